// The organ commands as functions: reports, defaults, refusals, and the shipped organs made anew.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/organs/organ_import.h"
#include "app/organs/organ_info.h"
#include "app/organs/organ_phantom.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/organ.h"

namespace trocar::organ_commands_test {
namespace {

using Json = nlohmann::json;
const std::filesystem::path kShipped = std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "organs";

std::filesystem::path write_map(const test::TemporaryFolder& folder, const std::string& name, bool second_label) {
  LabelVolume volume = test::ball_volume(24, 3, {4, 0, -3}, 22);
  for (auto& label : volume.labels) label = static_cast<std::uint16_t>(5 * label);
  if (second_label)
    for (int n = 0; n < 24; ++n) volume.labels[static_cast<std::size_t>(n)] = 4;
  return folder.write(name, nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels));
}

OrganImportOptions options_for(const std::filesystem::path& input, const std::filesystem::path& output) {
  OrganImportOptions options;
  options.input = input.string();
  options.output = output.string();
  options.triangles = 1000;
  options.json = true;
  return options;
}

struct Outcome {
  Json report;
  std::string remarks;
};

Outcome imported(const OrganImportOptions& options) {
  std::ostringstream out, err;
  EXPECT_EQ(organ_import(options, out, err), 0);
  return {Json::parse(out.str()), err.str()};
}

std::string refusal(const OrganImportOptions& options) {
  std::ostringstream out, err;
  return test::message_of<InputError>([&] { organ_import(options, out, err); });
}

/// A slab of three slices swells to four times its thickness with 200 triangles, and keeps its form with as many as the
/// refusal names.
TEST(OrganImport, ASlabOfTooFewTrianglesIsRefusedWithTheNumberThatIsEnough) {
  const test::TemporaryFolder folder;
  LabelVolume slab;
  slab.size = {68, 68, 11};
  for (int k = 0; k < 11; ++k)
    for (int j = 0; j < 68; ++j)
      for (int i = 0; i < 68; ++i)
        slab.labels.push_back(k >= 4 && k < 7 && j >= 4 && j < 64 && i >= 4 && i < 64 ? 1 : 0);
  OrganImportOptions options = options_for(
      folder.write("slab.nii.gz", nifti_gz_bytes(slab.size, slab.index_to_ras_mm, slab.labels)), folder / "out");
  options.material = "soft_tissue", options.triangles = 200;
  const std::string message = refusal(options);
  EXPECT_CONTAINS(message, "slab.nii.gz: 200 triangles are too few for a body ");
  const std::string advice = ": --triangles ";
  ASSERT_NE(message.find(advice), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.organ.toml"));
  options.triangles = std::stoi(message.substr(message.find(advice) + advice.size()));
  const Json report = imported(options).report;
  EXPECT_NEAR(report["kept_error_pct"].get<double>(), 0, 0.1);
  EXPECT_NEAR(1e3 * (report["bbox_m"][1][2].get<double>() - report["bbox_m"][0][2].get<double>()), 3, 1);
}

TEST(OrganImport, JsonHasEveryKeyOfTheInterface) {
  test::TemporaryFolder folder;
  const Outcome outcome = imported(options_for(write_map(folder, "liver.nii.gz", false), folder / "out"));
  for (const char* key : {"name",
                          "surface",
                          "vertices",
                          "triangles",
                          "closed",
                          "manifold",
                          "self_intersections",
                          "components",
                          "genus",
                          "volume_ml",
                          "label_volume_ml",
                          "volume_error_pct",
                          "distance_mm",
                          "bbox_m",
                          "cut_at_border",
                          "lost",
                          "repairs",
                          "unit",
                          "frame",
                          "source",
                          "licence"})
    EXPECT_TRUE(outcome.report.contains(key)) << key;
  for (const char* key : {"mean", "p99", "max"}) EXPECT_TRUE(outcome.report["distance_mm"][key].is_number()) << key;
  for (const char* key : {"file", "sha256", "label", "modality"})
    EXPECT_TRUE(outcome.report["source"].contains(key)) << key;
  EXPECT_EQ(outcome.report["name"], "liver");
  EXPECT_EQ(outcome.report["surface"], "out.ply");
  EXPECT_EQ(outcome.report["closed"], true);
  EXPECT_EQ(outcome.report["self_intersections"], 0);
  EXPECT_EQ(outcome.report["source"]["label"], 5);
  EXPECT_EQ(outcome.report["frame"], "RAS");
  EXPECT_EQ(outcome.report["unit"], "m");
  EXPECT_NEAR(outcome.report["bbox_m"][1][0].get<double>(), 0.026, 0.002);
  EXPECT_EQ(load_organ(folder / "out.organ.toml").name, "liver");
}

TEST(OrganImport, MultiLabelMapsNeedALabelAndSayTheTable) {
  test::TemporaryFolder folder;
  OrganImportOptions options = options_for(write_map(folder, "map.nii.gz", true), folder / "out.organ.toml");
  EXPECT_CONTAINS(refusal(options), "holds labels 4, 5");
  options.label = {"5"};
  EXPECT_CONTAINS(refusal(options), "label 5 has no name in the file");
  EXPECT_CONTAINS(refusal(options), "--label-table");
  EXPECT_CONTAINS(refusal(options), "--material soft_tissue");
  options.label_table = "totalsegmentator-v1";
  const Outcome by_number = imported(options);
  EXPECT_EQ(by_number.report["name"], "liver");
  EXPECT_EQ(by_number.report["source"]["label_table"], "totalsegmentator-v1");
  options.label = {"liver"};
  EXPECT_EQ(imported(options).report, by_number.report);
  options.label = {"tail"};
  EXPECT_CONTAINS(refusal(options), "--label tail");
  options.label = {"spleen"};
  EXPECT_CONTAINS(refusal(options), "\"spleen\" is number 1 in the table totalsegmentator-v1, which marks no voxel");
}

TEST(OrganImport, TakesNameLicenceAndMaterialFromTheUser) {
  test::TemporaryFolder folder;
  OrganImportOptions options = options_for(write_map(folder, "map.nii.gz", false), folder / "out");
  options.name = "ball", options.licence = "CC-BY-4.0", options.credit = "me", options.modality = "MR";
  options.label = {"5"};
  const Json report = imported(options).report;
  EXPECT_EQ(report["name"], "ball");
  EXPECT_EQ(report["material"], "ball");
  EXPECT_EQ(report["licence"], "CC-BY-4.0");
  EXPECT_EQ(report["credit"], "me");
  EXPECT_EQ(report["source"]["modality"], "MR");
}

TEST(OrganImport, RefusalsLeaveNothingBehind) {
  test::TemporaryFolder folder;
  const auto map = write_map(folder, "map.nii.gz", false);
  OrganImportOptions options = options_for(map, folder / "out");
  options.label = {"7"};
  EXPECT_CONTAINS(refusal(options), "label 7 marks no voxel");
  options.label = {"5"}, options.triangles = 10;
  EXPECT_CONTAINS(refusal(options), "--triangles");
  options.triangles = 500, options.surface.unit = "inch";
  EXPECT_CONTAINS(refusal(options), "no unit of length that is known here");
  options.surface.unit.clear(), options.output = folder.path().string() + "/";
  EXPECT_CONTAINS(refusal(options), "names a folder");
  options.output.clear();
  EXPECT_CONTAINS(refusal(options), "-o");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(OrganImport, SurfacesCarryNoLabelVolume) {
  test::TemporaryFolder folder;
  OrganImportOptions options =
      options_for(folder.write("sac.ply", test::ascii_ply(test::sphere(Vec3::Zero(), 0.03, 3), 1e3)), folder / "organ");
  EXPECT_CONTAINS(refusal(options), "--unit");
  options.surface.unit = "mm";
  const Json report = imported(options).report;
  EXPECT_TRUE(report["label_volume_ml"].is_null());
  EXPECT_TRUE(report["source"]["label"].is_null());
  EXPECT_EQ(report["source"]["modality"], "surface");
  EXPECT_NEAR(report["volume_error_pct"].get<double>(), 0, 0.05);
  options.label = {"5"};
  EXPECT_CONTAINS(refusal(options), "go with images");
}

TEST(OrganImport, ReplacingTheInputIsRefused) {
  test::TemporaryFolder folder;
  OrganImportOptions options =
      options_for(folder.write("sac.ply", test::ascii_ply(test::sphere(Vec3::Zero(), 0.03, 3), 1e3)), folder / "sac");
  options.surface.unit = "mm";
  EXPECT_CONTAINS(refusal(options), "would overwrite its input");
}

TEST(OrganInfo, RepeatsTheReportOfTheImport) {
  test::TemporaryFolder folder;
  const Json wanted = imported(options_for(write_map(folder, "liver.nii.gz", false), folder / "out")).report;
  std::ostringstream out, err, text;
  EXPECT_EQ(organ_info({folder / "out.organ.toml", true}, out, err), 0);
  Json info = Json::parse(out.str());
  for (const char* key : {"volume_error_pct", "kept_error_pct"}) {  // computed again from volumes of four decimals
    EXPECT_NEAR(info[key].get<double>(), wanted[key].get<double>(), 1e-3);
    info[key] = wanted[key];
  }
  EXPECT_EQ(info, wanted);
  EXPECT_EQ(organ_info({folder / "out.organ.toml", false}, text, err), 0);
  EXPECT_CONTAINS(text.str(), "closed, manifold");
}

TEST(OrganPhantom, MakesTheShippedOrgansByteForByte) {
  test::TemporaryFolder folder;
  std::ostringstream out, err;
  EXPECT_EQ(organ_phantom({.out = folder.path(), .seed = 1, .json = true}, out, err), 0);
  const Json report = Json::parse(out.str());
  EXPECT_EQ(report["synthetic"], true);
  ASSERT_EQ(report["organs"].size(), 2U);
  for (const char* name : {"phantom-liver", "phantom-gallbladder"})
    for (const char* suffix : {".organ.toml", ".ply"})
      EXPECT_EQ(read_bytes(folder / (std::string(name) + suffix)), read_bytes(kShipped / (std::string(name) + suffix)))
          << name << suffix;
  EXPECT_CONTAINS(read_bytes(folder / "README.md"), "no patient");
  for (const Json& organ : report["organs"]) {
    EXPECT_EQ(organ["synthetic"], true);
    EXPECT_EQ(organ["self_intersections"], 0);
    EXPECT_EQ(organ["source"]["modality"], "CT");
    EXPECT_LT(organ["distance_mm"]["p99"].get<double>(), 1.5);
  }
}

TEST(OrganPhantom, AnotherSeedChangesTheImageAndNotTheOrgans) {
  test::TemporaryFolder folder;
  std::ostringstream out, err;
  EXPECT_EQ(organ_phantom({.out = folder.path(), .seed = 2, .json = false}, out, err), 0);
  EXPECT_EQ(read_bytes(folder / "phantom-liver.ply"), read_bytes(kShipped / "phantom-liver.ply"));
  EXPECT_CONTAINS(out.str(), "(synthetic)");
}

}  // namespace
}  // namespace trocar::organ_commands_test
