#include "tissue/imaging/labels/label_table.h"

#include <array>

#include "haptics/input_error.h"
#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/totalsegmentator_tables.h"

namespace trocar {
namespace {

std::span<const LabelTable> tables() {
  static const std::array<LabelTable, 4> known{{{"totalsegmentator-v1", totalsegmentator_v1()},
                                                {"totalsegmentator-v2", totalsegmentator_v2()},
                                                {"totalsegmentator-mr", totalsegmentator_mr()},
                                                {kPhantomTable, kPhantomLabels}}};
  return known;
}

}  // namespace

std::optional<int> LabelTable::number_of(std::string_view label) const {
  for (const LabelName& entry : labels)
    if (entry.name == label) return entry.number;
  return std::nullopt;
}

std::optional<std::string_view> LabelTable::name_of(int number) const {
  for (const LabelName& entry : labels)
    if (entry.number == number) return entry.name;
  return std::nullopt;
}

const LabelTable& label_table(std::string_view name) {
  std::string known;
  for (const LabelTable& table : tables()) {
    if (table.name == name) return table;
    known += (known.empty() ? "" : ", ") + std::string(table.name);
  }
  throw InputError("no label table \"" + std::string(name) + "\"; known: " + known);
}

std::vector<std::string> label_table_names() {
  std::vector<std::string> names;
  for (const LabelTable& table : tables()) names.emplace_back(table.name);
  return names;
}

}  // namespace trocar
