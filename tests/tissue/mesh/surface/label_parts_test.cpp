// Which parts of a label are kept, bridged, lost; and what the working field makes of thin and cut organs.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tissue/support/shapes.h"
#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/isosurface.h"
#include "tissue/organ/organ_compiler.h"

namespace trocar::label_parts_test {
namespace {

LabelVolume empty(int extent, double voxel_mm = 2) {
  LabelVolume volume;
  volume.size = {extent, extent, extent};
  volume.index_to_ras_mm.linear() *= voxel_mm;
  volume.labels.assign(volume.offset(0, 0, extent), 0);
  return volume;
}

void fill(LabelVolume& volume, std::array<int, 3> low, std::array<int, 3> high, std::uint16_t label = 1) {
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) volume.labels[volume.offset(i, j, k)] = label;
}

TEST(PartsRule, PartsThatTouchByACornerAreJoinedByTwoVoxels) {
  LabelVolume volume = empty(16);
  fill(volume, {2, 2, 2}, {5, 5, 5});
  fill(volume, {6, 6, 6}, {9, 9, 9});
  const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin, {});
  EXPECT_EQ(mask.bridge_voxels, 2U);
  EXPECT_EQ(mask.parts, 1U);
  EXPECT_EQ(mask.kept_voxels, 130U);
  EXPECT_TRUE(mask.lost_parts.empty());
}

TEST(PartsRule, EdgeAndOneVoxelGapTakeOneVoxel) {
  LabelVolume volume = empty(16);
  fill(volume, {2, 2, 2}, {5, 5, 5});
  fill(volume, {6, 6, 2}, {9, 9, 5});  // by an edge
  fill(volume, {2, 2, 7}, {5, 5, 9});  // a voxel apart
  EXPECT_EQ(cut_out_label(volume, 1, kSmoothingMargin, {}).bridge_voxels, 2U);
  const LabelMask apart = cut_out_label(volume, 1, kSmoothingMargin, {.bridge_voxels = 0});
  EXPECT_EQ(apart.bridge_voxels, 0U);
  EXPECT_EQ(apart.parts, 3U);
}

TEST(PartsRule, ShareDecidesWhatStaysAndCrumbsAreLost) {
  LabelVolume volume = empty(32);
  fill(volume, {2, 2, 2}, {12, 12, 12});     // 1331
  fill(volume, {20, 20, 20}, {23, 23, 23});  // 64
  fill(volume, {28, 2, 2}, {28, 2, 4});      // 3
  const LabelMask both = cut_out_label(volume, 1, kSmoothingMargin, {});
  EXPECT_EQ(both.parts, 2U);
  EXPECT_EQ(both.lost_parts, std::vector<std::size_t>{3});
  const LabelMask one = cut_out_label(volume, 1, kSmoothingMargin, {.least_share = 0.1});
  EXPECT_EQ(one.parts, 1U);
  EXPECT_EQ(one.lost_parts, (std::vector<std::size_t>{64, 3}));
  EXPECT_EQ(cut_out_label(volume, 1, kSmoothingMargin, {.only_largest = true}).kept_voxels, 1331U);
}

TEST(PartsRule, TwoPartsBecomeOneClosedSurfaceOfTwoPieces) {
  LabelVolume volume = empty(32);
  fill(volume, {4, 4, 4}, {12, 12, 12});
  fill(volume, {18, 18, 18}, {25, 25, 25});
  const CompiledOrgan organ = compile_label(volume, 1, {1200});
  EXPECT_EQ(organ.facts.topology.components, 2U);
  EXPECT_TRUE(organ.facts.topology.closed() && organ.facts.topology.manifold());
  EXPECT_EQ(organ.facts.self_intersections, 0U);
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 0.1);
  EXPECT_TRUE(std::count(organ.facts.repairs.begin(), organ.facts.repairs.end(), "kept 2 parts that lie apart"));
}

