#include "tissue/mesh/files/read_surface_file.h"

#include "haptics/input_error.h"
#include "tissue/mesh/files/file_kind.h"
#include "tissue/mesh/files/scene_file.h"
#include "tissue/mesh/files/tetrahedra.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar {
namespace {

SurfaceFile read_kind(const std::filesystem::path& path, std::string_view bytes, const Progress& progress) {
  const std::string file = path.string();
  const SurfaceKind kind = surface_kind(path, bytes);
  switch (kind) {
    case SurfaceKind::kStl:
      return read_stl(bytes, file);
    case SurfaceKind::kObj:
      return read_obj(bytes, file);
    case SurfaceKind::kOff:
      return read_off(bytes, file);
    case SurfaceKind::kVtk:
      return read_vtk_legacy(bytes, file);
    case SurfaceKind::kVtp:
    case SurfaceKind::kVtu:
      return read_vtk_xml(bytes, file);
    case SurfaceKind::kMsh:
      return read_gmsh(bytes, file);
    case SurfaceKind::kPly:
    case SurfaceKind::kGlb:
    case SurfaceKind::kGltf:
    case SurfaceKind::kFbx:
      break;
  }
  return read_scene(path, kind, bytes, progress);
}

/// Numbers that text can hold but nobody measures, and that would overflow later.
void check_places(const std::vector<Vec3>& vertices, const std::string& file) {
  constexpr double kFarthest = 1e9;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!vertices[v].allFinite() || vertices[v].cwiseAbs().maxCoeff() > kFarthest)  // a maximum may step over a NaN
      throw InputError(file + ": vertex " + std::to_string(v) + " is not finite or absurdly far away");
}

}  // namespace

SurfaceFile read_surface_file(const std::filesystem::path& path, const Progress& progress) {
  const std::string file = path.string();
  if (!std::filesystem::is_regular_file(path)) throw InputError(file + ": no such file");
  if (std::filesystem::file_size(path) > kMaxSurfaceBytes) throw InputError(file + ": larger than 512 MiB");
  report(progress, "reading", 0);
  SurfaceFile result = read_kind(path, read_bytes(path), progress);
  std::erase_if(result.parts, [](const FilePart& part) { return part.surface.triangles.empty(); });
  FileTetrahedra& mesh = result.tetrahedra;
  if (result.parts.empty() && mesh.tetrahedra.empty()) throw InputError(file + ": holds no triangles");
  for (const FilePart& part : result.parts) check_places(part.surface.vertices, file);
  if (mesh.tetrahedra.empty()) return result;
  check_places(mesh.vertices, file);
  const std::size_t turned = make_positive(mesh);
  if (turned > 0)
    result.remarks.push_back("turned " + std::to_string(turned) + " of " + std::to_string(mesh.tetrahedra.size()) +
                             " tetrahedra that were stored inside out");
  return result;
}

}  // namespace trocar
