// What a desk is told of an attempt: from the moments that are shown, with events seen in the director's counts.
#include "app/session/keeping/live_attempt.h"

#include <gtest/gtest.h>

#include <thread>

#include "app/session/run_moment.h"
#include "tests/app/session/playback/playback_samples.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/live/live_stations.h"

namespace trocar::live_attempt_test {
namespace {

using Clock = LiveAttempt::Clock;

class LiveAttemptTest : public testing::Test {
 protected:
  void see(double wall_s, bool paused = false) {
    attempt_.see(
        view_of(scene_, moment_), paused,
        Clock::time_point(std::chrono::hours(1)) + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * wall_s)));
  }
  const LiveMoment& told() const { return attempt_.moment(); }

  const Scene scene_ = short_scene();
  LiveAttempt attempt_{live_beginning(scene_, "test", "T-7", "a-1")};
  RunMoment moment_;
};

TEST_F(LiveAttemptTest, BeginsWithWhatIsKnownBefore) {
  EXPECT_EQ(told().trainee, "T-7");
  EXPECT_EQ(told().exercise_id, "surface-touch");
  EXPECT_EQ(told().phase, "ready");
  EXPECT_EQ(told().count, static_cast<int>(scene_.board.targets.size()));
  EXPECT_EQ(told().limit_s, scene_.level.time_limit_s);
  EXPECT_EQ(told().limit_n, scene_.setup.exercise.hard_force_n);
  EXPECT_NE(told().setup.find("organ " + scene_.organ.name), std::string::npos) << told().setup;
  EXPECT_FALSE(told().force_n);
  EXPECT_EQ(told().device, "simulated");
  Scene held = scene_;
  held.setup.backend = "hostmot2";
  EXPECT_EQ(live_beginning(held, "test", "T-7", "a-1").device, "hostmot2");
}

TEST_F(LiveAttemptTest, CountsBecomeEventsOnceAndThePeakStays) {
  moment_.status.phase = Phase::kRun;
  moment_.status.run_time_s = 1;
  see(0);
  moment_.status.run_time_s = 3.5;
  moment_.status.targets_done = 1;
  moment_.record.stylus.F_I_T.force = Vec3(0, 3, 4);
  see(0.1);
  see(0.2);
  moment_.status.run_time_s = 5;
  moment_.status.excess_forces = 1;
  moment_.record.stylus.F_I_T.force = Vec3(0, 0, 0.5);
  see(0.3);
  const std::vector<LiveEvent> wanted{
      {1, "The clock began", false}, {3.5, "Target done", false}, {5, "Too much force", true}};
  EXPECT_EQ(told().events, wanted);
  EXPECT_EQ(told().peak_force_n, 5);
  EXPECT_EQ(told().force_n, 0.5);
  EXPECT_EQ(told().elapsed_s, 5);
  EXPECT_EQ(told().phase, "running");
}

TEST_F(LiveAttemptTest, TheNewestEventsAreKept) {
  for (int i = 1; i <= 30; ++i) {
    moment_.status.wrong_places = i;
    moment_.status.run_time_s = i;
    see(0.1 * i);
  }
  ASSERT_EQ(told().events.size(), kLiveEvents);
  EXPECT_EQ(told().events.back().t_s, 30);
}

TEST_F(LiveAttemptTest, TheRateIsMeasuredAndAPauseIsNoSlowness) {
  see(0);
  moment_.record.stylus.period = 500;
  see(0.5);
  EXPECT_FALSE(told().rate_hz) << "not yet";
  moment_.record.stylus.period = 1990;
  moment_.record.stylus.tick = 1988;
  see(2);
  EXPECT_NEAR(*told().rate_hz, 995, 1e-6);
  EXPECT_EQ(told().missed, 2);
  see(2.5, true);
  EXPECT_EQ(told().phase, "paused");
  see(60, true);
  EXPECT_FALSE(told().rate_hz);
  moment_.record.stylus.period += 1000;
  see(61);
  EXPECT_NEAR(*told().rate_hz, 1000, 1e-6);
}

TEST_F(LiveAttemptTest, ARunTellsTheDeskAndHandsEveryMomentOn) {
  const test::TemporaryFolder folder;
  const std::filesystem::path database = folder.path() / "x.db";
  int moments = 0;
  bool seen = false;
  {
    LivePublisher publisher(database);
    LiveAttempt attempt(live_beginning(scene_, "trocar run", "T-7", "a-1"));
    record_short(folder.path() / "a.trec", "expert",
                 told_live(publisher, attempt, [&](const SessionView&) { ++moments; }));
    EXPECT_EQ(attempt.moment().phase, "done");
    EXPECT_TRUE(attempt.moment().missed) << "how many were missed is the machine's business";
    EXPECT_FALSE(attempt.moment().events.empty());
    for (int i = 0; i < 500 && !seen; ++i) {
      for (const LiveStation& station : look_at_stations(database).stations)
        seen = seen || station.told.moment.phase == "done";
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  EXPECT_TRUE(seen);
  EXPECT_GT(moments, 500) << "each tissue step of 5 s and more";
  EXPECT_TRUE(look_at_stations(database).stations.empty());
}

}  // namespace
}  // namespace trocar::live_attempt_test
