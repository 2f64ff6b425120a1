// Cups of every board: where the scope of each looks, level and not too steep, clear of each other and of the plate;
// and what a cup hides.
#include "scenarios/kinds/camera/cup_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/camera/cup.h"
#include "scenarios/kinds/camera/scope_view.h"

namespace trocar::cup_layout_test {
namespace {

constexpr double kDegree = M_PI / 180;

const Exercise& shipped() {
  static const Exercise exercise = find_exercise("E04", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
  return exercise;
}

/// As the device rests: down, away and to the left, the picture level.
Mat3 resting() { return level_instrument(Vec3(-0.45, 0.45, -0.77).normalized()); }

TEST(CupLayout, EachIsSeenWholeLevelAndAlongItsAxisFromWhereItsScopeStands) {
  for (const ExerciseLevel& level : shipped().levels) {
    for (int number = 0; number < 20; ++number) {
      const Board board = lay_out_cups(shipped(), level, resting(), number);
      ASSERT_EQ(board.targets.size(), 8u);
      for (const Target& target : board.targets) {
        const Cup cup = cup_of(target, own_rules<CameraRules>(shipped()), own_rules<CameraLevel>(level));
        const Mat3 R_TC = target.R_TI * picture_in_instrument(own_rules<CameraLevel>(level).tilt_rad);
        EXPECT_NEAR((cup.sphere_T - target.centre_T).dot(R_TC.col(2)), own_rules<CameraRules>(shipped()).drawn_m, 1e-9);
        EXPECT_NEAR(horizon_of(R_TC).value(), 0, 1e-9);
        EXPECT_LE(-R_TC(2, 2), std::sin(own_rules<CameraRules>(shipped()).steepest_rad) + 1e-9);
        EXPECT_TRUE(cup.shows_sphere(target.centre_T));
        if (level.mapping == Mapping::kFulcrum)
          EXPECT_NEAR((target.centre_T - level.port_m).normalized().dot(target.R_TI.col(2)), 1, 1e-9);
        else
          EXPECT_GE(resting().col(2).dot(target.R_TI.col(2)),
                    std::cos(own_rules<CameraRules>(shipped()).swing_rad) - 1e-9);
      }
    }
  }
}

TEST(CupLayout, NoCupStandsInAnothersOrInItsLineOfSight) {
  const ExerciseLevel& level = find_level(shipped(), "L2");
  for (int number = 0; number < 20; ++number) {
    const Board board = lay_out_cups(shipped(), level, resting(), number);
    for (const Target& seen : board.targets) {
      const Cup cup = cup_of(seen, own_rules<CameraRules>(shipped()), own_rules<CameraLevel>(level));
      EXPECT_GT(cup.foot_T().z(), own_rules<CameraRules>(shipped()).board_z_m);
      for (const Target& other : board.targets) {
        if (&other == &seen) continue;
        const Cup beside = cup_of(other, own_rules<CameraRules>(shipped()), own_rules<CameraLevel>(level));
        for (double share = 0; share <= 1; share += 0.05)
          EXPECT_GT(beside.distance_m(seen.centre_T + share * (cup.foot_T() - seen.centre_T)), 0.0025) << number;
      }
    }
  }
}

TEST(CupLayout, IsDrawnByTheNumberAlone) {
  const ExerciseLevel& level = shipped().levels.front();
  const Board a = lay_out_cups(shipped(), level, resting(), 7), b = lay_out_cups(shipped(), level, resting(), 7),
              c = lay_out_cups(shipped(), level, resting(), 8);
  EXPECT_EQ(a.targets[3].centre_T, b.targets[3].centre_T);
  EXPECT_NE(a.targets[3].centre_T, c.targets[3].centre_T);
}

TEST(CupLayout, SaysWhenThereIsNoRoom) {
  Exercise crowded = shipped();
  crowded.layout.min_spacing_m = 0.080;
  EXPECT_THROW(lay_out_cups(crowded, crowded.levels.front(), resting(), 0), InputError);
}

/// Upright, bore 10, wall 1, depth 12, sphere 6 mm; its rim in the plane z = 9 mm.
Cup upright() { return {Vec3::Zero(), Vec3::UnitZ(), 0.010, 0.001, 0.012, 0.006}; }

TEST(Cup, HidesTheSphereFromWhoLooksAslant) {
  const auto from = [](double degrees) {
    return upright().shows_sphere(0.045 * Vec3(std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree)));
  };
  EXPECT_TRUE(from(0));
  EXPECT_TRUE(from(15));
  EXPECT_FALSE(from(18)) << "9 mm under the rim, 2.6 mm beside it";
}

TEST(Cup, IsAsFarAsItsNearestWall) {
  EXPECT_NEAR(upright().distance_m(Vec3(0, 0, 0)), 0.003, 1e-12) << "the floor";
  EXPECT_NEAR(upright().distance_m(Vec3(0.0055, 0, 0.019)), 0.010, 1e-12) << "over the rim";
  EXPECT_NEAR(upright().distance_m(Vec3(0, 0.010, 0)), 0.004, 1e-12) << "beside it";
  EXPECT_NEAR(upright().distance_m(Vec3(0.0055, 0, 0.002)), 0, 1e-12) << "within the wall";
}

}  // namespace
}  // namespace trocar::cup_layout_test
