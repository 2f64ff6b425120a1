// Tileable solid noise: the texture of all tissue, so that no organ needs an unwrapped surface.
//
// Value: fractal sum of gradient noise (Perlin 2002 fade curve) over a periodic lattice with an integer hash, so the
// bytes are the same on every machine. Texel: rgb = gradient of the value mapped from [-1, 1], a = value in [0, 1].
// Thread: any.
#pragma once

#include <cstdint>
#include <vector>

namespace trocar {

/// 32-bit integer hash (finaliser of MurmurHash3) of a lattice point.
std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t y, std::uint32_t z);

/// Periodic gradient noise in about [-1, 1]; x, y, z in lattice cells; repeats every `period` cells.
double gradient_noise(double x, double y, double z, int period);

/// Texture of size^3 RGBA8 texels, x fastest. @param size power of two, 8 to 128.
std::vector<std::uint8_t> solid_noise_texture(int size);

}  // namespace trocar
