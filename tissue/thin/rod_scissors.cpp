#include "tissue/thin/rod_scissors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kOnClip = 0.0003;  // m beside a clip's edge in which the blades meet it

double wall_area(const RodOptions& rod) {
  return std::numbers::pi * (rod.outer_radius_m * rod.outer_radius_m - rod.inner_radius_m() * rod.inner_radius_m());
}

}  // namespace

std::vector<RodCut> RodScissors::step(const Pose& X_TI, double opening_m, std::span<const ClipSurroundings::Rod> rods) {
  std::vector<RodCut> cuts;
  resist_n_ = 0;
  jammed_ = false;
  if (!std::isfinite(opening_m) || !X_TI.R.allFinite() || !X_TI.p.allFinite()) return cuts;
  caught_.resize(rods.size(), false);
  const bool shuts = opening_m <= options_.shut_opening_m;
  const JawSpace blades{options_.blade_m, options_.width_m, opening_m};
  for (std::size_t r = 0; r < rods.size(); ++r) {
    const RodOptions& rod = rods[r].rod->options();
    const std::vector<RodCrossing> crossings = rod_crossings(*rods[r].rod, X_TI, blades);
    const bool opened = opening_m > options_.shut_opening_m;
    caught_[r] = !crossings.empty() && (caught_[r] || opened);
    if (!caught_[r] || shut_) {
      if (shuts) caught_[r] = false;
      continue;
    }
    for (const RodCrossing& crossing : crossings) {
      const bool on_clip = std::any_of(rods[r].clips.begin(), rods[r].clips.end(), [&](double arc) {
        return std::abs(arc - crossing.arc_m) < options_.clip_width_m / 2 + kOnClip;
      });
      jammed_ = jammed_ || on_clip;
      const double way = 2 * rod.outer_radius_m - options_.shut_opening_m;
      if (way > 0 && opening_m < 2 * rod.outer_radius_m)
        resist_n_ += options_.toughness_j_per_m2 * crossing.share_between * wall_area(rod) / way;
      if (!shuts || on_clip) continue;
      const bool through = crossing.share_between >= options_.through_share;
      cuts.push_back({static_cast<std::int32_t>(r), crossing.arc_m, through ? 1.0 : crossing.share_between});
    }
    if (shuts) caught_[r] = false;
  }
  if (jammed_) cuts.clear();
  shut_ = shuts;
  return cuts;
}

}  // namespace trocar
