#include "tissue/imaging/volumes/meta_image_header.h"

#include "tests/tissue/imaging/volumes/volume_files.h"

namespace trocar::meta_image_test {
namespace {

using test::frame_of;
using test::packed;
using test::told_indices;

const std::string kStart = "ObjectType = Image\nNDims = 3\nDimSize = 4 3 2\n";
const std::string kPlace = "ElementSpacing = 2 3 4\nOffset = -10 20 30\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n";

std::string plain_file(const std::string& place = kPlace) {
  return kStart + place + "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" + packed<std::int16_t>(told_indices());
}

/// LPS of the format, RAS of ours.
Eigen::Affine3d expected(const Eigen::Matrix3d& directions = Eigen::Matrix3d::Identity()) {
  const Eigen::Vector3d signs(-1, -1, 1);
  return frame_of(signs.asDiagonal() * directions * Eigen::Vector3d(2, 3, 4).asDiagonal(), {10, -20, 30});
}

TEST(MetaImage, StoresInTheImageOrBesideIt) {
  test::TemporaryFolder folder;
  const auto check = [&](const std::string& name, const std::string& bytes) {
    const ImageVolume image = read_image_volume(folder.write(name, bytes));
    test::expect_told_indices(image, expected());
    return image.notes;
  };
  const auto rest = [&](const std::string& more, const std::string& file = "LOCAL") {
    return kStart + kPlace + more + "ElementDataFile = " + file + "\n";
  };
  const std::vector<double> values = told_indices();
  EXPECT_TRUE(check("a.mha", plain_file()).empty());
  check("a.mha",
        rest("ElementType = MET_USHORT\nBinaryDataByteOrderMSB = True\n") + packed<std::uint16_t>(values, true));
  check("a.mha", rest("ElementType = MET_DOUBLE\nElementByteOrderMSB = True\n") + packed<double>(values, true));
  check("a.mha", rest("ElementType = MET_UCHAR\nisPerpective = 0\n") + packed<std::uint8_t>(values));
  const std::string zlib = test::zlib_packed(packed<float>(values));
  check("a.mha", rest("ElementType = MET_FLOAT\nCompressedData = True\nCompressedDataSize = " +
                      std::to_string(zlib.size()) + "\n") +
                     zlib);
  std::string text;
  for (const double value : values) text += std::to_string(value) + " ";
  check("a.mha", rest("ElementType = MET_INT\nBinaryData = False\n") + text);
  folder.write("voxels.raw", "old header" + packed<std::int32_t>(values));
  check("a.mhd", rest("ElementType = MET_INT\nHeaderSize = 10\n", "voxels.raw"));
  check("a.mhd", rest("ElementType = MET_INT\nHeaderSize = -1\n", "voxels.raw"));
  folder.write("voxels.zraw", zlib);
  check("a.mhd", rest("ElementType = MET_FLOAT\nCompressedData = True\n", "voxels.zraw"));
}

// The matrix lists the axes one after the other: its first three numbers are the direction of i.
TEST(MetaImage, TransformMatrixHoldsOneAxisAfterTheOther) {
  test::TemporaryFolder folder;
  Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::ostringstream text;
  text.precision(17);
  text << "ElementSpacing = 2 3 4\nPosition = -10 20 30\nTransformMatrix =";
  for (int axis = 0; axis < 3; ++axis)
    for (int row = 0; row < 3; ++row) text << " " << turn(row, axis);
  text << "\n";
  test::expect_told_indices(read_image_volume(folder.write("a.mha", plain_file(text.str()))), expected(turn));
}

TEST(MetaImage, LettersStandInForAMissingMatrix) {
  test::TemporaryFolder folder;
  const std::string place = "ElementSpacing = 2 3 4\nOffset = -10 20 30\n";
  const ImageVolume lps = read_image_volume(folder.write("a.mha", plain_file(place)));
  test::expect_told_indices(lps, expected());
  EXPECT_TRUE(test::has_note(lps.notes, "LPS"));
  const ImageVolume same =
      read_image_volume(folder.write("a.mha", plain_file(place + "AnatomicalOrientation = RAI\n")));
  test::expect_told_indices(same, expected());
  const ImageVolume turned =
      read_image_volume(folder.write("a.mha", plain_file(place + "AnatomicalOrientation = LPS\n")));
  test::expect_told_indices(turned, expected(-Eigen::Matrix3d::Identity()));
  const ImageVolume torn =
      read_image_volume(folder.write("a.mha", plain_file(kPlace + "AnatomicalOrientation = LPS\n")));
  test::expect_told_indices(torn, expected());
  EXPECT_TRUE(test::has_note(torn.notes, "contradict"));
}

TEST(MetaImage, ScaleAndModalityAreTold) {
  test::TemporaryFolder folder;
  const ImageVolume image = read_image_volume(folder.write(
      "a.mha",
      plain_file(
          kPlace +
          "Modality = MET_MOD_CT\nElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1000\n")));
  EXPECT_EQ(image.modality, "CT");
  EXPECT_EQ(test::value_at(image, {10, -20, 30}), -1000);
  EXPECT_EQ(test::value_at(image, {8, -20, 30}), -998);
  EXPECT_TRUE(test::has_note(image.notes, "ElementToIntensityFunction"));
  const auto centre = plain_file(kPlace + "CenterOfRotation = 1 2 3\n");
  EXPECT_TRUE(test::has_note(read_image_volume(folder.write("b.mha", centre)).notes, "CenterOfRotation"));
}

TEST(MetaImage, LengthsThatAreNoMillimetresNeedAUnit) {
  test::TemporaryFolder folder;
  const auto path =
      folder.write("a.mha", plain_file("ElementSpacing = 0.002 0.003 0.004\nOffset = -0.010 0.020 0.030\n"));
  EXPECT_CONTAINS(test::map_refusal(folder.write("n.mha", plain_file("ElementSpacing = -2 3 4\nOffset = 0 0 0\n"))),
                  "directions belong into TransformMatrix");
  EXPECT_CONTAINS(
      test::map_refusal(folder.write("u.mha", plain_file("ElementSpacing = 2000 3000 4000\nOffset = 0 0 0\n"))),
      "um makes it ");
  const std::string message = test::image_refusal(path);
  EXPECT_CONTAINS(message, "voxel size 0.002 mm");
  EXPECT_CONTAINS(message, "m makes it 9 mm long");
  test::expect_told_indices(read_image_volume(path, {}, {.unit = "m", .space = ""}), expected());
}

struct Wrong {
  const char* from;
  const char* to;
  const char* message;
};

class WrongMetaImage : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongMetaImage, IsRefusedByName) {
  test::TemporaryFolder folder;
  std::string bytes = plain_file();
  const auto place = bytes.find(GetParam().from);
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, std::strlen(GetParam().from), GetParam().to);
  const std::string message = test::image_refusal(folder.write("a.mha", bytes));
  EXPECT_CONTAINS(message, "a.mha");
  EXPECT_CONTAINS(message, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Headers, WrongMetaImage,
    ::testing::Values(
        Wrong{"ObjectType = Image", "ObjectType = Tube", "ObjectType"}, Wrong{"NDims = 3", "NDims = 4", "4 dimensions"},
        Wrong{"DimSize = 4 3 2", "DimSize = 4 3", "3 numbers"}, Wrong{"DimSize = 4 3 2", "DimSize = 4 3 -2", "DimSize"},
        Wrong{"DimSize = 4 3 2", "DimSize = 9e4 9e4 9e4", "more than"},
        Wrong{"DimSize = 4 3 2", "DimSize = 4 3 2 1", "3 numbers"},
        Wrong{"DimSize = 4 3 2", "DimSize = 40 30 20", "the file ends after"},
        Wrong{"DimSize = 4 3 2", "DimSize = 4 3 2\nDimSize = 4 3 2", "given before"},
        Wrong{"ElementSpacing = 2 3 4", "ElementSpacing = 2 3 0", "voxel size 0"},
        Wrong{"ElementSpacing = 2 3 4", "ElementSpacing = 2 3 nan", "not finite"},
        Wrong{"ElementSpacing = 2 3 4\n", "", "how large is a voxel"},
        Wrong{"1 0 0 0 1 0 0 0 1", "1 0 0 1 0 0 0 0 1", "one plane"},
        Wrong{"1 0 0 0 1 0 0 0 1", "1 0 0 0 1 0 0 0 3", "length 1"},
        Wrong{"1 0 0 0 1 0 0 0 1", "1 0 0 0 1 0", "9 numbers"},
        Wrong{"MET_SHORT", "MET_LONG", "depends on the machine"}, Wrong{"MET_SHORT", "MET_STRING", "no number type"},
        Wrong{"MET_SHORT", "MET_SHORT\nHeaderSize = -7", "HeaderSize"},
        Wrong{"MET_SHORT", "MET_SHORT\nElementNumberOfChannels = 3", "3 values a voxel"},
        Wrong{"MET_SHORT", "MET_SHORT\nCompressedData = Maybe", "neither True nor False"},
        Wrong{"MET_SHORT", "MET_SHORT\nCompressedData = True", "damaged gzip"},
        Wrong{"= LOCAL", "= /etc/passwd", "own folder"}, Wrong{"= LOCAL", "= ../up.raw", "own folder"},
        Wrong{"= LOCAL", "= LIST 3", "several files"}, Wrong{"= LOCAL", "= s%03d.raw 1 2 1", "several files"},
        Wrong{"= LOCAL", "= gone.raw", "not beside the header"},
        Wrong{"ElementDataFile = LOCAL", "Comment = none", "a.mha"}));

TEST(MetaImage, ColoursAreNoImage) {
  test::TemporaryFolder folder;
  const std::string bytes = kStart + kPlace +
                            "ElementType = MET_UCHAR\nElementNumberOfChannels = 3\nElementDataFile = LOCAL\n" +
                            std::string(72, '\1');
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.mha", bytes)), "3 values a voxel");
  EXPECT_CONTAINS(test::map_refusal(folder.path() / "a.mha"), "no label map");
}

}  // namespace
}  // namespace trocar::meta_image_test
