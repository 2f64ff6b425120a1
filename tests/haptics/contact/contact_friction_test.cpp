// Coulomb friction of the contact: cone, break-away, sticking without drift, dragging, moving tissue, rolling, energy.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>

#include "haptics/contact/contact_renderer.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::contact_friction_test {
namespace {

using test::Random;
using test::tip_down;

constexpr double kRadius = ToolShape{}.radius_m;
constexpr double kPeriod = 1e-3;

class Friction : public ::testing::Test {
 protected:
  Friction() {
    patch->material[0].mu_static = 0.3;
    patch->material[0].mu_dynamic = 0.2;
    patch->material[0].damping_s_per_m = 0;
  }
  /// Goes to X with the velocity that the step means.
  ContactResult step(const Pose& X) {
    const Eigen::AngleAxisd turn(Mat3(X.R * last.R.transpose()));
    const Twist V{(X.p - last.p) / kPeriod, turn.axis() * (turn.angle() / kPeriod)};
    last = X;
    return renderer.update(X, V, *patch);
  }
  ContactResult press(const Pose& above, const Pose& X) {
    renderer.reset();
    last = above;
    ContactResult r;
    for (int i = 0; i <= 400; ++i) r = step({X.R, above.p + (X.p - above.p) * (i / 400.0)});
    for (int i = 0; i < 200; ++i) r = step(X);
    return r;
  }
  /// Tangential and normal force on a surface of this normal.
  static double ratio(const ContactResult& r, const Vec3& n) {
    const double normal = r.F_I_T.force.dot(n);
    return (r.F_I_T.force - normal * n).norm() / normal;
  }

  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  ContactRenderer renderer{ContactLaw::kProxy};
  Pose last;
};

TEST_F(Friction, WithoutFrictionNothingIsTangential) {
  patch->material[0].mu_static = patch->material[0].mu_dynamic = 0;
  test::flat_patch(*patch);
  press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - 0.003}));
  for (int k = 0; k < 500; ++k) {
    const ContactResult r = step(tip_down({1e-5 * k, 0, kRadius - 0.003}));
    ASSERT_LT(r.F_I_T.force.head<2>().norm(), 1e-9);
    ASSERT_FALSE(r.slipping);
  }
}

TEST_F(Friction, BreaksAwayAtMuStaticAndSlidesAtMuDynamicInEveryDirection) {
  test::flat_patch(*patch, 0, 0.04, 9);
  const double depth = 0.003, normal = 150 * depth;
  for (int k = 0; k < 24; ++k) {
    const double angle = k * std::numbers::pi / 12 + 0.05;
    const Vec3 way(std::cos(angle), std::sin(angle), 0);
    press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - depth}));
    double peak = 0, steady = 0;
    ContactResult r;
    for (int i = 0; i < 600; ++i) {  // 30 mm/s: well above the Stribeck speed
      r = step(tip_down(Vec3(0, 0, kRadius - depth) + way * (3e-5 * i)));
      peak = std::max(peak, r.F_I_T.force.head<2>().norm());
      if (i > 500) steady = std::max(steady, r.F_I_T.force.head<2>().norm());
    }
    EXPECT_TRUE(r.slipping);
    EXPECT_NEAR(peak / normal, 0.3, 0.02 * 0.3) << "cone, not pyramid: direction " << k;
    EXPECT_NEAR(steady / normal, 0.2, 0.02 * 0.2);
    EXPECT_LT(test::angle_between(-r.F_I_T.force.cwiseProduct(Vec3(1, 1, 0)), way), 0.01) << "against the motion";
  }
}

TEST_F(Friction, SticksUpToTheAngleWhoseTangentIsMu) {
  // Pressed vertically on an incline with a hand that is soft sideways: at rest the force has no component along the
  // slope but friction's; it holds while tan(slope) < mu_s.
  for (const double slope : {0.97 * std::atan(0.3), 1.03 * std::atan(0.3)}) {
    const Vec3 along(std::cos(slope), 0, std::sin(slope)), normal(-std::sin(slope), 0, std::cos(slope));
    patch->clear();
    test::add_sheet(*patch, -0.04 * along - Vec3(0, 0.04, 0), 0.08 * along, {0, 0.08, 0}, 8);
    press(tip_down(normal * 0.01), tip_down(normal * kRadius - Vec3(0, 0, 1e-4)));
    // Quasi-static load: a weight of 0.4 N that moves under the force left over, heavily damped.
    Vec3 p = last.p;
    ContactResult r = step(last);
    for (int i = 0; i < 20000; ++i) {
      p += (r.F_I_T.force - Vec3(0, 0, 0.4)) * 2e-4;
      r = step(tip_down(p));
    }
    const double slid = -(p - normal * kRadius).dot(along);
    // tan(slope) N is held by k_t u: u = 0.4 sin(slope) / (0.8 k).
    const double elastic = 0.4 * std::sin(slope) / (0.8 * 150);
    if (slope < std::atan(0.3)) {
      EXPECT_NEAR(slid, elastic, 4e-5) << "pressing itself went 0.03 mm down the slope";
      EXPECT_NEAR(ratio(r, normal), std::tan(slope), 0.02 * 0.3);
    } else {
      EXPECT_GT(slid, 0.01) << "it slides away";
    }
  }
}

