#include "tissue/organ/surface_import.h"

#include <gtest/gtest.h>

#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/ply_file.h"

namespace trocar::surface_import_test {
namespace {

using test::ascii_ply;

std::string refusal(const std::filesystem::path& path, const std::string& unit) {
  return test::message_of<InputError>([&] { import_surface(path, unit); });
}

TEST(SurfaceImport, OneShapeInThreeUnitsIsOneSurface) {
  test::TemporaryFolder folder;
  const TriangleSurface sphere = test::sphere(Vec3(0.02, 0.05, -0.01), 0.04, 3);
  for (const auto& [unit, scale] : {std::pair("mm", 1e3), std::pair("cm", 1e2), std::pair("m", 1.0)}) {
    const ImportedSurface imported = import_surface(folder.write("s.ply", ascii_ply(sphere, scale)), unit);
    EXPECT_NEAR(imported.surface.volume_m3() / sphere.volume_m3(), 1, 1e-3) << unit;  // six decimals in the file
    EXPECT_EQ(imported.surface.vertices.size(), sphere.vertices.size());
    EXPECT_TRUE(imported.repairs.empty()) << imported.repairs[0];
  }
}

TEST(SurfaceImport, WithoutUnitNamesTheBoxAndTheLikelyUnit) {
  test::TemporaryFolder folder;
  const std::string message =
      refusal(folder.write("s.ply", ascii_ply(test::box(Vec3::Zero(), Vec3(0.2, 0.1, 0.1)), 1e3)), "");
  EXPECT_CONTAINS(message, "s.ply");
  EXPECT_CONTAINS(message, "--unit");
  EXPECT_CONTAINS(message, "200 x 100 x 100");
  EXPECT_CONTAINS(message, "it would be in mm");
}

TEST(SurfaceImport, RefusesImplausibleSizes) {
  test::TemporaryFolder folder;
  const auto path = folder.write("s.ply", ascii_ply(test::box(Vec3::Zero(), Vec3(0.2, 0.1, 0.1)), 1e3));
  EXPECT_CONTAINS(refusal(path, "cm"), "not plausible");
  EXPECT_CONTAINS(refusal(path, "m"), "it would be in mm");
  EXPECT_CONTAINS(refusal(path, "inch"), "mm, cm, m or um");
  const auto tiny = folder.write("tiny.ply", ascii_ply(test::box(Vec3::Zero(), Vec3::Constant(1e-3)), 1));
  EXPECT_CONTAINS(refusal(tiny, "m"), "no unit among");
}

TEST(SurfaceImport, RefusesOpenSurfacesWithTheCountOfEdges) {
  test::TemporaryFolder folder;
  TriangleSurface open = test::sphere(Vec3::Zero(), 0.05, 3);
  open.triangles.erase(open.triangles.begin());
  EXPECT_CONTAINS(refusal(folder.write("open.ply", ascii_ply(open, 1e3)), "mm"), "3 boundary edges");
}

TEST(SurfaceImport, TurnsInwardSurfacesAndKeepsTheLargest) {
  test::TemporaryFolder folder;
  TriangleSurface inward = test::sphere(Vec3::Zero(), 0.05, 3);
  for (auto& triangle : inward.triangles) std::swap(triangle[0], triangle[1]);
  const auto path =
      folder.write("two.ply", ascii_ply(test::joined(inward, test::sphere(Vec3(0.09, 0, 0), 0.0095, 2)), 1e3));
  const ImportedSurface imported = import_surface(path, "mm");
  EXPECT_NEAR(imported.surface.volume_m3(), -inward.volume_m3(), 1e-3 * imported.surface.volume_m3());
  ASSERT_EQ(imported.lost_volumes_m3.size(), 1U);
  ASSERT_EQ(imported.repairs.size(), 2U);
  EXPECT_CONTAINS(imported.repairs[0], "kept the largest of 2 components (512 of 640 triangles)");
  EXPECT_CONTAINS(imported.repairs[1], "turned 512 triangles outwards");
}

TEST(SurfaceImport, RefusesAShapeThatEnclosesNothing) {
  test::TemporaryFolder folder;
  TriangleSurface flat;
  flat.vertices = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0.1, 0.1, 0)};
  flat.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  EXPECT_CONTAINS(refusal(folder.write("flat.ply", ascii_ply(flat, 1e3)), "mm"), "encloses no volume");
}

