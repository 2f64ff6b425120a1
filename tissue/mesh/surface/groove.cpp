#include "tissue/mesh/surface/groove.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "haptics/input_error.h"

namespace trocar {
namespace {

using WallTriangle = std::array<std::int32_t, 3>;  // corners of a triangle

constexpr double kLeastTurn = 0.2;  // cosine up to which a lip that gapes may turn a triangle beside it
constexpr int kNarrowings = 4;      // halvings of the gape before it is given up

[[noreturn]] void does_not_fit(std::size_t crossing, const std::string& why) {
  throw InputError("crossing " + std::to_string(crossing) + " of a cut " + why);
}

/// The vertices that a crossing becomes.
struct Lips {
  std::int32_t left = 0, right = 0, bottom = 0;
};

class GrooveCutter {
 public:
  GrooveCutter(const TriangleSurface& surface, const SurfaceCut& cut) : cut_(cut) {
    check(surface);
    out_.surface = surface;
  }

  Groove cut() {
    begin_ = add_inside(cut_.begin);
    for (const CutCrossing& crossing : cut_.crossings) add_lips(crossing);
    end_ = add_inside(cut_.end);
    open_end(cut_.begin.triangle, begin_, 0);
    for (std::size_t i = 0; i + 1 < cut_.crossings.size(); ++i) divide(cut_.crossings[i].triangle, i);
    open_end(cut_.end.triangle, end_, cut_.crossings.size() - 1);
    set_walls();
    for (std::size_t i = 0; i < lips_.size(); ++i) gape(i);
    out_.bottom.push_back(begin_);
    for (const Lips& lips : lips_) out_.bottom.push_back(lips.bottom);
    out_.bottom.push_back(end_);
    return std::move(out_);
  }

 private:
  void check(const TriangleSurface& surface) const {
    if (cut_.crossings.empty()) throw InputError("a cut crosses no edge");
    const auto triangles = static_cast<std::int32_t>(surface.triangles.size());
    std::set<std::int32_t> seen;
    for (std::size_t i = 0; i <= cut_.crossings.size(); ++i) {
      const std::int32_t triangle = i == 0 ? cut_.begin.triangle : cut_.crossings[i - 1].triangle;
      if (triangle < 0 || triangle >= triangles) does_not_fit(i, "goes into a triangle that there is not");
      if (!seen.insert(triangle).second) does_not_fit(i, "goes into a triangle twice");
      if (i == cut_.crossings.size()) break;
      const CutCrossing& crossing = cut_.crossings[i];
      // The line leaves a triangle over an edge that runs from its right to its left.
      if (!has_edge(surface.triangles[static_cast<std::size_t>(triangle)], crossing.right, crossing.left))
        does_not_fit(i, "leaves a triangle over an edge that it has not");
      if (crossing.triangle < 0 || crossing.triangle >= triangles ||
          !has_edge(surface.triangles[static_cast<std::size_t>(crossing.triangle)], crossing.left, crossing.right))
        does_not_fit(i, "goes into a triangle that does not lie there");
      if (!(crossing.share > 0 && crossing.share < 1)) does_not_fit(i, "does not lie on its edge");
      if (!crossing.depth_m.allFinite() || !std::isfinite(crossing.gape_m)) does_not_fit(i, "has no depth");
    }
    if (cut_.end.triangle != cut_.crossings.back().triangle)
      does_not_fit(cut_.crossings.size() - 1, "does not go into the last triangle");
  }

  static bool has_edge(const WallTriangle& triangle, std::int32_t from, std::int32_t to) {
    for (std::size_t k = 0; k < 3; ++k)
      if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
    return false;
  }

  std::int32_t add(const VertexOrigin& origin, const Vec3& place, CutSide side) {
    out_.added.push_back(origin);
    out_.side.push_back(side);
    out_.surface.vertices.push_back(place);
    return static_cast<std::int32_t>(out_.surface.vertices.size()) - 1;
  }
  const Vec3& at(std::int32_t vertex) const { return out_.surface.vertices[static_cast<std::size_t>(vertex)]; }

  /// A vertex inside a triangle: by two steps, along an edge and from there towards the third corner.
  std::int32_t add_inside(const MaterialPoint& point) {
    const auto& [a, b, c] = out_.surface.triangles[static_cast<std::size_t>(point.triangle)];
    const double ab = point.weight[0] + point.weight[1];
    const double along = ab > 0 ? point.weight[1] / ab : 0.5;
    const Vec3 place = interpolate(point.weight, {at(a), at(b), at(c)});
    // One vertex only: its values are those on the nearest edge's point; the third corner's share is left out.
    return add({a, b, along}, place, CutSide::kBoth);
  }

  void add_lips(const CutCrossing& crossing) {
    const Vec3 place = at(crossing.left) + crossing.share * (at(crossing.right) - at(crossing.left));
    const VertexOrigin origin{crossing.left, crossing.right, crossing.share};
    Lips lips;
    lips.left = add(origin, place, CutSide::kLeft);
    lips.right = add(origin, place, CutSide::kRight);
    lips.bottom = add(origin, place + crossing.depth_m, CutSide::kBoth);
    lips_.push_back(lips);
  }

  /// The first of the pieces takes the triangle's number.
  void replace(std::int32_t triangle, const std::vector<WallTriangle>& pieces) {
    out_.surface.triangles[static_cast<std::size_t>(triangle)] = pieces.front();
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      out_.surface.triangles.push_back(pieces[i]);
    }
  }

