// Plants that cannot be are refused by table, key and reason.
#include "haptics/device/plant/plant_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "haptics/device/plant/plant_fields.h"
#include "haptics/device/simulated_daq.h"

namespace trocar::plant_check_test {
namespace {

TEST(PlantCheck, EveryDrawnDeviceCanBe) {
  EXPECT_FALSE(plant_refusal(nominal_parameters()));
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto plain = plant_refusal(draw_parameters(seed)), all = plant_refusal(draw_everything(seed));
    EXPECT_FALSE(plain) << seed << ' ' << plain->text();
    EXPECT_FALSE(all) << seed << ' ' << all->text();
  }
}

TEST(PlantCheck, NominalAndDrawnValuesLieWithinTheirBounds) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    PlantParameters p = seed == 0 ? nominal_parameters() : draw_everything(seed);
    for (const auto fields : {plant_numbers(), option_numbers()}) {
      for (const PlantNumber& f : fields) {
        EXPECT_GE(f.at(p), f.low) << f.table << ' ' << f.key;
        EXPECT_LE(f.at(p), f.high) << f.table << ' ' << f.key;
      }
    }
    for (int i = 0; i < kChannels; ++i) {
      for (const ChannelNumber& f : i == kPinchChannel ? pinch_numbers() : joint_numbers()) {
        if (f.endless && std::isinf(f.at(p, i))) continue;
        EXPECT_GE(f.at(p, i), f.low) << f.key << i;
        EXPECT_LE(f.at(p, i), f.high) << f.key << i;
      }
    }
  }
}

struct Degenerate {
  const char *table, *key, *says;
  std::function<void(PlantParameters&)> spoil;
};

class PlantCheckRefuses : public ::testing::TestWithParam<Degenerate> {};

TEST_P(PlantCheckRefuses, ByPlaceAndReason) {
  PlantParameters p = nominal_parameters();
  GetParam().spoil(p);
  const auto refusal = plant_refusal(p);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->table, GetParam().table);
  EXPECT_EQ(refusal->key, GetParam().key);
  EXPECT_NE(refusal->reason.find(GetParam().says), std::string::npos) << refusal->reason;
  SimulatedDaqConfig config;
  config.plant = p;
  EXPECT_THROW(SimulatedDaq{config}, std::invalid_argument) << "and nothing is simulated with it";
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
using P = PlantParameters;

