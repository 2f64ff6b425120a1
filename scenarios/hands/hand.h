// The hand as the rest of the program meets it: what it intends upon what it perceives. A hand never sets the pose of
// the stylus; its intent pulls the stylus through the impedance of the plant's hand_model.h.
//
// Frame: theatre T; the hand task turns an intent into device coordinates through the inverse of the exercise's
// instrument map. Rate: hands are asked once a loop period. Must not allocate.
#pragma once

#include "scenarios/hands/percept.h"

namespace trocar {

/// Where the hand wants the instrument to be.
struct HandIntent {
  Pose X_TI;                    ///< wanted pose of the instrument tip in the theatre
  double jaw_opening_m = 0.02;  ///< wanted opening of the fingers at the pads
  bool clutch = false;          ///< holds the clutch: X_TI then says where the stylus would bring the instrument
  bool pedal = false;           ///< holds the pedal down
  bool exchange = false;        ///< presses the switch that asks for the next instrument
};

class Hand {
 public:
  virtual ~Hand() = default;
  /// Called once a period of the simulated device. @param dt_s time since the previous call, s.
  virtual HandIntent update(const Percept& percept, double dt_s) = 0;
};

}  // namespace trocar
