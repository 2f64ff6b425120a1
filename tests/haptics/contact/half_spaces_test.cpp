// Nearest point that no half-space forbids: optimality conditions and brute force as oracles.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <vector>

#include "haptics/contact/half_spaces.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::half_spaces_test {
namespace {

using test::Random;

/// Nearest feasible point among the wish, its feet on all planes, lines of two and corners of three.
Vec3 by_enumeration(const Vec3& w, const std::vector<HalfSpace>& h) {
  std::vector<Vec3> candidates{w};
  const auto add = [&](std::initializer_list<std::size_t> planes) {
    Eigen::MatrixXd N(static_cast<Eigen::Index>(planes.size()), 3);
    Eigen::VectorXd d(static_cast<Eigen::Index>(planes.size()));
    Eigen::Index row = 0;
    for (const std::size_t i : planes) {
      N.row(row) = h[i].normal.transpose();
      d[row++] = -h[i].gap - h[i].normal.dot(w);
    }
    const Eigen::MatrixXd gram = N * N.transpose();
    if (std::abs(gram.determinant()) < 1e-12) return;
    candidates.push_back(w + N.transpose() * gram.inverse() * d);
  };
  for (std::size_t i = 0; i < h.size(); ++i) {
    add({i});
    for (std::size_t j = 0; j < i; ++j) {
      add({i, j});
      for (std::size_t k = 0; k < j; ++k) add({i, j, k});
    }
  }
  Vec3 best = Vec3::Zero();
  for (const Vec3& s : candidates) {
    bool allowed = true;
    for (const HalfSpace& space : h) allowed = allowed && space.normal.dot(s) >= -space.gap - 1e-9;
    if (allowed && (s - w).norm() < (best - w).norm()) best = s;
  }
  return best;
}

TEST(HalfSpaces, WithoutAnyTheWishIsGranted) { EXPECT_EQ(nearest_allowed(Vec3(1, 2, 3), {}), Vec3(1, 2, 3)); }

TEST(HalfSpaces, OnePlaneTakesTheNormalPartBeyondItsGap) {
  const HalfSpace floor{Vec3::UnitZ(), 0.5};
  EXPECT_LT((nearest_allowed(Vec3(1, 2, -3), {&floor, 1}) - Vec3(1, 2, -0.5)).norm(), 1e-15);
  EXPECT_EQ(nearest_allowed(Vec3(1, 2, -0.4), {&floor, 1}), Vec3(1, 2, -0.4));
}

TEST(HalfSpaces, EqualsEnumerationOnRandomCones) {
  Random random(1);
  for (int k = 0; k < 3000; ++k) {
    std::vector<HalfSpace> h(static_cast<std::size_t>(1 + random.below(8)));
    for (HalfSpace& space : h) space = {random.direction(), random.below(2) ? 0 : random.between(0, 0.5)};
    const Vec3 w = random.vector(2), found = nearest_allowed(w, h), best = by_enumeration(w, h);
    for (const HalfSpace& space : h) EXPECT_GE(space.normal.dot(found), -space.gap - 1e-9);
    EXPECT_NEAR((found - w).norm(), (best - w).norm(), 1e-7);
  }
}

TEST(HalfSpaces, NearlyParallelFacetsAreNoProblem) {
  // Facets of a smooth surface: normals within a few degrees, gaps of micrometres.
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    std::vector<HalfSpace> h(static_cast<std::size_t>(2 + random.below(5)));
    for (HalfSpace& space : h) space = {(Vec3::UnitZ() + random.vector(0.03)).normalized(), random.between(0, 5e-5)};
    const Vec3 w(random.symmetric(1e-4), random.symmetric(1e-4), -2e-3);
    const Vec3 found = nearest_allowed(w, h);
    for (const HalfSpace& space : h) EXPECT_GE(space.normal.dot(found), -space.gap - 1e-12);
    EXPECT_NEAR((found - w).norm(), (by_enumeration(w, h) - w).norm(), 1e-9);
  }
}

TEST(HalfSpaces, DoublePlanesCountOnce) {
  const std::vector<HalfSpace> twice(6, HalfSpace{Vec3::UnitX(), 0});
  EXPECT_LT((nearest_allowed(Vec3(-1, 2, 3), twice) - Vec3(0, 2, 3)).norm(), 1e-15);
}

}  // namespace
}  // namespace trocar::half_spaces_test
