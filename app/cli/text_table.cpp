#include "app/cli/text_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "haptics/utf8.h"

namespace trocar {

void TextTable::print_row(std::ostream& out, const std::vector<std::string>& cells,
                          const std::vector<std::size_t>& widths) const {
  std::string line;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string text = i < cells.size() ? harmless(cells[i]) : "";
    const std::string padding(widths[i] - text.size(), ' ');
    if (i > 0) line += "  ";
    line += columns_[i].align == Align::kRight ? padding + text : text + padding;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  out << line << '\n';
}

void TextTable::print(std::ostream& out) const {
  std::vector<std::string> titles;
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    titles.push_back(columns_[i].title);
    std::size_t width = columns_[i].title.size();
    for (const auto& row : rows_) width = std::max(width, i < row.size() ? row[i].size() : 0);
    widths.push_back(width);
  }
  print_row(out, titles, widths);
  for (const auto& row : rows_) print_row(out, row, widths);
}

std::string cell(const std::optional<double>& value, int decimals) {
  if (!value || !std::isfinite(*value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, *value);
  return text;
}

std::string cell_rubric(const std::string& version, const std::string& sha256) {
  constexpr std::size_t kShown = 8;
  return version + " " + sha256.substr(0, kShown);
}

std::string cell_time(const std::string& utc) {
  if (utc.size() < 16) return "-";
  return utc.substr(0, 10) + " " + utc.substr(11, 5);
}

}  // namespace trocar
