// Where slices lie: every voxel is found again in the patient, whatever order, orientation or tilt the files have.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "tests/tissue/imaging/dicom/dicom_folder.h"

namespace trocar::test::dicom_geometry_test {
namespace {

TEST(DicomGeometry, AxialStackLiesWhereItsPositionsSay) {
  const DicomFolder folder;
  const auto slices = stack_of(4, 2.5);
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  EXPECT_EQ(volume.size, (std::array<int, 3>{6, 5, 4}));
  EXPECT_EQ(volume.modality, "CT");
  EXPECT_TRUE(volume.notes.empty()) << volume.notes.front();
  expect_holds(volume, slices);
  const Eigen::Matrix3d expected = Eigen::Vector3d(0.5, 0.75, 2.5).asDiagonal();  // RAS order: positive steps
  EXPECT_LT((volume.index_to_ras_mm.linear() - expected).norm(), 1e-9);
}

TEST(DicomGeometry, TagsThatContradictThePositionsAreNotBelieved) {
  const DicomFolder folder;
  SliceFixture like;
  like.change = [](Elements& data) {
    data.text(0x00180050, "DS", "9.5").text(0x00180088, "DS", "7").text(0x00201041, "DS", "-500");
  };
  const auto slices = stack_of(3, 2, like);
  folder.write_all(slices);
  EXPECT_NEAR(folder.read().index_to_ras_mm.linear()(2, 2), 2, 1e-9);
}

TEST(DicomGeometry, FileNamesInAnyOrderGiveTheSameVolume) {
  const DicomFolder sorted, shuffled;
  auto slices = stack_of(7, 1.25);
  sorted.write_all(slices);
  std::shuffle(slices.begin(), slices.end(), std::mt19937(7));
  shuffled.write_all(slices);
  const ImageVolume a = sorted.read(), b = shuffled.read();
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.index_to_ras_mm.matrix(), b.index_to_ras_mm.matrix());
}

class DicomOrientation : public ::testing::TestWithParam<int> {};

/// All 48 ways to lay rows, columns and slices along the patient's axes, and oblique ones.
TEST_P(DicomOrientation, EveryVoxelIsFoundAgain) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  SliceFixture like;
  if (GetParam() < 24) {
    const int u = GetParam() % 3, v = (u + 1 + GetParam() / 3 % 2) % 3;
    like.along_row = Eigen::Vector3d::Unit(u) * (GetParam() / 6 % 2 == 0 ? 1 : -1);
    like.along_column = Eigen::Vector3d::Unit(v) * (GetParam() / 12 == 0 ? 1 : -1);
  } else {
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    like.along_row = turn * Eigen::Vector3d::UnitX(), like.along_column = turn * Eigen::Vector3d::UnitY();
  }
  const DicomFolder folder;
  const auto slices = stack_of(3, 3, like);
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  for (int axis = 0; axis < 3; ++axis) EXPECT_GT(volume.index_to_ras_mm.linear()(axis, axis), 0);
  for (const SliceFixture& slice : slices) {
    const Eigen::Vector3d lps = centre_of(slice, 2, 3);
    const Eigen::Vector3d index = volume.index_to_ras_mm.inverse() * Eigen::Vector3d(-lps.x(), -lps.y(), lps.z());
    const Eigen::Vector3i at = index.array().round().cast<int>();
    ASSERT_LT((index - at.cast<double>()).norm(), 1e-5);
    EXPECT_EQ(volume.values[volume.offset(at.x(), at.y(), at.z())], static_cast<float>(slice.value(2, 3) - 1024));
  }
}

INSTANTIATE_TEST_SUITE_P(All, DicomOrientation, ::testing::Range(0, 40));

