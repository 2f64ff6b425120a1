// The rules as a file: the shipped one says what the program does by itself, and whatever is wrong is told with its
// line and column.
#include "trainees/progress/rules.h"

#include <fstream>
#include <sstream>

#include "tests/trainees/records/store_samples.h"

namespace trocar::rules_test {
namespace {

std::string shipped() {
  std::ifstream in(std::string(TROCAR_SOURCE_DIR) + "/assets/progress.toml");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string complaint(const std::string& toml) {
  return message_of<InputError>([&] { read_progress_rules(toml, "mine.toml"); });
}

TEST(ProgressRules, AKeyOfVeryManyPartsIsRefusedWithItsPlace) {
  std::string key = "a";
  for (int i = 0; i < 40000; ++i) key += ".a";
  EXPECT_NE(complaint(key + " = 1").find("mine.toml:1:64: a key of more than 32 parts"), std::string::npos);
}

TEST(ProgressRules, ShippedFileSaysWhatTheProgramDoesByItself) {
  const ProgressRules read = read_progress_rules(shipped(), "progress.toml"), own;
  EXPECT_EQ(read.version, own.version);
  EXPECT_EQ(read.passes_to_unlock, own.passes_to_unlock);
  EXPECT_EQ(read.stuck_after, own.stuck_after);
  EXPECT_EQ(read.unsafe_window, own.unsafe_window);
  EXPECT_EQ(read.unsafe_attempts, own.unsafe_attempts);
  EXPECT_EQ(read.integrity_window, own.integrity_window);
  EXPECT_EQ(read.integrity_attempts, own.integrity_attempts);
  EXPECT_EQ(read.late_share, own.late_share);
  EXPECT_EQ(read.plateau_window, own.plateau_window);
  EXPECT_EQ(read.plateau_rise, own.plateau_rise);
  EXPECT_EQ(read.cusum.adequate, own.cusum.adequate);
  EXPECT_EQ(read.cusum.inadequate, own.cusum.inadequate);
  EXPECT_EQ(read.cusum.shown_at, own.cusum.shown_at);
  EXPECT_EQ(read.cusum.relapse_at, own.cusum.relapse_at);
  EXPECT_EQ(read.least_reliability, own.least_reliability);
  EXPECT_EQ(read.reliability_window, own.reliability_window);
  EXPECT_EQ(read.retention_days, own.retention_days);
  EXPECT_EQ(read.retention_early_days, own.retention_early_days);
  EXPECT_EQ(read.rasch_least_attempts, own.rasch_least_attempts);
  EXPECT_EQ(read.rasch_largest_se, own.rasch_largest_se);
}

TEST(ProgressRules, EveryNumberIsTakenFromItsOwnKey) {
  const ProgressRules r = read_progress_rules(
      "version = \"ward 3\"\n[unlock]\npasses_in_a_row = 4\n[stuck]\nattempts = 6\n[unsafe]\nwindow = 8\nattempts = 3\n"
      "[integrity]\nwindow = 12\nattempts = 4\nlate_share = 0.02\n[plateau]\nwindow = 7\nrise = 1.5\n"
      "[cusum]\nadequate = 0.05\ninadequate = 0.15\nshown_at = 2.4\nrelapse_at = 1.8\n[ready]\nleast_reliability = "
      "0.8\nwindow = 9\n"
      "[retention]\ndays = [7, 30, 90]\nearly_days = 1\n[rasch]\nleast_attempts = 300\nlargest_standard_error = 0.4\n",
      "mine.toml");
  EXPECT_EQ(r.version, "ward 3");
  EXPECT_EQ(r.passes_to_unlock, 4);
  EXPECT_EQ(r.stuck_after, 6);
  EXPECT_EQ(r.unsafe_window, 8);
  EXPECT_EQ(r.unsafe_attempts, 3);
  EXPECT_EQ(r.integrity_window, 12);
  EXPECT_EQ(r.integrity_attempts, 4);
  EXPECT_EQ(r.late_share, 0.02);
  EXPECT_EQ(r.plateau_window, 7);
  EXPECT_EQ(r.plateau_rise, 1.5);
  EXPECT_EQ(r.cusum.adequate, 0.05);
  EXPECT_EQ(r.cusum.inadequate, 0.15);
  EXPECT_EQ(r.cusum.shown_at, 2.4);
  EXPECT_EQ(r.cusum.relapse_at, 1.8);
  EXPECT_EQ(r.least_reliability, 0.8);
  EXPECT_EQ(r.reliability_window, 9);
  EXPECT_EQ(r.retention_days, (std::vector<int>{7, 30, 90}));
  EXPECT_EQ(r.retention_early_days, 1);
  EXPECT_EQ(r.rasch_least_attempts, 300);
  EXPECT_EQ(r.rasch_largest_se, 0.4);
}

TEST(ProgressRules, WhatIsNotNamedKeepsTheShippedValue) {
  const ProgressRules r = read_progress_rules("version = \"2\"\n[stuck]\nattempts = 8\n", "mine.toml");
  EXPECT_EQ(r.stuck_after, 8);
  EXPECT_EQ(r.passes_to_unlock, 3);
  EXPECT_EQ(r.retention_days, (std::vector<int>{14, 183}));
}

TEST(ProgressRules, WrongOnesAreToldWithLineAndColumn) {
  struct Row {
    const char *toml, *place, *what;
  };
  for (const Row& row : {
           Row{"[stuck]\nattempts = 5\n", "mine.toml:", "missing key 'version'"},
           {"version = 1\n", "mine.toml:1:11:", "must be a text"},
           {"version = \"\"\n", "mine.toml:1:11:", "must be a text"},
           {"version = \"1\"\nstuck = 5\n", "mine.toml:2:9:", "must be a table"},
           {"version = \"1\"\n[stuck]\nattempt = 5\n",
            "mine.toml:3:1:", "unknown key 'attempt' in [stuck]: known are attempts"},
           {"version = \"1\"\n[stuk]\n", "mine.toml:2:", "unknown key 'stuk'"},
           {"version = \"1\"\n[stuck]\nattempts = 1\n",
            "mine.toml:3:12:", "'stuck.attempts' = 1 is out of range 2 to 1000"},
           {"version = \"1\"\n[stuck]\nattempts = 5.5\n", "mine.toml:3:12:", "whole number"},
           {"version = \"1\"\n[stuck]\nattempts = \"5\"\n", "mine.toml:3:12:", "whole number"},
           {"version = \"1\"\n[plateau]\nrise = nan\n", "mine.toml:3:8:", "out of range"},
           {"version = \"1\"\n[plateau]\nrise = \"2\"\n", "mine.toml:3:8:", "must be a number"},
           {"version = \"1\"\n[unsafe]\nattempts = 6\n", "mine.toml:3:12:", "must not exceed"},
           {"version = \"1\"\n[integrity]\nwindow = 1\n", "mine.toml:", "must not exceed"},
           {"version = \"1\"\n[cusum]\nadequate = 0.3\n", "mine.toml:3:12:", "must be less than"},
           {"version = \"1\"\n[cusum]\nadequate = 1.0\n", "mine.toml:3:12:", "out of range"},
           {"version = \"1\"\n[retention]\ndays = 14\n", "mine.toml:3:8:", "must be a list"},
           {"version = \"1\"\n[retention]\ndays = [14, \"x\"]\n", "mine.toml:3:13:", "whole numbers"},
           {"version = \"1\"\n[retention]\ndays = [14, 14]\n", "mine.toml:3:13:", "must rise"},
           {"version = \"1\"\n[retention\n", "mine.toml:2:", ""},
       }) {
    const std::string message = complaint(row.toml);
    EXPECT_TRUE(message.starts_with(row.place)) << row.toml << message;
    EXPECT_NE(message.find(row.what), std::string::npos) << row.toml << message;
  }
}

TEST(ProgressRules, NoRetentionIsAllowed) {
  EXPECT_TRUE(read_progress_rules("version = \"1\"\n[retention]\ndays = []\n", "mine.toml").retention_days.empty());
}

}  // namespace
}  // namespace trocar::rules_test
