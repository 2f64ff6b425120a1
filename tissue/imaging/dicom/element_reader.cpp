#include "tissue/imaging/dicom/element_reader.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_tags.h"

namespace trocar {
namespace {

constexpr int kDeepest = 12;
constexpr std::size_t kMostKept = 600000, kMostFragments = 200000;
constexpr std::uint32_t kLongestValue = 1024, kLongestTable = 1 << 17;

struct Wanted {
  DicomTag tag;
  char type;  ///< t text, w 16-bit numbers, l a long table of them, q sequence
};

constexpr Wanted kWanted[] = {
    {tag::kTransferSyntax, 't'},
    {tag::kDirectoryRecords, 'q'},
    {tag::kReferencedFile, 't'},
    {tag::kImageType, 't'},
    {tag::kSopClass, 't'},
    {tag::kSopInstance, 't'},
    {tag::kModality, 't'},
    {tag::kEchoTime, 't'},
    {tag::kEcho, 't'},
    {tag::kTrigger, 't'},
    {tag::kDiffusion, 't'},
    {tag::kAcquisition, 't'},
    {tag::kTemporalPosition, 't'},
    {tag::kStudy, 't'},
    {tag::kSeries, 't'},
    {tag::kSeriesNumber, 't'},
    {tag::kPosition, 't'},
    {tag::kOrientation, 't'},
    {tag::kFrameOfReference, 't'},
    {tag::kSamples, 'w'},
    {tag::kPhotometric, 't'},
    {tag::kFrames, 't'},
    {tag::kRows, 'w'},
    {tag::kColumns, 'w'},
    {tag::kPixelSpacing, 't'},
    {tag::kBitsAllocated, 'w'},
    {tag::kBitsStored, 'w'},
    {tag::kHighBit, 'w'},
    {tag::kPixelRepresentation, 'w'},
    {tag::kIntercept, 't'},
    {tag::kSlope, 't'},
    {tag::kLossy, 't'},
    {tag::kSharedGroups, 'q'},
    {tag::kFrameGroups, 'q'},
    {tag::kPlanePosition, 'q'},
    {tag::kPlaneOrientation, 'q'},
    {tag::kPixelMeasures, 'q'},
    {tag::kValueTransformation, 'q'},
    {tag::kSegmentationType, 't'},
    {tag::kMaximumFraction, 'w'},
    {tag::kPadding, 'w'},
    {tag::kSegments, 'q'},
    {tag::kSegmentNumber, 'w'},
    {tag::kSegmentLabel, 't'},
    {tag::kDisplayLab, 'w'},
    {tag::kSegmentIdentification, 'q'},
    {tag::kReferencedSegment, 'w'},
    {tag::kPropertyCategory, 'q'},
    {tag::kPropertyType, 'q'},
    {tag::kPropertyTypeModifier, 'q'},
    {tag::kAnatomicRegion, 'q'},
    {tag::kAnatomicRegionModifier, 'q'},
    {tag::kCodeValue, 't'},
    {tag::kCodeScheme, 't'},
    {tag::kCodeMeaning, 't'},
    {tag::kPaletteAbout, 'w'},
    {tag::kPaletteAbout + 1, 'w'},
    {tag::kPaletteAbout + 2, 'w'},
    {tag::kPalette, 'l'},
    {tag::kPalette + 1, 'l'},
    {tag::kPalette + 2, 'l'},
};

char wanted_type(DicomTag tag) {
  for (const Wanted& wanted : kWanted)
    if (wanted.tag == tag) return wanted.type;
  return 0;
}

bool known_vr(std::array<char, 2> vr) {
  constexpr std::string_view kAll =
      "AE AS AT CS DA DS DT FD FL IS LO LT OB OD OF OL OV OW PN SH SL SQ SS ST SV TM UC UI UL UN UR US UT UV";
  const std::size_t at = kAll.find(std::string_view(vr.data(), 2));
  return at != std::string_view::npos && at % 3 == 0;
}

bool long_vr(std::array<char, 2> vr) {
  constexpr std::string_view kLong = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
  const std::size_t at = kLong.find(std::string_view(vr.data(), 2));
  return at != std::string_view::npos && at % 3 == 0;
}

std::string printed(DicomTag tag) {
  char text[16];
  std::snprintf(text, sizeof text, "(%04x,%04x)", tag >> 16, tag & 0xFFFFU);
  return text;
}

bool delimiter(DicomTag tag) { return tag >> 16 == 0xFFFE; }

std::string trimmed_text(std::string text) {
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
}

}  // namespace

void ElementReader::damaged(DicomTag tag, const std::string& what) const {
  throw InputError(source_.name() + ": damaged DICOM: " + what + " at element " + printed(tag) +
                   "; copy or export it again");
}

std::uint32_t ElementReader::number(const unsigned char* bytes, int size) const {
  std::uint32_t value = 0;
  for (int n = 0; n < size; ++n) value = value << 8 | bytes[big_ ? n : size - 1 - n];
  return value;
}

void ElementReader::read_explicit_length(Head& head, const unsigned char* bytes, std::uint64_t at, std::uint64_t end) {
  head.vr = {static_cast<char>(bytes[4]), static_cast<char>(bytes[5])};
  if (!known_vr(head.vr)) damaged(head.tag, "no valid value representation");
  if (!long_vr(head.vr)) {
    head.length = number(bytes + 6, 2);
    return;
  }
  unsigned char length[4];
  if (end - at < 12 || !source_.read(at + 8, length, 4)) damaged(head.tag, "the file ends");
  head.length = number(length, 4);
  head.value_at = at + 12;
}

ElementReader::Head ElementReader::read_head(std::uint64_t at, std::uint64_t end) {
  unsigned char bytes[8];
  Head head;
  if (end < at || end - at < 8 || !source_.read(at, bytes, 8))
    throw InputError(source_.name() +
                     ": damaged DICOM: the file ends in the middle of an element; copy or export it again");
  head.tag = number(bytes, 2) << 16 | number(bytes + 2, 2);
  head.value_at = at + 8;
  head.length = number(bytes + 4, 4);
  if (explicit_ && !delimiter(head.tag)) read_explicit_length(head, bytes, at, end);
  return head;
}

void ElementReader::keep_value(DicomItem& item, const Head& head, char type) {
  if (head.length > (type == 'l' ? kLongestTable : kLongestValue))
    damaged(head.tag, "a value of " + std::to_string(head.length) + " bytes");
  if (++kept_ > kMostKept) damaged(head.tag, "more elements than a reader can hold");
  std::string value = source_.bytes(head.value_at, head.length);
  if (type == 't') value = trimmed_text(std::move(value));
  if (type != 't' && big_)
    for (std::size_t n = 0; n + 1 < value.size(); n += 2) std::swap(value[n], value[n + 1]);
  item.elements.try_emplace(head.tag, DicomElement{std::move(value), {}});
}

std::uint64_t ElementReader::read_element(DicomItem* item, const Head& head, std::uint64_t end, int depth) {
  const char type = item != nullptr ? wanted_type(head.tag) : '\0';
  if (!head.undefined() && head.length > end - head.value_at) damaged(head.tag, "the file ends inside the value");
  if (type == 'q' || head.undefined()) {
    DicomElement* element = nullptr;
    if (type == 'q') element = &item->elements.try_emplace(head.tag).first->second, element->items.clear();
    const bool was_explicit = explicit_, was_big = big_;
    if (explicit_ && head.is("UN")) explicit_ = false, big_ = false;  // PS3.5 6.2.2: such sequences are implicit
    const std::uint64_t after = read_sequence(element, head, end, depth);
    explicit_ = was_explicit, big_ = was_big;
    return after;
  }
  if (type != 0) keep_value(*item, head, type);
  return head.value_at + head.length;
}

std::uint64_t ElementReader::read_sequence(DicomElement* into, const Head& head, std::uint64_t end, int depth) {
  if (depth >= kDeepest) damaged(head.tag, "sequences nested too deep");
  const std::uint64_t stop = head.undefined() ? end : head.value_at + head.length;
  std::uint64_t at = head.value_at;
  while (at < stop) {
    const Head item = read_head(at, stop);
    if (item.tag == tag::kSequenceEnd && head.undefined()) return item.value_at;
    if (item.tag != tag::kItem) damaged(head.tag, "a sequence without items");
    if (++kept_ > kMostKept) damaged(head.tag, "more items than a reader can hold");
    DicomItem* kept = into != nullptr ? &into->items.emplace_back() : nullptr;
    at = read_item(kept, item, stop, depth + 1);
  }
  if (head.undefined()) damaged(head.tag, "a sequence without end");
  return stop;
}

std::uint64_t ElementReader::read_item(DicomItem* item, const Head& head, std::uint64_t end, int depth) {
  if (!head.undefined() && head.length > end - head.value_at) damaged(head.tag, "the file ends inside an item");
  const std::uint64_t stop = head.undefined() ? end : head.value_at + head.length;
  std::uint64_t at = head.value_at;
  if (item == nullptr && !head.undefined()) return stop;
  while (at < stop) {
    const Head element = read_head(at, stop);
    if (element.tag == tag::kItemEnd && head.undefined()) return element.value_at;
    if (delimiter(element.tag)) damaged(element.tag, "an item without end");
    at = read_element(item, element, stop, depth);
  }
  if (head.undefined()) damaged(head.tag, "an item without end");
  return stop;
}

void ElementReader::read_offset_table(const Head& head) {
  if (head.length % 4 != 0 || head.length > 4 * kMostFragments) damaged(tag::kPixels, "a broken table of frames");
  const std::string bytes = source_.bytes(head.value_at, head.length);
  for (std::size_t n = 0; n < bytes.size(); n += 4)
    pixels_.frame_offsets.push_back(number(reinterpret_cast<const unsigned char*>(bytes.data()) + n, 4));
}

void ElementReader::read_fragments(std::uint64_t at) {
  pixels_.offset = at;
  for (bool first = true;; first = false) {
    const Head head = read_head(at, source_.size());
    if (head.tag == tag::kSequenceEnd) break;
    if (head.tag != tag::kItem || head.undefined()) damaged(tag::kPixels, "compressed pixels that are not in items");
    if (head.length > source_.size() - head.value_at)
      damaged(tag::kPixels, "the file ends inside the compressed pixels");
    if (pixels_.fragments.size() >= kMostFragments) damaged(tag::kPixels, "more fragments than a reader can hold");
    if (first) read_offset_table(head);
    if (!first) pixels_.fragments.emplace_back(head.value_at, head.length);
    at = head.value_at + head.length;
  }
  pixels_.length = at - pixels_.offset;
}

void ElementReader::read_pixels(const Head& head) {
  pixels_.present = true;
  pixels_.floating = head.tag != tag::kPixels;
  pixels_.words = !explicit_ || head.is("OW");
  pixels_.encapsulated = head.undefined();
  pixels_.offset = head.value_at, pixels_.length = head.length;
  if (pixels_.encapsulated) read_fragments(head.value_at);
}

void ElementReader::read_all(DicomItem& data, std::uint64_t from) {
  for (std::uint64_t at = from; at < source_.size();) {
    const Head head = read_head(at, source_.size());
    if (head.tag >= tag::kFloatPixels && head.tag <= tag::kPixels) return read_pixels(head);
    if (delimiter(head.tag)) damaged(head.tag, "an end without a beginning");
    at = read_element(&data, head, source_.size(), 0);
  }
}

std::uint64_t ElementReader::read_group(DicomItem& data, std::uint64_t from, unsigned group) {
  std::uint64_t at = from;
  while (at < source_.size()) {
    unsigned char bytes[2];
    if (!source_.read(at, bytes, 2) || number(bytes, 2) != group) break;
    at = read_element(&data, read_head(at, source_.size()), source_.size(), 0);
  }
  return at;
}

}  // namespace trocar
