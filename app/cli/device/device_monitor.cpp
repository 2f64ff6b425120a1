#include "app/cli/device/device_monitor.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/cli/device/device_lanes.h"
#include "app/session/interrupt.h"
#include "app/session/setup/device_files.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/exchange/latest.h"
#include "haptics/haptic_loop.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kLinesHz = 10;
constexpr double kInJigS = 0.65;     // self-test and homing
constexpr double kSoftStartS = 1.2;  // before the hand begins to move
constexpr double kCircle_m = 0.015, kTurnsHz = 0.25;
constexpr int kDeviceFault = 4;
constexpr double kDegrees = 180 / std::numbers::pi;

/// The loop on a simulated device that a hand leads through free air, or on a real one whose amplifiers stay off.
class Bench {
 public:
  Bench(const MonitorOptions& options, const DeviceFiles& files)
      : backend_(make_backend(options.backend, {.simulated = device_of(options), .card = options.card})),
        loop_(loop_of(options, files, backend_.daq->capabilities())),
        patch_(std::make_unique<ContactPatch>()) {
    if (backend_.world) centre_ = goal_ = backend_.world->sense().X_BS;
  }

  const TickRecord& tick() {
    if (backend_.world) lead();
    const DaqSample sample = backend_.daq->read();
    DaqSample heard = sample;
    if (!backend_.world) heard.digital_in &= ~std::uint32_t{kDeadman};
    const DacFrame out = loop_.tick(heard, *patch_, record_);
    record_.in.digital_in = sample.digital_in;
    backend_.daq->arm(backend_.world && record_.amplifiers_armed);
    backend_.daq->write(backend_.world ? out : DacFrame{});
    return record_;
  }
  const TickRecord& record() const { return record_; }
  Backend& backend() { return backend_; }

 private:
  static SimulatedDaqConfig device_of(const MonitorOptions& options) {
    SimulatedDaqConfig config;
    config.seed = options.seed;
    config.rate_hz = options.rate_hz;
    for (const std::string& text : options.injections) config.faults.push_back(parse_injection(text));
    return config;
  }
  static HapticLoopConfig loop_of(const MonitorOptions& options, const DeviceFiles& files, const DaqCapabilities& daq) {
    HapticLoopConfig config;
    config.daq = daq;
    config.device = device_model(files, options.backend);
    return config;
  }

  void lead() {
    const double now_s = backend_.world->time_s();
    if (now_s < kInJigS) return;
    const double turning_s = now_s - kInJigS - kSoftStartS;
    if (turning_s > 0) {
      const double angle = 2 * std::numbers::pi * kTurnsHz * turning_s, grown = std::min(1.0, turning_s);
      goal_.p = centre_.p + grown * kCircle_m * Vec3(std::cos(angle) - 1, std::sin(angle), 0);
    }
    backend_.world->set_hand_intent(goal_, 0.020);
  }

  Backend backend_;  ///< its amplifiers go off with it
  HapticLoop loop_;
  std::unique_ptr<ContactPatch> patch_;
  TickRecord record_;
  Pose goal_, centre_;
};

std::vector<std::string> warnings_of(const TickRecord& record) {
  std::vector<std::string> names;
  for (const LoopWarning warning : kLoopWarnings) {
    if (record.warnings & bit(warning)) names.emplace_back(warning_name(warning));
  }
  return names;
}

template <class Vector>
std::vector<double> list(const Vector& v, int count) {
  return {v.data(), v.data() + count};
}

nlohmann::ordered_json to_json(const TickRecord& r) {
  const Pose X_WS = arm_state(r.q.head<kArmJoints>()).X_WS;
  const Fault& fault = r.stylus.fault;
  return {{"t_s", r.stylus.t_s},
          {"state", loop_state_name(r.stylus.loop)},
          {"fault", fault ? nlohmann::ordered_json(fault_name(fault.code)) : nlohmann::ordered_json(nullptr)},
          {"fault_channel",
           fault && fault.channel >= 0 ? nlohmann::ordered_json(fault.channel) : nlohmann::ordered_json(nullptr)},
          {"warnings", warnings_of(r)},
          {"armed", r.amplifiers_armed},
          {"counts", r.in.counts},
          {"valid", r.in.valid},
          {"digital_in", r.in.digital_in},
          {"q_rad", list(r.q, kArmJoints)},
          {"jaw_m", r.q[kPinchChannel]},
          {"stylus_m", list(X_WS.p, 3)},
          {"stylus_axis", list(Vec3(X_WS.R.col(2)), 3)},
          {"det_a", r.det_a},
          {"torque_n_m", list(r.torque, kArmJoints)},
          {"pinch_n", r.torque[kPinchChannel]},
          {"winding_c", r.winding_c},
          {"energy_j", r.stylus.energy_j}};
}

