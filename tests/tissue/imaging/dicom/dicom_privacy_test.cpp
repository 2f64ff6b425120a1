// Nothing that names a patient leaves the readers: not in lists, notes, labels of refusals, nor on standard output and
// error.
#include <gtest/gtest.h>

#include <numeric>

#include "tests/tissue/imaging/dicom/dicom_folder.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/imaging/dicom/zip_fixture.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/rt_structures.h"

namespace trocar::test::dicom_privacy_test {
namespace {

constexpr const char* kMarkers[] = {"MARKER", "marker", "1.9.8.7.6", "19010203", "77123"};

/// Puts a marker into every element that may name a patient, a person, a place or a time, and into all UIDs.
void mark(Elements& data) {
  for (const std::uint32_t tag : {0x00100010U, 0x00080090U, 0x00081050U, 0x00081070U, 0x00321032U})
    data.text(tag, "PN", "MARKER^NAME");
  for (const std::uint32_t tag :
       {0x00100020U, 0x00080080U, 0x00081010U, 0x00081030U, 0x0008103EU, 0x00081040U, 0x00102160U, 0x00180015U,
        0x00181030U, 0x00204000U, 0x00401001U, 0x00080050U, 0x00200010U, 0x00181000U, 0x00081090U})
    data.text(tag, "LO", "MARKER TEXT");
  for (const std::uint32_t tag : {0x00100030U, 0x00080020U, 0x00080021U, 0x00080022U, 0x00080023U})
    data.text(tag, "DA", "19010203");
  data.text(0x00080018, "UI", "1.9.8.7.6.1")
      .text(0x0020000D, "UI", "1.9.8.7.6.2")
      .text(0x0020000E, "UI", "1.9.8.7.6.3");
  data.text(0x00200052, "UI", "1.9.8.7.6.4")
      .text(0x00200011, "IS", "77123")
      .text(0x00080060, "CS", data.encoded().find("RTSTRUCT") == std::string::npos ? "CT" : "RTSTRUCT");
}

/// Everything that reading gives as text.
std::string all_texts(const std::filesystem::path& input) {
  std::string text;
  const auto run = [&](const auto& work) {
    try {
      work();
    } catch (const InputError& error) {
      text += std::string(error.what()) + "\n";
    }
  };
  const auto add = [&](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) text += note + "\n";
  };
  run([&] {
    for (const DicomSeries& series : list_dicom(input))
      text += describe(series) + series.modality + series.problem + series.hash + "\n";
  });
  run([&] {
    const ImageVolume volume = read_dicom_series(input);
    text += volume.modality;
    add(volume.notes);
  });
  run([&] {
    const LabelMap map = read_dicom_segmentation(input);
    add(map.notes);
    for (const Segment& segment : map.segments) text += segment.name;
  });
  run([&] { add(read_rtstruct(input).notes); });
  return text;
}

void expect_private(const std::filesystem::path& input) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  std::string text = all_texts(input);
  const std::string out = ::testing::internal::GetCapturedStdout(), err = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(out, "");
  EXPECT_EQ(err, "");
  EXPECT_FALSE(text.empty());
  for (const char* marker : kMarkers) EXPECT_EQ(text.find(marker), std::string::npos) << marker << " in: " << text;
}

std::vector<SliceFixture> marked_slices(int count = 4) {
  auto slices = stack_of(count, 2);
  for (SliceFixture& slice : slices) slice.change = mark;
  return slices;
}

TEST(DicomPrivacy, GoodSeriesFolderAndZip) {
  const DicomFolder folder;
  const auto slices = marked_slices();
  folder.write_all(slices);
  expect_private(folder.path());
  const TemporaryFolder other;
  expect_private(write_zip(other / "scan.zip", {{"a", slices[0].file()}, {"b", slices[1].file()}}));
}

