#include "app/organs/organ_import.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <ostream>

#include "app/organs/chosen_labels.h"
#include "app/organs/import_source.h"
#include "app/organs/organ_files.h"
#include "app/organs/organ_naming.h"
#include "app/organs/organ_page.h"
#include "app/organs/organ_report.h"
#include "app/organs/replaced_files.h"
#include "app/organs/volume_files.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "haptics/utf8.h"
#include "tissue/imaging/labels/label_table_file.h"
#include "tissue/imaging/labels/one_layer.h"
#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/volumes/volume_reader.h"
#include "tissue/mesh/files/surface_pieces.h"
#include "tissue/mesh/files/winding.h"
#include "tissue/organ/file_lock.h"
#include "tissue/organ/organ_compiler.h"
#include "tissue/organ/scene_compiler.h"
#include "tissue/organ/surface_import.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "trocar " TROCAR_VERSION;

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Decisions that the list of repairs does not tell already, each once.
std::vector<std::string> untold(const std::vector<std::string>& decisions, const std::vector<std::string>& repairs) {
  std::vector<std::string> fresh;
  const auto among = [](const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  for (const std::string& decision : decisions)
    if (!among(repairs, decision) && !among(fresh, decision)) fresh.push_back(decision);
  return fresh;
}

/// Image values for the page; none without an image.
std::vector<LabelValues> values_of(const OrganImportOptions& options, const ImportSource& source,
                                   const std::vector<ChosenLabel>& labels) {
  std::vector<LabelValues> values;
  if (source.image && !options.report.empty())
    for (const ChosenLabel& label : labels) values.push_back(image_values(source, label.segment));
  return values;
}

/// What is the same for every organ of an import.
OrganManifest common_manifest(const OrganImportOptions& options, const OrganSource& source) {
  OrganManifest manifest;
  manifest.program = kProgram;
  manifest.source = source;
  manifest.licence = options.licence.empty() ? "unknown" : options.licence;
  manifest.credit = options.credit;
  manifest.synthetic = options.synthetic || options.label_table == kPhantomTable;
  return manifest;
}

OrganManifest label_manifest(const OrganImportOptions& options, const ImportSource& source, const ChosenLabel& label) {
  OrganManifest manifest = common_manifest(options, source.source);
  OrganSource& origin = manifest.source;
  if (const auto own = source.origin.find(label.segment.number); own != source.origin.end()) {
    origin = own->second;
    origin.modality = source.source.modality;
  } else {
    origin.label = label.segment.number;
  }
  origin.label_name = is_utf8(label.segment.name) ? label.segment.name : file_name_of(label.segment);
  origin.label_table = label.table;
  origin.colour = label.segment.colour;
  for (const SegmentCode& code : label.segment.codes)
    if (is_utf8(code.scheme + code.value))
      origin.codes.push_back({code.role, code.scheme, code.value, is_utf8(code.meaning) ? code.meaning : ""});
  return manifest;
}

void name_organ(const OrganNaming& naming, OrganManifest& manifest) {
  manifest.name = naming.name;
  manifest.material = naming.material;
}

/// Of a mask among several, of the label map else.
std::string source_file_of(const ImportSource& source, int label) {
  const auto own = source.origin.find(label);
  return own == source.origin.end() ? source.file : own->second.file;
}

/// What keeps a label from becoming an organ, with the file before it.
template <typename Work>
auto with_file_named(const std::string& file, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
}

fs::path manifest_at(const fs::path& stem, bool scene) {
  return stem.string() + std::string(scene ? kOrganSetSuffix : kOrganSuffix);
}

/// The files of every organ, but for the manifest at `stem`. @param members of a scene, none for one organ
std::vector<fs::path> organ_targets(const fs::path& stem, const std::vector<std::string>& members) {
  if (members.empty()) return {stem.string() + ".ply"};
  std::vector<fs::path> targets;
  for (const std::string& member : members)
    for (const std::string_view suffix : {std::string_view(".ply"), kOrganSuffix})
      targets.push_back(member_stem(stem, member).string() + std::string(suffix));
  return targets;
}

/// Asked before the minutes of meshing; what is written is asked once more, with every file.
void refuse_foreign_early(const fs::path& stem, const std::vector<OrganNaming>& members) {
  std::vector<std::string> names;
  for (const OrganNaming& member : members) names.push_back(member.name);
  const fs::path manifest = manifest_at(stem, !members.empty());
  require_not_foreign(manifest, files_named_by(manifest), organ_targets(stem, names));
}

/// A single organ whose form too few triangles cannot hold is not one: its numbers would be those of another body.
CompiledOrgan with_its_form(CompiledOrgan&& organ) {
  if (organ.lost) throw InputError(lost_form_words(*organ.lost));
  return std::move(organ);
}

WrittenOrgans import_label(const OrganImportOptions& options, ImportSource&& source, const ChosenLabel& label,
                           std::vector<std::string> decisions, const fs::path& stem) {
  OrganManifest manifest = label_manifest(options, source, label);
  const OrganNaming naming = name_labels(options, {label}, source.map, source.stem, source.file, false).front();
  refuse_foreign_early(stem, {});
  name_organ(naming, manifest);
  decisions.insert(decisions.begin(), naming.decisions.begin(), naming.decisions.end());
  const LabelVolume& layer = source.map.layers[label.segment.layer];
  const MeshFit fit = options.synthetic ? MeshFit::kAlongNormals : MeshFit::kOntoBends;
  const CompileOptions how{options.triangles, {.only_largest = options.largest_only}, options.progress, fit};
  CompiledOrgan organ = with_file_named(source_file_of(source, label.segment.number),
                                        [&] { return with_its_form(compile_label(layer, label.segment.number, how)); });
  manifest.mesh = std::move(organ.facts);
  manifest.decisions = untold(decisions, manifest.mesh.repairs);
  std::vector<SideFile> files = volume_meshes(options, stem, organ.surface, {&layer, label.segment.number}, manifest);
  WrittenOrgans written;
  written.organs.push_back({std::move(manifest), std::move(organ.surface)});
  written.files = std::move(files);
  written.values = values_of(options, source, {label});
  written.image = std::move(source.image);
  written.labels = std::move(source.map);
  return written;
}

SurfaceImportOptions surface_options(const OrganImportOptions& options) {
  const SurfaceChoices& asked = options.surface;
  SurfaceImportOptions how{.unit = asked.unit,
                           .frame = asked.frame,
                           .up_axis = asked.up_axis,
                           .part = asked.part,
                           .organ = options.name,
                           .fill_holes_mm = asked.fill_holes_mm,
                           .wrap = {},
                           .only_largest = options.largest_only};
  if (asked.wrap) how.wrap = WrapSettings{.alpha_mm = asked.wrap_alpha_mm};
  return how;
}

ImportedSurface read_surface(const OrganImportOptions& options, const fs::path& path, const OrganNaming& naming) {
  SurfaceImportOptions how = surface_options(options);
  if (how.organ.empty()) how.organ = naming.name;
  return import_surface(path, how, options.progress);
}

/// Which cavities stay: all of a file that our own export wrote, else those in which another organ lies, as of labels.
/// @param others a point within each piece of the other organs
void settle(ImportedSurface& source, const std::vector<Vec3>& others) {
  const bool own = !source.name.empty();
  settle_cavities(source, [&](const TriangleSurface& cavity) {
    const Eigen::AlignedBox3d box = cavity.bounds();
    return own || std::any_of(others.begin(), others.end(),
                              [&](const Vec3& point) { return box.contains(point) && encloses(cavity, point); });
  });
}

CompileOptions surface_compiling(const OrganImportOptions& options) {
  return {.triangles = options.triangles, .progress = options.progress};
}

/// One surface of another program as an organ. @param stem of its files; what they are goes into `files`
CompiledMember surface_member(const OrganImportOptions& options, const fs::path& path, const OrganNaming& naming,
                              const ImportedSurface& source, CompiledOrgan&& organ, const fs::path& stem,
                              std::vector<SideFile>& files) {
  const OrganSource origin{path.filename().string(), digest::of_file(path), "surface", source.unit, {}, "", ""};
  OrganManifest manifest = common_manifest(options, origin);
  name_organ(naming, manifest);
  manifest.decisions = source.warnings;
  append(manifest.decisions, source.decisions);
  append(manifest.decisions, naming.decisions);
  organ.facts.repairs.insert(organ.facts.repairs.begin(), source.repairs.begin(), source.repairs.end());
  for (const double volume : source.lost_volumes_m3) organ.facts.lost.push_back({"part", 0, volume * 1e6});
  for (const double volume : source.filled_volumes_m3) organ.facts.added.push_back({"cavity", 0, volume * 1e6});
  manifest.mesh = std::move(organ.facts);
  for (SideFile& file : volume_meshes(options, stem, organ.surface, {}, manifest)) files.push_back(std::move(file));
  return {std::move(manifest), std::move(organ.surface)};
}

WrittenOrgans import_surface_file(const OrganImportOptions& options, const fs::path& path, const fs::path& stem) {
  if (!options.labels.empty() || !options.label.empty() || options.all || options.threshold.window)
    throw InputError("--label, --labels, --all and --threshold go with images, not with " + options.input);
  refuse_foreign_early(stem, {});
  const std::string by_default =
      options.surface.part.empty() ? path.stem().string() : file_name_of({0, 0, options.surface.part});
  OrganNaming naming = name_surface(options, by_default);
  ImportedSurface source = read_surface(options, path, naming);
  settle(source, {});
  if (!source.name.empty() && options.surface.part.empty()) {
    const std::string own = file_name_of({0, 0, source.name});
    naming = name_surface(options, own, options.name.empty() ? source.material : "");
    if (naming.name != by_default && options.name.empty())
      naming.decisions.push_back("called \"" + own + "\" as a comment of our own export says");
  }
  CompiledOrgan organ = with_file_named(
      path.string(), [&] { return with_its_form(compile_surface(source.surface, surface_compiling(options))); });
  WrittenOrgans written;
  written.organs.push_back(surface_member(options, path, naming, source, std::move(organ), stem, written.files));
  return written;
}

/// The organ that exercises are done on: as asked, else the liver, else the largest.
std::string subject_of(const OrganImportOptions& options, const std::vector<CompiledMember>& organs) {
  const auto named = [&](const std::string& name) {
    return std::any_of(organs.begin(), organs.end(),
                       [&](const CompiledMember& organ) { return organ.manifest.name == name; });
  };
  if (!options.subject.empty() && !named(options.subject))
    throw InputError("--subject " + options.subject + ": not one of the organs of the scene");
  if (!options.subject.empty()) return options.subject;
  if (named("liver")) return "liver";
  const auto largest =
      std::max_element(organs.begin(), organs.end(), [](const CompiledMember& a, const CompiledMember& b) {
        return a.manifest.mesh.volume_ml < b.manifest.mesh.volume_ml;
      });
  return largest->manifest.name;
}

/// Names of what organs lie against: the file's, the named table's, or the number. The table is read once.
class LabelWords {
 public:
  LabelWords(const LabelMap& map, const std::string& table) : map_(map) {
    if (!table.empty()) table_ = label_table_or_file(table);
  }

  std::string operator()(const Attachment& attachment) const {
    for (const Segment& segment : map_.segments)
      if (segment.layer == attachment.layer && segment.number == attachment.number && is_utf8(segment.name) &&
          !segment.name.empty())
        return segment.name;
    if (table_)
      if (const auto name = table_->table().name_of(attachment.number)) return std::string(*name);
    return "label " + std::to_string(attachment.number);
  }

 private:
  const LabelMap& map_;
  std::optional<OwnLabelTable> table_;
};

std::vector<SceneRequest> requests_of(const OrganImportOptions& options, const std::vector<Segment>& segments) {
  std::vector<SceneRequest> requests;
  for (const Segment& segment : segments)
    requests.push_back({segment.layer, segment.number, file_name_of(segment), options.triangles});
  return requests;
}

/// What lies against what, by names. Triangles are common only where neither organ was meshed alone.
void add_contacts(const CompiledScene& scene, const std::vector<CompiledMember>& organs, OrganSet& set) {
  const auto name = [&](std::size_t organ) { return organs[organ].manifest.name; };
  for (const SharedInterface& shared : scene.shared)
    set.contacts.push_back({name(shared.first), name(shared.second), shared.area_m2, !shared.triangles.empty()});
}

OrganSet set_of(const OrganImportOptions& options, const LabelMap& map, const CompiledScene& scene,
                const std::vector<CompiledMember>& organs) {
  OrganSet set;
  set.subject = subject_of(options, organs);
  add_contacts(scene, organs, set);
  const LabelWords words(map, options.label_table);
  for (const Attachment& attachment : scene.attachments)
    set.attachments.push_back(
        {organs[attachment.organ].manifest.name, words(attachment), attachment.area_m2, attachment.triangles});
  return set;
}

/// One organ of a scene, with its files.
CompiledMember member_of(const OrganImportOptions& options, OrganManifest&& manifest, const LabelledOrgan& made_from,
                         const OrganNaming& naming, CompiledOrgan&& organ, std::vector<std::string> decisions,
                         const fs::path& stem, std::vector<SideFile>& files) {
  name_organ(naming, manifest);
  decisions.insert(decisions.begin(), naming.decisions.begin(), naming.decisions.end());
  manifest.mesh = std::move(organ.facts);
  manifest.decisions = untold(decisions, manifest.mesh.repairs);
  const fs::path member = member_stem(stem, manifest.name);
  for (SideFile& file : volume_meshes(options, member, organ.surface, made_from, manifest))
    files.push_back(std::move(file));
  for (SideFile& file : vessel_files(options, member, made_from, manifest.name)) files.push_back(std::move(file));
  return {std::move(manifest), std::move(organ.surface)};
}

WrittenOrgans import_scene(const OrganImportOptions& options, ImportSource&& source,
                           const std::vector<ChosenLabel>& labels, const std::vector<std::string>& decisions,
                           const fs::path& stem) {
  const std::vector<OrganNaming> names = name_labels(options, labels, source.map, source.stem, source.file, true);
  refuse_foreign_early(stem, names);
  std::vector<Segment> segments;
  for (const ChosenLabel& label : labels) segments.push_back(label.segment);
  const std::optional<LabelMap> flat = in_one_layer(source.map, segments);
  if (flat)
    for (Segment& segment : segments) segment.layer = 0;
  const LabelMap& map = flat ? *flat : source.map;
  CompiledScene scene = with_file_named(source.file, [&] {
    return compile_scene(map, requests_of(options, segments),
                         {{.only_largest = options.largest_only}, options.progress});
  });
  WrittenOrgans written;
  for (std::size_t n = 0; n < labels.size(); ++n)
    written.organs.push_back(member_of(options, label_manifest(options, source, labels[n]),
                                       {&map.layers[segments[n].layer], segments[n].number}, names[n],
                                       std::move(scene.organs[n]), decisions, stem, written.files));
  written.set = set_of(options, map, scene, written.organs);
  written.set->name = options.name.empty() ? stem.filename().string() : options.name;
  written.values = values_of(options, source, labels);
  written.image = std::move(source.image);
  written.labels = std::move(source.map);
  written.notes = std::move(scene.notes);
  return written;
}

/// What is asked for of each surface of a scene, called like its file.
std::vector<OrganImportOptions> asked_of_each(const OrganImportOptions& options, const OrganFiles& files,
                                              const std::vector<OrganFile>& chosen) {
  std::vector<OrganImportOptions> each;
  std::map<std::string, std::string> seen;
  for (const OrganFile& file : chosen) {
    const std::string place = files.zip ? files.input + ": " + file.path.filename().string() : file.path.string();
    OrganImportOptions& one = each.emplace_back(options);
    one.name = file_name_of({0, 0, file.name});
    const auto [other, fresh] = seen.emplace(one.name, place);
    if (!fresh)
      throw InputError(other->second + " and " + place + " would both be written as \"" + one.name +
                       "\": rename one of them, or import each by itself under another -o");
  }
  return each;
}

/// The surfaces of a scene, each with those of its cavities that stay.
std::vector<ImportedSurface> read_surfaces(const std::vector<OrganImportOptions>& each,
                                           const std::vector<OrganFile>& chosen,
                                           const std::vector<OrganNaming>& names) {
  std::vector<ImportedSurface> sources;
  std::vector<std::vector<Vec3>> within;
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    sources.push_back(read_surface(each[n], chosen[n].path, names[n]));
    within.push_back(points_within(sources.back().surface));
  }
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    std::vector<Vec3> others;
    for (std::size_t other = 0; other < chosen.size(); ++other)
      if (other != n) others.insert(others.end(), within[other].begin(), within[other].end());
    settle(sources[n], others);
  }
  return sources;
}

