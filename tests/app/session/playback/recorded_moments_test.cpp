// Moments taken from keyframes are those of the run, whether the tissue deforms or keyframes were only asked for.
#include "app/session/playback/recorded_moments.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>

#include "app/session/lanes/recorder_task.h"
#include "app/session/playback/recorded_run.h"
#include "app/session/recording/chunk.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/app/session/recording/recording_samples.h"
#include "tests/app/session/recording/waving_world.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::recorded_moments_test {
namespace {

constexpr double kRow = 1e-6;       // m: half a quantum of a row's position, and room for rounding
constexpr double kBetween = 4e-4;   // m: a press of 5 mm at 2 Hz bends 0.25 mm away from a chord of 50 ms
constexpr double kSameTime = 1e-9;  // s: tick / rate and tick * period round differently

double seconds_of(const std::function<void()>& what) {
  const auto begin = std::chrono::steady_clock::now();
  what();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Between two keyframes of 50 ms a thing of the scene moves at most some mm, and bends far less from a straight way.
constexpr double kThing = 1.5e-3;

void expect_of_run(const SessionView& was, const RunMoment& is) {
  const StylusState &a = was.record.stylus, &b = is.record.stylus;
  ASSERT_NEAR(was.t_s, is.t_s, kSameTime);
  EXPECT_LT((a.X_TI.p - b.X_TI.p).cwiseAbs().maxCoeff(), kRow);
  EXPECT_LT(Eigen::AngleAxisd(a.X_TI.R.transpose() * b.X_TI.R).angle(), 0.02);
  EXPECT_LT((a.X_TI.R.col(2) - b.X_TI.R.col(2)).norm(), 2e-4);
  EXPECT_LT((a.F_I_T.force - b.F_I_T.force).norm(), 1e-3);
  EXPECT_NEAR(a.grip_force_n, b.grip_force_n, 1e-3);
  EXPECT_NEAR(a.jaw_opening_m, b.jaw_opening_m, kRow);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.loop, b.loop);
  EXPECT_NEAR(a.depth_m, b.depth_m, 1e-3);
  EXPECT_NEAR(was.record.winding_c, is.record.winding_c, 0.1);
  EXPECT_EQ(was.record.in.counts, is.record.in.counts);
  const DirectorStatus &s = was.director.status(), &t = is.status;
  EXPECT_TRUE(runs_on(s, t)) << "what has no values in between has a keyframe of its own";
  EXPECT_NEAR(s.run_time_s, t.run_time_s, 1e-9);
  EXPECT_LT((s.demand.centre_T - t.demand.centre_T).norm(), kThing);
  EXPECT_EQ(s.demand.band, t.demand.band);
  EXPECT_NEAR(s.hold_progress, t.hold_progress, 0.06);
  EXPECT_NEAR(s.exposure, t.exposure, 0.06);
  EXPECT_NEAR(s.horizon_rad, t.horizon_rad, 0.06);
  EXPECT_EQ(s.shown_symbol, t.shown_symbol);
  EXPECT_EQ(s.mark_count, t.mark_count);
  const TissueFrame &f = *was.tissue, &g = is.tissue;
  EXPECT_EQ(f.grip, g.grip);
  ASSERT_EQ(f.object_count, g.object_count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.object_count); ++i) {
    EXPECT_LT((f.object[i].X_TO.p - g.object[i].X_TO.p).norm(), kThing) << i;
    EXPECT_EQ(f.object[i].crushed, g.object[i].crushed);
  }
}

AttemptSetup grasp_setup() {
  AttemptSetup setup = short_setup();
  setup.exercise = find_exercise("limited-grasp", find_assets().exercises);
  setup.organ = "none";
  return setup;
}

/// Runs with keyframes asked for, and compares every moment with that of a run again.
void compare(const Scene& scene) {
  SessionHooks hooks;
  hooks.keyframes.always = true;
  const test::TemporaryFolder folder;
  const auto file = folder / "run.trec";
  const auto [outcome, recording] = record_session(scene, find_assets(), hooks, file);
  ASSERT_FALSE(recording.tissue.empty());
  std::printf("%.0f s, opened with one moment in %.2f s; ", 1e-3 * static_cast<double>(recording.ticks.size()),
              seconds_of([&] { RecordedRun(file, find_assets()).at(10); }));
  const RecordedMoments moments(scene, recording);
  std::size_t seen = 0;
  const SessionOutcome again = replay_session(scene, recording, [&](const SessionView& view) {
    if (view.t_s == 0) return;
    ++seen;
    if (!::testing::Test::HasFailure()) expect_of_run(view, moments.at(view.t_s));
  });
  EXPECT_EQ(again.state_hash, outcome.state_hash) << "keyframes are beside the run";
  const double minutes = static_cast<double>(recording.ticks.size()) / 60e3;
  std::printf("%zu moments, %zu keyframes, %.2f MiB a minute\n", seen, recording.tissue.size(),
              static_cast<double>(recording.tissue.bytes()) / (1 << 20) / minutes);
  EXPECT_LT(static_cast<double>(recording.tissue.bytes()) / minutes, 1 << 20);
}

