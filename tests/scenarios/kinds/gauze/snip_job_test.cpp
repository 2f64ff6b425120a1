// The job with scissors over gauze in a small world of its own: the tip follows the intent, gauze is a spring, and what
// the arm weighs is felt as well.
#include "scenarios/kinds/gauze/snip_job.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace trocar::snip_job_test {
namespace {

constexpr double kDt = 1e-3;

HandSkill steady() {
  HandSkill skill;
  skill.max_corrections = 3;
  skill.approach_speed_mps = 0.025;
  skill.hover_m = 0.012;
  return skill;
}

/// The place that is asked for is the origin of level gauze.
struct GauzeWorld {
  explicit GauzeWorld(double gauze) : gauze_n_per_m(gauze) {
    intent.X_TI.p = Vec3(0.01, 0, 0.03);
    intent.X_TI.R = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();
    intent.jaw_opening_m = 0.005;
  }

  Percept look() const {
    Percept seen;
    seen.tip_T = intent.X_TI.p;
    seen.R_TI = seen.target_R_TI = intent.X_TI.R;
    seen.jaw_opening_m = intent.jaw_opening_m;
    seen.cue = Cue::kSnip;
    seen.target_T = Vec3(0, 0, height_m);
    seen.target_normal_T = Vec3::UnitZ();
    seen.target_radius_m = 0.001;
    seen.target_angle_rad = 0.2;
    seen.band_low_n = 0.4;
    seen.band_high_n = 0.9;
    seen.shown_force_n = std::numeric_limits<double>::quiet_NaN();
    seen.felt_force_T = Vec3(0, 0, arm_n + pressed_n());
    return seen;
  }
  double pressed_n() const { return gauze_n_per_m * std::max(0.0, height_m - intent.X_TI.p.z()); }

  /// @return height of the tip as the blades shut
  double height_of_snip() {
    job.begin(look(), intent, random);
    for (int i = 0; i < 10000; ++i) {
      const Percept seen = look();
      senses.update(seen, 0, kDt);
      if (job.touches()) senses.set_used_to_it(false);
      job.update(seen, senses, kDt, intent, random);
      if (job.touches() && seen.tip_T.z() < 0.01) arm_n = arm_later_n;
      if (intent.jaw_opening_m < 0.0065 && job.touches()) height_m -= backs_away_mps * kDt;
      if (intent.jaw_opening_m < 0.001) return intent.X_TI.p.z();
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  double gauze_n_per_m, arm_n = 0, arm_later_n = 0, height_m = 0, backs_away_mps = 0;
  SnipJob job{steady()};
  HandSenses senses{0.2};
  HandRandom random{1};
  HandIntent intent;
};

TEST(SnipJob, PressesAsIsMeantAndCloses) {
  GauzeWorld world(150);
  const double height = world.height_of_snip();
  EXPECT_LT(height, -0.002) << "0.65 N are some 4 mm";
  EXPECT_GT(height, -0.010);
}

TEST(SnipJob, DoesNotTakeWhatTheArmWeighsForGauze) {
  GauzeWorld world(150);
  world.arm_later_n = 1.0;  // in the air, on the way down
  EXPECT_LT(world.height_of_snip(), -0.0005);
}

TEST(SnipJob, DoesNotPressLooseGauzeDeeperThanItGivesWay) {
  GauzeWorld world(0);
  const double height = world.height_of_snip();
  EXPECT_LT(height, -0.005);
  EXPECT_GT(height, -0.012);
}

TEST(SnipJob, GoesOnPressingOnGauzeThatBacksAwayWhileTheBladesClose) {
  GauzeWorld world(150);
  world.backs_away_mps = 0.04;  // by 5 mm until they are shut, of the 4 mm that it was pressed in
  world.height_of_snip();
  EXPECT_GT(world.pressed_n(), 0.1) << "what is not pressed is not cut";
}

}  // namespace
}  // namespace trocar::snip_job_test
