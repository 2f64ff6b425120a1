// Reports of pacing and of the force sensor, and the run report as a recording keeps it.
#include "app/session/grading/realtime_report.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/session/grading/recorded_result.h"
#include "haptics/force_sensor/simulated_force_sensor.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::realtime_report_test {
namespace {

using Json = nlohmann::json;

class Counted final : public Task {
 public:
  explicit Counted(std::uint64_t calls) : calls_(calls) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t) override { ++runs_; }
  bool finished() const override { return runs_ >= calls_; }

 private:
  std::uint64_t calls_, runs_ = 0;
};

TEST(RealtimeReport, EveryLaneSaysItsPolicyRateAndLatencies) {
  Counted first(50), second(1000000);
  ThreadedExecutor executor(500);
  executor.add_lane("first", {&first}, 0);
  executor.add_lane("second", {&second}, 0);
  executor.run();
  const Json json = Json::parse(realtime_json(executor, 7, WitnessedTime{2, 2, 1, 0}));
  EXPECT_TRUE(json.at("kernel_realtime").is_boolean());
  EXPECT_EQ(json.at("memory_locked"), executor.memory_locked());
  EXPECT_EQ(json.at("lost_records"), 7);
  ASSERT_EQ(json.at("lanes").size(), 2u);
  const Json& lane = json.at("lanes").at("first");
  EXPECT_EQ(lane.at("wakes"), 50);
  EXPECT_EQ(lane.at("policy"), "SCHED_OTHER");
  EXPECT_FALSE(lane.contains("refused")) << "nothing was asked for";
  const LaneReport& report = *executor.reports()[0];
  EXPECT_DOUBLE_EQ(lane.at("rate_hz"), report.rate_hz());
  EXPECT_DOUBLE_EQ(lane.at("longest_gap_ms"), static_cast<double>(report.longest_gap_ns) * 1e-6);
  const auto same = [&](const char* what, const DurationCounts& counts) {
    const Json& spread = lane.at(what);
    EXPECT_DOUBLE_EQ(spread.at("p50"), counts.percentile_us(0.5)) << what;
    EXPECT_DOUBLE_EQ(spread.at("p99"), counts.percentile_us(0.99)) << what;
    EXPECT_DOUBLE_EQ(spread.at("p99.9"), counts.percentile_us(0.999)) << what;
    EXPECT_DOUBLE_EQ(spread.at("p99.99"), counts.percentile_us(0.9999)) << what;
    EXPECT_DOUBLE_EQ(spread.at("max"), static_cast<double>(counts.max_ns()) * 1e-3) << what;
    EXPECT_EQ(spread.at("above_1ms"), counts.above_us(1000)) << what;
  };
  same("late_us", report.late);
  same("period_us", report.period);
  same("cpu_us", report.cpu);
  EXPECT_NE(json.at("kernel").get<std::string>().find("Linux"), std::string::npos);
  EXPECT_GE(json.at("processors"), 1);
  EXPECT_GE(json.at("load"), 0);
}

std::uint64_t counted(const Json& bins) {
  std::uint64_t sum = 0;
  for (const auto& [lower, count] : bins.items()) sum += count.get<std::uint64_t>();
  return sum;
}

TEST(RealtimeReport, TheLoopHasHistogramsAndTheOthersNot) {
  Counted loop(50), other(1000000);
  ThreadedExecutor executor(500);
  executor.add_lane("haptic", {&loop}, 0);
  executor.add_lane("other", {&other}, 0);
  executor.run();
  const Json lanes = Json::parse(realtime_json(executor, 0, {})).at("lanes");
  EXPECT_EQ(counted(lanes.at("haptic").at("late_us").at("bins")), 50u);
  EXPECT_EQ(counted(lanes.at("haptic").at("cpu_us").at("bins")), 50u);
  EXPECT_EQ(counted(lanes.at("haptic").at("period_us").at("off_bins")), 49u) << "between fifty wakes";
  EXPECT_FALSE(lanes.at("other").at("late_us").contains("bins"));
}

