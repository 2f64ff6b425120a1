#include "tissue/mesh/organ_manifest.h"

#include <toml++/toml.h>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/mesh/ply_file.h"
#include "tissue/mesh/staged_file.h"

namespace trocar {
namespace {

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::value<std::string>(text);
  return out.str();
}

std::string decimal(double value, int digits) {
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(digits);
  out << value;
  return out.str();
}

/// Writes "key = value" lines.
class TomlWriter {
 public:
  void table(const std::string& name) { text_ += "\n[" + name + "]\n"; }
  void add(const std::string& key, const std::string& value) { raw(key, quoted(value)); }
  void add(const std::string& key, bool value) { raw(key, value ? "true" : "false"); }
  void add(const std::string& key, std::size_t value) { raw(key, std::to_string(value)); }
  void add(const std::string& key, int value) { raw(key, std::to_string(value)); }
  void add(const std::string& key, double value, int digits) { raw(key, decimal(value, digits)); }
  void raw(const std::string& key, const std::string& value) { text_ += key + " = " + value + "\n"; }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

std::string distance_text(const SurfaceDistance& distance) {
  return "{mean = " + decimal(distance.mean_m * 1e3, 4) + ", p99 = " + decimal(distance.p99_m * 1e3, 4) +
         ", max = " + decimal(distance.max_m * 1e3, 4) + "}";
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
  std::string lost, repairs;
  for (const LostPart& part : mesh.lost)
    lost += "\n  {kind = " + quoted(part.kind) + ", voxels = " + std::to_string(part.voxels) +
            ", volume_ml = " + decimal(part.volume_ml, 4) + "},";
  for (const std::string& repair : mesh.repairs) repairs += "\n  " + quoted(repair) + ",";
  out.raw("lost", "[" + lost + (lost.empty() ? "]" : "\n]"));
  out.raw("repairs", "[" + repairs + (repairs.empty() ? "]" : "\n]"));
}

/// Reads one table key by key; what is left over at the end is unknown and refused.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  std::string text(std::string_view key) { return *value<std::string>(key, "text"); }
  bool boolean(std::string_view key) { return *value<bool>(key, "true or false"); }

  std::size_t count(std::string_view key) {
    const auto number = *value<std::int64_t>(key, "a whole number");
    if (number < 0) refuse(*table_.get(key), std::string(key) + " is negative");
    return static_cast<std::size_t>(number);
  }

  int integer(std::string_view key) {
    const std::size_t number = count(key);
    if (number > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      refuse(*table_.get(key), std::string(key) + " is too large");
    return static_cast<int>(number);
  }

  double number(std::string_view key) {
    const double real = *value<double>(key, "a number");
    if (!std::isfinite(real)) refuse(*table_.get(key), std::string(key) + " is not finite");
    return real;
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  TableReader table(std::string_view key) {
    const toml::node& node = required(key);
    if (!node.is_table()) refuse(node, std::string(key) + " must be a table");
    return {*node.as_table(), file_};
  }

  const toml::array& array(std::string_view key) {
    const toml::node& node = required(key);
    if (!node.is_array()) refuse(node, std::string(key) + " must be an array");
    return *node.as_array();
  }

  void finish() const {
    for (const auto& [key, node] : table_)
      if (!known_.contains(std::string(key.str())))
        refuse(key.source(), "unknown key \"" + std::string(key.str()) + "\"");
  }

  [[noreturn]] void refuse(const toml::node& node, const std::string& what) const { refuse(node.source(), what); }

 private:
  [[noreturn]] void refuse(const toml::source_region& place, const std::string& what) const {
    throw InputError(file_, static_cast<int>(place.begin.line), static_cast<int>(place.begin.column), what);
  }

  const toml::node& required(std::string_view key) {
    known_.emplace(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) refuse(table_, "key \"" + std::string(key) + "\" is missing");
    return *node;
  }

  template <typename T>
  std::optional<T> value(std::string_view key, const std::string& kind) {
    const toml::node& node = required(key);
    const auto found = node.value<T>();
    if (!found || (!std::is_same_v<T, double> && !node.value_exact<T>()))
      refuse(node, std::string(key) + " must be " + kind);
    return found;
  }

  const toml::table& table_;
  std::string file_;
  std::set<std::string> known_;
};

SurfaceDistance read_distance(TableReader table) {
  const SurfaceDistance distance{table.number("mean") * 1e-3, table.number("p99") * 1e-3, table.number("max") * 1e-3};
  table.finish();
  return distance;
}

void read_lists(TableReader& table, const std::string& file, MeshFacts& mesh) {
  for (const toml::node& node : table.array("lost")) {
    if (!node.is_table()) table.refuse(node, "lost holds tables");
    TableReader part(*node.as_table(), file);
    mesh.lost.push_back({part.text("kind"), part.count("voxels"), part.number("volume_ml")});
    part.finish();
  }
  for (const toml::node& node : table.array("repairs")) {
    if (!node.is_string()) table.refuse(node, "repairs holds texts");
    mesh.repairs.push_back(**node.as_string());
  }
}

/// The combinatorial zeros (no open edges and so on) are not stored: load_organ proves them on the surface itself.
MeshFacts read_mesh(TableReader table, const std::string& file) {
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
  read_lists(table, file, mesh);
  table.finish();
  return mesh;
}

OrganSource read_source(TableReader table) {
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

void expect(TableReader& table, const toml::table& root, std::string_view key, std::string_view wanted) {
  if (table.text(key) != wanted)
    table.refuse(*root.get(key), std::string(key) + " must be \"" + std::string(wanted) + "\"");
}

OrganManifest read_root(const toml::table& root, const std::string& file) {
  TableReader table(root, file);
  if (table.integer("format") != kOrganFormat) table.refuse(*root.get("format"), "format must be 1");
  expect(table, root, "frame", "RAS");
  expect(table, root, "unit", "m");
  OrganManifest manifest;
  manifest.name = table.text("name");
  manifest.material = table.text("material");
  manifest.synthetic = table.boolean("synthetic");
  manifest.surface = table.text("surface");
  if (manifest.surface.empty() || std::filesystem::path(manifest.surface).filename() != manifest.surface)
    table.refuse(*root.get("surface"), "surface must be the name of a file beside the manifest");
  manifest.surface_sha256 = table.text("surface_sha256");
  manifest.licence = table.text("licence");
  manifest.credit = table.text("credit");
  manifest.source = read_source(table.table("source"));
  manifest.mesh = read_mesh(table.table("mesh"), file);
  table.finish();
  return manifest;
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
  out.add("frame", std::string("RAS"));
  out.add("unit", std::string("m"));
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
  try {
    return read_root(toml::parse(text, file), file);
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    throw InputError(file, static_cast<int>(place.line), static_cast<int>(place.column),
                     std::string(error.description()));
  }
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
