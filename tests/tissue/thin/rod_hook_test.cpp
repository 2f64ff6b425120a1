// The crook of a hook: what comes over its foot from the side is lifted, what it came through from above is not.
#include "tissue/thin/rod_hook.h"

#include <gtest/gtest.h>

#include "tests/tissue/thin/rod_rig.h"

namespace trocar::rod_hook_test {
namespace {

constexpr double kFootZ = 0.00165;  // m of the foot below the tip's middle

/// A rod along x, 40 mm long, hung at both ends; the hook points down, its foot along +y of T.
class Hooked {
 public:
  Hooked() : rod(test::hung_duct({.avulsion_n = 1e6})) {}
  /// @param at of the foot's axis where it meets the shaft's
  void step(const Vec3& at) {
    Pose X;
    X.R = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();  // z down, -y towards +y of T
    X.p = at + Vec3(0, 0, kFootZ);
    std::vector<RodSpring> springs;
    hook.reach(X, rod, springs);
    rod.step(springs);
    hook.feel(X, springs, rod);
  }
  void move(const Vec3& from, const Vec3& to, int steps = 60) {
    for (int i = 1; i <= steps; ++i) step(from + static_cast<double>(i) / steps * (to - from));
  }
  double middle_z() const { return rod.place_at(0.02).z(); }

  ElasticRod rod;
  RodHook hook;
};

TEST(RodHook, SlidUnderFromTheSideItLiftsTheRodAndFeelsItsPull) {
  Hooked h;
  const double before = h.middle_z();
  h.move({0.02, -0.012, -0.004}, {0.02, -0.0045, -0.004});
  EXPECT_TRUE(h.hook.holds());
  EXPECT_EQ(h.hook.load_n(), 0) << "it lies over the foot without touching it";
  h.move({0.02, -0.0045, -0.004}, {0.02, -0.0045, 0.006});
  EXPECT_TRUE(h.hook.holds());
  EXPECT_NEAR(h.hook.arc_m(), 0.02, 0.002);
  EXPECT_GT(h.middle_z() - before, 0.005);
  EXPECT_GT(h.hook.load_n(), 0.05);
  EXPECT_LT(h.hook.hold().anchor_T.z(), 0.006) << "it pulls the hook down";
}

TEST(RodHook, FromAboveItGoesPastTheRodAndDoesNotLiftIt) {
  Hooked h;
  const double before = h.middle_z();
  h.move({0.02, -0.0045, 0.010}, {0.02, -0.0045, -0.004});
  EXPECT_FALSE(h.hook.holds());
  h.move({0.02, -0.0045, -0.004}, {0.02, -0.0045, 0.010});
  EXPECT_NEAR(h.middle_z(), before, 0.001);
}

TEST(RodHook, ComesOffTheEndOfTheFootAndBesideItHoldsNothing) {
  Hooked h;
  h.move({0.02, -0.012, -0.004}, {0.02, -0.0045, -0.004});
  h.move({0.02, -0.0045, -0.004}, {0.02, -0.0045, 0.004});
  ASSERT_TRUE(h.hook.holds());
  h.move({0.02, -0.0045, 0.004}, {0.02, -0.012, 0.004});
  EXPECT_FALSE(h.hook.holds());
  EXPECT_EQ(h.hook.hold().stiffness_n_per_m, 0);
  h.step({0.02, 0.02, 0});
  EXPECT_FALSE(h.hook.holds());
}

TEST(RodHook, APoseThatIsNoneLetsGo) {
  Hooked h;
  h.move({0.02, -0.012, -0.004}, {0.02, -0.0045, -0.004});
  ASSERT_TRUE(h.hook.holds());
  h.step(Vec3::Constant(NAN));
  EXPECT_FALSE(h.hook.holds());
}

}  // namespace
}  // namespace trocar::rod_hook_test
