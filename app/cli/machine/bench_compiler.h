// What the organ compiler costs: from a label map of CT size, made in memory, to an organ.
//
// The organ has the size, the bends and the cut of a liver: a lobed body of about 1.1 litres that the last slice cuts,
// on voxels of 0.7 x 0.7 x 1.5 mm. Same size, same voxels. RAS, mm. Thread: any, not the tick.
#pragma once

#include <array>
#include <cstddef>

#include "tissue/imaging/labels/label_volume.h"

namespace trocar {

/// Label 1 in a body of the shape and the share of a liver in a scan of the abdomen. @param size voxels, each >= 16
LabelVolume liver_like_labels(const std::array<int, 3>& size);

struct CompilerCost {
  std::array<int, 3> size{};       ///< voxels of the label map
  std::size_t raw_triangles = 0;   ///< of the iso surface of the mask, before anything is smoothed
  std::size_t triangles = 0;       ///< of the organ
  double cpu_s = 0;                ///< of this thread: from the label map in memory to the organ and its facts
  double peak_growth_mb = 0;       ///< of the program's largest memory ever, 10^6 bytes; 0 when it once held more
  double mean_mm = 0, p99_mm = 0;  ///< distance from the organ to the label
};

/// Compiles the liver-like body once.
CompilerCost compiler_cost(const std::array<int, 3>& size, int triangles);

}  // namespace trocar
