#include "app/session/setup/adjacent_organs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "app/session/setup/scene.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/tissue/support/shapes.h"
#include "tissue/tissue_world.h"

namespace trocar::adjacent_organs_test {
namespace {

/// A slab whose upper face lies at z = 0 under the region, and organs round it.
struct Place {
  Organ organ;
  Exercise exercise;
  MaterialTable materials = MaterialTable::load(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "materials.toml");

  Place() {
    organ.name = organ.material = "liver";
    organ.surface = test::box(Vec3(-0.08, -0.08, -0.05), Vec3(0.08, 0.08, 0));
    exercise.layout.region_x_m = exercise.layout.region_y_m = 0.08;
    exercise.surface.stiffness_n_per_m = 150;
  }
  void add(const std::string& name, const Vec3& low, const Vec3& high) {
    Organ other;
    other.name = other.material = name;
    other.surface = test::box(low, high);
    organ.adjacent.push_back(other);
  }
  AdjacentOrgans placed() const { return place_adjacent_organs(organ, organ.surface, Pose{}, exercise, materials); }
};

TEST(AdjacentOrgans, LieWhereTheImageHadThemAndAreFelt) {
  Place place;
  place.add("spleen", Vec3(0.09, -0.02, -0.04), Vec3(0.12, 0.02, 0.01));
  const AdjacentOrgans all = place.placed();
  ASSERT_EQ(all.organs.size(), 1U);
  EXPECT_EQ(all.organs[0].surface_T->bounds().min().x(), 0.09);
  EXPECT_EQ(all.felt_T.triangles.size(), 24U);
  ASSERT_EQ(all.triangle_material.size(), 24U);
  EXPECT_EQ(all.triangle_material[0], 0);
  EXPECT_EQ(all.triangle_material[12], 1);
  EXPECT_NEAR(all.materials.at(0).stiffness_n_per_m, 150.0 * 28 / 32, 1e-9);
}

TEST(AdjacentOrgans, WhatCoversTheRegionIsSetAsideByName) {
  Place place;
  place.add("abdominal_wall", Vec3(-0.1, -0.1, 0.05), Vec3(0.1, 0.1, 0.06));
  place.add("colon", Vec3(-0.1, -0.12, -0.03), Vec3(0.1, -0.09, 0.02));
  const AdjacentOrgans all = place.placed();
  EXPECT_EQ(all.set_aside, std::vector<std::string>{"abdominal_wall"});
  ASSERT_EQ(all.organs.size(), 1U);
  EXPECT_EQ(all.organs[0].name, "colon");
}

TEST(AdjacentOrgans, WhatLiesBelowTheSurfaceStays) {
  Place place;
  place.add("gallbladder", Vec3(-0.01, -0.01, -0.08), Vec3(0.01, 0.01, -0.04));
  EXPECT_TRUE(place.placed().set_aside.empty());
}

TEST(AdjacentOrgans, WithoutAnyTheOrganAloneIsFelt) {
  Place place;
  place.add("abdominal_wall", Vec3(-0.1, -0.1, 0.05), Vec3(0.1, 0.1, 0.06));
  const AdjacentOrgans all = place.placed();
  EXPECT_TRUE(all.felt_T.triangles.empty());
  Scene scene;
  scene.organ_T = still_surface(place.organ.surface);
  scene.adjacent = all;
  EXPECT_EQ(&felt_surface(scene), scene.organ_T.get());
}

TEST(AdjacentOrgans, MoreMaterialsThanAPatchHoldsShareTheMostAlike) {
  Place place;
  for (const char* name : {"spleen", "kidney_left", "pancreas", "colon", "fat", "aorta", "inferior_vena_cava",
                           "vertebrae_L3", "gallbladder"}) {
    const double x = 0.1 + 0.05 * static_cast<double>(place.organ.adjacent.size());
    place.add(name, Vec3(x, 0, 0), Vec3(x + 0.03, 0.03, 0.03));
  }
  const AdjacentOrgans all = place.placed();
  EXPECT_EQ(all.organs.size(), 9U);
  EXPECT_LE(all.materials.size(), static_cast<std::size_t>(kMaxPatchMaterials - 1));
  for (const std::int32_t material : all.triangle_material)
    EXPECT_LE(material, static_cast<std::int32_t>(all.materials.size()));
}

TEST(AdjacentOrgans, ThePatchGivesEachTriangleItsMaterial) {
  Place place;
  place.add("kidney_left", Vec3(0.082, -0.03, -0.05), Vec3(0.12, 0.03, 0));
  const AdjacentOrgans all = place.placed();
  TissueWorld world({.organ_T = &all.felt_T,
                     .organ = place.exercise.surface,
                     .triangle_material = all.triangle_material,
                     .adjacent = all.materials,
                     .rigid = {}});
  StylusState state;
  state.X_TI.p = Vec3(0.081, 0, 0.005);
  const auto patch = std::make_unique<ContactPatch>();
  world.step({state}, true, *patch);
  int of_organ = 0, of_adjacent = 0;
  for (int n = 0; n < patch->count; ++n) {
    const PatchTriangle& triangle = patch->triangle[static_cast<std::size_t>(n)];
    (triangle.id < 12 ? of_organ : of_adjacent) += 1;
    EXPECT_EQ(triangle.material, triangle.id < 12 ? 0 : 1);
  }
  EXPECT_GT(of_organ, 0);
  EXPECT_GT(of_adjacent, 0);
  EXPECT_EQ(patch->material[0].stiffness_n_per_m, 150);
  EXPECT_EQ(patch->material[1].stiffness_n_per_m, all.materials[0].stiffness_n_per_m);
}

TEST(ShippedAbdomen, IsOneFrameOfOrgansForTheTouchExercise) {
  const AssetRoots assets = find_assets();
  const Organ organ = load_organ(find_organ("phantom-abdomen", assets.assets));
  EXPECT_EQ(organ.name, "liver");
  EXPECT_TRUE(organ.synthetic);
  EXPECT_EQ(organ.licence, "CC0-1.0");
  std::set<std::string> names;
  for (const Organ& other : organ.adjacent) names.insert(other.name);
  for (const char* name : {"gallbladder", "cystic_duct", "common_bile_duct", "cystic_artery", "hepatic_artery",
                           "stomach", "colon", "small_bowel", "kidney_right", "spleen"})
    EXPECT_TRUE(names.contains(name)) << name;
  AttemptSetup setup;
  setup.exercise = find_exercise("surface-touch", assets.exercises);
  setup.organ = "phantom-abdomen";
  setup.hand = "expert";
  const Scene scene = build_scene(setup, assets, {"simulated", 1000, 16});
  EXPECT_EQ(scene.adjacent.organs.size() + scene.adjacent.set_aside.size(), names.size());
  EXPECT_GT(scene.adjacent.felt_T.triangles.size(), scene.organ_T->triangles.size());
  EXPECT_EQ(scene.board.targets.size(), 12U);
  EXPECT_EQ(scene.board.spacing_m, setup.exercise.layout.min_spacing_m) << "a whole liver has room";
}

TEST(ShippedAbdomen, TheCysticDuctAndArteryLieAtTheGallbladder) {
  const Organ organ = load_organ(find_organ("phantom-abdomen#gallbladder", find_assets().assets));
  ASSERT_EQ(organ.name, "gallbladder");
  const auto gap = [&](const std::string& name) {
    for (const Organ& other : organ.adjacent) {
      if (other.name != name) continue;
      double nearest = 1;
      for (const Vec3& a : other.surface.vertices)
        for (const Vec3& b : organ.surface.vertices) nearest = std::min(nearest, (a - b).norm());
      return nearest;
    }
    return 1.0;
  };
  EXPECT_LT(gap("cystic_duct"), 1e-6) << "they share triangles";
  EXPECT_LT(gap("cystic_artery"), 1e-6);
  EXPECT_GT(gap("spleen"), 0.02);
}

}  // namespace
}  // namespace trocar::adjacent_organs_test
