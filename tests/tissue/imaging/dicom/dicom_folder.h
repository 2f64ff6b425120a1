// A temporary folder with DICOM files, and what reading it gives.
//
// Thread: any.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/dicom_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/dicom_reader.h"

namespace trocar::test {

class DicomFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes);
  }
  /// Files "a00", "a01", ... without extension.
  void write_all(const std::vector<SliceFixture>& slices, const std::string& prefix = "a") const {
    for (std::size_t n = 0; n < slices.size(); ++n)
      folder_.write(prefix + (n < 10 ? "0" : "") + std::to_string(n), slices[n].file());
  }
  std::filesystem::path path() const { return folder_.path(); }
  ImageVolume read(std::optional<int> series = {}) const { return read_dicom_series(folder_.path(), series); }
  /// Message of the InputError that reading gives.
  std::string refusal(std::optional<int> series = {}) const {
    return message_of<InputError>([&] { read(series); });
  }

 private:
  TemporaryFolder folder_;
};

/// Value at a point of patient space (LPS, as DICOM has it); the point must be the centre of a voxel.
inline float value_at_lps(const ImageVolume& volume, const Eigen::Vector3d& lps) {
  const Eigen::Vector3d index = volume.index_to_ras_mm.inverse() * Eigen::Vector3d(-lps.x(), -lps.y(), lps.z());
  const Eigen::Vector3i whole = index.array().round().cast<int>();
  EXPECT_LT((index - whole.cast<double>()).norm(), 1e-6) << index.transpose();
  for (int axis = 0; axis < 3; ++axis)
    if (whole[axis] < 0 || whole[axis] >= volume.size[static_cast<std::size_t>(axis)]) {
      ADD_FAILURE() << "outside the volume: " << index.transpose();
      return 0;
    }
  return volume.values[volume.offset(whole.x(), whole.y(), whole.z())];
}

inline Eigen::Vector3d centre_of(const SliceFixture& slice, int i, int j) {
  return slice.position + slice.along_row * slice.row_step * i + slice.along_column * slice.column_step * j;
}

/// Every pixel of every slice lies in the volume where the slice says, with its rescaled value.
inline void expect_holds(const ImageVolume& volume, const std::vector<SliceFixture>& slices) {
  for (const SliceFixture& slice : slices)
    for (int j = 0; j < slice.rows; ++j)
      for (int i = 0; i < slice.columns; ++i)
        ASSERT_FLOAT_EQ(
            value_at_lps(volume, centre_of(slice, i, j)),
            static_cast<float>(slice.rescale ? slice.slope * slice.value(i, j) + slice.intercept : slice.value(i, j)))
            << i << " " << j;
}

}  // namespace trocar::test
