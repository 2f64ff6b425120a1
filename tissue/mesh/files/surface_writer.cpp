#include "tissue/mesh/files/surface_writer.h"

#include <array>
#include <bit>
#include <cstdint>
#include <sstream>

#include <assimp/scene.h>

#include <assimp/Exporter.hpp>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/vtk_xml_text.h"

namespace trocar {
namespace {

constexpr const char* kSays = "SPACE=RAS UNIT=mm";
constexpr float kMillimetres = 1000;

std::array<float, 3> corner(const Vec3& vertex) {
  return {static_cast<float>(vertex.x()) * kMillimetres, static_cast<float>(vertex.y()) * kMillimetres,
          static_cast<float>(vertex.z()) * kMillimetres};
}

/// As the bytes lie in memory: little-endian, as PLY here and STL want them.
template <typename Value>
void put(std::string& bytes, const Value& value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string ply_bytes(const std::vector<SurfacePartOut>& parts) {
  const TriangleSurface& surface = *parts.front().surface;
  std::string bytes = std::string("ply\nformat binary_little_endian 1.0\ncomment ") + kSays + "\n" + kOwnName +
                      parts.front().name + "\n" + kOwnMaterial + parts.front().material + "\ncomment " +
                      parts.front().comment + "\nelement vertex " + std::to_string(surface.vertices.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(surface.triangles.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& vertex : surface.vertices) put(bytes, corner(vertex));
  for (const auto& triangle : surface.triangles) {
    bytes += static_cast<char>(3);
    put(bytes, triangle);
  }
  return bytes;
}

std::string stl_bytes(const std::vector<SurfacePartOut>& parts) {
  const TriangleSurface& surface = *parts.front().surface;
  std::string bytes = std::string("Trocar ") + kSays;
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](std::int32_t vertex) { return surface.vertices[static_cast<std::size_t>(vertex)]; };
    const Vec3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    put(bytes, std::array<float, 3>{static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                                    static_cast<float>(normal.z())});
    for (const std::int32_t vertex : {a, b, c}) put(bytes, corner(at(vertex)));
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::ostringstream text_stream() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  return text;
}

std::string obj_bytes(const std::vector<SurfacePartOut>& parts) {
  std::ostringstream text = text_stream();
  text << "# " << kSays << '\n';
  std::size_t first = 1;
  for (const SurfacePartOut& part : parts) {
    text << "# " << part.comment << "\no " << part.name << '\n';
    for (const Vec3& vertex : part.surface->vertices) {
      const auto [x, y, z] = corner(vertex);
      text << "v " << x << ' ' << y << ' ' << z << '\n';
    }
    for (const auto& triangle : part.surface->triangles) {
      text << 'f';
      for (const std::int32_t vertex : triangle) text << ' ' << first + static_cast<std::size_t>(vertex);
      text << '\n';
    }
    first += part.surface->vertices.size();
  }
  return text.str();
}

/// Legacy VTK, text: its title is one line of at most 256 characters.
std::string vtk_bytes(const std::vector<SurfacePartOut>& parts) {
  const TriangleSurface& surface = *parts.front().surface;
  std::ostringstream text = text_stream();
  text << "# vtk DataFile Version 3.0\n"
       << kSays << ' ' << parts.front().comment.substr(0, 200) << "\nASCII\nDATASET POLYDATA\nPOINTS "
       << surface.vertices.size() << " float\n";
  for (const Vec3& vertex : surface.vertices) {
    const auto [x, y, z] = corner(vertex);
    text << x << ' ' << y << ' ' << z << '\n';
  }
  text << "POLYGONS " << surface.triangles.size() << ' ' << 4 * surface.triangles.size() << '\n';
  for (const auto& [a, b, c] : surface.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
  return text.str();
}

std::string vtp_bytes(const std::vector<SurfacePartOut>& parts) {
  const TriangleSurface& surface = *parts.front().surface;
  const auto [corners, ends] = vtk_xml_cells(surface.triangles);
  return vtk_xml_text({.type = "PolyData",
                       .counts = "NumberOfPolys=\"" + std::to_string(surface.triangles.size()) + "\"",
                       .credit = parts.front().comment,
                       .points_m = &surface.vertices,
                       .arrays = "<Polys>\n" + vtk_xml_array("Int32", "connectivity", corners) +
                                 vtk_xml_array("Int32", "offsets", ends) + "</Polys>\n"});
}

/// A mesh in metres with X to the left, Y up, Z to the front.
aiMesh* gltf_mesh(const SurfacePartOut& part) {
  auto* mesh = new aiMesh;
  mesh->mName = part.name;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(part.surface->vertices.size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
    const Vec3& ras = part.surface->vertices[i];
    mesh->mVertices[i] = {static_cast<float>(-ras.x()), static_cast<float>(ras.z()), static_cast<float>(ras.y())};
  }
  mesh->mNumFaces = static_cast<unsigned>(part.surface->triangles.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    aiFace& face = mesh->mFaces[i];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (std::size_t n = 0; n < 3; ++n) face.mIndices[n] = static_cast<unsigned>(part.surface->triangles[i][n]);
  }
  return mesh;
}

/// The scene owns all that is put into it.
std::string glb_bytes(const std::vector<SurfacePartOut>& parts) {
  aiScene scene;
  const auto count = static_cast<unsigned>(parts.size());
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene.mNumMeshes = count;
  scene.mMeshes = new aiMesh*[count];
  scene.mRootNode = new aiNode("Trocar");
  scene.mRootNode->mNumChildren = count;
  scene.mRootNode->mChildren = new aiNode*[count];
  for (unsigned i = 0; i < count; ++i) {
    scene.mMeshes[i] = gltf_mesh(parts[i]);
    auto* node = new aiNode(parts[i].name);
    node->mParent = scene.mRootNode;
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{i};
    scene.mRootNode->mChildren[i] = node;
  }
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, "glb2");
  if (!blob) throw EnvironmentError(std::string("glTF: assimp cannot write it: ") + exporter.GetErrorString());
  return {static_cast<const char*>(blob->data), blob->size};
}

}  // namespace

const std::map<std::string, SurfaceFormat>& written_formats() {
  static const std::map<std::string, SurfaceFormat> kFormats{{"ply", {ply_bytes, false}}, {"stl", {stl_bytes, false}},
                                                             {"obj", {obj_bytes, true}},  {"vtk", {vtk_bytes, false}},
                                                             {"vtp", {vtp_bytes, false}}, {"glb", {glb_bytes, true}}};
  return kFormats;
}

}  // namespace trocar
