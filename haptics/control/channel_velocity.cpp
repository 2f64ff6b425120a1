#include "haptics/control/channel_velocity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {

ChannelVelocity::ChannelVelocity(VelocityMethod method, double quantum, double period_s)
    : method_(method),
      quantum_(quantum),
      period_s_(period_s),
      foaw_(quantum, period_s),
      kalman_(quantum, period_s),
      edges_(period_s) {}

void ChannelVelocity::reset() {
  foaw_.reset();
  kalman_.reset();
  edges_.reset();
  tap_.fill(0);
  smooth_ = 0;
  started_ = false;
}

double ChannelVelocity::update(std::int64_t count, std::uint32_t elapsed_periods, std::uint16_t edge_age_us) {
  const std::uint32_t periods = std::max<std::uint32_t>(1, elapsed_periods);
  double velocity = 0;
  switch (method_) {
    case VelocityMethod::kBlend:
      velocity = blend(count, periods);
      break;
    case VelocityMethod::kFoaw:
      velocity = foaw_.update(count, periods);
      break;
    case VelocityMethod::kKalman:
      velocity = kalman_.update(count, periods);
      break;
    case VelocityMethod::kBackward:
      velocity = started_ ? static_cast<double>(count - last_) * quantum_ / (periods * period_s_) : 0;
      break;
    case VelocityMethod::kAverage:
      velocity = average(count, periods);
      break;
    case VelocityMethod::kLowPass:
      velocity = low_pass(count, periods);
      break;
    case VelocityMethod::kEdges:
      velocity = edges(count, periods, edge_age_us);
      break;
  }
  last_ = count;
  started_ = true;
  return velocity;
}

double ChannelVelocity::blend(std::int64_t count, std::uint32_t periods) {
  const double slow = foaw_.update(count, periods), fast = kalman_.update(count, periods);
  const double weight = std::clamp((std::abs(slow) / quantum_ - kSlow) / (kFast - kSlow), 0.0, 1.0);
  return slow + weight * (fast - slow);
}

double ChannelVelocity::edges(std::int64_t count, std::uint32_t periods, std::uint16_t edge_age_us) {
  if (edge_age_us == 0) {
    edges_.reset();
    return blend(count, periods);
  }
  const double slow = edges_.update(count, periods, edge_age_us), fast = kalman_.update(count, periods) / quantum_;
  const double weight = std::clamp((std::abs(slow) - kSlowEdges) / (kFastEdges - kSlowEdges), 0.0, 1.0);
  const double velocity = slow + weight * (fast - slow);
  edges_.advance(velocity);
  return velocity * quantum_;
}

double ChannelVelocity::average(std::int64_t count, std::uint32_t periods) {
  const double each = started_ ? static_cast<double>(count - last_) / periods : 0;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(periods, kTaps); ++i) {
    tap_[next_tap_] = each;
    next_tap_ = (next_tap_ + 1) % kTaps;
  }
  double sum = 0;
  for (const double counts : tap_) sum += counts;
  return sum * quantum_ / (kTaps * period_s_);
}

double ChannelVelocity::low_pass(std::int64_t count, std::uint32_t periods) {
  const double each = started_ ? static_cast<double>(count - last_) / (periods * period_s_) : 0;
  const double keep = std::exp(-2 * std::numbers::pi * kCutOffHz * period_s_);
  for (std::uint32_t i = 0; i < periods; ++i) smooth_ = keep * smooth_ + (1 - keep) * each;
  return smooth_ * quantum_;
}

}  // namespace trocar
