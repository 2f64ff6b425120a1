// Traces from the layout of the JIGSAWS kinematics (Gao et al., "JHU-ISI Gesture and Skill Assessment Working Set",
// 2014): our metrics on movements of surgeons that others have rated. Why nothing is written in it: docs/exports.md.
//
// A text line each 1/30 s, 76 numbers: master left, master right, slave left, slave right, 19 each = position (m) 3,
// rotation matrix by rows 9, linear velocity (m/s) 3, angular velocity (rad/s) 3, angle of the gripper (rad) 1. The
// columns of the rotation are the instrument's axes, z along the shaft. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

inline constexpr double kJigsawsRateHz = 30;
inline constexpr int kJigsawsColumns = 76, kJigsawsBlock = 19;
/// Hinge to tip of the grasper's jaws: opening = 2 length sin(angle / 2).
inline constexpr double kJawLength = 0.020;

enum class JigsawsSide : std::uint8_t { kLeft, kRight };

/// The slave's tip of that side as a trace of 30 Hz that begins at 0 s; no forces. @param name of the file, for
/// messages.
/// @throws InputError with the line: not 76 numbers, a value that is not finite, a rotation that is none; no instrument
/// there (all 0).
Trace parse_jigsaws(std::string_view text, const std::string& name, JigsawsSide side);

/// The metrics of the catalogue that need motion alone, over the whole trace; those that are not defined are left out.
/// A slower trace is brought to kMetricRateHz by cubics first, so that filter and differences are those of the
/// definitions. @param trace uniform in time.
std::vector<Metric> kinematic_metrics(const Trace& trace);

}  // namespace trocar
