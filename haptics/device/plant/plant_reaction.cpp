#include "haptics/device/plant/plant_reaction.h"

#include <algorithm>

#include "haptics/device/plant/plant_random.h"

namespace trocar {
namespace {

constexpr std::uint64_t kReactionStream = 0xA0761D6478BD642Full;
constexpr double kReflexRiseS = 0.03, kRelaxationS = 0.2;
constexpr double kShortestClosingS = 0.05;

/// Minimum-jerk curve from 0 at `from` to 1 at `to`.
double rise(double t, double from, double to) {
  const double s = std::clamp((t - from) / (to - from), 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

/// Up at once, down no faster than in kRelaxationS.
double follow(double share, double wanted, double dt) { return std::max(wanted, share - dt / kRelaxationS); }

}  // namespace

HandReaction draw_hand_reaction(std::uint64_t seed) {
  PlantRandom random(seed ^ kReactionStream);
  HandReaction r;
  r.on = true;
  r.reflex_s = 0.030 + 0.020 * random.unit();
  r.reaction_s = 0.150 + 0.050 * random.unit();
  r.notice_n *= random.log_normal(0.3);
  r.reflex_gain = 1 + (r.reflex_gain - 1) * random.log_normal(0.3);
  r.firm_s = std::max(r.firm_s * random.log_normal(0.15), r.reaction_s + kShortestClosingS);
  return r;
}

void PlantReaction::feel(const Vec3& force, double dt) noexcept {
  if (!p_.on) return;
  if (!began_) usual_ = force;
  began_ = true;
  usual_ += dt / (p_.notice_s + dt) * (force - usual_);
  quiet_ = force.norm() < p_.notice_n ? quiet_ + dt : 0;
  if (touched_) since_touch_ += dt;
  if (!touched_ && (force - usual_).norm() > p_.notice_n) {
    touched_ = true;
    since_touch_ = 0;
  }
  if (quiet_ > p_.relax_s) touched_ = false;
  reflex_ = follow(reflex_, touched_ ? rise(since_touch_, p_.reflex_s, p_.reflex_s + kReflexRiseS) : 0, dt);
  firmness_ = follow(firmness_, touched_ ? rise(since_touch_, p_.reaction_s, p_.firm_s) : 0, dt);
}

}  // namespace trocar
