#include "app/organs/chosen_labels.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/label_table.h"
#include "tissue/imaging/labels/label_table_file.h"

namespace trocar {
namespace {

/// The table that the user names: a built-in one, or a file.
struct NamedTable {
  std::optional<OwnLabelTable> own;
  const LabelTable* table = nullptr;
  std::string name;
};

NamedTable named_table(const std::string& given) {
  NamedTable named;
  if (given.empty()) return named;
  named.own = label_table_or_file(given);
  named.table = &named.own->table();
  named.name = std::filesystem::path(given).filename().string();
  return named;
}

/// The name that the file itself gives.
std::string own_name(const LabelMap& map, const Segment& wanted) {
  const auto found = std::find_if(map.segments.begin(), map.segments.end(), [&](const Segment& segment) {
    return segment.layer == wanted.layer && segment.number == wanted.number;
  });
  return found == map.segments.end() ? "" : found->name;
}

/// A label by number or name, with the name that the file gives it, else the table.
ChosenLabel chosen_label(const LabelMap& map, const std::string& file, const NamedTable& named,
                         const std::string& wanted) {
  ChosenLabel chosen;
  try {
    chosen.segment = choose_segment(map, wanted, named.table, file);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + (wanted.empty() ? "" : " (--label " + wanted + ")"));
  }
  if (own_name(map, chosen.segment) != chosen.segment.name) chosen.table = named.name;
  return chosen;
}

/// What the file calls otherwise than a person's own table.
void tell_conflicts(const LabelMap& map, const std::vector<ChosenLabel>& chosen, std::vector<std::string>& decisions) {
  for (const ChosenLabel& label : chosen) {
    const Segment& segment = label.segment;
    const std::string by_file = own_name(map, segment);
    if (!by_file.empty() && folded_name(by_file) != folded_name(segment.name))
      decisions.push_back("label " + std::to_string(segment.number) + " is called \"" + segment.name + "\" by " +
                          label.table + "; the file calls it \"" + by_file + "\"");
  }
}

/// Whether a name is that of just one label: --name takes it then, where --label says nothing.
bool names_one_label(const LabelMap& map, const std::string& name) {
  const std::string folded = folded_name(name);
  return !folded.empty() && std::count_if(map.segments.begin(), map.segments.end(), [&](const Segment& segment) {
                              return folded_name(segment.name) == folded;
                            }) == 1;
}

/// Why --name, which takes a label where there are several, took none.
std::string not_called(const LabelMap& map, const std::string& name) {
  if (name.empty()) return "";
  std::vector<std::string> names;
  for (const Segment& segment : map.segments) names.push_back(segment.name);
  const auto alike = std::count_if(map.segments.begin(), map.segments.end(), [&](const Segment& segment) {
    return folded_name(segment.name) == folded_name(name);
  });
  if (alike > 1) return "; " + std::to_string(alike) + " of them are called \"" + name + "\"";
  return "; none of them is called \"" + name + "\"" + did_you_mean(name, names);
}

/// A label of a few voxels cannot be meshed; among all labels of a map it is left out instead of stopping the rest.
bool too_small(const LabelMap& map, const Segment& segment, bool only_largest) {
  try {
    cut_out_label(map.layers[segment.layer], segment.number, 1, {.only_largest = only_largest});
    return false;
  } catch (const InputError&) {
    return true;
  }
}

/// "3 \"Liver\"", "3 \"Liver\" (of a.nii.gz)"
std::string told_label(const Segment& segment, const std::map<int, OrganSource>& origin) {
  const auto own = origin.find(segment.number);
  return std::to_string(segment.number) + " \"" + segment.name + "\"" +
         (own == origin.end() ? "" : " (of " + own->second.file + ")");
}

std::string layer_and_number_of(const Segment& segment) {
  return std::to_string(segment.layer) + ":" + std::to_string(segment.number);
}

void refuse_twice(const std::vector<ChosenLabel>& chosen, const std::string& file,
                  const std::map<int, OrganSource>& origin) {
  std::set<std::pair<std::size_t, int>> seen;
  std::map<std::string, Segment> names;
  for (const ChosenLabel& label : chosen) {
    const Segment& segment = label.segment;
    if (!seen.insert({segment.layer, segment.number}).second)
      throw InputError(file + ": --label: label " + std::to_string(segment.number) + " was asked for twice");
    const auto [other, fresh] = names.emplace(file_name_of(segment), segment);
    if (!fresh)
      throw InputError(file + ": labels " + told_label(other->second, origin) + " and " + told_label(segment, origin) +
                       " would both be written as \"" + other->first + "\"; import each by itself: --label " +
                       layer_and_number_of(other->second) + ", and under another -o --label " +
                       layer_and_number_of(segment));
  }
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest_word(word, known);
  return near.empty() ? "" : "; did you mean \"" + near + "\"?";
}

std::vector<ChosenLabel> choose_labels(const OrganImportOptions& options, const LabelMap& map, const std::string& file,
                                       std::vector<std::string>& decisions, const std::map<int, OrganSource>& origin) {
  const NamedTable named = named_table(options.label_table);
  if (named.table != nullptr) require_agreement(map, *named.table, file);
  const auto choose = [&](const std::string& wanted) { return chosen_label(map, file, named, wanted); };
  std::vector<ChosenLabel> chosen;
  if (options.all) {
    if (!options.label.empty()) throw InputError("--all takes every label; it does not go with --label");
    for (const Segment& segment : map.segments) {
      if (too_small(map, segment, options.largest_only)) {
        decisions.push_back("label " + std::to_string(segment.number) +
                            (segment.name.empty() ? "" : " (" + segment.name + ")") +
                            " is left out: no piece of it has 8 voxels");
        continue;
      }
      chosen.push_back(choose(std::to_string(segment.layer) + ":" + std::to_string(segment.number)));
    }
    if (chosen.empty()) throw InputError(file + ": no label of it has a piece of 8 voxels");
  } else if (options.label.empty()) {
    const bool by_name = map.segments.size() > 1 && names_one_label(map, options.name);
    if (map.segments.size() > 1 && !by_name)
      throw InputError(file + ": holds labels " + listed_segments(map, named.table) + not_called(map, options.name) +
                       ": say which with --label, or --all");
    chosen.push_back(choose(by_name ? options.name : ""));
  } else {
    for (const std::string& wanted : options.label) chosen.push_back(choose(wanted));
  }
  refuse_twice(chosen, file, origin);
  tell_conflicts(map, chosen, decisions);
  return chosen;
}

std::string file_name_of(const Segment& segment) {
  std::string name;
  for (const char letter : segment.name) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) && byte < 128)
      name += static_cast<char>(std::tolower(byte));
    else if (letter == '-' || letter == '_')
      name += letter;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "label-" + std::to_string(segment.number) : name;
}

}  // namespace trocar
