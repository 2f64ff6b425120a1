#include "app/commands/organ_report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double digits) {
  const double scale = std::pow(10.0, digits);
  const double result = std::round(value * scale) / scale;
  return result == 0 ? 0 : result;  // no "-0.0"
}

Json distance_json(const SurfaceDistance& distance) {
  return {{"mean", rounded(distance.mean_m * 1e3, 4)},
          {"p99", rounded(distance.p99_m * 1e3, 4)},
          {"max", rounded(distance.max_m * 1e3, 4)}};
}

Json corner_json(const Vec3& corner) {
  return {rounded(corner.x(), 6), rounded(corner.y(), 6), rounded(corner.z(), 6)};
}

Json source_json(const OrganSource& source) {
  Json json{{"file", source.file}, {"sha256", source.sha256}};
  json["label"] = source.label ? Json(*source.label) : Json(nullptr);
  json["label_name"] = source.label_name;
  json["label_table"] = source.label_table;
  json["modality"] = source.modality;
  return json;
}

void add_mesh(Json& json, const MeshFacts& mesh) {
  json["vertices"] = mesh.topology.vertices;
  json["triangles"] = mesh.topology.triangles;
  json["closed"] = mesh.topology.closed();
  json["manifold"] = mesh.topology.manifold();
  json["self_intersections"] = mesh.self_intersections;
  json["degenerate_triangles"] = mesh.topology.degenerate_triangles;
  json["components"] = mesh.topology.components;
  json["genus"] = mesh.topology.genus;
  json["volume_ml"] = rounded(mesh.volume_ml, 4);
  json["label_volume_ml"] = mesh.label_volume_ml ? Json(rounded(*mesh.label_volume_ml, 4)) : Json(nullptr);
  json["volume_error_pct"] = rounded(mesh.volume_error_pct, 4);
  json["kept_volume_ml"] = rounded(mesh.kept_volume_ml, 4);
  json["kept_error_pct"] = rounded(mesh.kept_error_pct, 4);
  json["distance_mm"] = distance_json(mesh.distance);
  json["distance_back_mm"] = distance_json(mesh.distance_back);
}

Json lost_json(const std::vector<LostPart>& lost) {
  Json list = Json::array();
  for (const LostPart& part : lost)
    list.push_back({{"kind", part.kind}, {"voxels", part.voxels}, {"volume_ml", rounded(part.volume_ml, 4)}});
  return list;
}

}  // namespace

std::string organ_json(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds) {
  const MeshFacts& mesh = manifest.mesh;
  Json json{{"name", manifest.name},
            {"surface", manifest.surface},
            {"surface_sha256", manifest.surface_sha256},
            {"material", manifest.material}};
  add_mesh(json, mesh);
  json["bbox_m"] = {corner_json(bounds.min()), corner_json(bounds.max())};
  json["cut_at_border"] = mesh.cut_at_border();
  json["border_voxels"] = mesh.border_voxels;
  json["lost"] = lost_json(mesh.lost);
  json["repairs"] = mesh.repairs;
  json["unit"] = "m";
  json["source_unit"] = manifest.source.unit;
  json["frame"] = "RAS";
  json["source"] = source_json(manifest.source);
  json["licence"] = manifest.licence;
  json["credit"] = manifest.credit;
  json["synthetic"] = manifest.synthetic;
  return json.dump(2) + "\n";
}

std::string organ_text(const OrganManifest& manifest, const Eigen::AlignedBox3d& bounds) {
  const MeshFacts& mesh = manifest.mesh;
  const Vec3 extent = bounds.sizes() * 1e3;
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(2);
  out << manifest.name << (manifest.synthetic ? " (synthetic)" : "") << ", material " << manifest.material << "\n"
      << "  surface    " << manifest.surface << ", " << mesh.topology.vertices << " vertices, "
      << mesh.topology.triangles << " triangles, " << (mesh.topology.closed() ? "closed" : "OPEN") << ", "
      << (mesh.topology.manifold() ? "manifold" : "NOT MANIFOLD") << ", genus " << mesh.topology.genus << ", "
      << mesh.self_intersections << " self-intersections\n"
      << "  volume     " << mesh.volume_ml << " mL";
  if (mesh.label_volume_ml) out << ", label " << *mesh.label_volume_ml << " mL (" << mesh.volume_error_pct << " %)";
  out << "\n  size       " << extent.x() << " x " << extent.y() << " x " << extent.z() << " mm\n"
      << "  distance   mean " << mesh.distance.mean_m * 1e3 << ", p99 " << mesh.distance.p99_m * 1e3 << ", max "
      << mesh.distance.max_m * 1e3 << " mm from the original surface\n"
      << "  source     " << manifest.source.file << " (" << manifest.source.modality << ", " << manifest.source.unit
      << "), sha256 " << manifest.source.sha256.substr(0, 16) << "\n"
      << "  licence    " << manifest.licence << (manifest.credit.empty() ? "" : "; ") << manifest.credit << "\n";
  if (mesh.cut_at_border())
    out << "  CUT        the image ends inside the organ (" << mesh.border_voxels
        << " voxels): the flat cap is not anatomy\n";
  for (const LostPart& part : mesh.lost)
    out << "  lost       " << part.kind << " of " << part.volume_ml << " mL (" << part.voxels << " voxels)\n";
  for (const std::string& repair : mesh.repairs) out << "  repair     " << repair << "\n";
  return out.str();
}

}  // namespace trocar
