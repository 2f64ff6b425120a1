#include "app/desk/desk_facts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "haptics/input_error.h"
#include "trainees/progress/rules.h"

namespace trocar::desk_facts_test {
namespace {

std::string file_text(const std::string& path) {
  std::ifstream file(std::string(TROCAR_SOURCE_DIR) + "/" + path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(DeskFacts, TouchHasItsBandLimitAndPassMark) {
  const std::string text = file_text("scenarios/exercises/surface-touch.toml");
  const review::LevelFacts first = desk_level_facts(text, "L1");
  EXPECT_DOUBLE_EQ(first.limits.low_n, 0.4);
  EXPECT_DOUBLE_EQ(first.limits.high_n, 0.8);
  EXPECT_DOUBLE_EQ(first.limits.hard_n, 1.5);
  EXPECT_DOUBLE_EQ(first.pass_at, 75);
  EXPECT_DOUBLE_EQ(desk_level_facts(text, "L2").limits.low_n, 0.5);
}

TEST(DeskFacts, SeveralBandsAreNoBand) {
  const review::LevelFacts third = desk_level_facts(file_text("scenarios/exercises/surface-touch.toml"), "L3");
  EXPECT_DOUBLE_EQ(third.limits.high_n, 0);
  EXPECT_DOUBLE_EQ(third.limits.hard_n, 1.5);
}

TEST(DeskFacts, TheRubricSaysWhichWayIsBetter) {
  const review::LevelFacts facts = desk_level_facts(file_text("scenarios/exercises/surface-touch.toml"), "L1");
  EXPECT_EQ(facts.less_is_better.at("object_in_band_share"), false);
  EXPECT_EQ(facts.less_is_better.at("time_s"), true);
  EXPECT_EQ(facts.less_is_better.count("force_max_n"), 0U);
}

TEST(DeskFacts, PensHaveTolerancesAndBlocksTheirLimitsByBoard) {
  const std::string pens = file_text("scenarios/exercises/reach-and-orient.toml"),
                    blocks = file_text("scenarios/exercises/limited-grasp.toml");
  EXPECT_GT(desk_level_facts(pens, "L1").pose.position_m, 0);
  EXPECT_EQ(desk_level_facts(blocks, "L1").pose.position_m, 0);
  EXPECT_TRUE(desk_grip_limits(pens, "L1", 3).empty());
  std::multiset<double> slips;
  for (const GripLimits& limits : desk_grip_limits(blocks, "L1", 3)) slips.insert(limits.slip_n);
  EXPECT_EQ(slips.count(0.5), 2U);
  EXPECT_EQ(slips.count(1.2), 2U);
}

TEST(DeskFacts, AllShippedExercisesCanBeShown) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises")) {
    if (entry.is_directory()) continue;  // what is not graded
    EXPECT_GT(desk_level_facts(file_text("scenarios/exercises/" + entry.path().filename().string()), "L1").pass_at, 0)
        << entry.path();
  }
}

TEST(DeskFacts, BadTextAndLevelAreRefused) {
  EXPECT_THROW(desk_level_facts("id = \"surface-touch\"\n", "L1"), InputError);
  EXPECT_THROW(desk_level_facts(file_text("scenarios/exercises/surface-touch.toml"), "L9"), InputError);
}

TEST(DeskFacts, ShippedRulesCanBeRead) {
  EXPECT_EQ(read_progress_rules(shipped_progress_rules(std::string(TROCAR_SOURCE_DIR) + "/assets"), "shipped").version,
            ProgressRules{}.version);
  EXPECT_EQ(shipped_progress_rules("/nowhere"), "");
}

}  // namespace
}  // namespace trocar::desk_facts_test
