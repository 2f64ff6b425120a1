// OFF, in text: OFF, COFF, NOFF, CNOFF, STOFF and their mixtures; whatever follows x y z of a vertex is stepped over
// line by line.
#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/text_scanner.h"

namespace trocar {
namespace {

/// Lines with something on them, comments cut off.
class OffLines {
 public:
  OffLines(std::string_view bytes, const std::string& file) : text_(bytes), file_(file) {}

  std::string_view next(const char* what) {
    while (offset_ < text_.size()) {
      const std::size_t end = std::min(text_.size(), text_.find('\n', offset_));
      std::string_view line = text_.substr(offset_, end - offset_);
      offset_ = end + 1;
      ++number_;
      line = line.substr(0, line.find('#'));
      if (line.find_first_not_of(" \t\r") != std::string_view::npos) return line;
    }
    throw InputError(file_, number_, 1, "the file ends before " + std::string(what));
  }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(file_, number_, 1, what); }

 private:
  std::string_view text_;
  std::string file_;
  std::size_t offset_ = 0;
  int number_ = 0;
};

double number(TextScanner& words, const OffLines& lines, const char* what) {
  const std::string_view word = words.word();
  double value = 0;
  if (!to_number(word, value)) lines.refuse(std::string(what) + " \"" + printable(word) + "\" is no finite number");
  return value;
}

std::int64_t whole(TextScanner& words, const OffLines& lines, const char* what) {
  const std::string_view word = words.word();
  std::int64_t value = 0;
  if (!to_whole(word, value) || value < 0) lines.refuse(std::string(what) + " \"" + printable(word) + "\" is no count");
  return value;
}

void read_face(std::string_view line, const OffLines& lines, TriangleSurface& surface, const std::string& file) {
  TextScanner words(line, file);
  const std::int64_t corners = whole(words, lines, "number of corners");
  if (corners < 3 || corners > static_cast<std::int64_t>(kMaxCorners))
    lines.refuse("a face of " + std::to_string(corners) + " corners");
  std::vector<std::int32_t> polygon;
  for (std::int64_t n = 0; n < corners; ++n) {
    const std::int64_t vertex = whole(words, lines, "vertex");
    if (vertex >= static_cast<std::int64_t>(surface.vertices.size()))
      lines.refuse("a face names vertex " + std::to_string(vertex) + " of " + std::to_string(surface.vertices.size()));
    polygon.push_back(static_cast<std::int32_t>(vertex));
  }
  check_count(surface.triangles.size() + polygon.size() - 2, kMaxTriangles, "triangles", file);
  add_polygon(surface, polygon);
}

}  // namespace

SurfaceFile read_off(std::string_view bytes, const std::string& file) {
  OffLines lines(bytes, file);
  std::string_view line = lines.next("its keyword");
  TextScanner words(line, file);
  const std::string_view key = words.word();
  if (!key.ends_with("OFF")) lines.refuse("\"OFF\" expected");
  if (key.find('4') != std::string_view::npos || key.find('n') != std::string_view::npos)
    lines.refuse("OFF of four or n dimensions is not read");
  if (words.peek() == "BINARY") lines.refuse("binary OFF is not read: write it as text, or as PLY");
  if (words.at_end()) line = lines.next("its counts"), words = TextScanner(line, file);
  const std::int64_t vertices = whole(words, lines, "number of vertices"),
                     faces = whole(words, lines, "number of faces");
  check_count(static_cast<std::uint64_t>(vertices), kMaxVertices, "vertices", file);
  check_count(static_cast<std::uint64_t>(faces), kMaxTriangles, "faces", file);
  SurfaceFile result;
  TriangleSurface& surface = result.parts.emplace_back().surface;
  for (std::int64_t n = 0; n < vertices; ++n) {
    TextScanner values(lines.next("all its vertices"), file);
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = number(values, lines, "coordinate");
    surface.vertices.push_back(point);
  }
  for (std::int64_t n = 0; n < faces; ++n) read_face(lines.next("all its faces"), lines, surface, file);
  return result;
}

}  // namespace trocar
