// A duct that hangs on a soft block and is pulled: both step in turn, and come to the same force.
#include "tissue/thin/rod_on_solid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tissue/solid/soft_blocks.h"

namespace trocar::rod_on_solid_test {
namespace {

struct Pulled {
  test::SoftBlock block{6, 6, 3, 0.01};
  SoftSolid solid;
  ElasticRod rod;
  NodeShares place;
  Vec3 top;

  Pulled() : solid(block.nodes, block.cells, std::vector<TissueSolid>{TissueSolid{}}, {}), rod(upright(), {}) {
    for (const std::int32_t node : block.face(2, false)) solid.hold(node, 1e4);
    place = {{block.id(3, 3, 3)}, {1.0f}};
    top = upright().back();
  }
  std::vector<Vec3> upright() const {
    std::vector<Vec3> path;
    for (int i = 0; i <= 30; ++i) path.push_back(block.nodes[std::size_t(block.id(3, 3, 3))] + Vec3(0, 0, 0.001 * i));
    return path;
  }
  void step(const Vec3& pulled, bool as_fixed_force = false) {
    rod.anchor(RodEnd::kStart, anchor_on(solid, place, 2000));
    rod.anchor(RodEnd::kFinish, {.position = top + pulled});
    rod.step();
    auto springs = load_springs(anchor_load(rod, RodEnd::kStart), place);
    if (as_fixed_force)
      for (SoftSpring& spring : springs) {
        const double force =
            spring.stiffness_n_per_m * (spring.stretch_m + spring.direction.dot(rod.anchor_way(RodEnd::kStart)));
        spring.stiffness_n_per_m = 1e-6;
        spring.stretch_m = force / 1e-6;
      }
    solid.step(springs);
  }
  Vec3 at() const { return solid.position()[std::size_t(place.node[0])].cast<double>(); }
};

TEST(RodOnSolid, ComesToTheForceAtWhichBothAreInBalance) {
  Pulled p;
  for (int i = 0; i < 200; ++i) p.step(Vec3(0, 0, 5e-5 * std::min(i, 100)));
  double swing = 0;
  const Vec3 there = p.at();
  for (int i = 0; i < 50; ++i) {
    p.step({0, 0, 0.005});
    swing = std::max(swing, (p.at() - there).norm());
  }
  EXPECT_LT(swing, 2e-5) << "at rest";
  const Vec3 force = p.rod.anchor_load(RodEnd::kStart).force;
  EXPECT_GT(force.z(), 0.05);
  EXPECT_LT((force + p.rod.anchor_load(RodEnd::kFinish).force).norm(), 0.01 * force.norm());
  // The same force alone on the block.
  Pulled alone;
  alone.solid.load(alone.place.node[0], force);
  alone.solid.settle();
  EXPECT_NEAR((p.at() - alone.at()).norm() / (alone.at() - alone.top + Vec3(0, 0, 0.03)).norm(), 0, 0.02);
}

TEST(RodOnSolid, LosesWhatAShakeHasGivenIt) {
  Pulled p;
  for (int i = 0; i < 20; ++i) p.step({0.004 * (i % 2), 0, 0.004 * (i % 3)});
  for (int i = 0; i < 300; ++i) p.step(Vec3::Zero());
  const Vec3 there = p.at();
  double swing = 0;
  for (int i = 0; i < 30; ++i) {
    p.step(Vec3::Zero());
    swing = std::max(swing, (p.at() - there).norm());
  }
  EXPECT_LT(swing, 1e-5);
}

TEST(RodOnSolid, WithItsForceAloneItWouldShakeItselfLoose) {
  Pulled with_stiffness, force_alone;
  for (int i = 0; i < 200; ++i) {
    with_stiffness.step(Vec3(0, 0, 5e-5 * std::min(i, 100)));
    force_alone.step(Vec3(0, 0, 5e-5 * std::min(i, 100)), true);
  }
  EXPECT_TRUE(with_stiffness.rod.anchored(RodEnd::kStart));
  EXPECT_FALSE(force_alone.rod.anchored(RodEnd::kStart)) << "what load_springs() is for";
}

}  // namespace
}  // namespace trocar::rod_on_solid_test
