// An organ out to other programs and back: the same place, size and name in every format.
#include "app/organs/organ_export.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/surface_import.h"

namespace trocar::organ_export_test {
namespace {

namespace fs = std::filesystem;
const fs::path kAssets = fs::path(TROCAR_SOURCE_DIR) / "assets";

std::string exported(const std::string& organ, const fs::path& output, const std::string& format = "ply") {
  std::ostringstream out, err;
  EXPECT_EQ(organ_export({organ, output, format, kAssets}, out, err), 0);
  return out.str();
}

std::string refused(const std::string& organ, const fs::path& output, const std::string& format = "ply") {
  std::ostringstream out, err;
  return test::message_of<InputError>([&] { organ_export({organ, output, format, kAssets}, out, err); });
}

/// Largest distance between corners of triangles with the same number, m.
double moved(const TriangleSurface& a, const TriangleSurface& b) {
  if (a.triangles.size() != b.triangles.size()) return INFINITY;
  double most = 0;
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t n = 0; n < 3; ++n)
      most = std::max(most, (a.vertices[static_cast<std::size_t>(a.triangles[t][n])] -
                             b.vertices[static_cast<std::size_t>(b.triangles[t][n])])
                                .norm());
  return most;
}

TEST(OrganExport, ComesBackAtItsPlaceFromEveryFormatWithoutBeingTold) {
  const test::TemporaryFolder folder;
  const Organ organ = load_organ(find_organ("phantom-gallbladder", kAssets));
  for (const char* format : {"ply", "stl", "obj", "vtk", "glb"}) {
    const fs::path file = folder / (std::string("g.") + format);
    EXPECT_EQ(exported("phantom-gallbladder", file), file.string() + "\n");
    const ImportedSurface back = import_surface(file, "");
    EXPECT_LT(moved(organ.surface, back.surface), 1e-6) << format;
  }
}

TEST(OrganExport, AFileSaysItsAxesUnitAndOrigin) {
  const test::TemporaryFolder folder;
  exported("phantom-gallbladder", folder / "g.ply");
  std::ifstream in(folder / "g.ply");
  std::string text(600, ' ');
  in.read(text.data(), 600);
  EXPECT_NE(text.find("comment SPACE=RAS UNIT=mm\n"), std::string::npos) << text.substr(0, 300);
  EXPECT_NE(text.find("(synthetic), licence "), std::string::npos) << text.substr(0, 300);
}

TEST(OrganExport, ASceneIsOneFileOfNamedPartsOrAFolder) {
  const test::TemporaryFolder folder;
  const Organ scene = load_organ(find_organ("phantom-abdomen", kAssets));
  std::set<std::string> names{scene.name};
  for (const Organ& organ : scene.adjacent) names.insert(organ.name);
  for (const char* file : {"a.glb", "a.obj"}) {
    exported("phantom-abdomen", folder / file);
    std::set<std::string> parts;
    for (const SurfacePart& part : list_surface_parts(folder / file)) parts.insert(part.name);
    EXPECT_EQ(parts, names) << file;
  }
  SurfaceImportOptions liver;
  liver.part = scene.name;
  EXPECT_LT(moved(scene.surface, import_surface(folder / "a.glb", liver).surface), 1e-6);
  exported("phantom-abdomen", folder / "organs", "stl");
  for (const std::string& name : names) EXPECT_TRUE(fs::exists(folder / "organs" / (name + ".stl"))) << name;
  const std::string one = scene.adjacent.front().name;
  exported("phantom-abdomen#" + one, folder / "one.ply");
  EXPECT_LT(moved(scene.adjacent.front().surface, import_surface(folder / "one.ply", "").surface), 1e-6);
}

TEST(OrganExport, NothingIsOverwrittenAndWhatCannotBeIsSaid) {
  const test::TemporaryFolder folder;
  const fs::path there = folder.write("g.ply", "mine");
  EXPECT_NE(refused("phantom-gallbladder", there).find("g.ply: is there already"), std::string::npos);
  EXPECT_NE(refused("phantom-gallbladder", folder / "g.xyz").find("there are glb, obj, ply, stl, vtk"),
            std::string::npos);
  EXPECT_NE(refused("phantom-gallbladder", folder / "many", "step").find("--format: \"step\""), std::string::npos);
  EXPECT_NE(refused("phantom-abdomen", folder / "a.stl").find("holds one organ, and here are 18"), std::string::npos);
  folder.write("many/gallbladder.ply", "mine");
  exported("phantom-gallbladder", folder / "g.stl");
  EXPECT_FALSE(fs::exists(folder / "many" / "liver.ply"));
}

}  // namespace
}  // namespace trocar::organ_export_test
