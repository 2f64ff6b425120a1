#include "trainees/exchange/export/xapi_terms.h"

#include <cctype>
#include <chrono>
#include <cstdio>
#include <regex>
#include <string>

namespace trocar::xapi {
namespace {

bool matches(std::string_view text, const std::regex& form) { return std::regex_match(text.begin(), text.end(), form); }

int number(const std::csub_match& part) { return part.matched ? std::stoi(part.str()) : 0; }

}  // namespace

std::string path_part(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x80 || std::isalnum(byte) || c == '-' || c == '.' || c == '_' || c == '~';
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", byte);
    out += plain ? std::string(1, c) : std::string(code);
  }
  return out.empty() ? "-" : out;
}

bool is_uuid(std::string_view text) {
  static const std::regex kForm("[0-9A-Fa-f]{8}-[0-9A-Fa-f]{4}-[0-9A-Fa-f]{4}-[89abAB][0-9A-Fa-f]{3}-[0-9A-Fa-f]{12}");
  return matches(text, kForm);
}

bool is_iri(std::string_view text) {
  static const std::regex kForm("[A-Za-z][A-Za-z0-9+.-]*:[^\\x00-\\x20<>\"{}|\\\\^`\\x7f]+");
  return text.size() <= 2048 && matches(text, kForm);
}

bool is_timestamp(std::string_view text) {
  static const std::regex kForm(
      "(\\d{4})-(\\d{2})-(\\d{2})[Tt](\\d{2}):(\\d{2}):(\\d{2})(\\.\\d{1,12})?([Zz]|[+-](\\d{2}):?(\\d{2})?)");
  std::cmatch parts;
  if (!std::regex_match(text.data(), text.data() + text.size(), parts, kForm)) return false;
  using namespace std::chrono;
  const month of_year(static_cast<unsigned>(number(parts[2])));
  const day of_month(static_cast<unsigned>(number(parts[3])));
  if (!year_month_day(year(number(parts[1])), of_year, of_month).ok()) return false;
  if (number(parts[4]) > 23 || number(parts[5]) > 59 || number(parts[6]) > 60) return false;
  if (number(parts[9]) > 23 || number(parts[10]) > 59) return false;
  const std::string zone = parts[8].str();
  return zone.front() != '-' || number(parts[9]) != 0 || number(parts[10]) != 0;
}

bool is_duration(std::string_view text) {
  static const std::regex kForm(
      "P(?=[0-9T])(\\d+([.,]\\d+)?W|(\\d+([.,]\\d+)?Y)?(\\d+([.,]\\d+)?M)?(\\d+([.,]\\d+)?D)?"
      "(T(?=\\d)(\\d+([.,]\\d+)?H)?(\\d+([.,]\\d+)?M)?(\\d+([.,]\\d+)?S)?)?)");
  static const std::regex kFractionInside("[.,]\\d+[A-Z].*\\d");
  return text.size() <= 64 && matches(text, kForm) && !std::regex_search(text.begin(), text.end(), kFractionInside);
}

bool is_language(std::string_view text) {
  static const std::regex kForm("[A-Za-z]{1,8}(-[A-Za-z0-9]{1,8})*");
  return text.size() <= 64 && matches(text, kForm);
}

}  // namespace trocar::xapi
