// From masks to surfaces: cutting out, smoothing, isosurfaces, caps, edge sizes and remeshing.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/cap_planes.h"
#include "tissue/mesh/surface/edge_sizes.h"
#include "tissue/mesh/surface/isosurface.h"
#include "tissue/mesh/surface/label_surface.h"
#include "tissue/mesh/surface/mesh_quality.h"
#include "tissue/mesh/surface/remesh.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar::field_surface_test {
namespace {

LabelVolume grid(std::array<int, 3> size) {
  LabelVolume volume;
  volume.size = size;
  volume.labels.assign(volume.offset(0, 0, size[2]), 0);
  return volume;
}

void fill(LabelVolume& volume, std::array<int, 3> low, std::array<int, 3> high, std::uint16_t label) {
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) volume.labels[volume.offset(i, j, k)] = label;
}

LabelVolume noise(unsigned seed, double share, int extent = 12) {
  LabelVolume volume = grid({extent, extent, extent});
  std::mt19937 random(seed);
  for (auto& label : volume.labels) label = std::uniform_real_distribution<double>(0, 1)(random) < share ? 1 : 0;
  return volume;
}

/// Sizes of the face-connected parts of what `wanted` holds of, largest first: colours lowered until nothing changes.
template <typename Wanted>
std::vector<std::size_t> parts_by_relaxation(const std::array<int, 3>& size, Wanted wanted) {
  LabelVolume places = grid(size);
  std::vector<std::size_t> colour(places.labels.size());
  std::iota(colour.begin(), colour.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) {
          const std::array<std::array<int, 3>, 3> next{{{i + 1, j, k}, {i, j + 1, k}, {i, j, k + 1}}};
          for (const auto& [a, b, c] : next) {
            if (a >= size[0] || b >= size[1] || c >= size[2]) continue;
            const std::size_t here = places.offset(i, j, k), there = places.offset(a, b, c);
            if (!wanted(here) || !wanted(there) || colour[here] == colour[there]) continue;
            colour[here] = colour[there] = std::min(colour[here], colour[there]);
            changed = true;
          }
        }
  }
  std::vector<std::size_t> sizes(colour.size(), 0), result;
  for (std::size_t v = 0; v < colour.size(); ++v) sizes[colour[v]] += wanted(v) ? 1 : 0;
  std::copy_if(sizes.begin(), sizes.end(), std::back_inserter(result), [](std::size_t n) { return n > 0; });
  std::sort(result.rbegin(), result.rend());
  return result;
}

TEST(CutOutNoise, PartsAreThoseThatRelaxationFinds) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const LabelVolume volume = noise(seed, 0.33);
    auto parts = parts_by_relaxation(volume.size, [&](std::size_t v) { return volume.labels[v] == 1; });
    const LabelMask mask = cut_out_label(volume, 1, 2);
    const std::size_t filled = std::accumulate(mask.cavities.begin(), mask.cavities.end(), std::size_t{0});
    EXPECT_EQ(mask.kept_voxels, parts[0] + filled) << seed;
    parts.erase(parts.begin());
    EXPECT_EQ(mask.lost_parts, parts) << seed;
  }
}

TEST(CutOutNoise, NoCavityIsLeftAndEveryVoxelIsAccountedFor) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const LabelMask mask = cut_out_label(noise(seed, 0.6), 1, 1, {});
    const auto outside = parts_by_relaxation(mask.size, [&](std::size_t v) { return mask.inside[v] == 0; });
    EXPECT_EQ(outside.size(), 1U) << seed;
    const auto sum = [](const std::vector<std::size_t>& sizes) {
      return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    };
    EXPECT_EQ(mask.kept_voxels, mask.label_voxels - sum(mask.lost_parts) + sum(mask.cavities) + mask.bridge_voxels);
    EXPECT_EQ(std::accumulate(mask.inside.begin(), mask.inside.end(), std::size_t{0}), mask.kept_voxels);
    const auto inside = parts_by_relaxation(mask.size, [&](std::size_t v) { return mask.inside[v] != 0; });
    EXPECT_EQ(inside.size(), mask.parts) << seed;
  }
}

