#include "app/commands/organ_import.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "app/commands/organ_report.h"
#include "app/import/chosen_labels.h"
#include "app/import/import_source.h"
#include "app/import/organ_page.h"
#include "app/import/volume_files.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/label_table_file.h"
#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/mesh/organ_compiler.h"
#include "tissue/mesh/scene_compiler.h"
#include "tissue/mesh/surface_import.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "trocar " TROCAR_VERSION;

void append(std::vector<std::string>& all, const std::vector<std::string>& more) { all.insert(all.end(), more.begin(), more.end()); }

/// Decisions that the list of repairs does not tell already, each once.
std::vector<std::string> untold(const std::vector<std::string>& decisions, const std::vector<std::string>& repairs) {
  std::vector<std::string> fresh;
  for (const std::string& decision : decisions)
    if (std::find(repairs.begin(), repairs.end(), decision) == repairs.end() && std::find(fresh.begin(), fresh.end(), decision) == fresh.end())
      fresh.push_back(decision);
  return fresh;
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
  manifest.source.label = label.segment.number;
  manifest.source.label_name = label.segment.name;
  manifest.source.label_table = label.table;
  return manifest;
}

void name_organ(const OrganImportOptions& options, const std::string& by_default, OrganManifest& manifest) {
  manifest.name = options.name.empty() ? by_default : options.name;
  manifest.material = options.material.empty() ? manifest.name : options.material;
}

WrittenOrgans import_label(const OrganImportOptions& options, ImportSource&& source, const ChosenLabel& label,
                           const std::vector<std::string>& decisions, const fs::path& stem) {
  OrganManifest manifest = label_manifest(options, source, label);
  name_organ(options, label.segment.name.empty() && source.map.segments.size() == 1 ? source.stem : file_name_of(label.segment), manifest);
  const LabelVolume& layer = source.map.layers[label.segment.layer];
  CompiledOrgan organ = compile_label(layer, label.segment.number, {options.triangles, {.only_largest = options.largest_only}, options.progress});
  manifest.mesh = std::move(organ.facts);
  manifest.decisions = untold(decisions, manifest.mesh.repairs);
  std::vector<SideFile> files = volume_meshes(options, stem, organ.surface, {&layer, label.segment.number}, manifest);
  WrittenOrgans written;
  written.organs.push_back({std::move(manifest), std::move(organ.surface)});
  written.files = std::move(files);
  written.image = std::move(source.image);
  written.labels = std::move(source.map);
  return written;
}

WrittenOrgans import_surface_file(const OrganImportOptions& options, const fs::path& stem) {
  const fs::path path = options.input;
  if (!options.labels.empty() || !options.label.empty() || options.all || options.threshold.window)
    throw InputError("--label, --labels, --all and --threshold go with images, not with " + options.input);
  SurfaceImportOptions how{.unit = options.surface.unit, .frame = options.surface.frame, .up_axis = options.surface.up_axis,
                           .part = options.surface.part, .organ = options.name, .fill_holes_mm = options.surface.fill_holes_mm, .wrap = {}};
  if (options.surface.wrap) how.wrap = WrapSettings{.alpha_mm = options.surface.wrap_alpha_mm};
  const ImportedSurface source = import_surface(path, how, options.progress);
  OrganManifest manifest = common_manifest(options, {path.filename().string(), digest::of_file(path), "surface", source.unit, {}, "", ""});
  name_organ(options, options.surface.part.empty() ? path.stem().string() : file_name_of({0, 0, options.surface.part}), manifest);
  manifest.decisions = source.decisions;
  append(manifest.decisions, source.warnings);
  CompiledOrgan organ = compile_surface(source.surface, {options.triangles, {}, options.progress});
  organ.facts.repairs.insert(organ.facts.repairs.begin(), source.repairs.begin(), source.repairs.end());
  for (const double volume : source.lost_volumes_m3) organ.facts.lost.push_back({"part", 0, volume * 1e6});
  manifest.mesh = std::move(organ.facts);
  std::vector<SideFile> files = volume_meshes(options, stem, organ.surface, {}, manifest);
  WrittenOrgans written;
  written.organs.push_back({std::move(manifest), std::move(organ.surface)});
  written.files = std::move(files);
  return written;
}