/// A field that is linear in patient space, seen through a tilted pile, is the same field in the volume: linear
/// interpolation is exact.
TEST(DicomGeometry, TiltedGantryIsShearedBack) {
  const DicomFolder folder;
  const double tilt = 18.5 * std::numbers::pi / 180;
  SliceFixture like;
  like.columns = 12, like.rows = 20, like.row_step = like.column_step = 0.5, like.rescale = true, like.slope = 0.01,
  like.intercept = 0;
  like.along_column = Eigen::Vector3d(0, std::cos(tilt), -std::sin(tilt));
  const auto field = [](const Eigen::Vector3d& lps) { return 30 + 0.7 * lps.x() - 1.3 * lps.y() + 2.1 * lps.z(); };
  std::vector<SliceFixture> slices;
  for (int k = 0; k < 6; ++k) {
    SliceFixture slice = like;
    slice.position = Eigen::Vector3d(-3, -5, 10 + 2.5 * k);  // the table moves along z, not along the normal
    slice.value = [slice, field](int i, int j) {
      return static_cast<int>(std::lround(100 * field(centre_of(slice, i, j))));
    };
    slices.push_back(slice);
  }
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_CONTAINS(volume.notes[0], "18.50 degrees");
  const Eigen::Matrix3d axes = volume.index_to_ras_mm.linear().colwise().normalized();
  EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-9) << "the grid has right angles";
  EXPECT_NEAR(volume.index_to_ras_mm.linear().col(2).norm(), 2.5 * std::cos(tilt), 1e-9);
  int covered = 0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const float value = volume.values[volume.offset(i, j, k)];
        if (value == -1024) continue;  // no slice covers it
        const Eigen::Vector3d ras = volume.index_to_ras_mm * Eigen::Vector3d(i, j, k);
        ASSERT_NEAR(value, field({-ras.x(), -ras.y(), ras.z()}), 0.011) << "rounding of the stored values";
        ++covered;
      }
  EXPECT_GT(covered, 12 * 19 * 6 - 1);
}

TEST(DicomGeometry, ATiltTooSmallToMatterIsLeftAlone) {
  const DicomFolder folder;
  auto slices = stack_of(4, 2);
  for (std::size_t k = 0; k < slices.size(); ++k) slices[k].position.x() += 0.01 * static_cast<double>(k);
  folder.write_all(slices);
  EXPECT_TRUE(folder.read().notes.empty());
}

TEST(DicomGeometry, AMissingSliceIsRefusedWithItsGap) {
  const DicomFolder folder;
  auto slices = stack_of(6, 5);
  slices.erase(slices.begin() + 3);
  folder.write_all(slices);
  const std::string message = folder.refusal();
  EXPECT_CONTAINS(message, "a02 and ");
  EXPECT_CONTAINS(message, "a03");
  EXPECT_CONTAINS(message, "a gap of 10 mm where slices are 5 mm apart: 1 slice is missing");
}

TEST(DicomGeometry, SeveralMissingSlicesAreCounted) {
  const DicomFolder folder;
  auto slices = stack_of(9, 2);
  slices.erase(slices.begin() + 4, slices.begin() + 7);
  folder.write_all(slices);
  EXPECT_CONTAINS(folder.refusal(), "3 slices are missing");
}

TEST(DicomGeometry, OfThreeSlicesAGapIsStillAGap) {
  const DicomFolder folder;
  auto slices = stack_of(4, 1);
  slices.erase(slices.begin() + 1);
  folder.write_all(slices);
  EXPECT_CONTAINS(folder.refusal(), "a gap of 2 mm where slices are 1 mm apart");
}

TEST(DicomGeometry, TwoSlicesInOnePlaceAreRefusedByName) {
  const DicomFolder folder;
  auto slices = stack_of(4, 5);
  slices.push_back(slices[1]);
  folder.write_all(slices);
  const std::string message = folder.refusal();
  EXPECT_CONTAINS(message, "a01 and ");
  EXPECT_CONTAINS(message, "a04 lie in the same place");
}

