// The light of the jig: an emitter and a receiver that face each other in a housing, and the coupler on the handle
// whose bore lets the light through where the stylus is turned right (thesis 3.4.1, figures 3.23 to 3.25).
//
//   E = margin lobe(a, beam) lobe(a, acceptance) overlap(d) + ambient + noise,   lobe(a, w) = cos^n a, 1/2 at a = w / 2
// in thresholds of the receiver; a: angle between bore and line of light, d: how far the bore lies beside it,
// overlap = 1 - d / bore. The Schmitt trigger switches on at 1 and off below 1 - hysteresis. The bore lies along Y6:
// rolling and tilting turn it away, turning about itself it does not see; the jig holds that.
// The housing goes with the jig: without it there is no light. Frame W'. Thread: one owner; no allocation.
#pragma once

#include <cstdint>

#include "haptics/device/plant/plant_options.h"
#include "haptics/device/plant/plant_random.h"
#include "haptics/quantities.h"

namespace trocar {

class InfraredBeam {
 public:
  InfraredBeam(const InfraredParameters& parameters, std::uint64_t seed) : p_(parameters), random_(seed) {}

  /// One period. @param X_BS stylus. @param jig housing and jig are there. @param dead, stuck failures of the pair.
  void update(const Pose& X_BS, bool jig, bool dead, bool stuck) noexcept;
  bool lit() const noexcept { return lit_; }
  /// Without ambient light and noise, thresholds.
  double through(const Pose& X_BS) const noexcept;

 private:
  InfraredParameters p_;
  PlantRandom random_;
  bool lit_ = false;
};

}  // namespace trocar
