// The bars of the organ surface on the real CT and its label map; skipped, loudly, where the shared data folder is
// missing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/surface/vessel_graph.h"
#include "tissue/organ/scene_compiler.h"
#include "tissue/solid/lattice.h"
#include "tissue/solid/tetrahedra.h"

namespace trocar::golden_path_test {
namespace {

class GoldenPath : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* elsewhere = std::getenv("TROCAR_SHARED");
    data_ = std::filesystem::path(elsewhere != nullptr ? elsewhere : TROCAR_SOURCE_DIR "/../shared") / "data" /
            "ct_abdomen_totalseg";
    if (std::filesystem::is_directory(data_)) return;
    std::cerr << "SKIPPED: no shared data in " << data_ << "; real label maps were NOT tested\n";
    GTEST_SKIP() << "no shared data in " << data_;
  }

  LabelVolume mask(const std::string& name) const {
    return test::read_label_volume(data_ / "masks_v1" / (name + ".nii.gz"));
  }

  static void expect_sound(const MeshFacts& facts, const std::string& name) {
    EXPECT_TRUE(facts.topology.closed() && facts.topology.manifold()) << name;
    EXPECT_EQ(facts.self_intersections, 0U) << name;
    EXPECT_EQ(facts.topology.degenerate_triangles, 0U) << name;
    EXPECT_GE(facts.quality.share_above_15, 0.99) << name;
    const double bar = *facts.label_volume_ml > 50 ? 1 : *facts.label_volume_ml > 10 ? 2 : 3;
    EXPECT_NEAR(facts.volume_error_pct, 0, bar) << name;
  }

  void expect_bars(const std::string& name) {
    const CompiledOrgan organ = compile_label(mask(name), 1, {3000});
    const MeshFacts& facts = organ.facts;
    expect_sound(facts, name);
    EXPECT_NEAR(static_cast<double>(organ.surface.triangles.size()), 3000, 150) << name;
    EXPECT_LE(facts.distance.mean_m, 0.35e-3) << name;  // of the liver; VTK's filters come to 0.35 at this count
    EXPECT_LE(facts.distance.p99_m, 1.25e-3) << name;
    EXPECT_LE(facts.distance_back.mean_m, 0.5e-3) << name;
    EXPECT_LE(facts.distance_back.p99_m, 2.0e-3) << name;  // 1.5 mm is aimed at; liver and right kidney are above
    EXPECT_LE(facts.centroid_offset_m, 0.5e-3) << name;
    EXPECT_GT(facts.quality.min_angle_deg, 20) << name;
  }

  std::filesystem::path data_;
};

TEST_F(GoldenPath, LiverMeetsTheBars) { expect_bars("liver"); }
TEST_F(GoldenPath, GallbladderMeetsTheBars) { expect_bars("gallbladder"); }
TEST_F(GoldenPath, SpleenMeetsTheBars) { expect_bars("spleen"); }
TEST_F(GoldenPath, LeftKidneyMeetsTheBars) { expect_bars("kidney_left"); }
TEST_F(GoldenPath, RightKidneyMeetsTheBars) { expect_bars("kidney_right"); }
TEST_F(GoldenPath, BladderMeetsTheBars) { expect_bars("urinary_bladder"); }

TEST_F(GoldenPath, ThinAndManyPartOrgansAreClosedManifoldAndWhole) {
  for (const std::string name : {"pancreas", "colon", "aorta", "adrenal_gland_left", "adrenal_gland_right"})
    expect_sound(compile_label(mask(name), 1, {3000}).facts, name);
}

TEST_F(GoldenPath, PancreasOfSixPartsLosesCrumbsOnly) {
  const MeshFacts facts = compile_label(mask("pancreas"), 1, {2000}).facts;
  std::size_t lost = 0;
  for (const LostPart& part : facts.lost) lost += part.voxels;
  EXPECT_LE(lost, 8U);
  EXPECT_EQ(facts.topology.components, 2U);
  ASSERT_FALSE(facts.added.empty());
  EXPECT_EQ(facts.added[0].kind, "bridge");
}

