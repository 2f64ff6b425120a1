// What reports, pages and packages say of an organ: the same facts in every form, and refusals that leave nothing
// behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/organs/organ_info.h"
#include "app/organs/organ_package.h"
#include "app/organs/organ_page.h"
#include "app/organs/organ_phantom.h"
#include "app/organs/organ_render.h"
#include "app/organs/organ_report.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::organ_words_more_test {
namespace {

using Json = nlohmann::json;

CompiledMember member(const std::string& name, const Vec3& centre = Vec3::Zero()) {
  CompiledMember organ;
  organ.surface = test::sphere(centre, 0.03, 2);
  OrganManifest& manifest = organ.manifest;
  manifest.name = manifest.material = name;
  manifest.licence = "CC0-1.0", manifest.credit = "somebody";
  manifest.source = {"map.nii.gz", std::string(64, 'a'), "CT", "mm", 5, name, ""};
  manifest.mesh.topology = analyse_topology(organ.surface);
  manifest.mesh.volume_ml = manifest.mesh.kept_volume_ml = organ.surface.volume_m3() * 1e6;
  return organ;
}

std::filesystem::path written(const test::TemporaryFolder& folder, CompiledMember organ,
                              const std::vector<SideFile>& more = {}) {
  return write_organ(folder / organ.manifest.name, organ.manifest, organ.surface, more);
}

OrganSet pair_set() {
  OrganSet set;
  set.name = "pair", set.subject = "liver";
  set.contacts = {{"liver", "spleen", 12.5e-4, true}};
  set.attachments = {{"liver", "diaphragm", 4e-3, {1, 2}}};
  return set;
}

std::string packed(const std::vector<std::string>& organs, const test::TemporaryFolder& folder) {
  std::ostringstream out, err;
  organ_package({organs, folder.path(), folder / "out.zip"}, out, err);
  return out.str();
}

std::string refusal(const std::vector<std::string>& organs, const test::TemporaryFolder& folder) {
  const std::string message = test::message_of<InputError>([&] { packed(organs, folder); });
  EXPECT_FALSE(std::filesystem::exists(folder / "out.zip"));
  return message;
}

TEST(OrganReport, JsonTellsTheManifestInTheUnitsOfItsKeys) {
  CompiledMember organ = member("liver", Vec3(0.1, 0.2, 0.3));
  MeshFacts& mesh = organ.manifest.mesh;
  mesh.distance.max_m = 1.25e-3, mesh.distance_back.max_m = 2.5e-3, mesh.voxel_m = 1e-3, mesh.centroid_offset_m = 1e-4;
  mesh.lost = {{"part", 7, 0.25}}, mesh.added = {{"cavity", 3, 0.5}};
  organ.manifest.lattice = VolumeMeshFile{"a.lattice", "12", 8, 1, 10, 0.5, 0.25};
  const Json json = Json::parse(organ_json(organ.manifest, organ.surface.bounds()));
  EXPECT_EQ(json["distance_mm"]["max"], 1.25);
  EXPECT_EQ(json["hausdorff_mm"], 2.5) << "the larger of both ways";
  EXPECT_EQ(json["hausdorff_voxels"], 2.5);
  EXPECT_EQ(json["centroid_offset_mm"], 0.1);
  EXPECT_EQ(json["lost"][0]["voxels"], 7);
  EXPECT_EQ(json["added"][0]["kind"], "cavity");
  EXPECT_EQ(json["lattice"]["floored_share"], 0.25);
  EXPECT_TRUE(json["tetrahedra"].is_null());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(json["bbox_m"][0][axis].get<double>(), 0.1 * (axis + 1) - 0.03, 1e-6);
    EXPECT_NEAR(json["bbox_m"][1][axis].get<double>(), 0.1 * (axis + 1) + 0.03, 1e-6);
  }
  EXPECT_EQ(json["vertices"].get<int>() - json["triangles"].get<int>() / 2, 2) << "Euler's number of a ball";
}

TEST(OrganReport, TextSaysTheCutTheRepairsAndWhoMadeIt) {
  CompiledMember organ = member("liver");
  const auto text = [&] { return organ_text(organ.manifest, organ.surface.bounds()); };
  EXPECT_CONTAINS(text(), "60.00 x 60.00 x 60.00 mm");
  EXPECT_CONTAINS(text(), "CC0-1.0; somebody");
  EXPECT_EQ(text().find("CUT"), std::string::npos);
  organ.manifest.mesh.border_voxels = 12, organ.manifest.synthetic = true;
  organ.manifest.mesh.repairs = {"filled a hole"}, organ.manifest.decisions = {"the frame is RAS"};
  for (const char* words :
       {"CUT", "12 voxels", "liver (synthetic)", "repair     filled a hole", "decided    the frame is RAS"})
    EXPECT_CONTAINS(text(), words);
  organ.manifest.mesh.lost.assign(11, {"part", 1, 0.1});
  EXPECT_CONTAINS(text(), "and 3 smaller parts");
}

