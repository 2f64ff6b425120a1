// STL: text or binary. Binary is known by its length, not by its header: many binary headers begin with "solid".
#include <algorithm>
#include <cmath>
#include <cstring>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/mesh/files/text_scanner.h"

namespace trocar {
namespace {

constexpr std::size_t kHeaderBytes = 84;  // 80 of text, then the number of triangles
constexpr std::size_t kTriangleBytes = 50;

void add_facet(TriangleSurface& surface, const std::array<Vec3, 3>& corners) {
  const auto first = static_cast<std::int32_t>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
  surface.triangles.push_back({first, first + 1, first + 2});
}

std::uint32_t stored_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof count, sizeof count);
  return count;
}

std::array<Vec3, 3> binary_corners(const char* at, std::size_t index, const std::string& file) {
  std::array<float, 9> values{};
  std::memcpy(values.data(), at + 12, sizeof values);
  std::array<Vec3, 3> corners;
  for (std::size_t n = 0; n < 3; ++n) {
    corners[n] = Vec3(values[3 * n], values[3 * n + 1], values[3 * n + 2]);
    if (!corners[n].allFinite())
      throw InputError(file + ": triangle " + std::to_string(index) + " has a corner that is not finite");
  }
  return corners;
}

SurfaceFile read_binary(std::string_view bytes, const std::string& file) {
  const std::size_t count = stored_count(bytes);
  const std::size_t wanted = kHeaderBytes + kTriangleBytes * count;
  if (bytes.size() < wanted)
    throw InputError(file + ": damaged: the header counts " + std::to_string(count) + " triangles (" +
                     std::to_string(wanted) + " bytes), the file has " + std::to_string(bytes.size()) +
                     " bytes: it is cut off, or no STL");
  check_count(count, kMaxTriangles, "triangles", file);
  SurfaceFile result;
  take_comment(bytes.substr(0, 80), "the header", result, file);
  if (bytes.size() > wanted)
    result.remarks.push_back(std::to_string(bytes.size() - wanted) + " bytes behind the last triangle were left out");
  FilePart part;
  part.surface.vertices.reserve(3 * count);
  part.surface.triangles.reserve(count);
  for (std::size_t n = 0; n < count; ++n)
    add_facet(part.surface, binary_corners(bytes.data() + kHeaderBytes + n * kTriangleBytes, n, file));
  result.parts.push_back(std::move(part));
  return result;
}

/// One "facet ... endfacet", the word "facet" taken.
std::array<Vec3, 3> text_corners(TextScanner& text) {
  const auto expect = [&](const char* word) {
    const std::string_view found = text.word();
    if (found != word) text.refuse("\"" + std::string(word) + "\" expected, not \"" + printable(found) + "\"");
  };
  expect("normal");
  for (int axis = 0; axis < 3; ++axis)
    if (text.word().empty()) text.refuse("the file ends in a normal");  // "nan" is common here and harms nobody
  expect("outer");
  expect("loop");
  std::array<Vec3, 3> corners;
  for (Vec3& corner : corners) {
    expect("vertex");
    for (int axis = 0; axis < 3; ++axis) corner[axis] = text.number("coordinate");
  }
  expect("endloop");
  expect("endfacet");
  return corners;
}

SurfaceFile read_text(std::string_view bytes, const std::string& file) {
  SurfaceFile result;
  TextScanner text(bytes, file);
  std::size_t triangles = 0;
  while (!text.at_end()) {
    if (text.word() != "solid") text.refuse("\"solid\" expected");
    const std::string_view name = text.line();
    if (result.parts.empty()) take_comment(name, "the header", result, file);
    check_count(result.parts.size() + 1, kMaxParts, "solids", file);
    FilePart part;
    part.name =
        slicer_spaces(name).empty() ? printable(name.substr(std::min(name.size(), name.find_first_not_of(" \t")))) : "";
    while (text.peek() == "facet") {
      text.word();
      add_facet(part.surface, text_corners(text));
      check_count(++triangles, kMaxTriangles, "triangles", file);
    }
    if (text.word() != "endsolid") text.refuse("\"facet\" or \"endsolid\" expected: the file is cut off or damaged");
    text.line();
    result.parts.push_back(std::move(part));
  }
  return result;
}

}  // namespace

SurfaceFile read_stl(std::string_view bytes, const std::string& file) {
  const bool exact =
      bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + kTriangleBytes * std::size_t{stored_count(bytes)};
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  const bool solid = first != std::string_view::npos && bytes.substr(first).starts_with("solid");
  if (!exact && solid && bytes.substr(0, 4096).find('\0') == std::string_view::npos) return read_text(bytes, file);
  if (bytes.size() < kHeaderBytes)
    throw InputError(file + ": damaged: " + std::to_string(bytes.size()) + " bytes are too few for an STL");
  return read_binary(bytes, file);
}

}  // namespace trocar
