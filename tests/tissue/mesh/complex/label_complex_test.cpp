// Complexes of several regions: the borders that they give, their edits, their volumes, their remeshing.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <set>

#include "tests/tissue/support/shapes.h"
#include "tissue/mesh/complex/complex_mesh.h"
#include "tissue/mesh/complex/complex_remesh.h"
#include "tissue/mesh/complex/complex_volume.h"
#include "tissue/mesh/surface/cap_planes.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::label_complex_test {
namespace {

using Kind = ComplexMesh::Kind;

constexpr double kFall = 2;  ///< samples over which a field falls from 1 to 0

/// A field that falls from 1 to 0 across the surface where `distance` (in samples, negative inside) is 0.
template <typename Distance>
RegionField field_of(int extent, Distance distance) {
  RegionField result;
  result.field.size = {extent, extent, extent};
  for (int k = 0; k < extent; ++k)
    for (int j = 0; j < extent; ++j)
      for (int i = 0; i < extent; ++i)
        result.field.values.push_back(static_cast<float>(std::clamp(0.5 - distance(Vec3(i, j, k)) / kFall, 0.0, 1.0)));
  return result;
}

/// A ball parted by the plane x = middle: regions 1 (low) and 2 (high), samples a millimetre apart.
LabelComplex halved_ball(int extent = 24, double radius = 8) {
  const double middle = (extent - 1) / 2.0 + 0.21;
  const auto ball = field_of(extent, [&](const Vec3& p) { return (p - Vec3::Constant(middle)).norm() - radius; });
  const auto half = [&](double sign) {
    RegionField share = field_of(extent, [&](const Vec3& p) { return sign * (p.x() - middle); });
    for (std::size_t n = 0; n < share.field.values.size(); ++n) share.field.values[n] *= ball.field.values[n];
    return share;
  };
  return label_complex({half(1), half(-1)}, {extent, extent, extent}, Vec3::Constant(1e-3), 1);
}

double area_of_pair(const LabelComplex& complex, std::int16_t low, std::int16_t high) {
  TriangleSurface part{complex.vertices, {}};
  for (std::size_t t = 0; t < complex.triangles.size(); ++t)
    if (complex.regions[t] == std::array<std::int16_t, 2>{low, high}) part.triangles.push_back(complex.triangles[t]);
  return surface_area_m2(part);
}

/// Two tetrahedra on one common triangle: (0, 1, 2) parts regions 1 (apex 3 below) and 2 (apex 4 above).
LabelComplex two_tents() {
  LabelComplex complex;
  complex.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1}, {0.3, 0.3, 1}};
  complex.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  complex.regions = {{1, 2}, {0, 1}, {0, 1}, {0, 1}, {0, 2}, {0, 2}, {0, 2}};
  return complex;
}

void expect_sound_borders(const LabelComplex& complex, int regions) {
  for (int region = 1; region <= regions; ++region) {
    const SurfaceTopology facts = analyse_topology(complex.border(region));
    EXPECT_TRUE(facts.closed() && facts.manifold()) << "region " << region;
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(facts.genus, 0);
    EXPECT_GT(complex.border(region).volume_m3(), 0);
  }
}

TEST(HalvedBall, RegionsMeetInADiscAndFillTheBall) {
  const LabelComplex complex = halved_ball();
  expect_sound_borders(complex, 2);
  const double low = complex.border(1).volume_m3(), high = complex.border(2).volume_m3();
  EXPECT_NEAR(low + high, test::sphere_volume(8e-3), 0.03 * test::sphere_volume(8e-3));
  EXPECT_NEAR(low, high, 0.02 * low);
  // On the plane both halves are half of that of the ball; the rest is as large where that is 2/3: kFall / 6 within.
  const double radius = (8 - kFall / 6) * 1e-3, disc = std::numbers::pi * radius * radius;
  EXPECT_NEAR(area_of_pair(complex, 1, 2), disc, 0.03 * disc);
}

TEST(HalvedBall, BorderOfTheRestIsThatOfBothTurnedRound) {
  const LabelComplex complex = halved_ball();
  const double inside = complex.border(1).volume_m3() + complex.border(2).volume_m3();
  EXPECT_NEAR(complex.border(0).volume_m3(), -inside, 1e-12);
  EXPECT_TRUE(complex.border(3).triangles.empty());
}