TEST(SurfaceImport, WeldsDoubledVertices) {
  test::TemporaryFolder folder;
  const TriangleSurface sphere = test::sphere(Vec3::Zero(), 0.05, 2);
  TriangleSurface soup;
  for (const auto& triangle : sphere.triangles) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (const auto vertex : triangle) soup.vertices.push_back(sphere.vertices[static_cast<std::size_t>(vertex)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const ImportedSurface imported = import_surface(folder.write("soup.ply", ascii_ply(soup, 1e3)), "mm");
  EXPECT_EQ(imported.surface.vertices.size(), sphere.vertices.size());
  EXPECT_CONTAINS(imported.repairs.at(0), "welded 384 vertices to 66");
}

TEST(SurfaceImport, CountsWhereTheSourceCutsItself) {
  test::TemporaryFolder folder;
  TriangleSurface sphere = test::sphere(Vec3::Zero(), 0.05, 3);
  sphere.vertices[0] = Vec3(-0.07, 0.001, 0.002);  // a vertex pulled through the other side
  const ImportedSurface imported = import_surface(folder.write("cut.ply", ascii_ply(sphere, 1e3)), "mm");
  EXPECT_GT(imported.source_self_intersections, 0U);
}

TEST(SurfaceImport, RefusesWhatIsNoPly) {
  test::TemporaryFolder folder;
  EXPECT_CONTAINS(refusal(folder.write("a.txt", "solid"), "mm"), "extension");
  EXPECT_CONTAINS(refusal(folder.write("a.ply", "solid"), "mm"), "signature");
  EXPECT_CONTAINS(refusal("no/a.ply", "mm"), "no such file");
  const std::string good = ascii_ply(test::box(Vec3::Zero(), Vec3::Constant(0.1)), 1e3);
  EXPECT_CONTAINS(refusal(folder.write("b.ply", good.substr(0, 60)), "mm"), "the header does not end");
  EXPECT_CONTAINS(refusal(folder.write("c.ply", good.substr(0, good.find("\n3 0 2 1") + 1)), "mm"),
                  "ends at face 0 of 12");
}

// assimp alone would run for ever on some of these.
TEST(SurfaceImport, EveryTruncationIsRefused) {
  test::TemporaryFolder folder;
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3::Constant(0.1));
  const std::string ascii = ascii_ply(box, 1), binary = ply_bytes(box);
  for (const std::string& whole : {ascii, binary})
    for (std::size_t length = 0; length + 2 < whole.size(); length += 7)
      EXPECT_CONTAINS(refusal(folder.write("cut.ply", whole.substr(0, length)), "m"), "cut.ply");
  EXPECT_EQ(import_surface(folder.write("whole.ply", binary), "m").surface.triangles.size(), 12U);
}

TEST(SurfaceImport, DamagedBinaryFilesAreReadOrRefused) {
  test::TemporaryFolder folder;
  const std::string whole = ply_bytes(test::box(Vec3::Zero(), Vec3::Constant(0.1)));
  std::mt19937_64 random(17);
  for (int round = 0; round < 600; ++round) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] = static_cast<char>(random());
    const auto path = folder.write("damaged.ply", bytes);
    try {
      EXPECT_GT(import_surface(path, "m").surface.volume_m3(), 0);
    } catch (const InputError& error) {
      EXPECT_CONTAINS(error.what(), "damaged.ply");
    }
  }
}

}  // namespace
}  // namespace trocar::surface_import_test
