// NIfTI as images and label maps: version 2, pairs, every number type, odd values, sheared axes, big volumes.
#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/volumes/gzip_stream.h"
#include "tissue/imaging/volumes/nifti_header.h"
#include "tissue/imaging/volumes/volume_assembly.h"

namespace trocar::nifti_volume_test {
namespace {

using test::NiftiFixture;

template <typename T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// NIfTI-2 of 4 x 3 x 2 voxels of int16 that tell their index; places of the fields as in nifti2.h.
std::string nifti2(const Eigen::Affine3d& frame) {
  std::string bytes(544, '\0');
  put<std::int32_t>(bytes, 0, 540);
  std::memcpy(bytes.data() + 4, "n+2\0\r\n\x1a\n", 8);
  put<std::int16_t>(bytes, 12, 4);
  put<std::int16_t>(bytes, 14, 16);
  const std::int64_t dim[8] = {3, 4, 3, 2, 1, 1, 1, 1};
  std::memcpy(bytes.data() + 16, dim, sizeof dim);
  for (std::size_t n = 0; n < 3; ++n) put(bytes, 112 + 8 * n, frame.linear().col(static_cast<int>(n)).norm());
  put<std::int64_t>(bytes, 168, 544);
  put<std::int32_t>(bytes, 348, 1);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      put(bytes, 400 + static_cast<std::size_t>(32 * row + 8 * column), frame.matrix()(row, column));
  put<std::int32_t>(bytes, 500, 2);
  return bytes + test::packed<std::int16_t>(test::told_indices());
}

Eigen::Affine3d oblique() {
  return test::frame_of(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix() *
                            Eigen::Vector3d(-2, 1.5, 3).asDiagonal(),
                        {-40, 12, 100});
}

TEST(Nifti2, IsReadWithItsDoubles) {
  test::TemporaryFolder folder;
  const std::string bytes = nifti2(oblique());
  test::expect_told_indices(read_image_volume(folder.write("a.nii", bytes)), oblique());
  test::expect_told_indices(read_image_volume(folder.write("a.nii.gz", gzip_compressed(bytes))), oblique());
  EXPECT_EQ(read_nifti_header(folder.path() / "a.nii").version, 2);
}

TEST(Nifti2, WrongFieldsAreRefusedByName) {
  test::TemporaryFolder folder;
  const auto refused = [&](const auto& spoil) {
    std::string bytes = nifti2(oblique());
    spoil(bytes);
    return test::image_refusal(folder.write("a.nii", bytes));
  };
  EXPECT_CONTAINS(refused([](std::string& b) { b[4] = 'x'; }), "magic");
  EXPECT_CONTAINS(refused([](std::string& b) { b[8] = 'x'; }), "magic");  // the bytes that a text transfer would change
  EXPECT_CONTAINS(refused([](std::string& b) { put<std::int64_t>(b, 24, -4); }), "dim[1]");
  EXPECT_CONTAINS(refused([](std::string& b) { put<std::int64_t>(b, 24, std::int64_t{1} << 60); }), "dim[1]");
  EXPECT_CONTAINS(refused([](std::string& b) { put<std::int64_t>(b, 168, 352); }), "vox_offset");
  EXPECT_CONTAINS(refused([](std::string& b) { put<std::int64_t>(b, 16, 4), put<std::int64_t>(b, 48, 5); }), "dim[4]");
  EXPECT_CONTAINS(refused([](std::string& b) { put(b, 400, std::nan("")); }), "not finite");
  EXPECT_CONTAINS(refused([](std::string& b) { b.resize(500); }), "500 of 540");
}

NiftiFixture pair_header() {
  NiftiFixture file;
  file.at(1, 2, 3) = 9;
  std::memcpy(file.header.data() + 344, "ni1", 4);
  file.put(108, 0.0F);
  return file;
}

TEST(NiftiPair, IsReadFromEitherName) {
  test::TemporaryFolder folder;
  const NiftiFixture file = pair_header();
  const std::string header = file.header.substr(0, 348), voxels(file.voxels.begin(), file.voxels.end());
  folder.write("a.hdr", header), folder.write("a.img", voxels);
  EXPECT_EQ(test::read_label_volume(folder / "a.hdr").label_counts().at(9), 1U);
  EXPECT_EQ(test::read_label_volume(folder / "a.img").label_counts().at(9), 1U);
  folder.write("B.HDR", header), folder.write("B.IMG", voxels);
  EXPECT_EQ(test::read_label_volume(folder / "B.IMG").label_counts().at(9), 1U);
  folder.write("c.hdr.gz", gzip_compressed(header)), folder.write("c.img.gz", gzip_compressed(voxels));
  EXPECT_EQ(test::read_label_volume(folder / "c.img.gz").label_counts().at(9), 1U);
  folder.write("d.hdr", header), folder.write("d.img.gz", gzip_compressed(voxels));
  EXPECT_EQ(test::read_label_volume(folder / "d.hdr").label_counts().at(9), 1U);
}

TEST(NiftiPair, HalvesAloneAndAnalyzeAreRefused) {
  test::TemporaryFolder folder;
  const NiftiFixture file = pair_header();
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.hdr", file.header)), "a.img, are not beside it");
  EXPECT_CONTAINS(test::image_refusal(folder.write("b.img", "voxels")), "b.hdr, is not beside it");
  EXPECT_CONTAINS(test::image_refusal(folder.write("c.nii", file.bytes())),
                  ".hdr/.img pair under the name of a single file");
  EXPECT_CONTAINS(test::image_refusal(folder.write("d.hdr", NiftiFixture().bytes())), "a header of a single file");
  std::string analyze = file.header;
  std::memset(analyze.data() + 344, 0, 4);
  EXPECT_CONTAINS(test::image_refusal(folder.write("e.hdr", analyze)), "Analyze 7.5");
}

TEST(NiftiImage, EveryNumberTypeSlopeAndByteOrder) {
  test::TemporaryFolder folder;
  NiftiFixture file;
  file.at(5, 0, 3) = 100;
  file.put(112, 0.5F), file.put(116, -20.0F);
  const auto check = [&](std::int16_t code, std::int16_t bits, const std::string& bytes) {
    const ImageVolume image = read_image_volume(folder.write("a.nii", bytes));
    EXPECT_EQ(test::value_at(image, {5, 0, 3}), 30) << code;
    EXPECT_EQ(test::value_at(image, {0, 0, 0}), -20) << code << " " << bits;
  };
  const auto of = [&](std::int16_t code, std::int16_t bits, const auto& make) {
    file.type(code, bits);
    check(code, bits, make());
  };
  of(2, 8, [&] { return file.bytes(); });
  of(4, 16, [&] { return file.bytes_as<std::int16_t>(); });
  of(8, 32, [&] { return file.bytes_as<std::int32_t>(); });
  of(16, 32, [&] { return file.bytes_as<float>(); });
  of(64, 64, [&] { return file.bytes_as<double>(); });
  of(256, 8, [&] { return file.bytes_as<std::int8_t>(); });
  of(512, 16, [&] { return file.bytes_as<std::uint16_t>(); });
  of(768, 32, [&] { return file.bytes_as<std::uint32_t>(); });
  of(1024, 64, [&] { return file.bytes_as<std::int64_t>(); });
  of(1280, 64, [&] { return file.bytes_as<std::uint64_t>(); });
}

TEST(NiftiImage, OddValuesBecomeTheLowestAndAreCounted) {
  test::TemporaryFolder folder;
  NiftiFixture file;
  file.type(16, 32);
  std::string bytes = file.bytes_as<float>();
  put(bytes, 352 + 4 * 3, std::numeric_limits<float>::quiet_NaN());
  put(bytes, 352 + 4 * 4, -std::numeric_limits<float>::infinity());
  put(bytes, 352 + 4 * 5, -7.0F);
  const ImageVolume image = read_image_volume(folder.write("a.nii", bytes));
  EXPECT_EQ(test::value_at(image, {3, 0, 0}), -7);
  EXPECT_EQ(test::value_at(image, {4, 0, 0}), -7);
  EXPECT_TRUE(test::has_note(image.notes, "2 voxels are not finite"));
  EXPECT_CONTAINS(test::map_refusal(folder.path() / "a.nii"), "not a finite number");
}

TEST(NiftiMap, ImagesAreNotTakenForLabelMaps) {
  test::TemporaryFolder folder;
  NiftiFixture file({20, 20, 5});
  file.type(4, 16);
  std::string bytes = file.bytes_as<std::int16_t>();
  for (std::size_t n = 0; n < 2000; ++n) put(bytes, 352 + 2 * n, static_cast<std::int16_t>(n % 1001));
  EXPECT_EQ(read_label_map(folder.write("a.nii", bytes)).segments.size(), 1000U);
  for (std::size_t n = 0; n < 2000; ++n) put(bytes, 352 + 2 * n, static_cast<std::int16_t>(n % 1002));
  const std::string many = test::map_refusal(folder.write("b.nii", bytes));
  EXPECT_CONTAINS(many, "more than 1000 different values");
  EXPECT_CONTAINS(many, "--labels");
  EXPECT_CONTAINS(many, "--threshold");
  put(bytes, 352, std::int16_t{-1000});
  EXPECT_CONTAINS(test::map_refusal(folder.write("c.nii", bytes)), "voxel 0 holds -1000");
}

/// Slices that slide forward one after the other, as a tilted gantry leaves them.
TEST(NiftiMap, ShearedAxesAreStraightenedAndKeepTheOrgan) {
  test::TemporaryFolder folder;
  Eigen::Affine3d tilted = Eigen::Affine3d::Identity();
  tilted.linear()(1, 2) = 0.4;  // 21.8 degrees
  NiftiFixture file({30, 30, 30}, tilted);
  const Eigen::Vector3d centre = tilted * Eigen::Vector3d(14.5, 14.5, 14.5);
  std::size_t inside = 0;
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 30; ++j)
      for (int i = 0; i < 30; ++i)
        if ((tilted * Eigen::Vector3d(i, j, k) - centre).norm() < 9) file.at(i, j, k) = 1, ++inside;
  const LabelMap map = read_label_map(folder.write("a.nii", file.bytes()));
  const LabelVolume& volume = map.layers.front();
  EXPECT_LT(skew_of(volume.index_to_ras_mm), 1e-12);
  EXPECT_TRUE(test::has_note(map.notes, "straightened"));
  EXPECT_TRUE(test::has_note(map.notes, "not at right angles"));
  const double volume_ml = static_cast<double>(volume.label_counts().at(1)) * volume.voxel_volume_ml();
  EXPECT_NEAR(volume_ml, static_cast<double>(inside) * 1e-3, 0.02 * volume_ml);
  std::size_t voxel = 0, wrong = 0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i, ++voxel) {
        const double distance = (volume.index_to_ras_mm * Eigen::Vector3d(i, j, k) - centre).norm();
        wrong += (volume.labels[voxel] == 1) != (distance < 9) && std::abs(distance - 9) > 0.71 ? 1 : 0;
      }
  EXPECT_EQ(wrong, 0U);  // the ball is where it was, to half a voxel's diagonal in the slice
}

