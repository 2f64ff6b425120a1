// The person's hand: rests until the device is ready, then follows the newest intent at its speed and no faster.
#include "app/window/attempt/person_hand.h"

#include <gtest/gtest.h>

#include <memory>

namespace trocar::person_hand_test {
namespace {

constexpr double kTick = 1e-3;

struct Bench {
  std::unique_ptr<HandLink> link = std::make_unique<HandLink>();
  PauseSwitch pause;
  PersonHand hand{*link, {}, &pause};
  Percept percept;
  std::uint64_t number = 0;

  Bench() {
    percept.tip_T = {0.01, 0.02, 0.03};
    percept.jaw_opening_m = 0.015;
  }
  void steer(const Vec3& to, double jaw_m = 0.02, const Mat3& R = Mat3::Identity()) {
    link->wanted.write({{{R, to}, jaw_m, false}, ++number});
  }
  HandIntent tick(int times = 1) {
    HandIntent intent;
    for (int i = 0; i < times; ++i) intent = hand.update(percept, kTick);
    return intent;
  }
};

TEST(PersonHand, RestsWhereItIsUntilTheDeviceIsReadyAndSomethingIsWanted) {
  Bench bench;
  bench.steer({0.05, 0, 0});
  EXPECT_TRUE(bench.tick(100).X_TI.p.isApprox(bench.percept.tip_T)) << "not ready";
  EXPECT_FALSE(bench.link->ready);
  Bench unwanted;
  unwanted.percept.device_ready = true;
  EXPECT_TRUE(unwanted.tick(100).X_TI.p.isApprox(unwanted.percept.tip_T)) << "ready, nothing wanted";
  EXPECT_TRUE(unwanted.link->ready);
  EXPECT_DOUBLE_EQ(unwanted.tick().jaw_opening_m, 0.015);
}

TEST(PersonHand, TakesUpWhereSoftStartHasCarriedTheInstrument) {
  Bench bench;
  bench.tick(10);
  bench.percept.tip_T += Vec3(0, 0, 0.004);
  EXPECT_NEAR(bench.tick().X_TI.p.z(), 0.03, 1e-12) << "holds where it took hold";
  bench.percept.device_ready = true;
  EXPECT_NEAR(bench.tick().X_TI.p.z(), 0.034, 1e-12);
  bench.percept.tip_T += Vec3(0, 0, 0.004);
  EXPECT_NEAR(bench.tick().X_TI.p.z(), 0.034, 1e-12) << "only once";
}

TEST(PersonHand, ALeapOfThePointerBecomesAMovement) {
  Bench bench;
  bench.percept.device_ready = true;
  bench.tick();
  const Vec3 far = bench.percept.tip_T + Vec3(0.3, 0, 0);
  bench.steer(far);
  Vec3 before = bench.percept.tip_T;
  for (int i = 0; i < 700; ++i) {
    const Vec3 now = bench.tick().X_TI.p;
    EXPECT_LE((now - before).norm(), PersonHand::kSpeed * kTick + 1e-12);
    before = now;
  }
  EXPECT_TRUE(before.isApprox(far)) << "0.3 m at 0.5 m/s take 0.6 s";
}

TEST(PersonHand, TurnsAndClosesAtTheirSpeeds) {
  Bench bench;
  bench.percept.device_ready = true;
  bench.tick();
  const Mat3 quarter = Eigen::AngleAxisd(1.5, Vec3::UnitY()).toRotationMatrix();
  bench.steer(bench.percept.tip_T, 0, quarter);
  const HandIntent after = bench.tick(100);
  EXPECT_NEAR(Eigen::AngleAxisd(after.X_TI.R).angle(), 0.1 * PersonHand::kTurnSpeed, 1e-9);
  EXPECT_NEAR(after.jaw_opening_m, 0.015 - 0.1 * PersonHand::kFingerSpeed, 1e-12);
  const HandIntent there = bench.tick(400);
  EXPECT_TRUE(there.X_TI.R.isApprox(quarter));
  EXPECT_DOUBLE_EQ(there.jaw_opening_m, 0);
}

TEST(PersonHand, NewestIntentWinsAndTheWindowSeesTheTarget) {
  Bench bench;
  bench.percept.device_ready = true;
  bench.tick();
  bench.steer({1, 1, 1});
  bench.steer(bench.percept.tip_T + Vec3(0, 0, 0.001));
  const HandIntent intent = bench.tick(10);
  EXPECT_NEAR(intent.X_TI.p.z(), 0.031, 1e-12);
  EXPECT_EQ(bench.link->target.read().X_TI.p, intent.X_TI.p);
}

TEST(PersonHand, AnIntentIsFeltWhenTheTickThatHadItIsOver) {
  Bench bench;
  bench.percept.device_ready = true;
  bench.tick();
  bench.steer(bench.percept.tip_T);
  bench.tick();
  EXPECT_EQ(bench.link->felt, 0u) << "the loop is still at it";
  bench.tick();
  EXPECT_EQ(bench.link->felt, 1u);
}

TEST(PersonHand, TheClutchIsHandedOn) {
  Bench bench;
  bench.percept.device_ready = true;
  bench.tick();
  bench.link->wanted.write({{{Mat3::Identity(), bench.percept.tip_T}, 0.02, true}, 1});
  EXPECT_TRUE(bench.tick().clutch);
}

TEST(PersonHand, AfterAPauseItTakesUpTheInstrumentByTheClutch) {
  Bench bench;
  bench.percept.device_ready = true;
  bench.steer(bench.percept.tip_T);
  EXPECT_FALSE(bench.tick(100).clutch);
  bench.pause.set(true);
  bench.pause.set(false);
  bench.steer(bench.percept.tip_T + Vec3(0.05, 0, 0));
  const HandIntent taken = bench.tick(static_cast<int>(PersonHand::kTakesUp / kTick) - 1);
  EXPECT_TRUE(taken.clutch) << "a hold begins anew under the clutch";
  EXPECT_EQ(taken.X_TI.p, bench.percept.tip_T) << "and what was steered meanwhile is not gone through in it";
  EXPECT_FALSE(bench.tick(2).clutch) << "once a pause";
}

}  // namespace
}  // namespace trocar::person_hand_test
