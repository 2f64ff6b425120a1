// The driver of the thesis' boards against boards that are not there: their set-up, SYNC, watchdog, troubles.
#include <gtest/gtest.h>

#include <memory>

#include "haptics/device/mc4000/emulated_mc4000.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/input_error.h"
#include "tests/support/daq_conformance.h"

namespace trocar::mc4000_test {
namespace {

using test::period;

class Mc4000 : public testing::Test {
 protected:
  std::unique_ptr<Mc4000Daq> driver(const Mc4000Options& options = {}) {
    return std::make_unique<Mc4000Daq>(pair_.board(0), pair_.board(1), options);
  }
  std::int32_t code_in_force(int channel) const {
    return device_.codes_in_force().codes[static_cast<std::size_t>(channel)];
  }

  Mc4000Map map_;
  SimulatedDaq device_{EmulatedMc4000::device_config({})};
  EmulatedMc4000 pair_{device_, 1000, map_, mc4000_inputs()};
};

TEST_F(Mc4000, TheMapIsTheThesisTable) {
  EXPECT_EQ(map_.pit, 0x00U);
  EXPECT_EQ(map_.watchdog, 0x02U);
  EXPECT_EQ(map_.gate, 0x04U);
  EXPECT_EQ(map_.sync_control, 0x06U);
  EXPECT_EQ(map_.dac + 7 * map_.dac_stride, 0x0FU) << "converters 0 to 7: 0x08 to 0x0F";
  EXPECT_EQ(map_.digital_in_b, 0x22U);
  EXPECT_EQ(map_.interrupt_flags, 0x34U);
  EXPECT_EQ(map_.interrupt_enable, 0x35U);
  EXPECT_EQ(map_.decoder_count + 7 * map_.decoder_stride, 0x4EU) << "counts 0 to 7: 0x40 to 0x4E";
  EXPECT_EQ(map_.decoder_mode + 7 * map_.decoder_stride, 0x5EU);
}

TEST_F(Mc4000, IsSetUpAsInFigure3_9ButWithItsWatchdogOn) {
  const auto daq = driver();
  EXPECT_EQ(pair_.board(0).read(map_.pit), 10000U) << "1 kHz";
  EXPECT_EQ(pair_.board(0).read(map_.watchdog), 2U) << "16 ms: two counts at an eighth of the SYNC clock";
  EXPECT_EQ(pair_.board(0).read(map_.gate), map_.gate_pit | map_.gate_watchdog);
  EXPECT_EQ(pair_.board(1).read(map_.gate), map_.gate_watchdog) << "driven by board 0";
  EXPECT_EQ(pair_.board(0).read(map_.sync_control), map_.sync_internal_pit | map_.sync_output1_pit);
  EXPECT_EQ(pair_.board(1).read(map_.sync_control), map_.sync_internal_external);
  const DaqSample first = daq->read();
  for (const std::int32_t count : first.counts) EXPECT_LE(std::abs(count), 1) << "counts begin at zero, in the jig";
  EXPECT_EQ(first.valid, 0x7F);
  EXPECT_TRUE(first.digital_in & kHomeBeam);
}

/// A board in an interrupt's way: its SYNC is waited for apart from what reads it.
class TellingBoard final : public RegisterBus {
 public:
  explicit TellingBoard(RegisterBus& board) : board_(board) {}
  std::uint32_t read(std::uint32_t word) noexcept override { return board_.read(word); }
  void write(std::uint32_t word, std::uint32_t value) noexcept override { board_.write(word, value); }
  std::uint32_t await_sync(std::uint32_t flags, std::uint32_t flag) noexcept override {
    ++waits_;
    return silent_ ? 0 : board_.await_sync(flags, flag);
  }
  bool tells_sync() const noexcept override { return true; }
  bool hears_interrupt() const noexcept override { return true; }
  int waits_ = 0;
  bool silent_ = false;

