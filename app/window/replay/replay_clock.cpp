#include "app/window/replay/replay_clock.h"

#include <algorithm>
#include <cmath>

namespace trocar {

namespace {
constexpr double kHere_s = 0.5, kLeastLoop_s = 0.2;
}

void ReplayClock::set_range(double from_s, double to_s) {
  from_s_ = from_s;
  to_s_ = std::max(from_s, to_s);
  if (!ranged_) now_s_ = from_s;
  ranged_ = true;
  go(now_s_);
}

void ReplayClock::go(double t_s) { now_s_ = std::clamp(t_s, from_s_, to_s_); }

void ReplayClock::advance(double dt_s, double known_s) {
  if (!playing_) return;
  const double wanted = now_s_ + dt_s * speed();
  if (b_s_ && now_s_ <= *b_s_ && wanted > *b_s_) return go(*a_s_);
  go(std::max(now_s_, std::min(wanted, known_s)));
  if (now_s_ >= to_s_) playing_ = false;
}

void ReplayClock::toggle_play() {
  playing_ = !playing_;
  if (playing_ && now_s_ >= to_s_) now_s_ = from_s_;
}

void ReplayClock::step(int steps) {
  playing_ = false;
  go((std::round(now_s_ / kStep_s) + steps) * kStep_s);
}

bool ReplayClock::jump(const std::vector<double>& marks_s, int direction) {
  std::optional<double> to;
  for (const double mark : marks_s) {
    const bool ahead = direction > 0 && mark > now_s_ + 1e-6,
               behind = direction < 0 && mark < now_s_ - (playing_ ? kHere_s : 1e-6);
    if ((ahead && (!to || mark < *to)) || (behind && (!to || mark > *to))) to = mark;
  }
  if (to) go(*to);
  return to.has_value();
}

void ReplayClock::change_speed(int by) {
  const int last = static_cast<int>(kSpeeds.size()) - 1;
  speed_ = static_cast<std::size_t>(std::clamp(static_cast<int>(speed_) + by, 0, last));
}

void ReplayClock::next_loop_point() {
  if (b_s_) {
    a_s_.reset();
    b_s_.reset();
  } else if (!a_s_) {
    a_s_ = now_s_;
  } else {
    const double other = std::abs(now_s_ - *a_s_) < kLeastLoop_s ? *a_s_ + kLeastLoop_s : now_s_;
    b_s_ = std::max(*a_s_, other);
    a_s_ = std::min(*a_s_, other);
  }
}

}  // namespace trocar
