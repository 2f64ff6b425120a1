// How jerkily the picture moves: peaks of the speed with which a point wanders through it.
//
// The speed is low-passed (50 ms); a peak stands out by at least 8 deg/s from the valley before and the fall behind it,
// so that neither tremor nor encoder steps count. rad/s. Thread: the tissue task's.
#pragma once

#include <optional>

#include "haptics/quantities.h"

namespace trocar {

class ViewMotion {
 public:
  /// Another point is looked at: no motion yet.
  void restart() { seen_C_.reset(); }
  /// @param seen_C direction of the point in the picture's axes, unit. @return a peak has just been passed
  bool update(const Vec3& seen_C, double dt_s);
  double speed() const { return speed_; }  ///< rad/s

 private:
  std::optional<Vec3> seen_C_;
  double speed_ = 0, valley_ = 0, top_ = 0;
  bool rising_ = false;
};

}  // namespace trocar
