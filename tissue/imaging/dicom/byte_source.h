// Bytes of a file, or of memory, by position: every read is checked against the end, nothing is mapped.
//
// Thread: one owner. Errors: InputError naming the file when it cannot be opened or read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace trocar {

class ByteSource {
 public:
  /// @param name of the file in messages
  ByteSource(const std::filesystem::path& path, std::string name);
  /// Bytes that are in memory already (an inflated file).
  ByteSource(std::string bytes, std::string name);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  std::uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }
  /// @return false, and nothing read, when [at, at + count) does not lie in the source
  bool read(std::uint64_t at, void* into, std::size_t count);
  /// @throws InputError when the source ends before
  std::string bytes(std::uint64_t at, std::size_t count);

 private:
  void fill(std::uint64_t at);
  void read_file(std::uint64_t at, void* into, std::size_t count) const;

  std::string name_, memory_;
  int file_ = -1;
  std::uint64_t size_ = 0;
  std::vector<char> window_;  ///< of the file, from window_at_
  std::uint64_t window_at_ = 0;
};

}  // namespace trocar
