// What the display says of an organ that gives way: what was done to it, how it bleeds, what is in hand; and why blades
// or a clip applier refused.
//
// It reads the world's frame alone, so playback and films say the same. Thread: any.
#pragma once

#include <vector>

#include "app/picture/scene/scene_view.h"
#include "app/session/session.h"

namespace trocar {

/// Nothing is asked on the organ: no steps and no targets are listed.
bool plays_freely(const Scene& scene);

/// Instrument, pedal; where the organ gives way also cuts, tears, clips, blood, heat.
std::vector<HudRow> free_play_rows(const SessionView& view);

/// A refusal of the last seconds, blood that comes fast.
void add_surgery_notices(const SessionView& view, std::vector<HudNotice>& notices);

}  // namespace trocar
