// How fast a hand that feels nothing presses into what its instrument touches: so that the force grows by as much a
// second whatever it is, and can be had by eye.
//
// How stiff that is comes from the way so far and the force that it took. SI. Thread: whoever holds it.
#pragma once

#include <algorithm>

namespace trocar {

class CarefulPress {
 public:
  static constexpr double kRate = 0.45;                  ///< N/s, within
  static constexpr double kSlow = 0.003, kFast = 0.012;  ///< m/s: of 150 N/m and more; of 38 N/m and less
  static constexpr double kKnown = 0.0005;               ///< m that tell how stiff it is

  double speed(double force_n) const {
    if (pressed_m_ < kKnown || force_n <= 0) return kSlow;
    return std::clamp(kRate * pressed_m_ / force_n, kSlow, kFast);
  }
  /// @param deeper_m into what is touched; less than 0: out of it
  void go(double deeper_m) { pressed_m_ = std::max(0.0, pressed_m_ + deeper_m); }
  void leave() { pressed_m_ = 0; }

 private:
  double pressed_m_ = 0;  ///< since it is touched
};

}  // namespace trocar
