#include "app/cli/device/device_pinch.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/device/device_lanes.h"
#include "app/cli/progress_display.h"
#include "app/session/interrupt.h"
#include "app/session/setup/device_files.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "scenarios/files/device_file.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

constexpr double kPinchRateHz = 1000;
constexpr double kHeld_s = 1.0;      // still at an end before it counts
constexpr std::int32_t kMoved = 50;  // counts from the last point, the first from where it was
constexpr int kNotFound = 4;
constexpr double kBeyond_m = 0.004;  // that the simulated fingers press beyond an end

struct PinchPoint {
  const char* words;
  double finger_m;  ///< where the simulated hand holds it, of the travel: 0 closed, 1 open
};
constexpr std::array kPoints{PinchPoint{"Close the pinch as far as it goes, and hold it", 0},
                             PinchPoint{"Open it as far as it goes, and hold it", 1},
                             PinchPoint{"Lay its jaws on the block of the jig, and hold them", -1}};

class PinchBench {
 public:
  explicit PinchBench(const PinchCommand& options)
      : options_(options), backend_(make_backend(options.backend, made(options))) {
    if (!backend_.world) return;
    rest_ = backend_.world->sense();
    goal_ = rest_.jaw_opening_m;
    for (int k = 0; k < 100; ++k) exchange(true);  // the jig opens; codes are zero
  }
  ~PinchBench() {
    backend_.daq->write({});
    backend_.daq->arm(false);
  }

  /// One period. @return whether there is still something to look for.
  bool tick() {
    const PinchPoint& point = kPoints[at()];
    move(point);
    exchange(backend_.world != nullptr);
    const bool rests = std::abs(count_ - from_) <= options_.noise + 1;
    if (!begun_) begun_ = count_;
    const bool elsewhere = std::abs(count_ - (at() == 0 ? *begun_ : counts_[at() - 1])) >= kMoved;
    if (rests && elsewhere) {
      sum_ += count_, ++held_;
    } else {
      from_ = count_;
      held_ = 0, sum_ = 0;
    }
    if (static_cast<double>(held_) < kHeld_s * kPinchRateHz)
      return static_cast<double>(++waited_) < options_.limit_s * kPinchRateHz;
    counts_[at()] = sum_ / static_cast<double>(held_);
    truth_[at()] = truth();
    from_ = count_;
    waited_ = held_ = 0, sum_ = 0;
    return ++at_ < kPoints.size();
  }

  /// The point that is looked for; behind the last one: all are found. Any thread.
  std::size_t at() const { return at_.load(std::memory_order_relaxed); }
  /// Mean count where each is held.
  const std::array<double, kPoints.size()>& counts() const { return counts_; }
  const std::array<std::optional<double>, kPoints.size()>& truths() const { return truth_; }
  const Backend& backend() const { return backend_; }

 private:
  std::optional<double> truth() const {
    return backend_.world ? std::optional(backend_.world->sense().jaw_opening_m) : std::nullopt;
  }
  static BackendOptions made(const PinchCommand& o) {
    BackendOptions out;
    out.card = o.card;
    out.simulated.rate_hz = kPinchRateHz;
    out.simulated.seed = o.seed;
    out.simulated.hand.tremor_m = 0;
    if (!o.plant.empty()) out.simulated.plant = true_plant(o.plant, o.seed).parameters;
    return out;
  }
  void move(const PinchPoint& point) {
    if (!backend_.world) return;
    const double to = point.finger_m < 0    ? rest_.jaw_opening_m
                      : point.finger_m == 0 ? -kBeyond_m
                                            : options_.travel_m + kBeyond_m;
    goal_ += std::clamp(to - goal_, -2e-5, 2e-5);  // 20 mm/s
  }
  void exchange(bool armed) {
    if (backend_.world) backend_.world->set_hand_intent(rest_.X_BS, goal_);
    count_ = backend_.daq->read().counts[kPinchChannel];
    backend_.daq->arm(armed);
    backend_.daq->write({});
  }

  const PinchCommand& options_;
  Backend backend_;
  HandSense rest_;
  double goal_ = 0;
  std::int32_t count_ = 0, from_ = 0;
  std::optional<std::int32_t> begun_;  ///< count before anybody has moved
  double sum_ = 0;
  long held_ = 0, waited_ = 0;
  std::atomic<std::size_t> at_ = 0;
  std::array<double, kPoints.size()> counts_{};
  std::array<std::optional<double>, kPoints.size()> truth_{};
};

/// Says what is to be done, once a point.
class PinchPrompts final : public Task {
 public:
  PinchPrompts(const PinchCommand& options, const PinchBench& bench, std::ostream& out)
      : json_(options.json), bench_(bench), out_(out) {}
  std::uint32_t period() const override { return 20; }
  void run(std::uint64_t) override {
    for (; said_ <= bench_.at() && said_ < kPoints.size(); ++said_)
      if (!json_) out_ << kPoints[said_].words << std::endl;
  }

 private:
  bool json_;
  const PinchBench& bench_;
  std::ostream& out_;
  std::size_t said_ = 0;
};

class PinchLoopTask final : public Task {
 public:
  explicit PinchLoopTask(PinchBench& bench) : bench_(bench) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t) override { over_ = !bench_.tick(); }
  bool finished() const override { return over_; }

 private:
  PinchBench& bench_;
  bool over_ = false;
};

}  // namespace

