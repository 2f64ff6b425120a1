// The colour scale "viridis" (Smith and van der Walt, 2015, CC0): even steps of lightness, so that equal differences
// look equal and colour vision, or a grey printer, makes no difference. Thread: pure.
#pragma once

#include <array>
#include <cstdint>

namespace trocar {

/// sRGB, 0..255. @param share 0 dark violet .. 1 yellow; cut to that.
std::array<std::uint8_t, 3> viridis(double share);

}  // namespace trocar
