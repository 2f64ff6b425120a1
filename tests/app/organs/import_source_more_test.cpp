// What an import starts from: DICOM in a folder or a zip, volumes with and without labels, and what provenance may say
// of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "app/organs/import_source.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_inspect.h"
#include "app/organs/zip_writer.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/phantom/dicom_writer.h"
#include "tissue/imaging/volumes/nifti_writer.h"

namespace trocar::import_source_more_test {
namespace {

namespace fs = std::filesystem;
constexpr const char* kPatient = "MUSTERMANN_ERIKA_19640812";

const CtPhantom& phantom() {
  static const CtPhantom made = make_phantom({.voxel_mm = 12});
  return made;
}

/// A hospital's folder, named after a patient.
fs::path patient_folder(const test::TemporaryFolder& folder) {
  const fs::path path = folder / kPatient;
  write_phantom_dicom(path, phantom());
  return path;
}

fs::path patient_zip(const test::TemporaryFolder& folder) {
  std::map<std::string, std::string> files;
  for (int k = 0; k < phantom().labels.size[2]; ++k)
    files[std::string(kPatient) + "/" + std::to_string(1000 + k) + ".dcm"] = phantom_dicom_slice(phantom(), k);
  return folder.write(std::string(kPatient) + ".zip", zip_bytes(files));
}

fs::path phantom_labels(const test::TemporaryFolder& folder) {
  const LabelVolume& labels = phantom().labels;
  return folder.write("labels.nii.gz", nifti_gz_bytes(labels.size, labels.index_to_ras_mm, labels.labels));
}

OrganImportOptions asking(const fs::path& input, const fs::path& labels = {}) {
  OrganImportOptions options;
  options.input = input.string(), options.labels = labels.string();
  return options;
}

std::string refusal(const OrganImportOptions& options) {
  return test::message_of<InputError>([&] { read_import_source(options); });
}

TEST(ImportSource, AFolderAndAZipOfOneSeriesGiveOneImage) {
  test::TemporaryFolder folder;
  const fs::path labels = phantom_labels(folder);
  const ImportSource a = read_import_source(asking(patient_folder(folder), labels));
  const ImportSource b = read_import_source(asking(patient_zip(folder), labels));
  ASSERT_TRUE(a.image && b.image);
  EXPECT_EQ(a.image->size, phantom().labels.size);
  EXPECT_EQ(a.image->values, b.image->values);
  EXPECT_TRUE(a.image->index_to_ras_mm.isApprox(b.image->index_to_ras_mm, 0));
  EXPECT_TRUE(a.image->index_to_ras_mm.isApprox(phantom().labels.index_to_ras_mm, 1e-6));
  for (std::size_t n = 0; n < a.image->values.size(); n += 97)
    EXPECT_EQ(a.image->values[n], static_cast<float>(phantom().hounsfield[n])) << n;
}

TEST(ImportSource, LabelsOfTheSameGridNeedNoNoteAndTheImageTellsTheModality) {
  test::TemporaryFolder folder;
  const ImportSource source = read_import_source(asking(patient_folder(folder), phantom_labels(folder)));
  EXPECT_TRUE(source.map.notes.empty());
  EXPECT_EQ(source.source.modality, "CT");
  EXPECT_EQ(source.source.file, "labels.nii.gz");
  EXPECT_EQ(source.source.unit, "mm");
  EXPECT_EQ(source.map.layers.at(0).labels, phantom().labels.labels);
}

TEST(ImportSource, LabelsOfAnotherGridInThePatientAreTakenAndSaid) {
  test::TemporaryFolder folder;
  const auto image = patient_folder(folder);
  const LabelVolume ball = test::ball_volume(10, 4, {0, 0, 0}, 15);
  const auto labels = folder.write("ball.nii.gz", nifti_gz_bytes(ball.size, ball.index_to_ras_mm, ball.labels));
  const ImportSource source = read_import_source(asking(image, labels));
  ASSERT_FALSE(source.map.notes.empty());
  EXPECT_CONTAINS(source.map.notes.back(), "another grid than the image");
  EXPECT_EQ(source.map.layers.at(0).size, ball.size) << "surfaces are made on the labels' grid";
}

TEST(ImportSource, AWindowOfValuesOnDicomMakesOneLabelAndNamesNoPatient) {
  test::TemporaryFolder folder;
  for (const fs::path& input : {patient_folder(folder), patient_zip(folder)}) {
    OrganImportOptions options = asking(input);
    options.threshold.window = {{80, 300}};
    const ImportSource source = read_import_source(options);
    ASSERT_EQ(source.map.segments.size(), 1U);
    EXPECT_EQ(source.source.file, "DICOM");
    EXPECT_EQ(source.stem, "organ");
    const auto& labels = source.map.layers.at(0).labels;
    ASSERT_EQ(labels.size(), source.image->values.size());
    std::size_t marked = 0, outside = 0;
    for (std::size_t n = 0; n < labels.size(); ++n) {
      marked += labels[n] != 0;
      outside += labels[n] != 0 && source.image->values[n] < 80;
    }
    EXPECT_GT(marked, 50U);
    EXPECT_LT(outside * 20, marked) << "only what is enclosed may lie outside the window";
  }
}

TEST(ImportSource, NoWrittenFileOfADicomImportNamesTheFolder) {
  test::TemporaryFolder folder;
  OrganImportOptions options = asking(patient_folder(folder));
  options.threshold.window = {{80, 300}};
  options.output = (folder / "soft").string();
  options.report = folder / "soft.html";
  options.triangles = 600, options.material = "soft_tissue";
  std::ostringstream out, err;
  ASSERT_EQ(organ_import(options, out, err), 0) << err.str();  // so rough a window, and it does not cut itself
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    const std::string bytes = read_bytes(entry.path());
    for (const char* word : {"MUSTERMANN", "ERIKA", "19640812", "PHANTOM"})
      EXPECT_EQ(bytes.find(word), std::string::npos) << entry.path() << " " << word;
    ++files;
  }
  EXPECT_EQ(files, 3) << "organ, surface and page";
  EXPECT_EQ(out.str().find("MUSTERMANN"), std::string::npos);
}

TEST(ImportSource, ImagesWithoutLabelsAreRefusedWithTheWaysOut) {
  test::TemporaryFolder folder;
  const std::string message = refusal(asking(patient_folder(folder)));
  EXPECT_CONTAINS(message, "holds DICOM images and no labels");
  EXPECT_CONTAINS(message, "--labels FILE");
  EXPECT_CONTAINS(message, "--threshold LOW HIGH");
}

TEST(ImportSource, AMapAloneIsReadWithoutAnImage) {
  test::TemporaryFolder folder;
  const ImportSource source = read_import_source(asking(phantom_labels(folder)));
  EXPECT_FALSE(source.image);
  EXPECT_EQ(source.stem, "labels");
  EXPECT_EQ(source.source.modality, "unknown");
  EXPECT_EQ(source.source.sha256, digest::of_file(folder / "labels.nii.gz"));
  std::map<int, std::size_t> counted;
  for (const std::uint16_t label : phantom().labels.labels)
    if (label != 0) ++counted[label];
  ASSERT_EQ(source.map.segments.size(), counted.size());
  auto wanted = counted.begin();
  for (const Segment& segment : source.map.segments) EXPECT_EQ(segment.number, (wanted++)->first);
}

TEST(ImportSource, TheUsersModalityGoesBeforeTheFiles) {
  test::TemporaryFolder folder;
  OrganImportOptions options = asking(patient_folder(folder), phantom_labels(folder));
  options.modality = "MR";
  EXPECT_EQ(read_import_source(options).source.modality, "MR");
}

TEST(ImportSource, ValuesThatOnlyCtHasMakeItCt) {
  test::TemporaryFolder folder;
  const LabelVolume ball = test::ball_volume(12, 3, {0, 0, 0}, 12);
  const auto labels = folder.write("ball.nii.gz", nifti_gz_bytes(ball.size, ball.index_to_ras_mm, ball.labels));
  for (const auto& [air, modality] :
       {std::pair<std::int16_t, const char*>(-1000, "CT"), {std::int16_t{0}, "unknown"}}) {
    const std::vector<std::int16_t> values(ball.labels.size(), air);
    const auto image = folder.write("image.nii.gz", nifti_gz_bytes(ball.size, ball.index_to_ras_mm, values));
    EXPECT_EQ(read_import_source(asking(image, labels)).source.modality, modality) << air;
  }
}

TEST(ImportSource, OptionsThatContradictEachOtherAreRefused) {
  test::TemporaryFolder folder;
  const fs::path map = phantom_labels(folder);
  const auto changed = [&](auto&& change) {
    OrganImportOptions options = asking(map);
    change(options);
    return refusal(options);
  };
  EXPECT_CONTAINS(changed([](auto& o) { o.threshold.window = {{0, 1}}, o.all = true; }), "--threshold makes one label");
  EXPECT_CONTAINS(changed([](auto& o) {
                    o.threshold.window = {{0, 1}}, o.label = {"5"};
                  }),
                  "--threshold makes one label");
  EXPECT_CONTAINS(changed([](auto& o) {
                    o.threshold.window = {{0, 1}}, o.labels = o.input;
                  }),
                  "it does not go with --labels");
  EXPECT_CONTAINS(changed([](auto& o) { o.threshold.window = {{0, 1}}, o.threshold.reach_mm = 5; }), "--seed-point");
  EXPECT_CONTAINS(changed([](auto& o) { o.threshold.seed_mm = {{0, 0, 0}}; }), "go with --threshold");
  EXPECT_CONTAINS(changed([](auto& o) { o.threshold.opening_mm = 1; }), "go with --threshold");
  EXPECT_CONTAINS(changed([](auto& o) { o.threshold.closing_mm = 1; }), "go with --threshold");
  EXPECT_CONTAINS(changed([](auto& o) { o.threshold.smooth = true; }), "go with --threshold");
}

TEST(ImportSource, MissingFilesAreNamedWhicheverOfThemItIs) {
  test::TemporaryFolder folder;
  const fs::path map = phantom_labels(folder);
  EXPECT_CONTAINS(refusal(asking(folder / "gone.nii.gz", map)), "gone.nii.gz: no such file or folder");
  EXPECT_CONTAINS(refusal(asking(map, folder / "lost.nrrd")), "lost.nrrd: no such file or folder");
}

TEST(HashOfInput, OfAFolderDependsOnContentAndNotOnNames) {
  test::TemporaryFolder folder;
  fs::create_directories(folder / "a" / "deep");
  fs::create_directories(folder / "b");
  folder.write("a/one", "first"), folder.write("a/deep/two", "second");
  folder.write("b/zzz", "first"), folder.write("b/aaa", "second");
  const std::string a = hash_of_input((folder / "a").string());
  EXPECT_EQ(a, hash_of_input((folder / "b").string()));
  std::vector<std::string> hashes{digest::of_bytes("first"), digest::of_bytes("second")};
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(a, digest::of_bytes(hashes[0] + hashes[1]));
  folder.write("b/aaa", "Second");
  EXPECT_NE(a, hash_of_input((folder / "b").string()));
  EXPECT_EQ(hash_of_input((folder / "a/one").string()), digest::of_bytes("first"));
}

TEST(IsSurfaceInput, GoesByExtensionAndNeverForAFolder) {
  test::TemporaryFolder folder;
  fs::create_directories(folder / "organ.stl");
  for (const auto& [name, surface] :
       {std::pair("liver.ply", true), std::pair("liver.stl", true), std::pair("liver.obj", true),
        std::pair("liver.nii.gz", false), std::pair("liver.dcm", false), std::pair("liver.zip", false)})
    EXPECT_EQ(is_surface_input(asking(folder / name)), surface) << name;
  EXPECT_FALSE(is_surface_input(asking(folder / "organ.stl")));
}

TEST(OrganInspectOfDicom, ListsTheSeriesAndNothingOfThePatient) {
  test::TemporaryFolder folder;
  for (const bool json : {false, true})
    for (const fs::path& input : {patient_folder(folder), patient_zip(folder)}) {
      std::ostringstream out, err;
      ASSERT_EQ(organ_inspect({input.string(), "", json, {}}, out, err), 0);
      EXPECT_CONTAINS(out.str(), "CT");
      EXPECT_CONTAINS(out.str(), std::to_string(phantom().labels.size[2]));
      EXPECT_EQ(out.str().find("MUSTERMANN"), std::string::npos);
      EXPECT_EQ(out.str().find("PHANTOM"), std::string::npos) << "patient name of the files";
    }
}

}  // namespace
}  // namespace trocar::import_source_more_test
