#include "tissue/imaging/phantom/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trocar::phantom::shapes_test {
namespace {

Vec random_point(std::mt19937_64& engine, double reach) {
  std::uniform_real_distribution<double> even(-reach, reach);
  return {even(engine), even(engine), even(engine)};
}

TEST(PhantomShapes, EllipsoidIsExactOnItsAxesAndABallEverywhere) {
  const Vec centre(1, 2, 3), radii(10, 20, 5);
  EXPECT_NEAR(ellipsoid(centre + Vec(14, 0, 0), centre, radii), 4, 1e-12);
  EXPECT_NEAR(ellipsoid(centre + Vec(0, -25, 0), centre, radii), 5, 1e-12);
  EXPECT_NEAR(ellipsoid(centre + Vec(0, 0, 4), centre, radii), -1, 1e-12);
  EXPECT_NEAR(ellipsoid(centre, centre, radii), -5, 1e-12);
  std::mt19937_64 engine(1);
  for (int n = 0; n < 100; ++n) {
    const Vec p = random_point(engine, 20);
    EXPECT_NEAR(ellipsoid(p, Vec::Zero(), Vec::Constant(7)), p.norm() - 7, 1e-9);
  }
}

TEST(PhantomShapes, ASweptBallIsACapsuleWithATaper) {
  const Vec a(0, 0, 0), b(10, 0, 0);
  EXPECT_DOUBLE_EQ(swept_ball(Vec(-3, 0, 0), a, 1, b, 2), 2);
  EXPECT_DOUBLE_EQ(swept_ball(Vec(5, 4, 0), a, 1, b, 2), 2.5);
  EXPECT_DOUBLE_EQ(swept_ball(Vec(13, 4, 0), a, 1, b, 2), 3);
}

TEST(PhantomShapes, TriangleDistanceAgreesWithADenseCloudOfItsPoints) {
  const Vec a(0, 0, 0), b(10, 1, 0), c(3, 8, 4);
  std::mt19937_64 engine(2);
  for (int n = 0; n < 60; ++n) {
    const Vec p = random_point(engine, 15);
    double nearest = 1e9;
    for (int u = 0; u <= 100; ++u)
      for (int v = 0; u + v <= 100; ++v)
        nearest = std::min(nearest, (p - (a + (b - a) * u / 100.0 + (c - a) * v / 100.0)).norm());
    EXPECT_NEAR(triangle_distance(p, a, b, c), nearest, 0.1);
    EXPECT_LE(triangle_distance(p, a, b, c), nearest + 1e-9);
  }
}

TEST(PhantomShapes, JoiningAddsAFilletAndCuttingTakesOneAway) {
  EXPECT_DOUBLE_EQ(joined(1, 20, 5), 1);  // far apart: the plain union
  EXPECT_DOUBLE_EQ(joined(2, 2, 4), 1);   // on the seam: a quarter of the width
  EXPECT_DOUBLE_EQ(common(2, 2, 4), 3);
  EXPECT_DOUBLE_EQ(without(-3, -20, 4), 20);  // deep in what is cut away
  for (double a = -5; a <= 5; a += 0.5)
    for (double b = -5; b <= 5; b += 0.5) {
      EXPECT_LE(joined(a, b, 3), std::min(a, b));
      EXPECT_GE(common(a, b, 3), std::max(a, b));
    }
}

TEST(PhantomShapes, ATubeThroughKnotsOnALineIsACapsule) {
  const Tube tube({{Vec(0, 0, 0), 2}, {Vec(10, 0, 0), 2}, {Vec(20, 0, 0), 2}});
  EXPECT_NEAR(tube.distance(Vec(7, 5, 0)), 3, 1e-9);
  EXPECT_NEAR(tube.distance(Vec(24, 0, 0)), 2, 1e-9);
  EXPECT_TRUE(tube.box().isApprox(Box(Vec(-2, -2, -2), Vec(22, 2, 2)), 1e-9));
}

TEST(PhantomShapes, ATubeGoesThroughItsKnotsWithoutCorners) {
  const std::vector<Knot> knots{{Vec(0, 0, 0), 3}, {Vec(10, 5, 0), 4}, {Vec(12, 18, 3), 2}, {Vec(0, 30, 10), 1}};
  const Tube tube(knots);
  for (const Knot& knot : knots) EXPECT_NEAR(tube.distance(knot.at), -knot.radius, 0.02);
  const auto& course = tube.course();
  for (std::size_t n = 1; n + 1 < course.size(); ++n) {
    const Vec before = (course[n].at - course[n - 1].at).normalized(),
              after = (course[n + 1].at - course[n].at).normalized();
    EXPECT_GT(before.dot(after), std::cos(0.35)) << n;
    EXPECT_LT((course[n].at - course[n - 1].at).norm(), 1.6);
  }
}

TEST(PhantomShapes, ReachOnlyCutsOffWhatIsFarther) {
  const Tube tube({{Vec(0, 0, 0), 3}, {Vec(30, 10, 0), 4}, {Vec(40, 50, 10), 2}, {Vec(-20, 60, 30), 5}});
  std::mt19937_64 engine(3);
  for (int n = 0; n < 500; ++n) {
    const Vec p = random_point(engine, 70);
    double nearest = 1e9;
    for (std::size_t m = 0; m + 1 < tube.course().size(); ++m)
      nearest = std::min(nearest, swept_ball(p, tube.course()[m].at, tube.course()[m].radius, tube.course()[m + 1].at,
                                             tube.course()[m + 1].radius));
    EXPECT_DOUBLE_EQ(tube.distance(p), nearest);
    EXPECT_DOUBLE_EQ(tube.distance(p, 4), std::min(nearest, 4.0));
  }
}

TEST(PhantomShapes, RippleWavesTheRadiusRoundItsMean) {
  Tube tube({{Vec(0, 0, 0), 10}, {Vec(100, 0, 0), 10}});
  tube.ripple(0.1, 25);
  EXPECT_NEAR(tube.distance(Vec(31.25, 20, 0)), 9, 0.05);   // crest: a quarter wave after the first whole one
  EXPECT_NEAR(tube.distance(Vec(43.75, 20, 0)), 11, 0.15);  // trough
}

}  // namespace
}  // namespace trocar::phantom::shapes_test
