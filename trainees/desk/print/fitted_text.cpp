#include "trainees/desk/print/fitted_text.h"

namespace trocar::printed {
namespace {

constexpr const char* kBox = "\xE2\x96\xA1";
constexpr const char* kEllipsis = "\xE2\x80\xA6";

/// Bytes of the character at `at`; 0: broken, or beyond the first plane, with its bytes in `skip`.
std::size_t length_at(const std::string& text, std::size_t at, std::size_t& skip) {
  const auto byte = [&](std::size_t k) { return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U; };
  const auto follow = [&](std::size_t count) {
    for (std::size_t k = 1; k < count; ++k)
      if ((byte(k) & 0xC0U) != 0x80U) return false;
    return true;
  };
  skip = 1;
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return follow(2) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool bad = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) >= 0xA0) || !follow(3);
    return bad ? 0 : 3;
  }
  if (lead >= 0xF0 && lead <= 0xF4 && follow(4)) skip = 4;
  return 0;
}

/// Where the character at `at` ends. @param text printable.
std::size_t after(const std::string& text, std::size_t at) {
  ++at;
  while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  return at;
}

void without_last(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
  if (!text.empty()) text.pop_back();
}

/// Pieces of a word, each within the width.
std::vector<std::string> pieces(const std::string& word, double width, const WidthOf& width_of) {
  if (width_of(word) <= width) return {word};
  std::vector<std::string> out(1);
  for (std::size_t at = 0; at < word.size();) {
    const std::size_t next = after(word, at);
    const std::string character = word.substr(at, next - at);
    if (!out.back().empty() && width_of(out.back() + character) > width) out.emplace_back();
    out.back() += character;
    at = next;
  }
  return out;
}

void wrap_line(const std::string& line, double width, const WidthOf& width_of, std::vector<std::string>& out) {
  out.emplace_back();
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    const std::string word = line.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    const std::string longer = out.back().empty() ? word : out.back() + " " + word;
    if (width_of(longer) <= width) {
      out.back() = longer;
      continue;
    }
    for (std::string& piece : pieces(word, width, width_of)) {
      if (out.back().empty())
        out.back() = std::move(piece);
      else
        out.push_back(std::move(piece));
    }
  }
}

}  // namespace

std::string printable(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t skip = 1;
    const std::size_t length = length_at(text, at, skip);
    const auto c = static_cast<unsigned char>(text[at]);
    if (length == 0)
      out += kBox;
    else if (length == 1 && (c < 0x20 || c == 0x7F))
      out += c == '\n' ? "\n" : " ";
    else
      out.append(text, at, length);
    at += length == 0 ? skip : length;
  }
  return out;
}

std::string shortened(const std::string& text, double width, const WidthOf& width_of) {
  std::string out = text;
  if (width_of(out) <= width) return out;
  while (!out.empty() && width_of(out + kEllipsis) > width) without_last(out);
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out + kEllipsis;
}

std::vector<std::string> wrapped(const std::string& text, double width, const WidthOf& width_of, int most) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    wrap_line(text.substr(at, end - at), width, width_of, out);
    at = end + 1;
  }
  const auto limit = static_cast<std::size_t>(most);
  if (most <= 0 || out.size() <= limit) return out;
  out.resize(limit);
  const std::string whole = out.back() + kEllipsis;
  out.back() = width_of(whole) <= width ? whole : shortened(whole, width, width_of);
  return out;
}

}  // namespace trocar::printed
