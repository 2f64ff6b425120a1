#include "tissue/solid/tetrahedra.h"

#include <gtest/gtest.h>

#include <sstream>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::tetrahedra_test {
namespace {

TEST(Tetrahedra, RegularTetrahedronHasItsKnownDihedralAngle) {
  TetrahedraMesh mesh;
  mesh.nodes = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  EXPECT_NEAR(smallest_dihedral_deg(mesh, 0), std::acos(1.0 / 3) * 180 / std::numbers::pi, 1e-9);
}

TEST(Tetrahedra, BallMeetsTheFigures) {
  const LabelVolume volume = test::ball_volume(30, 2, {0, 0, 0}, 24);
  const BuiltTetrahedra built = make_tetrahedra(volume, {1}, {.cell_m = 0.008});
  EXPECT_GT(built.facts.tetrahedra, 300U);
  EXPECT_NEAR(built.facts.volume_error_pct, 0, 0.5);
  EXPECT_GE(built.facts.min_dihedral_deg, 10);
  EXPECT_LT(built.facts.share_below_15, 0.05);
  EXPECT_LT(built.facts.surface_rms_voxel, 0.35);
  EXPECT_LT(built.facts.surface_max_voxel, 1);
  for (const auto& t : built.mesh.tetrahedra) {
    const auto at = [&](std::size_t n) -> const Vec3& { return built.mesh.nodes[static_cast<std::size_t>(t[n])]; };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)), 0);
  }
}

TEST(Tetrahedra, TwoLabelsMeetInCommonNodesAndAreTheSameEachTime) {
  LabelVolume volume = test::ball_volume(26, 2, {0, 0, 0}, 20);
  for (int k = 0; k < 26; ++k)
    for (int j = 0; j < 26; ++j)
      for (int i = 0; i < 13; ++i)
        if (auto& label = volume.labels[volume.offset(i, j, k)]; label != 0) label = 4;
  const BuiltTetrahedra built = make_tetrahedra(volume, {4, 1}, {.cell_m = 0.01});
  double left = 0, right = 0;
  std::vector<int> seen(built.mesh.nodes.size(), 0);
  for (std::size_t t = 0; t < built.mesh.tetrahedra.size(); ++t) {
    ASSERT_TRUE(built.mesh.labels[t] == 4 || built.mesh.labels[t] == 1);
    (built.mesh.labels[t] == 4 ? left : right) += 1;
    for (const auto node : built.mesh.tetrahedra[t])
      seen[static_cast<std::size_t>(node)] |= built.mesh.labels[t] == 4 ? 1 : 2;
  }
  EXPECT_GT(left, 50);
  EXPECT_GT(right, 50);
  EXPECT_GT(std::count(seen.begin(), seen.end(), 3), 10);
  EXPECT_EQ(gmsh_text(make_tetrahedra(volume, {4, 1}, {.cell_m = 0.01}).mesh), gmsh_text(built.mesh));
}

TEST(Tetrahedra, FilesCountWhatTheyHold) {
  TetrahedraMesh mesh;
  mesh.nodes = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.labels = {5};
  EXPECT_EQ(gmsh_text(mesh),
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 0.1 0 0\n3 0 0.1 0\n4 0 0 0.1\n$EndNodes\n"
            "$Elements\n1\n1 4 2 5 5 1 2 3 4\n$EndElements\n");
}

TEST(Tetrahedra, RefusesWhatCannotBe) {
  const LabelVolume volume = test::ball_volume(12, 2, {0, 0, 0}, 8);
  EXPECT_THROW(make_tetrahedra(volume, {}, {}), InputError);
  EXPECT_CONTAINS(test::message_of<InputError>([&] { make_tetrahedra(volume, {9}, {}); }), "label 9");
  EXPECT_THROW(make_tetrahedra(volume, {1}, {.cell_m = 0}), InputError);
  EXPECT_THROW(make_tetrahedra(volume, {1}, {.facet_distance_voxel = 0}), InputError);
}

}  // namespace
}  // namespace trocar::tetrahedra_test
