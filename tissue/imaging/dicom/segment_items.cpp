#include "tissue/imaging/dicom/segment_items.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmiod/cielabutil.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_instance.h"
#include "tissue/imaging/dicom/dicom_tags.h"

namespace trocar {
namespace {

/// A 16-bit word of an element's value; 0 where it ends before.
unsigned word_at(const std::string& value, std::size_t n) {
  if (value.size() < 2 * n + 2) return 0;
  return static_cast<unsigned char>(value[2 * n]) | static_cast<unsigned>(static_cast<unsigned char>(value[2 * n + 1]))
                                                        << 8;
}

void add_codes(Segment& segment, const DicomItem& item, DicomTag sequence, const char* role) {
  const DicomElement* codes = item.find(sequence);
  if (codes == nullptr) return;
  for (const DicomItem& code : codes->items)
    if (const std::string value = readable_name(code.text(tag::kCodeValue)); !value.empty())
      segment.codes.push_back(
          {role, readable_name(code.text(tag::kCodeScheme)), value, readable_name(code.text(tag::kCodeMeaning))});
}

/// "RecommendedDisplayCIELabValue" as sRGB.
std::optional<SegmentColour> lab_colour(const DicomItem& item) {
  const std::string value = item.text(tag::kDisplayLab);
  if (value.size() < 6) return std::nullopt;
  double red = 0, green = 0, blue = 0;
  IODCIELabUtil::dicomLab2RGB(red, green, blue, static_cast<std::uint16_t>(word_at(value, 0)),
                              static_cast<std::uint16_t>(word_at(value, 1)),
                              static_cast<std::uint16_t>(word_at(value, 2)));
  const auto within = [](double part) { return std::clamp(part, 0.0, 1.0); };
  return colour_of(within(red), within(green), within(blue));
}

/// The colour that the file's palette gives a pixel value; nothing when it has none (segmented tables are not read).
std::optional<SegmentColour> palette_colour(const DicomItem& data, int pixel) {
  SegmentColour colour{};
  for (unsigned part = 0; part < 3; ++part) {
    const std::string about = data.text(tag::kPaletteAbout + part), entries = data.text(tag::kPalette + part);
    const std::size_t count = word_at(about, 0) == 0 ? 65536 : word_at(about, 0);
    const std::size_t width = word_at(about, 2) == 16 ? 2 : 1;
    if (about.size() < 6 || entries.size() < count * width) return std::nullopt;
    const long entry = std::clamp<long>(pixel - static_cast<long>(word_at(about, 1)), 0, static_cast<long>(count) - 1);
    colour[part] = static_cast<std::uint8_t>(entries[static_cast<std::size_t>(entry) * width + width - 1]);
  }
  return colour;
}

Segment described(const DicomItem& item, const DicomItem& data) {
  Segment segment{0, static_cast<int>(std::min(item.whole(tag::kSegmentNumber).value_or(0), 65536U)),
                  readable_name(item.text(tag::kSegmentLabel)), lab_colour(item)};
  if (!segment.colour) segment.colour = palette_colour(data, segment.number);
  add_codes(segment, item, tag::kPropertyCategory, "category");
  add_codes(segment, item, tag::kPropertyType, "type");
  if (const DicomItem* type = item.first_item(tag::kPropertyType))
    add_codes(segment, *type, tag::kPropertyTypeModifier, "type modifier");
  add_codes(segment, item, tag::kAnatomicRegion, "region");
  if (const DicomItem* region = item.first_item(tag::kAnatomicRegion))
    add_codes(segment, *region, tag::kAnatomicRegionModifier, "region modifier");
  return segment;
}

}  // namespace

std::vector<Segment> described_segments(const DicomItem& data, const std::string& name) {
  const DicomElement* items = data.find(tag::kSegments);
  if (items == nullptr || items->items.empty()) throw InputError(name + ": describes no segment (SegmentSequence)");
  std::vector<Segment> segments;
  for (const DicomItem& item : items->items) {
    if (item.find(tag::kSegmentNumber) == nullptr)
      throw InputError(name + ": describes a segment without a number (SegmentNumber)");
    segments.push_back(described(item, data));
  }
  std::stable_sort(segments.begin(), segments.end(),
                   [](const Segment& a, const Segment& b) { return a.number < b.number; });
  const auto twice = std::adjacent_find(segments.begin(), segments.end(),
                                        [](const Segment& a, const Segment& b) { return a.number == b.number; });
  if (twice != segments.end())
    throw InputError(name + ": describes segment " + std::to_string(twice->number) + " twice (" + twice->name +
                     " and " + (twice + 1)->name + ")");
  return segments;
}

std::vector<int> frame_segments(const DicomItem& data, std::size_t frames) {
  std::vector<int> numbers(frames, -1);
  for (std::size_t frame = 0; frame < frames; ++frame)
    if (const DicomItem* group = frame_group(data, frame, tag::kSegmentIdentification))
      if (const auto number = group->whole(tag::kReferencedSegment)) numbers[frame] = static_cast<int>(*number);
  return numbers;
}

}  // namespace trocar