TEST(OrganReport, AFormThatTooFewTrianglesLoseIsSaid) {
  CompiledMember organ = member("liver");
  MeshFacts& mesh = organ.manifest.mesh;
  const auto text = [&] { return organ_text(organ.manifest, organ.surface.bounds()); };
  mesh.kept_error_pct = 0.9, mesh.voxel_m = 0.001, mesh.distance.mean_m = 0.0009;
  EXPECT_EQ(text().find("NOT AS LABELLED"), std::string::npos);
  mesh.kept_error_pct = -35.5;
  EXPECT_CONTAINS(text(), "NOT AS LABELLED  its volume is off by -35.50 %: ");
  mesh.kept_error_pct = 0, mesh.distance.mean_m = 0.004;
  EXPECT_CONTAINS(text(), "its surface lies 4.00 mm off on average, voxels are 1.00 mm: ");
  EXPECT_CONTAINS(organ_summary(organ.manifest, organ.surface.bounds(), "m"), "are too few for this form");
  mesh.repairs = {"wrapped with alpha 2.5 mm"};
  EXPECT_CONTAINS(text(), "or the wrap is too wide (--wrap-alpha)");
}

/// Half a diagonal of a voxel of 1 mm is 0.87 mm. A volume made up elsewhere hides neither a tip nor a swelling.
TEST(OrganReport, WhereOrgansOfASceneAreNotTheirLabelsIsSaid) {
  std::vector<CompiledMember> organs{member("liver"), member("vein"), member("duct"), member("slab")};
  for (CompiledMember& organ : organs) {
    MeshFacts& mesh = organ.manifest.mesh;
    mesh.label_volume_ml = mesh.volume_ml, mesh.voxel_m = 1e-3, mesh.quality.min_angle_deg = 20;
    mesh.centroid_offset_m = 0.86e-3, mesh.volume_error_pct = 0.1;
  }
  EXPECT_EQ(scene_summary(pair_set(), organs, "m").find("not as labelled"), std::string::npos);
  organs[0].manifest.mesh.volume_error_pct = -0.3;
  organs[1].manifest.mesh.centroid_offset_m = 4.1e-3;
  organs[2].manifest.mesh.centroid_offset_m = 0.88e-3;
  organs[1].manifest.mesh.quality.min_angle_deg = 4.9, organs[2].manifest.mesh.quality.min_angle_deg = 0.6;
  organs[3].manifest.mesh.distance_back.mean_m = 4.7e-3;
  EXPECT_CONTAINS(scene_summary(pair_set(), organs, "m"),
                  "  not as labelled: liver -0.3 % of their volume (parts, cavities, bridges: trocar organ info); "
                  "slab 4.7 mm off their surface on average (more --triangles); "
                  "vein 4.1 mm, duct 0.9 mm between the centres of label and surface (thin ends are gone: more "
                  "--triangles); duct 0.6 deg, vein 4.9 deg in the sharpest triangle\n");
}

TEST(OrganReport, OfASceneHoldsEveryOrgansOwnReport) {
  const std::vector<CompiledMember> organs{member("liver"), member("spleen", Vec3(0.1, 0, 0))};
  const Json json = Json::parse(scene_report_json(pair_set(), organs));
  ASSERT_EQ(json["organs"].size(), 2U);
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_EQ(json["organs"][n], Json::parse(organ_json(organs[n].manifest, organs[n].surface.bounds())));
  EXPECT_EQ(json["contacts"][0]["area_cm2"], 12.5);
  EXPECT_EQ(json["attachments"][0]["area_cm2"], 40);
  const std::string text = scene_report_text(pair_set(), organs);
  EXPECT_CONTAINS(text, "pair: 2 organs, exercises are done on liver");
  EXPECT_CONTAINS(text, "liver lies against spleen over 12.50 cm2, the same triangles in both");
  for (const CompiledMember& organ : organs) EXPECT_CONTAINS(text, organ_text(organ.manifest, organ.surface.bounds()));
}

TEST(OrganInfoProof, WhatTheManifestClaimsOfTheSurfaceIsProvedAnew) {
  test::TemporaryFolder folder;
  CompiledMember organ = member("liver");
  organ.manifest.mesh.topology.triangles = 7, organ.manifest.mesh.topology.genus = 3;
  std::ostringstream out, err;
  ASSERT_EQ(organ_info({written(folder, organ), true}, out, err), 0);
  const Json json = Json::parse(out.str());
  EXPECT_EQ(json["triangles"], organ.surface.triangles.size());
  EXPECT_EQ(json["genus"], 0);
  EXPECT_EQ(err.str(), "");
}

