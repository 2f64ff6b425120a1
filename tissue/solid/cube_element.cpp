#include "tissue/solid/cube_element.h"

#include <cmath>

namespace trocar {
namespace {

using CubeMatrix = Eigen::Matrix<double, 24, 24>;
using Row24 = Eigen::Matrix<double, 1, 24>;
constexpr int kAxes = 3;

/// Gradients of the eight trilinear functions in a unit cube about the origin.
Eigen::Matrix<double, 3, 8> gradients(const Vec3& at) {
  Eigen::Matrix<double, 3, 8> out;
  for (int a = 0; a < kCubeCorners; ++a) {
    const Vec3 sign(walsh(1, a), walsh(2, a), walsh(4, a));
    for (int c = 0; c < kAxes; ++c) {
      const int d = (c + 1) % kAxes, e = (c + 2) % kAxes;
      out(c, a) = sign[c] * (0.5 + sign[d] * at[d]) * (0.5 + sign[e] * at[e]);
    }
  }
  return out;
}

struct UnitCube {
  CubeMatrix deviatoric = CubeMatrix::Zero();
  Row24 dilatation = Row24::Zero();  ///< mean
};

UnitCube integrate() {
  UnitCube cube;
  const double point = 0.5 / std::sqrt(3.0), weight = 1.0 / kCubeCorners;
  for (int g = 0; g < kCubeCorners; ++g) {
    const auto gradient = gradients(point * Vec3(walsh(1, g), walsh(2, g), walsh(4, g)));
    Eigen::Matrix<double, 6, 24> strain = Eigen::Matrix<double, 6, 24>::Zero();  // xx yy zz, then engineering shears
    for (int a = 0; a < kCubeCorners; ++a)
      for (int c = 0; c < kAxes; ++c) {
        const int d = (c + 1) % kAxes;
        strain(c, 3 * a + c) = gradient(c, a);
        strain(kAxes + c, 3 * a + c) = gradient(d, a);
        strain(kAxes + c, 3 * a + d) = gradient(c, a);
      }
    const Row24 volume = strain.topRows<3>().colwise().sum();
    cube.dilatation += weight * volume;
    for (int c = 0; c < kAxes; ++c) {
      const Row24 normal = strain.row(c) - volume / 3, shear = strain.row(kAxes + c);
      cube.deviatoric += weight * (2 * normal.transpose() * normal + shear.transpose() * shear);
    }
  }
  return cube;
}

/// One class of a matrix over the corners.
Mat3 block(const CubeMatrix& matrix, int p) {
  Mat3 out = Mat3::Zero();
  for (int c = 0; c < kAxes; ++c)
    for (int d = 0; d < kAxes; ++d)
      for (int a = 0; a < kCubeCorners; ++a)
        for (int b = 0; b < kCubeCorners; ++b)
          out(c, d) += walsh(mode_of(p, c), a) * matrix(3 * a + c, 3 * b + d) * walsh(mode_of(p, d), b) / 64.0;
  return out;
}

}  // namespace

const CubeStiffness& cube_stiffness() {
  static const CubeStiffness stiffness = [] {
    const UnitCube cube = integrate();
    CubeStiffness out;
    for (int p = 0; p < kCubeCorners; ++p) out.deviatoric[static_cast<std::size_t>(p)] = block(cube.deviatoric, p);
    out.dilatation = block(cube.dilatation.transpose() * cube.dilatation, 0);
    return out;
  }();
  return stiffness;
}

Eigen::Matrix<double, 24, 24> cube_matrix(double edge_m, double shear_pa, double bulk_pa) {
  const UnitCube cube = integrate();
  return edge_m * (shear_pa * cube.deviatoric + bulk_pa * cube.dilatation.transpose() * cube.dilatation);
}

}  // namespace trocar
