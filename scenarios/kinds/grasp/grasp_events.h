// Events of blocks that no metric counts; those that one does stand in scenarios/scoring/event_types.h.
#pragma once

#include "scenarios/scoring/event_types.h"

namespace trocar::event_type {

inline constexpr EventType kGrasped{"GRASPED"}, kWrongBlock{"WRONG_BLOCK"}, kPlaced{"PLACED"}, kRemoved{"REMOVED"},
    kLost{"LOST"};

}  // namespace trocar::event_type