TEST(KeyframesAskedFor, GiveTheMomentsOfATouch) { compare(short_scene()); }
TEST(KeyframesAskedFor, GiveTheMomentsOfBlocksOnABoard) {
  compare(build_scene(grasp_setup(), find_assets(), {"simulated", 1000, 16}));
}

TEST(KeyframesAskedFor, GiveTheMomentsOfAScope) {
  AttemptSetup setup = short_setup();
  setup.exercise = find_exercise("camera-navigation", find_assets().exercises);
  setup.organ = "none";
  compare(build_scene(setup, find_assets(), {"simulated", 1000, 16}));
}

TEST(KeyframesAskedFor, AreNotMadeWhereNothingDeforms) {
  const auto [outcome, recording] = record_session(short_scene(), find_assets(), SessionHooks{}, {});
  EXPECT_TRUE(recording.tissue.empty());
  EXPECT_THROW(RecordedMoments(short_scene(), recording), InputError);
}

/// An attempt on waving tissue: the tissue task and the recorder as they are, the loop by formula.
class WavingAttempt : public ::testing::Test {
 protected:
  struct Step {
    double t_s = 0;
    SurfacePtr organ_T;
    std::vector<NodePlace> nodes_T;
  };

  std::filesystem::path record(double seconds) {
    const auto file = folder_ / "waving.trec";
    const BuiltLattice built = build_lattice(*scene_.organ_T, {.cell_m = 0.014});
    std::vector<NodePlace> nodes;
    for (std::size_t n = 0; n < built.lattice.nodes.size(); ++n) nodes.push_back(built.lattice.node_m(n).cast<float>());
    auto rest = std::make_shared<SurfaceSnapshot>(*scene_.organ_T);
    rest->topology = 7;
    scene_.organ_T = rest;
    scene_.embedded = std::make_shared<const EmbeddedSurface>(built.lattice, scene_.organ_T);
    auto made = std::make_unique<test::WavingWorld>(nodes, keep_ ? scene_.embedded : nullptr);
    test::WavingWorld& world = *made;
    RecordingWriter writer(file, scene_json(scene_), 1000);
    const auto rings = std::make_unique<RecorderRings>();
    const auto state = make_channel<HapticState>(Timing::kLockstep);
    const auto patch = make_channel<ContactPatch>(Timing::kLockstep, 5);
    Director director(scene_.setup.exercise, scene_.level, scene_.board);
    TissueTask tissue(scene_, director,
                      {*state, *patch, nullptr, nullptr, &rings->steps, &rings->events, &rings->tissue},
                      std::move(made));
    RecorderTask recorder(*rings, 1000, writer);
    const auto ticks = static_cast<std::uint64_t>(1e3 * seconds);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      TickRecord record;
      record.stylus.period = tick + 1;
      record.stylus.t_s = 1e-3 * static_cast<double>(tick + 1);
      record.stylus.X_TI.p = Vec3(0.02 * std::sin(record.stylus.t_s), 0, 0.05);
      record.patch_stamp = patch->newest(tick).stamp;
      state->write(tick, {record.stylus, {}});
      rings->ticks.push(record);
      if (tick == 5000) world.changes.emplace_back("a cut\0here", 10);
      if (tick % tissue.period() == 0) {
        tissue.run(tick);
        if (keep_)
          steps_.push_back(
              {record.stylus.t_s, world.surface(), {world.shape().nodes_T.begin(), world.shape().nodes_T.end()}});
      }
      if (tick % recorder.period() == 0) recorder.run(tick);
    }
    recorder.stop();
    EXPECT_EQ(recorder.lost(), 0u);
    writer.close({});
    return file;
  }

  test::TemporaryFolder folder_;
  Scene scene_ = short_scene();
  bool keep_ = true;
  std::vector<Step> steps_;
};

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double far = 0;
  for (std::size_t i = 0; i < a.size(); ++i) far = std::max(far, (a[i] - b[i]).norm());
  return far;
}

TEST_F(WavingAttempt, IsSeenAsItWas) {
  const Recording recording = read_recording(record(8));
  const RecordedMoments moments(scene_, recording);
  ASSERT_GT(recording.tissue.size(), 150u);
  EXPECT_EQ(moments.changes(), (std::vector<TopologyEvent>{{5001, std::string("a cut\0here", 10)}}));
  std::size_t at_keyframes = 0;
  for (const Step& step : steps_) {
    const RunMoment moment = moments.at(step.t_s);
    ASSERT_NEAR(moment.t_s, step.t_s, kSameTime);
    ASSERT_TRUE(moment.organ_T);
    EXPECT_EQ(moment.organ_T->topology, 7u);
    EXPECT_EQ(moment.organ_T->triangles, step.organ_T->triangles);
    EXPECT_EQ(moments.at(step.t_s).organ_T, moment.organ_T) << "made once";
    const auto period = static_cast<std::uint64_t>(std::llround(1e3 * step.t_s));
    const auto keyframe = recording.tissue.at_or_before(period, true);
    const bool exact = recording.tissue.period(*keyframe) == period;
    at_keyframes += exact ? 1 : 0;
    const double away = farthest(moment.organ_T->vertices, step.organ_T->vertices);
    ASSERT_LT(away, exact ? std::sqrt(3.0) * 0.5 * kNodeQuantum + 1e-6 : kBetween) << step.t_s;
    const double blood = moment.organ_T->fields.at(0).value.at(0);
    EXPECT_NEAR(blood, step.organ_T->fields.at(0).value.at(0), 0.61);
  }
  EXPECT_EQ(at_keyframes, 160u) << "20 Hz";
}