TEST(OrganPage, TakesNoWordsForMarkupAndIsTheSameTwice) {
  std::vector<CompiledMember> organs{member("liver")};
  organs[0].manifest.credit = "<img src=x onerror=1>", organs[0].manifest.source.file = "a<b>&\".nii.gz";
  organs[0].manifest.decisions = {"<b>bold</b>"};
  const OrganPageContent content{.organs = organs, .notes = {"note <i>1</i>"}, .assets = {}};
  const std::string page = organ_page(content);
  for (const char* words : {"<img src=x", "<b>bold", "<i>1", "<script", "http://", "https://"})
    EXPECT_EQ(page.find(words), std::string::npos) << words;
  EXPECT_CONTAINS(page, "&lt;b&gt;bold");
  EXPECT_CONTAINS(page, "a&lt;b&gt;&amp;");
  EXPECT_EQ(organ_page(content), page);
}

TEST(OrganPackageRules, ALicenceMustBeKnownHoweverItIsWritten) {
  for (const char* licence : {"unknown", "Unknown", " UNKNOWN ", "", "  ", "none", "None"}) {
    test::TemporaryFolder folder;
    CompiledMember organ = member("liver");
    organ.manifest.licence = licence;
    EXPECT_CONTAINS(refusal({written(folder, organ).string()}, folder), "liver has no licence") << licence;
  }
}

TEST(OrganPackageRules, OneWithoutALicenceStopsThemAll) {
  test::TemporaryFolder folder;
  CompiledMember spleen = member("spleen");
  spleen.manifest.licence = "unknown";
  const std::string good = written(folder, member("liver")).string(), bad = written(folder, spleen).string();
  EXPECT_CONTAINS(refusal({good, bad}, folder), "spleen.organ.toml: spleen has no licence");
  EXPECT_CONTAINS(packed({good}, folder), "out.zip: 3 files");
}

TEST(OrganPackageRules, TwoFilesOfOneNameAndDifferentBytesAreRefused) {
  test::TemporaryFolder folder;
  CompiledMember organ = member("liver"), other = member("liver", Vec3(0.1, 0, 0));
  const std::string first = written(folder, organ).string();
  const std::string second = write_organ(folder / "other" / "liver", other.manifest, other.surface).string();
  EXPECT_CONTAINS(refusal({first, second}, folder), "another organ of the package has a different file of this name");
  EXPECT_CONTAINS(packed({first, first}, folder), "3 files") << "the same one twice is one";
}

TEST(OrganPackageRules, TheLatticeGoesWithItsOrganAndIsMissedWhenGone) {
  test::TemporaryFolder folder;
  CompiledMember organ = member("liver");
  const std::string sha256 = "57104c57fbe0d1c944620f06ca6f5f1e26fc87025ad368e9327743b8975e4d49";  // of "cells"
  organ.manifest.lattice = VolumeMeshFile{"liver.lattice", sha256, 8, 1, 10, 0, 0};
  const std::string file = written(folder, organ, {{"liver.lattice", "cells"}}).string();
  EXPECT_CONTAINS(packed({file}, folder), "4 files");
  std::filesystem::remove(folder / "liver.lattice");
  std::filesystem::remove(folder / "out.zip");
  EXPECT_CONTAINS(refusal({file}, folder), "liver.lattice: no such file");
}

TEST(OrganPackageRules, NothingAndNobodyAreRefused) {
  test::TemporaryFolder folder;
  EXPECT_CONTAINS(refusal({}, folder), "no organ was named");
  EXPECT_CONTAINS(refusal({"no-such-organ"}, folder), "no-such-organ: neither a file nor an organ that ships (none)");
}

TEST(OrganCommands, RefuseSizesAndVariantsOutsideTheirRanges) {
  test::TemporaryFolder folder;
  std::ostringstream out, err;
  const auto file = written(folder, member("liver"));
  for (const auto& [width, height] :
       {std::pair(319, 240), std::pair(320, 239), std::pair(7681, 4320), std::pair(7680, 4321), std::pair(-1, 500)}) {
    const auto call = [&, w = width, h = height] {
      organ_render({file, folder / "x.png", w, h}, folder.path(), out, err);
    };
    EXPECT_CONTAINS(test::message_of<InputError>(call),
                    "not " + std::to_string(width) + " x " + std::to_string(height));
  }
  for (const double voxel : {0.7, 12.5, 0.0, -1.0})
    EXPECT_THROW(organ_phantom({.out = folder / "p", .voxel_mm = voxel}, out, err), InputError) << voxel;
  EXPECT_CONTAINS(
      test::message_of<InputError>([&] { organ_phantom({.out = folder / "p", .variant = "odd"}, out, err); }),
      "short-duct");
  EXPECT_FALSE(std::filesystem::exists(folder / "p"));
}

}  // namespace
}  // namespace trocar::organ_words_more_test
