// Live attempts: threads and the clock. Nothing here judges how punctual the machine is; what must hold is that the
// recording repeats the run to the bit, that it tells the same story as lockstep, and that every way out of it is
// orderly.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/session/lanes/recorder_task.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/session.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar::live_session_test {
namespace {

/// Two discs, then the block: some ten seconds of an expert.
Scene short_scene(bool realtime) {
  const AssetRoots assets = find_assets();
  AttemptSetup setup;
  std::string text = find_exercise("surface-touch", assets.exercises).text;
  text.replace(text.find("count = 12"), 10, "count = 2");
  setup.exercise = parse_exercise(text, "short.toml");
  setup.organ = "phantom-liver";
  setup.hand = "expert";
  setup.seed = 5;
  setup.board = 1;
  setup.realtime = realtime;
  if (realtime) setup.pace = kSimulatedLivePace;
  return build_scene(setup, assets, {"simulated", 1000, 16});
}

struct Taken {
  SessionOutcome outcome;
  std::string bytes;
  Recording recording;
};

Taken take(const Scene& scene, const std::function<bool()>& interrupted = {}, const SessionObserver& observe = {}) {
  MemorySink memory;
  RecordingWriter writer(memory, scene_json(scene), scene.loop.daq.rate_hz);
  SessionOutcome outcome = run_session(scene, find_assets(), writer, observe, interrupted);
  return {std::move(outcome), memory.bytes(), parse_recording(memory.bytes(), "memory")};
}

std::vector<std::string> types(const std::vector<Event>& events) {
  std::vector<std::string> out;
  for (const Event& event : events) out.push_back(event.type);
  return out;
}

TEST(LiveSession, RepeatsToTheBitAndTellsTheSameStoryAsLockstep) {
  const Scene scene = short_scene(true);
  Taken live = take(scene);
  // A machine that takes a quarter of a second at once stops the device, as it must: then another one.
  for (int more = 4; more > 0 && live.outcome.device.fault == "late-loop"; --more) live = take(scene);
  const Taken lockstep = take(short_scene(false));
  ASSERT_EQ(live.outcome.status, AttemptStatus::kCompleted) << live.outcome.device.fault;
  EXPECT_EQ(types(live.recording.events), types(lockstep.recording.events));
  EXPECT_EQ(live.recording.ticks.size(), live.outcome.device.ticks) << "every tick is recorded";
  EXPECT_EQ(live.recording.ticks.back().tick, live.outcome.device.ticks + live.outcome.device.overruns)
      << "what was missed has passed in the simulated world";
  const SessionOutcome replayed = replay_session(scene, live.recording);
  EXPECT_EQ(replayed.state_hash, live.outcome.state_hash);
  EXPECT_EQ(types(replayed.events), types(live.recording.events));
}

TEST(LiveSession, ItsRunReportSaysHowItWasPaced) {
  int ticks = 0;
  const Taken live = take(short_scene(true), [&] { return ++ticks > 50; });  // asked 50 times a second
  const auto run_report = nlohmann::json::parse(live.outcome.device.realtime);
  const auto& haptic = run_report.at("lanes").at("haptic");
  EXPECT_EQ(haptic.at("wakes"), live.outcome.device.ticks);
  EXPECT_EQ(haptic.at("missed"), live.outcome.device.overruns);
  EXPECT_EQ(run_report.at("lost_records"), 0);
  for (const char* lane : {"haptic", "tissue", "force-sensor", "recorder"}) {
    EXPECT_TRUE(run_report.at("lanes").at(lane).at("policy").is_string()) << lane;
    EXPECT_GT(run_report.at("lanes").at(lane).at("wakes"), 0) << lane;
  }
  const bool fifo = haptic.at("policy") == "SCHED_FIFO 80";
  EXPECT_NE(fifo, haptic.contains("refused")) << "given, or the reason why not";
}

TEST(LiveSession, ARealSensorThatSaysNothingIsNamedInItsRecordAndInWords) {
  Scene scene = short_scene(true);
  scene.setup.force_sensor = "net-ft:127.0.0.1:1";
  scene.setup.device.identified = DeviceFile{"[sensor]\ncounts_per_n = 1e6\ncounts_per_nm = 1e6\n", "sensor.toml"};
  int asked = 0;
  const Taken live = take(scene, [&] { return ++asked > 50; });
  const auto run_report = nlohmann::json::parse(live.recording.run_report_json).at("force_sensor");
  EXPECT_EQ(run_report.at("sensor"), "net-ft:127.0.0.1:1");
  EXPECT_EQ(run_report.at("samples"), 0);
  EXPECT_EQ(run_report.at("link").at("records"), 0);
  EXPECT_GT(run_report.at("link").at("begun"), 0);
  EXPECT_TRUE(run_report.at("residual_rms_n").is_null());
  ASSERT_FALSE(live.outcome.notes.empty());
  EXPECT_NE(live.outcome.notes.front().find("net-ft:127.0.0.1:1: no valid sample"), std::string::npos);
}

TEST(LiveSession, AnInterruptEndsItAsAbortedAndItCanStillBeReplayed) {
  const Scene scene = short_scene(true);
  int asked = 0;
  const Taken live = take(scene, [&] { return ++asked > 60; });
  EXPECT_EQ(live.outcome.status, AttemptStatus::kAborted);
  ASSERT_TRUE(live.recording.end);
  EXPECT_EQ(live.recording.end->status, AttemptStatus::kAborted);
  EXPECT_EQ(replay_session(scene, live.recording).state_hash, live.outcome.state_hash);
}

TEST(LiveSession, WhatAKillLeavesIsReplayedToItsLastChunk) {
  const Scene scene = short_scene(true);
  int asked = 0;
  const Taken live = take(scene, [&] { return ++asked > 150; });
  const Recording torn = parse_recording(live.bytes.substr(0, live.bytes.size() * 2 / 3), "torn");
  ASSERT_FALSE(torn.end);
  ASSERT_GT(torn.ticks.size(), 0u);
  EXPECT_EQ(replay_session(scene, torn).device.ticks, torn.ticks.size());
}

TEST(LiveSession, AnObserverRunsInTheCallingThread) {
  const auto here = std::this_thread::get_id();
  int views = 0;
  const Taken live = take(
      short_scene(true), [&] { return views >= 20; },
      [&](const SessionView& view) {
        EXPECT_EQ(std::this_thread::get_id(), here);
        EXPECT_GE(view.t_s, 0);
        ++views;
      });
  EXPECT_EQ(live.outcome.status, AttemptStatus::kAborted);
  EXPECT_GE(views, 20);
}

/// A disk that is full after so many appends.
class FullSink final : public RecordingSink {
 public:
  explicit FullSink(int left) : left_(left) {}
  void append(std::string_view) override {
    if (left_-- <= 0) throw EnvironmentError("disk.trec: no space left");
  }
  void sync() override {}

