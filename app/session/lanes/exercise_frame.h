// What the tissue task shows the rest of the program after each of its steps. Written whole, read whole.
#pragma once

#include <cstdint>
#include <vector>

#include "scenarios/director/director.h"
#include "tissue/surface_snapshot.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct ExerciseFrame {
  DirectorStatus status;
  TissueFrame tissue;
  SurfacePtr organ_T;
  std::vector<SurfacePtr> thin_T;  ///< as World::thin()
};

/// One step of the tissue task for the recorder: the schedule of the run, and the phase that a row shows.
struct TissueStep {
  std::uint64_t seen_period = 0;  ///< StylusState::period of the state that the step saw; 0: none yet
  std::uint8_t phase = 0;         ///< Phase after the step
};

}  // namespace trocar
