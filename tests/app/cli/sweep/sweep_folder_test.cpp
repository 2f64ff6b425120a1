// The folder of a sweep: rows come back to the bit, a torn line is dropped, what is not of one sweep is refused by name
// and line, merging again changes nothing.
#include "app/cli/sweep/sweep_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include "app/cli/sweep/sweep_command.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "scenarios/scoring/score.h"
#include "tests/app/cli/command_samples.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::sweep_folder_test {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

std::string file_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Rubric time_rubric() {
  Rubric rubric;
  rubric.subscores = {{"time", "time_s", 0.75, 10, 40, false, 0.5}, {"peaks", "speed_peaks", 0.25, 0, 30, true, 0.5}};
  return rubric;
}

SweepRow row_of(const std::string& hand, std::int64_t seed, double time_s) {
  SweepRow row;
  row.key = {"small-touch", "L1", "drawn", hand, "phantom-liver", "still", static_cast<int>(1000 + seed), seed};
  row.number = "E90";
  row.exercise_version = "4";
  row.rubric_sha256 = digest::of_bytes(testing_support::small_exercise());
  row.hand_sha256 = "hand";
  row.program = "1";
  row.grade = grade_metrics({{"time_s", time_s, "s"}, {"speed_peaks", 1.0 / 3, ""}, {"path_m", std::nullopt, "m"}},
                            time_rubric(), {AttemptStatus::kTimeout, 7, 12});
  return row;
}

std::string refusal(const std::function<void()>& work) { return test::message_of<InputError>(work); }

class SweepFolder : public ::testing::Test {
 protected:
  fs::path folder(const char* name = "a") const { return folder_ / name; }
  void write_rows(const fs::path& where, const std::vector<SweepRow>& rows, int part = 1, int parts = 0) {
    RowWriter writer(where, rows_file(part, parts), err_);
    for (const SweepRow& row : rows) writer.add(row_line(row));
    if (!rows.empty()) keep_ruleset(where, rows[0].rubric_sha256, testing_support::small_exercise());
  }
  SweepRows read(const fs::path& where) {
    SweepRows rows;
    rows.read(where, err_);
    return rows;
  }
  int merge(std::vector<fs::path> from, const fs::path& out = {}) {
    return sweep_merge({std::move(from), out}, out_, err_);
  }

  TemporaryFolder folder_;
  std::ostringstream out_, err_;
};

TEST_F(SweepFolder, ARowComesBackToTheBit) {
  SweepRow row = row_of("expert", 3, 1.0 / 3 + 20);
  row.skill = 0.1;
  row.fault = "overspeed";
  row.grade.caps.push_back({.kind = CapKind::kGate, .subject = "a \"name\"", .below = 0.5, .at_most = 59});
  const std::string line = row_line(row);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const SweepRow back = parse_row(line, "here:1");
  EXPECT_EQ(row_line(back), line);
  EXPECT_EQ(back.key, row.key);
  EXPECT_EQ(back.grade.score, row.grade.score);
  EXPECT_EQ(back.grade.caps, row.grade.caps);
  EXPECT_EQ(back.grade.metrics[2].value, std::nullopt);
}

TEST_F(SweepFolder, TheRulesetMakesTheScoreAgainOrItIsRefused) {
  SweepRow row = parse_row(row_line(row_of("expert", 3, 25)), "here:1");
  check_row(row, time_rubric(), "here:1");
  EXPECT_EQ(row.grade.subscores[0].raw, 25) << "sub-scores are whole again";
  SweepRow better = row;
  *better.grade.score += 1;
  EXPECT_CONTAINS(refusal([&] { check_row(better, time_rubric(), "here:7"); }),
                  "here:7: the ruleset makes another score");
  better = row;
  better.grade.passed = true;
  EXPECT_CONTAINS(refusal([&] { check_row(better, time_rubric(), "here:7"); }), "another verdict");
}

TEST_F(SweepFolder, WhatIsNoRowIsRefusedByFileAndLine) {
  write_rows(folder(), {row_of("expert", 1, 20)});
  const fs::path file = folder() / "attempts.jsonl";
  const std::string whole = file_text(file);
  for (const auto& [bad, words] : std::vector<std::pair<std::string, std::string>>{
           {"{}\n", "no row of a sweep"}, {"not JSON\n", "no row of a sweep"}, {"\n", "no row of a sweep"}}) {
    std::ofstream(file, std::ios::binary) << whole << bad;
    const std::string said = refusal([&] { read(folder()); });
    EXPECT_CONTAINS(said, "attempts.jsonl:2: ");
    EXPECT_CONTAINS(said, words);
  }
  std::string strange = whole;
  strange.replace(strange.find("\"timeout\""), 9, "\"asleep\"");
  std::ofstream(file, std::ios::binary) << strange;
  EXPECT_CONTAINS(refusal([&] { read(folder()); }), "attempts.jsonl:1: 'asleep' is no status");
}

