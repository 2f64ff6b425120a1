// Surface tree and patch extraction against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "haptics/contact/segment_triangle.h"
#include "haptics/least_turn.h"
#include "tests/haptics/contact/surfaces.h"
#include "tissue/collision/patch_extraction.h"

namespace trocar::collision_test {
namespace {

using test::Random;
using Hits = std::vector<SurfaceTree::Hit>;

std::array<Vec3, 3> corners(const TriangleSurface& s, std::size_t i) {
  const auto& [a, b, c] = s.triangles[i];
  return {s.vertices[std::size_t(a)], s.vertices[std::size_t(b)], s.vertices[std::size_t(c)]};
}

std::span<const QuerySegment> one(const QuerySegment& segment) { return {&segment, 1}; }

Hits brute_force(const TriangleSurface& s, const Vec3& a, const Vec3& b, double reach) {
  Hits hits;
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    const double d = closest_segment_triangle(a, b, corners(s, i)).distance;
    if (d <= reach) hits.push_back({static_cast<std::int32_t>(i), d});
  }
  return hits;
}

void expect_same(Hits found, const Hits& wanted) {
  std::sort(found.begin(), found.end(), [](const auto& l, const auto& r) { return l.triangle < r.triangle; });
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].triangle, wanted[i].triangle);
    EXPECT_EQ(found[i].distance, wanted[i].distance) << "the same function, the same bytes";
  }
}

/// Unconnected triangles; every fifth is a needle or a point.
TriangleSurface soup(Random& random, int count) {
  TriangleSurface s;
  for (int i = 0; i < count; ++i) {
    const Vec3 a = random.vector(0.05), b = a + random.vector(0.008), c = a + random.vector(0.008);
    const auto first = static_cast<std::int32_t>(s.vertices.size());
    s.vertices.push_back(a);
    s.vertices.push_back(i % 5 == 0 ? a : b);
    s.vertices.push_back(i % 10 == 0 ? a : c);
    s.triangles.push_back({first, first + 1, first + 2});
  }
  return s;
}

TEST(SurfaceTree, FindsExactlyWhatBruteForceFinds) {
  Random random(1);
  for (const int count : {1, 2, 4, 5, 9, 100, 3000}) {
    const TriangleSurface surface = soup(random, count);
    const SurfaceTree tree(surface);
    Hits hits;
    std::size_t total = 0;
    for (int k = 0; k < 60; ++k) {
      const Vec3 a = random.vector(0.08), b = k % 6 == 0 ? a : random.vector(0.08);
      const double reach = k % 7 == 0 ? 0 : random.between(0, 0.03);
      tree.within(one({a, b}), reach, hits);
      expect_same(hits, brute_force(surface, a, b, reach));
      total += hits.size();
    }
    EXPECT_TRUE(count < 100 || total > 100) << total;
  }
}

TEST(SurfaceTree, FindsExactlyWhatBruteForceFindsOnAnOrganLikeSurface) {
  const TriangleSurface surface = test::lumpy_sphere(4, 0.08);
  const SurfaceTree tree(surface);
  Random random(2);
  Hits hits;
  for (int k = 0; k < 100; ++k) {
    const Vec3 tip = random.direction() * random.between(0.07, 0.11), handle = tip + random.direction() * 0.30;
    tree.within(one({tip, handle}), kPatchRadius, hits);
    expect_same(hits, brute_force(surface, tip, handle, kPatchRadius));
  }
}

