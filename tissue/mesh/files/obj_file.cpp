// Wavefront OBJ: vertices and polygons; parts by "o" and "g". Materials, normals and textures are never opened.
#include <algorithm>
#include <map>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/text_scanner.h"

namespace trocar {
namespace {

std::string_view taken_word(std::string_view& line) {
  const std::size_t first = std::min(line.size(), line.find_first_not_of(" \t"));
  const std::size_t end = std::min(line.size(), line.find_first_of(" \t", first));
  const std::string_view word = line.substr(first, end - first);
  line.remove_prefix(end);
  return word;
}

std::string_view trimmed_line(std::string_view line) {
  const std::size_t first = std::min(line.size(), line.find_first_not_of(" \t"));
  const std::size_t end = line.find_last_not_of(" \t");
  return end == std::string_view::npos ? std::string_view() : line.substr(first, end + 1 - first);
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& file) : text_(bytes), file_(file) {}

  SurfaceFile read() {
    text_ = text_.substr(
        0, text_.find_last_not_of(std::string_view(" \t\r\n\0", 5)) + 1);  // some programs end a text with a zero
    while (offset_ < text_.size()) statement(next_line());
    if (curves_) result_.remarks.push_back("curves and free-form surfaces in the file were left out");
    if (lines_) result_.remarks.push_back("lines and points in the file were left out");
    std::vector<std::int32_t> scratch(vertices_.size(), -1);
    for (FilePart& part : result_.parts) take_vertices(part.surface, vertices_, scratch);
    return std::move(result_);
  }

 private:
  /// Joined over a backslash at the end.
  std::string next_line() {
    std::string whole;
    for (bool more = true; more && offset_ < text_.size();) {
      const std::size_t end = std::min(text_.size(), text_.find('\n', offset_));
      std::string_view piece = text_.substr(offset_, end - offset_);
      offset_ = end + 1;
      ++line_;
      if (piece.ends_with('\r')) piece.remove_suffix(1);
      more = piece.ends_with('\\');
      if (more) piece.remove_suffix(1);
      whole += piece;
      if (whole.size() > 65536) refuse("a line of more than 64 KiB");
    }
    return whole;
  }

  void statement(std::string_view line) {
    if (line.find('\0') != std::string_view::npos) refuse("holds binary data");
    const std::string_view key = taken_word(line);
    if (key == "v") return vertex(line);
    if (key == "f" || key == "fo") return face(line);
    if (key == "o" || key == "g") return group(trimmed_line(line));
    if (key.starts_with('#') && line.find('=') != std::string_view::npos)
      return take_comment(line, "a comment", result_, file_);
    curves_ = curves_ || key == "curv" || key == "curv2" || key == "surf";
    lines_ = lines_ || key == "l" || key == "p";
  }

  void vertex(std::string_view line) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = taken_word(line);
      if (!to_number(word, point[axis])) refuse("coordinate \"" + printable(word) + "\" is no finite number");
    }
    check_count(vertices_.size() + 1, kMaxVertices, "vertices", file_);
    vertices_.push_back(point);
  }

  std::int32_t corner(std::string_view word) const {
    std::int64_t index = 0;
    const auto count = static_cast<std::int64_t>(vertices_.size());
    if (!to_whole(word.substr(0, word.find('/')), index)) refuse("corner \"" + printable(word) + "\" names no vertex");
    if (index < 0) index += count + 1;
    if (index < 1 || index > count)
      refuse("a face names vertex " + printable(word) + " of the " + std::to_string(count) + " so far");
    return static_cast<std::int32_t>(index - 1);
  }

  void face(std::string_view line) {
    corners_.clear();
    for (std::string_view word = taken_word(line); !word.empty() && !word.starts_with('#'); word = taken_word(line))
      corners_.push_back(corner(word));
    if (corners_.size() < 3) refuse("a face of fewer than three corners");
    if (corners_.size() > kMaxCorners) refuse("a face of " + std::to_string(corners_.size()) + " corners");
    check_count(triangles_ += corners_.size() - 2, kMaxTriangles, "triangles", file_);
    if (result_.parts.empty()) group({});
    polygon(result_.parts[current_].surface);
  }

  /// The polygon in numbers of the file; vertices follow at the end.
  void polygon(TriangleSurface& surface) {
    if (corners_.size() == 3) {
      surface.triangles.push_back({corners_[0], corners_[1], corners_[2]});
      return;
    }
    TriangleSurface alone;
    std::vector<std::int32_t> order;
    for (const std::int32_t vertex : corners_) {
      order.push_back(static_cast<std::int32_t>(alone.vertices.size()));
      alone.vertices.push_back(vertices_[static_cast<std::size_t>(vertex)]);
    }
    add_polygon(alone, order);
    const auto in_file = [&](std::int32_t local) { return corners_[static_cast<std::size_t>(local)]; };
    for (const auto& [a, b, c] : alone.triangles) surface.triangles.push_back({in_file(a), in_file(b), in_file(c)});
  }

  void group(std::string_view name) {
    const std::string label = printable(name);
    const auto [entry, fresh] = number_of_.try_emplace(label, result_.parts.size());
    current_ = entry->second;
    if (!fresh) return;
    check_count(result_.parts.size() + 1, kMaxParts, "groups", file_);
    result_.parts.push_back({label, {}, {}});
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_, line_, 1, what); }

  std::string_view text_;
  std::string file_;
  std::size_t offset_ = 0, current_ = 0, triangles_ = 0;
  int line_ = 0;
  bool curves_ = false, lines_ = false;
  std::vector<Vec3> vertices_;
  std::vector<std::int32_t> corners_;
  std::map<std::string, std::size_t> number_of_;
  SurfaceFile result_;
};

}  // namespace

SurfaceFile read_obj(std::string_view bytes, const std::string& file) { return ObjReader(bytes, file).read(); }

}  // namespace trocar
