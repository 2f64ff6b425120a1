// How stiff the contacts of an attempt were beside what the device can display (haptics/contact/stiffness_limit.h),
// from the rows of its recording.
//
// Counted are the ticks that felt a spring. asked: stiffness of the contact at the stylus, the force scale included;
// share: min(1, K_max / asked), of the asked stiffness that K_max leaves. Thread: any, pure.
#pragma once

#include <span>

#include "app/session/recording/recorded_tick.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// @param clamped whether contacts stiffer than K_max were weakened to it. Rows of a recording before format 3 say
/// nothing.
StiffnessReport stiffness_report(std::span<const RecordedTick> rows, bool clamped);

}  // namespace trocar
