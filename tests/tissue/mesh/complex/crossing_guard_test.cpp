#include "tissue/mesh/complex/crossing_guard.h"

#include <gtest/gtest.h>

#include <numbers>

namespace trocar::crossing_guard_test {
namespace {

/// Two level sheets of 8 x 8 squares, a millimetre apart; each its own pair of regions.
LabelComplex two_sheets() {
  constexpr int kSide = 9;
  LabelComplex complex;
  for (int sheet = 0; sheet < 2; ++sheet) {
    const auto first = static_cast<std::int32_t>(complex.vertices.size());
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) complex.vertices.emplace_back(i * 1e-3, j * 1e-3, sheet * 1e-3);
    for (int j = 0; j + 1 < kSide; ++j)
      for (int i = 0; i + 1 < kSide; ++i) {
        const std::int32_t a = first + i + kSide * j;
        complex.triangles.push_back({a, a + 1, a + kSide + 1});
        complex.triangles.push_back({a, a + kSide + 1, a + kSide});
      }
  }
  complex.regions.assign(complex.triangles.size(), {0, 1});
  for (std::size_t t = complex.triangles.size() / 2; t < complex.regions.size(); ++t) complex.regions[t] = {0, 2};
  for (Vec3& vertex : complex.vertices) vertex = vertex.cast<float>().cast<double>();
  return complex;
}

NumberedTriangle triangle(std::array<std::int32_t, 3> corners, const Vec3& a, const Vec3& b, const Vec3& c) {
  return {corners, {a, b, c}};
}

TEST(TrianglesCross, OnlyInMoreThanTheCornersTheyShare) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const NumberedTriangle flat = triangle({0, 1, 2}, o, x, y);
  const Vec3 within(0.3, 0.3, 0), below(0.3, 0.3, -1), beside(2, 2, 0);
  EXPECT_TRUE(triangles_cross(flat, triangle({3, 4, 5}, within + z, below, below + x)));
  EXPECT_TRUE(triangles_cross(flat, triangle({3, 4, 5}, within, within + z, within + z + x)));  // touches
  EXPECT_FALSE(triangles_cross(flat, triangle({3, 4, 5}, o + z, x + z, y + z)));
  EXPECT_FALSE(triangles_cross(flat, triangle({3, 4, 5}, beside, beside + x, beside + y)));
  EXPECT_FALSE(triangles_cross(flat, triangle({0, 3, 4}, o, z, z - x)));  // a common corner
  EXPECT_TRUE(triangles_cross(flat, triangle({3, 0, 4}, within + z, o, within - z)));
  EXPECT_TRUE(triangles_cross(flat, triangle({0, 3, 4}, o, within, z)));
  EXPECT_FALSE(triangles_cross(flat, triangle({2, 0, 3}, y, o, z)));  // a common edge
  EXPECT_FALSE(triangles_cross(flat, triangle({1, 0, 3}, x, o, -y)));
  EXPECT_TRUE(triangles_cross(flat, triangle({1, 0, 3}, x, o, Vec3(0.5, 2, 0))));  // folded over
  EXPECT_TRUE(has_area(flat));
  EXPECT_FALSE(has_area(triangle({0, 1, 2}, o, x, 0.5 * x)));
}

TEST(CrossingGuard, FindsWhatCrosses) {
  LabelComplex complex = two_sheets();
  EXPECT_TRUE(CrossingGuard(complex).crossing().empty());
  complex.vertices[40].z() = 1.5e-3;  // the middle of the lower sheet, through the upper one
  EXPECT_FALSE(CrossingGuard(complex).crossing().empty());
}

TEST(CrossingGuard, FollowsTheEditsThatItIsTold) {
  const LabelComplex complex = two_sheets();
  CrossingGuard guard(complex);
  const Vec3 high(4.2e-3, 4.1e-3, 5e-3);
  const NumberedTriangle pin = triangle({200, 201, 202}, high, high + Vec3(1e-3, 0, 0), Vec3(4.2e-3, 4.1e-3, 0.5e-3));
  EXPECT_FALSE(guard.clear({pin}, {}));
  std::vector<std::int32_t> upper;
  for (std::size_t t = complex.triangles.size() / 2; t < complex.triangles.size(); ++t)
    upper.push_back(static_cast<std::int32_t>(t));
  EXPECT_TRUE(guard.clear({pin}, upper));
  for (const auto t : upper) guard.erase(t);
  EXPECT_TRUE(guard.clear({pin}, {}));
  guard.set(static_cast<std::int32_t>(complex.triangles.size()), pin);
  EXPECT_FALSE(guard.clear({triangle({210, 211, 212}, high, high + Vec3(0, 1e-3, 0), high - Vec3(0, 1e-3, 0))}, {}));
  EXPECT_FALSE(guard.clear({triangle({210, 211, 212}, Vec3::Zero(), Vec3::Zero(), Vec3::UnitX())}, {}));  // no area
}

TEST(MoveWithoutCrossing, EveryVertexGoesAsFarAsItMay) {
  LabelComplex complex = two_sheets();
  std::vector<Vec3> wanted = complex.vertices;
  for (std::size_t v = 0; v < 81; ++v) wanted[v].z() += 0.5e-3;
  wanted[40].z() = 1.6e-3;  // would pierce the upper sheet; half of the way is free
  EXPECT_EQ(move_without_crossing(complex, wanted), 1U);
  EXPECT_TRUE(CrossingGuard(complex).crossing().empty());
  EXPECT_NEAR(complex.vertices[40].z(), 0.8e-3, 1e-9);
  EXPECT_NEAR(complex.vertices[39].z(), 0.5e-3, 1e-9);
}

TEST(MoveWithoutCrossing, SheetsThatMoveTogetherDoNotHoldEachOtherUp) {
  LabelComplex complex = two_sheets();
  std::vector<Vec3> wanted = complex.vertices;
  for (Vec3& place : wanted) place.z() += 1.2e-3;  // the lower one to beyond where the upper one is
  move_without_crossing(complex, wanted);
  EXPECT_TRUE(CrossingGuard(complex).crossing().empty());
  for (std::size_t v = 81; v < 162; ++v) EXPECT_NEAR(complex.vertices[v].z(), 2.2e-3, 1e-9);
  EXPECT_GT(complex.vertices[40].z(), 0.55e-3);
}

TEST(MoveWithoutCrossing, NoTriangleBecomesThin) {
  LabelComplex complex = two_sheets();
  std::vector<Vec3> wanted = complex.vertices;
  wanted[40].x() += 0.97e-3;  // almost onto its neighbour
  move_without_crossing(complex, wanted);
  double sharpest = 0;
  for (const auto& [a, b, c] : complex.triangles) {
    const auto at = [&](std::int32_t v) { return complex.vertices[static_cast<std::size_t>(v)]; };
    sharpest = std::max(sharpest, sharpest_cosine({at(a), at(b), at(c)}));
  }
  EXPECT_LE(sharpest, kThinCosine);
  EXPECT_NEAR(std::acos(kThinCosine) * 180 / std::numbers::pi, 10, 0.1);
}

}  // namespace
}  // namespace trocar::crossing_guard_test
