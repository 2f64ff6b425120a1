#include "haptics/device/plant/plant_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/device/plant/plant_random.h"

namespace trocar::plant_parameters_test {
namespace {

TEST(PlantParameters, NominalDeviceMatchesTheDerivedNumbersOfTheNotes) {
  const PlantParameters p = nominal_parameters();
  const ChannelParameters& c = p.channel[0];
  EXPECT_NEAR(c.rotor_inertia / (c.ratio * c.ratio), 1.95e-5, 1e-7);
  EXPECT_NEAR(c.resistance * c.rotor_inertia / std::pow(c.torque_constant, 2), 4.4e-3, 0.05e-3);
  EXPECT_NEAR(2 * std::numbers::pi / p.counts_per_turn * c.ratio, 7.226e-4, 1e-7);
  EXPECT_NEAR(0.037 * c.torque_constant, 0.86e-3, 1e-5);
  double weight = p.stylus_mass * p.gravity;
  for (const PlatformMass& m : p.platform_masses) weight += m.mass * p.gravity;
  EXPECT_NEAR(weight, 3.21 + 0.20 + 1.61 + 0.76, 1e-12);
}

TEST(PlantParameters, DrawsStayWithinTheirStatedBounds) {
  const PlantParameters nominal = nominal_parameters();
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const PlantParameters p = draw_parameters(seed);
    for (std::size_t i = 0; i < p.platform_masses.size(); ++i) {
      EXPECT_NEAR(p.platform_masses[i].mass / nominal.platform_masses[i].mass, 1.0, 0.03);
      EXPECT_LE((p.platform_masses[i].position_home - nominal.platform_masses[i].position_home).cwiseAbs().maxCoeff(),
                0.5e-3);
    }
    EXPECT_LE(p.jig_error.cwiseAbs().maxCoeff(), 0.05 * std::numbers::pi / 180);
    for (const ChannelParameters& c : p.channel) {
      EXPECT_NEAR(c.dac_gain, 1.0, 0.01);
      EXPECT_LE(std::abs(c.dac_offset), 5e-3);
      EXPECT_GT(c.friction.coulomb, 0);
      EXPECT_LE(std::abs(c.encoder_offset_counts), 2147483648.0);
    }
  }
}

TEST(PlantParameters, FrictionSpreadsLogNormally) {
  const double nominal = nominal_parameters().channel[0].friction.coulomb;
  double sum = 0, squares = 0;
  const int draws = 2000;
  for (int seed = 0; seed < draws; ++seed) {
    const double n = std::log(draw_parameters(static_cast<std::uint64_t>(seed)).channel[0].friction.coulomb / nominal);
    sum += n;
    squares += n * n;
  }
  const double mean = sum / draws, sigma = std::sqrt(squares / draws - mean * mean);
  EXPECT_NEAR(mean, 0.0, 4 * 0.2 / std::sqrt(draws));  // four standard errors
  EXPECT_NEAR(sigma, 0.2, 0.02);
}

TEST(PlantParameters, SeedDecidesEverything) {
  const PlantParameters a = draw_parameters(42), b = draw_parameters(42), other = draw_parameters(43);
  for (int i = 0; i < kChannels; ++i) {
    EXPECT_EQ(a.channel[i].encoder_offset_counts, b.channel[i].encoder_offset_counts);
    EXPECT_EQ(a.channel[i].friction.coulomb, b.channel[i].friction.coulomb);
    EXPECT_NE(a.channel[i].encoder_offset_counts, other.channel[i].encoder_offset_counts);
  }
  EXPECT_EQ(a.jig_error, b.jig_error);
  EXPECT_NE(a.jig_error, other.jig_error);
}

TEST(PlantRandomStream, UniformAndNormalHaveTheirMoments) {
  PlantRandom random(1);
  double mean = 0, normal_mean = 0, normal_square = 0;
  const int draws = 100000;
  for (int n = 0; n < draws; ++n) {
    const double u = random.unit();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    mean += u / draws;
    const double z = random.normal();
    normal_mean += z / draws;
    normal_square += z * z / draws;
  }
  EXPECT_NEAR(mean, 0.5, 0.004);  // four standard errors
  EXPECT_NEAR(normal_mean, 0.0, 0.013);
  EXPECT_NEAR(normal_square, 1.0, 0.018);
}

}  // namespace
}  // namespace trocar::plant_parameters_test
