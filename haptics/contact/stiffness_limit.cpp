#include "haptics/contact/stiffness_limit.h"

#include <algorithm>
#include <cmath>

#include "haptics/device/transmission.h"

namespace trocar {

TipFriction tip_friction(const DeviceModel& model, const JointVector& lever) {
  TipFriction tip;
  double mobility = 0;  // of the stylus per joint damping
  double coulomb = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kArmJoints; ++i) {
    const double g = std::abs(lever[i]);
    if (g == 0) continue;
    mobility += g * g / model.viscous[i];
    coulomb = std::min(coulomb, model.coulomb[i] / g);
    tip.count_m = std::max(tip.count_m, g * count_size(model.transmission[static_cast<std::size_t>(i)]));
  }
  if (mobility == 0) return tip;
  tip.viscous_n_s_per_m = 1 / mobility;
  tip.coulomb_n = coulomb;
  return tip;
}

StiffnessLimit stiffness_limit(const DeviceModel& model, const JointVector& lever, double asked, double period_s,
                               double delay_s) {
  StiffnessLimit limit;
  const TipFriction tip = tip_friction(model, lever);
  if (tip.count_m == 0) return limit;
  limit.k_max = model.friction_sure() *
                std::min({2 * tip.viscous_n_s_per_m / period_s, tip.viscous_n_s_per_m / (period_s / 2 + delay_s),
                          2 * tip.coulomb_n / tip.count_m});
  limit.share = asked > limit.k_max ? limit.k_max / asked : 1;
  return limit;
}

}  // namespace trocar
