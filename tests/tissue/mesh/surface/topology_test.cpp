#include "tissue/mesh/surface/topology.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/shapes.h"

namespace trocar::topology_test {
namespace {

using test::box;

TEST(Topology, OfABox) {
  const SurfaceTopology facts = analyse_topology(box(Vec3::Zero(), Vec3(1, 2, 3)));
  EXPECT_EQ(facts.vertices, 8U);
  EXPECT_EQ(facts.triangles, 12U);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.components, 1U);
  EXPECT_EQ(facts.genus, 0);
  EXPECT_EQ(facts.degenerate_triangles, 0U);
}

TEST(Topology, CountsTheEdgesOfAHole) {
  TriangleSurface surface = box(Vec3::Zero(), Vec3::Ones());
  surface.triangles.pop_back();
  EXPECT_EQ(analyse_topology(surface).boundary_edges, 3U);
  EXPECT_FALSE(analyse_topology(surface).closed());
  EXPECT_FALSE(analyse_topology(TriangleSurface{}).closed());
}

TEST(Topology, SeesTurnedTrianglesAndExtraFaces) {
  TriangleSurface turned = box(Vec3::Zero(), Vec3::Ones());
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_EQ(analyse_topology(turned).misoriented_edges, 3U);
  TriangleSurface fin = box(Vec3::Zero(), Vec3::Ones());
  fin.vertices.emplace_back(5, 5, 5);
  fin.triangles.push_back({0, 1, 8});
  EXPECT_EQ(analyse_topology(fin).nonmanifold_edges, 1U);
}

TEST(Topology, SeesTwoBoxesThatTouchInOnePoint) {
  TriangleSurface pair = test::joined(box(Vec3::Zero(), Vec3::Ones()), box(Vec3::Ones(), Vec3::Constant(2)));
  EXPECT_TRUE(analyse_topology(pair).manifold());
  const TriangleSurface touching = welded(pair, 1e-9);
  EXPECT_EQ(touching.vertices.size(), 15U);
  const SurfaceTopology facts = analyse_topology(touching);
  EXPECT_EQ(facts.nonmanifold_vertices, 1U);
  EXPECT_FALSE(facts.manifold());
}

TEST(Topology, CountsDegenerateTriangles) {
  TriangleSurface surface = box(Vec3::Zero(), Vec3::Ones());
  surface.vertices[3] = surface.vertices[1];
  EXPECT_GT(analyse_topology(surface).degenerate_triangles, 0U);
}

TEST(Topology, SomeTrianglesTakeTheirVerticesAlongAndTurnedOnesAreJoinedToNothing) {
  const TriangleSurface cube = box(Vec3::Zero(), Vec3::Ones());
  const TriangleSurface both = test::joined(test::sphere(Vec3(5, 0, 0), 0.3, 3), cube);
  std::vector<bool> keep(both.triangles.size(), false);
  std::fill(keep.end() - 12, keep.end(), true);
  TriangleSurface kept = some_triangles(both, keep);
  EXPECT_EQ(kept.triangles.size(), 12U);
  EXPECT_EQ(kept.vertices.size(), 8U);
  EXPECT_NEAR(kept.volume_m3(), 1, 1e-12);
  append_turned(kept, cube);
  EXPECT_EQ(kept.vertices.size(), 16U);
  EXPECT_NEAR(kept.volume_m3(), 0, 1e-12);
}

TEST(Topology, WeldingClosesATriangleSoup) {
  const TriangleSurface solid = test::sphere(Vec3(0.1, 0, 0), 0.05, 2);
  TriangleSurface soup;
  for (const auto& triangle : solid.triangles) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (const auto vertex : triangle) soup.vertices.push_back(solid.vertices[static_cast<std::size_t>(vertex)]);
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.triangles.push_back({first, first + 1, first + 2});  // doubled faces go too
  }
  EXPECT_FALSE(analyse_topology(soup).manifold());
  const TriangleSurface closed = welded(soup, 1e-7);
  EXPECT_EQ(closed.vertices.size(), solid.vertices.size());
  EXPECT_EQ(closed.triangles.size(), solid.triangles.size());
  EXPECT_TRUE(analyse_topology(closed).closed());
}

TEST(Topology, MeasuresAreaAndCentroid) {
  const TriangleSurface surface = box(Vec3(1, 1, 1), Vec3(2, 3, 4));
  EXPECT_NEAR(surface_area_m2(surface), 2 * (1 * 2 + 2 * 3 + 3 * 1), 1e-12);
  EXPECT_TRUE(volume_centroid_m(surface).isApprox(Vec3(1.5, 2, 2.5), 1e-12));
}

}  // namespace
}  // namespace trocar::topology_test
