#include "tissue/mesh/surface/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tissue/mesh/surface/surface_check.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::isosurface_test {
namespace {

template <typename Function>
ScalarField sampled(int extent, Function value) {
  ScalarField field{{extent, extent, extent}, {}};
  for (int k = 0; k < extent; ++k)
    for (int j = 0; j < extent; ++j)
      for (int i = 0; i < extent; ++i) field.values.push_back(static_cast<float>(value(Vec3(i, j, k))));
  return field;
}

TEST(Isosurface, OfABallHasItsVolumeAreaAndPlace) {
  const Vec3 centre(15.2, 14.7, 15.9);
  const ScalarField field = sampled(32, [&](const Vec3& p) { return -(p - centre).norm(); });
  const TriangleSurface surface = isosurface(field, Vec3(0.002, 0.002, 0.002), -11);
  const double radius = 11 * 0.002;
  // Flat triangles of one voxel on a radius of eleven: chord error about (1/11)^2 / 8 of the radius.
  EXPECT_NEAR(surface.volume_m3() / (4.0 / 3 * std::numbers::pi * std::pow(radius, 3)), 1, 0.01);
  EXPECT_NEAR(surface_area_m2(surface) / (4 * std::numbers::pi * radius * radius), 1, 0.01);
  EXPECT_LT((volume_centroid_m(surface) - centre * 0.002).norm(), 2e-5);
  const SurfaceTopology facts = analyse_topology(surface);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.genus, 0);
  EXPECT_EQ(facts.components, 1U);
}

TEST(Isosurface, OfATorusHasGenusOne) {
  const ScalarField field = sampled(32, [](const Vec3& p) {
    const Vec3 q = p - Vec3::Constant(15.5);
    return -std::hypot(std::hypot(q.x(), q.y()) - 8, q.z());
  });
  const SurfaceTopology facts = analyse_topology(isosurface(field, Vec3::Ones(), -3.3));
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.genus, 1);
}

TEST(Isosurface, UsesTheSpacingOfEachAxis) {
  const ScalarField field = sampled(20, [](const Vec3& p) { return -(p - Vec3::Constant(9.5)).norm(); });
  const Vec3 extent = isosurface(field, Vec3(1, 2, 0.5), -6).bounds().sizes();
  EXPECT_NEAR(extent.x(), 12, 0.1);
  EXPECT_NEAR(extent.y(), 24, 0.2);
  EXPECT_NEAR(extent.z(), 6, 0.05);
}

// The hard case: white noise holds every pattern of inside corners, and samples equal to the level.
TEST(Isosurface, OfNoiseIsAlwaysAClosedManifoldWithoutSelfIntersections) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 5; ++round) {
    ScalarField field = sampled(12, [&](const Vec3& p) {
      const bool border = p.minCoeff() == 0 || p.maxCoeff() == 11;
      return border ? 0.0 : static_cast<double>(random() % 5) / 4;
    });
    const TriangleSurface surface = isosurface(field, Vec3::Ones(), 0.5);
    const SurfaceTopology facts = analyse_topology(surface);
    EXPECT_TRUE(facts.closed());
    EXPECT_EQ(facts.nonmanifold_edges, 0U);
    EXPECT_EQ(facts.misoriented_edges, 0U);
    EXPECT_EQ(facts.nonmanifold_vertices, 0U);
    EXPECT_EQ(count_self_intersections(surface), 0U);
    EXPECT_GT(surface.volume_m3(), 0);
  }
}

TEST(Isosurface, RefusesAFieldThatIsCutByItsGrid) {
  const ScalarField field = sampled(5, [](const Vec3&) { return 1.0; });
  EXPECT_THROW(isosurface(field, Vec3::Ones(), 0.5), std::invalid_argument);
  EXPECT_TRUE(isosurface(field, Vec3::Ones(), 2).triangles.empty());
}

}  // namespace
}  // namespace trocar::isosurface_test