TEST(SurfaceTree, RefittedItFindsExactlyWhatBruteForceFinds) {
  Random random(21);
  for (TriangleSurface surface : {soup(random, 2000), test::lumpy_sphere(4, 0.08)}) {
    SurfaceTree tree(surface);
    Hits hits;
    for (int round = 0; round < 12; ++round) {
      // Bent, stretched and, in the last rounds, torn to pieces.
      const double bend = random.symmetric(10), noise = round < 8 ? 0.001 : 0.03;
      for (Vec3& v : surface.vertices) {
        v = Vec3(v.x() + bend * v.y() * v.y(), v.y() * 1.02, v.z()) + random.vector(noise);
      }
      tree.refit();
      for (int k = 0; k < 10; ++k) {
        const std::array<QuerySegment, 2> axes{
            {{random.vector(0.09), random.vector(0.09)}, {random.vector(0.09), random.vector(0.09)}}};
        const double reach = random.between(0, 0.03);
        Hits wanted;
        for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
          const auto tri = corners(surface, i);
          const double d = std::min(closest_segment_triangle(axes[0].a, axes[0].b, tri).distance,
                                    closest_segment_triangle(axes[1].a, axes[1].b, tri).distance);
          if (d <= reach) wanted.push_back({static_cast<std::int32_t>(i), d});
        }
        tree.within(axes, reach, hits);
        expect_same(hits, wanted);
        // Of the nearest few none is missing and what was left out is said.
        std::sort(wanted.begin(), wanted.end());
        const std::size_t most = 1 + static_cast<std::size_t>(random.below(60));
        const auto left = tree.nearest(axes, reach, most, hits);
        ASSERT_EQ(hits.size(), std::min(most, wanted.size()));
        for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i].triangle, wanted[i].triangle) << "rank " << i;
        EXPECT_TRUE(left > 0 || wanted.size() <= most);
      }
    }
  }
}

TEST(SurfaceTree, EmptySurfaceHasNoHits) {
  const TriangleSurface nothing;
  const SurfaceTree tree(nothing);
  Hits hits{{3, 0.5}};
  tree.within(one({Vec3::Zero(), Vec3::UnitX()}), 10, hits);
  EXPECT_TRUE(hits.empty());
}

TEST(SurfaceTree, ManyTrianglesInOnePlaceDoNotConfuseTheSplit) {
  TriangleSurface same;
  same.vertices = {Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0.01, 0)};
  for (int i = 0; i < 1000; ++i) same.triangles.push_back({0, 1, 2});
  const SurfaceTree tree(same);
  Hits hits;
  const QuerySegment upright{{0.002, 0.002, 0.004}, {0.002, 0.002, 0.1}};
  tree.within(one(upright), 0.0041, hits);
  EXPECT_EQ(hits.size(), 1000u);
  tree.within(one(upright), 0.0039, hits);
  EXPECT_TRUE(hits.empty());
}

class Patch : public ::testing::Test {
 protected:
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
};

TEST_F(Patch, NearestFirstWithOutwardNormals) {
  const TriangleSurface surface = test::sphere(3, 0.05);
  PatchExtraction extraction(surface);
  const Pose X = test::tip_down({0.001, 0.002, 0.053});
  const ToolShape tool;
  extraction.extract(X, tool, *patch);
  ASSERT_GT(patch->count, 10);
  const Vec3 handle = X.p - X.R.col(2) * tool.shaft_length_m;
  double last = 0;
  for (int i = 0; i < patch->count; ++i) {
    const PatchTriangle& t = patch->triangle[std::size_t(i)];
    const double d = closest_segment_triangle(X.p, handle, patch->corners(i)).distance;
    EXPECT_GE(d, last);
    EXPECT_LE(d, kPatchRadius);
    EXPECT_NEAR(t.normal.norm(), 1, 1e-12);
    EXPECT_GT(t.normal.dot(patch->corners(i)[0]), 0) << "outward";
    EXPECT_EQ(patch->corners(i), corners(surface, std::size_t(t.id)));
    last = d;
  }
  EXPECT_EQ(patch->count + patch->dropped, static_cast<int>(brute_force(surface, X.p, handle, kPatchRadius).size()));
  EXPECT_EQ(patch->dropped, 0);
}

