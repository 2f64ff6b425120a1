// DICOM segmentations: every marked pixel comes back at its place in the patient, under its segment's name.
#include <gtest/gtest.h>

#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"

namespace trocar::test::dicom_segmentation_test {
namespace {

SegmentationFixture random_segmentation(unsigned seed, int segments, int slices, int maximum = 0) {
  std::mt19937 random(seed);
  SegmentationFixture fixture;
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
  EXPECT_EQ(map.layers[0].size, (std::array<int, 3>{7, 5, 6}));
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
  EXPECT_EQ(map.layers[0].size[2], 8);
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

TEST_F(DicomSegmentation, RleAndDeflatedAreRead) {
  SegmentationFixture fixture = random_segmentation(8, 1, 3, 255);
  const SegmentationFixture plain = fixture;
  fixture.change = [&](Elements& data) {
    std::vector<std::string> pieces;
    for (const SegmentationFrame& frame : fixture.frames) {
      std::string bytes;
      for (const int value : frame.values) bytes += static_cast<char>(value);
      pieces.push_back(rle_frame(bytes, 1));
    }
    data.fragments(pieces);
  };
  expect_holds(read(fixture.file(kRle)), plain);
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
  EXPECT_CONTAINS(refusal(coded.file("1.2.840.10008.1.2.4.90")), "stored as JPEG 2000 (Lossless Only)");
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
  folder_.write("seg2", fixture.file());
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_segmentation(folder_.path()); }),
                  "holds 2 segmentation files");
}

}  // namespace
}  // namespace trocar::test::dicom_segmentation_test
