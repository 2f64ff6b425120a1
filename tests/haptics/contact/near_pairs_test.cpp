// The pairs of capsule and triangle that the tick looks at, against all pairs of the patch: none that touches is
// missing, and what is looked at stays few however the tool moves.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "haptics/contact/contact_renderer.h"
#include "haptics/contact/near_pairs.h"
#include "haptics/contact/segment_triangle.h"
#include "tests/haptics/contact/surfaces.h"

namespace trocar::near_pairs_test {
namespace {

using test::Random;

constexpr double kSlack = 5e-5;

CapsuleAxes axes_of(const ToolCapsules& tool, const Mat3& R) {
  CapsuleAxes axes;
  for (int c = 0; c < tool.count; ++c) {
    const Capsule& capsule = tool.at[std::size_t(c)];
    axes[std::size_t(c)].front = R * capsule.X_IC.p;
    axes[std::size_t(c)].back = axes[std::size_t(c)].front - R * (capsule.X_IC.R.col(2) * capsule.length_m);
  }
  return axes;
}

/// Triangles of all sizes from 0.1 to 30 mm, some of them points and needles.
void fill_with_soup(Random& random, ContactPatch& patch) {
  patch.clear();
  while (patch.count < kMaxPatchTriangles) {
    const double size = std::pow(10, random.between(-4, -1.5));
    const Vec3 a = random.vector(0.04), b = a + random.vector(size);
    test::add_triangle(patch, a, b, random.below(10) == 0 ? b : Vec3(a + random.vector(size)));
  }
}

/// A tool on its way among the triangles, as the contact renderer follows it.
struct Walk {
  explicit Walk(std::uint64_t seed) : random(seed) {}

  void use(const ToolShape& shape, double opening_m, const HeldObject& held) {
    tool = tool_capsules(shape, opening_m, held);
    axes = axes_of(tool, R);
  }
  void go(double way_m, double angle_rad) {
    const Vec3 step = random.direction() * way_m;
    tip += step;
    near.travel(way_m);
    R = Eigen::AngleAxisd(angle_rad, random.direction()).toRotationMatrix() * R;
    const CapsuleAxes next = axes_of(tool, R);
    near.turn(axes, next, 1);
    axes = next;
    if ((tip - home).norm() > 2 * spread_m) jump();
  }
  void jump() {
    tip = home + random.vector(spread_m);
    R = random.rotation();
    axes = axes_of(tool, R);
    near.forget();
  }
  double gap(const ContactPatch& patch, int i, int c) const {
    const CapsuleAxis& axis = axes[std::size_t(c)];
    return closest_segment_triangle(tip + axis.front, tip + axis.back, patch.corners(i)).distance -
           tool.at[std::size_t(c)].radius_m;
  }
  void keep_up(const ContactPatch& patch) { near.keep_up({tool, axes, tip}, patch, kSlack); }

