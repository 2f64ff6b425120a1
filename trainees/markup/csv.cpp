#include "trainees/markup/csv.h"

#include <charconv>
#include <cmath>

namespace trocar {

std::string csv_text(std::string_view text) {
  constexpr std::string_view kDefused = "=+-@\t\r\n'", kFormula = "=+-@'";
  std::string out;
  if (!text.empty() && kDefused.find(text.front()) != std::string_view::npos) out = "'";
  for (const char c : text) {  // where commas are decimal points, spreadsheets divide at semicolons, within quotes too
    if (out.ends_with(';') && kFormula.find(c) != std::string_view::npos) out += '\'';
    out += c;
  }
  if (out.find_first_of(",\"\r\n") == std::string::npos) return out;
  std::string quoted = "\"";
  for (const char c : out) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double value) {
  if (std::isnan(value)) return "";
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (&field == &fields.front() ? "" : ",") + field;
  return line + "\r\n";
}

}  // namespace trocar
