#include "trainees/records/printed_text.h"

#include <algorithm>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kShortestReason = 10;

/// Length of the character that begins there, 0 when it is no UTF-8.
std::size_t character_at(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(at), second = byte(at + 1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return follows(at + 1) ? 2 : 0;
  if (first >= 0xE0 && first < 0xF0) {
    const bool shortest = first != 0xE0 || second >= 0xA0, no_surrogate = first != 0xED || second < 0xA0;
    return follows(at + 1) && follows(at + 2) && shortest && no_surrogate ? 3 : 0;
  }
  if (first < 0xF0 || first > 0xF4) return 0;
  const bool in_range = (first != 0xF0 || second >= 0x90) && (first != 0xF4 || second < 0x90);
  return follows(at + 1) && follows(at + 2) && follows(at + 3) && in_range ? 4 : 0;
}

/// Number of characters. @throws InputError: no UTF-8.
std::size_t characters_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    const std::size_t length = character_at(text, at);
    if (length == 0) throw InputError(what + ": is no UTF-8 text");
    at += length;
  }
  return count;
}

bool blank(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
}

bool control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }
bool control_in_prose(char c) { return control(c) && c != '\n' && c != '\r' && c != '\t'; }

}  // namespace

void check_printed(const std::string& what, const std::string& text, std::size_t most) {
  characters_of(what, text);
  if (blank(text) || text.size() > most || std::any_of(text.begin(), text.end(), control)) {
    throw InputError(what + ": give 1 to " + std::to_string(most) + " characters on one line");
  }
}

void check_prose(const std::string& what, const std::string& text, std::size_t most) {
  if (blank(text)) throw InputError(what + ": is empty");
  if (characters_of(what, text) > most)
    throw InputError(what + ": give no more than " + std::to_string(most) + " characters");
  if (std::any_of(text.begin(), text.end(), control_in_prose)) throw InputError(what + ": holds control characters");
}

void check_reason(const std::string& reason) {
  const std::size_t first = reason.find_first_not_of(" \t\r\n"), last = reason.find_last_not_of(" \t\r\n");
  if (first == std::string::npos || characters_of("reason", reason.substr(first, last - first + 1)) < kShortestReason) {
    throw InputError("reason: say why, in at least 10 characters");
  }
  check_prose("reason", reason);
}

}  // namespace trocar