 private:
  RegisterBus& board_;
};

TEST_F(Mc4000, ABoardThatTellsOfItsSyncIsWaitedForOnceAPeriod) {
  TellingBoard first(pair_.board(0));
  Mc4000Daq daq(first, pair_.board(1), {});
  EXPECT_EQ(first.read(map_.interrupt_enable), map_.flag_sync);
  first.waits_ = 0;
  for (int k = 1; k <= 5; ++k) {
    EXPECT_TRUE(daq.await_sync());
    EXPECT_EQ(daq.read().elapsed_periods, 1U) << "of the SYNC that was waited for";
    EXPECT_EQ(first.waits_, k);
  }
  EXPECT_EQ(daq.read().elapsed_periods, 1U) << "who does not wait first waits in the read";
  EXPECT_EQ(first.waits_, 6);
  first.silent_ = true;
  EXPECT_FALSE(daq.await_sync()) << "the caller's clock takes over";
  EXPECT_EQ(daq.read().elapsed_periods, 0U) << "nothing is news";
}

TEST_F(Mc4000, ABoardWithoutAnInterruptLeavesTheTimeToTheCaller) {
  const auto daq = driver();
  EXPECT_FALSE(daq->await_sync());
  EXPECT_EQ(daq->read().elapsed_periods, 1U);
  EXPECT_EQ(pair_.board(0).read(map_.interrupt_enable), 0U) << "nobody would answer it";
}

TEST_F(Mc4000, CountsAreThoseOfTheDeviceItself) {
  SimulatedDaq alone(EmulatedMc4000::device_config({}));
  const auto daq = driver();
  while (alone.time_s() < device_.time_s() - 1e-9) alone.read();
  DaqSample a0 = alone.read(), b0 = daq->read();
  for (int k = 0; k < 3000; ++k) {
    DacFrame frame;
    frame.codes.fill(k % 200 < 100 ? 2400 : -2400);
    for (DataAcquisition* each : {static_cast<DataAcquisition*>(&alone), static_cast<DataAcquisition*>(daq.get())}) {
      each->arm(k > 10);
      each->write(frame);
    }
    const DaqSample a = alone.read(), b = daq->read();
    for (std::size_t i = 0; i < kChannels; ++i) ASSERT_EQ(b.counts[i] - b0.counts[i], a.counts[i] - a0.counts[i]) << k;
    ASSERT_EQ(a.digital_in, b.digital_in) << k;
    ASSERT_EQ(b.elapsed_periods, 1U);
  }
}

TEST_F(Mc4000, AxesAreSplitFourAndTwoAndThePinch) {
  const auto daq = driver();
  for (int k = 0; k < 3; ++k) period(*daq, true);
  DacFrame frame;
  for (int i = 0; i < kChannels; ++i) frame.codes[static_cast<std::size_t>(i)] = 100 * (i + 1) * (i % 2 ? -1 : 1);
  daq->read();
  daq->write(frame);
  daq->read();
  for (int i = 0; i < kChannels; ++i) EXPECT_EQ(code_in_force(i), frame.codes[static_cast<std::size_t>(i)]);
  EXPECT_EQ(pair_.board(0).read(map_.dac + 3), 0xFFFFU & static_cast<std::uint32_t>(-400)) << "joint 4 on board 0";
  EXPECT_EQ(pair_.board(1).read(map_.dac + 0), 500U) << "joint 5 on board 1";
  EXPECT_EQ(pair_.board(1).read(map_.dac + 2), 700U) << "the pinch";
}

TEST_F(Mc4000, NarrowDecodersAndTurnedPhasesComeOutRight) {
  for (const int bits : {32, 24, 16}) {
    Mc4000Options options;
    options.map.count_bits = bits;
    options.invert[1] = true;
    SimulatedDaq device(EmulatedMc4000::device_config({})), same(EmulatedMc4000::device_config({}));
    EmulatedMc4000 narrow(device, 1000, options.map, mc4000_inputs()), wide(same, 1000, map_, mc4000_inputs());
    Mc4000Daq a(narrow.board(0), narrow.board(1), options), b(wide.board(0), wide.board(1), {});
    for (int k = 0; k < 2000; ++k) {
      const DaqSample x = period(a, k > 5, 6000), y = period(b, k > 5, 6000);
      for (std::size_t i = 0; i < kChannels; ++i) ASSERT_EQ(x.counts[i], i == 1 ? -y.counts[i] : y.counts[i]) << bits;
    }
  }
}

TEST_F(Mc4000, WithoutWritesTheWatchdogZeroesUntilDisarmed) {
  const auto daq = driver();
  for (int k = 0; k < 30; ++k) period(*daq, true, 500);
  EXPECT_EQ(code_in_force(0), 500);
  int k = 0;
  while (!(daq->read().digital_in & kWatchdogFired) && k < 100) ++k;
  EXPECT_GE(k, 14);
  EXPECT_LE(k, 18);
  EXPECT_EQ(code_in_force(0), 0);
  for (int n = 0; n < 5; ++n)
    EXPECT_TRUE(period(*daq, true, 500).digital_in & kWatchdogFired) << "a write is no way out";
  EXPECT_EQ(code_in_force(0), 0);
  period(*daq, false);
  for (int n = 0; n < 5; ++n) EXPECT_FALSE(period(*daq, true, 500).digital_in & kWatchdogFired);
  EXPECT_EQ(code_in_force(0), 500);
}

/// Both boards armed with a code in force, and then SYNCs in which the driver says nothing.
class Mc4000Watchdog : public Mc4000 {
 protected:
  static constexpr std::int32_t kCode = 500;
  Mc4000Watchdog() {
    for (int k = 0; k < 30; ++k) period(*daq_, true, kCode);
  }
  /// @return SYNCs until the converters of a board are zero; `most` where they do not get there.
  template <class BeforeEach>
  int zero_after(int number, int most, BeforeEach&& before_each) {
    const int channel = number == 0 ? 0 : 4;
    for (int k = 1; k <= most; ++k) {
      before_each();
      sync();
      if (code_in_force(channel) == 0) return k;
    }
    return most;
  }
  void sync() { pair_.board(0).await_sync(map_.interrupt_flags, map_.flag_sync); }
  void kick(int number, std::uint32_t counts) { pair_.board(number).write(map_.watchdog, counts); }
  bool flagged(int number) { return (pair_.board(number).read(map_.interrupt_flags) & map_.flag_watchdog) != 0; }

