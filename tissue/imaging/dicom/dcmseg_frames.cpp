#include "tissue/imaging/dicom/dcmseg_frames.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <cctype>
#include <memory>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/dicom/dcmtk_silence.h"
#include "tissue/imaging/dicom/packed_bytes.h"

namespace trocar {
namespace {

std::string label_of(DcmSegment& segment) {
  OFString label;
  segment.getSegmentLabel(label);
  std::string text(label.c_str());
  for (char& letter : text)
    if (std::iscntrl(static_cast<unsigned char>(letter)) != 0) letter = ' ';
  return text.substr(0, 64);  // what the standard allows
}

/// Bytes of values to bits, from one half of the maximum on.
std::string thresholded(const DcmIODTypes::Frame& frame, unsigned maximum) {
  std::string bits((frame.length + 7) / 8, '\0');
  for (std::size_t n = 0; n < frame.length; ++n)
    if (2U * frame.pixData[n] >= maximum && frame.pixData[n] != 0) bits[n / 8] = static_cast<char>(bits[n / 8] | 1 << n % 8);
  return bits;
}

std::string packed(DcmSegmentation& object, unsigned maximum) {
  PackedWriter out;
  const std::size_t segments = object.getNumberOfSegments(), frames = object.getNumberOfFrames();
  const bool fractional = object.getSegmentationType() == DcmSegTypes::ST_FRACTIONAL;
  std::vector<int> segment_of(frames, 0);
  out.put(static_cast<std::uint8_t>(fractional));
  out.put(static_cast<std::uint64_t>(segments));
  for (std::size_t n = 1; n <= segments; ++n) {
    DcmSegment* segment = object.getSegment(n);
    out.put(static_cast<std::int32_t>(n));
    out.put_text(segment != nullptr ? label_of(*segment) : "");
    OFVector<std::size_t> of_segment;
    object.getFramesForSegment(n, of_segment);
    for (const std::size_t frame : of_segment)
      if (frame < frames) segment_of[frame] = static_cast<int>(n);
  }
  out.put(static_cast<std::uint64_t>(frames));
  for (std::size_t n = 0; n < frames; ++n) {
    const DcmIODTypes::Frame* frame = object.getFrame(n);
    out.put(static_cast<std::int32_t>(segment_of[n]));
    if (frame == nullptr || frame->pixData == nullptr) throw std::runtime_error("a frame is missing");
    out.put_text(fractional ? thresholded(*frame, maximum) : std::string(reinterpret_cast<const char*>(frame->pixData), frame->length));
  }
  return out.take();
}

std::string load(const std::filesystem::path& path, const std::string& name) {
  silence_dcmtk();
  DcmRLEDecoderRegistration::registerCodecs();
  DcmFileFormat file;
  DcmSegmentation* loaded = nullptr;
  OFCondition condition = file.loadFile(OFFilename(path.c_str()));
  Uint16 maximum = 255;
  if (condition.good()) file.getDataset()->findAndGetUint16(DCM_MaximumFractionalValue, maximum);
  if (condition.good()) condition = DcmSegmentation::loadDataset(*file.getDataset(), loaded);
  const std::unique_ptr<DcmSegmentation> object(loaded);
  if (condition.bad() || object == nullptr) throw InputError(name + ": dcmseg refuses this segmentation: " + std::string(condition.text()));
  return packed(*object, maximum == 0 ? 255 : maximum);
}

}  // namespace

SegmentationFrames read_segmentation_frames(const std::filesystem::path& path, const std::string& name, const Progress& progress) {
  const std::string bytes = in_child(name, ChildLimits{std::uint64_t{3} << 29, 300}, progress, [&] { return load(path, name); });
  PackedReader in(bytes, name);
  SegmentationFrames frames;
  frames.fractional = in.get<std::uint8_t>() != 0;
  for (std::uint64_t left = in.get_count(12); left > 0; --left) {
    const int number = in.get<std::int32_t>();
    frames.segments.push_back({number, std::string(in.get_text())});
  }
  for (std::uint64_t left = in.get_count(12); left > 0; --left) {
    frames.segment_of.push_back(in.get<std::int32_t>());
    frames.bits.emplace_back(in.get_text());
  }
  return frames;
}

}  // namespace trocar