TEST(HalvedBall, BorderNamesTheTriangleThatEachOneIs) {
  const LabelComplex complex = halved_ball();
  for (const int region : {1, 2}) {
    std::vector<std::int32_t> source;
    const TriangleSurface border = complex.border(region, &source);
    ASSERT_EQ(source.size(), border.triangles.size());
    EXPECT_EQ(std::set<std::int32_t>(source.begin(), source.end()).size(), source.size());
    for (std::size_t t = 0; t < source.size(); ++t) {
      const auto s = static_cast<std::size_t>(source[t]);
      EXPECT_TRUE(complex.regions[s][0] == region || complex.regions[s][1] == region);
      Vec3 here = Vec3::Zero(), there = Vec3::Zero();
      for (std::size_t n = 0; n < 3; ++n) {
        here += border.vertices[static_cast<std::size_t>(border.triangles[t][n])];
        there += complex.vertices[static_cast<std::size_t>(complex.triangles[s][n])];
      }
      EXPECT_LT((here - there).norm(), 1e-12);
    }
  }
}

TEST(HalvedBall, PairsAreInOrderAndEveryTriangleBelongsToOne) {
  const LabelComplex complex = halved_ball();
  ASSERT_EQ(complex.regions.size(), complex.triangles.size());
  for (const auto& [low, high] : complex.regions) {
    EXPECT_LT(low, high);
    EXPECT_GE(low, 0);
    EXPECT_LE(high, 2);
  }
}

TEST(LabelComplexFields, ALargerOffsetMakesTheRegionLarger) {
  const auto ball = field_of(20, [](const Vec3& p) { return (p - Vec3::Constant(9.4)).norm() - 5; });
  double before = 0;
  for (const float offset : {-0.2F, -0.1F, 0.0F, 0.1F, 0.2F}) {
    RegionField moved = ball;
    moved.offset = offset;
    const double volume = label_complex({moved}, {20, 20, 20}, Vec3::Constant(1e-3), 1).border(1).volume_m3();
    EXPECT_GT(volume, before);
    before = volume;
  }
}

TEST(LabelComplexFields, ABoxOfItsOwnGivesTheSameSurfaceAsTheWholeGrid) {
  const Vec3 centre(11.3, 9.6, 12.2);
  const RegionField whole = field_of(24, [&](const Vec3& p) { return (p - centre).norm() - 4; });
  RegionField part = field_of(15, [&](const Vec3& p) { return (p + Vec3(4, 2, 5) - centre).norm() - 4; });
  part.first = {4, 2, 5};
  const auto one = label_complex({whole}, {24, 24, 24}, Vec3(1e-3, 2e-3, 3e-3), 1);
  const auto two = label_complex({part}, {24, 24, 24}, Vec3(1e-3, 2e-3, 3e-3), 1);
  EXPECT_EQ(one.triangles, two.triangles);
  ASSERT_EQ(one.vertices.size(), two.vertices.size());
  for (std::size_t v = 0; v < one.vertices.size(); ++v) EXPECT_LT((one.vertices[v] - two.vertices[v]).norm(), 1e-9);
  EXPECT_NEAR(one.border(1).volume_m3(), 6e-9 * test::sphere_volume(4), 0.05 * 6e-9 * test::sphere_volume(4));
}

TEST(LabelComplexFields, PiecesOfTooFewSamplesGoToTheRest) {
  const auto pair = field_of(26, [](const Vec3& p) {
    return std::min((p - Vec3(8.2, 12, 12)).norm() - 5, (p - Vec3(19.3, 12, 12)).norm() - 1.8);
  });
  const auto pieces = [&](std::size_t least) {
    return analyse_topology(label_complex({pair}, {26, 26, 26}, Vec3::Ones(), least).border(1)).components;
  };
  EXPECT_EQ(pieces(1), 2U);
  EXPECT_EQ(pieces(100), 1U);
  EXPECT_EQ(pieces(5000), 0U);
}

TEST(LabelComplexFields, TheOutermostSamplesAreTheRest) {
  const auto full = field_of(8, [](const Vec3&) { return -9.0; });
  const TriangleSurface border = label_complex({full}, {8, 8, 8}, Vec3::Ones(), 1).border(1);
  EXPECT_TRUE(analyse_topology(border).closed());
  EXPECT_GT(border.bounds().min().minCoeff(), 0);
  EXPECT_LT(border.bounds().max().maxCoeff(), 7);
}

