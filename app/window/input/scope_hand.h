// The assistant's hand at the scope: turned about its port, pushed in and drawn back, its light post turned.
//
// yaw to the right, pitch up, depth inwards, post to the right are positive. rad, m. Thread: plain value, any thread.
#pragma once

#include <algorithm>

namespace trocar {

/// Scope turned by the person: light post (30 degree scope) and shift about its port.
struct ScopeMove {
  double post_rad = 0, yaw_rad = 0, pitch_rad = 0, depth_m = 0;
  bool operator==(const ScopeMove&) const = default;
};

class ScopeHand {
 public:
  static constexpr double kMostTurn_rad = 0.6, kMostDepth_m = 0.05;

  /// Adds to what is; limits hold. A post turns round and round, -pi..pi.
  void turn(const ScopeMove& more);
  /// As deep as that, where it went deeper: something is in its way.
  void stop_at(double depth_m) { move_.depth_m = std::min(move_.depth_m, depth_m); }
  /// Goes back to where the exercise had it.
  void level() { returning_ = true; }
  void advance(double dt_s);
  const ScopeMove& move() const { return move_; }

 private:
  ScopeMove move_;
  bool returning_ = false;
};

}  // namespace trocar
