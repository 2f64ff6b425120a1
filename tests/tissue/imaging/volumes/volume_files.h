// Small volume files of several formats, made byte by byte for tests, and the value that lies at a place in patient
// space.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/volume_reader.h"

namespace trocar::test {

/// 4 x 3 x 2 voxels whose value tells their stored index: i + 10 j + 100 k.
inline std::vector<double> told_indices(int ni = 4, int nj = 3, int nk = 2) {
  std::vector<double> values;
  for (int k = 0; k < nk; ++k)
    for (int j = 0; j < nj; ++j)
      for (int i = 0; i < ni; ++i) values.push_back(i + 10 * j + 100 * k);
  return values;
}

template <typename Stored>
std::string packed(const std::vector<double>& values, bool big_endian = false) {
  std::string bytes;
  for (const double value : values) {
    const auto stored = static_cast<Stored>(value);
    char raw[sizeof(Stored)];
    std::memcpy(raw, &stored, sizeof stored);
    if (big_endian) std::reverse(raw, raw + sizeof stored);
    bytes.append(raw, sizeof stored);
  }
  return bytes;
}

/// A zlib stream, as MetaImage has it.
inline std::string zlib_packed(const std::string& bytes) {
  std::string result(compressBound(bytes.size()), '\0');
  uLongf length = result.size();
  compress(reinterpret_cast<Bytef*>(result.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  result.resize(length);
  return result;
}

/// The value of the voxel whose centre lies at the place; fails when the place is no voxel centre.
inline double value_at(const ImageVolume& image, const Eigen::Vector3d& ras_mm) {
  const Eigen::Vector3d index = image.index_to_ras_mm.inverse() * ras_mm;
  const Eigen::Array3i place = index.array().round().cast<int>();
  EXPECT_LT((index - place.matrix().cast<double>()).norm(), 1e-3) << "no voxel centre at " << ras_mm.transpose();
  for (int axis = 0; axis < 3; ++axis)
    if (place[axis] < 0 || place[axis] >= image.size[static_cast<std::size_t>(axis)]) {
      ADD_FAILURE() << "outside: " << ras_mm.transpose();
      return -1;
    }
  return image.values[image.offset(place[0], place[1], place[2])];
}

/// Every stored voxel (i, j, k) must lie at `frame` * (i, j, k), and steps must run to the right, the front and the
/// head.
inline void expect_told_indices(const ImageVolume& image, const Eigen::Affine3d& frame, int ni = 4, int nj = 3,
                                int nk = 2) {
  ASSERT_EQ(image.values.size(), static_cast<std::size_t>(ni * nj * nk));
  for (int k = 0; k < nk; ++k)
    for (int j = 0; j < nj; ++j)
      for (int i = 0; i < ni; ++i) EXPECT_EQ(value_at(image, frame * Eigen::Vector3d(i, j, k)), i + 10 * j + 100 * k);
  for (int axis = 0; axis < 3; ++axis) EXPECT_GT(image.index_to_ras_mm.linear()(axis, axis), 0);
}

inline Eigen::Affine3d frame_of(const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin) {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = linear;
  frame.translation() = origin;
  return frame;
}

inline std::string image_refusal(const std::filesystem::path& path, const VolumeReading& reading = {}) {
  return message_of<InputError>([&] { read_image_volume(path, {}, reading); });
}
inline std::string map_refusal(const std::filesystem::path& path) {
  return message_of<InputError>([&] { read_label_map(path); });
}

inline bool has_note(const std::vector<std::string>& notes, const std::string& part) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace trocar::test
