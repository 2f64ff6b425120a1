// Boards whose SYNC runs by itself: the wait for it, by flag and by interrupt, and what PciBus does with the files that
// the kernel gives.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <thread>

#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/device/mc4000/pci_bus.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::pci_bus_test {
namespace {

constexpr double kPeriod_s = 1e-3, kAccess_s = 1e-6;

/// Time that both boards and the computer share.
struct Clock {
  double now_s = 100, pit_hz = 1000, phase = 0, stops_at_s = std::numeric_limits<double>::infinity();
  double turns() const { return (std::min(now_s, stops_at_s) - 100) * pit_hz + phase; }
  bool runs = false;  ///< the gate of board 0's timer is open
  std::int64_t syncs() const { return static_cast<std::int64_t>(std::floor(turns())); }
  double since_sync_s() const { return (turns() - std::floor(turns())) / pit_hz; }
};

/// A board whose SYNC comes by its own timer, whoever looks: sets the flag, takes the converters over, latches its
/// decoders, which here count SYNCs. Each access takes its time.
class RunningBoard final : public PolledBus {
 public:
  RunningBoard(Clock& clock, int number) : PolledBus(1000), clock_(clock), number_(number), taken_(clock.syncs()) {}
  std::uint32_t read(std::uint32_t word) noexcept override {
    pass();
    if (gone) return ~0U;
    if (word == map_.interrupt_flags) return flag_;
    if (word >= map_.dac && word < map_.dac + 8) return held_[word];
    if (word >= map_.decoder_count && word < map_.decoder_mode) return static_cast<std::uint32_t>(taken_);
    return memory_[word];
  }
  void write(std::uint32_t word, std::uint32_t value) noexcept override {
    pass();
    if (word == map_.interrupt_flags)
      flag_ &= ~value;
    else
      memory_[word] = value;
    if (word == map_.gate && number_ == 0) clock_.runs = (value & map_.gate_pit) != 0;
  }
  bool hears_interrupt() const noexcept override { return interrupts; }
  bool gone = false, interrupts = false;
  double wakes_late_s = 50e-6;

 private:
  void pass() {
    clock_.now_s += kAccess_s;
    if (clock_.syncs() == taken_) return;
    taken_ = clock_.syncs();
    if (!clock_.runs) return;
    held_ = memory_;
    flag_ |= map_.flag_sync;
  }
  double now_s() noexcept override { return clock_.now_s; }
  void rest(double look_s, double limit_s) noexcept override {
    const double sync_s = clock_.now_s + 1 / clock_.pit_hz - clock_.since_sync_s(), to = interrupts ? sync_s : look_s;
    if (interrupts && sync_s > std::min(limit_s, clock_.stops_at_s))
      clock_.now_s = limit_s;
    else if (to > clock_.now_s)
      clock_.now_s = to + wakes_late_s * static_cast<double>(++rests_ % 8) / 4;
  }

