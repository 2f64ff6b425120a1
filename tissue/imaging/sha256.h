// SHA-256 (FIPS 180-4) through OpenSSL's libcrypto: names the bytes that an organ, a script or a record came from.
//
// Thread: any, not the tick (file I/O).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace trocar {

/// 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

/// Digest of a file's bytes, read in blocks.
/// @throws InputError when the file cannot be opened or read.
std::string sha256_file(const std::filesystem::path& path);

}  // namespace trocar
