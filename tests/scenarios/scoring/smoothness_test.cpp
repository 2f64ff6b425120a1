// Published golden values of the smoothness measures, minimum-jerk figures, peaks, runs and tremor.
#include "scenarios/scoring/smoothness.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace trocar::smoothness_test {
namespace {

/// exp(-5 t^2), t = -1 .. 0.99 in steps of 0.01: the example of the SPARC authors' code.
std::vector<double> golden_speed() {
  std::vector<double> speed;
  for (int i = 0; i < 200; ++i) {
    const double t = -1 + 0.01 * i;
    speed.push_back(std::exp(-5 * t * t));
  }
  return speed;
}

std::vector<double> minimum_jerk_speed(int repeats, double ripple = 0) {
  std::vector<double> speed;
  for (int r = 0; r < repeats; ++r) {
    for (int i = r == 0 ? 0 : 1; i <= 1000; ++i) {
      const double s = i / 1000.0;
      speed.push_back(30 * s * s * (1 - s) * (1 - s) + ripple * std::sin(2 * std::numbers::pi * 9 * s));
    }
  }
  return speed;
}

TEST(Smoothness, ReproducesTheGoldenValues) {
  EXPECT_NEAR(*spectral_arc_length(golden_speed(), 100), -1.41403, 5e-6);
  EXPECT_NEAR(*dimensionless_jerk(golden_speed(), 100), -335.74684, 5e-6);
  EXPECT_NEAR(*log_dimensionless_jerk(golden_speed(), 100), -5.81636, 5e-6);
}

TEST(Smoothness, ReproducesTheMinimumJerkFigures) {
  EXPECT_NEAR(*spectral_arc_length(minimum_jerk_speed(1), 1000), -1.4024, 5e-5);
  // Exact: 720 / 1.875^2 = 204.8. Published from samples: 203.14 (-5.314); how the ends are differenced makes 1 %.
  EXPECT_NEAR(-*dimensionless_jerk(minimum_jerk_speed(1), 1000), 720 / (1.875 * 1.875), 0.01 * 204.8);
  EXPECT_NEAR(-*dimensionless_jerk(minimum_jerk_speed(1), 1000), 203.14, 0.01 * 203.14);
  EXPECT_NEAR(*log_dimensionless_jerk(minimum_jerk_speed(1), 1000), -5.314, 0.01);
  EXPECT_NEAR(*spectral_arc_length(minimum_jerk_speed(2), 1000), -2.2496, 5e-3);
  EXPECT_NEAR(*spectral_arc_length(minimum_jerk_speed(5), 1000), -3.3622, 2e-2);  // joins counted once here
}

TEST(Smoothness, FallsWithSubmovementsAndRipple) {
  const double one = *spectral_arc_length(minimum_jerk_speed(1), 1000);
  const double two = *spectral_arc_length(minimum_jerk_speed(2), 1000);
  const double five = *spectral_arc_length(minimum_jerk_speed(5), 1000);
  EXPECT_GT(one, two);
  EXPECT_GT(two, five);
  EXPECT_GT(one, *spectral_arc_length(minimum_jerk_speed(1, 0.2), 1000));
  EXPECT_GT(*log_dimensionless_jerk(minimum_jerk_speed(1), 1000),
            *log_dimensionless_jerk(minimum_jerk_speed(1, 0.2), 1000));
}

TEST(Smoothness, DoesNotDependOnTheUnitOfSpeed) {
  std::vector<double> fast = golden_speed();
  for (double& value : fast) value *= 1000;
  EXPECT_NEAR(*spectral_arc_length(fast, 100), *spectral_arc_length(golden_speed(), 100), 1e-12);
  EXPECT_NEAR(*dimensionless_jerk(fast, 100), *dimensionless_jerk(golden_speed(), 100), 1e-9);
}

TEST(Smoothness, IsUndefinedForRest) {
  EXPECT_FALSE(spectral_arc_length(std::vector<double>(100, 0.0), 100));
  EXPECT_FALSE(dimensionless_jerk(std::vector<double>(100, 0.0), 100));
  EXPECT_FALSE(log_dimensionless_jerk({1, 1}, 100));
  EXPECT_FALSE(log_dimensionless_jerk(std::vector<double>(100, 0.3), 100)) << "no jerk: the logarithm has no value";
  EXPECT_FALSE(normalised_squared_jerk(std::vector<Vec3>(50, Vec3(1, 2, 3)), 100));
}

TEST(Smoothness, NormalisedJerkOfTheMinimumJerkMovementIsNearIts720) {
  std::vector<Vec3> position;
  for (int i = 0; i <= 1000; ++i) {
    const double s = i / 1000.0;
    position.push_back(Vec3(0.03, 0.04, 0) * (s * s * s * (10 + s * (-15 + 6 * s))));
  }
  EXPECT_NEAR(*normalised_squared_jerk(position, 1000), 720, 7.2);  // third differences lose 1 % at the ends
}

TEST(Peaks, CountsThoseThatStandOut) {
  EXPECT_EQ(count_peaks({0, 1, 0, 1, 0}, 0.5), 2);
  EXPECT_EQ(count_peaks({0, 1, 0.8, 1.2, 0}, 0.5), 1) << "the lower of two close tops does not stand out";
  EXPECT_EQ(count_peaks({0, 1, 1, 1, 0}, 0.5), 1) << "a plateau is one peak";
  EXPECT_EQ(count_peaks({0, 1, 2, 3}, 0.5), 0) << "a rise without a fall is none";
  EXPECT_EQ(count_peaks({0, 0.4, 0}, 0.5), 0);
  EXPECT_EQ(count_peaks({}, 0.5), 0);
}

TEST(Runs, FindsStretchesOfAtLeastTheWantedLength) {
  const std::vector<double> signal = {5, 5, 0, 5, 5, 5};
  const auto above = runs(signal, 1, 3);
  ASSERT_EQ(above.size(), 1u);
  EXPECT_EQ(above[0], (std::pair<std::size_t, std::size_t>{3, 6}));
  EXPECT_EQ(runs(signal, 1, 2).size(), 2u);
  EXPECT_EQ(runs(signal, 1, 1, true).size(), 1u);
  EXPECT_TRUE(runs({}, 1, 1).empty());
}

TEST(Tremor, MeasuresASineOfKnownSize) {
  for (const double frequency : {9.0, 10.0, 11.0}) {
    std::vector<Vec3> position;
    for (int i = 0; i < 8000; ++i) {
      const double t = i / 1000.0;
      position.push_back(Vec3(0.05 * t, 0.05e-3 * std::sqrt(2.0) * std::sin(2 * std::numbers::pi * frequency * t), 0));
    }
    EXPECT_NEAR(tremor(position, 1000)->rms_m, 0.05e-3, 0.05e-5) << frequency;
  }
}

TEST(Tremor, SeesNothingInSlowMotionAndNothingOutsideTheBand) {
  std::vector<Vec3> slow, fast;
  for (int i = 0; i < 8000; ++i) {
    const double t = i / 1000.0;
    slow.push_back(Vec3(0.02 * std::sin(2 * std::numbers::pi * 0.5 * t), 0, 0));
    fast.push_back(Vec3(0, 1e-4 * std::sin(2 * std::numbers::pi * 25 * t), 0));
  }
  EXPECT_LT(tremor(slow, 1000)->rms_m, 1e-6);
  EXPECT_LT(tremor(slow, 1000)->power_share, 1e-6);
  EXPECT_LT(tremor(fast, 1000)->rms_m, 1e-7);
  EXPECT_FALSE(tremor(std::vector<Vec3>(500, Vec3::Zero()), 1000)) << "half a second is too short";
  EXPECT_EQ(tremor(std::vector<Vec3>(2000, Vec3::Zero()), 1000)->rms_m, 0);
}

}  // namespace
}  // namespace trocar::smoothness_test
