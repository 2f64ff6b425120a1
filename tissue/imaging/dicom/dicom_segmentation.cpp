#include "tissue/imaging/dicom/dicom_segmentation.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dcmseg_frames.h"
#include "tissue/imaging/dicom/dicom_catalogue.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/dicom_tags.h"
#include "tissue/imaging/dicom/even_planes.h"
#include "tissue/imaging/dicom/segment_layers.h"

namespace trocar {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;  // of all frames: 128 MiB as bits
constexpr double kSameFrameDirection = 2e-3, kSameFrameSpacing = 5e-4;

struct Header {
  int rows = 0, columns = 0, frames = 0;
  bool fractional = false, compressed = false;
  unsigned maximum = 1;
  std::uint64_t offset = 0;  ///< of native pixels in `source`
  std::unique_ptr<ByteSource> source;
  std::vector<SlicePlace> places;

  std::size_t pixels() const { return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
};

[[noreturn]] void refuse(const DicomInstance& file, const std::string& what) {
  throw InputError(file.name + ": " + what);
}

void require_decodable(const DicomInstance& file, const DicomFile& elements) {
  if (!elements.damage.empty()) throw InputError(elements.damage);
  if (!elements.has_header)
    refuse(file, "has no DICOM file header, so its transfer syntax is unknown: export the segmentation again");
  if (elements.syntax == nullptr)
    refuse(file, "is stored in a transfer syntax that is not in the DICOM standard's list");
  if (elements.syntax->coding != PixelCoding::kNative && elements.syntax->coding != PixelCoding::kRle)
    refuse(file, "is a segmentation stored as " + std::string(elements.syntax->name) +
                     ", which cannot be decoded here: export it uncompressed");
  if (!elements.pixels.present || elements.pixels.floating) refuse(file, "holds no pixel data");
}

void read_coding(Header& header, const DicomItem& data, const DicomInstance& file) {
  const std::uint32_t bits = data.whole(tag::kBitsAllocated).value_or(0);
  const std::string type = data.text(tag::kSegmentationType);
  header.fractional = type == "FRACTIONAL";
  if (type == "LABELMAP")
    refuse(file, "is a segmentation of the kind LABELMAP, which is not read: export it as BINARY, or as NIfTI or NRRD");
  if (type != "BINARY" && !header.fractional) refuse(file, "is neither a binary nor a fractional segmentation");
  if (bits != (header.fractional ? 8U : 1U))
    refuse(file, "stores " + std::to_string(bits) + " bits a pixel, which does not fit its kind");
  if (!header.fractional) return;
  header.maximum = data.whole(tag::kMaximumFraction).value_or(0);
  if (header.maximum < 1 || header.maximum > 255) refuse(file, "MaximumFractionalValue is not between 1 and 255");
}

void require_length(Header& header, const PixelSpan& pixels, const DicomInstance& file) {
  header.compressed = pixels.encapsulated, header.offset = pixels.offset;
  if (header.compressed && !header.fractional)
    refuse(file, "holds compressed bits, which are not read: export it uncompressed");
  if (header.compressed) return;
  const std::uint64_t all = header.pixels() * static_cast<std::uint64_t>(header.frames),
                      need = header.fractional ? all : (all + 7) / 8;
  const std::uint64_t there =
      std::min(pixels.length, header.source->size() - std::min(header.source->size(), pixels.offset));
  if (there < need)
    refuse(file, "pixel data are cut off: " + std::to_string(there) + " of " + std::to_string(need) +
                     " bytes are there; copy or export it again");
}

/// Everything that dcmseg would trust is checked first.
Header checked_header(const DicomInstance& file) {
  Header header;
  InflateBudget budget;
  const auto elements = read_dicom_elements(file.path, file.name, budget, &header.source);
  if (!elements) refuse(file, "is not a DICOM file");
  require_decodable(file, *elements);
  header.rows = file.rows, header.columns = file.columns, header.frames = file.frames;
  const std::uint64_t pixels = header.pixels();
  if (pixels == 0 || file.frames < 1) refuse(file, "holds no frames");
  if (pixels > kMostPixels / static_cast<std::uint64_t>(file.frames))
    refuse(file, "claims " + std::to_string(file.frames) + " frames of " + std::to_string(file.columns) + " x " +
                     std::to_string(file.rows) + " pixels: more than an import may hold");
  read_coding(header, elements->data, file);
  require_length(header, elements->pixels, file);
  header.places = slice_places(elements->data, file.frames, file.name);
  return header;
}

/// One grid for all frames: their orientation, pixel spacing and in-plane place must agree.
class SegmentationGrid {
 public:
  SegmentationGrid(const Header& header, const DicomInstance& file) : first_(header.places.front()) {
    normal_ = first_.along_row.cross(first_.along_column);
    std::vector<double> heights;
    for (const SlicePlace& place : header.places) {
      require_same(place, file);
      heights.push_back(normal_.dot(place.position));
    }
    planes_ = even_planes(heights, "frames", file.name);
    if (planes_.step == 0) refuse(file, "marks a single slice: a volume needs two at least, an organ some dozens");
    size_ = {header.columns, header.rows, planes_.count};
    const double voxels = static_cast<double>(size_[0]) * size_[1] * size_[2];
    if (voxels > static_cast<double>(kMostVoxels))
      refuse(file, "spans more voxels than an import may hold (268 million)");
  }

