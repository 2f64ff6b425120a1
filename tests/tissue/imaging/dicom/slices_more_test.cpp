// Headers of slices and their piles: places, stored bits, shear and order by closed forms, with refusals by element.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/dicom_folder.h"
#include "tissue/imaging/dicom/byte_source.h"
#include "tissue/imaging/dicom/dicom_instance.h"
#include "tissue/imaging/dicom/dicom_pixels.h"
#include "tissue/imaging/dicom/dicom_tags.h"
#include "tissue/imaging/dicom/inflate.h"
#include "tissue/imaging/dicom/packed_bytes.h"
#include "tissue/imaging/dicom/slice_stack.h"
#include "tissue/imaging/dicom/slice_volume.h"

namespace trocar::test::slices_more_test {
namespace {

struct Parsed {
  DicomFile file;
  std::uint64_t size = 0;
};

Parsed parsed(const TemporaryFolder& folder, const std::string& bytes) {
  InflateBudget budget;
  std::unique_ptr<ByteSource> source;
  auto file = read_dicom_elements(folder.write("file", bytes), "x.dcm", budget, &source);
  EXPECT_TRUE(file.has_value());
  return {file.value_or(DicomFile{}), source ? source->size() : 0};
}

Eigen::Matrix3d drawn_turn(std::mt19937_64& random) {
  std::normal_distribution<double> part;
  const double w = part(random), x = part(random), y = part(random), z = part(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

StackSlice slice_at(const Eigen::Matrix3d& turn, const Eigen::Vector3d& position, const std::string& name) {
  StackSlice slice;
  slice.place.position = position;
  slice.place.along_row = turn.col(0), slice.place.along_column = turn.col(1);
  slice.place.row_step = 0.8, slice.place.column_step = 0.6;
  slice.rows = 4, slice.columns = 5, slice.name = name;
  return slice;
}

/// In any pose of the patient and any order of files: order, step, shift and tilt of p_k = p_0 + k (h n + s).
TEST(SliceStackMore, ShearedPilesInAnyPoseAndOrderAreUnderstood) {
  std::mt19937_64 random(301);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int round = 0; round < 40; ++round) {
    const Eigen::Matrix3d turn = drawn_turn(random);
    const double step = 1.5 + part(random);
    const Eigen::Vector2d shift(0.5 + 0.4 * part(random), part(random));
    const Eigen::Vector3d first = 100 * Eigen::Vector3d(part(random), part(random), part(random));
    std::vector<int> places(11);
    for (int k = 0; k < 11; ++k) places[static_cast<std::size_t>(k)] = k;
    std::shuffle(places.begin(), places.end(), random);
    std::vector<StackSlice> slices;
    for (const int k : places)
      slices.push_back(
          slice_at(turn, first + k * (turn * Eigen::Vector3d(shift.x(), shift.y(), step)), "f" + std::to_string(k)));
    const SliceStack stack = stacked(slices, "in");
    for (int k = 0; k < 11; ++k) EXPECT_EQ(places[stack.order[static_cast<std::size_t>(k)]], k);
    EXPECT_NEAR(stack.slice_step, step, 1e-9);
    EXPECT_LT((stack.shift - shift).norm(), 1e-9);
    EXPECT_NEAR(std::tan(stack.tilt_deg * std::numbers::pi / 180), shift.norm() / step, 1e-9);
    EXPECT_LT((stack.origin - first).norm(), 1e-9);
    EXPECT_LT((stack.normal - turn.col(2)).norm(), 1e-12);
  }
}

TEST(SliceStackMore, EveryMissingInnerSliceIsNamedByItsNeighbours) {
  for (int missing = 1; missing < 8; ++missing) {
    std::vector<StackSlice> slices;
    for (int k = 0; k < 9; ++k)
      if (k != missing)
        slices.push_back(slice_at(Eigen::Matrix3d::Identity(), {0, 0, 2.5 * k}, "f" + std::to_string(k)));
    const std::string message = message_of<InputError>([&] { stacked(slices, "in"); });
    EXPECT_CONTAINS(message, "between f" + std::to_string(missing - 1) + " and f" + std::to_string(missing + 1) +
                                 " lies a gap of 5 mm where slices are 2.5 mm apart: 1 slice is missing");
  }
}

TEST(SliceStackMore, OneSliceAsideIsRefusedByName) {
  std::vector<StackSlice> slices;
  for (int k = 0; k < 7; ++k)
    slices.push_back(slice_at(Eigen::Matrix3d::Identity(), {0, 0, 2.0 * k}, "f" + std::to_string(k)));
  slices[4].place.position.x() += 3;
  EXPECT_CONTAINS(message_of<InputError>([&] { stacked(slices, "in"); }), "f4: lies 3 mm to the side");
  slices[4].place.position.x() -= 2.9;
  EXPECT_NO_THROW(stacked(slices, "in"));
}

/// Whatever the pose, an upright pile keeps every value at its place in the patient, in an array of RAS order.
TEST(SliceVolumeMore, UprightPilesInAnyPoseKeepEveryValueInItsPlace) {
  std::mt19937_64 random(302);
  for (int round = 0; round < 40; ++round) {
    const Eigen::Matrix3d turn = drawn_turn(random);
    std::vector<StackSlice> slices;
    for (int k = 0; k < 3; ++k) slices.push_back(slice_at(turn, Eigen::Vector3d(5, 6, 7) + 2 * k * turn.col(2), "f"));
    const SliceStack stack = stacked(slices, "in");
    SliceVolume volume(stack, -1, "in");
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<float> values;
      for (int n = 0; n < 20; ++n) values.push_back(static_cast<float>(100 * static_cast<int>(k) + n));
      volume.put(k, values);
    }
    const ImageVolume image = volume.take();
    std::set<float> seen(image.values.begin(), image.values.end());
    EXPECT_EQ(seen.size(), 60U);
    const Eigen::Matrix3d axes = image.index_to_ras_mm.linear();
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(axes(axis, axis), 0);
    for (int k = 0; k < 3; ++k)
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column) {
          const Eigen::Vector3d lps =
              slices[static_cast<std::size_t>(k)].place.position + turn * Eigen::Vector3d(0.8 * column, 0.6 * row, 0);
          ASSERT_EQ(value_at_lps(image, lps), static_cast<float>(100 * k + 5 * row + column));
        }
  }
}

/// Linear interpolation is exact for a field that is linear within the slice; the rest is the value of outside.
TEST(SliceVolumeMore, ShearsBothWaysKeepALinearField) {
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0.37, 0), Eigen::Vector2d(-0.37, 0.21), Eigen::Vector2d(0.5, -0.7)}) {
    const auto field = [](const Eigen::Vector3d& lps) { return 3 * lps.x() - 2 * lps.y() + 5 * lps.z() + 1; };
    std::vector<StackSlice> slices;
    for (int k = 0; k < 5; ++k)
      slices.push_back(slice_at(Eigen::Matrix3d::Identity(), k * Eigen::Vector3d(shift.x(), shift.y(), 1.5), "f"));
    const SliceStack stack = stacked(slices, "in");
    SliceVolume volume(stack, -999, "in");
    for (std::size_t k = 0; k < 5; ++k) {
      std::vector<float> values;
      for (int n = 0; n < 20; ++n)
        values.push_back(
            static_cast<float>(field(slices[k].place.position + Eigen::Vector3d(0.8 * (n % 5), 0.6 * (n / 5), 0))));
      volume.put(k, values);
    }
    const ImageVolume image = volume.take();
    int covered = 0;
    for (int k = 0; k < image.size[2]; ++k)
      for (int j = 0; j < image.size[1]; ++j)
        for (int i = 0; i < image.size[0]; ++i) {
          const float value = image.values[image.offset(i, j, k)];
          if (value == -999) continue;
          const Eigen::Vector3d ras = image.index_to_ras_mm * Eigen::Vector3d(i, j, k);
          ASSERT_NEAR(value, field({-ras.x(), -ras.y(), ras.z()}), 1e-4);
          ++covered;
        }
    EXPECT_EQ(covered, 20 + 4 * 4 * (shift.y() == 0 ? 4 : 3)) << "a slice loses a column or row only where it is moved";
  }
}