TEST(ComplexMeshQueries, KindsFollowTheCurves) {
  const ComplexMesh mesh(two_tents());
  for (const int v : {0, 1, 2}) EXPECT_EQ(mesh.kind(v), Kind::curve) << v;
  for (const int v : {3, 4}) EXPECT_EQ(mesh.kind(v), Kind::patch) << v;
  EXPECT_TRUE(mesh.on_curve(0, 1));
  EXPECT_FALSE(mesh.on_curve(0, 3));
  EXPECT_EQ(mesh.around(0, 1).size(), 3U);
  EXPECT_EQ(mesh.around(1, 4).size(), 2U);
  EXPECT_TRUE(mesh.around(3, 4).empty());
  EXPECT_EQ(mesh.curve_neighbours(0), (std::vector<ComplexMesh::Index>{1, 2}));
  EXPECT_EQ(mesh.neighbours(3), (std::vector<ComplexMesh::Index>{0, 1, 2}));
  EXPECT_EQ(mesh.third(0, 2, 0), 1);
  EXPECT_EQ(mesh.edges().size(), 9U);
}

TEST(ComplexMeshQueries, EveryEdgeOnceAndEveryFanTheTrianglesOfItsVertex) {
  const LabelComplex complex = halved_ball(16, 5);
  const ComplexMesh mesh(complex);
  std::set<std::pair<int, int>> expected, found;
  for (const auto& t : complex.triangles)
    for (std::size_t n = 0; n < 3; ++n) expected.insert(std::minmax(t[n], t[(n + 1) % 3]));
  for (const auto& [a, b] : mesh.edges()) EXPECT_TRUE(found.insert(std::minmax(a, b)).second);
  EXPECT_EQ(found, expected);
  std::size_t sum = 0;
  for (std::size_t v = 0; v < mesh.vertices(); ++v)
    for (const auto t : mesh.fan(static_cast<ComplexMesh::Index>(v))) {
      const auto& corners = mesh.triangle(t);
      EXPECT_EQ(std::count(corners.begin(), corners.end(), static_cast<ComplexMesh::Index>(v)), 1);
      ++sum;
    }
  EXPECT_EQ(sum, 3 * complex.triangles.size());
}

TEST(ComplexMeshEdits, SplittingEveryEdgeKeepsVolumeAndArea) {
  const LabelComplex complex = halved_ball(16, 5);
  ComplexMesh mesh(complex);
  const auto edges = mesh.edges();
  for (const auto& [a, b] : edges) {
    const Vec3 half = (mesh.place(a) + mesh.place(b)) / 2;
    const std::size_t sides = mesh.around(a, b).size();
    const auto middle = mesh.split(a, b);
    EXPECT_EQ(mesh.place(middle), half);
    EXPECT_EQ(mesh.fan(middle).size(), 2 * sides);
    EXPECT_TRUE(mesh.around(a, b).empty());
  }
  const LabelComplex after = mesh.compact();
  EXPECT_EQ(after.vertices.size(), complex.vertices.size() + edges.size());
  expect_sound_borders(after, 2);
  for (const int region : {1, 2}) {
    EXPECT_NEAR(after.border(region).volume_m3(), complex.border(region).volume_m3(), 1e-18);
    EXPECT_NEAR(surface_area_m2(after.border(region)), surface_area_m2(complex.border(region)), 1e-12);
  }
}

TEST(ComplexMeshEdits, ASplitIsUndoneByTheCollapseOfItsMiddle) {
  const LabelComplex complex = halved_ball(14, 4);
  const auto edges = ComplexMesh(complex).edges();
  for (std::size_t n = 0; n < edges.size(); n += 37) {
    ComplexMesh mesh(complex);
    const auto [a, b] = edges[n];
    const bool curve = mesh.on_curve(a, b);
    const auto middle = mesh.split(a, b);
    EXPECT_EQ(mesh.kind(middle), curve ? Kind::curve : Kind::patch);
    ASSERT_TRUE(mesh.may_collapse(a, middle));
    mesh.collapse(a, middle);
    EXPECT_FALSE(mesh.alive(middle));
    const LabelComplex back = mesh.compact();
    EXPECT_EQ(back.vertices.size(), complex.vertices.size());
    EXPECT_EQ(back.triangles.size(), complex.triangles.size());
    EXPECT_NEAR(back.border(1).volume_m3(), complex.border(1).volume_m3(), 1e-18);
  }
}

