// A player who sees nothing but pictures of the window and answers with its hand, as slowly as a person does.
//
// From each picture it takes what stands out in it: the yellow outline of what is lit, the pink plumb line and its
// foot, the force bar at the tip, the dial's pointers. It sees them 0.3 s late, and after each movement waits to see
// what became of it. It knows no scene, no force and no depth. Test support.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/gl/image.h"
#include "tests/app/window/play/player_hand.h"

namespace trocar::testing_support {

struct Spot {
  double x = 0, y = 0;
};

/// What the eye takes from one picture.
struct Glance {
  std::optional<Spot> lit, tip, foot;  ///< middle of the outline; upper end of the plumb line; its foot
  double high = 0, lit_wide = 0;       ///< px: the picture, the outline
  enum class Force { kNone, kLow, kGood, kHigh } force = Force::kNone;  ///< colour of the bar at the tip
  /// The two dials: where the yellow dot is, 1 at the rim, up positive; nothing while it is within its ring.
  std::optional<Spot> place, turn;
  double roll_rad = 0;       ///< of the white mark, from the top, clockwise
  std::optional<Spot> glow;  ///< middle of the largest yellow: on a board, where what is carried belongs
};
Glance glance(const Image& picture);

class PicturePlayer {
 public:
  static constexpr double kEye_s = 0.3;

  /// What the briefing has taught.
  enum class Task { kTouch, kReach, kGrasp, kRetract, kPegs };
  PicturePlayer(PlayerHand& hand, Task task) : hand_(hand), task_(task) {}
  /// Whether it looks now: not while its hand moves, and not before what it has done can be seen.
  bool looks(double t_s) const;
  /// @param t_s clock. @param picture nullptr: it did not look. @return what it does now.
  std::vector<InputEvent> play(double t_s, const Image* picture);
  std::string doing;  ///< for whoever watches it

 private:
  std::vector<InputEvent> decide(double t_s, const Glance& seen);
  std::vector<InputEvent> aim(double t_s, const Spot& from, const Spot& to);
  std::vector<InputEvent> press(double t_s, const Glance& seen);

  struct Moment {
    double t_s;
    Glance seen;
  };
  std::vector<InputEvent> grasp(double t_s, const Glance& seen);
  std::vector<InputEvent> retract(double t_s, const Glance& seen);
  std::vector<InputEvent> reach(double t_s, const Glance& seen);

  PlayerHand& hand_;
  Task task_;
  std::deque<Moment> eye_;
  double looked_s_ = -9, hand_s_ = -9, wait_until_s_ = 0, since_s_ = 0, dark_s_ = -1, settled_s_ = -9, plumb_px_ = 0;
  enum class Stage { kAim, kPress, kKeep, kLift, kCarry } stage_ = Stage::kAim;
  bool down_ = false;
  std::optional<Spot> goal_, ball_;
};

}  // namespace trocar::testing_support
