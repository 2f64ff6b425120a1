// A voxel mask as a smooth scalar field: about 1 inside, 0 outside, between them across the organ's surface.
//
// Gaussian of the mask, sigma in voxels along each axis. Where the mask is too thin to
// hold a voxel with all six neighbours, a narrower Gaussian keeps it from melting away; the two fields are blended
// smoothly. Where the image ends inside the organ, the organ is taken to go on beyond, so that the cut is not rounded;
// the cut itself is put back by `signed_field`. Thread: any.
#pragma once

#include <array>
#include <vector>

#include "tissue/imaging/labels/label_mask.h"

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
  double broad = 0.65;  ///< voxels; where the organ is thick
  double thin = 0.4;    ///< voxels; where it is thinner than three voxels
};

/// How finely the field is sampled against the voxels, along each axis: 2 puts two samples into a voxel, -2 one into
/// two voxels.
using Sampling = std::array<int, 3>;

/// Margin that the mask needs so that the field vanishes at the border of its box.
inline constexpr int kSmoothingMargin = 4;

/// @param mask with a margin of kSmoothingMargin
/// @param sampling 1, 2, -2, -3, ... for each axis; the widths count in samples where that is coarser than a voxel
ScalarField smooth_field(const LabelMask& mask, const SmoothingWidths& widths, const Sampling& sampling = {1, 1, 1});

/// Place of a sample in voxels of the mask's box.
double sample_place(int sample, int sampling);

/// field - level, with the image's border put back as a flat cap half-way between the last slice inside and the first
/// outside.
ScalarField signed_field(const ScalarField& field, const LabelMask& mask, const Sampling& sampling, double level);

/// The mask itself, 0 and 1.
ScalarField sharp_field(const LabelMask& mask);

/// Voxels of the mask farther than two steps from every voxel whose six neighbours are inside too: parts under three
/// voxels thick.
std::size_t count_thin_voxels(const LabelMask& mask);

}  // namespace trocar
