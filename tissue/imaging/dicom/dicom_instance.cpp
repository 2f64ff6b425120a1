#include "tissue/imaging/dicom/dicom_instance.h"

#include <algorithm>
#include <charconv>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_tags.h"

namespace trocar {
namespace {

constexpr int kLargestEdge = 8192;

/// Modalities that may be named in output (PS3.3 C.7.3.1.1.1): a fixed list, so that no free text leaves the file.
std::string known_modality(const std::string& text) {
  constexpr std::string_view kKnown[] = {
      "CT", "MR", "PT",  "NM",  "US",       "CR",     "DX",     "XA",      "RF",       "MG",  "OT",  "SC", "SR",
      "PR", "KO", "REG", "SEG", "RTSTRUCT", "RTDOSE", "RTPLAN", "RTIMAGE", "RTRECORD", "DOC", "ECG", "ES", "XC"};
  return std::find(std::begin(kKnown), std::end(kKnown), text) != std::end(kKnown) ? text : "unknown";
}

DicomKind kind_of(const DicomFile& file, const std::string& modality) {
  const std::string sop = file.data.text(tag::kSopClass);
  const bool label_map = sop == "1.2.840.10008.5.1.4.1.1.66.7";
  if (sop == "1.2.840.10008.5.1.4.1.1.66.4" || label_map || (sop.empty() && modality == "SEG"))
    return DicomKind::kSegmentation;
  if (sop == "1.2.840.10008.5.1.4.1.1.481.3" || (sop.empty() && modality == "RTSTRUCT"))
    return DicomKind::kStructureSet;
  const bool measure = modality == "RTDOSE" || modality == "REG" || sop.starts_with("1.2.840.10008.5.1.4.1.1.66.");
  const bool image = file.data.whole(tag::kRows).value_or(0) > 0 && file.data.whole(tag::kColumns).value_or(0) > 0;
  return image && !measure ? DicomKind::kImage : DicomKind::kOther;
}

/// 1 when the element is missing; nullopt when it is no whole number from 1 on.
std::optional<int> frame_count(const DicomItem& data) {
  const std::string text = data.text(tag::kFrames);
  if (text.empty()) return 1;
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1) return {};
  return count;
}

int small(std::optional<std::uint32_t> number) {
  return static_cast<int>(std::min<std::uint32_t>(number.value_or(0), 65535));
}

struct Check {
  const DicomFile& file;
  const std::string& name;

  void require(bool holds, const std::string& what) const {
    if (!holds) throw InputError(name + ": " + what);
  }

  void sizes(DicomImage& image) const {
    image.rows = small(file.data.whole(tag::kRows)), image.columns = small(file.data.whole(tag::kColumns));
    require(image.rows > 0 && image.columns > 0,
            "holds no image (Rows or Columns is missing): a report, plan or list has no volume");
    require(image.rows <= kLargestEdge && image.columns <= kLargestEdge, "claims " + std::to_string(image.rows) +
                                                                             " x " + std::to_string(image.columns) +
                                                                             " pixels: more than 8192 along an edge");
    const auto frames = frame_count(file.data);
    require(frames.has_value(), "NumberOfFrames is not a whole number from 1 on");
    image.frames = *frames;
    const std::uint64_t voxels = static_cast<std::uint64_t>(image.rows) * static_cast<std::uint64_t>(image.columns) *
                                 static_cast<std::uint64_t>(image.frames);
    require(voxels <= kMostVoxels,
            "claims " + std::to_string(voxels) + " voxels: more than an import may hold (268 million)");
  }

  void grey_values(DicomImage& image) const {
    const std::string photometric = file.data.text(tag::kPhotometric);
    const bool colour = file.data.whole(tag::kSamples).value_or(1) != 1 || photometric.starts_with("RGB") ||
                        photometric.starts_with("YBR") || photometric.starts_with("PALETTE");
    require(!colour, "is a colour image: organs are read from grey values as a scanner measures them");
    require(photometric == "MONOCHROME1" || photometric == "MONOCHROME2",
            "PhotometricInterpretation is neither MONOCHROME1 nor MONOCHROME2");
    image.inverted = photometric == "MONOCHROME1";
    PixelFormat& format = image.format;
    format.allocated = small(file.data.whole(tag::kBitsAllocated)),
    format.stored = small(file.data.whole(tag::kBitsStored));
    require(format.allocated != 1, "holds 1-bit pixels: a mask, not an image; a segmentation object is read as such");
    require(format.allocated == 8 || format.allocated == 16 || format.allocated == 32,
            "BitsAllocated is " + std::to_string(format.allocated) + ": only 8, 16 and 32 are read");
    const int high =
        file.data.find(tag::kHighBit) != nullptr ? small(file.data.whole(tag::kHighBit)) : format.stored - 1;
    format.high_bit = high;
    require(
        format.stored >= 1 && format.stored <= format.allocated && high < format.allocated && high + 1 >= format.stored,
        "BitsStored and HighBit do not fit into BitsAllocated");
    const std::uint32_t sign = file.data.whole(tag::kPixelRepresentation).value_or(0);
    require(sign <= 1, "PixelRepresentation is neither 0 nor 1");
    format.is_signed = sign == 1;
  }

