// Boards of limited grasp: where blocks and rings stand, what the board number draws, what a level changes.
#include "scenarios/kinds/grasp/grasp_layout.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/scenarios/support/grasp_bench.h"

namespace trocar::grasp_layout_test {
namespace {

constexpr int kBoards = 40;

Board laid(const std::string& level, int number) {
  const Exercise exercise = limited_grasp();
  return lay_out_blocks(exercise, find_level(exercise, level), number);
}

bool same(const Board& a, const Board& b) {
  for (std::size_t i = 0; i < a.targets.size(); ++i) {
    if (a.rigid.blocks[i].X_TO.p != b.rigid.blocks[i].X_TO.p || a.rigid.blocks[i].X_TO.R != b.rigid.blocks[i].X_TO.R ||
        a.rigid.blocks[i].kind != b.rigid.blocks[i].kind || a.targets[i].centre_T != b.targets[i].centre_T)
      return false;
  }
  return a.targets.size() == b.targets.size();
}

TEST(GraspLayout, TheNumberAloneDrawsTheBoard) {
  for (const char* level : {"L1", "L3"}) {
    EXPECT_TRUE(same(laid(level, 5), laid(level, 5))) << level;
    int twins = 0;
    for (int number = 1; number < kBoards; ++number) twins += same(laid(level, 0), laid(level, number));
    EXPECT_EQ(twins, 0) << level;
  }
}

TEST(GraspLayout, BlocksStandOnTheBoardApartFromEachOther) {
  for (const char* level : {"L1", "L2", "L3"}) {
    const double shift = std::string(level) == "L3" ? 2 * 0.004 : 0;
    for (int number = 0; number < kBoards; ++number) {
      const Board board = laid(level, number);
      ASSERT_EQ(board.rigid.blocks.size(), 6u);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_DOUBLE_EQ(board.rigid.blocks[i].X_TO.p.z(), 0.010);
        for (std::size_t j = 0; j < i; ++j) {
          const Vec3 off = (board.rigid.blocks[i].X_TO.p - board.rigid.blocks[j].X_TO.p).cwiseAbs();
          EXPECT_TRUE(off.x() > 0.024 - shift - 1e-12 || off.y() > 0.032 - shift - 1e-12) << level << " " << number;
        }
      }
    }
  }
}

TEST(GraspLayout, BlocksAndRingsLieWithinTheBoard) {
  for (int number = 0; number < kBoards; ++number) {
    const Board board = laid("L3", number);
    ASSERT_TRUE(board.rigid.board.has_value());
    const double half = board.rigid.board->half_extent_m;
    EXPECT_DOUBLE_EQ(half, 0.050);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LT(board.rigid.blocks[i].X_TO.p.head<2>().cwiseAbs().maxCoeff(), half) << number;
      EXPECT_LT(board.rigid.rings[i].centre_T.head<2>().cwiseAbs().maxCoeff(), half) << number;
    }
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        EXPECT_GT((board.rigid.blocks[i].X_TO.p - board.targets[j].centre_T).head<2>().norm(), 0.010 + 0.007)
            << "no block stands in a ring at the start, board " << number;
  }
}

TEST(GraspLayout, EachRingLiesSixtyMillimetresFromItsBlock) {
  for (const char* level : {"L1", "L3"}) {
    const double spread = std::string(level) == "L3" ? 0.008 : 0;
    for (int number = 0; number < kBoards; ++number) {
      const Board board = laid(level, number);
      for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 way = board.targets[i].centre_T - board.rigid.blocks[i].X_TO.p;
        EXPECT_NEAR(way.x(), 0.060, spread + 1e-12);
        EXPECT_NEAR(way.y(), 0, spread + 1e-12);
        EXPECT_EQ(board.rigid.rings[i].centre_T, board.targets[i].centre_T);
      }
    }
  }
}

TEST(GraspLayout, DealsTheFoamsOutEvenlyAndLightsThemInDrawnOrder) {
  std::set<std::vector<std::int32_t>> orders;
  for (int number = 0; number < kBoards; ++number) {
    std::map<std::int32_t, int> dealt;
    std::vector<std::int32_t> order;
    for (const FoamBlock& block : laid("L1", number).rigid.blocks) {
      ++dealt[block.kind];
      order.push_back(block.kind);
    }
    orders.insert(order);
    EXPECT_EQ(dealt, (std::map<std::int32_t, int>{{0, 2}, {1, 2}, {2, 2}})) << number;
  }
  EXPECT_GT(orders.size(), 20u) << "of 90 possible orders";
}

TEST(GraspLayout, EachRingAsksForTheGripOfItsBlock) {
  const Exercise exercise = limited_grasp();
  const Board board = laid("L2", 3);
  for (std::size_t i = 0; i < 6; ++i) {
    const FoamBlock& block = board.rigid.blocks[i];
    EXPECT_DOUBLE_EQ(block.crush_above_n, exercise.grasp.kinds[static_cast<std::size_t>(block.kind)].crush_above_n);
    EXPECT_DOUBLE_EQ(board.targets[i].band.low_n, 1.25 * block.slip_below_n);
    EXPECT_DOUBLE_EQ(board.targets[i].band.high_n, 0.75 * block.crush_above_n);
    EXPECT_DOUBLE_EQ(board.targets[i].radius_m, 0.003);
  }
}

TEST(GraspLayout, LevelsShowColourOrTurnTheBlocks) {
  for (const FoamBlock& block : laid("L1", 2).rigid.blocks) {
    EXPECT_EQ(block.colour, block.kind);
    EXPECT_NEAR(std::atan2(block.X_TO.R(1, 0), block.X_TO.R(0, 0)), M_PI / 4, 1e-12);
  }
  double least = 1e9, most = -1e9;
  for (int number = 0; number < kBoards; ++number) {
    const Board board = laid("L3", number);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(board.rigid.blocks[i].colour, -1) << "all look alike";
      EXPECT_EQ(board.rigid.rings[i].colour, -1) << "the ring gives nothing away";
      const Mat3& R = board.rigid.blocks[i].X_TO.R;
      const double turned = std::atan2(R(1, 0), R(0, 0)) * 180 / M_PI - 45;
      least = std::min(least, turned);
      most = std::max(most, turned);
    }
  }
  EXPECT_GE(least, -12);
  EXPECT_LE(most, 12);
  EXPECT_GT(most - least, 20) << "the spread is used";
}

}  // namespace
}  // namespace trocar::grasp_layout_test