 private:
  int left_;
};

TEST(LiveSession, ADiskThatFillsUpEndsItWithItsReason) {
  const Scene scene = short_scene(true);
  FullSink sink(2);
  RecordingWriter writer(sink, scene_json(scene), 1000);
  try {
    run_session(scene, find_assets(), writer);
    ADD_FAILURE() << "the disk was full";
  } catch (const EnvironmentError& error) {
    EXPECT_STREQ(error.what(), "disk.trec: no space left") << "the first reason, not what followed from it";
  }
}

TEST(Lockstep, AnInterruptEndsItAsAborted) {
  const Scene scene = short_scene(false);
  int asked = 0;
  const Taken taken = take(scene, [&] { return ++asked >= 3000; });
  EXPECT_EQ(taken.outcome.status, AttemptStatus::kAborted);
  EXPECT_EQ(taken.recording.ticks.size(), 3000u);
  EXPECT_TRUE(taken.outcome.device.realtime.empty()) << "lockstep has no pacing to speak of";
}

TEST(RecorderTask, WhatFindsTheRingFullIsCountedAndTheRecordingSaysSo) {
  MemorySink memory;
  RecordingWriter writer(memory, "", 1000);
  const auto rings = std::make_unique<RecorderRings>();
  RecorderTask recorder(*rings, 1000, writer);
  TickRecord record;
  const auto push = [&](std::uint64_t from, std::uint64_t to) {
    for (record.stylus.period = from; record.stylus.period < to; ++record.stylus.period) rings->ticks.push(record);
  };
  push(1, TickRing::capacity() + 101);  // the recorder sleeps too long
  EXPECT_EQ(recorder.lost(), 100u);
  recorder.stop();
  push(TickRing::capacity() + 101, TickRing::capacity() + 111);
  recorder.stop();
  writer.close({});
  const Recording recording = parse_recording(memory.bytes(), "memory");
  EXPECT_EQ(recording.ticks.size(), TickRing::capacity() + 10);
  EXPECT_EQ(lost_rows(recording.ticks), 100u) << "so that a replay refuses it";
}

TEST(RecorderTask, ARowWaitsForTheStepThatTellsItsPhase) {
  MemorySink memory;
  RecordingWriter writer(memory, "", 1000);
  const auto rings = std::make_unique<RecorderRings>();
  RecorderTask recorder(*rings, 1000, writer);
  TickRecord record;
  for (record.stylus.period = 1; record.stylus.period <= 30; ++record.stylus.period) rings->ticks.push(record);
  rings->steps.push({10, 1});
  recorder.run(0);
  EXPECT_EQ(writer.tick_count(), 10u) << "a step may yet have seen one of the others";
  rings->steps.push({20, 2});
  recorder.stop();
  writer.close({});
  const Recording recording = parse_recording(memory.bytes(), "memory");
  ASSERT_EQ(recording.ticks.size(), 30u);
  EXPECT_EQ(recording.ticks[8].phase, 0);
  EXPECT_EQ(recording.ticks[9].phase, 1);
  EXPECT_EQ(recording.ticks[18].phase, 1);
  EXPECT_EQ(recording.ticks[29].phase, 2);
}

}  // namespace
}  // namespace trocar::live_session_test
