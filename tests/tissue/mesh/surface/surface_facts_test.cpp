// Facts of a surface against closed forms and brute force: topology, quality, nearest point, samples inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "tests/tissue/support/shapes.h"
#include "tissue/mesh/surface/column_samples.h"
#include "tissue/mesh/surface/measured_facts.h"
#include "tissue/mesh/surface/mesh_quality.h"
#include "tissue/mesh/surface/nearest_surface.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::surface_facts_test {
namespace {

using Sample = std::array<int, 3>;

/// A torus round z, wound outward.
TriangleSurface torus(double ring_m, double tube_m, int around, int across) {
  TriangleSurface surface;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = ring_m + tube_m * std::cos(v);
      surface.vertices.emplace_back(r * std::cos(u), r * std::sin(u), tube_m * std::sin(v));
      const auto at = [&](int a, int b) { return static_cast<std::int32_t>((a % around) * across + b % across); };
      surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return surface;
}

/// The same surface with vertices and triangles in a random order.
TriangleSurface shuffled(const TriangleSurface& surface, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::int32_t> number(surface.vertices.size());
  for (std::size_t v = 0; v < number.size(); ++v) number[v] = static_cast<std::int32_t>(v);
  std::shuffle(number.begin(), number.end(), random);
  TriangleSurface result;
  result.vertices.resize(surface.vertices.size());
  for (std::size_t v = 0; v < number.size(); ++v)
    result.vertices[static_cast<std::size_t>(number[v])] = surface.vertices[v];
  for (const auto& [a, b, c] : surface.triangles)
    result.triangles.push_back({number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)],
                                number[static_cast<std::size_t>(c)]});
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

TriangleSurface turned_over(TriangleSurface surface) {
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

Pose some_pose() {
  return {Eigen::AngleAxisd(0.9, Vec3(1, -2, 0.5).normalized()).toRotationMatrix(), Vec3(0.3, -0.7, 1.1)};
}

std::set<Sample> inside_samples(const TriangleSurface& surface, const Vec3& first, double step, const Sample& count) {
  std::set<Sample> result;
  for_inside_samples(surface, first, step, count, [&](int i, int j, int k) {
    EXPECT_TRUE(result.insert({i, j, k}).second) << "told twice";
  });
  return result;
}

/// Distance of a point to a triangle: to the plane where its foot lies within, else to the edges.
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto to_segment = [&](const Vec3& s, const Vec3& e) {
    return (s + (e - s) * std::clamp((p - s).dot(e - s) / (e - s).squaredNorm(), 0.0, 1.0) - p).norm();
  };
  const Vec3 normal = (b - a).cross(c - a).normalized(), foot = p - normal.dot(p - a) * normal;
  const bool within = normal.dot((b - a).cross(foot - a)) >= 0 && normal.dot((c - b).cross(foot - b)) >= 0 &&
                      normal.dot((a - c).cross(foot - c)) >= 0;
  return within ? (p - foot).norm() : std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

TEST(TopologyFacts, GenusAddsUpOverComponents) {
  const TriangleSurface ring = torus(1, 0.3, 24, 12);
  const SurfaceTopology one = analyse_topology(ring);
  EXPECT_TRUE(one.closed() && one.manifold());
  EXPECT_EQ(one.genus, 1);
  TriangleSurface all = ring;
  for (int n = 1; n < 4; ++n) all = test::joined(all, ring.transformed({Mat3::Identity(), Vec3(0, 0, n)}));
  all = test::joined(all, test::sphere(Vec3(9, 0, 0), 1, 2));
  const SurfaceTopology facts = analyse_topology(all);
  EXPECT_EQ(facts.components, 5U);
  EXPECT_EQ(facts.genus, 4);
}

TEST(TopologyFacts, EulerNumberOfAnyOrderOfTheSameTriangles) {
  const TriangleSurface solid = test::joined(torus(2, 0.4, 20, 10), test::sphere(Vec3(0, 0, 5), 1, 3));
  const SurfaceTopology before = analyse_topology(solid);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SurfaceTopology after = analyse_topology(shuffled(solid, seed));
    EXPECT_TRUE(after.closed() && after.manifold());
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_EQ(after.vertices, before.vertices);
  }
  const auto euler = static_cast<long>(before.vertices) - static_cast<long>(before.triangles) / 2;
  EXPECT_EQ(euler, 2 * static_cast<long>(before.components) - 2 * before.genus);
}

TEST(TopologyFacts, UnusedVerticesAreNotCounted) {
  TriangleSurface solid = test::sphere(Vec3::Zero(), 1, 2);
  const SurfaceTopology before = analyse_topology(solid);
  for (int n = 0; n < 7; ++n) solid.vertices.emplace_back(9, n, 0);
  const SurfaceTopology after = analyse_topology(solid);
  EXPECT_EQ(after.vertices, before.vertices);
  EXPECT_EQ(after.components, 1U);
  EXPECT_EQ(after.genus, 0);
}

