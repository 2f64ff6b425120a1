// The chain between what the tick computes and what leaves it, in its order: finite check, limit springs, singularity,
// heat, clamp, rate, soft start, small force at arming, latch. As properties of the whole loop: whatever comes in, what
// goes out keeps to them.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/haptics/loop_rig.h"

namespace trocar::safety_chain_order_test {
namespace {

using test::LoopRig;
using test::Random;
using test::working_pose;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Pressing into a floor with the jaws on a block: every stage has something to do.
void press(LoopRig& rig) {
  rig.start();
  rig.move(working_pose(), 1.0);
  rig.put_floor(0.002, 150);
  rig.patch->grip = {0.012, 500};
  rig.squeeze(0.010, 0.2);
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.4);
  ASSERT_EQ(rig.record.stylus.loop, LoopState::kActive) << fault_name(rig.record.stylus.fault.code);
  ASSERT_TRUE(rig.record.stylus.contact);
  ASSERT_GT(rig.record.stylus.grip_force_n, 0);
}

TEST(SafetyChain, NaNInAnythingThatTheTissueSaysStopsTheLoopInItsTick) {
  LoopRig rig;
  press(rig);
  const HapticLoop ready = rig.loop;
  const ContactPatch clean = *rig.patch;
  const DaqSample sample = rig.daq.read();
  const std::pair<const char*, std::function<void(ContactPatch&)>> poisons[] = {
      {"stiffness", [](ContactPatch& p) { p.material[0].stiffness_n_per_m = kNaN; }},
      {"infinite stiffness",
       [](ContactPatch& p) { p.material[0].stiffness_n_per_m = std::numeric_limits<double>::infinity(); }},
      {"damping", [](ContactPatch& p) { p.material[3].damping_s_per_m = kNaN; }},
      {"static friction", [](ContactPatch& p) { p.material[0].mu_static = kNaN; }},
      {"sliding friction", [](ContactPatch& p) { p.material[0].mu_dynamic = kNaN; }},
      {"slip speed", [](ContactPatch& p) { p.material[0].stribeck_m_s = kNaN; }},
      {"block", [](ContactPatch& p) { p.grip.thickness_m = kNaN; }},
      {"block's stiffness", [](ContactPatch& p) { p.grip.stiffness_n_per_m = kNaN; }},
      {"held object", [](ContactPatch& p) { p.held.to_I.z() = kNaN; }},
      {"its radius", [](ContactPatch& p) { p.held.radius_m = kNaN; }},
      {"hold", [](ContactPatch& p) { p.hold.anchor_T.x() = kNaN; }},
      {"hold's stiffness", [](ContactPatch& p) { p.hold.stiffness_n_per_m = kNaN; }},
      {"ring", [](ContactPatch& p) { p.ring.centre_I.y() = kNaN; }},
      {"ring's count", [](ContactPatch& p) { p.ring.count = -1; }},
      {"normal", [](ContactPatch& p) { p.triangle[1].normal.z() = kNaN; }},
      {"vertex", [](ContactPatch& p) { p.vertex[2].y() = kNaN; }},
      {"velocity", [](ContactPatch& p) { p.moving = true, p.velocity.fill(Vec3::Constant(kNaN)); }},
      {"glide", [](ContactPatch& p) { p.glide_s = kNaN; }},
      {"energy", [](ContactPatch& p) { p.given_j = kNaN; }},
      {"reach", [](ContactPatch& p) { p.reach_m = kNaN; }},
      {"material", [](ContactPatch& p) { p.triangle[0].material = kMaxPatchMaterials; }},
      {"corner", [](ContactPatch& p) { p.triangle[0].corner[1] = -1; }},
      {"more triangles than there can be", [](ContactPatch& p) { p.count = kMaxPatchTriangles + 1; }},
      {"fewer than none", [](ContactPatch& p) { p.count = -1; }},
      {"more vertices than there can be", [](ContactPatch& p) { p.vertex_count = kMaxPatchVertices + 1; }}};
  for (const auto& [what, poison] : poisons) {
    HapticLoop loop = ready;
    *rig.patch = clean;
    poison(*rig.patch);
    ++rig.patch->stamp;
    TickRecord record;
    const DacFrame out = loop.tick(sample, *rig.patch, record);
    EXPECT_STREQ(fault_name(record.stylus.fault.code), "non-finite") << what;
    EXPECT_FALSE(record.amplifiers_armed) << what;
    for (const std::int32_t code : out.codes) EXPECT_EQ(code, 0) << what;
    EXPECT_TRUE(record.torque.allFinite()) << what;
    *rig.patch = clean;
    loop.tick(sample, *rig.patch, record);
    EXPECT_EQ(record.stylus.loop, LoopState::kFault) << what << ": latched";
    EXPECT_TRUE(std::isfinite(record.winding_c)) << what << ": the heat model outlives it";
  }
}

TEST(SafetyChain, WhateverComesInWhatGoesOutKeepsToItsLimits) {
  const HapticLoopConfig defaults;
  ChannelVector limit, rate = ChannelVector::Constant(defaults.torque_rate);
  rate[kPinchChannel] = defaults.pinch_force_rate;
  for (int i = 0; i < kChannels; ++i)
    limit[i] = max_joint_torque(defaults.device.transmission[static_cast<std::size_t>(i)]);
  std::uint64_t powered = 0, faded = 0, at_limit = 0, singular = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    HapticLoopConfig config;
    config.map.X_SI.R = working_pose().R.transpose() * test::tip_down(Vec3::Zero()).R;
    config.safety.max_patch_age_s = 0.2;
    HapticLoop loop(config);
    const auto patch = std::make_unique<ContactPatch>();
    DaqSample sample;
    TickRecord record;
    ChannelVector last = ChannelVector::Zero();
    std::array<double, kChannels> place{}, speed{};
    for (int k = 0; k < 6000; ++k) {
      sample.digital_in = k < 700 ? kHomeBeam : kDeadman;
      if (k > 720) {
        for (std::size_t i = 0; i < kChannels; ++i) {  // swings of any size, past the joints' limits too
          speed[i] = std::clamp(speed[i] + random.symmetric(0.6), -12.0, 12.0) - 0.002 * place[i];
          place[i] += speed[i];
          sample.counts[i] = static_cast<std::int32_t>(place[i]);
        }
        if (k % 10 == 0) {  // a tissue that is anything but tissue
          const double z = record.stylus.X_TI.p.z() + random.symmetric(0.01);
          test::flat_patch(*patch, z, 0.2, 4);
          for (ContactMaterial& m : patch->material)
            m = {std::pow(10, random.between(1, 8)), random.between(0, 50), random.unit(), 0, 0.005};
          patch->grip = {random.between(0, 0.03), std::pow(10, random.between(1, 7))};
        }
      }
      sample.elapsed_periods = random.below(400) ? 1 : 2;
      const DacFrame out = loop.tick(sample, *patch, record);
      ASSERT_TRUE(record.torque.allFinite()) << k;
      const LoopState state = record.stylus.loop;
      const bool fades = state == LoopState::kFault && is_soft(record.stylus.fault.code);
      for (int i = 0; i < kChannels; ++i) {
        ASSERT_LE(std::abs(record.torque[i]), limit[i] * (1 + 1e-9)) << "clamp, channel " << i << ", tick " << k;
        if (state == LoopState::kActive) {
          ASSERT_LE(std::abs(record.torque[i] - last[i]), rate[i] * 1e-3 * (1 + 1e-9)) << "rate, channel " << i;
        } else if (!fades) {
          ASSERT_EQ(out.codes[static_cast<std::size_t>(i)], 0) << "latch";
        }
        at_limit += std::abs(record.torque[i]) > 0.99 * limit[i];
      }
      ASSERT_TRUE(record.amplifiers_armed <= (state == LoopState::kArmed || state == LoopState::kActive || fades));
      if (state == LoopState::kFault && record.stylus.fault.tick < record.stylus.tick) {
        ASSERT_EQ(record.stylus.F_I_T.force.norm(), 0) << "no contact force in a fault";
      }
      if (record.det_a < 0.10 && state == LoopState::kActive) {
        ++singular;
        ASSERT_EQ(record.stylus.delivered_share, 0) << "faded before the clamp";
      }
      powered += state == LoopState::kActive;
      faded += fades;
      last = record.torque;
    }
  }
  EXPECT_GT(powered, 1000U) << "the loop was at work";
  EXPECT_GT(faded, 10U);
  EXPECT_GT(at_limit, 30U) << "the clamp had something to do";
  RecordProperty("powered", static_cast<int>(powered));
  RecordProperty("singular", static_cast<int>(singular));
}