TEST(CutOutNoise, BridgesOfZeroOneAndTwoVoxelsJoinMoreAndMore) {
  LabelVolume volume = grid({24, 8, 8});
  fill(volume, {1, 2, 2}, {4, 5, 5}, 3);
  fill(volume, {6, 2, 2}, {9, 5, 5}, 3);    // one voxel away
  fill(volume, {12, 2, 2}, {15, 5, 5}, 3);  // two
  fill(volume, {19, 2, 2}, {22, 5, 5}, 3);  // three
  for (const int longest : {0, 1, 2}) {
    const LabelMask mask = cut_out_label(volume, 3, 2, {.bridge_voxels = longest});
    EXPECT_EQ(mask.parts, static_cast<std::size_t>(4 - longest));
    EXPECT_EQ(mask.bridge_voxels, longest == 2 ? 3U : static_cast<std::size_t>(longest));
    EXPECT_EQ(mask.kept_voxels, 256 + mask.bridge_voxels);
  }
}

TEST(CutOut, BoxMarginAndCutFollowTheOrgan) {
  LabelVolume volume = grid({10, 11, 12});
  fill(volume, {0, 3, 5}, {4, 7, 11}, 2);
  const LabelMask mask = cut_out_label(volume, 2, 3);
  EXPECT_EQ(mask.first, (std::array<int, 3>{-3, 0, 2}));
  EXPECT_EQ(mask.size, (std::array<int, 3>{11, 11, 13}));
  EXPECT_EQ(mask.cut, (std::array<std::array<bool, 2>, 3>{{{true, false}, {false, false}, {false, true}}}));
  EXPECT_EQ(mask.border_voxels, 5U * 7 + 5 * 5 - 5);
}

TEST(CutOut, RefusalsNameTheLabel) {
  LabelVolume volume = grid({6, 6, 6});
  fill(volume, {1, 1, 1}, {1, 1, 4}, 5);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { cut_out_label(volume, 5, 1); }), "label 5");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { cut_out_label(volume, 77, 1); }), "label 77");
}

TEST(ThinVoxels, BlocksOfThreeAreThickAndPlatesOfTwoAreThin) {
  for (const int thickness : {1, 2, 3, 4}) {
    LabelVolume volume = grid({20, 20, 20});
    fill(volume, {4, 4, 4}, {15, 15, 3 + thickness}, 1);
    const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin);
    EXPECT_EQ(count_thin_voxels(mask), thickness < 3 ? mask.kept_voxels : 0U) << thickness;
  }
}

TEST(SamplePlace, SamplesOfAVoxelLieRoundItsMiddle) {
  for (const int sampling : {1, 2, 3}) {
    double sum = 0;
    for (int n = 0; n < sampling; ++n) sum += sample_place(4 * sampling + n, sampling);
    EXPECT_NEAR(sum / sampling, 4, 1e-12);
  }
  EXPECT_NEAR(sample_place(3, -2), (6 + 7) / 2.0, 1e-12);
  EXPECT_NEAR(sample_place(0, -3), 1, 1e-12);
}

TEST(SmoothFields, TurnWithTheMask) {
  LabelVolume volume = noise(4, 0.45, 8), turned = volume;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) turned.labels[turned.offset(k, i, j)] = volume.labels[volume.offset(i, j, k)];
  const ScalarField a = smooth_field(cut_out_label(volume, 1, kSmoothingMargin), {});
  const ScalarField b = smooth_field(cut_out_label(turned, 1, kSmoothingMargin), {});
  ASSERT_EQ(a.values.size(), b.values.size());
  for (int k = 0; k < a.size[2]; ++k)
    for (int j = 0; j < a.size[1]; ++j)
      for (int i = 0; i < a.size[0]; ++i) EXPECT_NEAR(a.values[a.offset(i, j, k)], b.values[b.offset(k, i, j)], 2e-6);
}

TEST(Isosurfaces, LevelsNestAndTheirVolumeIsWhatIsCounted) {
  LabelVolume volume = noise(8, 0.55);
  const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin);
  ScalarField field = smooth_field(mask, {});
  const Vec3 spacing(1e-3, 1.5e-3, 0.7e-3);
  double before = 1;
  for (const double level : {0.1, 0.3, 0.5, 0.7}) {
    const auto at_level = signed_field(field, mask, {1, 1, 1}, level);
    const TriangleSurface surface = isosurface(at_level, spacing, 0);
    EXPECT_TRUE(analyse_topology(surface).closed() && analyse_topology(surface).manifold());
    EXPECT_NEAR(surface.volume_m3(), enclosed_volume_m3(at_level, spacing, 0), 5e-4 * surface.volume_m3());
    EXPECT_LT(surface.volume_m3(), before);
    before = surface.volume_m3();
  }
}