/// Several surfaces as one scene. What lies against what is told by the triangles that they have in common, and by
/// nothing else.
WrittenOrgans import_surface_scene(const OrganImportOptions& options, const OrganFiles& files, const fs::path& stem) {
  if (!options.labels.empty() || options.threshold.window || !options.surface.part.empty())
    throw InputError("--labels, --threshold and --part do not go with several surfaces");
  const std::vector<OrganFile> chosen = files.chosen(files.surfaces, options.label);
  const std::vector<OrganImportOptions> each = asked_of_each(options, files, chosen);
  std::vector<OrganNaming> names;
  for (const OrganImportOptions& one : each) names.push_back(name_surface(one, one.name));
  refuse_foreign_early(stem, names);
  std::vector<ImportedSurface> sources = read_surfaces(each, chosen, names);
  std::vector<TriangleSurface> surfaces;
  for (ImportedSurface& source : sources) surfaces.push_back(std::move(source.surface));
  CompiledScene scene = compile_surfaces(surfaces, surface_compiling(options));
  WrittenOrgans written;
  for (std::size_t n = 0; n < chosen.size(); ++n)
    written.organs.push_back(surface_member(each[n], chosen[n].path, names[n], sources[n], std::move(scene.organs[n]),
                                            member_stem(stem, each[n].name), written.files));
  OrganSet set;
  set.name = options.name.empty() ? stem.filename().string() : options.name;
  set.subject = subject_of(options, written.organs);
  add_contacts(scene, written.organs, set);
  written.set = std::move(set);
  return written;
}

