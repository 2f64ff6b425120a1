// SHA-256 of bytes and files, as 64 lower-case hexadecimal digits (FIPS 180-4, computed by OpenSSL). A module of its
// own, so that organs, exercises, recordings and the store name bytes in one way.
//
// Thread: any; one Stream belongs to one thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace trocar::digest {

/// Digest of bytes that arrive in pieces.
class Stream {
 public:
  Stream();
  ~Stream();
  Stream(Stream&&) noexcept;
  Stream& operator=(Stream&&) noexcept;

  void update(std::string_view bytes);
  /// Digest of everything so far; the stream can go on afterwards.
  std::string hex() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string of_bytes(std::string_view bytes);

/// @throws InputError naming the file when it cannot be read.
std::string of_file(const std::filesystem::path& file);

/// The same, but "" when the file cannot be read.
std::string of_readable_file(const std::filesystem::path& file);

}  // namespace trocar::digest
