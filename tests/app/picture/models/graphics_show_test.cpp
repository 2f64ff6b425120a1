// The show scene and what it is made of: surfaces from distances, organs that fit each other, fields, the montage of
// twelve marks.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "app/picture/models/implicit_surface.h"
#include "app/picture/models/picture_mesh.h"
#include "app/picture/models/show_anatomy.h"
#include "app/picture/models/show_scene.h"
#include "app/picture/models/solid_grid.h"
#include "app/picture/scene/mark_block.h"
#include "app/picture/scene/marks_montage.h"
#include "tests/support/headless_fixture.h"
#include "tests/support/picture_probe.h"
#include "tests/support/procedural_scene.h"

namespace trocar::graphics_show_test {
namespace {

double ball(const Vec3& p) { return p.norm() - 0.02; }
Eigen::AlignedBox3d cube(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }

/// Every directed edge has exactly one partner the other way.
bool closed(const TriangleSurface& s) {
  std::multiset<std::pair<int, int>> edges;
  for (const auto& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    return edges.count(e) == edges.count({e.second, e.first});
  });
}

TEST(ImplicitSurface, ABallHasItsVolumeAndIsClosedAndOutward) {
  const TriangleSurface s = implicit_surface(ball, cube(0.03), 0.001);
  EXPECT_TRUE(closed(s));
  EXPECT_NEAR(s.volume_m3(), 4.0 / 3 * std::numbers::pi * 8e-6, 0.01 * 3.35e-5);
  for (const Vec3& v : s.vertices) ASSERT_NEAR(v.norm(), 0.02, 1e-4);
}

TEST(ImplicitSurface, FinerGridsComeNearer) {
  const double exact = 4.0 / 3 * std::numbers::pi * 8e-6;
  const auto off = [&](double cell) { return std::abs(implicit_surface(ball, cube(0.03), cell).volume_m3() - exact); };
  EXPECT_LT(off(0.001), 0.5 * off(0.003));
}

TEST(ImplicitSurface, WhatReachesTheBorderIsCutAndStillClosed) {
  const TriangleSurface s = implicit_surface([](const Vec3& p) { return p.z() + 0.001; }, cube(0.02), 0.002);
  EXPECT_TRUE(closed(s));
  EXPECT_GT(s.volume_m3(), 0);
}

TEST(ImplicitSurface, RaysMeetTheSurfaceAndNormalsPointOut) {
  const Vec3 hit = first_hit(ball, Vec3(0, -0.1, 0), Vec3::UnitY(), 1);
  EXPECT_NEAR(hit.y(), -0.02, 2e-4);
  EXPECT_TRUE(slope_of(ball, hit).isApprox(-Vec3::UnitY(), 1e-6));
  EXPECT_NEAR(first_hit(ball, Vec3(0, -0.1, 0.05), Vec3::UnitY(), 0.3).y(), 0.2, 1e-9);  // a miss goes as far as asked
}

TEST(ShowAnatomy, EveryOrganIsClosedAndLiesInItsBox) {
  for (const ShowOrgan& organ : show_anatomy(1)) {
    const TriangleSurface s = implicit_surface(organ.distance, organ.box, 2 * organ.cell_m);
    EXPECT_GT(s.triangles.size(), 100U) << organ.material;
    EXPECT_GT(s.volume_m3(), 0) << organ.material;
    EXPECT_TRUE(closed(s)) << organ.material;
  }
}

TEST(ShowAnatomy, TheGallbladderHoldsWhatOneHolds) {
  const ShowOrgan gallbladder = show_anatomy(1).front();
  EXPECT_EQ(gallbladder.material, "gallbladder");
  const double ml = 1e6 * implicit_surface(gallbladder.distance, gallbladder.box, gallbladder.cell_m).volume_m3();
  EXPECT_GT(ml, 15);  // 30 to 50 mL in adults, less when contracted
  EXPECT_LT(ml, 60);
}

TEST(ShowScene, SameSeedSameSceneAnotherSeedAnother) {
  const SceneView a = show_scene("abdomen", 3), b = show_scene("abdomen", 3), c = show_scene("abdomen", 4);
  EXPECT_EQ(a.organ->vertices, b.organ->vertices);
  EXPECT_NE(a.organ->vertices, c.organ->vertices);
}

TEST(ShowScene, FieldsAreThereAndLieOnTissue) {
  const SceneView abdomen = show_scene("abdomen");
  const auto kinds = [&](const std::string& name) {
    std::set<TissueMarkKind> out;
    for (const TissueMark& mark : with_fields(abdomen, name).marks) out.insert(mark.kind);
    return out;
  };
  EXPECT_TRUE(kinds("abdomen").empty());
  EXPECT_TRUE(kinds("blood").count(TissueMarkKind::kBlood));
  EXPECT_TRUE(kinds("char").count(TissueMarkKind::kChar));
  EXPECT_TRUE(kinds("whitening").count(TissueMarkKind::kWhitening));
  EXPECT_TRUE(kinds("wet").count(TissueMarkKind::kWet));
  EXPECT_GT(with_fields(abdomen, "smoke").smoke_per_m, 0);
  EXPECT_GT(with_fields(abdomen, "fog").lens.fog, 0);
  EXPECT_NE(with_fields(abdomen, "thirty-degree").camera.notch_rad, 0);
  const auto organs = show_anatomy(1);
  for (const TissueMark& mark : with_fields(abdomen, "blood").marks) {
    double d = 1;
    for (const ShowOrgan& organ : organs) d = std::min(d, std::abs(organ.distance(mark.centre_T)));
    EXPECT_LT(d, 1e-3);
  }
}

TEST(ShowScene, RefusesUnknownNames) { EXPECT_THROW(show_scene("theatre"), std::invalid_argument); }

TEST(MarkBlock, HoldsPlaceKindAndStrength) {
  const MarkBlock block = make_mark_block(
      {{TissueMarkKind::kChar, Vec3(1, 2, 3), 0.5, 0.25}, {TissueMarkKind::kWet, Vec3::Zero(), 0.1, 7}});
  EXPECT_EQ(block.count[0], 2);
  EXPECT_EQ(block.place[0][2], 3);
  EXPECT_EQ(block.place[0][3], 0.5F);
  EXPECT_EQ(block.kind[0][1], 0.25F);
  EXPECT_EQ(block.kind[0][0], 0);
  EXPECT_EQ(block.kind[1][3], 1);  // strength ends at full
}

TEST(MarkBlock, TrianglesAreThoseWithinReach) {
  PictureMesh mesh;
  for (const float x : {0.0F, 1.0F, 2.0F, 3.0F}) mesh.vertices.push_back({{x, 0, 0}, {0, 0, 1}, {1, 0}});
  mesh.vertices.push_back({{0, 1, 0}, {0, 0, 1}, {1, 0}});
  mesh.vertices.push_back({{2, 1, 0}, {0, 0, 1}, {1, 0}});
  mesh.indices = {0, 1, 4, 2, 3, 5};
  EXPECT_TRUE(triangles_marked(mesh, {}).empty());
  const auto near = triangles_marked(mesh, {{TissueMarkKind::kBlood, Vec3(-0.1, -0.1, 0), 0.1, 1}});
  EXPECT_EQ(near, (std::vector<std::uint32_t>{0, 1, 4}));
}

TEST(SolidGrid, IsFullInsideEmptyOutside) {
  const SolidGrid grid(implicit_surface(ball, cube(0.03), 0.001));
  EXPECT_NEAR(grid.density(Vec3::Zero()), 1, 1e-6);
  EXPECT_NEAR(grid.density(Vec3(0.019, 0.019, 0)), 0, 1e-6);
  EXPECT_NEAR(grid.density(Vec3(0.02, 0, 0)), 0.5, 0.2);
  EXPECT_EQ(grid.density(Vec3(1, 1, 1)), 0);
}

TEST(SolidGrid, OnTheLatticeAtRestWhatStaysInPlaceStaysAsItIs) {
  const TriangleSurface still = implicit_surface(ball, cube(0.03), 0.001);
  const SolidGrid rest(still);
  TriangleSurface pulled = still;
  for (Vec3& v : pulled.vertices) v.x() += v.x() > 0.015 ? 0.5 * (v.x() - 0.015) : 0;
  const SolidGrid now(pulled, rest);
  EXPECT_EQ(now.cell(), rest.cell());
  for (const Vec3& p : {Vec3(-0.019, 0, 0), Vec3(0, 0.0195, 0), Vec3(0, 0, 0.02), Vec3(-0.01, 0.012, 0.012)})
    EXPECT_NEAR(now.density(p), rest.density(p), 1e-6);
  EXPECT_GT(now.density(Vec3(0.0215, 0, 0)), rest.density(Vec3(0.0215, 0, 0)) + 0.1);
  for (Vec3& v : pulled.vertices) v.x() *= 3;
  EXPECT_GT(SolidGrid(pulled, rest).density(Vec3(0.06, 0, 0)), 0.9) << "one that has grown beyond it has its own";
}

TEST(Occlusion, ANeighbourTakesLightOnlyFromTheSideThatFacesIt) {
  const TriangleSurface one = implicit_surface(ball, cube(0.03), 0.002);
  TriangleSurface other = one;
  for (Vec3& v : other.vertices) v += Vec3(0.042, 0, 0);
  PictureMesh mesh = bake_picture_mesh(one, SolidGrid(one));
  const PictureMesh before = mesh;
  darken_beside(mesh.vertices, SolidGrid(other));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const float lost = before.vertices[i].light[0] - mesh.vertices[i].light[0];
    if (mesh.vertices[i].position[0] < 0) {
      EXPECT_EQ(lost, 0);
    }
    if (mesh.vertices[i].position[0] > 0.0195F) {
      EXPECT_GT(lost, 0.3F);
    }
  }
}

