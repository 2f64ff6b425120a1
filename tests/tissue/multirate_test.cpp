// The loop and the tissue at their own rates: no energy comes out that nobody put in, the steady force is that of the
// tissue, nothing is felt of the steps, and a late patch harms nothing (tissue.md 2.5).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/tissue/solid/soft_organ_rig.h"

namespace trocar::multirate_test {
namespace {

using test::from_above;
using test::SoftHand;
using test::SoftScene;
using test::SoftSceneOptions;

constexpr double kX = 0.008, kY = 0.005;  // beside the pole: a slope of its own

SoftSceneOptions scene(double young_pa, int period_ticks, int delay_ticks) {
  SoftSceneOptions options;
  options.material.young_pa = young_pa;
  options.material.mu_static = 0.1;
  options.material.mu_dynamic = 0.05;
  options.organ.solid.edge_m = 0.01;
  options.period_ticks = period_ticks;
  options.delay_ticks = delay_ticks;
  return options;
}

struct Felt {
  double hold_n = 0, solid_n = 0;       ///< mean while the hand holds still: in the loop and in the solid
  double ripple_n = 0, step_n = 0;      ///< there; largest change in 1 ms of the whole
  double most_n = 0, out_j = 0;
};

/// Press in 1 s, hold 1 s, 2 Hz to and fro for 1.5 s, let go.
Felt press(const SoftSceneOptions& options, bool light, double deep_m, double encoder_m = 0) {
  SoftScene s(options);
  const double top = s.touching_z(kX, kY) + 1e-3;
  SoftHand hand = light ? SoftHand::light(top) : SoftHand::firm(top);
  Felt felt;
  std::vector<double> held;
  double last = 0;
  for (int k = 0; k < 4000; ++k) {
    const double t = 1e-3 * k;
    const double down = t < 1 ? deep_m * t : t < 3.5 ? deep_m : std::max(0.0, deep_m * (1 - 3 * (t - 3.5)));
    const double wave = t > 2 && t < 3.5 ? 0.25 * deep_m * std::sin(4 * std::numbers::pi * (t - 2)) : 0;
    const double z = encoder_m > 0 ? encoder_m * std::round(hand.z / encoder_m) : hand.z;
    const double force = s.tick(from_above({kX, kY, z}), {0, 0, hand.speed}).F_I_T.force.z();
    felt.step_n = std::max(felt.step_n, std::abs(force - last));
    felt.most_n = std::max(felt.most_n, force);
    last = force;
    hand.move(top - down + wave, force);
    if (t >= 1.6 && t < 2) {
      held.push_back(force);
      felt.solid_n += s.organ().force_n() / 400;
    }
  }
  for (const double f : held) felt.hold_n += f / double(held.size());
  for (const double f : held) felt.ripple_n = std::max(felt.ripple_n, std::abs(f - felt.hold_n));
  felt.out_j = hand.most_out_j;
  return felt;
}

TEST(MultiRate, AllGripsTissuesRatesAndDelays) {
  for (const double young : {5000.0, 50000.0})
    for (const bool light : {false, true})
      for (const int period : {5, 10, 20})
        for (const int delay : {0, 5, 10}) {
          const Felt felt = press(scene(young, period, delay), light, light ? 0.012 : 0.010);
          const std::string which = std::to_string(int(young)) + " Pa, " + (light ? "light" : "firm") + " grip, step " +
                                    std::to_string(period) + " ms, delay " + std::to_string(delay) + " ms";
          std::printf("%s: hold %.4f solid %.4f N (%.2f %%) ripple %.4f step %.4f (at 1 N %.4f) out %.4f mJ\n", which.c_str(),
                      felt.hold_n, felt.solid_n, 100 * (felt.hold_n / felt.solid_n - 1), felt.ripple_n, felt.step_n,
                      felt.step_n / std::max(1.0, felt.most_n), 1e3 * felt.out_j);
          EXPECT_LT(felt.out_j, 5e-5) << which;
          EXPECT_NEAR(felt.hold_n, felt.solid_n, 0.03 * felt.solid_n) << which;
          EXPECT_LT(felt.ripple_n, 0.05) << which;
          EXPECT_LT(felt.step_n, 0.03 * std::max(1.0, felt.most_n)) << which;
        }
}

}  // namespace
}  // namespace trocar::multirate_test
