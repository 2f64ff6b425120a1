// Clutch and hold: frozen while pressed, no jump of pose or force on release, offset taken up in handle space.
#include <gtest/gtest.h>

#include "haptics/mapping/instrument_coupling.h"
#include "tests/haptics/haptics_fixtures.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::instrument_coupling_test {
namespace {

using test::Random;

constexpr double kTick = 1e-3;

InstrumentMap direct_map() {
  InstrumentMap map;
  map.X_TW.R = test::Random(3).rotation();
  map.X_SI = {test::Random(4).rotation(), Vec3(0.01, 0.02, 0.03)};
  map.motion_scale = 1.5;
  return map;
}

InstrumentMap port_map() {
  InstrumentMap map;
  Fulcrum f;
  f.port_T = Vec3(0, 0, 0.12);
  f.R_TI_reference = test::tip_down(Vec3::Zero()).R;
  map.fulcrum = f;
  return map;
}

class Clutch : public testing::TestWithParam<bool> {
 protected:
  InstrumentMap map() const { return GetParam() ? port_map() : direct_map(); }
};

TEST_P(Clutch, FreezesTheInstrumentAndTakesUpTheOffset) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    InstrumentCoupling coupling(map());
    Pose stylus{random.rotation(), Vec3(0, 0, 0.27) + random.vector(0.05)};
    coupling.update(stylus, {}, false, kTick);
    for (int times = 0; times < 3; ++times) {
      const Pose before = coupling.X_TI();
      const Pose moved{random.rotation(), Vec3(0, 0, 0.27) + random.vector(0.05)};
      coupling.update(moved, {Vec3(0.1, 0, 0), Vec3(0, 1, 0)}, true, kTick);
      EXPECT_EQ((coupling.X_TI().p - before.p).norm(), 0);
      EXPECT_EQ(coupling.V_TI_T().linear.norm(), 0);
      EXPECT_TRUE(coupling.clutched());
      coupling.update(moved, {}, false, kTick);
      // Rounding of a few products of lengths below a metre; the twist comes back through atan2.
      EXPECT_LT((coupling.X_TI().p - before.p).norm(), 1e-12);
      EXPECT_LT((coupling.X_TI().R - before.R).norm(), 1e-9);
      EXPECT_FALSE(coupling.clutched());
    }
  }
}

TEST_P(Clutch, MovesOnFromThereAsTheStylusDoes) {
  InstrumentCoupling coupling(map());
  const Pose a{Mat3::Identity(), Vec3(0.01, 0.02, 0.27)}, b{Mat3::Identity(), Vec3(-0.04, 0.02, 0.25)};
  coupling.update(a, {}, false, kTick);
  const Vec3 tip = coupling.X_TI().p;
  coupling.update(b, {}, true, kTick);
  coupling.update(b, {}, false, kTick);
  const Vec3 step(1e-4, 2e-4, -1e-4);
  coupling.update({b.R, b.p + step}, {}, false, kTick);
  const Vec3 after_clutch = coupling.X_TI().p - tip;
  InstrumentCoupling plain(map());
  plain.update({a.R, a.p + step}, {}, false, kTick);
  EXPECT_LT((after_clutch - (plain.X_TI().p - tip)).norm(), 1e-12) << "as if the stylus had never been moved away";
}

TEST_P(Clutch, TheForceFadesInFiftyMilliseconds) {
  InstrumentCoupling coupling(map());
  const Pose stylus{Mat3::Identity(), Vec3(0, 0, 0.27)};
  coupling.update(stylus, {}, false, kTick);
  EXPECT_EQ(coupling.share(), 1);
  double last = 1;
  for (int k = 1; k <= 60; ++k) {
    coupling.update(stylus, {}, true, kTick);
    EXPECT_LE(last - coupling.share(), 0.02 + 1e-12);
    last = coupling.share();
    EXPECT_EQ(last == 0, k >= 50) << k;
  }
  coupling.update(stylus, {}, false, kTick);
  EXPECT_NEAR(coupling.share(), 0.02, 1e-12) << "and comes back as slowly";
}

INSTANTIATE_TEST_SUITE_P(BothMappings, Clutch, testing::Bool(),
                         [](const auto& mapping) { return mapping.param ? "Fulcrum" : "Direct"; });

TEST(PortHold, TheMapIsHeldNearThePortAndGoesOnWithoutAJump) {
  InstrumentCoupling coupling(port_map());
  const auto at = [&](double above_port) {
    coupling.update({Mat3::Identity(), Vec3(0, 0, 0.12 + above_port)}, {}, false, kTick);
    return coupling.X_TI().p;
  };
  for (double d = 0.05; d > 0.0205; d -= 0.001) at(d);
  EXPECT_FALSE(coupling.held());
  const Vec3 deepest = coupling.X_TI().p;
  for (const double d : {0.0195, 0.005, 0.0, -0.03, 0.01, 0.021}) {
    EXPECT_LT((at(d) - deepest).norm(), 1e-15) << d;
    EXPECT_TRUE(coupling.held()) << d << ": also beyond the port, and short of the hysteresis";
  }
  EXPECT_LT((at(0.0225) - deepest).norm(), 1e-12);
  EXPECT_FALSE(coupling.held());
  EXPECT_NEAR((at(0.0235) - deepest).z(), 0.001, 1e-12) << "drawing back draws the tip back";
}

