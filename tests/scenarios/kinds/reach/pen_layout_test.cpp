// Pens of every board: on the cap, inside the region, apart, turned no further than the file says, on the port's line.
#include "scenarios/kinds/reach/pen_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/reach/pose_task.h"

namespace trocar::pen_layout_test {
namespace {

constexpr double kTiny = 1e-9;

const Exercise& shipped() {
  static const Exercise exercise =
      find_exercise("reach-and-orient", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
  return exercise;
}

Mat3 resting() { return Eigen::AngleAxisd(2.5, Vec3(0.8, 0.6, 0)).toRotationMatrix(); }

TEST(PenLayout, PutsEveryTipOnTheCapApartFromTheOthers) {
  const PenRules& pens = shipped().pens;
  const Vec3 centre(0, 0, pens.shell_radius_m - shipped().layout.relief_m);
  for (int number = 0; number < 40; ++number) {
    const Board board = lay_out_pens(shipped(), shipped().levels[0], resting(), number);
    ASSERT_EQ(board.targets.size(), 8u);
    for (std::size_t i = 0; i < board.targets.size(); ++i) {
      const Vec3 tip = board.targets[i].centre_T;
      EXPECT_NEAR((tip - centre).norm(), pens.shell_radius_m, kTiny);
      EXPECT_GE((centre - tip).z(), pens.shell_radius_m * std::cos(pens.cap_rad) - kTiny);
      EXPECT_LE(std::abs(tip.z()), shipped().layout.relief_m + kTiny);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((tip - board.targets[j].centre_T).norm(), shipped().layout.min_spacing_m - kTiny);
    }
  }
}

TEST(PenLayout, TurnsNoFurtherThanTiltAndRollTogether) {
  double largest = 0;
  for (int number = 0; number < 40; ++number) {
    for (const Target& pen : lay_out_pens(shipped(), shipped().levels[0], resting(), number).targets) {
      const double tilt = std::acos(std::clamp(pen.R_TI.col(2).dot(resting().col(2)), -1.0, 1.0));
      EXPECT_LE(tilt, shipped().pens.tilt_rad + kTiny);
      EXPECT_LE(rotation_between(resting(), pen.R_TI), shipped().pens.tilt_rad + shipped().pens.roll_rad + kTiny);
      EXPECT_NEAR(pen.R_TI.determinant(), 1, kTiny);
      EXPECT_TRUE(pen.normal_T.isApprox(-pen.R_TI.col(2)));
      largest = std::max(largest, tilt);
    }
  }
  EXPECT_GT(largest, 0.9 * shipped().pens.tilt_rad) << "320 draws come near the limit";
}

TEST(PenLayout, LiesOnTheLineThroughThePort) {
  const ExerciseLevel& level = find_level(shipped(), "L3");
  double smallest = 1, largest = -1;
  for (int number = 0; number < 20; ++number) {
    for (const Target& pen : lay_out_pens(shipped(), level, resting(), number).targets) {
      const Vec3 axis = (pen.centre_T - level.port_m).normalized();
      EXPECT_TRUE(pen.R_TI.col(2).isApprox(axis, 1e-9)) << "the shaft of a matched pen passes the port";
      const Mat3 unrolled = least_turn(resting().col(2), axis).toRotationMatrix() * resting();
      const double roll = std::atan2(unrolled.col(1).dot(pen.R_TI.col(0)), unrolled.col(0).dot(pen.R_TI.col(0)));
      smallest = std::min(smallest, roll);
      largest = std::max(largest, roll);
    }
  }
  EXPECT_GE(smallest, -shipped().pens.roll_rad - kTiny);
  EXPECT_LE(largest, shipped().pens.roll_rad + kTiny);
  EXPECT_LT(smallest, -0.8 * shipped().pens.roll_rad) << "the roll is asked for, both ways";
  EXPECT_GT(largest, 0.8 * shipped().pens.roll_rad);
}

TEST(PenLayout, IsDrawnByTheBoardNumberAlone) {
  const auto tips = [](int number) {
    std::vector<Vec3> out;
    for (const Target& pen : lay_out_pens(shipped(), shipped().levels[0], resting(), number).targets)
      out.push_back(pen.centre_T);
    return out;
  };
  EXPECT_EQ(tips(3), tips(3));
  EXPECT_NE(tips(3), tips(4));
}

TEST(PenLayout, SaysHowManyFit) {
  Exercise crowded = shipped();
  crowded.layout.min_spacing_m = 0.060;
  try {
    lay_out_pens(crowded, crowded.levels[0], resting(), 7);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("board 7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("of 8 pens"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trocar::pen_layout_test