TEST(SafetyChain, ALimitSpringIsClampedAndStartsSoftlyAsAllElse) {
  // A joint far beyond its limit asks for more than its motor has.
  const JointVector beyond = (JointVector() << -60, 45, 45, -60, -75, 0).finished() * kDegree;
  TorqueShares shares;
  shares.springs = limit_spring_torque(beyond, JointVector::Zero());
  ChannelVector limit = ChannelVector::Constant(0.43);
  ASSERT_GT(shares.springs[0], 2 * limit[0]);
  TorqueLimiter limiter(limit, ChannelVector::Constant(100), 1e-3);
  EXPECT_NEAR(limiter.update(shares).total[0], 0.1, 1e-12) << "100 N m/s";
  for (int k = 0; k < 20; ++k) limiter.update(shares);
  EXPECT_EQ(limiter.update(shares).total[0], limit[0]);
}

TEST(SafetyChain, ArmedWithinTheTissueItGivesNoContactForceUntilThatWouldBeSmall) {
  LoopRig rig;
  rig.start();
  rig.move(working_pose(), 1.0);
  rig.daq.press_deadman(false);
  rig.run(0.05);
  ASSERT_EQ(rig.record.stylus.loop, LoopState::kHomed);
  rig.put_floor(-0.008, 400);  // 8 mm deep when the torque comes back
  rig.daq.press_deadman(true);
  rig.run(1.5);
  ASSERT_EQ(rig.record.stylus.loop, LoopState::kActive) << fault_name(rig.record.stylus.fault.code);
  ASSERT_TRUE(rig.record.stylus.contact);
  EXPECT_EQ(rig.record.stylus.delivered_share, 0);
  EXPECT_TRUE(rig.record.warnings & bit(LoopWarning::kContactWaits)) << "and it says why";
  Pose up = rig.goal;
  up.p.z() += 0.03;
  rig.move(up, 0.5);
  EXPECT_FALSE(rig.record.warnings & bit(LoopWarning::kContactWaits));
  rig.move(working_pose(), 0.5);
  rig.run(0.3);
  ASSERT_TRUE(rig.record.stylus.contact);
  EXPECT_GT(rig.record.stylus.delivered_share, 0.1) << "felt from now on";
}

