#include "tissue/organ/scene_compiler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/complex/complex_mesh.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/organ/ply_file.h"

namespace trocar::scene_compiler_test {
namespace {

/// A ball of label 1 and 2, parted by the plane x = 0, with label 3 below z = -12 mm in it.
LabelMap parted_ball() {
  LabelVolume volume = test::ball_volume(32, 2, {0, 0, 0}, 24);
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i) {
        auto& label = volume.labels[volume.offset(i, j, k)];
        const Vec3 p = volume.index_to_ras_mm * Vec3(i, j, k);
        if (label != 0) label = p.z() < -10 ? 3 : p.x() < 0 ? 1 : 2;
      }
  LabelMap map;
  map.layers.push_back(volume);
  return map;
}

using Corners = std::array<std::array<double, 3>, 3>;

Corners corners(const TriangleSurface& surface, std::int32_t t, bool turned) {
  Corners result;
  const auto& triangle = surface.triangles[static_cast<std::size_t>(t)];
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3& p = surface.vertices[static_cast<std::size_t>(triangle[turned ? 2 - n : n])];
    result[n] = {p.x(), p.y(), p.z()};
  }
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  return result;
}

void expect_sound(const CompiledOrgan& organ) {
  EXPECT_TRUE(organ.facts.topology.closed() && organ.facts.topology.manifold());
  EXPECT_EQ(organ.facts.topology.degenerate_triangles, 0U);
  EXPECT_EQ(organ.facts.self_intersections, 0U);
  EXPECT_GT(organ.surface.volume_m3(), 0);
  EXPECT_NEAR(organ.facts.volume_error_pct, 0, 1);
  EXPECT_GT(organ.facts.quality.share_above_15, 0.99);
}

TEST(SceneCompiler, NeighboursShareTheirTrianglesInOppositeWinding) {
  const CompiledScene scene =
      compile_scene(parted_ball(), {{0, 1, "left", 900}, {0, 2, "right", 900}, {0, 3, "low", 900}}, {});
  ASSERT_EQ(scene.organs.size(), 3U);
  for (const CompiledOrgan& organ : scene.organs) expect_sound(organ);
  ASSERT_EQ(scene.shared.size(), 3U);
  for (const SharedInterface& shared : scene.shared) {
    EXPECT_LT(shared.first, shared.second);
    ASSERT_FALSE(shared.triangles.empty());
    for (const auto& [a, b] : shared.triangles)
      EXPECT_EQ(corners(scene.organs[shared.first].surface, a, false),
                corners(scene.organs[shared.second].surface, b, true));
  }
  // Area of the half disc x = 0 above z = -10 mm in a ball of 24 mm: pi r^2 / 2 + the strip between z = -10 and 0.
  const double strip = 10 * std::sqrt(24.0 * 24 - 100) + 576 * std::asin(10.0 / 24);
  EXPECT_NEAR(scene.shared[0].area_m2 * 1e6, std::numbers::pi * 288 + strip,
              0.12 * (std::numbers::pi * 288 + strip));  // its rim is rounded
}

std::vector<TriangleSurface> parted_surfaces(int triangles) {
  std::vector<TriangleSurface> surfaces;
  for (CompiledOrgan& organ :
       compile_scene(parted_ball(), {{0, 1, "", triangles}, {0, 2, "", triangles}, {0, 3, "", triangles}}, {}).organs)
    surfaces.push_back(std::move(organ.surface));
  return surfaces;
}

TEST(SceneCompiler, EvenSurfacesThatShareTrianglesStayAsTheyCame) {
  const std::vector<TriangleSurface> surfaces = parted_surfaces(900);
  const CompiledScene scene = compile_surfaces(surfaces, {.triangles = 2000});
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    EXPECT_EQ(scene.organs[n].surface.triangles.size(), surfaces[n].triangles.size());
    EXPECT_NEAR(scene.organs[n].surface.volume_m3(), surfaces[n].volume_m3(), 1e-15);
    EXPECT_LT(scene.organs[n].facts.hausdorff_m(), 1e-9);
  }
  ASSERT_EQ(scene.shared.size(), 3U);
  for (const SharedInterface& shared : scene.shared)
    for (const auto& [a, b] : shared.triangles)
      EXPECT_EQ(corners(scene.organs[shared.first].surface, a, false),
                corners(scene.organs[shared.second].surface, b, true));
}