TEST(RealtimeReport, BinsOfAHistogramStandAtOneAndAHalfTwoThreeFiveSeven) {
  DurationCounts counts;
  for (const std::int64_t us : {0, 1, 4, 9, 10, 14, 15, 99, 149, 150, 1000, 70'000}) counts.add(us * 1000);
  using Bins = std::map<std::int64_t, std::uint64_t>;
  EXPECT_EQ(
      histogram(counts),
      (Bins{{0, 1}, {1, 1}, {3, 1}, {7, 1}, {10, 2}, {15, 1}, {70, 1}, {100, 1}, {150, 1}, {1000, 1}, {70'000, 1}}));
  DurationCounts periods;
  for (const std::int64_t us : {1000, 1001, 999, 800, 1249, 3000}) periods.add(us * 1000);
  EXPECT_EQ(histogram(periods, 1000), (Bins{{-200, 1}, {-1, 1}, {0, 1}, {1, 1}, {200, 1}, {2000, 1}}));
}

TEST(RealtimeReport, ASecondClockWitnessesTheProgramsOwn) {
  ThreadedExecutor executor(500);
  const auto told = [&](const std::optional<WitnessedTime>& time) {
    return pacing_fault(realtime_json(executor, 0, time), {});
  };
  EXPECT_EQ(told({}), "") << "no second clock could be read";
  EXPECT_EQ(told(WitnessedTime{60, 60, 1.008, 0.01}), "");
  EXPECT_EQ(told(WitnessedTime{60, 60, 0.5, 0}), "the program's clock ran at 0.50 of the kernel's")
      << "slow in the run, fast before it";
  EXPECT_EQ(told(WitnessedTime{62, 60, 1.03, 0}), "the program's clock ran at 1.03 of the kernel's");
  EXPECT_EQ(told(WitnessedTime{60, 60, 1, 12}), "the machine slept for 12.00 s while the attempt ran");
  for (const char* nothing : {"", "[]", "{}", R"({"clocks": 3})", R"({"clocks": {"worst": "x"}})"})
    EXPECT_EQ(pacing_fault(nothing, {}), "") << nothing;
  ClockWitness witness;
  EXPECT_FALSE(witness.seen());
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(2300);
  while (std::chrono::steady_clock::now() < end) {
    witness.look();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const std::optional<WitnessedTime> own = witness.seen();
  ASSERT_TRUE(own) << "x86-64 and AArch64";
  EXPECT_NEAR(own->program_s, own->kernel_s, 2e-3);
  EXPECT_GE(own->kernel_s, 2);
  EXPECT_NEAR(own->worst, 1, 2e-3);
  EXPECT_NEAR(own->slept_s, 0, 1e-3);
}

TEST(RealtimeReport, ARunThatIsStoppedAgainAndAgainIsNoMeasurement) {
  std::vector<Event> events(2);
  events[0].type = "START";
  events[0].t_s = 5;
  events[1].type = "DONE";
  events[1].t_s = 40;
  const auto paused = [&](int times, double at_s) {
    Json json = {{"pauses", Json::array()}};
    for (int i = 0; i < times; ++i) json["pauses"].push_back({{"at_s", at_s + i}, {"seconds", 0.2}});
    return pacing_fault(json.dump(), events);
  };
  EXPECT_EQ(paused(kMostPauses, 10), "");
  EXPECT_EQ(paused(kMostPauses + 1, 10), "it was paused 4 times while its clock ran");
  EXPECT_EQ(paused(10, -20), "") << "before START";
}

TEST(RealtimeReport, NotesSayWhatWasRefusedAndWhatWasLost) {
  Counted task(5);
  ThreadedExecutor executor(500);
  executor.add_lane("haptic", {&task}, 80);
  executor.run();
  const LaneReport& report = *executor.reports()[0];
  const std::size_t refused = (report.refusal.empty() ? 0 : 1) + (executor.memory_locked() ? 0 : 1);
  const std::vector<std::string> whole = realtime_notes(executor, 0), torn = realtime_notes(executor, 3);
  EXPECT_EQ(whole.size(), refused);
  ASSERT_EQ(torn.size(), refused + 1);
  EXPECT_EQ(torn.back().find("3 records found no room"), 0u) << torn.back();
  const Json lane = Json::parse(realtime_json(executor, 0, {})).at("lanes").at("haptic");
  EXPECT_EQ(lane.contains("refused"), !report.refusal.empty());
  if (!report.refusal.empty()) {
    EXPECT_CONTAINS(whole.front(), "the haptic thread did not get SCHED_FIFO (" + report.refusal + ")");
  }
}

TEST(ForceSensorReport, HoldsWhatWasMeasuredAndWhatTheLoopDidNotKnow) {
  LiveChannel<StylusForces> forces;
  SimulatedForceSensor simulated({.rate_hz = 40, .lag_s = 0.15, .noise_n = 0, .drift_n_per_h = 0}, 1);
  ForceSensorTask sensor(forces, simulated, 1000);
  constexpr int kCalls = 20, kLag = 6;  // 0.15 s at 40 Hz
  for (int i = 0; i < kCalls; ++i) {
    forces.write(static_cast<std::uint64_t>(i), {Vec3(0, 0, 2), Vec3(0, 0, i < 10 ? 1.5 : 1.0)});
    sensor.run(static_cast<std::uint64_t>(i));
  }
  const Json json = Json::parse(force_sensor_json(sensor));
  EXPECT_EQ(json.at("rate_hz"), 40);
  EXPECT_EQ(json.at("lag_s"), 0.15);
  EXPECT_EQ(json.at("samples"), kCalls - kLag);
  EXPECT_NEAR(json.at("measured_rms_n"), 2, 1e-12);
  EXPECT_EQ(json.at("residual_samples"), kCalls - kLag);
  EXPECT_NEAR(json.at("residual_max_n"), 1, 1e-12);
  EXPECT_NEAR(json.at("residual_rms_n"), std::sqrt((10 * 0.25 + 4 * 1.0) / 14), 1e-12) << "10 early, 4 late ones";
}

TEST(ForceSensorReport, WithoutASampleItIsZeroNotNothing) {
  LiveChannel<StylusForces> forces;
  SimulatedForceSensor simulated({}, 1);
  const ForceSensorTask sensor(forces, simulated, 1000);
  const Json json = Json::parse(force_sensor_json(sensor));
  EXPECT_EQ(json.at("samples"), 0);
  EXPECT_EQ(json.at("measured_rms_n"), 0);
  EXPECT_EQ(json.at("residual_rms_n"), 0);
}

/// Always the same, in its own axes; or never valid.
class RealSensor final : public ForceSensor {
 public:
  explicit RealSensor(bool valid) : valid_(valid) {}
  ForceSample sample(const Vec3&) override { return {.number = ++number_, .force = Vec3(0, 0, 4), .valid = valid_}; }
  const ForceSensorConfig& config() const override { return config_; }
  std::size_t delay() const override { return 0; }

 private:
  bool valid_;
  ForceSensorConfig config_;
  std::uint64_t number_ = 0;
};

/// Ten samples in the jig, five in a contact of 1 N.
void attempt_of(ForceSensorTask& task, LiveChannel<StylusForces>& forces) {
  for (std::uint64_t k = 0; k < 15; ++k) {
    const bool active = k >= 10;
    forces.write(k, {Vec3::Zero(), active ? Vec3(0, 1, 0) : Vec3(0, 0, 0), JointVector::Zero(),
                     active ? LoopState::kActive : LoopState::kHomed});
    task.run(k);
  }
}

TEST(ForceSensorReport, ARealOneIsNamedWithItsLineItsZeroAndItsAxes) {
  LiveChannel<StylusForces> forces;
  RealSensor real(true);
  SensorMount sits;
  sits.rpy_rad = Vec3::Zero();
  ForceSensorTask task(forces, real, 1000, RealSensorPlace{sits});
  attempt_of(task, forces);
  const RealSensorLine line{"net-ft:192.168.1.1", {.records = 15000, .lost = 3, .begun = 1}};
  const Json json = Json::parse(force_sensor_json(task, line));
  EXPECT_EQ(json.at("sensor"), "net-ft:192.168.1.1");
  EXPECT_EQ(json.at("axes"), "theatre");
  EXPECT_EQ(json.at("samples"), 15);
  EXPECT_EQ(json.at("zero").at("samples"), 10);
  EXPECT_NEAR(json.at("zero").at("force_n")[2], 4, 1e-12);
  EXPECT_EQ(json.at("link").at("records"), 15000);
  EXPECT_EQ(json.at("link").at("lost"), 3);
  EXPECT_EQ(json.at("link").at("taken_away"), 0);
  EXPECT_NEAR(json.at("measured_rms_n"), 0, 1e-12);
  EXPECT_NEAR(json.at("residual_rms_n"), 1, 1e-12);
  EXPECT_TRUE(force_sensor_notes(task, line).empty()) << "3 of 15000 are no word worth";
}

TEST(ForceSensorReport, WithoutAxesNothingIsComparedAndItIsSaid) {
  LiveChannel<StylusForces> forces;
  RealSensor real(true);
  ForceSensorTask task(forces, real, 1000, RealSensorPlace{});
  attempt_of(task, forces);
  const RealSensorLine line{"serial:/dev/ttyUSB0", {.records = 500, .lost = 6, .begun = 2, .taken_away = 1}};
  const Json json = Json::parse(force_sensor_json(task, line));
  EXPECT_EQ(json.at("axes"), "sensor");
  EXPECT_TRUE(json.at("residual_rms_n").is_null());
  EXPECT_TRUE(json.at("residual_max_n").is_null());
  EXPECT_TRUE(json.at("measured_rms_n").is_number());
  const std::vector<std::string> notes = force_sensor_notes(task, line);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_CONTAINS(notes[0], "serial:/dev/ttyUSB0: 500 records, 6 lost");
  EXPECT_CONTAINS(notes[0], "another program may be listening");
  EXPECT_CONTAINS(notes[1], "rpy_deg");
}

TEST(ForceSensorReport, ItsCountsAreNamedAndWhatSpeaksAgainstThem) {
  LiveChannel<StylusForces> forces;
  RealSensor real(true);
  SensorMount sits;
  sits.rpy_rad = Vec3::Zero();
  ForceSensorTask task(forces, real, 1000, RealSensorPlace{sits});
  attempt_of(task, forces);
  const RealSensorLine line{
      "net-ft:192.168.1.1",
      {.records = 500, .begun = 1, .counts = {5e5, 1e6, "the device file", "but the box says 1000000"}}};
  const Json json = Json::parse(force_sensor_json(task, line));
  EXPECT_EQ(json.at("counts"), (Json{{"per_n", 5e5}, {"per_nm", 1e6}, {"from", "the device file"}}));
  ASSERT_EQ(force_sensor_notes(task, line).size(), 1u);
  EXPECT_EQ(force_sensor_notes(task, line)[0], "force sensor net-ft:192.168.1.1: but the box says 1000000");
}

TEST(ForceSensorReport, ASilentOneIsSaidToBe) {
  LiveChannel<StylusForces> forces;
  RealSensor real(false);
  ForceSensorTask task(forces, real, 1000, RealSensorPlace{});
  attempt_of(task, forces);
  const RealSensorLine silent{"net-ft:127.0.0.1:1", {.begun = 70}}, sick{"net-ft:127.0.0.1:1", {.records = 9}};
  const Json json = Json::parse(force_sensor_json(task, silent));
  EXPECT_EQ(json.at("samples"), 0);
  EXPECT_TRUE(json.at("measured_rms_n").is_null()) << "not zero newtons";
  EXPECT_TRUE(json.at("zero").at("force_n").is_null());
  ASSERT_EQ(force_sensor_notes(task, silent).size(), 1u);
  EXPECT_CONTAINS(force_sensor_notes(task, silent)[0], "net-ft:127.0.0.1:1: no valid sample in this run (0 records");
  EXPECT_CONTAINS(force_sensor_notes(task, silent)[0], "is it powered");
  EXPECT_CONTAINS(force_sensor_notes(task, sick)[0], "saturation or an error");
}

RunReport stopped() {
  RunReport run_report;
  run_report.backend = "simulated";
  run_report.fault = "overspeed";
  run_report.fault_channel = 5;
  run_report.fault_s = 1.0 / 3;
  run_report.fault_value = -0.1;
  run_report.reason = "device fault \"overspeed\"\n\xc3\xa4";
  run_report.warnings = {{"saturated", 0.1, 12}, {"near-limit", 2.0 / 3, 1}};
  run_report.transitions = {{0.0, "off", "self-test"}, {0.7, "self-test", "homed"}};
  run_report.force_sensor = R"({"rate_hz":40.0,"samples":3})";
  return run_report;
}

TEST(RunReportJson, AStopComesBackWithItsWarningsAndTransitions) {
  const RunReport given = stopped(), back = parse_run_report(run_report_json(given), "a.trec");
  EXPECT_EQ(
      std::tie(back.fault, back.fault_channel, back.fault_s, back.fault_value, back.reason, back.force_sensor),
      std::tie(given.fault, given.fault_channel, given.fault_s, given.fault_value, given.reason, given.force_sensor));
  EXPECT_EQ(back.realtime, "") << "a run in lockstep has none";
  ASSERT_EQ(back.warnings.size(), 2u);
  EXPECT_EQ(back.warnings[1].name, "near-limit");
  EXPECT_EQ(back.warnings[1].first_s, 2.0 / 3);
  EXPECT_EQ(back.warnings[0].ticks, 12u);
  ASSERT_EQ(back.transitions.size(), 2u);
  EXPECT_EQ(back.transitions[1].t_s, 0.7);
  EXPECT_EQ(back.transitions[1].from, "self-test");
  EXPECT_EQ(back.transitions[1].to, "homed");
  EXPECT_EQ(run_report_json(back), run_report_json(given)) << "and again the same bytes";
}

TEST(RunReportJson, ANumberThatIsNotFiniteDoesNotSpoilTheRunReport) {
  RunReport run_report = stopped();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    run_report.fault_value = bad;
    EXPECT_EQ(parse_run_report(run_report_json(run_report), "a.trec").fault_value, 0);
  }
}

TEST(RunReportJson, OldRunReportsThatDoNotSayHowItStoppedAreRead) {
  Json json = Json::parse(run_report_json(stopped()));
  for (const char* key : {"reason", "warnings", "transitions", "fault_channel", "fault_s", "fault_value"}) {
    json.erase(key);
  }
  const RunReport old = parse_run_report(json.dump(), "old.trec");
  EXPECT_EQ(old.fault, "overspeed");
  EXPECT_EQ(old.fault_channel, -1);
  EXPECT_TRUE(old.warnings.empty() && old.transitions.empty() && old.reason.empty());
  json["reason"] = "half of the new keys";
  EXPECT_CONTAINS(test::message_of<InputError>([&] { parse_run_report(json.dump(), "half.trec"); }), "half.trec: ");
}

}  // namespace
}  // namespace trocar::realtime_report_test
