// Scenes, pages, packages and refusals of the organ commands, from files made in the test.
#include <gtest/gtest.h>
#include <zip.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/progress_display.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_info.h"
#include "app/organs/organ_inspect.h"
#include "app/organs/organ_package.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/organ.h"

namespace trocar::organ_scene_commands_test {
namespace {

using Json = nlohmann::json;

/// Two half balls that lie against each other (5 below, 1 above) on a grid of 3 mm.
LabelVolume halves() {
  LabelVolume volume = test::ball_volume(28, 3, {0, 0, 0}, 34);
  std::size_t voxel = 0;
  for (int k = 0; k < 28; ++k)
    for (int j = 0; j < 28; ++j)
      for (int i = 0; i < 28; ++i, ++voxel)
        if (volume.labels[voxel] != 0) volume.labels[voxel] = k < 14 ? 5 : 1;
  return volume;
}

struct Files {
  test::TemporaryFolder folder;
  LabelVolume labels = halves();
  std::filesystem::path map =
      folder.write("map.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, labels.labels));

  std::filesystem::path image() {
    std::vector<std::int16_t> values;
    for (const std::uint16_t label : labels.labels) values.push_back(label == 5 ? 100 : label == 1 ? 140 : -900);
    return folder.write("ct.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, values));
  }

  OrganImportOptions options(const std::string& output) {
    OrganImportOptions options;
    options.input = map.string();
    options.label_table = "totalsegmentator-v2";
    options.output = (folder / output).string();
    options.triangles = 800;
    options.json = true;
    return options;
  }
};

Json imported(const OrganImportOptions& options) {
  std::ostringstream out, err;
  EXPECT_EQ(organ_import(options, out, err), 0);
  return Json::parse(out.str());
}

std::string refusal(const OrganImportOptions& options) {
  std::ostringstream out, err;
  return test::message_of<InputError>([&] { organ_import(options, out, err); });
}

std::vector<std::string> left(const test::TemporaryFolder& folder, const std::string& stem) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().filename().string().starts_with(stem)) names.push_back(entry.path().filename().string());
  return names;
}

TEST(SceneImport, TwoLabelsBecomeASceneThatLoads) {
  Files files;
  OrganImportOptions options = files.options("abdomen");
  options.label = {"liver", "spleen"};
  const Json report = imported(options);
  ASSERT_EQ(report["organs"].size(), 2U);
  EXPECT_EQ(report["subject"], "liver");
  for (const Json& organ : report["organs"]) {
    EXPECT_TRUE(organ["closed"].get<bool>() && organ["manifold"].get<bool>());
    EXPECT_EQ(organ["self_intersections"], 0);
    EXPECT_LT(std::abs(organ["volume_error_pct"].get<double>()), 1.0) << organ["name"];
  }
  ASSERT_EQ(report["contacts"].size(), 1U);
  EXPECT_NEAR(report["contacts"][0]["area_cm2"].get<double>(), M_PI * 3.4 * 3.4, 6);
  const Organ organ = load_organ(files.folder / "abdomen.scene.toml");
  EXPECT_EQ(organ.name, "liver");
  EXPECT_EQ(organ.adjacent.at(0).name, "spleen");
  std::ostringstream out, err;
  organ_info({files.folder / "abdomen.scene.toml", true}, out, err);
  const Json found = Json::parse(out.str());
  ASSERT_EQ(found["organs"].size(), 2U);
  EXPECT_EQ(report["crossings"], Json::array());
  EXPECT_EQ(found["crossings"], report["crossings"]);
  for (std::size_t n = 0; n < 2; ++n)
    for (const char* key : {"self_intersections", "angles_deg", "edges_mm", "genus"})
      EXPECT_EQ(found["organs"][n][key], report["organs"][n][key]) << key;
}

TEST(SceneImport, AllTakesEveryLabelAndTheLargestIsTheSubject) {
  Files files;
  for (std::uint16_t& label : files.labels.labels) label = label == 5 ? 7 : label;
  files.map = files.folder.write("map.nii.gz",
                                 nifti_gz_bytes(files.labels.size, files.labels.index_to_ras_mm, files.labels.labels));
  OrganImportOptions options = files.options("all");
  options.all = true, options.label_table.clear();
  EXPECT_CONTAINS(refusal(options), "labels 1, 7 have no name in the file");
  options.material = "soft_tissue";
  const Json report = imported(options);
  EXPECT_EQ(report["organs"].size(), 2U);
  EXPECT_EQ(report["organs"][1]["name"], "label-7");
  EXPECT_EQ(report["organs"][1]["material"], "soft_tissue");
  options.subject = "bladder";
  EXPECT_CONTAINS(refusal(options), "--subject bladder");
}

TEST(SceneImport, TheSameInputGivesTheSameBytes) {
  Files files;
  OrganImportOptions options = files.options("one");
  options.all = true;
  imported(options);
  const std::string first = read_bytes(files.folder / "one-liver.ply"),
                    set = read_bytes(files.folder / "one.scene.toml");
  imported(options);
  EXPECT_EQ(read_bytes(files.folder / "one-liver.ply"), first);
  EXPECT_EQ(read_bytes(files.folder / "one.scene.toml"), set);
}

TEST(SceneImport, AnInterruptLeavesNothing) {
  Files files;
  OrganImportOptions options = files.options("stopped");
  options.all = true;
  for (const int after : {0, 3, 12}) {
    int calls = 0;
    options.progress = [&](std::string_view, double) {
      if (calls++ >= after) throw Interrupted();
    };
    std::ostringstream out, err;
    EXPECT_THROW(organ_import(options, out, err), Interrupted) << after;
    EXPECT_TRUE(left(files.folder, "stopped").empty()) << after;
  }
}

TEST(OrganReportPage, HoldsPicturesFiguresAndNothingForeign) {
  Files files;
  OrganImportOptions options = files.options("liver");
  options.input = files.image().string(), options.labels = files.map.string();
  options.label = {"liver"};
  options.credit = "<script>alert(1)</script>";
  options.report = files.folder / "liver.html";
  imported(options);
  const std::string page = read_bytes(options.report);
  std::size_t pictures = 0;
  for (std::size_t at = page.find("data:image/png;base64,"); at != std::string::npos;
       at = page.find("data:image/png;base64,", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 3U) << "three slices; views need the assets";
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing is loaded from anywhere";
  for (const char* words :
       {"closed", "manifold", "Volume of the mesh", "Distance, mesh to source", "sha256 of the source"})
    EXPECT_CONTAINS(page, words);
}

TEST(OrganReportPage, IsRefusedWhereItWouldOverwriteAndLeavesNoOrganWithoutIt) {
  Files files;
  OrganImportOptions options = files.options("liver");
  options.label = {"liver"};
  options.report = files.map;
  EXPECT_CONTAINS(refusal(options), "name it NAME.html");
  std::filesystem::create_directories(files.folder / "page.html.part");  // the page cannot be staged
  options.report = files.folder / "page.html";
  std::ostringstream out, err;
  EXPECT_THROW(organ_import(options, out, err), EnvironmentError);
  EXPECT_TRUE(left(files.folder, "liver").empty()) << "all or nothing";
}

TEST(SceneImport, ALabelOfAFewVoxelsDoesNotStopTheOthers) {
  Files files;
  files.labels.labels[0] = 9;
  files.map = files.folder.write("map.nii.gz",
                                 nifti_gz_bytes(files.labels.size, files.labels.index_to_ras_mm, files.labels.labels));
  OrganImportOptions options = files.options("most");
  options.all = true;
  const Json report = imported(options);
  EXPECT_EQ(report["organs"].size(), 2U);
  EXPECT_CONTAINS(report["organs"][0]["decisions"].dump(), "label 9 is left out");
}

TEST(OrganImport, ACountedMapGetsNoNamesFromTables) {
  Files files;
  for (std::uint16_t& label : files.labels.labels) label = label == 5 ? 2 : label;
  files.map = files.folder.write("map.nii.gz",
                                 nifti_gz_bytes(files.labels.size, files.labels.index_to_ras_mm, files.labels.labels));
  OrganImportOptions options = files.options("one");
  options.label = {"1"}, options.label_table.clear(), options.material = "soft_tissue";
  const Json report = imported(options);
  EXPECT_EQ(report["name"], "label-1") << "1 is the spleen in every table, and here just the first";
  options.label = {"spleen"};
  EXPECT_CONTAINS(refusal(options), "spleen");
}

TEST(OrganImportByThreshold, IsHonestAboutWhatItIs) {
  Files files;
  OrganImportOptions options = files.options("soft");
  options.input = files.image().string();
  options.threshold.window = {50, 120};
  EXPECT_CONTAINS(refusal(options), "--label-table") << "what is marked was numbered by no table";
  options.label_table.clear();
  EXPECT_CONTAINS(refusal(options), "--material");
  options.material = "soft_tissue";
  const Json report = imported(options);
  EXPECT_EQ(report["source"]["modality"], "CT");
  EXPECT_NEAR(report["label_volume_ml"].get<double>(), test::sphere_volume(0.034) * 1e6 / 2, 6);
  EXPECT_CONTAINS(report["repairs"].dump(), "connected pieces");
  EXPECT_CONTAINS(report["repairs"].dump(), "50");
  options.labels = files.map.string();
  EXPECT_CONTAINS(refusal(options), "--threshold");
}

TEST(OrganImport, LabelsThatLieElsewhereAreNotTheImagesLabels) {
  Files files;
  OrganImportOptions options = files.options("x");
  options.input = files.image().string();
  Eigen::Affine3d away = files.labels.index_to_ras_mm;
  away.translation().x() += 500;
  options.labels =
      files.folder.write("away.nii.gz", nifti_gz_bytes(files.labels.size, away, files.labels.labels)).string();
  options.label = {"liver"};
  EXPECT_CONTAINS(refusal(options), "mm outside the image");
}

TEST(OrganInspect, ListsLabelsWithVolumesAndTables) {
  Files files;
  std::ostringstream out, err;
  EXPECT_EQ(organ_inspect({files.map.string(), "totalsegmentator-v2", true, {}}, out, err), 0);
  const Json json = Json::parse(out.str());
  EXPECT_EQ(json["kind"], "label map");
  ASSERT_EQ(json["segments"].size(), 2U);
  EXPECT_EQ(json["segments"][1]["name"], "liver");
  EXPECT_NEAR(json["segments"][1]["volume_ml"].get<double>(), test::sphere_volume(0.034) * 1e6 / 2, 6);
  EXPECT_GE(json["tables_that_fit"].size(), 3U);
}

TEST(OrganInspect, TellsAnImageFromALabelMapAndRefusesWhatIsNeither) {
  Files files;
  std::ostringstream out, err;
  organ_inspect({files.image().string(), "", false, {}}, out, err);
  EXPECT_CONTAINS(out.str(), "image (");
  EXPECT_CONTAINS(out.str(), "28 x 28 x 28 voxels of 3.0 x 3.0 x 3.0 mm, values -900.0 to 140.0");
  const auto missing = [&] { organ_inspect({(files.folder / "no").string(), "", false, {}}, out, err); };
  EXPECT_CONTAINS(test::message_of<InputError>(missing), "no such file");
}

std::string entry_of(const std::filesystem::path& file, const std::string& name) {
  int error = 0;
  zip_t* zip = zip_open(file.c_str(), ZIP_RDONLY, &error);
  EXPECT_NE(zip, nullptr);
  zip_stat_t facts{};
  EXPECT_EQ(zip_stat(zip, name.c_str(), 0, &facts), 0) << name;
  std::string bytes(facts.size, '\0');
  zip_file_t* entry = zip_fopen(zip, name.c_str(), 0);
  EXPECT_EQ(zip_fread(entry, bytes.data(), facts.size), static_cast<zip_int64_t>(facts.size));
  zip_fclose(entry);
  zip_close(zip);
  return bytes;
}

TEST(OrganPackage, RefusesWhatHasNoLicence) {
  Files files;
  OrganImportOptions options = files.options("scene");
  options.all = true;
  imported(options);
  std::ostringstream out, err;
  const OrganPackageOptions package{
      {(files.folder / "scene.scene.toml").string()}, files.folder.path(), files.folder / "out.zip"};
  EXPECT_CONTAINS(test::message_of<InputError>([&] { organ_package(package, out, err); }), "has no licence");
  EXPECT_FALSE(std::filesystem::exists(package.output));
  const OrganPackageOptions wrong{
      {(files.folder / "scene.scene.toml").string()}, files.folder.path(), files.folder / "scene.scene.toml"};
  EXPECT_CONTAINS(test::message_of<InputError>([&] { organ_package(wrong, out, err); }), "name it NAME.zip");
}

TEST(OrganPackage, HoldsEveryFileAndTheCreditsAlwaysTheSameBytes) {
  Files files;
  OrganImportOptions options = files.options("scene");
  options.all = true, options.licence = "CC-BY-4.0", options.credit = "A hospital";
  imported(options);
  std::ostringstream out, err;
  OrganPackageOptions package{
      {(files.folder / "scene.scene.toml").string()}, files.folder.path(), files.folder / "out.zip"};
  ASSERT_EQ(organ_package(package, out, err), 0);
  EXPECT_EQ(entry_of(package.output, "scene-liver.ply"), read_bytes(files.folder / "scene-liver.ply"));
  EXPECT_EQ(entry_of(package.output, "scene.scene.toml"), read_bytes(files.folder / "scene.scene.toml"));
  EXPECT_CONTAINS(entry_of(package.output, "CREDITS.txt"),
                  "liver: made from map.nii.gz (unknown), licence CC-BY-4.0, A hospital");
  const std::string first = read_bytes(package.output);
  organ_package(package, out, err);
  EXPECT_EQ(read_bytes(package.output), first);
}

}  // namespace
}  // namespace trocar::organ_scene_commands_test