  std::unique_ptr<Mc4000Daq> daq_ = driver();
};

TEST_F(Mc4000Watchdog, ClosedGatesNeverBite) {
  pair_.board(0).write(map_.gate, map_.gate_pit);
  pair_.board(1).write(map_.gate, 0);
  for (const int number : {0, 1}) {
    EXPECT_EQ(zero_after(number, 200, [] {}), 200);
    EXPECT_FALSE(flagged(number));
  }
  for (int n = 0; n < 200; ++n) device_.miss_sync();
  EXPECT_EQ(code_in_force(0), kCode) << "nor while nobody asks";
}

TEST_F(Mc4000Watchdog, TheCountWrittenIsTheTime) {
  for (const std::uint32_t counts : {1U, 2U, 5U}) {
    for (const int number : {0, 1}) kick(number, counts);
    EXPECT_EQ(zero_after(0, 100, [] {}), 8 * static_cast<int>(counts));
    EXPECT_EQ(code_in_force(4), 0) << "at the same SYNC";
    period(*daq_, false);
    for (int k = 0; k < 5; ++k) period(*daq_, true, kCode);
    EXPECT_EQ(code_in_force(0), kCode);
  }
  for (const int number : {0, 1}) kick(number, 2);
  for (int n = 0; n < 15; ++n) device_.miss_sync();
  EXPECT_EQ(code_in_force(0), kCode);
  device_.miss_sync();
  EXPECT_EQ(code_in_force(0), 0) << "it bites while the program is late, not afterwards";
  EXPECT_TRUE(daq_->read().digital_in & kWatchdogFired);
}

TEST_F(Mc4000Watchdog, EachBoardHasItsOwn) {
  for (const int fed : {0, 1}) {
    EXPECT_EQ(zero_after(1 - fed, 100, [&] { kick(fed, 2); }), 16);
    EXPECT_TRUE(flagged(1 - fed));
    EXPECT_FALSE(flagged(fed));
    EXPECT_EQ(code_in_force(fed == 0 ? 0 : 4), kCode) << "the other board's converters go on";
    EXPECT_TRUE(daq_->read().digital_in & kWatchdogFired) << "either is told of";
    period(*daq_, false);
    for (int k = 0; k < 5; ++k) period(*daq_, true, kCode);
  }
}

TEST_F(Mc4000Watchdog, ItHoldsZeroUntilItsFlagIsCleared) {
  EXPECT_EQ(zero_after(0, 100, [] {}), 16);
  const auto go_on = [&] {
    for (int k = 0; k < 20; ++k) {
      for (const int number : {0, 1}) kick(number, 2);
      sync();
    }
  };
  go_on();
  EXPECT_EQ(code_in_force(0), 0) << "a kick is no way out";
  pair_.board(0).write(map_.interrupt_flags, map_.flag_watchdog);
  go_on();
  EXPECT_EQ(code_in_force(0), kCode) << "its converters are its registers again";
  EXPECT_EQ(code_in_force(4), 0) << "board 1 still says that it has bitten";
}

TEST_F(Mc4000Watchdog, ClosedWhileArmedTheConvertersAreZeroAndGuarded) {
  EXPECT_EQ(pair_.board(0).read(map_.dac), static_cast<std::uint32_t>(kCode));
  daq_.reset();
  for (const int number : {0, 1}) {
    EXPECT_EQ(pair_.board(number).read(map_.dac), 0U) << "board " << number;
    EXPECT_TRUE(pair_.board(number).read(map_.gate) & map_.gate_watchdog) << "board " << number;
    EXPECT_EQ(pair_.board(number).read(map_.interrupt_enable), 0U);
  }
  EXPECT_FALSE(pair_.board(0).read(map_.digital_out_a) & map_.out_amplifiers);
  EXPECT_EQ(driver()->read().elapsed_periods, 1U) << "and they can be opened anew";
}

TEST_F(Mc4000, ACableThatIsOutAndABoardThatIsGoneAreSeenAtOnce) {
  const auto daq = driver();
  for (int k = 0; k < 5; ++k) EXPECT_EQ(period(*daq, true).valid, 0x7F);
  pair_.trouble({.sync_cable_out = true});
  EXPECT_EQ(period(*daq, true).valid, 0x0F) << "joints 5, 6 and the pinch were not latched";
  pair_.trouble({.gone = {false, true}});
  EXPECT_EQ(period(*daq, true).valid, 0x0F);
  pair_.trouble({.quadrature_errors = 1 << 2});
  period(*daq, true);
  EXPECT_EQ(period(*daq, true).valid, 0x7F & ~(1 << 2));
  pair_.trouble({.gone = {true, false}});
  EXPECT_EQ(period(*daq, true).elapsed_periods, 0U) << "no news";
  pair_.trouble({});
  EXPECT_EQ(period(*daq, true).elapsed_periods, 1U);
}

TEST_F(Mc4000, BoardsThatCannotBeSetUpAreRefusedWithTheReason) {
  const auto refusal = [this](const BoardTroubles& troubles, const std::string& said) {
    pair_.trouble(troubles);
    try {
      driver();
      ADD_FAILURE() << "taken: " << said;
    } catch (const EnvironmentError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  };
  refusal({.gone = {true, false}}, "board 0: its timer does not keep what is written");
  refusal({.gone = {false, true}}, "board 1: its timer does not keep what is written");
  refusal({.sync_cable_out = true}, "board 1: no SYNC comes from board 0; is their cable plugged?");
}

}  // namespace
}  // namespace trocar::mc4000_test