TEST_F(WavingAttempt, IsSeenTheSameFromAnyPlace) {
  const Recording recording = read_recording(record(6));
  const RecordedMoments straight(scene_, recording), jumping(scene_, recording);
  std::vector<RunMoment> all;
  for (const Step& step : steps_) all.push_back(straight.at(step.t_s));
  for (std::size_t i = 0, n = 17; i < 200; ++i, n = (n * 31 + 7) % steps_.size()) {
    const RunMoment is = jumping.at(steps_[n].t_s);
    ASSERT_EQ(is.organ_T->vertices, all[n].organ_T->vertices) << n;
    EXPECT_EQ(is.tissue.stamp, all[n].tissue.stamp);
  }
  EXPECT_NEAR(jumping.at(-1).t_s, steps_.front().t_s, kSameTime);
  EXPECT_NEAR(jumping.at(1e9).t_s, steps_.back().t_s, kSameTime);
}

TEST_F(WavingAttempt, IsPlayedUpToWhereItWasCutOff) {
  const auto file = record(6);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (const double share : {0.4, 0.7, 0.95}) {
    const auto part =
        folder_.write("cut.trec", bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    const RecordedRun run(part, find_assets());
    EXPECT_TRUE(run.plays_keyframes());
    EXPECT_NE(run.torn(), "");
    EXPECT_GT(run.end_s(), 1);
    EXPECT_EQ(run.available_until(), run.end_s());
    EXPECT_NEAR(run.at(run.end_s()).t_s, run.end_s(), 0.011);
  }
}

TEST_F(WavingAttempt, StopsWhereAKeyframeCannotBeDecoded) {
  std::ifstream in(record(6), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::string forged = bytes.substr(0, kRecordingPrefixSize);
  int chunks = 0;
  for (auto chunk = chunk_at(bytes, kRecordingPrefixSize); chunk; chunk = chunk_at(bytes, chunk->end())) {
    std::string payload(chunk->payload);
    if (chunk->type == ChunkType::kKeyframes && ++chunks == 5) payload.resize(payload.size() - 9);
    forged += make_chunk(chunk->type, payload);
  }
  const RecordedRun run(folder_.write("forged.trec", relinked(forged)), find_assets());
  EXPECT_NEAR(run.at(1).t_s, 1, 0.011);
  EXPECT_EQ(run.failure(), "");
  EXPECT_NEAR(run.at(2.5).record.stylus.X_TI.p.x(), 0.02 * std::sin(2.5), 3e-4) << "the row is there";
  EXPECT_EQ(run.stage(), RecordedRun::Stage::kFailed);
  EXPECT_NE(run.failure(), "");
  EXPECT_TRUE(run.has_pictures());
}

TEST_F(WavingAttempt, OpensAtOnceHoweverLongItIs) {
  keep_ = false;
  const auto file = record(300);
  Recording recording;
  std::printf("5 minutes: read in %.2f s, ", seconds_of([&] { recording = read_recording(file); }));
  std::printf("%.2f MiB a minute of keyframes, %.2f MiB in all\n",
              static_cast<double>(recording.tissue.bytes()) / (1 << 20) / 5,
              static_cast<double>(std::filesystem::file_size(file)) / (1 << 20));
  EXPECT_LT(static_cast<double>(recording.tissue.bytes()) / 5, 3 << 20);
  std::optional<RecordedRun> run;
  const double opened = seconds_of([&] {
    run.emplace(file, find_assets());
    run->at(211.3);
  });
  EXPECT_TRUE(run->plays_keyframes());
  EXPECT_TRUE(run->has_pictures());
  EXPECT_EQ(run->stage(), RecordedRun::Stage::kWhole);
  EXPECT_THROW(run->outcome(), std::logic_error) << "nothing was run";
  const RecordedMoments moments(scene_, recording);
  const double first = seconds_of([&] { moments.at(123.4); });
  const double next = seconds_of([&] {
    for (int i = 0; i < 100; ++i) moments.at(124 + 0.04 * i);
  });
  std::printf(
      "a run opened with one moment in %.2f s; a moment with its surface of %zu nodes %.1f ms, the next ones %.1f ms\n",
      opened, scene_.embedded->nodes(), 1e3 * first, 10 * next);
}

}  // namespace
}  // namespace trocar::recorded_moments_test
