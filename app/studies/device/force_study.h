// `trocar study force`: the thesis' force correspondence (3.6), direction and magnitude of six wrenches at home.
//
// 1 N along +-Z6 and +-Y6, 1 N m about +-X6, asked through DAC codes without compensation of weight, as there. A stiff
// fixture holds the stylus by a force and torque sensor; it comes to the home pose from either side of every
// joint, so that friction shows with both signs, and what it reads without a wrench is taken off. Thread: any.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult force_study(const StudyRequest& request);

}  // namespace trocar
