// The keys of limited grasp: read as written, and every mistake refused at its line and column.
#include "scenarios/kinds/grasp/grasp_reader.h"

#include <gtest/gtest.h>

#include "tests/scenarios/support/bad_exercise.h"
#include "tests/scenarios/support/grasp_bench.h"

namespace trocar::grasp_loader_test {
namespace {

using test::refusal;

struct Refused {
  const char* from;
  const char* to;
  const char* key;  ///< stands in the changed file where the error is
  const char* message;
};

std::string changed(const std::string& from, const std::string& to) {
  return test::edited(limited_grasp().text, from, to);
}

/// "bad.toml:LINE:" of the first place at which `word` stands.
std::string line_of(const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  if (at == std::string::npos) ADD_FAILURE() << "not in the changed file: " << word;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return "bad.toml:" + std::to_string(line) + ":";
}

TEST(GraspLoader, ReadsTheShippedExercise) {
  const GraspRules rules = limited_grasp().grasp;
  EXPECT_LT((rules.block_m - Vec3(0.014, 0.014, 0.020)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(rules.block_mass_kg, 0.002);
  EXPECT_DOUBLE_EQ(rules.ring_radius_m, 0.010);
  EXPECT_DOUBLE_EQ(rules.lift_m, 0.030);
  EXPECT_DOUBLE_EQ(rules.lost_margin_m, 0.015);
  EXPECT_EQ(rules.critical_crushed, 3);
  ASSERT_EQ(rules.kinds.size(), 3u);
  EXPECT_EQ(rules.kinds[1].name, "blue");
  EXPECT_DOUBLE_EQ(rules.kinds[1].slip_below_n, 0.8);
}

TEST(GraspLoader, ALevelKeepsWhatItDoesNotName) {
  const Exercise exercise = limited_grasp();
  const GraspLevel l2 = find_level(exercise, "L2").grasp, l3 = find_level(exercise, "L3").grasp;
  EXPECT_TRUE(l2.colour_cue);
  EXPECT_DOUBLE_EQ(l2.window_margin, 0.25);
  EXPECT_NEAR(l2.yaw_rad, M_PI / 4, 1e-12) << "of L1";
  EXPECT_FALSE(l3.colour_cue);
  EXPECT_DOUBLE_EQ(l3.place_spread_m, 0.004);
  EXPECT_DOUBLE_EQ(find_level(exercise, "exam").grasp.place_tolerance_m, l3.place_tolerance_m);
}

TEST(GraspLoader, NamesLineAndColumnOfTheValue) {
  const std::string text = changed("lift_mm = 30", "lift_mm = 300");
  const std::string message = refusal(text);
  EXPECT_EQ(message.rfind(line_of(text, "lift_mm = 300"), 0), 0u) << message;
  EXPECT_EQ(message.rfind(line_of(text, "lift_mm = 300") + "11: ", 0), 0u) << message;
  EXPECT_NE(message.find("'lift_mm' = 300 is out of range"), std::string::npos) << message;
}

class GraspLoaderRefuses : public testing::TestWithParam<Refused> {};

TEST_P(GraspLoaderRefuses, AtTheLineOfTheMistake) {
  const std::string text = changed(GetParam().from, GetParam().to), message = refusal(text);
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_EQ(message.rfind(line_of(text, GetParam().key), 0), 0u) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, GraspLoaderRefuses,
    testing::Values(
        Refused{"crush_above_n = 1.5", "crush_above_n = 0.5", "crush_above_n = 0.5", "must be above 'slip_below_n'"},
        Refused{"stiffness_n_per_m = 300", "stiffness_n_per_m = 100", "stiffness_n_per_m = 100",
                "'yellow' is too soft"},
        Refused{"row_mm = 32", "row_mm = 19", "row_mm = 19", "'row_mm' lets blocks overlap"},
        Refused{"column_mm = 24", "column_mm = 19", "column_mm = 19", "'column_mm' lets blocks overlap"},
        Refused{"rows = 3", "rows = 4", "[blocks]", "must be the 'count' of [targets]"},
        Refused{"rows = 3", "rows = 2.5", "rows = 2.5", "'rows' must be a whole number"},
        Refused{"critical_crushed = 3", "critical_crushed = 0", "critical_crushed = 0", "is out of range"},
        Refused{"drop_mm = 5 ", "drop_mn = 5 ", "drop_mn = 5 ", "did you mean 'drop_mm'?"},
        Refused{"drop_mm = 5 ", "#", "[blocks]", "missing key 'drop_mm'"},
        Refused{"mass_g = 2", "mass_g = 2\nweight = 3", "weight = 3", "unknown key 'weight'"},
        Refused{"size_mm = [14, 14, 20]", "size_mm = [14, 14]", "size_mm = [14, 14]", "array of 3 numbers"},
        Refused{"slip_below_n = 0.5", "slip_below_n = nan", "slip_below_n = nan", "'slip_below_n' must be finite"},
        Refused{"lost_beyond_mm = 15", "lost_beyond_mm = -1", "lost_beyond_mm = -1", "is out of range"},
        Refused{"window_margin = 0.20", "window_margin = 0.60", "window_margin = 0.60", "leaves no grip for foam"},
        Refused{"place_tolerance_mm = 4", "place_tolerance_mm = 11", "place_tolerance_mm = 11", "wider than the ring"},
        Refused{"colour_cue = true", "colour_cue = 1", "colour_cue = 1", "'colour_cue' must be true or false"},
        Refused{"yaw_spread_deg = 0", "yaw_spread_deg = 60", "yaw_spread_deg = 60", "is out of range"}));

TEST(GraspLoader, TakesAtMostFourFoams) {
  std::string more;
  for (const char* name : {"green", "white"})
    more += "[[blocks.kinds]]\nname = \"" + std::string(name) +
            "\"\nstiffness_n_per_m = 400\nslip_below_n = 0.5\ncrush_above_n = 2\n";
  EXPECT_NE(refusal(changed("[force]", more + "[force]")).find("at most 4 kinds"), std::string::npos);
}

}  // namespace
}  // namespace trocar::grasp_loader_test
