#include "tissue/imaging/label_volume.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/imaging/itk_volume.h"
#include "tissue/imaging/nifti_header.h"

namespace trocar {
namespace {

constexpr double kWholeNumberTolerance = 1e-3;  // resampled maps stored as float carry rounding noise

/// Which stored axis runs along each RAS axis, and whether it must be flipped.
struct AxisOrder {
  std::array<int, 3> stored{};
  std::array<bool, 3> flipped{};
};

AxisOrder ras_order(const Eigen::Matrix3d& linear) {
  const Eigen::Matrix3d axes = linear.colwise().normalized();
  AxisOrder order;
  std::array<int, 3> best{0, 1, 2}, trial{0, 1, 2};
  double best_score = -1;
  do {
    double score = 0;
    for (int world = 0; world < 3; ++world) score += std::abs(axes(world, trial[static_cast<std::size_t>(world)]));
    if (score > best_score + 1e-9) best_score = score, best = trial;
  } while (std::next_permutation(trial.begin(), trial.end()));
  order.stored = best;
  for (std::size_t world = 0; world < 3; ++world) order.flipped[world] = axes(static_cast<int>(world), best[world]) < 0;
  return order;
}

Eigen::Affine3d reordered_frame(const LabelVolume& volume, const AxisOrder& order) {
  Eigen::Affine3d frame = volume.index_to_ras_mm;
  for (std::size_t world = 0; world < 3; ++world) {
    const Eigen::Vector3d step = volume.index_to_ras_mm.linear().col(order.stored[world]);
    const int last = volume.size[static_cast<std::size_t>(order.stored[world])] - 1;
    frame.linear().col(static_cast<int>(world)) = order.flipped[world] ? Eigen::Vector3d(-step) : step;
    if (order.flipped[world]) frame.translation() += step * last;
  }
  return frame;
}

std::uint16_t whole_label(double value, std::size_t voxel, const std::string& file) {
  const double rounded = std::round(value);
  if (!(std::abs(value - rounded) <= kWholeNumberTolerance) || rounded < 0 || rounded > 65535) {
    std::ostringstream message;
    message << file << ": data: voxel " << voxel << " holds " << value
            << ", no whole number in 0..65535: this is an image, not a label map";
    throw InputError(message.str());
  }
  return static_cast<std::uint16_t>(rounded);
}

}  // namespace

double LabelVolume::voxel_volume_ml() const { return std::abs(index_to_ras_mm.linear().determinant()) * 1e-3; }

std::map<int, std::size_t> LabelVolume::label_counts() const {
  std::vector<std::size_t> histogram(65536, 0);
  for (const std::uint16_t label : labels) ++histogram[label];
  std::map<int, std::size_t> counts;
  for (std::size_t label = 1; label < histogram.size(); ++label)
    if (histogram[label] > 0) counts[static_cast<int>(label)] = histogram[label];
  return counts;
}

LabelVolume in_ras_order(LabelVolume volume) {
  const AxisOrder order = ras_order(volume.index_to_ras_mm.linear());
  LabelVolume result;
  result.notes = volume.notes;
  for (std::size_t world = 0; world < 3; ++world)
    result.size[world] = volume.size[static_cast<std::size_t>(order.stored[world])];
  result.index_to_ras_mm = reordered_frame(volume, order);
  result.labels.reserve(volume.labels.size());
  std::array<int, 3> index{}, stored{};
  for (index[2] = 0; index[2] < result.size[2]; ++index[2])
    for (index[1] = 0; index[1] < result.size[1]; ++index[1])
      for (index[0] = 0; index[0] < result.size[0]; ++index[0]) {
        for (std::size_t world = 0; world < 3; ++world)
          stored[static_cast<std::size_t>(order.stored[world])] =
              order.flipped[world] ? result.size[world] - 1 - index[world] : index[world];
        result.labels.push_back(volume.labels[volume.offset(stored[0], stored[1], stored[2])]);
      }
  return result;
}

LabelVolume read_label_volume(const std::filesystem::path& path) {
  const NiftiHeader header = read_nifti_header(path);
  const ItkVolume image = read_itk_volume(path);
  if (image.size != header.size) throw InputError(path.string() + ": dim: ITK reads another size than the header says");
  LabelVolume volume{
      .size = header.size, .labels = {}, .index_to_ras_mm = header.index_to_ras_mm, .notes = header.notes};
  volume.labels.reserve(image.values.size());
  bool empty = true;
  for (std::size_t voxel = 0; voxel < image.values.size(); ++voxel) {
    volume.labels.push_back(whole_label(image.values[voxel], voxel, path.string()));
    empty = empty && volume.labels.back() == 0;
  }
  if (empty) throw InputError(path.string() + ": data: the label map is empty (all voxels are 0)");
  return in_ras_order(std::move(volume));
}

std::string guess_modality(const std::filesystem::path& volume) {
  read_nifti_header(volume);
  const ItkVolume image = read_itk_volume(volume);
  constexpr double kCertainlyHounsfield = -500;  // no MR magnitude image and no label map goes below 0
  return *std::min_element(image.values.begin(), image.values.end()) < kCertainlyHounsfield ? "CT" : "unknown";
}

}  // namespace trocar
