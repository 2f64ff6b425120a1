// A ring on a wire against what a straight wire gives in closed form: force, direction, energy.
#include "haptics/contact/ring_contact.h"

#include <random>

#include <gtest/gtest.h>

#include "haptics/contact/contact_renderer.h"

namespace trocar::ring_contact_test {
namespace {

constexpr double kStiffness = 250, kPlay = 0.004;

/// Along x through the origin, in points of a millimetre; the ring's normal is x of I, its centre ahead of the tip.
RingOnWire straight() {
  RingOnWire ring;
  ring.count = RingOnWire::kMostPoints;
  for (int i = 0; i < ring.count; ++i) ring.point_T[static_cast<std::size_t>(i)] = Vec3(0.001 * (i - 16), 0, 0);
  ring.centre_I = Vec3(0, 0, 0.006);
  ring.play_m = kPlay;
  ring.stiffness_n_per_m = kStiffness;
  ring.damping_s_per_m = 0.5;
  return ring;
}

Pose centred_at(const RingOnWire& ring, const Vec3& centre_T, const Mat3& R = Mat3::Identity()) {
  return {R, centre_T - R * ring.centre_I};
}

TEST(RingContact, NothingWithinThePlay) {
  const RingOnWire ring = straight();
  EXPECT_LE(touch_ring(ring, centred_at(ring, {0, 0.999 * kPlay, 0}), {}).depth_m, 0);
  EXPECT_LE(touch_ring(ring, centred_at(ring, {0.2, 0.01, 0}), {}).depth_m, 0) << "beyond the end of the wire";
}

TEST(RingContact, PushesBackToTheMiddleByDepthTimesStiffness) {
  const RingOnWire ring = straight();
  const Vec3 aside = Vec3(0, 0.6, -0.8) * (kPlay + 0.002);
  const RingTouch touch = touch_ring(ring, centred_at(ring, aside + Vec3(0.0003, 0, 0)), {});
  EXPECT_NEAR(touch.depth_m, 0.002, 1e-12);
  EXPECT_LT((touch.spring_I_T.force - kStiffness * 0.002 * Vec3(0, -0.6, 0.8)).norm(), 1e-9);
  EXPECT_NEAR(touch.stored_j, 0.5 * kStiffness * 0.002 * 0.002, 1e-12);
}

TEST(RingContact, IsTheSlopeOfItsEnergyAndPullsNeverAlongTheWire) {
  const RingOnWire ring = straight();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int n = 0; n < 200; ++n) {
    const Mat3 R =
        (Eigen::AngleAxisd(0.6 * part(random), Vec3::UnitY()) * Eigen::AngleAxisd(0.6 * part(random), Vec3::UnitZ()))
            .toRotationMatrix();
    const Vec3 way(0, part(random), part(random));
    const Pose X = centred_at(ring, way.normalized() * (kPlay + 0.003), R);
    const RingTouch touch = touch_ring(ring, X, {});
    ASSERT_GT(touch.depth_m, 0);
    EXPECT_NEAR(touch.spring_I_T.force.x(), 0, 1e-9);
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 unit = Vec3::Unit(axis);
      const auto energy = [&](const Pose& at) { return touch_ring(ring, at, {}).stored_j; };
      const double by_shift = (energy({X.R, X.p + kStep * unit}) - energy({X.R, X.p - kStep * unit})) / (2 * kStep);
      EXPECT_NEAR(touch.spring_I_T.force.dot(unit), -by_shift, 1e-6);
      const auto turned = [&](double angle) {
        return energy({Eigen::AngleAxisd(angle, unit).toRotationMatrix() * X.R, X.p});
      };
      EXPECT_NEAR(touch.spring_I_T.moment.dot(unit), -(turned(kStep) - turned(-kStep)) / (2 * kStep), 1e-7);
    }
  }
}

TEST(RingContact, DampingOpposesAndNeverPulls) {
  const RingOnWire ring = straight();
  const Pose X = centred_at(ring, {0, kPlay + 0.002, 0});
  EXPECT_NEAR(touch_ring(ring, X, {Vec3(0, 0.1, 0), Vec3::Zero()}).damping_factor, 1 + 1.5 * 0.5 * 0.1, 1e-12);
  EXPECT_EQ(touch_ring(ring, X, {Vec3(0, -9, 0), Vec3::Zero()}).damping_factor, 0);
}

TEST(RingContact, StaysBoundedWhereTheRingLiesAlongTheWire) {
  const RingOnWire ring = straight();
  for (int degree = 0; degree <= 90; ++degree) {
    const Mat3 R = Eigen::AngleAxisd(degree * M_PI / 180, Vec3::UnitZ()).toRotationMatrix();
    const RingTouch touch = touch_ring(ring, centred_at(ring, {0, 0.002, kPlay}, R), {});
    EXPECT_LE(touch.spring_I_T.force.norm(), kStiffness * 0.02 / 0.6) << degree;
  }
}

TEST(RingContact, IsFeltThroughTheRenderer) {
  ContactPatch patch;
  patch.stamp = 1;
  patch.ring = straight();
  ContactRenderer renderer(ContactLaw::kProxy);
  const ContactResult result = renderer.update(centred_at(patch.ring, {0, 0, kPlay + 0.001}), {}, patch);
  EXPECT_TRUE(result.contact && result.tip_contact);
  EXPECT_NEAR(result.F_I_T.force.z(), -kStiffness * 0.001, 1e-9);
  EXPECT_NEAR(result.depth_m, 0.001, 1e-12);
  patch.clear();
  EXPECT_FALSE(renderer.update(centred_at(straight(), {0, 0, kPlay + 0.001}), {}, patch).contact);
}

}  // namespace
}  // namespace trocar::ring_contact_test
