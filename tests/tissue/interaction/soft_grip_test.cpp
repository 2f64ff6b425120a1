// Jaws on tissue that gives way: what they take, hold, let slip and leave behind.
#include "tissue/interaction/soft_grip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/tissue/solid/soft_organ_rig.h"

namespace trocar::soft_grip_test {
namespace {

constexpr double kTop = 0.035;  // m, of the organ
constexpr double kOpen = 0.014;

class Grasped {
 public:
  explicit Grasped(const SoftGripOptions& options = {}) : grip(options) {}

  void step(const Vec3& tip, double opening_m) {
    const Pose X = test::from_above(tip);
    std::vector<SoftSpring> springs;
    grip.reach(X, opening_m, organ, springs);
    organ.step({}, &X.p, springs);
    grip.feel(X, springs, organ);
  }
  /// Jaws down on the top, then closed until they squeeze with this force.
  void take(double squeeze_n) {
    for (int i = 0; i < 10; ++i) step({0, 0, kTop - 0.006}, kOpen);
    closed = grip.block().thickness_m - squeeze_n / grip.block().stiffness_n_per_m;
    for (int i = 0; i <= 20; ++i) step({0, 0, kTop - 0.006}, kOpen + (closed - kOpen) * i / 20);
  }
  double furthest_from_rest() const {
    double most = 0;
    for (std::size_t v = 0; v < rest->vertices.size(); ++v)
      most = std::max(most, (organ.surface()->vertices[v] - rest->vertices[v]).norm());
    return most;
  }

  SurfacePtr rest = test::ellipsoid({0.06, 0.05, kTop}, 48);
  SoftOrgan organ{build_lattice({rest->vertices, rest->triangles}, {.cell_m = 0.01}).lattice, rest, TissueSolid{}, {}};
  SoftGrip grip;
  double closed = 0;
};

TEST(SoftGrip, NothingIsTakenBesideTheOrganOrByClosedJaws) {
  Grasped g;
  for (int i = 0; i < 10; ++i) g.step({0, 0, kTop + 0.03}, kOpen * (10 - i) / 10);
  EXPECT_EQ(g.grip.state(), GripState::kEmpty);
  for (int i = 0; i < 10; ++i) g.step({0, 0, kTop - 0.003}, 0.0);
  EXPECT_EQ(g.grip.state(), GripState::kEmpty) << "closed before they reached it";
  EXPECT_EQ(g.grip.hold().stiffness_n_per_m, 0);
}

TEST(SoftGrip, TheFingersFeelTheFoldBeforeItIsHeld) {
  Grasped g;
  for (int i = 0; i < 5; ++i) g.step({0, 0, kTop - 0.006}, kOpen);
  EXPECT_EQ(g.grip.state(), GripState::kAround);
  EXPECT_GT(g.grip.block().stiffness_n_per_m, 0);
  EXPECT_EQ(g.grip.squeeze_n(), 0) << "opened wider than the fold is thick";
  g.take(0.5);
  EXPECT_EQ(g.grip.state(), GripState::kHolding);
  EXPECT_NEAR(g.grip.squeeze_n(), 0.5, 1e-9);
}

TEST(SoftGrip, PullsAsTheTissueDoesAndTheLoopsSpringHasThatForce) {
  Grasped g;
  g.take(1.5);
  for (int i = 0; i < 100; ++i) g.step({0, 0, kTop - 0.006 + 6e-5 * i}, g.closed);
  for (int i = 0; i < 100; ++i) g.step({0, 0, kTop}, g.closed);
  ASSERT_EQ(g.grip.state(), GripState::kHolding);
  EXPECT_LT(g.grip.pull_T().z(), -0.1) << "lifted tissue pulls down";
  const GripHold hold = g.grip.hold();
  const Vec3 felt = hold.stiffness_n_per_m * (hold.anchor_T - test::from_above({0, 0, kTop}) * hold.point_I);
  EXPECT_LT((felt - g.grip.pull_T()).norm(), 1e-9);

  EXPECT_LT(hold.stiffness_n_per_m, SoftOrganOptions{}.most_stiffness_n_per_m + 1e-9);
}

TEST(SoftGrip, SlipsAtTheConeAndIsLostOffThePads) {
  for (const double squeeze : {0.4, 0.8}) {
    Grasped g;
    g.take(squeeze);
    const double limit = 2 * SoftGripOptions{}.friction * squeeze;
    double most = 0;
    bool slipped = false;
    for (int i = 0; i < 400 && g.grip.state() != GripState::kEmpty; ++i) {
      g.step({0, 0, kTop - 0.006 + 2e-4 * i}, g.closed);
      most = std::max(most, g.grip.pull_T().norm());
      slipped = slipped || g.grip.state() == GripState::kSlipping;
    }
    EXPECT_TRUE(slipped);
    EXPECT_EQ(g.grip.state(), GripState::kEmpty) << "pulled 80 mm up";
    EXPECT_NEAR(most, limit, 0.05 * limit) << squeeze << " N";
  }
}

TEST(SoftGrip, NothingIsLeftBehind) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> aside(-0.02, 0.02), up(-0.008, 0.02), gap(0, kOpen);
  Grasped g;
  for (int i = 0; i < 400; ++i) g.step({aside(random), aside(random), kTop + up(random)}, gap(random));
  g.grip.let_go();
  for (int i = 0; i < 500; ++i) g.organ.step({}, nullptr);
  EXPECT_LT(g.furthest_from_rest(), 1e-4);
  EXPECT_EQ(g.grip.hold().stiffness_n_per_m, 0);
  EXPECT_EQ(g.grip.block().stiffness_n_per_m, 0);
}

TEST(SoftGrip, TissueInTheJawsIsNoContactAndComesBack) {
  Grasped g;
  PatchExtraction extraction(*g.rest);
  const auto count = [&](const Vec3& tip) {
    const auto patch = std::make_unique<ContactPatch>();
    extraction.extract(test::from_above(tip), ToolShape{}, *patch);
    return std::count_if(patch->triangle.begin(), patch->triangle.begin() + patch->count,
                         [&](const PatchTriangle& triangle) { return g.grip.felt(triangle.id); });
  };
  const auto before = count({0, 0, kTop});
  g.take(1.0);
  EXPECT_LT(count({0, 0, kTop}), before);
  for (int i = 0; i < 20; ++i) g.step({0, 0, kTop - 0.006}, kOpen);
  for (int i = 0; i < 50; ++i) g.step({0, 0, kTop - 0.006 + 1e-3 * i}, kOpen);
  EXPECT_EQ(count({0, 0, kTop}), before);
}

}  // namespace
}  // namespace trocar::soft_grip_test
