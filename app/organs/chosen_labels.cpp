#include "app/organs/chosen_labels.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <set>

#include "haptics/input_error.h"
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

/// Numbers 1, 2, ... n: whoever drew them counted, and no table numbered them.
bool counted(const LabelMap& map) {
  int next = 1;
  for (const Segment& segment : map.segments)
    if (segment.number != next++) return false;
  return true;
}

/// Built-in tables that a bare map may have been numbered by: those that name every number of it.
std::vector<const LabelTable*> candidates(const LabelMap& map) {
  std::vector<const LabelTable*> tables;
  if (counted(map)) return tables;
  for (const std::string& name : label_table_names()) {
    const LabelTable& table = label_table(name);
    const bool fits = std::all_of(map.segments.begin(), map.segments.end(), [&](const Segment& segment) {
      return !segment.name.empty() || table.name_of(segment.number).has_value();
    });
    if (fits) tables.push_back(&table);
  }
  return tables;
}

std::string listed_names(const std::vector<const LabelTable*>& tables) {
  std::string text;
  for (const LabelTable* table : tables) text += (text.empty() ? "" : ", ") + std::string(table->name);
  return text;
}

/// What all candidates call this number; empty when they differ or there is none.
std::optional<std::string> agreed_name(const std::vector<const LabelTable*>& tables, int number) {
  std::set<std::string> names;
  for (const LabelTable* table : tables) names.insert(std::string(table->name_of(number).value_or("")));
  return names.size() == 1 && !names.begin()->empty() ? std::optional<std::string>(*names.begin()) : std::nullopt;
}

/// Every built-in table, for a name in a map whose numbers no single table knows; none for a counted map.
std::vector<const LabelTable*> all_tables(const LabelMap& map) {
  std::vector<const LabelTable*> tables;
  if (!counted(map))
    for (const std::string& name : label_table_names()) tables.push_back(&label_table(name));
  return tables;
}

/// The number that all candidates give this name. @throws InputError when they know it and differ
std::optional<int> agreed_number(const std::vector<const LabelTable*>& tables, const std::string& name,
                                 const std::string& file) {
  std::set<int> numbers;
  std::string said;
  for (const LabelTable* table : tables)
    if (const auto number = table->number_of(name)) {
      numbers.insert(*number);
      said += (said.empty() ? "" : ", ") + std::to_string(*number) + " in " + std::string(table->name);
    }
  if (numbers.size() > 1)
    throw InputError(file + ": --label " + name + ": the map has numbers only, and " + name + " is " + said +
                     ": say which table numbered it with --label-table");
  return numbers.empty() ? std::nullopt : std::optional<int>(*numbers.begin());
}

bool is_number(const std::string& text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size();
}

/// Asked for by number, or by layer and number: not by a name.
bool is_numeric(const std::string& text) { return is_number(text) || layer_and_number(text).has_value(); }

bool named_in_file(const LabelMap& map, const std::string& name) {
  return std::any_of(map.segments.begin(), map.segments.end(),
                     [&](const Segment& segment) { return segment.name == name; });
}

class Chooser {
 public:
  Chooser(const LabelMap& map, const std::string& file, const NamedTable& named, std::vector<std::string>& decisions)
      : map_(map), file_(file), named_(named), decisions_(decisions) {
    if (!named.table) assumed_ = candidates(map);
  }

  ChosenLabel choose(const std::string& wanted) {
    std::string asked = wanted;
    if (!named_.table && named_by_user(wanted) && !named_in_file(map_, wanted))
      if (const auto number = agreed_number(assumed_.empty() ? all_tables(map_) : assumed_, wanted, file_))
        asked = std::to_string(*number);
    require_marked(asked, wanted);
    ChosenLabel chosen{segment(asked, wanted), named_.table ? named_.name : ""};
    if (!named_.table) name_by_agreement(chosen, wanted);
    const bool from_file = std::any_of(map_.segments.begin(), map_.segments.end(), [&](const Segment& s) {
      return s.layer == chosen.segment.layer && s.number == chosen.segment.number && !s.name.empty();
    });
    if (from_file || chosen.segment.name.empty()) chosen.table.clear();
    return chosen;
  }

