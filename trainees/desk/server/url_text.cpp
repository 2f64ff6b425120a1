#include "trainees/desk/server/url_text.h"

#include <algorithm>

#include "haptics/utf8.h"

namespace trocar::review {
namespace {

constexpr std::size_t kLongestPath = 1000, kLongestName = 100;

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

bool letter_or_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

bool visible(char c) { return c > ' ' && c < 0x7f; }

bool refused_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
}

void append_hex(std::string& out, char c) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  const auto byte = static_cast<unsigned char>(c);
  out += '%';
  out += kDigits[byte >> 4];
  out += kDigits[byte & 15];
}

}  // namespace

std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '+' && plus_is_space) {
      c = ' ';
    } else if (c == '%') {
      const int high = i + 2 < text.size() ? hex_value(text[i + 1]) : -1, low = high < 0 ? -1 : hex_value(text[i + 2]);
      if (low < 0) return {};
      c = static_cast<char>(high << 4 | low);
      i += 2;
    }
    if (refused_control(c)) return {};
    out += c;
  }
  if (!is_utf8(out)) return {};
  return out;
}

std::string percent_encoded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (letter_or_digit(c) || c == '-' || c == '.' || c == '_' || c == '~')
      out += c;
    else
      append_hex(out, c);
  }
  return out;
}

namespace {

/// Browsers end lines of a text with CR LF; here a line ends with LF.
std::string one_line_end(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      out += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      out += '\n';
  }
  return out;
}

}  // namespace

std::optional<std::map<std::string, std::string>> form_fields(std::string_view text, std::size_t most) {
  std::map<std::string, std::string> out;
  std::size_t count = 0;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    if (part.empty()) continue;
    if (++count > most) return {};
    const std::size_t equals = part.find('=');
    const auto name = percent_decoded(part.substr(0, equals), true);
    const auto value = percent_decoded(equals == std::string_view::npos ? "" : part.substr(equals + 1), true);
    if (!name || !value) return {};
    out[*name] = one_line_end(*value);
  }
  return out;
}

bool local_path(std::string_view text) {
  if (text.empty() || text.size() > kLongestPath || text[0] != '/' || text.starts_with("//")) return false;
  return std::all_of(text.begin(), text.end(), [](char c) { return visible(c) && c != '\\'; });
}

std::string redirection_to(std::string_view path) {
  if (!path.starts_with('/') || path.starts_with("//")) return "/";
  std::string out;
  for (const char c : path) {
    if (visible(c) && c != '\\' && c != '"' && c != '<' && c != '>')
      out += c;
    else
      append_hex(out, c);
  }
  return out;
}

std::string download_name(std::string_view name) {
  std::string out;
  for (const char c : name.substr(0, kLongestName)) {
    const bool keeps = letter_or_digit(c) || c == '-' || c == '_' || (c == '.' && !out.empty());
    out += keeps ? c : '_';
  }
  return out.empty() ? "download" : out;
}

}  // namespace trocar::review