/// Numbers in fixed columns.
template <class Vector>
std::string monitor_row(const Vector& v, int count, double scale, int decimals, int width) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals);
  for (int i = 0; i < count; ++i) text << std::setw(width) << scale * v[i];
  return text.str();
}

std::string fault_words(const TickRecord& r) {
  const Fault& fault = r.stylus.fault;
  std::string words = fault ? fault_name(fault.code) : "none";
  if (fault && fault.channel >= 0) words += " on channel " + std::to_string(fault.channel);
  for (const std::string& warning : warnings_of(r)) words += ", warning " + warning;
  return words;
}

void print_line(const TickRecord& r, std::ostream& out) {
  const Pose X_WS = arm_state(r.q.head<kArmJoints>()).X_WS;
  out << std::fixed << std::setprecision(1) << std::setw(6) << r.stylus.t_s << " s  " << std::left << std::setw(9)
      << loop_state_name(r.stylus.loop) << std::right << "  q deg" << monitor_row(r.q, kArmJoints, kDegrees, 1, 7)
      << "  stylus mm" << monitor_row(X_WS.p, 3, 1e3, 1, 7) << std::setprecision(3) << "  det A " << r.det_a
      << "  torque mN m" << monitor_row(r.torque, kArmJoints, 1e3, 0, 6) << std::setprecision(1) << "  hottest "
      << r.winding_c << " C  fault " << fault_words(r) << '\n';
}

constexpr int kBlockLines = 8;

void print_block(const TickRecord& r, bool first, std::ostream& out) {
  const Pose X_WS = arm_state(r.q.head<kArmJoints>()).X_WS;
  const char* end = "\033[K\n";
  if (!first) out << "\033[" << kBlockLines << 'A';
  out << std::fixed << std::setprecision(1) << "time     " << r.stylus.t_s << " s, " << loop_state_name(r.stylus.loop)
      << (r.amplifiers_armed ? ", amplifiers on" : ", amplifiers off") << end;
  out << "counts   ";
  for (const std::int32_t count : r.in.counts) out << std::setw(12) << count;
  out << end << "joints   " << monitor_row(r.q, kArmJoints, kDegrees, 2, 9) << " deg, jaw " << 1e3 * r.q[kPinchChannel]
      << " mm" << end;
  out << "stylus   " << monitor_row(X_WS.p, 3, 1e3, 2, 9) << " mm, axis" << monitor_row(Vec3(X_WS.R.col(2)), 3, 1, 3, 8)
      << end;
  out << "det A    " << std::setprecision(3) << r.det_a << end;
  out << "torque   " << monitor_row(r.torque, kArmJoints, 1e3, 1, 9) << " mN m, pinch " << r.torque[kPinchChannel]
      << " N" << end;
  out << "hottest  " << std::setprecision(1) << r.winding_c << " C by the model" << end;
  out << "fault    " << fault_words(r) << end << std::flush;
}

}  // namespace

namespace {

void show(const MonitorOptions& options, const TickRecord& record, bool first, std::ostream& out) {
  if (options.json)
    out << to_json(record).dump() << '\n' << std::flush;
  else if (options.terminal)
    print_block(record, first, out);
  else
    print_line(record, out), out << std::flush;
}

class BenchTask final : public Task {
 public:
  BenchTask(Bench& bench, Latest<TickRecord>& newest) : bench_(bench), newest_(newest) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t) override { newest_.write(bench_.tick()); }

 private:
  Bench& bench_;
  Latest<TickRecord>& newest_;
};

class LinesTask final : public Task {
 public:
  LinesTask(const MonitorOptions& options, Latest<TickRecord>& newest, long lines, std::ostream& out)
      : options_(options), newest_(newest), left_(lines), out_(out) {}
  std::uint32_t period() const override { return static_cast<std::uint32_t>(options_.rate_hz / kLinesHz); }
  void run(std::uint64_t tick) override {
    if (tick == 0) return;  // the loop has only begun
    show(options_, newest_.read(), tick == 1, out_);
    --left_;
  }
  bool finished() const override { return left_ <= 0; }

