// Which files an old organ or scene named, and which of them go: only those, only beside it, never an input.
#include "app/organs/replaced_files.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/organ_set.h"

namespace trocar::replaced_files_test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using List = std::vector<std::string>;

OrganManifest manifest_of(const std::string& name) {
  OrganManifest manifest;
  manifest.name = name;
  return manifest;
}

class ReplacedFiles : public ::testing::Test {
 protected:
  fs::path organ(const std::string& stem, OrganManifest manifest) {
    return write_organ(folder_ / stem, manifest, test::sphere(Vec3::Zero(), 0.03, 2), {});
  }
  fs::path file(const std::string& name) const { return folder_.write(name, "x"); }
  test::TemporaryFolder folder_;
};

TEST_F(ReplacedFiles, AnOrganNamesItsSurfaceAndItsVolumeMeshes) {
  OrganManifest manifest = manifest_of("liver");
  EXPECT_EQ(files_named_by(organ("plain", manifest)), (Names{"plain.ply"}));
  manifest.lattice = VolumeMeshFile{};
  manifest.lattice->file = "full.lattice";
  manifest.lattice->sha256 = std::string(64, 'a');
  EXPECT_EQ(files_named_by(organ("full", manifest)), (Names{"full.lattice", "full.ply"}));
}

TEST_F(ReplacedFiles, ASceneNamesItsMembersTheirFilesAndItsOwnAndNotItself) {
  OrganSet set;
  set.name = "abdomen";
  set.subject = "liver";
  std::vector<CompiledMember> members(2);
  members[0] = {manifest_of("liver"), test::sphere(Vec3::Zero(), 0.03, 2)};
  members[1] = {manifest_of("spleen"), test::sphere(Vec3(0.1, 0, 0), 0.02, 2)};
  const fs::path scene = write_organ_set(folder_ / "out", set, members, {{"out.vessels.toml", "x"}});
  const Names all{"out-liver.organ.toml", "out-liver.ply", "out-spleen.organ.toml", "out-spleen.ply",
                  "out.vessels.toml"};
  EXPECT_EQ(files_named_by(scene), all);
  fs::remove(folder_ / "out-spleen.organ.toml");
  Names without_spleens = all;
  without_spleens.erase("out-spleen.ply");
  EXPECT_EQ(files_named_by(scene), without_spleens) << "a member that is gone names nothing more";
}

TEST_F(ReplacedFiles, WhatCannotBeUnderstoodNamesNothing) {
  EXPECT_EQ(files_named_by(folder_ / "none.organ.toml"), Names{});
  EXPECT_EQ(files_named_by(folder_ / "none.scene.toml"), Names{});
  EXPECT_EQ(files_named_by(folder_.write("bad.organ.toml", "surface = [")), Names{});
  EXPECT_EQ(files_named_by(folder_.write("bad.scene.toml", "format = 99\n")), Names{});
}

TEST_F(ReplacedFiles, AManifestThatNamesAFileElsewhereNamesNothing) {
  std::string text = read_bytes(organ("out", manifest_of("liver")));
  const std::string named = "out.ply";
  ASSERT_NE(text.find(named), std::string::npos);
  text.replace(text.find(named), named.size(), "../out.ply");
  EXPECT_EQ(files_named_by(folder_.write("out.organ.toml", text)), Names{});
}

TEST_F(ReplacedFiles, OnlyWhatTheNewOneLacksGoesInTheOrderOfNames) {
  const fs::path manifest = file("out.organ.toml");
  for (const char* name : {"out.ply", "out.msh", "out.lattice", "other.msh"}) file(name);
  const Names before{"out.ply", "out.msh", "out.lattice", "gone.msh"};
  EXPECT_EQ(remove_replaced(manifest, before, {"out.ply"}, {}), (List{"out.lattice", "out.msh"}));
  EXPECT_TRUE(fs::exists(folder_ / "out.ply"));
  EXPECT_TRUE(fs::exists(folder_ / "other.msh"));
  EXPECT_TRUE(fs::exists(manifest));
  EXPECT_EQ(remove_replaced(manifest, {"out.msh"}, {}, {}), List{}) << "it is gone already";
}

TEST_F(ReplacedFiles, AnInputIsKeptHoweverItsPathIsSpelled) {
  const fs::path manifest = file("out.organ.toml");
  fs::create_directory(folder_ / "sub");
  for (const char* name : {"a.ply", "b.ply", "c.ply"}) file(name);
  fs::create_symlink(folder_ / "b.ply", folder_ / "sub" / "link.ply");
  const List removed =
      remove_replaced(manifest, {"a.ply", "b.ply", "c.ply"}, {},
                      {folder_ / "sub" / ".." / "a.ply", folder_ / "sub" / "link.ply", folder_ / "no-such-input.ply"});
  EXPECT_EQ(removed, List{"c.ply"});
  EXPECT_TRUE(fs::exists(folder_ / "a.ply"));
  EXPECT_TRUE(fs::exists(folder_ / "b.ply"));
}

TEST_F(ReplacedFiles, AFolderOfThatNameStays) {
  fs::create_directory(folder_ / "out.msh");
  EXPECT_EQ(remove_replaced(file("out.organ.toml"), {"out.msh"}, {}, {}), List{});
  EXPECT_TRUE(fs::is_directory(folder_ / "out.msh"));
}

}  // namespace
}  // namespace trocar::replaced_files_test
