#include "tissue/thin/sheet_body.h"

#include <cassert>
#include <cstring>
#include <set>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::int32_t kSheetMark = -43;  // where a cut of an organ has a triangle

std::int32_t take_number(std::string_view& bytes) {
  std::int32_t value = 0;
  if (bytes.size() < sizeof value) throw InputError("a change of a sheet ends too early");
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

}  // namespace

std::string sheet_change_bytes(const SheetChange& change) {
  std::vector<std::int32_t> numbers{kSheetMark, change.sheet};
  for (const SheetEdge& edge : change.edges) numbers.insert(numbers.end(), edge.begin(), edge.end());
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof numbers[0]};
}

bool is_sheet_change(std::string_view bytes) {
  return bytes.size() >= sizeof kSheetMark && take_number(bytes) == kSheetMark;
}

SheetChange parse_sheet_change(std::string_view bytes) {
  if (take_number(bytes) != kSheetMark) throw InputError("a change of the tissue is not a sheet's");
  SheetChange change{take_number(bytes), {}};
  while (!bytes.empty()) {
    const std::int32_t a = take_number(bytes);
    change.edges.push_back({a, take_number(bytes)});
  }
  return change;
}

SheetSurface::SheetSurface(const SheetSetup& setup) : thickness_m_(setup.thickness_m), middle_(setup.drawn_T) {
  grow();
}

void SheetSurface::part(std::span<const std::array<std::int32_t, 3>> triangles, std::span<const std::int32_t> copied) {
  middle_.triangles.assign(triangles.begin(), triangles.end());
  for (const std::int32_t node : copied)
    middle_.vertices.push_back(Vec3(middle_.vertices[static_cast<std::size_t>(node)]));
  grow();
}

void SheetSurface::grow() {
  auto rest = std::make_shared<SurfaceSnapshot>();
  const auto below = static_cast<std::int32_t>(middle_.vertices.size());
  std::set<SheetEdge> directed;
  for (const auto& [a, b, c] : middle_.triangles) {
    rest->triangles.push_back({a, b, c});
    rest->triangles.push_back({a + below, c + below, b + below});
    directed.insert({{a, b}, {b, c}, {c, a}});
  }
  for (const auto& [a, b] : directed) {
    if (directed.contains({b, a})) continue;
    rest->triangles.push_back({a, a + below, b});
    rest->triangles.push_back({b, a + below, b + below});
  }
  rest->vertices = shell(middle_.vertices);
  rest->topology = rest_ ? rest_->topology + 1 : 0;
  rest_ = rest;
}

std::vector<Vec3> SheetSurface::shell(std::span<const Vec3> middle_T) const {
  TriangleSurface now;
  now.vertices.assign(middle_T.begin(), middle_T.end());
  now.triangles = middle_.triangles;
  const std::vector<Vec3> normal = now.vertex_normals();
  std::vector<Vec3> out;
  for (const double side : {0.5, -0.5})
    for (std::size_t v = 0; v < normal.size(); ++v) out.emplace_back(middle_T[v] + side * thickness_m_ * normal[v]);
  return out;
}

SurfacePtr SheetSurface::at(std::span<const Vec3> middle_T) const { return moved_surface(rest_, shell(middle_T)); }

std::vector<SurfacePtr> drawn_sheets(std::span<const SheetSetup> sheets) {
  std::vector<SurfacePtr> out;
  for (const SheetSetup& setup : sheets) out.push_back(SheetSurface(setup).at(setup.drawn_T.vertices));
  return out;
}

SheetPlayback::SheetPlayback(std::span<const SheetSetup> sheets, std::span<const std::string> changes) {
  for (const SheetSetup& setup : sheets)
    sheets_.push_back({setup.drawn_T.triangles, setup.drawn_T.vertices.size(), SheetSurface(setup)});
  for (const std::string& bytes : changes) {
    if (!is_sheet_change(bytes)) continue;
    const SheetChange change = parse_sheet_change(bytes);
    if (change.sheet < 0 || static_cast<std::size_t>(change.sheet) >= sheets_.size())
      throw InputError("a change of a sheet names one that is not there");
    Sheet& sheet = sheets_[static_cast<std::size_t>(change.sheet)];
    const auto copied = part_triangles(sheet.triangles, static_cast<std::int32_t>(sheet.nodes), change.edges);
    sheet.nodes += copied.size();
    sheet.seen.part(sheet.triangles, copied);
  }
}

std::size_t SheetPlayback::nodes() const {
  std::size_t sum = 0;
  for (const Sheet& sheet : sheets_) sum += sheet.nodes;
  return sum;
}

std::vector<SurfacePtr> SheetPlayback::at(std::span<const NodePlace> nodes_T) const {
  assert(nodes_T.size() == nodes());
  std::vector<SurfacePtr> out;
  for (const Sheet& sheet : sheets_) {
    std::vector<Vec3> middle;
    for (const NodePlace& node : nodes_T.first(sheet.nodes)) middle.emplace_back(node.cast<double>());
    nodes_T = nodes_T.subspan(sheet.nodes);
    out.push_back(sheet.seen.at(middle));
  }
  return out;
}

}  // namespace trocar
