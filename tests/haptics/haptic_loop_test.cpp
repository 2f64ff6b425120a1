// The whole tick on the simulated device: homing, soft start, contact, pinch, weight, determinism, replay, rates.
#include <gtest/gtest.h>

#include <cstring>

#include "haptics/control/gravity.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::haptic_loop_test {
namespace {

using test::LoopRig;
using test::working_pose;

TEST(HapticLoop, HomesArmsAndRampsUp) {
  LoopRig rig;
  rig.run(0.45);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kUnhomed);
  EXPECT_FALSE(rig.record.amplifiers_armed);
  rig.run(0.2);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kHomed) << "no hand yet";
  EXPECT_FALSE(rig.record.amplifiers_armed);
  rig.holding = true;
  rig.run(0.1);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kActive);
  EXPECT_TRUE(rig.record.amplifiers_armed);
  const double early = rig.record.torque.norm();
  rig.run(1.1);
  EXPECT_GT(rig.record.torque.norm(), 2 * early) << "torque ramps up within a second";
  EXPECT_FALSE(rig.record.stylus.fault);
}

TEST(HapticLoop, KnowsItsPoseAfterHoming) {
  LoopRig rig;
  rig.start();
  rig.move(working_pose(), 1.5);
  rig.run(0.5);
  // The jig holds the joints within 0.05 deg and a count is 0.041 deg: under 0.1 deg a joint, 0.5 mm at the tip.
  const Pose X_WS = rig.config.map.stylus_pose(rig.record.stylus.X_TI);
  EXPECT_LT((X_WS.p - rig.daq.sense().X_BS.p).norm(), 1e-3);
  EXPECT_LT(test::turn_between(X_WS.R, rig.daq.sense().X_BS.R), 0.3 * kDegree * 2);
}

TEST(HapticLoop, NoTorqueBeforeActiveAndNoCodes) {
  LoopRig rig;
  rig.keep = true;
  rig.run(0.65);
  for (const TickRecord& r : rig.records) {
    EXPECT_EQ(r.torque.norm(), 0);
    for (const std::int32_t code : r.out.codes) EXPECT_EQ(code, 0);
  }
}

TEST(HapticLoop, CarriesTheWeightInFreeAir) {
  LoopRig rig;
  rig.start();
  rig.move(working_pose(), 1.5);
  rig.run(0.5);
  const JointVector wanted = gravity_torque({}, arm_state(rig.record.q.head<kArmJoints>()));
  // Half a DAC step is 7e-6 N m; friction feed-forward is off at rest.
  EXPECT_LT((rig.record.torque.head<kArmJoints>() - wanted).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT(wanted.norm(), 0.05);
  // The device was drawn about the nominal one (masses 3 %, gain 1 %) and rubs: what the hand feels is far below the
  // weight of 5.8 N.
  Vec3 felt = Vec3::Zero();
  for (int k = 0; k < 500; ++k) {
    rig.tick();
    felt += rig.daq.sense().force_on_hand / 500;
  }
  EXPECT_LT(felt.norm(), 0.6);
}

TEST(HapticLoop, PressAtRestRendersStiffnessTimesDepth) {
  for (const double stiffness : {100.0, 150.0, 250.0}) {
    LoopRig rig;
    rig.start();
    rig.move(working_pose(), 1.5);
    rig.run(0.3);
    rig.put_floor(0.002, stiffness);
    Pose deep = rig.goal;
    deep.p.z() -= 0.012;
    rig.move(deep, 1.0);
    rig.run(1.0);
    const StylusState& s = rig.record.stylus;
    ASSERT_TRUE(s.contact) << fault_name(s.fault.code) << " of channel " << int(s.fault.channel) << " at "
                           << s.fault.tick;
    EXPECT_TRUE(s.tip_contact);
    EXPECT_FALSE(s.fault);
    EXPECT_GT(s.depth_m, 0.001);
    EXPECT_NEAR(s.F_I_T.force.z(), stiffness * s.depth_m, 1e-3 * stiffness * s.depth_m + 1e-3);
    // Delivered to the hand: 1 % for the passivity law at rest and DAC steps of 0.05 mN.
    EXPECT_NEAR(s.rendered_force_T.z(), stiffness * s.depth_m, 0.01 * stiffness * s.depth_m + 1e-3);
    EXPECT_LT(s.rendered_force_T.head<2>().norm(), 0.02 * s.rendered_force_T.z() + 1e-3);
  }
}

/// Mean of the true finger force and the true compression over half a second, jaws held at `jaw`.
struct Squeeze {
  double force = 0, compression = 0;
};
Squeeze hold(LoopRig& rig, double jaw, double thickness) {
  rig.squeeze(jaw, 1.0);
  rig.run(0.5);
  Squeeze mean;
  for (int k = 0; k < 500; ++k) {
    rig.tick();
    mean.force += rig.daq.sense().force_on_finger_n / 500;
    mean.compression += (thickness - rig.daq.sense().jaw_opening_m) / 500;
  }
  return mean;
}

TEST(HapticLoop, ToldContactsAreThoseOfTheTick) {
  LoopRig rig;
  rig.start();
  rig.move(working_pose(), 1.5);
  EXPECT_EQ(rig.loop.contacts().count, 0);
  rig.put_floor(0.002, 150);
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.5);
  const SolvedContacts& contacts = rig.loop.contacts();
  ASSERT_EQ(contacts.count, 1);
  EXPECT_GT(rig.record.stylus.F_I_T.force.norm(), 0.3);
  EXPECT_LT((contacts.at[0].force_T - rig.record.stylus.F_I_T.force).norm(), 1e-14);
  const Vec3 place = interpolate(contacts.at[0].place.weight, rig.patch->corners(contacts.at[0].place.triangle));
  EXPECT_LT((place - rig.record.stylus.contact_point_T).norm(), 1e-12);
  rig.holding = false;
  rig.daq.release_hand();
  rig.run(0.3);
  EXPECT_EQ(rig.loop.contacts().count, 0) << "the hand has let go: nothing is felt";
}

