#include "app/session/setup/motor_pairs.h"

namespace trocar {

MotorPairs motor_pairs(const MotorStates& motors) {
  MotorPairs pairs;
  for (const MotorTemperatures& motor : motors) pairs.push_back({motor.winding_c, motor.case_c});
  return pairs;
}

std::optional<MotorStates> motor_states(const MotorPairs& pairs) {
  MotorStates motors;
  if (pairs.size() != motors.size()) return std::nullopt;
  for (std::size_t i = 0; i < motors.size(); ++i) motors[i] = {pairs[i][0], pairs[i][1]};
  return motors;
}

}  // namespace trocar