/// The surfaces of a folder, a zip or a list: one where --label or --name asks for one, else a scene.
WrittenOrgans import_surfaces(const OrganImportOptions& options, const OrganFiles& files, const fs::path& stem) {
  OrganImportOptions asked = options;
  asked.label = files.asked(files.surfaces, options);
  const std::vector<OrganFile> chosen = files.chosen(files.surfaces, asked.label);
  if (chosen.size() > 1 || options.output.ends_with(kOrganSetSuffix)) return import_surface_scene(asked, files, stem);
  asked.label.clear(), asked.all = false;
  return import_surface_file(asked, chosen.front().path, stem);
}

/// Organ files are TOML, which is UTF-8: a name in another encoding could be written and never read again.
void check_texts(const OrganImportOptions& options) {
  for (const auto& [option, text] : {std::pair("-o", &options.output), std::pair("--name", &options.name),
                                     std::pair("--material", &options.material),
                                     std::pair("--licence", &options.licence), std::pair("--credit", &options.credit)})
    if (!is_utf8(*text))
      throw InputError(std::string(option) +
                       ": the text is not UTF-8, which organ files are written in: use UTF-8 or plain letters");
  std::vector<std::string> inputs = options.more_inputs;
  inputs.insert(inputs.end(), {options.input, options.labels});
  for (const std::string& file : inputs)
    if (!is_utf8(fs::path(file).filename().string()))
      throw InputError("an input's file name is not UTF-8, and organ files record it: rename the file (" +
                       fs::path(file).extension().string() + ")");
}

