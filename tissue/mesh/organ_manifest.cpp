#include "tissue/mesh/organ_manifest.h"

#include <fstream>
#include <iterator>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/mesh/ply_file.h"
#include "tissue/mesh/staged_file.h"
#include "tissue/mesh/toml_table.h"

namespace trocar {
namespace {

std::string distance_text(const SurfaceDistance& distance) {
  return "{mean = " + TomlWriter::decimal(distance.mean_m * 1e3, 4) + ", p99 = " + TomlWriter::decimal(distance.p99_m * 1e3, 4) +
         ", max = " + TomlWriter::decimal(distance.max_m * 1e3, 4) + "}";
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
  out.add("border_voxels", mesh.border_voxels);
  std::string lost;
  for (const LostPart& part : mesh.lost)
    lost += "\n  {kind = " + TomlWriter::quoted(part.kind) + ", voxels = " + std::to_string(part.voxels) +
            ", volume_ml = " + TomlWriter::decimal(part.volume_ml, 4) + "},";
  out.raw("lost", "[" + lost + (lost.empty() ? "]" : "\n]"));
  out.add("repairs", mesh.repairs);
}

SurfaceDistance read_distance(TomlTable table) {
  const SurfaceDistance distance{table.number("mean") * 1e-3, table.number("p99") * 1e-3, table.number("max") * 1e-3};
  table.finish();
  return distance;
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
  mesh.border_voxels = table.count("border_voxels");
  for (TomlTable& part : table.tables("lost")) {
    mesh.lost.push_back({part.text("kind"), part.count("voxels"), part.number("volume_ml")});
    part.finish();
  }
  mesh.repairs = table.texts("repairs");
  table.finish();
  return mesh;
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
  table.finish();
  return source;
}

}  // namespace

std::string manifest_text(const OrganManifest& manifest) {
  TomlWriter out;
  out.add("format", kOrganFormat);
  out.add("name", manifest.name);
  out.add("material", manifest.material);
  out.add("synthetic", manifest.synthetic);
  out.add("surface", manifest.surface);
  out.add("surface_sha256", manifest.surface_sha256);
  out.add("frame", "RAS");
  out.add("unit", "m");
  out.add("licence", manifest.licence);
  out.add("credit", manifest.credit);
  out.table("source");
  out.add("file", manifest.source.file);
  out.add("sha256", manifest.source.sha256);
  out.add("modality", manifest.source.modality);
  out.add("unit", manifest.source.unit);
  if (manifest.source.label) out.add("label", *manifest.source.label);
  out.add("label_name", manifest.source.label_name);
  out.add("label_table", manifest.source.label_table);
  write_mesh(out, manifest.mesh);
  return std::move(out).text();
}

OrganManifest parse_manifest(const std::string& text, const std::string& file) {
  TomlTable table = TomlTable::parse(text, file);
  if (table.integer("format") != kOrganFormat) table.refuse("format", "format must be 1");
  table.expect("frame", "RAS");
  table.expect("unit", "m");
  OrganManifest manifest;
  manifest.name = table.text("name");
  manifest.material = table.text("material");
  manifest.synthetic = table.boolean("synthetic");
  manifest.surface = table.text("surface");
  if (manifest.surface.empty() || std::filesystem::path(manifest.surface).filename() != manifest.surface)
    table.refuse("surface", "surface must be the name of a file beside the manifest");
  manifest.surface_sha256 = table.text("surface_sha256");
  manifest.licence = table.text("licence");
  manifest.credit = table.text("credit");
  manifest.source = read_source(table.table("source"));
  manifest.mesh = read_mesh(table.table("mesh"));
  table.finish();
  return manifest;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !in) throw InputError(path.string() + ": no such file");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw InputError(path.string() + ": read error");
  return bytes;
}

std::filesystem::path write_organ(const std::filesystem::path& stem, OrganManifest& manifest,
                                  const TriangleSurface& surface) {
  const std::string bytes = ply_bytes(surface);
  manifest.surface = stem.filename().string() + ".ply";
  manifest.surface_sha256 = digest::of_bytes(bytes);
  std::filesystem::path path = stem.string() + std::string(kOrganSuffix);
  StagedFile ply(stem.string() + ".ply", bytes);
  StagedFile toml(path, manifest_text(manifest));
  ply.commit();
  toml.commit();
  return path;
}

}  // namespace trocar
