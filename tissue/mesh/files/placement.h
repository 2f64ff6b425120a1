// From units and axes of a file to metres in RAS: who says what they are, and a sentence about it.
//
// Thread: any.
#pragma once

#include "tissue/mesh/files/surface_file.h"
#include "tissue/organ/surface_import.h"

namespace trocar {

struct Placement {
  double unit_m = 1;
  std::string unit, frame;
  Mat3 to_ras = Mat3::Identity();
  std::vector<std::string> decisions;

  Vec3 placed(const Vec3& point) const { return unit_m * (to_ras * point); }
  bool mirrors() const { return to_ras.determinant() < 0; }
};

/// @param bounds of what is taken, in units of the file
/// @param organ name that the hints go by, "" for none
/// @throws InputError naming the file: no unit and none declared, implausible size, unknown frame or axis
Placement placement_of(const SurfaceFile& file, const SurfaceImportOptions& options, const Eigen::AlignedBox3d& bounds,
                       const std::string& organ, const std::string& path);

}  // namespace trocar
