// Surfaces that move, and what the contact stage tells of each contact: the same scene seen from a moving frame gives
// the same forces, and the contacts add up to the force on the instrument.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>

#include "haptics/contact/contact_renderer.h"
#include "haptics/contact/segment_triangle.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::moving_surface_test {
namespace {

using test::Random;
using test::tip_down;

constexpr double kRadius = ToolShape{}.radius_m, kPeriod = 1e-3;

/// Tool and surface, both carried along at `drift`; a new patch every period.
class Carried {
 public:
  Carried(const std::function<void(ContactPatch&)>& surface, const Vec3& drift, bool moving) : drift_(drift) {
    patch->material[0] = {150, 0.8, 0.3, 0.2};
    surface(*patch);
    patch->moving = moving;
    patch->velocity.fill(drift);
    at_rest_ = patch->vertex;
  }
  /// @param V_I of the tool relative to what carries it.
  ContactResult step(const Pose& X_CI, const Twist& V_I) {
    const Vec3 way = drift_ * (kPeriod * ++tick_);
    for (int i = 0; i < patch->vertex_count; ++i) patch->vertex[std::size_t(i)] = at_rest_[std::size_t(i)] + way;
    ++patch->stamp;
    return renderer.update({X_CI.R, X_CI.p + way}, {V_I.linear + drift_, V_I.angular}, *patch);
  }

  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  ContactRenderer renderer{ContactLaw::kProxy};

 private:
  Vec3 drift_;
  std::array<Vec3, kMaxPatchVertices> at_rest_;
  int tick_ = 0;
};

void plane(ContactPatch& patch) { test::flat_patch(patch, 0, 0.04, 6); }

/// Down to 3 mm, to and fro along x and up again, the speeds those of the steps.
void press_and_rub(const std::function<void(const Pose&, const Twist&)>& step) {
  const auto at = [](int i) {
    const double t = i * kPeriod;
    return Vec3(0.01 * std::sin(6 * t), 0.002 * std::cos(9 * t), kRadius + 0.003 * std::cos(4 * t));
  };
  for (int i = 1; i < 2000; ++i) step(tip_down(at(i)), {(at(i) - at(i - 1)) / kPeriod, Vec3::Zero()});
}

TEST(MovingSurface, VelocitiesOfZeroChangeNothing) {
  Carried still(plane, Vec3::Zero(), false), moving(plane, Vec3::Zero(), true);
  int touching = 0;
  press_and_rub([&](const Pose& X, const Twist& V) {
    const ContactResult a = still.step(X, V), b = moving.step(X, V);
    ASSERT_EQ(a.F_I_T.force, b.F_I_T.force);
    ASSERT_EQ(a.F_I_T.moment, b.F_I_T.moment);
    touching += a.contact;
  });
  EXPECT_GT(touching, 500);
}

TEST(MovingSurface, OnlyRelativeMotionIsFelt) {
  // The proxy rests within 1e-7 m of its goal, 1.5e-5 N; friction keeps what it was off by.
  Random random(1);
  for (int trial = 0; trial < 6; ++trial) {
    const Vec3 drift = 0.1 * random.direction();
    Carried still(plane, Vec3::Zero(), false), carried(plane, drift, true), unaware(plane, drift, false);
    double worst = 0, worst_unaware = 0, most = 0;
    press_and_rub([&](const Pose& X, const Twist& V) {
      const Vec3 wanted = still.step(X, V).F_I_T.force;
      worst = std::max(worst, (carried.step(X, V).F_I_T.force - wanted).norm());
      worst_unaware = std::max(worst_unaware, (unaware.step(X, V).F_I_T.force - wanted).norm());
      most = std::max(most, wanted.norm());
    });
    EXPECT_GT(most, 0.4);
    EXPECT_LT(worst, 1e-4) << "drift " << drift.transpose();
    EXPECT_GT(worst_unaware, 2e-3) << "without velocities damping and sliding friction are another's";
  }
}

TEST(MovingSurface, DampingFollowsTheSpeedOfApproach) {
  for (const double tool : {-0.05, 0.0, 0.03}) {
    for (const double surface : {-0.04, 0.0, 0.06}) {
      const auto patch = std::make_unique<ContactPatch>();
      plane(*patch);
      patch->material[0] = {150, 0.8};
      patch->moving = true;
      ContactRenderer renderer(ContactLaw::kProxy);
      for (int i = 0; i < 20; ++i) renderer.update(tip_down({0, 0, kRadius - 1e-4 * i}), Twist{}, *patch);
      patch->velocity.fill({0.02, 0, surface});
      const ContactResult r = renderer.update(tip_down({0, 0, kRadius - 0.002}), {{0, 0, tool}, Vec3::Zero()}, *patch);
      EXPECT_NEAR(r.damping_factor, 1 + 1.5 * 0.8 * (surface - tool), 1e-9);
    }
  }
}

TEST(MovingSurface, SlidingFrictionFollowsTheSpeedOverTheSurface) {
  for (const double speed : {0.002, 0.004, 0.02}) {
    Carried scene(plane, {0.03, 0.07, 0}, true);
    const ContactMaterial& material = scene.patch->material[0];
    for (int i = 0; i < 100; ++i) scene.step(tip_down({0, 0, kRadius + 1e-3 - 3e-5 * i}), Twist{});
    ContactResult r;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p(i < 1000 ? 5e-6 * i : 5e-3 + speed * kPeriod * (i - 1000), 0, kRadius - 2e-3);
      r = scene.step(tip_down(p), {{speed, 0, 0}, Vec3::Zero()});
    }
    EXPECT_TRUE(r.slipping);
    const double ratio = speed / material.stribeck_m_s;
    const double mu = material.mu_dynamic + (material.mu_static - material.mu_dynamic) * std::exp(-ratio * ratio);
    EXPECT_NEAR(-r.F_I_T.force.x() / (150 * 2e-3), mu, 0.01 * mu) << speed << " m/s";
  }
}

