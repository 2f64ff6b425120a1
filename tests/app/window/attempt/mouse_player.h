// A person at the mouse who sees nothing but the screen: where tip, lit target and start ball are in the picture, the
// force bar, the dial, the toast, which of two things that overlap hides the other. All of it 200 ms late, as eyes are.
// Depth is never told: it is found by going deeper until something happens.
//
// Drives Steering by events, as a window would, fifty times a second, in a lockstep session: no clock. Test support.
#pragma once

#include <deque>
#include <functional>
#include <memory>

#include "app/session/session.h"
#include "app/window/attempt/person_hand.h"
#include "app/window/input/steering.h"

namespace trocar {

class MousePlayer {
 public:
  explicit MousePlayer(const Scene& scene, const SteeringOptions& options = {});
  /// What a run is given so that this player plays it.
  SessionHooks hooks();

 private:
  /// What the eye takes from one picture.
  struct Seen {
    bool ready = false;
    Eigen::Vector2d tip = Eigen::Vector2d::Zero(), goal = Eigen::Vector2d::Zero();  ///< px
    bool goal_seen = false, goal_hides_tip = false;                                 ///< where they overlap
    double force_n = 0, band_low_n = 0, band_high_n = 0, grip_n = 0;                ///< bars
    PoseDial dial;
    bool has_dial = false;
    std::string toast;
    int target = -1;
    Phase phase = Phase::kReady;
    Cue cue = Cue::kNone;
  };
  void look(const SessionView& view);
  Seen see(const SessionView& view) const;
  void act(const Seen& seen);
  void find_start(const Seen& seen);
  void touch(const Seen& seen);
  void squeeze(const Seen& seen);
  void match_pen(const Seen& seen);

  // what the hand can do
  void move(const Eigen::Vector2d& by_px);
  void wheel(int notches, bool fine);
  void button(MouseButton which, bool down);
  void key(std::int32_t which, bool down);
  bool often(double seconds);  ///< at most so often

  const Scene& scene_;
  Camera camera_;
  Steering steering_;
  std::unique_ptr<HandLink> link_ = std::make_unique<HandLink>();
  std::deque<Seen> eye_;
  double t_s_ = 0, next_s_ = 0, last_s_ = -1, wheeled_s_ = 0;
  bool begun_ = false;
  std::uint64_t number_ = 0;
  Eigen::Vector2d pointer_{640, 360};
  bool left_ = false, right_ = false, control_ = false, shift_ = false;
  int target_ = -1, back_ = 0, settled_ = 0;
};

}  // namespace trocar
