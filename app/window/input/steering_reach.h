// Where a steered tip may go: a ball about the work space, and the port that the shaft passes if there is one.
//
// The ball holds the board region, its relief and the start sphere with 15 mm to spare, so that a lost mouse cannot
// throw the arm. The wrist's limits are what the device can follow. Without a port the shaft lies across the stylus, so
// that roll is soon a large turn of the arm: 24 degrees of lean and 20 of roll are the pens of reach-and-orient (20 and
// 15) with room; through a port roll is the stylus' own. Where a ring follows a wire without a port it is too: about
// the stylus, away from the trainee, the arm can turn for ever. Frame T, m, rad. Thread: plain value, any thread.
#pragma once

#include <numbers>
#include <optional>

#include "haptics/quantities.h"

namespace trocar {

struct Exercise;
struct ExerciseLevel;

struct SteeringReach {
  double radius_m = 0.08;
  std::optional<Vec3> port_T = {};  ///< then only tip and roll can be had: the shaft's direction follows from the tip
  double most_lean_rad = 24 * std::numbers::pi / 180, most_roll_rad = 20 * std::numbers::pi / 180;
  bool rolls_stylus = false;  ///< roll turns about the stylus, which points along y of T, not about the shaft
};

SteeringReach steering_reach(const Exercise& exercise, const ExerciseLevel& level);

/// The point of the ball nearest to p.
Vec3 within_ball(const Vec3& p_T, const Vec3& centre_T, double radius_m);

}  // namespace trocar
