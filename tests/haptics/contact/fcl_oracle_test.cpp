// An independent oracle for the capsule against a mesh: FCL on a static surface (its OBBRSS distance is exact to 1e-5 m
// while the shapes are apart; it is not used by the program).
#include <gtest/gtest.h>

#include <fcl/fcl.h>

#include "haptics/contact/segment_triangle.h"
#include "haptics/least_turn.h"
#include "tests/haptics/contact/surfaces.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::fcl_oracle_test {
namespace {

std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> fcl_mesh(const TriangleSurface& surface) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : surface.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c));
  }
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel();
  model->addSubModel(surface.vertices, triangles);
  model->endModel();
  return model;
}

/// FCL's distance between the surface and a capsule of radius r about a-b; -1 when they overlap.
double fcl_distance(const std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>& mesh, const Vec3& a, const Vec3& b, double r) {
  const auto capsule = std::make_shared<fcl::Capsuled>(r, (b - a).norm());  // length without the caps
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = least_turn(Vec3::UnitZ(), b - a).toRotationMatrix();
  X.translation() = (a + b) / 2;
  const fcl::CollisionObjectd surface(mesh), tool(capsule, X);
  const fcl::DistanceRequestd request(false, false, 0, 0, 1e-9, fcl::GST_LIBCCD);
  fcl::DistanceResultd result;
  return fcl::distance(&surface, &tool, request, result);
}

double our_distance(const TriangleSurface& s, const Vec3& a, const Vec3& b) {
  double best = 1e9;
  for (const auto& [i, j, k] : s.triangles) {
    const auto& v = s.vertices;
    best = std::min(best,
                    closest_segment_triangle(a, b, {v[std::size_t(i)], v[std::size_t(j)], v[std::size_t(k)]}).distance);
  }
  return best;
}

TEST(FclOracle, CapsuleDistanceFromAStaticMeshAgrees) {
  // Millimetres as the unit for FCL's sake: its convergence tolerance is absolute.
  const TriangleSurface surface = test::lumpy_sphere(3, 40.0);
  const auto mesh = fcl_mesh(surface);
  test::Random random(1);
  constexpr double r = 2.5;
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 150; ++k) {
    const Vec3 a = random.direction() * random.between(38, 80), b = a + random.direction() * random.between(5, 60);
    const double ours = our_distance(surface, a, b) - r, theirs = fcl_distance(mesh, a, b, r);
    if (ours > 0.01) {
      ++apart;
      EXPECT_NEAR(theirs, ours, 0.01) << "1e-5 m, FCL's own accuracy";
    } else if (ours < -0.01) {
      ++overlapping;
      EXPECT_LT(theirs, 0.01) << "FCL says overlap";
    }
  }
  EXPECT_GT(apart, 40);
  EXPECT_GT(overlapping, 20);
}

}  // namespace
}  // namespace trocar::fcl_oracle_test
