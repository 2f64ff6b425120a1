// Pieces that displays of all kinds are put together from. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "app/picture/scene/scene_view.h"
#include "app/session/session.h"

namespace trocar {

/// @param format of printf for one number.
std::string hud_number(const char* format, double value);
HudStep hud_step(const char* words, bool done, bool current);
/// "3 / 12" targets.
std::string targets_done(const Scene& scene, const DirectorStatus& status);
/// "3 / 12" of the targets from one number on to before another.
std::string of_count(const DirectorStatus& status, int from, int to);
/// Percent of the present hold.
HudRow hold_row(const DirectorStatus& status);
ForceBar force_bar(const char* label, double value_n, const WantedForce& band, double limit_n);
/// Of the tip, as far as the level shows it, with its peak. @pre the kind judges the force of the tip
std::vector<ForceBar> tip_bar(const SessionView& view, const char* label, const WantedForce& band);
/// Of tissue that is held: its pull, and the grip on it.
std::vector<ForceBar> pull_and_grip(const SessionView& view, const WantedForce& grip);
/// On the lit object, as far as the level shows it. Where no colour tells the foam, the bar does not either: it then
/// spans all kinds.
std::vector<ForceBar> grip_of_lit_object(const SessionView& view);
/// Why a bar is hidden. @param display of the level: band | after.
std::string hidden_note(const std::string& display);

}  // namespace trocar
