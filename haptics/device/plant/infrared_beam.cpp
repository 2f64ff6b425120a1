#include "haptics/device/plant/infrared_beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

const Vec3 kLine = -Vec3::UnitX();       // Y6 of the home pose in W' (3.3)
const Vec3 kThrough(0, -0.006, -0.272);  // m, the stylus origin there

/// Exponent of a lobe that has half its light at half its width.
double lobe_power(double wide_deg) { return std::log(0.5) / std::log(std::cos(wide_deg / 2 * std::numbers::pi / 180)); }

}  // namespace

double InfraredBeam::through(const Pose& X_BS) const noexcept {
  const double along = X_BS.R.col(1).dot(kLine);
  if (along <= 0) return 0;
  const Vec3 off = X_BS.p - kThrough;
  const double beside = (off - off.dot(kLine) * kLine).norm();
  return p_.margin * std::pow(along, lobe_power(p_.beam_deg) + lobe_power(p_.acceptance_deg)) *
         std::max(0.0, 1 - beside / p_.bore_m);
}

void InfraredBeam::update(const Pose& X_BS, bool jig, bool dead, bool stuck) noexcept {
  if (!jig || dead || stuck) {
    lit_ = stuck && !dead;
    return;
  }
  double light = through(X_BS) + p_.ambient;
  if (p_.noise > 0) light += p_.noise * random_.normal();
  lit_ = light >= (lit_ ? 1 - p_.hysteresis : 1.0);
}

}  // namespace trocar
