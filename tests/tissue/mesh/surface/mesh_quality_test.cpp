#include "tissue/mesh/surface/mesh_quality.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/shapes.h"
#include "tissue/mesh/surface/edge_sizes.h"
#include "tissue/mesh/surface/mesh_facts.h"
#include "tissue/mesh/surface/nearest_surface.h"

namespace trocar::mesh_quality_test {
namespace {

TEST(MeshQuality, BoxOfKnownAnglesAndEdges) {
  const MeshQuality q = mesh_quality(test::box(Vec3::Zero(), Vec3::Ones()));
  EXPECT_NEAR(q.min_angle_deg, 45, 1e-9);
  EXPECT_NEAR(q.p01_angle_deg, 45, 1e-9);
  EXPECT_EQ(q.share_above_15, 1);
  EXPECT_NEAR(q.edge_min_m, 1, 1e-12);
  EXPECT_NEAR(q.edge_median_m, 1, 1e-12);
  EXPECT_NEAR(q.edge_max_m, std::sqrt(2.0), 1e-12);
}

TEST(MeshQuality, SlenderAndFlatTrianglesAreSeen) {
  TriangleSurface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.05, 0}, {2, 0, 0}};
  surface.triangles = {{0, 1, 2}, {0, 1, 3}};
  const auto angles = smallest_angles_deg(surface);
  EXPECT_NEAR(angles[0], std::atan2(0.05, 0.5) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(angles[1], 0);
  EXPECT_EQ(mesh_quality(surface).share_above_15, 0);
  EXPECT_EQ(mesh_quality({}).share_above_15, 0);
}

TEST(MeshQuality, HausdorffIsTheLargerWayAndCountsInVoxels) {
  MeshFacts facts;
  facts.distance.max_m = 0.002, facts.distance_back.max_m = 0.003;
  EXPECT_FALSE(facts.hausdorff_voxels().has_value());
  facts.voxel_m = 0.0015;
  EXPECT_NEAR(*facts.hausdorff_voxels(), 2, 1e-12);
}

TEST(SurfaceDistance, RootMeanSquareOfParallelFacesIsTheirDistance) {
  const SurfaceDistance d = distance_from_to(test::sphere(Vec3::Zero(), 1, 5), test::sphere(Vec3::Zero(), 1.1, 5));
  EXPECT_NEAR(d.rms_m, 0.1, 1e-3);
  EXPECT_GE(d.rms_m, d.mean_m);
}

/// A long drop: round caps of radius 5 mm on a cylinder that is 80 mm across would be flat against it.
TriangleSurface ellipsoid(const Vec3& axes) {
  TriangleSurface surface = test::sphere(Vec3::Zero(), 1, 6);
  for (Vec3& vertex : surface.vertices) vertex = vertex.cwiseProduct(axes);
  return surface;
}

TEST(EdgeSizes, AreShorterWhereTheSurfaceBends) {
  const TriangleSurface lens = ellipsoid({0.06, 0.06, 0.015});
  EdgeSizeOptions options;
  options.triangles = 1000;
  const auto sizes = edge_sizes(lens, options);
  double rim = 1, pole = 0;
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    if (std::abs(lens.vertices[v].z()) < 0.0005) rim = std::min(rim, sizes[v]);
    if (lens.vertices[v].head<2>().norm() < 0.005) pole = std::max(pole, sizes[v]);
  }
  EXPECT_GT(pole, 1.5 * rim);
}

TEST(EdgeSizes, AskForTheWantedCountAndGrowSlowly) {
  const TriangleSurface lens = ellipsoid({0.05, 0.03, 0.02});
  EdgeSizeOptions options;
  options.triangles = 800;
  const auto sizes = edge_sizes(lens, options);
  double count = 0;
  for (const auto& [a, b, c] : lens.triangles) {
    const auto at = [&](int v) -> const Vec3& { return lens.vertices[static_cast<std::size_t>(v)]; };
    const double area = (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
    for (const int v : {a, b, c}) {
      const double s = sizes[static_cast<std::size_t>(v)];
      count += area / 3 / (std::sqrt(3.0) / 4 * s * s);
    }
    EXPECT_LT(std::abs(sizes[static_cast<std::size_t>(a)] - sizes[static_cast<std::size_t>(b)]),
              0.3 * (at(a) - at(b)).norm() * 1.5);
  }
  EXPECT_NEAR(count, 800, 8);
  EXPECT_TRUE(edge_sizes({}, options).empty());
}

TEST(NearestSurface, FindsPlaceNormalAndTriangle) {
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3::Ones());
  const NearestSurface nearest(box);
  const auto hit = nearest.nearest({0.3, 0.4, 1.5});
  EXPECT_LT((hit.place - Vec3(0.3, 0.4, 1)).norm(), 1e-12);
  EXPECT_GT(hit.normal.z(), 0.9);
  EXPECT_LT(hit.triangle, 12U);
  EXPECT_THROW(NearestSurface({}), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::mesh_quality_test
