#include "tissue/imaging/labels/segment.h"

#include <algorithm>
#include <cmath>

namespace trocar {

std::string readable_name(std::string text) {
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto letter = static_cast<unsigned char>(text[n]);
    const auto next = static_cast<unsigned char>(n + 1 < text.size() ? text[n + 1] : 0);
    if (letter < ' ' || letter == 0x7f) text[n] = ' ';
    if (letter == 0xc2 && next >= 0x80 && next < 0xa0) text[n] = text[n + 1] = ' ';
  }
  std::size_t end = std::min(text.size(), kReadableBytes);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
  text.resize(end);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

std::string folded_name(std::string_view name) {
  std::string folded;
  for (const char letter : name) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') ||
                       static_cast<unsigned char>(letter) >= 0x80;
    if (letter >= 'A' && letter <= 'Z')
      folded += static_cast<char>(letter - 'A' + 'a');
    else if (plain)
      folded += letter;
    else if (!folded.empty() && folded.back() != '_')
      folded += '_';
  }
  while (!folded.empty() && folded.back() == '_') folded.pop_back();
  return folded;
}

std::string listed_words(const std::vector<std::string>& words, std::size_t most) {
  std::string text;
  for (std::size_t n = 0; n < std::min(words.size(), most); ++n) text += (n > 0 ? ", " : "") + words[n];
  return words.size() > most ? text + " and " + std::to_string(words.size() - most) + " more" : text;
}

std::optional<SegmentColour> colour_of(double red, double green, double blue) {
  SegmentColour colour{};
  std::size_t place = 0;
  for (const double part : {red, green, blue}) {
    if (!(part >= 0 && part <= 1)) return std::nullopt;
    colour[place++] = static_cast<std::uint8_t>(std::lround(255 * part));
  }
  return colour;
}

}  // namespace trocar
