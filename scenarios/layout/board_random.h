// What a board draws: the same numbers for the same board, on every standard library.
//
// Thread: loading only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace trocar {

class BoardRandom {
 public:
  explicit BoardRandom(int board) : generator_(0x9E3779B97F4A7C15ull * (static_cast<std::uint64_t>(board) + 1)) {}
  /// In [0, 1), by an explicit formula.
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
  /// In [-most, most).
  double either_way(double most) { return (2 * uniform() - 1) * most; }
  /// In [0, count).
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }
  /// Fisher and Yates.
  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[index(i)]);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace trocar