void check_options(const OrganImportOptions& options) {
  constexpr int kFewest = 200, kMost = 200000;
  if (options.input.empty()) throw InputError("no input file");
  if (options.output.empty()) throw InputError("-o: no output name");
  if (options.triangles < kFewest || options.triangles > kMost)
    throw InputError("--triangles " + std::to_string(options.triangles) + ": 200 to 200000 are wanted");
  if (!options.report.empty() && options.report.extension() != ".html" && options.report.extension() != ".htm")
    throw InputError("--report " + options.report.string() + ": the page is HTML: name it NAME.html");
  check_texts(options);
  for (const std::string& input : {options.input, options.labels}) refuse_own_manifest(input);
  for (const std::string& input : options.more_inputs) refuse_own_manifest(input);
  if (!fs::exists(options.input)) throw InputError(options.input + ": no such file or folder");
}

fs::path stem_of(const std::string& output) {
  fs::path stem = output;
  for (const std::string_view suffix : {kOrganSuffix, kOrganSetSuffix})
    if (output.ends_with(suffix)) stem = output.substr(0, output.size() - suffix.size());
  if (stem.filename().empty() || stem.filename() == "." || stem.filename() == "..")
    throw InputError("-o " + output + ": names a folder, not an organ");
  return stem;
}

/// Two names of one file: the surface would replace what it was made from.
void check_not_input(const fs::path& stem, const OrganImportOptions& options) {
  std::error_code missing;
  std::vector<std::string> inputs = options.more_inputs;
  inputs.push_back(options.input);
  for (const std::string& suffix : {std::string(".ply"), std::string(".lattice"), std::string(".msh")})
    for (const std::string& input : inputs)
      if (fs::equivalent(stem.string() + suffix, input, missing))
        throw InputError("-o " + options.output + ": would overwrite its input " + input);
}

