// Random numbers of a hand by explicit formulas, so that a seed means the same on every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace trocar {

class HandRandom {
 public:
  explicit HandRandom(std::uint64_t seed) : generator_(seed) {}
  /// In [0, 1).
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
  /// Standard normal (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  /// Log-normal of mean about 1 and the given coefficient of variation.
  double log_normal(double cv) {
    const double variance = std::log(1 + cv * cv);
    return std::exp(std::sqrt(variance) * normal() - variance / 2);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace trocar
