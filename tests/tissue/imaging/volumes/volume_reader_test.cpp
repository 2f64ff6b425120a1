// One anatomy in many containers is one array in one place; and what the reader tells about a file beside its voxels.
#include "tissue/imaging/volumes/volume_reader.h"

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::volume_reader_test {
namespace {

/// A few labels on a grid that float32 cannot hold exactly.
test::NiftiFixture anatomy() {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = Eigen::Vector3d(0.7, 0.7, 1.3).asDiagonal();
  frame.translation() = Eigen::Vector3d(-177.956, 11.319, -1234.302);
  test::NiftiFixture file({6, 5, 4}, frame);
  file.at(1, 2, 3) = 5, file.at(5, 0, 0) = 1, file.at(0, 4, 2) = 9, file.at(2, 2, 2) = 5;
  return file;
}

std::string voxels_of(const test::NiftiFixture& file) { return {file.voxels.begin(), file.voxels.end()}; }

/// The same voxels in the order of LPS axes: x and y the other way round.
std::string turned_voxels(const test::NiftiFixture& file) {
  std::string voxels;
  for (int k = 0; k < 4; ++k)
    for (int j = 4; j >= 0; --j)
      for (int i = 5; i >= 0; --i)
        voxels += static_cast<char>(file.voxels[static_cast<std::size_t>(i + 6 * (j + 5 * k))]);
  return voxels;
}

TEST(Containers, OneAnatomyIsOneArrayInOnePlace) {
  test::TemporaryFolder folder;
  const test::NiftiFixture file = anatomy();
  const LabelMap wanted = read_label_map(folder.write("a.nii", file.bytes()));
  const auto same = [&](const std::filesystem::path& path) {
    const LabelMap map = read_label_map(path);
    ASSERT_EQ(map.layers.size(), 1U) << path;
    EXPECT_EQ(map.layers[0].labels, wanted.layers[0].labels) << path;
    EXPECT_TRUE(same_grid(grid_of(map.layers[0]), grid_of(wanted.layers[0]), 1e-3)) << path;  // 1e-6 m
    EXPECT_EQ(map.segments.size(), 3U) << path;
  };
  same(folder.write("a.nii.gz", gzip_compressed(file.bytes())));
  test::NiftiFixture by_quaternion = file;
  by_quaternion.put<std::int16_t>(254, 0), by_quaternion.put<std::int16_t>(252, 1);
  for (std::size_t n = 0; n < 3; ++n)
    by_quaternion.put(268 + 4 * n, static_cast<float>(file.frame.translation()[static_cast<int>(n)]));
  same(folder.write("b.nii", by_quaternion.bytes()));
  // Voxel (0, 0, 0) of the turned order is voxel (5, 4, 0): in LPS at (177.956 - 3.5, -11.319 - 2.8, -1234.302).
  const std::string start =
      "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 6 5 4\nspace directions: ";
  const std::string packed = gzip_compressed(turned_voxels(file));
  same(folder.write(
      "a.nrrd",
      start + "(0.7,0,0) (0,0.7,0) (0,0,1.3)\nencoding: gzip\nspace origin: (174.456,-14.119,-1234.302)\n\n" + packed));
  same(folder.write(
      "a.seg.nrrd",
      start + "(-0.7,0,0) (0,-0.7,0) (0,0,1.3)\nencoding: raw\nspace origin: (177.956,-11.319,-1234.302)\n\n" +
          voxels_of(file)));
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nDimSize = 6 5 4\nElementSpacing = 0.7 0.7 1.3\nElementType = MET_UCHAR\n";
  same(folder.write(
      "a.mha",
      meta + "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 174.456 -14.119 -1234.302\nElementDataFile = LOCAL\n" +
          turned_voxels(file)));
  folder.write("a.raw", voxels_of(file));
  same(folder.write(
      "a.mhd",
      meta + "TransformMatrix = -1 0 0 0 -1 0 0 0 1\nOffset = 177.956 -11.319 -1234.302\nElementDataFile = a.raw\n"));
}

TEST(Containers, LabelVolumeComesFromAnyOfThem) {
  test::TemporaryFolder folder;
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nDimSize = 4 3 2\nElementSpacing = 2 3 4\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
      "Offset = 0 0 0\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  const auto map = folder.write("map.mha", meta + test::packed<std::int16_t>(test::told_indices()));
  EXPECT_EQ(test::read_label_volume(map).label_counts().size(), 23U);  // all but the background
  std::vector<double> hounsfield = test::told_indices();
  hounsfield[5] = -1000;
  const auto ct = folder.write("ct.mha", meta + test::packed<std::int16_t>(hounsfield));
  EXPECT_TRUE(certainly_hounsfield(read_image_volume(ct)));
  EXPECT_FALSE(certainly_hounsfield(read_image_volume(map)));
  const auto mr = folder.write("mr.mha", "Modality = MET_MOD_MR\n" + meta + test::packed<std::int16_t>(hounsfield));
  EXPECT_EQ(read_image_volume(mr).modality, "MR");
  EXPECT_CONTAINS(test::map_refusal(ct), "voxel 5 holds -1000");
}

TEST(Containers, SegmentationWithoutSegmentsSaysSo) {
  test::TemporaryFolder folder;
  const std::string bytes =
      "NRRD0004\ntype: uchar\ndimension: 3\nspace: RAS\nsizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
      "encoding: raw\nspace origin: (0,0,0)\n\n" +
      std::string(7, '\2') + '\0';
  EXPECT_TRUE(test::has_note(read_label_map(folder.write("a.seg.nrrd", bytes)).notes, "names no segment"));
  EXPECT_FALSE(test::has_note(read_label_map(folder.write("b.nrrd", bytes)).notes, "names no segment"));
}

/// As 3D Slicer crops what it exports; without a word of it a single mask that fills its grid to all six sides.
TEST(Containers, ACutOutHasRoomRoundIt) {
  test::TemporaryFolder folder;
  const auto nrrd = [&](const std::string& more, char low) {
    return folder.write("a.seg.nrrd",
                        "NRRD0004\ntype: uchar\ndimension: 3\nspace: RAS\nsizes: 2 2 2\nspace directions: (1,0,0) "
                        "(0,1,0) (0,0,1)\nencoding: raw\nspace origin: (5,0,0)\n" +
                            more + "\n" + std::string(4, low) + std::string(4, '\2'));
  };
  const std::string offset = "Segmentation_ReferenceImageExtentOffset:=";
  for (const auto& [more, low, size] : {std::tuple(std::string(), '\2', 4),
                                        {std::string(), '\0', 2},
                                        {offset + "0 0 3\n", '\0', 4},
                                        {offset + "0 0 0\n", '\0', 2}}) {
    const LabelMap map = read_label_map(nrrd(more, low));
    EXPECT_EQ(map.layers[0].size, (std::array<int, 3>{size, size, size})) << more << int{low};
    EXPECT_EQ(test::has_note(map.notes, "a cut-out of a larger image"), size == 4);
    EXPECT_EQ(map.layers[0].index_to_ras_mm.translation().x(), size == 4 ? 4 : 5);
    EXPECT_EQ(map.layers[0].label_counts().at(2), low == 0 ? 4U : 8U);
  }
}

TEST(Containers, FormatsAreListedForPeople) {
  for (const char* ending : {".nii.gz", ".hdr", ".nrrd", ".nhdr", ".seg.nrrd", ".mha", ".mhd"})
    EXPECT_CONTAINS(volume_formats(), ending);
  for (const char* name : {"a.nii", "A.NRRD", "b.mhd", "c.img.gz", "d.seg.nrrd"})
    EXPECT_TRUE(is_volume_file(name)) << name;
  for (const char* name : {"a.dcm", "nii", "b.gz", "c.raw", "d.stl", ""}) EXPECT_FALSE(is_volume_file(name)) << name;
}

}  // namespace
}  // namespace trocar::volume_reader_test
