// Blades on a duct: cut through, nicked, jammed on a clip, and what closing them takes.
#include "tissue/thin/rod_scissors.h"

#include <gtest/gtest.h>

#include "tests/tissue/thin/rod_rig.h"

namespace trocar::rod_scissors_test {
namespace {

constexpr double kOpen = 0.008;

struct Closing {
  std::vector<RodCut> cuts;
  double work_j = 0;
  bool jammed = false;
};

Closing close(const ElasticRod& rod, const Pose& X, std::span<const double> clips = {}, double from = kOpen,
              double to = 0) {
  const std::array<ClipSurroundings::Rod, 1> rods{{{&rod, clips}}};
  RodScissors scissors;
  Closing closing;
  constexpr int kSteps = 800;
  for (int i = 0; i <= kSteps; ++i) {
    const auto cuts = scissors.step(X, from + (to - from) * i / kSteps, rods);
    closing.work_j += scissors.resist_n() * (from - to) / kSteps;
    closing.cuts.insert(closing.cuts.end(), cuts.begin(), cuts.end());
    closing.jammed = closing.jammed || scissors.jammed();
  }
  return closing;
}

TEST(RodScissors, CutThroughWhatLiesBetween) {
  ElasticRod rod = test::hung_duct();
  const Closing closing = close(rod, test::jaws_from_above({0.0153, 0, -0.006}));
  ASSERT_EQ(closing.cuts.size(), 1u);
  EXPECT_NEAR(closing.cuts[0].arc_m, 0.0153, 1e-9);
  EXPECT_EQ(closing.cuts[0].share, 1);
  ASSERT_TRUE(rod.sever(closing.cuts[0].arc_m));
  EXPECT_EQ(rod.parts().size(), 2u);
}

TEST(RodScissors, CutNothingBesideAndNothingWhenClosedBefore) {
  ElasticRod rod = test::hung_duct();
  EXPECT_TRUE(close(rod, test::jaws_from_above({0.0153, 0.02, -0.006})).cuts.empty());
  EXPECT_TRUE(close(rod, test::jaws_from_above({0.0153, 0, 0.01})).cuts.empty());
  EXPECT_TRUE(close(rod, test::jaws_from_above({0.0153, 0, -0.006}), {}, 0.0003, 0).cuts.empty());
  EXPECT_TRUE(close(rod, test::jaws_from_above({0.0153, 0, -0.006}), {}, kOpen, 0.001).cuts.empty()) << "not shut";
}

TEST(RodScissors, NickWhatLiesBetweenOnlyInPart) {
  ElasticRod rod = test::hung_duct();
  const Closing closing = close(rod, test::jaws_from_above({0.0153, 0, 0}));
  ASSERT_EQ(closing.cuts.size(), 1u);
  EXPECT_NEAR(closing.cuts[0].share, 0.5, 0.01);
}

TEST(RodScissors, JamOnAClip) {
  ElasticRod rod = test::hung_duct();
  const std::vector<double> clips{0.0150, 0.030};
  const Closing on = close(rod, test::jaws_from_above({0.0153, 0, -0.006}), clips);
  EXPECT_TRUE(on.jammed);
  EXPECT_TRUE(on.cuts.empty());
  const Closing beside = close(rod, test::jaws_from_above({0.0180, 0, -0.006}), clips);
  EXPECT_FALSE(beside.jammed);
  EXPECT_EQ(beside.cuts.size(), 1u);
}

TEST(RodScissors, TakeToughnessTimesTheWallsArea) {
  ElasticRod rod = test::hung_duct();
  const double area = std::numbers::pi * (1.5e-3 * 1.5e-3 - 1e-3 * 1e-3);
  EXPECT_NEAR(close(rod, test::jaws_from_above({0.0153, 0, -0.006})).work_j, 500 * area, 0.02 * 500 * area);
}

}  // namespace
}  // namespace trocar::rod_scissors_test
