#include "tissue/mesh/files/gltf_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"

namespace trocar {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMaxJsonBytes = std::size_t{48} << 20;
constexpr std::uint64_t kGlbHeader = 12, kChunkHeader = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

class GltfChecker {
 public:
  GltfChecker(const fs::path& path) : path_(path), file_(path.string()) {}

  std::vector<std::string> check(std::string_view bytes) {
    const std::string_view text = bytes.starts_with("glTF") ? json_chunk(bytes) : bytes;
    if (text.size() > kMaxJsonBytes) refuse("its JSON is larger than 48 MiB: write it as .glb");
    json_ = Json::parse(text, nullptr, false);
    if (!json_.is_object()) refuse("damaged JSON");
    try {
      check_contents();
    } catch (const Json::exception&) {
      refuse("a value in the JSON is missing or of a false type");
    }
    return remarks_;
  }

 private:
  std::string_view json_chunk(std::string_view bytes) {
    if (bytes.size() < kGlbHeader + kChunkHeader) refuse("too short for a binary glTF");
    if (word_at(bytes, 4) != 2) refuse("glTF version " + std::to_string(word_at(bytes, 4)) + " is not read, only 2");
    const std::uint64_t length = word_at(bytes, 12);
    if (word_at(bytes, 8) > bytes.size() || length > bytes.size() - kGlbHeader - kChunkHeader)
      refuse("the header states more bytes than the file has: it is cut off");
    if (word_at(bytes, 16) != 0x4E4F534A) refuse("the first chunk is not JSON");
    const std::uint64_t next = kGlbHeader + kChunkHeader + length;
    if (bytes.size() >= next + kChunkHeader) {
      binary_bytes_ = word_at(bytes, static_cast<std::size_t>(next));
      if (binary_bytes_ > bytes.size() - next - kChunkHeader) refuse("the binary chunk is cut off");
    }
    return bytes.substr(kGlbHeader + kChunkHeader, static_cast<std::size_t>(length));
  }

  void check_contents() {
    const std::string version = json_.at("asset").at("version").get<std::string>();
    if (!version.starts_with("2.")) refuse("glTF version " + printable(version) + " is not read, only 2.x");
    check_extensions();
    const std::vector<std::uint64_t> buffers = check_buffers();
    const std::vector<std::uint64_t> views = check_views(buffers);
    check_accessors(views);
    check_meshes();
    check_nodes();
    if (list("skins").size() > 0) remarks_.push_back("skins were left out: the surface is as it was modelled");
    if (list("animations").size() > 0) remarks_.push_back("animations were left out");
  }

  const Json& list(const char* key) const {
    static const Json kNone = Json::array();
    const auto found = json_.find(key);
    if (found == json_.end()) return kNone;
    if (!found->is_array()) refuse(std::string(key) + " is no list");
    return *found;
  }

  void check_extensions() const {
    for (const Json& entry : list("extensionsRequired")) {
      const std::string name = entry.get<std::string>();
      const bool harmless = name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
                            name == "EXT_texture_webp" || name == "KHR_lights_punctual";
      if (!harmless)
        refuse("needs the extension " + printable(name) +
               ", which is not read: write it without compression or quantization");
    }
  }

  std::uint64_t number(const Json& object, const char* key, std::uint64_t otherwise) const {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    if (!found->is_number_unsigned()) refuse(std::string(key) + " is no count");
    return found->get<std::uint64_t>();
  }

  std::uint64_t index(const Json& object, const char* key, std::size_t size) const {
    const std::uint64_t value = number(object, key, ~std::uint64_t{0});
    if (value >= size)
      refuse(std::string(key) + " names number " + std::to_string(value) + " of " + std::to_string(size));
    return value;
  }

  /// A buffer in a file of its own must be a plain name beside this file: no folders, no addresses.
  std::uint64_t external_bytes(const std::string& uri) const {
    if (uri.starts_with("data:")) return (uri.size() - std::min(uri.size(), uri.find(',') + 1)) / 4 * 3;
    if (uri.find_first_of("/\\:%") != std::string::npos || uri.starts_with('.'))
      refuse("its buffer \"" + printable(uri) + "\" is not a plain file name beside it: only those are opened");
    const fs::path buffer = path_.parent_path() / uri;
    std::error_code error;
    if (!fs::is_regular_file(fs::symlink_status(buffer, error)))
      refuse("its buffer " + printable(uri) + " is missing beside it");
    const auto size = fs::file_size(buffer, error);
    if (error || size > kMaxSurfaceBytes) refuse("its buffer " + printable(uri) + " is larger than 512 MiB");
    return size;
  }

  std::vector<std::uint64_t> check_buffers() const {
    std::vector<std::uint64_t> lengths;
    for (const Json& buffer : list("buffers")) {
      const std::uint64_t stated = number(buffer, "byteLength", 0);
      const std::uint64_t there =
          buffer.contains("uri") ? external_bytes(buffer["uri"].get<std::string>()) : binary_bytes_;
      if (stated > there)
        refuse("a buffer of " + std::to_string(stated) + " bytes has only " + std::to_string(there) +
               ": it is cut off");
      lengths.push_back(stated);
    }
    return lengths;
  }

