#include "tissue/imaging/volumes/nifti_writer.h"

#include <bit>
#include <cstring>
#include <stdexcept>

#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/volumes/gzip_stream.h"
#include "tissue/imaging/volumes/nifti_header.h"

namespace trocar {
namespace {

static_assert(std::endian::native == std::endian::little, "the header is written in this machine's byte order");

constexpr std::size_t kDataOffset = 352;

template <typename T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

/// Byte offsets as in nifti1.h.
std::string header_bytes(const std::array<int, 3>& size, const Eigen::Affine3d& frame, NiftiType type,
                         std::int16_t bits) {
  std::string bytes(kDataOffset, '\0');
  put<std::int32_t>(bytes, 0, 348);
  put<std::int16_t>(bytes, 40, 3);
  for (std::size_t n = 0; n < 7; ++n) put(bytes, 42 + 2 * n, static_cast<std::int16_t>(n < 3 ? size[n] : 1));
  put(bytes, 70, static_cast<std::int16_t>(type));
  put(bytes, 72, bits);
  put(bytes, 76, 1.0F);
  for (std::size_t n = 0; n < 3; ++n)
    put(bytes, 80 + 4 * n, static_cast<float>(frame.linear().col(static_cast<int>(n)).norm()));
  put(bytes, 108, static_cast<float>(kDataOffset));
  put(bytes, 112, 1.0F);
  put<std::uint8_t>(bytes, 123, 2);  // millimetres
  std::memcpy(bytes.data() + 148, kPhantomDescription.data(), kPhantomDescription.size());
  put<std::int16_t>(bytes, 254, 1);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      put(bytes, 280 + static_cast<std::size_t>(16 * row + 4 * column),
          static_cast<float>(frame.matrix()(row, column)));
  std::memcpy(bytes.data() + 344, "n+1", 4);
  return bytes;
}

template <typename T>
std::string packed(const std::array<int, 3>& size, const Eigen::Affine3d& frame, NiftiType type,
                   const std::vector<T>& values) {
  std::size_t count = 1;
  for (const int extent : size) count *= static_cast<std::size_t>(extent);
  if (count != values.size()) throw std::invalid_argument("nifti_gz_bytes: size and number of values differ");
  std::string bytes = header_bytes(size, frame, type, 8 * sizeof(T));
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return gzip_compressed(bytes);
}

}  // namespace

std::string nifti_gz_bytes(const std::array<int, 3>& size, const Eigen::Affine3d& index_to_ras_mm,
                           const std::vector<std::int16_t>& values) {
  return packed(size, index_to_ras_mm, NiftiType::kInt16, values);
}

std::string nifti_gz_bytes(const std::array<int, 3>& size, const Eigen::Affine3d& index_to_ras_mm,
                           const std::vector<std::uint16_t>& values) {
  return packed(size, index_to_ras_mm, NiftiType::kUint16, values);
}

}  // namespace trocar
