#include "tissue/mesh/surface/surface_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/tissue/support/shapes.h"
#include "tissue/mesh/surface/mesh_quality.h"
#include "tissue/mesh/surface/remesh.h"
#include "tissue/mesh/surface/surface_fit.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::surface_check_test {
namespace {

using test::box;

TEST(SurfaceCheck, FindsSelfIntersections) {
  const TriangleSurface apart =
      test::joined(box(Vec3::Zero(), Vec3::Ones()), box(Vec3::Constant(2), Vec3::Constant(3)));
  const TriangleSurface crossing =
      test::joined(box(Vec3::Zero(), Vec3::Ones()), box(Vec3::Constant(0.5), Vec3::Constant(1.6)));
  EXPECT_EQ(count_self_intersections(apart), 0U);
  EXPECT_GT(count_self_intersections(crossing), 0U);
}

TEST(SurfaceCheck, FindsWhichSurfacesCrossAndLetsThemShareFaces) {
  const TriangleSurface one = box(Vec3::Zero(), Vec3::Ones()), inside = box(Vec3::Constant(.2), Vec3::Constant(.4)),
                        over = box(Vec3(.9, .9, .9), Vec3::Constant(2)), beside = box(Vec3(1, 0, 0), Vec3(2, 1, 1));
  EXPECT_TRUE(surface_crossings({&one, &inside}).empty()) << "a surface inside another one";
  TriangleSurface round_it = one;
  for (auto& triangle : round_it.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_TRUE(surface_crossings({&one, &round_it}).empty()) << "the same triangles, back to back: a common border";
  const auto twice = surface_crossings({&one, &one});
  ASSERT_EQ(twice.size(), 1U) << "one body lies in the other";
  EXPECT_EQ(twice[0].pairs, one.triangles.size());
  EXPECT_TRUE(surface_crossings({&one}).empty());
  const auto found = surface_crossings({&beside, &one, &inside, &over});
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.back().first, 1U);
  EXPECT_EQ(found.back().second, 3U);
  EXPECT_GT(found.back().pairs, 0U);
}

TEST(SurfaceCheck, CountsCrossingsThatRunThroughASharedCorner) {
  const auto triangle = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return TriangleSurface{{a, b, c}, {{0, 1, 2}}};
  };
  const TriangleSurface flat = triangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                        through = triangle(Vec3::Zero(), Vec3(.4, .4, -1), Vec3(.4, .4, 1)),
                        corner = triangle(Vec3::Zero(), Vec3(-1, 0, 1), Vec3(-1, 1, 1)),
                        folded = triangle(Vec3(1, 0, 0), Vec3::Zero(), Vec3(.3, .3, 0)),
                        hinged = triangle(Vec3(1, 0, 0), Vec3::Zero(), Vec3(.3, .3, 1));
  EXPECT_EQ(surface_crossings({&flat, &through}).size(), 1U);
  EXPECT_EQ(surface_crossings({&flat, &folded}).size(), 1U) << "both lie in one plane on one side of the common edge";
  EXPECT_TRUE(surface_crossings({&flat, &corner}).empty());
  EXPECT_TRUE(surface_crossings({&flat, &hinged}).empty());
}

TEST(SurfaceCheck, TurnsASurfaceOutwards) {
  TriangleSurface inward = box(Vec3::Zero(), Vec3::Ones());
  for (auto& triangle : inward.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_EQ(orient_outward(inward), 12U);
  EXPECT_NEAR(inward.volume_m3(), 1, 1e-12);
  TriangleSurface mixed = box(Vec3::Zero(), Vec3::Ones());
  std::swap(mixed.triangles[7][1], mixed.triangles[7][2]);
  EXPECT_EQ(orient_outward(mixed), 1U);
  EXPECT_TRUE(analyse_topology(mixed).manifold());
  EXPECT_EQ(orient_outward(mixed), 0U);
}

TEST(SurfaceCheck, RefusesToOrientAnOpenSurface) {
  TriangleSurface open = box(Vec3::Zero(), Vec3::Ones());
  open.triangles.pop_back();
  EXPECT_THROW(orient_outward(open), std::invalid_argument);
}

TEST(SurfaceCheck, DistanceOfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  const TriangleSurface inner = test::sphere(Vec3::Zero(), 1, 5), outer = test::sphere(Vec3::Zero(), 1.1, 5);
  const SurfaceDistance distance = distance_from_to(inner, outer);
  EXPECT_NEAR(distance.mean_m, 0.1, 1e-3);  // facets of edge 0.05 lie 3e-4 below the sphere
  EXPECT_NEAR(distance.p99_m, 0.1, 2e-3);
  EXPECT_NEAR(distance.max_m, 0.1, 2e-3);
  EXPECT_NEAR(distance_from_to(inner, inner).max_m, 0, 1e-12);
}

TEST(SurfaceCheck, DistanceSeesWhatOnlyOneSurfaceHas) {
  const TriangleSurface plain = box(Vec3::Zero(), Vec3::Ones());
  const TriangleSurface extra = test::joined(plain, test::sphere(Vec3(4, 0.5, 0.5), 0.5, 3));
  EXPECT_NEAR(distance_from_to(plain, extra).max_m, 0, 1e-12);
  EXPECT_NEAR(distance_from_to(extra, plain).max_m, 3.5, 0.05);
}

TEST(Remesh, GivesTrianglesOfTheWantedSizeOnTheSameSurface) {
  const TriangleSurface dense = test::sphere(Vec3(0.1, 0.2, 0.3), 0.05, 5);
  const TriangleSurface coarse = remeshed(dense, std::vector<double>(dense.vertices.size(), 0.008), {});
  const SurfaceTopology facts = analyse_topology(coarse);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.genus, 0);
  double shortest = 1, longest = 0;
  for (const auto& triangle : coarse.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      const double edge = (coarse.vertices[static_cast<std::size_t>(triangle[n])] -
                           coarse.vertices[static_cast<std::size_t>(triangle[(n + 1) % 3])])
                              .norm();
      shortest = std::min(shortest, edge), longest = std::max(longest, edge);
    }
  EXPECT_GT(shortest, 0.3 * 0.008);
  EXPECT_LT(longest, 1.6 * 0.008);
  EXPECT_GT(mesh_quality(coarse).min_angle_deg, 25);
  for (const Vec3& vertex : coarse.vertices) EXPECT_NEAR((vertex - Vec3(0.1, 0.2, 0.3)).norm(), 0.05, 1e-4);
}

