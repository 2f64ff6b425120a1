// `trocar study hardware`: what two cheap changes of the device's electronics would bring: counters that tell the time
// of their last edge, and amplifiers set to the motors' short-term peak torque. On the simulated plant.
//
// The presses of the passivity study under the default law, done again with each; what peak torque gives at rest and
// how long the winding bears it. Neither is on by default: the thesis' boards do not tell edges, and its amplifiers are
// set to 100 mN m. Thread: any.
#pragma once

#include "app/studies/study.h"

namespace trocar {

/// @throws BenchFault.
StudyResult hardware_study(const StudyRequest& request);

}  // namespace trocar