/// The page is made before anything is written, and written with the rest.
void add_page(const OrganImportOptions& options, WrittenOrgans& written) {
  const OrganPageContent content{written.organs,
                                 written.set ? &*written.set : nullptr,
                                 written.image ? &*written.image : nullptr,
                                 written.labels ? &*written.labels : nullptr,
                                 written.notes,
                                 options.assets,
                                 written.values};
  written.files.push_back({fs::absolute(options.report).string(), organ_page(content)});
}

/// What is written beside the manifest, without a page that takes the place of an older one of this organ.
std::vector<fs::path> targets_of(const OrganImportOptions& options, const WrittenOrgans& written) {
  std::vector<std::string> members;
  for (const CompiledMember& organ : written.organs)
    if (written.set) members.push_back(organ.manifest.name);
  std::vector<fs::path> targets = organ_targets(written.stem, members);
  for (const SideFile& file : written.files) {
    const fs::path path = written.stem.parent_path() / file.name;
    const bool page = !options.report.empty() && path == fs::absolute(options.report);
    if (!page || !is_older_page(path, file.bytes)) targets.push_back(path);
  }
  return targets;
}

/// Writes everything, then takes away what an older organ of this name had and this one has not.
void write(const OrganImportOptions& options, WrittenOrgans& written) {
  const fs::path manifest = manifest_at(written.stem, written.set.has_value());
  const std::set<std::string> before = files_named_by(manifest);
  require_not_foreign(manifest, before, targets_of(options, written));
  if (written.set) {
    written.manifest = write_organ_set(written.stem, *written.set, written.organs, written.files);
  } else {
    const CompiledMember& organ = written.organs[0];
    written.manifest = write_entered_organ(written.stem, organ.manifest, organ.surface_bytes, written.files);
  }
  written.removed =
      remove_replaced(manifest, before, files_named_by(manifest), {options.input, options.labels, options.report});
}

