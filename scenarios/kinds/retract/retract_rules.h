// Retract and hold: tissue to be taken, lifted and held, as an exercise file describes it.
//
// Lengths m, forces N. Thread: plain values, fixed after loading.
#pragma once

#include "scenarios/exercise.h"

namespace trocar {

struct RetractRules : KindRules {
  double reach_m = 0;          ///< from the axis of a place: tissue that is taken further off does not count
  double exposed_share = 0;    ///< of the lift: from here on what lies behind is to be seen
  double too_hard_share = 0;   ///< of the hold above the hard limit, together: a critical error
  double grip_low_n = 0;       ///< wanted grip: it holds what is pulled ...
  double grip_high_n = 0;      ///< ... and spares the tissue
  double grip_critical_n = 0;  ///< where the pads damage what they hold
};

struct RetractLevel : KindRules {
  double lift_m = 0;  ///< up from where the tissue was taken: all that lies behind is to be seen
};

}  // namespace trocar
