// Puts on the "screen" of a hand what the director asks for: cue, target, wanted band. Position, force and delays are
// the session's part.
#pragma once

#include "haptics/device/hand.h"
#include "scenarios/director.h"
#include "scenarios/exercise.h"

namespace trocar {

/// Fills cue, target_index, target_T, target_normal_T, target_radius_m and the band of the percept.
/// While waiting the target is the start sphere (index -1); while gripping the band is that of the grip.
void show_cue(const DirectorStatus& status, const Board& board, const Exercise& exercise, const ExerciseLevel& level,
              Percept& percept);

}  // namespace trocar
