// Seeded random numbers of the simulated device: the distributions are spelled out so that one seed gives the same
// numbers with every library.
//
// Thread: one stream a thread.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace trocar {

class PlantRandom {
 public:
  explicit PlantRandom(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1): the upper 53 bits of one draw.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// Uniform in [-half_width, half_width).
  double symmetric(double half_width) { return half_width * (2.0 * unit() - 1.0); }
  /// Standard normal by Box and Muller's cosine branch (1 - u keeps the logarithm finite).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return radius * std::cos(2.0 * std::numbers::pi * unit());
  }
  /// Factor exp(sigma n): median 1.
  double log_normal(double sigma) { return std::exp(sigma * normal()); }
  /// Whole number in [0, 2^32).
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_() >> 32); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trocar
