// The proxy contact as a potential: force and moment are minus the slope of the stored energy, closed loops do no work.
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::contact_energy_test {
namespace {

using test::Random;
using test::tip_down;

constexpr double kRadius = ToolShape{}.radius_m;

Pose moved(const Pose& X, const Vec6& step) {
  const Vec3 turn = step.tail<3>();
  const Mat3 R =
      turn.norm() > 0 ? Mat3(Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()) : Mat3::Identity();
  return {R * X.R, X.p + step.head<3>()};
}

ContactResult settled(ContactRenderer renderer, const Pose& X, const ContactPatch& patch) {
  ContactResult r;
  for (int i = 0; i < 30; ++i) r = renderer.update(X, Twist{}, patch);
  return r;
}

/// Force (N) and moment (N m) by central differences of the stored energy.
Vec6 minus_slope(const ContactRenderer& renderer, const Pose& X, const ContactPatch& patch) {
  Vec6 slope;
  for (int i = 0; i < 6; ++i) {
    // The proxy rests within 1e-7 m: the energy is uncertain by F * 1e-7, the slope by F * 1e-7 / h.
    const double h = i < 3 ? 2e-5 : 2e-4;
    const Vec6 step = Vec6::Unit(i) * h;
    slope[i] =
        -(settled(renderer, moved(X, step), patch).stored_j - settled(renderer, moved(X, -step), patch).stored_j) /
        (2 * h);
  }
  return slope;
}

class ContactEnergy : public ::testing::Test {
 protected:
  void expect_gradient(const Pose& far, const Pose& X) {
    ContactRenderer renderer(ContactLaw::kProxy);
    for (int i = 0; i <= 400; ++i) {  // approach along the straight line
      renderer.update({X.R, far.p + (X.p - far.p) * (i / 400.0)}, Twist{}, *patch);
    }
    const ContactResult r = settled(renderer, X, *patch);
    ASSERT_TRUE(r.contact);
    const Vec6 slope = minus_slope(renderer, X, *patch);
    EXPECT_LT((r.F_I_T.force - slope.head<3>()).norm(), 0.01 * r.F_I_T.force.norm());
    EXPECT_LT((r.F_I_T.moment - slope.tail<3>()).norm(), 0.01 * r.F_I_T.force.norm() * 0.1);
  }
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
};

TEST_F(ContactEnergy, TipOnAPlane) {
  test::flat_patch(*patch);
  expect_gradient(tip_down({0, 0, 0.01}), tip_down({0.001, 0.002, kRadius - 0.003}));
}

TEST_F(ContactEnergy, TipOnACurvedSurface) {
  test::patch_near(test::sphere(5, 0.04), {0, 0, 0.04}, 0.012, *patch);
  Random random(1);
  for (int k = 0; k < 10; ++k) {
    Vec3 n = Vec3(random.symmetric(0.15), random.symmetric(0.15), 1).normalized();
    expect_gradient(tip_down(n * 0.05), tip_down(n * (0.04 + kRadius - 0.002)));
  }
}

TEST_F(ContactEnergy, ShaftOnARidgeIncludingItsMoment) {
  test::add_sheet(*patch, {0.10, -0.02, 0}, {0, 0.04, 0}, {-0.01, 0, -0.01}, 3);
  test::add_sheet(*patch, {0.10, -0.02, 0}, {0.01, 0, -0.01}, {0, 0.04, 0}, 3);
  const Mat3 lying = (Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished();
  Random random(2);
  for (int k = 0; k < 5; ++k) {
    const Mat3 R = Eigen::AngleAxisd(random.symmetric(0.02), random.direction()) * lying;
    const double drop = -R.col(2).z() / -R.col(2).x() * 0.10;  // height of the shaft over the ridge
    const Pose X{R, Vec3(random.symmetric(0.002), 0, kRadius - 0.002 - drop)};
    expect_gradient({R, X.p + Vec3(0, 0, 0.01)}, X);
  }
}

/// Net work of the contact on the instrument along a closed path that begins and ends in the air, J.
double work_of_loop(const ContactPatch& patch, int ticks, const std::function<Pose(double)>& path) {
  ContactRenderer renderer(ContactLaw::kProxy);
  Pose X = path(0);
  ContactResult last = renderer.update(X, Twist{}, patch);
  EXPECT_FALSE(last.contact);
  double work = 0, depth = 0;
  for (int k = 1; k <= ticks; ++k) {
    const Pose next = path(double(k) / ticks);
    const ContactResult r = renderer.update(next, Twist{}, patch);
    const Eigen::AngleAxisd turn(Mat3(next.R * X.R.transpose()));
    work += 0.5 * (last.F_I_T.force + r.F_I_T.force).dot(next.p - X.p);
    work += 0.5 * (last.F_I_T.moment + r.F_I_T.moment).dot(turn.axis() * turn.angle());
    depth = std::max(depth, r.depth_m);
    X = next;
    last = r;
  }
  EXPECT_FALSE(last.contact);
  EXPECT_GT(depth, 1e-3) << "the loop must press";
  return work;
}

/// Random smooth loop: harmonics in position and orientation about `centre`, lifted by `lift` at both ends.
std::function<Pose(double)> random_loop(Random& random, const Pose& centre, double sway, double turn, double lift) {
  std::array<Vec3, 4> a;
  for (Vec3& v : a) v = random.vector(1);
  return [=](double s) {
    const double w = 2 * std::numbers::pi * s;
    const Vec3 swing = sway * (a[0] * std::sin(w) + a[1] * std::sin(2 * w));
    const Vec3 rotation = turn * (a[2] * std::sin(w) + a[3] * std::sin(2 * w));
    Vec6 step;
    step << swing + Vec3(0, 0, lift * 0.5 * (1 + std::cos(w)) + std::abs(swing.z())), rotation;
    return moved(centre, step);
  };
}

TEST_F(ContactEnergy, ClosedLoopsOnAPlaneDoNoWork) {
  test::flat_patch(*patch);
  Random random(3);
  for (int k = 0; k < 10; ++k) {
    const auto loop = random_loop(random, tip_down({0, 0, kRadius - 0.004}), 0.002, 0.2, 0.02);
    EXPECT_LT(std::abs(work_of_loop(*patch, 4000, loop)), 1e-6) << "of about 1 mJ stored";
  }
}

TEST_F(ContactEnergy, ClosedLoopsOnASphereDoNoWork) {
  // The axis stays outside the facets: the nearest point is unique, the force a function of the pose.
  test::patch_near(test::sphere(4, 0.04), {0, 0, 0.04}, 0.02, *patch);
  Random random(4);
  for (int k = 0; k < 10; ++k) {
    const auto loop = random_loop(random, tip_down({0, 0, 0.04 + kRadius - 0.002}), 0.002, 0.1, 0.02);
    EXPECT_LT(std::abs(work_of_loop(*patch, 8000, loop)), 1e-6);
  }
}

TEST_F(ContactEnergy, DeeperThanTheRadiusALoopMayLoseEnergyButNeverGains) {
  // With its axis inside a convex body the proxy goes from facet to facet, each time a little downhill.
  test::patch_near(test::sphere(4, 0.04), {0, 0, 0.04}, 0.02, *patch);
  Random random(4);
  for (int k = 0; k < 10; ++k) {
    const auto loop = random_loop(random, tip_down({0, 0, 0.04 + kRadius - 0.003}), 0.002, 0.1, 0.02);
    const double work = work_of_loop(*patch, 8000, loop);
    EXPECT_LT(work, 1e-7);
    EXPECT_GT(work, -1e-5) << "a hundredth of what is stored";
  }
}

TEST_F(ContactEnergy, ClosedLoopsInAGrooveDoNoWork) {
  test::add_sheet(*patch, {0, -0.02, 0}, {0.02, 0, 0.02}, {0, 0.04, 0}, 4);
  test::add_sheet(*patch, {0, -0.02, 0}, {0, 0.04, 0}, {-0.02, 0, 0.02}, 4);
  Random random(5);
  for (int k = 0; k < 10; ++k) {
    const auto loop = random_loop(random, tip_down({0, 0, kRadius * std::sqrt(2.0) - 0.003}), 0.001, 0.1, 0.03);
    EXPECT_LT(std::abs(work_of_loop(*patch, 8000, loop)), 1e-6);
  }
}

TEST(ContactDamping, OfASwingingShaftOnlyDissipates) {
  // The shaft rests on a plane far behind the tip: the damping must follow the speed of the contact, not of the tip.
  ContactPatch patch;
  const double s = 0.4;
  add_triangle(patch, {Vec3(-s, -s, 0), Vec3(s, -s, 0), Vec3(s, s, 0)}, 0);
  add_triangle(patch, {Vec3(-s, -s, 0), Vec3(s, s, 0), Vec3(-s, s, 0)}, 1);
  for (const double phase : {0.0, 1.5, 3.0, 4.5}) {
    ContactRenderer renderer(ContactLaw::kProxy);
    double work = 0, largest = 0;
    for (int i = 0; i <= 20000; ++i) {  // 5 Hz, 20 kHz steps: ten cycles
      const double w = 2 * std::numbers::pi * 5, t = i * 0.5e-4, swing = 0.02;
      const double angle = 0.01 + swing * std::sin(w * t + phase), height = 0.002 + 0.002 * std::sin(w * t);
      // Shaft from the tip backwards along +x, lowered by the angle.
      const Vec3 back(std::cos(angle), 0, -std::sin(angle));
      Pose X;
      X.R.col(2) = -back;
      X.R.col(1) = Vec3::UnitY();
      X.R.col(0) = X.R.col(1).cross(X.R.col(2));
      X.p = Vec3(-0.1, 0, height);
      const Twist V{Vec3(0, 0, 0.002 * w * std::cos(w * t)), Vec3(0, swing * w * std::cos(w * t + phase), 0)};
      const ContactResult r = renderer.update(X, V, patch);
      if (i > 4000) {  // after the first cycles
        work += r.F_I_T.force.dot(V.linear) * 0.5e-4 + r.F_I_T.moment.dot(V.angular) * 0.5e-4;
      }
      largest = std::max(largest, r.F_I_T.force.norm());
    }
    EXPECT_GT(largest, 0.1) << "the shaft does press";
    EXPECT_LE(work, 2e-5) << "phase " << phase << ": J given to the hand in eight cycles";
  }
}

}  // namespace
}  // namespace trocar::contact_energy_test
