// The cube's stiffness against one integrated here by other points, and what any stiffness has to be.
#include "tissue/solid/cube_element.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <functional>
#include <random>

namespace trocar::cube_element_test {
namespace {

using CubeMatrix = Eigen::Matrix<double, 24, 24>;
using Vec24 = Eigen::Matrix<double, 24, 1>;

Vec3 corner(int a) { return {a & 1 ? 1.0 : 0.0, a & 2 ? 1.0 : 0.0, a & 4 ? 1.0 : 0.0}; }

Vec24 displacements(const std::function<Vec3(const Vec3&)>& field) {
  Vec24 u;
  for (int a = 0; a < kCubeCorners; ++a) u.segment<3>(3 * a) = field(corner(a));
  return u;
}

/// B-bar with 3 x 3 x 3 points, gradients by finite differences of products of the corner functions: shares nothing
/// with the code but the definition. Deviatoric strain at the points, dilatation its mean.
CubeMatrix integrated(double edge, double mu, double kappa) {
  const double at[3] = {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)};
  const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const auto shape = [](int a, const Vec3& x) {
    double value = 1;
    for (int c = 0; c < 3; ++c) value *= (a >> c & 1) != 0 ? x[c] : 1 - x[c];
    return value;
  };
  CubeMatrix deviatoric = CubeMatrix::Zero();
  Vec24 mean = Vec24::Zero();
  for (int g = 0; g < 27; ++g) {
    const Vec3 x(at[g % 3], at[g / 3 % 3], at[g / 9]);
    const double w = weight[g % 3] * weight[g / 3 % 3] * weight[g / 9] * edge * edge * edge;
    Eigen::Matrix<double, 9, 24> strain;  // column-major 3 x 3 tensor
    Eigen::Matrix<double, 1, 24> trace;
    for (int a = 0; a < 8; ++a)
      for (int c = 0; c < 3; ++c) {
        Mat3 gradient = Mat3::Zero();
        // Linear in each coordinate: a difference over the whole edge is exact.
        for (int k = 0; k < 3; ++k) {
          Vec3 low = x, high = x;
          low[k] = 0;
          high[k] = 1;
          gradient(c, k) = (shape(a, high) - shape(a, low)) / edge;
        }
        const Mat3 e = 0.5 * (gradient + gradient.transpose());
        const Mat3 shape_change = e - e.trace() / 3 * Mat3::Identity();
        strain.col(3 * a + c) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(shape_change.data());
        trace[3 * a + c] = e.trace();
      }
    deviatoric += w * 2 * mu * strain.transpose() * strain;
    mean += w * trace.transpose();
  }
  const double volume = edge * edge * edge;
  return deviatoric + kappa / volume * mean * mean.transpose();
}

constexpr double kRounding = 1e-13;  // of the largest entry: 24 sums of 27 products in double

TEST(CubeElement, MatrixIsThatOfAnIndependentIntegration) {
  for (const double edge : {1.0, 0.01})
    for (const double kappa : {0.7, 40.0}) {
      const CubeMatrix wanted = integrated(edge, 1.3, kappa), got = cube_matrix(edge, 1.3, kappa);
      EXPECT_LT((got - wanted).cwiseAbs().maxCoeff(), kRounding * wanted.cwiseAbs().maxCoeff()) << kappa;
    }
}

TEST(CubeElement, EightBlocksAreTheWholeMatrix) {
  const CubeStiffness& cube = cube_stiffness();
  CubeMatrix assembled = CubeMatrix::Zero();
  const double mu = 2.1, kappa = 17;
  for (int p = 0; p < kCubeCorners; ++p)
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) {
        const double value =
            mu * cube.deviatoric[std::size_t(p)](c, d) + (p == 0 ? kappa * cube.dilatation(c, d) : 0.0);
        for (int a = 0; a < kCubeCorners; ++a)
          for (int b = 0; b < kCubeCorners; ++b)
            assembled(3 * a + c, 3 * b + d) += walsh(mode_of(p, c), a) * value * walsh(mode_of(p, d), b);
      }
  const CubeMatrix wanted = cube_matrix(1, mu, kappa);
  EXPECT_LT((assembled - wanted).cwiseAbs().maxCoeff(), kRounding * wanted.cwiseAbs().maxCoeff());
}

TEST(CubeElement, IsSymmetricAndOnlyRigidMotionsAreFree) {
  const CubeMatrix K = cube_matrix(0.01, 1700, 17000);
  const double scale = K.cwiseAbs().maxCoeff();
  EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), kRounding * scale);
  const Vec24 values = Eigen::SelfAdjointEigenSolver<CubeMatrix>(K).eigenvalues();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(values[i], 0, 1e-12 * scale) << "rigid";
  EXPECT_GT(values[6], 1e-3 * scale) << "no hourglass shape is free";
}

TEST(CubeElement, RigidMotionsGiveNoForce) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const CubeMatrix K = cube_matrix(1, 1, 30);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 shift(normal(random), normal(random), normal(random)), spin(normal(random), normal(random), 1);
    const Vec24 u = displacements([&](const Vec3& x) { return Vec3(shift + spin.cross(x)); });
    EXPECT_LT((K * u).norm(), 1e-12 * u.norm() * K.cwiseAbs().maxCoeff());
  }
}

TEST(CubeElement, UniformStrainHasItsEnergy) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const double edge = 0.02, mu = 1700, kappa = 9000;
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 G = Mat3::NullaryExpr([&] { return normal(random); });
    const Mat3 e = 0.5 * (G + G.transpose()), s = e - e.trace() / 3 * Mat3::Identity();
    const double wanted = edge * edge * edge * (mu * s.squaredNorm() + 0.5 * kappa * e.trace() * e.trace());
    const Vec24 u = displacements([&](const Vec3& x) { return Vec3(edge * G * x); });
    EXPECT_NEAR(0.5 * u.dot(cube_matrix(edge, mu, kappa) * u), wanted, 1e-12 * wanted);
  }
}

}  // namespace
}  // namespace trocar::cube_element_test
