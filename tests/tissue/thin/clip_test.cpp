// The clip applier's judgement, reason by reason, and what a placed clip does, bears and loses.
#include "tissue/thin/clip_applier.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

#include "tests/tissue/thin/rod_rig.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/thin/rod_grip.h"
#include "tissue/thin/rod_surface.h"

namespace trocar::clip_test {
namespace {

constexpr double kOpen = 0.008;
constexpr double kTipBelow = 0.0045;  // m under the duct's axis: 2.36 mm of flat half width and 2.1 of tip
constexpr double kClosed = 0.001;     // both walls of the duct

class Applied {
 public:
  explicit Applied(const ClipApplierOptions& options = {}) : applier(options) {}
  /// Opens, closes to an opening and opens again. @return the last that was told
  std::optional<ClipOutcome> close(const Pose& X, double to = kClosed, bool forced = false) {
    std::optional<ClipOutcome> told;
    const auto at = [&](double opening) {
      const std::vector<double> arcs = clips.arcs();
      std::vector<ClipSurroundings::Rod> rods{{&rod, arcs}};
      if (second) rods.push_back({&*second});
      if (const auto outcome = applier.step(X, opening, {rods, organ ? &*organ : nullptr}, forced)) {
        EXPECT_FALSE(told) << "told once";
        told = outcome;
        if (outcome->placed) clips.place(rod, lumen, outcome->verdict.arc_m, outcome->verdict.width_share, X);
      }
    };
    at(kOpen);
    for (int i = 0; i <= 20; ++i) at(kOpen + (to - kOpen) * i / 20);
    for (int i = 20; i >= 0; --i) at(kOpen + (to - kOpen) * i / 20);
    return told;
  }
  ClipRefusal refusal(const Pose& X, double to = kClosed) {
    const auto outcome = close(X, to);
    EXPECT_TRUE(outcome);
    if (!outcome) return ClipRefusal::kNone;
    EXPECT_EQ(outcome->placed, outcome->verdict.refusal == ClipRefusal::kNone);
    return outcome->verdict.refusal;
  }

  ElasticRod rod = test::hung_duct();
  std::optional<ElasticRod> second;
  std::optional<TriangleSurface> organ;
  Lumen lumen;
  ClipSet clips;
  ClipApplier applier;
};

Pose over(double arc, double turn = 0) { return test::jaws_from_above({arc, 0, -kTipBelow}, turn); }

TEST(ClipApplier, PlacesAClipThatIsRight) {
  Applied a;
  EXPECT_EQ(a.refusal(over(0.02)), ClipRefusal::kNone);
  ASSERT_EQ(a.clips.arcs().size(), 1u);
  EXPECT_NEAR(a.clips.arcs()[0], 0.02, 1e-6);
  EXPECT_EQ(a.applier.left(), 19);
  const auto segments = a.lumen.segments(a.rod);
  EXPECT_EQ(segments[19].open, 0);
  EXPECT_GE(segments[19].holds_pa, 300 * 133.3);
}

TEST(ClipApplier, RefusesJawsWithNothingBetween) {
  Applied a;
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0.02, -kTipBelow}), 0.0003), ClipRefusal::kNothingBetween);
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, 0.004}), 0.0003), ClipRefusal::kNothingBetween) << "above it";
  EXPECT_EQ(a.applier.left(), 20) << "a refused clip stays in the jaws";
}

TEST(ClipApplier, RefusesADuctThatIsNotWhollyBetween) {
  Applied a;
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, -0.001})), ClipRefusal::kNotWhole) << "tips halfway";
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, -0.0075})), ClipRefusal::kNotWhole) << "in the crotch";
}

TEST(ClipApplier, RefusesTipsThatDoNotShow) {
  Applied a;
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, -0.0030})), ClipRefusal::kTipHidden);
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, -0.0033})), ClipRefusal::kTipHidden);
  EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, -0.0034})), ClipRefusal::kNone);
}

