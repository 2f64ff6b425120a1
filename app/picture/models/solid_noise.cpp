#include "app/picture/models/solid_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trocar {
namespace {

constexpr std::array<std::array<float, 3>, 12> kGradients = {{{1, 1, 0},
                                                              {-1, 1, 0},
                                                              {1, -1, 0},
                                                              {-1, -1, 0},
                                                              {1, 0, 1},
                                                              {-1, 0, 1},
                                                              {1, 0, -1},
                                                              {-1, 0, -1},
                                                              {0, 1, 1},
                                                              {0, -1, 1},
                                                              {0, 1, -1},
                                                              {0, -1, -1}}};

float corner(int ix, int iy, int iz, float dx, float dy, float dz, int period) {
  const auto wrap = [period](int i) { return static_cast<std::uint32_t>(((i % period) + period) % period); };
  const auto& g =
      kGradients[lattice_hash(wrap(ix), wrap(iy), wrap(iz) + static_cast<std::uint32_t>(period) * 131U) % 12U];
  return g[0] * dx + g[1] * dy + g[2] * dz;
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float mix(float a, float b, float t) { return a + (b - a) * t; }

/// Fractal sum on a grid of size^3: octaves of 4, 8, 16 and 32 cells a tile.
std::vector<float> fractal_volume(int size) {
  std::vector<float> volume;
  volume.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int z = 0; z < size; ++z)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        double sum = 0, amplitude = 1;
        for (int cells = 4; cells <= std::min(32, size / 2); cells *= 2, amplitude *= 0.5) {
          const double step = static_cast<double>(cells) / size;
          sum += amplitude * gradient_noise((x + 0.5) * step, (y + 0.5) * step, (z + 0.5) * step, cells);
        }
        volume.push_back(static_cast<float>(std::clamp(0.5 + 0.42 * sum, 0.0, 1.0)));
      }
  return volume;
}

std::uint8_t to_byte(float unit) { return static_cast<std::uint8_t>(std::lround(std::clamp(unit, 0.0F, 1.0F) * 255)); }

}  // namespace

std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t h = x * 0x9E3779B1U ^ y * 0x85EBCA77U ^ z * 0xC2B2AE3DU;
  h ^= h >> 16;
  h *= 0x85EBCA6BU;
  h ^= h >> 13;
  h *= 0xC2B2AE35U;
  return h ^ (h >> 16);
}

double gradient_noise(double x, double y, double z, int period) {
  const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy), iz = static_cast<int>(fz);
  const auto dx = static_cast<float>(x - fx), dy = static_cast<float>(y - fy), dz = static_cast<float>(z - fz);
  const float u = fade(dx), v = fade(dy), w = fade(dz);
  const auto edge = [&](int j, int k) {
    return mix(corner(ix, iy + j, iz + k, dx, dy - static_cast<float>(j), dz - static_cast<float>(k), period),
               corner(ix + 1, iy + j, iz + k, dx - 1, dy - static_cast<float>(j), dz - static_cast<float>(k), period),
               u);
  };
  return mix(mix(edge(0, 0), edge(1, 0), v), mix(edge(0, 1), edge(1, 1), v), w);
}

std::vector<std::uint8_t> solid_noise_texture(int size) {
  const std::vector<float> volume = fractal_volume(size);
  const auto at = [&](int x, int y, int z) {
    const int mask = size - 1;
    return volume[static_cast<std::size_t>(((z & mask) * size + (y & mask)) * size + (x & mask))];
  };
  std::vector<std::uint8_t> texels;
  texels.reserve(volume.size() * 4);
  constexpr float kSlope = 3.0F;  // maps the steepest slope per texel to about +-1
  for (int z = 0; z < size; ++z)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        texels.push_back(to_byte(0.5F + kSlope * (at(x + 1, y, z) - at(x - 1, y, z))));
        texels.push_back(to_byte(0.5F + kSlope * (at(x, y + 1, z) - at(x, y - 1, z))));
        texels.push_back(to_byte(0.5F + kSlope * (at(x, y, z + 1) - at(x, y, z - 1))));
        texels.push_back(to_byte(at(x, y, z)));
      }
  return texels;
}

}  // namespace trocar
