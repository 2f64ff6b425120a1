// Reads a plain or gzip-compressed file as one stream of bytes, without ever holding more than a block of it.
//
// Thread: one owner. Errors: InputError naming the file (damaged compression, unreadable file).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace trocar {

class GzipStream {
 public:
  explicit GzipStream(const std::filesystem::path& path);

  /// Whether the file starts with the gzip signature 1f 8b.
  bool gzip() const { return gzip_; }
  /// Reads up to `count` decompressed bytes; fewer only at the end of the file.
  std::size_t read(unsigned char* into, std::size_t count);
  /// To be called after the last wanted byte: proves the checksum that follows it in a gzip file.
  void finish_member();

 private:
  struct Close {
    void operator()(void* file) const;
  };

  std::string name_;
  bool gzip_ = false;
  std::unique_ptr<void, Close> file_;
};

/// One gzip member holding `bytes`, without name or time stamp: same bytes in, same bytes out.
std::string gzip_compressed(const std::string& bytes);

}  // namespace trocar
