// `trocar study zwidth`: how stiff a wall may be, by damping, law and rate. On the simulated plant.
//
// Protocol of the haptics notes, section 2: for each damping B of the wall the stiffness K climbs a geometric ladder; a
// rung is held when all of its contacts (20, drawn by the seed over speeds, grips, poses and directions; the same for every
// rung) are stable by WallOutcome::stable(). The width is the last rung held. Beside it: the stiffness that is displayed
// there, the rung up to which every contact settles within 0.1 s, and the limits of theory. B of the wall acts through
// the contact law's factor and is exact at kDampingDepth.
#pragma once

#include "app/study/study.h"

namespace trocar {

StudyResult zwidth_study(const StudyRequest& request);

}  // namespace trocar