  void coding(const DicomImage& image) const {
    require(file.has_header,
            "has no DICOM file header, so its transfer syntax is unknown: export the image again as a DICOM file");
    require(file.syntax != nullptr, "is stored in a transfer syntax that is not in the DICOM standard's list");
    require(file.syntax->coding != PixelCoding::kCannot, "is stored as " + std::string(file.syntax->name) +
                                                             ", which cannot be decoded here: export it uncompressed");
    require(file.pixels.present, "holds no pixel data");
    require(!file.pixels.floating, "holds floating point pixel data, which are not read");
    require(file.pixels.encapsulated == (file.syntax->coding != PixelCoding::kNative),
            "its pixel data are not stored as " + std::string(file.syntax->name) + ", which it claims");
    require(image.format.allocated <= 16 || !file.pixels.encapsulated, "holds compressed pixels of more than 16 bits");
  }

  void length(DicomImage& image, std::uint64_t source_size) const {
    const auto frames = static_cast<std::uint64_t>(image.frames);
    if (file.pixels.encapsulated) {
      require(file.pixels.fragments.size() >= frames, "holds " + std::to_string(file.pixels.fragments.size()) +
                                                          " compressed pieces for " + std::to_string(frames) +
                                                          " frames");
      return;
    }
    const std::uint64_t need = static_cast<std::uint64_t>(image.rows) * static_cast<std::uint64_t>(image.columns) *
                               frames * static_cast<std::uint64_t>(image.format.allocated / 8);
    const std::uint64_t there = std::min(file.pixels.length, source_size - std::min(source_size, file.pixels.offset));
    require(there >= need, "pixel data are cut off: " + std::to_string(there) + " of " + std::to_string(need) +
                               " bytes are there; copy or export it again");
    image.padded = file.pixels.length > need + 1;
  }
};

}  // namespace

bool compressed_with_loss(const DicomFile& file) {
  const bool always = file.syntax->lossy && file.syntax->uid != "1.2.840.10008.1.2.4.91";
  return always || file.data.text(tag::kLossy) == "01";
}

DicomImage checked_image(const DicomFile& file, const std::string& name, std::uint64_t source_size) {
  if (!file.damage.empty()) throw InputError(file.damage);
  DicomImage image;
  const Check check{file, name};
  check.sizes(image);
  check.grey_values(image);
  check.coding(image);
  check.length(image, source_size);
  image.syntax = file.syntax;
  image.lossy = compressed_with_loss(file);
  image.places = slice_places(file.data, image.frames, name);
  image.pixels = file.pixels;
  return image;
}

DicomInstance instance_of(const DicomFile& file, const std::filesystem::path& path, const std::string& name,
                          std::uint64_t source_size) {
  DicomInstance instance;
  instance.path = path, instance.name = name;
  instance.modality = known_modality(file.data.text(tag::kModality));
  instance.kind = kind_of(file, instance.modality);
  instance.study = file.data.text(tag::kStudy), instance.series = file.data.text(tag::kSeries);
  if (instance.series.empty())
    instance.series = instance.kind == DicomKind::kImage
                          ? std::string(kNoSeries)
                          : "none " + file.data.text(tag::kSopInstance) + " " + std::to_string(source_size);
  for (const DicomTag tag : {tag::kEcho, tag::kEchoTime, tag::kTemporalPosition, tag::kTrigger, tag::kDiffusion,
                             tag::kImageType, tag::kAcquisition})
    instance.pass.push_back(file.data.text(tag));
  instance.frame_of_reference = file.data.text(tag::kFrameOfReference);
  instance.rows = small(file.data.whole(tag::kRows)), instance.columns = small(file.data.whole(tag::kColumns));
  instance.frames = frame_count(file.data).value_or(0);
  const std::string number = file.data.text(tag::kSeriesNumber);
  std::from_chars(number.data(), number.data() + number.size(), instance.series_number);
  instance.problem = file.damage;
  if (instance.kind != DicomKind::kImage || !file.damage.empty()) return instance;
  try {
    instance.image = checked_image(file, name, source_size);
  } catch (const InputError& error) {
    instance.problem = error.what();
  }
  return instance;
}

}  // namespace trocar
