// Organs round the subject as they are felt and seen: order, poses, looks, and the portrait of a scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "app/picture/models/organ_scene.h"
#include "app/picture/scene/tissue_painter.h"
#include "app/session/setup/adjacent_organs.h"
#include "tests/tissue/support/shapes.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar::adjacent_organs_in_a_scene_test {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(TROCAR_SOURCE_DIR) / "assets";

Organ organ_of(const std::string& name, const TriangleSurface& surface) {
  Organ organ;
  organ.name = organ.material = name;
  organ.surface = surface;
  return organ;
}

struct Abdomen {
  Organ organ = organ_of("liver", test::box(Vec3(-0.08, -0.08, -0.05), Vec3(0.08, 0.08, 0)));
  Exercise exercise;
  MaterialTable materials = MaterialTable::load(kAssets / "materials.toml");
  Pose X_TO;

  Abdomen() {
    exercise.layout.region_x_m = 0.08, exercise.layout.region_y_m = 0.06;
    exercise.surface = {.stiffness_n_per_m = 100, .damping_s_per_m = 0.4, .mu_static = 0, .mu_dynamic = 0};
  }
  void add(const std::string& name, const Vec3& low, const Vec3& high) {
    organ.adjacent.push_back(organ_of(name, test::box(low, high)));
  }
  AdjacentOrgans placed() const {
    return place_adjacent_organs(organ, organ.surface.transformed(X_TO), X_TO, exercise, materials);
  }
};

/// Organs of the given names in a row beside the subject, far from its region.
Abdomen row_of(const std::vector<std::string>& names) {
  Abdomen abdomen;
  for (const std::string& name : names) {
    const double x = 0.1 + 0.05 * static_cast<double>(abdomen.organ.adjacent.size());
    abdomen.add(name, Vec3(x, 0, 0), Vec3(x + 0.03, 0.03, 0.03));
  }
  return abdomen;
}

TEST(AdjacentOrgansInAScene, FeltIsTheSubjectThenEachOtherInOrder) {
  const AdjacentOrgans all = row_of({"spleen", "colon", "aorta"}).placed();
  ASSERT_EQ(all.organs.size(), 3U);
  ASSERT_EQ(all.felt_T.triangles.size(), 48U);
  ASSERT_EQ(all.triangle_material.size(), 48U);
  EXPECT_EQ(all.felt_T.vertices.size(), 32U);
  for (std::size_t n = 0; n < 48; ++n)
    for (const std::int32_t corner : all.felt_T.triangles[n])
      EXPECT_EQ(static_cast<std::size_t>(corner) / 8, n / 12) << "of the organ's own vertices";
  double volume = 0.16 * 0.16 * 0.05;
  for (const AdjacentOrgan& other : all.organs) volume += other.surface_T->volume_m3();
  EXPECT_NEAR(all.felt_T.volume_m3(), volume, 1e-12);
}

TEST(AdjacentOrgansInAScene, OfOneMaterialShareOneEntry) {
  const AdjacentOrgans all = row_of({"colon", "duodenum", "colon", "aorta", "cystic_artery"}).placed();
  std::set<std::int32_t> used(all.triangle_material.begin(), all.triangle_material.end());
  EXPECT_EQ(used.size(), all.materials.size() + 1) << "every entry is used, and 0 by the subject";
  EXPECT_EQ(all.triangle_material[12], all.triangle_material[36]) << "both colons";
  EXPECT_EQ(all.triangle_material[48], all.triangle_material[60]) << "both arteries";
  for (std::size_t n = 0; n < all.organs.size(); ++n) {
    const MaterialTable materials = MaterialTable::load(kAssets / "materials.toml");
    const ContactMaterial wanted =
        materials.beside({.stiffness_n_per_m = 100, .damping_s_per_m = 0.4}, "liver", all.organs[n].material);
    const auto index = static_cast<std::size_t>(all.triangle_material[12 * (n + 1)]);
    EXPECT_DOUBLE_EQ(all.materials.at(index - 1).stiffness_n_per_m, wanted.stiffness_n_per_m);
    EXPECT_EQ(all.materials.at(index - 1).damping_s_per_m, 0.4);
  }
}

TEST(AdjacentOrgansInAScene, AnotherOrderOfTheFileIsTheSameAbdomen) {
  std::vector<std::string> names{"spleen", "colon", "aorta", "pancreas"};
  const AdjacentOrgans before = row_of(names).placed();
  Abdomen abdomen = row_of(names);
  std::reverse(abdomen.organ.adjacent.begin(), abdomen.organ.adjacent.end());
  const AdjacentOrgans after = abdomen.placed();
  for (std::size_t n = 0; n < names.size(); ++n) {
    const std::size_t m = names.size() - 1 - n;
    EXPECT_EQ(before.organs[n].name, after.organs[m].name);
    EXPECT_EQ(before.organs[n].surface_T->vertices, after.organs[m].surface_T->vertices);
    const auto a = static_cast<std::size_t>(before.triangle_material[12 * (n + 1)]),
               b = static_cast<std::size_t>(after.triangle_material[12 * (m + 1)]);
    EXPECT_EQ(before.materials.at(a - 1).stiffness_n_per_m, after.materials.at(b - 1).stiffness_n_per_m);
  }
}

