#include "tissue/imaging/label_table.h"

#include <array>

#include "haptics/input_error.h"
#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar {
namespace {

constexpr std::array<LabelName, 17> kV1{{{1, "spleen"},
                                         {2, "kidney_right"},
                                         {3, "kidney_left"},
                                         {4, "gallbladder"},
                                         {5, "liver"},
                                         {6, "stomach"},
                                         {7, "aorta"},
                                         {8, "inferior_vena_cava"},
                                         {9, "portal_vein_and_splenic_vein"},
                                         {10, "pancreas"},
                                         {11, "adrenal_gland_right"},
                                         {12, "adrenal_gland_left"},
                                         {42, "esophagus"},
                                         {55, "small_bowel"},
                                         {56, "duodenum"},
                                         {57, "colon"},
                                         {104, "urinary_bladder"}}};

constexpr std::array<LabelName, 17> kV2{{{1, "spleen"},
                                         {2, "kidney_right"},
                                         {3, "kidney_left"},
                                         {4, "gallbladder"},
                                         {5, "liver"},
                                         {6, "stomach"},
                                         {7, "pancreas"},
                                         {8, "adrenal_gland_right"},
                                         {9, "adrenal_gland_left"},
                                         {15, "esophagus"},
                                         {18, "small_bowel"},
                                         {19, "duodenum"},
                                         {20, "colon"},
                                         {21, "urinary_bladder"},
                                         {52, "aorta"},
                                         {63, "inferior_vena_cava"},
                                         {64, "portal_vein_and_splenic_vein"}}};

constexpr std::array<LabelName, 15> kMr{{{1, "spleen"},
                                         {2, "kidney_right"},
                                         {3, "kidney_left"},
                                         {4, "gallbladder"},
                                         {5, "liver"},
                                         {6, "stomach"},
                                         {7, "pancreas"},
                                         {8, "adrenal_gland_right"},
                                         {9, "adrenal_gland_left"},
                                         {13, "small_bowel"},
                                         {14, "duodenum"},
                                         {15, "colon"},
                                         {23, "aorta"},
                                         {24, "inferior_vena_cava"},
                                         {25, "portal_vein_and_splenic_vein"}}};

constexpr std::array<LabelTable, 4> kTables{{{"totalsegmentator-v1", kV1},
                                             {"totalsegmentator-v2", kV2},
                                             {"totalsegmentator-mr", kMr},
                                             {kPhantomTable, kPhantomLabels}}};

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
  for (const LabelTable& table : kTables) {
    if (table.name == name) return table;
    known += (known.empty() ? "" : ", ") + std::string(table.name);
  }
  throw InputError("no label table \"" + std::string(name) + "\"; known: " + known);
}

std::vector<std::string> label_table_names() {
  std::vector<std::string> names;
  for (const LabelTable& table : kTables) names.emplace_back(table.name);
  return names;
}

}  // namespace trocar
