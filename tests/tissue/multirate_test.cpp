// The loop and the tissue at their own rates: no energy comes out that nobody put in, the steady force is that of the
// tissue, nothing is felt of the steps, and a late patch harms nothing (tissue.md 2.5).
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/haptics/contact/surfaces.h"
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
  options.half_m = {0.05, 0.045, 0.03};
  options.rows = 28;
  options.organ.solid.edge_m = 0.0125;
  options.period_ticks = period_ticks;
  options.delay_ticks = delay_ticks;
  return options;
}

struct Felt {
  double hold_n = 0, solid_n = 0;   ///< mean while the hand holds still: in the loop and in the solid
  double ripple_n = 0, step_n = 0;  ///< there; largest change in 1 ms of the whole
  double most_n = 0, out_j = 0;
};

/// Press in 0.6 s, hold 0.6 s, 2 Hz to and fro for 1 s, let go.
Felt press(const SoftSceneOptions& options, bool light, double deep_m, double encoder_m = 0) {
  SoftScene s(options);
  const double top = s.touching_z(kX, kY) + 1e-3;
  SoftHand hand = light ? SoftHand::light(top) : SoftHand::firm(top);
  Felt felt;
  std::vector<double> held;
  double last = 0;
  for (int k = 0; k < 2600; ++k) {
    const double t = 1e-3 * k;
    const double down = t < 0.6 ? deep_m * t / 0.6 : t < 2.2 ? deep_m : std::max(0.0, deep_m * (1 - 3 * (t - 2.2)));
    const double wave = t > 1.2 && t < 2.2 ? 0.25 * deep_m * std::sin(4 * std::numbers::pi * (t - 1.2)) : 0;
    const double z = encoder_m > 0 ? encoder_m * std::round(hand.z / encoder_m) : hand.z;
    const double force = s.tick(from_above({kX, kY, z}), {0, 0, hand.speed}).F_I_T.force.z();
    felt.step_n = std::max(felt.step_n, std::abs(force - last));
    felt.most_n = std::max(felt.most_n, force);
    last = force;
    hand.move(top - down + wave, force);
    if (t >= 0.9 && t < 1.2) {
      held.push_back(force);
      felt.solid_n += s.organ().force_n() / 300;
    }
  }
  for (const double f : held) felt.hold_n += f / double(held.size());
  for (const double f : held) felt.ripple_n = std::max(felt.ripple_n, std::abs(f - felt.hold_n));
  felt.out_j = hand.most_out_j;
  return felt;
}

TEST(MultiRate, AllGripsTissuesRatesAndDelays) {
  Felt worst;  // hold_n: its error, relative
  for (const double young : {5000.0, 50000.0})
    for (const bool light : {false, true})
      for (const int period : {5, 10, 20})
        for (const int delay : {0, 5, 10}) {
          const Felt felt = press(scene(young, period, delay), light, light ? 0.012 : 0.010);
          const std::string which = std::to_string(int(young)) + " Pa, " + (light ? "light" : "firm") + " grip, step " +
                                    std::to_string(period) + " ms, delay " + std::to_string(delay) + " ms";
          worst.out_j = std::max(worst.out_j, felt.out_j);
          worst.hold_n = std::max(worst.hold_n, std::abs(felt.hold_n / felt.solid_n - 1));
          worst.ripple_n = std::max(worst.ripple_n, felt.ripple_n);
          worst.step_n = std::max(worst.step_n, felt.step_n / std::max(1.0, felt.most_n));
          EXPECT_LT(felt.out_j, 5e-5) << which;
          EXPECT_NEAR(felt.hold_n, felt.solid_n, 0.03 * felt.solid_n) << which;
          EXPECT_LT(felt.ripple_n, 0.05) << which;
          EXPECT_LT(felt.step_n, 0.03 * std::max(1.0, felt.most_n)) << which;
        }
  RecordProperty("out_mj", std::to_string(1e3 * worst.out_j));
  RecordProperty("steady_error_pct", std::to_string(100 * worst.hold_n));
  RecordProperty("ripple_n", std::to_string(worst.ripple_n));
  RecordProperty("step_at_1_n", std::to_string(worst.step_n));
}

