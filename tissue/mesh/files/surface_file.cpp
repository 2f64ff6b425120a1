#include "tissue/mesh/files/surface_file.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <utility>

#include "haptics/input_error.h"
#include "haptics/utf8.h"

namespace trocar {
namespace {

using Corners = std::vector<std::int32_t>;

const Vec3& corner_at(const TriangleSurface& surface, std::int32_t vertex) {
  return surface.vertices[static_cast<std::size_t>(vertex)];
}

/// Newell's normal of the whole outline, twice its area.
Vec3 outline_normal(const TriangleSurface& surface, const Corners& corners) {
  Vec3 normal = Vec3::Zero();
  const Vec3& origin = corner_at(surface, corners[0]);
  for (std::size_t n = 1; n + 1 < corners.size(); ++n)
    normal += (corner_at(surface, corners[n]) - origin).cross(corner_at(surface, corners[n + 1]) - origin);
  return normal;
}

bool inside(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const auto left = [&](const Vec3& from, const Vec3& to) { return (to - from).cross(p - from).dot(normal) >= 0; };
  return left(a, b) && left(b, c) && left(c, a);
}

bool is_ear(const TriangleSurface& surface, const Corners& corners, std::size_t tip, const Vec3& normal) {
  const std::size_t count = corners.size();
  const std::size_t before = (tip + count - 1) % count, after = (tip + 1) % count;
  const Vec3 &a = corner_at(surface, corners[before]), &b = corner_at(surface, corners[tip]),
             &c = corner_at(surface, corners[after]);
  if ((b - a).cross(c - a).dot(normal) <= 0) return false;
  for (std::size_t n = 0; n < count; ++n)
    if (n != before && n != tip && n != after && inside(corner_at(surface, corners[n]), a, b, c, normal)) return false;
  return true;
}

/// Whether a four-sided outline is narrower between its second and fourth corner.
bool shorter_across(const TriangleSurface& surface, const Corners& c) {
  return (corner_at(surface, c[3]) - corner_at(surface, c[1])).squaredNorm() <
         (corner_at(surface, c[2]) - corner_at(surface, c[0])).squaredNorm() * (1 - 1e-9);
}

}  // namespace

void add_polygon(TriangleSurface& surface, const Corners& corners) {
  Corners left = corners;
  const Vec3 normal = outline_normal(surface, left);
  while (left.size() > 3) {
    const std::size_t count = left.size();
    std::size_t tip = 1;  // a convex polygon becomes the fan round its first corner
    if (count == 4 && shorter_across(surface, left)) tip = 2;
    for (std::size_t tried = 0; tried < count && !is_ear(surface, left, tip, normal); ++tried) tip = (tip + 1) % count;
    surface.triangles.push_back({left[(tip + count - 1) % count], left[tip], left[(tip + 1) % count]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(tip));
  }
  surface.triangles.push_back({left[0], left[1], left[2]});
}

void take_vertices(TriangleSurface& surface, const std::vector<Vec3>& all, std::vector<std::int32_t>& scratch) {
  std::vector<std::size_t> used;
  for (auto& triangle : surface.triangles)
    for (std::int32_t& vertex : triangle) {
      const auto source = static_cast<std::size_t>(vertex);
      if (scratch[source] < 0) {
        scratch[source] = static_cast<std::int32_t>(surface.vertices.size());
        surface.vertices.push_back(all[source]);
        used.push_back(source);
      }
      vertex = scratch[source];
    }
  for (const std::size_t source : used) scratch[source] = -1;
}

std::string printable(std::string_view name) {
  std::string text;
  for (const char letter : name.substr(0, kMaxNameBytes)) text += letter >= 32 && letter < 127 ? letter : '?';
  return text;
}

/// What a comment says behind SPACE=: RAS and LPS with blanks round the sign and in any spelling of case; other words
/// only where they are written as 3D Slicer would, for a comment may be about another space.
std::vector<std::string> slicer_spaces(std::string_view comment) {
  static const std::regex says(R"((^|[^A-Za-z])(SPACE\s{0,4}=\s{0,4})([A-Za-z]{1,16}))", std::regex::icase);
  std::vector<std::string> spaces;
  const std::string text(comment);
  for (std::sregex_iterator found(text.begin(), text.end(), says); found != std::sregex_iterator(); ++found) {
    std::string space = (*found)[3].str();
    const bool exact =
        (*found)[2] == "SPACE=" && std::none_of(space.begin(), space.end(), [](char c) { return c > 'Z'; });
    for (char& letter : space) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (exact || space == "RAS" || space == "LPS") spaces.push_back(space);
  }
  return spaces;
}

void take_comment(std::string_view comment, const char* where, SurfaceFile& result, const std::string& file) {
  for (const std::string& space : slicer_spaces(comment)) {
    if (!result.frame.empty() && result.frame != space)
      throw InputError(file + ": says SPACE=" + result.frame + " and SPACE=" + printable(space) +
                       ": which of them holds, only the program that wrote it knows");
    take_space(space, result, file);
    result.frame_source = std::string(where) + " says SPACE=" + space + ", as 3D Slicer writes it";
  }
  constexpr std::string_view kUnit = "UNIT=";
  const std::size_t at = comment.find(kUnit);
  if (at == std::string_view::npos) return;
  const std::string_view rest = comment.substr(at + kUnit.size());
  const std::string_view word = rest.substr(0, rest.find_first_of(std::string_view(" \t\r\n\0", 5)));
  for (const auto& [unit, metres] :
       {std::pair{"mm", 1e-3}, std::pair{"cm", 1e-2}, std::pair{"m", 1.0}, std::pair{"um", 1e-6}}) {
    if (word != unit) continue;
    result.unit_m = metres;
    result.unit_source = std::string(where) + " says UNIT=" + unit;
  }
}

void take_own_words(std::string_view header, SurfaceFile& result) {
  std::istringstream lines{std::string(header)};
  for (std::string line; std::getline(lines, line);)
    for (const auto& [begins, word] : {std::pair(kOwnName, &result.name), std::pair(kOwnMaterial, &result.material)}) {
      if (!line.starts_with(begins)) continue;
      std::string said = line.substr(std::string_view(begins).size());
      if (said.size() <= kMaxNameBytes && is_utf8(said) && harmless(said) == said) *word = std::move(said);
    }
}

void take_space(const std::string& letters, SurfaceFile& result, const std::string& file) {
  if (letters != "RAS" && letters != "LPS")
    throw InputError(file + ": its SPACE is \"" + printable(letters) +
                     "\", where 3D Slicer writes RAS or LPS: export it again from a program that knows its axes");
  result.frame = letters;
  result.frame_source = "the field SPACE says " + letters + ", as 3D Slicer writes it";
}

void check_count(std::uint64_t count, std::uint64_t most, const char* what, const std::string& file) {
  if (count > most)
    throw InputError(file + ": " + std::to_string(count) + " " + what + " are more than the " + std::to_string(most) +
                     " that an import may have: reduce the surface in the program that wrote it");
}

}  // namespace trocar