int device_pinch(const PinchCommand& options, std::ostream& out, std::ostream& err) {
  InterruptWatch interrupt;  // before a thread is started: it must inherit what is blocked
  const auto interrupted = [&] { return interrupt.seen() || (options.interrupted && options.interrupted()); };
  PinchBench bench(options);
  PinchPrompts prompts(options, bench, out);
  PinchLoopTask loop(bench);
  if (bench.backend().world) {
    for (prompts.run(0); !loop.finished() && !interrupted(); prompts.run(0)) loop.run(0);
  } else {
    run_device_lanes(bench.backend(), kPinchRateHz, loop, prompts, interrupted);
  }
  if (bench.at() < kPoints.size()) {
    if (!loop.finished()) throw Interrupted();
    err << "trocar: " << kPoints[bench.at()].words << ": not seen within " << options.limit_s << " s; it must rest for "
        << kHeld_s << " s, and lie " << kMoved << " counts from where it was before\n";
    return kNotFound;
  }
  const auto& counts = bench.counts();
  const auto& truth = bench.truths();
  const double span = counts[1] - counts[0];
  if (span < 0)
    throw InputError("the pinch counts down as it opens (" + std::to_string(std::lround(counts[0])) + " to " +
                     std::to_string(std::lround(counts[1])) +
                     "): swap A and B of its encoder, or the ends of its potentiometer");
  DeviceModel model;
  Transmission& t = model.transmission[kPinchChannel];
  model.pinch.design = options.design == "potentiometer" ? PinchDesign::kPotentiometer : PinchDesign::kGeared;
  model.pinch.noise_counts = options.noise;
  model.pinch_travel_m = options.travel_m;
  model.pinch_home_m = std::clamp((counts[2] - counts[0]) / span, 0.0, 1.0) * options.travel_m;
  if (options.ratio_m > 0) t.ratio = options.ratio_m;
  t.counts_per_turn = 2 * std::numbers::pi * t.ratio * span / options.travel_m;
  t.max_motor_torque = options.most_n * t.ratio;
  const double count_mm = 1e3 * options.travel_m / span;
  double worst = 0;
  for (std::size_t i = 0; i < kPoints.size(); ++i)
    if (truth[i]) worst = std::max(worst, std::abs((counts[i] - counts[0]) * count_mm * 1e-3 - *truth[i]));
  const double angle = 2 * std::asin(options.travel_m / 2 / model.pinch.jaw_length_m) * 180 / std::numbers::pi;
  if (options.json) {
    out << nlohmann::ordered_json{{"backend", options.backend},
                                  {"design", options.design},
                                  {"closed_counts", counts[0]},
                                  {"open_counts", counts[1]},
                                  {"count_mm", count_mm},
                                  {"home_mm", 1e3 * model.pinch_home_m},
                                  {"open_deg", angle},
                                  {"worst_error_mm", truth[0] ? nlohmann::ordered_json(1e3 * worst) : nullptr}}
               .dump(2)
        << '\n';
  } else {
    out << std::fixed << std::setprecision(0) << span << " counts from closed to open, one is " << std::setprecision(4)
        << count_mm << " mm; the jig holds it at " << std::setprecision(2) << 1e3 * model.pinch_home_m
        << " mm; jaws of 20 mm open by " << std::setprecision(1) << angle << " deg\n";
    if (truth[0])
      out << "off the truth on the simulated plant by at most " << std::setprecision(3) << 1e3 * worst << " mm\n";
  }
  if (!options.out.empty()) {
    write_file(
        options.out,
        device_toml(
            model,
            "Two points of the pinch, by trocar device pinch.\nclosed_counts is 0: the loop counts from the jig."));
    err << "trocar: device file " << options.out.string() << '\n';
  }
  return 0;
}

void add_device_pinch(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<PinchCommand>();
  PinchCommand& o = *given;
  CLI::App* pinch = add_command(parent, "pinch", "Two points of the pinch's slide as a device file, torque zero",
                                chosen, [given] { return device_pinch(*given, std::cout, std::cerr); });
  pinch->add_option("--backend", o.backend, "Device: simulated, hostmot2, hostmot2-fake, mc4000 or mc4000-emulated")
      ->capture_default_str()
      ->check(CLI::IsMember(
          {kSimulatedBackend, kHostmot2Backend, kFakeHostmot2Backend, kMc4000Backend, kEmulatedMc4000Backend}));
  pinch->add_option("--card", o.card, kCardForms);
  pinch->add_option("--design", o.design, "Of thesis 5.2: geared, or potentiometer")
      ->capture_default_str()
      ->check(CLI::IsMember({"geared", "potentiometer"}));
  pinch->add_option("--travel", o.travel_m, "Of the slide, closed to open, measured, m")
      ->capture_default_str()
      ->check(CLI::Range(0.002, 0.039));
  pinch->add_option("--ratio", o.ratio_m, "Slide a motor radian, m (default: 0.008)")->check(CLI::Range(1e-4, 0.1));
  pinch->add_option("--most", o.most_n, "Most force at the slide, N")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 100.0));
  pinch->add_option("--noise", o.noise, "Counts that a potentiometer trembles by at rest")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  pinch->add_option("--limit", o.limit_s, "Seconds for each point")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 3600.0));
  pinch->add_option("--seed", o.seed, "Of the simulated device")->capture_default_str()->check(seed_range());
  pinch->add_option("--plant", o.plant, "Plant file of the simulated device, instead of the seed's")
      ->check(file_name());
  pinch->add_option("--out", o.out, "Device file (TOML) to write")->check(writable_path());
  pinch->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
