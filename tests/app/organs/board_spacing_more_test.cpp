// Boards on organs with much and with little room: how far apart the targets lie, and what the board says of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "haptics/input_error.h"
#include "scenarios/kinds/touch/disc_layout.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::board_spacing_more_test {
namespace {

constexpr double kRadius = 0.003, kWrong = 0.002, kClosest = 2 * (kRadius + kWrong);

/// A touch on flat ground; the limits of the shipped exercise.
Exercise touch(int count, double spacing_m) {
  Exercise exercise;
  exercise.id = "touch";
  exercise.layout = {.count = count,
                     .radius_m = kRadius,
                     .region_x_m = 0.1,
                     .region_y_m = 0.08,
                     .relief_m = 0.02,
                     .min_spacing_m = spacing_m,
                     .max_slope_rad = 0.7,
                     .wrong_place_m = kWrong};
  exercise.start_above_m = Vec3(0.01, -0.02, 0.045);
  exercise.retract_height_m = 0.012;
  return exercise;
}

ExerciseLevel level(const std::vector<WantedForce>& bands = {{0.4, 0.8}}) {
  ExerciseLevel made;
  made.bands = bands;
  return made;
}

/// Slab whose flat upper face is the region's ground.
TriangleSurface slab(double width_m, double depth_m) {
  return test::box(Vec3(-width_m / 2, -depth_m / 2, -0.03), Vec3(width_m / 2, depth_m / 2, 0));
}

double nearest_pair(const Board& board) {
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < board.targets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, (board.targets[i].centre_T - board.targets[j].centre_T).head<2>().norm());
  return nearest;
}

TEST(BoardSpacing, ALargeOrganKeepsTheExercisesSpacing) {
  const Exercise exercise = touch(10, 0.014);
  for (int number = 0; number < 10; ++number) {
    const Board board = lay_out_discs(slab(0.2, 0.2), exercise, level(), number);
    EXPECT_EQ(board.targets.size(), 10U);
    EXPECT_EQ(board.spacing_m, 0.014) << "exactly what was asked";
    EXPECT_GE(nearest_pair(board), 0.014);
  }
}

TEST(BoardSpacing, ASmallOrganMovesThemTogetherButNeverRimIntoRim) {
  const Exercise exercise = touch(12, 0.02);
  int closer = 0;
  for (int number = 0; number < 6; ++number) {
    const Board board = lay_out_discs(slab(0.062, 0.052), exercise, level(), number);
    ASSERT_EQ(board.targets.size(), 12U) << number;
    EXPECT_GE(board.spacing_m, kClosest - 1e-12);
    EXPECT_LE(board.spacing_m, 0.02);
    EXPECT_GE(nearest_pair(board), board.spacing_m - 1e-9) << "the board says no more than is so";
    closer += board.spacing_m < 0.02;
  }
  EXPECT_EQ(closer, 6) << "twelve at 20 mm do not fit on 50 mm by 40 mm";
}

TEST(BoardSpacing, LessRoomNeverMeansMoreSpace) {
  const Exercise exercise = touch(9, 0.02);
  double before = 0.02;
  for (const double width : {0.12, 0.08, 0.06, 0.05}) {
    const Board board = lay_out_discs(slab(width, width), exercise, level(), 1);
    EXPECT_LE(board.spacing_m, before + 0.001) << width;
    before = board.spacing_m;
  }
  EXPECT_LT(before, 0.02);
}

TEST(BoardSpacing, WhereEvenTouchingRimsDoNotFitTheRefusalCounts) {
  const Exercise exercise = touch(12, 0.014);
  const std::string message =
      test::message_of<InputError>([&] { lay_out_discs(slab(0.03, 0.03), exercise, level(), 7); });
  EXPECT_CONTAINS(message, "board 7 of exercise 'touch'");
  EXPECT_CONTAINS(message, "of 12 targets");
  EXPECT_EQ(message.find("room for 0 "), std::string::npos) << "some fit: " << message;
}