  const std::array<int, 3>& size() const { return size_; }
  double step() const { return planes_.step; }
  int slice_of(std::size_t frame) const { return planes_.slice[frame]; }
  int empty_slices() const {
    std::vector<bool> used(static_cast<std::size_t>(planes_.count));
    for (const int slice : planes_.slice) used[static_cast<std::size_t>(slice)] = true;
    return static_cast<int>(std::count(used.begin(), used.end(), false));
  }

  Eigen::Affine3d ras_frame() const {
    Eigen::Affine3d lps = Eigen::Affine3d::Identity();
    lps.linear().col(0) = first_.along_row * first_.row_step;
    lps.linear().col(1) = first_.along_column * first_.column_step;
    lps.linear().col(2) = normal_ * planes_.step;
    lps.translation() = first_.position + normal_ * (planes_.first - normal_.dot(first_.position));
    return Eigen::Affine3d(Eigen::Scaling(-1.0, -1.0, 1.0)) * lps;
  }

 private:
  void require_same(const SlicePlace& place, const DicomInstance& file) const {
    if ((place.along_row - first_.along_row).norm() > kSameFrameDirection ||
        (place.along_column - first_.along_column).norm() > kSameFrameDirection)
      refuse(file, "has frames of different orientations: they are not one volume");
    if (std::abs(place.row_step / first_.row_step - 1) > kSameFrameSpacing ||
        std::abs(place.column_step / first_.column_step - 1) > kSameFrameSpacing)
      refuse(file, "has frames of different pixel spacings: they are not one volume");
    const Eigen::Vector3d offset = place.position - first_.position;
    const Eigen::Vector2d shift(first_.along_row.dot(offset) / first_.row_step,
                                first_.along_column.dot(offset) / first_.column_step);
    if (shift.norm() > 0.5)
      refuse(file,
             "has frames that lie beside each other (a tilted gantry, or cut-out frames): export the segmentation on "
             "an upright grid");
  }

