// The simulated device itself, measured: does it keep its energy, do its motors warm as they should, and does the loop
// hold a wall with every option of the plant on? docs/plant.md.
#pragma once

#include "app/studies/study.h"

namespace trocar {

/// Takes the device of the request for the energy and the wall; heat and cable are closed systems of their own.
StudyResult plant_study(const StudyRequest& request);

}  // namespace trocar