TEST(HapticLoop, PinchBlockFeelsItsStiffnessAtTheFingers) {
  constexpr double kThickness = 0.012;
  for (const double stiffness : {300.0, 600.0, 1000.0, 2000.0}) {
    LoopRig rig;
    rig.start();
    rig.patch->grip = {kThickness, stiffness};
    // From both sides to about the same squeeze; the mean takes the slide's friction out.
    const double squeeze = 2.0 / stiffness + 0.003;
    hold(rig, kThickness - 0.5 * squeeze, kThickness);
    const Squeeze closing = hold(rig, kThickness - squeeze, kThickness);
    hold(rig, kThickness - 1.5 * squeeze, kThickness);
    const Squeeze opening = hold(rig, kThickness - squeeze, kThickness);
    ASSERT_FALSE(rig.record.stylus.fault) << fault_name(rig.record.stylus.fault.code);
    const double force = 0.5 * (closing.force + opening.force);
    const double wanted = stiffness * 0.5 * (closing.compression + opening.compression);
    // Budget: 5 %, through the whole chain, mean of approaches from both sides.
    EXPECT_NEAR(force, wanted, 0.05 * wanted) << stiffness << " N/m";
    EXPECT_GT(wanted, 0.5);
  }
}

TEST(HapticLoop, EveryRateHomesPressesAndStaysQuiet) {
  for (const double rate : {1000.0, 2000.0, 4000.0}) {
    SimulatedDaqConfig device;
    device.rate_hz = rate;
    LoopRig rig(device);
    rig.start();
    rig.move(working_pose(), 1.5);
    rig.run(0.2);
    rig.put_floor(0.002, 150);
    Pose deep = rig.goal;
    deep.p.z() -= 0.010;
    rig.move(deep, 0.5);
    rig.run(0.7);
    const StylusState& s = rig.record.stylus;
    EXPECT_EQ(s.loop, LoopState::kActive) << rate << " Hz: " << fault_name(s.fault.code);
    EXPECT_NEAR(s.t_s, rig.daq.time_s(), 1e-9) << rate;
    EXPECT_NEAR(s.rendered_force_T.z(), 150 * s.depth_m, 0.01 * 150 * s.depth_m + 1e-3) << rate << " Hz";
    EXPECT_GT(s.depth_m, 0.001);
  }
}

TEST(HapticLoop, ReleaseOfTheHandSwitchesOff) {
  LoopRig rig;
  rig.start();
  rig.move(working_pose(), 1.0);
  rig.holding = false;
  rig.daq.release_hand();
  rig.tick();
  rig.tick();
  EXPECT_FALSE(rig.record.amplifiers_armed);
  EXPECT_EQ(rig.record.stylus.loop, LoopState::kHomed);
  EXPECT_EQ(rig.record.torque.norm(), 0);
}

