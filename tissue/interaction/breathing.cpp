#include "tissue/interaction/breathing.h"

#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kIn = 0.4, kBeat = 0.4;  // shares of a breath and of a beat; unchecked
const Vec3 kTowardsFeet(0, -0.75, -0.65);

/// 0 to 1 to 0, smooth; both ends of each part without speed.
double swell(double share, double rise) {
  const double along = share < rise ? share / rise : 1 + (share - rise) / (1 - rise);
  return 0.5 - 0.5 * std::cos(std::numbers::pi * along);
}

double share_of(double per_min, double t_s) {
  const double count = t_s * per_min / 60;
  return count - std::floor(count);
}

}  // namespace

Vec3 bed_shift(const Breathing& breathing, double t_s) {
  const double beat = share_of(breathing.beats_per_min, t_s) / kBeat;
  return breathing.depth_m * swell(share_of(breathing.per_min, t_s), kIn) * kTowardsFeet +
         (beat < 1 ? breathing.beat_m * swell(beat, 0.5) : 0.0) * Vec3::UnitZ();
}

}  // namespace trocar