TEST(ClipApplier, RefusesAClipThatLiesAslant) {
  constexpr double kDegree = std::numbers::pi / 180;
  for (const double angle : {-18.0, 18.0}) {
    Applied a;
    EXPECT_EQ(a.refusal(test::jaws_from_above({0.02, 0, -0.0049}, angle * kDegree)), ClipRefusal::kNone) << angle;
  }
  for (const double angle : {-22.0, 22.0, 60.0, 90.0}) {
    Applied a;
    EXPECT_EQ(a.refusal(over(0.02, angle * kDegree)), ClipRefusal::kAngle) << angle;
  }
}

TEST(ClipApplier, RefusesSomethingElseBetween) {
  Applied a;
  a.second = test::hung_duct({.outer_radius_m = 0.0005, .wall_m = 0.0002}, {0, 0.0008, 0.002});
  EXPECT_EQ(a.refusal(over(0.02)), ClipRefusal::kSomethingElse) << "an artery";
  a.second.reset();
  a.organ = TriangleSurface{{{0.01, -0.01, -0.004}, {0.03, -0.01, -0.004}, {0.02, 0.02, -0.004}}, {{0, 1, 2}}};
  EXPECT_EQ(a.refusal(over(0.02)), ClipRefusal::kSomethingElse) << "a large triangle without a corner between";
  a.organ->vertices = {{0.01, 0.0010, -0.02}, {0.03, 0.0010, -0.02}, {0.02, 0.0010, 0.02}};
  EXPECT_EQ(a.refusal(over(0.02)), ClipRefusal::kSomethingElse) << "squeezed out before they are shut";
  a.organ.reset();
  EXPECT_EQ(a.refusal(over(0.02)), ClipRefusal::kNone) << "forgotten once they have opened";
  EXPECT_EQ(a.refusal(over(0.0205)), ClipRefusal::kSomethingElse) << "on a clip";
  EXPECT_EQ(a.refusal(over(0.0230)), ClipRefusal::kNone) << "beside it";
}

TEST(ClipApplier, RefusesJawsThatAreNotShut) {
  Applied a;
  EXPECT_EQ(a.refusal(over(0.02), 0.0025), ClipRefusal::kNotShut);
  EXPECT_EQ(a.clips.arcs().size(), 0u);
  EXPECT_FALSE(a.close(test::jaws_from_above({0.02, 0.02, 0}), 0.0025)) << "closed a little in the air: nothing to say";
}

TEST(ClipApplier, RefusesWhenTheMagazineIsEmpty) {
  Applied a({.magazine = 2});
  EXPECT_EQ(a.refusal(over(0.010)), ClipRefusal::kNone);
  EXPECT_EQ(a.applier.phase(), ClipApplier::Phase::kLoaded);
  EXPECT_EQ(a.refusal(over(0.015)), ClipRefusal::kNone);
  EXPECT_EQ(a.applier.phase(), ClipApplier::Phase::kEmpty);
  EXPECT_EQ(a.refusal(over(0.020)), ClipRefusal::kMagazineEmpty);
  EXPECT_EQ(a.clips.arcs().size(), 2u);
}

TEST(ClipApplier, ForcedItClosesInPartOrOnNothing) {
  Applied a;
  const auto half = a.close(test::jaws_from_above({0.02, 0, 0}), kClosed, true);
  ASSERT_TRUE(half && half->placed);
  EXPECT_EQ(half->verdict.refusal, ClipRefusal::kNotWhole);
  EXPECT_NEAR(half->verdict.width_share, 0.5, 0.01);
  EXPECT_NEAR(a.lumen.segments(a.rod)[19].open, 0.5, 0.01);
  const auto lost = a.close(test::jaws_from_above({0.02, 0.02, 0}), 0.0003, true);
  ASSERT_TRUE(lost);
  EXPECT_TRUE(lost->lost);
  EXPECT_EQ(a.applier.left(), 18);
}