TEST_F(Friction, StuckItDoesNotCreepUnderNoise) {
  // 0.8 of the limit for 10 s; pose noise as large as an encoder count at the tip (0.1 mm, 0.4 mrad) every tick.
  patch->material[0].mu_dynamic = 0.3;
  test::patch_near(test::sphere(5, 0.04), {0, 0, 0.04}, 0.02, *patch);
  const double depth = 0.003;
  const Vec3 rest(0, 0, 0.04 + kRadius - depth);
  press(tip_down({0, 0, 0.06}), tip_down(rest));
  const double limit = 0.3 * depth / 0.8;
  const auto mean_force = [&](int ticks, Random& random) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < ticks; ++i) {
      const Mat3 R =
          Eigen::AngleAxisd(random.symmetric(4e-4), random.direction()).toRotationMatrix() * tip_down(rest).R;
      const Vec3 noise = random.vector(0.5e-4);
      sum += step({R, rest + Vec3(0.7 * limit, 0, 0) + noise}).F_I_T.force;
    }
    return Vec3(sum / ticks);
  };
  for (int i = 0; i <= 100; ++i) step(tip_down(rest + Vec3(0.7 * limit * i / 100, 0, 0)));
  Random random(7);
  const Vec3 first = mean_force(500, random), after = (mean_force(9500, random), mean_force(500, random));
  // The anchor's creep shows as force lost: k_t times the distance.
  EXPECT_GT(first.head<2>().norm(), 0.05) << "friction holds";
  EXPECT_LT((after - first).head<2>().norm() / (0.8 * 150), 1e-4) << "0.1 mm in 10 s";
}

TEST_F(Friction, SlippingDragsTheAnchor) {
  test::flat_patch(*patch, 0, 0.04, 9);
  const double depth = 0.003, limit = 0.2 * depth / 0.8;
  press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - depth}));
  for (int i = 0; i <= 500; ++i) step(tip_down({2e-5 * i, 0, kRadius - depth}));
  // Turned back it unloads over twice the stretch and holds from the other side.
  double reversed = 0;
  for (int i = 0; i < 200; ++i) {
    const ContactResult r = step(tip_down({0.010 - 1e-5 * i, 0, kRadius - depth}));
    if (reversed == 0 && r.F_I_T.force.x() >= 0) reversed = 1e-5 * i;
  }
  EXPECT_NEAR(reversed, limit, 3e-5) << "the anchor lies one stretch behind";
}

TEST_F(Friction, TheTissueTakesTheToolAlong) {
  test::flat_patch(*patch);
  const double depth = 0.003;
  press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - depth}));
  for (int k = 1; k <= 20; ++k) {  // the surface moves by 0.4 mm, a new patch every 10 ticks
    for (int i = 0; i < patch->vertex_count; ++i) patch->vertex[std::size_t(i)].x() += 2e-5;
    // Another order and another part of the surface: the triangle is found by its name.
    std::swap(patch->triangle[0], patch->triangle[std::size_t(patch->count - 1 - k)]);
    ++patch->stamp;
    ContactResult r;
    for (int i = 0; i < 10; ++i) r = step(last);
    EXPECT_NEAR(r.F_I_T.force.x(), 0.8 * 150 * 2e-5 * k, 1e-4);
  }
}

TEST_F(Friction, AShaftThatTurnsAboutItselfMeetsATorque) {
  const Mat3 lying = (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished();
  test::add_sheet(*patch, {0.10, -0.02, 0}, {0, 0.04, 0}, {-0.01, 0, -0.01}, 3);
  test::add_sheet(*patch, {0.10, -0.02, 0}, {0.01, 0, -0.01}, {0, 0.04, 0}, 3);
  const double depth = 0.003;
  press({lying, Vec3(0, 0, 0.02)}, {lying, Vec3(0, 0, kRadius - depth)});
  ContactResult r;
  for (int i = 1; i < 2000; ++i) {
    r = step({Eigen::AngleAxisd(1e-3 * i, Vec3::UnitX()).toRotationMatrix() * lying, Vec3(0, 0, kRadius - depth)});
  }
  // 1 rad/s on 2.5 mm: half the Stribeck speed. The pressed-in point lies one radius from the axis.
  const double torque = (0.2 + 0.1 * std::exp(-0.25)) * 150 * depth * kRadius;
  EXPECT_NEAR(std::abs(r.F_I_T.moment.x()), torque, 0.02 * torque);
}

TEST_F(Friction, ATipThatSpinsOnTheSpotDoesNot) {
  test::flat_patch(*patch);
  press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - 0.003}));
  for (int i = 1; i < 2000; ++i) {
    const Mat3 R = Eigen::AngleAxisd(1e-3 * i, Vec3::UnitZ()).toRotationMatrix() * tip_down(Vec3::Zero()).R;
    const ContactResult r = step({R, Vec3(0, 0, kRadius - 0.003)});
    ASSERT_LT(r.F_I_T.force.head<2>().norm(), 1e-4);
  }
}

