// Numeric CSV with a header line: read strictly, written with enough digits to round-trip.
//
// Errors name file, line and column (field). Thread: not for the tick.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

struct NumericCsv {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// Index of a column by name, empty when the file lacks it.
  std::optional<std::size_t> find(const std::string& name) const;
  /// Index of a column that must exist. @throws InputError naming `file` and the column.
  std::size_t require(const std::string& name, const std::filesystem::path& file) const;
};

/// @throws InputError: missing file, empty file, ragged line, field that is no finite number.
NumericCsv read_numeric_csv(const std::filesystem::path& file);

/// Writes to a temporary beside `file` and renames. @throws EnvironmentError when that fails.
void write_numeric_csv(const std::filesystem::path& file, const NumericCsv& csv);

}  // namespace trocar
