// Thesis 3.7, first experiment (figures 3.40 to 3.43): from near the home pose the stylus meets the left, the right and
// the back wall of a notch; desired force beside the one that a sensor measures.
//
// Left is where the wall pushes along -Y6, as the thesis says of its first contact; with X6 up the back then lies along
// -Z6. First contact 7.62 to 8.98 s and second from 10.5 s are the thesis'; the second ends at 12.0 s and the third
// lasts from 13.5 to 15.0 s by choice. The first 6 s of idling are left out. Thread: any.
#pragma once

#include "app/studies/contact/contact_experiment.h"
#include "app/studies/study.h"

namespace trocar {

/// @param past_wall_m how far behind each wall the hand aims.
ContactExperiment walls_experiment(double past_wall_m);

/// @throws BenchFault.
StudyResult walls_study(const StudyRequest& request);

}  // namespace trocar