TEST(TopologyFacts, ARepeatedCornerIsADegenerateTriangle) {
  TriangleSurface solid = test::sphere(Vec3::Zero(), 1, 1);
  EXPECT_EQ(analyse_topology(solid).degenerate_triangles, 0U);
  solid.triangles.push_back({0, 0, 1});
  EXPECT_EQ(analyse_topology(solid).degenerate_triangles, 1U);
}

TEST(TopologyFacts, SizeDoesNotDecideWhatIsDegenerate) {
  for (const double scale : {1e-5, 1.0, 1e4}) {
    EXPECT_EQ(analyse_topology(test::sphere(Vec3::Zero(), scale, 3)).degenerate_triangles, 0U) << scale;
    TriangleSurface needle;
    needle.vertices = {{0, 0, 0}, {scale, 0, 0}, {scale / 2, 1e-7 * scale, 0}};
    needle.triangles = {{0, 1, 2}};
    EXPECT_EQ(analyse_topology(needle).degenerate_triangles, 1U) << scale;
  }
}

TEST(TopologyFacts, EachRemovedTriangleOpensThreeEdges) {
  TriangleSurface solid = test::sphere(Vec3::Zero(), 1, 3);
  const std::vector<std::size_t> apart{10, 200, 400};
  for (auto t = apart.rbegin(); t != apart.rend(); ++t)
    solid.triangles.erase(solid.triangles.begin() + static_cast<std::ptrdiff_t>(*t));
  const SurfaceTopology facts = analyse_topology(solid);
  EXPECT_EQ(facts.boundary_edges, 9U);
  EXPECT_FALSE(facts.closed());
  EXPECT_EQ(facts.misoriented_edges, 0U);
}

TEST(TriangleComponents, AreNumberedByFirstTriangle) {
  const TriangleSurface three = test::joined(
      test::joined(test::box(Vec3::Zero(), Vec3::Ones()), test::sphere(Vec3(5, 0, 0), 1, 1)), torus(1, 0.2, 8, 6));
  const auto numbers = triangle_components(three);
  ASSERT_EQ(numbers.size(), three.triangles.size());
  std::int32_t next = 0;
  for (const std::int32_t number : numbers) {
    EXPECT_LE(number, next);
    next = std::max(next, number + 1);
  }
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 0), 12);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 1), 32);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 2), 96);
}

TEST(WithoutSpecks, DropsSmallOnesAndInnerWallsAndListsTheSmallOnes) {
  const TriangleSurface body = test::sphere(Vec3::Zero(), 1, 3);
  const TriangleSurface wall = turned_over(test::sphere(Vec3::Zero(), 0.8, 3));
  TriangleSurface all = test::joined(test::box(Vec3(3, 0, 0), Vec3(3.1, 0.1, 0.1)), wall);
  all = test::joined(test::joined(all, body), test::box(Vec3(4, 0, 0), Vec3(4.2, 0.2, 0.2)));
  std::vector<double> lost;
  const TriangleSurface kept = without_specks(all, 0.1, &lost);
  EXPECT_EQ(kept.triangles.size(), body.triangles.size());
  EXPECT_EQ(kept.vertices.size(), body.vertices.size());
  EXPECT_NEAR(kept.volume_m3(), body.volume_m3(), 1e-12);
  ASSERT_EQ(lost.size(), 2U);
  EXPECT_NEAR(lost[0], 0.008, 1e-12);
  EXPECT_NEAR(lost[1], 0.001, 1e-12);
}

TEST(WithoutSpecks, LeavesEverythingLargeEnough) {
  const TriangleSurface pair =
      test::joined(test::box(Vec3::Zero(), Vec3::Ones()), test::box(Vec3(2, 0, 0), Vec3(3, 1, 1)));
  std::vector<double> lost;
  const TriangleSurface kept = without_specks(pair, 0.5, &lost);
  EXPECT_EQ(analyse_topology(kept).components, 2U);
  EXPECT_NEAR(kept.volume_m3(), 2, 1e-12);
  EXPECT_TRUE(lost.empty());
}

TEST(AreaAndCentroid, MoveWithTheBodyAndScaleByPowers) {
  const TriangleSurface ring = torus(0.05, 0.02, 96, 48);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(surface_area_m2(ring), 4 * pi * pi * 0.05 * 0.02, 0.005 * surface_area_m2(ring));
  EXPECT_NEAR(ring.volume_m3(), 2 * pi * pi * 0.05 * 0.02 * 0.02, 0.01 * ring.volume_m3());
  EXPECT_LT(volume_centroid_m(ring).norm(), 1e-12);
  const TriangleSurface moved = ring.transformed(some_pose());
  EXPECT_NEAR(surface_area_m2(moved), surface_area_m2(ring), 1e-12);
  EXPECT_NEAR(moved.volume_m3(), ring.volume_m3(), 1e-12);
  EXPECT_LT((volume_centroid_m(moved) - some_pose().p).norm(), 1e-9);
}