/// Tissue stiffer than the loop renders: it is felt as stiff as that, and does not swing.
TEST(MultiRate, NoTissueIsTooStiff) {
  for (const double young : {150000.0, 300000.0})
    for (const bool light : {false, true}) {
      const Felt felt = press(scene(young, 10, 5), light, light ? 0.012 : 0.010);
      const std::string which = std::to_string(int(young)) + " Pa, " + (light ? "light" : "firm") + " grip";
      EXPECT_LT(felt.out_j, 5e-5) << which;
      EXPECT_NEAR(felt.hold_n, felt.solid_n, 0.03 * felt.solid_n) << which;
      EXPECT_LT(felt.ripple_n, 0.05) << which;
      EXPECT_LT(felt.step_n, 0.03 * std::max(1.0, felt.most_n)) << which;
    }
}

/// The tool straight down to `deep_m` in 0.6 s and held there.
double depth_at(double t, double deep_m) { return std::min(1.0, t / 0.6) * deep_m; }

TEST(MultiRate, AStalledOrganHarmsNothing) {
  for (const double young : {5000.0, 50000.0})
    for (const int stall_ms : {10, 30, 60, 100, 200, 400}) {
      SoftScene s(scene(young, 10, 5));
      const double top = s.touching_z(kX, kY), deep = young > 1e4 ? 0.004 : 0.008;
      double last = 0, step = 0, grown = 0, at_end = 0, held = 0;
      for (int k = 0; k < 1500; ++k) {
        const int into = k - 803;  // the stall begins in the middle of a period
        const bool stalled = into >= 0 && into < stall_ms;
        const double force =
            s.tick(from_above({kX, kY, top - depth_at(1e-3 * k, deep)}), Vec3::Zero(), stalled).F_I_T.force.norm();
        step = std::max(step, std::abs(force - last));
        // The packet on its way still arrives, and is glided to: 5 and 10 ms.
        if (stalled && into > 16) grown = std::max(grown, force - last);
        if (into == 0) held = force;
        if (into == stall_ms - 1) at_end = force;
        last = force;
      }
      EXPECT_LT(step, 0.3) << stall_ms << " ms";
      EXPECT_LT(grown, 1e-6) << stall_ms << " ms: force grew without news";
      if (stall_ms >= 300) {
        EXPECT_EQ(at_end, 0) << "250 ms without news";
      }
      EXPECT_NEAR(last, held, 0.02 * held) << "and all is as before";
    }
}

TEST(MultiRate, LostPacketsAreNotFelt) {
  for (const double young : {5000.0, 50000.0}) {
    SoftSceneOptions options = scene(young, 10, 5);
    options.material.prony = {PronyBranch{0.35, 0.1}, PronyBranch{0.25, 5}};
    SoftScene s(options);
    const double top = s.touching_z(kX, kY) + 1e-3;
    SoftHand hand = SoftHand::firm(top);
    std::mt19937 random(3);
    double last = 0, step = 0, most = 0;
    for (int k = 0; k < 4000; ++k) {
      const double t = 1e-3 * k, down = 0.005 - 0.005 * std::cos(5 * t);
      const bool lost = k % 10 == 0 && random() % 10 < 4;
      const double force = s.tick(from_above({kX, kY, hand.z}), {0, 0, hand.speed}, false, lost).F_I_T.force.z();
      step = std::max(step, std::abs(force - last));
      most = std::max(most, force);
      last = force;
      hand.move(top - down, force);
    }
    RecordProperty("step_n_" + std::to_string(int(young)), std::to_string(step));
    EXPECT_GT(most, 0.15);
    EXPECT_LT(step, 0.3) << young;
    EXPECT_LT(hand.most_out_j, 5e-5) << young;
  }
}

struct Swept {
  double turn_deg = 0, rubbed_n = 0, most_n = 0;  ///< most in a millisecond; against the way; in all
};

/// Over the organ and back by 40 mm, that deep, at up to that speed; it turns round without a blow.
Swept sweep(int rows, double speed_m_s, double deep_m) {
  SoftSceneOptions options = scene(5000, 10, 5);
  options.rows = rows;
  SoftScene s(options);
  constexpr double kWay = 0.02, kPress = 0.3;  // m to either side; s
  const double rate = speed_m_s / kWay;
  Vec3 last = Vec3::Zero();
  Swept swept;
  for (int k = 0; 1e-3 * k < kPress + 2 * std::numbers::pi / rate; ++k) {
    const double t = std::max(0.0, 1e-3 * k - kPress);
    const double x = -kWay * std::cos(rate * t), speed = kWay * rate * std::sin(rate * t);
    const double deep = (deep_m + 0.001) * std::min(1.0, 1e-3 * k / kPress) - 0.001;
    const Vec3 force = s.tick(from_above({x, kY, s.touching_z(x, kY) - deep}), {speed, 0, 0}).F_I_T.force;
    // From a hundredth of a newton on a direction is felt.
    if (force.norm() > 0.01 && last.norm() > 0.01)
      swept.turn_deg = std::max(swept.turn_deg, std::atan2(force.cross(last).norm(), force.dot(last)) / kDegree);
    if (speed > 0) swept.rubbed_n = std::max(swept.rubbed_n, -force.x());
    swept.most_n = std::max(swept.most_n, force.norm());
    last = force;
  }
  return swept;
}

