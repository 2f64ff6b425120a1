#include "app/window/input/scope_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kReturnTurn = 2.5;    // rad/s
constexpr double kReturnDepth = 0.15;  // m/s

double home(double value, double step) { return value - std::clamp(value, -step, step); }

}  // namespace

void ScopeHand::turn(const ScopeMove& more) {
  if (more == ScopeMove{}) return;
  returning_ = false;
  move_.post_rad = std::remainder(move_.post_rad + more.post_rad, 2 * std::numbers::pi);
  move_.yaw_rad = std::clamp(move_.yaw_rad + more.yaw_rad, -kMostTurn_rad, kMostTurn_rad);
  move_.pitch_rad = std::clamp(move_.pitch_rad + more.pitch_rad, -kMostTurn_rad, kMostTurn_rad);
  move_.depth_m = std::clamp(move_.depth_m + more.depth_m, -kMostDepth_m, kMostDepth_m);
}

void ScopeHand::advance(double dt_s) {
  if (!returning_) return;
  const double turn = kReturnTurn * dt_s;
  move_ = {home(move_.post_rad, turn), home(move_.yaw_rad, turn), home(move_.pitch_rad, turn),
           home(move_.depth_m, kReturnDepth * dt_s)};
  returning_ = move_ != ScopeMove{};
}

}  // namespace trocar