/// The organ that exercises are done on: as asked, else the liver, else the largest.
std::string subject_of(const OrganImportOptions& options, const std::vector<CompiledMember>& organs) {
  const auto named = [&](const std::string& name) {
    return std::any_of(organs.begin(), organs.end(), [&](const CompiledMember& organ) { return organ.manifest.name == name; });
  };
  if (!options.subject.empty() && !named(options.subject)) throw InputError("--subject " + options.subject + ": not one of the organs of the scene");
  if (!options.subject.empty()) return options.subject;
  if (named("liver")) return "liver";
  const auto largest = std::max_element(organs.begin(), organs.end(), [](const CompiledMember& a, const CompiledMember& b) {
    return a.manifest.mesh.volume_ml < b.manifest.mesh.volume_ml;
  });
  return largest->manifest.name;
}

/// Name of what an organ lies against: the file's, the named table's, or the number.
std::string label_words(const LabelMap& map, const Attachment& attachment, const OrganImportOptions& options) {
  for (const Segment& segment : map.segments)
    if (segment.layer == attachment.layer && segment.number == attachment.number && !segment.name.empty()) return segment.name;
  if (!options.label_table.empty())
    if (const auto name = label_table_or_file(options.label_table).table().name_of(attachment.number)) return std::string(*name);
  return "label " + std::to_string(attachment.number);
}

std::vector<SceneRequest> requests_of(const OrganImportOptions& options, const std::vector<ChosenLabel>& labels) {
  std::vector<SceneRequest> requests;
  for (const ChosenLabel& label : labels)
    requests.push_back({label.segment.layer, label.segment.number, file_name_of(label.segment), options.triangles});
  return requests;
}

/// An organ that cuts itself in the common mesh is meshed alone: a clean surface goes before a shared one, and that is said.
void mesh_alone_what_cuts_itself(const OrganImportOptions& options, const LabelMap& map, const std::vector<ChosenLabel>& labels, CompiledScene& scene,
                                 std::vector<bool>& alone) {
  for (std::size_t n = 0; n < labels.size(); ++n) {
    if (scene.organs[n].facts.self_intersections == 0) continue;
    const Segment& segment = labels[n].segment;
    CompiledOrgan fresh = compile_label(map.layers[segment.layer], segment.number, {options.triangles, {.only_largest = options.largest_only}, options.progress});
    if (fresh.facts.self_intersections >= scene.organs[n].facts.self_intersections) continue;
    scene.notes.push_back(file_name_of(segment) + " cut itself in " + std::to_string(scene.organs[n].facts.self_intersections) +
                          " places of the common mesh and was meshed alone: it lies against its neighbours, but shares no triangles with them");
    scene.organs[n] = std::move(fresh);
    alone[n] = true;
  }
}

WrittenOrgans import_scene(const OrganImportOptions& options, ImportSource&& source, const std::vector<ChosenLabel>& labels,
                           const std::vector<std::string>& decisions, const fs::path& stem) {
  if (!options.material.empty()) throw InputError("--material goes with one organ; those of a scene have theirs by name");
  CompiledScene scene = compile_scene(source.map, requests_of(options, labels), {{.only_largest = options.largest_only}, options.progress});
  std::vector<bool> alone(labels.size(), false);
  mesh_alone_what_cuts_itself(options, source.map, labels, scene, alone);
  WrittenOrgans written;
  std::vector<SideFile> more;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    OrganManifest manifest = label_manifest(options, source, labels[n]);
    manifest.name = manifest.material = file_name_of(labels[n].segment);
    manifest.mesh = std::move(scene.organs[n].facts);
    manifest.decisions = untold(decisions, manifest.mesh.repairs);
    const fs::path member = member_stem(stem, manifest.name);
    const LabelledOrgan made_from{&source.map.layers[labels[n].segment.layer], labels[n].segment.number};
    for (SideFile& file : volume_meshes(options, member, scene.organs[n].surface, made_from, manifest)) more.push_back(std::move(file));
    for (SideFile& file : vessel_files(options, member, made_from, manifest.name)) more.push_back(std::move(file));
    written.organs.push_back({std::move(manifest), std::move(scene.organs[n].surface)});
  }
  OrganSet set;
  set.name = options.name.empty() ? stem.filename().string() : options.name;
  set.subject = subject_of(options, written.organs);
  for (const SharedInterface& shared : scene.shared)
    set.contacts.push_back({written.organs[shared.first].manifest.name, written.organs[shared.second].manifest.name, shared.area_m2,
                            !alone[shared.first] && !alone[shared.second]});
  for (const Attachment& attachment : scene.attachments)
    if (!alone[attachment.organ])  // the list names triangles of the common mesh
      set.attachments.push_back({written.organs[attachment.organ].manifest.name, label_words(source.map, attachment, options), attachment.area_m2, attachment.triangles});
  written.files = std::move(more);
  written.set = std::move(set);
  written.image = std::move(source.image);
  written.labels = std::move(source.map);
  written.notes = std::move(scene.notes);
  return written;
}

