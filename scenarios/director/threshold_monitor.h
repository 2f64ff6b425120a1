// Turns a signal into single events: fires on entry above a level, re-arms after a time below a lower one.
//
// EXCESS_FORCE: enter F > F_hard, re-arm below 0.8 F_hard for 0.2 s, so that a trembling force counts once.
#pragma once

namespace trocar {

/// Shared by the limits of all kinds: share of the limit, s.
inline constexpr double kRearmShare = 0.8, kRearmTime = 0.2;
inline constexpr double kHoldGrace = 0.1;  ///< s out of what is wanted that only pause a hold

class ThresholdMonitor {
 public:
  /// @param enter fires above this. @param leave, rearm_s: armed again after rearm_s below `leave`.
  /// @param repeat_s fires again after each further time so long above `enter`; 0: once only.
  ThresholdMonitor(double enter, double leave, double rearm_s, double repeat_s = 0)
      : enter_(enter), leave_(leave), rearm_s_(rearm_s), repeat_s_(repeat_s) {}
  /// @returns true in the one update in which the signal enters. @param dt_s time since the previous update.
  bool update(double value, double dt_s);
  bool above() const { return fired_; }

 private:
  double enter_, leave_, rearm_s_, repeat_s_;
  double below_s_ = 0, above_s_ = 0;
  bool fired_ = false;
};

/// Continuous time inside a band: short excursions pause the count; longer ones, or many of them, reset it.
class HoldTimer {
 public:
  /// @param wanted_s complete after this. @param grace_s time outside that is forgiven (not counted); what has been
  /// used of it comes back at a fifth of the time inside, so tapping in and out never completes a hold.
  HoldTimer(double wanted_s, double grace_s) : wanted_s_(wanted_s), grace_s_(grace_s) {}
  /// @returns true once the wanted time is reached.
  bool update(bool inside, double dt_s);
  void reset() { held_s_ = outside_s_ = 0; }
  double progress() const { return held_s_ / wanted_s_; }

 private:
  double wanted_s_, grace_s_;
  double held_s_ = 0, outside_s_ = 0;
};

}  // namespace trocar