TEST(SceneCompiler, FineSurfacesThatShareTrianglesAreRemeshedTogether) {
  const CompiledScene scene = compile_surfaces(parted_surfaces(3000), {.triangles = 600});
  for (const CompiledOrgan& organ : scene.organs) {
    expect_sound(organ);
    EXPECT_NEAR(static_cast<double>(organ.surface.triangles.size()), 600, 200);
  }
  ASSERT_EQ(scene.shared.size(), 3U);
  for (const SharedInterface& shared : scene.shared) {
    EXPECT_GT(shared.triangles.size(), 20U);
    for (const auto& [a, b] : shared.triangles)
      EXPECT_EQ(corners(scene.organs[shared.first].surface, a, false),
                corners(scene.organs[shared.second].surface, b, true));
  }
}

TEST(SceneCompiler, ASurfaceThatIsThereTwiceDoesNotSpoilItsNeighbours) {
  std::vector<TriangleSurface> surfaces = parted_surfaces(900);
  surfaces.push_back(surfaces[0]);
  const CompiledScene scene = compile_surfaces(surfaces, {.triangles = 2000});
  EXPECT_EQ(scene.shared.size(), 3U);
  for (const CompiledOrgan& organ : scene.organs) expect_sound(organ);
}

TEST(SceneCompiler, SurfacesThatShareNothingAreCompiledAlone) {
  std::vector<TriangleSurface> surfaces = parted_surfaces(900);
  surfaces.resize(1);
  surfaces.push_back(surfaces[0].transformed({Mat3::Identity(), Vec3(0.1, 0, 0)}));
  surfaces.push_back(surfaces[0]);  // twice the same shares nothing: it is not on the other side
  const CompiledScene scene = compile_surfaces(surfaces, {.triangles = 900});
  EXPECT_TRUE(scene.shared.empty());
  for (std::size_t n = 0; n < surfaces.size(); ++n)
    EXPECT_EQ(ply_bytes(scene.organs[n].surface), ply_bytes(compile_surface(surfaces[n], {.triangles = 900}).surface));
}

TEST(SceneCompiler, OrgansTogetherFillTheBall) {
  const CompiledScene scene = compile_scene(parted_ball(), {{0, 1, "", 800}, {0, 2, "", 800}, {0, 3, "", 800}}, {});
  double sum = 0, voxels = 0;
  for (const CompiledOrgan& organ : scene.organs) sum += organ.facts.volume_ml, voxels += *organ.facts.label_volume_ml;
  EXPECT_NEAR(sum / voxels, 1, 0.005);
}

TEST(SceneCompiler, SameInputGivesTheSameBytes) {
  const auto once = compile_scene(parted_ball(), {{0, 1, "", 500}, {0, 2, "", 500}}, {});
  const auto again = compile_scene(parted_ball(), {{0, 1, "", 500}, {0, 2, "", 500}}, {});
  for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(ply_bytes(once.organs[n].surface), ply_bytes(again.organs[n].surface));
}

TEST(SceneCompiler, ALabelNotAskedForIsAnAttachment) {
  const CompiledScene scene = compile_scene(parted_ball(), {{0, 1, "", 900}, {0, 2, "", 900}}, {});
  ASSERT_EQ(scene.attachments.size(), 2U);
  EXPECT_EQ(scene.attachments[0].organ, 0U);
  EXPECT_EQ(scene.attachments[0].number, 3);
  const double half_disc = std::numbers::pi * (24 * 24 - 100) / 2;
  EXPECT_NEAR(scene.attachments[0].area_m2 * 1e6, half_disc, 0.15 * half_disc);
}

TEST(SceneCompiler, AnOrganFarFromTheOthersIsCompiledAlone) {
  LabelMap map;
  map.layers.push_back(test::ball_volume(40, 2, {-20, 0, 0}, 12));
  LabelVolume& volume = map.layers[0];
  const LabelVolume other = test::ball_volume(40, 2, {22, 0, 0}, 10);
  for (std::size_t v = 0; v < volume.labels.size(); ++v)
    if (other.labels[v] != 0) volume.labels[v] = 2;
  const CompiledScene scene = compile_scene(map, {{0, 2, "", 600}, {0, 1, "", 600}}, {});
  EXPECT_TRUE(scene.shared.empty());
  EXPECT_EQ(ply_bytes(scene.organs[0].surface), ply_bytes(compile_label(volume, 2, {600}).surface));
  EXPECT_EQ(ply_bytes(scene.organs[1].surface), ply_bytes(compile_label(volume, 1, {600}).surface));
}