/// A run with contact, pinch and a slip off the surface; every record kept.
std::vector<TickRecord> eventful_run(LoopRig& rig) {
  rig.keep = true;
  rig.start();
  rig.move(working_pose(), 1.0);
  rig.run(0.5);
  rig.put_floor(0.002, 150);
  rig.patch->grip = {0.012, 500};
  rig.squeeze(0.009, 0.2);
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.3);
  Pose aside = deep;
  aside.p += Vec3(0.015, 0.01, 0);
  rig.move(aside, 0.5);
  return rig.records;
}

/// All numbers of a record, for comparison bit by bit.
std::vector<double> numbers(const TickRecord& r) {
  std::vector<double> n{double(r.amplifiers_armed), r.det_a, r.winding_c, r.contact_scale, r.stored_j, r.min_energy_j};
  for (int i = 0; i < kChannels; ++i) {
    n.insert(n.end(),
             {r.q[i], r.qd[i], r.torque[i], double(r.in.counts[std::size_t(i)]), double(r.out.codes[std::size_t(i)])});
  }
  const StylusState& s = r.stylus;
  n.insert(n.end(), {double(s.tick), s.t_s, double(s.loop), double(s.fault.code), s.jaw_opening_m, s.grip_force_n,
                     s.rendered_grip_n, double(s.contact), s.depth_m, s.energy_j, double(s.passivity_active)});
  for (int i = 0; i < 3; ++i) {
    n.insert(n.end(), {s.X_TI.p[i], s.V_TI_T.linear[i], s.F_I_T.force[i], s.F_I_T.moment[i], s.rendered_force_T[i],
                       s.contact_point_T[i], s.contact_normal_T[i]});
  }
  return n;
}

TEST(HapticLoop, ReplayReproducesEveryRecord) {
  LoopRig rig;
  const std::vector<TickRecord> live = eventful_run(rig);
  std::vector<DaqSample> samples;
  for (const TickRecord& r : live) samples.push_back(r.in);
  ReplayDaq replay(samples, rig.daq.capabilities());
  HapticLoopConfig config = rig.config;
  config.daq = replay.capabilities();
  HapticLoop loop(config);
  // The patch changed during the run: replay with the patch of each phase, told by the tick at which it was put.
  const ContactPatch nothing{};
  bool touched = false, gripped = false;
  for (std::size_t k = 0; k < live.size(); ++k) {
    const bool before = k < 600 + 1200 + 1500;
    TickRecord record;
    loop.tick(replay.read(), before ? nothing : *rig.patch, record);
    const std::vector<double> a = numbers(live[k]), b = numbers(record);
    ASSERT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << "tick " << k;
    touched |= record.stylus.contact;
    gripped |= record.stylus.grip_force_n > 0.1;
  }
  EXPECT_TRUE(touched && gripped) << "the run must feel something";
  EXPECT_TRUE(replay.finished());
}

TEST(HapticLoop, TwoRunsOfOneSeedAreTheSameBytesAndAnotherSeedIsNot) {
  LoopRig a, b;
  SimulatedDaqConfig other;
  other.seed = 2;
  LoopRig c(other);
  const auto ra = eventful_run(a), rb = eventful_run(b), rc = eventful_run(c);
  ASSERT_EQ(ra.size(), rb.size());
  for (std::size_t k = 0; k < ra.size(); ++k) {
    const auto x = numbers(ra[k]), y = numbers(rb[k]);
    ASSERT_EQ(std::memcmp(x.data(), y.data(), x.size() * sizeof(double)), 0) << "tick " << k;
  }
  EXPECT_NE(numbers(ra.back()), numbers(rc.back()));
}

TEST(ReplayDaq, AfterTheEndAllChannelsAreInvalid) {
  DaqSample sample;
  sample.counts[0] = 7;
  ReplayDaq replay({sample, sample}, {"simulated", 2000, 14});
  EXPECT_STREQ(replay.capabilities().name, "replay");
  EXPECT_EQ(replay.capabilities().rate_hz, 2000);
  EXPECT_EQ(replay.capabilities().dac_bits, 14);
  EXPECT_EQ(replay.read().valid, 0x7F);
  EXPECT_FALSE(replay.finished());
  EXPECT_EQ(replay.read().valid, 0x7F);
  EXPECT_TRUE(replay.finished());
  EXPECT_EQ(replay.read().valid, 0);
  EXPECT_EQ(replay.read().counts[0], 7) << "repeats the last sample";
}

}  // namespace
}  // namespace trocar::haptic_loop_test
