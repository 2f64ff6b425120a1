#include "tissue/organ/organ_compiler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/ply_file.h"

namespace trocar::organ_compiler_test {
namespace {

void expect_sound(const MeshFacts& facts) {
  EXPECT_TRUE(facts.topology.closed());
  EXPECT_TRUE(facts.topology.manifold());
  EXPECT_EQ(facts.topology.components, 1U);
  EXPECT_EQ(facts.topology.degenerate_triangles, 0U);
  EXPECT_EQ(facts.self_intersections, 0U);
}

TEST(OrganCompiler, BallKeepsVolumePlaceAndSize) {
  const Eigen::Vector3d centre_mm(3, -2, 1);
  const LabelVolume volume = test::ball_volume(40, 2, centre_mm, 25);
  const CompiledOrgan organ = compile_label(volume, 1, {2000});
  expect_sound(organ.facts);
  EXPECT_EQ(organ.facts.topology.genus, 0);
  EXPECT_NEAR(static_cast<double>(organ.facts.topology.triangles), 2000, 100);
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 0.05);
  EXPECT_NEAR(organ.facts.volume_ml, test::sphere_volume(2.5),
              0.01 * organ.facts.volume_ml);  // of the voxel count, not of the ball
  EXPECT_LT((volume_centroid_m(organ.surface) - centre_mm * 1e-3).norm(), 1e-4);
  for (const Vec3& vertex : organ.surface.vertices)
    EXPECT_NEAR((vertex - centre_mm * 1e-3).norm(), 0.025, 0.0012);  // 0.6 voxel
  EXPECT_FALSE(organ.facts.cut_at_border());
  EXPECT_TRUE(organ.facts.lost.empty());
}

TEST(OrganCompiler, SameInputGivesTheSameBytes) {
  const LabelVolume volume = test::ball_volume(24, 3, {4, 0, -3}, 22);
  EXPECT_EQ(ply_bytes(compile_label(volume, 1, {1000}).surface), ply_bytes(compile_label(volume, 1, {1000}).surface));
}

TEST(OrganCompiler, StorageOrderDoesNotMatter) {
  const LabelVolume volume = test::ball_volume(24, 3, {4, 0, -3}, 22);
  LabelVolume flipped = volume;
  flipped.index_to_ras_mm.linear().col(0) *= -1;
  flipped.index_to_ras_mm.translation().x() *= -1;
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i) flipped.labels[flipped.offset(i, j, k)] = volume.labels[volume.offset(23 - i, j, k)];
  EXPECT_EQ(ply_bytes(compile_label(in_ras_order(flipped), 1, {1000}).surface),
            ply_bytes(compile_label(volume, 1, {1000}).surface));
}

TEST(OrganCompiler, ObliqueImageGivesTheTurnedMesh) {
  const LabelVolume volume = test::ball_volume(24, 3, {4, 0, -3}, 22);
  LabelVolume turned = volume;
  const Eigen::Affine3d turn =
      Eigen::Translation3d(10, 20, 30) * Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 1, 0).normalized());
  turned.index_to_ras_mm = turn * volume.index_to_ras_mm;
  const CompiledOrgan straight = compile_label(volume, 1, {1000}), oblique = compile_label(turned, 1, {1000});
  expect_sound(oblique.facts);
  TriangleSurface back = oblique.surface;
  for (Vec3& vertex : back.vertices) vertex = turn.inverse() * (vertex * 1e3) * 1e-3;
  EXPECT_LT(distance_from_to(back, straight.surface).mean_m, 1e-4);
  EXPECT_NEAR(oblique.facts.volume_ml / straight.facts.volume_ml, 1, 1e-3);
}

TEST(OrganCompiler, CutOrganGetsAFlatCapWhereTheImageEnds) {
  const LabelVolume volume =
      test::ball_volume(20, 3, {0, 0, 25}, 22);  // the top slice lies at z = 28.5 mm, its face at 30
  const CompiledOrgan organ = compile_label(volume, 1, {3000});
  expect_sound(organ.facts);
  EXPECT_GT(organ.facts.border_voxels, 100U);
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 0.05);
  std::size_t on_cap = 0;
  for (const Vec3& vertex : organ.surface.vertices) {
    EXPECT_LT(vertex.z(), 0.0306);  // a fifth of a voxel above the face
    const bool well_inside = vertex.head<2>().norm() < 0.014 && vertex.z() > 0.015;
    EXPECT_NEAR(well_inside ? vertex.z() : 0.030, 0.030, 0.0004);
    on_cap += well_inside ? 1 : 0;
  }
  EXPECT_GT(on_cap, 50U);
  EXPECT_TRUE(std::any_of(organ.facts.repairs.begin(), organ.facts.repairs.end(),
                          [](const std::string& r) { return r.find("flat cap") != std::string::npos; }));
}

