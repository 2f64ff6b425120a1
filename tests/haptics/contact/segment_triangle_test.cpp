// Segment and triangle: brute-force sampling as the oracle, degenerate shapes, independence of the unit of length.
#include <gtest/gtest.h>

#include "haptics/contact/segment_triangle.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::segment_triangle_test {
namespace {

using test::Random;
using Triangle = std::array<Vec3, 3>;

Triangle random_triangle(Random& random, double half) {
  const Vec3 a = random.vector(half), b = random.vector(half);
  return {a, b, random.vector(half)};
}

Vec3 point_in(const Triangle& t, double u, double v) { return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]); }

/// Least distance over a grid on segment and triangle, then refined by halving steps: an upper bound of the distance
/// that converges, because squared distance is convex over the convex domain.
double sampled_distance(const Vec3& a, const Vec3& b, const Triangle& t) {
  double s = 0.5, u = 1.0 / 3, v = 1.0 / 3;
  const auto at = [&](double s_, double u_, double v_) { return (a + s_ * (b - a) - point_in(t, u_, v_)).norm(); };
  double best = at(s, u, v);
  for (double step = 0.5; step > 1e-9;) {
    double next = best, s1 = s, u1 = u, v1 = v;
    for (int i = 0; i < 27; ++i) {
      const double s2 = std::clamp(s + step * (i % 3 - 1), 0.0, 1.0);
      double u2 = std::max(0.0, u + step * (i / 3 % 3 - 1)), v2 = std::max(0.0, v + step * (i / 9 - 1));
      if (u2 + v2 > 1) {
        const double over = u2 + v2;
        u2 /= over;
        v2 /= over;
      }
      if (at(s2, u2, v2) < next) {
        next = at(s2, u2, v2);
        s1 = s2, u1 = u2, v1 = v2;
      }
    }
    if (next < best - 1e-15) {
      best = next, s = s1, u = u1, v = v1;
    } else {
      step *= 0.7;
    }
  }
  return best;
}

/// Least distance over a plain grid: never below the truth, above it by at most the mesh of the grid.
double grid_distance(const Vec3& a, const Vec3& b, const Triangle& t, int n) {
  double best = 1e9;
  for (int i = 0; i <= n; ++i) {
    const Vec3 p = a + (b - a) * (double(i) / n);
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k + j <= n; ++k)
        best = std::min(best, (p - point_in(t, double(j) / n, double(k) / n)).squaredNorm());
    }
  }
  return std::sqrt(best);
}

TEST(SegmentTriangle, NoSampleIsNearerThanTheAnswerAndSomeSampleIsAsNear) {
  Random random(1);
  constexpr int n = 24;
  for (int k = 0; k < 300; ++k) {
    const Triangle t = random_triangle(random, 1);
    const Vec3 a = random.vector(1), b = random.vector(1);
    const double exact = closest_segment_triangle(a, b, t).distance, grid = grid_distance(a, b, t, n);
    const double mesh = ((b - a).norm() + (t[1] - t[0]).norm() + (t[2] - t[0]).norm()) / n;
    EXPECT_LE(exact, grid + 1e-12);
    EXPECT_GE(exact, grid - mesh);
  }
}

TEST(SegmentTriangle, RefinedSearchNeverGetsBelowTheAnswer) {
  Random random(2);
  int converged = 0;
  for (int k = 0; k < 2000; ++k) {
    const Triangle t = random_triangle(random, 1);
    const Vec3 a = random.vector(1), b = random.vector(1);
    const double exact = closest_segment_triangle(a, b, t).distance, found = sampled_distance(a, b, t);
    EXPECT_LE(exact, found + 1e-12);
    converged += found - exact < 1e-6;
  }
  EXPECT_GT(converged, 1200) << "a coordinate search stalls on oblique valleys, but mostly it arrives";
}

