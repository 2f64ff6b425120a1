#include "tissue/mesh/files/text_scanner.h"

#include <charconv>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/mesh/files/surface_file.h"

namespace trocar {
namespace {

bool blank(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n' || letter == '\0';
}

template <typename Number>
bool parse(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && stop == word.data() + word.size();
}

}  // namespace

bool to_number(std::string_view word, double& value) {
  if (parse(word, value)) return std::isfinite(value);
  // Too small for a double is zero; too large is no coordinate.
  if (word.find("e-") == std::string_view::npos && word.find("E-") == std::string_view::npos) return false;
  double mantissa = 0;
  std::int64_t exponent = 0;
  const std::size_t e = word.find_first_of("eE");
  if (!parse(word.substr(0, e), mantissa) || !parse(word.substr(e + 1), exponent) || exponent > -300) return false;
  value = 0;
  return true;
}

bool to_whole(std::string_view word, std::int64_t& value) { return parse(word, value); }

void TextScanner::skip_blanks() {
  for (; offset_ < text_.size() && blank(text_[offset_]); ++offset_) line_ += text_[offset_] == '\n' ? 1 : 0;
}

std::string_view TextScanner::peek() {
  skip_blanks();
  std::size_t end = offset_;
  while (end < text_.size() && !blank(text_[end])) ++end;
  return text_.substr(offset_, end - offset_);
}

std::string_view TextScanner::word() {
  const std::string_view found = peek();
  offset_ += found.size();
  return found;
}

std::string_view TextScanner::line() {
  const std::size_t end = text_.find('\n', offset_);
  const std::size_t stop = end == std::string_view::npos ? text_.size() : end;
  std::string_view found = text_.substr(offset_, stop - offset_);
  if (found.ends_with('\r')) found.remove_suffix(1);
  offset_ = end == std::string_view::npos ? stop : stop + 1;
  ++line_;
  return found;
}

bool TextScanner::at_end() {
  skip_blanks();
  return offset_ >= text_.size();
}

double TextScanner::number(const char* what) {
  const std::string_view found = word();
  double value = 0;
  if (found.empty()) refuse("the file ends before " + std::string(what));
  if (!to_number(found, value)) refuse(std::string(what) + ": \"" + printable(found) + "\" is no finite number");
  return value;
}

std::int64_t TextScanner::whole(const char* what, std::int64_t least, std::int64_t most) {
  const std::string_view found = word();
  std::int64_t value = 0;
  if (found.empty()) refuse("the file ends before " + std::string(what));
  if (!to_whole(found, value) || value < least || value > most)
    refuse(std::string(what) + ": \"" + printable(found) + "\" is no whole number from " + std::to_string(least) +
           " to " + std::to_string(most));
  return value;
}

void TextScanner::refuse(const std::string& what) const { throw InputError(file_, line_, 1, what); }

}  // namespace trocar