 private:
  /// A number that marks no voxel, with the name that led to it.
  void require_marked(const std::string& asked, const std::string& wanted) const {
    const auto meant = [&](const Segment& segment) {
      return std::to_string(segment.number) == asked || segment.name == asked;
    };
    if (!is_number(asked) || std::any_of(map_.segments.begin(), map_.segments.end(), meant)) return;
    throw InputError(file_ + ": label " + asked + (asked == wanted ? "" : " (" + wanted + ")") +
                     " marks no voxel; the map holds " + listed_segments(map_, named_.table));
  }

  Segment segment(const std::string& asked, const std::string& wanted) const {
    try {
      return choose_segment(map_, asked, named_.table, file_);
    } catch (const InputError& error) {
      throw InputError(std::string(error.what()) + (wanted.empty() ? "" : " (--label " + wanted + ")"));
    }
  }

  static bool named_by_user(const std::string& wanted) { return !wanted.empty() && !is_numeric(wanted); }

  void name_by_agreement(ChosenLabel& chosen, const std::string& wanted) {
    if (!chosen.segment.name.empty() || (map_.segments.size() == 1 && !named_by_user(wanted))) return;
    const auto name =
        named_by_user(wanted) ? std::optional<std::string>(wanted) : agreed_name(assumed_, chosen.segment.number);
    if (!name) {
      decisions_.push_back("label " + std::to_string(chosen.segment.number) +
                           " stays without a name: the map has numbers only and no table was named (--label-table)");
      return;
    }
    chosen.segment.name = *name;
    chosen.table = listed_names(assumed_.empty() ? all_tables(map_) : assumed_);
    decisions_.push_back("label " + std::to_string(chosen.segment.number) + " is \"" + *name +
                         "\" in every table that could have numbered this map (" + chosen.table +
                         "), which was assumed");
  }

  const LabelMap& map_;
  const std::string& file_;
  const NamedTable& named_;
  std::vector<std::string>& decisions_;
  std::vector<const LabelTable*> assumed_;
};

/// A label of a few voxels cannot be meshed; among all labels of a map it is left out instead of stopping the rest.
bool too_small(const LabelMap& map, const Segment& segment, bool only_largest) {
  try {
    cut_out_label(map.layers[segment.layer], segment.number, 1, {.only_largest = only_largest});
    return false;
  } catch (const InputError&) {
    return true;
  }
}

void refuse_twice(const std::vector<ChosenLabel>& chosen, const std::string& file) {
  std::set<std::pair<std::size_t, int>> seen;
  std::set<std::string> names;
  for (const ChosenLabel& label : chosen) {
    const std::string name = file_name_of(label.segment);
    if (!seen.insert({label.segment.layer, label.segment.number}).second)
      throw InputError(file + ": --label: label " + std::to_string(label.segment.number) + " was asked for twice");
    if (!names.insert(name).second)
      throw InputError(file + ": two of the labels would both be written as \"" + name +
                       "\"; import each by itself: --label " + std::to_string(label.segment.layer) + ":" +
                       std::to_string(label.segment.number) + " and the other");
  }
}

}  // namespace

std::vector<ChosenLabel> choose_labels(const OrganImportOptions& options, const LabelMap& map, const std::string& file,
                                       std::vector<std::string>& decisions) {
  const NamedTable named = named_table(options.label_table);
  Chooser chooser(map, file, named, decisions);
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
      chosen.push_back(chooser.choose(std::to_string(segment.layer) + ":" + std::to_string(segment.number)));
    }
    if (chosen.empty()) throw InputError(file + ": no label of it has a piece of 8 voxels");
  } else if (options.label.empty()) {
    if (map.segments.size() > 1)
      throw InputError(file + ": holds labels " + listed_segments(map, named.table) +
                       ": say which with --label, or --all");
    chosen.push_back(chooser.choose(""));
  } else {
    for (const std::string& wanted : options.label) chosen.push_back(chooser.choose(wanted));
  }
  refuse_twice(chosen, file);
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