TEST(AdjacentOrgansInAScene, MoveRigidlyWithTheSubject) {
  Abdomen abdomen = row_of({"spleen", "colon"});
  abdomen.X_TO = Pose{Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix(), Vec3(0.002, -0.001, 0)};
  const AdjacentOrgans all = abdomen.placed();
  ASSERT_EQ(all.organs.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    const TriangleSurface& before = abdomen.organ.adjacent[n].surface;
    for (std::size_t v = 0; v < before.vertices.size(); ++v)
      EXPECT_NEAR(
          (all.organs[n].surface_T->vertices[v] - (abdomen.X_TO.R * before.vertices[v] + abdomen.X_TO.p)).norm(), 0,
          1e-15);
  }
}

TEST(AdjacentOrgansInAScene, WhatIsSetAsideIsNeitherFeltNorSeen) {
  Abdomen abdomen = row_of({"spleen", "colon"});
  const AdjacentOrgans before = abdomen.placed();
  abdomen.add("stomach", Vec3(0.0, 0.0, 0.01), Vec3(0.02, 0.02, 0.03));
  const AdjacentOrgans after = abdomen.placed();
  EXPECT_EQ(after.set_aside, std::vector<std::string>{"stomach"});
  EXPECT_EQ(after.organs.size(), 2U);
  EXPECT_EQ(before.felt_T.vertices, after.felt_T.vertices);
  EXPECT_EQ(before.felt_T.triangles, after.felt_T.triangles);
  EXPECT_EQ(before.triangle_material, after.triangle_material);
}

TEST(AdjacentOrgansInAScene, CoverCountsOnlyOverTheRegionAndItsRim) {
  for (const double gap : {-0.02, 0.03}) {
    Abdomen abdomen;
    const double x = abdomen.exercise.layout.region_x_m / 2 + gap;
    abdomen.add("stomach", Vec3(x, -0.01, 0.005), Vec3(x + 0.1, 0.01, 0.02));
    const AdjacentOrgans all = abdomen.placed();
    EXPECT_EQ(all.set_aside.size(), gap < 0 ? 1U : 0U) << gap;
    EXPECT_EQ(all.organs.size(), gap < 0 ? 0U : 1U) << gap;
  }
}

TEST(AdjacentOrgansInAScene, AboveButLowerThanTheSubjectIsNoCover) {
  Abdomen abdomen;
  abdomen.add("gallbladder", Vec3(-0.03, -0.03, -0.04), Vec3(0.03, 0.03, -0.001));
  abdomen.add("stomach", Vec3(-0.03, -0.03, -0.04), Vec3(0.03, 0.03, 0.001));
  EXPECT_EQ(abdomen.placed().set_aside, std::vector<std::string>{"stomach"});
}

TEST(AdjacentMaterials, NoTriangleEverPointsBeyondThePatch) {
  std::mt19937 generator(4);
  const MaterialTable table = MaterialTable::load(kAssets / "materials.toml");
  for (int n = 0; n < 20; ++n) {
    std::vector<std::string> names;
    for (int m = static_cast<int>(generator() % 14); m >= 0; --m)
      names.push_back(table.all()[generator() % table.all().size()].name);
    const AdjacentOrgans all = row_of(names).placed();
    ASSERT_EQ(all.organs.size(), names.size());
    ASSERT_LT(all.materials.size(), static_cast<std::size_t>(kMaxPatchMaterials));
    for (std::size_t t = 0; t < all.triangle_material.size(); ++t) {
      EXPECT_EQ(all.triangle_material[t] == 0, t < 12) << "only the subject's are 0";
      EXPECT_LE(all.triangle_material[t], static_cast<std::int32_t>(all.materials.size()));
    }
    for (const ContactMaterial& material : all.materials) {
      EXPECT_GE(material.stiffness_n_per_m, 25);
      EXPECT_LE(material.stiffness_n_per_m, 200);
    }
  }
}

TEST(TissueLook, GoesByTheWordInTheName) {
  for (const auto& [name, look] :
       {std::pair("liver", "LOOK_LIVER"), std::pair("liver_segment_4", "LOOK_LIVER"),
        std::pair("gallbladder", "LOOK_GALLBLADDER"), std::pair("cystic_duct", "LOOK_DUCT"),
        std::pair("cystic_artery", "LOOK_ARTERY"), std::pair("aorta", "LOOK_ARTERY"),
        std::pair("portal_vein_and_splenic_vein", "LOOK_VEIN"), std::pair("inferior_vena_cava", "LOOK_VEIN"),
        std::pair("spleen", "LOOK_SPLEEN"), std::pair("kidney_left", "LOOK_KIDNEY"),
        std::pair("vertebrae_L3", "LOOK_BONE"), std::pair("colon", "LOOK_FLESH"), std::pair("", "LOOK_FLESH"),
        std::pair("label-7", "LOOK_FLESH")})
    EXPECT_EQ(tissue_look(name), look) << name;
}

