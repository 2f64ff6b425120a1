// One pair a motor, and back.
#include "app/session/setup/motor_pairs.h"

#include <gtest/gtest.h>

namespace trocar::motor_pairs_test {
namespace {

TEST(MotorPairs, ComeBackAndAreOneAMotor) {
  MotorStates motors;
  motors[3] = {104, 60};
  MotorPairs pairs = motor_pairs(motors);
  EXPECT_EQ(motor_states(pairs), motors);
  pairs.pop_back();
  EXPECT_EQ(motor_states(pairs), std::nullopt);
  pairs.resize(motors.size() + 1);
  EXPECT_EQ(motor_states(pairs), std::nullopt);
}

}  // namespace
}  // namespace trocar::motor_pairs_test
