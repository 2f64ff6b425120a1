// The index of an encoder in DaqSample::digital_in: the number of the joint that stood at its mark at the latch.
//
// Joints 1 to 6 as a number in bits 15, 23 and 31, which no other input uses; 0: none. Of two at once the lower is
// told: a mark that stays is told at the next latch. It is recorded and replayed with the inputs. Thread: pure.
#pragma once

#include <cstdint>

namespace trocar {

inline constexpr std::uint32_t kMarkBits = 1u << 15 | 1u << 23 | 1u << 31;

/// @param joint 0 to 5.
constexpr std::uint32_t index_mark(int joint) {
  const auto n = static_cast<std::uint32_t>(joint + 1);
  return (n & 1) << 15 | (n >> 1 & 1) << 23 | (n >> 2 & 1) << 31;
}

/// Joint 0 to 5; -1: none.
constexpr int marked_joint(std::uint32_t digital_in) {
  return static_cast<int>((digital_in >> 15 & 1) | (digital_in >> 23 & 1) << 1 | (digital_in >> 31 & 1) << 2) - 1;
}

}  // namespace trocar
