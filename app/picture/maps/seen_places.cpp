#include "app/picture/maps/seen_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trocar {

SeenPlaces::SeenPlaces(const Camera& camera, int width, int height)
    : optics_(camera, {0, 0, width, height}),
      width_(width),
      height_(height),
      what_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), What::kNothing),
      away_(what_.size(), std::numeric_limits<float>::infinity()),
      place_(what_.size(), Vec3::Zero()) {}

/// Perspective: 1/away runs evenly over the pixels of a triangle, and so does place/away.
void SeenPlaces::draw(const Corner& a, const Corner& b, const Corner& c, What what) {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (std::abs(area) < 1e-9) return;
  const int x0 = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x})))),
            x1 = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
  const int y0 = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y})))),
            y1 = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double wb = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
      const double wc = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
      const double wa = 1 - wb - wc;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double ia = wa / a.away, ib = wb / b.away, ic = wc / c.away, away = 1 / (ia + ib + ic);
      const std::size_t at = index(x, y);
      if (away >= static_cast<double>(away_[at])) continue;
      away_[at] = static_cast<float>(away);
      what_[at] = what;
      place_[at] = away * (ia * a.place_T + ib * b.place_T + ic * c.place_T);
    }
}

void SeenPlaces::add(const TriangleSurface& surface, What what) {
  std::vector<Corner> corners(surface.vertices.size());
  std::vector<bool> seen(surface.vertices.size());
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const auto pixel = optics_.project(surface.vertices[i]);
    seen[i] = pixel.has_value();
    if (pixel)
      corners[i] = {surface.vertices[i], pixel->x(), pixel->y(),
                    (surface.vertices[i] - optics_.eye()).dot(optics_.forward())};
  }
  for (const auto& triangle : surface.triangles) {
    const auto [a, b, c] = std::array{static_cast<std::size_t>(triangle[0]), static_cast<std::size_t>(triangle[1]),
                                      static_cast<std::size_t>(triangle[2])};
    if (seen[a] && seen[b] && seen[c]) draw(corners[a], corners[b], corners[c], what);
  }
}

void SeenPlaces::add(const SceneView& view) {
  if (view.organ) add(*view.organ, What::kOrgan);
  for (const AdjacentOrganView& other : view.adjacent)
    if (other.surface) add(*other.surface, What::kOther);
  for (const SceneObject& object : view.objects)
    if (object.shape == SceneObject::Shape::kBoard) add(board_face(object), What::kBoard);
}

TriangleSurface board_face(const SceneObject& board) {
  constexpr int kParts = 24;
  TriangleSurface out;
  for (int j = 0; j <= kParts; ++j)
    for (int i = 0; i <= kParts; ++i) {
      const Vec3 place_O(board.size_m.x() * (static_cast<double>(i) / kParts - 0.5),
                         board.size_m.y() * (static_cast<double>(j) / kParts - 0.5), 0);
      out.vertices.push_back(board.X_TO.R * place_O + board.X_TO.p);
    }
  for (int j = 0; j < kParts; ++j)
    for (int i = 0; i < kParts; ++i) {
      const int a = j * (kParts + 1) + i, b = a + 1, c = a + kParts + 1, d = c + 1;
      out.triangles.push_back({a, b, d});
      out.triangles.push_back({a, d, c});
    }
  return out;
}

}  // namespace trocar
