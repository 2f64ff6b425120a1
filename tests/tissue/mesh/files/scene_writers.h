// Small Gmsh, glTF and FBX files, written byte by byte for tests and independent of the readers.
#pragma once

#include "tests/tissue/mesh/files/file_writers.h"

namespace trocar::test {

/// Numbers of the nodes begin at 11 and go up by two, as after a cut.
inline std::int64_t tag_of(std::int64_t index) { return 11 + 2 * index; }

struct Elements {
  int type = 2;  ///< of Gmsh: 2 triangles, 4 tetrahedra
  std::size_t size = 3;
  std::vector<std::int64_t> corners;
};

inline Elements elements_of(const TriangleSurface& s) { return {2, 3, flat(s)}; }
inline Elements elements_of(const FileTetrahedra& mesh) { return {4, 4, flat(mesh)}; }

inline std::string msh_1(const std::vector<Vec3>& points, const Elements& e) {
  std::string text = "$NOD\n" + std::to_string(points.size()) + "\n";
  for (std::size_t n = 0; n < points.size(); ++n)
    text += std::to_string(tag_of(static_cast<std::int64_t>(n))) + " " + triple(points[n]) + "\n";
  text += "$ENDNOD\n$ELM\n" + std::to_string(e.corners.size() / e.size) + "\n";
  for (std::size_t n = 0; n < e.corners.size(); ++n) {
    if (n % e.size == 0)
      text += std::to_string(n / e.size + 1) + " " + std::to_string(e.type) + " 7 1 " + std::to_string(e.size);
    text += " " + std::to_string(tag_of(e.corners[n])) + ((n + 1) % e.size == 0 ? "\n" : "");
  }
  return text + "$ENDELM\n";
}

inline std::string msh_2(const std::vector<Vec3>& points, const Elements& e, bool binary, bool big_endian = false) {
  std::string text = "$MeshFormat\n2.2 " + std::string(binary ? "1" : "0") + " 8\n";
  const auto whole = [&](std::int64_t value) {
    if (binary)
      put(text, static_cast<std::int32_t>(value), big_endian);
    else
      text += std::to_string(value) + " ";
  };
  if (binary) whole(1), text += "\n";
  text += "$EndMeshFormat\n$PhysicalNames\n1\n" + std::string(e.type == 4 ? "3" : "2") +
          " 7 \"left lobe\"\n$EndPhysicalNames\n$Nodes\n" + std::to_string(points.size()) + "\n";
  for (std::size_t n = 0; n < points.size(); ++n) {
    whole(tag_of(static_cast<std::int64_t>(n)));
    if (!binary)
      text += triple(points[n]) + "\n";
    else
      for (int axis = 0; axis < 3; ++axis) put(text, points[n][axis], big_endian);
  }
  const std::size_t count = e.corners.size() / e.size;
  text += (binary ? "\n" : "") + std::string("$EndNodes\n$Elements\n") + std::to_string(count) + "\n";
  if (binary) whole(e.type), whole(static_cast<std::int64_t>(count)), whole(2);
  for (std::size_t n = 0; n < e.corners.size(); ++n) {
    if (n % e.size == 0) {
      whole(static_cast<std::int64_t>(n / e.size + 1));
      if (!binary) whole(e.type), whole(2);
      whole(7), whole(1);
    }
    whole(tag_of(e.corners[n]));
    if (!binary && (n + 1) % e.size == 0) text += "\n";
  }
  return text + (binary ? "\n" : "") + "$EndElements\n";
}

inline std::string msh_4(const std::vector<Vec3>& points, const Elements& e, bool binary) {
  std::string text = "$MeshFormat\n4.1 " + std::string(binary ? "1" : "0") + " 8\n";
  const auto size = [&](std::int64_t value) { binary ? put(text, value) : void(text += std::to_string(value) + " "); };
  const auto whole = [&](int value) { binary ? put(text, value) : void(text += std::to_string(value) + " "); };
  if (binary) whole(1), text += "\n";
  const auto nodes = static_cast<std::int64_t>(points.size()),
             count = static_cast<std::int64_t>(e.corners.size() / e.size);
  const int dimension = e.type == 4 ? 3 : 2;
  text += "$EndMeshFormat\n$Entities\nanything $ but its end\n$EndEntities\n$Nodes\n";
  for (const std::int64_t value : {std::int64_t{1}, nodes, std::int64_t{11}, tag_of(nodes - 1)}) size(value);
  for (const int value : {dimension, 7, 0}) whole(value);
  size(nodes);
  for (std::int64_t n = 0; n < nodes; ++n) size(tag_of(n));
  for (const Vec3& p : points) {
    if (!binary)
      text += "\n" + triple(p);
    else
      for (int axis = 0; axis < 3; ++axis) put(text, p[axis]);
  }
  text += "\n$EndNodes\n$Elements\n";
  for (const std::int64_t value : {std::int64_t{1}, count, std::int64_t{1}, count}) size(value);
  for (const int value : {dimension, 7, e.type}) whole(value);
  size(count);
  for (std::size_t n = 0; n < e.corners.size(); ++n) {
    if (n % e.size == 0) size(static_cast<std::int64_t>(n / e.size + 1));
    size(tag_of(e.corners[n]));
  }
  return text + "\n$EndElements\n";
}

/// A glTF document of nodes that each hold a mesh of their own.
struct GltfNode {
  std::string name;
  TriangleSurface mesh;
  std::string extra;  ///< more of the node's JSON: ",\"scale\":[-1,1,1]"
};

struct Gltf {
  std::string json, binary;
};

/// @param buffer more of the buffer's JSON: ",\"uri\":\"x.bin\""
inline Gltf gltf_of(const std::vector<GltfNode>& nodes, const std::string& buffer = "",
                    const std::string& document = "") {
  Gltf file;
  std::string node_list, meshes, accessors, views, roots;
  const auto comma = [](std::string& list) { list += list.empty() ? "" : ","; };
  const auto view = [&](const std::string& bytes) {
    comma(views);
    views += "{\"buffer\":0,\"byteOffset\":" + std::to_string(file.binary.size()) +
             ",\"byteLength\":" + std::to_string(bytes.size()) + "}";
    file.binary += bytes;
  };
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    std::string points, corners;
    for (const Vec3& p : nodes[n].mesh.vertices)
      for (int axis = 0; axis < 3; ++axis) put(points, static_cast<float>(p[axis]));
    for (const std::int64_t index : flat(nodes[n].mesh)) put(corners, static_cast<std::uint32_t>(index));
    view(points), view(corners);
    const std::string first = std::to_string(2 * n), second = std::to_string(2 * n + 1);
    comma(accessors), comma(meshes), comma(node_list), comma(roots);
    accessors += "{\"bufferView\":" + first +
                 ",\"componentType\":5126,\"count\":" + std::to_string(nodes[n].mesh.vertices.size()) +
                 ",\"type\":\"VEC3\",\"min\":[-1,-1,-1],\"max\":[1,1,1]},{\"bufferView\":" + second +
                 ",\"componentType\":5125,\"count\":" + std::to_string(3 * nodes[n].mesh.triangles.size()) +
                 ",\"type\":\"SCALAR\"}";
    meshes += "{\"primitives\":[{\"attributes\":{\"POSITION\":" + first + "},\"indices\":" + second + "}]}";
    node_list += "{\"name\":\"" + nodes[n].name + "\",\"mesh\":" + std::to_string(n) + nodes[n].extra + "}";
    roots += std::to_string(n);
  }
  file.json = "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[" + roots + "]}],\"nodes\":[" +
              node_list + "],\"meshes\":[" + meshes + "],\"accessors\":[" + accessors + "],\"bufferViews\":[" + views +
              "],\"buffers\":[{\"byteLength\":" + std::to_string(file.binary.size()) + buffer + "}]" + document + "}";
  return file;
}

