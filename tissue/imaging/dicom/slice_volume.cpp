#include "tissue/imaging/dicom/slice_volume.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"

namespace trocar {
namespace {

/// Pixels that the last slice is moved by.
Eigen::Vector2d last_shift(const SliceStack& stack) {
  const auto last = static_cast<double>(stack.order.size() - 1);
  return {last * stack.shift.x() / stack.row_step, last * stack.shift.y() / stack.column_step};
}

Eigen::Affine3d ras_frame(const SliceStack& stack, const Eigen::Vector2i& margin) {
  Eigen::Affine3d lps = Eigen::Affine3d::Identity();
  lps.linear().col(0) = stack.along_row * stack.row_step;
  lps.linear().col(1) = stack.along_column * stack.column_step;
  lps.linear().col(2) = stack.normal * stack.slice_step;
  lps.translation() = stack.origin - lps.linear().col(0) * margin.x() - lps.linear().col(1) * margin.y();
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  const Eigen::Vector3d flip(-1, -1, 1);
  frame.linear() = flip.asDiagonal() * lps.linear();
  frame.translation() = flip.cwiseProduct(lps.translation());
  return frame;
}

}  // namespace

SliceVolume::SliceVolume(const SliceStack& stack, float outside, const std::string& input)
    : stack_(stack), outside_(outside) {
  const Eigen::Vector2d last = last_shift(stack);
  margin_ = (-last.cwiseMin(0.0)).array().ceil().cast<int>();
  const Eigen::Vector2i after = last.cwiseMax(0.0).array().ceil().cast<int>();
  stored_size_ = {stack.columns + margin_.x() + after.x(), stack.rows + margin_.y() + after.y(),
                  static_cast<int>(stack.order.size())};
  const double voxels = static_cast<double>(stored_size_[0]) * stored_size_[1] * stored_size_[2];
  if (voxels > static_cast<double>(kMostVoxels))
    throw InputError(input + ": the series has " + std::to_string(stored_size_[0]) + " x " +
                     std::to_string(stored_size_[1]) + " x " + std::to_string(stored_size_[2]) +
                     " voxels: more than an import may hold (268 million); cut it down");
  const Eigen::Affine3d frame = ras_frame(stack, margin_);
  const AxisOrder order = ras_order(frame.linear());
  volume_.size = reordered_size(stored_size_, order);
  volume_.index_to_ras_mm = reordered_frame(frame, stored_size_, order);
  volume_.values.assign(volume_.offset(0, 0, volume_.size[2]), outside);
  std::ptrdiff_t stride = 1;
  for (std::size_t world = 0; world < 3; ++world) {
    const auto stored = static_cast<std::size_t>(order.stored[world]);
    stride_[stored] = order.flipped[world] ? -stride : stride;
    if (order.flipped[world]) first_ += stride * (volume_.size[world] - 1);
    stride *= volume_.size[world];
  }
}

std::vector<float> SliceVolume::sheared(std::size_t place, const std::vector<float>& values) const {
  const int width = stored_size_[0], height = stored_size_[1];
  std::vector<float> moved(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), outside_);
  const double share = static_cast<double>(place) / static_cast<double>(stack_.order.size() - 1);
  const Eigen::Vector2d at =
      -(last_shift(stack_) * share) - margin_.cast<double>();  // of output pixel (0, 0) in the slice
  const Eigen::Vector2i base = at.array().floor().cast<int>();
  const Eigen::Vector2d part = at - base.cast<double>();
  const auto value = [&](int x, int y) {
    return static_cast<double>(
        values[static_cast<std::size_t>(y) * static_cast<std::size_t>(stack_.columns) + static_cast<std::size_t>(x)]);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int left = x + base.x(), top = y + base.y();
      const int right = left + (part.x() > 0 ? 1 : 0), bottom = top + (part.y() > 0 ? 1 : 0);
      if (left < 0 || top < 0 || right >= stack_.columns || bottom >= stack_.rows) continue;
      const double upper = (1 - part.x()) * value(left, top) + part.x() * value(right, top);
      const double lower = (1 - part.x()) * value(left, bottom) + part.x() * value(right, bottom);
      moved[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
          static_cast<float>((1 - part.y()) * upper + part.y() * lower);
    }
  return moved;
}

void SliceVolume::put(std::size_t place, const std::vector<float>& values) {
  const bool upright = stack_.shift.isZero(0);
  const std::vector<float>* slice = &values;
  std::vector<float> moved;
  if (!upright) moved = sheared(place, values), slice = &moved;
  const std::ptrdiff_t plane = first_ + static_cast<std::ptrdiff_t>(place) * stride_[2];
  auto from = slice->begin();
  for (int y = 0; y < stored_size_[1]; ++y)
    for (int x = 0; x < stored_size_[0]; ++x)
      volume_.values[static_cast<std::size_t>(plane + y * stride_[1] + x * stride_[0])] = *from++;
}

}  // namespace trocar
