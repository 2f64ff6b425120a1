#include "tissue/organ/organ_manifest.h"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/organ/ply_file.h"
#include "tissue/organ/staged_file.h"
#include "tissue/organ/toml_table.h"

namespace trocar {
namespace {

std::string distance_text(const SurfaceDistance& distance) {
  const auto mm = [](double metres) { return TomlWriter::decimal(metres * 1e3, 4); };
  return "{mean = " + mm(distance.mean_m) + ", rms = " + mm(distance.rms_m) + ", p99 = " + mm(distance.p99_m) +
         ", max = " + mm(distance.max_m) + "}";
}

/// Rows {kind, voxels, volume_ml} of what was lost or added.
template <typename Part>
std::string parts_text(const std::vector<Part>& parts) {
  std::string text;
  for (const Part& part : parts)
    text += "\n  {kind = " + TomlWriter::quoted(part.kind) + ", voxels = " + std::to_string(part.voxels) +
            ", volume_ml = " + TomlWriter::decimal(part.volume_ml, 4) + "},";
  return "[" + text + (text.empty() ? "]" : "\n]");
}

void write_quality(TomlWriter& out, const MeshQuality& quality) {
  out.table("quality");
  out.add("min_angle_deg", quality.min_angle_deg, 3);
  out.add("p01_angle_deg", quality.p01_angle_deg, 3);
  out.add("share_above_15", quality.share_above_15, 5);
  const auto mm = [](double metres) { return TomlWriter::decimal(metres * 1e3, 3); };
  out.raw("edge_mm", "{min = " + mm(quality.edge_min_m) + ", p05 = " + mm(quality.edge_p05_m) +
                         ", median = " + mm(quality.edge_median_m) + ", p95 = " + mm(quality.edge_p95_m) +
                         ", max = " + mm(quality.edge_max_m) + "}");
}

void write_mesh(TomlWriter& out, const MeshFacts& mesh) {
  out.table("mesh");
  out.add("vertices", mesh.topology.vertices);
  out.add("triangles", mesh.topology.triangles);
  out.add("components", mesh.topology.components);
  out.add("genus", mesh.topology.genus);
  out.add("self_intersections", mesh.self_intersections);
  out.add("volume_ml", mesh.volume_ml, 4);
  if (mesh.label_volume_ml) out.add("label_volume_ml", *mesh.label_volume_ml, 4);
  out.add("kept_volume_ml", mesh.kept_volume_ml, 4);
  out.raw("distance_mm", distance_text(mesh.distance));
  out.raw("distance_back_mm", distance_text(mesh.distance_back));
  out.add("centroid_offset_mm", mesh.centroid_offset_m * 1e3, 4);
  out.add("voxel_mm", mesh.voxel_m * 1e3, 4);
  out.add("border_voxels", mesh.border_voxels);
  out.raw("lost", parts_text(mesh.lost));
  out.raw("added", parts_text(mesh.added));
  out.add("repairs", mesh.repairs);
}

void write_volume_mesh(TomlWriter& out, const char* table, const std::optional<VolumeMeshFile>& mesh) {
  if (!mesh) return;
  out.table(table);
  out.add("file", mesh->file);
  out.add("sha256", mesh->sha256);
  out.add("nodes", mesh->nodes);
  out.add("cells", mesh->cells);
  out.add("size_mm", mesh->size_mm, 4);
  out.add("volume_error_pct", mesh->volume_error_pct, 4);
  out.add("worst", mesh->worst, 4);
}

SurfaceDistance read_distance(TomlTable table) {
  SurfaceDistance distance;
  distance.mean_m = table.number("mean") * 1e-3;
  distance.p99_m = table.number("p99") * 1e-3;
  distance.max_m = table.number("max") * 1e-3;
  if (table.has("rms")) distance.rms_m = table.number("rms") * 1e-3;
  table.finish();
  return distance;
}

MeshQuality read_quality(TomlTable table) {
  MeshQuality quality;
  quality.min_angle_deg = table.number("min_angle_deg");
  quality.p01_angle_deg = table.number("p01_angle_deg");
  quality.share_above_15 = table.number("share_above_15");
  TomlTable edge = table.table("edge_mm");
  quality.edge_min_m = edge.number("min") * 1e-3;
  quality.edge_p05_m = edge.number("p05") * 1e-3;
  quality.edge_median_m = edge.number("median") * 1e-3;
  quality.edge_p95_m = edge.number("p95") * 1e-3;
  quality.edge_max_m = edge.number("max") * 1e-3;
  edge.finish();
  table.finish();
  return quality;
}

template <typename Part>
std::vector<Part> read_parts(TomlTable& table, std::string_view key) {
  std::vector<Part> parts;
  for (TomlTable& part : table.tables(key)) {
    parts.push_back({part.text("kind"), part.count("voxels"), part.number("volume_ml")});
    part.finish();
  }
  return parts;
}

/// The combinatorial zeros (no open edges and so on) are not stored: load_organ proves them on the surface itself.
MeshFacts read_mesh(TomlTable table) {
  MeshFacts mesh;
  mesh.topology.vertices = table.count("vertices");
  mesh.topology.triangles = table.count("triangles");
  mesh.topology.components = table.count("components");
  mesh.topology.genus = table.integer("genus");
  mesh.self_intersections = table.count("self_intersections");
  mesh.volume_ml = table.number("volume_ml");
  if (table.has("label_volume_ml")) mesh.label_volume_ml = table.number("label_volume_ml");
  mesh.kept_volume_ml = table.number("kept_volume_ml");
  mesh.volume_error_pct = (mesh.volume_ml / mesh.label_volume_ml.value_or(mesh.kept_volume_ml) - 1) * 100;
  mesh.kept_error_pct = (mesh.volume_ml / mesh.kept_volume_ml - 1) * 100;
  mesh.distance = read_distance(table.table("distance_mm"));
  mesh.distance_back = read_distance(table.table("distance_back_mm"));
  if (table.has("centroid_offset_mm")) mesh.centroid_offset_m = table.number("centroid_offset_mm") * 1e-3;
  if (table.has("voxel_mm")) mesh.voxel_m = table.number("voxel_mm") * 1e-3;
  mesh.border_voxels = table.count("border_voxels");
  mesh.lost = read_parts<LostPart>(table, "lost");
  if (table.has("added")) mesh.added = read_parts<AddedPart>(table, "added");
  mesh.repairs = table.texts("repairs");
  table.finish();
  return mesh;
}

std::optional<VolumeMeshFile> read_volume_mesh(TomlTable& root, std::string_view key) {
  if (!root.has(key)) return std::nullopt;
  TomlTable table = root.table(key);
  VolumeMeshFile mesh;
  mesh.file = table.text("file");
  if (!is_plain_name(mesh.file)) table.refuse("file", "file must be the name of a file beside the manifest");
  mesh.sha256 = table.text("sha256");
  mesh.nodes = table.count("nodes");
  mesh.cells = table.count("cells");
  mesh.size_mm = table.number("size_mm");
  mesh.volume_error_pct = table.number("volume_error_pct");
  mesh.worst = table.number("worst");
  table.finish();
  return mesh;
}

std::string colour_text(const SegmentColour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour[0], colour[1], colour[2]);
  return text;
}

SegmentColour read_colour(TomlTable& table, const char* key) {
  const std::string text = table.text(key);
  SegmentColour colour{};
  bool fits = text.size() == 7 && text[0] == '#';
  for (std::size_t part = 0; fits && part < 3; ++part) {
    const char *from = text.data() + 1 + 2 * part, *to = from + 2;
    fits = std::from_chars(from, to, colour[part], 16).ptr == to;
  }
  if (!fits) table.refuse(key, std::string(key) + " must be \"#rrggbb\"");
  return colour;
}

std::string codes_text(const std::vector<SegmentCode>& codes) {
  std::string text = "[";
  for (const SegmentCode& code : codes)
    text += "\n  {role = " + TomlWriter::quoted(code.role) + ", scheme = " + TomlWriter::quoted(code.scheme) +
            ", value = " + TomlWriter::quoted(code.value) + ", meaning = " + TomlWriter::quoted(code.meaning) + "},";
  return text + "\n]";
}

std::vector<SegmentCode> read_codes(TomlTable& table, std::string_view key) {
  std::vector<SegmentCode> codes;
  for (TomlTable& code : table.tables(key)) {
    codes.push_back({code.text("role"), code.text("scheme"), code.text("value"), code.text("meaning")});
    code.finish();
  }
  return codes;
}

OrganSource read_source(TomlTable table) {
  OrganSource source;
  source.file = table.text("file");
  source.sha256 = table.text("sha256");
  source.modality = table.text("modality");
  source.unit = table.text("unit");
  if (table.has("label")) source.label = table.integer("label");
  source.label_name = table.text("label_name");
  source.label_table = table.text("label_table");
  if (table.has("label_colour")) source.colour = read_colour(table, "label_colour");
  if (table.has("label_codes")) source.codes = read_codes(table, "label_codes");
  table.finish();
  return source;
}

}  // namespace