TEST(DicomGeometry, EchoesPhasesAndAcquisitionsAreSeriesToChooseFrom) {
  for (const auto& [tag, name] :
       {std::pair(0x00180086U, "echo"), std::pair(0x00200100U, "phase"), std::pair(0x00200012U, "acquisition")}) {
    const DicomFolder folder;
    std::vector<SliceFixture> slices;
    for (const int pass : {2, 10})
      for (SliceFixture& slice : stack_of(4, 5)) {
        slice.value = [pass](int, int) { return pass; };
        slice.change = [pass, tag = tag](Elements& data) { data.text(tag, "IS", std::to_string(pass)); };
        slices.push_back(slice);
      }
    folder.write_all(slices);
    const auto series = list_dicom(folder.path());
    ASSERT_EQ(series.size(), 2U) << name;
    EXPECT_EQ(series[0].part, std::string(name) + " 1 of 2");
    EXPECT_CONTAINS(folder.refusal(), "choose one with --series N");
    EXPECT_EQ(read_dicom_series(folder.path(), 1).values.front(), 2 - 1024) << "2 comes before 10";
    EXPECT_EQ(read_dicom_series(folder.path(), 2).values.front(), 10 - 1024);
  }
}

TEST(DicomGeometry, ImagesThatNameNoSeriesAreOneAndSaySo) {
  const DicomFolder folder;
  SliceFixture like;
  like.series = "", like.study = "";
  folder.write_all(stack_of(4, 5, like));
  ASSERT_EQ(list_dicom(folder.path()).size(), 1U);
  const ImageVolume image = read_dicom_series(folder.path());
  EXPECT_EQ(image.size[2], 4);
  EXPECT_CONTAINS(image.notes.at(0), "4 images name no series");
}

TEST(DicomGeometry, OtherOrientationSizeSpacingAndFrameOfReferenceAreRefusedByName) {
  const std::vector<std::pair<std::function<void(SliceFixture&)>, std::string>> cases{
      {[](SliceFixture& s) { s.along_row = Eigen::Vector3d(0, 1, 0), s.along_column = Eigen::Vector3d(0, 0, -1); },
       "different orientations"},
      {[](SliceFixture& s) { s.rows = 7; }, "different sizes (6 x 5 and 6 x 7 pixels)"},
      {[](SliceFixture& s) { s.row_step = 0.6; }, "different pixel spacings"},
      {[](SliceFixture& s) { s.change = [](Elements& data) { data.text(0x00200052, "UI", "1.2.77"); }; },
       "different frames of reference"},
      {[](SliceFixture& s) { s.position.x() += 4; }, "to the side"},
      {[](SliceFixture& s) { s.position.z() += 0.8; }, "unevenly spaced"},
      {[](SliceFixture& s) { s.rescale = false; }, "only one of them has RescaleSlope"},
  };
  for (const auto& [change, expected] : cases) {
    const DicomFolder folder;
    auto slices = stack_of(5, 2);
    change(slices[2]);
    folder.write_all(slices, expected.substr(0, 4) == "diff" ? "a" : "b");
    const std::string message = folder.refusal();
    EXPECT_CONTAINS(message, expected);
    EXPECT_CONTAINS(message, "02");
  }
}

TEST(DicomGeometry, RoundedPositionsAreTakenAsEven) {
  const DicomFolder folder;
  auto slices = stack_of(9, 0.3125);
  for (SliceFixture& slice : slices) slice.position.z() = std::round(slice.position.z() * 100) / 100;
  folder.write_all(slices);
  const ImageVolume volume = folder.read();
  EXPECT_NEAR(volume.index_to_ras_mm.linear()(2, 2), 0.3125, 1e-9);
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_CONTAINS(volume.notes[0], "off an even step of 0.312 mm");
}

TEST(DicomGeometry, ASingleSliceIsNoVolume) {
  const DicomFolder folder;
  const auto file = folder.write("one", SliceFixture{}.file());
  const std::string message = message_of<InputError>([&] { read_dicom_series(file); });
  EXPECT_CONTAINS(message, "is a single image of 6 x 5 pixels: a volume needs two slices at least");
}

