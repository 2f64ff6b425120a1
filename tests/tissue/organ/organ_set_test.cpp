#include "tissue/organ/organ_set.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/surface/surface_check.h"

namespace trocar::organ_set_test {
namespace {

CompiledMember member(const std::string& name, const Vec3& centre, const std::string& licence,
                      const std::string& credit) {
  CompiledMember organ;
  organ.surface = test::sphere(centre, 0.04, 2);
  organ.manifest.name = organ.manifest.material = name;
  organ.manifest.licence = licence;
  organ.manifest.credit = credit;
  organ.manifest.source = {"map.nii.gz", "ab", "CT", "mm", 5, name, ""};
  organ.manifest.mesh.kept_volume_ml = organ.manifest.mesh.volume_ml = organ.surface.volume_m3() * 1e6;
  return organ;
}

struct Written {
  OrganSet set;
  std::vector<CompiledMember> organs;
  std::filesystem::path path;
};

Written write(const test::TemporaryFolder& folder) {
  Written written;
  written.set = {.name = "abdomen",
                 .subject = "liver",
                 .files = {},
                 .sha256 = {},
                 .contacts = {{"liver", "spleen", 12.5e-4, true}},
                 .attachments = {{"liver", "diaphragm", 40e-4, {3, 4, 9}}},
                 .more_files = {}};
  written.organs = {member("liver", Vec3::Zero(), "CC0-1.0", "one"),
                    member("spleen", Vec3(0.1, 0, 0), "CC-BY-4.0", "two")};
  written.organs[1].manifest.synthetic = true;
  written.path =
      write_organ_set(folder / "abdomen", written.set, written.organs, {{"abdomen.vessels.toml", "format = 1\n"}});
  return written;
}

std::string refusal(const std::filesystem::path& path, const std::string& subject = "") {
  return test::message_of<InputError>([&] { load_organ_set(path, subject); });
}

TEST(OrganSet, ComesBackWithSubjectAndAdjacentOrgansInOneFrame) {
  test::TemporaryFolder folder;
  const Written written = write(folder);
  EXPECT_EQ(written.path, folder / "abdomen.scene.toml");
  const Organ organ = load_organ(written.path);
  EXPECT_EQ(organ.name, "liver");
  ASSERT_EQ(organ.adjacent.size(), 1U);
  EXPECT_EQ(organ.adjacent[0].name, "spleen");
  EXPECT_NEAR((organ.adjacent[0].surface.bounds().center() - Vec3(0.1, 0, 0)).norm(), 0, 1e-6);
  EXPECT_EQ(organ.manifest, written.path);
}

TEST(OrganSet, OrgansThatCrossAreToldInTheFileAndRefusedByExercises) {
  test::TemporaryFolder folder;
  Written sound = write(folder);
  EXPECT_TRUE(sound.set.crossings.empty());
  EXPECT_NO_THROW(require_sound(load_organ(sound.path)));
  std::vector<CompiledMember> organs{member("liver", Vec3::Zero(), "CC0-1.0", "one"),
                                     member("spleen", Vec3(0.07, 0, 0), "CC0-1.0", "two")};
  sound.set.crossings = {{"liver", "spleen", 0}};  // what was said before counts for nothing
  const std::filesystem::path path = write_organ_set(folder / "crossing", sound.set, organs, {});
  const OrganSet read = parse_organ_set(read_bytes(path), path.string());
  ASSERT_EQ(read.crossings.size(), 1U);
  EXPECT_EQ(read.crossings[0].b, "spleen");
  EXPECT_GT(read.crossings[0].pairs, 0U);
  EXPECT_EQ(read.crossings, organ_crossings(organs));
  const std::vector<std::string> faults = faults_of(organs, read.crossings);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_CONTAINS(faults[0], "liver and spleen cut each other: " + std::to_string(read.crossings[0].pairs));
  EXPECT_CONTAINS(test::message_of<InputError>([&] { require_sound(load_organ(path)); }),
                  "no exercise can be done on it: liver and spleen cut each other");
}

TEST(OrganSet, WhatTheManifestSaysIsCountedOnWhatTheFileHolds) {
  test::TemporaryFolder folder;
  CompiledMember organ = member("liver", Vec3::Zero(), "CC0-1.0", "one");
  organ.surface =
      test::joined(test::box(Vec3::Zero(), Vec3::Constant(0.1)), test::box(Vec3::Constant(0.05), Vec3::Constant(0.16)));
  organ.manifest.mesh.self_intersections = 0;
  const std::filesystem::path path = write_organ(folder / "liver", organ.manifest, organ.surface);
  const Organ read = load_organ(path);
  EXPECT_GT(organ.manifest.mesh.self_intersections, 0U);
  EXPECT_EQ(organ.manifest.mesh.self_intersections, count_self_intersections(read.surface));
  EXPECT_CONTAINS(test::message_of<InputError>([&] { require_sound(read); }), "liver cuts itself");
}

TEST(OrganSet, CreditsLicencesAndTheSyntheticFlagSpeakForAll) {
  test::TemporaryFolder folder;
  const Organ organ = load_organ(write(folder).path);
  EXPECT_EQ(organ.credit, "one; two");
  EXPECT_EQ(organ.licence, "CC0-1.0; CC-BY-4.0");
  EXPECT_TRUE(organ.synthetic) << "one synthetic organ makes the scene one";
}

TEST(OrganSet, AnotherSubjectIsAnotherOrganWithAnotherHash) {
  test::TemporaryFolder folder;
  const auto path = write(folder).path;
  const Organ liver = load_organ(path), spleen = load_organ(path.string() + "#spleen");
  EXPECT_EQ(spleen.name, "spleen");
  EXPECT_EQ(spleen.adjacent.at(0).name, "liver");
  EXPECT_NE(liver.sha256, spleen.sha256);
  EXPECT_EQ(find_organ(path.string() + "#spleen", folder.path()), path.string() + "#spleen");
  EXPECT_CONTAINS(refusal(path, "kidney"), "no organ \"kidney\" to be the subject; there are liver, spleen");
}

TEST(OrganSet, ASubjectOfASingleOrganIsRefused) {
  test::TemporaryFolder folder;
  write(folder);
  const std::string message =
      test::message_of<InputError>([&] { load_organ((folder / "abdomen-liver.organ.toml").string() + "#liver"); });
  EXPECT_CONTAINS(message, "only a scene has a subject");
}

TEST(OrganSet, TextReadsBackWordForWord) {
  test::TemporaryFolder folder;
  const Written written = write(folder);
  const std::string text = organ_set_text(written.set);
  const OrganSet read = parse_organ_set(text, "x.scene.toml");
  EXPECT_EQ(organ_set_text(read), text);
  EXPECT_EQ(read.contacts, written.set.contacts);
  EXPECT_EQ(read.attachments, written.set.attachments);
  EXPECT_EQ(read.more_files, std::vector<std::string>{"abdomen.vessels.toml"});
  EXPECT_TRUE(std::filesystem::exists(folder / "abdomen.vessels.toml"));
}

TEST(OrganSet, RefusesWithLineAndColumn) {
  test::TemporaryFolder folder;
  const std::string text = organ_set_text(write(folder).set);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    return test::message_of<InputError>([&] { parse_organ_set(other, "x.scene.toml"); });
  };
  EXPECT_CONTAINS(changed("format = 1", "format = 9"), "x.scene.toml:1:10: format must be 1");
  EXPECT_CONTAINS(changed("frame = 'RAS'", "frame = 'LPS'"), "frame must be \"RAS\"");
  EXPECT_CONTAINS(changed("subject = 'liver'", "colour = 'red'"), "key \"subject\" is missing");
  EXPECT_CONTAINS(changed("'abdomen-liver.organ.toml'", "'../liver.organ.toml'"), "beside the scene");
  EXPECT_CONTAINS(changed("area_cm2 = 12.500", "area_cm2 = 'much'"), "area_cm2 must be a number");
  EXPECT_CONTAINS(changed("'abdomen.vessels.toml'", "'../secret.toml'"), "files holds names of files beside the scene");
  EXPECT_CONTAINS(changed("[3, 4, 9]", "[3, -4, 9]"), "triangles holds numbers of triangles");
  EXPECT_CONTAINS(changed("name = 'abdomen'", "name = 'abdomen'\nextra = 1"), "unknown key \"extra\"");
}

TEST(OrganSet, AChangedOrMissingMemberIsNamed) {
  test::TemporaryFolder folder;
  const Written written = write(folder);
  const auto spleen = folder / "abdomen-spleen.organ.toml";
  const std::string bytes = read_bytes(spleen);
  folder.write("abdomen-spleen.organ.toml", bytes + "\n");
  EXPECT_CONTAINS(refusal(written.path), "abdomen-spleen.organ.toml: its sha256 is not the one in");
  std::filesystem::remove(spleen);
  EXPECT_CONTAINS(refusal(written.path), "abdomen-spleen.organ.toml: no such file");
}

TEST(OrganSet, TwoOrgansOfOneNameAreRefused) {
  test::TemporaryFolder folder;
  Written written = write(folder);
  OrganSet twice = written.set;
  twice.files.push_back(twice.files[0]);
  twice.sha256.push_back(twice.sha256[0]);
  EXPECT_CONTAINS(refusal(folder.write("twice.scene.toml", organ_set_text(twice))), "two organs are named \"liver\"");
}

TEST(OrganSet, WritesAllOrNothing) {
  test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "abdomen.scene.toml.part");  // the last file cannot be staged
  OrganSet set{.name = "abdomen",
               .subject = "liver",
               .files = {},
               .sha256 = {},
               .contacts = {},
               .attachments = {},
               .more_files = {}};
  std::vector<CompiledMember> organs{member("liver", Vec3::Zero(), "CC0-1.0", "one")};
  EXPECT_THROW(write_organ_set(folder / "abdomen", set, organs, {}), EnvironmentError);
  EXPECT_FALSE(std::filesystem::exists(folder / "abdomen-liver.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "abdomen-liver.organ.toml"));
}

}  // namespace
}  // namespace trocar::organ_set_test
