#include "tissue/imaging/volumes/volume_assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/volumes/axis_order.h"
#include "tissue/imaging/volumes/volume_frame.h"
#include "tissue/imaging/volumes/voxel_stream.h"

namespace trocar {
namespace {

constexpr double kWholeNumberTolerance = 1e-3;  // resampled maps stored as float carry rounding noise
constexpr std::size_t kMostLabels = 1000;
constexpr int kMostLayers = 256;
constexpr const char* kWhatToDo =
    ": this is an image, not a label map; give its label map with --labels, or mark an organ in it with --threshold";

[[noreturn]] void refuse_assembly(const VolumeHeader& header, const std::string& what) {
  throw InputError(header.block.file.string() + ": data: " + what);
}

/// Where the stored values go in an array in RAS order, perhaps of voxels averaged over `factor` along each RAS axis.
class Placing {
 public:
  Placing(const VolumeHeader& header, const std::array<int, 3>& factor) : factor_(factor) {
    const AxisOrder order = ras_order(header.index_to_ras_mm.linear());
    const std::array<int, 3> whole = reordered_size(header.size, order);
    frame_ = reordered_frame(header.index_to_ras_mm, header.size, order);
    std::array<std::int64_t, 3> stride{};
    std::int64_t along = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      size_[axis] = whole[axis] / factor[axis];
      stride[axis] = std::exchange(along, along * size_[axis]);
      frame_.translation() += 0.5 * (factor[axis] - 1) * frame_.linear().col(static_cast<int>(axis));
      frame_.linear().col(static_cast<int>(axis)) *= factor[axis];
    }
    for (int stored = 0, spatial = 0; stored < 4; ++stored) {
      if (stored == header.component_axis)
        steps_[static_cast<std::size_t>(stored)].assign(static_cast<std::size_t>(header.components), 0);
      else
        fill_steps(steps_[static_cast<std::size_t>(stored)], order, spatial++, whole, stride);
    }
    component_axis_ = static_cast<std::size_t>(header.component_axis);
  }

  const std::array<int, 3>& size() const { return size_; }
  const Eigen::Affine3d& frame() const { return frame_; }

  /// put(component, place, value) for every value; place -1 for a voxel that fell off the end of the pairs.
  template <typename Put>
  void scatter(std::span<const double> values, Put put) {
    for (std::size_t done = 0; done < values.size();) {
      const auto [row, dropped] = start_of_row();
      const std::size_t run = std::min(values.size() - done, steps_[0].size() - index_[0]);
      for (std::size_t n = 0; n < run; ++n) {
        const std::int64_t step = steps_[0][index_[0] + n];
        put(component_axis_ == 0 ? index_[0] + n : index_[component_axis_], dropped || step < 0 ? -1 : row + step,
            values[done + n]);
      }
      done += run;
      index_[0] += run;
      if (index_[0] < steps_[0].size()) return;
      index_[0] = 0;
      for (std::size_t axis = 1; axis < 4 && ++index_[axis] == steps_[axis].size(); ++axis) index_[axis] = 0;
    }
  }

 private:
  /// Place of the row's first voxel but for the step along the row; whether the whole row falls off the pairs.
  std::pair<std::int64_t, bool> start_of_row() const {
    std::int64_t place = 0;
    bool dropped = false;
    for (std::size_t axis = 1; axis < 4; ++axis) {
      const std::int64_t step = steps_[axis][index_[axis]];
      dropped = dropped || step < 0;
      place += step;
    }
    return {place, dropped};
  }

  void fill_steps(std::vector<std::int64_t>& steps, const AxisOrder& order, int spatial,
                  const std::array<int, 3>& whole, const std::array<std::int64_t, 3>& stride) {
    std::size_t axis = 0;
    while (order.stored[axis] != spatial) ++axis;
    for (int n = 0; n < whole[axis]; ++n) {
      const int place = (order.flipped[axis] ? whole[axis] - 1 - n : n) / factor_[axis];
      steps.push_back(place < size_[axis] ? place * stride[axis] : -1);
    }
  }

