// The grid on which contours are filled: slices along the last axis, so that every contour lies in a plane of constant
// k.
//
// Either an image's grid with its axes turned so, or one made from the planes of the contours themselves. Frame RAS,
// mm; contours come in LPS. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/structure_contours.h"
#include "tissue/imaging/volumes/image_volume.h"

namespace trocar {

inline constexpr double kSamePlaneSlices = 0.05;  ///< contours closer than this share a plane
inline constexpr double kOnSlice = 0.1;  ///< a plane farther than this from a slice's middle lies between slices

struct ContourGrid {
  std::array<int, 3> size{};
  Eigen::Affine3d index_to_ras_mm = Eigen::Affine3d::Identity();

  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  double step_mm(int axis) const { return index_to_ras_mm.linear().col(axis).norm(); }
  /// @param lps mm
  Eigen::Vector3d index_of(const Eigen::Vector3d& lps) const {
    return index_to_ras_mm.inverse() * Eigen::Vector3d(-lps.x(), -lps.y(), lps.z());
  }
};

/// The image's grid with the axis that the contours are normal to as the last.
/// @throws InputError when the contours do not lie in planes of one of its axes
ContourGrid image_contour_grid(const ImageVolume& image, const std::vector<Structure>& structures,
                               const std::string& file);

/// Slices where the contours lie, and an empty one at either end: nothing is cut off there; in them square pixels of 1
/// mm, less for small structures, with a margin of two.
/// @throws InputError when the planes are not parallel or not evenly spaced, or the grid would be too large
ContourGrid own_contour_grid(const std::vector<Structure>& structures, const std::string& file);

}  // namespace trocar
