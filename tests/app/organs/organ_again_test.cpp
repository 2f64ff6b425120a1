// An organ made again under its name, its side files proved, and names that organ files cannot hold.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/organs/import_source.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_info.h"
#include "app/organs/organ_package.h"
#include "app/organs/replaced_files.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/file_lock.h"
#include "tissue/organ/organ.h"

namespace trocar::organ_again_test {
namespace {

namespace fs = std::filesystem;

struct Ball {
  test::TemporaryFolder folder;
  OrganImportOptions options;

  Ball() {
    LabelVolume volume = test::ball_volume(24, 3, {0, 0, 0}, 28);
    for (std::size_t voxel = 0; voxel < volume.labels.size(); ++voxel)
      if (volume.labels[voxel] != 0 && voxel >= volume.labels.size() / 2) volume.labels[voxel] = 2;
    options.input =
        folder.write("map.nii.gz", nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels)).string();
    options.output = (folder / "out").string();
    options.label = {"1"};
    options.material = "soft_tissue";
    options.triangles = 700;
    options.licence = "CC0-1.0";
  }

  std::string imported() {
    std::ostringstream out, err;
    EXPECT_EQ(organ_import(options, out, err), 0);
    return err.str();
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path())) names.insert(entry.path().filename().string());
    return names;
  }

  void change(const std::string& name) const {
    std::string bytes = read_bytes(folder / name);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    folder.write(name, bytes);
  }

  std::string info(bool json = false) const {
    std::ostringstream out, err;
    organ_info({folder / "out.organ.toml", json}, out, err);
    return out.str();
  }
  std::string info_refusal() const {
    return test::message_of<InputError>([&] { info(); });
  }
  std::string package_refusal() const {
    std::ostringstream out, err;
    return test::message_of<InputError>([&] {
      organ_package({{(folder / "out.organ.toml").string()}, {}, folder / "out.zip"}, out, err);
    });
  }
};

using Names = std::set<std::string>;

TEST(OrganAgain, FilesThatTheNewOneDoesNotHaveGoAndOnlyThose) {
  Ball ball;
  ball.options.lattice_mm = 8, ball.options.tetrahedra_mm = 8;
  ball.imported();
  ball.folder.write("out.notes.txt", "mine"), ball.folder.write("other.lattice", "another organ's");
  EXPECT_EQ(ball.files(), (Names{"map.nii.gz", "out.lattice", "out.msh", "out.notes.txt", "out.organ.toml", "out.ply",
                                 "other.lattice"}));
  ball.options.tetrahedra_mm = 0;
  const std::string remarks = ball.imported();
  EXPECT_CONTAINS(remarks, "removed out.msh, which the organ of this name had before");
  EXPECT_EQ(remarks.find("removed out.lattice"), std::string::npos);
  EXPECT_EQ(ball.files(),
            (Names{"map.nii.gz", "out.lattice", "out.notes.txt", "out.organ.toml", "out.ply", "other.lattice"}));
}

TEST(OrganAgain, MembersThatASceneNoLongerHasGoWithTheirFiles) {
  Ball ball;
  ball.options.label = {"1", "2"}, ball.options.lattice_mm = 10;
  ball.imported();
  ASSERT_TRUE(fs::exists(ball.folder / "out-label-2.lattice"));
  ball.options.output += ".scene.toml", ball.options.label = {"1"}, ball.options.lattice_mm = 0;
  ball.imported();
  EXPECT_EQ(ball.files(), (Names{"map.nii.gz", "out.scene.toml", "out-label-1.organ.toml", "out-label-1.ply"}));
}

TEST(OrganAgain, AnInputOrADamagedOldManifestLosesNothing) {
  Ball ball;
  ball.options.tetrahedra_mm = 8;
  ball.imported();
  EXPECT_EQ(remove_replaced(ball.folder / "out.organ.toml", {"out.msh"}, {}, {ball.folder / "out.msh"}),
            std::vector<std::string>{});
  ball.change("out.organ.toml");
  ball.folder.write("out.organ.toml", "no manifest");
  ball.options.tetrahedra_mm = 0;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { ball.imported(); }), "out.ply: is there already");
  fs::remove(ball.folder / "out.ply");
  ball.imported();
  EXPECT_TRUE(fs::exists(ball.folder / "out.msh"));
}

/// Another program that imports to this name has its lock from the beginning on.
TEST(OrganAgain, WhileAnotherProgramWritesThisNameTheImportIsRefused) {
  Ball ball;
  ball.imported();
  const std::string before = read_bytes(ball.folder / "out.organ.toml");
  ball.options.triangles = 900;
  {
    const NameLock other(ball.folder / "out");
    EXPECT_CONTAINS(test::message_of<EnvironmentError>([&] { ball.imported(); }),
                    "out: another program is just writing it");
    EXPECT_EQ(read_bytes(ball.folder / "out.organ.toml"), before);
    ball.options.output = (ball.folder / "another").string();
    ball.imported();
  }
  ball.options.output = (ball.folder / "out").string();
  ball.imported();
  EXPECT_EQ(ball.files(), (Names{"map.nii.gz", "another.organ.toml", "another.ply", "out.organ.toml", "out.ply"}));
}

/// Written among its inputs, an organ's source has the hash that it has without it.
TEST(OrganAgain, ALockAmongTheInputsIsNoInput) {
  const test::TemporaryFolder folder;
  folder.write("map.nii.gz", "x");
  const std::string before = hash_of_input(folder.path().string());
  const NameLock lock(folder / "out");
  EXPECT_EQ(hash_of_input(folder.path().string()), before);
}

