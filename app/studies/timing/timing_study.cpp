#include "app/studies/timing/timing_study.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <thread>

#include "app/session/grading/realtime_report.h"
#include "app/session/lanes/real_time.h"
#include "trainees/markup/pacing.h"

namespace trocar {
namespace {

constexpr double kNominalHz = 1000;
constexpr std::int64_t kNominalUs = 1000;
constexpr int kGridPerDecade = 20, kGridDecades = 5;  // from 1 us

using Measure = DurationCounts PatternRun::*;

struct NamedShare {
  const char* name;
  double share;
};
constexpr NamedShare kPercentiles[] = {{"p50", 0.5}, {"p90", 0.9}, {"p99", 0.99}, {"p99.9", 0.999}};

const PatternRun* run_named(const TimedLoad& load, const std::string& name) {
  const auto at =
      std::find_if(load.runs.begin(), load.runs.end(), [&](const PatternRun& run) { return run.name == name; });
  return at == load.runs.end() || at->late.count() == 0 ? nullptr : &*at;
}

std::string load_words(const TimedLoad& load) {
  return load.busy == 0 ? "idle" : std::to_string(load.busy) + " busy processes";
}

/// What ours is held against: cyclictest, or where it did not run the wait alone.
struct Beside {
  const PatternRun* run = nullptr;
  std::string name;
};
Beside beside_of(const TimedLoad& load) {
  if (const PatternRun* run = run_named(load, "cyclictest")) return {run, "cyclictest"};
  return {run_named(load, "wait alone"), "the wait alone"};
}

/// Periods that passed while whoever ran beside ours waited for its wake: it does not catch up either.
std::string lost_beside(const Beside& beside) {
  if (!beside.run) return "";
  std::uint64_t lost = 0;
  beside.run->late.each([&](std::int64_t lower_us, std::uint64_t count) {
    lost += static_cast<std::uint64_t>(lower_us / kNominalUs) * count;
  });
  return " While " + beside.name + " waited beside it, " + std::to_string(lost) + " of " +
         std::to_string(beside.run->late.count() + lost) + " passed so: as many are the machine's.";
}

void add_rate(StudyResult& study, const TimedLoad& load, const PatternRun& run, bool judged) {
  const double rate = run.rate_hz();
  study.cases.push_back({"mean rate, " + run.name + ", " + load_words(load), "Hz", rate, std::nullopt,
                         judged ? "1000.0 on average" : "reported",
                         !judged || std::abs(rate - kNominalHz) < kAverageTolerance,
                         "Wakes over the time from the first that was asked for to the last that was; " +
                             std::to_string(run.missed) + " of " + std::to_string(run.late.count() + run.missed) +
                             " periods passed without one." + (judged ? lost_beside(beside_of(load)) : "")});
}

void add_percentiles(StudyResult& study, const TimedLoad& load, bool judged) {
  const PatternRun& ours = load.runs.front();
  const Beside beside = beside_of(load);
  const auto add = [&](const std::string& name, double value, std::optional<double> other, bool held) {
    const double bar = other ? kMostOfCyclictest * *other : 0;
    study.cases.push_back({"wake-up late, " + name + ", " + load_words(load), "us", value, other,
                           held && other ? "<= 1.5 x " + beside.name : "reported",
                           !held || (ours.late.count() > 0 && (!other || value <= bar)),
                           "Wake after its time, upper end of a bin of 1 us; beside it that of " + beside.name + "."});
  };
  for (const NamedShare& p : kPercentiles)
    add(p.name, ours.late.percentile_us(p.share),
        beside.run ? std::optional(beside.run->late.percentile_us(p.share)) : std::nullopt, judged);
  const auto longest = [](const PatternRun& run) { return static_cast<double>(run.late.max_ns()) * 1e-3; };
  add("longest", longest(ours), beside.run ? std::optional(longest(*beside.run)) : std::nullopt, false);
}

void add_load(StudyResult& study, const TimedLoad& load, bool judged) {
  const PatternRun& ours = load.runs.front();
  add_rate(study, load, ours, judged);
  add_percentiles(study, load, judged);
  study.cases.push_back({"longest gap, " + load_words(load), "ms", static_cast<double>(ours.longest_gap_ns) * 1e-6,
                         std::nullopt, "reported", true, "Between two wakes of ours."});
  study.cases.push_back({"work of a tick, p99.9, " + load_words(load), "us", ours.work.percentile_us(0.999),
                         std::nullopt, "reported", true, "Processor time of hand, plant, loop and force tap."});
  for (const PatternRun& run : load.runs)
    if (&run != &ours && run.period.count() > 0) add_rate(study, load, run, false);
}

StudyCurves later_than(const TimedLoad& load, const std::string& file) {
  StudyCurves curves{
      file, "Share of wake-ups later than a time, " + load_words(load), "late by, us", "share of wake-ups", {}, {},
      true};
  for (int i = 0; i <= kGridPerDecade * kGridDecades; ++i)
    curves.x.push_back(std::pow(10, static_cast<double>(i) / kGridPerDecade));
  for (const PatternRun& run : load.runs) {
    if (run.late.count() == 0) continue;
    std::vector<double> later(curves.x.size(), 0);
    run.late.each([&](std::int64_t lower_us, std::uint64_t count) {
      for (std::size_t i = 0; i < curves.x.size() && static_cast<double>(lower_us) >= curves.x[i]; ++i)
        later[i] += static_cast<double>(count) / static_cast<double>(run.late.count());
    });
    std::replace(later.begin(), later.end(), 0.0, std::numeric_limits<double>::quiet_NaN());
    curves.series.push_back({run.name, std::move(later)});
  }
  return curves;
}

std::string spread_columns(const DurationCounts& counts) {
  std::ostringstream out;
  for (const NamedShare& p : kPercentiles) {
    out << ',';
    if (counts.count() > 0) out << counts.percentile_us(p.share);
  }
  out << ',';
  if (counts.count() > 0) out << static_cast<double>(counts.max_ns()) * 1e-3;
  return out.str();
}

std::string patterns_csv(const std::vector<const TimedLoad*>& loads) {
  std::ostringstream out;
  out << std::setprecision(9) << "busy_processes,pattern,scheduler,wakes,missed,rate_hz,longest_gap_ms";
  for (const char* measure : {"late", "period", "work"})
    for (const char* share : {"p50", "p90", "p99", "p99.9", "max"}) out << ',' << measure << '_' << share << "_us";
  out << '\n';
  for (const TimedLoad* load : loads)
    for (const PatternRun& run : load->runs) {
      out << load->busy << ',' << '"' << run.name << "\"," << run.scheduler << ',' << run.late.count() << ',';
      const bool told = run.period.count() > 0;
      if (told) out << run.missed;
      out << ',';
      if (told) out << run.rate_hz();
      out << ',';
      if (told) out << static_cast<double>(run.longest_gap_ns) * 1e-6;
      out << spread_columns(run.late) << spread_columns(run.period) << spread_columns(run.work) << '\n';
    }
  return out.str();
}

std::string histograms_csv(const std::vector<const TimedLoad*>& loads) {
  std::ostringstream out;
  out << "busy_processes,pattern,measure,from_us,ticks\n";
  const std::pair<const char*, Measure> measures[] = {
      {"late", &PatternRun::late}, {"period", &PatternRun::period}, {"work", &PatternRun::work}};
  for (const TimedLoad* load : loads)
    for (const PatternRun& run : load->runs)
      for (const auto& [name, measure] : measures)
        (run.*measure).each([&](std::int64_t lower_us, std::uint64_t count) {
          out << load->busy << ",\"" << run.name << "\"," << name << ',' << lower_us << ',' << count << '\n';
        });
  return out.str();
}

/// The receipt's plot as a file by itself.
std::string receipt_svg(const PatternRun& ours) {
  Pacing pacing;
  pacing.late.bins = histogram(ours.late);
  pacing.period.bins = histogram(ours.period, kNominalUs);
  pacing.work.bins = histogram(ours.work);
  std::string svg = pacing_plot_svg(pacing, kNominalHz);
  if (svg.empty()) return svg;
  svg.insert(std::string("<svg").size(),
             " xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" height=\"250\" font-family=\"sans-serif\" "
             "font-size=\"13\"");
  svg.insert(svg.find('>') + 1, "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>");
  return svg + "\n";
}

void add_notes(StudyResult& study, const TimedLoad& load) {
  std::string schedulers;
  for (const PatternRun& run : load.runs)
    if (run.late.count() > 0)
      schedulers += (schedulers.empty() ? "With " + load_words(load) + ": " : "; ") + run.name + " " + run.scheduler;
  study.notes.push_back(schedulers + ".");
  const PatternRun& ours = load.runs.front();
  if (!ours.refused.empty())
    study.notes.push_back("Our loop did not get SCHED_FIFO (" + ours.refused + "): trocar doctor says how to give it.");
  for (const PatternRun& run : load.runs)
    if (run.name == "cyclictest" && run.late.count() == 0)
      study.notes.push_back("cyclictest " + run.refused + ": ours is held against its own wait without work instead.");
    else if (run.name == "cyclictest" && run.scheduler != "SCHED_FIFO 80")
      study.notes.push_back("cyclictest did not get SCHED_FIFO 80 either and ran as an ordinary thread.");
}

std::string machine_words() {
  std::ostringstream busy;
  busy << std::fixed << std::setprecision(1) << load_of_last_minute();
  return kernel_release() + (real_time_kernel() ? ", real-time" : ", not real-time") + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " processors, load " + busy.str() +
         " from other programs before it began; simulated device of seed 1";
}

/// Slices in turn, back and forth, so that no pattern has the better minute.
TimedLoad timed(int busy, int rounds, double slice_s) {
  constexpr PatternRun (*kPatterns[])(double) = {live_attempt, wait_alone, cyclictest, busy_wait, sleep_and_yield};
  constexpr std::size_t kCount = std::size(kPatterns);
  TimedLoad out{busy, std::vector<PatternRun>(kCount)};
  const BusyProcesses load(busy);
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < kCount; ++i) {
      const std::size_t turn = round % 2 == 0 ? i : kCount - 1 - i;
      out.runs[turn].add(kPatterns[turn](slice_s));
    }
  return out;
}

}  // namespace

StudyResult timing_result(const TimedLoad& busy, const TimedLoad& idle, const std::string& machine) {
  StudyResult study{"timing", machine, {}, {later_than(busy, "later_busy"), later_than(idle, "later_idle")}};
  study.beside = beside_of(busy).name;
  add_load(study, busy, true);
  add_load(study, idle, false);
  study.files = {{"patterns.csv", patterns_csv({&busy, &idle})},
                 {"histograms.csv", histograms_csv({&busy, &idle})},
                 {"receipt_busy.svg", receipt_svg(busy.runs.front())},
                 {"receipt_idle.svg", receipt_svg(idle.runs.front())}};
  study.notes.push_back("Machine: " + machine + ".");
  add_notes(study, busy);
  add_notes(study, idle);
  return study;
}

StudyResult timing_study(const StudyRequest& request) {
  const int processes = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
  const std::string machine = machine_words();
  live_attempt(0);  // the organ and the exercise are read before anything is timed
  const double slice_s = request.quick ? 1 : 5;
  const TimedLoad busy = timed(processes, request.quick ? 1 : 2, slice_s);
  const TimedLoad idle = timed(0, 1, slice_s);
  return timing_result(busy, idle, machine);
}

}  // namespace trocar
