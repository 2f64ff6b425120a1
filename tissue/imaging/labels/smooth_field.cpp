#include "tissue/imaging/labels/smooth_field.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Core>

namespace trocar {
namespace {

std::vector<float> gaussian_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(std::min(3.5 * sigma, sigma + 2.4)));
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

/// Convolves along one axis, whole rows at a time; beyond the box the field is 0.
void convolve_axis(ScalarField& field, std::size_t axis, const std::vector<float>& kernel) {
  Eigen::Index stride = 1;
  for (std::size_t n = 0; n < axis; ++n) stride *= field.size[n];
  const Eigen::Index length = field.size[axis], block = stride * length;
  const auto radius = static_cast<Eigen::Index>(kernel.size() / 2);
  Eigen::ArrayXf padded = Eigen::ArrayXf::Zero((length + 2 * radius) * stride);
  for (std::size_t start = 0; start < field.values.size(); start += static_cast<std::size_t>(block)) {
    Eigen::Map<Eigen::ArrayXf> values(field.values.data() + start, block);
    padded.segment(radius * stride, block) = values;
    values.setZero();
    const Eigen::Index piece =
        std::max(stride, std::min<Eigen::Index>(block, 1024));  // stays in the cache over the taps
    for (Eigen::Index from = 0; from < block; from += piece) {
      const Eigen::Index count = std::min(piece, block - from);
      for (std::size_t tap = 0; tap < kernel.size(); ++tap)
        values.segment(from, count) +=
            kernel[tap] * padded.segment(from + static_cast<Eigen::Index>(tap) * stride, count);
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

/// Sets the cube of 5 x 5 x 5 voxels round each voxel of a run within a row.
void mark_round(std::vector<std::uint8_t>& marked, const std::array<int, 3>& size, std::size_t begin, std::size_t end) {
  const std::ptrdiff_t row = size[0], slice = row * size[1];
  for (int k = -2; k <= 2; ++k)
    for (int j = -2; j <= 2; ++j) {
      const auto first = marked.begin() + static_cast<std::ptrdiff_t>(begin) - 2 + j * row + k * slice;
      std::fill(first, first + static_cast<std::ptrdiff_t>(end - begin) + 4, std::uint8_t{1});
    }
}

/// 1 at mask voxels farther than two steps from every core voxel (one whose six neighbours are inside too).
ScalarField thin_parts(const LabelMask& mask) {
  ScalarField thin{mask.size, std::vector<float>(mask.inside.size(), 0.0F)};
  const std::ptrdiff_t row = mask.size[0], slice = row * mask.size[1];
  std::vector<std::uint8_t> near_core(mask.inside.size(), 0);
  const auto core = [&](std::size_t voxel) {  // the margin keeps every inside voxel four steps from the box
    const std::uint8_t* here = mask.inside.data() + voxel;
    return *here != 0 && here[-1] != 0 && here[1] != 0 && here[-row] != 0 && here[row] != 0 && here[-slice] != 0 &&
           here[slice] != 0;
  };
  for (std::size_t voxel = 0; voxel < mask.inside.size(); ++voxel) {
    if (!core(voxel)) continue;
    const std::size_t begin = voxel;
    while (core(voxel + 1)) ++voxel;
    mark_round(near_core, mask.size, begin, voxel + 1);
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

/// Index of slice `n` along `axis`, the last slice of the image at a cut side: what lies beyond repeats it.
struct ImageSide {
  std::size_t axis;
  int last;  ///< slice inside
  int step;  ///< from there outwards
};

std::vector<ImageSide> cut_sides(const LabelMask& mask, const std::array<int, 3>& size, const Sampling& sampling) {
  std::vector<ImageSide> sides;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = kSmoothingMargin - 0.5, high = mask.size[axis] - kSmoothingMargin - 0.5;  // the image's border
    if (mask.cut[axis][0]) {
      int last = 0;
      while (sample_place(last, sampling[axis]) < low) ++last;
      sides.push_back({axis, last, -1});
    }
    if (mask.cut[axis][1]) {
      int last = size[axis] - 1;
      while (sample_place(last, sampling[axis]) > high) --last;
      sides.push_back({axis, last, 1});
    }
  }
  return sides;
}

/// Calls set(outside value, value of the last slice inside) for every sample beyond a cut side.
template <typename Set>
void beyond(ScalarField& field, const ImageSide& side, Set set) {
  std::array<int, 3> index{};
  std::size_t sample = 0;
  for (index[2] = 0; index[2] < field.size[2]; ++index[2])
    for (index[1] = 0; index[1] < field.size[1]; ++index[1])
      for (index[0] = 0; index[0] < field.size[0]; ++index[0], ++sample) {
        if ((index[side.axis] - side.last) * side.step <= 0) continue;
        auto inner = index;
        inner[side.axis] = side.last;
        set(field.values[sample], field.values[field.offset(inner[0], inner[1], inner[2])]);
      }
}

/// The values at the voxels on the grid of samples: repeated, or averaged.
ScalarField resampled(const ScalarField& voxels, const Sampling& sampling) {
  ScalarField field;
  std::array<int, 3> step{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    step[axis] = std::max(1, -sampling[axis]);
    field.size[axis] =
        sampling[axis] > 0 ? voxels.size[axis] * sampling[axis] : (voxels.size[axis] + step[axis] - 1) / step[axis];
  }
  field.values.assign(field.offset(0, 0, field.size[2]), 0.0F);
  const auto cell = [&](std::size_t axis, int voxel) { return voxel / step[axis]; };
  const float share = 1.0F / static_cast<float>(step[0] * step[1] * step[2]);
  const std::array<int, 3> copies{std::max(1, sampling[0]), std::max(1, sampling[1]), std::max(1, sampling[2])};
  std::size_t voxel = 0;
  for (int k = 0; k < voxels.size[2]; ++k)
    for (int j = 0; j < voxels.size[1]; ++j)
      for (int i = 0; i < voxels.size[0]; ++i, ++voxel) {
        if (voxels.values[voxel] == 0) continue;
        for (int c = 0; c < copies[2]; ++c)
          for (int b = 0; b < copies[1]; ++b)
            for (int a = 0; a < copies[0]; ++a)
              field.values[field.offset(cell(0, i) * copies[0] + a, cell(1, j) * copies[1] + b,
                                        cell(2, k) * copies[2] + c)] += share * voxels.values[voxel];
      }
  return field;
}

}  // namespace

ScalarField sharp_field(const LabelMask& mask) {
  ScalarField field{mask.size, {}};
  field.values.assign(mask.inside.begin(), mask.inside.end());
  return field;
}

double sample_place(int sample, int sampling) {
  return sampling > 0 ? (sample + 0.5) / sampling - 0.5 : (sample + 0.5) * -sampling - 0.5;
}

std::size_t count_thin_voxels(const LabelMask& mask) {
  const ScalarField thin = thin_parts(mask);
  return static_cast<std::size_t>(
      std::count_if(thin.values.begin(), thin.values.end(), [](float value) { return value > 0; }));
}

ScalarField smooth_field(const LabelMask& mask, const SmoothingWidths& widths, const Sampling& sampling) {
  ScalarField voxels = sharp_field(mask);
  for (const ImageSide& side : cut_sides(mask, mask.size, {1, 1, 1}))
    beyond(voxels, side, [](float& outside, float last) { outside = last; });
  ScalarField broad = resampled(voxels, sampling);
  std::array<double, 3> per_voxel{};
  for (std::size_t axis = 0; axis < 3; ++axis) per_voxel[axis] = std::max(1, sampling[axis]);
  ScalarField weight = thin_parts(mask);
  const bool thin = std::any_of(weight.values.begin(), weight.values.end(), [](float value) { return value > 0; });
  ScalarField narrow;
  if (thin) narrow = broad;
  for (std::size_t axis = 0; axis < 3; ++axis)
    convolve_axis(broad, axis, gaussian_kernel(widths.broad * per_voxel[axis]));
  if (!thin) return broad;
  widen(weight);
  weight = resampled(weight, sampling);
  for (std::size_t axis = 0; axis < 3; ++axis)
    convolve_axis(narrow, axis, gaussian_kernel(widths.thin * per_voxel[axis]));
  for (std::size_t n = 0; n < broad.values.size(); ++n)
    broad.values[n] += weight.values[n] * (narrow.values[n] - broad.values[n]);
  return broad;
}

ScalarField signed_field(const ScalarField& field, const LabelMask& mask, const Sampling& sampling, double level) {
  ScalarField result = field;
  for (float& value : result.values) value -= static_cast<float>(level);
  for (const ImageSide& side : cut_sides(mask, field.size, sampling))
    beyond(result, side, [](float& outside, float last) { outside = -std::abs(last); });
  return result;
}

}  // namespace trocar
