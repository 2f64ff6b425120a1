// `trocar organ phantom` beyond the shipped organs: variants, patients, voxel sizes, the DICOM series.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/organs/organ_phantom.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/labels/label_volume.h"

namespace trocar::phantom_command_test {
namespace {

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PhantomCommand, DrawsAVariantOfAPatientWithItsDicomSeries) {
  test::TemporaryFolder folder;
  OrganPhantomOptions options;
  options.out = folder / "ct", options.variant = "low-insertion", options.patient = 4, options.voxel_mm = 4,
  options.dicom = true, options.json = true;
  std::ostringstream out, err;
  EXPECT_EQ(organ_phantom(options, out, err), 0);
  const nlohmann::json report = nlohmann::json::parse(out.str());
  EXPECT_EQ(report["variant"], "low-insertion");
  EXPECT_EQ(report["patient"], 4);
  EXPECT_EQ(report["voxel_mm"], 4);
  EXPECT_EQ(report["label_table"], "trocar-phantom");
  EXPECT_EQ(report["organs"][0]["source"]["label_table"], "trocar-phantom");
  const std::string readme = file_bytes(folder / "ct/README.md");
  EXPECT_CONTAINS(readme, "--variant low-insertion --patient 4 --voxel 4 --seed 1");
  EXPECT_CONTAINS(readme, "cystic_duct, ");
  EXPECT_CONTAINS(readme, "206 cystic_artery, ");
  const LabelVolume labels = test::read_label_volume(folder / "ct/labels.nii.gz");
  EXPECT_GT(labels.label_counts().at(201), 10U);
  std::size_t slices = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "ct/dicom"))
    slices += entry.path().extension() == ".dcm" ? 1 : 0;
  EXPECT_EQ(slices, static_cast<std::size_t>(labels.size[2]));
}

TEST(PhantomCommand, ASeedMayChooseTheVariant) {
  test::TemporaryFolder folder;
  OrganPhantomOptions options;
  options.out = folder / "ct", options.variant = "by-seed", options.seed = 8, options.voxel_mm = 6, options.json = true;
  std::ostringstream out, err;
  EXPECT_EQ(organ_phantom(options, out, err), 0);
  EXPECT_EQ(nlohmann::json::parse(out.str())["variant"], "fat");  // the fourth of five
  EXPECT_CONTAINS(file_bytes(folder / "ct/README.md"), "--variant fat --patient 0 --voxel 6 --seed 8");
}

TEST(PhantomCommand, RefusesBeforeItWritesAnything) {
  test::TemporaryFolder folder;
  std::ostringstream out, err;
  OrganPhantomOptions options;
  options.out = folder / "ct", options.variant = "mirrored";
  EXPECT_CONTAINS(test::message_of<InputError>([&] { organ_phantom(options, out, err); }),
                  "no phantom variant \"mirrored\"; known: normal");
  options.variant = "fat", options.voxel_mm = 0.1;
  EXPECT_CONTAINS(test::message_of<InputError>([&] { organ_phantom(options, out, err); }), "outside 0.75 to 12 mm");
  options.out = "";
  EXPECT_CONTAINS(test::message_of<InputError>([&] { organ_phantom(options, out, err); }), "--out");
  EXPECT_FALSE(std::filesystem::exists(folder / "ct"));
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace trocar::phantom_command_test
