// The stiffness of a cube of isotropic material with mean dilatation (B-bar), in the basis in which it is almost
// diagonal.
//
// Displacements of the eight corners are taken by component into Walsh functions: mode m is the product of the signs of
// the coordinates whose bits are in m (1 = x, 2 = y, 4 = z), so mode 0 is translation, 1, 2, 4 the mean gradient, 3, 5,
// 6, 7 hourglass shapes. The cube's three mirror planes leave eight classes of three that do not meet: in class p
// component c has mode p xor (1 << c). So a 24 x 24 matrix is eight 3 x 3 ones, and no step of the solver ever
// assembles anything.
//
// Deviatoric part by 2 x 2 x 2 points, dilatation its mean over the cube (Hughes 1980); both exact for a cube. Unit
// cube, unit modulus: the stiffness of an edge h is h mu deviatoric + h kappa dilatation. Thread: any.
#pragma once

#include <array>

#include "haptics/quantities.h"

namespace trocar {

inline constexpr int kCubeCorners = 8;

/// f^ = block u^, where u^_m = sum over corners of walsh(m, corner) u and f = sum over modes of walsh(m, corner) f^_m.
struct CubeStiffness {
  std::array<Mat3, kCubeCorners> deviatoric;  ///< by class, of a unit cube with shear modulus 1
  Mat3 dilatation;                            ///< class 0 alone, of a unit cube with bulk modulus 1
};

/// +1 or -1: value of mode m at a corner (bits 1 = +x, 2 = +y, 4 = +z).
constexpr int walsh(int mode, int corner) {
  int sign = 1;
  for (int bit = 1; bit < kCubeCorners; bit <<= 1)
    if ((mode & bit) != 0 && (corner & bit) == 0) sign = -sign;
  return sign;
}

/// Mode of component c in class p.
constexpr int mode_of(int p, int c) { return p ^ (1 << c); }

const CubeStiffness& cube_stiffness();

/// The same as a matrix over the corners, 3 x corner + component, for tests and small reference problems. N/m
Eigen::Matrix<double, 24, 24> cube_matrix(double edge_m, double shear_pa, double bulk_pa);

}  // namespace trocar
