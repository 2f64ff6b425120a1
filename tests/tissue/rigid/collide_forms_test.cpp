// Contacts of boxes, capsules and cylinders in positions where depth, place and normal are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tissue/rigid/collide.h"

namespace trocar::collide_forms_test {
namespace {

constexpr double kFine = 5e-6;  // m: FCL's distances
const Vec3 kHalf(0.01, 0.02, 0.03);

BoxShape box_at(const Vec3& centre, const Mat3& R = Mat3::Identity()) { return {{R, centre}, kHalf}; }

double deepest(const RigidContacts& contacts) {
  double depth = 0;
  for (int c = 0; c < contacts.count; ++c) depth = std::max(depth, contacts.at[std::size_t(c)].depth_m);
  return depth;
}

TEST(BoxShape, CornersRunThroughTheSignsXFirst) {
  const BoxShape box = box_at(Vec3(1, 2, 3), Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix());
  EXPECT_LT((box.corner(0) - Vec3(1.02, 1.99, 2.97)).norm(), 1e-12);
  EXPECT_LT((box.corner(1) - box.corner(0) - Vec3(0, 0.02, 0)).norm(), 1e-12);
  EXPECT_LT((box.corner(2) - box.corner(0) - Vec3(-0.04, 0, 0)).norm(), 1e-12);
  EXPECT_LT((box.corner(4) - box.corner(0) - Vec3(0, 0, 0.06)).norm(), 1e-12);
  EXPECT_LT((box.corner(7) + box.corner(0) - 2 * Vec3(1, 2, 3)).norm(), 1e-12);
}

TEST(RigidContacts, HoldsEightAndNoMore) {
  RigidContacts contacts;
  for (int i = 0; i < 12; ++i) contacts.add({Vec3(i, 0, 0), Vec3::UnitZ(), 0.1 * i});
  EXPECT_EQ(contacts.count, RigidContacts::kMost);
  EXPECT_EQ(contacts.at[7].point_T.x(), 7);
}

TEST(BoxPlane, EachCornerBelowHasItsOwnDepth) {
  EXPECT_EQ(box_plane(box_at(Vec3(0, 0, 0.0301)), 0).count, 0);
  EXPECT_EQ(box_plane(box_at(Vec3(0, 0, 0.0301)), 0.001).count, 4);
  EXPECT_EQ(box_plane(box_at(Vec3(0, 0, -0.2)), 0).count, 8) << "all of it";
  const double tilt = 0.1;
  const Mat3 R = Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix();
  const double lowest = kHalf.x() * std::sin(tilt) + kHalf.z() * std::cos(tilt);
  const RigidContacts edge = box_plane(box_at(Vec3(0, 0, lowest - 1e-4), R), 0);
  ASSERT_EQ(edge.count, 2) << "it stands on one edge";
  for (int c = 0; c < 2; ++c) {
    const RigidContact& contact = edge.at[std::size_t(c)];
    EXPECT_NEAR(contact.depth_m, 1e-4, 1e-12);
    EXPECT_EQ(contact.normal_T, Vec3::UnitZ());
    EXPECT_NEAR(std::abs(contact.point_T.y()), kHalf.y(), 1e-12);
  }
}

TEST(CapsulePlane, TouchesWithTheEndsThatAreLowEnough) {
  const CapsuleShape lying{Vec3(0, 0, 0.004), Vec3(0.1, 0, 0.004), 0.005};
  const RigidContacts both = capsule_plane(lying, 0);
  ASSERT_EQ(both.count, 2);
  EXPECT_NEAR(both.at[0].depth_m, 0.001, 1e-15);
  EXPECT_NEAR(both.at[1].depth_m, 0.001, 1e-15);
  const CapsuleShape leaning{Vec3(0, 0, 0.004), Vec3(0.1, 0, 0.050), 0.005};
  ASSERT_EQ(capsule_plane(leaning, 0).count, 1);
  EXPECT_NEAR(capsule_plane(leaning, 0).at[0].point_T.x(), 0, 1e-12);
  EXPECT_EQ(capsule_plane(lying, -0.002).count, 0);
}

TEST(AxisDistance, IsThatToFaceEdgeAndCorner) {
  const BoxShape box = box_at(Vec3::Zero());
  const Vec3 far(0, 0, 1);
  const auto distance = [&](const Vec3& from, const Vec3& to) { return axis_distance({from, to, 0.002}, box); };
  EXPECT_NEAR(distance(Vec3(0.015, 0, -0.01), Vec3(0.015, 0, 0.01)), 0.005, kFine) << "beside a face";
  EXPECT_NEAR(distance(Vec3(0.013, 0.024, -0.01), Vec3(0.013, 0.024, 0.01)), 0.005, kFine) << "along an edge";
  EXPECT_NEAR(distance(Vec3(0.012, 0.021, 0.032), Vec3(0.012, 0.021, 0.032) + far), 0.003, kFine) << "off a corner";
  EXPECT_LE(distance(Vec3(0, 0, -0.1), Vec3(0, 0, 0.1)), 0) << "through it";
}

TEST(CapsuleBox, OverlapIsRadiusLessDistanceAndTheNormalPointsToTheCapsule) {
  const BoxShape box = box_at(Vec3(0.2, 0, 0));
  for (const double overlap : {0.0002, 0.001, 0.003}) {
    const double x = 0.2 + kHalf.x() + 0.005 - overlap;
    const RigidContacts touch = capsule_box({Vec3(x, 0, -0.01), Vec3(x, 0, 0.01), 0.005}, box);
    ASSERT_EQ(touch.count, 1);
    EXPECT_NEAR(touch.at[0].depth_m, overlap, kFine);
    EXPECT_NEAR(touch.at[0].normal_T.x(), 1, 1e-3);
  }
  EXPECT_EQ(capsule_box({Vec3(0.2151, 0, 0), Vec3(0.3, 0, 0), 0.005}, box).count, 0);
}

TEST(BoxBox, FacesOverlapByTheirDepthAndChangingPlacesTurnsTheNormal) {
  const BoxShape a = box_at(Vec3::Zero()), b = box_at(Vec3(0.0195, 0, 0));
  const RigidContacts there = box_box(a, b), back = box_box(b, a);
  ASSERT_GT(there.count, 0);
  ASSERT_GT(back.count, 0);
  EXPECT_NEAR(deepest(there), 0.0005, kFine);
  EXPECT_NEAR(deepest(back), 0.0005, kFine);
  EXPECT_NEAR(there.at[0].normal_T.x(), -1, 1e-6);
  EXPECT_NEAR(back.at[0].normal_T.x(), 1, 1e-6);
  EXPECT_EQ(box_box(a, box_at(Vec3(0.0205, 0, 0))).count, 0);
  EXPECT_EQ(box_box(a, box_at(Vec3(0.015, 0.041, 0))).count, 0) << "apart along one axis is apart";
}

TEST(BoxCylinder, MeetsTheTubeThroughItsWallAndNotBeyondItsEnds) {
  const CylinderShape tube{Vec3::Zero(), Vec3::UnitZ(), 0.006, 0.020};
  EXPECT_GT(box_cylinder(box_at(Vec3(0.015, 0, 0)), tube).count, 0) << "1 mm into the wall";
  EXPECT_EQ(box_cylinder(box_at(Vec3(0.017, 0, 0)), tube).count, 0) << "1 mm beside it";
  EXPECT_GT(box_cylinder(box_at(Vec3(0, 0, 0.039)), tube).count, 0) << "1 mm into its end";
  EXPECT_EQ(box_cylinder(box_at(Vec3(0, 0, 0.041)), tube).count, 0);
  const CylinderShape lying{Vec3::Zero(), Vec3::UnitX(), 0.006, 0.020};
  EXPECT_GT(box_cylinder(box_at(Vec3(0.019, 0, 0)), lying).count, 0) << "its axis counts";
  EXPECT_EQ(box_cylinder(box_at(Vec3(0, 0, 0.039)), lying).count, 0);
}

}  // namespace
}  // namespace trocar::collide_forms_test
