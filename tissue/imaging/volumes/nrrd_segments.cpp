#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <sstream>

#include "haptics/input_error.h"
#include "haptics/utf8.h"
#include "tissue/imaging/volumes/nrrd_header.h"

namespace trocar {
namespace {

struct SegmentEntry {
  std::optional<int> number, layer;
  Segment told;  ///< name, colour and codes
  int line = 0;
};

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size() ? std::optional<int>(value) : std::nullopt;
}

/// "0.5 0.2 1": parts of one. An unreadable colour is none.
std::optional<SegmentColour> colour_in(const std::string& text) {
  std::istringstream in(text);
  double red = -1, green = -1, blue = -1;
  in >> red >> green >> blue;
  return in ? colour_of(red, green, blue) : std::nullopt;
}

std::vector<std::string> parts_at(std::string_view text, char mark) {
  std::vector<std::string> parts(1);
  for (const char letter : text) {
    if (letter == mark)
      parts.emplace_back();
    else
      parts.back() += letter;
  }
  return parts;
}

/// The tag "TerminologyEntry" as 3D Slicer writes it: CONTEXT~category~type~modifier~CONTEXT~region~modifier, each a
/// code SCHEME^VALUE^MEANING.
std::vector<SegmentCode> codes_in(const std::string& tags) {
  constexpr std::string_view kTag = "TerminologyEntry:";
  constexpr std::array<const char*, 7> kRoles{"", "category", "type", "type modifier", "", "region", "region modifier"};
  std::vector<SegmentCode> codes;
  const std::size_t at = tags.find(kTag);
  if (at == std::string::npos) return codes;
  const std::size_t from = at + kTag.size(), end = std::min(tags.find('|', from), tags.size());
  const std::vector<std::string> entries = parts_at(std::string_view(tags).substr(from, end - from), '~');
  for (std::size_t n = 0; n < std::min(entries.size(), kRoles.size()); ++n) {
    const std::vector<std::string> code = parts_at(entries[n], '^');
    if (*kRoles[n] != 0 && code.size() == 3 && !code[1].empty())
      codes.push_back({kRoles[n], readable_name(code[0]), readable_name(code[1]), readable_name(code[2])});
  }
  return codes;
}

/// The name as it is shown; what was changed in it is told.
std::string told_name(const std::string& key, const std::string& text, std::vector<std::string>& notes) {
  if (!is_utf8(text)) {
    notes.push_back(key + ": the name is not UTF-8, as organ files are: the segment has none");
    return "";
  }
  std::string name = readable_name(text);
  if (harmless(text) != text) notes.push_back(key + ": blanks stand for control characters: \"" + name + "\"");
  const std::size_t last = text.find_last_not_of(' ');
  if (last != std::string::npos && last >= kReadableBytes)
    notes.push_back(key + ": the name is longer than " + std::to_string(kReadableBytes) + " bytes, and was cut to \"" +
                    name + "\"");
  return name;
}

int wanted_number(const NrrdFields& header, const std::string& key, const NrrdText& value, int least, int most) {
  const auto number = whole_number(value.text);
  if (!number || *number < least || *number > most)
    throw InputError(header.file, value.line, 1,
                     key + ": no whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return *number;
}

/// Keys "Segment12_Name" by their number.
std::map<int, SegmentEntry> entries_of(const NrrdFields& header, std::vector<std::string>& notes) {
  constexpr std::string_view kPrefix = "Segment";
  std::map<int, SegmentEntry> entries;
  for (const auto& [key, value] : header.keys) {
    const auto bar = key.find('_');
    if (!key.starts_with(kPrefix) || bar == std::string::npos) continue;
    const auto index = whole_number(std::string_view(key).substr(kPrefix.size(), bar - kPrefix.size()));
    if (!index || *index < 0) continue;  // "Segmentation_..." is about all of them
    const std::string what = key.substr(bar + 1);
    SegmentEntry& entry = entries[*index];
    entry.line = std::max(entry.line, value.line);
    if (what == "Name") entry.told.name = told_name(key, value.text, notes);
    if (what == "Color") entry.told.colour = colour_in(value.text);
    if (what == "Tags" && is_utf8(value.text)) entry.told.codes = codes_in(value.text);
    if (what == "Tags" && !is_utf8(value.text)) notes.push_back(key + ": not UTF-8: its codes are left out");
    if (what == "LabelValue") entry.number = wanted_number(header, key, value, 1, 65535);
    if (what == "Layer") entry.layer = wanted_number(header, key, value, 0, 65535);
  }
  return entries;
}

}  // namespace

std::vector<Segment> nrrd_segments(const NrrdFields& header, int components, std::vector<std::string>& notes) {
  const std::map<int, SegmentEntry> entries = entries_of(header, notes);
  std::vector<Segment> segments;
  for (const auto& [index, entry] : entries) {
    const bool old_style = !entry.layer && !entry.number && components > 1;  // before Slicer 4.11: one component each
    if (!entry.number && components == 1 && entries.size() > 1) {
      notes.push_back("Segment" + std::to_string(index) + " (\"" + entry.told.name +
                      "\") has no LabelValue: which number is meant cannot be told, and none was given its name");
      continue;
    }
    Segment segment = entry.told;
    segment.number = entry.number.value_or(components == 1 ? kAnyNumber : 1);
    segment.layer = static_cast<std::size_t>(entry.layer.value_or(old_style ? index : 0));
    if (segment.layer >= static_cast<std::size_t>(components))
      throw InputError(header.file, entry.line, 1,
                       "Segment" + std::to_string(index) + "_Layer: layer " + std::to_string(segment.layer) + " of " +
                           std::to_string(components));
    for (const Segment& other : segments)
      if (other.number == segment.number && other.layer == segment.layer)
        throw InputError(header.file, entry.line, 1,
                         "Segment" + std::to_string(index) + "_LabelValue: another segment has number " +
                             std::to_string(segment.number) + " in that layer");
    segments.push_back(std::move(segment));
  }
  return segments;
}

}  // namespace trocar
