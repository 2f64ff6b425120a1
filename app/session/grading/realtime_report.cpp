#include "app/session/grading/realtime_report.h"

#include <algorithm>
#include <array>
#include <thread>

#include <nlohmann/json.hpp>

#include "app/session/lanes/real_time.h"

namespace trocar {
namespace {

constexpr double kLossyShare = 0.01;  // of a sensor's records: worth a word [chosen]

using RunReportJson = nlohmann::ordered_json;

RunReportJson distribution(const DurationCounts& counts) {
  return {{"p50", counts.percentile_us(0.5)},       {"p90", counts.percentile_us(0.9)},
          {"p99", counts.percentile_us(0.99)},      {"p99.9", counts.percentile_us(0.999)},
          {"p99.99", counts.percentile_us(0.9999)}, {"max", static_cast<double>(counts.max_ns()) * 1e-3},
          {"above_1ms", counts.above_us(1000)}};
}

RunReportJson lane(const LaneReport& report) {
  RunReportJson json = {{"policy", report.policy}};
  if (!report.refusal.empty()) json["refused"] = report.refusal;
  if (report.processor >= 0) json["processor"] = report.processor;
  json["rate_hz"] = report.rate_hz();
  json["wakes"] = report.wakes;
  json["missed"] = report.missed;
  json["overruns"] = report.overruns;
  json["longest_gap_ms"] = static_cast<double>(report.longest_gap_ns) * 1e-6;
  json["late_us"] = distribution(report.late);
  json["period_us"] = distribution(report.period);
  json["cpu_us"] = distribution(report.cpu);
  return json;
}

/// Lower end of the histogram's bin that holds a duration.
std::int64_t lower_end(std::int64_t us) {
  constexpr std::array<std::int64_t, 6> kBinSteps{10, 15, 20, 30, 50, 70};  // of a decade
  if (us < 10) return us >= 7 ? 7 : us >= 5 ? 5 : std::min<std::int64_t>(us, 3);
  std::int64_t decade = 1, lower = 10;
  while (us >= 100 * decade) decade *= 10;
  for (const std::int64_t step : kBinSteps)
    if (us >= step * decade) lower = step * decade;
  return lower;
}

RunReportJson bins_json(const std::map<std::int64_t, std::uint64_t>& bins) {
  RunReportJson json = RunReportJson::object();
  for (const auto& [lower, count] : bins) json[std::to_string(lower)] = count;
  return json;
}

}  // namespace

std::map<std::int64_t, std::uint64_t> histogram(const DurationCounts& counts, std::int64_t nominal_us) {
  std::map<std::int64_t, std::uint64_t> out;
  counts.each([&](std::int64_t lower_us, std::uint64_t count) {
    const std::int64_t off = lower_us - nominal_us;
    out[off < 0 ? -lower_end(-off) : lower_end(off)] += count;
  });
  return out;
}

std::string realtime_json(const ThreadedExecutor& executor, std::uint64_t lost,
                          const std::optional<WitnessedTime>& witnessed) {
  RunReportJson json = {{"kernel", kernel_release()},
                        {"kernel_realtime", real_time_kernel()},
                        {"processors", std::thread::hardware_concurrency()},
                        {"load", load_of_last_minute()},
                        {"memory_locked", executor.memory_locked()},
                        {"processors_awake", executor.processors_awake()},
                        {"lost_records", lost},
                        {"lanes", RunReportJson::object()}};
  for (const LaneReport* report : executor.reports()) json["lanes"][report->name] = lane(*report);
  if (!executor.reports().empty()) {
    const LaneReport& loop = *executor.reports().front();
    RunReportJson& told = json["lanes"][loop.name];
    told["late_us"]["bins"] = bins_json(histogram(loop.late));
    told["period_us"]["off_bins"] = bins_json(histogram(loop.period, loop.period_us));
    told["cpu_us"]["bins"] = bins_json(histogram(loop.cpu));
  }
  for (const ThreadedExecutor::Pause& pause : executor.pauses())
    json["pauses"].push_back({{"at_s", pause.at_s}, {"seconds", pause.seconds}});
  if (witnessed)
    json["clocks"] = {{"program_s", witnessed->program_s},
                      {"kernel_s", witnessed->kernel_s},
                      {"worst", witnessed->worst},
                      {"slept_s", witnessed->slept_s}};
  return json.dump();
}

std::string pacing_fault(const std::string& realtime, const std::vector<Event>& events) {
  const RunReportJson json = RunReportJson::parse(realtime, nullptr, false);
  if (json.is_object() && json.contains("clocks") && json["clocks"].is_object()) {
    const RunReportJson& clocks = json["clocks"];
    const auto number = [&clocks](const char* name, double otherwise) {
      return clocks.contains(name) && clocks[name].is_number() ? clocks[name].get<double>() : otherwise;
    };
    WitnessedTime time;
    time.worst = number("worst", 1);
    time.slept_s = number("slept_s", 0);
    if (std::string fault = clock_fault(time); !fault.empty()) return fault;
  }
  const auto start =
      std::find_if(events.begin(), events.end(), [](const Event& event) { return event.type == event_type::kStart; });
  if (start == events.end()) return "";
  int pauses = 0;
  for (const StoodStill& pause : pauses_of(realtime))
    pauses += pause.at_s >= start->t_s && pause.at_s <= events.back().t_s ? 1 : 0;
  return pauses > kMostPauses ? "it was paused " + std::to_string(pauses) + " times while its clock ran" : "";
}

std::string force_sensor_json(const ForceSensorTask& sensor, const std::optional<RealSensorLine>& line) {
  RunReportJson json = {{"rate_hz", sensor.config().rate_hz},
                        {"lag_s", sensor.config().lag_s},
                        {"samples", sensor.samples()},
                        {"measured_rms_n", sensor.measured().rms()},
                        {"residual_samples", sensor.residual().count()},
                        {"residual_rms_n", sensor.residual().rms()},
                        {"residual_max_n", sensor.residual().largest()}};
  if (!line) return json.dump();
  const std::optional<Wrench> zero = sensor.zero();
  const auto three = [](const Vec3& v) { return RunReportJson{v.x(), v.y(), v.z()}; };
  json["sensor"] = line->words;
  json["axes"] = sensor.compares() ? "theatre" : "sensor";
  json["measured_rms_nm"] = sensor.measured_moment().rms();
  json["zero"] = {{"samples", sensor.zero_samples()},
                  {"force_n", zero ? three(zero->force) : RunReportJson(nullptr)},
                  {"moment_nm", zero ? three(zero->moment) : RunReportJson(nullptr)}};
  const WrenchLink& link = line->link;
  json["link"] = {{"records", link.records},      {"lost", link.lost},       {"out_of_order", link.out_of_order},
                  {"malformed", link.malformed},  {"unsound", link.unsound}, {"begun", link.begun},
                  {"taken_away", link.taken_away}};
  json["counts"] = {{"per_n", link.counts.per_n}, {"per_nm", link.counts.per_nm}, {"from", link.counts.from}};
  if (sensor.measured().count() == 0) json["measured_rms_n"] = json["measured_rms_nm"] = nullptr;
  if (sensor.residual().count() == 0) json["residual_rms_n"] = json["residual_max_n"] = nullptr;
  return json.dump();
}

std::vector<std::string> force_sensor_notes(const ForceSensorTask& sensor, const RealSensorLine& line) {
  const WrenchLink& link = line.link;
  const std::string name = "force sensor " + line.words + ": ";
  if (sensor.samples() == 0)
    return {name + "no valid sample in this run (" + link_words(link) + "); " +
            (link.records == 0 ? "is it powered, and is this its address?" : "it reports saturation or an error")};
  std::vector<std::string> notes;
  if (!link.counts.doubt.empty()) notes.push_back(name + link.counts.doubt);
  const std::uint64_t missing = link.lost + link.malformed + link.unsound;
  if (static_cast<double>(missing) > kLossyShare * static_cast<double>(link.records) || link.begun > 1)
    notes.push_back(name + link_words(link));
  if (!sensor.zero())
    notes.push_back(name + "no zero was taken, too few samples came in the jig: what it read is not in the record");
  if (!sensor.compares())
    notes.push_back(name + "compared with nothing, for no device file says how it sits ([sensor], rpy_deg)");
  return notes;
}

std::vector<StoodStill> pauses_of(const std::string& realtime) {
  std::vector<StoodStill> out;
  const RunReportJson json = RunReportJson::parse(realtime, nullptr, false);
  if (!json.is_object() || !json.contains("pauses") || !json["pauses"].is_array()) return out;
  for (const RunReportJson& pause : json["pauses"])
    if (pause.is_object() && pause.contains("at_s") && pause["at_s"].is_number() && pause.contains("seconds") &&
        pause["seconds"].is_number())
      out.push_back({pause["at_s"].get<double>(), pause["seconds"].get<double>()});
  return out;
}

std::vector<std::string> realtime_notes(const ThreadedExecutor& executor, std::uint64_t lost) {
  std::vector<std::string> notes;
  for (const LaneReport* report : executor.reports()) {
    if (!report->refusal.empty()) {
      notes.push_back("soft real time: the " + report->name + " thread did not get SCHED_FIFO (" + report->refusal +
                      ")");
    }
  }
  if (!executor.memory_locked()) notes.push_back("memory is not locked (" + executor.lock_refusal() + ")");
  if (lost > 0) {
    notes.push_back(std::to_string(lost) +
                    " records found no room on their way to the disk: the recording can be graded "
                    "but not replayed");
  }
  return notes;
}

}  // namespace trocar
