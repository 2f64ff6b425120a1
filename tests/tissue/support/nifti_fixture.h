// NIfTI-1 files made byte by byte for tests, independent of the project's own writer.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace trocar::test {

struct NiftiFixture {
  std::array<int, 3> size{6, 5, 4};
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  std::vector<std::uint8_t> voxels = std::vector<std::uint8_t>(120, 0);
  std::string header = std::string(352, '\0');

  explicit NiftiFixture(std::array<int, 3> extent = {6, 5, 4},
                        const Eigen::Affine3d& affine = Eigen::Affine3d::Identity())
      : size(extent), frame(affine), voxels(static_cast<std::size_t>(extent[0] * extent[1] * extent[2]), 0) {
    put<std::int32_t>(0, 348);
    put<std::int16_t>(40, 3);
    for (std::size_t n = 0; n < 7; ++n) put(42 + 2 * n, static_cast<std::int16_t>(n < 3 ? size[n] : 1));
    type(2, 8);
    put(76, 1.0F);
    for (std::size_t n = 0; n < 3; ++n)
      put(80 + 4 * n, static_cast<float>(frame.linear().col(static_cast<int>(n)).norm()));
    put(108, 352.0F);
    put<std::uint8_t>(123, 2);
    put<std::int16_t>(254, 2);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        put(280 + static_cast<std::size_t>(16 * row + 4 * column), static_cast<float>(frame.matrix()(row, column)));
    std::memcpy(header.data() + 344, "n+1", 4);
  }

  template <typename T>
  void put(std::size_t offset, T value) {
    std::memcpy(header.data() + offset, &value, sizeof(T));
  }

  void type(std::int16_t code, std::int16_t bits) {
    put(70, code);
    put(72, bits);
  }

  std::uint8_t& at(int i, int j, int k) { return voxels[static_cast<std::size_t>(i + size[0] * (j + size[1] * k))]; }

  std::string bytes() const { return header + std::string(voxels.begin(), voxels.end()); }

  template <typename T>
  std::string bytes_as() const {
    std::string all = header;
    for (const std::uint8_t voxel : voxels) {
      const T value = static_cast<T>(voxel);
      all.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    return all;
  }

  std::array<unsigned char, 348> header_array() const {
    std::array<unsigned char, 348> raw{};
    std::memcpy(raw.data(), header.data(), raw.size());
    return raw;
  }
};

}  // namespace trocar::test
