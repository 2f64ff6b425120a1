#include "scenarios/hands/force_grip.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kThinkAgainAfter = 0.7;  // s outside the band
constexpr double kForgiven = 0.5;         // of the time inside
constexpr double kNothingFelt = -1;       // N
constexpr double kRateTime = 0.08;        // s over which the change of the felt force is judged
constexpr double kBiasFade = 0.6, kSpreadFade = 0.8;
constexpr double kWanderTime = 0.5;     // s, correlation time of the force wander
constexpr double kWanderShare = 0.3;    // of the CV
constexpr double kSmallestGoal = 0.05;  // N
constexpr double kTaught = 0.3;         // weight of one success
constexpr double kTrialShare = 0.4;     // of the band's width from one force that is tried to the next

}  // namespace

void ForceGrip::begin(double low_n, double high_n, HandRandom& random) {
  low_n_ = low_n;
  high_n_ = high_n;
  outside_s_ = inside_s_ = wander_ = rate_n_per_s_ = 0;
  last_n_ = kNothingFelt;
  thoughts_ = trials_ = 0;
  wrong_n_ = taught_n_;
  draw_goal(random);
}

void ForceGrip::draw_goal(HandRandom& random) {
  const double bias = 1 + (tuning_.bias - 1) * std::pow(kBiasFade, thoughts_);
  const double cv = tuning_.cv * std::pow(kSpreadFade, thoughts_);
  goal_n_ = std::max(kSmallestGoal, (low_n_ + high_n_) / 2 * bias * (1 + cv * random.normal()));
}

void ForceGrip::succeeded() { taught_n_ += kTaught * (last_n_ + wrong_n_ - (low_n_ + high_n_) / 2 - taught_n_); }

void ForceGrip::try_another(HandRandom& random) {
  if (trials_++ == 0) first_way_ = random.uniform() < 0.5 ? -1 : 1;
  const double off = kTrialShare * (high_n_ - low_n_) * ((trials_ + 1) / 2) * (trials_ % 2 == 1 ? 1 : -1);
  wrong_n_ = taught_n_ + first_way_ * off;
  inside_s_ = outside_s_ = 0;
  draw_goal(random);
}

double ForceGrip::speed(double raw_n, double dt_s, HandRandom& random) {
  const double felt_n = raw_n - wrong_n_;
  const bool inside = felt_n >= low_n_ && felt_n <= high_n_;
  inside_s_ += inside ? dt_s : 0;
  if (inside_s_ > tuning_.patience_s) try_another(random);
  outside_s_ = std::max(0.0, outside_s_ + (inside ? -kForgiven : 1) * dt_s);
  if (outside_s_ > kThinkAgainAfter) {
    outside_s_ = 0;
    ++thoughts_;
    draw_goal(random);
  }
  const double rate = dt_s / kWanderTime;  // Ornstein-Uhlenbeck of unit variance
  wander_ += -rate * wander_ + std::sqrt(2 * rate) * random.normal();
  const double goal = goal_n_ * (1 + kWanderShare * tuning_.cv * wander_);
  if (last_n_ < 0) last_n_ = felt_n;
  rate_n_per_s_ += ((felt_n - last_n_) / dt_s - rate_n_per_s_) * std::min(1.0, dt_s / kRateTime);
  last_n_ = felt_n;
  const double coming = felt_n + tuning_.foresight_s * rate_n_per_s_;
  const double speed = tuning_.crossover_rad_per_s * (goal - coming) / tuning_.expected_stiffness_n_per_m;
  return std::clamp(speed, -tuning_.fastest_mps, tuning_.fastest_mps);
}

}  // namespace trocar