/// Stored bits anywhere within the word, the other bits full of noise.
TEST(UnpackedMore, StoredBitsAnywhereInTheWordComeBack) {
  std::mt19937_64 random(303);
  for (const int allocated : {8, 16, 32})
    for (int stored = 1; stored <= std::min(allocated, 24); ++stored)
      for (const bool is_signed : {false, true}) {
        const int high = stored - 1 + static_cast<int>(random() % static_cast<unsigned>(allocated - stored + 1));
        const std::int64_t range = std::int64_t{1} << stored, low = is_signed ? -range / 2 : 0;
        std::string bytes;
        std::vector<float> wanted;
        for (int n = 0; n < 16; ++n) {
          const std::int64_t value = low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(range));
          const int shift = high + 1 - stored;
          const std::uint64_t mask = (static_cast<std::uint64_t>(range) - 1) << shift;
          const std::uint64_t word = (random() & ~mask) | (static_cast<std::uint64_t>(value) << shift & mask);
          for (int byte = 0; byte < allocated / 8; ++byte) bytes += static_cast<char>(word >> 8 * byte & 0xFF);
          wanted.push_back(static_cast<float>(value));
        }
        EXPECT_EQ(unpacked(bytes, {allocated, stored, high, is_signed}), wanted) << allocated << " " << stored;
      }
}

