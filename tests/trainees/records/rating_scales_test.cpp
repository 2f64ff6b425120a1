// A person's rating of an attempt: what the scale takes, all or nothing, and how the newest values of each rater are
// read.
#include "trainees/records/rating_scales.h"

#include <functional>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::rating_scales_test {
namespace {

class Ratings : public testing::Test {
 protected:
  Ratings() {
    TraineeStore(database_).ensure_trainee("T-1");
    attempt_ = store_attempt(database_, sample_start("T-1"), sample_result()).uuid;
  }
  void refuses(const std::map<std::string, double>& values, const std::string& why,
               const std::string& scale = "GOALS") {
    const std::string message = message_of<InputError>([&] { store_.rate(attempt_, scale, values, ida_); });
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
  std::vector<RatingSheet> sheets() { return rating_sheets(store_.ratings_of(attempt_), goals_scale()); }

  Database database_{":memory:"};
  AssessmentStore store_{database_};
  const Author ida_{"0192-ida", "Ida Adler"}, otto_{"", "Otto"};
  std::string attempt_;
};

std::map<std::string, double> all(double value) {
  std::map<std::string, double> values;
  for (const RatingItem& item : goals_scale().items) values[item.name] = value;
  return values;
}

TEST(RatingScale, GoalsHasFiveItemsFromOneToFive) {
  EXPECT_EQ(goals_scale().items.size(), 5U);
  EXPECT_EQ(goals_scale().least, 1);
  EXPECT_EQ(goals_scale().most, 5);
  EXPECT_EQ(&rating_scale("GOALS"), &goals_scale());
  EXPECT_NE(message_of<InputError>([] { rating_scale("GRADES"); }).find("known: GOALS"), std::string::npos);
}

TEST_F(Ratings, ASumNeedsEveryItem) {
  store_.rate(attempt_, "GOALS", {{"efficiency", 3}, {"autonomy", 5}}, ida_);
  ASSERT_EQ(sheets().size(), 1U);
  EXPECT_FALSE(sheets()[0].total(goals_scale()));
  EXPECT_EQ(sheets()[0].values.size(), 2U);
  store_.rate(attempt_, "GOALS", {{"depth perception", 2}, {"bimanual dexterity", 4}, {"tissue handling", 1}}, ida_);
  ASSERT_EQ(sheets().size(), 1U);
  EXPECT_EQ(sheets()[0].total(goals_scale()), 15.0);
}

TEST_F(Ratings, TheNewestValueOfEachRaterCountsAndTheOlderStays) {
  store_.rate(attempt_, "GOALS", all(2), ida_);
  store_.rate(attempt_, "GOALS", all(5), otto_);
  store_.rate(attempt_, "GOALS", {{"efficiency", 4}}, ida_);
  const auto read = sheets();
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].rater, "Ida Adler");
  EXPECT_EQ(read[0].total(goals_scale()), 12.0);
  EXPECT_EQ(read[1].total(goals_scale()), 25.0);
  EXPECT_EQ(store_.ratings_of(attempt_).size(), 11U);
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Ratings, TwoPeopleOfOneNameWithAccountsAreTwo) {
  store_.rate(attempt_, "GOALS", all(2), {"0192-a", "Ida Adler"});
  store_.rate(attempt_, "GOALS", all(3), {"0192-b", "Ida Adler"});
  store_.rate(attempt_, "GOALS", all(4), {"", "Ida Adler"});
  EXPECT_EQ(sheets().size(), 3U);
}

TEST_F(Ratings, WhatTheScaleDoesNotHaveIsRefusedAsAWhole) {
  refuses({}, "no item was rated");
  refuses({{"efficiency", 3}, {"charm", 5}}, "charm: the scale has no such item");
  refuses({{"efficiency", 0}}, "a whole number from 1 to 5");
  refuses({{"efficiency", 6}}, "a whole number from 1 to 5");
  refuses({{"efficiency", 2.5}}, "a whole number from 1 to 5");
  refuses({{"efficiency", 2}}, "known: GOALS", "GRADES");
  EXPECT_TRUE(store_.ratings_of(attempt_).empty());
}

TEST_F(Ratings, OfARunningAttemptNothingIsKept) {
  const std::string running = AttemptStore(database_).begin_attempt(sample_start("T-1")).uuid;
  EXPECT_NE(message_of<InputError>([&] { store_.rate(running, "GOALS", all(3), ida_); }).find("still running"),
            std::string::npos);
  EXPECT_TRUE(store_.ratings_of(running).empty());
}

TEST_F(Ratings, AChangedRatingIsFound) {
  store_.rate(attempt_, "GOALS", all(2), ida_);
  sql::execute(database_.connection(),
               "DROP TRIGGER rating_no_update; UPDATE rating SET value = 5 WHERE item = 'autonomy'");
  EXPECT_FALSE(database_.check().empty());
}

}  // namespace
}  // namespace trocar::rating_scales_test
