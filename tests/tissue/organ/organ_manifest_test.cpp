#include "tissue/organ/organ_manifest.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::organ_manifest_test {
namespace {

OrganManifest full_manifest() {
  OrganManifest manifest;
  manifest.name = "liver \"left\" \\ äöü";
  manifest.material = "liver";
  manifest.synthetic = true;
  manifest.surface = "liver.ply";
  manifest.surface_sha256 = "ab";
  manifest.licence = "CC0-1.0";
  manifest.credit = "somebody";
  manifest.source = {"map.nii.gz", "cd", "CT", "mm", 5, "liver", "totalsegmentator-v1"};
  manifest.mesh.topology.vertices = 10;
  manifest.mesh.topology.triangles = 16;
  manifest.mesh.topology.components = 1;
  manifest.mesh.volume_ml = 99;
  manifest.mesh.label_volume_ml = 100;
  manifest.mesh.kept_volume_ml = 99.5;
  manifest.mesh.distance = {1e-4, 2e-4, 3e-4};
  manifest.mesh.distance_back = {2e-4, 3e-4, 4e-4};
  manifest.mesh.border_voxels = 12;
  manifest.mesh.lost = {{"part", 7, 0.2}, {"detached", 1, 0.03}};
  manifest.mesh.repairs = {"filled a cavity", "it's done"};
  return manifest;
}

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { parse_manifest(text, "x.organ.toml"); });
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = manifest_text(full_manifest());
  EXPECT_NE(text.find(from), std::string::npos) << text;
  return text.replace(text.find(from), from.size(), to);
}

TEST(OrganManifest, ReadsBackEveryField) {
  const OrganManifest wanted = full_manifest(), read = parse_manifest(manifest_text(wanted), "x.organ.toml");
  EXPECT_EQ(read.name, wanted.name);
  EXPECT_EQ(read.material, wanted.material);
  EXPECT_TRUE(read.synthetic);
  EXPECT_EQ(read.surface, wanted.surface);
  EXPECT_EQ(read.surface_sha256, wanted.surface_sha256);
  EXPECT_EQ(read.licence, wanted.licence);
  EXPECT_EQ(read.credit, wanted.credit);
  EXPECT_EQ(read.source.file, "map.nii.gz");
  EXPECT_EQ(read.source.label, 5);
  EXPECT_EQ(read.source.label_name, "liver");
  EXPECT_EQ(read.source.label_table, "totalsegmentator-v1");
  EXPECT_EQ(read.mesh.label_volume_ml, 100);
  EXPECT_NEAR(read.mesh.volume_error_pct, -1, 1e-9);
  EXPECT_NEAR(read.mesh.distance.p99_m, 2e-4, 1e-12);
  EXPECT_NEAR(read.mesh.distance_back.max_m, 4e-4, 1e-12);
  EXPECT_TRUE(read.mesh.cut_at_border());
  ASSERT_EQ(read.mesh.lost.size(), 2U);
  EXPECT_EQ(read.mesh.lost[1].kind, "detached");
  EXPECT_EQ(read.mesh.repairs, wanted.mesh.repairs);
  EXPECT_EQ(manifest_text(read), manifest_text(wanted));
}

TEST(OrganManifest, SurfacesHaveNoLabel) {
  OrganManifest manifest = full_manifest();
  manifest.source.label.reset();
  manifest.mesh.label_volume_ml.reset();
  const OrganManifest read = parse_manifest(manifest_text(manifest), "x.organ.toml");
  EXPECT_FALSE(read.source.label.has_value());
  EXPECT_FALSE(read.mesh.label_volume_ml.has_value());
}

TEST(OrganManifest, RefusesWithLineAndColumn) {
  EXPECT_CONTAINS(refusal("format = 1\nname = \n"), "x.organ.toml:2:");
  EXPECT_CONTAINS(refusal(with("synthetic = true", "synthetic = true\ncolour = 'red'")),
                  "x.organ.toml:6:1: unknown key \"colour\"");
  EXPECT_CONTAINS(refusal(with("format = 2", "format = 3")), "x.organ.toml:1:10: format must be 1 or 2");
  EXPECT_CONTAINS(refusal(with("synthetic = true", "synthetic = 'yes'")),
                  "x.organ.toml:5:13: synthetic must be true or false");
  EXPECT_CONTAINS(refusal(with("unit = 'm'", "unit = 'mm'")), "unit must be \"m\"");
  EXPECT_CONTAINS(refusal(with("material = 'liver'\n", "")), "key \"material\" is missing");
  EXPECT_CONTAINS(refusal(with("vertices = 10", "vertices = -1")), "vertices is negative");
  EXPECT_CONTAINS(refusal(with("vertices = 10", "vertices = 10.5")), "vertices must be a whole number");
  EXPECT_CONTAINS(refusal(with("volume_ml = 99.0000", "volume_ml = nan")), "volume_ml is not finite");
  EXPECT_CONTAINS(refusal(with("'liver.ply'", "'../liver.ply'")), "beside the manifest");
  EXPECT_CONTAINS(refusal(with("[source]", "[sauce]")), "key \"source\" is missing");
  EXPECT_CONTAINS(refusal(with("repairs = [", "repairs = [1,")), "repairs");
}

TEST(OrganManifest, WritesBothFilesOrNone) {
  test::TemporaryFolder folder;
  OrganManifest manifest = full_manifest();
  EXPECT_EQ(write_organ(folder / "box", manifest, test::box(Vec3::Zero(), Vec3::Ones())), folder / "box.organ.toml");
  EXPECT_EQ(manifest.surface, "box.ply");
  EXPECT_TRUE(std::filesystem::exists(folder / "box.ply"));
  std::filesystem::create_directories(folder / "blocked.organ.toml.part");  // the manifest cannot be staged
  EXPECT_THROW(write_organ(folder / "blocked", manifest, test::box(Vec3::Zero(), Vec3::Ones())), EnvironmentError);
  EXPECT_FALSE(std::filesystem::exists(folder / "blocked.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "blocked.ply.part"));
}

}  // namespace
}  // namespace trocar::organ_manifest_test