TEST(BigImages, AreAveragedOverPairsAndSaySo) {
  test::TemporaryFolder folder;
  NiftiFixture file({8, 6, 5}, test::frame_of(Eigen::Vector3d(1, 1, 3).asDiagonal(), {0, 0, 0}));
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i) file.at(i, j, k) = static_cast<std::uint8_t>(i + 10 * j + 40 * k);
  const VolumeHeader header = nifti_volume_header(folder.write("a.nii", file.bytes()));
  const ImageVolume half = assemble_image(header, {}, 120);
  EXPECT_EQ(half.size, (std::array<int, 3>{4, 6, 5}));
  EXPECT_EQ(test::value_at(half, {2.5, 1, 0}), 12.5);
  EXPECT_TRUE(test::has_note(half.notes, "averaged over 2 x 1 x 1"));
  const ImageVolume quarter = assemble_image(header, {}, 60);
  EXPECT_EQ(quarter.size, (std::array<int, 3>{4, 3, 5}));
  EXPECT_EQ(test::value_at(quarter, {0.5, 0.5, 3}), 45.5);
  EXPECT_TRUE(assemble_image(header, {}, 240).notes.empty());
}

TEST(VolumeNames, DispatchGoesByEndingAndSignature) {
  test::TemporaryFolder folder;
  const std::string nifti = NiftiFixture().bytes();
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.nrrd", nifti)),
                  "the name says NRRD, but the bytes look like a NIfTI header");
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.mha", "NRRD0004\n")),
                  "the name says MetaImage, but the bytes look like NRRD");
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.nii", "NRRD0004\n")),
                  "the name says NIfTI, but the bytes look like NRRD");
  EXPECT_CONTAINS(test::image_refusal(folder.write("b.nrrd", gzip_compressed(nifti))), "look like a gzip file");
  EXPECT_CONTAINS(test::image_refusal(folder.write("c.nrrd", std::string(128, '\0') + "DICM....")), "look like DICOM");
  EXPECT_CONTAINS(test::image_refusal(folder.write("d.mha", "")), "the file is empty");
  EXPECT_CONTAINS(test::image_refusal(folder.write("e.raw", nifti)), "volumes are read from NIfTI");
  EXPECT_CONTAINS(test::image_refusal(folder.path() / "gone.mha"), "no such file");
  EXPECT_CONTAINS(test::image_refusal(folder.path()), "a folder");
  EXPECT_TRUE(is_volume_file("x/SCAN.NII.GZ"));
  EXPECT_TRUE(is_volume_file("abdomen.seg.nrrd"));
  EXPECT_FALSE(is_volume_file("liver.stl"));
}

TEST(VolumeNames, ReadingCanBeStoppedOnTheWay) {
  test::TemporaryFolder folder;
  struct Stopped {};
  const auto path = folder.write("a.nii", NiftiFixture().bytes());
  EXPECT_THROW(read_image_volume(path, [](std::string_view, double) { throw Stopped(); }), Stopped);
}

}  // namespace
}  // namespace trocar::nifti_volume_test