  std::array<int, 3> factor_, size_{};
  Eigen::Affine3d frame_;
  std::array<std::vector<std::int64_t>, 4> steps_;
  std::array<std::size_t, 4> index_{};
  std::size_t component_axis_ = 3;
};

std::uint64_t voxels_of(const std::array<int, 3>& size) {
  std::uint64_t count = 1;
  for (const int extent : size) count *= static_cast<std::uint64_t>(extent);
  return count;
}

/// Pairs along the axes with the shortest edges first, until the image is small enough.
std::array<int, 3> reduction(const VolumeHeader& header, std::uint64_t most) {
  const AxisOrder order = ras_order(header.index_to_ras_mm.linear());
  const std::array<int, 3> whole = reordered_size(header.size, order);
  const Eigen::Affine3d frame = reordered_frame(header.index_to_ras_mm, header.size, order);
  std::array<int, 3> factor{1, 1, 1}, size = whole;
  while (voxels_of(size) > most) {
    std::size_t finest = 0;
    const auto edge = [&](std::size_t axis) {
      return frame.linear().col(static_cast<int>(axis)).norm() * factor[axis] * (size[axis] < 4 ? 1e9 : 1);
    };
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (edge(axis) < edge(finest) * (1 - 1e-9)) finest = axis;
    factor[finest] *= 2;
    size[finest] = whole[finest] / factor[finest];
  }
  return factor;
}

/// Makes what is not finite the lowest value that is.
void mend_values(const VolumeHeader& header, ImageVolume& volume) {
  float lowest = std::numeric_limits<float>::infinity();
  std::size_t odd = 0;
  for (const float value : volume.values) {
    if (std::isfinite(value))
      lowest = std::min(lowest, value);
    else
      ++odd;
  }
  if (odd == 0) return;
  if (odd == volume.values.size()) refuse_assembly(header, "holds no voxel that is a finite number");
  for (float& value : volume.values)
    if (!std::isfinite(value)) value = lowest;
  volume.notes.push_back(std::to_string(odd) + " voxels are not finite numbers; they were given the lowest value, " +
                         plain(lowest));
}

void note_rest(const VolumeHeader& header, bool more, std::vector<std::string>& notes) {
  if (more)
    notes.push_back(header.block.file.filename().string() +
                    " holds more bytes than its voxels need; they were left unread");
}

/// Takes voxels one by one and judges them.
class LabelTaker {
 public:
  LabelTaker(const VolumeHeader& header, LabelMap& map)
      : header_(header), map_(map), counts_(map.layers.size(), std::vector<std::size_t>(65536, 0)) {}

  void take(std::size_t layer, std::int64_t place, double value) {
    const double rounded = std::round(value);
    if (!(std::abs(value - rounded) <= kWholeNumberTolerance) || rounded < 0 || rounded > 65535) refuse_value(value);
    const auto label = static_cast<std::uint16_t>(rounded);
    if (++counts_[layer][label] == 1 && label != 0 && ++distinct_ > kMostLabels)
      refuse_assembly(header_, "more than " + std::to_string(kMostLabels) + " different values" + kWhatToDo);
    map_.layers[layer].labels[static_cast<std::size_t>(place)] = label;
    ++taken_;
  }

  const std::vector<std::size_t>& counts(std::size_t layer) const { return counts_[layer]; }

 private:
  [[noreturn]] void refuse_value(double value) const {
    if (!std::isfinite(value)) refuse_assembly(header_, "holds a voxel that is not a finite number");
    refuse_assembly(header_, "voxel " + std::to_string(taken_) + " holds " + plain(value) +
                                 ", no whole number in 0..65535" + kWhatToDo);
  }

