// Whole numbers of any size in as few bytes as they need, signed ones by zigzag. Internal to the recorder.
//
// All arithmetic modulo 2^64: exact for every value, and no overflow whatever a damaged file holds.
#pragma once

#include <cstddef>
#include <cstdint>

#include "app/session/recording/byte_order.h"

namespace trocar::bytes {

inline constexpr std::size_t kMaxVarint = 10;

inline std::uint64_t zigzag(std::uint64_t value) { return (value << 1) ^ (0 - (value >> 63)); }
inline std::uint64_t unzigzag(std::uint64_t value) { return (value >> 1) ^ (0 - (value & 1)); }

/// @param out has room for kMaxVarint bytes. @return behind the last byte.
inline char* put_varint(char* out, std::uint64_t value) {
  while (value >= 0x80) {
    *out++ = static_cast<char>(value | 0x80);
    value >>= 7;
  }
  *out++ = static_cast<char>(value);
  return out;
}

/// @throws InputError when the bytes run out or the number is longer than 64 bits.
inline std::uint64_t take_varint(Reader& reader) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const auto byte = reader.take<std::uint8_t>();
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if ((byte & 0x80) == 0) return value;
  }
  throw InputError("a number is longer than 64 bits");
}

}  // namespace trocar::bytes
