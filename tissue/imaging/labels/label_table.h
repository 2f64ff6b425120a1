// What the numbers of a label map mean: named tables, because one number means different organs in different tables.
//
// Source of the built-in ones: the class maps of TotalSegmentator (v1 "total", v2 "total", "total_mr"), in full
// (totalsegmentator_tables.h); a table of the user's own comes from label_table_file.h. Thread: constant data.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trocar {

struct LabelName {
  int number;
  std::string_view name;
};

struct LabelTable {
  std::string_view name;
  std::span<const LabelName> labels;
  bool own = false;  ///< a person's own file, whose names go before those of the label map

  std::optional<int> number_of(std::string_view label) const;
  std::optional<std::string_view> name_of(int number) const;
};

/// @throws InputError listing the known tables
const LabelTable& label_table(std::string_view name);
std::vector<std::string> label_table_names();

}  // namespace trocar
