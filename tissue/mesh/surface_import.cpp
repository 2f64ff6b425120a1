#include "tissue/mesh/surface_import.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <sstream>
#include <stdexcept>

#include "haptics/input_error.h"
#include "tissue/mesh/organ_manifest.h"
#include "tissue/mesh/ply_check.h"
#include "tissue/mesh/surface_check.h"
#include "tissue/mesh/topology.h"

namespace trocar {
namespace {

constexpr std::array<std::pair<const char*, double>, 3> kUnits{{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}}};
constexpr std::uintmax_t kMaxBytes = 512u << 20;
constexpr double kLeastVolumeM3 = 1e-9;  // 1 mm^3: a flat or collinear shape encloses nothing
constexpr double kWeldTolerance = 1e-6;  // of the bounding box's diagonal: float32 keeps 1e-7

void check_file(const std::filesystem::path& path) {
  const std::string file = path.string();
  if (!std::filesystem::is_regular_file(path)) throw InputError(file + ": no such file");
  if (path.extension() != ".ply") throw InputError(file + ": extension: surfaces are read from .ply");
  if (std::filesystem::file_size(path) > kMaxBytes) throw InputError(file + ": larger than 512 MiB");
  const std::string bytes = read_bytes(path);
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r\n"))
    throw InputError(file + ": signature: does not start with \"ply\"");
  check_ply(bytes, file);
}

/// Polygons become fans. assimp 5.2.5 hands indices on unseen, so its own triangulation must not touch them first.
void add_mesh(const aiMesh& mesh, TriangleSurface& surface, const std::string& file) {
  const auto first = static_cast<std::int32_t>(surface.vertices.size());
  for (unsigned v = 0; v < mesh.mNumVertices; ++v)
    surface.vertices.emplace_back(mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    for (unsigned corner = 0; corner < face.mNumIndices; ++corner)
      if (face.mIndices[corner] >= mesh.mNumVertices)
        throw InputError(file + ": face " + std::to_string(f) + " names vertex " +
                         std::to_string(face.mIndices[corner]) + " of " + std::to_string(mesh.mNumVertices));
    const auto vertex = [&](unsigned corner) { return first + static_cast<std::int32_t>(face.mIndices[corner]); };
    for (unsigned corner = 2; corner < face.mNumIndices; ++corner)
      surface.triangles.push_back({vertex(0), vertex(corner - 1), vertex(corner)});
  }
}

TriangleSurface read_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) throw InputError(path.string() + ": damaged PLY: " + importer.GetErrorString());
  TriangleSurface surface;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) add_mesh(*scene->mMeshes[m], surface, path.string());
  if (surface.triangles.empty()) throw InputError(path.string() + ": holds no triangles");
  for (const Vec3& vertex : surface.vertices)
    if (!vertex.allFinite()) throw InputError(path.string() + ": holds a vertex that is not finite");
  return surface;
}

bool plausible(double diagonal_m) { return diagonal_m >= kSmallestOrganM && diagonal_m <= kLargestOrganM; }

/// "bounding box 221.9 x 214.3 x 190.3; an organ of 5..600 mm would have it in mm"
std::string size_hint(const TriangleSurface& surface) {
  const Vec3 extent = surface.bounds().sizes();
  std::ostringstream out;
  out << "bounding box " << extent.x() << " x " << extent.y() << " x " << extent.z() << "; ";
  std::string candidates;
  for (const auto& [name, factor] : kUnits)
    if (plausible(extent.norm() * factor)) candidates += (candidates.empty() ? "" : " or ") + std::string(name);
  out << "an organ measures 5 to 600 mm across, so "
      << (candidates.empty() ? "no unit among mm, cm, m fits" : "it would be in " + candidates);
  return out.str();
}

void check_closed(const TriangleSurface& surface, const std::string& file) {
  const SurfaceTopology facts = analyse_topology(surface);
  if (facts.boundary_edges > 0)
    throw InputError(file + ": the surface is open: " + std::to_string(facts.boundary_edges) +
                     " boundary edges (holes are not filled)");
  if (facts.nonmanifold_edges > 0)
    throw InputError(file + ": not a manifold: " + std::to_string(facts.nonmanifold_edges) +
                     " edges of more than two triangles");
  if (facts.nonmanifold_vertices > 0)
    throw InputError(file + ": not a manifold: " + std::to_string(facts.nonmanifold_vertices) +
                     " vertices where parts touch");
}

void keep_largest(ImportedSurface& result) {
  const std::size_t before = result.surface.triangles.size();
  result.surface = largest_component(result.surface, &result.lost_volumes_m3);
  if (result.lost_volumes_m3.empty()) return;
  result.repairs.push_back("kept the largest of " + std::to_string(result.lost_volumes_m3.size() + 1) +
                           " components (" + std::to_string(result.surface.triangles.size()) + " of " +
                           std::to_string(before) + " triangles)");
}

void orient(ImportedSurface& result, const std::string& file) {
  try {
    const std::size_t turned = orient_outward(result.surface);
    if (turned > 0) result.repairs.push_back("turned " + std::to_string(turned) + " triangles outwards");
  } catch (const std::invalid_argument&) {
    throw InputError(file + ": the surface has no inside and outside");
  }
}

}  // namespace

double metres_per(const std::string& unit) {
  for (const auto& [name, factor] : kUnits)
    if (unit == name) return factor;
  throw InputError("--unit " + unit + ": mm, cm or m is wanted");
}

ImportedSurface import_surface(const std::filesystem::path& path, const std::string& unit) {
  const std::string file = path.string();
  check_file(path);
  ImportedSurface result;
  result.surface = read_with_assimp(path);
  if (unit.empty())
    throw InputError(file + ": PLY carries no unit, say --unit mm, cm or m: " + size_hint(result.surface));
  const double factor = metres_per(unit);
  if (!plausible(result.surface.bounds().diagonal().norm() * factor))
    throw InputError(file + ": --unit " + unit + " is not plausible: " + size_hint(result.surface));
  for (Vec3& vertex : result.surface.vertices) vertex *= factor;
  const std::size_t before = result.surface.vertices.size();
  result.surface = welded(result.surface, kWeldTolerance * result.surface.bounds().diagonal().norm());
  if (result.surface.vertices.size() < before)
    result.repairs.push_back("welded " + std::to_string(before) + " vertices to " +
                             std::to_string(result.surface.vertices.size()));
  check_closed(result.surface, file);
  keep_largest(result);
  orient(result, file);
  if (result.surface.volume_m3() < kLeastVolumeM3)
    throw InputError(file + ": the surface encloses no volume (less than 1 mm^3): it is flat or collinear");
  result.source_self_intersections = count_self_intersections(result.surface);
  if (result.source_self_intersections > 0)
    result.repairs.push_back("the source cut itself in " + std::to_string(result.source_self_intersections) +
                             " pairs of triangles");
  return result;
}

}  // namespace trocar