  Random random;
  Vec3 home = Vec3::Zero();  ///< where it begins again and again
  double spread_m = 0.02;
  ToolCapsules tool;
  Vec3 tip = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  CapsuleAxes axes;
  NearPairs near;
};

/// Every pair that brute force finds within the slack is listed, in order, and due; what is due is then measured.
/// @return how many
int expect_none_missing(Walk& walk, const ContactPatch& patch) {
  int touching = 0, n = 0;
  for (int i = 0; i < patch.count; ++i) {
    for (int c = 0; c < walk.tool.count; ++c) {
      const double gap = walk.gap(patch, i, c);
      const bool listed = n < walk.near.count() && walk.near.at(n).index == i && walk.near.at(n).capsule == c;
      const bool due = listed && walk.near.due(walk.near.at(n), kSlack);
      if (gap <= kSlack) {
        EXPECT_TRUE(due) << "triangle " << i << " capsule " << c << " gap " << gap << " listed " << listed;
        ++touching;
      }
      if (due) walk.near.measured(n, gap);
      n += listed;
    }
  }
  EXPECT_EQ(n, walk.near.count()) << "nothing else is listed";
  return touching;
}

void walk_among(Walk& walk, ContactPatch& patch, int ticks, bool with_balls) {
  int touching = 0;
  const HeldObject none{}, held{{0.01, 0, 0.012}, {-0.01, 0, 0.012}, 0.003};
  for (int k = 0; k < ticks; ++k) {
    if (k % 40 == 0) {
      const ToolShape grasper{.jaw_length_m = k % 80 == 0 ? 0.020 : 0.0};
      walk.use(grasper, walk.random.between(0, 0.02), k % 3 == 0 ? held : none);
      walk.jump();
      ++patch.stamp;
      if (with_balls) enclose(patch, patch.balls);
    }
    const double speed = std::pow(10, walk.random.between(-3, 0));  // 1 mm/s to 1 m/s
    const int kind = walk.random.below(3);                          // it goes, turns or does both
    walk.go(kind == 0 ? 0 : speed * 1e-3, kind == 1 ? 0 : speed * walk.random.between(0, 0.01));
    walk.keep_up(patch);
    touching += expect_none_missing(walk, patch);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(touching, ticks / 4) << "too little was met to prove anything";
}

class NearPairsTest : public ::testing::Test {
 protected:
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
};

TEST_F(NearPairsTest, NoTouchingPairOfASoupIsMissedAtAnySpeed) {
  for (const bool with_balls : {true, false}) {
    Walk walk(1);
    for (int soup = 0; soup < 4; ++soup) {
      fill_with_soup(walk.random, *patch);
      walk_among(walk, *patch, 240, with_balls);
    }
  }
}

TEST_F(NearPairsTest, NoTouchingPairOfASurfaceIsMissedHoweverFineItIs) {
  for (const int levels : {3, 5, 7}) {
    Walk walk(static_cast<std::uint64_t>(levels));
    const TriangleSurface surface = test::lumpy_sphere(levels, 0.02);
    test::patch_near(surface, {0, 0, 0.02}, levels == 7 ? 0.004 : 0.05, *patch);
    walk.home = {0, 0, 0.02};
    walk.spread_m = levels == 7 ? 0.004 : 0.02;
    walk_among(walk, *patch, 400, true);
  }
}

TEST_F(NearPairsTest, NothingIsMissedByAShaftThatOnlyTurns) {
  Walk walk(7);
  walk.use({}, 0, {});
  int touching = 0;
  for (int k = 0; k < 2000; ++k) {
    if (k % 100 == 0) {
      fill_with_soup(walk.random, *patch);
      walk.jump();
    }
    walk.go(0, 3e-4);  // 0.09 mm a tick at the far end
    walk.keep_up(*patch);
    touching += expect_none_missing(walk, *patch);
    if (HasFailure()) return;
  }
  EXPECT_GT(touching, 2000);
}

TEST_F(NearPairsTest, ABallHoldsItsTriangleFarFromTheOriginToo) {
  Random random(2);
  for (const double away : {0.0, 0.3, 3.0}) {
    patch->clear();
    const Vec3 centre = random.direction() * away;
    for (int i = 0; i < kMaxPatchTriangles; ++i) {
      const Vec3 a = centre + random.vector(0.3), b = a + random.vector(0.01);
      test::add_triangle(*patch, a, b, a + random.vector(i % 3 == 0 ? 0 : 0.01));
    }
    enclose(*patch, patch->balls);
    ASSERT_EQ(patch->balls.count, patch->count);
    ASSERT_EQ(patch->balls.stamp, patch->stamp);
    const PatchBalls& balls = patch->balls;
    for (std::size_t i = 0; i < std::size_t(kMaxPatchTriangles); ++i) {
      const Vec3 middle = balls.origin + Vec3(balls.x[i], balls.y[i], balls.z[i]);
      double furthest = 0;
      for (const Vec3& v : patch->corners(int(i))) furthest = std::max(furthest, (v - middle).norm());
      EXPECT_LE(furthest, balls.radius[i]);
      EXPECT_GE(furthest, balls.radius[i] - 4e-6) << "and is not much larger";
    }
  }
}

TEST_F(NearPairsTest, BallsOfAnotherPatchAreNotBelieved) {
  test::flat_patch(*patch, -0.02);
  enclose(*patch, patch->balls);
  test::flat_patch(*patch, 0);  // moved up, its balls left behind: another stamp
  Walk walk(3);
  walk.use({}, 0, {});
  walk.R = test::tip_down(Vec3::Zero()).R;
  walk.axes = axes_of(walk.tool, walk.R);
  walk.tip = {0.001, 0.002, ToolShape{}.radius_m};
  walk.keep_up(*patch);
  EXPECT_GT(expect_none_missing(walk, *patch), 0);
}

TEST_F(NearPairsTest, AShaftThatTurnsAboutItsTipDoesNotStirUpWhatLiesThere) {
  test::flat_patch(*patch, 0, 0.005, 16);
  enclose(*patch, patch->balls);
  Walk walk(4);
  walk.use({}, 0, {});
  walk.R = test::tip_down(Vec3::Zero()).R;
  walk.axes = axes_of(walk.tool, walk.R);
  walk.tip = {0.0001, 0.0002, ToolShape{}.radius_m + 1e-4};
  walk.keep_up(*patch);
  expect_none_missing(walk, *patch);
  walk.near.work = {};
  for (int k = 0; k < 18; ++k) {  // 0.1 mm a tick at the far end
    walk.go(0, 1e-4 / ToolShape{}.shaft_length_m);
    walk.keep_up(*patch);
    expect_none_missing(walk, *patch);
  }
  EXPECT_EQ(walk.near.work.lists, 0) << "2 mm at the far end are allowed for";
  EXPECT_LE(walk.near.work.measured, 40) << "of 512 triangles in 18 ticks";
}

TEST_F(NearPairsTest, AListGoesOnAfterAnyPair) {
  test::flat_patch(*patch, 0, 0.005, 4);
  Walk walk(5);
  walk.use({.jaw_length_m = 0.020}, 0.01, {});
  walk.tip = {0, 0, 0.0005};
  walk.keep_up(*patch);
  ASSERT_GT(walk.near.count(), 4);
  for (int i = 0; i < walk.near.count(); ++i) EXPECT_EQ(walk.near.first_after(walk.near.at(i)), i + 1);
  const NearPairs::Pair before{0, 0, -1, 0}, behind{0, 0, kMaxPatchTriangles, 0};
  EXPECT_EQ(walk.near.first_after(before), 0);
  EXPECT_EQ(walk.near.first_after(behind), walk.near.count());
}

TEST_F(NearPairsTest, BallsChangeNoDigitOfTheForce) {
  test::patch_near(test::lumpy_sphere(5, 0.04), {0, 0, 0.04}, 0.012, *patch);
  patch->material[0].mu_static = 0.3;
  patch->material[0].mu_dynamic = 0.2;
  const auto run = [&] {
    Random random(6);
    ContactRenderer renderer(ContactLaw::kProxy, {.jaw_length_m = 0.020});
    std::vector<double> out;
    for (int k = 0; k < 1500; ++k) {
      const Mat3 R = Eigen::AngleAxisd(0.4 * std::sin(2e-3 * k), Vec3::UnitY()).toRotationMatrix() *
                     test::tip_down(Vec3::Zero()).R;
      const Pose X{R, {0.004 * std::sin(9e-3 * k), 0.003 * std::cos(7e-3 * k), 0.042 + 0.004 * std::sin(1e-2 * k)}};
      const ContactResult r = renderer.update(X, Twist{random.vector(0.1), Vec3::Zero()}, *patch, 0.005);
      for (int i = 0; i < 3; ++i) out.insert(out.end(), {r.F_I_T.force[i], r.F_I_T.moment[i], r.point_T[i]});
    }
    return out;
  };
  const std::vector<double> without = run();
  enclose(*patch, patch->balls);
  const std::vector<double> with = run();
  EXPECT_EQ(std::memcmp(with.data(), without.data(), with.size() * sizeof(double)), 0);
}

}  // namespace
}  // namespace trocar::near_pairs_test