TEST(OrganAgain, AnImportThatFailsLeavesNeitherLockNorFolder) {
  Ball ball;
  ball.options.output = (ball.folder / "new/er/out").string();
  ball.options.label = {"7"};
  EXPECT_THROW(ball.imported(), InputError);
  EXPECT_EQ(ball.files(), (Names{"map.nii.gz"}));
}

/// What lies there under a name that the import wants stays, and nothing else is written.
TEST(OrganAgain, FilesOfSomebodyElseAreNotOverwritten) {
  for (const bool scene : {false, true}) {
    Ball ball;
    if (scene) ball.options.label = {"1", "2"};
    ball.options.report = ball.folder / "page.html", ball.options.lattice_mm = 10;
    const std::string stem = scene ? "out-label-2" : "out";
    std::vector<std::string> wanted{stem + ".ply", stem + ".lattice", "page.html"};
    if (scene) wanted.push_back(stem + ".organ.toml");
    for (const std::string& name : wanted) {
      ball.folder.write(name, "mine");
      EXPECT_CONTAINS(test::message_of<InputError>([&] { ball.imported(); }),
                      name + ": is there already; it is not overwritten");
      EXPECT_EQ(ball.files(), (Names{"map.nii.gz", name}));
      EXPECT_EQ(read_bytes(ball.folder / name), "mine");
      fs::remove(ball.folder / name);
    }
    ball.imported();
    const Names made = ball.files();
    ball.imported();
    EXPECT_EQ(ball.files(), made) << "its own files, the page among them, are made again";
    ball.options.output = (ball.folder / "another").string(), ball.options.name = "another";
    EXPECT_CONTAINS(test::message_of<InputError>([&] { ball.imported(); }), "page.html: is there already");
  }
}

TEST(OrganSideFiles, AChangedLatticeIsFoundByInfoAndPackage) {
  Ball ball;
  ball.options.lattice_mm = 8;
  ball.imported();
  EXPECT_CONTAINS(ball.info(), "lattice    out.lattice, ");
  ball.change("out.lattice");
  for (const std::string& message : {ball.info_refusal(), ball.package_refusal()}) {
    EXPECT_CONTAINS(message, "out.lattice: its sha256 is not the one in");
    EXPECT_CONTAINS(message, "the file was changed");
  }
  EXPECT_FALSE(fs::exists(ball.folder / "out.zip"));
  fs::remove(ball.folder / "out.lattice");
  EXPECT_CONTAINS(ball.info_refusal(), "out.lattice: no such file");
}

TEST(OrganSideFiles, ChangedTetrahedraAreFoundAndGoodOnesMeasuredAnew) {
  Ball ball;
  ball.options.tetrahedra_mm = 8;
  ball.imported();
  const auto told = nlohmann::json::parse(ball.info(true))["tetrahedra"];
  const OrganManifest manifest = parse_manifest(read_bytes(ball.folder / "out.organ.toml"), "out.organ.toml");
  EXPECT_EQ(told["nodes"], manifest.tetrahedra->nodes);
  EXPECT_NEAR(told["min_dihedral_deg"].get<double>(), manifest.tetrahedra->worst, 0.01);
  std::string lying = read_bytes(ball.folder / "out.organ.toml");
  const std::string cells = "cells = " + std::to_string(manifest.tetrahedra->cells);
  lying.replace(lying.find(cells), cells.size(), "cells = 17");
  ball.folder.write("out.organ.toml", lying);
  EXPECT_CONTAINS(ball.info_refusal(), "the manifest says " + std::to_string(manifest.tetrahedra->nodes) + " and 17");
  ball.change("out.msh");
  EXPECT_CONTAINS(ball.info_refusal(), "out.msh: its sha256");
  EXPECT_CONTAINS(ball.package_refusal(), "out.msh: its sha256");
}

TEST(OrganPage, TheSurfacesBytesAreMadeOnceAndAreThoseOfTheFile) {
  Ball ball;
  ball.options.report = ball.folder / "out.html";
  std::ostringstream err;
  const WrittenOrgans written = import_organs(ball.options, err);
  EXPECT_EQ(written.organs.at(0).surface_bytes, read_bytes(ball.folder / "out.ply"));
  EXPECT_CONTAINS(read_bytes(ball.options.report), written.organs[0].manifest.surface_sha256);
}

TEST(OrganNames, TextThatIsNotUtf8IsRefusedBeforeAnythingIsDone) {
  Ball ball;
  const auto refusal = [&] { return test::message_of<InputError>([&] { ball.imported(); }); };
  ball.options.output = (ball.folder / "le\xe9").string();
  EXPECT_CONTAINS(refusal(), "-o: the text is not UTF-8");
  ball.options.output = (ball.folder / "le\u00e9").string();
  ball.options.credit = "M\xfcller";
  EXPECT_CONTAINS(refusal(), "--credit: the text is not UTF-8");
  ball.options.credit = "M\u00fcller";
  const fs::path latin = ball.folder / "r\xe9sultat.nii.gz";
  fs::copy_file(ball.options.input, latin);
  const std::string good = std::exchange(ball.options.input, latin.string());
  EXPECT_CONTAINS(refusal(), "rename the file");
  fs::remove(latin);
  EXPECT_EQ(ball.files(), Names{"map.nii.gz"});
  ball.options.input = good;
  ball.imported();
  EXPECT_EQ(load_organ(ball.folder / "le\u00e9.organ.toml").credit, "M\u00fcller");
}

}  // namespace
}  // namespace trocar::organ_again_test
