// Numbers and texts in a string of bytes: how a reader in a child process hands over what it found.
//
// The child may have been led astray by a hostile file, so reading checks every length. Thread: any.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "haptics/input_error.h"

namespace trocar {

class PackedWriter {
 public:
  template <typename Number>
  void put(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class PackedReader {
 public:
  /// @param name begins messages
  PackedReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  template <typename Number>
  Number get() {
    static_assert(std::is_arithmetic_v<Number>);
    Number number;
    std::memcpy(&number, taken(sizeof number).data(), sizeof number);
    return number;
  }
  std::string_view get_text() { return taken(get<std::uint64_t>()); }
  /// A count of things of at least `least` bytes each: no more than can be there.
  std::uint64_t get_count(std::uint64_t least) {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / least)
      throw InputError(name_ + ": the reader gave no sensible answer: the file is damaged");
    return count;
  }

 private:
  std::string_view taken(std::uint64_t count) {
    if (count > bytes_.size()) throw InputError(name_ + ": the reader gave no sensible answer: the file is damaged");
    const std::string_view part = bytes_.substr(0, static_cast<std::size_t>(count));
    bytes_.remove_prefix(static_cast<std::size_t>(count));
    return part;
  }

  std::string_view bytes_;
  std::string name_;
};

}  // namespace trocar
