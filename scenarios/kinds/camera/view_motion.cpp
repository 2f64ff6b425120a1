#include "scenarios/kinds/camera/view_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kSmooth = 0.05;                            // s
constexpr double kProminence = 8 * std::numbers::pi / 180;  // rad/s [D]

}  // namespace

bool ViewMotion::update(const Vec3& seen_C, double dt_s) {
  if (dt_s <= 0) return false;
  if (!seen_C_) {
    seen_C_ = seen_C;
    speed_ = valley_ = top_ = 0;
    rising_ = false;
    return false;
  }
  const double angle = std::atan2(seen_C_->cross(seen_C).norm(), seen_C_->dot(seen_C));
  seen_C_ = seen_C;
  speed_ += (angle / dt_s - speed_) * std::min(1.0, dt_s / kSmooth);
  if (!rising_) {
    valley_ = std::min(valley_, speed_);
    rising_ = speed_ > valley_ + kProminence;
    top_ = speed_;
    return false;
  }
  top_ = std::max(top_, speed_);
  if (speed_ > top_ - kProminence) return false;
  rising_ = false;
  valley_ = speed_;
  return true;
}

}  // namespace trocar
