#include "haptics/device/plant/plant_pinch.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kNoLoadCurrent = 0.037;  // A [T] table 3.4

}  // namespace

PlantGear::PlantGear(const PlantParameters& plant) : play_(plant.options.pinch.backlash) {
  const ChannelParameters& c = plant.channel[kPinchChannel];
  mass_ = c.rotor_inertia / (c.ratio * c.ratio);
  rub_ = kNoLoadCurrent * c.torque_constant / c.ratio;
}

double PlantGear::advance(double force, double slide, double slide_rate, double slide_mass, double dt) noexcept {
  rate_ += dt * force / mass_;
  const double brake = dt * rub_ / mass_;
  rate_ = std::abs(rate_) <= brake ? 0 : rate_ - std::copysign(brake, rate_);
  const double apart = at_ - slide + dt * (rate_ - slide_rate);  // at the end of the step, were there no flanks
  const double beyond = apart - std::clamp(apart, -play_ / 2, play_ / 2);
  if (beyond != 0) {
    const double impulse = beyond / dt / (1 / mass_ + 1 / slide_mass);
    rate_ -= impulse / mass_;
    slide_rate += impulse / slide_mass;
  }
  at_ += dt * rate_;
  return slide_rate;
}

std::int32_t PlantPotentiometer::read(double slide) noexcept {
  const double worn = p_.dead_every > 0 ? std::abs(std::remainder(slide, p_.dead_every)) : p_.dead_wide;
  const double tremble = p_.noise_counts > 0 ? p_.noise_counts * random_.normal() : 0;
  if (read_once_ && p_.dead_every > 0 && worn < p_.dead_wide / 2) return last_;
  read_once_ = true;
  return last_ = static_cast<std::int32_t>(std::lround(slide * p_.counts_per_m + tremble));
}

}  // namespace trocar
