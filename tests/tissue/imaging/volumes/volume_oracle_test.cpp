// Frames and values of our readers against ITK's, which programs of others use: good files only, for hostile ones crash
// it.
#include <random>

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/itk_volume.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::volume_oracle_test {
namespace {

/// Every voxel that ITK has must lie in our image at the same place, LPS turned into RAS, with the same value.
void expect_same_as_itk(const std::filesystem::path& path) {
  const ItkVolume itk = read_itk_volume(path);
  const ImageVolume ours = read_image_volume(path);
  ASSERT_EQ(itk.values.size(), ours.values.size());
  std::size_t voxel = 0;
  for (int k = 0; k < itk.size[2]; ++k)
    for (int j = 0; j < itk.size[1]; ++j)
      for (int i = 0; i < itk.size[0]; ++i, ++voxel) {
        Eigen::Vector3d place(itk.origin_mm[0], itk.origin_mm[1], itk.origin_mm[2]);
        const std::array<int, 3> index{i, j, k};
        for (std::size_t row = 0; row < 3; ++row)
          for (std::size_t column = 0; column < 3; ++column)
            place[static_cast<int>(row)] += itk.direction[row][column] * itk.spacing_mm[column] * index[column];
        const Eigen::Vector3d ras(-place.x(), -place.y(), place.z());
        const Eigen::Vector3d found = ours.index_to_ras_mm.inverse() * ras;
        const Eigen::Array3i nearest = found.array().round().cast<int>();
        ASSERT_LT((found - nearest.matrix().cast<double>()).norm(), 2e-3) << path;
        ASSERT_EQ(ours.values[ours.offset(nearest[0], nearest[1], nearest[2])], itk.values[voxel]) << path;
      }
}

struct Numbers {
  std::mt19937_64 random{17};
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Eigen::Matrix3d turn() {
    const Eigen::Quaterniond q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    Eigen::Matrix3d axes = q.normalized().toRotationMatrix();
    if (random() % 2 == 0) axes.col(static_cast<int>(random() % 3)) *= -1;
    return axes;
  }
};

std::string spaced(const Eigen::Vector3d& v, const char* separator) {
  std::ostringstream text;
  text.precision(17);
  text << v.x() << separator << v.y() << separator << v.z();
  return text.str();
}

TEST(AgainstItk, MetaImagesInAnyOrientation) {
  test::TemporaryFolder folder;
  Numbers numbers;
  for (int round = 0; round < 20; ++round) {
    const Eigen::Matrix3d axes = numbers.turn();
    const Eigen::Vector3d spacing(numbers.between(0.5, 3), numbers.between(0.5, 3), numbers.between(0.5, 3));
    const Eigen::Vector3d origin(numbers.between(-300, 300), numbers.between(-300, 300), numbers.between(-300, 300));
    const std::string header = "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = " +
                               std::string(round % 2 == 0 ? "True" : "False") +
                               "\nCompressedData = False\nTransformMatrix = " + spaced(axes.col(0), " ") + " " +
                               spaced(axes.col(1), " ") + " " + spaced(axes.col(2), " ") +
                               "\nOffset = " + spaced(origin, " ") + "\nElementSpacing = " + spaced(spacing, " ") +
                               "\nDimSize = 4 3 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
    expect_same_as_itk(
        folder.write("a.mha", header + test::packed<std::int16_t>(test::told_indices(), round % 2 == 0)));
  }
}

// LAS is left out: ITK 5.2.1 turns its x where its y points away from LPS, which later versions mend.
TEST(AgainstItk, NrrdInAnyOrientation) {
  test::TemporaryFolder folder;
  Numbers numbers;
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const Eigen::Matrix3d axes = numbers.turn() * numbers.between(0.5, 3);
    const Eigen::Vector3d origin(numbers.between(-300, 300), numbers.between(-300, 300), numbers.between(-300, 300));
    const char* spaces[] = {"left-posterior-superior", "right-anterior-superior"};
    const std::string header = "NRRD0004\ntype: float\ndimension: 3\nspace: " + std::string(spaces[round / 2 % 2]) +
                               "\nsizes: 4 3 2\nspace directions: (" + spaced(axes.col(0), ",") + ") (" +
                               spaced(axes.col(1), ",") + ") (" + spaced(axes.col(2), ",") +
                               ")\nkinds: domain domain domain\nendian: " + (round % 2 == 0 ? "big" : "little") +
                               "\nencoding: gzip\nspace origin: (" + spaced(origin, ",") + ")\n\n";
    expect_same_as_itk(
        folder.write("a.nrrd", header + gzip_compressed(test::packed<float>(test::told_indices(), round % 2 == 0))));
  }
}

// Along the patient's axes, edges that float32 holds exactly: ITK 5.2.1 refuses most others as not orthonormal.
TEST(AgainstItk, NiftiInEveryStorageOrder) {
  test::TemporaryFolder folder;
  Numbers numbers;
  for (int round = 0; round < 20; ++round) {
    const Eigen::Vector3d origin(numbers.between(-300, 300), numbers.between(-300, 300), numbers.between(-300, 300));
    Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
      axes((axis + round) % 3, axis) =
          ((round >> axis & 1) != 0 ? -0.25 : 0.25) * static_cast<double>(2 + numbers.random() % 9);
    test::NiftiFixture file({6, 5, 4}, test::frame_of(axes, origin));
    for (std::size_t voxel = 0; voxel < file.voxels.size(); ++voxel)
      file.voxels[voxel] = static_cast<std::uint8_t>(voxel);
    file.put(112, 2.0F), file.put(116, -50.0F);
    expect_same_as_itk(folder.write("a.nii", file.bytes()));
  }
}

}  // namespace
}  // namespace trocar::volume_oracle_test
