// `trocar study zwidth`: how stiff a wall may be, by damping, law and rate. On the simulated plant.
//
// Protocol of the haptics notes, section 2: for each damping B of the wall the stiffness K climbs a geometric ladder; a
// rung is held when 19 of its 20 contacts (drawn by the seed over speeds, grips, poses and directions; the same for
// every rung) are stable by WallOutcome::stable(): one, at 0.9 m/s, swings back on the hand's own account. The width is
// the last rung held. Beside it: the stiffness that is displayed there, the rung up to which half settle within 0.1 s,
// the one up to which 19 of 20 give less than 1 mJ, and the limits of theory. B of the wall acts through the contact
// law's factor and is exact at kDampingDepth.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult zwidth_study(const StudyRequest& request);

}  // namespace trocar
