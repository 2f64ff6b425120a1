// What holds for the phantom's shapes at every point: symmetries, closed forms, and the shortcuts against the long way.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tissue/imaging/phantom/shapes.h"

namespace trocar::phantom::shape_laws_test {
namespace {

class ShapeLaws : public ::testing::Test {
 protected:
  Vec point(double reach) { return {even(-reach, reach), even(-reach, reach), even(-reach, reach)}; }
  double even(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Eigen::Matrix3d turn() { return Eigen::AngleAxisd(even(0.1, 3), point(1).normalized()).toRotationMatrix(); }

  std::mt19937_64 engine_{20};
};

/// The nearest of many balls between two neighbours of a course: slow, and without any shortcut.
double distance_the_long_way(const std::vector<Knot>& course, const Vec& p) {
  double nearest = 1e9;
  for (std::size_t n = 0; n + 1 < course.size(); ++n)
    nearest = std::min(nearest, swept_ball(p, course[n].at, course[n].radius, course[n + 1].at, course[n + 1].radius));
  return nearest;
}

double course_length(const Tube& tube) {
  double length = 0;
  for (std::size_t n = 1; n < tube.course().size(); ++n)
    length += (tube.course()[n].at - tube.course()[n - 1].at).norm();
  return length;
}

const std::vector<Knot> kBent{{Vec(0, 0, 0), 3}, {Vec(18, 6, -4), 4}, {Vec(30, -8, 5), 2}, {Vec(44, 3, 14), 2.5}};

TEST_F(ShapeLaws, EllipsoidSeparatesInsideFromOutsideAsItsEquationDoes) {
  for (int n = 0; n < 500; ++n) {
    const Vec centre = point(5), radii(even(2, 20), even(2, 20), even(2, 20)), p = point(30);
    const double equation = (p - centre).cwiseQuotient(radii).squaredNorm() - 1;
    EXPECT_EQ(ellipsoid(p, centre, radii) < 0, equation < 0) << p.transpose();
  }
}

TEST_F(ShapeLaws, EllipsoidScalesMovesAndMirrorsWithItsNumbers) {
  for (int n = 0; n < 200; ++n) {
    const Vec centre = point(5), radii(even(2, 20), even(2, 20), even(2, 20)), p = point(30), move = point(100);
    const double d = ellipsoid(p, centre, radii), scale = even(0.2, 5);
    EXPECT_NEAR(ellipsoid(p + move, centre + move, radii), d, 1e-9);
    EXPECT_NEAR(ellipsoid(scale * p, scale * centre, scale * radii), scale * d, 1e-9);
    EXPECT_NEAR(ellipsoid(2 * centre - p, centre, radii), d, 1e-9);
    const auto turned = [](const Vec& v) { return Vec(v.y(), v.z(), v.x()); };
    EXPECT_NEAR(ellipsoid(turned(p), turned(centre), turned(radii)), d, 1e-9);
  }
}

TEST_F(ShapeLaws, EllipsoidDistanceIsRightToFirstOrderAtItsSurface) {
  const Vec radii(12, 30, 7);
  for (int n = 0; n < 300; ++n) {
    const Vec on = point(1).normalized().cwiseProduct(radii);
    const Vec normal = on.cwiseQuotient(radii.cwiseProduct(radii)).normalized();
    EXPECT_NEAR(ellipsoid(on, Vec::Zero(), radii), 0, 1e-9);
    for (const double step : {-0.01, 0.01}) EXPECT_NEAR(ellipsoid(on + step * normal, Vec::Zero(), radii), step, 1e-3);
  }
}

TEST_F(ShapeLaws, PillarAndColumnAreTheSameFromHeadToFoot) {
  for (int n = 0; n < 200; ++n) {
    const Vec p = point(40), lifted = p + Vec(0, 0, even(-900, 900));
    EXPECT_EQ(column(p, 3, -4, 9), column(lifted, 3, -4, 9));
    EXPECT_EQ(pillar(p, 3, -4, 9, 15), pillar(lifted, 3, -4, 9, 15));
    EXPECT_NEAR(pillar(p, 3, -4, 9, 9), column(p, 3, -4, 9), 1e-9);
    EXPECT_NEAR(column(p, 3, -4, 9) - column(p, 3, -4, 11), 2, 1e-12);
    EXPECT_EQ(pillar(p, 3, -4, 9, 15) < 0, std::hypot((p.x() - 3) / 9, (p.y() + 4) / 15) < 1);
  }
}

TEST_F(ShapeLaws, ASweptBallHasNoDirection) {
  for (int n = 0; n < 300; ++n) {
    const Vec a = point(20), b = point(20), p = point(40), move = point(90);
    const double ra = even(0, 6), rb = even(0, 6), d = swept_ball(p, a, ra, b, rb);
    EXPECT_NEAR(swept_ball(p, b, rb, a, ra), d, 1e-9);
    EXPECT_NEAR(swept_ball(p + move, a + move, ra, b + move, rb), d, 1e-9);
    const Eigen::Matrix3d turned = turn();
    EXPECT_NEAR(swept_ball(turned * p, turned * a, ra, turned * b, rb), d, 1e-9);
    EXPECT_NEAR(swept_ball(p, a, ra + 1.5, b, rb + 1.5), d - 1.5, 1e-9);
    EXPECT_LE(swept_ball(p, a, ra, b, ra), std::min((p - a).norm(), (p - b).norm()) - ra + 1e-9);
  }
}

TEST_F(ShapeLaws, TriangleDistanceForgetsTheOrderOfItsCornersAndTurnsWithThem) {
  for (int n = 0; n < 200; ++n) {
    const Vec a = point(20), b = point(20), c = point(20), p = point(30), move = point(80);
    const double d = triangle_distance(p, a, b, c);
    std::array<Vec, 3> corner{a, b, c};
    std::array<std::size_t, 3> order{0, 1, 2};
    do EXPECT_NEAR(triangle_distance(p, corner[order[0]], corner[order[1]], corner[order[2]]), d, 1e-9);
    while (std::next_permutation(order.begin(), order.end()));
    const Eigen::Matrix3d turned = turn();
    EXPECT_NEAR(triangle_distance(turned * p + move, turned * a + move, turned * b + move, turned * c + move), d, 1e-8);
    EXPECT_LE(d, std::min({(p - a).norm(), (p - b).norm(), (p - c).norm()}) + 1e-9);
    EXPECT_GE(d, std::abs((b - a).cross(c - a).normalized().dot(p - a)) - 1e-9);
  }
}

TEST_F(ShapeLaws, TriangleDistanceIsNothingOnTheTriangleAndTheHeightAboveIt) {
  for (int n = 0; n < 200; ++n) {
    const Vec a = point(20), b = point(20), c = point(20);
    const double u = even(0.05, 0.45), v = even(0.05, 0.45), height = even(-15, 15);
    const Vec on = a + u * (b - a) + v * (c - a), normal = (b - a).cross(c - a).normalized();
    EXPECT_NEAR(triangle_distance(on, a, b, c), 0, 1e-9);
    EXPECT_NEAR(triangle_distance(on + height * normal, a, b, c), std::abs(height), 1e-9);
  }
}

TEST_F(ShapeLaws, JoiningKeepsBothShapesAndAddsAtMostAQuarterOfTheWidth) {
  for (int n = 0; n < 1000; ++n) {
    const double a = even(-20, 20), b = even(-20, 20), width = even(0.5, 15), both = joined(a, b, width);
    EXPECT_EQ(both, joined(b, a, width));
    EXPECT_LE(both, std::min(a, b));
    EXPECT_GE(both, std::min(a, b) - width / 4 - 1e-12);
    EXPECT_TRUE(std::abs(a - b) < width || both == std::min(a, b)) << a << " " << b << " " << width;
    EXPECT_LE(both, joined(a + 0.7, b, width) + 1e-12);  // moving away from a shape never brings one closer
    EXPECT_NEAR(joined(a + 3, b + 3, width), both + 3, 1e-9);
    EXPECT_NEAR(joined(2 * a, 2 * b, 2 * width), 2 * both, 1e-9);
  }
}

TEST_F(ShapeLaws, WhatIsInBothOrLeftOverFollowsFromTheUnion) {
  for (int n = 0; n < 500; ++n) {
    const double a = even(-20, 20), b = even(-20, 20), width = even(0.5, 15);
    EXPECT_EQ(common(a, b, width), -joined(-a, -b, width));
    EXPECT_EQ(common(a, b, width), common(b, a, width));
    EXPECT_EQ(without(a, b, width), common(a, -b, width));
    EXPECT_GE(without(a, b, width), a);   // cutting never adds
    EXPECT_GE(without(a, b, width), -b);  // nor leaves what is cut away
    EXPECT_NEAR(joined(a, b, width) + common(a, b, width), a + b, 1e-9);
  }
}

TEST_F(ShapeLaws, ATubesShortcutsAgreeWithAskingEveryStep) {
  Tube tube(kBent);
  for (const bool rippled : {false, true}) {
    if (rippled) tube.ripple(0.25, 7);
    for (int n = 0; n < 400; ++n) {
      const Vec p = Vec(22, 0, 4) + point(35);
      EXPECT_NEAR(tube.distance(p), distance_the_long_way(tube.course(), p), 1e-9) << p.transpose();
    }
  }
}

TEST_F(ShapeLaws, ATubeGoesTheSameWayBack) {
  const Tube there(kBent), back(std::vector<Knot>(kBent.rbegin(), kBent.rend()));
  EXPECT_EQ(there.course().size(), back.course().size());
  EXPECT_NEAR(course_length(there), course_length(back), 1e-9);
  for (int n = 0; n < 200; ++n) {
    const Vec p = Vec(22, 0, 4) + point(35);
    EXPECT_NEAR(there.distance(p), back.distance(p), 1e-9);
  }
}

TEST_F(ShapeLaws, ATubeMovesAndTurnsWithItsKnots) {
  const Tube tube(kBent);
  const Eigen::Matrix3d turned = turn();
  const Vec move = point(60);
  std::vector<Knot> knots = kBent;
  for (Knot& knot : knots) knot.at = turned * knot.at + move;
  const Tube other(knots);
  EXPECT_NEAR(course_length(other), course_length(tube), 1e-9);
  for (int n = 0; n < 200; ++n) {
    const Vec p = Vec(22, 0, 4) + point(35);
    EXPECT_NEAR(other.distance(turned * p + move), tube.distance(p), 1e-9);
  }
}

TEST_F(ShapeLaws, ATubeIsSampledInStepsOfAboutAMillimetreFromEndToEnd) {
  const Tube tube(kBent);
  const auto& course = tube.course();
  EXPECT_EQ(course.front().at, kBent.front().at);
  EXPECT_EQ(course.back().at, kBent.back().at);
  EXPECT_EQ(course.back().radius, kBent.back().radius);
  double straight = 0;
  for (std::size_t n = 1; n < kBent.size(); ++n) straight += (kBent[n].at - kBent[n - 1].at).norm();
  EXPECT_GE(course_length(tube), straight - 0.05);
  EXPECT_LT(course_length(tube), 1.25 * straight);
  for (std::size_t n = 1; n < course.size(); ++n) {
    EXPECT_LT((course[n].at - course[n - 1].at).norm(), 1.6);
    EXPECT_GT((course[n].at - course[n - 1].at).norm(), 0.3);
    EXPECT_GE(course[n].radius, 2);
    EXPECT_LE(course[n].radius, 4);
  }
}

TEST_F(ShapeLaws, ATubesBoxHoldsItAndTouchesIt) {
  Tube tube(kBent);
  tube.ripple(0.2, 9);
  const Box box = tube.box();
  for (int n = 0; n < 3000; ++n) {
    const Vec p = Vec(22, 0, 4) + point(35);
    EXPECT_TRUE(tube.distance(p) >= 0 || box.contains(p)) << p.transpose();
  }
  for (const Knot& knot : tube.course())
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(knot.at[axis] - knot.radius, box.min()[axis] - 1e-12);
      EXPECT_LE(knot.at[axis] + knot.radius, box.max()[axis] + 1e-12);
    }
}

TEST_F(ShapeLaws, ABoxThatATubeMissesHoldsNoneOfIt) {
  const Tube tube(kBent);
  int missed = 0, hit = 0;
  for (int n = 0; n < 400; ++n) {
    const Vec low = Vec(22, 0, 4) + point(30), size(even(0.5, 12), even(0.5, 12), even(0.5, 12));
    const bool misses = tube.misses(Box(low, low + size));
    (misses ? missed : hit) += 1;
    bool inside = false;
    for (int s = 0; s < 40; ++s) {
      const Vec share(even(0, 1), even(0, 1), even(0, 1));
      inside = inside || tube.distance(low + share.cwiseProduct(size)) < 0;
    }
    EXPECT_FALSE(misses && inside) << low.transpose();
  }
  EXPECT_GT(missed, 50);
  EXPECT_GT(hit, 20);
  for (const Knot& knot : tube.course()) EXPECT_FALSE(tube.misses(Box(knot.at, knot.at)));
  EXPECT_TRUE(tube.misses(Box(Vec(0, 40, 0), Vec(9, 60, 9))));
}

TEST_F(ShapeLaws, ReachIsTheMostThatATubeAnswers) {
  const Tube tube(kBent);
  for (int n = 0; n < 400; ++n) {
    const Vec p = Vec(22, 0, 4) + point(40);
    const double reach = even(0.1, 30);
    EXPECT_NEAR(tube.distance(p, reach), std::min(reach, tube.distance(p)), 1e-9);
  }
}

TEST_F(ShapeLaws, ARippleLeavesTheCourseAndItsStart) {
  const Tube smooth(kBent);
  Tube waved(kBent);
  waved.ripple(0.3, 6);
  ASSERT_EQ(waved.course().size(), smooth.course().size());
  EXPECT_EQ(waved.course().front().radius, smooth.course().front().radius);
  double most = 0;
  for (std::size_t n = 0; n < waved.course().size(); ++n) {
    EXPECT_EQ(waved.course()[n].at, smooth.course()[n].at);
    const double share = waved.course()[n].radius / smooth.course()[n].radius - 1;
    EXPECT_LE(std::abs(share), 0.3 + 1e-12);
    most = std::max(most, std::abs(share));
  }
  EXPECT_GT(most, 0.25);
  Tube still(kBent);
  still.ripple(0, 6);
  for (std::size_t n = 0; n < still.course().size(); ++n)
    EXPECT_EQ(still.course()[n].radius, smooth.course()[n].radius);
}

}  // namespace
}  // namespace trocar::phantom::shape_laws_test
