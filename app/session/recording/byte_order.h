// Little-endian numbers in byte strings, whatever the machine. Internal to the recorder.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "haptics/input_error.h"

namespace trocar::bytes {

template <std::unsigned_integral T>
void put(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
}

inline void put_double(std::string& out, double value) { put(out, std::bit_cast<std::uint64_t>(value)); }

/// Reads numbers off the front of a byte string. @throws InputError when the bytes run out.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral T>
  T take() {
    const std::string_view field = take_bytes(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(field[i])) << (8 * i);
    }
    return static_cast<T>(value);
  }

  double take_double() { return std::bit_cast<double>(take<std::uint64_t>()); }

  std::string_view take_bytes(std::size_t size) {
    if (size > rest_.size()) throw InputError("payload ends too early");
    const std::string_view field = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return field;
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

}  // namespace trocar::bytes
