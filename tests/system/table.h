// Numeric CSV read as simply as can be, independently of the program's own reader.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/system_fixture.h"

namespace trocar::test {

struct Table {
  Translator columns;
  std::vector<std::vector<double>> rows;

  std::size_t at(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw std::runtime_error("no column " + name);
    return static_cast<std::size_t>(found - columns.begin());
  }
};

inline Table read_table(const std::filesystem::path& file) {
  Table table;
  std::string text = file_bytes(file);
  std::erase(text, '\r');
  std::istringstream in(text);
  std::string line, field;
  std::getline(in, line);
  for (std::istringstream fields(line); std::getline(fields, field, ',');) table.columns.push_back(field);
  while (std::getline(in, line)) {
    auto& row = table.rows.emplace_back();
    for (std::istringstream fields(line); std::getline(fields, field, ',');) row.push_back(std::stod(field));
  }
  return table;
}

}  // namespace trocar::test
