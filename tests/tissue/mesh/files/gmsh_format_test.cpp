// Gmsh meshes: versions, kinds of elements, regions and damage.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::gmsh_format_test {
namespace {

using namespace test;

const std::string kFormat = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kNodes = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n40 0 0 1\n5 1 1 1\n$EndNodes\n";

std::string refusal(const std::string& bytes) {
  return message_of<InputError>([&] { read_gmsh(bytes, "a.msh"); });
}

TEST(GmshFile, RegionsCarryThePhysicalNames) {
  const std::string text =
      kFormat + "$PhysicalNames\n2\n3 7 \"left lobe\"\n2 9 \"skin\"\n$EndPhysicalNames\n" + kNodes +
      "$Elements\n4\n1 4 2 7 1 1 2 3 40\n2 4 2 8 1 2 3 40 5\n3 2 2 9 1 1 2 3\n4 3 2 9 1 1 2 5 3\n$EndElements\n";
  const SurfaceFile file = read_gmsh(text, "a.msh");
  EXPECT_EQ(file.tetrahedra.region_names, (std::vector<std::string>{"left lobe", "volume 8"}));
  EXPECT_EQ(file.tetrahedra.regions, (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].name, "skin");
  EXPECT_EQ(file.parts[0].surface.triangles.size(), 3U);  // a triangle and a quad
}

TEST(GmshFile, PointsLinesAndCurvedElements) {
  const std::string text = kFormat + kNodes +
                           "$Elements\n5\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 8 2 0 1 1 2 3\n4 9 2 1 1 1 2 3 40 5 5\n5 11 0 "
                           "1 2 3 40 5 5 5 5 5 5\n$EndElements\n";
  const SurfaceFile file = read_gmsh(text, "a.msh");
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].surface.triangles.size(), 1U);
  ASSERT_EQ(file.tetrahedra.tetrahedra.size(), 1U);
  EXPECT_EQ(file.tetrahedra.vertices.at(static_cast<std::size_t>(file.tetrahedra.tetrahedra[0][3])),
            Vec3(0, 0, 1));  // node 40
}

TEST(GmshFile, VersionsThatAreNotRead) {
  EXPECT_CONTAINS(refusal("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n"),
                  "a.msh:2:1: version 4.0 is not read, only 1.0, 2.x and 4.1");
  EXPECT_CONTAINS(refusal("$MeshFormat\n3.1 0 8\n$EndMeshFormat\n"), "version 3.1");
  EXPECT_CONTAINS(refusal("$MeshFormat\n2.2 0 4\n$EndMeshFormat\n"), "numbers of a size other than 8 bytes");
}

TEST(GmshFile, SolidsThatAreNotReadAreNamed) {
  EXPECT_CONTAINS(refusal(kFormat + kNodes + "$Elements\n1\n1 5 0 1 2 3 40 5 1 2 3\n$EndElements\n"),
                  "hexahedra, prisms and pyramids are not read");
  EXPECT_CONTAINS(refusal(kFormat + kNodes + "$Elements\n1\n1 99 0 1 2 3\n$EndElements\n"), "elements of type 99");
}

TEST(GmshFile, DamageIsNamed) {
  const auto elements = [](const std::string& row) {
    return kFormat + kNodes + "$Elements\n1\n" + row + "\n$EndElements\n";
  };
  EXPECT_CONTAINS(refusal(elements("1 2 0 1 2 4")), "an element names node 4, which the file does not have");
  EXPECT_CONTAINS(refusal(elements("1 2 0 1 2")), "a.msh:");
  EXPECT_CONTAINS(refusal(kFormat + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n"), "two nodes carry the number 1");
  EXPECT_CONTAINS(refusal(kFormat + "$Nodes\n2\n1 0 0 0\n$EndNodes\n"), "\"$EndNodes\" is no whole number");
  EXPECT_CONTAINS(refusal(kFormat + "$Nodes\n90000000\n"), "is no whole number from 0 to");
  EXPECT_CONTAINS(refusal(kFormat + "$Nodes\n9000000\n1 0 0 0\n"), "more than the file can hold");
  EXPECT_CONTAINS(refusal(kFormat + "$Whatever\nrest"), "$EndWhatever is missing");
  EXPECT_CONTAINS(refusal(kFormat + "Nodes\n"), "a section \"$...\" expected");
  EXPECT_CONTAINS(refusal("$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 4 1 1 3 1 1 1\n$ENDELM\n"), "false number of nodes");
}

TEST(GmshFile, EveryCutIsRefused) {
  const TriangleSurface shape = box(Vec3::Zero(), Vec3::Ones());
  const FileTetrahedra solid = star_of(shape);
  for (const std::string& whole :
       {msh_1(solid.vertices, elements_of(solid)), msh_2(shape.vertices, elements_of(shape), false),
        msh_2(shape.vertices, elements_of(shape), true), msh_4(solid.vertices, elements_of(solid), false),
        msh_4(solid.vertices, elements_of(solid), true)}) {
    const std::size_t first = whole.find(whole.starts_with("$NOD") ? "$ELM" : "$Elements") + 4;
    for (std::size_t length = first; length + 2 < whole.size(); length += 3)
      EXPECT_CONTAINS(refusal(whole.substr(0, length)), "a.msh");
  }
}

TEST(GmshFile, ParametricNodesOfVersion41) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 1 4\n2 1 1 3\n1\n2\n3\n0 0 0 0.1 0.2\n1 0 0 0.3 0.4\n0 1 0 "
      "0.5 0.6\n0 1 0 1\n4\n0 0 1\n$EndNodes\n"
      "$Elements\n1 4 1 4\n2 5 2 4\n1 1 3 2\n2 1 2 4\n3 2 3 4\n4 1 4 3\n$EndElements\n";
  const SurfaceFile file = read_gmsh(text, "a.msh");
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(file.parts[0].name, "surface 5");
  EXPECT_NEAR(file.parts[0].surface.volume_m3(), 1.0 / 6, 1e-12);
}

}  // namespace
}  // namespace trocar::gmsh_format_test