TEST(TwelveMarks, AreTwelveEachOfAKnownScene) {
  std::set<std::string> labels;
  for (const MarkPointer& mark : twelve_marks()) {
    labels.insert(mark.label);
    EXPECT_NE(std::find(show_scene_names().begin(), show_scene_names().end(), mark.scene), show_scene_names().end())
        << mark.scene;
    EXPECT_GE(mark.zoom, 1);
  }
  EXPECT_EQ(labels.size(), 12U);
}

class ShowPicture : public testing_support::HeadlessFixture {};

TEST_F(ShowPicture, TheMontageFillsItsTwelveTiles) {
  Renderer renderer = make_renderer();
  const Image image = marks_montage(renderer, 640, 360, 1);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const auto tile = testing_support::mean_at(image, {80.0 + 160 * column, 50.0 + 121 * row}, 20);
      EXPECT_GT(tile[0] + tile[1] + tile[2], 60) << row << " " << column;
    }
  EXPECT_THROW(marks_montage(renderer, 200, 100, 1), std::invalid_argument);
}

struct Patch {
  const char* what;
  double x, y, red, green, blue;
};
constexpr Patch kAbdomenPatches[] = {{"liver", 0.40, 0.12, 139, 48, 35},     {"gallbladder", 0.62, 0.40, 202, 201, 174},
                                     {"fat", 0.45, 0.85, 200, 166, 89},      {"stomach", 0.42, 0.42, 190, 139, 122},
                                     {"fat aside", 0.80, 0.60, 137, 91, 38}, {"sheath", 0.24, 0.72, 33, 28, 24}};

/// Mean colours of places: what a picture looks like from afar, whatever the driver's last bits.
TEST_F(ShowPicture, TheAbdomenLooksAsItDidFromAfar) {
  Renderer renderer = make_renderer();
  const Image image = renderer.render(show_scene("abdomen"), 640, 360);
  for (const Patch& p : kAbdomenPatches) {
    const auto seen = testing_support::mean_at(image, {p.x * 640, p.y * 360}, 10);
    EXPECT_NEAR(seen[0], p.red, 14) << p.what;
    EXPECT_NEAR(seen[1], p.green, 14) << p.what;
    EXPECT_NEAR(seen[2], p.blue, 14) << p.what;
  }
}

}  // namespace
}  // namespace trocar::graphics_show_test
