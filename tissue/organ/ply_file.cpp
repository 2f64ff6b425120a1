#include "tissue/organ/ply_file.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are copied as little-endian");

constexpr std::size_t kVertexBytes = 3 * sizeof(float);
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::int32_t);
constexpr std::size_t kMaxElements = 20'000'000;

template <typename T>
void append_bytes(std::string& bytes, T value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

template <typename T>
T element_at(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// Takes the header line by line; comments are passed over.
class HeaderLines {
 public:
  HeaderLines(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  void expect(std::string_view wanted) {
    const std::string_view line = next();
    if (line != wanted) refuse("\"" + std::string(wanted) + "\" expected");
  }

  std::size_t count_after(std::string_view prefix) {
    const std::string_view line = next();
    std::size_t count = 0;
    const char* end = line.data() + line.size();
    if (!line.starts_with(prefix)) refuse("\"" + std::string(prefix) + "N\" expected");
    const auto [stop, error] = std::from_chars(line.data() + prefix.size(), end, count);
    if (error != std::errc() || stop != end || count > kMaxElements) refuse("the count is no number up to 20 million");
    return count;
  }

  std::size_t offset() const { return offset_; }

 private:
  std::string_view next() {
    for (;;) {
      const std::size_t end = bytes_.find('\n', offset_);
      ++number_;
      if (end == std::string_view::npos || end - offset_ > 200) refuse("the PLY header does not end");
      const std::string_view line = bytes_.substr(offset_, end - offset_);
      offset_ = end + 1;
      if (!line.starts_with("comment ")) return line;
    }
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_, number_, 1, what); }

  std::string_view bytes_;
  std::string file_;
  std::size_t offset_ = 0;
  int number_ = 0;
};

Vec3 read_ply_vertex(std::string_view bytes, std::size_t offset, std::size_t index, const std::string& file) {
  Vec3 vertex;
  for (std::size_t axis = 0; axis < 3; ++axis)
    vertex[static_cast<Eigen::Index>(axis)] = element_at<float>(bytes, offset + axis * sizeof(float));
  if (!vertex.allFinite()) throw InputError(file + ": vertex " + std::to_string(index) + " is not finite");
  return vertex;
}

std::array<std::int32_t, 3> read_ply_face(std::string_view bytes, std::size_t offset, std::size_t index,
                                          std::size_t vertices, const std::string& file) {
  if (bytes[offset] != 3) throw InputError(file + ": face " + std::to_string(index) + " is no triangle");
  std::array<std::int32_t, 3> face{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    face[corner] = element_at<std::int32_t>(bytes, offset + 1 + corner * sizeof(std::int32_t));
    if (face[corner] < 0 || static_cast<std::size_t>(face[corner]) >= vertices)
      throw InputError(file + ": face " + std::to_string(index) + " names vertex " + std::to_string(face[corner]) +
                       " of " + std::to_string(vertices));
  }
  return face;
}

}  // namespace

std::string ply_bytes(const TriangleSurface& surface) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment organ surface, metres, RAS patient axes\nelement vertex " +
      std::to_string(surface.vertices.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(surface.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& vertex : surface.vertices)
    for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, static_cast<float>(vertex[axis]));
  for (const auto& triangle : surface.triangles) {
    bytes += '\3';
    for (const std::int32_t index : triangle) append_bytes(bytes, index);
  }
  return bytes;
}

TriangleSurface parse_ply(std::string_view bytes, const std::string& file) {
  HeaderLines lines(bytes, file);
  lines.expect("ply");
  lines.expect("format binary_little_endian 1.0");
  const std::size_t vertices = lines.count_after("element vertex ");
  for (const char* axis : {"x", "y", "z"}) lines.expect(std::string("property float ") + axis);
  const std::size_t faces = lines.count_after("element face ");
  lines.expect("property list uchar int vertex_indices");
  lines.expect("end_header");
  const std::size_t wanted = lines.offset() + vertices * kVertexBytes + faces * kFaceBytes;
  if (bytes.size() != wanted)
    throw InputError(file + ": " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(wanted) +
                     (bytes.size() < wanted ? ": the file is cut off" : ": something follows the last face"));
  TriangleSurface surface;
  surface.vertices.reserve(vertices);
  surface.triangles.reserve(faces);
  std::size_t offset = lines.offset();
  for (std::size_t v = 0; v < vertices; ++v, offset += kVertexBytes)
    surface.vertices.push_back(read_ply_vertex(bytes, offset, v, file));
  for (std::size_t f = 0; f < faces; ++f, offset += kFaceBytes)
    surface.triangles.push_back(read_ply_face(bytes, offset, f, vertices, file));
  return surface;
}

}  // namespace trocar
