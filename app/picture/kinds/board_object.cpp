#include "app/picture/kinds/board_object.h"

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

}  // namespace trocar
