// Thesis 3.7, second to fourth experiment (figures 3.44 to 3.52): the stylus, a cylinder, is turned about X6, Y6 or Z6
// until its end meets a virtual cube, twice; desired wrench beside the one that a sensor measures.
//
// The figures give no dimensions. Which way the cylinder lies follows from the signs that the thesis expects, M = r x F
// with r from the stylus origin to the contact:
//   torque-x  +Mx with +Fz and -Fy: r along +Y6, the cube's face looks along Z6 of rest, turn about -X6
//   torque-y  +My with +Fx and less -Fz: r along +Z6, the face looks up (X6 of rest), turn about -Y6
//   torque-z  first -Mz with +Fx and -Fy, then +Mz with +Fx and +Fy: r along +Y6, then -Y6; the face looks up;
//             turn about +Z6, then -Z6
// The cylinder is 200 mm long, 10 mm thick, its middle in the stylus origin. Rest is the home orientation with the
// origin drawn back from home: to -255 mm for torque-x, to -200 mm for the others, where less friction stands along the
// arm. Contact times are the thesis' where it gives them: 10.15-15.65, 6.98-9.35, 5.60-8.70 and 11.50-14.70 s; the
// second contacts of torque-x (17.5-20.5 s) and torque-y (11.5-13.9 s) are choices. Idling before 8.5, 5.5 and 4.0 s is
// left out. Thread: any.
#pragma once

#include <vector>

#include "app/studies/contact/contact_experiment.h"
#include "app/studies/study.h"

namespace trocar {

/// A component and the sign that the thesis expects of it.
struct ExpectedSign {
  Component which;
  int sign;
};

struct TorqueContact {
  double touch_s = 0, leave_s = 0;
  bool thesis_times = false;
  std::vector<ExpectedSign> expected;  ///< the intended torque first
};

struct TorqueExperiment {
  char axis = 'x';
  ContactExperiment experiment;
  std::vector<TorqueContact> contacts;
};

/// @param turn_rad how far the hand turns the stylus. @throws std::invalid_argument for another axis than x, y, z.
TorqueExperiment torque_experiment(char axis, double turn_rad);

/// @throws BenchFault.
StudyResult torque_study(char axis, const StudyRequest& request);

}  // namespace trocar
