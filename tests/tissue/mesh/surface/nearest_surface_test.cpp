#include "tissue/mesh/surface/nearest_surface.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "haptics/contact/segment_triangle.h"
#include "tests/tissue/support/shapes.h"

namespace trocar::nearest_surface_test {
namespace {

std::array<Vec3, 3> corners(const TriangleSurface& surface, std::size_t triangle) {
  std::array<Vec3, 3> p;
  for (std::size_t n = 0; n < 3; ++n) p[n] = surface.vertices[static_cast<std::size_t>(surface.triangles[triangle][n])];
  return p;
}

/// Every triangle looked at.
double least_distance(const TriangleSurface& surface, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    least = std::min(least, (closest_point_on_triangle(point, corners(surface, t)) - point).norm());
  return least;
}

class Dice {
 public:
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max());
  }
  Vec3 point(double low, double high) {
    const double x = real(low, high), y = real(low, high);
    return {x, y, real(low, high)};
  }
  std::size_t below(std::size_t count) { return engine_() % count; }

 private:
  std::mt19937 engine_{7};
};

TriangleSurface soup(Dice& dice, int count, double low, double high, double size) {
  TriangleSurface surface;
  for (int n = 0; n < count; ++n) {
    const Vec3 place = dice.point(low, high);
    for (int corner = 0; corner < 3; ++corner) surface.vertices.push_back(place + dice.point(-size, size));
    surface.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  }
  return surface;
}

/// The distance, the place, the normal and the triangle of the answer agree with each other and with a look at every
/// triangle.
void expect_nearest(const TriangleSurface& surface, const NearestSurface& tree, const Vec3& point, std::size_t guess) {
  const NearestSurface::Hit hit = tree.nearest(point, guess);
  EXPECT_DOUBLE_EQ((hit.place - point).norm(), least_distance(surface, point)) << point.transpose();
  ASSERT_LT(hit.triangle, surface.triangles.size());
  const auto p = corners(surface, hit.triangle);
  EXPECT_EQ(hit.place, closest_point_on_triangle(point, p));
  EXPECT_EQ(hit.normal, (p[1] - p[0]).cross(p[2] - p[0]));
}

TEST(NearestSurface, AgreesWithALookAtEveryTriangle) {
  Dice dice;
  for (const int count : {1, 2, 3, 4, 5, 16, 17, 65, 300}) {
    const TriangleSurface surface = soup(dice, count, -0.1, 0.1, 0.02);
    const NearestSurface tree(surface);
    for (int n = 0; n < 200; ++n)
      expect_nearest(surface, tree, dice.point(-0.2, 0.2), dice.below(surface.triangles.size()));
  }
}

TEST(NearestSurface, NoGuessChangesTheDistance) {
  Dice dice;
  const TriangleSurface surface = test::sphere(Vec3(0.3, -0.2, 1.1), 0.08, 3);
  const NearestSurface tree(surface);
  const Vec3 point(0.33, -0.25, 1.15);
  const double distance = least_distance(surface, point);
  for (std::size_t guess = 0; guess < surface.triangles.size(); ++guess)
    EXPECT_DOUBLE_EQ((tree.nearest(point, guess).place - point).norm(), distance);
}

TEST(NearestSurface, TrianglesOfAllSizesTogether) {
  Dice dice;
  const TriangleSurface surface = test::joined(soup(dice, 20, -1, 1, 1), soup(dice, 400, -0.05, 0.05, 1e-4));
  const NearestSurface tree(surface);
  for (int n = 0; n < 200; ++n)
    expect_nearest(surface, tree, dice.point(-0.1, 0.1), dice.below(surface.triangles.size()));
  for (int n = 0; n < 100; ++n) expect_nearest(surface, tree, dice.point(-30, 30), 0);
}

/// A scanner's coordinates may lie metres from their origin: floats of them would be off by more than the answer.
TEST(NearestSurface, FarFromTheOrigin) {
  Dice dice;
  const TriangleSurface surface = soup(dice, 300, 5000, 5000.1, 0.01);
  const NearestSurface tree(surface);
  for (int n = 0; n < 200; ++n) expect_nearest(surface, tree, dice.point(5000, 5000.1), 0);
}

TEST(NearestSurface, PointsOnTheSurfaceLieOnIt) {
  const TriangleSurface surface = test::sphere(Vec3::Zero(), 0.05, 3);
  const NearestSurface tree(surface);
  for (const Vec3& vertex : surface.vertices) EXPECT_EQ(tree.nearest(vertex).place, vertex);
}

TEST(NearestSurface, TrianglesWithoutAreaCountAsTheirEdges) {
  TriangleSurface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 5, 0}};
  surface.triangles = {{0, 1, 2}, {3, 3, 3}};
  const NearestSurface tree(surface);
  EXPECT_EQ(tree.nearest({2, 1, 0}).place, Vec3(2, 0, 0));
  EXPECT_EQ(tree.nearest({-1, -1, 0}).place, Vec3(0, 0, 0));
  EXPECT_EQ(tree.nearest({9, 0, 1}).place, Vec3(3, 0, 0));
  EXPECT_EQ(tree.nearest({0, 6, 0}).triangle, 1U);
}

TEST(NearestSurface, WantsATriangle) { EXPECT_THROW(NearestSurface(TriangleSurface{}), std::invalid_argument); }

}  // namespace
}  // namespace trocar::nearest_surface_test
