// Where a steered tip may go: a ball about the work space, and the port that the shaft passes if there is one.
//
// The ball holds the board region, its relief and the start sphere with 15 mm to spare, so that a lost mouse cannot
// throw the arm. Frame T, m. Thread: plain value, any thread.
#pragma once

#include <optional>

#include "haptics/quantities.h"

namespace trocar {

struct Exercise;
struct ExerciseLevel;

struct SteeringReach {
  double radius_m = 0.08;
  std::optional<Vec3> port_T = {};  ///< then only tip and roll can be had: the shaft's direction follows from the tip
};

SteeringReach steering_reach(const Exercise& exercise, const ExerciseLevel& level);

/// The point of the ball nearest to p.
Vec3 within_ball(const Vec3& p_T, const Vec3& centre_T, double radius_m);

}  // namespace trocar
