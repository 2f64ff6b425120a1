#include "app/cli/machine/bench_compiler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/organ/organ_compiler.h"

namespace trocar::bench_compiler_test {
namespace {

double volume_ml(const LabelVolume& volume) {
  return static_cast<double>(std::count(volume.labels.begin(), volume.labels.end(), 1)) * volume.voxel_volume_ml();
}

TEST(BenchCompiler, TheBodyHasTheVolumeOfALiverOnEveryGrid) {
  const double coarse = volume_ml(liver_like_labels({64, 64, 20})), fine = volume_ml(liver_like_labels({128, 128, 40}));
  EXPECT_GT(fine, 900);
  EXPECT_LT(fine, 2000);  // livers of adults: 0.9 to 2 litres
  EXPECT_NEAR(coarse / fine, 1, 0.01);
}

TEST(BenchCompiler, TheBodyIsOnePieceThatTheLastSliceCuts) {
  const LabelVolume volume = liver_like_labels({128, 128, 40});
  const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin);
  EXPECT_TRUE(mask.lost_parts.empty());
  EXPECT_TRUE(mask.cavities.empty());
  EXPECT_FALSE(mask.cut[2][0]);
  EXPECT_TRUE(mask.cut[2][1]);
  EXPECT_FALSE(mask.cut[0][0] || mask.cut[0][1] || mask.cut[1][0] || mask.cut[1][1]);
  EXPECT_EQ(volume.labels, liver_like_labels({128, 128, 40}).labels);
}

TEST(BenchCompiler, CountsWhatItMade) {
  const CompilerCost cost = compiler_cost({96, 96, 40}, 2000);
  EXPECT_NEAR(static_cast<double>(cost.triangles), 2000, 200);
  EXPECT_GT(cost.raw_triangles, 4 * cost.triangles);
  EXPECT_GT(cost.cpu_s, 0);
  EXPECT_GE(cost.peak_growth_mb, 0);
  EXPECT_GT(cost.mean_mm, 0);
  EXPECT_LT(cost.mean_mm, 0.2 * 3.7);  // voxels of 3.7 mm
  EXPECT_GT(cost.p99_mm, cost.mean_mm);
}

/// The same bytes every time, on a map with bends, a cut and more samples than triangles.
TEST(BenchCompiler, TheSameMapGivesTheSameOrgan) {
  const LabelVolume volume = liver_like_labels({96, 96, 40});
  CompileOptions options;
  options.triangles = 1500;
  const CompiledOrgan one = compile_label(volume, 1, options), two = compile_label(volume, 1, options);
  EXPECT_EQ(one.surface.triangles, two.surface.triangles);
  EXPECT_EQ(one.surface.vertices, two.surface.vertices);
  EXPECT_EQ(one.facts.self_intersections, 0U);
  EXPECT_EQ(one.facts.topology.components, 1U);
}

}  // namespace
}  // namespace trocar::bench_compiler_test
