// What people give: folders with other things in them, zips, discs with a DICOMDIR; listed, chosen from, and bounded.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tissue/imaging/dicom/dicom_folder.h"
#include "tests/tissue/imaging/dicom/zip_fixture.h"
#include "tissue/imaging/dicom/unpacked_zip.h"

namespace trocar::test::dicom_input_test {
namespace {

namespace fs = std::filesystem;

SliceFixture like(const std::string& series, const std::string& number, const std::string& modality = "CT") {
  SliceFixture slice;
  slice.series = series, slice.series_number = number, slice.modality = modality;
  if (modality == "MR") slice.sop_class = kMrClass, slice.intercept = 0;
  return slice;
}

Elements report_file() {
  Elements data;
  data.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.11")
      .text(0x00080018, "UI", "1.9")
      .text(0x00080060, "CS", "SR");
  return data.text(0x0020000D, "UI", "1.2.3").text(0x0020000E, "UI", "1.2.3.99").text(0x00200011, "IS", "99");
}

/// A folder as a hospital's disc has it: two series and a report in subfolders, pictures and texts beside them.
void fill(const fs::path& root) {
  const auto put = [&](const fs::path& name, const std::string& bytes) {
    fs::create_directories((root / name).parent_path());
    std::ofstream(root / name, std::ios::binary) << bytes;
  };
  const auto ct = stack_of(5, 2, like("1.2.3.5", "3")), mr = stack_of(4, 3, like("1.2.3.6", "2", "MR"));
  for (std::size_t n = 0; n < ct.size(); ++n) put("DICOM/S1/I" + std::to_string(9 - n), ct[n].file());
  for (std::size_t n = 0; n < mr.size(); ++n) put("DICOM/S2/" + std::to_string(n) + ".dcm", mr[n].file());
  put("DICOM/report", dicom_file(report_file()));
  put("README.TXT", "Please open the viewer.");
  put("viewer/autorun.exe", std::string(500, 'M'));
  put("empty", "");
}

TEST(DicomInput, SeriesOfAFolderAreListedByNumberAndModality) {
  const TemporaryFolder folder;
  fill(folder.path());
  const auto list = list_dicom(folder.path());
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(describe(list[0]),
            "1: MR, 4 images of 6 x 5, 0.500 x 0.750 x 3.000 mm, 3 x 4 x 12.0 mm [" + list[0].hash + "]");
  EXPECT_EQ(list[1].modality, "CT");
  EXPECT_EQ(list[1].images, 5);
  EXPECT_EQ(list[1].rows, 5);
  EXPECT_EQ(list[1].columns, 6);
  EXPECT_DOUBLE_EQ(list[1].spacing_mm[2], 2);
  EXPECT_DOUBLE_EQ(list[1].extent_mm[2], 10);
  EXPECT_EQ(list[2].kind, DicomKind::kOther);
  EXPECT_EQ(describe(list[2]), "3: SR, no image [" + list[2].hash + "]");
  for (const DicomSeries& series : list) EXPECT_TRUE(series.problem.empty()) << series.problem;
  EXPECT_EQ(list[0].hash.size(), 8U);
  EXPECT_NE(list[0].hash, list[1].hash);
}

TEST(DicomInput, SeveralSeriesMustBeChosenFrom) {
  const TemporaryFolder folder;
  fill(folder.path());
  const std::string message = message_of<InputError>([&] { read_dicom_series(folder.path()); });
  EXPECT_CONTAINS(message, "holds 2 series of images; choose one with --series N");
  EXPECT_CONTAINS(message, "\n  1: MR, 4 images");
  EXPECT_CONTAINS(message, "\n  2: CT, 5 images");
  EXPECT_EQ(read_dicom_series(folder.path(), 1).modality, "MR");
  EXPECT_EQ(read_dicom_series(folder.path(), 2).size[2], 5);
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.path(), 7); }), "has no series 7");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.path(), 3); }),
                  "series 3 is not one of images");
}

TEST(DicomInput, WhatIsNotThereOrNotDicomIsRefused) {
  const TemporaryFolder folder;
  EXPECT_CONTAINS(message_of<InputError>([&] { list_dicom(folder / "nowhere"); }), "does not exist");
  EXPECT_CONTAINS(message_of<InputError>([&] { list_dicom(folder.write("text", "hello")); }), "is not a DICOM file");
  EXPECT_CONTAINS(message_of<InputError>([&] { list_dicom(folder.path()); }),
                  "holds no DICOM files (1 files were looked at)");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.write("r", dicom_file(report_file()))); }),
                  "holds no series of images");
}

