// Dates after a certificate: which attempt counts for which, what is due, what was missed.
#include "trainees/progress/retention.h"

#include <gtest/gtest.h>

#include "trainees/progress/calendar.h"

namespace trocar::retention_test {
namespace {

using State = RetentionDate::State;

constexpr const char* kCertified = "2026-01-10T12:00:00.000Z";  // due 2026-01-24 and 2026-07-12

std::string day(int after) { return utc_of_seconds(*seconds_of_utc(kCertified) + after * kSecondsADay); }

CurveAttempt on(int after, bool passed = true) {
  CurveAttempt a;
  a.started_s = *seconds_of_utc(day(after));
  a.score = passed ? 85 : 60;
  a.passed = passed;
  return a;
}

std::vector<State> states(const std::vector<CurveAttempt>& attempts, int now, const ProgressRules& rules = {}) {
  std::vector<State> out;
  for (const RetentionDate& date : retention_dates(kCertified, attempts, rules, day(now))) out.push_back(date.state);
  return out;
}

TEST(Retention, DatesAreTwoWeeksAndSixMonthsAfter) {
  const auto dates = retention_dates(kCertified, {}, {}, kCertified);
  ASSERT_EQ(dates.size(), 2u);
  EXPECT_EQ(dates[0].due_utc, "2026-01-24T12:00:00Z");
  EXPECT_EQ(dates[1].due_utc, "2026-07-12T12:00:00Z");
  EXPECT_EQ(dates[0].days, 14);
  EXPECT_TRUE(retention_dates("", {}, {}, kCertified).empty());
  EXPECT_TRUE(retention_dates("some day", {}, {}, kCertified).empty());
}

TEST(Retention, ComesDueOnTheDayAndIsMissedWhenTheNextBegins) {
  EXPECT_EQ(states({}, 13), (std::vector{State::kUpcoming, State::kUpcoming}));
  EXPECT_EQ(states({}, 14), (std::vector{State::kDue, State::kUpcoming}));
  EXPECT_EQ(states({}, 179), (std::vector{State::kDue, State::kUpcoming}));
  EXPECT_EQ(states({}, 180), (std::vector{State::kMissed, State::kUpcoming}));
  EXPECT_EQ(states({}, 183), (std::vector{State::kMissed, State::kDue}));
  EXPECT_EQ(states({}, 5000), (std::vector{State::kMissed, State::kDue})) << "the last stays due";
}

TEST(Retention, TheFirstGradedAttemptInItsWindowCounts) {
  EXPECT_EQ(states({on(11)}, 20)[0], State::kKept) << "three days early";
  EXPECT_EQ(states({on(10)}, 20)[0], State::kDue) << "practice after the certificate is none";
  EXPECT_EQ(states({on(15, false), on(16)}, 20)[0], State::kNotKept) << "the first, not the best";
  EXPECT_EQ(states({on(16), on(15, false)}, 20)[0], State::kNotKept) << "in any order";
  EXPECT_EQ(states({on(200)}, 210), (std::vector{State::kMissed, State::kKept}));
  EXPECT_EQ(states({on(-3)}, 20)[0], State::kDue);
}

TEST(Retention, WhatTheDeviceEndedOrWasNotGradedDoesNotCount) {
  CurveAttempt broken = on(14), left = on(14);
  broken.broken = true;
  left.score.reset();
  EXPECT_EQ(states({broken, left}, 20)[0], State::kDue);
}

TEST(Retention, RulesOfACurriculumHold) {
  ProgressRules rules;
  rules.retention_days = {7};
  rules.retention_early_days = 30;
  EXPECT_EQ(states({on(0)}, 8, rules), std::vector{State::kDue}) << "never before the certificate";
  EXPECT_EQ(states({on(1)}, 8, rules), std::vector{State::kKept});
  rules.retention_days = {};
  EXPECT_TRUE(states({on(1)}, 8, rules).empty());
}

TEST(Retention, StatesHaveWords) {
  EXPECT_STREQ(retention_state_name(State::kDue), "due");
  EXPECT_STREQ(retention_state_name(State::kNotKept), "not kept");
}

}  // namespace
}  // namespace trocar::retention_test
