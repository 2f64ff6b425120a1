// The parts below the readers: elements, numbers, tables, planes, packed bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/dicom_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/dicom_elements.h"
#include "tissue/imaging/dicom/dicom_tags.h"
#include "tissue/imaging/dicom/even_planes.h"
#include "tissue/imaging/dicom/packed_bytes.h"
#include "tissue/imaging/dicom/segment_layers.h"

namespace trocar::test::dicom_parts_test {
namespace {

DicomFile parsed(const TemporaryFolder& folder, const std::string& bytes) {
  InflateBudget budget;
  const auto file = read_dicom_elements(folder.write("file", bytes), "file", budget);
  EXPECT_TRUE(file.has_value());
  return file.value_or(DicomFile{});
}

TEST(DicomElements, ValuesComeTheSameInEveryEncoding) {
  const TemporaryFolder folder;
  for (const Encoding encoding :
       {Encoding::kExplicit, Encoding::kImplicit, Encoding::kBigEndian, Encoding::kDeflated}) {
    SliceFixture slice;
    slice.encoding = encoding;
    const DicomFile file = parsed(folder, slice.file());
    EXPECT_EQ(file.damage, "");
    EXPECT_EQ(file.data.text(tag::kModality), "CT");
    EXPECT_EQ(file.data.whole(tag::kRows), 5U);
    EXPECT_EQ(file.data.decimals(tag::kPosition), (std::vector<double>{-10, -20, 30}));
    EXPECT_EQ(file.pixels.length, 60U);
    EXPECT_TRUE(file.pixels.present && !file.pixels.encapsulated);
    EXPECT_EQ(file.syntax->big_endian, encoding == Encoding::kBigEndian);
  }
}

TEST(DicomElements, OnlyListedElementsAreKept) {
  const TemporaryFolder folder;
  SliceFixture slice;
  slice.change = [](Elements& data) {
    data.text(0x00100010, "PN", "A^B").text(0x00100020, "LO", "1").text(0x00081030, "LO", "text");
  };
  const std::set<DicomTag> allowed{tag::kTransferSyntax,
                                   tag::kImageType,
                                   tag::kSopClass,
                                   tag::kSopInstance,
                                   tag::kModality,
                                   tag::kStudy,
                                   tag::kSeries,
                                   tag::kSeriesNumber,
                                   tag::kPosition,
                                   tag::kOrientation,
                                   tag::kFrameOfReference,
                                   tag::kSamples,
                                   tag::kPhotometric,
                                   tag::kRows,
                                   tag::kColumns,
                                   tag::kPixelSpacing,
                                   tag::kBitsAllocated,
                                   tag::kBitsStored,
                                   tag::kHighBit,
                                   tag::kPixelRepresentation,
                                   tag::kIntercept,
                                   tag::kSlope,
                                   tag::kEcho,
                                   tag::kAcquisition};
  for (const auto& [tag, element] : parsed(folder, slice.file()).data.elements)
    EXPECT_TRUE(allowed.contains(tag)) << std::hex << tag;
}

TEST(DicomElements, DecimalsAreNumbersOrNothing) {
  const auto read = [](const std::string& text) {
    DicomItem item;
    item.elements[tag::kSlope] = {text, {}};
    return item.decimals(tag::kSlope);
  };
  EXPECT_EQ(read("1.5"), (std::vector<double>{1.5}));
  EXPECT_EQ(read(" +1e-3 \\ -7\\0"), (std::vector<double>{0.001, -7, 0}));
  for (const char* bad :
       {"", "abc", "1\\", "1,5", "0x10", "inf", "nan", "1e999", "1 2", "--1", "+-1", "-+1", "++1", "+"})
    EXPECT_FALSE(read(bad).has_value()) << bad;
}

TEST(DicomElements, EveryTruncationIsDamageOrCutPixels) {
  const TemporaryFolder folder;
  const std::string whole = SliceFixture{}.file();
  for (std::size_t length = 140; length < whole.size(); ++length) {
    const DicomFile file = parsed(folder, whole.substr(0, length));
    const bool at_an_end =
        file.damage.empty() && !file.pixels.present;  // between two elements nothing is visibly missing
    const bool cut_pixels = file.pixels.present && file.pixels.offset + file.pixels.length > length;
    EXPECT_TRUE(!file.damage.empty() || cut_pixels || at_an_end) << length;
  }
}

TEST(DicomElements, UnknownRepresentationsAreDamage) {
  const TemporaryFolder folder;
  std::string bytes = SliceFixture{}.file();
  const std::size_t at = bytes.find("CS", 160);
  bytes.replace(at, 2, "zz");
  EXPECT_CONTAINS(parsed(folder, bytes).damage, "no valid value representation at element (0008,0008)");
}

TEST(DicomElements, FilesWithoutSignatureAreRecognisedByTheirFirstElement) {
  const TemporaryFolder folder;
  InflateBudget budget;
  const auto file = read_dicom_elements(folder.write("bare", SliceFixture{}.elements().encoded()), "bare", budget);
  ASSERT_TRUE(file.has_value());
  EXPECT_FALSE(file->has_header);
  EXPECT_EQ(file->data.text(tag::kModality), "CT");
  EXPECT_FALSE(read_dicom_elements(folder.write("text", "Dear colleague, thank you for the referral."), "text", budget)
                   .has_value());
}

TEST(DicomElements, InflatingStopsAtTheBudget) {
  const TemporaryFolder folder;
  SliceFixture slice;
  slice.encoding = Encoding::kDeflated;
  slice.change = [](Elements& data) { data.bytes(0x00091010, "OB", std::string(300000, '\0')); };
  InflateBudget budget;
  budget.left = 100000;
  const auto file = read_dicom_elements(folder.write("bomb", slice.file()), "bomb", budget);
  ASSERT_TRUE(file.has_value());
  EXPECT_CONTAINS(file->damage, "the limit");
  EXPECT_EQ(budget.left, 0U);
}

TEST(TransferSyntaxes, NamesAndWhatCanBeDecoded) {
  EXPECT_EQ(transfer_syntax("1.2.840.10008.1.2.4.90")->name, "JPEG 2000 (Lossless Only)");
  EXPECT_EQ(transfer_syntax("1.2.840.10008.1.2.4.50")->coding, PixelCoding::kJpeg);
  EXPECT_TRUE(transfer_syntax("1.2.840.10008.1.2.4.50")->lossy);
  EXPECT_FALSE(transfer_syntax("1.2.840.10008.1.2.4.70")->lossy);
  EXPECT_EQ(transfer_syntax("1.2.840.10008.1.2.4.202")->coding, PixelCoding::kCannot);
  EXPECT_TRUE(transfer_syntax("1.2.840.10008.1.2.2")->big_endian);
  EXPECT_FALSE(transfer_syntax("1.2.840.10008.1.2")->explicit_vr);
  EXPECT_EQ(transfer_syntax("1.2.840.10008"), nullptr);
}

TEST(EvenPlanes, HeightsAreSlicesOfOneStep) {
  const EvenPlanes planes = even_planes({10, 4, 6, 16, 6}, "frames", "f");
  EXPECT_DOUBLE_EQ(planes.step, 2);
  EXPECT_DOUBLE_EQ(planes.first, 4);
  EXPECT_EQ(planes.count, 7);
  EXPECT_EQ(planes.slice, (std::vector<int>{3, 0, 1, 6, 1}));
  EXPECT_EQ(even_planes({7, 7}, "frames", "f").step, 0);
  EXPECT_CONTAINS(message_of<InputError>([] { even_planes({0, 1, 2.4, 3}, "frames", "f"); }), "not evenly spaced");
  EXPECT_CONTAINS(message_of<InputError>([] {
                    even_planes({0, 0.02, 1000}, "frames", "f");
                  }),
                  "span more than 20000 slices");
}

/// Positions rounded to 0.01 mm: the smallest distance alone would count a slice too many.
TEST(EvenPlanes, RoundedHeightsOfALongPile) {
  std::vector<double> heights;
  for (int k = 0; k < 400; ++k) heights.push_back(std::round(0.6251 * k * 100) / 100);
  const EvenPlanes planes = even_planes(heights, "frames", "f");
  EXPECT_EQ(planes.count, 400);
  EXPECT_NEAR(planes.step, 0.6251, 1e-4);
}

TEST(PackedBytes, ComeBackAndAreChecked) {
  PackedWriter out;
  out.put(std::uint64_t{3});
  out.put(2.5);
  out.put_text("name");
  const std::string bytes = out.take();
  PackedReader in(bytes, "f");
  EXPECT_EQ(in.get<std::uint64_t>(), 3U);
  EXPECT_EQ(in.get<double>(), 2.5);
  EXPECT_EQ(in.get_text(), "name");
  EXPECT_THROW(in.get<char>(), InputError);
  PackedReader again(bytes, "f");
  EXPECT_THROW(again.get_count(100), InputError) << "three things of 100 bytes cannot be there";
  const std::string tail = bytes.substr(8);  // its first number is no length
  PackedReader text(tail, "f");
  EXPECT_CONTAINS(message_of<InputError>([&] { text.get_text(); }), "f: the reader gave no sensible answer");
}

TEST(SegmentLayers, TheFirstFreeLayerIsTaken) {
  const std::array<int, 3> size{2, 2, 3};
  SegmentLayers layers(size, Eigen::Affine3d::Identity(), "f");
  const auto mask = [&](const std::vector<std::size_t>& voxels) {
    SegmentMask one(size);
    for (const std::size_t n : voxels) one.voxels[n] = true, one.mark_slice(static_cast<int>(n / 4));
    return one;
  };
  layers.add({0, 1, "a"}, mask({0, 1}));
  layers.add({0, 2, "b"}, mask({1, 5}));
  layers.add({0, 3, "c"}, mask({2, 11}));
  layers.add({0, 4, "d"}, mask({0, 8}));
  layers.add({0, 5, "e"}, mask({}));
  const LabelMap map = layers.take();
  ASSERT_EQ(map.layers.size(), 2U);
  ASSERT_EQ(map.segments.size(), 4U);
  EXPECT_EQ(map.segments[1].name, "c");
  EXPECT_EQ(map.layers[0].labels, (std::vector<std::uint16_t>{1, 1, 3, 0, 0, 0, 0, 0, 0, 0, 0, 3}));
  EXPECT_EQ(map.layers[1].labels, (std::vector<std::uint16_t>{4, 2, 0, 0, 0, 2, 0, 0, 4, 0, 0, 0}));
}

}  // namespace
}  // namespace trocar::test::dicom_parts_test
