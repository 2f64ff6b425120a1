// What cuts make of a closed line, against closed forms.
#include "scenarios/kinds/gauze/cut_line.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace trocar::cut_line_test {
namespace {

constexpr double kPi = std::numbers::pi, kBand = 0.002;
const GauzeLine kCircle{0.020, 0.020, 0, -kPi / 2, 0.027, 1};

struct Sum {
  double area = 0, outside = 0, off = 0;
};

Sum cut_in(CutLine& line, double aside_m = 0) {
  Sum sum;
  for (double depth = 0; depth < 0.027; depth += 0.004) {
    const auto added = line.add({aside_m, -0.047 + depth}, {aside_m, -0.047 + depth + 0.0045});
    sum.area += added.area_share;
    sum.outside += added.outside_share;
  }
  return sum;
}

/// All round at a radius, by chords of 4 mm.
Sum cut_round(CutLine& line, double radius_m, double from_turn = 0, double to_turn = 2 * kPi) {
  Sum sum;
  const auto at = [&](double turn) -> Eigen::Vector2d {
    return radius_m * Eigen::Vector2d(std::cos(turn - kPi / 2), std::sin(turn - kPi / 2));
  };
  const int chords = static_cast<int>(std::ceil((to_turn - from_turn) * radius_m / 0.004));
  for (int n = 0; n < chords; ++n) {
    const double step = (to_turn - from_turn) / chords;
    const auto added = line.add(at(from_turn + n * step), at(from_turn + (n + 1) * step));
    sum.area += added.area_share;
    sum.outside += added.outside_share;
    sum.off = std::max(sum.off, added.off_m);
  }
  return sum;
}

TEST(CutLine, AWholeCutClosesItAndOnlyAWholeOne) {
  CutLine line(kCircle, kBand);
  EXPECT_NEAR(line.round_m(), 2 * kPi * 0.020, 1e-4);
  cut_in(line);
  EXPECT_FALSE(line.closed());
  EXPECT_NEAR(line.uncut_from_m(), line.way_in_m(), 1e-9);
  cut_round(line, 0.020, 0, kPi);
  EXPECT_FALSE(line.closed());
  EXPECT_NEAR(line.uncut_from_m() - line.way_in_m(), kPi * 0.020, 0.0025);
  cut_round(line, 0.020, kPi, 2 * kPi);
  EXPECT_TRUE(line.closed());
}

TEST(CutLine, TheWayInIsCutWhereTheGauzeHasPartedAheadOfTheBlades) {
  for (const bool rim : {false, true}) {
    CutLine line(kCircle, kBand);
    line.add({0, -0.047}, {0, -0.026});
    EXPECT_LT(line.uncut_from_m(), line.way_in_m()) << "3 mm before the circle";
    line.add({0, -0.0235}, {0, -0.0195}, rim);
    EXPECT_EQ(line.uncut_from_m() >= line.way_in_m(), rim) << "2.5 mm between the cuts: gauze that holds, or none";
  }
}

TEST(CutLine, CutsMeetWhereTheGauzeBetweenThemHasParted) {
  const auto at = [](double arc_m) -> Eigen::Vector2d {
    return 0.020 * Eigen::Vector2d(std::cos(arc_m / 0.020 - kPi / 2), std::sin(arc_m / 0.020 - kPi / 2));
  };
  const auto left_over = [&](double gap_m, bool rim) {
    CutLine line(kCircle, kBand);
    cut_in(line);
    const double met = 0.060;
    cut_round(line, 0.020, 0, (met - gap_m) / 0.020);
    line.add(at(met), at(met + 0.004), rim, false);
    cut_round(line, 0.020, (met + 0.004) / 0.020, 2 * kPi);
    return !line.closed();
  };
  EXPECT_FALSE(left_over(0.0010, false)) << "threads";
  EXPECT_TRUE(left_over(0.0022, false)) << "the blades ended there, the gauze goes on";
  EXPECT_FALSE(left_over(0.0022, true)) << "the gauze ended there";
  EXPECT_TRUE(left_over(0.0045, true)) << "too far for one gap";

  CutLine line(kCircle, kBand);  // a cut that does not reach the older one, and one beside it that finds the gap
  cut_in(line);
  cut_round(line, 0.020, 0, 0.058 / 0.020);
  line.add(at(0.0602), at(0.0642));
  cut_round(line, 0.020, 0.0642 / 0.020, 2 * kPi);
  EXPECT_FALSE(line.closed());
  line.add(at(0.0604), at(0.0614), true, true);
  EXPECT_TRUE(line.closed());
}

TEST(CutLine, TheAreaIsThatBetweenTwoCircles) {
  for (const double radius : {0.019, 0.0195, 0.021, 0.022}) {
    CutLine line(kCircle, kBand);
    const double exact = std::abs(radius * radius - 0.020 * 0.020) / (0.020 * 0.020);
    EXPECT_NEAR(cut_round(line, radius).area, exact, 0.012) << "chords of 4 mm lie 0.1 mm within their circle";
  }
}

TEST(CutLine, OutsideIsWhatLiesBeyondTheBand) {
  CutLine near(kCircle, kBand), far(kCircle, kBand);
  EXPECT_EQ(cut_round(near, 0.0215).outside, 0);
  const Sum sum = cut_round(far, 0.0225);
  EXPECT_NEAR(sum.outside, 0.0225 / 0.020, 0.01);
  EXPECT_NEAR(sum.off, 0.0025, 1e-4);
}

TEST(CutLine, ASecondCutMendsNothing) {
  CutLine line(kCircle, kBand);
  EXPECT_GT(cut_round(line, 0.022).area, 0.19);
  EXPECT_EQ(cut_round(line, 0.020).area, 0) << "nearer: neither better nor worse";
  const double worse = cut_round(line, 0.0175).area;
  EXPECT_GT(worse, 0) << "further off on the other side: worse";
}

TEST(CutLine, TheWayInIsNeverOffTheLine) {
  CutLine line(kCircle, kBand);
  const Sum sum = cut_in(line, 0.003);
  EXPECT_EQ(sum.area, 0);
  EXPECT_EQ(sum.outside, 0);
  CutLine across(kCircle, kBand);
  EXPECT_GT(across.add({-0.0025, -0.026}, {0.0025, -0.026}).outside_share, 0) << "across it a cut is";
}

TEST(CutLine, OfAnEllipseTheDistanceIsSquareToIt) {
  const GauzeLine ellipse{0.023, 0.017, 0, -kPi / 2, 0.027, -1};
  CutLine line(ellipse, 0.001);
  EXPECT_NEAR(line.round_m(), kPi * (3 * 0.040 - std::sqrt((3 * 0.023 + 0.017) * (0.023 + 3 * 0.017))), 2e-4)
      << "Ramanujan's first";
  EXPECT_NEAR(line.add({0.0243, -0.001}, {0.0243, 0.001}).off_m, 0.0013, 1e-4);
  EXPECT_NEAR(line.add({-0.001, 0.0175}, {0.001, 0.0175}).off_m, 0.0005, 1e-4);
}

TEST(CutLine, WhatLiesFarFromTheLineDoesNotCutIt) {
  CutLine line(kCircle, kBand);
  cut_in(line);
  cut_round(line, 0.007);
  EXPECT_NEAR(line.uncut_from_m(), line.way_in_m(), 1e-9);
}

}  // namespace
}  // namespace trocar::cut_line_test