TEST(MultiRate, ASweepTurnsTheForceSmoothly) {
  // Facets that stand 3 and 6 deg to one another; 3 mm deep the dent is shallower than the tool's radius, 8 mm deep
  // not.
  struct Case {
    int rows;
    double speed_m_s, deep_m;
  };
  for (const auto& [rows, speed, deep] :
       {Case{64, 0.05, 0.003}, Case{28, 0.05, 0.003}, Case{28, 0.05, 0.008}, Case{28, 0.01, 0.008}}) {
    const Swept swept = sweep(rows, speed, deep);
    const std::string which = std::to_string(rows) + " rows, " + std::to_string(std::lround(1e3 * speed)) + " mm/s, " +
                              std::to_string(std::lround(1e3 * deep)) + " mm";
    RecordProperty("turn of " + which, std::to_string(swept.turn_deg));
    EXPECT_LT(swept.turn_deg, 2) << which;
    EXPECT_GT(swept.rubbed_n, 0.002) << which;
    EXPECT_GT(swept.most_n, deep > 0.005 ? 0.15 : 0.05) << which;
  }
}

/// A flat patch at that height that is glided to over 10 ms.
void plane_at(double z, ContactPatch& patch) {
  const std::uint64_t last = patch.stamp;
  test::flat_patch(patch, z, 0.04, 6);
  patch.glide_s = 0.01;
  patch.moving = true;
  patch.velocity.fill(Vec3::Zero());
  patch.follows = last;
  patch.stamp = last + 1;
  for (int v = 0; v < patch.vertex_count; ++v) patch.previous[std::size_t(v)] = std::int16_t(v);
}

/// The surface rises under a tool that waits, sinks when the tool is gone. @return work on the tool, J
double work_of_an_adversary(bool metered) {
  ContactRenderer renderer(ContactLaw::kProxy, {}, {.metered = metered});
  const auto patch = std::make_unique<ContactPatch>();
  patch->material[0] = {150, 0};
  const double touch = ToolShape{}.radius_m;
  double work = 0, last = touch + 1e-3;
  for (int k = 0; k < 20 * 400; ++k) {
    const double phase = k % 400 / 100.0;
    const auto ramp = [&](double from) { return std::clamp(phase - from, 0.0, 1.0); };
    if (k % 10 == 0) plane_at(0.003 * (ramp(0) - ramp(2)), *patch);
    const double z = touch - 0.002 + 0.007 * (ramp(1) - ramp(3));
    const double force =
        renderer.update(from_above({0, 0, z}), {{0, 0, (z - last) / 1e-3}, Vec3::Zero()}, *patch).F_I_T.force.z();
    work += force * (z - last);
    last = z;
  }
  return work;
}

TEST(MultiRate, TheSurfaceGivesNoEnergyThatNobodyPutIn) {
  const double metered = work_of_an_adversary(true), unmetered = work_of_an_adversary(false);
  RecordProperty("metered_mj", std::to_string(1e3 * metered));
  RecordProperty("unmetered_mj", std::to_string(1e3 * unmetered));
  EXPECT_GT(unmetered, 0.02) << "this one would be felt";
  EXPECT_LT(metered, GlideParameters{}.tank_j);
}

TEST(MultiRate, TheTankIsNotFeltOnTissue) {
  SoftSceneOptions options = scene(5000, 10, 5);
  const Felt metered = press(options, true, 0.012);
  options.glide.metered = false;
  const Felt unmetered = press(options, true, 0.012);
  EXPECT_NEAR(metered.hold_n, unmetered.hold_n, 1e-4);
  EXPECT_NEAR(metered.most_n, unmetered.most_n, 1e-3);
}

}  // namespace
}  // namespace trocar::multirate_test
