#include <algorithm>
#include <charconv>
#include <map>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/nrrd_header.h"

namespace trocar {
namespace {

struct SegmentEntry {
  std::optional<int> number, layer;
  std::string name;
  int line = 0;
};

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && stop == text.data() + text.size() ? std::optional<int>(value) : std::nullopt;
}

/// A name for a person to read: no control characters, not longer than a line.
std::string readable(std::string text) {
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < ' ' || letter == 0x7f) letter = ' ';
  if (text.size() > 80) text.resize(80);
  return text;
}

int wanted_number(const NrrdFields& header, const std::string& key, const NrrdText& value, int least, int most) {
  const auto number = whole_number(value.text);
  if (!number || *number < least || *number > most)
    throw InputError(header.file, value.line, 1,
                     key + ": no whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return *number;
}

/// Keys "Segment12_Name" by their number.
std::map<int, SegmentEntry> entries_of(const NrrdFields& header) {
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
    if (what == "Name") entry.name = readable(value.text);
    if (what == "LabelValue") entry.number = wanted_number(header, key, value, 1, 65535);
    if (what == "Layer") entry.layer = wanted_number(header, key, value, 0, 65535);
  }
  return entries;
}

}  // namespace

std::vector<NamedSegment> nrrd_segments(const NrrdFields& header, int components) {
  const std::map<int, SegmentEntry> entries = entries_of(header);
  std::vector<NamedSegment> segments;
  for (const auto& [index, entry] : entries) {
    const bool old_style = !entry.layer && !entry.number && components > 1;  // before Slicer 4.11: one component each
    const int number = entry.number.value_or(old_style || components > 1 ? 1 : index + 1);
    const int layer = entry.layer.value_or(old_style ? index : 0);
    if (layer >= components)
      throw InputError(header.file, entry.line, 1,
                       "Segment" + std::to_string(index) + "_Layer: layer " + std::to_string(layer) + " of " +
                           std::to_string(components));
    for (const NamedSegment& other : segments)
      if (other.number == number && other.layer == static_cast<std::size_t>(layer))
        throw InputError(header.file, entry.line, 1,
                         "Segment" + std::to_string(index) + "_LabelValue: another segment has number " +
                             std::to_string(number) + " in that layer");
    segments.push_back({number, static_cast<std::size_t>(layer), entry.name});
  }
  return segments;
}

}  // namespace trocar
