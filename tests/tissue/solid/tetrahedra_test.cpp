// Tetrahedra of closed surfaces: angles, volumes, common faces, and what is refused before anything is made.
#include "tissue/solid/tetrahedra.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/solid/tetrahedra_border.h"
#include "tissue/solid/tetrahedra_file.h"
#include "tissue/solid/tissue_table.h"

namespace trocar::tetrahedra_test {
namespace {

BuiltTetrahedra built_of(const std::vector<TriangleSurface>& organs, double cell_m) {
  std::vector<const TriangleSurface*> surfaces;
  for (const TriangleSurface& organ : organs) surfaces.push_back(&organ);
  return make_tetrahedra(surfaces, {.cell_m = cell_m});
}

/// A tube with round ends.
TriangleSurface needle(double half_length, double radius) {
  TriangleSurface surface = test::sphere(Vec3::Zero(), radius, 4);
  for (Vec3& vertex : surface.vertices) vertex.x() *= half_length / radius;
  return surface;
}

void expect_sound(const TetrahedraMesh& mesh) {
  std::map<std::array<std::int32_t, 3>, int> faces;
  for (const auto& t : mesh.tetrahedra) {
    const auto at = [&](std::size_t n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(t[n])]; };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)), 0);
    for (std::size_t n = 0; n < 4; ++n) {
      std::array face{t[(n + 1) % 4], t[(n + 2) % 4], t[(n + 3) % 4]};
      std::sort(face.begin(), face.end());
      EXPECT_LE(++faces[face], 2);
    }
  }
}

TEST(Tetrahedra, RegularTetrahedronHasItsKnownDihedralAngle) {
  TetrahedraMesh mesh;
  mesh.nodes = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  EXPECT_NEAR(smallest_dihedral_deg(mesh, 0), std::acos(1.0 / 3) * 180 / std::numbers::pi, 1e-9);
}

TEST(Tetrahedra, OfABallKeepVolumeAnglesAndSurface) {
  const BuiltTetrahedra built = built_of({test::sphere(Vec3(0.1, 0, 0), 0.024, 4)}, 0.008);
  expect_sound(built.mesh);
  EXPECT_GT(built.facts.tetrahedra, 300U);
  EXPECT_NEAR(built.facts.volume_error_pct, 0, 0.01);
  EXPECT_GE(built.facts.min_dihedral_deg, 14);
  EXPECT_LT(built.facts.share_below_15, 0.01);
  EXPECT_LT(built.facts.surface_rms_m, 0.4e-3);  // a facet may lie 0.8 mm inside
  EXPECT_LT(built.facts.surface_max_m, 1.2e-3);
}

TEST(Tetrahedra, OrgansThatTouchShareTheirFaceAndKeepTheirVolumes) {
  const auto left = test::box(Vec3::Zero(), Vec3(0.02, 0.03, 0.04));
  const auto right = test::box(Vec3(0.02, 0, 0), Vec3(0.05, 0.03, 0.04));
  const BuiltTetrahedra built = built_of({left, right}, 0.006);
  expect_sound(built.mesh);
  EXPECT_GE(built.facts.min_dihedral_deg, 10);
  EXPECT_NEAR(built.facts.regions[0].volume_ml, 24, 0.01);
  EXPECT_NEAR(built.facts.regions[1].volume_ml, 36, 0.01);
  double common = 0;
  for (const BorderFace& face : border_faces(built.mesh)) {
    const auto at = [&](std::size_t n) -> const Vec3& {
      return built.mesh.nodes[static_cast<std::size_t>(face.nodes[n])];
    };
    if (face.outer == 2) common += (at(1) - at(0)).cross(at(2) - at(0)).x() / 2;
  }
  EXPECT_NEAR(common, 0.03 * 0.04, 0.05 * 0.03 * 0.04);
  EXPECT_EQ(gmsh_text(built.mesh, {}), gmsh_text(built_of({left, right}, 0.006).mesh, {})) << "the same each time";
}

