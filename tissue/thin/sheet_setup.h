// A sheet of tissue as a scene lays it out: where it lies, what it is made of, where it hangs on the organ or in a
// frame.
//
// T, SI. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/solid/tissue_material.h"

namespace trocar {

struct SheetSetup {
  std::string name;                 ///< "flap"
  TriangleSurface drawn_T;          ///< its middle surface, as it lies and rests
  std::vector<std::int32_t> hinge;  ///< vertices that hang on the organ, or in the frame
  double thickness_m = 0.001;
  TissueSolid material;
  bool framed = false;  ///< spread in a frame that stands still; else on the organ
};

}  // namespace trocar
