// `trocar study sensitivity`: what the stability of contact owes to numbers that nobody has measured. On the simulated
// plant.
//
// The same drawn presses (passivity_grid.h) under the loop's own law, on the arms as drawn and with one property of
// plant or hand halved or raised by half, the controller none the wiser: what breaks first, and where. With sub-steps
// half as long no verdict may change: then the integration of the plant has converged. Thread: starts workers of its
// own.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult sensitivity_study(const StudyRequest& request);

}  // namespace trocar
