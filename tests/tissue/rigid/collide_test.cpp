// Rigid primitives against oracles of our own: a box's distance function, minimised along the capsule's axis by golden
// sections, and support functions along the separating axes of two boxes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/haptics/contact/surfaces.h"
#include "tissue/rigid/collide.h"

namespace trocar::collide_test {
namespace {

using test::Random;

Mat3 any_rotation(Random& random) {
  return Eigen::AngleAxisd(random.between(-3, 3), random.vector(1).normalized()).toRotationMatrix();
}

double point_box(const BoxShape& box, const Vec3& point_T) {
  const Vec3 outside = (box.X_TB.inverse() * point_T).cwiseAbs() - box.half;
  return outside.cwiseMax(0.0).norm();
}

/// The distance is convex along the segment: ternary search.
double segment_box(const CapsuleShape& capsule, const BoxShape& box) {
  double low = 0, high = 1;
  const auto at = [&](double s) { return point_box(box, capsule.from_T + s * (capsule.to_T - capsule.from_T)); };
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return at(low);
}

double half_width(const BoxShape& box, const Vec3& axis) {
  return (box.X_TB.R.transpose() * axis).cwiseAbs().dot(box.half);
}

/// Overlap of two boxes along the best of the 15 separating axes; negative: apart.
double overlap_of(const BoxShape& a, const BoxShape& b) {
  std::vector<Vec3> axes;
  for (int i = 0; i < 3; ++i) axes.push_back(a.X_TB.R.col(i));
  for (int i = 0; i < 3; ++i) axes.push_back(b.X_TB.R.col(i));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) axes.push_back(a.X_TB.R.col(i).cross(b.X_TB.R.col(j)));
  double least = 1e9;
  for (const Vec3& axis : axes) {
    if (axis.norm() < 1e-6) continue;
    const Vec3 n = axis.normalized();
    least = std::min(least, half_width(a, n) + half_width(b, n) - std::abs(n.dot(a.X_TB.p - b.X_TB.p)));
  }
  return least;
}

const Vec3 kHalf(0.007, 0.007, 0.010);

TEST(Collide, DistanceOfACapsulesAxisFromABoxAgreesWithTheOracle) {
  Random random(4);
  int judged = 0;
  for (int k = 0; k < 4000; ++k) {
    const BoxShape box{{any_rotation(random), random.vector(0.03)}, kHalf};
    const Vec3 from = random.vector(0.04);
    const Vec3 to = k % 7 == 0 ? from : Vec3(from + random.vector(k % 2 ? 0.02 : 0.3));
    const double wanted = segment_box({from, to, 0.0025}, box);
    if (wanted < 3e-4) continue;  // the thread that stands for the axis touches
    EXPECT_NEAR(axis_distance({from, to, 0.0025}, box), wanted, 5e-6) << "FCL's tolerance";
    ++judged;
  }
  EXPECT_GT(judged, 2000);
}

TEST(Collide, CapsuleAgainstBoxGivesDepthAndANormalThatFreesIt) {
  Random random(5);
  int touching = 0;
  for (int k = 0; k < 4000; ++k) {
    const BoxShape box{{any_rotation(random), random.vector(0.01)}, kHalf};
    const Vec3 from = random.vector(0.03);
    CapsuleShape capsule{from, from + random.vector(0.05), 0.0025};
    const double distance = segment_box(capsule, box);
    const RigidContacts found = capsule_box(capsule, box);
    if (std::abs(distance - capsule.radius_m) > 5e-6) {
      ASSERT_EQ(found.count, distance < capsule.radius_m ? 1 : 0) << distance;
    }
    if (found.count == 0 || distance < 3e-4) continue;
    ++touching;
    EXPECT_NEAR(found.at[0].depth_m, capsule.radius_m - distance, 5e-6);
    const Vec3 out = found.at[0].normal_T * (found.at[0].depth_m + 1e-5);
    EXPECT_NEAR(segment_box({capsule.from_T + out, capsule.to_T + out, 0}, box), capsule.radius_m + 1e-5, 1e-4)
        << "the axis leaves along the normal; it may meet another edge on its way";
  }
  EXPECT_GT(touching, 100);
}

TEST(Collide, ACapsuleWhoseAxisEntersIsPushedOut) {
  const BoxShape box{{Mat3::Identity(), Vec3::Zero()}, kHalf};
  const RigidContacts found = capsule_box({Vec3(0.0065, 0, -0.05), Vec3(0.0065, 0, 0.05), 0.002}, box);
  ASSERT_EQ(found.count, 1);
  EXPECT_GT(found.at[0].normal_T.x(), 0.99);
  EXPECT_NEAR(found.at[0].depth_m, 0.0025, 2e-4) << "half a millimetre of axis and the radius, within the thread";
}

TEST(Collide, BoxAgainstBoxAgreesWithSeparatingAxes) {
  Random random(6);
  int touching = 0, apart = 0;
  for (int k = 0; k < 3000; ++k) {
    const BoxShape a{{any_rotation(random), random.vector(0.01)}, kHalf};
    const BoxShape b{{any_rotation(random), random.vector(0.02)}, kHalf};
    const double overlap = overlap_of(a, b);
    if (std::abs(overlap) < 1e-6) continue;
    const RigidContacts found = box_box(a, b);
    ASSERT_EQ(found.count > 0, overlap > 0) << overlap;
    (overlap > 0 ? touching : apart)++;
    double deepest = 0;
    for (int c = 0; c < found.count; ++c) {
      deepest = std::max(deepest, found.at[std::size_t(c)].depth_m);
      EXPECT_NEAR(found.at[std::size_t(c)].normal_T.norm(), 1, 1e-9);
    }
    // The solver prefers a face to an edge that is up to 5 % better.
    if (found.count == 0) continue;
    EXPECT_GE(deepest, overlap - 1e-6);
    EXPECT_LE(deepest, overlap * 1.06 + 1e-4);
  }
  EXPECT_GT(touching, 300);
  EXPECT_GT(apart, 300);
}

TEST(Collide, NormalsPointFromTheSecondToTheFirst) {
  const BoxShape low{{Mat3::Identity(), Vec3::Zero()}, kHalf};
  const BoxShape high{{Mat3::Identity(), Vec3(0.001, 0, 0.0199)}, kHalf};
  const RigidContacts stacked = box_box(high, low);
  ASSERT_EQ(stacked.count, 4) << "a face on a face rests on four points";
  for (int c = 0; c < 4; ++c) {
    EXPECT_NEAR(stacked.at[std::size_t(c)].normal_T.z(), 1, 1e-12);
    EXPECT_NEAR(stacked.at[std::size_t(c)].depth_m, 1e-4, 1e-9);
  }
  const RigidContacts capsule = capsule_box({Vec3(0, 0, 0.012), Vec3(0, 0, 0.1), 0.0025}, low);
  ASSERT_EQ(capsule.count, 1);
  EXPECT_NEAR(capsule.at[0].normal_T.z(), 1, 1e-6);
}

TEST(Collide, AStandingBoxTouchesThePlaneWithFourCorners) {
  const BoxShape box{{Mat3::Identity(), Vec3(0.01, 0.02, 0.0099)}, kHalf};
  const RigidContacts found = box_plane(box, 0);
  ASSERT_EQ(found.count, 4);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(found.at[std::size_t(c)].depth_m, 1e-4, 1e-12);
  EXPECT_EQ(box_plane({{Mat3::Identity(), Vec3(0, 0, 0.0101)}, kHalf}, 0).count, 0);
  const BoxShape edge{{Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix(), Vec3(0, 0, 0.0110)}, kHalf};
  EXPECT_EQ(box_plane(edge, 0).count, 2) << "tilted, it stands on an edge";
}

TEST(Collide, CapsuleOnPlaneAndBoxInCylinderByHand) {
  const RigidContacts lying = capsule_plane({Vec3(0, 0, 0.002), Vec3(0.1, 0, 0.002), 0.0025}, 0);
  ASSERT_EQ(lying.count, 2);
  EXPECT_NEAR(lying.at[0].depth_m, 0.0005, 1e-12);
  EXPECT_EQ(capsule_plane({Vec3(0, 0, 0.0026), Vec3(0, 0, 0.1), 0.0025}, 0).count, 0);
  const CylinderShape port{Vec3(0, 0, 0.12), Vec3(0, 0, 1), 0.006, 0.020};
  EXPECT_GT(box_cylinder({{Mat3::Identity(), Vec3(0, 0, 0.101)}, kHalf}, port).count, 0);
  EXPECT_EQ(box_cylinder({{Mat3::Identity(), Vec3(0, 0, 0.0995)}, kHalf}, port).count, 0);
  EXPECT_EQ(box_cylinder({{Mat3::Identity(), Vec3(0.0132, 0, 0.12)}, kHalf}, port).count, 0);
  EXPECT_GT(box_cylinder({{Mat3::Identity(), Vec3(0.0128, 0, 0.12)}, kHalf}, port).count, 0);
}

}  // namespace
}  // namespace trocar::collide_test
