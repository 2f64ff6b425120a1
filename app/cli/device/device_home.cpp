#include "app/cli/device/device_home.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/cli/device/device_lanes.h"
#include "app/session/interrupt.h"
#include "app/session/setup/device_files.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/backends/homing_operator.h"
#include "haptics/device/transmission.h"
#include "haptics/exchange/latest.h"
#include "haptics/haptic_loop.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/director/homing_words.h"
#include "scenarios/files/device_file.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

using nlohmann::ordered_json;

constexpr int kNotHomed = 4;
constexpr double kHomeRateHz = 1000;
const std::vector<std::string> kMethods{"light", "edges", "index"};

std::string joint_words(int channel) {
  return channel == kPinchChannel ? "the pinch" : "joint " + std::to_string(channel + 1);
}

/// What the display has no room for: which joint, how much.
std::string homing_detail(const HomingReport& h) {
  std::ostringstream out;
  out << std::setprecision(3);
  if (h.step == HomingStep::kMarks) {
    out << "marks still to be seen: joints";
    for (int i = 0; i < kArmJoints; ++i)
      if (h.missing >> i & 1) out << ' ' << i + 1;
    if (h.trouble != HomingTrouble::kNone) out << "; ";
  }
  const double degrees = h.value * count_size(Transmission{}) / kDegree;
  if (h.trouble == HomingTrouble::kMoved) out << joint_words(h.channel) << " moved by " << h.value << " counts";
  if (h.trouble == HomingTrouble::kDark) out << "no light for " << h.value << " s";
  if (h.trouble == HomingTrouble::kWrongPose)
    out << joint_words(h.channel)
        << (std::abs(h.channel) == kArmJoints - 1 && h.step != HomingStep::kStill ? ": its light is "
                                                                                  : ": light or mark is ")
        << h.value << " counts (" << degrees << " deg) wide or off";
  if (h.trouble == HomingTrouble::kDeadChannel) out << joint_words(h.channel) << " counted nothing while it was turned";
  if (h.trouble == HomingTrouble::kTimeout) out << "not homed after " << h.value << " s";
  return out.str();
}

class HomeBench {
 public:
  HomeBench(const HomeOptions& options, DeviceModel model)
      : options_(options),
        backend_(make_backend(options.backend, backend_options(options))),
        loop_(loop_of(model)),
        patch_(std::make_unique<ContactPatch>()) {
    if (backend_.world) person_ = std::make_unique<HomingOperator>(*backend_.world, options.seed);
  }

  /// One period. @return whether the homing goes on.
  bool tick() {
    exchange();
    ++ticks_;
    const StylusState& s = record_.stylus;
    if (s.homing.trouble != HomingTrouble::kNone) outcome_.report = s.homing;
    const bool over = s.loop == LoopState::kHomed || s.loop == LoopState::kFault;
    return !over && static_cast<double>(ticks_) < options_.limit_s * kHomeRateHz;
  }

  /// As the homing stands now.
  HomeOutcome outcome() const {
    HomeOutcome out = outcome_;
    const StylusState& s = record_.stylus;
    out.seconds = static_cast<double>(ticks_) / kHomeRateHz;
    out.homed = s.loop == LoopState::kHomed;
    if (s.fault) out.fault = fault_name(s.fault.code);
    if (out.homed || s.homing.trouble != HomingTrouble::kNone || out.report.trouble == HomingTrouble::kNone)
      out.report = s.homing;
    if (!out.homed) return out;
    out.marks = loop_.homing().marks();
    out.offset = loop_.homing().offset();
    for (int i = 0; i < kChannels; ++i) out.counts[i] = record_.in.counts[static_cast<std::size_t>(i)];
    if (backend_.world) out.error = error();
    return out;
  }

  const StylusState& stylus() const { return record_.stylus; }
  const Backend& backend() const { return backend_; }

  /// The stylus is taken out, and everything is forgotten but where the counters stand.
  void again(const DeviceModel& model) {
    loop_ = HapticLoop(loop_of(model));
    record_ = {};
    outcome_ = {};
    ticks_ = 0;
    if (!backend_.world) return;
    JointVector out = JointVector::Zero();
    out[kArmJoints - 2] = 20 * kDegree;
    backend_.world->lead_arm(out, 1.5);
    for (int k = 0; k < 1600; ++k) backend_.daq->read();
  }

