#include "tissue/mesh/files/winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

using Index = std::int32_t;

struct Side {
  Index low, high, triangle;
  bool forward;  ///< the triangle runs from low to high
};

struct Neighbour {
  Index triangle = -1;
  bool same_way = false;  ///< both run along the edge in one direction: one of them is the wrong way round
};

/// Three neighbours of each triangle.
std::vector<std::array<Neighbour, 3>> triangle_neighbours(const TriangleSurface& surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t n = 0; n < 3; ++n) {
      const Index from = surface.triangles[t][n], to = surface.triangles[t][(n + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<Index>(t), from < to});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  std::vector<std::array<Neighbour, 3>> result(surface.triangles.size());
  const auto link = [&](Index from, const Neighbour& to) {
    auto& three = result[static_cast<std::size_t>(from)];
    const auto free = std::find_if(three.begin(), three.end(), [](const Neighbour& n) { return n.triangle < 0; });
    if (free != three.end()) *free = to;
  };
  for (std::size_t n = 0; n + 1 < sides.size(); n += 2) {
    const bool same = sides[n].forward == sides[n + 1].forward;
    link(sides[n].triangle, {sides[n + 1].triangle, same});
    link(sides[n + 1].triangle, {sides[n].triangle, same});
  }
  return result;
}

double six_volumes(const TriangleSurface& surface, const std::array<Index, 3>& t, const Vec3& origin) {
  std::array<Vec3, 3> p;
  for (std::size_t n = 0; n < 3; ++n) p[n] = surface.vertices[static_cast<std::size_t>(t[n])] - origin;
  return p[0].dot(p[1].cross(p[2]));
}

}  // namespace

bool wind_outward(TriangleSurface& surface, std::size_t& turned) {
  const auto neighbours = triangle_neighbours(surface);
  const Vec3 origin = surface.bounds().center();  // far from the origin the sum loses digits
  enum State : char { kUnseen, kAsStored, kTurned };
  std::vector<char> state(surface.triangles.size(), kUnseen);
  std::vector<Index> piece;
  for (std::size_t seed = 0; seed < state.size(); ++seed) {
    if (state[seed] != kUnseen) continue;
    piece.assign(1, static_cast<Index>(seed));
    state[seed] = kAsStored;
    double volume = 0;
    for (std::size_t done = 0; done < piece.size(); ++done) {
      const auto here = static_cast<std::size_t>(piece[done]);
      volume += (state[here] == kTurned ? -1 : 1) * six_volumes(surface, surface.triangles[here], origin);
      for (const Neighbour& next : neighbours[here]) {
        if (next.triangle < 0) continue;
        char& other = state[static_cast<std::size_t>(next.triangle)];
        const char wanted = (state[here] == kTurned) != next.same_way ? kTurned : kAsStored;
        if (other != kUnseen && other != wanted) return false;
        if (other == kUnseen) piece.push_back(next.triangle);
        other = wanted;
      }
    }
    for (const Index triangle : piece)
      if ((state[static_cast<std::size_t>(triangle)] == kTurned) != (volume < 0)) {
        auto& corners = surface.triangles[static_cast<std::size_t>(triangle)];
        std::swap(corners[1], corners[2]);
        ++turned;
      }
  }
  return true;
}

bool encloses(const TriangleSurface& surface, const Vec3& point) {
  double angle = 0;  // van Oosterom and Strackee 1983
  for (const auto& triangle : surface.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t n = 0; n < 3; ++n) p[n] = surface.vertices[static_cast<std::size_t>(triangle[n])] - point;
    const double a = p[0].norm(), b = p[1].norm(), c = p[2].norm();
    angle += 2 * std::atan2(p[0].dot(p[1].cross(p[2])),
                            a * b * c + p[0].dot(p[1]) * c + p[1].dot(p[2]) * a + p[2].dot(p[0]) * b);
  }
  return angle > 2 * std::numbers::pi;
}

}  // namespace trocar