std::string manifest_text(const OrganManifest& manifest) {
  TomlWriter out;
  out.add("format", kOrganFormat);
  out.add("program", manifest.program);
  out.add("name", manifest.name);
  out.add("material", manifest.material);
  out.add("synthetic", manifest.synthetic);
  out.add("surface", manifest.surface);
  out.add("surface_sha256", manifest.surface_sha256);
  out.add("frame", "RAS");
  out.add("unit", "m");
  out.add("licence", manifest.licence);
  out.add("credit", manifest.credit);
  out.add("decisions", manifest.decisions);
  out.table("source");
  out.add("file", manifest.source.file);
  out.add("sha256", manifest.source.sha256);
  out.add("modality", manifest.source.modality);
  out.add("unit", manifest.source.unit);
  if (manifest.source.label) out.add("label", *manifest.source.label);
  out.add("label_name", manifest.source.label_name);
  out.add("label_table", manifest.source.label_table);
  if (manifest.source.colour) out.add("label_colour", colour_text(*manifest.source.colour));
  if (!manifest.source.codes.empty()) out.raw("label_codes", codes_text(manifest.source.codes));
  write_mesh(out, manifest.mesh);
  write_quality(out, manifest.mesh.quality);
  write_volume_mesh(out, "lattice", manifest.lattice);
  write_volume_mesh(out, "tetrahedra", manifest.tetrahedra);
  return std::move(out).text();
}