TEST_F(SweepFolder, ATornLastLineIsDroppedWithAWord) {
  write_rows(folder(), {row_of("expert", 1, 20), row_of("expert", 2, 21)});
  const fs::path file = folder() / "attempts.jsonl";
  const std::string whole = file_text(file);
  const std::size_t first = whole.find('\n') + 1;
  for (const std::size_t cut : {first + 1, first + 40, whole.size() - 1}) {
    fs::resize_file(file, cut);
    err_.str("");
    EXPECT_EQ(read(folder()).all().size(), 1u);
    EXPECT_CONTAINS(err_.str(), "attempts.jsonl:2: the last line was cut off");
    write_rows(folder(), {row_of("expert", 2, 21)});
    EXPECT_CONTAINS(err_.str(), "it is dropped and its attempt made again");
    EXPECT_EQ(file_text(file), whole);
  }
}

TEST_F(SweepFolder, OneProcessWritesAFileAndNoneWhileItIsMerged) {
  RowWriter writer(folder(), rows_file(1, 0), err_);
  EXPECT_CONTAINS(refusal([&] { RowWriter(folder(), rows_file(1, 0), err_); }), "is being written by another process");
  EXPECT_NO_THROW(RowWriter(folder(), rows_file(2, 3), err_)) << "another part is another file";
  EXPECT_CONTAINS(refusal([&] { merge({folder()}); }), "a sweep still writes into it");
}

TEST_F(SweepFolder, PartsMergeIntoOneFileAndAgainIntoTheSame) {
  write_rows(folder(), {row_of("novice", 2, 30), row_of("expert", 2, 20)}, 2, 2);
  write_rows(folder(), {row_of("expert", 1, 22)}, 1, 2);
  write_rows(folder("b"), {row_of("expert", 1, 22), row_of("expert", 9, 23)});
  EXPECT_EQ(merge({folder()}), 0);
  const std::string once = file_text(folder() / "attempts.jsonl");
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 3);
  EXPECT_EQ(merge({folder()}), 0);
  EXPECT_EQ(file_text(folder() / "attempts.jsonl"), once) << "with its parts still beside it";
  EXPECT_EQ(merge({folder(), folder("b")}, folder("c")), 0);
  const std::string all = file_text(folder("c") / "attempts.jsonl");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 4) << "an attempt that both have counts once";
  EXPECT_EQ(merge({folder("b"), folder("b"), folder("c"), folder()}, folder("c")), 0);
  EXPECT_EQ(file_text(folder("c") / "attempts.jsonl"), all);
  EXPECT_EQ(kept_ruleset(folder("c"), row_of("expert", 1, 1).rubric_sha256), testing_support::small_exercise());
  EXPECT_CONTAINS(refusal([&] { merge({folder(), folder("b")}); }), "--out DIR");
}

TEST_F(SweepFolder, ConflictingRowsAreRefusedWithBothPlaces) {
  write_rows(folder(), {row_of("expert", 1, 22)});
  write_rows(folder("b"), {row_of("expert", 2, 22), row_of("expert", 1, 23)});
  const std::string said = refusal([&] { merge({folder(), folder("b")}, folder("c")); });
  EXPECT_CONTAINS(said, "b/attempts.jsonl:2: another outcome than in ");
  EXPECT_CONTAINS(said, "a/attempts.jsonl:1 of small-touch L1, hand expert");
  EXPECT_FALSE(fs::exists(folder("c") / "attempts.jsonl"));
}

TEST_F(SweepFolder, OtherRulesetsHandsAndProgramsAreRefused) {
  write_rows(folder(), {row_of("expert", 1, 22)});
  const std::vector<std::pair<std::string SweepRow::*, std::string>> editions{
      {&SweepRow::rubric_sha256, "ruleset of small-touch is other, but "},
      {&SweepRow::hand_sha256, "script of hand expert is other, but hand in "},
      {&SweepRow::program, "version of the program is other, but 1 in "}};
  for (const auto& [which, words] : editions) {
    SweepRow row = row_of("expert", 2, 22);
    row.*which = "other";
    SweepRows rows = read(folder());
    const std::string said = refusal([&] { rows.take(row, row_line(row), "b:5"); });
    EXPECT_CONTAINS(said, "b:5: " + words);
    EXPECT_CONTAINS(said, "a/attempts.jsonl:1; a sweep has one");
  }
}

TEST_F(SweepFolder, ARulesetThatWasEditedIsRefused) {
  write_rows(folder(), {row_of("expert", 1, 22)});
  const std::string sha256 = row_of("expert", 1, 22).rubric_sha256;
  std::ofstream(folder() / "rulesets" / (sha256 + ".toml"), std::ios::app) << "# edited\n";
  EXPECT_CONTAINS(refusal([&] { kept_ruleset(folder(), sha256); }), "its bytes are not those of its name");
}

}  // namespace
}  // namespace trocar::sweep_folder_test
