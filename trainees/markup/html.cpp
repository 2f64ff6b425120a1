#include "trainees/markup/html.h"

#include <sodium.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "haptics/utf8.h"

namespace trocar {
std::string escape_html(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const char c = text[i];
    const bool control = (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') || c == 0x7F;
    if (length == 0 || control)
      out += "\xEF\xBF\xBD";
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out.append(text, i, length);
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) return "n/a";
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string out = text.data();
  return out.find_first_not_of("-0.") == std::string::npos && out[0] == '-' ? out.substr(1) : out;  // no "-0.00"
}

std::string number_text(double value) {
  if (!std::isfinite(value)) return "n/a";
  const double size = std::abs(value);
  if (size != 0 && (size >= 1e7 || size < 1e-4)) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
  }
  const int decimals = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : size >= 1 ? 3 : 4;
  std::string out = fixed_text(value, decimals);
  if (out.find('.') == std::string::npos) return out;
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

std::pair<double, std::string> readable_unit(double value, const std::string& unit) {
  if (unit == "m" && std::abs(value) < 10) return {value * 1000, "mm"};
  if (unit == "m/s" && std::abs(value) < 10) return {value * 1000, "mm/s"};
  if (unit == "1" || unit == "count" || unit == "share") return {value, ""};
  return {value, unit};
}

std::string quantity_text(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "undefined";
  const auto [shown, shown_unit] = readable_unit(*value, unit);
  return number_text(shown) + (shown_unit.empty() ? "" : " " + shown_unit);
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr int kVariant = sodium_base64_VARIANT_ORIGINAL;
  std::string out(sodium_base64_ENCODED_LEN(bytes.size(), kVariant), '\0');
  sodium_bin2base64(out.data(), out.size(), bytes.data(), bytes.size(), kVariant);
  out.pop_back();  // its end as a C string
  return out;
}

std::string words_of(const std::string& identifier) {
  std::string out = lower_words_of(identifier);
  if (!out.empty() && static_cast<unsigned char>(out[0]) < 0x80)
    out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out;
}

std::string lower_words_of(const std::string& identifier) {
  std::string out;
  for (const char c : identifier) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '_' || c == '-')
      out += ' ';
    else
      out += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
  }
  return out;
}

}  // namespace trocar
