// Jaws on a duct: what they take, hold, let slip and leave behind; and everything at once at random.
#include "tissue/thin/rod_grip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/tissue/thin/rod_rig.h"
#include "tissue/thin/clip_applier.h"
#include "tissue/thin/rod_scissors.h"
#include "tissue/thin/rod_surface.h"

namespace trocar::rod_grip_test {
namespace {

constexpr double kOpen = 0.008;

class Held {
 public:
  explicit Held(const RodOptions& options = {.avulsion_n = 1e6}) : rod(test::hung_duct(options)) {}
  void step(const Pose& X, double opening_m) {
    std::vector<RodSpring> springs;
    lumen.begin();
    grip.reach(X, opening_m, rod, springs);
    grip.press(lumen);
    rod.step(springs);
    grip.feel(X, springs, rod);
  }
  void step(const Vec3& at, double opening_m) { step(test::jaws_from_above(at + Vec3(0, 0, -0.01)), opening_m); }
  /// Jaws over the middle, then closed until they squeeze by this much, N.
  void take(double squeeze_n) {
    step({0.02, 0, 0}, kOpen);
    double low = 0, high = kOpen;
    for (int i = 0; i < 60; ++i) {
      const double opening = (low + high) / 2;
      Held trial = *this;
      trial.step({0.02, 0, 0}, opening);
      (trial.grip.squeeze_n() > squeeze_n ? low : high) = opening;
    }
    closed = (low + high) / 2;
    step({0.02, 0, 0}, closed);
  }

