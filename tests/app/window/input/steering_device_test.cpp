// Can the arm follow what steering asks for? On the shipped exercises' own maps.
#include <gtest/gtest.h>

#include <string>

#include "app/session/setup/placement.h"
#include "app/window/input/steering.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar::steering_device_test {
namespace {

Exercise shipped(const std::string& id) {
  return load_exercise(TROCAR_SOURCE_DIR "/scenarios/exercises/" + id + ".toml");
}

TEST(SteeringReach, BallHoldsRegionAndStart) {
  for (const char* id : {"reach-and-orient", "surface-touch", "limited-grasp"}) {
    const Exercise exercise = shipped(id);
    const SteeringReach reach = steering_reach(exercise, exercise.levels.front());
    EXPECT_GT(reach.radius_m, Vec3(0.05, 0.04, 0.02).norm() + 0.01) << id;
    EXPECT_GT(reach.radius_m, exercise.start_above_m.norm() + exercise.start_sphere_m) << id;
    EXPECT_LT(reach.radius_m, 0.10) << id;
    EXPECT_FALSE(reach.port_T);
    EXPECT_EQ(steering_reach(exercise, exercise.levels[2]).port_T, Vec3(0.050, -0.050, 0.120));
  }
}

/// Share of postures within the wrist's limits, over the board region, that the arm can take.
double followed(const Exercise& exercise, const ExerciseLevel& level, double lean, double roll) {
  const InstrumentMap map = place_theatre(level);
  const Mat3 R0 = map.instrument_pose(home_pose()).R;
  int can = 0, all = 0;
  for (const double x : {-0.5, 0.0, 0.5}) {
    for (const double y : {-0.5, 0.0, 0.5}) {
      for (const double z : {0.0, exercise.start_above_m.z()}) {
        for (int side = 0; side < 8; ++side) {
          const double a = side * std::numbers::pi / 4;
          const Vec3 axis = R0 * Vec3(std::cos(a), std::sin(a), 0);
          const Mat3 R = Eigen::AngleAxisd(lean, axis) * R0 * Eigen::AngleAxisd(roll, Vec3::UnitZ()).toRotationMatrix();
          const Vec3 p(x * exercise.layout.region_x_m, y * exercise.layout.region_y_m, z);
          ++all;
          if (inverse_within_limits(map.stylus_pose({R, p}), home_angles())) ++can;
        }
      }
    }
  }
  return static_cast<double>(can) / all;
}

TEST(SteeringReach, TheWristFollowsToItsLimits) {
  for (const char* id : {"reach-and-orient", "surface-touch", "limited-grasp"}) {
    const Exercise exercise = shipped(id);
    const ExerciseLevel& direct = exercise.levels[0];
    const SteeringReach reach = steering_reach(exercise, direct);
    EXPECT_EQ(followed(exercise, direct, 0, 0), 1) << id;
    EXPECT_GE(followed(exercise, direct, reach.most_lean_rad, 0), 0.9)
        << id;  // the rest lies high over a corner of the board
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_GE(followed(exercise, direct, 0, sign * reach.most_roll_rad), 0.85)
          << id;  // limited-grasp starts 55 mm up
      EXPECT_GE(followed(exercise, direct, reach.most_lean_rad, sign * reach.most_roll_rad), 0.75) << id;
    }
  }
}

TEST(SteeringReach, ThroughAPortTheStylusRolls) {
  const Exercise exercise = shipped("surface-touch");
  const ExerciseLevel& level = exercise.levels[2];
  const double roll = steering_reach(exercise, level).most_roll_rad;
  for (const double sign : {-1.0, 1.0}) EXPECT_EQ(followed(exercise, level, 0, sign * roll), 1);
}

}  // namespace
}  // namespace trocar::steering_device_test
