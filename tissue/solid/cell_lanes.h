// Eight cells at a time: the arithmetic of the soft solid's element, with a vector of eight floats for every number.
//
// A cell's displacement is held by component and Walsh mode (cube_element.h). Against a change of shape the stiffness
// is written out by what meets what, the rest being zero: for axes c, d, e and u_c of a mode named by its axes
//   f_c,c = stretch u_c,c + stretch_across (u_d,d + u_e,e)   f_c,d   = shear (u_c,d + u_d,c)
//   f_c,cd = bend u_c,cd + bend_across u_e,ed                f_c,cde = hourglass u_c,cde
//   f_c,de = warp u_c,de + warp_across (u_d,ec + u_e,cd)
// so a product takes 30 multiplications, and 18 by the modulus, and not the 576 of the full matrix. Gathering and
// scattering turn rows of nodes into lanes and back in registers. The vector path and the portable one do the same
// operations in the same order. Thread: any.
#pragma once

#include <cstdint>
#include <cstring>

#include "tissue/solid/cube_element.h"
#include "tissue/solid/node_row.h"

// A test defines it empty, for the path that every machine can go.
#if defined(TROCAR_LANES_CLONED)
#elif defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TROCAR_LANES_CLONED __attribute__((target_clones("default", "avx2")))
#else
#define TROCAR_LANES_CLONED
#endif
#define TROCAR_INLINE [[gnu::always_inline]] inline
#define TROCAR_UNROLLED _Pragma("GCC unroll 8")

namespace trocar {

inline constexpr int kLanes = 8;
inline constexpr int kAxes = 3;
inline constexpr int kRotationSteps = 4;  // warm-started: each leaves of the error its square and half the strain of it
// Up to which the volume is that of the cell; beyond, as it grows from there on.
inline constexpr float kMostGradient = 0.5F;
inline constexpr float kNoGradient = 1e-9F;  // keeps the division of a collapsed cell defined

using Lane = float __attribute__((vector_size(kLanes * sizeof(float))));
using Row = float __attribute__((vector_size(sizeof(NodeRow))));

TROCAR_INLINE Lane all(float value) { return Lane{} + value; }
TROCAR_INLINE Row row(const NodeRow& from) {
  Row out;
  std::memcpy(&out, from.at, sizeof out);
  return out;
}
TROCAR_INLINE void set(NodeRow& to, Row value) { std::memcpy(to.at, &value, sizeof value); }

/// Corners to modes and back but for the factor 8: the same butterflies, the sign at the lower corner.
TROCAR_INLINE void to_modes(Lane* v) {
  TROCAR_UNROLLED
  for (int bit = 1; bit < kCubeCorners; bit <<= 1) {
    TROCAR_UNROLLED
    for (int a = 0; a < kCubeCorners; ++a)
      if ((a & bit) == 0) {
        const Lane low = v[a], high = v[a | bit];
        v[a] = low + high;
        v[a | bit] = high - low;
      }
  }
}
TROCAR_INLINE void to_corners(Lane* v) {
  TROCAR_UNROLLED
  for (int bit = 1; bit < kCubeCorners; bit <<= 1) {
    TROCAR_UNROLLED
    for (int a = 0; a < kCubeCorners; ++a)
      if ((a & bit) == 0) {
        const Lane mean = v[a], difference = v[a | bit];
        v[a] = mean - difference;
        v[a | bit] = mean + difference;
      }
  }
}

/// The element's constants as floats.
struct FloatCube {
  float stretch, stretch_across, shear, bend, bend_across, warp, warp_across, hourglass;
  float dilatation;  ///< the same for every pair of axes
};
inline const FloatCube& float_cube() {
  static const FloatCube cube = [] {
    const CubeStiffness& exact = cube_stiffness();
    const auto of = [&](std::size_t p, int c, int d) { return static_cast<float>(exact.deviatoric[p](c, d)); };
    return FloatCube{of(0, 0, 0), of(0, 0, 1), of(3, 0, 1),
                     of(1, 1, 1), of(1, 1, 2), of(7, 0, 0),
                     of(7, 0, 1), of(3, 2, 2), static_cast<float>(exact.dilatation(0, 0))};
  }();
  return cube;
}

/// f = mu deviatoric u in modes; u and f by component and mode. Stiffness with edge and fill.
TROCAR_INLINE void stiffen(const FloatCube& cube, const Lane (*u)[kCubeCorners], Lane mu, Lane (*f)[kCubeCorners]) {
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    const int d = (c + 1) % kAxes, e = (c + 2) % kAxes, x = 1 << c, y = 1 << d, z = 1 << e;
    f[c][0] = Lane{};
    f[c][x] = mu * (cube.stretch * u[c][x] + cube.stretch_across * (u[d][y] + u[e][z]));
    f[c][y | z] = mu * (cube.warp * u[c][y | z] + cube.warp_across * (u[d][z | x] + u[e][x | y]));
    f[c][x | y | z] = mu * (cube.hourglass * u[c][x | y | z]);
    f[c][y] = f[d][x] = mu * (cube.shear * (u[c][y] + u[d][x]));
    f[d][x | y] = mu * (cube.bend * u[d][x | y] + cube.bend_across * u[e][x | z]);
    f[e][x | z] = mu * (cube.bend * u[e][x | z] + cube.bend_across * u[d][x | y]);
  }
}
/// How the volume grows with u: growth : grad u. In the small the trace.
TROCAR_INLINE Lane swelling(const Lane (*growth)[kAxes], const Lane (*u)[kCubeCorners]) {
  Lane sum{};
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) sum += growth[c][k] * u[c][1 << k];
  }
  return sum;
}
/// f += the pressure against that. @param pressure with dilatation, edge and fill
TROCAR_INLINE void press(const Lane (*growth)[kAxes], Lane pressure, Lane (*f)[kCubeCorners]) {
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) f[c][1 << k] += pressure * growth[c][k];
  }
}

