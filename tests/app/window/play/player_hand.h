// Hands of a player at a mouse, at keys, at a pad: what it wants becomes events as a person at them would send.
//
// Ways are in pixels of the picture. Keys and sticks have speeds: whoever plays with them knows by practice how long a
// way takes, roughly; that is all that they know. Test support.
#pragma once

#include <memory>
#include <vector>

#include "app/window/input/input_event.h"

namespace trocar::testing_support {

class PlayerHand {
 public:
  virtual ~PlayerHand() = default;
  virtual std::vector<InputEvent> move(double right_px, double down_px) = 0;
  /// Press or close: held or let go.
  virtual std::vector<InputEvent> act(bool down) = 0;
  /// Drags the shaft's far end by so much.
  virtual std::vector<InputEvent> lean(double right_px, double down_px) = 0;
  /// By notches of 4 degrees.
  virtual std::vector<InputEvent> roll(int notches) = 0;
  /// @return what is due by now: what has been held long enough is let go.
  virtual std::vector<InputEvent> pass(double) { return {}; }
  virtual bool busy() const { return false; }
};

/// @param height_px of the picture. Null for others than mouse, keyboard and gamepad.
std::unique_ptr<PlayerHand> player_hand(InputKind input, double height_px);

}  // namespace trocar::testing_support