  Mc4000Map map_;
  Clock& clock_;
  int number_;
  std::int64_t taken_;
  std::uint32_t flag_ = 0;
  int rests_ = 0;
  std::map<std::uint32_t, std::uint32_t> memory_, held_;
};

struct Rig {
  explicit Rig(double drift = 0, double phase = 0) : clock{.pit_hz = 1000 * (1 + drift), .phase = phase} {
    options.inputs.clear();
  }
  Mc4000Daq& open() { return *(daq = std::make_unique<Mc4000Daq>(first, second, options)); }
  /// A tick's work, with codes that are new each time.
  void work(double seconds) {
    clock.now_s += seconds;
    DacFrame frame;
    frame.codes.fill(++ticks % 1000);
    daq->arm(true);
    daq->write(frame);
  }
  void expect_sound(const DaqSample& sample) const {
    EXPECT_EQ(sample.valid, 0x7F) << "tick " << ticks;
    EXPECT_EQ(sample.digital_in, 0U) << "tick " << ticks;
  }
  Clock clock;
  RunningBoard first{clock, 0}, second{clock, 1};
  Mc4000Options options;
  std::unique_ptr<Mc4000Daq> daq;
  int ticks = 0;
};

TEST(RunningBoards, OpenAtAnyPhaseOfTheirTimer) {
  for (int k = 0; k < 1000; ++k) {
    Rig rig(0, 0.001 * k);
    ASSERT_NO_THROW(rig.open()) << k;
    EXPECT_LT(rig.clock.now_s, 100 + 4 * kPeriod_s);
    rig.clock.now_s += 3;  // a scene is built
    EXPECT_EQ(rig.daq->read().elapsed_periods, 1U) << "no period was missed before the first";
  }
  Rig rig;
  rig.clock.stops_at_s = 0;
  EXPECT_THROW(rig.open(), EnvironmentError);
  EXPECT_GT(rig.clock.now_s, 100 + 40 * kPeriod_s) << "it was given the time";
}

/// @param interrupts whether board 0's are heard, else its flag is polled.
class PacingBoards : public testing::TestWithParam<bool> {
 protected:
  Mc4000Daq& open(Rig& rig) const {
    rig.first.interrupts = GetParam();
    return rig.open();
  }
};

TEST_P(PacingBoards, PaceTheLoopWhateverTheirDrift) {
  for (const double drift : {-1e-4, -5e-5, 0.0, 5e-5, 1e-4})
    for (const double phase : {0.0, 0.35, 0.99}) {
      Rig rig(drift, phase);
      Mc4000Daq& daq = open(rig);
      daq.read();
      const std::int64_t begun = rig.clock.syncs();
      for (int k = 0; k < 12000; ++k) {
        ASSERT_TRUE(daq.await_sync()) << "drift " << drift << ", phase " << phase << ", tick " << k;
        ASSERT_TRUE(k < 20 || rig.clock.since_sync_s() < 0.1 * kPeriod_s) << "drift " << drift << ", tick " << k;
        const DaqSample sample = daq.read();
        ASSERT_EQ(sample.elapsed_periods, 1U) << "drift " << drift << ", phase " << phase << ", tick " << k;
        rig.expect_sound(sample);
        rig.work(200e-6);
      }
      EXPECT_EQ(rig.clock.syncs() - begun, 12000);
    }
}

TEST_P(PacingBoards, ALateLoopIsToldThePeriodsThatPassed) {
  for (const double drift : {-1e-4, 3e-5}) {
    Rig rig(drift, 0.2);
    Mc4000Daq& daq = open(rig);
    DaqSample before = daq.read();
    int unlike = 0;
    for (int k = 1; k < 12000; ++k) {
      daq.await_sync();
      const DaqSample sample = daq.read();
      const std::int32_t off = sample.counts[0] - before.counts[0] - static_cast<std::int32_t>(sample.elapsed_periods);
      ASSERT_LE(std::abs(off), 1) << k;
      unlike += off != 0;
      rig.expect_sound(sample);
      before = sample;
      rig.work(k % 50 == 0 ? 1e-4 * (k % 173) : 2e-4);
    }
    EXPECT_LE(unlike, 24) << "of 239 late ones, those that read just when a SYNC comes; drift " << drift;
  }
}

TEST_P(PacingBoards, AFlagThatWasClearedUnseenIsAPeriodThatPassed) {
  Rig rig(5e-5);
  Mc4000Daq& daq = open(rig);
  for (int k = 0; k < 20; ++k) {
    daq.await_sync();
    daq.read();
    rig.work(200e-6);
  }
  rig.clock.now_s += 0.9 * kPeriod_s;
  rig.first.write(Mc4000Map().interrupt_flags, Mc4000Map().flag_sync);
  EXPECT_TRUE(daq.await_sync());
  EXPECT_EQ(daq.read().elapsed_periods, 2U);
}

TEST_P(PacingBoards, ATimerThatStopsAndABoardThatIsGoneAreFoundInThatTick) {
  Rig rig(0, 0.3);
  Mc4000Daq& daq = open(rig);
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(daq.await_sync());
    ASSERT_EQ(daq.read().elapsed_periods, 1U);
    rig.work(2e-4);
  }
  rig.clock.stops_at_s = rig.clock.now_s;
  double begun = rig.clock.now_s;
  EXPECT_FALSE(daq.await_sync());
  EXPECT_EQ(daq.read().elapsed_periods, 0U);
  EXPECT_LT(rig.clock.now_s - begun, 1.6 * kPeriod_s);
  rig.clock.stops_at_s = std::numeric_limits<double>::infinity();
  daq.await_sync();
  EXPECT_GE(daq.read().elapsed_periods, 1U);
  rig.first.gone = true;
  begun = rig.clock.now_s;
  EXPECT_FALSE(daq.await_sync());
  EXPECT_EQ(daq.read().elapsed_periods, 0U);
  EXPECT_LT(rig.clock.now_s - begun, 0.1 * kPeriod_s) << "nothing to wait for";
}