TEST(ClipApplier, EveryReasonHasItsOwnWords) {
  std::vector<std::string_view> said;
  for (int r = 0; r <= static_cast<int>(ClipRefusal::kNotShut); ++r) {
    const std::string_view words = sentence(static_cast<ClipRefusal>(r));
    EXPECT_FALSE(words.empty());
    for (const std::string_view other : said) EXPECT_NE(words, other);
    said.push_back(words);
  }
}

TEST(ClipApplier, JawsThatAreNowhereDoNothing) {
  Applied a;
  Pose nowhere = over(0.02);
  nowhere.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(a.close(nowhere));
}

TEST(ClipSet, AClipRidesWithTheRod) {
  Applied a;
  a.close(over(0.015));
  const Pose before = a.clips.clips()[0].X_TC;
  const Vec3 from_rod = before.p - a.rod.place_at(0.015);
  // Everything moves and turns a quarter about x.
  const Mat3 turn = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix();
  for (int i = 1; i <= 200; ++i) {
    const Mat3 R = Eigen::AngleAxisd(std::numbers::pi / 2 * std::min(i, 100) / 100, Vec3::UnitX()).toRotationMatrix();
    a.rod.anchor(RodEnd::kStart, {.position = {0, 0, 0.003}, .rotation = R});
    a.rod.anchor(RodEnd::kFinish, {.position = {0.04, 0, 0.003}, .rotation = R});
    a.rod.step();
    a.clips.step(a.rod, a.lumen);
  }
  const Pose after = a.clips.clips()[0].X_TC;
  EXPECT_LT((after.R - turn * before.R).norm(), 0.05);
  EXPECT_LT((after.p - (a.rod.place_at(0.015) + turn * from_rod)).norm(), 2e-4);
}

TEST(ClipSet, HoldsBelowItsLimitAndComesOffAbove) {
  for (const double pull : {4.8, 5.2}) {
    Applied a;
    a.close(over(0.02));
    std::size_t off = 0;
    for (int i = 0; i < 50; ++i) {
      a.clips.pull(1, {pull, 0, 0});
      off += a.clips.step(a.rod, a.lumen).size();
    }
    EXPECT_EQ(off, pull > 5 ? 1u : 0u);
    EXPECT_EQ(a.lumen.segments(a.rod)[19].open, pull > 5 ? 1 : 0) << "what came off closes nothing";
    EXPECT_EQ(a.clips.arcs().size(), pull > 5 ? 0u : 1u);
  }
  Applied across;
  across.close(over(0.02));
  for (int i = 0; i < 50; ++i) {
    across.clips.pull(1, {0, 20, 0});
    EXPECT_TRUE(across.clips.step(across.rod, across.lumen).empty()) << "across it does not slip";
  }
}

TEST(ClipSet, BearsLessWithLittleStumpAndInPart) {
  Applied a;
  a.close(over(0.02));
  EXPECT_NEAR(a.clips.bears_n(a.clips.clips()[0], a.rod), 5, 1e-12);
  a.rod.sever(0.0216);
  EXPECT_NEAR(a.clips.bears_n(a.clips.clips()[0], a.rod), 5 * (0.0016 - 0.0006) / 0.002, 1e-3);
  Applied part;
  part.close(test::jaws_from_above({0.02, 0, 0}), kClosed, true);
  EXPECT_NEAR(part.clips.bears_n(part.clips.clips()[0], part.rod), 2.5, 0.05);
}

/// Pulled along the rod by so much more each step, until it comes off. N; more than 10: it did not
double pulled_off_at(Applied& a, double more_n) {
  for (double pull = 0; pull < 10; pull += more_n) {
    a.clips.pull(1, {-pull, 0, 0});
    if (!a.clips.step(a.rod, a.lumen).empty()) return pull;
  }
  return 11;
}

