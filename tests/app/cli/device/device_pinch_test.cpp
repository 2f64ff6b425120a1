// `trocar device pinch` on a card by the clock: a person does what is said, in both designs, or does nothing.
#include "app/cli/device/device_pinch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>
#include <thread>
#include <vector>

#include "app/cli/progress_display.h"
#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "scenarios/files/device_file.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::device_pinch_test {
namespace {

/// What is said to the person, a line at each flush.
class Prompts final : public std::stringbuf {
 public:
  std::size_t said() const { return said_; }

 protected:
  int sync() override {
    ++said_;
    return 0;
  }

 private:
  std::atomic<std::size_t> said_ = 0;
};

/// Reads a line, the first for longer than a point must be held, and moves two fingers there; in the card's own time.
class Person {
 public:
  static constexpr std::array kLate_s{1.2, 0.4, 0.4};
  static constexpr double kMove_s = 0.5;
  static constexpr std::array kGoes{-0.004, 0.034, 0.020};  ///< pressed against an end, the other, and on the block

  Person(FakeHostmot2& card, const Prompts& prompts) : card_(card), prompts_(prompts), thread_([this] { live(); }) {}
  ~Person() { stop(); }
  Person(const Person&) = delete;
  Person(Person&&) = delete;
  Person& operator=(const Person&) = delete;
  Person& operator=(Person&&) = delete;

  void stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// True opening where each line was obeyed. @pre stopped
  const std::array<double, kGoes.size()>& held() const { return held_; }

 private:
  void live() {
    const HandSense rest = card_.sense();
    double fingers = rest.jaw_opening_m, from = fingers, read_s = 0;
    std::size_t read = 0;
    for (; !ends_; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      const HandSense now = card_.sense();
      if (read > 0) held_[read - 1] = now.jaw_opening_m;
      if (read < kGoes.size() && prompts_.said() > read) ++read, read_s = card_.time_s(), from = fingers;
      if (read > 0) {
        const double way = std::clamp((card_.time_s() - read_s - kLate_s[read - 1]) / kMove_s, 0.0, 1.0);
        fingers = from + way * way * (3 - 2 * way) * (kGoes[read - 1] - from);
      }
      card_.set_hand_intent(rest.X_BS, fingers);
    }
  }

  FakeHostmot2& card_;
  const Prompts& prompts_;
  std::array<double, kGoes.size()> held_{};
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

SimulatedDaqConfig steady(const PlantParameters& plant) {
  SimulatedDaqConfig config;
  config.plant = plant;
  config.hand.tremor_m = 0;  // a block between the jaws holds them still; the simulated one is the fingers' own
  return FakeHostmot2::device_config(config);
}

/// A device out of its jig, as a person takes it, on a card.
struct Bench {
  explicit Bench(const PlantParameters& plant) : device(steady(plant)) {
    const HandSense rest = device.sense();
    for (int k = 0; k < 100; ++k) {
      device.set_hand_intent(rest.X_BS, rest.jaw_opening_m);
      device.read();
      device.arm(true);
      device.write({});
    }
    device.arm(false);
    card.emplace(device, std::vector<InjectedFault>{}, hostmot2::standard_wiring());
    options.backend = kHostmot2Backend;
    options.card = card->address();
    options.limit_s = 20;
    options.out = folder / "pinch.toml";
  }

  const test::TemporaryFolder folder;
  SimulatedDaq device;
  std::optional<FakeHostmot2> card;
  PinchCommand options;
  std::ostringstream err;
};

/// The file that comes of a person who does it all; nothing of it knows the device.
void expect_true_pinch(Bench& bench, double counts_per_m) {
  Prompts prompts;
  std::ostream out(&prompts);
  Person person(*bench.card, prompts);
  ASSERT_EQ(device_pinch(bench.options, out, bench.err), 0) << bench.err.str();
  person.stop();
  EXPECT_FALSE(bench.card->amplifiers_enabled());
  EXPECT_EQ(prompts.said(), 3u) << prompts.str();
  const DeviceModel found = load_device(bench.options.out);
  const Transmission& t = found.transmission[kPinchChannel];
  const auto [closed, open, block] = person.held();
  EXPECT_NEAR(found.pinch_home_m, block, 1.5e-4) << "the zero that the loop counts from";
  EXPECT_NEAR(found.pinch_travel_m, open - closed, 2e-4) << "fingers press the ends in by 0.08 mm each";
  EXPECT_NEAR(t.counts_per_turn / (2 * std::numbers::pi * t.ratio) / counts_per_m, 1, 0.01);
}

TEST(DevicePinch, OnARealCardAGearedPinchIsFoundByWhatItsPersonDoes) {
  PlantParameters plant = draw_parameters(1);
  ChannelParameters& c = plant.channel[kPinchChannel];
  c.ratio = 0.004;
  c.friction.coulomb = 0.15;
  plant.options.pinch.backlash = 1e-4;
  Bench bench(plant);
  bench.options.ratio_m = c.ratio;
  expect_true_pinch(bench, 2000 / (2 * std::numbers::pi * c.ratio));
  EXPECT_EQ(load_device(bench.options.out).pinch.design, PinchDesign::kGeared);
}

TEST(DevicePinch, OnARealCardAPotentiometerIsFoundThroughItsTrembling) {
  PlantParameters plant = draw_parameters(1);
  plant.options.pinch = {
      .counts_per_m = 4096 / 0.030, .noise_counts = 0.7, .dead_every = 0.007, .dead_wide = 5e-5, .driver_lag = 0.003};
  Bench bench(plant);
  bench.options.design = "potentiometer";
  bench.options.noise = 5;
  expect_true_pinch(bench, 4096 / 0.030);
  const DeviceModel found = load_device(bench.options.out);
  EXPECT_EQ(found.pinch.design, PinchDesign::kPotentiometer);
  EXPECT_EQ(found.pinch.noise_counts, 5);
}

TEST(DevicePinch, OnARealCardNothingIsWrittenWhenNobodySqueezes) {
  Bench bench(draw_parameters(1));
  bench.options.limit_s = 2;
  std::ostringstream out;
  EXPECT_EQ(device_pinch(bench.options, out, bench.err), 4);
  EXPECT_EQ(out.str(), "Close the pinch as far as it goes, and hold it\n") << "what rests from the start is no point";
  EXPECT_CONTAINS(bench.err.str(), "Close the pinch as far as it goes, and hold it: not seen within 2 s");
  EXPECT_FALSE(std::filesystem::exists(bench.options.out));
  EXPECT_FALSE(bench.card->amplifiers_enabled());
}

TEST(DevicePinch, InterruptedItSaysSoWhereverTheLoopRuns) {
  Bench bench(draw_parameters(1));
  bench.options.interrupted = [] { return true; };
  std::ostringstream out;
  EXPECT_THROW(device_pinch(bench.options, out, bench.err), Interrupted) << "on a card";
  EXPECT_FALSE(bench.card->amplifiers_enabled());
  bench.options.backend = kSimulatedBackend;
  EXPECT_THROW(device_pinch(bench.options, out, bench.err), Interrupted) << "on the simulated device";
  EXPECT_EQ(bench.err.str(), "") << "not: not seen within so many seconds";
  EXPECT_FALSE(std::filesystem::exists(bench.options.out));
}

}  // namespace
}  // namespace trocar::device_pinch_test