TEST(Tetrahedra, OfTwoThatOverlapTheSmallerHasThePlace) {
  const BuiltTetrahedra built =
      built_of({test::sphere(Vec3::Zero(), 0.03, 4), test::sphere(Vec3(0.005, 0, 0), 0.008, 4)}, 0.008);
  const double small = test::sphere(Vec3::Zero(), 0.008, 4).volume_m3() * 1e6;
  const double large = test::sphere(Vec3::Zero(), 0.03, 4).volume_m3() * 1e6;
  EXPECT_NEAR(built.facts.regions[1].volume_ml, small, 1e-3 * small);
  EXPECT_NEAR(built.facts.regions[0].volume_ml, large - small, 1e-3 * large);
  expect_sound(built.mesh);
  const auto twice = test::sphere(Vec3::Zero(), 0.02, 3);
  std::set<std::size_t> counts;
  for (const auto& region : built_of({twice, twice}, 0.01).facts.regions) counts.insert(region.tetrahedra);
  EXPECT_EQ(*counts.begin(), 0U) << "nothing is left of the other one";
}

TEST(Tetrahedra, AThinTubeIsNotLostBetweenLargeTetrahedra) {
  const BuiltTetrahedra built = built_of({test::sphere(Vec3(0, 0, 0.05), 0.03, 3), needle(0.03, 0.001)}, 0.01);
  EXPECT_NEAR(built.facts.regions[1].volume_error_pct, 0, 0.1);
  EXPECT_GE(built.facts.min_dihedral_deg, 12);
}

TEST(Tetrahedra, AreAsManyAsExpectedWithinAFactorOfTwo) {
  for (const auto& [surface, cell] :
       {std::pair(test::sphere(Vec3::Zero(), 0.03, 4), 0.008), std::pair(test::sphere(Vec3::Zero(), 0.03, 4), 0.003),
        std::pair(needle(0.05, 0.002), 0.01), std::pair(test::box(Vec3::Zero(), Vec3(0.1, 0.1, 0.01)), 0.005)}) {
    const double made = static_cast<double>(built_of({surface}, cell).facts.tetrahedra);
    EXPECT_LT(std::abs(std::log2(expected_tetrahedra({&surface}, cell) / made)), 1) << made;
  }
}

TEST(Tetrahedra, OfASizeThatCannotBeAreRefusedBeforeTheyAreMade) {
  const TriangleSurface ball = test::sphere(Vec3::Zero(), 0.03, 3);
  const auto refusal = [&](double cell_m) {
    return test::message_of<InputError>([&] { make_tetrahedra({&ball}, {.cell_m = cell_m}); });
  };
  for (const double cell : {0.0, -0.008, 1e6, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_CONTAINS(refusal(cell), "above 0 and up to 1000 mm");
  EXPECT_CONTAINS(refusal(1e-5), "at most 5 million are made: choose 0.");
  EXPECT_CONTAINS(refusal(1e-30), "million GB of memory");
}

TetrahedraMesh one_tetrahedron() {
  TetrahedraMesh mesh;
  mesh.nodes = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.labels = {1};
  return mesh;
}

TEST(TetrahedraFile, GmshCountsWhatItHoldsAndNamesItLast) {
  EXPECT_EQ(gmsh_text(one_tetrahedron(), {"a \"b\""}),
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 0.1 0 0\n3 0 0.1 0\n4 0 0 0.1\n$EndNodes\n"
            "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n$PhysicalNames\n1\n3 1 \"a 'b'\"\n$EndPhysicalNames\n");
}

TEST(TetrahedraFile, FebioHasAMaterialAPartAndADomainOfTheOrgansName) {
  const TissueTable tissues = TissueTable::load(std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "tissues.toml");
  const TissueSolid& liver = tissues.find("liver");
  const std::string text = written_tetrahedra().at("feb")(one_tetrahedron(), {{"a<b", "of x--y", liver, false}});
  EXPECT_CONTAINS(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n");
  EXPECT_CONTAINS(text, "<!-- of x- -y; E of liver, ");
  EXPECT_CONTAINS(text, "; no tissue is known of that name -->");
  EXPECT_CONTAINS(text,
                  "<material id=\"1\" name=\"a&lt;b\" type=\"neo-Hookean\">\n<density>1060</density>\n<E>5000</E>\n"
                  "<v>0.45</v>\n</material>\n");
  EXPECT_CONTAINS(text, "<node id=\"2\">0.1,0,0</node>\n");
  EXPECT_CONTAINS(text,
                  "<Elements type=\"tet4\" name=\"a&lt;b\">\n<elem id=\"1\">1,2,3,4</elem>\n</Elements>\n</Mesh>\n"
                  "<MeshDomains>\n<SolidDomain name=\"a&lt;b\" mat=\"a&lt;b\"/>\n</MeshDomains>\n</febio_spec>\n");
}

}  // namespace
}  // namespace trocar::tetrahedra_test