/// While the clutch is pressed the stylus may go anywhere, also to where the old registration has the handle in the
/// port.
TEST(PortHold, AClutchReleasedThereByTheOldRegistrationHoldsNothing) {
  for (const double above_port : {0.0195, 0.005, 0.0, -0.04}) {
    InstrumentCoupling coupling(port_map());
    const Pose off{Mat3::Identity(), Vec3(0.02, -0.01, 0.27)};
    for (int k = 0; k < 3; ++k) coupling.update(off, {}, false, kTick);
    const Pose before = coupling.X_TI();
    const Wrench push{Vec3(0.3, 0.1, 0.8), Vec3(0, 0, 0.002)};
    const Wrench felt = coupling.stylus_wrench(push);
    Pose released{Mat3::Identity(), Vec3(0, 0, 0.12 + above_port)};
    for (int k = 0; k < 60; ++k) coupling.update(released, {}, true, kTick);
    EXPECT_EQ(coupling.share(), 0);
    for (int k = 1; k <= 60; ++k) {
      coupling.update(released, {}, false, kTick);
      EXPECT_FALSE(coupling.held()) << above_port;
      EXPECT_LT((coupling.X_TI().p - before.p).norm(), 1e-12);
      EXPECT_LT((coupling.X_TI().R - before.R).norm(), 1e-9);
      EXPECT_NEAR(coupling.share(), std::min(1.0, 0.02 * k), 1e-12) << "the force comes back at once, and in 50 ms";
    }
    const Wrench again = coupling.stylus_wrench(push);
    EXPECT_LT((again.force - felt.force).norm(), 1e-9);
    EXPECT_LT((again.moment - felt.moment).norm(), 1e-12);
    released.p.z() += 0.001;
    coupling.update(released, {}, false, kTick);
    EXPECT_GT(coupling.X_TI().p.z(), before.p.z() + 0.5e-3) << "drawing back draws the tip back";
  }
}

TEST(PortHold, AClutchDoesNotFreeAHandleThatIsPushedOnIntoThePort) {
  InstrumentCoupling coupling(port_map());
  Pose stylus{Mat3::Identity(), Vec3(0, 0, 0.1405)};
  coupling.update(stylus, {}, false, kTick);
  const Vec3 deepest = coupling.X_TI().p;
  stylus.p = Vec3(0.1, 0, 0.3);
  coupling.update(stylus, {}, true, kTick);
  coupling.update(stylus, {}, false, kTick);
  EXPECT_FALSE(coupling.held()) << "half a millimetre is left, wherever the stylus is";
  stylus.p.z() -= 0.001;
  coupling.update(stylus, {}, false, kTick);
  EXPECT_TRUE(coupling.held());
  EXPECT_LT((coupling.X_TI().p - deepest).norm(), 1e-12);
  // Clutched out of the hold: the map that the force goes by and the instrument it goes to still belong together.
  stylus.p = Vec3(-0.05, 0.02, 0.25);
  coupling.update(stylus, {}, true, kTick);
  coupling.update(stylus, {}, false, kTick);
  EXPECT_LT((coupling.map().instrument_pose(coupling.X_WS()).p - coupling.X_TI().p).norm(), 1e-12);
}

TEST(PortHold, AStylusThatBeginsInThePortIsHeldAtAFinitePose) {
  InstrumentCoupling coupling(port_map());
  coupling.update({Mat3::Identity(), Vec3(0, 0, 0.12)}, {}, false, kTick);
  EXPECT_TRUE(coupling.held());
  EXPECT_TRUE(coupling.X_TI().p.allFinite());
  EXPECT_LT((coupling.X_TI().p - Vec3(0, 0, -0.16)).norm(), 1e-12);
}

/// The loop on the simulated plant, pressing 0.5 N on a floor, when the clutch is pressed and the hand moves away.
TEST(ClutchInTheLoop, NeitherPoseNorForceJumps) {
  test::LoopRig rig;
  rig.start();
  rig.move(test::working_pose(), 0.8);
  rig.put_floor(0.002, 150);
  Pose down = rig.goal;
  down.p.z() -= 0.008;
  rig.move(down, 0.8);
  rig.run(0.4);
  ASSERT_GT(rig.record.stylus.rendered_force_T.norm(), 0.2);
  rig.daq.press_clutch(true);
  rig.keep = true;
  rig.run(0.1);
  EXPECT_TRUE(rig.record.stylus.clutched);
  EXPECT_LT(rig.record.stylus.rendered_force_T.norm(), 1e-9);
  Pose aside = rig.goal;
  aside.p += Vec3(0.02, 0.01, 0.02);
  rig.move(aside, 0.5);
  const Vec3 frozen = rig.record.stylus.X_TI.p;
  rig.run(0.3);
  EXPECT_EQ((rig.record.stylus.X_TI.p - frozen).norm(), 0);
  rig.daq.press_clutch(false);
  rig.run(0.3);
  EXPECT_FALSE(rig.record.stylus.clutched);
  EXPECT_FALSE(rig.record.stylus.fault);
  for (std::size_t k = 1; k < rig.records.size(); ++k) {
    const StylusState &a = rig.records[k - 1].stylus, &b = rig.records[k].stylus;
    // One count moves the tip by up to 0.22 mm; two joints may count in the same millisecond.
    EXPECT_LT((b.X_TI.p - a.X_TI.p).norm(), 0.6e-3) << k;
    // A fiftieth of the force a tick, plus 150 N/m over that motion.
    EXPECT_LT((b.rendered_force_T - a.rendered_force_T).norm(), 0.02 * 1.5 + 0.6e-3 * 150 * 1.5) << k;
  }
  EXPECT_EQ(rig.allocations, 0u);
}

}  // namespace
}  // namespace trocar::instrument_coupling_test
