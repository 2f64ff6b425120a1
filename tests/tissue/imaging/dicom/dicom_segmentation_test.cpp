// DICOM segmentations: every marked pixel comes back at its place in the patient, under its segment's name.
#include <gtest/gtest.h>

#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/gdcm_fixture.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"

namespace trocar::test::dicom_segmentation_test {
namespace {

SegmentationFixture random_segmentation(unsigned seed, int segments, int slices, int maximum = 0,
                                        const SegmentationFixture& like = {}) {
  std::mt19937 random(seed);
  SegmentationFixture fixture = like;
  fixture.maximum = maximum;
  fixture.labels.clear();
  for (int segment = 1; segment <= segments; ++segment) {
    fixture.labels.push_back("Organ " + std::to_string(segment));
    for (int k = 0; k < slices; ++k) {
      SegmentationFrame frame{segment, {-40, 12, 100 + 2.5 * k}, {}};
      for (int n = 0; n < fixture.rows * fixture.columns; ++n)
        frame.values.push_back(maximum == 0 ? static_cast<int>(random() % 2)
                                            : static_cast<int>(random() % static_cast<unsigned>(maximum + 1)));
      fixture.frames.push_back(frame);
    }
  }
  std::shuffle(fixture.frames.begin(), fixture.frames.end(), random);
  return fixture;
}

/// Number at a point (LPS) in the layer of a segment.
int label_at(const LabelVolume& layer, const Eigen::Vector3d& lps) {
  const Eigen::Vector3d index = layer.index_to_ras_mm.inverse() * Eigen::Vector3d(-lps.x(), -lps.y(), lps.z());
  const Eigen::Vector3i at = index.array().round().cast<int>();
  EXPECT_LT((index - at.cast<double>()).norm(), 1e-6);
  return layer.labels[layer.offset(at.x(), at.y(), at.z())];
}

void expect_holds(const LabelMap& map, const SegmentationFixture& fixture) {
  for (const SegmentationFrame& frame : fixture.frames) {
    const auto segment = std::find_if(map.segments.begin(), map.segments.end(),
                                      [&](const Segment& one) { return one.number == frame.segment; });
    ASSERT_NE(segment, map.segments.end());
    EXPECT_EQ(segment->name, fixture.labels[static_cast<std::size_t>(frame.segment - 1)]);
    const std::vector<SegmentCode> codes{{"category", "SCT", "85756007", "Tissue"},
                                         {"type", "SCT", "10200004", "Liver"}};
    ASSERT_EQ(segment->codes, codes);
    for (int j = 0; j < fixture.rows; ++j)
      for (int i = 0; i < fixture.columns; ++i) {
        const int value = frame.values[static_cast<std::size_t>(j * fixture.columns + i)];
        const bool marked = fixture.maximum == 0 ? value != 0 : value != 0 && 2 * value >= fixture.maximum;
        const Eigen::Vector3d at =
            frame.position + fixture.along_row * fixture.row_step * i + fixture.along_column * fixture.column_step * j;
        ASSERT_EQ(label_at(map.layers[segment->layer], at) == frame.segment, marked)
            << frame.segment << " " << i << " " << j;
      }
  }
}

/// A label map of 4 slices with the numbers 3, 7 and 200 (and 40000 instead of it where 16 bits have room).
SegmentationFixture label_map(unsigned seed, int bits, const SegmentationFixture& like = {}) {
  std::mt19937 random(seed);
  SegmentationFixture fixture = like;
  const int last = bits == 16 ? 40000 : 200;
  fixture.label_bits = bits, fixture.numbers = {3, 7, last};
  fixture.labels = {"Organ 3", "Organ 7", "Organ " + std::to_string(last)};
  const int values[] = {0, 3, 7, last};
  for (const int k : {2, 0, 3, 1}) {
    SegmentationFrame frame{0, {-40, 12, 100 + 2.5 * k}, {}};
    for (int n = 0; n < fixture.rows * fixture.columns; ++n) frame.values.push_back(values[random() % 4]);
    fixture.frames.push_back(frame);
  }
  return fixture;
}

void expect_numbers(const LabelMap& map, const SegmentationFixture& fixture) {
  ASSERT_EQ(map.layers.size(), 1U);
  ASSERT_EQ(map.segments.size(), fixture.labels.size());
  for (std::size_t n = 0; n < fixture.labels.size(); ++n) {
    EXPECT_EQ(map.segments[n].number, fixture.numbers[n]);
    EXPECT_EQ(map.segments[n].name, fixture.labels[n]);
  }
  for (const SegmentationFrame& frame : fixture.frames)
    for (int j = 0; j < fixture.rows; ++j)
      for (int i = 0; i < fixture.columns; ++i)
        ASSERT_EQ(label_at(map.layers[0], frame.position + fixture.along_row * fixture.row_step * i +
                                              fixture.along_column * fixture.column_step * j),
                  frame.values[static_cast<std::size_t>(j * fixture.columns + i)]);
}

class DicomSegmentation : public ::testing::Test {
 protected:
  LabelMap read(const std::string& bytes) { return read_dicom_segmentation(folder_.write("seg.dcm", bytes)); }
  std::string refusal(const std::string& bytes) {
    return message_of<InputError>([&] { read(bytes); });
  }
  TemporaryFolder folder_;
};

TEST_F(DicomSegmentation, OneSegmentInFramesOfAnyOrder) {
  const SegmentationFixture fixture = random_segmentation(1, 1, 6);
  const LabelMap map = read(fixture.file());
  ASSERT_EQ(map.layers.size(), 1U);
  EXPECT_EQ(map.layers[0].size, (std::array<int, 3>{7, 5, 8})) << "an empty slice before and behind";
  EXPECT_TRUE(map.notes.empty()) << map.notes[0];
  expect_holds(map, fixture);
}

TEST_F(DicomSegmentation, OverlappingSegmentsLieInLayers) {
  const SegmentationFixture fixture = random_segmentation(2, 3, 4);
  const LabelMap map = read(fixture.file());
  EXPECT_EQ(map.layers.size(), 3U);
  EXPECT_EQ(map.segments.size(), 3U);
  EXPECT_CONTAINS(map.notes.at(0), "they lie in 3 layers");
  expect_holds(map, fixture);
}

TEST_F(DicomSegmentation, SegmentsThatDoNotOverlapShareALayer) {
  SegmentationFixture fixture = random_segmentation(3, 1, 4);
  fixture.labels.push_back("Rest");
  for (int k = 0; k < 4; ++k) {
    SegmentationFrame rest = fixture.frames[static_cast<std::size_t>(k)];
    rest.segment = 2;
    for (int& value : rest.values) value = 1 - value;
    fixture.frames.push_back(rest);
  }
  const LabelMap map = read(fixture.file());
  ASSERT_EQ(map.layers.size(), 1U);
  expect_holds(map, fixture);
}

TEST_F(DicomSegmentation, FractionalCountsFromOneHalf) {
  for (const int maximum : {255, 100, 1}) {
    const SegmentationFixture fixture = random_segmentation(4, 1, 3, maximum);
    const LabelMap map = read(fixture.file());
    expect_holds(map, fixture);
    EXPECT_CONTAINS(map.notes.at(0), "from one half of the maximum on");
  }
}

TEST_F(DicomSegmentation, ObliqueFramesLieWhereTheySay) {
  SegmentationFixture fixture = random_segmentation(5, 1, 4);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized();
  fixture.along_row = turn * Eigen::Vector3d::UnitX(), fixture.along_column = turn * Eigen::Vector3d::UnitY();
  for (SegmentationFrame& frame : fixture.frames) frame.position = turn * frame.position;
  const LabelMap map = read(fixture.file());
  for (const SegmentationFrame& frame : fixture.frames) {
    const Eigen::Vector3d lps =
        frame.position + fixture.along_row * fixture.row_step * 3 + fixture.along_column * fixture.column_step * 2;
    const LabelVolume& layer = map.layers[0];
    const Eigen::Vector3d index = layer.index_to_ras_mm.inverse() * Eigen::Vector3d(-lps.x(), -lps.y(), lps.z());
    const Eigen::Vector3i at = index.array().round().cast<int>();
    ASSERT_LT((index - at.cast<double>()).norm(), 1e-5);
    EXPECT_EQ(layer.labels[layer.offset(at.x(), at.y(), at.z())], frame.values[2 * 7 + 3]);
  }
}

TEST_F(DicomSegmentation, SlicesLeftOutAreEmpty) {
  SegmentationFixture fixture = random_segmentation(6, 1, 8);
  std::sort(fixture.frames.begin(), fixture.frames.end(),
            [](const auto& a, const auto& b) { return a.position.z() < b.position.z(); });
  fixture.frames.erase(fixture.frames.begin() + 3, fixture.frames.begin() + 5);
  const LabelMap map = read(fixture.file());
  EXPECT_EQ(map.layers[0].size[2], 10);
  EXPECT_CONTAINS(map.notes.at(0), "leaves 2 slices out");
  expect_holds(map, fixture);
}

TEST_F(DicomSegmentation, SegmentsWithoutVoxelsAreLeftOutWithANote) {
  SegmentationFixture fixture = random_segmentation(7, 1, 3);
  fixture.labels.push_back("Nothing");
  const LabelMap map = read(fixture.file());
  EXPECT_EQ(map.segments.size(), 1U);
  EXPECT_CONTAINS(map.notes.at(0), "Segment 2 (Nothing) marks no voxel");
}

/// The encoders refuse smaller ones; frames of bits do not end at whole bytes.
const SegmentationFixture kLarge = [] {
  SegmentationFixture fixture;
  fixture.columns = 43, fixture.rows = 37;
  return fixture;
}();

constexpr const char *kJpeg2000Lossless = "1.2.840.10008.1.2.4.90", *kJpegLsLossless = "1.2.840.10008.1.2.4.80",
                     *kJpegBaselineLossy = "1.2.840.10008.1.2.4.50";

TEST_F(DicomSegmentation, DeflatedIsReadInEveryKind) {
  for (const int maximum : {0, 255}) {
    SegmentationFixture fixture = random_segmentation(8, 2, 3, maximum);
    fixture.encoding = Encoding::kDeflated;
    expect_holds(read(fixture.file()), fixture);
  }
  SegmentationFixture map = label_map(8, 16);
  map.encoding = Encoding::kDeflated;
  expect_numbers(read(map.file()), map);
}

TEST_F(DicomSegmentation, RleIsReadInEveryKind) {
  for (const int maximum : {0, 255}) {  // 35 bits a frame: packed afresh in each
    const SegmentationFixture fixture = random_segmentation(8, 2, 3, maximum);
    expect_holds(read(fixture.file(kRle, [&](const auto& frame) { return rle_frame(fixture.bytes_of(frame), 1); })),
                 fixture);
  }
  for (const int bits : {8, 16}) {
    const SegmentationFixture map = label_map(9, bits);
    expect_numbers(read(map.file(kRle,
                                 [&](const auto& frame) {
                                   return rle_frame(
                                       map.bytes_of(frame).substr(0, static_cast<std::size_t>(35 * bits / 8)),
                                       bits / 8);
                                 })),
                   map);
  }
}

/// One frame's values as a compressed code, by GDCM's encoders.
std::string coded(const SegmentationFixture& fixture, const SegmentationFrame& frame, const char* syntax, int stored) {
  SliceFixture slice;
  slice.columns = fixture.columns, slice.rows = fixture.rows, slice.is_signed = false;
  slice.allocated = fixture.label_bits == 16 ? 16 : 8, slice.stored = stored;
  slice.value = [&](int i, int j) { return frame.values[static_cast<std::size_t>(j * fixture.columns + i)]; };
  const std::string file = compressed(slice.file(), syntax);
  const std::size_t start = file.find(syntax == kJpeg2000Lossless ? "\xFF\x4F\xFF" : "\xFF\xD8\xFF");
  return file.substr(start, file.size() - start - 8);
}

TEST_F(DicomSegmentation, Jpeg2000AndJpegLsAreRead) {
  for (const char* syntax : {kJpeg2000Lossless, kJpegLsLossless}) {
    for (const int bits : {8, 16}) {
      const SegmentationFixture map = label_map(10, bits, kLarge);
      expect_numbers(read(map.file(syntax, [&](const auto& frame) { return coded(map, frame, syntax, bits); })), map);
    }
    const SegmentationFixture fractions = random_segmentation(12, 1, 3, 255, kLarge);
    expect_holds(read(fractions.file(syntax, [&](const auto& frame) { return coded(fractions, frame, syntax, 8); })),
                 fractions);
  }
  const SegmentationFixture bits = random_segmentation(13, 2, 3, 0, kLarge);
  expect_holds(
      read(bits.file(kJpeg2000Lossless, [&](const auto& frame) { return coded(bits, frame, kJpeg2000Lossless, 1); })),
      bits);
}

TEST_F(DicomSegmentation, LossBeforeItCameIsTold) {
  const SegmentationFixture fractions = random_segmentation(15, 1, 3, 255, kLarge);
  const auto code = [&](const auto& frame) { return coded(fractions, frame, kJpegLsLossless, 8); };
  const LabelMap map = read(fractions.file("1.2.840.10008.1.2.4.81", code));  // JPEG-LS that may lose, and need not
  expect_holds(map, fractions);
  EXPECT_TRUE(has_note(map.notes, "compressed with loss"));
  EXPECT_FALSE(has_note(read(fractions.file(kJpegLsLossless, code)).notes, "compressed with loss"));
}

TEST_F(DicomSegmentation, LabelMapsCarryTheirOwnNumbers) {
  for (const int bits : {8, 16}) {
    const SegmentationFixture map = label_map(14, bits);
    const LabelMap result = read(map.file());
    EXPECT_TRUE(result.notes.empty()) << result.notes[0];
    expect_numbers(result, map);
  }
}

TEST_F(DicomSegmentation, ALabelMapsBackgroundIsWhatItSays) {
  SegmentationFixture map = label_map(15, 8);
  map.labels.insert(map.labels.begin(), "Background"), map.numbers.insert(map.numbers.begin(), 0);
  EXPECT_TRUE(read(map.file()).notes.empty()) << "a described background is no organ without voxels";
  map.labels.erase(map.labels.begin()), map.numbers.erase(map.numbers.begin());
  map.change = [](Elements& data) { data.word(0x00280120, 200); };
  const LabelMap result = read(map.file());
  EXPECT_EQ(result.segments.size(), 2U);
  EXPECT_CONTAINS(result.notes.at(0), "beside the background, number 200");
}

TEST_F(DicomSegmentation, ALabelMapsPaletteGivesColours) {
  SegmentationFixture map = label_map(16, 8);
  map.change = [](Elements& data) {
    data.text(0x00280004, "CS", "PALETTE COLOR");
    for (unsigned part = 0; part < 3; ++part) {
      std::string table;
      for (int n = 0; n < 256; ++n) table += static_cast<char>(part == 0 ? n : part == 1 ? 255 - n : 7);
      data.bytes(0x00281101 + part, "US", std::string("\0\1\0\0\x08\0", 6)).bytes(0x00281201 + part, "OW", table);
    }
  };
  const LabelMap result = read(map.file());
  expect_numbers(result, map);
  EXPECT_EQ(result.segments.at(2).colour, (SegmentColour{200, 55, 7}));
}

TEST_F(DicomSegmentation, WhatALabelMapDoesNotSayIsTold) {
  SegmentationFixture map = label_map(17, 8);
  map.labels.pop_back(), map.numbers.pop_back();
  const LabelMap result = read(map.file());
  EXPECT_EQ(result.segments.at(2).number, 200);
  EXPECT_EQ(result.segments.at(2).name, "");
  EXPECT_CONTAINS(result.notes.at(0), "Number 200 marks");
  SegmentationFixture twice = label_map(17, 8);
  twice.frames[1].position = twice.frames[2].position;
  EXPECT_CONTAINS(refusal(twice.file()), "two frames in one place");
  SegmentationFixture named = label_map(17, 8);
  named.numbers = {7, 7, 200};
  EXPECT_CONTAINS(refusal(named.file()), "describes segment 7 twice (Organ 3 and Organ 7)");
  const SegmentationFixture lossy = label_map(17, 8);
  EXPECT_CONTAINS(refusal(lossy.file(kJpegBaselineLossy, [](const auto&) { return std::string("xx"); })),
                  "compressed with loss (JPEG Baseline");
}

TEST_F(DicomSegmentation, CompressedFramesThatAreCutOffOrMissingAreRefused) {
  const SegmentationFixture bits = random_segmentation(18, 1, 3), map = label_map(18, 16, kLarge);
  EXPECT_CONTAINS(
      refusal(bits.file(kRle, [&](const auto& frame) { return rle_frame(bits.bytes_of(frame), 1).substr(0, 66); })),
      "RLE pixels are cut off");
  EXPECT_CONTAINS(
      refusal(map.file(kJpeg2000Lossless,
                       [&](const auto& frame) { return coded(map, frame, kJpeg2000Lossless, 16).substr(0, 60); })),
      "cut off");
  SegmentationFixture few = map;
  few.change = [](Elements& data) { data.fragments({"xx"}); };
  EXPECT_CONTAINS(refusal(few.file(kRle)), "1 compressed pieces for 4 frames");
  EXPECT_CONTAINS(refusal(map.file(kRle)), "not stored as RLE Lossless, which it claims");
}

/// Numbers with gaps, as dcmqi keeps label ids, and frames of a segment that nothing describes.
TEST_F(DicomSegmentation, NumbersMayHaveGapsAndFramesMayBeNobodys) {
  SegmentationFixture fixture = random_segmentation(19, 2, 3);
  for (SegmentationFrame& frame : fixture.frames) frame.segment = frame.segment == 2 ? 90 : 1;
  SegmentationFixture named = fixture;
  named.numbers = {1, 90};
  const LabelMap map = read(named.file());
  ASSERT_EQ(map.segments.size(), 2U);
  const Segment& last = map.segments[0].number == 90 ? map.segments[0] : map.segments[1];
  EXPECT_EQ(last.name, "Organ 2");
  const LabelMap half = read(fixture.file());
  EXPECT_EQ(half.segments.size(), 1U);
  EXPECT_CONTAINS(half.notes.back(), "3 frames name no segment that the file describes") << half.notes.size();
}

TEST_F(DicomSegmentation, ASegmentThatAllFramesShareIsNamedOnce) {
  SegmentationFixture fixture = random_segmentation(20, 1, 3);
  const SegmentationFixture plain = fixture;
  for (SegmentationFrame& frame : fixture.frames) frame.segment = 0;
  fixture.shared_segment = 1;
  expect_holds(read(fixture.file()), plain);
}

TEST_F(DicomSegmentation, WhatIsCutOffOrTooLargeOrFlatIsRefused) {
  const SegmentationFixture whole = random_segmentation(9, 1, 4);
  const std::string bytes = whole.file();
  EXPECT_CONTAINS(refusal(bytes.substr(0, bytes.size() - 4)), "pixel data are cut off: 14 of 18 bytes");
  SegmentationFixture huge = whole;
  huge.change = [](Elements& data) { data.word(0x00280010, 60000).word(0x00280011, 60000); };
  EXPECT_CONTAINS(refusal(huge.file()), "more than an import may hold");
  SegmentationFixture flat = whole;
  flat.frames.resize(1);
  EXPECT_CONTAINS(refusal(flat.file()), "marks a single slice");
  SegmentationFixture empty = whole;
  for (SegmentationFrame& frame : empty.frames) std::fill(frame.values.begin(), frame.values.end(), 0);
  EXPECT_CONTAINS(refusal(empty.file()), "marks no voxel at all");
}

TEST_F(DicomSegmentation, FramesThatAreNoVolumeAreRefused) {
  const SegmentationFixture whole = random_segmentation(10, 1, 5);
  SegmentationFixture uneven = whole;
  for (SegmentationFrame& frame : uneven.frames)
    if (frame.position.z() > 106) frame.position.z() += 1;
  EXPECT_CONTAINS(refusal(uneven.file()), "not evenly spaced");
  SegmentationFixture beside = whole;
  beside.frames[2].position.x() += 10;
  EXPECT_CONTAINS(refusal(beside.file()), "lie beside each other");
  SegmentationFixture nowhere = whole;
  nowhere.change = [](Elements& data) { data.erase(0x52009229); };
  EXPECT_CONTAINS(refusal(nowhere.file()), "no usable ImageOrientationPatient");
  SegmentationFixture coded = whole;
  EXPECT_CONTAINS(refusal(coded.file("1.2.840.10008.1.2.4.201")),
                  "stored as High-Throughput JPEG 2000 (Lossless Only), which cannot be decoded here");
}

TEST_F(DicomSegmentation, OtherDicomIsRefused) {
  EXPECT_CONTAINS(refusal(stack_of(1, 1)[0].file()), "holds no series of a segmentation");
  EXPECT_CONTAINS(refusal("text"), "is not a DICOM file");
}

TEST_F(DicomSegmentation, AFolderWithItsImagesWillDo) {
  const SegmentationFixture fixture = random_segmentation(11, 1, 3);
  const auto slices = stack_of(3, 2.5);
  for (std::size_t n = 0; n < slices.size(); ++n) folder_.write("ct" + std::to_string(n), slices[n].file());
  folder_.write("seg", fixture.file());
  expect_holds(read_dicom_segmentation(folder_.path()), fixture);
}

/// As archives keep them: a file an organ, each with the slices that mark something.
TEST_F(DicomSegmentation, SeveralFilesOfASeriesAreOneMap) {
  SegmentationFixture first = random_segmentation(12, 2, 3), second = random_segmentation(13, 1, 4), empty = first;
  for (SegmentationFrame& frame : second.frames) frame.position.z() += 2 * 2.5;
  for (SegmentationFrame& frame : empty.frames) std::fill(frame.values.begin(), frame.values.end(), 0);
  second.labels = {"Spleen"};
  for (const auto& [name, file] : {std::pair("a", &first), {"b", &second}, {"c", &empty}})
    folder_.write(name, file->file());
  const LabelMap map = read_dicom_segmentation(folder_.path());
  ASSERT_EQ(map.segments.size(), 3U);
  for (const LabelVolume& layer : map.layers) EXPECT_EQ(layer.size, (std::array<int, 3>{7, 5, 8}));
  EXPECT_TRUE(has_note(map.notes, "c marks no voxel and was left out"));
  EXPECT_TRUE(has_note(map.notes, "3 segmentation files were taken together"));
  SegmentationFixture all = first;
  all.labels = {"Organ 1", "Organ 2", "Spleen"};
  for (SegmentationFrame frame : second.frames) frame.segment = 3, all.frames.push_back(frame);
  expect_holds(map, all);

  for (SegmentationFrame& frame : second.frames) frame.position.x() += 0.2;
  folder_.write("b", second.file());
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_segmentation(folder_.path()); }),
                  "b: lies on another grid than the segmentation files before it");
  folder_.write("a", empty.file()), folder_.write("b", empty.file());
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_segmentation(folder_.path()); }),
                  "its segmentations mark no voxel at all");
}

}  // namespace
}  // namespace trocar::test::dicom_segmentation_test
