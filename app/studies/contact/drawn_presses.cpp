#include "app/studies/contact/drawn_presses.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "haptics/device/plant/plant_random.h"

namespace trocar {
namespace {

constexpr std::uint64_t kPressStream = 0x8EBC6AF09C88C6E3ull;
/// Degrees: middle and half-width of the joints from which a press sets out.
constexpr double kMiddle[kArmJoints] = {45, 45, 45, -68, -78, 0}, kHalf[kArmJoints] = {12, 12, 12, 25, 25, 60};

void draw_way(WallCase& c, PlantRandom& random) {
  do {
    for (int i = 0; i < kArmJoints; ++i) c.pose[i] = (kMiddle[i] + random.symmetric(kHalf[i])) * kDegree;
    const double up = random.symmetric(1), around = 2 * std::numbers::pi * random.unit(), flat = std::sqrt(1 - up * up);
    c.direction = {flat * std::cos(around), flat * std::sin(around), up};
  } while (!comfortable(c.pose, c.direction, press_travel(c)));
}

}  // namespace

std::vector<DrawnPress> drawn_presses(std::uint64_t seed, std::size_t count, const PressDraw& draw) {
  std::vector<DrawnPress> presses(count);
  for (std::size_t i = 0; i < count; ++i) {
    WallCase& c = presses[i].wall;
    const std::uint64_t trial = trial_seed(seed, i);
    PlantRandom random(trial ^ kPressStream);
    std::size_t turn = i;
    const auto next = [&turn](std::size_t n) { return std::exchange(turn, turn / n) % n; };
    c.stiffness = draw.stiffness[next(draw.stiffness.size())];
    const int delay = draw.extra_delay[next(draw.extra_delay.size())];
    const GripPreset grip = presses[i].grip = kGrips[next(kGrips.size())];
    c.device = draw.nominal ? nominal_device(grip) : drawn_device(trial, grip);
    c.device.extra_delay_periods = delay;
    c.device.rate_hz = draw.rate_hz;
    c.speed = draw.slowest * std::pow(draw.fastest / draw.slowest, random.unit());
    c.speed_tolerance = 0.1;
    draw_way(c, random);
  }
  return presses;
}

std::string drawn_plant_words(std::uint64_t seed, bool nominal) {
  if (nominal) return "simulated plant, nominal parameters";
  return "simulated plants and hands, one drawn for each trial (seed " + std::to_string(seed) + ")";
}

}  // namespace trocar
