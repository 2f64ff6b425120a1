// Boards of peg transfer: where pegs and rings stand, and what the board number draws.
#include "scenarios/kinds/pegs/pegs_layout.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "scenarios/kinds/pegs/pegs_rules.h"
#include "tests/scenarios/support/pegs_bench.h"

namespace trocar::pegs_layout_test {
namespace {

constexpr int kBoards = 20;

Board laid(const std::string& level, int number) {
  const Exercise exercise = peg_transfer();
  return lay_out_pegs(exercise, find_level(exercise, level), number);
}

bool same(const Board& a, const Board& b) {
  bool equal = a.targets.size() == b.targets.size();
  for (std::size_t i = 0; equal && i < a.targets.size(); ++i) equal = a.targets[i].centre_T == b.targets[i].centre_T;
  for (std::size_t i = 0; equal && i < a.rigid.blocks.size(); ++i)
    equal = a.rigid.blocks[i].X_TO.R == b.rigid.blocks[i].X_TO.R;
  return equal;
}

TEST(PegsLayout, TheNumberAloneDrawsTheBoard) {
  for (const char* level : {"L1", "L2", "L3", "exam"}) {
    EXPECT_TRUE(same(laid(level, 5), laid(level, 5))) << level;
    for (int a = 0; a < kBoards; ++a)
      for (int b = 0; b < a; ++b) EXPECT_FALSE(same(laid(level, a), laid(level, b))) << level << " " << a << " " << b;
  }
}

TEST(PegsLayout, TwoSidesOfSixPegsWithTheGapOfTheLevel) {
  const Exercise exercise = peg_transfer();
  for (const ExerciseLevel& level : exercise.levels) {
    const auto& asked = own_rules<PegsLevel>(level);
    for (int number = 0; number < kBoards; ++number) {
      const Board board = laid(level.name, number);
      ASSERT_EQ(board.rigid.pegs.size(), 12u);
      double nearest = 1, inner_left = -1, inner_right = 1;
      for (std::size_t i = 0; i < 12; ++i) {
        const Vec3& foot = board.rigid.pegs[i].foot_T;
        (foot.x() < 0 ? inner_left : inner_right) =
            foot.x() < 0 ? std::max(inner_left, foot.x()) : std::min(inner_right, foot.x());
        for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (foot - board.rigid.pegs[j].foot_T).norm());
      }
      EXPECT_NEAR(nearest, std::hypot(0.015, 0.0125), 1e-12) << "columns stand half a row apart";
      EXPECT_GE(inner_right - inner_left, asked.least_gap_m - 1e-12);
      EXPECT_LE(inner_right - inner_left, asked.widest_gap_m + 1e-12);
    }
  }
}

TEST(PegsLayout, EveryRingStandsOnAPegGoesToAnotherSideAndComesBack) {
  for (int number = 0; number < kBoards; ++number) {
    const Board board = laid("L3", number);
    ASSERT_EQ(board.rigid.blocks.size(), 6u);
    ASSERT_EQ(board.targets.size(), 12u);
    std::set<std::pair<double, double>> across;
    for (std::size_t i = 0; i < 6; ++i) {
      const Vec3 home = board.rigid.blocks[i].X_TO.p, there = board.targets[i].centre_T;
      EXPECT_LT(home.x(), 0);
      EXPECT_GT(there.x(), 0);
      across.insert({there.x(), there.y()});
      EXPECT_LT((board.targets[i + 6].centre_T - home).head<2>().norm(), 1e-12);
    }
    EXPECT_EQ(across.size(), 6u);
  }
}

}  // namespace
}  // namespace trocar::pegs_layout_test
