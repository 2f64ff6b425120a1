// A table for people: columns aligned by spaces, numbers to the right. ASCII widths. Thread: any.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

class TextTable {
 public:
  enum class Align : char { kLeft, kRight };
  struct Column {
    std::string title;
    Align align = Align::kLeft;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// One cell a column; missing cells are empty.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  void print(std::ostream& out) const;

 private:
  void print_row(std::ostream& out, const std::vector<std::string>& cells,
                 const std::vector<std::size_t>& widths) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// The number with that many decimals, "-" when there is none.
std::string cell(const std::optional<double>& value, int decimals);

/// "1 f15c376e": version and first digits of the bytes that graded, so that two files of one id are told apart.
std::string cell_rubric(const std::string& version, const std::string& sha256);

/// "2026-03-01 09:30" of an ISO 8601 time; "-" when empty.
std::string cell_time(const std::string& utc);

}  // namespace trocar
