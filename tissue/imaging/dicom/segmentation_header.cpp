#include "tissue/imaging/dicom/segmentation_header.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_tags.h"
#include "tissue/imaging/dicom/segment_items.h"

namespace trocar {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;  // of all frames: 128 MiB as bits

[[noreturn]] void refuse_segmentation(const DicomInstance& file, const std::string& what) {
  throw InputError(file.name + ": " + what);
}

void require_decodable(const DicomInstance& file, const DicomFile& elements) {
  if (!elements.damage.empty()) throw InputError(elements.damage);
  if (!elements.has_header)
    refuse_segmentation(file,
                        "has no DICOM file header, so its transfer syntax is unknown: export the segmentation again");
  if (elements.syntax == nullptr)
    refuse_segmentation(file, "is stored in a transfer syntax that is not in the DICOM standard's list");
  if (elements.syntax->coding == PixelCoding::kCannot)
    refuse_segmentation(file, "is a segmentation stored as " + std::string(elements.syntax->name) +
                                  ", which cannot be decoded here: export it uncompressed");
  if (!elements.pixels.present || elements.pixels.floating) refuse_segmentation(file, "holds no pixel data");
  if (elements.pixels.encapsulated != (elements.syntax->coding != PixelCoding::kNative))
    refuse_segmentation(file,
                        "its pixel data are not stored as " + std::string(elements.syntax->name) + ", which it claims");
}

void read_content(SegmentationHeader& header, const DicomItem& data) {
  const DicomInstance& file = header.file;
  const std::string type = data.text(tag::kSegmentationType);
  if (type != "BINARY" && type != "FRACTIONAL" && type != "LABELMAP")
    refuse_segmentation(file, "is neither a binary nor a fractional segmentation nor a label map (SegmentationType)");
  header.content = type == "BINARY"       ? SegmentationContent::kBits
                   : type == "FRACTIONAL" ? SegmentationContent::kFractions
                                          : SegmentationContent::kNumbers;
  const std::uint32_t bits = data.whole(tag::kBitsAllocated).value_or(0);
  const bool fits = header.content == SegmentationContent::kBits        ? bits == 1
                    : header.content == SegmentationContent::kFractions ? bits == 8
                                                                        : bits == 8 || bits == 16;
  if (!fits)
    refuse_segmentation(file, "stores " + std::to_string(bits) + " bits a pixel, which does not fit its kind, " + type);
  const int stored = static_cast<int>(std::min(data.whole(tag::kBitsStored).value_or(bits), bits));
  header.file.image->format = {static_cast<int>(bits), std::max(stored, 1), std::max(stored, 1) - 1, false};
  header.background = data.whole(tag::kPadding).value_or(0) & 0xFFFF;
  if (header.content != SegmentationContent::kFractions) return;
  header.maximum = data.whole(tag::kMaximumFraction).value_or(0);
  if (header.maximum < 1 || header.maximum > 255)
    refuse_segmentation(file, "MaximumFractionalValue is not between 1 and 255");
}

/// Of bits only: RLE gives them packed, as whole bytes a frame, JPEG 2000 one by one (PS3.5 A.4.2, A.4.4, 8.2).
void read_compressed(SegmentationHeader& header) {
  DicomImage& image = *header.file.image;
  if (image.pixels.fragments.size() < header.frames())
    refuse_segmentation(header.file, "holds " + std::to_string(image.pixels.fragments.size()) +
                                         " compressed pieces for " + std::to_string(header.frames()) + " frames");
  if (header.content == SegmentationContent::kNumbers && image.lossy)
    refuse_segmentation(header.file, "was compressed with loss (" + std::string(image.syntax->name) +
                                         "): its numbers of segments are no longer true; export it without loss");
  if (header.content != SegmentationContent::kBits) return;
  image.format = {8, 1, 0, false};
  if (image.syntax->coding != PixelCoding::kRle) return;
  image.format.stored = 8, image.format.high_bit = 7;
  image.rows = 1, image.columns = static_cast<int>((header.pixels() + 7) / 8);
}

void require_length(const SegmentationHeader& header) {
  const PixelSpan& pixels = header.image().pixels;
  const std::uint64_t bits = static_cast<std::uint64_t>(header.image().format.allocated);
  const std::uint64_t need = (header.pixels() * header.frames() * bits + 7) / 8;
  const std::uint64_t there =
      std::min(pixels.length, header.source->size() - std::min(header.source->size(), pixels.offset));
  if (there < need)
    refuse_segmentation(header.file, "pixel data are cut off: " + std::to_string(there) + " of " +
                                         std::to_string(need) + " bytes are there; copy or export it again");
  if (header.content == SegmentationContent::kBits && header.image().syntax->big_endian)
    refuse_segmentation(header.file,
                        "holds single bits in big endian order, which are not read: export it in little endian");
}

}  // namespace

SegmentationHeader segmentation_header(const DicomInstance& file) {
  SegmentationHeader header;
  InflateBudget budget;
  const auto elements = read_dicom_elements(file.path, file.name, budget, &header.source);
  if (!elements) refuse_segmentation(file, "is not a DICOM file");
  require_decodable(file, *elements);
  header.file = file;
  const std::uint64_t pixels = header.pixels();
  if (pixels == 0 || file.frames < 1) refuse_segmentation(file, "holds no frames");
  if (pixels > kMostPixels / static_cast<std::uint64_t>(file.frames))
    refuse_segmentation(file, "claims " + std::to_string(file.frames) + " frames of " + std::to_string(file.columns) +
                                  " x " + std::to_string(file.rows) + " pixels: more than an import may hold");
  DicomImage& image = header.file.image.emplace();
  image.rows = file.rows, image.columns = file.columns, image.frames = file.frames;
  image.syntax = elements->syntax, image.pixels = elements->pixels;
  image.lossy = compressed_with_loss(*elements);
  read_content(header, elements->data);
  image.pixels.encapsulated ? read_compressed(header) : require_length(header);
  image.places = slice_places(elements->data, file.frames, file.name);
  header.segments = described_segments(elements->data, file.name);
  header.segment_of = frame_segments(elements->data, header.frames());
  return header;
}

}  // namespace trocar
