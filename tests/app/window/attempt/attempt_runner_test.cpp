// Attempts in threads of their own. Nothing judges how punctual the machine is: only what must hold whatever it does.
#include "app/window/attempt/attempt_runner.h"
#include "app/session/bookmark.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/input_error.h"
#include "tests/app/window/attempt/runner_samples.h"

namespace trocar::attempt_runner_test {
namespace {

using std::chrono::milliseconds;

/// Where the instrument is now, and its intent moved by `by_T` from there.
HandIntent moved(AttemptRunner& run, const Vec3& by_T) {
  HandIntent intent;
  intent.X_TI = run.newest().record.stylus.X_TI;
  intent.X_TI.p += by_T;
  return intent;
}

TEST(AttemptRunner, AScriptedHandRunsToItsGradeAndIsKeptAsTrocarRunKeepsIt) {
  const RunnerFolder folder;
  AttemptResult result;
  // A machine that takes more than 1 % of the ticks away voids an attempt, one that takes a quarter of a second at
  // once stops the device, as they must: then another one.
  for (int attempt = 0; attempt < 5; ++attempt) {
    AttemptRunner run(short_request(folder.database(), "expert"), find_assets());
    EXPECT_THROW(run.result(), std::logic_error) << "no result before the end";
    ASSERT_TRUE(wait_for([&] { return run.stored(); }));
    result = run.result();
    if (result.grade.status == AttemptStatus::kCompleted) {
      EXPECT_EQ(run.newest().status.phase, Phase::kDone);
      break;
    }
    std::puts(result.integrity.c_str());
    EXPECT_FALSE(result.grade.score);
  }
  EXPECT_EQ(result.grade.status, AttemptStatus::kCompleted) << result.integrity;
  ASSERT_TRUE(result.grade.score);
  const AttemptResult stored = stored_attempt(folder.database());
  EXPECT_EQ(stored.uuid, result.uuid);
  EXPECT_EQ(stored.grade.score, result.grade.score);
  EXPECT_EQ(stored.hand, "expert");
  EXPECT_EQ(stored.trainee, "T-1");
  EXPECT_TRUE(verified(result.recording_path));
  EXPECT_EQ(grade_recording(read_recording(result.recording_path), "regraded").grade.score, result.grade.score);
}

TEST(AttemptRunner, APersonsIntentsMoveTheInstrumentAndTheInputIsStoredAsTheHand) {
  const RunnerFolder folder;
  AttemptRunner run(short_request(folder.database()), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.ready() && run.newest().seen; }));
  const Vec3 before = run.newest().record.stylus.X_TI.p;
  const HandIntent wanted = moved(run, {0.02, 0, 0.01});
  const std::uint64_t number = run.steer(wanted);
  EXPECT_EQ(number, 1u);
  ASSERT_TRUE(wait_for([&] { return run.newest().steered >= number; })) << "felt";
  ASSERT_TRUE(wait_for([&] { return (run.newest().record.stylus.X_TI.p - before).norm() > 0.015; }));
  EXPECT_LT((run.target().X_TI.p - wanted.X_TI.p).norm(), 1e-9);
  run.abort();
  ASSERT_TRUE(wait_for([&] { return run.stored(); }));
  EXPECT_EQ(run.result().grade.status, AttemptStatus::kAborted);
  EXPECT_FALSE(run.result().grade.score);
  EXPECT_EQ(stored_attempt(folder.database()).hand, "mouse");
  EXPECT_TRUE(verified(run.result().recording_path)) << "a person's hand is in the device's counts";
}

TEST(AttemptRunner, APauseStopsEverythingLosesNothingAndIsInTheRunReport) {
  const RunnerFolder folder;
  AttemptRunner run(short_request(folder.database()), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.ready(); }));
  EXPECT_TRUE(run.pause(true));
  EXPECT_TRUE(run.paused());
  std::this_thread::sleep_for(milliseconds(200));  // a tick or step that was under way ends
  const double stands_at = run.newest().t_s;
  std::this_thread::sleep_for(milliseconds(1500));
  EXPECT_EQ(run.newest().t_s, stands_at) << "time stands still";
  EXPECT_FALSE(run.finished());
  run.pause(false);
  ASSERT_TRUE(wait_for([&] { return run.newest().t_s > stands_at + 0.3; })) << "and goes on";
  run.abort();
  ASSERT_TRUE(wait_for([&] { return run.stored(); }));
  const AttemptResult& result = run.result();
  EXPECT_EQ(result.grade.status, AttemptStatus::kAborted)
      << "a hole of 1.5 s would have been a fault: " << result.integrity;
  const auto pauses = nlohmann::json::parse(result.device.realtime).at("pauses");
  ASSERT_EQ(pauses.size(), 1u);
  EXPECT_GE(pauses[0].at("seconds"), 1.7);
  EXPECT_NEAR(pauses[0].at("at_s"), stands_at, 0.25) << "on the loop's clock";
  EXPECT_TRUE(verified(result.recording_path)) << "the state hash runs on through the pause";
}

