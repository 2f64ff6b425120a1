// Hidden nodules: twenty boards of each level, inside the organ and the region, apart, drawn by the number alone; and
// the keys that say what they are.
#include "scenarios/kinds/palpate/palpate_layout.h"

#include <gtest/gtest.h>

#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/palpate/palpate_rules.h"
#include "scenarios/layout/height_field.h"
#include "scenarios/layout/organ_placement.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar::palpate_layout_test {
namespace {

Exercise shipped() { return load_exercise(std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises/palpation.toml"); }

TEST(PalpateLayout, TwentyBoardsOfEachLevel) {
  const Exercise exercise = shipped();
  const TriangleSurface organ = liver_like().transformed(place_organ(liver_like(), exercise.layout));
  const HeightField field(organ);
  for (const ExerciseLevel& level : exercise.levels)
    for (int number = 0; number < 20; ++number) {
      const Board board = lay_out_nodules(organ, exercise, level, number);
      ASSERT_TRUE(board.targets.empty());
      ASSERT_EQ(board.nodules.size(), own_rules<PalpateRules>(exercise).nodules.size() +
                                          static_cast<std::size_t>(own_rules<PalpateLevel>(level).decoys));
      for (std::size_t i = 0; i < board.nodules.size(); ++i) {
        const HiddenNodule& one = board.nodules[i];
        const auto top = field.top(one.centre_T.x(), one.centre_T.y());
        ASSERT_TRUE(top);
        EXPECT_GT(top->position.z() - one.centre_T.z(), one.radius_m) << "under the surface";
        for (std::size_t k = 0; k < i; ++k)
          EXPECT_GT((one.centre_T - board.nodules[k].centre_T).head<2>().norm(), 0.010) << level.name << ' ' << number;
      }
      const Board again = lay_out_nodules(organ, exercise, level, number);
      for (std::size_t i = 0; i < board.nodules.size(); ++i)
        EXPECT_EQ(board.nodules[i].centre_T, again.nodules[i].centre_T);
    }
}

TEST(PalpateLayout, WhatIsNoNoduleIsLessStiffAndComesLast) {
  const Exercise exercise = shipped();
  const ExerciseLevel level = find_level(exercise, "L3");
  const TriangleSurface organ = liver_like().transformed(place_organ(liver_like(), exercise.layout));
  const Board board = lay_out_nodules(organ, exercise, level, 1);
  ASSERT_EQ(board.nodules.size(), 4u);
  for (int i = 0; i < 3; ++i)
    EXPECT_DOUBLE_EQ(board.nodules[static_cast<std::size_t>(i)].stiffness_ratio, own_rules<PalpateLevel>(level).ratio);
  EXPECT_DOUBLE_EQ(board.nodules[3].stiffness_ratio, own_rules<PalpateLevel>(level).decoy_ratio);
}

TEST(PalpateLoader, ReadsTheShippedExercise) {
  const Exercise exercise = shipped();
  ASSERT_TRUE(exercise.own);
  EXPECT_DOUBLE_EQ(own_rules<PalpateRules>(exercise).nodules[0].radius_m, 0.009);
  EXPECT_DOUBLE_EQ(own_rules<PalpateRules>(exercise).mark_hold_s, 1.5);
  EXPECT_TRUE(own_rules<PalpateLevel>(find_level(exercise, "L1")).found_shown);
  EXPECT_FALSE(own_rules<PalpateLevel>(find_level(exercise, "exam")).found_shown);
  EXPECT_DOUBLE_EQ(own_rules<PalpateLevel>(find_level(exercise, "exam")).ratio,
                   own_rules<PalpateLevel>(find_level(exercise, "L3")).ratio);
}

TEST(PalpateLoader, RefusesWhatCannotBe) {
  const std::string text = shipped().text;
  const auto refused = [&](const char* from, const char* to) { return test::refusal(test::edited(text, from, to)); };
  EXPECT_NE(refused("tissue = \"stiff\"", "tissue = \"still\"").find("tissue"), std::string::npos);
  EXPECT_NE(refused("count = 3", "count = 4").find("as many entries"), std::string::npos);
  EXPECT_NE(refused("press_n = [0.8, 1.2]", "press_n = [1.2, 0.8]").find("low below high"), std::string::npos);
  EXPECT_NE(refused("press_n = [0.8, 1.2]", "press_n = [0.8, 2.2]").find("hard_n"), std::string::npos);
  EXPECT_NE(refused("decoy_ratio = 1.3", "decoy_ratio = 5.5").find("less stiff"), std::string::npos);
  EXPECT_NE(refused("pad_mm = 10", "pad_mm = 1").find("too thin"), std::string::npos);
}

}  // namespace
}  // namespace trocar::palpate_layout_test