TEST(SceneCompiler, AnOrganWithinAnotherLeavesAHole) {
  LabelMap map;
  map.layers.push_back(test::ball_volume(32, 2, {0, 0, 0}, 24));
  const LabelVolume core = test::ball_volume(32, 2, {0, 0, 0}, 10);
  for (std::size_t v = 0; v < core.labels.size(); ++v)
    if (core.labels[v] != 0) map.layers[0].labels[v] = 2;
  const CompiledScene scene = compile_scene(map, {{0, 1, "", 1500}, {0, 2, "", 600}}, {});
  expect_sound(scene.organs[0]);
  expect_sound(scene.organs[1]);
  EXPECT_EQ(scene.organs[0].facts.topology.components, 2U);  // the outer wall and that round the core
  EXPECT_EQ(scene.shared.at(0).triangles.size(), scene.organs[1].surface.triangles.size());
}

TEST(SceneCompiler, RefusesWhatCannotBe) {
  const LabelMap map = parted_ball();
  const auto says = [&](const std::vector<SceneRequest>& requests) {
    return test::message_of<InputError>([&] { compile_scene(map, requests, {}); });
  };
  EXPECT_CONTAINS(says({}), "no organ");
  EXPECT_CONTAINS(says({{1, 1, "liver"}}), "no layer 1");
  EXPECT_CONTAINS(says({{0, 1, "a"}, {0, 1, "b"}}), "twice");
  EXPECT_CONTAINS(says({{0, 9, ""}, {0, 1, ""}}), "label 9");
  EXPECT_CONTAINS(says({{0, 0, ""}}), "start at 1");
}

LabelComplex random_regions(unsigned seed, int extent) {
  std::vector<RegionField> fields(4);
  for (auto& f : fields) {
    f.field.size = {extent, extent, extent};
    for (int n = 0; n < extent * extent * extent; ++n) {
      seed = seed * 1664525U + 1013904223U;
      f.field.values.push_back(static_cast<float>(seed >> 8) / static_cast<float>(1U << 24) * 0.6F);
    }
  }
  return label_complex(fields, {extent, extent, extent}, Vec3::Ones(), 1);
}

TEST(LabelComplex, EveryBorderIsAClosedManifoldWhateverTheFields) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const LabelComplex complex = random_regions(seed, 7);
    for (int region = 1; region <= 4; ++region) {
      const SurfaceTopology facts = analyse_topology(complex.border(region));
      EXPECT_TRUE(facts.closed() && facts.manifold()) << seed << ' ' << region;
    }
  }
}

/// Two slabs a sample apart that touch over one half, and in single samples, a step over a corner apart, over the
/// other.
TEST(LabelComplex, DottedContactBesideALargeOneIsParted) {
  constexpr int kExtent = 40;
  std::vector<RegionField> fields(2);
  for (auto& f : fields) f.field.size = {kExtent, kExtent, kExtent}, f.field.values.resize(kExtent * kExtent * kExtent);
  for (int k = 1; k < kExtent - 1; ++k)
    for (int j = 1; j < kExtent - 1; ++j)
      for (int i = 1; i < kExtent - 1; ++i) {
        const bool touches = i < 8 || (i > 14 && i + j == 44);
        const std::size_t region = k < 10 ? 0 : 1;
        if (k != 10 || touches) fields[region].field.values[fields[region].field.offset(i, j, k)] = 1;
      }
  const LabelComplex complex = label_complex(fields, {kExtent, kExtent, kExtent}, Vec3::Ones(), 1);
  std::size_t shared = 0;
  for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
    if (complex.regions[t][0] == 0) continue;
    ++shared;
    for (const auto v : complex.triangles[t]) EXPECT_LT(complex.vertices[static_cast<std::size_t>(v)].x(), 9);
  }
  EXPECT_GT(shared, 100U);
  for (int region = 1; region <= 2; ++region) {
    const SurfaceTopology facts = analyse_topology(complex.border(region));
    EXPECT_TRUE(facts.closed() && facts.manifold()) << region;
  }
}

TEST(ComplexMesh, RandomEditsKeepEveryBorderAClosedManifold) {
  ComplexMesh mesh(random_regions(3, 6));
  unsigned seed = 5;
  for (int round = 0; round < 6; ++round)
    for (const auto& [a, b] : mesh.edges()) {
      seed = seed * 1664525U + 1013904223U;
      if (mesh.around(a, b).empty()) continue;
      if (seed >> 30 == 0) mesh.split(a, b);
      if (seed >> 30 == 1) mesh.flip(a, b);
      const bool keeps_curve = mesh.kind(b) == ComplexMesh::Kind::patch ||
                               (mesh.kind(b) == ComplexMesh::Kind::curve && mesh.kind(a) != ComplexMesh::Kind::patch);
      if (seed >> 31 == 1 && keeps_curve && mesh.may_collapse(a, b)) mesh.collapse(a, b);
    }
  const LabelComplex edited = mesh.compact();
  for (int region = 1; region <= 4; ++region) {
    const SurfaceTopology facts = analyse_topology(edited.border(region));
    EXPECT_TRUE(facts.closed() && facts.nonmanifold_edges == 0 && facts.misoriented_edges == 0) << region;
  }
}