/// e^x less 1 for x of at most 2.5, to 3e-7 of it. No library's: theirs differ from processor to processor.
TROCAR_INLINE Lane exponential_less_one(Lane x) {
  const Lane y = x * (1.0F / 16);
  Lane less_one = y * (1.0F + y * (0.5F + y * (1.0F / 6 + y * (1.0F / 24 + y * (1.0F / 120)))));
  TROCAR_UNROLLED
  for (int doubled = 0; doubled < 4; ++doubled) less_one *= 2.0F + less_one;
  return less_one;
}

/// Volume of a cell less that at rest, over that at rest, from the mean gradient 1 + e of its turned corners, and how
/// it grows with e: the cofactors.
TROCAR_INLINE Lane volume_change(const Lane (*e)[kAxes], Lane (*growth)[kAxes]) {
  Lane g[kAxes][kAxes], beyond{};
  const Lane most = all(kMostGradient);
  TROCAR_UNROLLED
  for (int i = 0; i < kAxes * kAxes; ++i) {
    const Lane value = e[i / kAxes][i % kAxes], above = value > most ? most : value;
    g[i / kAxes][i % kAxes] = above < -most ? -most : above;
  }
  Lane change = g[0][0] + g[1][1] + g[2][2];
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    const int d = (c + 1) % kAxes, f = (c + 2) % kAxes;
    change += g[d][d] * g[f][f] - g[d][f] * g[f][d];
    change += g[0][c] * (g[1][d] * g[2][f] - g[1][f] * g[2][d]);
  }
  for (int c = 0; c < kAxes; ++c) g[c][c] += 1.0F;
  TROCAR_UNROLLED
  for (int i = 0; i < kAxes * kAxes; ++i) {
    const int c = i / kAxes, k = i % kAxes;
    const int d = (c + 1) % kAxes, f = (c + 2) % kAxes, m = (k + 1) % kAxes, n = (k + 2) % kAxes;
    growth[c][k] = g[d][m] * g[f][n] - g[d][n] * g[f][m];
    beyond += growth[c][k] * (e[c][k] - (c == k ? g[c][k] - 1.0F : g[c][k]));
  }
  return change + beyond;
}

