#include "app/commands/organ_import.h"

#include <charconv>
#include <filesystem>
#include <optional>
#include <ostream>

#include "app/commands/organ_report.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/label_table.h"
#include "tissue/mesh/surface_import.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

/// "liver" from "dir/liver.nii.gz".
std::string plain_stem(const fs::path& path) {
  const std::string file = path.filename().string();
  for (const std::string_view suffix : {".nii.gz", ".nii", ".ply"})
    if (file.ends_with(suffix)) return file.substr(0, file.size() - suffix.size());
  return path.stem().string();
}

std::optional<int> whole_number(const std::string& text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string listed(const std::map<int, std::size_t>& counts) {
  std::string text;
  for (const auto& [label, voxels] : counts) text += (text.empty() ? "" : ", ") + std::to_string(label);
  return text;
}

/// A label as the user meant it, checked against the map.
struct ChosenLabel {
  int number = 0;
  std::string name;   ///< "" when no table was used or it does not name the number
  std::string table;  ///< "" when no table was used
};

ChosenLabel choose_label(const OrganImportOptions& options, const LabelVolume& volume, const std::string& file,
                         std::ostream& err) {
  const auto counts = volume.label_counts();
  const LabelTable& table = label_table(options.label_table);
  const auto number = whole_number(options.label);
  ChosenLabel chosen;
  if (options.label.empty()) {
    if (counts.size() > 1) throw InputError(file + ": holds labels " + listed(counts) + ": say which with --label");
    chosen.number = counts.begin()->first;
  } else if (number) {
    chosen.number = *number;
  } else {
    const auto found = table.number_of(options.label);
    if (!found) throw InputError("--label " + options.label + ": not in the table " + std::string(table.name));
    chosen.number = *found;
  }
  const bool by_name = !options.label.empty() && !number;
  if (by_name || counts.size() > 1) {
    chosen.table = table.name;
    chosen.name = table.name_of(chosen.number).value_or("");
    err << "label " << chosen.number
        << (chosen.name.empty() ? " has no name in the table " : " is \"" + chosen.name + "\" in the table ")
        << chosen.table << ", which was assumed\n";
  }
  if (!counts.contains(chosen.number))
    throw InputError(file + ": label " + std::to_string(chosen.number) + (by_name ? " (" + options.label + ")" : "") +
                     " marks no voxel; the map holds " + listed(counts));
  return chosen;
}

CompiledOrgan compile_map(const OrganImportOptions& options, OrganManifest& manifest, std::ostream& err) {
  const fs::path map = options.labels.empty() ? options.input : options.labels;
  const LabelVolume volume = read_label_volume(map);
  const ChosenLabel label = choose_label(options, volume, map.string(), err);
  manifest.source.file = map.filename().string();
  manifest.source.sha256 = digest::of_file(map);
  manifest.source.unit = "mm";
  manifest.source.label = label.number;
  manifest.source.label_name = label.name;
  manifest.source.label_table = label.table;
  manifest.source.modality = !options.modality.empty() ? options.modality
                             : options.labels.empty()  ? "unknown"
                                                       : guess_modality(options.input);
  manifest.name = !label.name.empty() ? label.name : plain_stem(map);
  return compile_label(volume, label.number, {options.triangles});
}

CompiledOrgan compile_ply(const OrganImportOptions& options, OrganManifest& manifest) {
  const fs::path path = options.input;
  if (!options.labels.empty() || !options.label.empty())
    throw InputError("--label and --labels go with a label map, not with " + options.input);
  const ImportedSurface source = import_surface(path, options.unit);
  manifest.source.file = path.filename().string();
  manifest.source.sha256 = digest::of_file(path);
  manifest.source.unit = options.unit;
  manifest.source.modality = "surface";
  manifest.name = plain_stem(path);
  CompiledOrgan organ = compile_surface(source.surface, {options.triangles});
  organ.facts.repairs.insert(organ.facts.repairs.begin(), source.repairs.begin(), source.repairs.end());
  for (const double volume : source.lost_volumes_m3) organ.facts.lost.push_back({"part", 0, volume * 1e6});
  return organ;
}

void check_options(const OrganImportOptions& options) {
  constexpr int kFewest = 200, kMost = 200000;
  if (options.input.empty()) throw InputError("no input file");
  if (options.output.empty()) throw InputError("-o: no output name");
  if (options.triangles < kFewest || options.triangles > kMost)
    throw InputError("--triangles " + std::to_string(options.triangles) + ": 200 to 200000 are wanted");
}

fs::path stem_of(const std::string& output) {
  fs::path stem = output.ends_with(kOrganSuffix) ? output.substr(0, output.size() - kOrganSuffix.size()) : output;
  if (stem.filename().empty() || stem.filename() == "." || stem.filename() == "..")
    throw InputError("-o " + output + ": names a folder, not an organ");
  return stem;
}

/// Two names of one file: the surface would replace what it was made from.
void check_not_input(const fs::path& stem, const OrganImportOptions& options) {
  std::error_code missing;
  const fs::path ply = stem.string() + ".ply";
  if (fs::equivalent(ply, options.input, missing))
    throw InputError("-o " + options.output + ": would overwrite its input " + options.input);
}

}  // namespace

WrittenOrgan import_organ(const OrganImportOptions& options, std::ostream& err) {
  check_options(options);
  const fs::path stem = stem_of(options.output);
  check_not_input(stem, options);
  OrganManifest manifest;
  const bool surface = options.input.ends_with(".ply");
  if (!surface && !options.unit.empty() && options.unit != "mm")
    throw InputError("--unit " + options.unit + ": label maps are in mm");
  CompiledOrgan organ = surface ? compile_ply(options, manifest) : compile_map(options, manifest, err);
  if (!options.name.empty()) manifest.name = options.name;
  manifest.material = options.material.empty() ? manifest.name : options.material;
  manifest.licence = options.licence.empty() ? "unknown" : options.licence;
  manifest.credit = options.credit;
  manifest.synthetic = options.synthetic;
  manifest.mesh = std::move(organ.facts);
  write_organ(stem, manifest, organ.surface);
  if (manifest.mesh.self_intersections > 0)
    err << "warning: the surface cuts itself in " << manifest.mesh.self_intersections
        << " places; try another --triangles\n";
  if (manifest.mesh.cut_at_border()) err << "note: the image ends inside the organ; the flat cap is not anatomy\n";
  return {std::move(manifest), std::move(organ.surface)};
}

int organ_import(const OrganImportOptions& options, std::ostream& out, std::ostream& err) {
  const WrittenOrgan organ = import_organ(options, err);
  out << (options.json ? organ_json(organ.manifest, organ.surface.bounds())
                       : organ_text(organ.manifest, organ.surface.bounds()));
  return 0;
}

}  // namespace trocar
