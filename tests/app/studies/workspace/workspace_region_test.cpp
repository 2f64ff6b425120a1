// The region asked in other ways: symmetry of the device, refinement, finite differences, scaling laws, order
// statistics.
#include "app/studies/workspace/workspace_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/studies/workspace/workspace_grid.h"
#include "app/studies/workspace/workspace_quality.h"
#include "haptics/control/gravity.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/kinematics/link_clearance.h"
#include "haptics/kinematics/spherical_parallel.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::workspace_region_test {
namespace {

using test::Random;

constexpr std::array kSets{ReachSet::kLimits, ReachSet::kRing, ReachSet::kLimitsClear, ReachSet::kRules,
                           ReachSet::kRulesClear};

TEST(Quantiles, AreThoseOfAKnownSequence) {
  std::vector<double> values(10001);
  std::iota(values.begin(), values.end(), 0.0);
  std::reverse(values.begin(), values.end());  // order of the values does not matter
  const RegionPercentiles::Three q = quantiles(values);
  EXPECT_EQ(q[0].value, 500);
  EXPECT_EQ(q[1].value, 5000);
  EXPECT_EQ(q[2].value, 9500);
  // Two standard deviations of the median of 4000 and 10001 samples: 2 sqrt(0.25 (1/4000 + 1/10001)) = 1.87 %.
  EXPECT_NEAR(q[1].high - q[1].value, 187, 1.5);
  EXPECT_NEAR(q[1].value - q[1].low, 187, 1.5);
  EXPECT_LT(q[0].high - q[0].low, q[1].high - q[1].low) << "the tails of a flat distribution are known better";
}

TEST(Quantiles, CoverNineteenOfTwentySmallDraws) {
  // The range promised: percentiles of 4000 draws lie in it 95 times of 100. Counted over 200 draws of a normal.
  Random random(3);
  std::vector<double> large(20000);
  for (double& v : large) v = random.normal();
  const RegionPercentiles::Three q = quantiles(large);
  int inside = 0;
  constexpr int kDraws = 200;
  for (int n = 0; n < kDraws; ++n) {
    std::vector<double> small(4000);
    for (double& v : small) v = random.normal();
    std::nth_element(small.begin(), small.begin() + 200, small.end());
    inside += small[200] >= q[0].low && small[200] <= q[0].high;
  }
  EXPECT_GT(inside, 0.88 * kDraws);
}

TEST(SweptExtent, NarrowsWithEveryConditionAndGrowsWithFinerSteps) {
  const SweptExtent coarse = sweep_extent(15), fine = sweep_extent(30);
  EXPECT_TRUE(fine.limits.contains(fine.ring));
  EXPECT_TRUE(fine.ring.contains(fine.clear));
  EXPECT_TRUE(fine.limits.contains(coarse.limits)) << "every second step of the finer sweep is one of the coarser";
  EXPECT_TRUE(fine.clear.contains(coarse.clear));
}

TEST(SweptExtent, IsTheSameToBothSides) {
  // Mirroring the device in the plane x' = 0 exchanges two motors: its region must be its own mirror image.
  const SweptExtent swept = sweep_extent(30);
  for (const Eigen::AlignedBox3d& box : {swept.limits, swept.ring, swept.clear}) {
    EXPECT_NEAR(box.min().x(), -box.max().x(), 1e-9);
  }
}

TEST(WorkspaceGrid, IsItsOwnMirrorImage) {
  const WorkspaceGrid grid(0.02, 72);
  for (const ReachSet set : kSets) {
    int cells = 0, differ = 0;
    for (int k = 0; k < grid.size()[2]; ++k) {
      for (int j = 0; j < grid.size()[1]; ++j) {
        for (int i = 0; i < grid.size()[0]; ++i) {
          cells += grid.cell(i, j, k).in(set);
          differ += grid.cell(i, j, k).in(set) != grid.cell(grid.size()[0] - 1 - i, j, k).in(set);
        }
      }
    }
    EXPECT_GT(cells, 500);
    EXPECT_LT(differ, 0.03 * cells) << "planes are tried from one side of each cube to the other: set " << int(set);
  }
}

TEST(ReachAt, MorePlanesTakeNothingAway) {
  Random random(4);
  int gained = 0, reached = 0;
  for (int n = 0; n < 400; ++n) {
    const Vec3 p = Vec3(random.symmetric(0.25), random.symmetric(0.25), random.between(-0.27, 0.0));
    const std::uint8_t few = reach_at(p, 36).sets, many = reach_at(p, 144).sets;
    EXPECT_EQ(few & ~many, 0) << "every fourth of the 144 planes is one of the 36";
    gained += few != many;
    reached += many != 0;
  }
  EXPECT_GT(reached, 80);
  EXPECT_LT(gained, 0.15 * reached) << "36 planes already see nearly everything";
}

TEST(ReachAt, AgreesWithPosturesDrawnBlindly) {
  // Brute force from the other side: whatever the forward model reaches clear of the links, the cube's answer must
  // know.
  Random random(5);
  int clear = 0, known = 0;
  for (int n = 0; n < 1500; ++n) {
    const JointVector q = test::random_joints(random, 10, 0.35);
    if (!link_clearance(q.head<3>(), spherical_parallel(q.head<3>()).R_WP).clear()) continue;
    ++clear;
    known += reach_at(arm_state(q).X_WS.p, 144).in(ReachSet::kRulesClear);
  }
  EXPECT_GT(clear, 300);
  EXPECT_GE(known, 0.995 * clear);
}

TEST(ReachAt, NothingBeyondTheArmNorWithinTheFoldedElbow) {
  Random random(6);
  const double nearest = std::sqrt(kLink1 * kLink1 + kLink2 * kLink2 - kLink1 * kLink2);  // elbow at -120 deg
  for (int n = 0; n < 300; ++n) {
    const Vec3 direction = random.direction();
    EXPECT_EQ(reach_at((kLink1 + kLink2 + 1e-4) * direction, 36).sets, 0);
    EXPECT_EQ(reach_at((nearest - 1e-4) * direction, 36).sets, 0);
  }
  EXPECT_EQ(reach_at(Vec3::Zero(), 36).sets, 0);
}

TEST(PostureQuality, StepIsHowFarOneCountReallyMovesTheTip) {
  const DeviceModel model;
  Random random(7);
  for (int n = 0; n < 100; ++n) {
    const JointVector q = test::random_joints(random, 6, 0.25);
    double largest = 0;
    for (int i = 0; i < kArmJoints; ++i) {
      JointVector moved = q;
      moved[i] += count_size(model.transmission[static_cast<std::size_t>(i)]);
      largest = std::max(largest, (arm_state(moved).X_WS.p - arm_state(q).X_WS.p).norm());
    }
    // One count is 7e-4 rad: the chord differs from the tangent by its curvature, some parts in a thousand.
    EXPECT_NEAR(posture_quality(model, q).step_m / largest, 1, 0.01);
  }
}

TEST(PostureQuality, ForceIsWhatTheJointsCanHoldAndNoMore) {
  const DeviceModel model;
  Random random(8);
  for (int n = 0; n < 60; ++n) {
    const ArmState arm = arm_state(test::random_joints(random, 8, 0.3));
    const JointVector holding = gravity_torque(model, arm);
    const double force = worst_direction_force(model, arm, holding, kPeakMotor_nm);
    double most_used = 0;
    for (int m = 0; m < 200; ++m) {
      Vec6 wrench = Vec6::Zero();
      wrench.head<3>() = force * random.direction();
      const JointVector torque = holding + arm.J_WS.transpose() * wrench;
      most_used = std::max(most_used, (torque.head<4>().cwiseAbs() * 0.23 / kPeakMotor_nm).maxCoeff());
    }
    if (force == 0) continue;  // the weight alone is too much
    EXPECT_LE(most_used, 1 + 1e-9) << "in no direction is a motor asked for more";
  }
}

TEST(PostureQuality, ScalesAsStaticsScale) {
  const DeviceModel model;
  DeviceModel heavy = model, light = model;
  heavy.stylus_weight_n *= 2;
  for (PlatformWeight& w : heavy.platform_weights) w.weight_n *= 2;
  for (PlatformWeight& w : light.platform_weights) w.weight_n = 0;
  light.stylus_weight_n = 0;
  Random random(9);
  for (int n = 0; n < 60; ++n) {
    const JointVector q = test::random_joints(random, 8, 0.3);
    const ArmState arm = arm_state(q);
    const PostureQuality usual = posture_quality(model, q), doubled = posture_quality(heavy, q),
                         none = posture_quality(light, q);
    EXPECT_NEAR(doubled.gravity_motor_nm, 2 * usual.gravity_motor_nm, 1e-12);
    EXPECT_LE(doubled.peak_n, usual.peak_n);
    EXPECT_GE(doubled.winding_c, usual.winding_c);
    EXPECT_EQ(none.gravity_motor_nm, 0);
    EXPECT_NEAR(none.winding_c, 25, 1e-9) << "ambient";
    EXPECT_NEAR(none.continuous_n, usual.force_before_n, 1e-12);
    EXPECT_NEAR(none.peak_n, none.continuous_n * kPeakMotor_nm / kContinuousMotor_nm, 1e-9);
    EXPECT_GE(usual.peak_n, usual.continuous_n);
    EXPECT_NEAR(usual.smallest_singular, smallest_singular_value(arm.J_WS, 0.2), 1e-15);
    EXPECT_EQ(usual.det_a, arm.det_a);
  }
}

TEST(PostureQuality, RollAndWristAngleDoNotTouchTheForce) {
  const DeviceModel model;
  Random random(10);
  for (int n = 0; n < 40; ++n) {
    JointVector q = test::random_joints(random, 8, 0.3);
    const PostureQuality one = posture_quality(model, q);
    q[4] = random.between(-160, 0) * kDegree;
    q[5] = random.between(-400, 400) * kDegree;
    const PostureQuality other = posture_quality(model, q);
    EXPECT_NEAR(one.peak_n, other.peak_n, 1e-12) << "both axes pass through the stylus origin";
    EXPECT_NEAR(one.step_m, other.step_m, 1e-15);
    EXPECT_NEAR(one.gravity_motor_nm, other.gravity_motor_nm, 1e-12);
  }
}

TEST(SteadyWinding, RunsAwayWhereCopperHeatsFasterThanItCools) {
  const MotorHeatParameters p;
  // 1 = a R_th I^2 R: above this current there is no steady state.
  const double limit = std::sqrt(1 / (p.copper_per_k * 17.1 * p.resistance_ohm));
  EXPECT_TRUE(std::isfinite(steady_winding_c(p, 0.99 * limit)));
  EXPECT_TRUE(std::isinf(steady_winding_c(p, 1.01 * limit)));
  EXPECT_EQ(steady_winding_c(p, 0), p.ambient_c);
  EXPECT_EQ(steady_winding_c(p, 0.7), steady_winding_c(p, -0.7));
  double last = 0;
  for (double i = 0; i < limit; i += 0.1) {
    EXPECT_GT(steady_winding_c(p, i), last);
    last = steady_winding_c(p, i);
  }
}

}  // namespace
}  // namespace trocar::workspace_region_test