 private:
  static BackendOptions backend_options(const HomeOptions& options) {
    BackendOptions out;
    out.card = options.card;
    out.simulated.rate_hz = kHomeRateHz;
    out.simulated.seed = options.seed;
    if (!options.plant.empty()) out.simulated.plant = true_plant(options.plant, options.seed).parameters;
    if (options.method == "index") {
      if (!out.simulated.plant) out.simulated.plant = draw_parameters(options.seed);
      out.simulated.plant->options.encoder.index = 1;
    }
    for (const std::string& text : options.injections) out.simulated.faults.push_back(parse_injection(text));
    return out;
  }
  HapticLoopConfig loop_of(const DeviceModel& model) const {
    HapticLoopConfig config;
    config.daq = backend_.daq->capabilities();
    config.device = model;
    // Where the marks lie is what is to be found: nothing is known of them yet.
    if (!options_.learn.empty()) config.safety.homing.jig_counts = config.safety.homing.roll_counts = 1e9;
    return config;
  }
  void exchange() {
    const DaqSample sample = backend_.daq->read();
    const DacFrame codes = loop_.tick(sample, *patch_, record_);
    const bool silent = std::all_of(codes.codes.begin(), codes.codes.end(), [](std::int32_t c) { return c == 0; });
    outcome_.torque_free = outcome_.torque_free && silent && !record_.amplifiers_armed;
    backend_.daq->arm(record_.amplifiers_armed);
    backend_.daq->write(codes);
    if (person_ && record_.stylus.loop == LoopState::kUnhomed) person_->follow(record_.stylus.homing);
  }
  /// Of what the loop takes for its angles, against where the simulated arm truly is, counts.
  ChannelVector error() const {
    const HandSense truth = backend_.world->sense();
    ChannelVector q = record_.q;
    const JointVector near = q.head<kArmJoints>();
    if (const auto exact = inverse_within_limits(truth.X_BS, near)) q.head<kArmJoints>() -= *exact;
    q[kPinchChannel] -= truth.jaw_opening_m;
    for (int i = 0; i < kChannels; ++i)
      q[i] /= count_size(loop_.config().device.transmission[static_cast<std::size_t>(i)]);
    return q;
  }

  const HomeOptions& options_;
  Backend backend_;
  HapticLoop loop_;
  std::unique_ptr<ContactPatch> patch_;
  std::unique_ptr<HomingOperator> person_;
  TickRecord record_;
  HomeOutcome outcome_;
  long ticks_ = 0;
};

DeviceModel model_of(const HomeOptions& options) {
  std::optional<HomingMethod> asked;
  for (std::size_t i = 0; i < kMethods.size(); ++i)
    if (options.method == kMethods[i]) asked = static_cast<HomingMethod>(i);
  DeviceModel model = device_model(read_device_files({}, options.device), options.backend, asked);
  model.homing.see_dark = true;  // a light that was never dark tells nothing
  return model;
}

ordered_json channel_list(const ChannelVector& v) {
  ordered_json list = ordered_json::array();
  for (int i = 0; i < kChannels; ++i) list.push_back(std::isfinite(v[i]) ? ordered_json(v[i]) : ordered_json(nullptr));
  return list;
}

ordered_json home_json(const HomeOutcome& o) {
  return {{"homed", o.homed},
          {"seconds", o.seconds},
          {"torque_free", o.torque_free},
          {"fault", o.fault.empty() ? ordered_json(nullptr) : ordered_json(o.fault)},
          {"trouble", static_cast<int>(o.report.trouble)},
          {"detail", homing_detail(o.report)},
          {"steps", o.steps},
          {"error_counts", o.homed ? channel_list(o.error) : ordered_json(nullptr)},
          {"marks_counts", o.homed ? channel_list(o.marks) : ordered_json(nullptr)}};
}

/// Mean and spread of the error of each channel over the repeats that were homed.
void print_errors(const std::vector<HomeOutcome>& all, std::ostream& out) {
  const double to_deg = count_size(Transmission{}) / kDegree;
  out << "zero off the truth on the simulated plant, counts (joints: one is " << std::setprecision(4) << to_deg
      << " deg): mean, spread, worst over the repeats\n";
  for (int i = 0; i < kChannels; ++i) {
    double n = 0, sum = 0, squares = 0, worst = 0;
    for (const HomeOutcome& o : all) {
      if (!o.homed) continue;
      ++n, sum += o.error[i], squares += o.error[i] * o.error[i], worst = std::max(worst, std::abs(o.error[i]));
    }
    if (n == 0) continue;
    const double mean = sum / n, spread = std::sqrt(std::max(0.0, squares / n - mean * mean));
    out << "  " << std::left << std::setw(10) << joint_words(i) << std::right << std::fixed << std::setprecision(2)
        << std::setw(9) << mean << std::setw(9) << spread << std::setw(9) << worst << '\n';
  }
}

/// Places of the marks from home, by the counters alone: `marks` where they were passed, `home` where the jig and the
/// edges of its light put the zero.
ChannelVector places_from_home(const HomeOutcome& marks, const HomeOutcome& home) {
  const ChannelVector mark = marks.counts - marks.offset + marks.marks, zero = home.counts - home.offset;
  ChannelVector out = mark - zero;
  for (int i = 0; i < kArmJoints; ++i) out[i] = std::remainder(out[i], HomingLimits{}.index_turn);
  return out;
}