TEST(DicomInput, AZipGivesWhatItsFolderGives) {
  const TemporaryFolder folder;
  fill(folder / "disc");
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "disc"))
    if (entry.is_regular_file()) {
      std::ifstream in(entry.path(), std::ios::binary);
      files.emplace_back(fs::relative(entry.path(), folder / "disc").string(),
                         std::string(std::istreambuf_iterator<char>(in), {}));
    }
  const fs::path zip = write_zip(folder / "disc.zip", files);
  const auto as_folder = list_dicom(folder / "disc"), as_zip = list_dicom(zip);
  ASSERT_EQ(as_zip.size(), as_folder.size());
  for (std::size_t n = 0; n < as_zip.size(); ++n) EXPECT_EQ(describe(as_zip[n]), describe(as_folder[n]));
  for (const int series : {1, 2}) {
    const ImageVolume a = read_dicom_series(folder / "disc", series), b = read_dicom_series(zip, series);
    EXPECT_EQ(a.values, b.values);
    EXPECT_EQ(a.index_to_ras_mm.matrix(), b.index_to_ras_mm.matrix());
  }
}

int temporary_zip_folders() {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path()))
    count += entry.path().filename().string().starts_with("trocar-zip-") ? 1 : 0;
  return count;
}

TEST(DicomInput, UnpackedFilesAreGoneAfterwardsAlsoAfterErrors) {
  const TemporaryFolder folder, own;
  setenv("TMPDIR", own.path().c_str(), 1);
  auto slices = stack_of(3, 2);
  const fs::path good = write_zip(folder / "good.zip", {{"a", slices[0].file()}, {"b", slices[1].file()}});
  EXPECT_EQ(read_dicom_series(good).size[2], 2);
  EXPECT_EQ(temporary_zip_folders(), 0);
  const fs::path bad = write_zip(folder / "bad.zip", {{"a", slices[0].file()}, {"b", slices[0].file()}});
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(bad); }), "bad.zip: a and ");
  EXPECT_EQ(temporary_zip_folders(), 0);
  struct Stop {};
  EXPECT_THROW(read_dicom_series(good, {},
                                 [](std::string_view stage, double) {
                                   if (stage == "decoding slices") throw Stop();
                                 }),
               Stop);
  EXPECT_EQ(temporary_zip_folders(), 0);
  unsetenv("TMPDIR");
}

TEST(DicomInput, NamesInAZipNeverBecomePaths) {
  const TemporaryFolder folder;
  const auto slices = stack_of(3, 2);
  const fs::path zip = write_zip(
      folder / "evil.zip",
      {{"../../escaped", slices[0].file()}, {"/tmp/trocar-absolute", slices[1].file()}, {"a\nb", slices[2].file()}});
  EXPECT_EQ(read_dicom_series(zip).size[2], 3);
  EXPECT_FALSE(fs::exists(folder.path().parent_path() / "escaped"));
  EXPECT_FALSE(fs::exists("/tmp/trocar-absolute"));
}

TEST(DicomInput, ZipsBeyondTheLimitsAreRefused) {
  const TemporaryFolder folder;
  const std::string slice = stack_of(1, 1)[0].file();
  const std::string bomb = slice + std::string(std::size_t{8} << 20, '\0');
  const fs::path zip = write_zip(folder / "bomb.zip", {{"a", bomb}, {"b", slice}});
  const auto refusal = [&](const ZipLimits& limits) {
    return message_of<InputError>([&] { const UnpackedZip unpacked(zip, limits, {}); });
  };
  ZipLimits limits;
  EXPECT_EQ(UnpackedZip(zip, limits, {}).files().size(), 2U);
  limits.entries = 1;
  EXPECT_CONTAINS(refusal(limits), "holds 2 files: more than 1");
  limits = {}, limits.file_bytes = std::uint64_t{4} << 20;
  EXPECT_CONTAINS(refusal(limits), "a file above 4 MiB");
  limits = {}, limits.all_bytes = std::uint64_t{2} << 20;
  EXPECT_CONTAINS(refusal(limits), "unpacks to more than 2 MiB");
  limits = {}, limits.free_bytes = 1 << 20, limits.ratio = 10;
  EXPECT_CONTAINS(refusal(limits), "more than 10 times its size");
}

