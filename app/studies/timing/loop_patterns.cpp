#include "app/studies/timing/loop_patterns.h"

#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include "app/cli/attempts/run_command.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kPatternHz = 1000;
constexpr std::int64_t kPatternPeriod = 1'000'000, kPeersWork = 100'000, kPeersSlack = 2'000'000;  // ns
constexpr int kLoopFifo = 80;
constexpr std::int64_t kCyclictestBins = 20'000;  // us

std::int64_t clock_ns() {
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

/// Wakes of a loop that works 0.1 ms a tick. @param await returns at or after the time that it is given.
template <typename Await>
std::vector<std::int64_t> wakes_of(double seconds, Await await) {
  std::vector<std::int64_t> wakes;
  wakes.reserve(static_cast<std::size_t>(seconds * kPatternHz * 1.1) + 1);
  const std::int64_t end = clock_ns() + std::llround(seconds * 1e9);
  for (std::int64_t now = clock_ns(); now < end;) {
    wakes.push_back(now);
    while (clock_ns() < now + kPeersWork) {
    }
    now = await(now + kPatternPeriod);
  }
  return wakes;
}

/// No work: the wait that is left.
class Nothing final : public Task {
 public:
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t) override {}
};

/// From the first time that it is asked: what comes before the run is no part of the slice.
std::function<bool()> after(double seconds) {
  return [seconds, end = std::int64_t{0}]() mutable {
    if (end == 0) end = clock_ns() + std::llround(seconds * 1e9);
    return clock_ns() >= end;
  };
}

/// The loop's exercise, built once: a live attempt needs seconds for it.
struct Prepared {
  AssetRoots assets = find_assets();
  Scene scene = [this] {
    RunOptions options;
    options.exercise = "surface-touch";
    options.hand = "expert";
    options.realtime = true;
    const AttemptSetup setup = attempt_setup(options, assets);
    return build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
  }();
};

struct Answer {
  std::string text;
  bool ended_well = false;
};

Answer answer_of(const std::string& command) {
  Answer out;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return out;
  std::array<char, 4096> part;
  for (std::size_t n; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) out.text.append(part.data(), n);
  out.ended_well = ::pclose(pipe) == 0;
  return out;
}

std::string first_line_of(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

void PatternRun::add(const PatternRun& slice) {
  if (name.empty()) name = slice.name;
  scheduler = slice.scheduler;
  refused = slice.refused;
  awake_s += slice.awake_s;
  missed += slice.missed;
  longest_gap_ns = std::max(longest_gap_ns, slice.longest_gap_ns);
  late.add(slice.late);
  period.add(slice.period);
  work.add(slice.work);
}

PatternRun pattern_of(const std::string& name, const LaneReport& report) {
  PatternRun out{name, report.policy, report.refusal, report.awake_s, report.missed, report.longest_gap_ns};
  out.late = report.late;
  out.period = report.period;
  out.work = report.cpu;
  return out;
}

PatternRun pattern_of_wakes(const std::string& name, const std::vector<std::int64_t>& wakes_ns,
                            std::int64_t period_ns) {
  PatternRun out{name, "SCHED_OTHER", ""};
  for (std::size_t i = 1; i < wakes_ns.size(); ++i) {
    const std::int64_t gap = wakes_ns[i] - wakes_ns[i - 1];
    out.late.add(gap - period_ns);
    out.period.add(gap);
    out.awake_s += static_cast<double>(gap) * 1e-9;
    out.missed += static_cast<std::uint64_t>(std::max<std::int64_t>(0, gap / period_ns - 1));
    out.longest_gap_ns = std::max(out.longest_gap_ns, gap);
  }
  return out;
}

PatternRun live_attempt(double seconds) {
  static const Prepared prepared;
  MemorySink memory;
  RecordingWriter writer(memory, "", kPatternHz);
  PatternRun out;
  SessionHooks hooks;
  hooks.interrupted = after(seconds);
  hooks.paced = [&](const ThreadedExecutor& executor) {
    out = pattern_of("Trocar, live", *executor.reports().front());
  };
  run_session(prepared.scene, prepared.assets, hooks, writer);
  return out;
}

PatternRun wait_alone(double seconds) {
  Nothing nothing;
  ThreadedExecutor executor(kPatternHz);
  executor.add_lane("wait", {&nothing}, kLoopFifo);
  executor.keep_awake();
  executor.run(after(seconds));
  return pattern_of("wait alone", *executor.reports().front());
}

PatternRun busy_wait(double seconds) {
  return pattern_of_wakes("spin",
                          wakes_of(seconds,
                                   [](std::int64_t until) {
                                     std::int64_t now = 0;
                                     while ((now = clock_ns()) < until) {
                                     }
                                     return now;
                                   }),
                          kPatternPeriod);
}

PatternRun sleep_and_yield(double seconds) {
  return pattern_of_wakes("sleep-yield",
                          wakes_of(seconds,
                                   [](std::int64_t until) {
                                     std::int64_t now = clock_ns();
                                     if (const std::int64_t rest = until - kPeersSlack - now; rest > 0) {
                                       const timespec left{0, rest};
                                       ::nanosleep(&left, nullptr);
                                     }
                                     while ((now = clock_ns()) < until) ::sched_yield();
                                     return now;
                                   }),
                          kPatternPeriod);
}

PatternRun cyclictest(double seconds) {
  const std::string common = "cyclictest -q -t 1 -i 1000 -h " + std::to_string(kCyclictestBins) + " -l " +
                             std::to_string(std::max(1L, std::lround(seconds * kPatternHz)));
  PatternRun out{"cyclictest", "SCHED_FIFO 80", ""};
  const Answer with_rights = answer_of(common + " -m -p 80");
  if (with_rights.ended_well && read_cyclictest(with_rights.text, out)) return out;
  const Answer without = answer_of(common + " --policy=other");
  out.scheduler = "SCHED_OTHER";
  if (without.ended_well && read_cyclictest(without.text, out)) return out;
  const std::string said = first_line_of(without.text);
  out.refused =
      said.find("not found") != std::string::npos ? "not installed (apt install rt-tests)" : "said \"" + said + "\"";
  return out;
}

bool read_cyclictest(const std::string& text, PatternRun& run) {
  std::istringstream lines(text);
  std::int64_t longest_us = 0;
  std::uint32_t overflows = 0;
  PatternRun read;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    std::uint32_t count = 0;
    if (line.starts_with("# Max Latencies:")) words.ignore(16) >> longest_us;
    if (line.starts_with("# Histogram Overflows:")) words.ignore(22) >> overflows;
    if (!(words >> first >> count) || first.find_first_not_of("0123456789") != std::string::npos || first.size() > 9)
      continue;
    read.late.add(std::stoll(first) * 1000, count);
  }
  read.late.add(longest_us * 1000, overflows);
  if (read.late.count() == 0) return false;
  run.late.add(read.late);
  return true;
}

BusyProcesses::BusyProcesses(int count) {
  for (int i = 0; i < count; ++i) {
    const pid_t process = ::fork();
    if (process == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (volatile unsigned n = 0;;) n = n + 1;
    }
    if (process < 0) throw EnvironmentError("study timing: no process can be started to keep the machine busy");
    processes_.push_back(process);
  }
}

BusyProcesses::~BusyProcesses() {
  for (const int process : processes_) {
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
}

}  // namespace trocar