TEST_F(Friction, RollingWithoutSlipIsFree) {
  // The tip rolls like a ball: its centre goes r dtheta while it turns by dtheta.
  test::flat_patch(*patch);
  press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - 0.0005}));
  const double r = kRadius;
  double worst = 0;
  for (int i = 1; i <= 600; ++i) {
    const double angle = 1e-3 * i;  // the pressed-in point turns about the lower height
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix() * tip_down(Vec3::Zero()).R;
    worst = std::max(worst, step({R, Vec3(r * angle, 0, kRadius - 0.0005)}).F_I_T.force.head<2>().norm());
  }
  EXPECT_LT(worst, 0.1 * 0.2 * 150 * 0.0005) << "a tenth of sliding";
}

TEST_F(Friction, CrossingFacetsLosesNothing) {
  // Dragged over a smooth ball of many facets the friction stays mu_d N all the way.
  test::patch_near(test::sphere(5, 0.04), {0, 0, 0.04}, 0.02, *patch);
  const auto at = [](double angle) {
    const Vec3 n(std::sin(angle), 0.1 * std::sin(angle), std::cos(angle));
    return tip_down(n.normalized() * (0.04 + kRadius - 0.001));
  };
  press(tip_down({-0.008, 0, 0.06}), at(-0.2));
  double low = 1, high = 0, step_n = 0;
  Vec3 before = Vec3::Zero();
  for (int i = 0; i <= 400; ++i) {
    const ContactResult r = step(at(-0.2 + 1e-3 * i));
    const double now = ratio(r, r.normal_T);
    if (i > 100) {
      low = std::min(low, now);
      high = std::max(high, now);
      step_n = std::max(step_n, (r.F_I_T.force - before).norm());
    }
    before = r.F_I_T.force;
  }
  EXPECT_GT(low, 0.2 * 0.95);
  EXPECT_LT(high, 0.2 * 1.05);
  EXPECT_LT(step_n, 0.012) << "N over 43 um at 150 N/m: no facet is felt as a step";
}

/// Work of the contact on the instrument along a closed path, J, less what it stored at the end.
TEST_F(Friction, NoClosedPathGainsEnergy) {
  test::patch_near(test::lumpy_sphere(4, 0.04), {0, 0, 0.04}, 0.02, *patch);
  Random random(11);
  double dissipated = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::array<Vec3, 4> a;
    for (Vec3& v : a) v = random.vector(1);
    const auto path = [&](double s) {
      const double w = 2 * std::numbers::pi * s;
      const Vec3 swing = 0.003 * (a[0] * std::sin(w) + a[1] * std::sin(2 * w));
      const Vec3 turn = 0.15 * (a[2] * std::sin(w) + a[3] * std::sin(2 * w));
      const double lift = 0.02 * 0.5 * (1 + std::cos(w)) + std::abs(swing.z());
      const Mat3 R = turn.norm() > 0 ? Mat3(Eigen::AngleAxisd(turn.norm(), turn.normalized())) : Mat3::Identity();
      return Pose{R * tip_down(Vec3::Zero()).R, Vec3(swing.x(), swing.y(), 0.04 + kRadius - 0.0005 + lift - 0.002)};
    };
    renderer.reset();
    last = path(0);
    ContactResult before = step(last);
    double work = 0;
    constexpr int kTicks = 6000;
    for (int k = 1; k <= kTicks; ++k) {
      const Pose from = last;
      const ContactResult r = step(path(double(k) / kTicks));
      const Eigen::AngleAxisd turn(Mat3(last.R * from.R.transpose()));
      work += 0.5 * (before.F_I_T.force + r.F_I_T.force).dot(last.p - from.p);
      work += 0.5 * (before.F_I_T.moment + r.F_I_T.moment).dot(turn.axis() * turn.angle());
      before = r;
    }
    EXPECT_LT(work, 1e-6) << "J given to the hand, path " << trial;
    dissipated -= work;
  }
  EXPECT_GT(dissipated, 1e-4) << "friction was at work";
}

TEST_F(Friction, StoredEnergyCountsTheStickSpring) {
  test::flat_patch(*patch);
  const double depth = 0.003, aside = 0.0005;
  const double before = press(tip_down({0, 0, 0.01}), tip_down({0, 0, kRadius - depth})).stored_j;
  ContactResult r;
  for (int i = 1; i <= 100; ++i) r = step(tip_down({aside * i / 100, 0, kRadius - depth}));
  ASSERT_FALSE(r.slipping);
  EXPECT_NEAR(r.stored_j - before, 0.5 * 0.8 * 150 * aside * aside, 1e-7);
}

}  // namespace
}  // namespace trocar::contact_friction_test