/// "liver, spleen and 3 more": organs that the image does not hold whole; "" for none.
std::string cut_organs(const WrittenOrgans& written) {
  constexpr std::size_t kListed = 6;
  std::vector<std::string> names;
  for (const CompiledMember& organ : written.organs)
    if (organ.manifest.mesh.cut_at_border()) names.push_back(organ.manifest.name);
  return listed_words(names, kListed);
}

std::vector<OrganCrossing> crossings_of(const WrittenOrgans& written) {
  return written.set ? written.set->crossings : std::vector<OrganCrossing>{};
}

/// What was decided: in a scene with the names of the organs that it holds for before it, and last what holds for all.
std::vector<std::string> told_decisions(const WrittenOrgans& written) {
  constexpr std::size_t kListed = 4;
  std::vector<std::pair<std::string, std::vector<std::string>>> about;
  for (const CompiledMember& organ : written.organs)
    for (const std::string& decision : organ.manifest.decisions) {
      auto found = std::find_if(about.begin(), about.end(), [&](const auto& one) { return one.first == decision; });
      if (found == about.end()) found = about.insert(about.end(), {decision, {}});
      if (found->second.empty() || found->second.back() != organ.manifest.name)
        found->second.push_back(organ.manifest.name);
    }
  std::vector<std::string> some, all;
  for (const auto& [decision, organs] : about)
    if (organs.size() == written.organs.size())
      all.push_back(decision);
    else
      some.push_back(listed_words(organs, kListed) + ": " + decision);
  append(some, all);
  return some;
}

