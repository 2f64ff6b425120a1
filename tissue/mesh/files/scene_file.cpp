#include "tissue/mesh/files/scene_file.h"

#include <assimp/config.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/mesh/files/gltf_check.h"
#include "tissue/organ/ply_check.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;
using Bake = Eigen::Affine3d;

/// Opens the file itself and plain names beside it, for reading; nothing else is there.
class FolderOnly : public Assimp::DefaultIOSystem {
 public:
  explicit FolderOnly(fs::path file) : file_(std::move(file)) {}
  bool Exists(const char* name) const override { return allowed(name) && DefaultIOSystem::Exists(name); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    return allowed(name) && mode[0] == 'r' ? DefaultIOSystem::Open(name, mode) : nullptr;
  }

 private:
  bool allowed(const fs::path& name) const {
    std::error_code error;
    if (name == file_) return true;
    return fs::weakly_canonical(name.parent_path(), error) == fs::weakly_canonical(file_.parent_path(), error) &&
           fs::is_regular_file(fs::symlink_status(name, error)) && fs::file_size(name, error) <= kMaxSurfaceBytes;
  }
  fs::path file_;
};

/// Values and texts one behind the other, as the child hands them over.
class Packer {
 public:
  template <typename Value>
  void put(const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::string& text) {
    put(text.size());
    bytes += text;
  }
  template <typename Item>
  void put_all(const std::vector<Item>& items) {
    put(items.size());
    for (const Item& item : items) put(item);
  }
  std::string bytes;
};

/// Believes no length: the child read a file that may be hostile.
class Unpacker {
 public:
  Unpacker(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}
  template <typename Value>
  void take(Value& value) {
    need(sizeof value);
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
  }
  void take(std::string& text) {
    std::size_t size = 0;
    take(size);
    need(size);
    text = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
  }
  template <typename Item>
  void take_all(std::vector<Item>& items) {
    std::size_t size = 0;
    take(size);
    need(size);  // no item is smaller than a byte
    items.resize(size);
    for (Item& item : items) take(item);
  }
  void need(std::size_t bytes) const {
    if (bytes > bytes_.size()) throw InputError(file_ + ": the reader's answer is damaged");
  }

 private:
  std::string_view bytes_;
  const std::string& file_;
};

std::string packed_scene(const SurfaceFile& result) {
  Packer out;
  out.put(result.parts.size());
  for (const FilePart& part : result.parts) {
    out.put(part.name);
    out.put_all(part.groups);
    out.put(part.surface.vertices.size());
    for (const Vec3& vertex : part.surface.vertices) out.put(std::array{vertex.x(), vertex.y(), vertex.z()});
    out.put_all(part.surface.triangles);
  }
  out.put(result.unit_m.value_or(0));
  for (const std::string* text :
       {&result.unit_source, &result.frame, &result.frame_source, &result.name, &result.material})
    out.put(*text);
  out.put_all(result.remarks);
  return std::move(out.bytes);
}

SurfaceFile unpacked(std::string_view bytes, const std::string& file) {
  Unpacker in(bytes, file);
  SurfaceFile result;
  std::size_t count = 0;
  in.take(count);
  in.need(count);
  result.parts.resize(count);
  for (FilePart& part : result.parts) {
    in.take(part.name);
    in.take_all(part.groups);
    in.take(count);
    for (std::array<double, 3> p{}; count > 0; --count)
      in.take(p), part.surface.vertices.emplace_back(p[0], p[1], p[2]);
    in.take_all(part.surface.triangles);
  }
  double unit = 0;
  in.take(unit);
  if (unit > 0) result.unit_m = unit;
  for (std::string* text : {&result.unit_source, &result.frame, &result.frame_source, &result.name, &result.material})
    in.take(*text);
  in.take_all(result.remarks);
  return result;
}