/// Labels of a volume of anisotropic voxels by their place in mm.
template <typename Label>
LabelMap drawn_map(const std::array<int, 3>& size, const Vec3& voxel_mm, Label label) {
  LabelVolume volume;
  volume.size = size;
  volume.index_to_ras_mm.linear() = voxel_mm.asDiagonal();
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        volume.labels.push_back(static_cast<std::uint16_t>(label(Vec3(i, j, k).cwiseProduct(voxel_mm))));
  LabelMap map;
  map.layers.push_back(std::move(volume));
  return map;
}

void expect_no_crossings(const CompiledScene& scene, double most_volume_error_pct) {
  std::vector<const TriangleSurface*> surfaces;
  for (const CompiledOrgan& organ : scene.organs) {
    EXPECT_TRUE(organ.facts.topology.closed() && organ.facts.topology.manifold());
    EXPECT_EQ(count_self_intersections(organ.surface), 0U);
    EXPECT_NEAR(organ.facts.kept_error_pct, 0, most_volume_error_pct);
    surfaces.push_back(&organ.surface);
  }
  EXPECT_TRUE(surface_crossings(surfaces).empty());
}

TEST(SceneCompiler, ThinLabelsThatTouchDoNotCross) {  // three sheets of a voxel or two, waved, one on the other
  const LabelMap map = drawn_map({44, 44, 24}, Vec3::Constant(2), [](const Vec3& p) {
    const double height = p.z() - 20 - 5 * std::sin(p.x() / 9) * std::cos(p.y() / 7);
    if (p.x() < 8 || p.x() > 78 || p.y() < 8 || p.y() > 78) return 0;
    return height < 0 ? 0 : height < 2.4 ? 1 : height < 5.5 ? 2 : height < 8 ? 3 : 0;
  });
  expect_no_crossings(compile_scene(map, {{0, 1, "", 400}, {0, 2, "", 400}, {0, 3, "", 400}}, {}),
                      15);  // a voxel thick
}

TEST(SceneCompiler, VesselsThatEnterAnOrganDoNotCrossIt) {  // two tubes of three voxels into a ball, one through it
  const LabelMap map = drawn_map({40, 40, 40}, Vec3::Constant(2), [](const Vec3& p) {
    const Vec3 q = p - Vec3::Constant(39);
    const double first = Vec3(0, q.y() - 6, q.z() - 0.3 * q.x()).norm(), second = Vec3(q.x() + 5, 0, q.z() + 8).norm();
    if (first < 3.2 && q.x() > -4 && q.x() < 36) return 2;
    if (second < 2.6 && std::abs(q.y()) < 36) return 3;
    return q.norm() < 24 ? 1 : 0;
  });
  expect_no_crossings(compile_scene(map, {{0, 1, "", 500}, {0, 2, "", 500}, {0, 3, "", 500}}, {}), 1);
}

TEST(SceneCompiler, RibsOnThickSlicesDoNotCross) {  // oblique rods on slices of 10 mm, over a lung
  const LabelMap map = drawn_map({60, 60, 14}, {2, 2, 10}, [](const Vec3& p) {
    const Vec3 q = p - Vec3(59, 59, 65);
    const double radius = std::hypot(q.x(), q.y());
    for (int rib = 0; rib < 4; ++rib)
      if (std::abs(radius - 46) < 5 && std::abs(q.z() + 38 - 26 * rib - 0.45 * q.y()) < 7 && q.x() < 30) return rib + 2;
    return Vec3(q.x(), q.y(), q.z() / 1.3).norm() < 41 ? 1 : 0;
  });
  const CompiledScene scene =
      compile_scene(map, {{0, 1, "", 900}, {0, 2, "", 700}, {0, 3, "", 700}, {0, 4, "", 700}, {0, 5, "", 700}}, {});
  expect_no_crossings(scene, 1);
  for (std::size_t n = 1; n < scene.organs.size(); ++n) EXPECT_EQ(scene.organs[n].facts.topology.components, 1U);
}

}  // namespace
}  // namespace trocar::scene_compiler_test