TEST(MeshQualityFacts, DoNotChangeWithPlaceOrderOrWinding) {
  const TriangleSurface ring = torus(0.05, 0.02, 31, 13);
  const MeshQuality before = mesh_quality(ring);
  for (const TriangleSurface& other : {ring.transformed(some_pose()), shuffled(ring, 3), turned_over(ring)}) {
    const MeshQuality after = mesh_quality(other);
    EXPECT_NEAR(after.min_angle_deg, before.min_angle_deg, 1e-9);
    EXPECT_NEAR(after.p01_angle_deg, before.p01_angle_deg, 1e-9);
    EXPECT_EQ(after.share_above_15, before.share_above_15);
    EXPECT_NEAR(after.edge_p05_m, before.edge_p05_m, 1e-12);
    EXPECT_NEAR(after.edge_median_m, before.edge_median_m, 1e-12);
    EXPECT_NEAR(after.edge_p95_m, before.edge_p95_m, 1e-12);
  }
  EXPECT_LE(before.edge_min_m, before.edge_p05_m);
  EXPECT_LE(before.edge_p05_m, before.edge_median_m);
  EXPECT_LE(before.edge_median_m, before.edge_p95_m);
  EXPECT_LE(before.edge_p95_m, before.edge_max_m);
}

TEST(MeshQualityFacts, SmallestAngleAgreesWithTheLawOfCosines) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 200; ++n) {
    TriangleSurface one;
    for (int v = 0; v < 3; ++v) one.vertices.emplace_back(unit(random), unit(random), unit(random));
    one.triangles = {{0, 1, 2}};
    std::array<double, 3> edges{};
    for (std::size_t e = 0; e < 3; ++e) edges[e] = (one.vertices[e] - one.vertices[(e + 1) % 3]).norm();
    std::sort(edges.begin(), edges.end());
    const auto [a, b, c] = edges;
    EXPECT_NEAR(smallest_angles_deg(one)[0], std::acos((b * b + c * c - a * a) / (2 * b * c)) * 180 / std::numbers::pi,
                1e-6);
    EXPECT_LE(smallest_angles_deg(one)[0], 60);
  }
}

TEST(NearestSurfaceFacts, AgreesWithEveryTriangleTried) {
  const TriangleSurface ring = torus(0.05, 0.02, 18, 9);
  const NearestSurface nearest(ring);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  for (int n = 0; n < 300; ++n) {
    const Vec3 p(place(random), place(random), place(random));
    double best = 1;
    for (const auto& [a, b, c] : ring.triangles)
      best = std::min(best, distance_to_triangle(p, ring.vertices[static_cast<std::size_t>(a)],
                                                 ring.vertices[static_cast<std::size_t>(b)],
                                                 ring.vertices[static_cast<std::size_t>(c)]));
    const auto hit = nearest.nearest(p);
    EXPECT_NEAR((hit.place - p).norm(), best, 1e-12);
    const auto& [a, b, c] = ring.triangles.at(hit.triangle);
    const Vec3& first = ring.vertices[static_cast<std::size_t>(a)];
    const Vec3 normal =
        (ring.vertices[static_cast<std::size_t>(b)] - first).cross(ring.vertices[static_cast<std::size_t>(c)] - first);
    EXPECT_LT((hit.normal - normal).norm(), 1e-12);
    EXPECT_NEAR(normal.normalized().dot(hit.place - first), 0, 1e-12);
  }
}

TEST(NearestSurfaceFacts, OutlivesItsSourceAndMoves) {
  TriangleSurface box = test::box(Vec3::Zero(), Vec3::Ones());
  NearestSurface first(box);
  box = {};
  NearestSurface second(std::move(first));
  EXPECT_LT((second.nearest({0.5, 0.25, -3}).place - Vec3(0.5, 0.25, 0)).norm(), 1e-12);
  second = NearestSurface(test::box(Vec3::Constant(5), Vec3::Constant(6)));
  EXPECT_LT((second.nearest(Vec3::Zero()).place - Vec3::Constant(5)).norm(), 1e-12);
}