 private:
  const MonitorOptions& options_;
  Latest<TickRecord>& newest_;
  long left_;
  std::ostream& out_;
};

/// A device with a clock of its own: at its rate, as a run would be.
int watch_device(const MonitorOptions& options, Bench& bench, long lines, std::ostream& out, std::ostream& err) {
  const auto newest = std::make_unique<Latest<TickRecord>>();
  BenchTask loop(bench, *newest);
  LinesTask shown(options, *newest, lines, out);
  const LaneReport report = run_device_lanes(bench.backend(), options.rate_hz, loop, shown, options.interrupted);
  err << "trocar: " << options.backend << " looked at for " << std::fixed << std::setprecision(1) << report.seconds
      << " s at " << report.rate_hz() << " Hz, " << report.policy << ", " << report.missed
      << " periods missed; its amplifiers stayed off\n";
  return bench.record().stylus.fault ? kDeviceFault : 0;
}

}  // namespace

int monitor(const MonitorOptions& options, std::ostream& out, std::ostream& err) {
  using Clock = std::chrono::steady_clock;
  const bool own_clock = !backend_abilities(options.backend).pace;
  if (own_clock && options.lockstep)
    throw InputError("--backend " + options.backend + ": runs by its own clock; leave --lockstep away");
  if (own_clock && !options.injections.empty())
    throw InputError("--backend " + options.backend + ": --inject is for simulated devices");
  const DeviceFiles files = read_device_files(options.calibration, options.device);
  if (!own_clock)
    for (const std::string& doubt : device_doubts(files, simulated_plant_words(options.seed)))
      err << "trocar: " << doubt << '\n';
  Bench bench(options, files);
  const auto ticks_a_line = static_cast<int>(std::lround(options.rate_hz / kLinesHz));
  const auto lines = std::max<long>(1, std::lround(options.seconds * kLinesHz));
  if (own_clock) return watch_device(options, bench, lines, out, err);
  auto due = Clock::now();
  for (long line = 0; line < lines && !(options.interrupted && options.interrupted()); ++line) {
    for (int k = 0; k < ticks_a_line; ++k) bench.tick();
    due += std::chrono::milliseconds(static_cast<int>(1e3 / kLinesHz));
    if (!options.lockstep) std::this_thread::sleep_until(due);
    show(options, bench.record(), line == 0, out);
  }
  err << "trocar: " << bench.backend().world->time_s() << " s of the simulated device behind " << options.backend
      << ", seed " << options.seed << '\n';
  return bench.record().stylus.fault ? kDeviceFault : 0;
}

int device_monitor(const MonitorOptions& given, std::ostream& out, std::ostream& err) {
  if (!std::isfinite(given.seconds)) throw InputError("device monitor: --seconds is a number");
  InterruptWatch interrupt;
  MonitorOptions options = given;
  options.terminal = isatty(STDOUT_FILENO) != 0;
  options.interrupted = [&] { return interrupt.seen(); };
  return monitor(options, out, err);
}

void add_device_monitor(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<MonitorOptions>();
  MonitorOptions& o = *given;
  CLI::App* monitor = add_command(parent, "monitor", "Live values of the device loop, ten times a second", chosen,
                                  [given] { return device_monitor(*given, std::cout, std::cerr); });
  std::string backends;
  for (const std::string& name : backend_names()) backends += (backends.empty() ? "" : ", ") + name;
  monitor
      ->add_option("--backend", o.backend, "Device that is looked at, a real one with its amplifiers off: " + backends)
      ->capture_default_str();
  monitor->add_option("--card", o.card, kCardForms);
  monitor->add_option("--seconds", o.seconds, "Until it ends by itself")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  monitor->add_flag("--lockstep", o.lockstep, "As fast as it goes instead of by the clock");
  add_device_file_options(*monitor, o.calibration, o.device);
  monitor->add_flag("--json", o.json, "A JSON object a line");
  monitor->add_option("--seed", o.seed, "Of the simulated device")->capture_default_str()->check(seed_range());
  monitor->add_option("--rate", o.rate_hz, "Loop rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
  monitor->add_option("--inject", o.injections, "Device fault as in run, repeatable");
}

}  // namespace trocar