TEST(SegmentTriangle, AnswersAreConsistentWithThemselves) {
  Random random(3);
  for (int k = 0; k < 5000; ++k) {
    const Triangle t = random_triangle(random, 1);
    const Vec3 a = random.vector(1), b = random.vector(1);
    const ClosestPair pair = closest_segment_triangle(a, b, t);
    EXPECT_LT((pair.on_segment - (a + pair.along * (b - a))).norm(), 1e-14);
    EXPECT_LT((closest_point_on_triangle(pair.on_triangle, t) - pair.on_triangle).norm(), 1e-12)
        << "lies on the triangle";
    EXPECT_NEAR((pair.on_segment - pair.on_triangle).norm(), pair.distance, 1e-14);
    EXPECT_NEAR(closest_segment_triangle(b, a, t).distance, pair.distance, 1e-12) << "ends exchanged";
    EXPECT_NEAR(closest_segment_triangle(a, b, {t[1], t[2], t[0]}).distance, pair.distance, 1e-12) << "corners turned";
    EXPECT_NEAR(closest_segment_triangle(a, b, {t[1], t[0], t[2]}).distance, pair.distance, 1e-12) << "turned over";
    EXPECT_EQ(pair.crossing, closest_segment_triangle(b, a, t).crossing);
    EXPECT_TRUE(!pair.crossing || pair.distance == 0);
  }
}

TEST(SegmentTriangle, ThePointOnTheTriangleIsOptimal) {
  // Oracle: at the nearest point no direction into the triangle shortens the distance (first-order condition).
  Random random(4);
  for (int k = 0; k < 5000; ++k) {
    const Triangle t = random_triangle(random, 1);
    const Vec3 p = random.vector(2), foot = closest_point_on_triangle(p, t);
    for (const Vec3& corner : t) EXPECT_LE((p - foot).dot(corner - foot), 1e-12);
  }
}

TEST(SegmentTriangle, KnownCases) {
  const Triangle t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_TRUE(closest_segment_triangle({0.2, 0.2, 1}, {0.2, 0.2, -1}, t).crossing);
  EXPECT_NEAR(closest_segment_triangle({0.2, 0.2, 1}, {0.2, 0.2, -1}, t).along, 0.5, 1e-15);
  EXPECT_NEAR(closest_segment_triangle({0.2, 0.2, 1}, {0.2, 0.2, 0.3}, t).distance, 0.3, 1e-15);
  EXPECT_NEAR(closest_segment_triangle({-1, 0.5, 0.4}, {3, 0.5, 0.4}, t).distance, 0.4, 1e-15);  // parallel above
  EXPECT_NEAR(closest_segment_triangle({2, -1, 0}, {2, 3, 0}, t).distance, 1, 1e-15);            // in its plane, beside
  EXPECT_NEAR(closest_segment_triangle({-1, -1, 0.5}, {1, -1, 0.5}, t).distance, std::sqrt(1.25),
              1e-15);                                                                     // edge to edge
  EXPECT_NEAR(closest_segment_triangle({-3, -4, 0}, {-6, -8, 0}, t).distance, 5, 1e-15);  // corner
  EXPECT_LT(closest_segment_triangle({-1, 0.2, 0}, {2, 0.2, 0}, t).distance, 1e-15);      // in its plane, through
}

