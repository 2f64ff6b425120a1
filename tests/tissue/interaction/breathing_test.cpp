// The bed breathes without a jump, and what lies on it goes along and is felt to.
#include "tissue/interaction/breathing.h"

#include <gtest/gtest.h>

#include "tests/tissue/solid/soft_organ_rig.h"

namespace trocar::breathing_test {
namespace {

using test::from_above;
using test::SoftScene;
using test::SoftSceneOptions;

constexpr Breathing kVentilated{14, 0.004, 0, 0};

TEST(Breathing, IsSmallPeriodicAndAlwaysTheSameWay) {
  const double period = 60.0 / 14;
  for (double t = 0; t < 6; t += 0.05) {
    const Vec3 shift = bed_shift(kVentilated, t);
    EXPECT_LE(shift.norm(), 0.0041);
    EXPECT_LE(shift.y(), 0);
    EXPECT_LT((shift - bed_shift(kVentilated, t + period)).norm(), 1e-9);
    EXPECT_LT((bed_shift(kVentilated, t + 0.01) - shift).norm(), 1.2e-4);  // no jump where one breath meets the next
  }
  EXPECT_EQ(bed_shift({}, 3.3), Vec3::Zero());
}

TEST(Breathing, TheHeartLiftsOnceABeat) {
  const Breathing heart{0, 0, 60, 0.001};
  EXPECT_NEAR(bed_shift(heart, 0.2).z(), 0.001, 1e-9);
  EXPECT_NEAR(bed_shift(heart, 0.5).z(), 0, 1e-12);
  EXPECT_NEAR(bed_shift(heart, 7.2).z(), 0.001, 1e-9);
}

TEST(Breathing, AnOrganGoesAlongWithItsBedAndGivesNoEnergyThatItWasLent) {
  SoftScene s(SoftSceneOptions{});
  const Vec3 shift(0, -0.003, -0.002);
  s.organ().carry(shift);
  double given = 0;
  for (int i = 0; i < 400; ++i) {
    s.organ().step({}, nullptr);
    given += s.organ().given_j();
  }
  const auto& now = s.organ().surface()->vertices;
  const auto& rest = s.organ().rest()->vertices;
  for (std::size_t v = 0; v < rest.size(); v += 97) EXPECT_LT((now[v] - rest[v] - shift).norm(), 2e-5) << v;
  // All that the bed put in is lost again: the work of its move.
  SoftScene other(SoftSceneOptions{});
  const double before = other.organ().solid().energy_j();
  other.organ().carry(shift);
  EXPECT_NEAR(given, other.organ().solid().energy_j() - before, 0.02 * given);
}

TEST(Breathing, UnderAToolThatHoldsStillTheForceSwellsWithoutASteps) {
  SoftSceneOptions options;
  options.material.young_pa = 5000;
  SoftScene s(options);
  const double z = s.touching_z(0, 0) - 0.012;
  double least = 1e9, most = 0, step = 0, last = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    const double t = 1e-3 * tick;
    s.organ().carry(bed_shift(kVentilated, t > 1.5 ? t - 1.5 : 0));
    const double down = std::min(1.0, t) * 0.012;
    const double force = s.tick(from_above({0, 0, z + 0.012 - down}), {0, 0, t < 1 ? -0.012 : 0}).F_I_T.force.norm();
    if (t > 1.5) {
      step = std::max(step, std::abs(force - last));
      least = std::min(least, force);
      most = std::max(most, force);
    }
    last = force;
  }
  RecordProperty("swell_n", std::to_string(most - least));
  RecordProperty("step_n_per_ms", std::to_string(step));
  EXPECT_GT(most - least, 0.05);  // 2.6 mm of depth come and go
  EXPECT_LT(step, 0.03);
}

}  // namespace
}  // namespace trocar::breathing_test
