// An organ out to other programs and back: the same place, size and name in every format.
#include "app/organs/organ_export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "app/organs/organ_import.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/organ_set.h"
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

std::string exported_tetrahedra(const std::string& organ, const fs::path& output, double size_mm) {
  std::ostringstream out, err;
  EXPECT_EQ(organ_export({organ, output, "ply", kAssets, size_mm}, out, err), 0);
  return out.str();
}

std::string refused_tetrahedra(const fs::path& output, double size_mm) {
  std::ostringstream out, err;
  return test::message_of<InputError>([&] {
    organ_export({"phantom-gallbladder", output, "ply", kAssets, size_mm}, out, err);
  });
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
  for (const char* format : {"ply", "stl", "obj", "vtk", "vtp", "glb"}) {
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

TEST(OrganExport, APlyTellsNameAndMaterialToTheImportAndOthersCommentsDoNot) {
  const test::TemporaryFolder folder;
  const Organ organ = load_organ(find_organ("phantom-gallbladder", kAssets));
  exported("phantom-gallbladder", folder / "g.ply");
  OrganImportOptions options;
  options.input = (folder / "g.ply").string();
  options.output = (folder / "back").string();
  std::ostringstream out, err;
  EXPECT_EQ(organ_import(options, out, err), 0) << err.str();
  const Organ back = load_organ(options.output + ".organ.toml");
  EXPECT_EQ(back.name, organ.name);
  EXPECT_EQ(back.material, organ.material);
  options.name = "sac";
  EXPECT_EQ(organ_import(options, out, err), 0) << err.str();
  EXPECT_EQ(load_organ(options.output + ".organ.toml").material, "sac") << "the user's word";
  options.name.clear();
  std::ifstream in(folder / "g.ply", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t at; (at = bytes.find("comment TROCAR ")) != std::string::npos;)
    bytes.replace(at, 14, "comment ANOTHER");
  options.input = folder.write("thing.ply", bytes).string();
  EXPECT_EQ(organ_import(options, out, err), 0) << err.str();
  EXPECT_EQ(load_organ(options.output + ".organ.toml").name, "thing") << "after its file";
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

/// Corners of the tetrahedra, by region and in their order: readers number the nodes as they please.
std::map<std::string, std::vector<Vec3>> corners_of(const ImportedTetrahedra& mesh) {
  std::map<std::string, std::vector<Vec3>> corners;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const std::int32_t node : mesh.tetrahedra[t])
      corners[mesh.parts[static_cast<std::size_t>(mesh.regions[t])].name].push_back(
          mesh.vertices[static_cast<std::size_t>(node)]);
  return corners;
}

double moved(const ImportedTetrahedra& a, const ImportedTetrahedra& b) {
  const auto ours = corners_of(a), theirs = corners_of(b);
  double most = 0;
  for (const auto& [name, corners] : ours) {
    if (!theirs.contains(name) || theirs.at(name).size() != corners.size()) return INFINITY;
    for (std::size_t n = 0; n < corners.size(); ++n) most = std::max(most, (corners[n] - theirs.at(name)[n]).norm());
  }
  return most;
}

/// Volumes of the regions by name, mL.
std::map<std::string, double> volumes_of(const ImportedTetrahedra& mesh) {
  std::map<std::string, double> volumes;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto at = [&](std::size_t n) -> const Vec3& {
      return mesh.vertices[static_cast<std::size_t>(mesh.tetrahedra[t][n])];
    };
    const std::string& name = mesh.parts[static_cast<std::size_t>(mesh.regions[t])].name;
    volumes[name] += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6 * 1e6;
  }
  return volumes;
}

TEST(OrganExport, ASceneComesBackFromAFolderWithoutACrossing) {
  const test::TemporaryFolder folder;
  const Organ scene = load_organ(find_organ("phantom-abdomen", kAssets));
  for (const char* format : {"ply", "stl"}) {
    const fs::path files = folder / format;
    exported("phantom-abdomen", files, format);
    OrganImportOptions options;
    options.input = files.string();
    options.output = (folder / (std::string("back-") + format)).string();
    std::ostringstream out, err;
    EXPECT_EQ(organ_import(options, out, err), 0) << err.str();
    const Organ back = load_organ(options.output + std::string(kOrganSetSuffix));
    EXPECT_EQ(back.adjacent.size(), scene.adjacent.size());
    EXPECT_EQ(back.surface.triangles.size(), scene.surface.triangles.size()) << format;
    EXPECT_NEAR(back.surface.volume_m3(), scene.surface.volume_m3(), 1e-9);
  }
}

TEST(OrganExport, TetrahedraOfASceneComeBackWithNodesRegionsAndVolumes) {
  const test::TemporaryFolder folder;
  const Organ scene = load_organ(find_organ("phantom-abdomen", kAssets));
  EXPECT_CONTAINS(exported_tetrahedra("phantom-abdomen", folder / "a.msh", 12), "volume within 0.0");
  exported_tetrahedra("phantom-abdomen", folder / "a.vtu", 12);
  SurfaceImportOptions metres;
  metres.unit = "m", metres.frame = "RAS";
  const ImportedTetrahedra msh = read_tetrahedra(folder / "a.msh", metres);
  const ImportedTetrahedra vtu = read_tetrahedra(folder / "a.vtu", {});
  EXPECT_EQ(vtu.unit, "mm");
  EXPECT_EQ(vtu.frame, "RAS");
  EXPECT_EQ(msh.vertices.size(), vtu.vertices.size());
  EXPECT_LT(moved(msh, vtu), 1e-6);
  const auto volumes = volumes_of(msh);
  EXPECT_EQ(volumes.size(), scene.adjacent.size() + 1);
  for (const auto& [name, ml] : volumes_of(vtu)) EXPECT_NEAR(volumes.at(name), ml, 1e-4 * ml) << name;
  for (const Organ& organ : scene.adjacent)  // what the liver holds of others is not the liver's
    EXPECT_NEAR(volumes.at(organ.name), organ.surface.volume_m3() * 1e6, 0.02 * volumes.at(organ.name)) << organ.name;
}

TEST(OrganExport, TetrahedraOfAWrongSizeOrFormatAreRefused) {
  const test::TemporaryFolder folder;
  for (const double size : {0.0, -1.0, 1e9, std::nan("")})
    EXPECT_CONTAINS(refused_tetrahedra(folder / "a.msh", size), "up to 1000 mm");
  EXPECT_CONTAINS(refused_tetrahedra(folder / "a.msh", 0.01), "GB of memory; at most 5 million");
  EXPECT_CONTAINS(refused_tetrahedra(folder / "a.ply", 8), "there are feb, msh, vtu");
  EXPECT_CONTAINS(refused_tetrahedra(folder / "a", 8), "go into one file");
  EXPECT_CONTAINS(refused("phantom-gallbladder", folder / "a.msh"), "give their size");
  EXPECT_CONTAINS(refused_tetrahedra(folder.write("b.msh", "mine"), 8), "is there already");
  EXPECT_FALSE(fs::exists(folder / "a.msh"));
}

TEST(OrganExport, NothingIsOverwrittenAndWhatCannotBeIsSaid) {
  const test::TemporaryFolder folder;
  const fs::path there = folder.write("g.ply", "mine");
  EXPECT_NE(refused("phantom-gallbladder", there).find("g.ply: is there already"), std::string::npos);
  EXPECT_NE(refused("phantom-gallbladder", folder / "g.xyz").find("there are glb, obj, ply, stl, vtk, vtp"),
            std::string::npos);
  EXPECT_NE(refused("phantom-gallbladder", folder / "many", "step").find("--format: \"step\""), std::string::npos);
  EXPECT_NE(refused("phantom-abdomen", folder / "a.stl").find("holds one organ, and here are 18"), std::string::npos);
  folder.write("many/gallbladder.ply", "mine");
  exported("phantom-gallbladder", folder / "g.stl");
  EXPECT_FALSE(fs::exists(folder / "many" / "liver.ply"));
}

}  // namespace
}  // namespace trocar::organ_export_test