TEST(Isosurfaces, OfALinearRampLieAtTheLevelExactly) {
  ScalarField field{{9, 9, 9}, {}};
  for (int n = 0; n < 729; ++n) {
    const int i = n % 9, j = n / 9 % 9, k = n / 81;
    field.values.push_back(static_cast<float>(4 - std::abs(i - 4) - std::abs(j - 4) - std::abs(k - 4)));
  }
  const TriangleSurface surface = isosurface(field, Vec3::Ones(), 0.5);
  for (const Vec3& v : surface.vertices) EXPECT_LE((v - Vec3::Constant(4)).lpNorm<1>(), 3.5 + 1e-6);
  EXPECT_LT((surface.bounds().min() - Vec3::Constant(0.5)).norm(), 1e-6);
  EXPECT_LT((surface.bounds().max() - Vec3::Constant(7.5)).norm(), 1e-6);
}

TEST(Caps, LieHalfAVoxelBeyondTheLastCentreInAnyFrame) {
  LabelVolume volume = grid({12, 10, 9});
  fill(volume, {0, 2, 2}, {6, 7, 8}, 1);
  volume.index_to_ras_mm.linear() =
      Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized()).toRotationMatrix() * Eigen::Scaling(2.0, 1.0, 3.0);
  volume.index_to_ras_mm.translation() = Vec3(10, -20, 30);
  const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin);
  const auto caps = cap_planes(mask, box_to_ras_m(volume, mask));
  ASSERT_EQ(caps.size(), 2U);
  for (const auto& [cap, outer] : {std::pair(caps[0], Vec3(-0.5, 3, 4)), std::pair(caps[1], Vec3(5, 3, 8.5))}) {
    EXPECT_NEAR(cap.normal.norm(), 1, 1e-12);
    EXPECT_NEAR(cap.normal.dot(volume.index_to_ras_mm * outer) * 1e-3, cap.offset_m, 1e-12);
    EXPECT_LT(cap.normal.dot(volume.index_to_ras_mm * Vec3(3, 4, 5)) * 1e-3, cap.offset_m);
  }
}

TEST(Caps, KeeperHoldsWhatLayInThemAndPutsBackWhatPasses) {
  const std::vector<CapPlane> planes{{Vec3(0, 0, 1), 0.1}};
  std::vector<Vec3> vertices{{0, 0, 0.1}, {1, 0, 0.05}, {2, 0, 0.02}};
  const CapKeeper keeper(planes, vertices);
  vertices = {{0.1, 0.2, 0.07}, {1, 0, 0.3}, {2, 0.1, 0.04}};
  keeper.apply(vertices);
  EXPECT_LT((vertices[0] - Vec3(0.1, 0.2, 0.1)).norm(), 1e-12);
  EXPECT_LT((vertices[1] - Vec3(1, 0, 0.1)).norm(), 1e-12);
  EXPECT_EQ(vertices[2], Vec3(2, 0.1, 0.04));
}

TEST(MappedVertices, TurnTrianglesOverWhereTheMapMirrors) {
  TriangleSurface ball = test::sphere(Vec3::Zero(), 1, 2);
  const double volume = ball.volume_m3();
  map_vertices(ball, Eigen::Affine3d(Eigen::Scaling(-1.0, 2.0, 3.0)));
  EXPECT_NEAR(ball.volume_m3(), 6 * volume, 1e-12);
  map_vertices(ball, Eigen::Affine3d(Eigen::Scaling(-1.0, -0.5, 1.0)));
  EXPECT_NEAR(ball.volume_m3(), 3 * volume, 1e-12);
}

TEST(LabelSurfaces, EncloseTheKeptVoxelsRoundTheirMiddle) {
  for (const double radius : {6.0, 11.0}) {
    const LabelVolume volume = test::ball_volume(24, 1.5, {1, -2, 0.5}, radius);
    const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin);
    const LabelSurface made = label_surface(volume, 1, mask, 1000);
    EXPECT_NEAR(made.kept_m3, static_cast<double>(mask.kept_voxels) * 1.5 * 1.5 * 1.5e-9, 1e-15);
    EXPECT_NEAR(made.dense.volume_m3(), made.kept_m3, 3e-3 * made.kept_m3);
    EXPECT_LT((volume_centroid_m(made.dense) - made.centroid_m).norm(), 1e-4);
    EXPECT_TRUE(made.caps.empty() && made.fallen_off_m3.empty());
    EXPECT_TRUE(analyse_topology(made.sharp).closed());
  }
}

