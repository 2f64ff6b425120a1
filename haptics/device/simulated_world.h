// What lies behind a simulated device: the person's hand on the stylus, and what that person senses.
//
// Only a simulated back-end has one. Tasks that play the person (hand, force tap) see this and no more of the back-end.
// Poses in W'. Thread: the haptic task's, which those tasks share; no call allocates, locks or throws.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

/// What the simulated person senses of the device, true values in W'.
struct HandSense {
  Pose X_BS;                          ///< stylus
  Vec3 force_on_hand = Vec3::Zero();  ///< N, mean over the last period
  double force_on_finger_n = 0;       ///< N, mean over the last period, positive opens the fingers
  double jaw_opening_m = 0;
  bool amplifiers_enabled = false;
  bool in_jig = true;
  Vec3 moment_on_hand = Vec3::Zero();  ///< N m about the stylus origin, mean over the last period
};

class SimulatedWorld {
 public:
  virtual ~SimulatedWorld() = default;
  /// Intent of the hand for the coming period: stylus pose, jaw opening in m. The first one takes hold.
  virtual void set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept = 0;
  /// The hand's clutch switch, from the next period on.
  virtual void press_clutch(bool pressed) noexcept = 0;
  /// The pedal under the person's foot, from the next period on.
  virtual void press_pedal(bool pressed) noexcept = 0;
  /// The switch that asks for the next instrument, from the next period on.
  virtual void press_exchange(bool pressed) noexcept = 0;
  /// The enabling switch in the handle, pressed at first; it counts only while the hand holds the stylus.
  virtual void press_deadman(bool pressed) noexcept = 0;
  /// The person leads the arm by hand, motors off, to where each joint is so far from its place in the jig (rad), and
  /// holds it there; zero puts the stylus into its jig.
  virtual void lead_arm(const JointVector& from_jig, double seconds) noexcept = 0;
  virtual HandSense sense() const noexcept = 0;
  /// Live: lets one period pass that the loop has missed. The next read() counts it.
  virtual void miss_sync() noexcept = 0;
  /// Time of the last SYNC, s.
  virtual double time_s() const noexcept = 0;
};

}  // namespace trocar