OrganManifest parse_manifest(const std::string& text, const std::string& file) {
  TomlTable table = TomlTable::parse(text, file);
  const int format = table.integer("format");
  if (format < 1 || format > kOrganFormat) table.refuse("format", "format must be 1 or 2");
  table.expect("frame", "RAS");
  table.expect("unit", "m");
  OrganManifest manifest;
  if (format > 1) manifest.program = table.text("program");
  manifest.name = table.text("name");
  manifest.material = table.text("material");
  manifest.synthetic = table.boolean("synthetic");
  manifest.surface = table.text("surface");
  if (!is_plain_name(manifest.surface))
    table.refuse("surface", "surface must be the name of a file beside the manifest");
  manifest.surface_sha256 = table.text("surface_sha256");
  manifest.licence = table.text("licence");
  manifest.credit = table.text("credit");
  if (format > 1) manifest.decisions = table.texts("decisions");
  manifest.source = read_source(table.table("source"));
  manifest.mesh = read_mesh(table.table("mesh"));
  if (format > 1) manifest.mesh.quality = read_quality(table.table("quality"));
  manifest.lattice = read_volume_mesh(table, "lattice");
  manifest.tetrahedra = read_volume_mesh(table, "tetrahedra");
  table.finish();
  return manifest;
}

bool is_plain_name(const std::string& file) { return !file.empty() && std::filesystem::path(file).filename() == file; }

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !in) throw InputError(path.string() + ": no such file");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw InputError(path.string() + ": read error");
  return bytes;
}

std::string read_unchanged(const std::filesystem::path& path, const std::string& sha256, const std::string& named_by) {
  std::string bytes = read_bytes(path);
  if (digest::of_bytes(bytes) != sha256)
    throw InputError(path.string() + ": its sha256 is not the one in " + named_by + ": the file was changed");
  return bytes;
}

std::vector<std::string> files_beside(const OrganManifest& manifest) {
  std::vector<std::string> names{manifest.surface};
  for (const auto& mesh : {manifest.lattice, manifest.tetrahedra})
    if (mesh) names.push_back(mesh->file);
  return names;
}

void prove_surface(const TriangleSurface& surface, MeshFacts& facts) {
  facts.topology = analyse_topology(surface);
  facts.quality = mesh_quality(surface);
  facts.self_intersections = count_self_intersections(surface);
}

std::string enter_surface(const std::filesystem::path& stem, OrganManifest& manifest, TriangleSurface& surface) {
  std::string bytes = ply_bytes(surface);
  surface = parse_ply(bytes, stem.string() + ".ply");
  prove_surface(surface, manifest.mesh);
  manifest.surface = stem.filename().string() + ".ply";
  manifest.surface_sha256 = digest::of_bytes(bytes);
  return bytes;
}

std::filesystem::path write_organ(const std::filesystem::path& stem, OrganManifest& manifest, TriangleSurface surface,
                                  const std::vector<SideFile>& more) {
  return write_entered_organ(stem, manifest, enter_surface(stem, manifest, surface), more);
}

std::filesystem::path write_entered_organ(const std::filesystem::path& stem, const OrganManifest& manifest,
                                          const std::string& surface_bytes, const std::vector<SideFile>& more) {
  std::filesystem::path path = stem.string() + std::string(kOrganSuffix);
  std::vector<std::unique_ptr<StagedFile>> staged;
  staged.push_back(std::make_unique<StagedFile>(stem.string() + ".ply", surface_bytes));
  for (const SideFile& file : more)
    staged.push_back(std::make_unique<StagedFile>(stem.parent_path() / file.name, file.bytes));
  staged.push_back(std::make_unique<StagedFile>(path, manifest_text(manifest)));
  for (const auto& file : staged) file->commit();
  return path;
}

}  // namespace trocar