  std::vector<std::uint64_t> check_views(const std::vector<std::uint64_t>& buffers) const {
    std::vector<std::uint64_t> lengths;
    for (const Json& view : list("bufferViews")) {
      const std::uint64_t whole = buffers[index(view, "buffer", buffers.size())];
      const std::uint64_t offset = number(view, "byteOffset", 0), length = number(view, "byteLength", 0);
      if (offset > whole || length > whole - offset) refuse("a view reaches beyond its buffer");
      lengths.push_back(length);
    }
    return lengths;
  }

  static std::uint64_t component_bytes(std::uint64_t type) {
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : type == 5125 || type == 5126 ? 4 : 0;
  }
  static std::uint64_t components(const std::string& type) {
    return type == "SCALAR"                   ? 1
           : type == "VEC2"                   ? 2
           : type == "VEC3"                   ? 3
           : type == "VEC4" || type == "MAT2" ? 4
           : type == "MAT3"                   ? 9
           : type == "MAT4"                   ? 16
                                              : 0;
  }

  void check_accessors(const std::vector<std::uint64_t>& views) const {
    for (const Json& accessor : list("accessors")) {
      if (accessor.contains("sparse")) refuse("sparse accessors are not read");
      const std::uint64_t view = index(accessor, "bufferView", views.size());
      const std::uint64_t count = number(accessor, "count", 0), offset = number(accessor, "byteOffset", 0);
      check_count(count, 3 * kMaxTriangles, "values of an accessor", file_);
      const std::uint64_t element =
          component_bytes(number(accessor, "componentType", 0)) * components(accessor.at("type").get<std::string>());
      if (element == 0 || count == 0) refuse("an accessor without a type or values");
      const std::uint64_t stride = number(list("bufferViews")[view], "byteStride", element);
      if (stride < element || stride > 1024 || offset > views[view] ||
          (count - 1) * stride + element > views[view] - offset)
        refuse("an accessor reaches beyond its view");
    }
  }

  void check_meshes() {
    for (const Json& mesh : list("meshes")) {
      std::uint64_t triangles = 0;
      for (const Json& primitive : mesh.at("primitives")) {
        const std::size_t accessors = list("accessors").size();
        const Json& position = list("accessors")[index(primitive.at("attributes"), "POSITION", accessors)];
        if (position.at("type") != "VEC3" || number(position, "componentType", 0) != 5126)
          refuse("positions are not of three floats");
        for (const auto& [name, accessor] : primitive.at("attributes").items())
          if (!accessor.is_number_unsigned() || accessor.get<std::uint64_t>() >= accessors)
            refuse("an attribute names no accessor");
        const Json& corners =
            primitive.contains("indices") ? list("accessors")[index(primitive, "indices", accessors)] : position;
        if (primitive.contains("indices") && corners.at("type") != "SCALAR") refuse("indices are not single numbers");
        triangles += number(corners, "count", 0);
        if (primitive.contains("targets")) targets_ = true;
      }
      corners_of_mesh_.push_back(triangles);
    }
    if (targets_) remarks_.push_back("morph targets were left out");
  }

  /// Each node has one parent at most, so there is no circle that a root reaches; instances are counted before they are
  /// made.
  void check_nodes() const {
    const Json& nodes = list("nodes");
    check_count(nodes.size(), 100'000, "nodes", file_);
    std::vector<bool> has_parent(nodes.size(), false);
    std::uint64_t corners = 0;
    for (const Json& node : nodes) {
      if (node.contains("mesh")) corners += corners_of_mesh_[index(node, "mesh", corners_of_mesh_.size())];
      check_count(corners, 3 * kMaxTriangles, "corners of triangles", file_);
      if (!node.contains("children")) continue;
      for (const Json& child : node["children"]) {
        const auto number = child.get<std::uint64_t>();
        if (!child.is_number_unsigned() || number >= nodes.size() || has_parent[number])
          refuse("the nodes are no tree");
        has_parent[number] = true;
      }
    }
    for (const Json& scene : list("scenes"))
      for (const Json& root : scene.value("nodes", Json::array()))
        if (!root.is_number_unsigned() || root.get<std::uint64_t>() >= nodes.size() ||
            has_parent[root.get<std::uint64_t>()])
          refuse("a scene names a node that is no root");
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_ + ": " + what); }

  const fs::path& path_;
  std::string file_;
  Json json_;
  std::uint64_t binary_bytes_ = 0;
  bool targets_ = false;
  std::vector<std::uint64_t> corners_of_mesh_;
  std::vector<std::string> remarks_;
};

}  // namespace

std::vector<std::string> check_gltf(std::string_view bytes, const std::filesystem::path& path) {
  return GltfChecker(path).check(bytes);
}

}  // namespace trocar
