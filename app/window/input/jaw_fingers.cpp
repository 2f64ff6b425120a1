#include "app/window/input/jaw_fingers.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kWidest_m = 0.02;  // fingers of a person at rest (HandIntent)

double finger_toward(double from, double to, double step) { return from + std::clamp(to - from, -step, step); }

}  // namespace

void JawFingers::begin(double opening_m) {
  *this = JawFingers();
  widest_m_ = std::max(kWidest_m, opening_m);
  opening_m_ = opening_m;
}

void JawFingers::advance(const Wish& wish, double dt_s) {
  const double step = kSpeed_m_per_s * dt_s;
  const bool begins = wish.used && !used_;
  used_ = wish.used;
  if (!wish.used) {
    opening_m_ = finger_toward(opening_m_, 0, step);
    return;
  }
  if (begins || wish.open) opening_ = true;
  if (wish.close) {
    opening_ = false;
    kept_n_ = 0;  // until it is let go
    opening_m_ = finger_toward(opening_m_, kTightest_m, step);
    if (wish.gripping) opening_m_ = std::max(opening_m_, wish.fingers_m - kAhead_m);
  } else if (wish.let_go && !opening_) {
    opening_m_ = wish.fingers_m;
    kept_n_ = wish.grip_n;
  } else if (!opening_ && wish.gripping && wish.grip_n < kept_n_) {
    const double follows = std::min(kFollowFastest, kFollow * (kept_n_ - wish.grip_n)) * dt_s;
    opening_m_ = std::max(opening_m_ - follows, wish.fingers_m - kAhead_m);
  }
  if (opening_) opening_m_ = finger_toward(opening_m_, widest_m_, step);
  opening_m_ = std::min(opening_m_, widest_m_);  // fingers on a device may be farther apart
}

void JawFingers::work(const Work& wish, double dt_s) {
  const double to = wish.close ? kTightest_m : wish.shut ? 0 : widest_m_;
  opening_m_ = finger_toward(opening_m_, to, kWorkSpeed_m_per_s * dt_s);
  if (wish.close && wish.gripping) opening_m_ = std::max(opening_m_, wish.fingers_m - kAhead_m);
  opening_m_ = std::min(opening_m_, widest_m_);
  used_ = opening_ = false;
}

}  // namespace trocar
