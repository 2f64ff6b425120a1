// Whether bytes are text as UTF-8 has it (Unicode 15, table 3-7: no surrogates, no overlong forms), and fit to be
// shown. Pure. Thread: any.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trocar {

/// Bytes of the character that begins at `at`; 0 when none that is well formed does.
inline std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !follows(1)) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) {
    const bool overlong = first == 0xE0 && second < 0xA0, surrogate = first == 0xED && second >= 0xA0;
    return !follows(2) || overlong || surrogate ? 0 : 3;
  }
  const bool overlong = first == 0xF0 && second < 0x90, beyond = first == 0xF4 && second >= 0x90;
  return !follows(2) || !follows(3) || overlong || beyond ? 0 : 4;
}

/// Number of characters; nothing when the text is not UTF-8.
inline std::optional<std::size_t> utf8_characters(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) return {};
    at += length;
  }
  return count;
}

inline bool is_utf8(std::string_view text) { return utf8_characters(text).has_value(); }

/// What would steer a terminal, or break the line, as "?" (C0, DEL and C1): text in a record, or from another program,
/// may come from anybody.
inline std::string harmless(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte < 0x20 || byte == 0x7F) text[i] = '?';
    if (byte == 0xC2 && next >= 0x80 && next < 0xA0) text[i] = text[i + 1] = '?';
  }
  return text;
}

}  // namespace trocar