inline std::string glb(const Gltf& file) {
  std::string json = file.json, binary = file.binary;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  put(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + "BIN" + std::string(1, '\0') + binary;
}

/// FBX in text. @param settings lines of Properties70 of the global settings
inline std::string fbx(const TriangleSurface& s, const std::string& settings) {
  std::string points, corners;
  for (const Vec3& p : s.vertices)
    for (int axis = 0; axis < 3; ++axis) points += (points.empty() ? "" : ",") + number(p[axis]);
  for (const auto& [a, b, c] : s.triangles)
    corners +=
        (corners.empty() ? "" : ",") + std::to_string(a) + "," + std::to_string(b) + "," + std::to_string(-c - 1);
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: "
         "7400\n}\nGlobalSettings:  {\n"
         "\tVersion: 1000\n\tProperties70:  {\n" +
         settings +
         "\t}\n}\nDefinitions:  {\n\tVersion: 100\n\tCount: 2\n}\nObjects:  {\n"
         "\tGeometry: 1001, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *" +
         std::to_string(3 * s.vertices.size()) + " {\n\t\t\ta: " + points + "\n\t\t}\n\t\tPolygonVertexIndex: *" +
         std::to_string(3 * s.triangles.size()) + " {\n\t\t\ta: " + corners +
         "\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n\tModel: 1002, \"Model::organ\", \"Mesh\" {\n\t\tVersion: "
         "232\n\t\tProperties70:  {\n\t\t}\n\t}\n}\n"
         "Connections:  {\n\tC: \"OO\",1001,1002\n\tC: \"OO\",1002,0\n}\n";
}

inline std::string fbx_settings(double unit_scale, const std::string& axes = "") {
  return axes + "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + number(unit_scale) + "\n";
}

}  // namespace trocar::test
