// Puts on the "screen" of a hand what the director asks for: cue, target, wanted band. Position, force and delays are
// the hand task's part.
#pragma once

#include "scenarios/director/director.h"
#include "scenarios/hands/percept.h"

namespace trocar {

/// Fills cue, target_index, the target's place and orientation, and the band of the percept. While waiting the target
/// is the start sphere (index -1); while gripping the band is that of the grip.
void show_cue(const DirectorStatus& status, Percept& percept);

}  // namespace trocar
