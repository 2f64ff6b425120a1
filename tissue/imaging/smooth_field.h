// A voxel mask as a smooth scalar field: about 1 inside, 0 outside, between them across the organ's surface.
//
// Gaussian of the mask, sigma in voxels along each axis. Where the mask is too thin to
// hold a voxel with all six neighbours, a narrower Gaussian keeps it from melting away; the two fields are blended
// smoothly. Thread: any.
#pragma once

#include <array>
#include <vector>

#include "tissue/imaging/label_mask.h"

namespace trocar {

struct ScalarField {
  std::array<int, 3> size{};
  std::vector<float> values;  ///< i fastest, size[0] * size[1] * size[2]

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
};

struct SmoothingWidths {
  double broad = 0.8;  ///< voxels; where the organ is thick
  double thin = 0.4;   ///< voxels; where it is thinner than three voxels
};

/// Margin that the mask needs so that the field vanishes at the border of its box.
inline constexpr int kSmoothingMargin = 4;

/// @param mask with a margin of kSmoothingMargin
ScalarField smooth_field(const LabelMask& mask, const SmoothingWidths& widths);

/// The mask itself, 0 and 1.
ScalarField sharp_field(const LabelMask& mask);

}  // namespace trocar
