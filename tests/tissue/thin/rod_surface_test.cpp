// The tube round a rod: closed and manifold whatever happens to the rod, and its numbers stay.
#include "tissue/thin/rod_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/tissue/thin/rod_rig.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::rod_surface_test {
namespace {

void expect_tubes(const TriangleSurface& surface, std::size_t count) {
  const SurfaceTopology facts = analyse_topology(surface);
  EXPECT_TRUE(facts.closed());
  EXPECT_TRUE(facts.manifold());
  EXPECT_EQ(facts.components, count);
  EXPECT_EQ(facts.genus, 0);
  EXPECT_EQ(facts.vertices, surface.vertices.size()) << "every vertex is used";
}

TEST(RodSurface, IsAClosedTubeOfTheRodsVolume) {
  ElasticRod rod = test::hung_duct();
  RodSurface tube(rod, 12);
  expect_tubes(*tube.surface(), 1);
  const double round = 12 / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi / 12);  // of a 12-gon's area
  EXPECT_NEAR(tube.surface()->volume_m3(), round * std::numbers::pi * 1.5e-3 * 1.5e-3 * 0.04, 1e-12);
  EXPECT_TRUE(tube.added().empty());
}

TEST(RodSurface, ACutKeepsNumbersAndAddsTheRest) {
  ElasticRod rod = test::hung_duct();
  RodSurface tube(rod, 12);
  const SurfacePtr before = tube.surface();
  rod.sever(0.0203);
  rod.sever(0.0207);
  tube.follow(rod);
  expect_tubes(*tube.surface(), 3);
  EXPECT_NE(tube.surface()->topology, before->topology);
  EXPECT_EQ(tube.added().size(), 4u * 13u);
  EXPECT_EQ(tube.surface()->vertices.size(), before->vertices.size() + tube.added().size());
  EXPECT_GT(tube.surface()->triangles.size(), before->triangles.size());
  for (std::size_t v = 0; v < before->vertices.size(); ++v)
    EXPECT_LT((tube.surface()->vertices[v] - before->vertices[v]).norm(), 1e-9);
  // Old triangles keep at least the corners on their own ring: all of them outside the strip that was cut.
  std::size_t changed = 0;
  for (std::size_t t = 0; t < before->triangles.size(); ++t)
    changed += tube.surface()->triangles[t] != before->triangles[t];
  EXPECT_EQ(changed, 24u);
  // What is carried over by the growth lies where the new vertices are.
  std::vector<Vec3> places = before->vertices;
  for (std::size_t i = 0; i < tube.added().size(); ++i) {
    const VertexOrigin& origin = tube.added()[i];
    ASSERT_LT(origin.from, static_cast<std::int32_t>(places.size()));
    ASSERT_LT(origin.to, static_cast<std::int32_t>(places.size()));
    const Vec3 from = places[static_cast<std::size_t>(origin.from)], to = places[static_cast<std::size_t>(origin.to)];
    places.emplace_back(from + origin.share * (to - from));
    EXPECT_LT((places.back() - tube.surface()->vertices[places.size() - 1]).norm(), 1e-6) << i;
    EXPECT_LT((places.back() - surface_at_rest(tube.surface())->vertices[places.size() - 1]).norm(), 1e-6) << i;
  }
  tube.follow(rod);
  EXPECT_TRUE(tube.added().empty());
}

TEST(RodSurface, StaysClosedThroughRandomCutsInRandomBatches) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> arc(0, test::kDuctLength);
    ElasticRod rod = test::hung_duct();
    RodSurface tube(rod, 10);
    for (int i = 0; i < 12; ++i) {
      rod.sever(arc(random));
      rod.step();
      if (i % 3 == 2) tube.follow(rod);
    }
    tube.follow(rod);
    const SurfaceTopology facts = analyse_topology(*tube.surface());
    EXPECT_TRUE(facts.closed() && facts.manifold()) << seed;
    EXPECT_EQ(facts.components, rod.parts().size());
  }
}

TEST(RodSurface, FollowsATurnedRodWithoutATwist) {
  std::vector<Vec3> helix;
  for (int i = 0; i <= 60; ++i) helix.push_back({0.01 * std::cos(0.2 * i), 0.01 * std::sin(0.2 * i), 0.0008 * i});
  RodOptions options;
  options.outer_radius_m = 0.001;
  options.wall_m = 0.0004;
  ElasticRod rod(helix, options);
  RodSurface tube(rod, 12);
  expect_tubes(*tube.surface(), 1);
  // Edges along the rod: vertex k of one ring to vertex k of the next, never round the tube.
  for (std::size_t i = 0; i + 1 < helix.size(); ++i)
    for (std::size_t k = 0; k < 12; ++k) {
      const Vec3 a = tube.surface()->vertices[12 * i + k] - helix[i];
      const Vec3 b = tube.surface()->vertices[12 * (i + 1) + k] - helix[i + 1];
      EXPECT_GT(a.normalized().dot(b.normalized()), std::cos(0.35));
    }
}

TEST(RodSurface, IsFlatWhereItIsClipped) {
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  lumen.clip(0.0195, 0.0205, 1, 39997, 0.5);
  RodSurface tube(rod, 12);
  tube.follow(rod, &lumen);
  const auto reach = [&](std::size_t node, double angle) {
    const Mat3 R = rod.frame_at(0.02);
    const Vec3 way = std::cos(angle) * R.col(0) + std::sin(angle) * R.col(1);
    double most = 0;
    for (std::size_t k = 0; k < 12; ++k)
      most = std::max(most, way.dot(tube.surface()->vertices[12 * node + k] - rod.nodes()[node].position));
    return most;
  };
  EXPECT_NEAR(reach(20, 0.5), rod.options().wall_m, 1e-4) << "both walls on one another";
  EXPECT_NEAR(reach(20, 0.5 + std::numbers::pi / 2), 1.5e-3 * std::numbers::pi / 2, 2e-4);
  EXPECT_NEAR(reach(10, 0.5), 1.5e-3, 1e-4);
  expect_tubes(*tube.surface(), 1);
}

TEST(RodSurface, KnowsThePlaceOnTheRod) {
  ElasticRod rod = test::hung_duct();
  RodSurface tube(rod, 12);
  for (const std::int32_t t : {0, 100, 500, 900}) {
    const MaterialPoint place{t, {0.2, 0.3, 0.5}};
    const auto& corner = tube.surface()->triangles[static_cast<std::size_t>(t)];
    Vec3 point = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      point += place.weight[c] * tube.surface()->vertices[static_cast<std::size_t>(corner[c])];
    EXPECT_NEAR(tube.arc_of(place), point.x(), 1e-9);
  }
}

}  // namespace
}  // namespace trocar::rod_surface_test
