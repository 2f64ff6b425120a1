// Can the arm follow what steering asks for? On the shipped exercises' own maps.
#include <gtest/gtest.h>

#include <string>

#include "app/input/steering.h"
#include "app/placement.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/exercise_loader.h"

namespace trocar {
namespace {

Exercise shipped(const std::string& id) { return load_exercise(TROCAR_SOURCE_DIR "/scenarios/exercises/" + id + ".toml"); }

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

TEST(SteeringReach, PrintsWhatTheWristCanFollow) {
  const Exercise exercise = shipped("surface-touch");
  for (const double lean : {0.0, 20.0, 35.0, 45.0})
    for (const double roll : {-150.0, -90.0, 0.0, 90.0, 150.0})
      std::printf("lean %3.0f roll %4.0f: %.2f\n", lean, roll,
                  followed(exercise, exercise.levels[0], lean * std::numbers::pi / 180, roll * std::numbers::pi / 180));
}

}  // namespace
}  // namespace trocar