TEST(MovingSurface, AToolThatRidesAlongDoesNotSlip) {
  Carried ride(plane, {0.08, 0.02, 0}, true);
  const auto ride_on = [&](double z) { return ride.step(tip_down({0, 0, z}), Twist{}); };
  for (int i = 0; i < 100; ++i) ride_on(kRadius + 1e-3 - 3e-5 * i);
  for (int i = 0; i < 300; ++i) {
    const ContactResult r = ride_on(kRadius - 2e-3);
    ASSERT_TRUE(r.contact);
    ASSERT_FALSE(r.slipping);
    ASSERT_LT(r.F_I_T.force.head<2>().norm(), 1e-6);
  }
}

/// Where tissue gives way fast the tip is off both sides for a moment. It must come to lie on both again, not slide
/// over one until the other throws it back.
TEST(MovingSurface, BetweenTwoSidesThatRecedeTheForceIsThatOfBoth) {
  constexpr double kDeep = 0.006, kSteep = 26 * std::numbers::pi / 180;
  auto patch = std::make_unique<ContactPatch>();
  patch->material[0] = {150, 0, 0, 0};
  test::add_sheet(*patch, {-0.03, -0.02, 0}, {0.03, 0, 0}, {0, 0.04, 0}, 6);
  test::add_sheet(*patch, {0, -0.02, 0}, {0.03 * std::cos(kSteep), 0, 0.03 * std::sin(kSteep)}, {0, 0.04, 0}, 6);
  const auto at_rest = patch->vertex;
  ContactRenderer renderer(ContactLaw::kProxy);
  const auto felt = [&](double sunk_m, double tip_z_m) {
    for (int i = 0; i < patch->vertex_count; ++i)
      patch->vertex[std::size_t(i)] = at_rest[std::size_t(i)] - Vec3(0, 0, sunk_m);
    ++patch->stamp;
    return renderer.update(tip_down({-0.0002, 0.0003, tip_z_m}), Twist{}, *patch).F_I_T.force;
  };
  for (double z = 0.01; z > -kDeep; z -= 5e-5) felt(0, z);
  Vec3 before = felt(0, -kDeep);
  double most = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 now = felt(0.0035 * std::sin(20 * i * kPeriod), -kDeep);  // up to 70 mm/s
    most = std::max(most, (now - before).norm());
    before = now;
  }
  EXPECT_LT(most, 3 * 150 * 0.0035 * 20 * kPeriod) << "N a period: thrice what its spring gives";
}

TEST(MovingSurface, IdsOfAnotherTopologyNameNoAnchor) {
  // Ids given anew to the same plane: the stick force goes on, held by what lies there now.
  const auto patch = std::make_unique<ContactPatch>();
  plane(*patch);
  patch->material[0] = {150, 0, 0.3, 0.3};
  ContactRenderer renderer(ContactLaw::kProxy);
  for (int i = 0; i <= 30; ++i) renderer.update(tip_down({0, 0, kRadius - 1e-4 * i}), Twist{}, *patch);
  ContactResult r;
  for (int i = 0; i <= 30; ++i) r = renderer.update(tip_down({1e-5 * i, 0, kRadius - 3e-3}), Twist{}, *patch);
  const Vec3 before = r.F_I_T.force;
  EXPECT_NEAR(before.x(), -0.8 * 150 * 3e-4, 1e-5);
  for (int i = 0; i < patch->count; ++i) patch->triangle[std::size_t(i)].id = patch->count - 1 - i;
  ++patch->stamp;
  ++patch->topology;
  for (int i = 0; i < 5; ++i) {
    r = renderer.update(tip_down({3e-4, 0, kRadius - 3e-3}), Twist{}, *patch);
    ASSERT_LT((r.F_I_T.force - before).norm(), 1e-6);
  }
}

