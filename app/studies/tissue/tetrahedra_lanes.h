// Linear tetrahedra, eight to a vector: the arithmetic that the soft solid's peers have in common.
//
// Displacements, not places, are what they hold: a float keeps 1e-8 m of a place, and a substep moves little more.
// Lanes without a tetrahedron hang on a last node that nothing moves. Thread: any.
#pragma once

#include <span>
#include <vector>

#include "app/studies/tissue/peer_body.h"
#include "tissue/solid/cell_lanes.h"

namespace trocar {

inline constexpr int kTetrahedronCorners = 4;

/// Eight tetrahedra.
struct alignas(kLanes * sizeof(float)) TetrahedraGroup {
  std::int32_t node[kTetrahedronCorners][kLanes];
  Lane inverse[kAxes][kAxes];  ///< of the matrix whose columns are the edges from the first corner
  Lane volume, mu, lambda;     ///< m3 of tissue; Lame's constants, Pa
};

/// @param order of the tetrahedra, -1 for a lane that stays empty; as many as there are lanes
std::vector<TetrahedraGroup> grouped(const PeerBody& body, std::span<const std::int32_t> order);

/// G = grad u.
TROCAR_INLINE void displacement_gradient(const NodeRow* u, const TetrahedraGroup& group, Lane (*G)[kAxes]) {
  Lane edge[kTetrahedronCorners][kAxes];
  TROCAR_UNROLLED
  for (int a = 0; a < kTetrahedronCorners; ++a) {
    const std::int32_t* n = group.node[a];
    Row low[4], high[4];
    columns(row(u[n[0]]), row(u[n[1]]), row(u[n[2]]), row(u[n[3]]), low);
    columns(row(u[n[4]]), row(u[n[5]]), row(u[n[6]]), row(u[n[7]]), high);
    TROCAR_UNROLLED
    for (int c = 0; c < kAxes; ++c) edge[a][c] = __builtin_shufflevector(low[c], high[c], 0, 1, 2, 3, 4, 5, 6, 7);
  }
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int k = 0; k < kAxes; ++k)
      G[c][k] = (edge[1][c] - edge[0][c]) * group.inverse[0][k] + (edge[2][c] - edge[0][c]) * group.inverse[1][k] +
                (edge[3][c] - edge[0][c]) * group.inverse[2][k];
  }
}

/// What a derivative by the gradient is by the corners: P inverse^T, and for the first the rest.
TROCAR_INLINE void corners_of(const Lane (*P)[kAxes], const TetrahedraGroup& group, Lane (*f)[kAxes]) {
  TROCAR_UNROLLED
  for (int c = 0; c < kAxes; ++c) {
    TROCAR_UNROLLED
    for (int j = 0; j < kAxes; ++j)
      f[j + 1][c] = P[c][0] * group.inverse[j][0] + P[c][1] * group.inverse[j][1] + P[c][2] * group.inverse[j][2];
    f[0][c] = -(f[1][c] + f[2][c] + f[3][c]);
  }
}

/// to += f at the corners.
TROCAR_INLINE void add_to_corners(const Lane (*f)[kAxes], const TetrahedraGroup& group, NodeRow* to) {
  TROCAR_UNROLLED
  for (int a = 0; a < kTetrahedronCorners; ++a) {
    const Lane x = f[a][0], y = f[a][1], z = f[a][2];
    Row rows[kLanes];
    columns(__builtin_shufflevector(x, x, 0, 1, 2, 3), __builtin_shufflevector(y, y, 0, 1, 2, 3),
            __builtin_shufflevector(z, z, 0, 1, 2, 3), Row{}, rows);
    columns(__builtin_shufflevector(x, x, 4, 5, 6, 7), __builtin_shufflevector(y, y, 4, 5, 6, 7),
            __builtin_shufflevector(z, z, 4, 5, 6, 7), Row{}, rows + 4);
    TROCAR_UNROLLED
    for (int l = 0; l < kLanes; ++l) {
      NodeRow& at = to[group.node[a][l]];
      set(at, row(at) + rows[l]);
    }
  }
}

}  // namespace trocar
