#include "tissue/imaging/dicom/dcmseg_frames.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmiod/cielabutil.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <algorithm>
#include <memory>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/dicom/dcmtk_silence.h"
#include "tissue/imaging/dicom/packed_bytes.h"
#include "tissue/imaging/dicom/packed_segment.h"

namespace trocar {
namespace {

std::string text_of(const OFString& text) { return readable_name(text.c_str()); }

void add_code(std::vector<SegmentCode>& codes, const char* role, CodeSequenceMacro* code) {
  if (code == nullptr) return;
  OFString scheme, value, meaning;
  code->getCodingSchemeDesignator(scheme);
  code->getCodeValue(value);
  code->getCodeMeaning(meaning);
  if (!value.empty()) codes.push_back({role, text_of(scheme), text_of(value), text_of(meaning)});
}

/// "RecommendedDisplayCIELabValue" as sRGB.
std::optional<SegmentColour> colour_of_segment(DcmSegment& segment) {
  Uint16 lightness = 0, a = 0, b = 0;
  if (segment.getRecommendedDisplayCIELabValue(lightness, a, b).bad()) return std::nullopt;
  double red = 0, green = 0, blue = 0;
  IODCIELabUtil::dicomLab2RGB(red, green, blue, lightness, a, b);
  const auto within = [](double part) { return std::clamp(part, 0.0, 1.0); };
  return colour_of(within(red), within(green), within(blue));
}

Segment described(DcmSegment& segment, int number) {
  OFString label;
  segment.getSegmentLabel(label);
  Segment told{0, number, text_of(label), colour_of_segment(segment), {}};
  add_code(told.codes, "category", &segment.getSegmentedPropertyCategoryCode());
  add_code(told.codes, "type", &segment.getSegmentedPropertyTypeCode());
  for (CodeSequenceMacro* code : segment.getSegmentedPropertyTypeModifierCode())
    add_code(told.codes, "type modifier", code);
  add_code(told.codes, "region", &segment.getGeneralAnatomyCode().getAnatomicRegion());
  for (CodeSequenceMacro* code : segment.getGeneralAnatomyCode().getAnatomicRegionModifier())
    add_code(told.codes, "region modifier", code);
  return told;
}

void pack_segments(PackedWriter& out, DcmSegmentation& object, std::vector<int>& segment_of) {
  const std::size_t segments = object.getNumberOfSegments();
  out.put(static_cast<std::uint64_t>(segments));
  for (std::size_t n = 1; n <= segments; ++n) {
    DcmSegment* segment = object.getSegment(n);
    const int number = static_cast<int>(n);
    put_segment(out, segment != nullptr ? described(*segment, number) : Segment{0, number});
    OFVector<std::size_t> of_segment;
    object.getFramesForSegment(n, of_segment);
    for (const std::size_t frame : of_segment)
      if (frame < segment_of.size()) segment_of[frame] = static_cast<int>(n);
  }
}

std::string packed(DcmSegmentation& object, bool with_pixels) {
  PackedWriter out;
  std::vector<int> segment_of(object.getNumberOfFrames(), 0);
  pack_segments(out, object, segment_of);
  out.put(static_cast<std::uint64_t>(segment_of.size()));
  for (std::size_t n = 0; n < segment_of.size(); ++n) {
    const DcmIODTypes::Frame* frame = with_pixels ? object.getFrame(n) : nullptr;
    if (with_pixels && (frame == nullptr || frame->pixData == nullptr)) throw std::runtime_error("a frame is missing");
    out.put(static_cast<std::int32_t>(segment_of[n]));
    out.put_text(with_pixels ? std::string_view(reinterpret_cast<const char*>(frame->pixData), frame->length)
                             : std::string_view());
  }
  return out.take();
}

std::string load(const std::filesystem::path& path, const std::string& name, bool with_pixels) {
  silence_dcmtk();
  DcmRLEDecoderRegistration::registerCodecs();
  DcmSegmentation* loaded = nullptr;
  const OFCondition condition = DcmSegmentation::loadFile(path.c_str(), loaded);
  const std::unique_ptr<DcmSegmentation> object(loaded);
  if (condition.bad() || object == nullptr)
    throw InputError(name + ": dcmseg refuses this segmentation: " + std::string(condition.text()));
  return packed(*object, with_pixels);
}

}  // namespace

SegmentationFrames read_segmentation_frames(const std::filesystem::path& path, const std::string& name,
                                            bool with_pixels, const Progress& progress) {
  load_dcmtk_dictionary();
  const std::string bytes =
      in_child(name, ChildLimits{std::uint64_t{3} << 29, 300}, progress, [&] { return load(path, name, with_pixels); });
  PackedReader in(bytes, name);
  SegmentationFrames frames;
  for (std::uint64_t left = in.get_count(12); left > 0; --left) {
    frames.segments.push_back(get_segment(in));
  }
  for (std::uint64_t left = in.get_count(12); left > 0; --left) {
    frames.segment_of.push_back(in.get<std::int32_t>());
    frames.values.emplace_back(in.get_text());
  }
  return frames;
}

}  // namespace trocar