TEST(PartsRule, BridgesAndCavitiesAreListedAsAdded) {
  LabelVolume volume = test::ball_volume(30, 2, {0, 0, 0}, 20);
  volume.labels[volume.offset(15, 15, 15)] = 0;
  const CompiledOrgan organ = compile_label(volume, 1, {1000});
  ASSERT_EQ(organ.facts.added.size(), 1U);
  EXPECT_EQ(organ.facts.added[0].kind, "cavity");
  EXPECT_NEAR(organ.facts.added[0].volume_ml, 0.008, 1e-12);
}

TEST(ThinOrgan, OneVoxelTubeKeepsLengthAndVolume) {
  LabelVolume volume = empty(40);
  for (int i = 4; i < 36; ++i) volume.labels[volume.offset(i, 20, 20)] = 1;
  EXPECT_EQ(count_thin_voxels(cut_out_label(volume, 1, kSmoothingMargin, {})), 32U);
  const CompiledOrgan tube = compile_label(volume, 1, {1000});
  EXPECT_EQ(tube.facts.topology.components, 1U);
  EXPECT_EQ(tube.facts.topology.genus, 0);
  EXPECT_GT(tube.surface.bounds().sizes().x(), 0.059);  // of 64 mm
  EXPECT_NEAR(tube.facts.volume_error_pct, 0, 1);
}

TEST(CutOrgan, CapIsAPlaneToTheMicron) {
  const LabelVolume volume = test::ball_volume(20, 3, {0, 0, 25}, 22);
  const CompiledOrgan organ = compile_label(volume, 1, {2000});
  std::size_t on_cap = 0;
  for (const Vec3& vertex : organ.surface.vertices) {
    EXPECT_LT(vertex.z(), 0.030 + 1e-6);
    on_cap += std::abs(vertex.z() - 0.030) < 1e-6 ? 1 : 0;
  }
  EXPECT_GT(on_cap, 100U);
  EXPECT_LT(organ.facts.distance_back.max_m, 0.0025);  // the rim is not rounded off
}

TEST(EnclosedVolume, IsWhatTheSurfaceEncloses) {
  const LabelVolume volume = test::ball_volume(24, 3, {1, 2, 3}, 25);
  const ScalarField field = smooth_field(cut_out_label(volume, 1, kSmoothingMargin, {}), {});
  const Vec3 spacing(0.001, 0.002, 0.003);
  for (const double level : {0.2, 0.5, 0.8}) {
    const double counted = enclosed_volume_m3(field, spacing, level);
    EXPECT_NEAR(counted / isosurface(field, spacing, level).volume_m3(), 1, 5e-4) << level;
  }
}

TEST(Sampling, CoarserAndFinerFieldsHoldTheSameVolume) {
  const LabelMask mask = cut_out_label(test::ball_volume(40, 1, {0, 0, 0}, 15), 1, kSmoothingMargin, {});
  for (const int step : {1, 2, -2}) {
    const double edge = step > 0 ? 1.0 / step : -step;
    const ScalarField field = smooth_field(mask, {}, {step, step, step});
    EXPECT_NEAR(enclosed_volume_m3(field, Vec3::Constant(edge), 0.5) / static_cast<double>(mask.kept_voxels), 1, 0.04)
        << step;
    EXPECT_NEAR(sample_place(0, step), step > 0 ? 0.5 / step - 0.5 : 0.5, 1e-12);
  }
}

TEST(Progress, TellsStagesAndMayStopTheWork) {
  std::vector<std::string> stages;
  CompileOptions options;
  options.triangles = 500;
  options.progress = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
  };
  const LabelVolume volume = test::ball_volume(20, 3, {0, 0, 0}, 20);
  compile_label(volume, 1, options);
  EXPECT_GE(stages.size(), 5U);
  struct Stop {};
  options.progress = [](std::string_view stage, double) {
    if (stage == "remeshing") throw Stop();
  };
  EXPECT_THROW(compile_label(volume, 1, options), Stop);
}

}  // namespace
}  // namespace trocar::label_parts_test