TEST(BoardSpacing, ASpacingBelowTheRimsIsLeftAsItIs) {
  const Exercise exercise = touch(5, 0.008);
  EXPECT_EQ(lay_out_discs(slab(0.2, 0.2), exercise, level(), 0).spacing_m, 0.008);
  const std::string message =
      test::message_of<InputError>([&] { lay_out_discs(slab(0.018, 0.018), exercise, level(), 0); });
  EXPECT_CONTAINS(message, "of 5 targets");
}

TEST(BoardSpacing, TheSameNumberIsTheSameBoardToTheBit) {
  const Exercise exercise = touch(12, 0.02);
  for (const double width : {0.2, 0.062}) {
    const TriangleSurface organ = slab(width, 0.052);
    const Board a = lay_out_discs(organ, exercise, level(), 4), b = lay_out_discs(organ, exercise, level(), 4);
    ASSERT_EQ(a.targets.size(), b.targets.size());
    EXPECT_EQ(a.spacing_m, b.spacing_m);
    for (std::size_t n = 0; n < a.targets.size(); ++n) EXPECT_EQ(a.targets[n].centre_T, b.targets[n].centre_T) << n;
    const Board other = lay_out_discs(organ, exercise, level(), 5);
    EXPECT_NE(a.targets[0].centre_T, other.targets[0].centre_T);
  }
}

TEST(BoardSpacing, TheOrderOfTrianglesDoesNotChangeTheBoard) {
  const Exercise exercise = touch(12, 0.02);
  TriangleSurface organ = slab(0.062, 0.052);
  const Board before = lay_out_discs(organ, exercise, level(), 2);
  std::mt19937 generator(3);
  std::shuffle(organ.triangles.begin(), organ.triangles.end(), generator);
  for (auto& [a, b, c] : organ.triangles) std::tie(a, b, c) = std::tuple(b, c, a);
  const Board after = lay_out_discs(organ, exercise, level(), 2);
  EXPECT_EQ(before.spacing_m, after.spacing_m);
  for (std::size_t n = 0; n < before.targets.size(); ++n)
    EXPECT_NEAR((before.targets[n].centre_T - after.targets[n].centre_T).norm(), 0, 1e-12) << n;
}

TEST(BoardSpacing, EveryTargetLiesWithItsRimInsideTheRegionAndOnTheOrgan) {
  Exercise exercise = touch(12, 0.014);
  exercise.layout.region_x_m = 0.07, exercise.layout.region_y_m = 0.06;
  for (const double width : {0.3, 0.06}) {
    const Board board = lay_out_discs(slab(width, 0.3), exercise, level(), 3);
    for (const Target& target : board.targets) {
      EXPECT_LE(std::abs(target.centre_T.x()), 0.035 - kRadius - kWrong + 1e-12);
      EXPECT_LE(std::abs(target.centre_T.y()), 0.030 - kRadius - kWrong + 1e-12);
      EXPECT_LE(std::abs(target.centre_T.x()), width / 2);
      EXPECT_NEAR(target.centre_T.z(), 0, 1e-12);
      EXPECT_NEAR(target.normal_T.norm(), 1, 1e-12);
      EXPECT_LE(std::acos(target.normal_T.z()), exercise.layout.max_slope_rad + 1e-9);
      EXPECT_EQ(target.radius_m, kRadius);
    }
  }
}

TEST(BoardSpacing, OnABallEverySlopeAndHeightIsWithinItsLimit) {
  Exercise exercise = touch(12, 0.02);
  const double radius = 0.045;
  const TriangleSurface ball = test::sphere(Vec3(0, 0, -radius), radius, 4);
  const Board board = lay_out_discs(ball, exercise, level(), 0);
  ASSERT_EQ(board.targets.size(), 12U);
  for (const Target& target : board.targets) {
    EXPECT_NEAR((target.centre_T - Vec3(0, 0, -radius)).norm(), radius, 0.001);
    EXPECT_LE(std::acos(target.normal_T.z()), exercise.layout.max_slope_rad + 1e-9);
    EXPECT_GE(target.centre_T.z(), board.centre_T.z() - exercise.layout.relief_m);
  }
  EXPECT_GE(nearest_pair(board), board.spacing_m - 1e-9);
}