  const VolumeHeader& header_;
  LabelMap& map_;
  std::vector<std::vector<std::size_t>> counts_;
  std::size_t distinct_ = 0, taken_ = 0;
};

/// What the header tells of a number; the bare number when it tells nothing.
Segment told_of(const std::vector<Segment>& segments, std::size_t layer, int number) {
  for (const Segment& segment : segments)
    if (segment.layer == layer && segment.number == number) return segment;
  return {layer, number};
}

/// The header's segments; the only one that says no number has that of a map with just one.
std::vector<Segment> numbered(const VolumeHeader& header, const std::vector<std::size_t>& counts,
                              std::vector<std::string>& notes) {
  std::vector<Segment> segments = header.segments;
  if (segments.empty() || segments.front().number != kAnyNumber) return segments;
  const auto marked = [](std::size_t count) { return count > 0; };
  const auto first = std::find_if(counts.begin() + 1, counts.end(), marked);
  if (first != counts.end() && std::none_of(first + 1, counts.end(), marked)) {
    segments.front().number = static_cast<int>(first - counts.begin());
    return segments;
  }
  if (first != counts.end())
    notes.push_back("the header's only segment (\"" + segments.front().name +
                    "\") has no LabelValue, and several numbers mark voxels: none was given its name");
  return {};
}

/// Our own phantom's map says in its header what made it, and no other map of that header has a skin: its numbers are
/// those of its table.
bool of_phantom(const VolumeHeader& header, const std::vector<std::size_t>& counts) {
  return header.description == kPhantomDescription && counts[phantom_label::kSkin] > 0;
}

/// Segments that mark no voxel, in one sentence: a table names every organ that could be. @param names in quotes
void note_unmarked(const std::vector<std::string>& names, std::vector<std::string>& notes) {
  constexpr std::size_t kListed = 3;
  if (names.empty()) return;
  const std::string text = listed_words(names, kListed);
  notes.push_back(names.size() == 1 ? "segment " + text + " marks no voxel and was left out"
                                    : "segments " + text + " mark no voxel and were left out");
}

/// Segments in the order of layer and number; layers without any are left out.
void list_segments(const VolumeHeader& header, const LabelTaker& taker, LabelMap& map) {
  std::vector<LabelVolume> layers;
  const std::vector<Segment> told = numbered(header, taker.counts(0), map.notes);
  for (std::size_t layer = 0; layer < map.layers.size(); ++layer) {
    std::size_t marked = 0;
    if (header.segments.empty() && of_phantom(header, taker.counts(layer))) map.table = kPhantomTable;
    for (std::size_t number = 1; number < 65536; ++number) {
      if (taker.counts(layer)[number] == 0) continue;
      map.segments.push_back(told_of(told, layer, static_cast<int>(number)));
      map.segments.back().layer = layers.size();
      ++marked;
    }
    if (marked > 0) layers.push_back(std::move(map.layers[layer]));
  }
  std::vector<std::string> unmarked;
  for (const Segment& segment : told)
    if (taker.counts(segment.layer)[static_cast<std::size_t>(segment.number)] == 0)
      unmarked.push_back("\"" + segment.name + "\"");
  note_unmarked(unmarked, map.notes);
  map.layers = std::move(layers);
}

}  // namespace

ImageVolume assemble_image(const VolumeHeader& header, const Progress& progress, std::uint64_t most) {
  if (header.components != 1)
    refuse_assembly(
        header, std::to_string(header.components) + " values a voxel: colours or vectors; one grey value is wanted");
  const std::array<int, 3> factor = reduction(header, most);
  Placing placing(header, factor);
  check_length(header.block, header.value_count());
  ImageVolume volume;
  volume.size = placing.size();
  volume.index_to_ras_mm = settled_frame(placing.frame());
  volume.modality = header.modality;
  volume.notes = header.notes;
  volume.values.assign(static_cast<std::size_t>(voxels_of(volume.size)), 0.0F);
  const int averaged = factor[0] * factor[1] * factor[2];
  const double weight = 1.0 / averaged;
  const bool more = stream_voxels(header.block, header.value_count(), progress, [&](std::span<const double> values) {
    placing.scatter(values, [&](std::size_t, std::int64_t place, double value) {
      if (place >= 0) volume.values[static_cast<std::size_t>(place)] += static_cast<float>(value * weight);
    });
  });
  note_rest(header, more, volume.notes);
  if (averaged > 1)
    volume.notes.push_back(std::to_string(header.value_count()) + " voxels are more than " + std::to_string(most) +
                           ": averaged over " + std::to_string(factor[0]) + " x " + std::to_string(factor[1]) + " x " +
                           std::to_string(factor[2]) + " voxels");
  mend_values(header, volume);
  return volume;
}

LabelMap assemble_labels(const VolumeHeader& header, const Progress& progress) {
  if (header.components > 1 && !header.segmentation)
    refuse_assembly(header, std::to_string(header.components) +
                                " values a voxel, and no segments named: colours or vectors, no label map");
  if (header.components > kMostLayers)
    refuse_assembly(header, std::to_string(header.components) + " layers, more than " + std::to_string(kMostLayers));
  Placing placing(header, {1, 1, 1});
  check_length(header.block, header.value_count());
  LabelMap map;
  map.notes = header.notes;
  map.modality = header.modality;
  LabelVolume layer;
  layer.size = placing.size();
  layer.index_to_ras_mm = settled_frame(placing.frame());
  map.layers.assign(static_cast<std::size_t>(header.components), layer);
  for (LabelVolume& each : map.layers) each.labels.assign(static_cast<std::size_t>(voxels_of(layer.size)), 0);
  LabelTaker taker(header, map);
  const bool more = stream_voxels(header.block, header.value_count(), progress, [&](std::span<const double> values) {
    placing.scatter(
        values, [&](std::size_t component, std::int64_t place, double value) { taker.take(component, place, value); });
  });
  note_rest(header, more, map.notes);
  list_segments(header, taker, map);
  return map;
}

}  // namespace trocar
