// One axis of the device against a spring wall: mass, friction, encoder, hold, delay and the hand of haptics notes 3.3
// and 3.4, integrated at 20 us; the passivity controller in the loop and the true port energy beside it.
#pragma once

#include <deque>

#include "haptics/control/passivity.h"
#include "haptics/control/velocity_estimator.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::test {

/// Spring of stiffness k pressed to depth x, moved by dx in the last period while `held` newtons acted.
inline ContactWork spring(double k, double x, double dx, double held) {
  ContactWork work;
  work.wanted_n = k * x;
  work.absorbed_j = held * dx;
  work.dx_m = dx;
  work.speed_m_s = dx / 1e-3;
  work.stored_j = 0.5 * k * x * x;
  work.stiffness = k;
  return work;
}

struct OneAxisCase {
  PassivityParameters law;
  double mass = 0.127, viscous = 0.3, coulomb = 0.06, quantum = 0.208e-3;  ///< haptics notes 3.4
  double stiffness = 150;
  int delay_periods = 1;
  double saturation = 1.51;                                                   ///< N, 100 mN m at the worst motor
  double grip_k = 60, grip_b = 0.3, hand_mass = 0.4, arm_b = 6, arm_k = 130;  ///< fingertip grip
  double wall = 0.030, goal_past_wall = 0.015, reach_s = 0.17;                ///< meets the wall at about 0.46 m/s
  double duration_s = 3;
};

struct OneAxisResult {
  double settled_at_s = 0;  ///< last time at which |v| > 0.03 m/s
  double least_true_j = 0;  ///< lowest true energy taken by the port so far
  double worst_gap_j = 0;   ///< observer against 20 us integration
  double largest_true_j = 0;
  double displayed = 0;  ///< force over stiffness times depth at the end
  double largest_step_n = 0, least_force_n = 0, largest_force_n = 0;
  int contacts = 0;
};

inline double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

class OneAxisRig {
 public:
  explicit OneAxisRig(const OneAxisCase& c) : c_(c), controller_(c.law), velocity_(c.quantum, c.law.period_s) {
    for (int i = 0; i < c.delay_periods; ++i) pending_.push_back(0);
  }

  OneAxisResult run() {
    const int ticks = static_cast<int>(c_.duration_s / c_.law.period_s);
    for (int k = 0; k < ticks; ++k) {
      control(k * c_.law.period_s);
      integrate(k * c_.law.period_s);
    }
    return result_;
  }
  const PassivityController& controller() const { return controller_; }

 private:
  void control(double t) {
    const auto count = static_cast<std::int64_t>(std::floor(x_ / c_.quantum));
    const double x = static_cast<double>(count) * c_.quantum, dx = x - last_x_;
    last_x_ = x;
    const double depth = std::max(0.0, x - c_.wall);
    ContactWork work;
    work.wanted_n = std::min(c_.saturation, c_.stiffness * depth);
    work.absorbed_j = acting_ * dx;
    work.dx_m = dx;
    work.friction_j = 0.6 * c_.coulomb * std::abs(dx);  // the sure part
    work.speed_m_s = velocity_.update(count, 1);
    work.stored_j = stored(depth);
    work.stiffness = c_.stiffness;
    const double asked = std::min(c_.saturation, controller_.update(work));
    result_.least_force_n = std::min(result_.least_force_n, asked);
    result_.largest_force_n = std::max(result_.largest_force_n, asked);
    result_.contacts += was_free_ && work.wanted_n > 0;
    was_free_ = work.wanted_n <= 0;
    pending_.push_back(asked);
    result_.largest_step_n = std::max(result_.largest_step_n, std::abs(pending_.front() - acting_));
    acting_ = pending_.front();
    pending_.pop_front();
    result_.worst_gap_j = std::max(result_.worst_gap_j, std::abs(controller_.absorbed_j() - true_j_));
    if (work.wanted_n > 0 && t > c_.duration_s - 0.1) result_.displayed = asked / work.wanted_n;
  }

  /// Energy of the saturated spring.
  double stored(double depth) const {
    const double knee = c_.saturation / c_.stiffness, soft = std::min(depth, knee);
    return 0.5 * c_.stiffness * soft * soft + c_.saturation * (depth - soft);
  }

  void integrate(double t) {
    constexpr double dt = 20e-6;
    const int steps = static_cast<int>(std::lround(c_.law.period_s / dt));
    for (int i = 0; i < steps; ++i) {
      const double goal = (c_.wall + c_.goal_past_wall) * minimum_jerk((t + i * dt) / c_.reach_s);
      const double grip = c_.grip_k * (hand_ - x_) + c_.grip_b * (hand_v_ - v_);
      const double arm = c_.arm_k * (goal - hand_) - c_.arm_b * hand_v_;
      const double friction = c_.coulomb * std::tanh(v_ / 1e-3) + c_.viscous * v_;
      v_ += dt * (grip - friction - acting_) / c_.mass;
      hand_v_ += dt * (arm - grip) / c_.hand_mass;
      x_ += dt * v_;
      hand_ += dt * hand_v_;
      true_j_ += acting_ * v_ * dt;
    }
    result_.least_true_j = std::min(result_.least_true_j, true_j_);
    result_.largest_true_j = std::max(result_.largest_true_j, true_j_);
    if (std::abs(v_) > 0.03) result_.settled_at_s = t;
  }

  OneAxisCase c_;
  PassivityController controller_;
  VelocityEstimator velocity_;
  std::deque<double> pending_;  ///< forces on their way to the DAC
  OneAxisResult result_;
  double x_ = 0, v_ = 0, hand_ = 0, hand_v_ = 0, last_x_ = 0, acting_ = 0, true_j_ = 0;
  bool was_free_ = true;
};

}  // namespace trocar::test