TEST(SegmentTriangle, DegenerateShapesGiveTheDistanceOfWhatIsLeft) {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const Vec3 a = random.vector(1), b = random.vector(1), p = random.vector(1), d = random.vector(1);
    const double line = closest_segment_triangle(a, b, {p, p, p}).distance;
    const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    EXPECT_NEAR(line, (p - a - s * (b - a)).norm(), 1e-12) << "triangle shrunk to a point";
    // Triangle shrunk to a line: the same as segment against segment, sampled.
    const double needle = closest_segment_triangle(a, b, {p, Vec3(p + d), Vec3(p + 0.3 * d)}).distance;
    double best = 1e9;
    for (int i = 0; i <= 400; ++i) {
      const Vec3 q = p + d * (i / 400.0);
      const double u = std::clamp((q - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      best = std::min(best, (q - a - u * (b - a)).norm());
    }
    EXPECT_LE(needle, best + 1e-9);
    EXPECT_GE(needle, best - d.norm() / 400);
    // Segment shrunk to a point.
    const Triangle t = random_triangle(random, 1);
    EXPECT_NEAR(closest_segment_triangle(a, a, t).distance, (a - closest_point_on_triangle(a, t)).norm(), 1e-12);
  }
}

TEST(SegmentTriangle, MetresAndMillimetresAgree) {
  Random random(6);
  for (int k = 0; k < 3000; ++k) {
    // Shapes of a few millimetres, as on an organ, in metres and a thousand times larger.
    const Triangle t = random_triangle(random, 0.003);
    const Vec3 a = random.vector(0.003), b = random.vector(0.003);
    const ClosestPair metres = closest_segment_triangle(a, b, t);
    const ClosestPair large = closest_segment_triangle(a * 1000, b * 1000, {t[0] * 1000, t[1] * 1000, t[2] * 1000});
    EXPECT_EQ(metres.crossing, large.crossing);
    EXPECT_NEAR(metres.distance * 1000, large.distance, 1e-12);
    EXPECT_NEAR(metres.along, large.along, 1e-9);
  }
}

TEST(SegmentTriangle, LongShaftAgainstTinyTriangleKeepsSevenDigits) {
  // Requirement: 1e-7 m against brute force. A 0.3 m shaft, millimetre triangles, an exact answer by construction.
  Random random(7);
  for (int k = 0; k < 2000; ++k) {
    const Mat3 R = random.rotation();
    const Vec3 p = random.vector(0.1);
    const double gap = random.between(1e-5, 0.02), size = random.between(1e-4, 3e-3);
    // Triangle in the plane z = 0 with a corner towards the shaft, which passes above it along x at height gap.
    const Triangle t{Vec3(0, 0, 0), Vec3(size, -size, -0.5 * size), Vec3(-size, -size, -0.5 * size)};
    const Vec3 a(-random.between(0.01, 0.29), 0, gap), b = a + Vec3(0.3, 0, 0);
    const ClosestPair pair = closest_segment_triangle(R * a + p, R * b + p, {R * t[0] + p, R * t[1] + p, R * t[2] + p});
    EXPECT_NEAR(pair.distance, gap, 1e-14);
    EXPECT_LT((pair.on_triangle - (R * t[0] + p)).norm(), 1e-12);
  }
}

TEST(SegmentTriangle, TheShortWayRoundATriangleAheadOfAnEndGivesTheSameAsTheLongOne) {
  // A segment presses with an end on small triangles all round it. Turned about, or with the triangle a little behind
  // the end, the answer comes by the general way.
  Random random(8);
  int ahead = 0;
  for (int k = 0; k < 20000; ++k) {
    const double size = std::pow(10, -random.between(2, 4.5));
    const Vec3 a = random.vector(0.1), b = a + random.direction() * (k % 7 == 0 ? 0.02 : 0.3);
    const Vec3 centre = a + random.direction() * random.between(1e-6, 5e-3);
    Triangle t{centre + random.vector(size), centre + random.vector(size), centre + random.vector(size)};
    if (k % 11 == 0) t[2] = t[k % 2];
    const ClosestPair pair = closest_segment_triangle(a, b, t), turned = closest_segment_triangle(b, a, t);
    EXPECT_NEAR(pair.distance, turned.distance, 1e-15);
    EXPECT_NEAR(pair.along, 1 - turned.along, 1e-9) << "beside an edge nearly parallel to it the place is not sharp";
    const bool all_ahead = (t[0] - a).dot(b - a) < 0 && (t[1] - a).dot(b - a) < 0 && (t[2] - a).dot(b - a) < 0;
    if (!all_ahead) continue;
    ++ahead;
    EXPECT_EQ(pair.along, 0);
    EXPECT_EQ(pair.on_segment, a);
    EXPECT_FALSE(pair.crossing);
    EXPECT_NEAR(pair.distance, (a - closest_point_on_triangle(a, t)).norm(), 1e-16 + 1e-15 * pair.distance);
  }
  EXPECT_GT(ahead, 5000);
}

}  // namespace
}  // namespace trocar::segment_triangle_test
