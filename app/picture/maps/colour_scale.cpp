#include "app/picture/maps/colour_scale.h"

#include <algorithm>
#include <cmath>

namespace trocar {

std::array<std::uint8_t, 3> viridis(double share) {
  static constexpr std::array<std::array<std::uint8_t, 3>, 16> kStops = {{{68, 1, 84},
                                                                          {72, 26, 108},
                                                                          {71, 47, 125},
                                                                          {65, 68, 135},
                                                                          {57, 86, 140},
                                                                          {49, 104, 142},
                                                                          {42, 120, 142},
                                                                          {35, 136, 142},
                                                                          {31, 152, 139},
                                                                          {34, 168, 132},
                                                                          {53, 183, 121},
                                                                          {84, 197, 104},
                                                                          {122, 209, 81},
                                                                          {165, 219, 54},
                                                                          {210, 226, 27},
                                                                          {253, 231, 37}}};
  const double at = (std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0) * (kStops.size() - 1);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
  const double part = at - static_cast<double>(low);
  std::array<std::uint8_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = static_cast<std::uint8_t>(std::lround(kStops[low][i] + part * (kStops[low + 1][i] - kStops[low][i])));
  return out;
}

}  // namespace trocar