  /// A triangle in which the line begins or ends: a fan round that point, open towards the lips.
  void open_end(std::int32_t triangle, std::int32_t middle, std::size_t crossing) {
    const CutCrossing& over = cut_.crossings[crossing];
    const Lips& lips = lips_[crossing];
    const WallTriangle corners = out_.surface.triangles[static_cast<std::size_t>(triangle)];
    std::vector<WallTriangle> pieces;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = corners[k], to = corners[(k + 1) % 3];
      const bool crossed = (from == over.left && to == over.right) || (from == over.right && to == over.left);
      if (!crossed) {
        pieces.push_back({middle, from, to});
        continue;
      }
      pieces.push_back({middle, from, from == over.left ? lips.left : lips.right});
      pieces.push_back({middle, to == over.left ? lips.left : lips.right, to});
    }
    replace(triangle, pieces);
  }

  /// A triangle that the line runs through from one crossing to the next: a corner alone, two on the other side.
  void divide(std::int32_t triangle, std::size_t crossing) {
    const CutCrossing& in = cut_.crossings[crossing];
    const CutCrossing& out = cut_.crossings[crossing + 1];
    const bool left = in.left == out.left;  // the corner alone lies left
    const std::int32_t alone = left ? in.left : in.right;
    const auto lip = [&](std::size_t i, bool of_left) { return of_left ? lips_[i].left : lips_[i].right; };
    WallTriangle corners = out_.surface.triangles[static_cast<std::size_t>(triangle)];
    while (corners[0] != alone) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    // Counter-clockwise: alone, over the one crossing, d, e, over the other.
    const std::int32_t d = corners[1], e = corners[2];
    const bool in_first = d == in.left || d == in.right;
    const std::size_t first = in_first ? crossing : crossing + 1, second = in_first ? crossing + 1 : crossing;
    const std::int32_t m = lip(first, !left), n = lip(second, !left);
    std::vector<WallTriangle> pieces{{alone, lip(first, left), lip(second, left)}};
    if ((at(m) - at(e)).squaredNorm() <= (at(d) - at(n)).squaredNorm()) {
      pieces.push_back({m, d, e});
      pieces.push_back({m, e, n});
    } else {
      pieces.push_back({m, d, n});
      pieces.push_back({d, e, n});
    }
    replace(triangle, pieces);
  }

  void wall(const WallTriangle& corners) {
    out_.walls.push_back(static_cast<std::int32_t>(out_.surface.triangles.size()));
    out_.surface.triangles.push_back(corners);
  }
  void set_walls() {
    wall({lips_.front().left, begin_, lips_.front().bottom});
    wall({begin_, lips_.front().right, lips_.front().bottom});
    for (std::size_t i = 0; i + 1 < lips_.size(); ++i) {
      const Lips &a = lips_[i], &b = lips_[i + 1];
      wall({b.left, a.left, a.bottom});
      wall({b.left, a.bottom, b.bottom});
      wall({a.right, b.right, b.bottom});
      wall({a.right, b.bottom, a.bottom});
    }
    wall({end_, lips_.back().left, lips_.back().bottom});
    wall({lips_.back().right, end_, lips_.back().bottom});
  }

  /// Draws the lips of a crossing apart along its edge, as far as no triangle beside them turns over.
  void gape(std::size_t i) {
    const CutCrossing& crossing = cut_.crossings[i];
    const Vec3 along = at(crossing.right) - at(crossing.left);
    const double length = along.norm();
    if (!(length > 0) || !(crossing.gape_m > 0)) return;
    for (const bool left : {true, false}) {
      const std::int32_t lip = left ? lips_[i].left : lips_[i].right;
      const Vec3 place = at(lip);
      const double room = (left ? crossing.share : 1 - crossing.share) * length / 2;
      double move = std::min(crossing.gape_m / 2, room);
      const std::vector<WallTriangle> beside = outside_round(lip);
      std::vector<Vec3> normals;
      for (const WallTriangle& t : beside) normals.push_back(normal_of(t));
      for (int narrowing = 0;; ++narrowing, move /= 2) {
        out_.surface.vertices[static_cast<std::size_t>(lip)] =
            narrowing < kNarrowings ? Vec3(place + (left ? -move : move) / length * along) : place;
        bool turned = false;
        for (std::size_t t = 0; t < beside.size(); ++t) turned |= normal_of(beside[t]).dot(normals[t]) < kLeastTurn;
        if (!turned || narrowing >= kNarrowings) break;
      }
    }
  }
  /// The triangles at a vertex but for the groove's own walls.
  std::vector<WallTriangle> outside_round(std::int32_t vertex) const {
    std::vector<WallTriangle> out;
    const auto take = [&](std::size_t t) {
      const WallTriangle& corners = out_.surface.triangles[t];
      if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) out.push_back(corners);
    };
    take(static_cast<std::size_t>(cut_.begin.triangle));
    for (const CutCrossing& crossing : cut_.crossings) take(static_cast<std::size_t>(crossing.triangle));
    for (std::size_t t = first_piece(); t < static_cast<std::size_t>(out_.walls.front()); ++t) take(t);
    return out;
  }
  std::size_t first_piece() const {
    // Three more of each end's five or four pieces stand behind, two more of each triangle between.
    return static_cast<std::size_t>(out_.walls.front()) - 2 * 3 - 2 * (cut_.crossings.size() - 1);
  }
  Vec3 normal_of(const WallTriangle& t) const { return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized(); }

  const SurfaceCut& cut_;
  Groove out_;
  std::int32_t begin_ = 0, end_ = 0;
  std::vector<Lips> lips_;
};

}  // namespace

Groove cut_groove(const TriangleSurface& surface, const SurfaceCut& cut) { return GrooveCutter(surface, cut).cut(); }

}  // namespace trocar
