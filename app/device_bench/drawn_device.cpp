#include "app/device_bench/drawn_device.h"

#include <cmath>

#include "haptics/device/plant/plant_random.h"

namespace trocar {
namespace {

constexpr std::uint64_t kOptionStream = 0xA0761D6478BD642Full, kHandStream = 0xE7037ED1A0B428DBull;
constexpr double kSoftestCable = 50, kStiffestCable = 200;  // N m/rad
constexpr double kCableSpread = 0.1;
constexpr int kMostJitter = 2;                              // periods
constexpr double kFewestMissed = 1e-7, kMostMissed = 1e-5;  // of the edges

double log_between(double low, double high, double unit) { return low * std::pow(high / low, unit); }

}  // namespace

SimulatedDaqConfig nominal_device(GripPreset grip) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  device.hand = hand_parameters(grip);
  device.hand.tremor_m = 0;
  return device;
}

SimulatedDaqConfig drawn_device(std::uint64_t seed, GripPreset grip) {
  SimulatedDaqConfig device;
  device.seed = seed;
  device.plant = draw_everything(seed);
  PlantRandom random(seed ^ kOptionStream);
  PlantOptions& options = device.plant->options;
  const double stiffness = log_between(kSoftestCable, kStiffestCable, random.unit());
  for (CableParameters& cable : options.cable) {
    cable.stiffness = stiffness * (1 + random.symmetric(kCableSpread));
    cable.damping *= random.log_normal(0.3);
  }
  options.jitter_periods = static_cast<int>((kMostJitter + 1) * random.unit());
  options.encoder.missed_per_edge = log_between(kFewestMissed, kMostMissed, random.unit());
  options.heat.on = true;
  device.hand = draw_hand_parameters(grip, seed ^ kHandStream);
  return device;
}

std::uint64_t trial_seed(std::uint64_t study_seed, std::uint64_t n) {
  std::uint64_t z = study_seed * 0x9E3779B97F4A7C15ull + n + 1;  // splitmix64
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

}  // namespace trocar