Bake matrix_of(const aiMatrix4x4& m) {
  Bake result;
  result.matrix() << double{m.a1}, double{m.a2}, double{m.a3}, double{m.a4}, double{m.b1}, double{m.b2}, double{m.b3},
      double{m.b4}, double{m.c1}, double{m.c2}, double{m.c3}, double{m.c4}, 0, 0, 0, 1;
  return result;
}

class SceneReader {
 public:
  SceneReader(const aiScene& scene, const std::string& file) : scene_(scene), file_(file) {}

  SurfaceFile read() {
    add_node(*scene_.mRootNode, Bake::Identity(), {}, 0);
    if (thin_) result_.remarks.push_back("points and lines in the file were left out");
    if (mirrored_)
      result_.remarks.push_back("a node mirrors its mesh: its triangles were turned over to face outwards as before");
    return std::move(result_);
  }

 private:
  void add_node(const aiNode& node, const Bake& above, const std::vector<std::string>& groups, int depth) {
    constexpr int kDeepest = 200;
    if (depth > kDeepest) throw InputError(file_ + ": nodes are nested more than 200 deep");
    const Bake here = above * matrix_of(node.mTransformation);
    const std::string name = printable(node.mName.C_Str());
    for (unsigned n = 0; n < node.mNumMeshes; ++n) add_mesh(*scene_.mMeshes[node.mMeshes[n]], here, name, groups);
    std::vector<std::string> below = groups;
    if (!name.empty()) below.insert(below.begin(), name);
    for (unsigned n = 0; n < node.mNumChildren; ++n) add_node(*node.mChildren[n], here, below, depth + 1);
  }

  void add_mesh(const aiMesh& mesh, const Bake& bake, const std::string& node, const std::vector<std::string>& groups) {
    check_count(result_.parts.size() + 1, kMaxParts, "meshes", file_);
    if (result_.parts.empty() || result_.parts.back().name != node || node.empty())
      result_.parts.push_back({node.empty() ? printable(mesh.mName.C_Str()) : node, groups, {}});
    TriangleSurface& surface = result_.parts.back().surface;  // meshes of one node differ in material only
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    check_count(vertices_ += mesh.mNumVertices, kMaxVertices, "vertices", file_);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const Vec3 point = bake * Vec3(mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z);
      if (!point.allFinite()) throw InputError(file_ + ": holds a vertex that is not finite");
      surface.vertices.push_back(point);
    }
    const bool mirrors = bake.linear().determinant() < 0;
    mirrored_ = mirrored_ || mirrors;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) add_face(mesh, f, first, mirrors, surface);
  }

  void add_face(const aiMesh& mesh, unsigned number, std::int32_t first, bool mirrors, TriangleSurface& surface) {
    const aiFace& face = mesh.mFaces[number];
    corners_.clear();
    for (unsigned n = 0; n < face.mNumIndices; ++n) {
      if (face.mIndices[n] >= mesh.mNumVertices)
        throw InputError(file_ + ": face " + std::to_string(number) + " names vertex " +
                         std::to_string(face.mIndices[n]) + " of " + std::to_string(mesh.mNumVertices));
      corners_.push_back(first + static_cast<std::int32_t>(face.mIndices[n]));
    }
    if (corners_.size() < 3) {
      thin_ = true;
      return;
    }
    if (corners_.size() > kMaxCorners)
      throw InputError(file_ + ": a face of " + std::to_string(corners_.size()) + " corners");
    if (mirrors) std::reverse(corners_.begin(), corners_.end());
    check_count(triangles_ += corners_.size() - 2, kMaxTriangles, "triangles", file_);
    add_polygon(surface, corners_);
  }

  const aiScene& scene_;
  const std::string& file_;
  bool thin_ = false, mirrored_ = false;
  std::size_t vertices_ = 0, triangles_ = 0;
  std::vector<std::int32_t> corners_;
  SurfaceFile result_;
};