/// A motor wired the wrong way round: what should hold the arm pushes it along.
TEST(SafetyChain, AMotorOfTheWrongSignIsStopped) {
  for (int channel = 0; channel < kArmJoints; ++channel) {
    LoopRig rig;
    rig.start();
    rig.move(working_pose(), 1.0);
    double fastest = 0;
    bool off = false;
    for (int k = 0; k < 4000 && !off; ++k) {
      rig.daq.set_hand_intent(rig.goal, 0.02);
      DacFrame out = rig.loop.tick(rig.daq.read(), *rig.patch, rig.record);
      out.codes[static_cast<std::size_t>(channel)] *= -1;
      rig.daq.arm(rig.record.amplifiers_armed);
      rig.daq.write(out);
      fastest = std::max(fastest, rig.daq.plant().motion().V_BS.linear.norm());
      off = !rig.record.amplifiers_armed;
    }
    // A hand holds one such motor; what is too much for it is stopped by speed, jump or the joint's limit.
    EXPECT_LT(fastest, 2.2) << "joint " << channel + 1 << ": about the fastest that is allowed";
    EXPECT_TRUE(rig.record.torque.allFinite());
  }
}

/// Fastest that the stylus gets while a hand swings it gently, m/s.
double fastest_with(LoopRig& rig) {
  rig.start();
  rig.move(working_pose(), 1.0);
  const Pose rest = rig.goal;
  double fastest = 0;
  for (int k = 0; k < 4000; ++k) {
    rig.goal.p = rest.p + Vec3(0, 0, 0.012 * (std::cos(4e-3 * k) - 1));
    rig.tick();
    fastest = std::max(fastest, rig.daq.plant().motion().V_BS.linear.norm());
  }
  EXPECT_TRUE(rig.record.torque.allFinite());
  return fastest;
}

/// Numbers that a file or an exercise may have and no arm has: the hand feels them, nothing is thrown.
TEST(SafetyChain, WhatAFileSaysWrongIsFeltAndThrowsNothing) {
  HapticLoopConfig heavy;
  for (PlatformWeight& weight : heavy.device.platform_weights) weight.weight_n *= 10;
  heavy.device.stylus_weight_n *= 10;
  LoopRig too_heavy({}, heavy);
  EXPECT_LT(fastest_with(too_heavy), 2.2) << "ten times the weight, carried as far as the motors go";
  HapticLoopConfig weak;
  for (Transmission& t : weak.device.transmission) t.amps_per_volt /= 10;
  LoopRig too_strong({}, weak);
  EXPECT_LT(fastest_with(too_strong), 2.2) << "amplifiers ten times as strong as their file says";
  for (const double stiffness : {1e4, 1e6, 1e8}) {
    LoopRig rig;
    rig.start();
    rig.move(working_pose(), 1.0);
    rig.put_floor(0.002, stiffness);
    const Pose rest = rig.goal;
    double fastest = 0;
    for (int k = 0; k < 4000; ++k) {
      rig.goal.p = rest.p + Vec3(0, 0, 0.012 * (std::cos(4e-3 * k) - 1));
      rig.tick();
      fastest = std::max(fastest, rig.daq.plant().motion().V_BS.linear.norm());
    }
    EXPECT_LT(fastest, 2.2) << "a floor of " << stiffness << " N/m";
  }
}

TEST(SafetyChain, AContactWhoseTissueSaysNothingMoreFadesAndStopsTheLoop) {
  HapticLoopConfig config;
  config.safety.max_patch_age_s = 0.2;
  LoopRig rig({}, config);
  rig.start();
  rig.move(working_pose(), 0.1);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kFault) << "nobody has made a patch since the start";
  EXPECT_STREQ(fault_name(rig.record.stylus.fault.code), "stale-patch");
}

}  // namespace
}  // namespace trocar::safety_chain_order_test
