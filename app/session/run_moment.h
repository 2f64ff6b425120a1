// One moment of an attempt as a whole value: what a picture, a screen or a scrub bar needs. Copied between threads.
//
// Frame T, SI units. Live it is the newest one (app/window/attempt/attempt_runner.h), in a replay any one
// (app/session/playback).
#pragma once

#include <vector>

#include "app/session/session.h"
#include "haptics/exchange/tick_record.h"
#include "scenarios/director/director.h"
#include "scenarios/hands/hand.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct RunMoment {
  TickRecord record;
  DirectorStatus status;
  TissueFrame tissue;
  double t_s = 0;                ///< loop time
  bool seen = false;             ///< false: nothing has been seen of the run yet
  std::uint64_t steered = 0;     ///< number of the newest intent of a person that the device had felt by then; 0: none
  SurfacePtr organ_T = nullptr;  ///< the organ as it was; nullptr: as the scene has it
  std::vector<SurfacePtr> thin_T = {};  ///< the thin parts as they were; empty: as the scene has them
};

/// The moment as pictures and displays take it. Refers to both arguments.
inline SessionView view_of(const Scene& scene, const RunMoment& moment) {
  return {scene,          moment.record, {moment.status, scene.board}, moment.t_s, &moment.tissue,
          moment.organ_T, moment.thin_T};
}

}  // namespace trocar
