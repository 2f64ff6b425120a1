// What a stopped device means for an attempt: its status, its reason, what is kept of the stop, and that it replays.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/grading/device_words.h"
#include "app/session/grading/recorded_result.h"
#include "app/session/recording/safety_file.h"
#include "app/session/session.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::session_safety_test {
namespace {

/// A short exercise in which the expert touches two discs; its clock begins at about 4 s.
Scene scene_with(const InjectedFault& fault, int limit_s = 20) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  std::string text = find_exercise("surface-touch", assets.exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  text.replace(text.find("time_limit_s = 120"), 18, "time_limit_s = " + std::to_string(limit_s));
  setup.exercise = parse_exercise(text, "short.toml");
  setup.organ = "phantom-liver";
  setup.hand = "expert";
  setup.seed = 5;
  setup.board = 1;
  setup.faults = {fault};
  return build_scene(setup, assets, {"simulated", 1000, 16});
}

std::pair<SessionOutcome, Recording> run(const Scene& scene) {
  MemorySink memory;
  RecordingWriter writer(memory, scene_json(scene), scene.loop.daq.rate_hz);
  SessionOutcome outcome = run_session(scene, find_assets(), writer);
  return {std::move(outcome), parse_recording(memory.bytes(), "memory")};
}

TEST(SessionSafety, AFaultIsToldWithItsCauseAndItsFirstTime) {
  const Scene scene = scene_with({InjectedFaultKind::kDriveFault, 5.0, 0, 3, 0});
  const auto [outcome, recording] = run(scene);
  EXPECT_EQ(outcome.status, AttemptStatus::kFault);
  EXPECT_EQ(outcome.device.fault, "drive-fault");
  EXPECT_EQ(outcome.device.fault_channel, 3);
  EXPECT_NEAR(outcome.device.fault_s, 5.0, 1.5e-3);
  EXPECT_NE(outcome.device.reason.find("drive-fault on channel 3 at 5.000 s"), std::string::npos)
      << outcome.device.reason;
  EXPECT_EQ(outcome.device.transitions.back().to, "fault");
  EXPECT_EQ(outcome.device.transitions.front().from, "off");
  EXPECT_NE(outcome.safety_csv.find(",active,fault,drive-fault,3,1"), std::string::npos);
  const auto lines = std::count(outcome.safety_csv.begin(), outcome.safety_csv.end(), '\n');
  EXPECT_GE(lines, 2000) << "two seconds before it";
  const SessionOutcome again = replay_session(scene, recording);
  EXPECT_EQ(again.state_hash, outcome.state_hash);
  EXPECT_EQ(again.safety_csv, outcome.safety_csv) << "the replayed loop remembers the same";
}

TEST(SessionSafety, AnOpenDeadmanMidRunVoidsTheAttempt) {
  const auto [outcome, recording] = run(scene_with({InjectedFaultKind::kDeadmanOpen, 5.0, 0.5, 0, 0}));
  EXPECT_EQ(outcome.status, AttemptStatus::kVoid);
  EXPECT_NE(outcome.device.reason.find("deadman"), std::string::npos);
  EXPECT_TRUE(outcome.device.fault.empty());
  EXPECT_EQ(outcome.events.back().type, "DEADMAN_OPEN");
  const Grade grade = grade_recording(recording, "memory").grade;
  EXPECT_EQ(grade.status, AttemptStatus::kVoid);
  EXPECT_FALSE(grade.score);
}

TEST(SessionSafety, AnOpenDeadmanBeforeTheClockCostsNothing) {
  const auto [outcome, recording] = run(scene_with({InjectedFaultKind::kDeadmanOpen, 1.5, 0.5, 0, 0}));
  EXPECT_EQ(outcome.status, AttemptStatus::kCompleted) << outcome.device.reason;
  EXPECT_TRUE(grade_recording(recording, "memory").grade.score);
  EXPECT_FALSE(outcome.safety_csv.empty()) << "the torque went off on the way";
}

TEST(SessionSafety, AnAttemptThatNeverBeginsSaysWhatItWaitedFor) {
  const auto [outcome, recording] = run(scene_with({InjectedFaultKind::kDeadmanOpen, 0, 0, 0, 0}, 5));
  EXPECT_EQ(outcome.status, AttemptStatus::kAborted);
  EXPECT_NE(outcome.device.reason.find("never began: the device was homed, waiting for the deadman"), std::string::npos)
      << outcome.device.reason;
}

TEST(SessionSafety, ASoundAttemptHasNoReasonAndKeepsNoStop) {
  const auto [outcome, recording] = run(scene_with({InjectedFaultKind::kHandNaN, 1000, 0, 0, 0}));
  EXPECT_EQ(outcome.status, AttemptStatus::kCompleted);
  EXPECT_EQ(outcome.device.reason, "");
  EXPECT_EQ(outcome.safety_csv, "");
  EXPECT_EQ(outcome.device.transitions.size(), 5u) << "off to active";
}

TEST(SessionSafety, AnAttemptThatIsNeverHomedSaysWhatTheDeviceWaitedFor) {
  const auto [outcome, recording] = run(scene_with({InjectedFaultKind::kBeamDark, 0, 0, 0, 0}, 5));
  EXPECT_EQ(outcome.status, AttemptStatus::kAborted);
  EXPECT_NE(outcome.device.reason.find("Put the stylus into its jig. No light"), std::string::npos)
      << outcome.device.reason;
  EXPECT_EQ(recorded_result(recording, "").integrity, outcome.device.reason) << "and so it is stored";
}

TEST(DeviceWords, EveryFaultSaysWhatToDo) {
  for (int code = 1; std::string(fault_name(static_cast<FaultCode>(code))) != "unknown"; ++code) {
    RunReport device;
    device.fault = fault_name(static_cast<FaultCode>(code));
    device.fault_channel = 4;
    device.fault_s = 1.25;
    device.fault_value = 17.5;
    const std::string words = fault_words(device);
    EXPECT_TRUE(words.starts_with(device.fault + " on channel 4 at 1.250 s: ")) << words;
    EXPECT_NE(words.find("; then put the stylus into its jig and start again"), std::string::npos) << words;
    EXPECT_EQ(words.find('%'), std::string::npos) << words;
  }
  EXPECT_EQ(fault_words({}), "");
}

TEST(DeviceWords, AnEndNamesItsReason) {
  EXPECT_EQ(end_words(AttemptStatus::kCompleted, {}, LoopState::kActive, true), "");
  EXPECT_EQ(end_words(AttemptStatus::kTimeout, {}, LoopState::kActive, true), "");
  EXPECT_NE(end_words(AttemptStatus::kAborted, {}, LoopState::kActive, true).find("did not end"), std::string::npos);
  EXPECT_NE(end_words(AttemptStatus::kAborted, {}, LoopState::kSelfTest, false).find("self-test"), std::string::npos);
  EXPECT_NE(end_words(AttemptStatus::kVoid, {}, LoopState::kHomed, true).find("deadman"), std::string::npos);
}

TEST(SafetyFile, LiesBesideTheRecordingAndIsNeverWrittenInSilence) {
  EXPECT_EQ(safety_file_of("a/b.trec"), "a/b.safety.csv");
  const test::TemporaryFolder folder;
  SafetyRow row;
  row.period = 7;
  row.codes[6] = -3;
  SafetyTransition change;
  change.period = 2000;
  change.to = LoopState::kFault;
  change.fault = {FaultCode::kWatchdog, -1, 2000, 1};
  const std::string csv = safety_csv({change}, {row}, 4000);
  EXPECT_NE(csv.find("# 2000,0.500000,off,fault,watchdog,-1,1\n"), std::string::npos) << csv;
  EXPECT_TRUE(csv.ends_with("7,off,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,-3\n")) << csv;
  write_safety_file(folder / "x.safety.csv", csv);
  EXPECT_EQ(std::filesystem::file_size(folder / "x.safety.csv"), csv.size());
  EXPECT_THROW(write_safety_file("/proc/trocar/x.csv", csv), EnvironmentError);
  const SafetyFile back = read_safety_file(folder / "x.safety.csv");
  ASSERT_EQ(back.changes.size(), 1U);
  EXPECT_EQ(back.changes[0][4], "watchdog");
  ASSERT_EQ(back.rows.size(), 1U);
  EXPECT_EQ(back.columns.back(), "code6");
  EXPECT_EQ(back.rows[0].back(), "-3");
  for (const std::string& wrong :
       {std::string(), csv.substr(0, csv.size() - 5), std::string("a,b\n1,2\n"), csv + "7\n"}) {
    std::filesystem::remove(folder / "y.csv");
    write_safety_file(folder / "y.csv", wrong);
    EXPECT_THROW(read_safety_file(folder / "y.csv"), InputError) << wrong.substr(0, 40);
  }
  EXPECT_THROW(read_safety_file(folder / "nowhere.csv"), EnvironmentError);
}

}  // namespace
}  // namespace trocar::session_safety_test
