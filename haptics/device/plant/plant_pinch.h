// What the pinch's other designs have beyond a pulley on the motor (thesis 5.2): gears with play, a potentiometer.
//
// Gears: the motor's side is a body of its own, free within the play between the flanks; where it meets a flank it
// takes the slide along without rebound. It rubs as a motor does without load (37 mA). Potentiometer: a digitised
// place of the slide, trembling, standing still where the wiper has worn the track. SI at the slide, counts.
// Thread: one owner; no allocation.
#pragma once

#include <cstdint>

#include "haptics/device/plant/plant_parameters.h"
#include "haptics/device/plant/plant_random.h"

namespace trocar {

class PlantGear {
 public:
  explicit PlantGear(const PlantParameters& plant);
  bool loose() const noexcept { return play_ > 0; }
  void place(double slide) noexcept { at_ = slide, rate_ = 0; }
  /// The motor pushes with `force` for dt. @param slide, slide_rate, slide_mass of the slide after its own step.
  /// @return rate of the slide then.
  double advance(double force, double slide, double slide_rate, double slide_mass, double dt) noexcept;
  double rate() const noexcept { return rate_; }
  double at() const noexcept { return at_; }

 private:
  double play_, mass_, rub_;
  double at_ = 0, rate_ = 0;
};

class PlantPotentiometer {
 public:
  PlantPotentiometer(const PinchOptions& options, std::uint64_t seed) : p_(options), random_(seed) {}
  bool there() const noexcept { return p_.counts_per_m > 0; }
  /// Its reading now; asks once a latch.
  std::int32_t read(double slide) noexcept;

 private:
  PinchOptions p_;
  PlantRandom random_;
  std::int32_t last_ = 0;
  bool read_once_ = false;
};

}  // namespace trocar