TEST(ComplexMeshEdits, AFlipThereAndBackIsNoChange) {
  ComplexMesh mesh(halved_ball(14, 4));
  const auto before = mesh.compact();
  int flipped = 0;
  for (const auto& [a, b] : mesh.edges()) {
    const auto sides = mesh.around(a, b);
    if (sides.size() != 2) {
      EXPECT_FALSE(mesh.flip(a, b)) << "a curve was flipped";
      continue;
    }
    const auto c = mesh.third(sides[0], a, b), d = mesh.third(sides[1], a, b);
    if (!mesh.flip(a, b)) continue;
    ++flipped;
    EXPECT_TRUE(mesh.around(a, b).empty());
    EXPECT_EQ(mesh.around(c, d).size(), 2U);
    EXPECT_TRUE(mesh.flip(c, d));
  }
  EXPECT_GT(flipped, 100);
  const auto after = mesh.compact();
  EXPECT_EQ(after.triangles.size(), before.triangles.size());
  EXPECT_NEAR(after.border(1).volume_m3(), before.border(1).volume_m3(), 1e-18);
  EXPECT_NEAR(surface_area_m2(after.border(2)), surface_area_m2(before.border(2)), 1e-15);
}

TEST(ComplexMeshEdits, ATentMayNotCollapse) {
  const ComplexMesh mesh(two_tents());
  for (const auto& [a, b] : mesh.edges()) {
    EXPECT_FALSE(mesh.may_collapse(a, b)) << a << ' ' << b;
    EXPECT_FALSE(mesh.may_collapse(b, a)) << b << ' ' << a;
  }
}

TEST(ComplexMeshEdits, CompactDropsWhatNothingUses) {
  LabelComplex complex = two_tents();
  complex.vertices.insert(complex.vertices.begin(), Vec3::Constant(7));
  for (auto& triangle : complex.triangles)
    for (auto& corner : triangle) ++corner;
  const LabelComplex compact = ComplexMesh(complex).compact();
  EXPECT_EQ(compact.vertices.size(), 5U);
  EXPECT_EQ(compact.regions, complex.regions);
  EXPECT_NEAR(compact.border(2).volume_m3(), two_tents().border(2).volume_m3(), 1e-15);
}

TEST(CorrectVolumes, EveryRegionGetsItsOwnWhileTheInterfaceStays) {
  LabelComplex complex = halved_ball();
  const LabelComplex before = complex;
  const std::vector<CapPlane> none;
  const double low = before.border(1).volume_m3() * 1.03, high = before.border(2).volume_m3() * 0.97;
  correct_volumes(complex, {low, high}, 1e-3, CapKeeper(none, complex.vertices));
  EXPECT_NEAR(complex.border(1).volume_m3(), low, 2e-3 * low);
  EXPECT_NEAR(complex.border(2).volume_m3(), high, 2e-3 * high);
  EXPECT_NEAR(area_of_pair(complex, 1, 2), area_of_pair(before, 1, 2), 1e-12);
  const ComplexMesh mesh(before);
  for (std::size_t v = 0; v < mesh.vertices(); ++v)
    if (mesh.kind(static_cast<ComplexMesh::Index>(v)) != Kind::patch) {
      EXPECT_EQ(complex.vertices[v], before.vertices[v]);
    }
}

TEST(CorrectVolumes, SixStepsAreTheMost) {
  LabelComplex complex = halved_ball();
  const LabelComplex before = complex;
  const std::vector<CapPlane> none;
  correct_volumes(complex, {1, before.border(2).volume_m3()}, 1e-5, CapKeeper(none, complex.vertices));
  double most = 0;
  for (std::size_t v = 0; v < complex.vertices.size(); ++v)
    most = std::max(most, (complex.vertices[v] - before.vertices[v]).norm());
  EXPECT_NEAR(most, 6e-5, 1e-7);
}

TEST(ComplexRemesh, KeepsTopologyAndVolumeAndIsTheSameEachTime) {
  const LabelComplex dense = halved_ball();
  ComplexRemeshOptions options;
  options.triangles = {400, 400};
  options.smoothing_m = 2e-3;
  const LabelComplex coarse = remeshed(dense, options), again = remeshed(dense, options);
  expect_sound_borders(coarse, 2);
  EXPECT_EQ(coarse.triangles, again.triangles);
  EXPECT_TRUE(std::equal(coarse.vertices.begin(), coarse.vertices.end(), again.vertices.begin(), again.vertices.end()));
  for (const int region : {1, 2}) {
    const double volume = dense.border(region).volume_m3();
    EXPECT_NEAR(coarse.border(region).volume_m3(), volume, 0.03 * volume);
    EXPECT_NEAR(static_cast<double>(coarse.border(region).triangles.size()), 400, 60);
  }
  EXPECT_NEAR(area_of_pair(coarse, 1, 2), area_of_pair(dense, 1, 2), 0.05 * area_of_pair(dense, 1, 2));
}

}  // namespace
}  // namespace trocar::label_complex_test
