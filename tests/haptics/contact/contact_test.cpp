// The proxy contact at rest and at work: plane, shaft, wedge, energy, damping, limits of the patch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::contact_test {
namespace {

using test::Random;
using test::tip_down;

constexpr double kRadius = ToolShape{}.radius_m, kLength = ToolShape{}.shaft_length_m;
// The proxy rests within 1e-7 m of its goal: 1.5e-5 N at 150 N/m, several steps of it.
constexpr double kForceTolerance = 1e-4;

class Contact : public ::testing::Test {
 protected:
  ContactResult feel(const Pose& X, const Vec3& velocity = Vec3::Zero()) {
    return renderer.update(X, Twist{velocity, Vec3::Zero()}, *patch);
  }
  ContactResult settle(const Pose& X, int ticks = 20) {
    ContactResult result;
    for (int i = 0; i < ticks; ++i) result = feel(X);
    return result;
  }
  double stiffness() const { return patch->material[0].stiffness_n_per_m; }

  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  ContactRenderer renderer{ContactLaw::kProxy};
};

/// Instrument lying along -x: its tip at p, its shaft from there along +x.
Pose lying(const Vec3& p) { return {(Mat3() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished(), p}; }

TEST_F(Contact, NothingWithoutTriangles) {
  const ContactResult r = feel(tip_down(Vec3::Zero()));
  EXPECT_FALSE(r.contact);
  EXPECT_EQ(r.F_I_T.force.norm(), 0);
}

TEST_F(Contact, FreeAirAboveThePlaneIsForceFree) {
  test::flat_patch(*patch);
  const ContactResult r = settle(tip_down({0, 0, kRadius + 1e-5}));
  EXPECT_FALSE(r.contact);
  EXPECT_EQ(r.F_I_T.force.norm(), 0);
  EXPECT_EQ(r.stored_j, 0);
}

TEST_F(Contact, PlaneGivesStiffnessTimesDepth) {
  test::flat_patch(*patch);
  settle(tip_down({0, 0, kRadius}));
  for (double depth = 1e-4; depth < 0.012; depth += 1e-4) {
    const ContactResult r = feel(tip_down({0.001, 0.002, kRadius - depth}));
    ASSERT_TRUE(r.contact);
    EXPECT_TRUE(r.tip_contact);
    EXPECT_LT((r.F_I_T.force - Vec3(0, 0, stiffness() * depth)).norm(), kForceTolerance);
    EXPECT_NEAR(r.depth_m, depth, 1e-6);
    EXPECT_NEAR(r.stored_j, 0.5 * stiffness() * depth * depth, 1e-6 * stiffness() * depth);
    EXPECT_LT((r.point_T - Vec3(0.001, 0.002, 0)).norm(), 1e-5);
    EXPECT_LT(r.F_I_T.moment.norm(), kForceTolerance * kRadius * 2) << "a frictionless sphere has no moment";
  }
}

TEST_F(Contact, TangentialJitterDoesNotTouchTheForce) {
  test::flat_patch(*patch, 0, 0.04, 15);
  Random random(1);
  settle(tip_down({0, 0, kRadius}));
  for (int k = 0; k < 5000; ++k) {
    const ContactResult r = feel(tip_down({random.symmetric(5e-4), random.symmetric(5e-4), kRadius - 0.004}));
    EXPECT_LT((r.F_I_T.force - Vec3(0, 0, 0.004 * stiffness())).norm(), kForceTolerance);
  }
}

/// Two planes that lean from each other by this much: the tip stands between them, and they face each other nearly.
void groove(ContactPatch& patch, double half_rad) {
  const Vec3 right(std::sin(half_rad), 0, std::cos(half_rad)), left(-std::sin(half_rad), 0, std::cos(half_rad));
  test::add_sheet(patch, {0, 0.02, 0}, 0.06 * right, {0, -0.04, 0}, 3);
  test::add_sheet(patch, {0, 0.02, 0}, {0, -0.04, 0}, 0.06 * left, 3);
}

TEST_F(Contact, AGrooveHoldsWhatIsPressedIntoIt) {
  constexpr double kHalf = 0.15, kDepth = 0.002;
  groove(*patch, kHalf);
  const double rest = kRadius / std::sin(kHalf);
  settle(tip_down({0, 0, rest}));
  const ContactResult r = settle(tip_down({0, 0, rest - kDepth}));
  ASSERT_EQ(renderer.contacts().count, 2);
  EXPECT_LT((r.F_I_T.force - Vec3(0, 0, kDepth * stiffness())).norm(), kForceTolerance);
}

TEST_F(Contact, PlanesThatFaceEachOtherDoNotPressByAThousandTimesWhatTheyHold) {
  constexpr double kHalf = 0.05, kDepth = 0.002;
  groove(*patch, kHalf);
  const double rest = kRadius / std::sin(kHalf);
  settle(tip_down({0, 0, rest}));
  // Closing planes, too: damping acts on what each contact carries.
  const ContactResult r = feel(tip_down({0, 0, rest - kDepth}), {0, 0, -0.2});
  ASSERT_EQ(renderer.contacts().count, 2);
  double all = 0;
  for (int i = 0; i < 2; ++i) all += renderer.contacts().at[i].force_T.norm();
  EXPECT_LT(all, 10 * kDepth * stiffness() * r.damping_factor + kForceTolerance);
  EXPECT_LT(r.F_I_T.force.norm(), kDepth * stiffness() * r.damping_factor);
  EXPECT_GT(r.F_I_T.force.z(), 0) << "still felt";
}

TEST_F(Contact, ShaftOnARidgeGivesForceTimesLever) {
  // A ridge along y at x = 0.10, its edge at z = 0.
  test::add_sheet(*patch, {0.10, -0.02, 0}, {0, 0.04, 0}, {-0.01, 0, -0.01}, 3);
  test::add_sheet(*patch, {0.10, -0.02, 0}, {0.01, 0, -0.01}, {0, 0.04, 0}, 3);
  settle(lying({0, 0, kRadius}));
  const double depth = 0.003;
  const ContactResult r = settle(lying({0, 0, kRadius - depth}));
  ASSERT_TRUE(r.contact);
  EXPECT_FALSE(r.tip_contact);
  EXPECT_LT((r.F_I_T.force - Vec3(0, 0, depth * stiffness())).norm(), kForceTolerance);
  const Vec3 lever(0.10, 0, -kRadius);  // from the proxy's tip to the edge
  EXPECT_LT((r.F_I_T.moment - lever.cross(r.F_I_T.force)).norm(), 0.01 * depth * stiffness() * 0.10);
  EXPECT_LT(r.F_I_T.moment.y(), -0.9 * depth * stiffness() * 0.10) << "sign: lifts the shaft beyond the tip";
}

TEST_F(Contact, WedgePushesOutOfItsGroove) {
  // Two planes at 45 degrees that meet along y at z = 0.
  test::add_sheet(*patch, {0, -0.02, 0}, {0.02, 0, 0.02}, {0, 0.04, 0}, 4);
  test::add_sheet(*patch, {0, -0.02, 0}, {0, 0.04, 0}, {-0.02, 0, 0.02}, 4);
  const double seat = kRadius * std::sqrt(2.0);
  settle(tip_down({0, 0, seat + 0.001}));
  for (const double depth : {0.0005, 0.001, 0.002, 0.004}) {
    const ContactResult down = settle(tip_down({0, 0, seat - depth}));
    EXPECT_LT((down.F_I_T.force - Vec3(0, 0, depth * stiffness())).norm(), 5 * kForceTolerance);
    // Aside by less than its depth both planes still carry: F = k (seat - goal).
    const ContactResult aside = settle(tip_down({0.3 * depth, 0, seat - depth}));
    EXPECT_LT((aside.F_I_T.force - stiffness() * Vec3(-0.3 * depth, 0, depth)).norm(), 5 * kForceTolerance);
  }
}

TEST_F(Contact, OneWallOfTheWedgeCarriesAloneWhenTheOtherIsLeft) {
  test::add_sheet(*patch, {0, -0.02, 0}, {0.02, 0, 0.02}, {0, 0.04, 0}, 4);
  test::add_sheet(*patch, {0, -0.02, 0}, {0, 0.04, 0}, {-0.02, 0, 0.02}, 4);
  const Vec3 normal = Vec3(-1, 0, 1).normalized();
  const Vec3 on_wall(0.01, 0, 0.01);
  settle(tip_down(on_wall + normal * (kRadius + 1e-4)));
  const ContactResult r = settle(tip_down(on_wall + normal * (kRadius - 0.002)));
  EXPECT_LT((r.F_I_T.force - normal * 0.002 * stiffness()).norm(), 5 * kForceTolerance);
}

TEST_F(Contact, DampingResistsTheApproachAndNeverPulls) {
  test::flat_patch(*patch);
  Random random(2);
  settle(tip_down({0, 0, kRadius}));
  const Pose X = tip_down({0, 0, kRadius - 0.003});
  const double spring = settle(X).F_I_T.force.z();
  const ContactResult in = feel(X, {0, 0, -0.2}), out = feel(X, {0, 0, 0.2});
  EXPECT_NEAR(in.F_I_T.force.z(), spring * (1 + 1.5 * patch->material[0].damping_s_per_m * 0.2), 1e-6);
  EXPECT_NEAR(out.F_I_T.force.z(), spring * (1 - 1.5 * patch->material[0].damping_s_per_m * 0.2), 1e-6);
  for (int k = 0; k < 5000; ++k) {
    const ContactResult r = feel(X, random.vector(20));
    EXPECT_GE(r.F_I_T.force.z(), 0);
    EXPECT_GE(r.damping_factor, 0);
  }
  EXPECT_EQ(feel(X, {0, 0, 5}).F_I_T.force.norm(), 0) << "fast withdrawal: no suction";
}

TEST_F(Contact, ResetForgetsTheSide) {
  test::flat_patch(*patch);
  settle(tip_down({0, 0, 0.01}));
  ASSERT_TRUE(settle(tip_down({0, 0, -0.004})).contact);
  renderer.reset();
  // Started 4 mm under the surface, upright, the shaft pierces it; far to the side nothing is near.
  EXPECT_FALSE(feel(tip_down({0.2, 0, -0.004})).contact);
}

TEST_F(Contact, OrderOfTheTrianglesDoesNotMatter) {
  // A fine plane: some 200 triangles lie within reach of the tip, more than the renderer looks at in one tick.
  test::flat_patch(*patch, 0, 0.005, 16);
  ASSERT_EQ(patch->count, kMaxPatchTriangles);
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    for (int i = patch->count - 1; i > 0; --i) {
      std::swap(patch->triangle[std::size_t(i)], patch->triangle[std::size_t(random.below(i + 1))]);
    }
    ++patch->stamp;
    renderer.reset();
    settle(tip_down({0.0007, -0.0004, kRadius + 1e-4}), 2);
    for (double depth = 1e-4; depth < 0.003; depth += 1e-4) {
      const ContactResult r = feel(tip_down({0.0007, -0.0004, kRadius - depth}));
      ASSERT_NEAR(r.F_I_T.force.z(), depth * stiffness(), kForceTolerance) << "order " << trial << " depth " << depth;
    }
  }
}

TEST_F(Contact, FullPatchIsUsedToItsLastTriangle) {
  // 511 triangles far away, the one that matters last.
  for (int i = 0; i < kMaxPatchTriangles - 1; ++i) {
    const Vec3 p(0.015 + 1e-5 * i, 0.015, -0.01);
    test::add_triangle(*patch, p, p + Vec3(1e-4, 0, 0), p + Vec3(0, 1e-4, 0));
  }
  test::add_triangle(*patch, {-0.01, -0.01, 0}, {0.01, -0.01, 0}, {0, 0.01, 0});
  ASSERT_EQ(patch->count, kMaxPatchTriangles);
  settle(tip_down({0, 0, kRadius}));
  EXPECT_NEAR(feel(tip_down({0, 0, kRadius - 0.002})).F_I_T.force.z(), 0.002 * stiffness(), kForceTolerance);
}

TEST_F(Contact, SameInputSameBytes) {
  test::patch_near(test::lumpy_sphere(4, 0.04), {0, 0, 0.04}, 0.015, *patch);
  const auto run = [&] {
    Random random(4);
    ContactRenderer fresh(ContactLaw::kProxy);
    std::vector<double> out;
    for (int k = 0; k < 2000; ++k) {
      const double t = k * 1e-3;
      const Pose X{random.rotation(),
                   Vec3(0.003 * std::sin(9 * t), 0.002 * std::cos(7 * t), 0.042 + 0.004 * std::sin(3 * t))};
      const ContactResult r = fresh.update(X, Twist{random.vector(0.1), Vec3::Zero()}, *patch);
      for (int i = 0; i < 3; ++i) out.insert(out.end(), {r.F_I_T.force[i], r.F_I_T.moment[i], r.point_T[i]});
    }
    return out;
  };
  const std::vector<double> a = run(), b = run();
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

TEST_F(Contact, RandomPosesOnATriangleSoupStayFinite) {
  Random random(5);
  constexpr int kTicks = 100000;
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  for (int k = 0; k < kTicks; ++k) {
    if (k % 500 == 0) {
      patch->clear();
      for (int i = 0; i < 60; ++i) {
        const Vec3 a = random.vector(0.02);
        const double size = random.below(8) == 0 ? 0 : 0.01;  // every eighth is a point
        const Vec3 b = a + random.vector(size);
        test::add_triangle(*patch, a, b, random.below(10) == 0 ? b : Vec3(a + random.vector(size)));
      }
    }
    p = random.below(100) == 0 ? random.vector(0.05) : Vec3(p + random.vector(0.001));
    if (p.norm() > 0.06) p = Vec3::Zero();
    if (random.below(50) == 0) R = random.rotation();
    const ContactResult r = feel({R, p}, random.vector(1));
    ASSERT_TRUE(r.F_I_T.force.allFinite() && r.F_I_T.moment.allFinite() && std::isfinite(r.stored_j)) << "tick " << k;
    ASSERT_GE(r.depth_m, 0);
    ASSERT_GE(r.damping_factor, 0);
    ASSERT_NEAR(r.normal_T.norm(), 1, 1e-9);
  }
}

}  // namespace
}  // namespace trocar::contact_test
