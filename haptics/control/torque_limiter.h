// Who gets the torque: limit springs, then gravity, then contact and pinch scaled down together (direction kept), then
// friction compensation, then the alignment spring of the port; total clamped per joint and limited in rate.
//
// Design: docs/device_and_safety.md. The part of the contact torque that was really applied is returned for the
// passivity observer. Channels 0..5 N m, 6 N. Thread: haptic task; no allocation.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

struct TorqueShares {
  ChannelVector springs = ChannelVector::Zero();
  ChannelVector gravity = ChannelVector::Zero();
  ChannelVector contact = ChannelVector::Zero();  ///< arm contact and pinch
  ChannelVector friction = ChannelVector::Zero();
  ChannelVector alignment = ChannelVector::Zero();
};

struct LimitedTorque {
  ChannelVector total = ChannelVector::Zero();
  ChannelVector contact = ChannelVector::Zero();  ///< what remained of shares.contact
  ChannelVector carried = ChannelVector::Zero();  ///< limit springs and weight
  double contact_scale = 1;                       ///< < 1: saturated
};

class TorqueLimiter {
 public:
  /// @param limit largest torque of each channel; @param rate largest change, unit/s.
  TorqueLimiter(const ChannelVector& limit, const ChannelVector& rate, double period_s)
      : limit_(limit), step_(rate * period_s) {}

  LimitedTorque update(const TorqueShares& shares);
  /// Share of shares.contact for which springs and gravity leave room in every channel, 0..1.
  double room(const TorqueShares& shares) const;
  void reset() { last_.setZero(); }
  /// From the next update on.
  void set_limit(const ChannelVector& limit) { limit_ = limit; }

 private:
  ChannelVector limit_, step_, last_ = ChannelVector::Zero();
};

/// Torque that pushes joints away from their limits inside the margin: a damped spring, never a pull.
/// @param q rad; @param qd rad/s.
ChannelVector limit_spring_torque(const JointVector& q, const JointVector& qd);

/// 1 while det A is healthy, falling linearly to 0 as the shoulder nears its singularity.
double singularity_share(double det_a);

}  // namespace trocar
