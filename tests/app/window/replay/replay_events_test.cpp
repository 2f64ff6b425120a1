// What of a run is worth jumping to: what a person saw happen, on the clock of the film, in words.
#include "app/window/replay/replay_events.h"

#include <gtest/gtest.h>

namespace trocar::replay_events_test {
namespace {

Event event(double t_s, const char* type, Severity severity = Severity::kInfo) {
  Event out;
  out.t_s = t_s;
  out.type = type;
  out.severity = severity;
  return out;
}

TEST(ReplayEvents, AreToldOnTheClockOfTheFilm) {
  const auto told =
      replay_events({event(7.5, "TARGET_HELD"), event(9, "CRITICAL_FORCE", Severity::kCritical)}, 5.5, Translator());
  ASSERT_EQ(told.size(), 2u);
  EXPECT_DOUBLE_EQ(told[0].clock_s, 2);
  EXPECT_EQ(told[0].severity, Severity::kInfo);
  EXPECT_FALSE(told[0].words.empty());
  EXPECT_NE(told[0].words, told[1].words);
  EXPECT_EQ(told[1].severity, Severity::kCritical);
}

TEST(ReplayEvents, WhatOnlyTheGradeReadsIsLeftOut) {
  EXPECT_TRUE(
      replay_events({event(1, "TARGET_LIT"), event(2, "POSITION_ERROR"), event(2, "NO_SUCH_TYPE")}, 0, Translator())
          .empty());
  EXPECT_TRUE(replay_events({}, 0, Translator()).empty());
}

}  // namespace
}  // namespace trocar::replay_events_test
