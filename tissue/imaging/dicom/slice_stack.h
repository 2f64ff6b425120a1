// A pile of slices as a regular grid: order, steps and shear from the slices' positions, never from tags such as
// SliceThickness.
//
// With normal n = along_row x along_column and positions p_k sorted by n.p, the grid is regular when p_k = p_0 + k (h n
// + s) with one step h and one in-plane shift s (a tilted gantry). Frame LPS, mm. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/dicom_instance.h"

namespace trocar {

struct StackSlice {
  SlicePlace place;
  int rows = 0, columns = 0;
  std::string name;  ///< in messages
};

struct SliceStack {
  std::vector<std::size_t> order;  ///< of the slices given, along the normal
  Eigen::Vector3d origin, along_row, along_column, normal;
  double row_step = 1, column_step = 1, slice_step = 1;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< mm a slice, along row and column; 0 when it does not matter
  double tilt_deg = 0;                              ///< between the pile's direction and the normal; 0 as above
  int rows = 0, columns = 0;
};

/// @param input begins messages that are not about one file
/// @throws InputError naming the slices: other size, spacing or orientation, two in one place, gaps, uneven distances
/// or shifts;
///         fewer than two
SliceStack stacked(const std::vector<StackSlice>& slices, const std::string& input);

}  // namespace trocar
