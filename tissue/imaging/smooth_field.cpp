#include "tissue/imaging/smooth_field.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trocar {
namespace {

std::vector<float> gaussian_kernel(double sigma) {
  const int radius = std::min(kSmoothingMargin - 1, static_cast<int>(std::ceil(3.5 * sigma)));
  std::vector<double> weights;
  double sum = 0;
  for (int offset = -radius; offset <= radius; ++offset) {
    weights.push_back(std::exp(-0.5 * offset * offset / (sigma * sigma)));
    sum += weights.back();
  }
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

/// Convolves along one axis; beyond the box the field is 0.
void convolve_axis(ScalarField& field, std::size_t axis, const std::vector<float>& kernel) {
  const std::array<std::size_t, 3> strides{
      1, static_cast<std::size_t>(field.size[0]),
      static_cast<std::size_t>(field.size[0]) * static_cast<std::size_t>(field.size[1])};
  const std::size_t stride = strides[axis];
  const int length = field.size[axis], radius = static_cast<int>(kernel.size() / 2);
  std::vector<float> line(static_cast<std::size_t>(length + 2 * radius), 0.0F);
  for (std::size_t start = 0; start < field.values.size(); ++start) {
    if (start / stride % static_cast<std::size_t>(length) != 0) continue;
    for (int n = 0; n < length; ++n)
      line[static_cast<std::size_t>(n + radius)] = field.values[start + static_cast<std::size_t>(n) * stride];
    for (int n = 0; n < length; ++n) {
      float sum = 0;
      for (std::size_t tap = 0; tap < kernel.size(); ++tap)
        sum += kernel[tap] * line[static_cast<std::size_t>(n) + tap];
      field.values[start + static_cast<std::size_t>(n) * stride] = sum;
    }
  }
}

void blur(ScalarField& field, double sigma) {
  const std::vector<float> kernel = gaussian_kernel(sigma);
  for (std::size_t axis = 0; axis < 3; ++axis) convolve_axis(field, axis, kernel);
}

/// Voxel offsets of a cube's 27 voxels.
std::vector<std::ptrdiff_t> cube_offsets(const ScalarField& field, int reach) {
  std::vector<std::ptrdiff_t> offsets;
  const std::ptrdiff_t row = field.size[0], slice = row * field.size[1];
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) offsets.push_back(i + j * row + k * slice);
  return offsets;
}

/// 1 at mask voxels farther than two steps from every core voxel (one whose six neighbours are inside too).
ScalarField thin_parts(const LabelMask& mask) {
  ScalarField thin{mask.size, std::vector<float>(mask.inside.size(), 0.0F)};
  const std::ptrdiff_t row = mask.size[0], slice = row * mask.size[1];
  const auto offsets = cube_offsets(thin, 2);
  std::vector<std::uint8_t> near_core(mask.inside.size(), 0);
  const auto inside = [&](std::size_t voxel, std::ptrdiff_t step) {
    return mask.inside[voxel + static_cast<std::size_t>(step)] != 0;
  };
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel) {
    if (mask.inside[voxel] == 0) continue;  // the margin keeps every inside voxel four steps from the box
    if (!(inside(voxel, -1) && inside(voxel, 1) && inside(voxel, -row) && inside(voxel, row) && inside(voxel, -slice) &&
          inside(voxel, slice)))
      continue;
    for (const std::ptrdiff_t step : offsets) near_core[voxel + static_cast<std::size_t>(step)] = 1;
  }
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel)
    if (mask.inside[voxel] != 0 && near_core[voxel] == 0) thin.values[voxel] = 1;
  return thin;
}

/// Spreads the thin parts over their surroundings and softens the seam.
void widen(ScalarField& thin) {
  const auto offsets = cube_offsets(thin, 1);
  std::vector<float> wide(thin.values.size(), 0.0F);
  for (std::size_t voxel = 0; voxel < wide.size(); ++voxel)
    if (thin.values[voxel] > 0)
      for (const std::ptrdiff_t step : offsets) wide[voxel + static_cast<std::size_t>(step)] = 1;
  thin.values = std::move(wide);
  blur(thin, 1.0);
}

}  // namespace

ScalarField sharp_field(const LabelMask& mask) {
  ScalarField field{mask.size, {}};
  field.values.assign(mask.inside.begin(), mask.inside.end());
  return field;
}

ScalarField smooth_field(const LabelMask& mask, const SmoothingWidths& widths) {
  ScalarField broad = sharp_field(mask);
  blur(broad, widths.broad);
  ScalarField weight = thin_parts(mask);
  if (std::none_of(weight.values.begin(), weight.values.end(), [](float value) { return value > 0; })) return broad;
  widen(weight);
  ScalarField narrow = sharp_field(mask);
  blur(narrow, widths.thin);
  for (std::size_t voxel = 0; voxel < broad.values.size(); ++voxel)
    broad.values[voxel] += weight.values[voxel] * (narrow.values[voxel] - broad.values[voxel]);
  return broad;
}

}  // namespace trocar
