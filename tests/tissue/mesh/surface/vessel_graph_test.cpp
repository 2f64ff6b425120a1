#include "tissue/mesh/surface/vessel_graph.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"

namespace trocar::vessel_graph_test {
namespace {

constexpr double kVoxelMm = 1.5;

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  return (p - a - along * std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0)).norm();
}

/// Tubes of one radius round segments, label 1.
LabelVolume tubes(const std::vector<std::pair<Vec3, Vec3>>& segments, double radius_mm) {
  LabelVolume volume = test::ball_volume(60, kVoxelMm, {0, 0, 0}, -1);
  std::size_t voxel = 0;
  for (int k = 0; k < 60; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i, ++voxel)
        for (const auto& [a, b] : segments)
          if (to_segment(volume.index_to_ras_mm * Vec3(i, j, k), a, b) < radius_mm) volume.labels[voxel] = 1;
  return volume;
}

TEST(VesselGraph, StraightTubeIsOneLineOfItsRadius) {
  const Vec3 a(-30, 0, 0), b(30, 10, 5);
  const VesselGraph graph = vessel_graph(tubes({{a, b}}, 5), 1);
  EXPECT_EQ(graph.parts, 1U);
  EXPECT_EQ(graph.ends(), 2U);
  EXPECT_EQ(graph.branchings(), 0U);
  EXPECT_NEAR(graph.length_m, ((b - a).norm() + 10) * 1e-3, 0.006);  // with the round caps
  double sum = 0, count = 0;
  for (const VesselNode& node : graph.nodes) {
    if (std::abs(node.place_m.x()) > 0.025) continue;
    EXPECT_LT(to_segment(node.place_m * 1e3, a, b), 1.2 * kVoxelMm);
    EXPECT_NEAR(node.radius_m, 0.005, 0.0015);  // a voxel
    sum += node.radius_m, count += 1;
  }
  EXPECT_NEAR(sum / count, 0.005, 0.0008);
}

TEST(VesselGraph, AForkHasOneBranchingAndThreeEnds) {
  const Vec3 fork(0, 0, 0);
  const VesselGraph graph = vessel_graph(tubes({{{0, 0, -35}, fork}, {fork, {25, 0, 28}}, {fork, {-25, 0, 28}}}, 4), 1);
  EXPECT_EQ(graph.ends(), 3U);
  EXPECT_EQ(graph.branchings(), 1U);
  EXPECT_EQ(graph.edges.size() + 1, graph.nodes.size());  // a tree
  EXPECT_NEAR(graph.length_m, 0.035 + 2 * std::hypot(0.025, 0.028) + 0.012, 0.015);
}

TEST(VesselGraph, TwoPartsGiveTwoTreesAndTheSameEachTime) {
  const LabelVolume volume = tubes({{{-30, 20, 0}, {30, 20, 0}}, {{-30, -20, 0}, {30, -20, 0}}}, 3);
  const VesselGraph graph = vessel_graph(volume, 1), again = vessel_graph(volume, 1);
  EXPECT_EQ(graph.parts, 2U);
  EXPECT_EQ(graph.ends(), 4U);
  EXPECT_EQ(graph.edges, again.edges);
  for (const auto& [a, b] : graph.edges) {
    EXPECT_GE(a, 0);
    EXPECT_LT(static_cast<std::size_t>(b), graph.nodes.size());
  }
}

TEST(VesselGraph, RefusesAnAbsentLabel) { EXPECT_THROW(vessel_graph(tubes({}, 1), 1), InputError); }

}  // namespace
}  // namespace trocar::vessel_graph_test