TEST(SolvedContacts, AddUpToTheForceAndLieOnTheirTriangles) {
  const auto patch = std::make_unique<ContactPatch>();
  patch->material[0] = {150, 0.8, 0.3, 0.2};
  Random random(2);
  int several = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const bool valley = trial % 2 == 0;
    patch->clear();
    if (valley) {  // between two slopes, on both
      test::add_sheet(*patch, {0, -0.03, 0}, {0, 0.06, 0}, {-0.03, 0, 0.02}, 6);
      test::add_sheet(*patch, {0, -0.03, 0}, {0.03, 0, 0.02}, {0, 0.06, 0}, 6);
    } else {
      test::patch_near(test::lumpy_sphere(4, 0.04), {0, 0, 0.04}, 0.02, *patch);
    }
    patch->topology = std::uint64_t(trial) + 7;
    const Vec3 home(0, 0, (valley ? 0 : 0.04) + kRadius);
    const Vec3 swing = 0.004 * random.direction();
    ContactRenderer renderer(ContactLaw::kProxy);
    for (int i = 0; i < 800; ++i) {
      const double t = i * kPeriod;
      const Vec3 p = home + swing * std::sin(7 * t) + Vec3(0, 0, 0.004 * std::cos(5 * t));
      const ContactResult r = renderer.update(tip_down(p), {random.vector(0.05), random.vector(0.5)}, *patch);
      const SolvedContacts& contacts = renderer.contacts();
      ASSERT_EQ(contacts.topology, patch->topology);
      ASSERT_EQ(contacts.count > 0, r.contact);
      several += contacts.count > 1;
      Vec3 force = Vec3::Zero();
      for (int k = 0; k < contacts.count; ++k) {
        const SolvedContact& c = contacts.at[std::size_t(k)];
        force += c.force_T;
        const std::array<Vec3, 3> corners = patch->corners(c.place.triangle);  // its id is its index here
        const Vec3 place = interpolate(c.place.weight, corners);
        EXPECT_LT((place - closest_point_on_triangle(place, corners)).norm(), 1e-12);
        EXPECT_GT(c.normal_T.dot(patch->triangle[std::size_t(c.place.triangle)].normal), 0.5);
        EXPECT_LT((place - r.point_T).norm(), 2 * kRadius + 1e-3);
        EXPECT_GE(c.anchor.triangle, 0);
      }
      ASSERT_LT((force - r.F_I_T.force).norm(), 1e-14) << "N: rounding alone";
    }
  }
  EXPECT_GT(several, 100);
}

TEST(SolvedContacts, OfTheThesisLawIsOne) {
  const auto patch = std::make_unique<ContactPatch>();
  plane(*patch);
  ContactRenderer renderer(ContactLaw::kThesis);
  const ContactResult r = renderer.update(tip_down({0.001, 0.002, -0.003}), Twist{}, *patch);
  ASSERT_EQ(renderer.contacts().count, 1);
  const SolvedContact& c = renderer.contacts().at[0];
  EXPECT_EQ(c.force_T, r.F_I_T.force);
  EXPECT_LT((interpolate(c.place.weight, patch->corners(c.place.triangle)) - r.point_T).norm(), 1e-15);
  renderer.update(tip_down({0, 0, 0.003}), Twist{}, *patch);
  EXPECT_EQ(renderer.contacts().count, 0);
}

TEST(ContactPatch, WhatFindsNoRoomIsCounted) {
  const auto patch = std::make_unique<ContactPatch>();
  const std::array<Vec3, 3> apart{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  for (int i = 0; i < kMaxPatchTriangles - 1; ++i) add_triangle(*patch, apart, i);
  const std::array<std::array<int, 3>, 2> both_sides{{{0, 1, 2}, {0, 2, 1}}};
  add_surface(*patch, apart, both_sides, 1000, 0);
  EXPECT_EQ(patch->count, kMaxPatchTriangles);
  EXPECT_EQ(patch->triangle.back().id, 1000);
  EXPECT_EQ(patch->dropped, 1);
  add_surface(*patch, apart, both_sides, 2000, 0);
  EXPECT_EQ(patch->dropped, 3);
  EXPECT_LE(patch->vertex_count, kMaxPatchVertices);
}

}  // namespace
}  // namespace trocar::moving_surface_test
