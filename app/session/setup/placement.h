// Where the theatre lies in the device's workspace, and how much of a scene force the device can render there.
//
// The board region's centre (T's origin) is put where the arm is good: a search over the workspace with the home
// orientation kept gave this point the largest force that every posture of a 100 x 80 x 70 mm box can render, joint
// margin >= 8 deg, det A >= 0.3 (docs/decisions/0004-placement.md).
#pragma once

#include "haptics/device/device_model.h"
#include "haptics/mapping/instrument_map.h"
#include "scenarios/exercise.h"

namespace trocar {

/// Registration of a level. T is W' turned by half a turn about z (the stylus then points away from the trainee,
/// towards +y of T). Direct: the shaft is turned against the stylus axis so that it comes from above and from the
/// right, clear of the scope. Fulcrum: the handle, not the tip, is put where the arm is good, for the shipped port and
/// length such that the whole region is within reach whether the stylus keeps its direction or follows the shaft
/// (decision 0004).
InstrumentMap place_theatre(const ExerciseLevel& level);

/// Force that the device can render at the region's 5th percentile beyond gravity, N, along the approach axis (T's z).
double renderable_force_n(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout);

/// The same with the tip at one point; 0 out of reach.
double renderable_force_n(const InstrumentMap& map, const DeviceModel& device, const Vec3& tip_T);

/// Share of the region in which the device can give map.force_scale x `soft_force_n`.
double room_share(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout, double soft_force_n);

}  // namespace trocar
