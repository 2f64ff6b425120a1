// Traces in the layout of the JIGSAWS kinematics (Gao et al., "JHU-ISI Gesture and Skill Assessment Working Set",
// 2014), and back.
//
// A text line each 1/30 s, 76 numbers: master left, master right, slave left, slave right, 19 each = position (m) 3,
// rotation matrix by rows 9, linear velocity (m/s) 3, angular velocity (rad/s) 3, angle of the gripper (rad) 1. Our one
// hand stands in both right blocks, the left ones are 0. The frame is T. The columns of the rotation are the
// instrument's axes, z along the shaft; roll is not recorded, so x and y are carried along the path without turning
// about the shaft. Samples are taken as they are, without a filter. Pure. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
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

/// @throws InputError: fewer than 2 samples, a value that is not finite, times that do not increase.
std::string jigsaws_text(const Trace& trace);

/// The slave's tip of that side as a trace of 30 Hz that begins at 0 s; no forces. @param name of the file, for
/// messages.
/// @throws InputError with the line: not 76 numbers, a value that is not finite, a rotation that is none; no instrument
/// there (all 0).
Trace parse_jigsaws(std::string_view text, const std::string& name, JigsawsSide side);

struct JigsawsTrial {
  std::string name;                                ///< of the file, without .txt
  char skill = 'X';                                ///< E, I, N; X: not said
  std::optional<std::array<int, 6>> ratings = {};  ///< 1 to 5 each; empty: not rated, written as 0
};

/// Line of the meta file: name, skill, sum of the ratings, the six ratings; tabs between.
std::string jigsaws_meta_line(const JigsawsTrial& trial);

/// The metrics of the catalogue that need motion alone, over the whole trace; those that are not defined are left out.
/// A slower trace is brought to kMetricRateHz by cubics first, so that filter and differences are those of the
/// definitions. @param trace uniform in time.
std::vector<Metric> kinematic_metrics(const Trace& trace);

}  // namespace trocar
