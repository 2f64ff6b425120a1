// Events of blocks that no metric counts and no page of the desk draws; the others stand in
// scenarios/scoring/event_types.h.
#pragma once

#include "scenarios/scoring/event_types.h"

namespace trocar::event_type {

inline constexpr EventType kGrasped{"GRASPED"}, kWrongBlock{"WRONG_BLOCK"}, kRemoved{"REMOVED"};

}  // namespace trocar::event_type
