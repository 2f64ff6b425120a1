// How a patient lies in the theatre: from RAS patient axes (x right, y front, z head) to the axes of frame T.
//
// On the back, seen from the feet: front up (z), head away (y), the patient's left on the right (x). A turn only.
// Thread: any.
#pragma once

#include <Eigen/Core>

namespace trocar {

inline Eigen::Matrix3d theatre_from_ras() {
  Eigen::Matrix3d turn;
  turn << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  return turn;
}

}  // namespace trocar