INSTANTIATE_TEST_SUITE_P(By, PacingBoards, testing::Bool(),
                         [](const auto& by) { return by.param ? "Interrupt" : "Flag"; });

/// Who sleeps by the computer's clock and reads: its wakes drift through every phase of the SYNC.
TEST(RunningBoards, ReadsOfTheComputersOwnPaceAreNews) {
  for (const double drift : {-5e-4, -5e-5, 0.0, 5e-5, 5e-4}) {
    Rig rig(drift, 0.5);
    Mc4000Daq& daq = rig.open();
    DaqSample before = daq.read();
    const double begun = rig.clock.now_s;
    int unlike = 0;
    for (int k = 0; k < 20000; ++k) {
      rig.clock.now_s = std::max(rig.clock.now_s, begun + k * kPeriod_s);
      const DaqSample sample = daq.read();
      ASSERT_GE(sample.elapsed_periods, 1U) << "drift " << drift << ", tick " << k;
      ASSERT_LE(sample.elapsed_periods, 2U) << "drift " << drift << ", tick " << k;
      unlike += k > 0 && sample.counts[0] - before.counts[0] != static_cast<std::int32_t>(sample.elapsed_periods);
      rig.expect_sound(sample);
      before = sample;
      rig.work(100e-6);
    }
    EXPECT_LE(unlike, 2 + 20000 * std::abs(drift)) << "a period in which two SYNCs came, now and then";
  }
}

/// The flag then stands at the first look, and when the SYNC came does not show.
TEST(RunningBoards, WakesThatAreAlwaysLateLoseNoSync) {
  for (const double drift : {-1e-4, 1e-4}) {
    Rig rig(drift);
    rig.first.wakes_late_s = 250e-6;
    Mc4000Daq& daq = rig.open();
    const std::int32_t begun = daq.read().counts[0];
    std::int64_t told = 0;
    DaqSample sample;
    for (int k = 0; k < 20000; ++k) {
      ASSERT_TRUE(daq.await_sync());
      sample = daq.read();
      told += sample.elapsed_periods;
      rig.expect_sound(sample);
      rig.work(200e-6);
    }
    EXPECT_NEAR(static_cast<double>(told), sample.counts[0] - begun, 1) << drift;
  }
}