/// Mean over the repeats: what the index method needs to know.
void write_marks(const HomeOptions& options, DeviceModel model, const std::vector<ChannelVector>& places) {
  for (int i = 0; i < kArmJoints; ++i) {
    double sum = 0;
    for (const ChannelVector& p : places)  // near half a turn the nearest mark may be that of either side
      sum += places.front()[i] + std::remainder(p[i] - places.front()[i], HomingLimits{}.index_turn);
    model.homing.index_counts[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::lround(sum / static_cast<double>(places.size())));
  }
  model.homing.method = HomingMethod::kIndex;
  write_file(options.learn, device_toml(model, "Marks of the encoders, learnt in the jig by trocar device home."));
}

/// All that were asked for, the stylus out of the jig in between; with --learn each by the marks and once more by the
/// light's edges.
class Homings {
 public:
  Homings(const HomeOptions& options, HomeBench& bench, const DeviceModel& model)
      : options_(options), bench_(bench), model_(model), by_edges_(model) {
    by_edges_.homing.method = HomingMethod::kEdges;
  }

  /// One period. @return whether there is more to do.
  bool tick() {
    if (bench_.tick()) return true;
    const HomeOutcome done = bench_.outcome();
    if (!options_.learn.empty() && !marks_ && done.homed) {
      marks_ = done;
      bench_.again(by_edges_);
      return true;
    }
    all_.push_back(done);
    over_ = !done.homed || static_cast<int>(all_.size()) == options_.repeat;
    if (marks_ && done.homed) places_.push_back(places_from_home(*marks_, done));
    marks_.reset();
    if (!over_) bench_.again(model_);
    return !over_;
  }
  std::size_t number() const { return all_.size(); }

  /// What was done, and the one that was cut off.
  std::vector<HomeOutcome> end() {
    if (!over_) all_.push_back(bench_.outcome());
    if (!options_.learn.empty() && all_.back().homed) write_marks(options_, model_, places_);
    return std::move(all_);
  }

 private:
  const HomeOptions& options_;
  HomeBench& bench_;
  DeviceModel model_, by_edges_;
  std::optional<HomeOutcome> marks_;  ///< of a homing by them, whose edges are still to be found
  std::vector<HomeOutcome> all_;
  std::vector<ChannelVector> places_;
  bool over_ = false;
};

/// What is said on the way, each step once.
class HomingSpeech {
 public:
  HomingSpeech(const HomeOptions& options, std::ostream& out)
      : json_(options.json), out_(out), steps_(static_cast<std::size_t>(options.repeat)) {}

  void hear(std::size_t homing, const StylusState& s) {
    const HomingWords words = homing_words(s.loop, s.homing);
    const std::string now = s.loop == LoopState::kSelfTest ? "Self-test: leave it alone; the deadman open."
                                                           : std::string(words.title) + ". " + words.hint;
    const bool begun_now = s.loop == LoopState::kUnhomed && s.homing.step == HomingStep::kNone;
    const bool nothing = s.loop == LoopState::kOff || s.loop == LoopState::kHomed || s.loop == LoopState::kFault;
    if (homing >= steps_.size() || now == said_ || nothing || begun_now) return;
    said_ = now;
    const std::string detail = homing_detail(s.homing);
    steps_[homing].push_back(now + (detail.empty() ? "" : " (" + detail + ")"));
    if (!json_)
      out_ << std::fixed << std::setprecision(1) << std::setw(7) << s.t_s << " s  " << steps_[homing].back()
           << std::endl;
  }
  const std::vector<std::string>& steps(std::size_t homing) const { return steps_[homing]; }

 private:
  bool json_;
  std::ostream& out_;
  std::string said_;
  std::vector<std::vector<std::string>> steps_;
};

/// A moment of a homing, from the loop's thread to the one that speaks.
struct HomingMoment {
  std::size_t number = 0;
  StylusState stylus;
};

class HomingLoopTask final : public Task {
 public:
  HomingLoopTask(Homings& homings, const HomeBench& bench, Latest<HomingMoment>& newest)
      : homings_(homings), bench_(bench), newest_(newest) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t) override {
    const std::size_t number = homings_.number();
    over_ = !homings_.tick();
    newest_.write({number, bench_.stylus()});
  }
  bool finished() const override { return over_; }

 private:
  Homings& homings_;
  const HomeBench& bench_;
  Latest<HomingMoment>& newest_;
  bool over_ = false;
};

