#include "tissue/imaging/dicom/dicom_segmentation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_catalogue.h"
#include "tissue/imaging/dicom/dicom_pixels.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/even_planes.h"
#include "tissue/imaging/dicom/segment_layers.h"
#include "tissue/imaging/dicom/segmentation_header.h"

namespace trocar {
namespace {

constexpr double kSameFrameDirection = 2e-3, kSameFrameSpacing = 5e-4;

[[noreturn]] void refuse(const DicomInstance& file, const std::string& what) {
  throw InputError(file.name + ": " + what);
}

/// One grid for all frames: their orientation, pixel spacing and in-plane place must agree. It has an empty slice
/// before the first and behind the last: frames without a mark are left out as a rule, so where the frames end no image
/// ends.
class SegmentationGrid {
 public:
  SegmentationGrid(const SegmentationHeader& header, const DicomInstance& file)
      : first_(header.image().places.front()) {
    normal_ = first_.along_row.cross(first_.along_column);
    std::vector<double> heights;
    for (const SlicePlace& place : header.image().places) {
      require_same(place, file);
      heights.push_back(normal_.dot(place.position));
    }
    planes_ = even_planes(heights, "frames", file.name);
    if (planes_.step == 0) refuse(file, "marks a single slice: a volume needs two at least, an organ some dozens");
    size_ = {header.file.columns, header.file.rows, planes_.count + 2};
    const double voxels = static_cast<double>(size_[0]) * size_[1] * size_[2];
    if (voxels > static_cast<double>(kMostVoxels))
      refuse(file, "spans more voxels than an import may hold (268 million)");
  }

