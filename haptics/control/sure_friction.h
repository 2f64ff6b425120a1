// What friction surely takes: the part of it that every device of this kind has, or that was identified.
//
// A channel that turns back first bends its bristles and takes nothing that it does not give back: only the way beyond
// that play slips. Coulomb friction is counted there, viscous friction on all of the way:
//   W = sure (tau_c |slip| + b qd dq)
// Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <cmath>

#include "haptics/quantities.h"

namespace trocar {

class SureFriction {
 public:
  /// Coulomb friction, N m (N); viscous friction, N m s/rad (N s/m); half the play, rad (m): each already the sure
  /// part.
  SureFriction(const ChannelVector& coulomb, const ChannelVector& viscous, const ChannelVector& play)
      : coulomb_(coulomb), viscous_(viscous), play_(play) {}

  void reset() { bent_.setZero(); }
  /// @param way since the last call, rad (m); @param rate estimated, rad/s (m/s). @return energy of each channel, J, >=
  /// 0.
  ChannelVector update(const ChannelVector& way, const ChannelVector& rate) {
    const ChannelVector reached = bent_ + way;
    bent_ = reached.cwiseMax(-play_).cwiseMin(play_);
    return coulomb_.cwiseProduct((reached - bent_).cwiseAbs()) +
           viscous_.cwiseProduct(way.cwiseProduct(rate).cwiseMax(0.0));
  }

 private:
  ChannelVector coulomb_, viscous_, play_, bent_ = ChannelVector::Zero();
};

}  // namespace trocar