  ElasticRod rod;
  Lumen lumen;
  RodGrip grip;
  double closed = 0;
};

TEST(RodGrip, TakesNothingBesideIt) {
  Held h;
  for (int i = 0; i <= 10; ++i) h.step({0.02, 0.02, 0}, kOpen * (10 - i) / 10);
  EXPECT_EQ(h.grip.state(), GripState::kEmpty);
  EXPECT_EQ(h.grip.hold().stiffness_n_per_m, 0);
  for (int i = 0; i < 5; ++i) h.step({0.02, 0, 0}, 0.0002);
  EXPECT_EQ(h.grip.state(), GripState::kEmpty) << "closed before they reached it";
}

TEST(RodGrip, SqueezesTheRingFirstThenTheWalls) {
  Held h;
  h.step({0.02, 0, 0}, kOpen);
  EXPECT_EQ(h.grip.state(), GripState::kAround);
  EXPECT_EQ(h.grip.squeeze_n(), 0);
  double before = 0;
  for (double opening = 0.003; opening > 0.0005; opening -= 5e-5) {
    h.step({0.02, 0, 0}, opening);
    EXPECT_GE(h.grip.squeeze_n(), before) << opening;
    EXPECT_LT(h.grip.squeeze_n() - before, 0.12) << "without a jump where the walls meet";
    EXPECT_NEAR(h.grip.squeeze_n(), h.grip.block().stiffness_n_per_m * (h.grip.block().thickness_m - opening), 1e-9);
    before = h.grip.squeeze_n();
  }
  EXPECT_GT(before, 0.5);
}

TEST(RodGrip, ClosesTheLumenWhileItSqueezes) {
  Held h;
  h.take(0.5);
  EXPECT_EQ(h.lumen.segments(h.rod)[20].open, 0);
  EXPECT_EQ(h.lumen.segments(h.rod)[20].state, LumenState::kPressed);
  EXPECT_EQ(h.lumen.segments(h.rod)[5].open, 1);
  for (int i = 0; i < 3; ++i) h.step({0.02, 0, 0}, kOpen);
  EXPECT_EQ(h.lumen.segments(h.rod)[20].open, 1);
}

TEST(RodGrip, HoldsAtUpToFourPlacesAndPullsAsTheRodDoes) {
  Held h;
  h.take(1);
  EXPECT_EQ(h.grip.state(), GripState::kHolding);
  EXPECT_LE(h.grip.arcs().size(), 4u);
  EXPECT_GE(h.grip.arcs().size(), 2u);
  for (int i = 0; i < 100; ++i) h.step({0.02, 0, 5e-5 * i}, h.closed);
  for (int i = 0; i < 200; ++i) h.step({0.02, 0, 0.005}, h.closed);
  EXPECT_EQ(h.grip.state(), GripState::kHolding);
  const Vec3 on_anchors = h.rod.anchor_load(RodEnd::kStart).force + h.rod.anchor_load(RodEnd::kFinish).force;
  EXPECT_LT((h.grip.pull_T() + on_anchors).norm(), 0.01 * h.grip.pull_T().norm()) << "actio = reactio";
  EXPECT_LT(h.grip.pull_T().z(), -0.05);
  const GripHold hold = h.grip.hold();
  const Pose X = test::jaws_from_above({0.02, 0, 0.005 - 0.01});
  const Vec3 rendered = hold.stiffness_n_per_m * (hold.anchor_T - X * hold.point_I);
  EXPECT_LT((rendered - h.grip.pull_T()).norm(), 1e-6) << "the loop's spring has the solved force";
  EXPECT_LE(hold.stiffness_n_per_m, 600);
}

TEST(RodGrip, SlipsAtTwoMuN) {
  Held h;
  h.take(0.3);
  int slipping = 0;
  double slipped = 0;
  for (int i = 0; i < 300 && h.grip.state() != GripState::kEmpty; ++i) {
    h.step({0.02, 0, 1e-4 * i}, h.closed);
    const double over = h.grip.pull_T().norm() / (2 * 0.6 * h.grip.squeeze_n());
    if (h.grip.state() == GripState::kHolding) {
      EXPECT_LE(over, 1);
    }
    if (h.grip.state() != GripState::kSlipping) continue;
    ++slipping;
    slipped = h.grip.slipped_m();
    EXPECT_NEAR(over, 1, 0.05);
  }
  EXPECT_GT(slipping, 10);
  EXPECT_GT(slipped, 0.001);
}

TEST(RodGrip, AThreadRunsThroughTheJawsWithItsFriction) {
  RodOptions thread;
  thread.outer_radius_m = thread.wall_m = 0.0003;
  thread.young_pa = 2e7;
  thread.stiffening = thread.pre_strain = 0;
  thread.avulsion_n = 1e6;
  Held h(thread);
  h.rod.let_go(RodEnd::kFinish);
  h.take(0.2);
  ASSERT_EQ(h.grip.state(), GripState::kHolding);
  double arc = 0.02;
  for (int i = 0; i < 100; ++i) {
    h.step({0.02 + 1e-4 * i, 0, 0}, h.closed);
    ASSERT_FALSE(h.grip.arcs().empty()) << i;
    arc = h.grip.arcs()[0];
  }
  EXPECT_GT(arc, 0.024) << "pulled towards the free end, it holds another piece";
  EXPECT_NEAR(h.grip.pull_T().norm() / (2 * 0.6 * h.grip.squeeze_n()), 1, 0.05);
}

TEST(RodGrip, LeavesNothingBehind) {
  Held h;
  h.take(1);
  for (int i = 0; i < 50; ++i) h.step({0.02, 0, 1e-4 * i}, h.closed);
  for (int i = 0; i < 300; ++i) h.step({0.02, 0, 0.05}, kOpen);
  EXPECT_EQ(h.grip.state(), GripState::kEmpty);
  for (const RodNode& node : h.rod.nodes()) EXPECT_LT((node.position - node.drawn).norm(), 1e-4);
}

/// Jaws, clips, blades, cuts and heat at random. @return a number of what became of it
double anything(unsigned seed, int steps) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  RodGrip grip({.clip_legs_m = 0.0016});
  ClipSet clips;
  ClipApplier applier;
  RodScissors scissors;
  RodSurface tube(rod, 10);
  Pose X = test::jaws_from_above({0.02, 0, -0.005});
  double opening = kOpen;
  int tool = 0;
  for (int i = 0; i < steps; ++i) {
    if (i % 50 == 0) {
      tool = static_cast<int>(1.5 * (any(random) + 1));
      X = test::jaws_from_above({0.02 * (1 + any(random)), 0.002 * any(random), -0.006 + 0.005 * any(random)},
                                0.3 * any(random));
    }
    if (i % 97 == 0) X.p = Vec3(any(random), any(random), any(random));
    X.p += 3e-4 * Vec3(any(random), any(random), any(random));
    opening = std::max(0.0, kOpen * std::sin(0.13 * i));
    const std::vector<double> arcs = clips.arcs();
    const std::array<ClipSurroundings::Rod, 1> near{{{&rod, arcs}}};
    std::vector<RodSpring> springs;
    lumen.begin();
    if (tool == 0)
      grip.reach(X, opening, rod, springs, arcs);
    else
      grip.let_go();
    if (tool == 1)
      if (const auto outcome = applier.step(X, opening, {near}, i % 2 == 0); outcome && outcome->placed)
        clips.place(rod, lumen, outcome->verdict.arc_m, outcome->verdict.width_share, X);
    if (tool == 2)
      for (const RodCut& cut : scissors.step(X, opening, near)) {
        if (cut.share == 1)
          rod.sever(cut.arc_m);
        else
          lumen.nick(cut.arc_m, cut.share);
      }
    grip.press(lumen);
    rod.step(springs);
    grip.feel(X, springs, rod);
    clips.pull_held(grip.clips(), -grip.pull_T());
    clips.pull_touched(springs);
    if (!clips.clips().empty()) clips.pull(1, 6 * Vec3(any(random), any(random), any(random)));
    clips.step(rod, lumen);
    if (i % 10 == 0) tube.follow(rod, &lumen);
  }
  tube.follow(rod, &lumen);
  double sum = 0;
  for (const Vec3& vertex : tube.surface()->vertices) {
    EXPECT_TRUE(vertex.allFinite());
    EXPECT_LT(vertex.norm(), 50);
    sum += vertex.sum();
  }
  for (const LumenSegment& segment : lumen.segments(rod)) EXPECT_TRUE(segment.open >= 0 && segment.open <= 1);
  for (const Clip& clip : clips.clips()) EXPECT_TRUE(clip.X_TC.p.allFinite() && clip.X_TC.R.allFinite());
  return sum + static_cast<double>(rod.parts().size()) + 10 * static_cast<double>(clips.clips().size());
}

TEST(RodGrip, EverythingAtRandomStaysFiniteAndIsTheSameTwice) {
  for (unsigned seed = 0; seed < 5; ++seed) anything(seed, 1000);
  EXPECT_EQ(anything(3, 400), anything(3, 400));
}

}  // namespace
}  // namespace trocar::rod_grip_test
