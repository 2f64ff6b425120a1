#include "tissue/imaging/labels/label_values.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace trocar {

LabelValues values_under(const ImageVolume& image, const LabelVolume& labels, int number) {
  if (image.size != labels.size || image.values.size() != labels.labels.size())
    throw std::invalid_argument("values_under: labels and image have different grids");
  std::vector<float> values;
  for (std::size_t voxel = 0; voxel < labels.labels.size(); ++voxel)
    if (labels.labels[voxel] == number) values.push_back(image.values[voxel]);
  LabelValues result{.voxels = values.size()};
  if (values.empty()) return result;
  const auto count = static_cast<double>(values.size());
  for (const float value : values) result.mean += static_cast<double>(value) / count;
  for (const float value : values) result.deviation += std::pow(static_cast<double>(value) - result.mean, 2) / count;
  result.deviation = std::sqrt(result.deviation);
  const auto quantile = [&](double share) {
    const auto place = values.begin() + std::lround(share * (count - 1));
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
  };
  result.p05 = quantile(0.05), result.p95 = quantile(0.95);
  return result;
}

}  // namespace trocar