/// What sysfs and UIO give for a board, as plain files.
class PciBusFiles : public testing::Test {
 protected:
  PciBusFiles() { folder_.write("resource0", std::string(4096, '\0')); }
  std::string bytes(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string fifo() const {
    const std::string node = folder_ / "uio";
    EXPECT_EQ(::mkfifo(node.c_str(), 0600), 0);
    return node;
  }
  /// As the board does.
  void set_sync() const {
    std::fstream registers(folder_ / "resource0", std::ios::in | std::ios::out | std::ios::binary);
    registers.seekp(4 * map_.interrupt_flags)
        .write(reinterpret_cast<const char*>(&map_.flag_sync), sizeof map_.flag_sync);
  }
  double waited(PciBus& bus, std::uint32_t said) const {
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_EQ(bus.await_sync(map_.interrupt_flags, map_.flag_sync), said);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  }
  Mc4000Map map_;
  test::TemporaryFolder folder_;
};

TEST_F(PciBusFiles, MapsRegistersAndSaysWhyNot) {
  {
    PciBus bus(folder_.path(), 1000);
    bus.write(0x08, 0x12345678);
    EXPECT_EQ(bus.read(0x08), 0x12345678U);
    EXPECT_EQ(bus.read(5000), ~0U) << "beyond the end nobody answers";
    bus.write(5000, 1);
    EXPECT_EQ(Mc4000Daq::dry_look(bus, {}).size(), 19U);
    EXPECT_NE(Mc4000Daq::dry_look(bus, {})[7].find("MC_DAC0        0x08  0x12345678"), std::string::npos);
    EXPECT_THROW(Mc4000Daq(bus, bus, {}), EnvironmentError) << "a file sends no SYNC";
  }
  EXPECT_EQ(bytes("resource0").substr(4 * 0x08, 4), std::string(4, '\0')) << "converters at zero, at the word's place";
  folder_.write("resource0", "short");
  EXPECT_THROW(PciBus(folder_.path(), 1000), EnvironmentError);
  std::filesystem::remove(folder_ / "resource0");
  try {
    const PciBus bus(folder_.path(), 1000);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
  try {
    const PciBus bus("/dev/uio4711", 1000);
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/uio4711: No such file"), std::string::npos);
  }
}

TEST_F(PciBusFiles, WithoutAnInterruptItPollsTheFlagForAPeriodAndAHalf) {
  {
    PciBus bus(folder_.path(), 100);
    EXPECT_TRUE(bus.tells_sync());
    EXPECT_FALSE(bus.hears_interrupt());
    EXPECT_GE(waited(bus, 0), 0.015);
    EXPECT_THROW(PciBus(folder_.path(), 100), EnvironmentError) << "one program has a board";
  }
  std::thread board([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    set_sync();
  });
  PciBus slow(folder_.path(), 0.1);
  EXPECT_LT(waited(slow, 1), 10) << "seen when it comes";
  board.join();
}

TEST_F(PciBusFiles, AnInterruptEndsTheWaitAndIsUnmaskedByTheCommandRegister) {
  const std::string node = fifo();
  folder_.write("config", std::string("\x01\x02\x03\x04\x05\x07\x08", 7));
  PciBus bus(folder_.path(), 0.1, node);
  EXPECT_TRUE(bus.hears_interrupt());
  std::fstream interrupts(node, std::ios::in | std::ios::out | std::ios::binary);
  const auto interrupt = [&](std::uint32_t count) {
    interrupts.write(reinterpret_cast<const char*>(&count), sizeof count).flush();
  };
  interrupt(6);  // of another device on the line: the flag does not stand
  std::thread board([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    set_sync();
    interrupt(9);
  });
  EXPECT_LT(waited(bus, 1), 10) << "a period, whatever the interrupts counted";
  board.join();
  EXPECT_EQ(bytes("config"), std::string("\x01\x02\x03\x04\x05\x03\x08", 7)) << "Interrupt Disable, and nothing else";
}

TEST_F(PciBusFiles, WhereThereIsNoConfigurationTheNodeIsAskedToUnmask) {
  folder_.write("uio", "");
  PciBus bus(folder_.path(), 1000, folder_ / "uio");
  waited(bus, 0);
  EXPECT_EQ(bytes("uio").substr(0, 4), std::string("\x01\0\0\0", 4));
}

TEST_F(PciBusFiles, AnInterruptThatStaysAwayIsNoSync) {
  folder_.write("config", std::string(64, '\0'));
  PciBus bus(folder_.path(), 100, fifo());
  EXPECT_GE(waited(bus, 0), 0.015);
}

}  // namespace
}  // namespace trocar::pci_bus_test