TEST_F(GoldenPath, LiverAndGallbladderShareTheirBed) {
  LabelMap map;
  map.layers.push_back(test::read_label_volume(data_ / "example_seg.nii.gz"));
  const CompiledScene scene =
      compile_scene(map, {{0, 5, "liver", 3000}, {0, 4, "gallbladder", 2000}, {0, 1, "spleen", 2000}}, {});
  for (const CompiledOrgan& organ : scene.organs) {
    EXPECT_TRUE(organ.facts.topology.closed() && organ.facts.topology.manifold());
    EXPECT_EQ(organ.facts.self_intersections, 0U);
    EXPECT_NEAR(organ.facts.volume_error_pct, 0, 1);
    EXPECT_LE(organ.facts.distance.mean_m, 0.6e-3);
  }
  ASSERT_EQ(scene.shared.size(), 1U);
  EXPECT_GT(scene.shared[0].area_m2, 10e-4);
  EXPECT_LT(scene.shared[0].area_m2, 35e-4);
  EXPECT_FALSE(scene.attachments.empty());
}

TEST_F(GoldenPath, LiverAmongItsNeighboursHasNoThinTrianglesAndDoesNotCutItself) {
  LabelMap map;
  map.layers.push_back(test::read_label_volume(data_ / "example_seg.nii.gz"));
  const CompiledScene scene = compile_scene(
      map,
      {{0, 5, "liver"}, {0, 2, "right kidney"}, {0, 11, "right adrenal"}, {0, 4, "gallbladder"}, {0, 8, "vena cava"}},
      {});
  for (const CompiledOrgan& organ : scene.organs) {
    EXPECT_TRUE(organ.facts.topology.closed() && organ.facts.topology.manifold());
    EXPECT_EQ(organ.facts.self_intersections, 0U);
    EXPECT_GE(organ.facts.quality.share_above_15, 0.99);
    EXPECT_LE(organ.facts.distance.mean_m, 0.6e-3);
    EXPECT_LE(organ.facts.distance_back.p99_m, 3e-3);  // the adrenal melted away at its thin ends before: 5.5 mm
    EXPECT_NEAR(organ.facts.kept_error_pct, 0, 0.2);
  }
}

TEST_F(GoldenPath, LiverLatticeAndVesselGraph) {
  const LabelVolume volume = mask("liver");
  const BuiltLattice built = build_lattice(compile_label(volume, 1, {6000}).surface, {.cell_m = 0.010}, &volume);
  EXPECT_NEAR(built.facts.volume_error_pct, 0, 1);  // the flat cap lies between two layers of samples
  EXPECT_GT(built.facts.nodes, 1200U);
  EXPECT_EQ(built.facts.components, 1U);
  const VesselGraph aorta = vessel_graph(mask("aorta"), 1);
  EXPECT_EQ(aorta.parts, 1U);
  EXPECT_GT(aorta.length_m, 0.10);
  EXPECT_LT(aorta.branchings(), 6U);
}

TEST_F(GoldenPath, TetrahedraOfEveryGoldenOrganStandUpAndKeepTheVolume) {
  for (const std::string name : {"gallbladder", "spleen", "kidney_left", "kidney_right", "urinary_bladder", "liver"})
    for (const double cell : {0.010, 0.006}) {
      const TriangleSurface surface = compile_label(mask(name), 1, {6000}).surface;
      const BuiltTetrahedra built = make_tetrahedra({&surface}, {.cell_m = cell});
      EXPECT_NEAR(built.facts.volume_error_pct, 0, 0.1) << name << ' ' << cell;
      EXPECT_GE(built.facts.min_dihedral_deg, 14) << name << ' ' << cell;
      EXPECT_LE(built.facts.surface_rms_m, 0.07 * cell) << name << ' ' << cell;
      EXPECT_LE(built.facts.surface_max_m, 0.3 * cell) << name << ' ' << cell;
    }
}

}  // namespace
}  // namespace trocar::golden_path_test
