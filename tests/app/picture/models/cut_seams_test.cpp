// Cuts as the picture shows them: a sharp lip, no gap, and how far every place is from the lip.
#include "app/picture/models/cut_seams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/picture/models/curved_subdivision.h"
#include "tests/support/procedural_scene.h"
#include "tissue/mesh/surface/cut_tracing.h"
#include "tissue/mesh/surface/groove.h"

namespace trocar::cut_seams_test {
namespace {

constexpr double kRadius = 0.040, kLong = 0.020, kDeep = 0.006;

/// A ball with a cut at its top along x.
SurfaceSnapshot cut_ball() {
  TriangleSurface ball = testing_support::icosphere(4);
  for (Vec3& v : ball.vertices) v *= kRadius;
  const Vec3 top(0, 0, kRadius - 0.001);
  const TracedCut traced = trace_cut(
      ball, track_blade(top - Vec3(kLong / 2, 3e-4, 0), top + Vec3(kLong / 2, -2e-4, 0), -Vec3::UnitZ(), kDeep, 0.005));
  EXPECT_EQ(traced.refusal, CutRefusal::kNone) << refusal_words(traced.refusal);
  const Groove groove = cut_groove(ball, traced.cut);
  SurfaceSnapshot out;
  static_cast<TriangleSurface&>(out) = groove.surface;
  out.inside.assign(out.triangles.size(), false);
  for (const std::int32_t wall : groove.walls) out.inside[static_cast<std::size_t>(wall)] = true;
  return out;
}

struct Opened {
  SurfaceSnapshot rest = cut_ball();
  CutSeams seams = open_seams(rest);
  const Vec3& at(std::int32_t v) const { return seams.surface.vertices[static_cast<std::size_t>(v)]; }
};

TEST(CutSeams, AWholeSurfaceIsLeftAlone) {
  SurfaceSnapshot ball;
  static_cast<TriangleSurface&>(ball) = testing_support::icosphere(2);
  const CutSeams seams = open_seams(ball);
  EXPECT_EQ(seams.surface.triangles, ball.triangles);
  EXPECT_TRUE(seams.twin_of.empty());
  EXPECT_EQ(seams.at_twins_too(std::vector<int>{1, 2}), (std::vector<int>{1, 2}));
}

TEST(CutSeams, EveryTriangleStaysWhereItIs) {
  const Opened cut;
  ASSERT_EQ(cut.seams.surface.triangles.size(), cut.rest.triangles.size());
  EXPECT_GT(cut.seams.twin_of.size(), 8U);
  for (std::size_t t = 0; t < cut.rest.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(cut.at(cut.seams.surface.triangles[t][k]),
                cut.rest.vertices[static_cast<std::size_t>(cut.rest.triangles[t][k])]);
  EXPECT_EQ(cut.seams.at_twins_too(cut.rest.vertices), cut.seams.surface.vertices);
}

TEST(CutSeams, TheLipIsSharp) {
  const Opened cut;
  const std::vector<Vec3> normals = cut.seams.surface.vertex_normals();
  const std::size_t first = cut.rest.vertices.size();
  double turned = 0;
  for (std::size_t i = 0; i < cut.seams.twin_of.size(); ++i) {
    const auto lip = static_cast<std::size_t>(cut.seams.twin_of[i]);
    const Vec3 out = cut.rest.vertices[lip].normalized();
    EXPECT_GT(normals[lip].dot(out), 0.95) << "the outside goes on as if nothing were cut";
    turned += 1 - normals[first + i].dot(out);
  }
  EXPECT_GT(turned / static_cast<double>(cut.seams.twin_of.size()), 0.4) << "the wall goes down";
}

TEST(CutSeams, RefinedTheSheetsStillMeet) {
  const Opened cut;
  const TriangleSurface fine =
      CurvedSubdivision(cut.seams.surface, 4 * cut.seams.surface.triangles.size(), cut.seams.straight).fine();
  // By place instead of by number the surface is closed: each edge has one that runs the other way.
  using Place = std::array<double, 3>;
  const auto place = [&](std::int32_t v) {
    const Vec3& p = fine.vertices[static_cast<std::size_t>(v)];
    return Place{p.x(), p.y(), p.z()};
  };
  std::map<std::pair<Place, Place>, int> edges;
  for (const auto& t : fine.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{place(t[k]), place(t[(k + 1) % 3])}];
  for (const auto& [edge, count] : edges) ASSERT_EQ(edges.count({edge.second, edge.first}), 1U) << "a gap at the lip";
}

TEST(CutSeams, PlacesAreTheirDistanceFromTheLip) {
  const Opened cut;
  const std::vector<float> places = cut_places(cut.seams.surface, cut.rest.inside);
  float deepest = 0;
  for (std::size_t i = 0; i < cut.seams.twin_of.size(); ++i) {
    EXPECT_EQ(places[static_cast<std::size_t>(cut.seams.twin_of[i])], kLipOutside);
    EXPECT_EQ(places[cut.rest.vertices.size() + i], kLipOfWall);
  }
  for (std::size_t t = 0; t < cut.rest.triangles.size(); ++t)
    for (const std::int32_t corner : cut.seams.surface.triangles[t]) {
      const float place = places[static_cast<std::size_t>(corner)];
      if (cut.rest.inside[t])
        deepest = std::max(deepest, place);
      else
        EXPECT_LE(place, kLipOutside);
    }
  EXPECT_NEAR(deepest - kLipOfWall, 1000 * kDeep, 2) << "mm";
  const auto far = std::min_element(cut.rest.vertices.begin(), cut.rest.vertices.end(),
                                    [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  EXPECT_EQ(places[static_cast<std::size_t>(far - cut.rest.vertices.begin())], kFarFromCut);
}

}  // namespace
}  // namespace trocar::cut_seams_test