TEST(DicomInput, DamagedAndEncryptedZipsAreRefused) {
  const TemporaryFolder folder;
  const auto slices = stack_of(2, 2);
  const fs::path zip = write_zip(folder / "good.zip", {{"a", slices[0].file()}, {"b", slices[1].file()}});
  std::ifstream in(zip, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  EXPECT_CONTAINS(
      message_of<InputError>([&] { list_dicom(folder.write("cut.zip", bytes.substr(0, bytes.size() / 2))); }),
      "is damaged");
  const fs::path locked = write_zip(folder / "locked.zip", {{"a", slices[0].file()}}, "secret");
  EXPECT_CONTAINS(message_of<InputError>([&] { list_dicom(locked); }), "is encrypted");
  EXPECT_CONTAINS(message_of<InputError>([&] {
                    list_dicom(write_zip(folder / "none.zip", {{"a.txt", "text"}}));
                  }),
                  "holds no DICOM files");
}

Elements directory_of(const std::vector<std::string>& names) {
  std::vector<Elements> records{Elements().text(0x00041430, "CS", "PATIENT").text(0x00100010, "PN", "Nobody")};
  for (const std::string& name : names)
    records.push_back(Elements().text(0x00041430, "CS", "IMAGE").text(0x00041500, "CS", name));
  return Elements().text(0x00041130, "CS", "DISC").sequence(0x00041220, records);
}

TEST(DicomInput, ADicomdirNamesItsFiles) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "IMG/A");
  const auto slices = stack_of(4, 2);
  for (std::size_t n = 0; n < 3; ++n) folder.write("IMG/A/I" + std::to_string(n), slices[n].file());
  folder.write("IMG/A/UNNAMED", slices[3].file());
  const fs::path directory =
      folder.write("DICOMDIR", dicom_file(directory_of({"IMG\\A\\I0", "IMG\\A\\I1", "IMG\\A\\I2", "IMG\\A\\I9"})));
  const ImageVolume volume = read_dicom_series(directory);
  EXPECT_EQ(volume.size[2], 3);
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_EQ(volume.notes[0], "The DICOMDIR names 4 files, of which 1 are not there.");
  EXPECT_EQ(read_dicom_series(folder.path()).size[2], 4) << "the folder has one file more";
}

TEST(DicomInput, ADicomdirCannotLeaveItsFolder) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "disc");
  folder.write("outside", stack_of(1, 1)[0].file());
  std::error_code ignored;
  fs::create_symlink(folder / "outside", folder / "disc/LINK", ignored);
  for (const char* name : {"..\\outside", "LINK", "\\outside", "disc/../../outside", "."}) {
    const fs::path directory = folder.write("disc/DICOMDIR", dicom_file(directory_of({name})));
    EXPECT_CONTAINS(message_of<InputError>([&] { list_dicom(directory); }),
                    "names 1 files, none of which lies beside it")
        << name;
  }
}

TEST(DicomInput, DamagedFilesOfASeriesAreRefusedOthersAreNoted) {
  const DicomFolder folder;
  auto slices = stack_of(4, 2);
  folder.write_all(slices);
  Elements lost = report_file();
  const std::string whole = dicom_file(lost.text(0x00400001, "LO", "something at the end"));
  folder.write("z-report", whole.substr(0, whole.size() - 5));
  const ImageVolume volume = folder.read();
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_CONTAINS(volume.notes[0], "1 damaged DICOM files were passed over");
  folder.write("a02", slices[2].file().substr(0, 500));
  EXPECT_CONTAINS(folder.refusal(), "a02: damaged DICOM: the file ends");
}

TEST(DicomInput, AnImageWithoutFileHeaderIsRefused) {
  const DicomFolder folder;
  const auto slices = stack_of(3, 2);
  for (std::size_t n = 0; n < slices.size(); ++n) folder.write(std::to_string(n), slices[n].elements().encoded());
  EXPECT_CONTAINS(folder.refusal(), "has no DICOM file header, so its transfer syntax is unknown");
}

TEST(DicomInput, NestedAndUndefinedSequencesAreSteppedOver) {
  const DicomFolder folder;
  SliceFixture like_this;
  like_this.change = [](Elements& data) {
    Elements inner = Elements().text(0x00200032, "DS", "9\\9\\9").bytes(0x7FE00010, "OW", "icon");
    Elements middle = Elements().sequence(0x00081140, {inner, inner}, true);
    data.sequence(0x00081115, {middle}, true).sequence(0x00880200, {inner}, true);
    data.bytes(0x00091010, "UN", std::string(3000, 'p')).bytes(0x00091011, "OB", std::string(70000, 'q'));
  };
  const auto slices = stack_of(3, 2, like_this);
  folder.write_all(slices);
  expect_holds(folder.read(), slices);
}

TEST(DicomInput, SequencesNestedWithoutEndAreRefused) {
  const DicomFolder folder;
  Elements inner;
  for (int depth = 0; depth < 40; ++depth) inner = Elements().sequence(0x00081115, {inner}, true);
  SliceFixture slice;
  slice.change = [&](Elements& data) { data.sequence(0x00081115, {inner}, true); };
  folder.write("deep", slice.file());
  folder.write("flat", slice.file());
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.path() / "deep"); }), "nested too deep");
}

TEST(DicomInput, ProgressIsAskedAndMayStopTheWork) {
  const DicomFolder folder;
  folder.write_all(stack_of(6, 2));
  std::vector<std::string> stages;
  double last = -1;
  read_dicom_series(folder.path(), {}, [&](std::string_view stage, double share) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage), last = -1;
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1);
    last = share;
  });
  EXPECT_EQ(stages, (std::vector<std::string>{"looking at the files", "decoding slices"}));
  EXPECT_THROW(list_dicom(folder.path(), [](std::string_view, double) { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace trocar::test::dicom_input_test