TEST_F(Patch, TheFurthestIsDroppedAndCounted) {
  const TriangleSurface surface = test::sphere(6, 0.03);  // 32768 triangles of 0.7 mm
  PatchExtraction extraction(surface);
  const Pose X = test::tip_down({0, 0, 0.031});
  extraction.extract(X, {}, *patch);
  Hits all = brute_force(surface, X.p, X.p - X.R.col(2) * ToolShape{}.shaft_length_m, kPatchRadius);
  ASSERT_GT(all.size(), 512u);
  EXPECT_EQ(patch->count, kMaxPatchTriangles);
  EXPECT_GT(patch->dropped, 0);
  EXPECT_LT(patch->reach_m, kPatchRadius);
  std::sort(all.begin(), all.end(), [](const auto& l, const auto& r) {
    return l.distance != r.distance ? l.distance < r.distance : l.triangle < r.triangle;
  });
  for (std::size_t i = 0; i < 512; ++i) ASSERT_EQ(patch->triangle[i].id, all[i].triangle) << "rank " << i;
  EXPECT_EQ(patch->reach_m, all[511].distance) << "nothing nearer than this is missing";
}

TEST_F(Patch, JawsAndHeldObjectWidenIt) {
  const TriangleSurface surface = test::sphere(3, 0.05);
  PatchExtraction extraction(surface);
  const ToolShape grasper{.jaw_length_m = 0.020};
  const double opening = 0.024;
  const Pose X = test::tip_down({0.001, 0.002, 0.060});
  patch->held = {{0.01, 0, 0.012}, {-0.01, 0, 0.012}, 0.003};
  extraction.extract(X, grasper, *patch, opening);
  const ToolCapsules tool = tool_capsules(grasper, opening, patch->held);
  ASSERT_EQ(tool.count, 4);
  int expected = 0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    double nearest = 1;
    for (int c = 0; c < tool.count; ++c) {
      const Pose X_TC = X * tool.at[std::size_t(c)].X_IC;
      const Vec3 back = X_TC.p - X_TC.R.col(2) * tool.at[std::size_t(c)].length_m;
      nearest = std::min(nearest, closest_segment_triangle(X_TC.p, back, corners(surface, i)).distance);
    }
    expected += nearest <= kPatchRadius;
  }
  ASSERT_EQ(patch->dropped, 0);
  EXPECT_EQ(patch->count, expected);
  patch->held.radius_m = 0;
  extraction.extract(X, {}, *patch);
  EXPECT_LT(patch->count, expected) << "the probe alone reaches less";
}

TEST_F(Patch, FollowsASurfaceThatMoves) {
  TriangleSurface surface = test::sphere(4, 0.05);
  PatchExtraction extraction(surface);
  std::vector<Vec3> velocity;
  for (Vec3& v : surface.vertices) {
    velocity.push_back(7 * v);
    v = 1.2 * v + Vec3(0.01, 0, 0);
  }
  extraction.refit(velocity);
  const Pose X = test::tip_down({0.01, 0.002, 0.061});
  extraction.extract(X, {}, *patch);
  const Hits all = brute_force(surface, X.p, X.p - X.R.col(2) * ToolShape{}.shaft_length_m, kPatchRadius);
  ASSERT_EQ(patch->count, static_cast<int>(std::min<std::size_t>(all.size(), 512)));
  ASSERT_GT(patch->count, 50);
  for (int i = 0; i < patch->count; ++i) {
    const PatchTriangle& t = patch->triangle[std::size_t(i)];
    ASSERT_EQ(patch->corners(i), corners(surface, std::size_t(t.id))) << "where it is now";
    ASSERT_GT(t.normal.dot(patch->corners(i)[0] - Vec3(0.01, 0, 0)), 0.9 * 0.06)
        << "outward, and of the moved triangle";
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& corner = surface.triangles[std::size_t(t.id)];
      Barycentric weight{};
      weight[k] = 1;
      ASSERT_EQ(patch->velocity_at(i, weight), velocity[std::size_t(corner[k])]);
    }
  }
  EXPECT_TRUE(patch->moving);
  EXPECT_LT(patch->vertex_count, 0.6 * patch->count + 40) << "shared: half as many as triangles, and the rim";
  extraction.refit();
  extraction.extract(X, {}, *patch);
  EXPECT_FALSE(patch->moving);
  EXPECT_EQ(patch->velocity_at(0, {1, 0, 0}), Vec3::Zero());
}

