// Temperatures of the motors as JSON keeps them, in a recording's setup and from one attempt to the next:
// "motors_c": [[winding, case], ...], C, one pair a motor. Thread: any.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "haptics/control/motor_heat.h"

namespace trocar {

inline constexpr const char* kMotorsKey = "motors_c";
using MotorPairs = std::vector<std::array<double, 2>>;

MotorPairs motor_pairs(const MotorStates& motors);
/// Nothing where they are not one pair a motor.
std::optional<MotorStates> motor_states(const MotorPairs& pairs);

}  // namespace trocar