TEST(ClipSet, ComesOffInTheSecondStepOverItsLimitInProportionToStumpAndPart) {
  constexpr double kMore = 0.02;  // N a step
  Applied whole, stump, part, both;
  for (Applied* a : {&whole, &stump}) a->close(over(0.02));
  for (Applied* a : {&part, &both}) a->close(test::jaws_from_above({0.02, 0, 0}), kClosed, true);
  for (Applied* a : {&stump, &both}) a->rod.sever(0.0216);
  for (const auto& [a, limit] :
       {std::pair(&whole, 5.0), std::pair(&stump, 2.5), std::pair(&part, 2.5), std::pair(&both, 1.25)}) {
    const double bears = a->clips.bears_n(a->clips.clips()[0], a->rod);
    EXPECT_NEAR(bears, limit, 0.02 * limit);
    const double at = pulled_off_at(*a, kMore);
    EXPECT_GT(at, bears);
    EXPECT_LT(at, bears + 3 * kMore);
  }
  Applied jerked;
  jerked.close(over(0.02));
  jerked.clips.pull(1, {50, 0, 0});
  EXPECT_TRUE(jerked.clips.step(jerked.rod, jerked.lumen).empty()) << "one step is a blow and no pull";
  EXPECT_TRUE(jerked.clips.step(jerked.rod, jerked.lumen).empty());
}

TEST(ClipSet, WhatTouchesTheRodPullsOnlyOnTheClipThatItTouches) {
  for (const double aside : {0.0, 0.0005, 0.0007, 0.002}) {
    Applied a;
    a.close(over(0.015));
    a.close(over(0.02));
    std::size_t off = 0;
    for (int i = 0; i < 5; ++i) {
      const std::array<RodSpring, 2> springs{{{a.clips.clips()[1].arc_m + aside, Vec3::UnitX(), 100, 0.06, false, 6},
                                              {0.03, Vec3::UnitX(), 1, 0, false, 9}}};
      a.clips.pull_touched(springs);
      for (const std::int32_t number : a.clips.step(a.rod, a.lumen)) off += static_cast<std::size_t>(number);
    }
    EXPECT_EQ(off, aside < 0.0006 ? 2u : 0u) << aside;
  }
}

/// A grasper that closes on a place of a duct with a clip at another, and draws at it towards its free end.
struct Drawn {
  double most_n = 0;    ///< that the jaws pulled with while the clip was on
  double before_n = 0;  ///< in the step in which it came off
  bool held = false;    ///< the clip
  double block_m = 0;   ///< between the pads, closed
  std::size_t off = 0;  ///< clips
  double open = 0;      ///< of the lumen at the clip, jaws away
};

Drawn draw(double jaws_arc, double clip_arc, const RodGripOptions& options, double open_m = kOpen) {
  Drawn out;
  Applied a;
  a.rod = test::hung_duct({.avulsion_n = 1e6});
  a.close(over(clip_arc));
  a.rod.let_go(RodEnd::kFinish);
  for (int i = 0; i < 100; ++i) a.rod.step();
  const double from_x = a.rod.place_at(jaws_arc).x();
  RodGrip grip(options);
  const auto step = [&](double x, double opening) {
    const std::vector<double> arcs = a.clips.arcs();
    std::vector<RodSpring> springs;
    const Pose X = test::jaws_from_above({x, 0, -0.01});
    a.lumen.begin();
    grip.reach(X, opening, a.rod, springs, arcs);
    grip.press(a.lumen);
    a.rod.step(springs);
    grip.feel(X, springs, a.rod);
    a.clips.pull_held(grip.clips(), -grip.pull_T());
    out.held = out.held || (!grip.clips().empty() && grip.state() != GripState::kAround);
    const double pull = grip.pull_T().norm();
    const std::size_t off = a.clips.step(a.rod, a.lumen).size();
    if (off > 0) out.before_n = pull, grip.let_go();
    if (off == 0 && out.off == 0) out.most_n = std::max(out.most_n, pull);
    out.off += off;
  };
  for (double opening = open_m; opening > 1e-9; opening -= 4e-4) step(from_x, opening);
  out.block_m = grip.block().thickness_m;
  for (int i = 0; i < 400 && out.off == 0; ++i) step(from_x + 1e-4 * i, 0);
  for (int i = 0; i < 5; ++i) step(1, kOpen);
  out.open = a.lumen.segments(a.rod)[a.rod.segment_at(clip_arc)].open;
  return out;
}

