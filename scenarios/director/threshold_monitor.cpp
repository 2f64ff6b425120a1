#include "scenarios/director/threshold_monitor.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kGraceReturn = 0.2;  // of the time inside

}  // namespace

bool ThresholdMonitor::update(double value, double dt_s) {
  if (!fired_) {
    below_s_ = above_s_ = 0;
    fired_ = value > enter_;
    return fired_;
  }
  below_s_ = value < leave_ ? below_s_ + dt_s : 0;
  if (below_s_ >= rearm_s_) fired_ = false;
  if (repeat_s_ <= 0 || value <= enter_) return false;
  above_s_ += dt_s;
  if (above_s_ < repeat_s_ - 1e-9) return false;
  above_s_ = 0;
  return true;
}

bool HoldTimer::update(bool inside, double dt_s) {
  if (inside) {
    outside_s_ = std::max(0.0, outside_s_ - kGraceReturn * dt_s);
    held_s_ = std::min(wanted_s_, held_s_ + dt_s);
  } else {
    outside_s_ += dt_s;
    if (outside_s_ > grace_s_) {
      held_s_ = 0;
      outside_s_ = grace_s_;
    }
  }
  return held_s_ >= wanted_s_ - 1e-9;
}

}  // namespace trocar
