// An attempt without a device: the instrument goes where it is pointed, nothing can fault, and the recording replays.
#include <gtest/gtest.h>

#include <sstream>

#include "app/cli/attempts/recording_command.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/session.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::pointer_session_test {
namespace {

constexpr double kPressed = 0.020;  // m below the first disc: 3 N that no arm of ours could hold for long

/// Rests in the start ball, goes to a place and presses there, at 0.1 m/s.
class Presser final : public Hand {
 public:
  Presser(const Vec3& start_T, const Vec3& to_T) : start_T_(start_T), to_T_(to_T) {}
  HandIntent update(const Percept& percept, double dt_s) override {
    if (!percept.device_ready) intent_ = {{percept.R_TI, percept.tip_T}, 0.02};
    if (!percept.device_ready) return intent_;
    const Vec3 way = (percept.t_s < 4 ? start_T_ : Vec3(to_T_ - Vec3(0, 0, kPressed))) - intent_.X_TI.p;
    intent_.X_TI.p += std::min(1.0, 0.1 * dt_s / std::max(1e-9, way.norm())) * way;
    return intent_;
  }

 private:
  Vec3 start_T_, to_T_;
  HandIntent intent_;
};

Scene pointed() {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  setup.exercise = find_exercise("surface-touch", assets.exercises);
  setup.organ = "phantom-liver";
  setup.hand = "mouse";
  setup.board = 3;
  setup.backend = kPointerBackend;
  return build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
}

std::pair<SessionOutcome, Recording> pressed(const Scene& scene, long most_steps = 3000,
                                             const std::filesystem::path& file = {}) {
  SessionHooks hooks;
  long steps = 0;
  hooks.hand = [&] { return std::make_unique<Presser>(scene.board.start_T, scene.board.targets.front().centre_T); };
  hooks.observe = [&](const SessionView&) { ++steps; };
  hooks.interrupted = [&] { return steps > most_steps; };  // of 10 ms
  return record_session(scene, find_assets(), hooks, file);
}

TEST(PointerSession, PressesForHalfAMinuteWithoutHeatFadingOrFault) {
  const Scene scene = pointed();
  const auto [outcome, recording] = pressed(scene);
  EXPECT_EQ(outcome.device.fault, "");
  EXPECT_EQ(outcome.device.backend, kPointerBackend);
  EXPECT_TRUE(outcome.device.without_device());
  EXPECT_TRUE(outcome.device.warnings.empty());
  EXPECT_EQ(outcome.device.plant, "") << "there is none";
  const Trace trace = rebuild_trace(recording.ticks, recording.rate_hz);
  const auto force = [&](double t_s) { return trace.samples.at(static_cast<std::size_t>(t_s * 1000)).force_T.norm(); };
  EXPECT_GT(force(8), 1.0);
  EXPECT_NEAR(force(29), force(8), 1e-3) << "it does not sink";
}

TEST(PointerSession, ReplaysToTheBit) {
  const Scene scene = pointed();
  const auto [outcome, recording] = pressed(scene);
  const RecordedSetup recorded = parse_scene_json(recording.session, "pressed");
  EXPECT_FALSE(recorded.daq.motors);
  const Scene again = build_scene(recorded.setup, find_assets(), recorded.daq);
  EXPECT_EQ(replay_session(again, recording).state_hash_hex, outcome.state_hash_hex);
}

TEST(PointerSession, ARecordingByItselfSaysWhatHelped) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "pressed.trec";
  pressed(pointed(), 100, file);
  RecordingOptions options;
  options.subject = file.string();
  options.json = true;
  std::ostringstream out, err;
  score_command(options, out, err);
  EXPECT_NE(out.str().find("\"assists\": \"height plumb\""), std::string::npos) << out.str();
}

/// Comes in and goes to a place, or stays where it came in.
class Visitor final : public Hand {
 public:
  Visitor(const Vec3& entry_T, const Vec3& to_T) : at_T_(entry_T), to_T_(to_T) {}
  HandIntent update(const Percept& percept, double dt_s) override {
    const Vec3 way = to_T_ - at_T_;
    if (percept.device_ready) at_T_ += std::min(1.0, 0.02 * dt_s / std::max(1e-9, way.norm())) * way;
    return {{percept.R_TI, at_T_}, 0};
  }

 private:
  Vec3 at_T_, to_T_;
};

TEST(PointerSession, TheOrganStopsTheInstrumentBeforeTheStart) {
  const Scene scene = pointed();
  const Vec3 entry = entry_T(scene);
  double force_n = 0;
  SessionHooks hooks;
  hooks.hand = [&] {
    return std::make_unique<Visitor>(entry, scene.board.targets.front().centre_T - Vec3(0, 0, 0.01));
  };
  hooks.observe = [&](const SessionView& view) {
    EXPECT_TRUE(waits_for_start(view.director.status().phase));
    force_n = std::max(force_n, view.record.stylus.F_I_T.force.norm());
  };
  hooks.interrupted = [&] { return force_n > 0.5; };
  const auto [outcome, recording] = record_session(scene, find_assets(), hooks, {});
  EXPECT_GT(force_n, 0.5);
}

TEST(PointerSession, WhatNeverBeginsIsVoidAndHasNoScore) {
  const Scene scene = pointed();
  SessionHooks hooks;
  hooks.hand = [&] { return std::make_unique<Visitor>(entry_T(scene), entry_T(scene)); };
  const auto [outcome, recording] = record_session(scene, find_assets(), hooks, {});
  EXPECT_EQ(outcome.status, AttemptStatus::kVoid);
  EXPECT_NE(outcome.device.reason.find("the clock never began"), std::string::npos) << outcome.device.reason;
  EXPECT_FALSE(grade_recording(recording, "never begun").grade.score);
}

TEST(PointerSession, AScriptedHandIsRefused) {
  const Scene scene = pointed();
  try {
    record_session(scene, find_assets(), SessionHooks{}, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a script needs a device"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trocar::pointer_session_test
