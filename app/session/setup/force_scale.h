// kappa of a level whose file says "auto": how much of a scene force is rendered at the stylus
// (docs/frames_and_units.md).
//
// kappa belongs to the level, not to the board: the same push must feel the same on all of them. So it is asked of the
// practice boards and of as many that seeds draw, those that `trocar check` proves. SI units. Thread: loading only.
#pragma once

#include <vector>

#include "haptics/device/device_model.h"
#include "haptics/mapping/instrument_map.h"
#include "scenarios/director/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// A pose that a board asks for, with the scene's normal there.
struct Stop {
  Pose X_TI;
  Vec3 normal_T;
};

/// Start and every target of a board, each also withdrawn by the retract height. @param R_TI_rest resting instrument.
std::vector<Stop> stops_of(const Exercise& exercise, const Board& board, const Mat3& R_TI_rest);

/// Largest kappa <= 1, rounded down to 0.01, for which the soft limit is rendered at the 5th percentile of the region,
/// and at every stop of `boards` gravity and the hard limit together stay within the torque budget. At least 0.01; a
/// stop out of reach asks nothing (`trocar check` says so).
double auto_force_scale(const InstrumentMap& map, const DeviceModel& device, const Exercise& exercise,
                        const std::vector<Board>& boards);

}  // namespace trocar
