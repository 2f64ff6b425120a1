// Pedal and exchange switch: edges counted, the list gone round, and in the loop no step of pose or force.
#include "haptics/mapping/instrument_exchange.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/contact/instrument.h"
#include "tests/haptics/loop_rig.h"

namespace trocar::instrument_exchange_test {
namespace {

constexpr double kTick = 1e-3;

struct Pressed {
  InstrumentExchange exchange;
  int taken = 0;
  void hold(bool pressed, double seconds) {
    for (int k = 0, n = static_cast<int>(std::lround(seconds / kTick)); k < n; ++k)
      taken += exchange.update(pressed, kTick);
  }
  void press() {
    hold(true, 0.05);
    hold(false, 0.05);
  }
};

TEST(InstrumentExchange, EachPressTakesTheNextAndAfterTheLastTheFirst) {
  Pressed p{InstrumentExchange(3)};
  for (const int expected : {1, 2, 0, 1}) {
    p.hold(false, 0.3);
    EXPECT_TRUE(p.exchange.in_hand());
    p.press();
    p.hold(false, 0.3);
    EXPECT_EQ(p.exchange.index(), expected);
  }
  EXPECT_EQ(p.taken, 4);
}

TEST(InstrumentExchange, HeldDownItIsOnePress) {
  Pressed p{InstrumentExchange(3)};
  p.hold(false, 0.01);
  p.hold(true, 5);
  EXPECT_EQ(p.exchange.index(), 1);
  EXPECT_TRUE(p.exchange.in_hand());
}

TEST(InstrumentExchange, APressOnTheWayCountsAndOnceRoundIsNoExchange) {
  Pressed p{InstrumentExchange(3)};
  p.hold(false, 0.01);
  for (int n = 0; n < 2; ++n) {
    p.hold(true, 0.02);
    p.hold(false, 0.02);
  }
  p.hold(false, 0.3);
  EXPECT_EQ(p.exchange.index(), 2);
  EXPECT_EQ(p.taken, 1);
  for (int n = 0; n < 3; ++n) {
    p.hold(true, 0.01);
    p.hold(false, 0.01);
  }
  p.hold(false, 0.3);
  EXPECT_EQ(p.exchange.index(), 2);
  EXPECT_EQ(p.taken, 1);
  EXPECT_TRUE(p.exchange.in_hand());
}

TEST(InstrumentExchange, ASwitchClosedFromTheStartIsNoPressAndOneInstrumentIsNeverExchanged) {
  Pressed closed{InstrumentExchange(3)}, one{InstrumentExchange(1)};
  closed.hold(true, 1);
  EXPECT_EQ(closed.exchange.index(), 0);
  one.hold(false, 0.01);
  one.press();
  one.hold(false, 0.3);
  EXPECT_EQ(one.exchange.index(), 0);
  EXPECT_EQ(one.taken, 0);
  EXPECT_EQ(one.exchange.share(), 1);
}

HapticLoopConfig with_tools(const std::vector<InstrumentKind>& kinds) {
  HapticLoopConfig config;
  for (const InstrumentKind kind : kinds) config.tools.push_back(make_tool(kind));
  config.tool = config.tools.front().shape;
  return config;
}

const std::vector<InstrumentKind> kAll{InstrumentKind::kGrasper, InstrumentKind::kScissors, InstrumentKind::kHook,
                                       InstrumentKind::kClipApplier, InstrumentKind::kSuction};

struct PressingRig : test::LoopRig {
  PressingRig() : LoopRig({}, with_tools(kAll)) {
    start();
    move(test::working_pose(), 0.8);
    squeeze(0.004, 0.3);
    put_floor(0.002, 150);
    Pose down = goal;
    down.p.z() -= 0.011;
    move(down, 0.8);
    run(1.4);
  }
  void press_exchange() {
    daq.press_exchange(true);
    run(0.05);
    daq.press_exchange(false);
    run(0.6);
  }
};

/// The loop on the simulated plant, pressing half a newton on a floor with jaws 4 mm open, through all instruments.
TEST(ExchangeInTheLoop, NeitherPoseNorForceJumpsAndThePressComesBack) {
  PressingRig rig;
  const double pressed_n = rig.record.stylus.F_I_T.force.z();
  ASSERT_GT(rig.record.stylus.rendered_force_T.norm(), 0.2);
  rig.keep = true;
  for (std::int32_t n = 1; n <= 5; ++n) {
    const std::size_t from = rig.records.size();
    rig.press_exchange();
    EXPECT_EQ(rig.record.stylus.instrument, n % 5);
    double least_n = 10;
    for (std::size_t k = from; k < rig.records.size(); ++k)
      least_n = std::min(least_n, rig.records[k].stylus.rendered_force_T.norm());
    EXPECT_LT(least_n, 1e-9) << "drawn back it touches nothing";
    EXPECT_GT(rig.record.stylus.F_I_T.force.z(), 0.9 * pressed_n) << n << " presses as before, a thicker one more";
  }
  EXPECT_NEAR(rig.record.stylus.F_I_T.force.z(), pressed_n, 0.2) << "the arm's friction leaves a hand some of it";
  EXPECT_FALSE(rig.record.stylus.fault);
  EXPECT_EQ(rig.allocations, 0u);
  for (std::size_t k = 1; k < rig.records.size(); ++k) {
    const StylusState &a = rig.records[k - 1].stylus, &b = rig.records[k].stylus;
    EXPECT_LT((b.X_TI.p - a.X_TI.p).norm(), 0.6e-3) << k;
    EXPECT_LT((b.rendered_force_T - a.rendered_force_T).norm(), 0.05) << k;
    // 0.5 mm of the way back a tick at most, one count of the device, 150 N/m
    EXPECT_LT((b.F_I_T.force - a.F_I_T.force).norm(), (0.5e-3 + 0.6e-3) * 150) << k;
  }
}

TEST(PedalInTheLoop, IsDownWhileItIsHeldInAnActiveLoopWithAnInstrumentInHand) {
  PressingRig rig;
  EXPECT_FALSE(rig.record.stylus.pedal);
  rig.daq.press_pedal(true);
  rig.run(0.01);
  EXPECT_TRUE(rig.record.stylus.pedal);
  rig.daq.press_exchange(true);
  rig.run(0.05);
  EXPECT_FALSE(rig.record.stylus.pedal) << "on its way";
  rig.daq.press_exchange(false);
  rig.run(0.6);
  EXPECT_TRUE(rig.record.stylus.pedal);
  rig.daq.press_deadman(false);
  rig.run(0.05);
  EXPECT_FALSE(rig.record.stylus.pedal) << "switched off";
}

TEST(PedalInTheLoop, ReplaysFromItsInputsToTheBit) {
  test::LoopRig first({}, with_tools(kAll));
  std::vector<DaqSample> samples;
  first.keep = true;
  first.start();
  first.daq.press_pedal(true);
  first.daq.press_exchange(true);
  first.run(0.4);
  for (const TickRecord& record : first.records) samples.push_back(record.in);
  ReplayDaq replay(samples, first.daq.capabilities());
  HapticLoopConfig config = with_tools(kAll);
  config.daq = first.config.daq;
  config.map = first.config.map;
  HapticLoop again(config);
  TickRecord record;
  for (const TickRecord& was : first.records) {
    again.tick(replay.read(), *first.patch, record);
    ASSERT_EQ(record.stylus.instrument, was.stylus.instrument);
    ASSERT_EQ(record.stylus.pedal, was.stylus.pedal);
    ASSERT_EQ(record.out.codes, was.out.codes);
  }
  EXPECT_EQ(record.stylus.instrument, 1);
  EXPECT_TRUE(record.stylus.pedal);
}

}  // namespace
}  // namespace trocar::instrument_exchange_test
