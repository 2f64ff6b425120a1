// Uniform numbers of the identifier, spelled out so that one seed means the same with every standard library.
// Thread: one owner.
#pragma once

#include <cstdint>
#include <random>

namespace trocar {

class SeededDraw {
 public:
  explicit SeededDraw(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double sign() { return unit() < 0.5 ? -1 : 1; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace trocar