TEST(OrganCompiler, ReportsLostPartsAndFilledCavities) {
  LabelVolume volume = test::ball_volume(30, 2, {0, 0, 0}, 20);
  volume.labels[volume.offset(15, 15, 15)] = 0;
  for (int n = 0; n < 3; ++n) volume.labels[volume.offset(1 + n, 1, 1)] = 1;
  const CompiledOrgan organ = compile_label(volume, 1, {1000});
  ASSERT_EQ(organ.facts.lost.size(), 1U);
  EXPECT_EQ(organ.facts.lost[0].kind, "part");
  EXPECT_EQ(organ.facts.lost[0].voxels, 3U);
  EXPECT_NEAR(organ.facts.lost[0].volume_ml, 3 * 0.008, 1e-9);
  EXPECT_TRUE(std::count(organ.facts.repairs.begin(), organ.facts.repairs.end(), "filled a cavity of 1 voxels"));
  EXPECT_NEAR(organ.facts.kept_volume_ml - *organ.facts.label_volume_ml, (1 - 3) * 0.008, 1e-9);
  EXPECT_NEAR(organ.facts.kept_error_pct, 0, 0.05);
}

TEST(OrganCompiler, AnisotropicVoxelsKeepTheVolume) {
  LabelVolume volume = test::ball_volume(30, 2, {0, 0, 0}, 20);
  volume.index_to_ras_mm.linear() = Eigen::Vector3d(0.8, 0.8, 3).asDiagonal();
  const CompiledOrgan organ = compile_label(volume, 1, {2000});
  expect_sound(organ.facts);
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 0.05);
}

TEST(OrganCompiler, ThinTubeSurvives) {
  LabelVolume volume;
  volume.size = {40, 7, 7};
  volume.index_to_ras_mm.linear() *= 2;
  volume.labels.assign(volume.offset(0, 0, 7), 0);
  for (int i = 3; i < 37; ++i)
    for (const auto& [j, k] : {std::pair(3, 3), std::pair(4, 3), std::pair(3, 4), std::pair(4, 4)})
      volume.labels[volume.offset(i, j, k)] = 1;
  const CompiledOrgan organ = compile_label(volume, 1, {1500});
  expect_sound(organ.facts);
  EXPECT_GT(organ.surface.bounds().sizes().x(), 0.064);  // of 68 mm
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 0.1);
}

TEST(OrganCompiler, RemeshesAnImportedSurface) {
  const TriangleSurface source = test::sphere(Vec3(0.1, 0, 0), 0.04, 4);
  const CompiledOrgan organ = compile_surface(source, {1200});
  expect_sound(organ.facts);
  EXPECT_FALSE(organ.facts.label_volume_ml.has_value());
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 0.05);
  EXPECT_LT(organ.facts.distance.max_m, 4e-4);
  EXPECT_NEAR(static_cast<double>(organ.facts.topology.triangles), 1200, 100);
}

TEST(OrganCompiler, RefusesAnAbsentLabel) {
  EXPECT_CONTAINS(test::message_of<InputError>([] {
                    compile_label(test::ball_volume(10, 2, {0, 0, 0}, 6), 5, {});
                  }),
                  "label 5");
}

TEST(OrganCompiler, ASurfaceOfFewVerticesIsFollowedBetweenThemToo) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.05, 3);  // 258 vertices, bends of 10 degrees
  CompileOptions options;
  options.triangles = 2000;
  const MeshFacts facts = compile_surface(ball, options).facts;
  EXPECT_LT(facts.distance.mean_m, 4e-5);
  EXPECT_LT(facts.distance_back.mean_m, 4e-5);
  EXPECT_EQ(facts.self_intersections, 0U);
  EXPECT_GT(facts.quality.min_angle_deg, 20);
}

}  // namespace
}  // namespace trocar::organ_compiler_test