TEST(SlicePlacesMore, PlacesComeBackAsWrittenWithUnitVectorsAtRightAngles) {
  const TemporaryFolder folder;
  std::mt19937_64 random(304);
  for (int round = 0; round < 15; ++round) {
    const Eigen::Matrix3d turn = drawn_turn(random);
    SliceFixture slice;
    slice.along_row = turn.col(0), slice.along_column = turn.col(1);
    slice.slope = 0.5 + round, slice.intercept = -3 * round;
    const auto places = slice_places(parsed(folder, slice.file()).file.data, 1, "x.dcm");
    ASSERT_EQ(places.size(), 1U);
    EXPECT_EQ(places[0].position, slice.position);
    EXPECT_LT((places[0].along_row - turn.col(0)).norm() + (places[0].along_column - turn.col(1)).norm(), 1e-4);
    EXPECT_NEAR(places[0].along_row.dot(places[0].along_column), 0, 1e-12);
    EXPECT_NEAR(places[0].along_column.norm(), 1, 1e-12);
    EXPECT_EQ(places[0].row_step, 0.5) << "PixelSpacing has the distance of rows first";
    EXPECT_EQ(places[0].column_step, 0.75);
    EXPECT_EQ(places[0].slope, slice.slope);
    EXPECT_EQ(places[0].intercept, slice.intercept);
  }
}

TEST(SlicePlacesMore, BoundsOfEveryNumberAreRefusedByFileAndElement) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::function<void(Elements&)>& change) {
    SliceFixture slice;
    slice.change = change;
    const Parsed one = parsed(folder, slice.file());
    const std::string message = instance_of(one.file, "p", "x.dcm", one.size).problem;
    EXPECT_TRUE(message.starts_with("x.dcm: ")) << message;
    return message;
  };
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00200032, {0, 0, 100001}); }), "more than 100 m away");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00200032, {0, 0}); }), "holds 2 numbers instead of 3");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00200037, {1, 0, 0, 0.1, 1, 0}); }), "at right angles");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00200037, {0, 0, 0, 0, 1, 0}); }), "unit vectors");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00280030, {0.5, 101}); }), "between 0.001 and 100 mm");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00280030, {0, 1}); }), "PixelSpacing");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.numbers(0x00281053, {0}); }), "RescaleSlope is 0");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.erase(0x00281052); }), "without the other");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.word(0x00280103, 2); }), "PixelRepresentation is neither 0 nor 1");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.word(0x00280101, 17); }), "do not fit into BitsAllocated");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.word(0x00280102, 16); }), "do not fit into BitsAllocated");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.word(0x00280100, 12); }), "BitsAllocated is 12");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.word(0x00280010, 8193); }), "more than 8192 along an edge");
  EXPECT_CONTAINS(refusal([](Elements& e) { e.word(0x00280010, 6); }), "60 of 72 bytes are there");
}

TEST(InstancesMore, ModalitiesAreOfAListAndKindsFollowTheClass) {
  const TemporaryFolder folder;
  const auto instance = [&](const std::string& modality, const std::string& sop_class) {
    SliceFixture slice;
    slice.modality = modality, slice.sop_class = sop_class;
    const Parsed one = parsed(folder, slice.file());
    return instance_of(one.file, "p", "x.dcm", one.size);
  };
  EXPECT_EQ(instance("Mr Smith", kCtClass).modality, "unknown");
  EXPECT_EQ(instance("MR", kMrClass).modality, "MR");
  EXPECT_EQ(instance("CT", kSegmentationClass).kind, DicomKind::kSegmentation);
  EXPECT_EQ(instance("CT", kStructureClass).kind, DicomKind::kStructureSet);
  EXPECT_EQ(instance("RTDOSE", kCtClass).kind, DicomKind::kOther);
  EXPECT_TRUE(instance("PT", kCtClass).image.has_value());
}