TEST(ColumnSamples, OfAConvexBodyAreThoseBehindEveryFace) {
  const TriangleSurface ball = test::sphere(Vec3(0.011, -0.007, 0.003), 0.04, 2);
  const Vec3 first(-0.05, -0.05, -0.05);
  const double step = 0.0047;
  const Sample count{22, 22, 22};
  std::set<Sample> expected;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        const Vec3 p = first + step * Vec3(i, j, k);
        bool within = true;
        for (const auto& [a, b, c] : ball.triangles) {
          const Vec3& corner = ball.vertices[static_cast<std::size_t>(a)];
          within = within && (ball.vertices[static_cast<std::size_t>(b)] - corner)
                                     .cross(ball.vertices[static_cast<std::size_t>(c)] - corner)
                                     .dot(p - corner) < 0;
        }
        if (within) expected.insert({i, j, k});
      }
  EXPECT_GT(expected.size(), 2000U);
  EXPECT_EQ(inside_samples(ball, first, step, count), expected);
}

TEST(ColumnSamples, OverlapIsToldOnceAndACavityNotAtAll) {
  const TriangleSurface pair =
      test::joined(test::box(Vec3::Zero(), Vec3(2, 2, 2)), test::box(Vec3(0, 0, 1), Vec3(2, 2, 3)));
  EXPECT_EQ(inside_samples(pair, Vec3::Constant(0.05), 0.1, {20, 20, 40}).size(), 20U * 20 * 30);
  const TriangleSurface shell = test::joined(test::box(Vec3::Zero(), Vec3(2, 2, 3)),
                                             turned_over(test::box(Vec3(0.5, 0.5, 0.5), Vec3(1.5, 1.5, 1.5))));
  EXPECT_EQ(inside_samples(shell, Vec3::Constant(0.05), 0.1, {20, 20, 40}).size(), 20U * 20 * 30 - 1000);
}

TEST(ColumnSamples, AreToldByRowThenColumnThenHeight) {
  std::vector<Sample> order;
  for_inside_samples(test::sphere(Vec3::Zero(), 1, 3), Vec3::Constant(-1.03), 0.11, {20, 20, 20},
                     [&](int i, int j, int k) {
                       order.push_back({j, i, k});
                     });
  EXPECT_GT(order.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(ColumnSamples, StayWithinTheAskedGrid) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 10, 2);
  EXPECT_EQ(inside_samples(ball, Vec3::Constant(-1), 0.5, {3, 4, 5}).size(), 60U);
  EXPECT_TRUE(inside_samples(ball, Vec3::Constant(30), 0.5, {3, 4, 5}).empty());
  EXPECT_TRUE(inside_samples(turned_over(ball), Vec3::Constant(-1), 0.5, {3, 4, 5}).empty()) << "inside out";
}

TEST(MeasuredFacts, MaskIsToldInNumbersAndWords) {
  LabelMask mask;
  mask.label_voxels = 1000;
  mask.lost_parts = {20, 5};
  mask.cavities = {7};
  mask.bridge_voxels = 3;
  mask.parts = 2;
  mask.border_voxels = 40;
  MeshFacts facts;
  note_mask(mask, 0.002, facts);
  EXPECT_NEAR(facts.label_volume_ml.value_or(0), 2, 1e-12);
  ASSERT_EQ(facts.lost.size(), 2U);
  EXPECT_EQ(facts.lost[0].voxels, 20U);
  EXPECT_NEAR(facts.lost[1].volume_ml, 0.01, 1e-12);
  ASSERT_EQ(facts.added.size(), 2U);
  EXPECT_EQ(facts.added[0].kind + facts.added[1].kind, "bridgecavity");
  EXPECT_NEAR(facts.added[1].volume_ml, 0.014, 1e-12);
  EXPECT_TRUE(facts.cut_at_border());
  EXPECT_EQ(facts.repairs.size(), 5U);
  MeshFacts none;
  note_mask({}, 0.002, none);
  EXPECT_TRUE(none.repairs.empty() && none.lost.empty() && none.added.empty() && !none.cut_at_border());
}

TEST(MeasuredFacts, VolumesAndErrorsAgreeWithEachOther) {
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3(0.1, 0.1, 0.1));
  MeshFacts facts;
  facts.label_volume_ml = 800;
  measure(box, 0.00125, box, Vec3(0.05, 0.05, 0.08), facts);
  EXPECT_NEAR(facts.volume_ml, 1000, 1e-9);
  EXPECT_NEAR(facts.kept_volume_ml, 1250, 1e-9);
  EXPECT_NEAR(facts.kept_error_pct, -20, 1e-9);
  EXPECT_NEAR(facts.volume_error_pct, 25, 1e-9);
  EXPECT_NEAR(facts.centroid_offset_m, 0.03, 1e-12);
  EXPECT_NEAR(facts.hausdorff_m(), 0, 1e-9);
  facts.label_volume_ml.reset();
  measure(box, 0.00125, box, Vec3(0.05, 0.05, 0.08), facts);
  EXPECT_NEAR(facts.volume_error_pct, facts.kept_error_pct, 1e-12);
}

}  // namespace
}  // namespace trocar::surface_facts_test
