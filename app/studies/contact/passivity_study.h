// `trocar study passivity`: the thesis' three wall experiments (4.3.3) again, the two scenarios that make "off"
// unstable, and the laws side by side on the grid of 100 presses. On the simulated plant.
//
// Settled: last time after touch at which the rendered force differs by 0.1 N or more from its centred 50 ms mean.
// Scenario S1: 150 N/m, 10 ms, fingertip grip, touch at 0.46 m/s. S2: 150 N/m times the thesis' amplifier gain of 5,
// that is 750 N/m, 6 ms, light grip, 0.43 m/s; once with the gain calibrated, once unknown to the loop.
#pragma once

#include "app/studies/study.h"

namespace trocar {

StudyResult passivity_study(const StudyRequest& request);

}  // namespace trocar