  const std::array<int, 3>& size() const { return size_; }
  double step() const { return planes_.step; }
  int slice_of(std::size_t frame) const { return planes_.slice[frame] + 1; }
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
    lps.translation() = first_.position + normal_ * (planes_.first - planes_.step - normal_.dot(first_.position));
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

/// Calls `take` with every frame's values, in order.
void for_frames(const SegmentationHeader& header, const Progress& progress, const DicomPixels::Take& take) {
  std::vector<DicomPixels::Wish> wishes;
  for (std::size_t frame = 0; frame < header.frames(); ++frame) wishes.push_back({&header.file, frame});
  DicomPixels::read(wishes, progress, take);
}

/// Whether a pixel counts, for all pixels of all frames. Native bits run on from frame to frame (PS3.5 8.1.1).
std::vector<bool> marked_pixels(const SegmentationHeader& header, const Progress& progress) {
  const std::size_t pixels = header.pixels();
  std::vector<bool> marked(pixels * header.frames());
  const PixelSpan& span = header.image().pixels;
  const bool bits = header.content == SegmentationContent::kBits;
  const bool packed = bits && header.image().format.stored == 8;
  if (bits && !span.encapsulated) {
    constexpr std::size_t kBytes = std::size_t{1} << 20;
    for (std::size_t from = 0; from < marked.size(); from += 8 * kBytes) {
      const std::size_t count = std::min(8 * kBytes, marked.size() - from);
      const std::string bytes = header.source->bytes(span.offset + from / 8, (count + 7) / 8);
      for (std::size_t n = 0; n < count; ++n)
        marked[from + n] = (static_cast<unsigned char>(bytes[n / 8]) >> n % 8 & 1) != 0;
    }
    return marked;
  }
  for_frames(header, progress, [&](std::size_t frame, const std::vector<float>& values) {
    for (std::size_t n = 0; n < pixels; ++n) {
      const auto value = static_cast<unsigned>(values[packed ? n / 8 : n]);
      marked[frame * pixels + n] =
          packed ? (value >> n % 8 & 1) != 0 : value != 0 && (bits || 2 * value >= header.maximum);
    }
  });
  return marked;
}

SegmentMask mask_of(int number, const SegmentationHeader& header, const std::vector<bool>& marked,
                    const SegmentationGrid& grid) {
  SegmentMask mask(grid.size());
  for (std::size_t frame = 0; frame < header.frames(); ++frame) {
    if (header.segment_of[frame] != number) continue;
    const int slice = grid.slice_of(frame);
    const std::size_t from = header.pixels() * static_cast<std::size_t>(slice);
    for (std::size_t n = 0; n < header.pixels(); ++n)
      if (marked[frame * header.pixels() + n]) mask.voxels[from + n] = true, mask.mark_slice(slice);
  }
  return mask;
}

std::string no_voxel(const Segment& segment) {
  return "Segment " + std::to_string(segment.number) + " (" + segment.name + ") marks no voxel and was left out.";
}

LabelMap layered(const SegmentationHeader& header, const SegmentationGrid& grid, const Progress& progress) {
  SegmentLayers layers(grid.size(), grid.ras_frame(), header.file.name);
  std::vector<std::string> notes;
  const std::vector<bool> marked = marked_pixels(header, progress);
  double done = 0;
  for (const Segment& segment : header.segments) {
    report(progress, "segments", done++ / static_cast<double>(header.segments.size()));
    const SegmentMask mask = mask_of(segment.number, header, marked, grid);
    if (mask.empty()) notes.push_back(no_voxel(segment));
    layers.add(segment, mask);
  }
  LabelMap map = layers.take();
  map.notes = std::move(notes);
  const auto lost = std::count_if(header.segment_of.begin(), header.segment_of.end(), [&](int number) {
    return std::none_of(header.segments.begin(), header.segments.end(),
                        [&](const Segment& segment) { return segment.number == number; });
  });
  if (lost > 0)
    map.notes.push_back(std::to_string(lost) + " frames name no segment that the file describes; they were left out.");
  if (header.content == SegmentationContent::kFractions)
    map.notes.emplace_back("The segmentation is fractional: a voxel counts from one half of the maximum on.");
  if (map.layers.size() > 1)
    map.notes.push_back("Segments overlap: they lie in " + std::to_string(map.layers.size()) + " layers.");
  return map;
}

/// What a label map says of its numbers: those described, without voxels, without description.
void name_numbers(LabelMap& map, const SegmentationHeader& header) {
  const std::map<int, std::size_t> counts = map.layers.front().label_counts();
  std::map<int, Segment> described;
  for (const Segment& segment : header.segments) described.emplace(segment.number, segment);
  for (const auto& [number, count] : counts) {
    const auto found = described.find(number);
    map.segments.push_back(found != described.end() ? found->second : Segment{0, number});
    if (found == described.end())
      map.notes.push_back("Number " + std::to_string(number) + " marks " + std::to_string(count) +
                          " voxels, but the file does not say what it is.");
  }
  for (const auto& [number, segment] : described)
    if (number != 0 && number != static_cast<int>(header.background) && !counts.contains(number))
      map.notes.push_back(no_voxel(segment));
}

LabelMap numbered(const SegmentationHeader& header, const SegmentationGrid& grid, const Progress& progress) {
  LabelVolume layer;
  layer.size = grid.size(), layer.index_to_ras_mm = grid.ras_frame();
  layer.labels.assign(header.pixels() * static_cast<std::size_t>(grid.size()[2]), 0);
  std::vector<bool> filled(static_cast<std::size_t>(grid.size()[2]));
  std::size_t zeros = 0;
  for_frames(header, progress, [&](std::size_t frame, const std::vector<float>& values) {
    const auto slice = static_cast<std::size_t>(grid.slice_of(frame));
    if (filled[slice])
      refuse(header.file, "has two frames in one place (one of them frame " + std::to_string(frame + 1) +
                              "): a label map has one number a voxel; export it again");
    filled[slice] = true;
    for (std::size_t n = 0; n < header.pixels(); ++n) {
      const auto number = static_cast<unsigned>(values[n]);
      if (number == header.background) continue;
      layer.labels[header.pixels() * slice + n] = static_cast<std::uint16_t>(number);
      zeros += number == 0 ? 1 : 0;
    }
  });
  LabelMap map;
  map.layers.push_back(in_ras_order(std::move(layer)));
  if (zeros > 0)
    map.notes.push_back("Number 0 marks " + std::to_string(zeros) + " voxels beside the background, number " +
                        std::to_string(header.background) + "; both were taken for background.");
  name_numbers(map, header);
  if (map.segments.empty()) map.layers.clear();
  return map;
}

/// Without layers when it marks no voxel.
LabelMap assembled(const DicomInstance& file, const Progress& progress) {
  const SegmentationHeader header = segmentation_header(file);
  const SegmentationGrid grid(header, file);
  LabelMap map = header.content == SegmentationContent::kNumbers ? numbered(header, grid, progress)
                                                                 : layered(header, grid, progress);
  if (header.image().lossy)
    map.notes.emplace_back("The segmentation was compressed with loss before it came here: its edges may be off.");
  if (const int empty = grid.empty_slices(); empty > 0)
    map.notes.push_back("The segmentation leaves " + std::to_string(empty) +
                        " slices out between its first and last; they are empty.");
  return map;
}

/// Several files as one map, their segments counted from 1.
LabelMap joined(const std::vector<const DicomInstance*>& files, const std::string& input, const Progress& progress) {
  SegmentLayers layers(input);
  std::vector<std::string> notes;
  int count = 0;
  for (const DicomInstance* file : files) {
    LabelMap map = assembled(*file, progress);
    for (const std::string& note : map.notes) notes.push_back(file->name + ": " + note);
    if (map.layers.empty()) {
      notes.push_back(file->name + " marks no voxel and was left out.");
      continue;
    }
    if (!layers.hold(grid_of(map.layers.front())))
      refuse(*file, "lies on another grid than the segmentation files before it: give one of them");
    for (Segment& segment : map.segments) {
      const LabelVolume& layer = map.layers[segment.layer];
      const int number = std::exchange(segment.number, ++count);
      layers.add(std::move(segment), layer, number);
    }
  }
  LabelMap map = layers.take();
  notes.push_back(std::to_string(files.size()) + " segmentation files were taken together: " + files.front()->name +
                  " to " + files.back()->name + "; their segments are counted from 1.");
  map.notes = std::move(notes);
  return map;
}

std::vector<const DicomInstance*> files_of(const CataloguedSeries& series) {
  std::vector<const DicomInstance*> files;
  for (const DicomInstance& file : series.instances) files.push_back(&file);
  return files;
}

}  // namespace

LabelMap read_dicom_segmentation(const std::filesystem::path& input, const Progress& progress,
                                 std::optional<int> number) {
  return read_dicom_segmentation(DicomStudy(input, progress), progress, number);
}

LabelMap read_dicom_segmentation(const DicomStudy& study, const Progress& progress, std::optional<int> number,
                                 bool every) {
  const std::string& input = study.files().name();
  const DicomCatalogue& all = study.catalogue();
  std::vector<const DicomInstance*> files;
  if (every && !number) {
    for (const CataloguedSeries& series : all.series)
      if (series.facts.kind == DicomKind::kSegmentation)
        for (const DicomInstance* file : files_of(series)) files.push_back(file);
  }
  if (files.empty()) files = files_of(choose(all, DicomKind::kSegmentation, number, input, "a segmentation"));
  LabelMap map = files.size() == 1 ? assembled(*files.front(), progress) : joined(files, input, progress);
  if (map.layers.empty())
    throw InputError((files.size() == 1 ? files.front()->name + ": marks" : input + ": its segmentations mark") +
                     " no voxel at all");
  map.notes.insert(map.notes.begin(), all.notes.begin(), all.notes.end());
  return map;
}

}  // namespace trocar