/// Every kind of refusal: each makes its message from other parts of the file.
TEST(DicomPrivacy, RefusedSeries) {
  const std::vector<std::function<void(std::vector<SliceFixture>&)>> faults{
      [](auto& s) { s.erase(s.begin() + 2); },
      [](auto& s) { s[1].position = s[0].position; },
      [](auto& s) { s[1].rows = 9; },
      [](auto& s) { s[1].photometric = "MARKER"; },
      [](auto& s) { s[1].along_row = Eigen::Vector3d(0, 1, 0), s[1].along_column = Eigen::Vector3d(0, 0, 1); },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.text(0x00280008, "IS", "MARKER"); }; },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.text(0x00200032, "DS", "MARKER"); }; },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.text(0x00281052, "DS", "MARKER"); }; },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.text(0x00080060, "CS", "MARKER"); }; },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.text(0x00080016, "UI", "1.9.8.7.6"); }; },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.text(0x0020000E, "UI", "1.9.8.7.6.9"); }; },
      [](auto& s) {
        s[1].change = [](Elements& d) { mark(d), d.raw(0x00100020, std::string("\x10\0\x20\0??MARKER", 12)); };
      },
      [](auto& s) { s[1].change = [](Elements& d) { mark(d), d.bytes(0x7FE00010, "OW", "MARKER"); }; },
  };
  for (std::size_t n = 0; n < faults.size(); ++n) {
    const DicomFolder folder;
    auto slices = marked_slices();
    faults[n](slices);
    folder.write_all(slices);
    SCOPED_TRACE(n);
    expect_private(folder.path());
    expect_private(folder.path() / "a01");
  }
}

TEST(DicomPrivacy, TruncatedAtEveryPlace) {
  const DicomFolder folder;
  const std::string whole = marked_slices()[1].file();
  for (std::size_t length = 132; length < whole.size(); length += 29)
    expect_private(folder.write("cut", whole.substr(0, length)));
}

TEST(DicomPrivacy, CompressedPixelsThatDecodersComplainAbout) {
  const DicomFolder folder;
  for (const char* syntax :
       {"1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", kRle, "1.9.8.7.6"}) {
    auto slices = marked_slices(2);
    for (std::size_t n = 0; n < 2; ++n) {
      slices[n].change = [](Elements& d) {
        mark(d);
        d.fragments({std::string("\xFF\xD8\xFF\xC3\0\x0B\x10\0\x05\0\x06\x01\x01\x11\0MARKER", 21) +
                     std::string("\xFF\xD9", 2)});
      };
      folder.write(std::to_string(n), slices[n].file(syntax));
    }
    expect_private(folder.path());
  }
}

TEST(DicomPrivacy, SegmentationsAndStructureSets) {
  const DicomFolder folder;
  SegmentationFixture segmentation;
  for (int k = 0; k < 3; ++k) segmentation.frames.push_back({1, {0, 0, 3.0 * k}, std::vector<int>(35, 1)});
  segmentation.change = [](Elements& d) {
    mark(d), d.text(0x00080060, "CS", "SEG").text(0x00700084, "PN", "MARKER^NAME");
  };
  const std::string seg = segmentation.file();
  expect_private(folder.write("seg", seg));
  expect_private(folder.write("seg", seg.substr(0, seg.size() - 3)));
  segmentation.change = [](Elements& d) { mark(d), d.text(0x00080060, "CS", "SEG").text(0x00620001, "CS", "MARKER"); };
  expect_private(folder.write("seg", segmentation.file()));
  StructureFixture box;
  for (int k = 0; k < 3; ++k) box.contours.push_back(rectangle(0, 0, 5, 5, 2.0 * k));
  Elements set = structure_set({box});
  mark(set);
  expect_private(folder.write("rt", dicom_file(set)));
  set.text(0x30060002, "SH", "MARKER").text(0x30060004, "LO", "MARKER").text(0x300E0008, "PN", "MARKER^NAME");
  const std::string rt = dicom_file(set);
  expect_private(folder.write("rt", rt.substr(0, rt.size() - 9)));
}

}  // namespace
}  // namespace trocar::test::dicom_privacy_test