TEST(Remesh, RefusesWhatIsNoManifold) {
  TriangleSurface fin = box(Vec3::Zero(), Vec3::Ones());
  fin.triangles.push_back({0, 1, 7});
  EXPECT_THROW(remeshed(fin, std::vector<double>(8, 0.3), {}), std::invalid_argument);
  EXPECT_THROW(remeshed(box(Vec3::Zero(), Vec3::Ones()), {0.3}, {}), std::invalid_argument);
}

TEST(SurfaceFit, BringsFacetsCloserToTheShape) {
  const TriangleSurface dense = test::sphere(Vec3::Zero(), 1, 6);
  const TriangleSurface coarse = remeshed(dense, std::vector<double>(dense.vertices.size(), 0.4), {});
  const double before = distance_from_to(coarse, dense).mean_m,
               after = distance_from_to(fitted(coarse, dense, 4), dense).mean_m;
  EXPECT_LT(after, 0.5 * before);
  EXPECT_EQ(fitted(coarse, dense, 0).vertices.size(), coarse.vertices.size());
}

/// A cube with rounded edges, half a metre from its middle to its faces.
TriangleSurface rounded_cube() {
  TriangleSurface cube = test::sphere(Vec3::Zero(), 1, 6);
  for (Vec3& vertex : cube.vertices) vertex /= 2 * std::pow(vertex.array().pow(8).sum(), 1.0 / 8);
  return cube;
}

TEST(SurfaceFit, SlidesOntoBendsAndFlipsEdgesAlongThem) {
  const TriangleSurface dense = rounded_cube();
  const TriangleSurface coarse = remeshed(dense, std::vector<double>(dense.vertices.size(), 0.25), {});
  const std::vector<CapPlane> none;
  const CapKeeper no_caps(none, coarse.vertices);
  const TriangleSurface along = fitted(coarse, dense, 6), close = closely_fitted(coarse, dense, no_caps, 6);
  EXPECT_LT(distance_from_to(close, dense).mean_m, 0.75 * distance_from_to(along, dense).mean_m);
  EXPECT_LT(distance_from_to(dense, close).mean_m, 0.75 * distance_from_to(dense, along).mean_m);
  EXPECT_NE(close.triangles, coarse.triangles);
  EXPECT_GT(mesh_quality(close).min_angle_deg,
            std::min(kLeastFittedAngleDeg, mesh_quality(coarse).min_angle_deg) - 1e-9);
  const SurfaceTopology facts = analyse_topology(close);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.genus, 0);
  EXPECT_EQ(close.vertices.size(), coarse.vertices.size());
  EXPECT_EQ(close.triangles.size(), coarse.triangles.size());
  EXPECT_EQ(count_self_intersections(close), 0U);
  const TriangleSurface again = closely_fitted(coarse, dense, no_caps, 6);
  EXPECT_TRUE(again.vertices == close.vertices && again.triangles == close.triangles);
  EXPECT_EQ(closely_fitted(coarse, dense, no_caps, 0).vertices, coarse.vertices);
}

TEST(SurfaceFit, LeavesACapFlat) {
  TriangleSurface dense = rounded_cube();
  const std::vector<CapPlane> planes{{Vec3::UnitZ(), 0.2}};
  for (Vec3& vertex : dense.vertices) vertex.z() = std::min(vertex.z(), 0.2);
  const TriangleSurface coarse = remeshed(dense, std::vector<double>(dense.vertices.size(), 0.15), {});
  const TriangleSurface close = closely_fitted(coarse, dense, {planes, coarse.vertices}, 6);
  std::size_t on_cap = 0;
  for (std::size_t v = 0; v < close.vertices.size(); ++v) {
    EXPECT_LE(close.vertices[v].z(), 0.2 + 1e-12);
    if (std::abs(coarse.vertices[v].z() - 0.2) > 1e-9) continue;
    ++on_cap;
    EXPECT_NEAR(close.vertices[v].z(), 0.2, 1e-12);
  }
  EXPECT_GT(on_cap, 20U);
  EXPECT_LT(distance_from_to(close, dense).mean_m, 0.75 * distance_from_to(coarse, dense).mean_m);
  EXPECT_EQ(count_self_intersections(close), 0U);
}

}  // namespace
}  // namespace trocar::surface_check_test
