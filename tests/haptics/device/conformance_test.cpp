// One list for every back-end of the seam (haptics/device/data_acquisition.h): the simulated device, a card and boards
// that are not there, a recording, and the one without a device. What needs motors is asked where there are some.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/backends/simulated_board.h"
#include "haptics/device/pointer_daq.h"
#include "haptics/device/transmission.h"
#include "haptics/haptic_loop.h"
#include "haptics/input_error.h"
#include "tests/support/daq_conformance.h"
#include "tests/support/repeats.h"

namespace trocar::conformance_test {
namespace {

using test::DaqUnderTest;
using test::period;

SimulatedDaqConfig exact_device() {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  config.hand.tremor_m = 0;
  return config;
}

/// Leads the stylus so that every joint and the jaw turn.
struct MovingHand {
  explicit MovingHand(SimulatedWorld& w) : world(w), home(w.sense().X_BS) {}
  void operator()() const {
    const double t = world.time_s();
    Pose wanted = home;
    wanted.p += Vec3(0.03 * std::sin(3 * t), -0.03 * (1 - std::cos(2 * t)), 0.03 + 0.02 * std::sin(2 * t));
    wanted.R = wanted.R * Mat3(Eigen::AngleAxisd(0.3 * std::sin(4 * t), Vec3(1, 1, 2).normalized()));
    world.set_hand_intent(wanted, 0.018 + 0.006 * std::sin(5 * t));
  }
  SimulatedWorld& world;
  Pose home;
};

/// Code of a share of full scale.
std::int32_t code_of(const DataAcquisition& daq, double share) {
  return static_cast<std::int32_t>(share * ((1 << (daq.capabilities().dac_bits - 1)) - 1));
}

std::string short_name(const testing::TestParamInfo<std::string>& backend) {
  std::string name = backend.param;
  std::erase(name, '-');
  return name;
}

/// Back-ends with motors, and the simulated device behind them.
class Conformance : public testing::TestWithParam<std::string> {
 protected:
  SimulatedBoard open(const SimulatedDaqConfig& config = exact_device(), double answer_s = 2) const {
    return open_simulated_board(GetParam(), config, answer_s);
  }
  static DaqUnderTest under_test(const SimulatedBoard& board) {
    const auto looked = [&board](ChannelVector (DevicePlant::*what)() const noexcept) {
      const auto held = board.hold();
      return (board.device->plant().*what)();
    };
    return {*board.daq, MovingHand(*board.world), [looked] { return looked(&DevicePlant::outputs); },
            [looked] { return looked(&DevicePlant::motor_loads); }};
  }
  static double load(const SimulatedBoard& board) { return under_test(board).motor_loads().cwiseAbs().maxCoeff(); }
};

TEST_P(Conformance, SaysWhoItIs) {
  const SimulatedBoard board = open();
  test::expect_sane_capabilities(under_test(board));
  EXPECT_EQ(board.daq->capabilities().name, GetParam());
}

TEST_P(Conformance, SamplesAreWellFormed) {
  const SimulatedBoard board = open();
  board.daq->arm(true);
  test::expect_well_formed_samples(under_test(board), 2000, 30);
}

/// Each counter is that of the same instant, to the count: sign, scale, and one latch over all axes.
TEST_P(Conformance, AllAxesAreLatchedAtOneInstantAndFollowTheMotion) {
  const SimulatedBoard board = open();
  for (int k = 0; k < 3; ++k) period(*board.daq, true);
  ChannelVector per_output;
  for (int i = 0; i < kChannels; ++i)
    per_output[i] = 2000 / (2 * std::numbers::pi) / board.device->plant().parameters().channel[i].ratio;
  DaqUnderTest asked = under_test(board);
  asked.before_read = [&board, hand = MovingHand(*board.world)] { hand(), board.daq->write({}); };
  test::expect_counts_follow_motion(asked, 2000, per_output);
}

TEST_P(Conformance, ACommandIsItsVoltsAndTheirTorqueWithinAStep) {
  const DeviceModel model;
  for (const double share : {-1.0, -0.61, -0.1, 0.001, 0.25, 0.5, 0.999}) {
    const SimulatedBoard board = open();
    const DaqUnderTest asked = under_test(board);
    const int bits = board.daq->capabilities().dac_bits;
    DacFrame frame, step;
    frame.codes.fill(code_of(*board.daq, share));
    step.codes.fill(1);
    for (int k = 0; k < 40; ++k) {  // in the jig, which opens after 50
      board.daq->read();
      board.daq->arm(true);
      board.daq->write(frame);
    }
    const ChannelVector due = torques_of(model, frame, bits), least = torques_of(model, step, bits);
    const ChannelVector off = (asked.motor_loads() - due).cwiseAbs();
    for (int i = 0; i < kChannels; ++i) EXPECT_LE(off[i], least[i] + 1e-9) << share << " of full scale, channel " << i;
  }
}

TEST_P(Conformance, CodesActTogetherAtTheNextSync) {
  const SimulatedBoard board = open();
  for (int k = 0; k < 10; ++k) period(*board.daq, true);
  DaqUnderTest asked = under_test(board);
  asked.before_read = {};
  test::expect_atomic_write(asked, code_of(*board.daq, 0.1));
}

TEST_P(Conformance, NoTorqueBeforeArmingAndAfterDisarming) {
  const SimulatedBoard board = open();
  for (int k = 0; k < 20; ++k) {
    period(*board.daq, false, code_of(*board.daq, 0.5));
    ASSERT_EQ(load(board), 0) << "before arming, tick " << k;
  }
  DaqUnderTest asked = under_test(board);
  asked.before_read = {};
  test::expect_disarm_removes_torque(asked, code_of(*board.daq, 0.1));
}

TEST_P(Conformance, AWatchdogThatBitesLeavesNoTorqueUntilDisarmed) {
  const SimulatedBoard board = open();
  const std::int32_t code = code_of(*board.daq, 0.1);
  for (int k = 0; k < 20; ++k) period(*board.daq, true, code);
  EXPECT_GT(load(board), 0.01);
  int unwritten = 0;
  while (!(board.daq->read().digital_in & kWatchdogFired) && unwritten < 100) ++unwritten;
  EXPECT_GE(unwritten, 14);
  EXPECT_LE(unwritten, 18);
  board.daq->read();
  constexpr double kDying = 1e-3;  // N m: what is left of a current with the amplifier's time constant
  EXPECT_LT(load(board), kDying);
  for (int k = 0; k < 10; ++k) {
    EXPECT_TRUE(period(*board.daq, true, code).digital_in & kWatchdogFired) << "a write is no way out";
    EXPECT_LT(load(board), kDying);
  }
  period(*board.daq, false);
  for (int k = 0; k < 10; ++k) period(*board.daq, true, code);
  EXPECT_GT(load(board), 0.01) << "a disarm is";
}

/// A pause of a device that cannot stand still is an open deadman: codes zero, written each period.
TEST_P(Conformance, ZeroCodesKeepTheWatchdogAliveWithoutTorque) {
  const SimulatedBoard board = open();
  for (const bool armed : {true, false})
    for (int k = 0; k < 3000; ++k) {
      ASSERT_FALSE(period(*board.daq, armed).digital_in & kWatchdogFired) << k;
      ASSERT_EQ(load(board), 0) << k;
    }
}

TEST_P(Conformance, OneSilentPeriodIsNoNewsAndItGoesOn) {
  SimulatedDaqConfig config = exact_device();
  config.faults.push_back({InjectedFaultKind::kSensorSilence, 0.2, 0.003, 0, 0});
  const SimulatedBoard board = open(config, 0.2);
  int silent = 0, stale = 0;
  std::array<std::int32_t, kChannels> before{};
  for (int k = 0; k < 400; ++k) {
    const DaqSample sample = period(*board.daq, false);
    silent += sample.elapsed_periods == 0;
    if (k > 0 && sample.elapsed_periods == 0) {
      EXPECT_EQ(sample.counts, before) << "what it had, marked as no news";
    }
    stale += sample.elapsed_periods > 1;
    before = sample.counts;
  }
  EXPECT_GE(silent + stale, 2) << "the hole is told, as no news or by the periods that went by";
  EXPECT_EQ(period(*board.daq, false).elapsed_periods, 1U);
  EXPECT_EQ(period(*board.daq, false).valid, 0x7F);
}

TEST_P(Conformance, AFailingChannelIsMarkedAndNoOther) {
  SimulatedDaqConfig config = exact_device();
  config.faults.push_back({InjectedFaultKind::kChannelInvalid, 0.1, 0.01, 3, 0});
  const SimulatedBoard board = open(config);
  int marked = 0;
  for (int k = 0; k < 200; ++k) {
    const std::uint8_t valid = period(*board.daq, false).valid;
    EXPECT_TRUE(valid == 0x7F || valid == (0x7F & ~(1 << 3))) << int{valid};
    marked += valid != 0x7F;
  }
  EXPECT_NEAR(marked, 10, 1);
}

TEST_P(Conformance, OpenedAnewItIsAtItsStart) {
  for (int n = 0; n < 3; ++n) {
    const SimulatedBoard board = open();
    EXPECT_EQ(load(board), 0) << "nothing is left of the one before";
    const DaqSample first = board.daq->read();
    EXPECT_EQ(first.elapsed_periods, 1U);
    EXPECT_EQ(first.valid, 0x7F);
    EXPECT_FALSE(first.digital_in & (kWatchdogFired | kEmergencyStop));
    EXPECT_TRUE(first.digital_in & kHomeBeam);
    for (int k = 0; k < 30; ++k) period(*board.daq, true, code_of(*board.daq, 0.3));
    EXPECT_GT(load(board), 0.01);
  }
}

TEST_P(Conformance, AWrongConfigurationIsRefused) {
  const auto refuses = [&](auto&& change) {
    SimulatedDaqConfig config = exact_device();
    change(config);
    EXPECT_ANY_THROW(open(config));
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  refuses([](SimulatedDaqConfig& c) { c.rate_hz = 0; });
  refuses([](SimulatedDaqConfig& c) { c.rate_hz = -1000; });
  refuses([&](SimulatedDaqConfig& c) { c.rate_hz = kNaN; });
  refuses([](SimulatedDaqConfig& c) { c.rate_hz = 1e9; });
  refuses([&](SimulatedDaqConfig& c) { c.watchdog_s = kNaN; });
  refuses([](SimulatedDaqConfig& c) { c.watchdog_s = 0; });
  refuses([](SimulatedDaqConfig& c) { c.watchdog_s = -1; });
  EXPECT_THROW(open_simulated_board("mc5000", {}), InputError);
}

/// The loop at work on the back-end: not one allocation in its calls, nor in the tick.
TEST_P(Conformance, TicksAtWorkAllocateNothing) {
  const int ticks = test::repeats("CONFORMANCE_TICKS", 6000);
  const SimulatedBoard board = open();
  HapticLoopConfig config;
  config.daq = board.daq->capabilities();
  HapticLoop loop(config);
  const auto patch = std::make_unique<ContactPatch>();
  TickRecord record;
  const Pose jig = board.world->sense().X_BS;
  std::uint64_t allocations = 0, active = 0;
  for (int k = 0; k < ticks; ++k) {
    const double phase = 2e-3 * std::max(0, k - 2500);
    const Pose goal{jig.R, jig.p + Vec3(0.02 * std::sin(phase), 0.02 * (std::cos(phase) - 1), 0.01 * std::sin(phase))};
    if (k > 700) board.world->set_hand_intent(goal, 0.02);
    const test::AllocationGuard guard;
    const DacFrame out = loop.tick(board.daq->read(), *patch, record);
    board.daq->arm(record.amplifiers_armed);
    board.daq->write(out);
    allocations += guard.allocations();
    active += record.stylus.loop == LoopState::kActive;
    ASSERT_NE(record.stylus.loop, LoopState::kFault) << k << ": " << fault_name(record.stylus.fault.code);
  }
  EXPECT_EQ(allocations, 0U);
  EXPECT_GT(active, static_cast<std::uint64_t>(ticks) / 2);
}

INSTANTIATE_TEST_SUITE_P(Backends, Conformance, testing::ValuesIn(simulated_board_names()), short_name);

std::vector<DaqSample> recorded_samples(int count) {
  SimulatedDaq daq(exact_device());
  const MovingHand hand(daq);
  std::vector<DaqSample> out;
  for (int k = 0; k < count; ++k) {
    hand();
    out.push_back(period(daq, true));
  }
  return out;
}

TEST(ReplayConformance, GivesWhatWasRecordedAndNothingBeyondItsEnd) {
  const std::vector<DaqSample> samples = recorded_samples(2000);
  const auto open = [&] { return replay_backend(samples, {"simulated", 1000, 16}); };
  Backend first = open(), backend = open();
  test::expect_sane_capabilities({*backend.daq, {}, {}, {}});
  test::expect_well_formed_samples({*backend.daq, {}, {}, {}}, 1998, 30);
  for (const DaqSample& sample : samples) {
    const DaqSample now = period(*first.daq, true, 30000);
    ASSERT_EQ(now.counts, sample.counts);
    ASSERT_EQ(now.digital_in, sample.digital_in);
  }
  const DaqSample past = first.daq->read();
  EXPECT_EQ(past.valid, 0) << "driven past its end the loop faults: it feels no frozen device";
  EXPECT_EQ(past.counts, samples.back().counts);
  backend = open();
  test::expect_no_allocation({*backend.daq, {}, {}, {}}, 1000);
  EXPECT_EQ(open().daq->read().counts, samples.front().counts) << "opened anew";
}

TEST(PointerConformance, HasNoMotorsAndIsGivenNoCodes) {
  const Backend backend = make_backend(kPointerBackend, {});
  const DaqUnderTest asked{*backend.daq, MovingHand(*backend.world), {}, {}};
  test::expect_sane_capabilities(asked);
  EXPECT_FALSE(backend.daq->capabilities().motors);
  test::expect_well_formed_samples(asked, 500, 2000);  // its counts are a hundred times as fine
  test::expect_no_allocation(asked, 500);
  const Backend again = make_backend(kPointerBackend, {});
  const MovingHand hand(*again.world);
  HapticLoopConfig config;
  config.daq = again.daq->capabilities();
  config.device.transmission = pointer_transmissions();
  HapticLoop loop(config);
  const auto patch = std::make_unique<ContactPatch>();
  TickRecord record;
  for (int k = 0; k < 3000; ++k) {
    if (k > 700) hand();
    const DacFrame out = loop.tick(again.daq->read(), *patch, record);
    for (const std::int32_t code : out.codes) ASSERT_EQ(code, 0);
    again.daq->arm(record.amplifiers_armed);
    again.daq->write(out);
  }
  EXPECT_EQ(record.stylus.loop, LoopState::kActive) << fault_name(record.stylus.fault.code);
}

}  // namespace
}  // namespace trocar::conformance_test