TEST(TransferSyntaxesMore, TheListIsConsistent) {
  const std::set<std::string> native{"", ".1", ".1.99", ".2"};
  std::set<std::string_view> names;
  for (const std::string tail :
       {"", ".1", ".1.99", ".2", ".5", ".4.50", ".4.51", ".4.57", ".4.70", ".4.80", ".4.81", ".4.90", ".4.91"}) {
    const TransferSyntax* syntax = transfer_syntax("1.2.840.10008.1.2" + tail);
    ASSERT_NE(syntax, nullptr) << tail;
    EXPECT_TRUE(names.insert(syntax->name).second) << tail;
    EXPECT_EQ(syntax->coding == PixelCoding::kNative, native.contains(tail)) << tail;
    EXPECT_FALSE(syntax->coding == PixelCoding::kCannot) << tail;
    EXPECT_EQ(syntax->deflated, tail == ".1.99");
    EXPECT_EQ(syntax->big_endian, tail == ".2");
  }
  EXPECT_FALSE(implicit_little_endian().explicit_vr);
  EXPECT_TRUE(explicit_little_endian().explicit_vr);
  for (const char* none :
       {"", "1.2.840.10008.1.2 ", "1.2.840.10008.1.2.", "1.2.840.10008.1.2.4", "1.2.840.10008.1.2.4.5"})
    EXPECT_EQ(transfer_syntax(none), nullptr) << none;
}

TEST(InflateMore, StreamsComeBackFromAnyPlaceAndCutsSaySo) {
  const TemporaryFolder folder;
  SliceFixture slice;
  slice.encoding = Encoding::kDeflated;
  const std::string whole = slice.file();
  slice.encoding = Encoding::kExplicit;
  const std::string plain = slice.elements().encoded(), head = slice.file();
  const std::size_t start = head.size() - plain.size() + 2;  // ".99" more, and a byte less to make it even
  ByteSource complete(whole, "m");
  InflateBudget full;
  const std::uint64_t before = full.left;
  const Inflated all = inflate_raw(complete, start, full);
  EXPECT_EQ(all.damage, "");
  EXPECT_EQ(all.bytes, plain);
  EXPECT_EQ(before - full.left, plain.size()) << "what came out is taken from the budget";
  for (std::size_t length = start; length + 1 < whole.size(); length += 7) {
    ByteSource source(whole.substr(0, length), "m");
    InflateBudget budget;
    const Inflated result = inflate_raw(source, start, budget);
    EXPECT_TRUE(plain.starts_with(result.bytes));
    EXPECT_CONTAINS(result.damage, "m: damaged DICOM: the deflated data are cut off");
  }
}

TEST(PackedBytesMore, EveryTypeComesBackAndEveryCutIsRefused) {
  PackedWriter writer;
  writer.put(std::int8_t{-3}), writer.put(std::uint16_t{60000}), writer.put(-1.5F), writer.put_text(""),
      writer.put_text("ab");
  writer.put(std::int64_t{-1} << 40);
  const std::string bytes = writer.take();
  const auto read = [](std::string_view from) {
    PackedReader reader(from, "x.dcm");
    EXPECT_EQ(reader.get<std::int8_t>(), -3);
    EXPECT_EQ(reader.get<std::uint16_t>(), 60000);
    EXPECT_EQ(reader.get<float>(), -1.5F);
    EXPECT_EQ(reader.get_text(), "");
    EXPECT_EQ(reader.get_text(), "ab");
    EXPECT_EQ(reader.get<std::int64_t>(), std::int64_t{-1} << 40);
  };
  EXPECT_NO_THROW(read(bytes));
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_CONTAINS(message_of<InputError>([&] { read(std::string_view(bytes).substr(0, length)); }),
                    "x.dcm: the reader gave no sensible answer");
}

}  // namespace
}  // namespace trocar::test::slices_more_test