TEST(BoardSpacing, StartLiesAboveTheMiddleOfTheSurface) {
  const Exercise exercise = touch(4, 0.014);
  const TriangleSurface high = slab(0.2, 0.2).transformed(Pose{Mat3::Identity(), Vec3(0, 0, 0.01)});
  const Board board = lay_out_discs(high, exercise, level(), 0);
  EXPECT_NEAR((board.centre_T - Vec3(0, 0, 0.01)).norm(), 0, 1e-12);
  EXPECT_NEAR((board.start_T - Vec3(0.01, -0.02, 0.055)).norm(), 0, 1e-12);
}

TEST(BoardSpacing, BandsAreDealtEvenlyAlsoWhereTargetsMoveTogether) {
  const Exercise exercise = touch(12, 0.02);
  const std::vector<WantedForce> bands{{0.2, 0.4}, {0.4, 0.8}, {0.8, 1.2}};
  bool mixed = false;
  for (int number = 0; number < 4; ++number) {
    const Board board = lay_out_discs(slab(0.062, 0.052), exercise, level(bands), number);
    std::map<double, int> dealt;
    for (std::size_t n = 0; n < board.targets.size(); ++n) {
      ++dealt[board.targets[n].band.low_n];
      mixed = mixed || board.targets[n].band != bands[n % 3];
    }
    EXPECT_EQ(dealt, (std::map<double, int>{{0.2, 4}, {0.4, 4}, {0.8, 4}})) << number;
  }
  EXPECT_TRUE(mixed) << "in a drawn order";
}

TEST(PlaceOrgan, IsAProperTurnOfTheImageAxesForEveryOrgan) {
  const TargetLayout layout = touch(4, 0.014).layout;
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> somewhere(-0.3, 0.3);
  for (int n = 0; n < 5; ++n) {
    const Vec3 centre(somewhere(generator), somewhere(generator), somewhere(generator));
    const Pose pose = place_organ(test::sphere(centre, 0.05, 3), layout);
    EXPECT_NEAR(pose.R.determinant(), 1, 1e-12);
    EXPECT_EQ(pose.R * Vec3::UnitX(), -Vec3::UnitX());
    EXPECT_EQ(pose.R * Vec3::UnitY(), Vec3::UnitZ()) << "anterior is up";
    EXPECT_EQ(pose.R * Vec3::UnitZ(), Vec3::UnitY()) << "the head is away";
    const Vec3 middle = pose.R * centre + pose.p;
    EXPECT_NEAR(middle.norm(), 0.05, 0.004) << "the origin lies on the surface";
    EXPECT_LT(middle.z(), 0);
  }
}

TEST(PlaceOrgan, AndABoardGoTogetherWhereverTheImageLay) {
  const Exercise exercise = touch(8, 0.014);
  const TriangleSurface here = test::sphere(Vec3::Zero(), 0.06, 3);
  const TriangleSurface there = here.transformed(Pose{Mat3::Identity(), Vec3(0.25, -0.5, 0.125)});
  const auto board = [&](const TriangleSurface& organ) {
    return lay_out_discs(organ.transformed(place_organ(organ, exercise.layout)), exercise, level(), 6);
  };
  const Board a = board(here), b = board(there);
  for (std::size_t n = 0; n < a.targets.size(); ++n)
    EXPECT_NEAR((a.targets[n].centre_T - b.targets[n].centre_T).norm(), 0, 1e-6) << n;
}

}  // namespace
}  // namespace trocar::board_spacing_more_test