TEST_F(Patch, FarAwayNothingIsFoundAndMaterialIsLeftAlone) {
  const TriangleSurface surface = test::sphere(3, 0.05);
  PatchExtraction extraction(surface);
  patch->material[0].stiffness_n_per_m = 321;
  patch->stamp = 17;
  patch->grip = {0.01, 500};
  extraction.extract(test::tip_down({0, 0, 0.5}), {}, *patch);
  EXPECT_EQ(patch->count, 0);
  EXPECT_EQ(patch->dropped, 0);
  EXPECT_EQ(patch->material[0].stiffness_n_per_m, 321);
  EXPECT_EQ(patch->stamp, 17u);
  EXPECT_EQ(patch->grip.stiffness_n_per_m, 500);
}

/// A plane of one material and another, further away, below the first.
TEST_F(Patch, LooksAheadForTheNearestOfEachMaterialThatIsNotTouched) {
  TriangleSurface surface;
  std::vector<std::int32_t> material;
  for (const double z : {0.0, -0.001, -0.020}) {
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    for (const Vec3& v : {Vec3(-0.03, -0.03, z), Vec3(0.03, -0.03, z), Vec3(0, 0.03, z)}) surface.vertices.push_back(v);
    surface.triangles.push_back({first, first + 1, first + 2});
    material.push_back(first / 3);
  }
  PatchExtraction extraction(surface, material);
  const ToolCapsules tool = tool_capsules({}, 0, {});
  const double radius = tool.at[0].radius_m;
  const auto all = [](std::int32_t) { return true; };
  SolvedContacts contacts;
  extraction.look_ahead(test::tip_down({0.001, 0, radius + 0.002}), tool, 0.0025, all, contacts);
  ASSERT_EQ(contacts.count, 1) << "the second is 3 mm away";
  EXPECT_EQ(contacts.at[0].place.triangle, 0);
  EXPECT_LT((contacts.at[0].normal_T - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((contacts.at[0].tool_T - Vec3(0.001, 0, 0.002)).norm(), 1e-9);
  EXPECT_EQ(contacts.at[0].force_T, Vec3::Zero());
  extraction.look_ahead(test::tip_down({0.001, 0, radius + 0.002}), tool, 0.004, all, contacts);
  ASSERT_EQ(contacts.count, 2) << "of the first there is one";
  EXPECT_EQ(contacts.at[1].place.triangle, 1);
  contacts.count = 0;
  extraction.look_ahead(
      test::tip_down({0.001, 0, radius + 0.002}), tool, 0.004, [](std::int32_t t) { return t == 1; }, contacts);
  ASSERT_EQ(contacts.count, 1) << "the first is no contact";
  EXPECT_EQ(contacts.at[0].place.triangle, 1);
  contacts.count = 0;
  extraction.look_ahead(test::tip_down({0.001, 0, 0.4 * radius}), tool, 0.0005, all, contacts);
  EXPECT_EQ(contacts.count, 1) << "of the first the side is not told";
}

TEST_F(Patch, SameInputSamePatch) {
  const TriangleSurface surface = test::lumpy_sphere(5, 0.06);
  PatchExtraction one(surface), two(surface);
  const auto other = std::make_unique<ContactPatch>();
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    const Vec3 n = random.direction();
    const Pose X{least_turn(Vec3::UnitZ(), -n).toRotationMatrix(), n * 0.062};
    one.extract(X, {}, *patch);
    two.extract(X, {}, *other);
    ASSERT_EQ(patch->count, other->count);
    for (std::size_t i = 0; i < std::size_t(patch->count); ++i) EXPECT_EQ(patch->triangle[i].id, other->triangle[i].id);
  }
}

}  // namespace
}  // namespace trocar::collision_test