/// The four rows' components side by side, and back: a transposition.
TROCAR_INLINE void columns(Row a, Row b, Row c, Row d, Row* out) {
  const Row ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Row ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  out[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  out[2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  out[3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}
TROCAR_INLINE void gather(const NodeRow* from, const std::int32_t (*node)[kLanes], Lane (*v)[kCubeCorners]) {
  TROCAR_UNROLLED
  for (int a = 0; a < kCubeCorners; ++a) {
    const std::int32_t* n = node[a];
    Row low[4], high[4];
    columns(row(from[n[0]]), row(from[n[1]]), row(from[n[2]]), row(from[n[3]]), low);
    columns(row(from[n[4]]), row(from[n[5]]), row(from[n[6]]), row(from[n[7]]), high);
    TROCAR_UNROLLED
    for (int c = 0; c < kAxes; ++c) v[c][a] = __builtin_shufflevector(low[c], high[c], 0, 1, 2, 3, 4, 5, 6, 7);
  }
}
TROCAR_INLINE void scatter(const Lane (*v)[kCubeCorners], const std::int32_t (*node)[kLanes], NodeRow* to) {
  TROCAR_UNROLLED
  for (int a = 0; a < kCubeCorners; ++a) {
    const Lane x = v[0][a], y = v[1][a], z = v[2][a];
    Row rows[kLanes];
    columns(__builtin_shufflevector(x, x, 0, 1, 2, 3), __builtin_shufflevector(y, y, 0, 1, 2, 3),
            __builtin_shufflevector(z, z, 0, 1, 2, 3), Row{}, rows);
    columns(__builtin_shufflevector(x, x, 4, 5, 6, 7), __builtin_shufflevector(y, y, 4, 5, 6, 7),
            __builtin_shufflevector(z, z, 4, 5, 6, 7), Row{}, rows + 4);
    TROCAR_UNROLLED
    for (int l = 0; l < kLanes; ++l) {
      NodeRow& at = to[node[a][l]];
      set(at, row(at) + rows[l]);
    }
  }
}

/// v <- R^T v and v <- R v, by mode, but for the translation, which has no part in any force.
TROCAR_INLINE void turn_back(const Lane (*R)[kAxes], Lane (*v)[kCubeCorners]) {
  TROCAR_UNROLLED
  for (int m = 1; m < kCubeCorners; ++m) {
    const Lane x = v[0][m], y = v[1][m], z = v[2][m];
    TROCAR_UNROLLED
    for (int c = 0; c < kAxes; ++c) v[c][m] = R[0][c] * x + R[1][c] * y + R[2][c] * z;
  }
}
TROCAR_INLINE void turn(const Lane (*R)[kAxes], Lane (*v)[kCubeCorners]) {
  TROCAR_UNROLLED
  for (int m = 1; m < kCubeCorners; ++m) {
    const Lane x = v[0][m], y = v[1][m], z = v[2][m];
    TROCAR_UNROLLED
    for (int c = 0; c < kAxes; ++c) v[c][m] = R[c][0] * x + R[c][1] * y + R[c][2] * z;
  }
}

/// The rotation nearest to a gradient F, from a guess: turns R by the torque that its columns feel towards F's.
TROCAR_INLINE void follow_rotation(const Lane (*F)[kAxes], Lane (*R)[kAxes]) {
  for (int step = 0; step < kRotationSteps; ++step) {
    Lane w[kAxes]{}, weight{};
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) {
      TROCAR_UNROLLED
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
        w[c] += R[d][k] * F[e][k] - R[e][k] * F[d][k];
      }
      weight += R[0][k] * F[0][k] + R[1][k] * F[1][k] + R[2][k] * F[2][k];
    }
    weight = (weight < 0.0F ? -weight : weight) + kNoGradient;
    Lane q[kAxes];
    // Half the angle, for the Cayley map. Near a stretch S the torque of a turn v is (tr S - S) v, 2/3 of tr S v at
    // rest: with that and not with all of tr S nothing is left of a turn of an undeformed cell.
    TROCAR_UNROLLED
    for (int c = 0; c < kAxes; ++c) q[c] = 0.75F * w[c] / weight;
    const Lane scale = 2.0F / (1.0F + q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k) {
      const Lane r[kAxes] = {R[0][k], R[1][k], R[2][k]};
      Lane t[kAxes];
      TROCAR_UNROLLED
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
        t[c] = r[c] + (q[d] * r[e] - q[e] * r[d]);
      }
      TROCAR_UNROLLED
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
        R[c][k] = r[c] + scale * (q[d] * t[e] - q[e] * t[d]);
      }
    }
  }
}

}  // namespace trocar