template <typename Value>
std::optional<Value> setting(const aiScene& scene, const char* key) {
  double real = 0;
  float single = 0;
  std::int32_t whole = 0;
  std::uint64_t large = 0;
  if (scene.mMetaData == nullptr) return std::nullopt;
  if (scene.mMetaData->Get(key, real)) return static_cast<Value>(real);
  if (scene.mMetaData->Get(key, single)) return static_cast<Value>(single);
  if (scene.mMetaData->Get(key, whole)) return static_cast<Value>(whole);
  if (scene.mMetaData->Get(key, large)) return static_cast<Value>(large);
  return std::nullopt;
}

std::string short_number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// The axes of FBX: up is superior, front is anterior, the third is the left of who looks out of it.
void fbx_frame(const aiScene& scene, SurfaceFile& result) {
  std::string frame = "???";
  const auto name = [&](const char* axis, const char* sign, char positive, char negative) {
    const int number = setting<int>(scene, axis).value_or(-1);
    if (number >= 0 && number < 3)
      frame[static_cast<std::size_t>(number)] = setting<int>(scene, sign).value_or(1) < 0 ? negative : positive;
  };
  name("UpAxis", "UpAxisSign", 'S', 'I');
  name("FrontAxis", "FrontAxisSign", 'A', 'P');
  name("CoordAxis", "CoordAxisSign", 'L', 'R');
  const bool told = frame.find('?') == std::string::npos;
  result.frame = told ? frame : "LSA";
  result.frame_source = told ? "the FBX settings say so for a person who stands upright and looks to the front"
                             : "the FBX settings name no axes: Y up, looking along Z was taken, as FBX has it";
}

void fbx_unit(const aiScene& scene, SurfaceFile& result, const std::string& file) {
  const double centimetres = setting<double>(scene, "UnitScaleFactor").value_or(1);
  if (!(centimetres > 1e-6 && centimetres < 1e6))
    throw InputError(file + ": UnitScaleFactor of the FBX settings is no scale");
  result.unit_m = std::round(centimetres * 1e6) * 1e-8;  // assimp keeps it as a 32-bit float
  result.unit_source = "the FBX settings say UnitScaleFactor " + short_number(centimetres) + " (times a centimetre)";
}

SurfaceFile read_with_assimp(const fs::path& path, SurfaceKind kind) {
  const std::string file = path.string();
  Assimp::Importer importer;
  importer.SetIOHandler(new FolderOnly(path));  // the importer deletes it
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_TEXTURES, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = importer.ReadFile(file, 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InputError(file + ": damaged: " + printable(importer.GetErrorString()));
  SurfaceFile result = SceneReader(*scene, file).read();
  if (kind == SurfaceKind::kFbx) {
    fbx_frame(*scene, result);
    fbx_unit(*scene, result, file);
  }
  if (kind == SurfaceKind::kGlb || kind == SurfaceKind::kGltf) {
    result.unit_m = 1;
    result.unit_source = "glTF is in metres by its standard";
    result.frame = "LSA";
    result.frame_source =
        "glTF has Y up and the front along Z by its standard: X is the left of a person who stands upright";
  }
  return result;
}

}  // namespace

SurfaceFile read_scene(const fs::path& path, SurfaceKind kind, std::string_view bytes, const Progress& progress) {
  const std::string file = path.string();
  const std::string answer = in_child(file, {std::uint64_t{1536} << 20, 120}, progress, [&] {
    std::vector<std::string> remarks;
    if (kind == SurfaceKind::kPly) check_ply(bytes, file);
    if (kind == SurfaceKind::kGlb || kind == SurfaceKind::kGltf) remarks = check_gltf(bytes, path);
    SurfaceFile result = read_with_assimp(path, kind);
    result.remarks.insert(result.remarks.begin(), remarks.begin(), remarks.end());
    if (kind == SurfaceKind::kPly) {
      const std::string_view header = bytes.substr(0, bytes.find("end_header"));
      take_comment(header, "a comment", result, file);
      take_own_words(header, result);
    }
    return packed_scene(result);
  });
  return unpacked(answer, file);
}

}  // namespace trocar
