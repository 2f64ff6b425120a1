// A curved needle in soft tissue: what opens the surface, what it costs to go on, what holds, and that nothing stays.
#include "tissue/interaction/suture_needle.h"

#include <gtest/gtest.h>

#include <cstring>
#include <ctime>
#include <random>

#include "tests/tissue/interaction/needle_rig.h"

namespace trocar::suture_needle_test {
namespace {

using Kind = NeedleEvent::Kind;

constexpr double kEnters = 0.25, kIn = 1.8, kOut = 3.0;  // rad: above the surface; in it; about to come out

const NeedleEvent* told(const SutureNeedle& needle, Kind kind) {
  for (const NeedleEvent& event : needle.events())
    if (event.kind == kind) return &event;
  return nullptr;
}

/// Turned on from one angle to another. @return force of every step
std::vector<double> turn(test::NeedleRig& rig, double from, double to, double per_step = 0.005) {
  std::vector<double> force;
  const int steps = int(std::ceil(std::abs(to - from) / per_step));
  for (int i = 1; i <= steps; ++i) {
    rig.drive(from + (to - from) * i / steps);
    force.push_back(rig.needle.tissue_n());
  }
  return force;
}

/// Along the needle, on what is inside it.
double along(const test::NeedleRig& rig) {
  // About the middle of the circle only what acts along the arc turns the needle.
  const Vec3 about = rig.needle.X_TN() * rig.needle.shape().place(rig.needle.held_arc_m());
  const Wrench load = rig.needle.load_T();
  const Vec3 moment = load.moment + (about - rig.needle.X_TN().p).cross(load.force);
  return -moment.dot(rig.needle.X_TN().R.col(2)) / rig.needle.shape().radius_m();
}

TEST(SutureNeedle, TheShapeIsAnArc) {
  const NeedleShape half, three_eighths{.circle = 0.375};
  EXPECT_NEAR((half.place(0) - half.place(half.length_m)).norm(), 2 * half.radius_m(), 1e-12);
  EXPECT_NEAR(three_eighths.radius_m(), 0.026 / (2 * std::numbers::pi * 0.375), 1e-12);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> arc(-0.005, 0.031), off(-0.003, 0.003);
  for (int i = 0; i < 1000; ++i) {
    const double at = arc(random), outward = off(random), across = off(random);
    const Vec3 place = half.place(at) + outward * half.place(at).normalized() + across * Vec3::UnitZ();
    const BesideNeedle beside = beside_needle(half, place);
    EXPECT_NEAR(beside.arc_m, at, 1e-12);
    EXPECT_NEAR(beside.outward_m, outward, 1e-12);
    EXPECT_NEAR(beside.across_m, across, 1e-12);
    EXPECT_NEAR(half.tangent(at).dot(half.place(at)), 0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(half.radius_at(half.length_m), half.tip_radius_m);
  EXPECT_DOUBLE_EQ(half.radius_at(0), half.wire_radius_m);
}

TEST(SutureNeedle, OpensTheSurfaceAtItsForceAndThenGoesOnWithLess) {
  test::NeedleRig rig;
  const double law = puncture_force(rig.organ.material(), rig.needle.shape(), {});
  EXPECT_NEAR(law, 1.5 * 164 * 0.0006, 1e-12);
  double before = 0, opened = 0, angle = kEnters;
  for (; opened == 0 && angle < 1.5; angle += 0.002) {
    rig.drive(angle);
    if (const NeedleEvent* event = told(rig.needle, Kind::kPuncture))
      opened = event->force_n;
    else
      before = rig.needle.touch_n();
  }
  EXPECT_NEAR(opened, law, 0.05 * law);
  EXPECT_LE(before, law);
  ASSERT_EQ(rig.needle.paths().size(), 1U);
  for (int i = 0; i < 10; ++i) rig.drive(angle);
  EXPECT_LT(rig.needle.tissue_n(), 0.6 * law) << "it falls once the surface is open";
  turn(rig, angle, 1.2);
  EXPECT_NEAR(rig.needle.paths()[0].end_force_n(), 164 * 0.0006, 0.05 * 164 * 0.0006) << "J times the wire's width";
}

TEST(SutureNeedle, LaidFlatItPressesAndOpensNothing) {
  // The point lies along the surface: more than 4 mm2 of it press.
  test::NeedleRig rig;
  const double flat = std::numbers::pi / 2 - 0.05;
  for (int i = 0; i < 200; ++i) rig.drive(flat, {0, 0, 0.01 - 1e-4 * i});
  EXPECT_TRUE(rig.needle.paths().empty());
}

TEST(SutureNeedle, ComesOutWithASecondPuncture) {
  test::NeedleRig rig;
  constexpr double kBefore = kOut - 0.3;
  turn(rig, 0, kBefore);
  EXPECT_FALSE(rig.needle.paths()[0].through());
  double out = 0;
  for (int i = 0; out == 0 && i < 400; ++i) {
    rig.drive(kBefore + 0.002 * i);
    if (const NeedleEvent* event = told(rig.needle, Kind::kExit)) out = event->force_n;
  }
  const double law = puncture_force(rig.organ.material(), rig.needle.shape(), {});
  EXPECT_NEAR(out, law, 0.05 * law);
  ASSERT_EQ(rig.needle.paths().size(), 1U);
  EXPECT_TRUE(rig.needle.paths()[0].through());
  const Vec3 entry = rig.needle.paths()[0].entry_rest_T(), exit = rig.needle.paths()[0].end_rest_T();
  EXPECT_NEAR(exit.x(), -entry.x(), 0.002) << "as far on the other side of the circle's middle";
  SurfaceWalk walk(*rig.rest);
  std::int32_t vertex = -1;
  EXPECT_LT(std::abs(walk.foot(rig.rest->vertices, exit, vertex).height_m), 1e-6) << "on the surface";
}

TEST(SutureNeedle, HeldStillItsPlacesLieOnItsAxis) {
  test::NeedleRig rig;
  turn(rig, 0, kIn);
  for (int i = 0; i < 100; ++i) rig.drive(kIn);
  ASSERT_EQ(rig.needle.paths().size(), 1U);
  EXPECT_GT(rig.needle.paths()[0].inside_m(), 0.008);
  EXPECT_LT(rig.needle.paths()[0].furthest_m(rig.organ, rig.needle.shape(), rig.needle.X_TN()), 3e-4);
}

TEST(SutureNeedle, ForceAlongItGrowsWithDepthAndWithFriction) {
  // Beyond what the point cuts with: friction by the metre, times what is inside.
  for (const double friction : {0.0, 10.0, 20.0}) {
    test::NeedleRig rig({}, {.friction_n_per_m = friction});
    turn(rig, 0, 1.0);
    const double from = rig.needle.paths()[0].inside_m(), force = along(rig);
    turn(rig, 1.0, 2.4);
    const double more = rig.needle.paths()[0].inside_m() - from;
    EXPECT_GT(more, 0.01);
    EXPECT_NEAR(along(rig) - force, friction * more, 0.1 * friction * more + 0.004) << friction << " N/m";
  }
}

TEST(SutureNeedle, FrictionSticksBelowItsLimitAndKeepsItBeyond) {
  NeedleTissueOptions options{.friction_n_per_m = 20};
  test::NeedleRig rig({}, options);
  turn(rig, 0, kIn);
  const double before = along(rig);
  turn(rig, kIn, kIn - 0.03, 0.0005);
  const double limit = 20 * rig.needle.paths()[0].inside_m();
  EXPECT_LT(along(rig), before);
  EXPECT_GT(along(rig), -limit) << "a quarter of a millimetre back: the tissue comes along";
  double most = 0;
  for (int i = 0; i < 200; ++i) {
    rig.drive(kIn - 0.03 - 0.002 * i);
    if (!rig.needle.paths().empty()) most = std::max(most, -along(rig));
  }
  EXPECT_NEAR(most, limit, 0.1 * limit) << "drawn back";
}

TEST(SutureNeedle, FrictionDoesNotGrowWithSpeed) {
  std::vector<double> force;
  for (const double per_step : {0.002, 0.02}) {  // 1.7 and 17 mm/s
    test::NeedleRig rig;
    turn(rig, 0, kIn, per_step);
    force.push_back(along(rig));
  }
  EXPECT_NEAR(force[1], force[0], 0.1 * force[0]);
}

TEST(SutureNeedle, DrawnBackNothingIsLeft) {
  test::NeedleRig rig;
  turn(rig, 0, kIn);
  EXPECT_GT(rig.furthest_from_rest(), 1e-4);
  turn(rig, kIn, 0);
  EXPECT_TRUE(rig.needle.paths().empty());
  for (int i = 0; i < 600; ++i) rig.drive(0);
  EXPECT_LT(rig.furthest_from_rest(), 1e-4);
  EXPECT_EQ(rig.needle.tissue_n(), 0);
  EXPECT_EQ(rig.needle.hold().stiffness_n_per_m, 0);
}

TEST(SutureNeedle, LetGoItStaysWhereItIsAndCanBeTakenAgain) {
  test::NeedleRig rig;
  turn(rig, 0, 3.3);
  ASSERT_TRUE(rig.needle.paths()[0].through());
  rig.step(DriverJaws{rig.jaws_at(3.3), 0.004});
  EXPECT_FALSE(rig.needle.held());
  for (int i = 0; i < 300; ++i) rig.step({});
  const Vec3 there = rig.needle.tip_T();
  for (int i = 0; i < 100; ++i) rig.step({});
  EXPECT_LT((rig.needle.tip_T() - there).norm(), 5e-5) << "at rest";
  ASSERT_EQ(rig.needle.paths().size(), 1U);
  EXPECT_GT(rig.needle.paths()[0].inside_m(), 0.012);
  // From above on the point that stands out, drawn on along the arc.
  const Pose jaws = test::jaws_from_above(rig.needle.tip_T() - Vec3(0, 0, 0.002));
  for (int i = 0; i <= 10; ++i) rig.step(DriverJaws{jaws, 0.004 * (10 - i) / 10});
  ASSERT_TRUE(rig.needle.held());
  const Pose X_IN = jaws.inverse() * rig.needle.X_TN();
  const Vec3 middle = rig.needle.X_TN().p, axis = rig.needle.X_TN().R.col(2);
  bool out = false;
  for (int i = 0; i <= 700 && !out; ++i) {
    const Mat3 by = Eigen::AngleAxisd(0.005 * i, axis).toRotationMatrix();
    const Pose X_TN{by * (jaws * X_IN).R, middle};
    rig.step(DriverJaws{X_TN * X_IN.inverse(), 0});
    out = told(rig.needle, Kind::kThrough) != nullptr;
  }
  EXPECT_TRUE(out);
  EXPECT_TRUE(rig.needle.paths().empty());
}

TEST(SutureNeedle, ClosingPadsKeepWhatLiesAtTheirEdge) {
  test::NeedleRig rig;
  rig.step(std::nullopt);
  rig.needle.place(rig.turned(0));
  rig.needle.stand();
  Pose jaws = rig.jaws_at(0);
  jaws.p += (rig.needle.shape().wire_radius_m + 0.001) * jaws.R.col(1);
  for (int i = 0; i <= 21; ++i) rig.step(DriverJaws{jaws, 0.0002 * (20 - i)});
  EXPECT_TRUE(rig.needle.held()) << "they press beyond the wire's width";
}

TEST(SutureNeedle, PulledAcrossItTearsOut) {
  test::NeedleRig rig;
  turn(rig, 0, kIn);
  double force = 0;
  for (int i = 0; i < 400 && force == 0; ++i) {
    rig.drive(kIn, {0, 0, 1e-4 * i});
    if (const NeedleEvent* event = told(rig.needle, Kind::kTorn)) force = event->force_n;
  }
  EXPECT_GT(force, 300 * 0.008) << "300 N/m over more than 8 mm of tissue";
  EXPECT_LT(force, 4.62 * 1.1);
  EXPECT_TRUE(rig.needle.paths().empty());
}

TEST(SutureNeedle, TheHandFeelsWhatTissueDoes) {
  test::NeedleRig rig;
  turn(rig, 0, kIn);
  const GripHold hold = rig.needle.hold();
  const Vec3 felt = hold.stiffness_n_per_m * (hold.anchor_T - rig.jaws_at(kIn) * hold.point_I);
  EXPECT_GT(felt.norm(), 0.05);
  EXPECT_LT((felt - rig.needle.load_T().force).norm(), 1e-9);
  EXPECT_LE(hold.stiffness_n_per_m, SoftOrganOptions{}.most_stiffness_n_per_m + 1e-9);
}

TEST(SutureNeedle, GivesNoWorkOverAClosedCycle) {
  test::NeedleRig rig;
  turn(rig, 0, 1.2);
  double work = 0;
  Pose before = rig.needle.X_TN();
  for (int cycle = 0; cycle < 3; ++cycle) {
    double of_cycle = 0;
    for (int i = 0; i < 240; ++i) {
      const double angle = 1.2 + 0.6 * std::sin(2 * std::numbers::pi * (i + 1) / 240);
      const Vec3 aside = 0.001 * Vec3(0, std::sin(2 * std::numbers::pi * (i + 1) / 240), 0);
      rig.drive(angle, aside);
      const Vec3 about = rig.needle.X_TN() * rig.needle.shape().place(rig.needle.held_arc_m());
      const Eigen::AngleAxisd turned(Mat3(rig.needle.X_TN().R * before.R.transpose()));
      const Vec3 way = about - before * rig.needle.shape().place(rig.needle.held_arc_m());
      of_cycle -= rig.needle.load_T().force.dot(way) +
                  rig.needle.load_T().moment.dot(turned.angle() * turned.axis());  // of the hand on the needle
      before = rig.needle.X_TN();
    }
    EXPECT_GT(of_cycle, 0) << "friction takes, nothing gives";
    work += of_cycle;
  }
  EXPECT_GT(work, 0);
}

TEST(SutureNeedle, AtRandomAllStaysFiniteAndTheSameInputGivesTheSameBytes) {
  const auto run = [](int steps) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(-0.3, 0.3), aside(-0.002, 0.002), chance(0, 1);
    test::NeedleRig rig;
    double at = 0;
    Vec3 shift = Vec3::Zero();
    bool sound = true;
    for (int i = 0; i < steps; ++i) {
      at = std::clamp(at + angle(random), -1.0, 4.0);
      shift += Vec3(aside(random), aside(random), aside(random));
      shift = shift.cwiseMax(-0.01).cwiseMin(0.01);
      const double pick = chance(random);
      if (pick < 0.02)
        rig.step({});
      else
        rig.step(DriverJaws{rig.jaws_at(at, shift), pick < 0.1 ? 0.005 : 0.0});
      if (i % 200 == 0) rig.needle.load(rig.jaws_at(at, shift), rig.X_NI.inverse());
      sound = sound && rig.needle.X_TN().p.allFinite() && rig.needle.X_TN().R.allFinite() &&
              rig.needle.load_T().force.allFinite() && rig.organ.surface()->vertices[0].allFinite();
    }
    EXPECT_TRUE(sound);
    for (const Vec3& vertex : rig.organ.surface()->vertices) sound = sound && vertex.allFinite();
    EXPECT_TRUE(sound);
    rig.needle.place(rig.turned(0, {0, 0, 0.05}));
    std::vector<Vec3f> nodes(rig.organ.solid().position().begin(), rig.organ.solid().position().end());
    return nodes;
  };
  const auto a = run(10000), b = run(1000), c = run(1000);
  EXPECT_EQ(std::memcmp(b.data(), c.data(), b.size() * sizeof(Vec3f)), 0);
  EXPECT_FALSE(a.empty());
}

TEST(SutureNeedle, PrintsWhatAStepCosts) {
  test::NeedleRig rig;
  turn(rig, 0, 2.2);
  const OrganView view{rig.organ, rig.walk};
  const DriverJaws jaws{rig.jaws_at(2.2), 0};
  const std::clock_t from = std::clock();
  constexpr int kSteps = 200;
  std::size_t count = 0;
  for (int i = 0; i < kSteps; ++i) {
    std::vector<SoftSpring> springs;
    rig.needle.before(view, jaws, {}, springs);
    rig.needle.after(view, jaws, {}, springs);
    count = springs.size();
  }
  RecordProperty("ms", std::to_string(1e3 * double(std::clock() - from) / CLOCKS_PER_SEC / kSteps));
  std::printf("needle in tissue, held, %zu springs: %.3f ms CPU a step beside the organ's own\n", count,
              1e3 * double(std::clock() - from) / CLOCKS_PER_SEC / kSteps);
}

}  // namespace
}  // namespace trocar::suture_needle_test