  SlicePlace first_;
  Eigen::Vector3d normal_;
  EvenPlanes planes_;
  std::array<int, 3> size_{};
};

/// Calls `mark(n)` for every pixel of a frame that counts.
template <typename Mark>
void for_marked(const Header& header, const SegmentationFrames& frames, std::size_t frame, const Mark& mark) {
  const std::size_t pixels = header.pixels();
  if (header.fractional) {
    const std::string bytes =
        header.compressed ? frames.values[frame] : header.source->bytes(header.offset + frame * pixels, pixels);
    for (std::size_t n = 0; n < pixels; ++n) {
      const unsigned value = static_cast<unsigned char>(bytes[n]);
      if (value != 0 && 2 * value >= header.maximum) mark(n);
    }
    return;
  }
  const std::uint64_t first =
      frame * static_cast<std::uint64_t>(pixels);  // bits run on from frame to frame (PS3.5 8.1.1)
  const std::string bytes =
      header.source->bytes(header.offset + first / 8, static_cast<std::size_t>((first % 8 + pixels + 7) / 8));
  for (std::size_t n = 0; n < pixels; ++n)
    if ((static_cast<unsigned char>(bytes[(first % 8 + n) / 8]) >> (first + n) % 8 & 1) != 0) mark(n);
}

SegmentMask mask_of(int number, const Header& header, const SegmentationFrames& frames, const SegmentationGrid& grid) {
  SegmentMask mask(grid.size());
  for (std::size_t frame = 0; frame < frames.segment_of.size(); ++frame) {
    if (frames.segment_of[frame] != number) continue;
    const int slice = grid.slice_of(frame);
    const std::size_t from = header.pixels() * static_cast<std::size_t>(slice);
    for_marked(header, frames, frame, [&](std::size_t n) {
      mask.voxels[from + n] = true;
      mask.mark_slice(slice);
    });
  }
  return mask;
}

void require_frames(const SegmentationFrames& frames, const Header& header, const DicomInstance& file) {
  if (frames.segment_of.size() != header.places.size())
    refuse(file, "dcmseg finds another number of frames than the header says");
  for (const std::string& values : frames.values)
    if (header.compressed && values.size() < header.pixels()) refuse(file, "a frame is cut off");
  if (frames.segments.size() > 65535) refuse(file, "holds more than 65535 segments");
}

LabelMap assembled(const Header& header, const SegmentationFrames& frames, const SegmentationGrid& grid,
                   const DicomInstance& file, const Progress& progress) {
  SegmentLayers layers(grid.size(), grid.ras_frame(), file.name);
  std::vector<std::string> notes;
  double done = 0;
  for (const Segment& segment : frames.segments) {
    report(progress, "segments", done++ / static_cast<double>(frames.segments.size()));
    const SegmentMask mask = mask_of(segment.number, header, frames, grid);
    if (mask.empty())
      notes.push_back("Segment " + std::to_string(segment.number) + " (" + segment.name +
                      ") marks no voxel and was left out.");
    layers.add(segment, mask);
  }
  LabelMap map = layers.take();
  if (map.layers.empty()) refuse(file, "marks no voxel at all");
  if (header.fractional)
    notes.emplace_back("The segmentation is fractional: a voxel counts from one half of the maximum on.");
  if (const int empty = grid.empty_slices(); empty > 0)
    notes.push_back("The segmentation leaves " + std::to_string(empty) +
                    " slices out between its first and last; they are empty.");
  if (map.layers.size() > 1)
    notes.push_back("Segments overlap: they lie in " + std::to_string(map.layers.size()) + " layers.");
  map.notes = std::move(notes);
  return map;
}

}  // namespace

LabelMap read_dicom_segmentation(const std::filesystem::path& input, const Progress& progress,
                                 std::optional<int> number) {
  return read_dicom_segmentation(DicomStudy(input, progress), progress, number);
}

LabelMap read_dicom_segmentation(const DicomStudy& study, const Progress& progress, std::optional<int> number) {
  const DicomInput& files = study.files();
  const DicomCatalogue& all = study.catalogue();
  const CataloguedSeries& series = choose(all, DicomKind::kSegmentation, number, files.name(), "a segmentation");
  if (series.instances.size() != 1)
    throw InputError(files.name() + ": the series holds " + std::to_string(series.instances.size()) +
                     " segmentation files (" + series.instances[0].name + ", " + series.instances[1].name +
                     ", ...): give one of them");
  const DicomInstance& file = series.instances.front();
  const Header header = checked_header(file);
  const SegmentationGrid grid(header, file);
  const SegmentationFrames frames = read_segmentation_frames(file.path, file.name, header.compressed, progress);
  require_frames(frames, header, file);
  LabelMap map = assembled(header, frames, grid, file, progress);
  map.notes.insert(map.notes.begin(), all.notes.begin(), all.notes.end());
  return map;
}

}  // namespace trocar
