// The exchange of instruments: the one in hand is drawn back along its shaft, the next of the list comes forward.
//
// Every rising edge of the switch asks for the next of the list, after the last the first. The instrument in hand is
// drawn back by kWay_m in kPart_s, slowly at first, while its jaws close and the scene's force fades; there the next
// takes its place, waits kRest_s for a patch of its own, and comes forward as the other went. So neither pose nor force
// jumps, and nothing appears within the tissue. Edges that come meanwhile count. Thread: haptic task; no allocation.
#pragma once

#include <cstdint>

namespace trocar {

class InstrumentExchange {
 public:
  static constexpr double kPart_s = 0.100, kRest_s = 0.030;
  static constexpr double kWay_m = 0.025;  ///< more than any jaws are long

  /// @param count instruments of the list, at least 1. With one the switch does nothing.
  explicit InstrumentExchange(std::int32_t count) : count_(count) {}

  /// One tick. @param pressed the switch; closed from the start it counts from when it has been open
  /// @return whether another instrument has just taken its place
  bool update(bool pressed, double dt_s);

  std::int32_t index() const { return index_; }  ///< in hand
  double share() const { return share_; }        ///< of the scene's force that is passed on, 0..1
  double drawn_m() const { return (1 - share_) * (1 - share_) * kWay_m; }  ///< how far back the instrument is
  bool in_hand() const { return share_ == 1; }                             ///< none is on its way

 private:
  std::int32_t count_, index_ = 0, wanted_ = 0;
  double share_ = 1, rest_s_ = 0;
  bool was_pressed_ = true;
};

}  // namespace trocar