class HomingSpeechTask final : public Task {
 public:
  HomingSpeechTask(HomingSpeech& speech, Latest<HomingMoment>& newest) : speech_(speech), newest_(newest) {}
  std::uint32_t period() const override { return 20; }
  void run(std::uint64_t) override {
    const HomingMoment& now = newest_.read();
    speech_.hear(now.number, now.stylus);
  }

 private:
  HomingSpeech& speech_;
  Latest<HomingMoment>& newest_;
};

}  // namespace

std::vector<HomeOutcome> home_device(const HomeOptions& options, std::ostream& out) {
  const DeviceModel model = model_of(options);
  if (!options.learn.empty() && model.homing.method != HomingMethod::kIndex)
    throw InputError("--learn: needs --method index, and encoders whose index is wired");
  HomeBench bench(options, model);
  Homings homings(options, bench, model);
  HomingSpeech speech(options, out);
  if (bench.backend().world) {
    bool more = true;
    while (more && !(options.interrupted && options.interrupted())) {
      const std::size_t number = homings.number();
      more = homings.tick();
      speech.hear(number, bench.stylus());
    }
  } else {
    Latest<HomingMoment> newest;
    HomingLoopTask loop(homings, bench, newest);
    HomingSpeechTask said(speech, newest);
    run_device_lanes(bench.backend(), kHomeRateHz, loop, said, options.interrupted);
  }
  std::vector<HomeOutcome> all = homings.end();
  for (std::size_t k = 0; k < all.size() && k < static_cast<std::size_t>(options.repeat); ++k)
    all[k].steps = speech.steps(k);
  return all;
}

int device_home(const HomeOptions& given, std::ostream& out, std::ostream& err) {
  HomeOptions options = given;
  InterruptWatch interrupt;
  if (!options.interrupted) options.interrupted = [&] { return interrupt.seen(); };
  const std::vector<HomeOutcome> all = home_device(options, out);
  const HomeOutcome& last = all.back();
  if (options.json) {
    ordered_json list = ordered_json::array();
    for (const HomeOutcome& o : all) list.push_back(home_json(o));
    out << ordered_json{{"backend", options.backend}, {"homings", list}}.dump(2) << '\n';
  } else if (last.homed && backend_abilities(options.backend).pace) {
    print_errors(all, out);
  }
  const bool torque_free = std::all_of(all.begin(), all.end(), [](const HomeOutcome& o) { return o.torque_free; });
  if (last.homed)
    err << "trocar: homed " << all.size() << (all.size() == 1 ? " time on " : " times on ") << options.backend
        << ", the last in " << last.seconds << " s, "
        << (torque_free ? "torque off throughout\n" : "TORQUE WAS ASKED FOR on the way: report this\n");
  else
    err << "trocar: not homed on " << options.backend << " after " << last.seconds << " s: "
        << (!last.fault.empty() ? "fault " + last.fault
            : homing_detail(last.report).empty()
                ? std::string(homing_words(LoopState::kUnhomed, last.report).title) + ". " +
                      homing_words(LoopState::kUnhomed, last.report).hint
                : homing_words(LoopState::kUnhomed, last.report).hint + (" " + homing_detail(last.report)))
        << '\n';
  return last.homed ? 0 : kNotHomed;
}

void add_device_home(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<HomeOptions>();
  HomeOptions& o = *given;
  CLI::App* home = add_command(parent, "home", "Home the device, torque off, and say what to do next; 4 when it is not",
                               chosen, [given] { return device_home(*given, std::cout, std::cerr); });
  home->add_option("--backend", o.backend, "Device: simulated, hostmot2, hostmot2-fake, mc4000 or mc4000-emulated")
      ->capture_default_str()
      ->check(CLI::IsMember(
          {kSimulatedBackend, kHostmot2Backend, kFakeHostmot2Backend, kMc4000Backend, kEmulatedMc4000Backend}));
  home->add_option("--card", o.card, kCardForms);
  home->add_option("--method", o.method,
                   "Zero from the light, its edges, or the encoders' index (default: device file's)")
      ->check(CLI::IsMember(kMethods));
  home->add_option("--device", o.device, "Device file: method and places of the marks")->check(file_name());
  home->add_option("--learn", o.learn, "Device file to write with the places of the marks, learnt in the jig")
      ->check(writable_path());
  home->add_option("--repeat", o.repeat, "Homings, the stylus out of the jig in between")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  home->add_option("--limit", o.limit_s, "Seconds for each")->capture_default_str()->check(CLI::Range(1.0, 3600.0));
  home->add_option("--seed", o.seed, "Of the simulated device and its person")
      ->capture_default_str()
      ->check(seed_range());
  home->add_option("--plant", o.plant, "Plant file of the simulated device, instead of the seed's")->check(file_name());
  home->add_option("--inject", o.injections, "Device fault as in run, repeatable: beam-dark@0, beam-lit@0, ...");
  home->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
