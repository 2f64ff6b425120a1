// The bytes of a file from some place on, plain or inflated, never more than a block of them at a time.
//
// Thread: one owner. Errors: InputError naming the file (cannot be read, damaged compression).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace trocar {

class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// Reads up to `count` bytes; fewer only at the end.
  virtual std::size_t read(unsigned char* into, std::size_t count) = 0;
};

/// @param offset bytes of the file passed over before the first byte
std::unique_ptr<ByteStream> open_plain(const std::filesystem::path& path, std::uint64_t offset);
/// A gzip file (also of several members) or a zlib stream, told apart by their first bytes.
std::unique_ptr<ByteStream> open_deflated(const std::filesystem::path& path, std::uint64_t offset);

/// No deflate stream grows by more than this factor (zlib's own figure).
inline constexpr std::uint64_t kLargestInflation = 1032;

}  // namespace trocar
