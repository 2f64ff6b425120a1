#include "app/organs/organ_naming.h"

#include <algorithm>
#include <optional>

#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/organ/material_names.h"
#include "tissue/organ/material_table.h"

namespace trocar {
namespace {

MaterialTable materials_for(const OrganImportOptions& options) {
  const std::filesystem::path assets = options.assets.empty() ? find_assets().assets : options.assets;
  return MaterialTable::load(assets / "materials.toml");
}

void require_known(const MaterialTable& table, const std::string& material) {
  if (material.empty() || table.knows(material)) return;
  std::string known;
  for (const TissueMaterial& one : table.all()) known += (known.empty() ? "" : ", ") + one.name;
  throw InputError("--material " + material + ": no such material; there are " + known);
}

/// The first of the file's codes whose meaning is a material; nullptr for none.
const SegmentCode* known_code(const MaterialTable& table, const std::vector<SegmentCode>& codes) {
  const auto found = std::find_if(codes.begin(), codes.end(), [&](const SegmentCode& code) {
    return (code.role == "type" || code.role == "region") && table.knows(code.meaning);
  });
  return found == codes.end() ? nullptr : &*found;
}

/// The material of what has a name: by the name, else by the file's code, else soft tissue, which is said; so is a code
/// that is about something else than the name.
void find_material(const MaterialTable& table, const std::vector<SegmentCode>& codes, OrganNaming& naming) {
  naming.material = folded_name(naming.name);
  const SegmentCode* code = known_code(table, codes);
  const std::string coded = code == nullptr ? "" : folded_name(code->meaning);
  const auto holds = [](const std::string& text, const std::string& part) { return text.find(part) != text.npos; };
  if (table.knows(naming.name)) {
    if (!holds(naming.material, coded) && !holds(coded, naming.material))
      naming.decisions.push_back("\"" + naming.name + "\" is its name, but its code " + code->scheme + " " +
                                 code->value + " says \"" + code->meaning + "\": it was taken by the name");
  } else if (code != nullptr) {
    naming.material = coded;
    naming.decisions.push_back("material " + coded + " by the file's code " + code->scheme + " " + code->value + " \"" +
                               code->meaning + "\"");
  } else {
    naming.decisions.push_back("no material is called \"" + naming.name + "\": it feels like " + kFallbackMaterial +
                               " (--material says another)");
  }
}

std::string output_name(const OrganImportOptions& options) {
  const std::string file = std::filesystem::path(options.output).filename().string();
  return file.substr(0, file.find('.'));
}

std::string numbered(const std::vector<const Segment*>& nameless) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> numbers;
  for (const Segment* segment : nameless) numbers.push_back(std::to_string(segment->number));
  return (nameless.size() == 1 ? "label " : "labels ") + listed_words(numbers, kMost);
}

[[noreturn]] void ask(const std::vector<const Segment*>& nameless, const LabelMap& map, const std::string& file,
                      bool scene) {
  const std::vector<std::string> fitting = guess_label_table(map);
  const std::string tables = listed_words(fitting, fitting.size());
  throw InputError(file + ": " + numbered(nameless) + (nameless.size() == 1 ? " has" : " have") +
                   " no name in the file, so nothing says what it is or how it feels: say which table numbered it "
                   "(--label-table NAME, or a file of lines \"1,liver\"" +
                   (tables.empty() ? "" : "; known tables with all its numbers: " + tables) + ")" +
                   (scene ? "" : ", or what it is (--name liver)") + ", or give a material (--material " +
                   kFallbackMaterial + ")");
}

/// A label that neither file nor table names, alone: the user's word for it, in -o or in the name of the file, when it
/// is one that a material knows.
std::optional<OrganNaming> named_by_files(const OrganImportOptions& options, const MaterialTable& table,
                                          const std::string& file_stem, bool only_one) {
  const std::string output = output_name(options);
  if (table.knows(output))
    return OrganNaming{output, folded_name(output), {"called \"" + output + "\" as -o says: the label has no name"}};
  if (only_one && table.knows(file_stem))
    return OrganNaming{
        file_stem, folded_name(file_stem), {"called \"" + file_stem + "\" after its file: the label has no name"}};
  return std::nullopt;
}

}  // namespace

std::vector<OrganNaming> name_labels(const OrganImportOptions& options, const std::vector<ChosenLabel>& labels,
                                     const LabelMap& map, const std::string& file_stem, const std::string& file,
                                     bool scene) {
  const MaterialTable table = materials_for(options);
  require_known(table, options.material);
  const bool only_one = map.segments.size() == 1;
  std::vector<OrganNaming> all;
  std::vector<const Segment*> nameless;
  for (const ChosenLabel& label : labels) {
    OrganNaming naming;
    const bool told = !label.segment.name.empty() || (!scene && !options.name.empty());
    naming.name = !scene && !options.name.empty() ? options.name
                  : !told && !scene && only_one   ? file_stem
                                                  : file_name_of(label.segment);
    if (!options.material.empty() && (!scene || !told))
      naming.material = folded_name(options.material);
    else if (told)
      find_material(table, label.segment.codes, naming);
    else if (const auto found = scene ? std::nullopt : named_by_files(options, table, file_stem, only_one))
      naming = *found;
    else
      nameless.push_back(&label.segment);
    all.push_back(std::move(naming));
  }
  if (!nameless.empty()) ask(nameless, map, file, scene);
  const bool used =
      std::any_of(labels.begin(), labels.end(), [](const ChosenLabel& l) { return l.segment.name.empty(); });
  if (scene && !options.material.empty() && !used)
    throw InputError("--material goes with one organ, or with labels without a name; those of this scene have names");
  return all;
}

OrganNaming name_surface(const OrganImportOptions& options, const std::string& by_default,
                         const std::string& own_material) {
  const MaterialTable table = materials_for(options);
  require_known(table, options.material);
  const bool own = options.material.empty() && table.knows(own_material);
  OrganNaming naming{
      options.name.empty() ? by_default : options.name, folded_name(own ? own_material : options.material), {}};
  if (naming.material.empty()) find_material(table, {}, naming);
  return naming;
}

}  // namespace trocar
