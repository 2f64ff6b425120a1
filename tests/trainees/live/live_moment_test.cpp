#include "trainees/live/live_moment.h"

#include <gtest/gtest.h>

#include <limits>

namespace trocar::live_moment_test {
namespace {

StatusSnapshot sample() {
  StatusSnapshot told;
  told.moment = {.program = "trocar run",
                 .trainee = "T-7",
                 .exercise_id = "surface-touch",
                 .exercise = "Surface touch",
                 .level = "L2",
                 .hand = "expert",
                 .setup = "board 3",
                 .attempt = "a-1",
                 .phase = "running"};
  told.moment.elapsed_s = 12.25;
  told.moment.force_n = 0.125;
  told.moment.done = 3;
  told.moment.count = 12;
  told.moment.at_limit = true;
  told.moment.hears = true;
  told.moment.events = {{1.5, "Target done", false}, {2.5, "Too much force", true}};
  told.process = {4711, "boot-a", 987654321012};
  told.machine = "lab-3";
  told.began_utc = "2026-03-01T09:30:00Z";
  told.told_utc = "2026-03-01T09:31:00Z";
  told.told_s = 1234.5;
  return told;
}

TEST(LiveMoment, ComesBackFromItsTextAsItWas) {
  const StatusSnapshot told = sample();
  const auto read = parse_live_text(live_text(told));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->moment, told.moment);
  EXPECT_EQ(read->process.pid, told.process.pid);
  EXPECT_EQ(read->process.boot, told.process.boot);
  EXPECT_EQ(read->process.start, told.process.start);
  EXPECT_EQ(read->machine, "lab-3");
  EXPECT_EQ(read->told_utc, told.told_utc);
  EXPECT_EQ(read->told_s, told.told_s);
}

TEST(LiveMoment, NumbersThatAreNoneAreLeftOutAndTextsMayHoldAnything) {
  StatusSnapshot told = sample();
  told.moment.force_n = std::numeric_limits<double>::quiet_NaN();
  told.moment.limit_n = std::numeric_limits<double>::infinity();
  told.moment.trainee = "a\"\\\n\xC3\x28";
  const auto read = parse_live_text(live_text(told));
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->moment.force_n);
  EXPECT_FALSE(read->moment.limit_n);
  EXPECT_TRUE(read->moment.trainee.starts_with("a\"\\\n"));
}

TEST(LiveMoment, GarbageIsNoMoment) {
  const std::string whole = live_text(sample());
  EXPECT_TRUE(parse_live_text(whole));
  for (std::size_t cut = 0; cut + 2 < whole.size(); cut += 7)
    EXPECT_FALSE(parse_live_text(whole.substr(0, cut))) << cut;
  for (const char* odd :
       {"", "{}", "[]", "17", "null", "\"trocar-live-1\"", R"({"form":"trocar-live-2","process":{},"moment":{}})",
        R"({"form":"trocar-live-1"})", R"({"form":"trocar-live-1","process":[],"moment":{}})",
        R"({"form":"trocar-live-1","process":{"pid":-4,"boot":"b","start":1},"moment":{}})",
        R"({"form":"trocar-live-1","process":{"pid":"4","boot":"b","start":1},"moment":{}})"})
    EXPECT_FALSE(parse_live_text(odd)) << odd;
}

TEST(LiveMoment, FieldsOfAnotherKindAreLeftEmptyAndLongOnesCut) {
  const std::string text =
      R"({"form":"trocar-live-1","process":{"pid":4,"boot":"b","start":1},"told_s":"now","moment":{"trainee":7,"phase":")" +
      std::string(5000, 'x') +
      R"(","force_n":"1","done":-3,"count":1e300,"at_limit":"yes","events":[1,null,{"t_s":"x","what":5}]}})";
  const auto read = parse_live_text(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->moment.trainee, "");
  EXPECT_EQ(read->moment.phase.size(), 200u);
  EXPECT_FALSE(read->moment.force_n);
  EXPECT_EQ(read->moment.done, 0);
  EXPECT_EQ(read->moment.count, 0);
  EXPECT_FALSE(read->moment.at_limit);
  ASSERT_EQ(read->moment.events.size(), 1u);
  EXPECT_EQ(read->moment.events[0], LiveEvent{});
}

TEST(LiveMoment, NewsIsWhoWhatAndPhaseAndNotTheNumbers) {
  const LiveMoment a = sample().moment;
  LiveMoment b = a;
  b.force_n = 9;
  b.elapsed_s = 99;
  EXPECT_TRUE(same_news(a, b));
  for (std::string LiveMoment::*field :
       {&LiveMoment::trainee, &LiveMoment::exercise_id, &LiveMoment::level, &LiveMoment::attempt, &LiveMoment::phase}) {
    LiveMoment c = a;
    c.*field = "other";
    EXPECT_FALSE(same_news(a, c));
  }
}

}  // namespace
}  // namespace trocar::live_moment_test
