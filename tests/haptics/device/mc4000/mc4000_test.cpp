// The driver of the thesis' boards against boards that are not there: their set-up, SYNC, watchdog, troubles.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "haptics/device/mc4000/emulated_mc4000.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/device/mc4000/pci_bus.h"
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
  std::uint32_t await_sync() noexcept override {
    ++waits_;
    return silent_ ? 0 : board_.await_sync();
  }
  bool tells_sync() const noexcept override { return true; }
  int waits_ = 0;
  bool silent_ = false;

 private:
  RegisterBus& board_;
};

TEST_F(Mc4000, ABoardThatTellsOfItsSyncIsWaitedForOnceAPeriod) {
  TellingBoard first(pair_.board(0));
  Mc4000Daq daq(first, pair_.board(1), {});
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

/// Memory of a board as sysfs gives it: here a file.
TEST(PciBus, MapsAFileOfRegistersAndSaysWhyNot) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "trocar_pci_bus_test";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "resource0";
  std::ofstream(file).write(std::string(4096, '\0').data(), 4096);
  {
    PciBus bus(folder.string(), 1000);
    bus.write(0x08, 0x12345678);
    EXPECT_EQ(bus.read(0x08), 0x12345678U);
    EXPECT_EQ(bus.read(5000), ~0U) << "beyond the end nobody answers";
    bus.write(5000, 1);
    EXPECT_EQ(PciBus(folder.string(), 1e-6).await_sync(), 0U) << "eleven days have not passed on the host's clock";
    PciBus fast(folder.string(), 1e9);
    EXPECT_GT(fast.await_sync(), 0U) << "a nanosecond has";
    EXPECT_EQ(Mc4000Daq::dry_look(bus, {}).size(), 19U);
    EXPECT_NE(Mc4000Daq::dry_look(bus, {})[7].find("MC_DAC0        0x08  0x12345678"), std::string::npos);
    EXPECT_THROW(Mc4000Daq(bus, bus, {}), EnvironmentError) << "a file sends no SYNC";
  }
  std::ifstream in(file, std::ios::binary);
  in.seekg(4 * 0x08);
  std::uint32_t word = 1;
  in.read(reinterpret_cast<char*>(&word), 4);
  EXPECT_EQ(word, 0U) << "converters at zero, at the word's place";
  std::ofstream(file, std::ios::trunc) << "short";
  EXPECT_THROW(PciBus(folder.string(), 1000), EnvironmentError);
  std::filesystem::remove_all(folder);
  try {
    const PciBus bus(folder.string(), 1000);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
}

}  // namespace
}  // namespace trocar::mc4000_test
