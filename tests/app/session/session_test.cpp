// The session without its command line: one attempt in memory, replayed, regraded, and set up again from its recording.
#include "app/session/session.h"

#include <gtest/gtest.h>

#include "app/session/lanes/state_hash.h"
#include "app/session/setup/placement.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::session_test {
namespace {

using test::message_of;

/// The shipped exercise cut to two discs, so that an expert's attempt is short and whole.
Scene short_scene(const std::string& hand, const std::string& organ = "phantom-liver") {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  std::string text = find_exercise("surface-touch", assets.exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  text.replace(text.find("time_limit_s = 120"), 18, "time_limit_s = 30");
  setup.exercise = parse_exercise(text, "short.toml");
  setup.organ = organ;
  setup.hand = hand;
  setup.seed = 5;
  setup.board = 1;
  return build_scene(setup, assets, {"simulated", 1000, 16});
}

struct Attempt {
  SessionOutcome outcome;
  Recording recording;
};

Attempt run(const Scene& scene, const SessionObserver& observe = {}) {
  MemorySink memory;
  RecordingWriter writer(memory, scene_json(scene), scene.loop.daq.rate_hz);
  SessionOutcome outcome = run_session(scene, find_assets(), writer, observe);
  return {std::move(outcome), parse_recording(memory.bytes(), "memory")};
}

TEST(StateHash, DependsOnEveryWordAndOnTheirOrder) {
  const auto hash = [](std::initializer_list<double> values) {
    StateHash state;
    for (const double value : values) state.add(value);
    return state.value();
  };
  EXPECT_EQ(hash({1, 2}), hash({1, 2}));
  EXPECT_NE(hash({1, 2}), hash({2, 1}));
  EXPECT_NE(hash({1, 2}), hash({1, 2, 0}));
  EXPECT_NE(hash({0.0}), hash({-0.0}));
  EXPECT_EQ(StateHash(0x1234).hex(), "0000000000001234");
}

TEST(Session, ARunGradesAndReplaysToTheSameHash) {
  const Scene scene = short_scene("expert");
  const Attempt attempt = run(scene);
  EXPECT_EQ(attempt.outcome.status, AttemptStatus::kCompleted);
  EXPECT_EQ(attempt.outcome.device.backend, "simulated");
  EXPECT_EQ(attempt.outcome.device.overruns, 0u);
  EXPECT_EQ(attempt.recording.ticks.size(), attempt.outcome.device.ticks) << "every tick is recorded";
  ASSERT_TRUE(attempt.recording.end);
  EXPECT_EQ(attempt.recording.end->state_hash, attempt.outcome.state_hash);

  const SessionOutcome replayed = replay_session(scene, attempt.recording);
  EXPECT_EQ(replayed.state_hash, attempt.outcome.state_hash);
  EXPECT_EQ(replayed.device.backend, "replay");
  EXPECT_EQ(replayed.events.size(), attempt.outcome.events.size());

  const Grade grade = grade_recording(attempt.recording, "memory").grade;
  ASSERT_TRUE(grade.score);
  EXPECT_GT(*grade.score, 60);
  EXPECT_EQ(grade.status, AttemptStatus::kCompleted);
}

TEST(Session, MotorsThatBeganWarmReplayToTheSameHash) {
  Scene scene = short_scene("expert");
  scene.setup.motors[2] = scene.loop.motors[2] = {99.5, 1.0 / 3 + 60};
  const Attempt attempt = run(scene);
  const RecordedSetup recorded = parse_scene_json(attempt.recording.session, "memory");
  EXPECT_EQ(recorded.setup.motors, scene.loop.motors);
  const Scene again = build_scene(recorded.setup, find_assets(), recorded.daq);
  EXPECT_EQ(replay_session(again, attempt.recording).state_hash, attempt.outcome.state_hash);
  EXPECT_NE(replay_session(short_scene("expert"), attempt.recording).state_hash, attempt.outcome.state_hash);
}

TEST(Session, AnotherRubricIsReadWithTheRiseThatItsAnchorsWereSetWith) {
  Scene scene = short_scene("heavy-handed");
  scene.setup.exercise.rise_s = 0;
  const Attempt attempt = run(scene);
  Exercise slow = scene.setup.exercise;
  slow.rise_s = 10;
  const auto in_band = [&](const Exercise* rubric_of) {
    const Grade grade = grade_recording(attempt.recording, "memory", rubric_of).grade;
    for (const Metric& metric : grade.metrics)
      if (metric.name == "in_band_share") return metric.value.value_or(-1);
    return -1.0;
  };
  EXPECT_EQ(in_band(nullptr), in_band(&scene.setup.exercise)) << "as recorded";
  EXPECT_GT(in_band(&slow), in_band(nullptr));
}

TEST(Session, AMissedPeriodShiftsTraceAndEventsTogether) {
  Scene scene = short_scene("expert");
  scene.setup.faults = {{InjectedFaultKind::kMissedSync, 2.5, 0, 0, 6}};
  const Attempt attempt = run(scene);
  ASSERT_EQ(attempt.outcome.status, AttemptStatus::kCompleted) << "six periods of a thousand are borne";
  EXPECT_EQ(attempt.outcome.device.overruns, 6u);
  EXPECT_EQ(attempt.recording.ticks.back().tick, attempt.recording.ticks.size() + 6) << "the rows skip what was missed";
  const Trace trace = rebuild_trace(attempt.recording.ticks, attempt.recording.rate_hz);
  EXPECT_NEAR(trace.samples.back().t_s, attempt.recording.events.back().t_s, 0.0105) << "one clock for both";
}

TEST(Session, ALongOutageIsAFault) {
  Scene scene = short_scene("expert");
  scene.setup.faults = {{InjectedFaultKind::kMissedSync, 2.5, 0, 0, 1000}};
  const Attempt attempt = run(scene);
  EXPECT_EQ(attempt.outcome.status, AttemptStatus::kFault);
  EXPECT_EQ(attempt.outcome.device.fault, "late-loop");
  EXPECT_FALSE(grade_recording(attempt.recording, "memory").grade.score);
}

TEST(Session, AnObserverSeesTheRunAndDoesNotReachIt) {
  const Scene scene = short_scene("expert");
  int calls = 0;
  double last_s = -1;
  const Attempt watched = run(scene, [&](const SessionView& view) {
    EXPECT_GT(view.t_s, last_s);
    last_s = view.t_s;
    ++calls;
  });
  EXPECT_NEAR(calls, static_cast<double>(watched.outcome.device.ticks) / 10, 2) << "the tissue rate is 100 Hz";
  EXPECT_EQ(run(scene).outcome.state_hash, watched.outcome.state_hash);
}

TEST(Session, ARecordingWithoutItsEndIsGradedAsAborted) {
  Attempt attempt = run(short_scene("expert"));
  attempt.recording.end.reset();
  const Grade grade = grade_recording(attempt.recording, "memory").grade;
  EXPECT_EQ(grade.status, AttemptStatus::kAborted);
  EXPECT_FALSE(grade.score);
  EXPECT_FALSE(grade.passed);
  EXPECT_FALSE(grade.metrics.empty()) << "what happened is still measured";
}

TEST(Session, AnEmptyRecordingIsNotReplayed) {
  EXPECT_THROW(replay_session(short_scene("expert"), Recording{}), InputError);
}

TEST(SceneText, ComesBackFromTheRecordingsHeader) {
  Scene scene = short_scene("novice");
  scene.setup.contact_law = ContactLaw::kThesis;
  scene.setup.passivity_law = PassivityLaw::kOff;
  const RecordedSetup back = parse_scene_json(scene_json(scene), "a.trec");
  EXPECT_EQ(back.setup.exercise.text, scene.setup.exercise.text);
  EXPECT_EQ(back.setup.exercise.rubric.sha256, scene.setup.exercise.rubric.sha256);
  EXPECT_EQ(back.setup.organ, "phantom-liver");
  EXPECT_EQ(back.organ_sha256, scene.organ.sha256);
  EXPECT_EQ(back.setup.hand, "novice");
  EXPECT_EQ(back.setup.seed, 5);
  EXPECT_EQ(back.setup.board, 1);
  EXPECT_EQ(back.setup.rate_hz, 1000);
  EXPECT_EQ(back.setup.contact_law, ContactLaw::kThesis);
  EXPECT_EQ(back.setup.passivity_law, PassivityLaw::kOff);
}

TEST(SceneText, DamageIsRefusedWithTheRecordingsName) {
  const std::string text = scene_json(short_scene("expert"));
  for (const std::string& bad :
       {std::string("{"), std::string("{}"), std::string("[1]"), text.substr(0, text.size() / 2),
        std::string(text).replace(text.find("\"format\":1"), 10, "\"format\":2")}) {
    EXPECT_EQ(message_of<InputError>([&] {
                parse_scene_json(bad, "a.trec");
              }).find("a.trec: the recording's setup cannot be read"),
              0u)
        << bad.substr(0, 40);
  }
}

TEST(Placement, EveryTargetLiesWithinTheArmsReach) {
  const Scene scene = short_scene("expert");
  const Mat3 R_TI = scene.loop.map.instrument_pose(home_pose()).R;
  for (const Target& target : scene.board.targets) {
    EXPECT_TRUE(inverse_within_limits(scene.loop.map.stylus_pose({R_TI, target.centre_T}), home_angles()));
  }
}

TEST(Placement, ThroughAPortEveryDiscIsWithinReachToo) {
  const Scene scene = short_scene("expert");
  ExerciseLevel level = scene.level;
  level.mapping = Mapping::kFulcrum;
  level.port_m = Vec3(0.05, -0.05, 0.12);
  const InstrumentMap map = place_theatre(level);
  const Mat3 R_TI = map.instrument_pose(home_pose()).R;
  for (const Target& target : scene.board.targets) {
    const Pose X_WS = map.stylus_pose({R_TI, target.centre_T});
    EXPECT_TRUE(inverse_within_limits(X_WS, home_angles()));
    EXPECT_LT((map.instrument_pose(X_WS).p - target.centre_T).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace trocar::session_test
