// Where the pairs of dots lie on the organ, how a needle goes through them, and where needles stand.
//
// Boards are drawn by their number alone. The slit runs as the shaft does, seen from above, so that a needle across the
// shaft crosses it. Frame T, m. Thread: loading only, but for the pure functions.
#pragma once

#include <optional>

#include "scenarios/director/director.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/kinds/needle/needle_rules.h"

namespace trocar {

/// A needle whose circle stands across the shaft, turned so that its point is at an angle.
/// @param middle_T of the circle. @param up_T made upright to the shaft. @param shaft_T unit, to the tip
/// @param point_rad about the shaft's back from the side towards which the needle is driven; 3/2 pi is lowest
Pose needle_across(const NeedleShape& shape, const Vec3& middle_T, const Vec3& up_T, const Vec3& shaft_T,
                   double point_rad);

/// Where the circle of a needle goes through a pair of dots: its middle, and the point's angle there.
struct BiteCircle {
  Vec3 middle_T = Vec3::Zero(), up_T = Vec3::UnitZ();
  double entry_rad = 0;
};
BiteCircle bite_circle(const NeedleShape& shape, const Vec3& entry_T, const Vec3& exit_T, const Vec3& normal_T,
                       const Vec3& shaft_T);

/// The instrument that grasps a needle where it lies, so far along it, rolled least from an orientation.
Pose grasping(const NeedleShape& shape, const Pose& X_TN, double share_from_swage, const Mat3& R_TI_near,
              const Vec3& port_T);

/// @throws InputError: the organ has no room for the pairs
Board lay_out_needle(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place);

/// Where the board has its needles stand; nullopt: it is of another kind.
std::optional<Pose> needle_stand(const Exercise& exercise, const Board& board);

}  // namespace trocar