TEST(ClipSet, JawsThatCloseOnAClipHoldItAndDrawItOffAtItsLimit) {
  const Drawn drawn = draw(0.02, 0.02, {.clip_legs_m = 0.0016});
  EXPECT_TRUE(drawn.held);
  EXPECT_NEAR(drawn.block_m, 0.0026, 1e-12) << "two walls and two legs";
  EXPECT_EQ(drawn.off, 1u);
  EXPECT_GT(drawn.before_n, 5);
  EXPECT_LT(drawn.before_n, 5.3) << "0.06 N more each step at most, in the second step over it";
  EXPECT_EQ(drawn.open, 1);
}

TEST(ClipSet, JawsBesideAClipOrClosedBeforeTheyReachItDoNotDrawItOff) {
  const Drawn beside = draw(0.02, 0.010, {.friction = 10, .clip_legs_m = 0.0016});
  EXPECT_FALSE(beside.held);
  EXPECT_GT(beside.most_n, 5.5);
  EXPECT_EQ(beside.off, 0u);
  EXPECT_EQ(beside.open, 0);
  const Drawn late = draw(0.02, 0.02, {.friction = 10, .clip_legs_m = 0.0016}, 0.0022);
  EXPECT_FALSE(late.held) << "a clip does not get in between pads that are nearly shut";
  EXPECT_EQ(late.off, 0u);
}

TEST(ClipSet, ClipsStayOnBothSidesOfACut) {
  Applied a;
  for (const double arc : {0.012, 0.016, 0.024}) EXPECT_EQ(a.refusal(over(arc)), ClipRefusal::kNone);
  a.rod.sever(0.020);
  for (int i = 0; i < 200; ++i) {
    a.rod.step();
    a.clips.step(a.rod, a.lumen);
  }
  const std::vector<double> arcs = a.clips.arcs();
  ASSERT_EQ(arcs.size(), 3u);
  EXPECT_NEAR(arcs[1] - arcs[0], 0.004, 1e-6);
  EXPECT_LT(a.clips.clips()[1].X_TC.p.x(), 0.016 - 1e-4) << "drawn back with its stump";
  EXPECT_GT(a.clips.clips()[2].X_TC.p.x(), 0.024 + 1e-4);
  // From each open end inwards: closed before the anchor.
  const auto segments = a.lumen.segments(a.rod);
  for (const LumenEnd& end : a.lumen.ends(a.rod)) {
    if (!end.outside) continue;
    const RodPart& part = a.rod.parts()[end.part];
    bool closed = false;
    for (std::size_t i = part.first; i < part.last; ++i) closed = closed || segments[i].open == 0;
    EXPECT_TRUE(closed);
  }
}

TEST(ClipModel, IsAClosedSolidOfItsMeasures) {
  const ClipOptions options;
  for (const double gap : {0.001, 0.006}) {
    const TriangleSurface model = clip_model(options, gap, 0.001);
    const SurfaceTopology facts = analyse_topology(model);
    EXPECT_TRUE(facts.closed() && facts.manifold());
    EXPECT_EQ(facts.genus, 0);
    EXPECT_GT(model.volume_m3(), 0);
    EXPECT_NEAR(model.bounds().sizes().z(), options.length_m, 1e-12);
    EXPECT_NEAR(model.bounds().sizes().y(), gap + 2 * options.leg_m, 1e-12);
  }
  const double legs = 2 * options.leg_m * options.length_m + options.leg_m * 0.001;
  EXPECT_NEAR(clip_model(options, 0.001, 0.001).volume_m3(), legs * options.width_m, 1e-13);
}

}  // namespace
}  // namespace trocar::clip_test