TEST(LabelSurfaces, OfACutOrganEndAtTheCap) {
  const LabelVolume volume = test::ball_volume(20, 2, {0, 0, -14}, 14);
  const LabelMask mask = cut_out_label(volume, 1, kSmoothingMargin);
  const LabelSurface made = label_surface(volume, 1, mask, 1000);
  ASSERT_EQ(made.caps.size(), 1U);
  EXPECT_LT((made.caps[0].normal - Vec3(0, 0, -1)).norm(), 1e-12);
  EXPECT_NEAR(made.caps[0].offset_m, 0.020, 1e-12);
  EXPECT_GT(made.dense.bounds().min().z(), -0.021);  // near the rim, by less than half a voxel
  const auto on_cap = [&](const Vec3& v) { return std::abs(v.z() + 0.020) < 1e-6; };
  const auto flat = std::count_if(made.dense.vertices.begin(), made.dense.vertices.end(), on_cap);
  EXPECT_GT(flat, 80);
  std::vector<Vec3> kept = made.dense.vertices;
  CapKeeper(made.caps, kept).apply(kept);
  for (const Vec3& v : kept) EXPECT_GT(v.z(), -0.020 - 1e-12);
  EXPECT_GT(std::count_if(kept.begin(), kept.end(), on_cap), flat);
  EXPECT_NEAR(made.dense.volume_m3(), made.kept_m3, 5e-3 * made.kept_m3);
}

TEST(EdgeSizesOfABall, AreEvenAndScaleWithBallAndCount) {
  const TriangleSurface ball = test::sphere(Vec3(1, 2, 3), 0.05, 5);
  EdgeSizeOptions options;
  options.triangles = 800;
  const auto sizes = edge_sizes(ball, options);
  ASSERT_EQ(sizes.size(), ball.vertices.size());
  const double even = std::sqrt(surface_area_m2(ball) / 800 / (std::sqrt(3.0) / 4));
  for (const double size : sizes) EXPECT_NEAR(size, even, 0.25 * even);
  const auto larger = edge_sizes(test::sphere(Vec3(1, 2, 3), 0.1, 5), options);
  options.triangles = 200;
  const auto fewer = edge_sizes(ball, options);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    EXPECT_NEAR(larger[v], 2 * sizes[v], 0.01 * sizes[v]);
    EXPECT_NEAR(fewer[v], 2 * sizes[v], 0.05 * sizes[v]);
  }
}

TEST(Remesh, MeetsCountVolumeAndShapeOnSeveralComponents) {
  const TriangleSurface pair =
      test::joined(test::sphere(Vec3(-0.1, 0, 0), 0.05, 5), test::sphere(Vec3(0.1, 0, 0), 0.03, 5));
  const auto sizes = edge_sizes(pair, {.triangles = 900});
  const TriangleSurface coarse = remeshed(pair, sizes, {.triangles = 900});
  const SurfaceTopology facts = analyse_topology(coarse);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.components, 2U);
  EXPECT_EQ(facts.genus, 0);
  EXPECT_NEAR(static_cast<double>(facts.triangles), 900, 36);
  EXPECT_LT(coarse.volume_m3(), pair.volume_m3());  // corners on a convex source: chords lie within
  EXPECT_GT(coarse.volume_m3(), 0.97 * pair.volume_m3());
  EXPECT_GT(mesh_quality(coarse).min_angle_deg, 25);
  const TriangleSurface again = remeshed(pair, sizes, {.triangles = 900});
  EXPECT_EQ(again.triangles, coarse.triangles);
  EXPECT_EQ(again.vertices, coarse.vertices);
}

TEST(Remesh, RefusesWhatIsNoManifoldAndSizesThatDoNotFit) {
  TriangleSurface fin = test::sphere(Vec3::Zero(), 0.05, 2);
  const std::vector<double> sizes(fin.vertices.size(), 0.01);
  EXPECT_THROW(remeshed(fin, std::vector<double>(3, 0.01), {.triangles = 100}), std::invalid_argument);
  fin.triangles.push_back(fin.triangles[0]);
  EXPECT_THROW(remeshed(fin, sizes, {.triangles = 100}), std::invalid_argument);
}

}  // namespace
}  // namespace trocar::field_surface_test
