// The wrong kind of file, two organs of one name, labels of a voxel: what is said, and that the advice works.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/organs/organ_export.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_inspect.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/organ.h"

namespace trocar::organ_wrong_inputs_test {
namespace {

namespace fs = std::filesystem;
const fs::path kAssets = fs::path(TROCAR_SOURCE_DIR) / "assets";

std::string imported(const OrganImportOptions& options) {
  std::ostringstream out, err;
  organ_import(options, out, err);
  return out.str() + err.str();
}

std::string refusal(const OrganImportOptions& options) {
  return test::message_of<InputError>([&] { imported(options); });
}

OrganImportOptions asking(const fs::path& input, const fs::path& output) {
  OrganImportOptions options;
  options.input = input.string(), options.output = output.string();
  options.triangles = 600, options.material = "soft_tissue";
  return options;
}

std::string ball(const Eigen::Vector3d& centre_mm, double radius_mm) {
  const LabelVolume volume = test::ball_volume(24, 3, centre_mm, radius_mm);
  return nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels);
}

TEST(OrganWrongInputs, MasksOfOneNameAreToldApartAndTakenByTheirNumbers) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "s");
  folder.write("s/Liver.nii.gz", ball({-20, 0, 0}, 12));
  folder.write("s/liver.nii.gz", ball({20, 0, 0}, 9));
  folder.write("s/spleen.nii.gz", ball({0, 25, 0}, 8));
  OrganImportOptions options = asking(folder / "s", folder / "out");
  options.material.clear();
  EXPECT_CONTAINS(refusal(options),
                  "labels 1 \"Liver\" (of Liver.nii.gz) and 2 \"liver\" (of liver.nii.gz) would both be written as "
                  "\"liver\"; import each by itself: --label 0:1, and under another -o --label 0:2");
  std::vector<double> volumes;
  for (const char* number : {"0:1", "2"}) {
    options.label = {number};
    options.output = (folder / ("out" + std::to_string(volumes.size()))).string();
    imported(options);
    volumes.push_back(load_organ(options.output + ".organ.toml").surface.volume_m3());
  }
  EXPECT_NEAR(volumes[0] / volumes[1], std::pow(12.0 / 9, 3), 0.35);
  options.label = {"liver", "spleen"};
  options.output = (folder / "two").string();
  imported(options);
  EXPECT_EQ(load_organ(folder / "two.scene.toml").adjacent.at(0).name, "spleen");
}

TEST(OrganWrongInputs, SurfacesOfOneNameAreBothNamed) {
  const test::TemporaryFolder folder;
  for (const char* side : {"a", "b"}) {
    fs::create_directory(folder / side);
    folder.write(std::string(side) + "/sac.ply", test::ascii_ply(test::sphere(Vec3::Zero(), 0.03, 2), 1e3));
  }
  OrganImportOptions options = asking(folder / "a" / "sac.ply", folder / "out");
  options.more_inputs = {(folder / "b" / "sac.ply").string()};
  options.surface.unit = "mm";
  const std::string told = refusal(options);
  EXPECT_CONTAINS(told, (folder / "a" / "sac.ply").string() + " and " + (folder / "b" / "sac.ply").string());
  EXPECT_CONTAINS(told, "would both be written as \"sac\": rename one of them, or import each by itself");
}

TEST(OrganWrongInputs, ALabelOfAVoxelIsRefusedWithItsFile) {
  const test::TemporaryFolder folder;
  LabelVolume volume = test::ball_volume(12, 3, {0, 0, 0}, 0);
  volume.labels[800] = 1;
  const fs::path map = folder.write("one.nii.gz", nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels));
  OrganImportOptions options = asking(map, folder / "out");
  options.label = {"1"};
  EXPECT_CONTAINS(refusal(options), map.string() + ": label 1: its largest part has only 1 voxel, and 8 are needed");
}

TEST(OrganWrongInputs, EachCommandSaysWhatItWasGivenAndWhatTakesThat) {
  const test::TemporaryFolder folder;
  OrganImportOptions options =
      asking(folder.write("sac.stl.ply", test::ascii_ply(test::sphere(Vec3::Zero(), 0.03, 3), 1e3)), folder / "sac");
  options.surface.unit = "mm";
  imported(options);
  const std::string organ = (folder / "sac.organ.toml").string(), surface = (folder / "sac.ply").string();
  const auto inspected = [](const std::string& input) {
    std::ostringstream out, err;
    organ_inspect({input, "", false, {}}, out, err);
    return out.str();
  };
  EXPECT_CONTAINS(test::message_of<InputError>([&] { inspected(organ); }),
                  organ + ": is an organ of Trocar already: `trocar organ info`");
  EXPECT_CONTAINS(refusal(asking(organ, folder / "x")), "is an organ of Trocar already");
  EXPECT_CONTAINS(refusal(asking(folder.write("a.scene.toml", "x"), folder / "x")), "is a scene of Trocar already");
  EXPECT_EQ(inspected(surface).find("  :"), std::string::npos) << inspected(surface);
  const auto found = [](const fs::path& file) {
    return test::message_of<InputError>([&] { find_organ(file.string(), kAssets); });
  };
  EXPECT_EQ(found(surface), surface + ": is a surface: give its organ, " + organ);
  EXPECT_CONTAINS(found(folder / "sac.stl.ply"), "is a surface: `trocar organ import` makes an organ of it");
  EXPECT_CONTAINS(found(folder.write("ct.nii.gz", "x")), "is an image or a label map: `trocar organ import`");
  EXPECT_CONTAINS(found(folder.path()), "is a folder: give one of the files in it: a.scene.toml, sac.organ.toml");
  fs::create_directory(folder / "empty");
  EXPECT_CONTAINS(found(folder / "empty"), "is a folder without an organ in it");
}

TEST(OrganWrongInputs, ExportTakesExtensionsInAnyCaseAndTellsLicencesInOneLine) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "s");
  for (int n = 0; n < 6; ++n)
    folder.write("s/part" + std::to_string(n) + ".ply",
                 test::ascii_ply(test::sphere(Vec3(0.05 * n, 0, 0), 0.02, 2), 1e3));
  OrganImportOptions options = asking(folder / "s", folder / "out");
  options.surface.unit = "mm", options.triangles = 200;
  imported(options);
  std::ostringstream out, err;
  const std::string scene = (folder / "out.scene.toml").string();
  EXPECT_THROW(organ_export({scene, folder / "g.STL", "ply", kAssets}, out, err), InputError);
  EXPECT_EQ(err.str(), "") << "nothing was written";
  EXPECT_EQ(organ_export({scene, folder / "g.GLB", "ply", kAssets}, out, err), 0);
  EXPECT_CONTAINS(err.str(), " and 2 more have no licence: they may not be passed on\n");
  const std::string told = err.str();
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_EQ(organ_export({scene + "#part1", folder / "g.PLY", "ply", kAssets}, out, err), 0);
  EXPECT_TRUE(fs::exists(folder / "g.PLY"));
}

}  // namespace
}  // namespace trocar::organ_wrong_inputs_test
