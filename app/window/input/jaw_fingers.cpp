#include "app/window/input/jaw_fingers.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kWidest_m = 0.02;  // fingers of a person at rest (HandIntent)

double finger_toward(double from, double to, double step) { return from + std::clamp(to - from, -step, step); }

}  // namespace

void JawFingers::begin(double opening_m) {
  widest_m_ = std::max(kWidest_m, opening_m);
  opening_m_ = widest_m_;
  latched_ = false;
}

void JawFingers::advance(const Wish& wish, double dt_s) {
  const double fast = widest_m_ / kRampTime_s * dt_s, slow = kSlow_m_per_s * dt_s;
  if (wish.open) {
    if (!wish.fine) latched_ = false;
    opening_m_ = finger_toward(opening_m_, widest_m_, wish.fine ? slow : fast);
    return;
  }
  if (wish.trigger > 0) {
    if (!latched_) opening_m_ = finger_toward(opening_m_, widest_m_ + wish.trigger * (kTightest_m - widest_m_), fast);
    return;
  }
  if (wish.close) {
    const bool gentle = wish.fine || latched_ || opening_m_ <= 0;
    opening_m_ = gentle ? finger_toward(opening_m_, kTightest_m, slow) : std::max(0.0, opening_m_ - fast);
    return;
  }
  if (!latched_) opening_m_ = finger_toward(opening_m_, widest_m_, fast);
}

void JawFingers::toggle_latch() { latched_ = !latched_; }

void JawFingers::hold() { latched_ = latched_ || opening_m_ < widest_m_; }

}  // namespace trocar
