#include "tissue/imaging/labels/label_choice.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "haptics/input_error.h"

namespace trocar {
namespace {

std::optional<int> whole_label(std::string_view text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() ? std::optional<int>(number) : std::nullopt;
}

std::string joined_names(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

/// The name that the file or the table gives a segment: a person's own table comes first, a built-in one last.
std::string name_of(const Segment& segment, const LabelTable* table) {
  const auto by_table = table != nullptr ? table->name_of(segment.number) : std::nullopt;
  return by_table && (table->own || segment.name.empty()) ? std::string(*by_table) : segment.name;
}

Segment named(const Segment& segment, const LabelTable* table) {
  Segment called = segment;
  called.name = name_of(segment, table);
  return called;
}

[[noreturn]] void refuse_name(const LabelMap& map, std::string_view wanted, const LabelTable* table,
                              const std::string& file) {
  const std::string holds = "; it holds " + listed_segments(map, table);
  if (table != nullptr) {
    const auto number = table->number_of(wanted);
    throw InputError(file + ": " + in_quotes(wanted) +
                     (number ? " is number " + std::to_string(*number) + " in the table " + std::string(table->name) +
                                   ", which marks no voxel"
                             : " is no name in the table " + std::string(table->name)) +
                     holds);
  }
  std::vector<std::string> knowing;
  for (const std::string& name : label_table_names())
    if (const auto number = label_table(name).number_of(wanted))
      knowing.push_back(name + " (" + std::to_string(*number) + ")");
  throw InputError(file + ": " + in_quotes(wanted) + ": the file gives no such name" +
                   (knowing.empty() ? ", and no table that is known here does"
                                    : "; say which table its numbers follow with --label-table: " +
                                          joined_names(knowing) + " know it") +
                   holds);
}

/// "2 tumour (layer 1)"
std::string placed(const Segment& segment) {
  return std::to_string(segment.number) + (segment.name.empty() ? "" : " " + segment.name) + " (layer " +
         std::to_string(segment.layer) + ")";
}

/// How each of several candidates can be asked for: by its name where no other has it, else as LAYER:NUMBER.
std::string asked_as(const Segment& segment, const std::vector<Segment>& all) {
  const auto alike =
      std::count_if(all.begin(), all.end(), [&](const Segment& one) { return one.name == segment.name; });
  return segment.name.empty() || alike > 1 ? std::to_string(segment.layer) + ":" + std::to_string(segment.number)
                                           : in_quotes(segment.name);
}

Segment only_one(const std::vector<Segment>& found, std::string_view wanted, const std::string& file) {
  if (found.size() == 1) return found.front();
  std::string places, choices;
  for (const Segment& segment : found) {
    places += (places.empty() ? "" : ", ") + placed(segment);
    choices += (choices.empty() ? "" : " or ") + ("--label " + asked_as(segment, found));
  }
  throw InputError(file + ": " + in_quotes(wanted) + " means " + std::to_string(found.size()) + " segments: " + places +
                   "; choose one with " + choices);
}

}  // namespace

std::optional<std::pair<std::size_t, int>> layer_and_number(std::string_view wanted) {
  const std::size_t colon = wanted.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto layer = whole_label(wanted.substr(0, colon)), number = whole_label(wanted.substr(colon + 1));
  if (!layer || !number || *layer < 0) return std::nullopt;
  return std::pair(static_cast<std::size_t>(*layer), *number);
}

void require_agreement(const LabelMap& map, const LabelTable& table, const std::string& file) {
  if (table.own) return;
  for (const Segment& segment : map.segments) {
    const auto name = table.name_of(segment.number);
    if (segment.name.empty() || !name || folded_name(*name) == folded_name(segment.name)) continue;
    throw InputError(
        file + ": label " + std::to_string(segment.number) + " is " + in_quotes(segment.name) +
        " by the file's own names and " + in_quotes(*name) + " in the table " + std::string(table.name) +
        ": leave --label-table away to go by the file, or give a file of your own table, which goes first");
  }
}

std::vector<std::string> guess_label_table(const LabelMap& map) {
  std::vector<std::string> fitting;
  for (const std::string& name : label_table_names()) {
    const LabelTable& table = label_table(name);
    const bool fits = std::all_of(map.segments.begin(), map.segments.end(), [&](const Segment& segment) {
      return !segment.name.empty() || table.name_of(segment.number).has_value();
    });
    if (fits) fitting.push_back(name);
  }
  return fitting;
}

Segment choose_segment(const LabelMap& map, std::string_view wanted, const LabelTable* table, const std::string& file) {
  if (wanted.empty()) {
    if (map.segments.size() == 1) return named(map.segments.front(), table);
    throw InputError(file + ": holds " + std::to_string(map.segments.size()) + " segments: say which with --label; " +
                     listed_segments(map, table));
  }
  const bool is_name =
      std::any_of(map.segments.begin(), map.segments.end(), [&](const Segment& one) { return one.name == wanted; });
  if (const auto place = layer_and_number(wanted); place && !is_name) {
    for (const Segment& segment : map.segments)
      if (segment.layer == place->first && segment.number == place->second) return named(segment, table);
    throw InputError(file + ": layer " + std::to_string(place->first) + " holds no label " +
                     std::to_string(place->second) + "; there are " + listed_segments(map, table));
  }
  std::vector<Segment> found;
  const auto number = whole_label(wanted);
  for (const Segment& segment : map.segments)
    if (number ? segment.number == *number : name_of(segment, table) == wanted) found.push_back(named(segment, table));
  if (found.empty() && !number)  // "Liver" for "liver"
    for (const Segment& segment : map.segments)
      if (folded_name(name_of(segment, table)) == folded_name(wanted) && !folded_name(wanted).empty())
        found.push_back(named(segment, table));
  if (!found.empty()) return only_one(found, wanted, file);
  if (number)
    throw InputError(file + ": label " + std::to_string(*number) + " marks no voxel; it holds " +
                     listed_segments(map, table));
  refuse_name(map, wanted, table, file);
}

std::string listed_segments(const LabelMap& map, const LabelTable* table, std::size_t most) {
  std::vector<std::string> words;
  for (const Segment& segment : map.segments) {
    const std::string name = name_of(segment, table);
    words.push_back(std::to_string(segment.number) + (name.empty() ? "" : " " + name));
  }
  return listed_words(words, most);
}

}  // namespace trocar