TEST(DicomGeometry, EnhancedFramesAreSlices) {
  const DicomFolder folder;
  auto slices = stack_of(5, 1.5);
  for (std::size_t k = 0; k < slices.size(); ++k) slices[k].slope = 1 + 0.5 * static_cast<double>(k);
  std::swap(slices[1], slices[3]);  // frames in any order
  const auto file = folder.write("multi.dcm", dicom_file(enhanced(slices)));
  const ImageVolume volume = read_dicom_series(file);
  EXPECT_EQ(volume.size[2], 5);
  expect_holds(volume, slices);
  ASSERT_EQ(volume.notes.size(), 1U);
  EXPECT_CONTAINS(volume.notes[0], "differ between slices; each slice got its own");
}

TEST(DicomGeometry, EnhancedFilesInEveryEncoding) {
  for (const Encoding encoding : {Encoding::kImplicit, Encoding::kBigEndian, Encoding::kDeflated}) {
    const DicomFolder folder;
    SliceFixture like;
    like.encoding = encoding;
    const auto slices = stack_of(3, 1.5, like);
    expect_holds(read_dicom_series(folder.write("multi.dcm", dicom_file(enhanced(slices)))), slices);
  }
}

TEST(DicomGeometry, EnhancedFilesWithWrongCountsOrDoublePlacesAreRefused) {
  const DicomFolder folder;
  auto slices = stack_of(4, 1.5);
  Elements wrong = enhanced(slices);
  wrong.text(0x00280008, "IS", "3");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.write("a", dicom_file(wrong))); }),
                  "3 frames but describes 4");
  slices[3].position = slices[0].position;
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.write("b", dicom_file(enhanced(slices)))); }),
                  "b frame 1 and " + folder.path().string() + "/b frame 4 lie in the same place");
  Elements old = stack_of(1, 1)[0].elements();
  old.text(0x00280008, "IS", "2").bytes(0x7FE00010, "OW", std::string(120, '\0'));
  EXPECT_CONTAINS(message_of<InputError>([&] { read_dicom_series(folder.write("c", dicom_file(old))); }),
                  "older multi-frame kind");
}

TEST(DicomGeometry, UnusablePlacesAreRefusedByElement) {
  const std::vector<std::pair<std::function<void(Elements&)>, std::string>> cases{
      {[](Elements& data) { data.erase(0x00200032); }, "no usable ImagePositionPatient"},
      {[](Elements& data) { data.text(0x00200032, "DS", "1\\2\\abc"); }, "no usable ImagePositionPatient"},
      {[](Elements& data) { data.text(0x00200032, "DS", "1\\2\\nan"); }, "no usable ImagePositionPatient"},
      {[](Elements& data) { data.text(0x00200032, "DS", "1\\2\\1e30"); }, "more than 100 m away"},
      {[](Elements& data) {
         data.numbers(0x00200032, {1, 2});
       },
       "holds 2 numbers instead of 3"},
      {[](Elements& data) {
         data.numbers(0x00200037, {1, 0, 0, 0.5, 0.5, 0});
       },
       "not two unit vectors at right angles"},
      {[](Elements& data) { data.erase(0x00200037); }, "no usable ImageOrientationPatient"},
      {[](Elements& data) {
         data.numbers(0x00280030, {0, 1});
       },
       "PixelSpacing is not between"},
      {[](Elements& data) {
         data.numbers(0x00280030, {1, -1});
       },
       "PixelSpacing is not between"},
      {[](Elements& data) { data.text(0x00281053, "DS", "0"); }, "RescaleSlope is 0"},
      {[](Elements& data) { data.erase(0x00281052); }, "one of RescaleSlope and RescaleIntercept without the other"},
  };
  for (const auto& [change, expected] : cases) {
    const DicomFolder folder;
    auto slices = stack_of(3, 2);
    slices[1].change = change;
    folder.write_all(slices);
    const std::string message = folder.refusal();
    EXPECT_CONTAINS(message, expected);
    EXPECT_CONTAINS(message, "a01");
  }
}

}  // namespace
}  // namespace trocar::test::dicom_geometry_test
