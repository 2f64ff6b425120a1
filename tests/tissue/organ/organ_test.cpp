#include "tissue/organ/organ.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar::organ_test {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(TROCAR_SOURCE_DIR) / "assets";

OrganManifest box_manifest() {
  OrganManifest manifest;
  manifest.name = "box";
  manifest.material = "liver";
  manifest.source = {"box.nii", "00", "CT", "mm", 1, "", ""};
  manifest.licence = "unknown";
  manifest.mesh.volume_ml = manifest.mesh.kept_volume_ml = 1;
  manifest.mesh.border_voxels = 3;
  return manifest;
}

std::string load_refusal(const std::filesystem::path& path) {
  return test::message_of<InputError>([&] { load_organ(path); });
}

TEST(Organ, LoadsWhatWasWritten) {
  test::TemporaryFolder folder;
  OrganManifest manifest = box_manifest();
  const Organ organ = load_organ(write_organ(folder / "box", manifest, test::box(Vec3::Zero(), Vec3::Constant(0.1))));
  EXPECT_EQ(organ.name, "box");
  EXPECT_EQ(organ.material, "liver");
  EXPECT_EQ(organ.modality, "CT");
  EXPECT_EQ(organ.source_file, "box.nii");
  EXPECT_EQ(organ.licence, "unknown");
  EXPECT_TRUE(organ.cut_at_border);
  EXPECT_FALSE(organ.synthetic);
  EXPECT_EQ(organ.sha256, manifest.surface_sha256);
  EXPECT_EQ(organ.manifest, folder / "box.organ.toml");
  EXPECT_NEAR(organ.surface.volume_m3(), 1e-3, 1e-9);
}

TEST(Organ, RefusesChangedMissingAndOpenSurfaces) {
  test::TemporaryFolder folder;
  OrganManifest manifest = box_manifest();
  const TriangleSurface box = test::box(Vec3::Zero(), Vec3::Constant(0.1));
  const auto path = write_organ(folder / "box", manifest, box);
  const std::string ply = read_bytes(folder / "box.ply");
  folder.write("box.ply", ply.substr(0, ply.size() - 5));
  EXPECT_CONTAINS(load_refusal(path), "box.ply");
  std::string changed = ply;
  changed[ply.find("end_header\n") + 12] ^= 1;
  folder.write("box.ply", changed);
  EXPECT_CONTAINS(load_refusal(path), "the file was changed");
  std::filesystem::remove(folder / "box.ply");
  EXPECT_CONTAINS(load_refusal(path), "box.ply: no such file");
  EXPECT_CONTAINS(load_refusal(folder / "none.organ.toml"), "no such file");
  TriangleSurface open = box;
  open.triangles.pop_back();
  EXPECT_CONTAINS(load_refusal(write_organ(folder / "open", manifest, open)), "open (3 boundary edges)");
  TriangleSurface inward = box;
  for (auto& triangle : inward.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_CONTAINS(load_refusal(write_organ(folder / "inward", manifest, inward)), "inside out");
  EXPECT_CONTAINS(load_refusal(write_organ(folder / "empty", manifest, TriangleSurface{})), "empty");
}

TEST(Organ, ShippedPhantomsLoadAndSayTheyAreSynthetic) {
  for (const std::string name : {"phantom-liver", "phantom-gallbladder"}) {
    const Organ organ = load_organ(find_organ(name, kAssets));
    EXPECT_TRUE(organ.synthetic);
    EXPECT_EQ(organ.credit, "synthetic CT phantom made by Trocar");
    EXPECT_EQ(organ.licence, "CC0-1.0");
    EXPECT_EQ("phantom-" + organ.name, name);
    EXPECT_FALSE(organ.cut_at_border);
  }
}

TEST(Organ, IsFoundByPathOrByName) {
  test::TemporaryFolder folder;
  const auto file = folder.write("mine.organ.toml", "x");
  EXPECT_EQ(find_organ(file.string(), kAssets), file);
  EXPECT_EQ(find_organ("phantom-liver", kAssets), kAssets / "organs" / "phantom-liver.organ.toml");
  const auto unknown = [](const std::string& name) {
    return test::message_of<InputError>([&] { find_organ(name, kAssets); });
  };
  EXPECT_CONTAINS(unknown("spleen"), "phantom-gallbladder, phantom-liver");
  EXPECT_CONTAINS(unknown("../organs/phantom-liver"), "neither a file");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { find_organ("x", folder.path()); }), "none");
}

}  // namespace
}  // namespace trocar::organ_test
