#include "tissue/organ/utf8_text.h"

#include <cstddef>

namespace trocar {
namespace {

/// Bytes that follow a first byte, and the range of the second; none for a byte that begins nothing.
struct Sequence {
  std::size_t more = 0;
  unsigned char low = 0x80, high = 0xbf;
  bool valid = true;
};

Sequence begun_by(unsigned char first) {
  if (first < 0x80) return {};
  if (first >= 0xc2 && first <= 0xdf) return {.more = 1};
  if (first == 0xe0) return {.more = 2, .low = 0xa0};
  if (first == 0xed) return {.more = 2, .high = 0x9f};
  if (first >= 0xe1 && first <= 0xef) return {.more = 2};
  if (first == 0xf0) return {.more = 3, .low = 0x90};
  if (first == 0xf4) return {.more = 3, .high = 0x8f};
  if (first >= 0xf1 && first <= 0xf3) return {.more = 3};
  return {.valid = false};
}

}  // namespace

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Sequence sequence = begun_by(static_cast<unsigned char>(text[at]));
    if (!sequence.valid || text.size() - at <= sequence.more) return false;
    for (std::size_t n = 1; n <= sequence.more; ++n) {
      const auto byte = static_cast<unsigned char>(text[at + n]);
      if (byte < (n == 1 ? sequence.low : 0x80) || byte > (n == 1 ? sequence.high : 0xbf)) return false;
    }
    at += 1 + sequence.more;
  }
  return true;
}

}  // namespace trocar
