// Days counted by hand, across leap days and years, and texts that are no time.
#include "trainees/progress/calendar.h"

#include <gtest/gtest.h>

namespace trocar::calendar_test {
namespace {

TEST(Calendar, KnowsPublishedSeconds) {
  EXPECT_EQ(seconds_of_utc("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(seconds_of_utc("2001-09-09T01:46:40Z"), 1000000000);
  EXPECT_EQ(seconds_of_utc("2038-01-19T03:14:07.999Z"), 2147483647);
  EXPECT_EQ(utc_of_seconds(1000000000), "2001-09-09T01:46:40Z");
  EXPECT_EQ(utc_of_seconds(0), "1970-01-01T00:00:00Z");
}

TEST(Calendar, GoesThereAndBack) {
  for (std::int64_t s = 0; s < 4000000000; s += 12345677) EXPECT_EQ(seconds_of_utc(utc_of_seconds(s)), s);
}

TEST(Calendar, CountsLeapDays) {
  const auto day = [](const char* utc) { return *seconds_of_utc(utc) / kSecondsADay; };
  EXPECT_EQ(day("2028-03-01T00:00:00Z") - day("2028-02-28T00:00:00Z"), 2);
  EXPECT_EQ(day("2026-03-01T00:00:00Z") - day("2026-02-28T00:00:00Z"), 1);
  EXPECT_EQ(day("2100-03-01T00:00:00Z") - day("2100-02-28T00:00:00Z"), 1);
}

TEST(Calendar, RefusesWhatIsNoTime) {
  for (const char* text :
       {"", "yesterday", "2026-02-30T00:00:00Z", "2026-13-01T00:00:00Z", "2026-01-01 00:00:00Z", "2026-01-01T24:00:00Z",
        "2026-01-01T00:60:00Z", "2026-01-01T00:00:00", "2026-01-01T0a:00:00Z", "20260101T000000Z......"})
    EXPECT_FALSE(seconds_of_utc(text)) << text;
}

TEST(Calendar, WeeksBeginOnMonday) {
  EXPECT_EQ(monday_of(0), "1969-12-29");                                        // a Thursday
  EXPECT_EQ(monday_of(*seconds_of_utc("2026-03-01T23:59:59Z")), "2026-02-23");  // a Sunday
  EXPECT_EQ(monday_of(*seconds_of_utc("2026-03-02T00:00:00Z")), "2026-03-02");
  EXPECT_EQ(monday_of(*seconds_of_utc("2025-01-01T12:00:00Z")), "2024-12-30");
}

}  // namespace
}  // namespace trocar::calendar_test
