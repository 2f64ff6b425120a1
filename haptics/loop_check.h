// Can a loop be run like this? What would make it push where it should hold, or never stop, is refused before it runs:
// numbers that are none, limits that limit nothing, amplifiers of the wrong sign, rates that no board has.
//
// Thread: any; not for the tick.
#pragma once

#include <string>

#include "haptics/haptic_loop.h"

namespace trocar {

/// The first thing that is wrong, by the field's name; empty when the loop can be.
std::string loop_refusal(const HapticLoopConfig& config);

}  // namespace trocar
