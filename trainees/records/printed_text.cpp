#include "trainees/records/printed_text.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "haptics/utf8.h"

namespace trocar {
namespace {

constexpr std::size_t kShortestReason = 10;

/// Number of characters. @throws InputError: no UTF-8.
std::size_t characters_of(const std::string& what, const std::string& text) {
  if (const auto count = utf8_characters(text)) return *count;
  throw InputError(what + ": is no UTF-8 text");
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