/// Warnings, and the first of what was decided; the manifests and the page have everything.
void remark(const WrittenOrgans& written, std::ostream& err) {
  constexpr std::size_t kFaults = 3, kNotes = 4;
  const std::vector<std::string> faults = faults_of(written.organs, crossings_of(written));
  for (std::size_t n = 0; n < std::min(faults.size(), kFaults); ++n) err << "warning: " << faults[n] << "\n";
  if (faults.size() > kFaults) err << "warning: and " << faults.size() - kFaults << " more, which the page has\n";
  const std::string ended = cut_organs(written);
  if (!ended.empty() && written.organs.size() > 1)
    err << "note: the image ends inside these, their flat cap is not anatomy: " << ended << "\n";
  std::vector<std::string> notes = told_decisions(written);
  append(notes, untold(written.notes, notes));
  for (std::size_t n = 0; n < std::min(notes.size(), kNotes); ++n) err << "note: " << notes[n] << "\n";
  if (notes.size() > kNotes)
    err << "note: and " << notes.size() - kNotes << " more, which the page and the manifests have\n";
  for (const std::string& file : written.removed)
    err << "note: removed " << file << ", which the organ of this name had before\n";
}

/// Labels of an image, a map or several masks. Masks in files of their own are a scene of all of them unless some were
/// asked for, by --label or --name.
WrittenOrgans import_labels(const OrganImportOptions& options, const std::optional<OrganFiles>& masks,
                            const fs::path& stem) {
  ImportSource source = read_import_source(options, masks);
  OrganImportOptions asked = options;
  if (!source.origin.empty() && options.label.empty() && options.name.empty() && source.map.segments.size() > 1)
    asked.all = true;
  if (asked.label_table.empty()) asked.label_table = source.map.table;
  std::vector<std::string> decisions = source.map.notes;
  if (source.image) append(decisions, source.image->notes);
  const std::vector<ChosenLabel> labels = choose_labels(asked, source.map, source.file, decisions, source.origin);
  const bool scene = labels.size() > 1 || asked.all || asked.output.ends_with(kOrganSetSuffix);
  return scene ? import_scene(asked, std::move(source), labels, decisions, stem)
               : import_label(asked, std::move(source), labels.front(), decisions, stem);
}

/// Masks or surfaces in several files, a folder or a zip; nothing where the input is something else.
std::optional<OrganFiles> input_files(const OrganImportOptions& options) {
  std::vector<std::string> inputs{options.input};
  inputs.insert(inputs.end(), options.more_inputs.begin(), options.more_inputs.end());
  const bool maybe = inputs.size() > 1 || !is_volume_file(options.input);
  return maybe ? organ_files(inputs, options.progress) : std::nullopt;
}

}  // namespace

WrittenOrgans import_organs(const OrganImportOptions& options, std::ostream& err) {
  check_options(options);
  const fs::path stem = stem_of(options.output);
  check_not_input(stem, options);
  const NameLock lock(stem);  // from before the old manifest is read until the last file has its name
  WrittenOrgans written;
  if (is_surface_input(options)) {
    written = import_surface_file(options, options.input, stem);
  } else {
    const std::optional<OrganFiles> files = input_files(options);
    written = files && !files->surfaces.empty() ? import_surfaces(options, *files, stem)
                                                : import_labels(options, files, stem);
  }
  written.stem = stem;
  CompiledMember& first = written.organs.front();
  if (written.set) enter_surfaces(stem, *written.set, written.organs);
  if (!written.set) first.surface_bytes = enter_surface(stem, first.manifest, first.surface);
  if (!options.report.empty()) add_page(options, written);
  write(options, written);
  remark(written, err);
  return written;
}

int organ_import(const OrganImportOptions& options, std::ostream& out, std::ostream& err) {
  const WrittenOrgans written = import_organs(options, err);
  const OrganManifest& first = written.organs[0].manifest;
  const Eigen::AlignedBox3d bounds = written.organs[0].surface.bounds();
  const std::string file = written.manifest.string();
  if (written.set)
    out << (options.json ? scene_report_json(*written.set, written.organs)
                         : scene_summary(*written.set, written.organs, file));
  else
    out << (options.json ? organ_json(first, bounds) : organ_summary(first, bounds, file));
  return faults_of(written.organs, crossings_of(written)).empty() ? 0 : 2;
}

}  // namespace trocar
