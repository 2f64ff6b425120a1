#include "tissue/imaging/label_volume.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "haptics/input_error.h"
#include "tissue/imaging/axis_order.h"
#include "tissue/imaging/itk_volume.h"
#include "tissue/imaging/nifti_header.h"

namespace trocar {
namespace {

constexpr double kWholeNumberTolerance = 1e-3;  // resampled maps stored as float carry rounding noise

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
  result.size = reordered_size(volume.size, order);
  result.index_to_ras_mm = reordered_frame(volume.index_to_ras_mm, volume.size, order);
  result.labels = reordered(volume.labels, volume.size, order);
  result.notes = std::move(volume.notes);
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
