// A synthetic abdominal CT with its label map, drawn from analytic shapes: shippable, and made by nobody's patient.
//
// Shapes are implicit functions in the patient frame (RAS, mm, origin in front of the spine at the level of the porta
// hepatis); sizes follow common textbook proportions of an adult. Portal venous phase. Labels are numbered as in the
// table "totalsegmentator-v1". Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tissue/imaging/label_volume.h"

namespace trocar {

struct PhantomOptions {
  double voxel_mm = 2.5;
  double noise_hu = 40;    ///< standard deviation before the blur, which leaves about a quarter of it
  std::uint64_t seed = 1;  ///< of the noise; the anatomy is always the same
};

struct CtPhantom {
  LabelVolume labels;
  std::vector<std::int16_t> hounsfield;  ///< on the grid of the labels
};

CtPhantom make_phantom(const PhantomOptions& options);

/// Signed distance (approximate, mm, negative inside) of the phantom's organs, for tests and pictures.
double phantom_liver_mm(const Eigen::Vector3d& point_mm);
double phantom_gallbladder_mm(const Eigen::Vector3d& point_mm);

}  // namespace trocar
