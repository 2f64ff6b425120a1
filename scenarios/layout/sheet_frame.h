// A sheet that is spread in a frame over the organ: where it lies, and where clips hold its rim.
//
// A plane at one height, clear of all that is beneath. Clips hold three sides and the ends of the fourth, opposite the
// sheet's first edge, whose middle is left free to be cut into. Frame T, m. Thread: loading only.
#pragma once

#include "scenarios/exercise.h"
#include "scenarios/layout/height_field.h"

namespace trocar {

class SheetFrame {
 public:
  /// @param plan of a sheet that names no organ
  SheetFrame(const SheetPlan& plan, const HeightField& organ_T);

  /// @param place along the first edge and across
  Vec3 at(const Eigen::Vector2d& place) const;
  bool clipped(const Eigen::Vector2d& place) const;

 private:
  Eigen::Vector2d corner_, along_, across_;
  double length_, width_, height_ = 0;
};

}  // namespace trocar