void check_options(const OrganImportOptions& options) {
  constexpr int kFewest = 200, kMost = 200000;
  if (options.input.empty()) throw InputError("no input file");
  if (options.output.empty()) throw InputError("-o: no output name");
  if (options.triangles < kFewest || options.triangles > kMost)
    throw InputError("--triangles " + std::to_string(options.triangles) + ": 200 to 200000 are wanted");
  if (!options.report.empty() && options.report.extension() != ".html" && options.report.extension() != ".htm")
    throw InputError("--report " + options.report.string() + ": the page is HTML: name it NAME.html");
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
  for (const std::string& suffix : {std::string(".ply"), std::string(".lattice"), std::string(".msh")})
    if (fs::equivalent(stem.string() + suffix, options.input, missing))
      throw InputError("-o " + options.output + ": would overwrite its input " + options.input);
}

/// The page is made before anything is written, and written with the rest.
void add_page(const OrganImportOptions& options, WrittenOrgans& written) {
  for (CompiledMember& organ : written.organs)
    enter_surface(written.set ? member_stem(written.stem, organ.manifest.name) : written.stem, organ.manifest, organ.surface);
  const OrganPageContent content{written.organs, written.set ? &*written.set : nullptr, written.image ? &*written.image : nullptr,
                                 written.labels ? &*written.labels : nullptr, written.notes, options.assets};
  written.files.push_back({fs::absolute(options.report).string(), organ_page(content)});
}

void write(WrittenOrgans& written) {
  written.manifest = written.set ? write_organ_set(written.stem, *written.set, written.organs, written.files)
                                 : write_organ(written.stem, written.organs[0].manifest, written.organs[0].surface, written.files);
}

void remark(const WrittenOrgans& written, std::ostream& err) {
  for (const CompiledMember& organ : written.organs) {
    const MeshFacts& mesh = organ.manifest.mesh;
    for (const std::string& decision : organ.manifest.decisions) {
      if (&organ == &written.organs.front()) err << "note: " << decision << "\n";
    }
    if (mesh.self_intersections > 0)
      err << "warning: " << organ.manifest.name << ": the surface cuts itself in " << mesh.self_intersections << " places; try another --triangles\n";
    if (mesh.cut_at_border())
      err << "note: " << organ.manifest.name << " is cut at the volume border: the image ends inside it, the flat cap is not anatomy\n";
  }
  for (const std::string& note : written.notes) err << "note: " << note << "\n";
}

}  // namespace

WrittenOrgans import_organs(const OrganImportOptions& options, std::ostream& err) {
  check_options(options);
  const fs::path stem = stem_of(options.output);
  check_not_input(stem, options);
  WrittenOrgans written;
  if (is_surface_input(options)) {
    written = import_surface_file(options, stem);
  } else {
    ImportSource source = read_import_source(options);
    std::vector<std::string> decisions = source.map.notes;
    if (source.image) append(decisions, source.image->notes);
    const std::vector<ChosenLabel> labels = choose_labels(options, source.map, source.file, decisions);
    const bool scene = labels.size() > 1 || options.all || options.output.ends_with(kOrganSetSuffix);
    written = scene ? import_scene(options, std::move(source), labels, decisions, stem)
                    : import_label(options, std::move(source), labels.front(), decisions, stem);
  }
  written.stem = stem;
  if (!options.report.empty()) add_page(options, written);
  write(written);
  remark(written, err);
  return written;
}

int organ_import(const OrganImportOptions& options, std::ostream& out, std::ostream& err) {
  const WrittenOrgans written = import_organs(options, err);
  if (written.set)
    out << (options.json ? scene_report_json(*written.set, written.organs) : scene_report_text(*written.set, written.organs));
  else
    out << (options.json ? organ_json(written.organs[0].manifest, written.organs[0].surface.bounds())
                         : organ_text(written.organs[0].manifest, written.organs[0].surface.bounds()));
  return 0;
}

}  // namespace trocar