TEST(AttemptRunner, APausedAttemptCanBeAborted) {
  const RunnerFolder folder;
  AttemptRunner run(short_request(folder.database()), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.newest().seen; }));
  run.pause(true);
  run.abort();
  EXPECT_EQ(run.result().grade.status, AttemptStatus::kAborted);
}

TEST(AttemptRunner, AnExamHasNoPause) {
  const RunnerFolder folder;
  AttemptRequest request = short_request(folder.database());
  request.setup.level = "exam";
  request.setup.board = 100;
  AttemptRunner run(request, find_assets());
  EXPECT_FALSE(run.pause(true));
  EXPECT_FALSE(run.paused());
  EXPECT_TRUE(run.pause(false));
}

/// A card that is there, as a real one is: nobody is patient with a loop that holds a motor.
TEST(AttemptRunner, ARealDeviceKeepsTheLimitsOfARealDevice) {
  SimulatedDaq device(FakeHostmot2::device_config({}));
  FakeHostmot2 card(device, {}, hostmot2::standard_wiring());
  AttemptRequest request = short_request(":memory:");
  request.setup.backend = kHostmot2Backend;
  request.setup.card = card.address();
  AttemptRunner run(request, find_assets());
  EXPECT_TRUE(run.scene().setup.pace == PaceLimits{});
  EXPECT_TRUE(run.scene().loop.device.homing.see_dark);
  EXPECT_FALSE(run.pause(true)) << "an arm cannot hang in the air";
  run.abort();
}

TEST(AttemptRunner, ADeviceThatFailsEndsTheAttemptWithWhatWasRecorded) {
  const RunnerFolder folder;
  AttemptRequest request = short_request(folder.database());
  InjectedFault unplugged;
  unplugged.kind = InjectedFaultKind::kChannelInvalid;
  unplugged.at_s = 2;
  unplugged.channel = 2;
  unplugged.value = 1000;
  request.setup.faults.push_back(unplugged);
  AttemptRunner run(request, find_assets());
  ASSERT_TRUE(wait_for([&] { return run.stored(); }));
  EXPECT_EQ(run.result().grade.status, AttemptStatus::kFault);
  EXPECT_FALSE(run.result().device.fault.empty());
  EXPECT_FALSE(run.result().integrity.empty()) << "the reason in words";
  const Recording kept = read_recording(run.result().recording_path);
  EXPECT_GT(kept.ticks.size(), 1900u) << "two seconds before, and a little after";
  EXPECT_TRUE(std::filesystem::is_regular_file(run.result().safety_log_path));
}

TEST(AttemptRunner, GoingAwayAbortsAndStores) {
  const RunnerFolder folder;
  {
    AttemptRunner run(short_request(folder.database()), find_assets());
    ASSERT_TRUE(wait_for([&] { return run.newest().seen; }));
  }
  EXPECT_EQ(stored_attempt(folder.database()).grade.status, AttemptStatus::kAborted);
}

TEST(AttemptRunner, WithoutADatabaseNothingIsKeptButTheResultIsThere) {
  AttemptRunner run(short_request(":memory:"), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.newest().seen; }));
  run.abort();
  ASSERT_TRUE(wait_for([&] { return run.stored(); }));
  EXPECT_EQ(run.result().grade.status, AttemptStatus::kAborted);
  EXPECT_TRUE(run.result().recording_path.empty());
}

TEST(AttemptRunner, AMarkedMomentIsAnEventOfTheRecordingAndChangesNothingElse) {
  const RunnerFolder folder;
  AttemptRunner run(short_request(folder.database()), find_assets());
  ASSERT_TRUE(wait_for([&] { return run.ready(); }));
  const double before_s = run.newest().t_s;
  run.mark();
  run.mark();
  run.mark_message();
  ASSERT_TRUE(wait_for([&] { return run.newest().t_s > before_s + 0.3; }));
  run.abort();
  ASSERT_TRUE(wait_for([&] { return run.stored(); }));
  const AttemptResult kept = stored_attempt(folder.database());
  std::vector<double> marked, messages;
  for (const Event& event : kept.events)
    if (event.type == event_type::kMarked) marked.push_back(event.t_s);
  for (const Event& event : kept.events)
    if (event.type == event_type::kMessage) messages.push_back(event.t_s);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NEAR(messages[0], before_s, 0.25);
  ASSERT_EQ(marked.size(), 2u);
  EXPECT_NEAR(marked[0], before_s, 0.25);
  EXPECT_EQ(without_marks(kept.events).size() + 3, kept.events.size());
  EXPECT_TRUE(verified(kept.recording_path)) << "the loop knows nothing of it";
}

}  // namespace
}  // namespace trocar::attempt_runner_test
