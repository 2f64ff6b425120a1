#include "app/picture/kinds/board_object.h"

#include <numbers>

namespace trocar {

SceneObject board_object(double top_z, double side, double thickness, const Vec3& centre, const Vec3& lines) {
  SceneObject board;
  board.shape = SceneObject::Shape::kBoard;
  board.look = SceneObject::Look::kBoard;
  board.size_m = {side, side, thickness};
  board.X_TO.p = {centre.x(), centre.y(), top_z};
  board.colour = Vec3(0.15, 0.16, 0.17);
  board.accent = lines;
  return board;
}

SceneObject triangle_object(const FoamBlock& ring) {
  SceneObject out;
  out.shape = SceneObject::Shape::kTriangle;
  out.size_m = {ring.size_m.x() * 2 / std::numbers::sqrt3, 2 * ring.hole_radius_m, ring.size_m.z()};
  out.X_TO = ring.X_TO;
  out.colour = Vec3(0.50, 0.13, 0.07);
  return out;
}

}  // namespace trocar