INSTANTIATE_TEST_SUITE_P(
    Plants, PlantCheckRefuses,
    ::testing::Values(
        Degenerate{"stylus", "mass_kg", "positive", [](P& p) { p.stylus_mass = -0.1; }},
        Degenerate{"elbow_motor", "mass_kg", "positive", [](P& p) { p.platform_masses[2].mass = 0; }},
        Degenerate{"jaw", "mass_kg", "positive", [](P& p) { p.jaw_mass = 0; }},
        Degenerate{"arm", "platform_inertia_kg_m2", "positive", [](P& p) { p.platform_inertia = 0; }},
        Degenerate{"stylus", "inertia_kg_m2", "positive definite", [](P& p) { p.stylus_inertia[2] = -1e-6; }},
        Degenerate{"stylus", "inertia_kg_m2", "positive definite",
                   [](P& p) {
                     p.stylus_products = {9e-5, 0, 0};
                   }},
        Degenerate{"stylus", "inertia_kg_m2", "sum of the others",
                   [](P& p) {
                     p.stylus_inertia = {8e-5, 1e-5, 1e-5};
                   }},
        Degenerate{"stylus", "com_m", "finite", [](P& p) { p.stylus_com[1] = kNan; }},
        Degenerate{"arm", "link1_m", "home", [](P& p) { p.link1 = 0.120; }},
        Degenerate{"arm", "gravity_m_s2", "finite", [](P& p) { p.gravity = kNan; }},
        Degenerate{"electronics", "dac_full_scale_v", "positive", [](P& p) { p.dac_full_scale = 0; }},
        Degenerate{"electronics", "counts_per_turn", "positive", [](P& p) { p.counts_per_turn = 0; }},
        Degenerate{"electronics", "amplifier_tau_s", "positive", [](P& p) { p.amplifier_time_constant = 0; }},
        Degenerate{"th4", "coulomb_n_m", "negative", [](P& p) { p.channel[3].friction.coulomb = -0.01; }},
        Degenerate{"th1", "stribeck_ratio", "breakaway", [](P& p) { p.channel[0].friction.stribeck_ratio = 0.9; }},
        Degenerate{"th2", "ratio", "positive", [](P& p) { p.channel[1].ratio = 0; }},
        Degenerate{"th3", "resistance_ohm", "positive", [](P& p) { p.channel[2].resistance = 0; }},
        Degenerate{"th5", "stop_upper_rad", "above",
                   [](P& p) { std::swap(p.channel[4].stop.lower, p.channel[4].stop.upper); }},
        Degenerate{"th1", "stop_upper_rad", "home pose", [](P& p) { p.channel[0].stop.upper = 0.5; }},
        Degenerate{"pinch", "coulomb_n", "negative", [](P& p) { p.channel[kPinchChannel].friction.coulomb = -1; }},
        Degenerate{"jaw", "jig_opening_m", "stops", [](P& p) { p.jig_jaw_opening = 0.05; }},
        Degenerate{"cable", "damping_n_m_s_per_rad", "negative", [](P& p) { p.options.cable[0].damping = -1; }},
        Degenerate{"cable", "friction_on_motor", "at most 1", [](P& p) { p.options.cable[5].friction_on_motor = 2; }},
        Degenerate{"encoder", "missed_per_edge", "at most 1", [](P& p) { p.options.encoder.missed_per_edge = 1.5; }},
        Degenerate{"heat", "winding_time_s", "positive", [](P& p) { p.options.heat.winding_time = 0; }},
        Degenerate{"delay", "jitter_periods", "0 to 63", [](P& p) { p.options.jitter_periods = -1; }}));

TEST(DrawEverything, LeavesWhatTheSeedDrawsTodayAsItIs) {
  const PlantParameters plain = draw_parameters(9), all = draw_everything(9);
  EXPECT_EQ(plain.jig_error, all.jig_error);
  EXPECT_EQ(plain.stylus_mass, all.stylus_mass);
  EXPECT_EQ(plain.channel[2].friction.coulomb, all.channel[2].friction.coulomb);
  EXPECT_EQ(plain.channel[4].encoder_offset_counts, all.channel[4].encoder_offset_counts);
}

TEST(DrawEverything, DrawsWhatSeedsLeaveNominal) {
  const PlantParameters nominal = nominal_parameters();
  double ratio = 0, kt = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const PlantParameters p = draw_everything(seed);
    EXPECT_NE(p.leg_stop, nominal.leg_stop);
    EXPECT_NE(p.stylus_inertia[2], nominal.stylus_inertia[2]);
    EXPECT_NE(p.amplifier_time_constant, nominal.amplifier_time_constant);
    for (const ChannelParameters& c : p.channel) {
      EXPECT_GE(c.friction.stribeck_ratio, 1);
      EXPECT_NEAR(c.resistance / (&c == &p.channel[kPinchChannel] ? 4.0 : 2.32), 1, 0.08);
      ratio += std::log(c.friction.bristle_length) / 700;
      kt = std::max(kt, std::abs(c.torque_constant / 0.0232 - 1));
    }
  }
  EXPECT_LE(kt, 0.05);
  EXPECT_GT(kt, 0.04) << "of 700 draws one comes near the edge";
  const double mean_log = (6 * std::log(1e-3) + std::log(1e-5)) / 7;
  EXPECT_NEAR(ratio, mean_log, 4 * 0.3 / std::sqrt(700.0)) << "four standard errors";
}

}  // namespace
}  // namespace trocar::plant_check_test
