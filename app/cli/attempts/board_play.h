// Boards proved by playing: the scripted expert's attempt at each, in lockstep on the simulated plant.
//
// Reach and torque say what the device can do; whether a board on an organ of one's own can be finished shows when it
// is played. Recordings are kept in the cache (app/session/playback/expert_run.h), so a board is played once a version.
// Thread: starts some, each with attempts of its own.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/session/setup/scene.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

struct PlayedBoard {
  int board = 0;
  AttemptStatus status = AttemptStatus::kAborted;
  double score = 0;  ///< 0 without a grade
  std::string why;   ///< why it is not sound: not finished, or finished and not passed; empty when it is
};

/// What the expert made of a level: practice boards 0 to 19; of an exam those that seeds 0 to 19 draw.
struct PlayedLevel {
  std::vector<PlayedBoard> boards;
  /// "" when all are sound, else the first that is not, and how many.
  std::string why() const;
};

/// @param organ as given on the command line. @param err for progress. @throws InputError; Interrupted.
PlayedLevel play_level(const Exercise& exercise, const std::string& level, const std::string& organ,
                       const AssetRoots& assets, std::ostream& err);

}  // namespace trocar