TEST(TissueLook, EveryLookOfAMaterialIsKnownToTheShader) {
  const std::string shader = read_bytes(kAssets / "shaders" / "tissue.frag");
  const MaterialTable table = MaterialTable::load(kAssets / "materials.toml");
  for (const TissueMaterial& material : table.all()) {
    const std::string look = tissue_look(material.name);
    EXPECT_TRUE(look == "LOOK_FLESH" || shader.find(look) != std::string::npos) << look;
  }
}

TEST(OrganPortrait, KeepsShapesAndDistancesOfTheWholeScene) {
  Organ organ = organ_of("liver", test::sphere(Vec3(0.4, -0.2, 0.9), 0.05, 2));
  organ.adjacent.push_back(organ_of("spleen", test::sphere(Vec3(0.5, -0.2, 0.9), 0.03, 2)));
  const SceneView view = organ_scene(organ);
  ASSERT_EQ(view.adjacent.size(), 1U);
  EXPECT_EQ(view.adjacent[0].material, "spleen");
  EXPECT_NEAR(view.organ->volume_m3(), organ.surface.volume_m3(), 1e-12) << "turned, never mirrored";
  const Vec3 between = view.adjacent[0].surface->bounds().center() - view.organ->bounds().center();
  EXPECT_NEAR((between - Vec3(-0.1, 0, 0)).norm(), 0, 1e-9) << "the patient's right is on the left";
  Eigen::AlignedBox3d box = view.organ->bounds();
  box.extend(view.adjacent[0].surface->bounds());
  EXPECT_NEAR(box.center().norm(), 0, 1e-9);
  EXPECT_FALSE(box.contains(view.camera.eye_T));
}

TEST(OrganPortrait, LeavesOutWhatSurroundsTheSubject) {
  Organ organ = organ_of("liver", test::sphere(Vec3::Zero(), 0.05, 2));
  const SceneView alone = organ_scene(organ);
  organ.adjacent.push_back(organ_of("abdominal_wall", test::box(Vec3::Constant(-0.3), Vec3::Constant(0.4))));
  const SceneView walled = organ_scene(organ);
  EXPECT_TRUE(walled.adjacent.empty());
  EXPECT_EQ(alone.organ->vertices, walled.organ->vertices);
  EXPECT_EQ(alone.camera.eye_T, walled.camera.eye_T);
}

TEST(OrganPortrait, DoesNotDependOnWhereTheImageLayAndGrowsWithTheOrgan) {
  const SceneView here = organ_scene(organ_of("liver", test::sphere(Vec3::Zero(), 0.05, 2)));
  const SceneView there = organ_scene(organ_of("liver", test::sphere(Vec3(1, 2, -3), 0.05, 2)));
  EXPECT_NEAR((here.camera.eye_T - there.camera.eye_T).norm(), 0, 1e-9);
  EXPECT_NEAR((here.X_TI.p - there.X_TI.p).norm(), 0, 1e-9);
  const SceneView large = organ_scene(organ_of("liver", test::sphere(Vec3::Zero(), 0.10, 2)));
  EXPECT_GT((large.camera.eye_T - large.camera.look_at_T).norm(), (here.camera.eye_T - here.camera.look_at_T).norm());
}

TEST(OrganPortrait, TheInstrumentIsHeldProperlyAndOutsideTheOrgan) {
  for (const double radius : {0.01, 0.04, 0.12}) {
    const SceneView view = organ_scene(organ_of("liver", test::sphere(Vec3(0.1, 0, 0), radius, 3)));
    EXPECT_NEAR((view.X_TI.R.transpose() * view.X_TI.R - Mat3::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(view.X_TI.R.determinant(), 1, 1e-12);
    EXPECT_LT(view.X_TI.R.col(2).z(), 0) << "the shaft points down to its tip";
    EXPECT_GT(view.X_TI.p.norm(), radius) << "above the surface";
  }
}

TEST(OrganPortrait, TheCreditSaysWhatMustBeSaidOnce) {
  Organ organ = organ_of("liver", test::sphere(Vec3::Zero(), 0.05, 1));
  organ.licence = "CC-BY-4.0", organ.credit = "A hospital, CC-BY-4.0", organ.cut_at_border = true;
  const std::string credit = organ_scene(organ).hud.credit;
  EXPECT_NE(credit.find("liver"), std::string::npos);
  EXPECT_EQ(credit.find("CC-BY-4.0"), credit.rfind("CC-BY-4.0")) << credit;
  EXPECT_NE(credit.find("not anatomy"), std::string::npos);
  EXPECT_EQ(credit.find("synthetic"), std::string::npos);
}

}  // namespace
}  // namespace trocar::adjacent_organs_in_a_scene_test
