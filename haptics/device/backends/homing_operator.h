// The person who homes a simulated device: does what the homing says and knows nothing else.
//
// Leads the arm past the marks joint by joint, puts the stylus into its jig and turns it into the light, turns it out
// of it to the other side where it is asked to, and leaves it alone. Where in the light it stops is drawn: a person
// stops as soon as the lamp is on, or a little later. Joint angles from the jig, rad. Thread: the caller's.
#pragma once

#include <cstdint>
#include <random>

#include "haptics/device/simulated_world.h"
#include "haptics/exchange/homing_report.h"

namespace trocar {

class HomingOperator {
 public:
  HomingOperator(SimulatedWorld& world, std::uint64_t seed) : world_(world), random_(seed) {}

  /// Once a tick, after it.
  void follow(const HomingReport& homing);

 private:
  void lead(const JointVector& to);
  double drawn(double low, double high);

  SimulatedWorld& world_;
  std::mt19937_64 random_;
  JointVector at_ = JointVector::Zero();
  double busy_until_s_ = 0;
  int sweep_ = 0, side_ = -1;  ///< ends of a joint's way, sides of the light
};

}  // namespace trocar
