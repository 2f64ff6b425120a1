#include "app/cli/device/numeric_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "haptics/input_error.h"

namespace trocar {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = line.find(',', begin);
    std::string field = line.substr(begin, comma - begin);
    const auto first = field.find_first_not_of(" \t\r");
    const auto last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    if (comma == std::string::npos) return fields;
    begin = comma + 1;
  }
}

double parse_field(const std::string& field, const std::filesystem::path& file, int line, int column,
                   const std::string& name) {
  double value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    throw InputError(file.string(), line, column, "column " + name + ": '" + field + "' is not a finite number");
  }
  return value;
}

}  // namespace

std::optional<std::size_t> NumericCsv::find(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::size_t NumericCsv::require(const std::string& name, const std::filesystem::path& file) const {
  if (const auto index = find(name)) return *index;
  throw InputError(file.string(), 1, 1, "no column '" + name + "' in the header line");
}

NumericCsv read_numeric_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot be read (missing file or no permission)");
  NumericCsv csv;
  std::string line;
  if (!std::getline(in, line)) throw InputError(file.string(), 1, 1, "empty file: a header line was expected");
  csv.columns = split(line);
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto fields = split(line);
    if (fields.size() != csv.columns.size()) {
      throw InputError(
          file.string(), number, 1,
          std::to_string(fields.size()) + " fields where the header has " + std::to_string(csv.columns.size()));
    }
    std::vector<double>& row = csv.rows.emplace_back();
    for (std::size_t i = 0; i < fields.size(); ++i) {
      row.push_back(parse_field(fields[i], file, number, static_cast<int>(i) + 1, csv.columns[i]));
    }
  }
  return csv;
}

void write_numeric_csv(const std::filesystem::path& file, const NumericCsv& csv) {
  const std::filesystem::path temporary = file.string() + ".part";
  {
    std::ofstream out(temporary);
    for (std::size_t i = 0; i < csv.columns.size(); ++i) out << (i ? "," : "") << csv.columns[i];
    out << '\n';
    char digits[32];
    for (const auto& row : csv.rows) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto end = std::to_chars(digits, digits + sizeof digits, row[i]).ptr;
        if (i) out << ',';
        out.write(digits, end - digits);
      }
      out << '\n';
    }
    out.flush();
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      throw EnvironmentError(file.string() + ": cannot be written (no permission, missing folder or full disk)");
    }
  }
  std::filesystem::rename(temporary, file);
}

}  // namespace trocar
