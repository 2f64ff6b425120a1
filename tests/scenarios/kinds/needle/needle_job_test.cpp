// The job with a needle in a small world of its own: the tip follows the intent, the needle the jaws while they are
// shut, and no tissue lets its point in.
#include "scenarios/kinds/needle/needle_job.h"

#include <numbers>

#include <gtest/gtest.h>

namespace trocar::needle_job_test {
namespace {

constexpr double kDt = 1e-3, kRadius = 0.0085;

/// The shaft comes steeply from above over two dots 8 mm apart; the needle is held by its middle, its point over the
/// first.
struct NeedleWorld {
  NeedleWorld() {
    Mat3& R = intent.X_TI.R;
    R.col(2) = Vec3(0, 0.8, -0.6);
    R.col(0) = Vec3::UnitX();
    R.col(1) = R.col(2).cross(R.col(0));
    R_TI_wanted = R;
    intent.X_TI.p = Vec3(0, 0, 0.02);
    intent.jaw_opening_m = -0.010;
  }

  Percept look() const {
    Percept seen;
    seen.tip_T = intent.X_TI.p;
    seen.R_TI = intent.X_TI.R;
    seen.target_R_TI = R_TI_wanted;
    seen.jaw_opening_m = std::max(0.0, intent.jaw_opening_m);
    seen.cue = Cue::kDrive;
    seen.target_T = Vec3(0.004, 0, 0);
    seen.goal_T = Vec3(-0.004, 0, 0);
    seen.target_normal_T = Vec3::UnitZ();
    seen.target_radius_m = 0.0015;
    seen.object.size_m = Vec3(2, 1, 0) * kRadius;
    seen.object.X_TO = intent.X_TI * X_IN;
    return seen;
  }

  Mat3 R_TI_wanted = Mat3::Identity();
  Pose X_IN{Eigen::AngleAxisd(-std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix(), Vec3(0, -kRadius, 0)};
  NeedleJob job{HandSkill{}};
  HandSenses senses{0.2};
  HandRandom random{1};
  HandIntent intent;
};

TEST(NeedleJob, LetsGoAfterTwoDrivesInVain) {
  NeedleWorld world;
  world.job.begin(world.look(), world.intent, world.random);
  int presses = 0;
  bool pressed = false;
  for (int i = 0; i < 120000 && world.intent.jaw_opening_m < 0.006; ++i) {
    const Percept seen = world.look();
    world.senses.update(seen, 0, kDt);
    world.job.update(seen, world.senses, kDt, world.intent, world.random);
    presses += world.job.touches() && !pressed;
    pressed = world.job.touches();
  }
  EXPECT_GE(world.intent.jaw_opening_m, 0.006) << "it lets go";
  EXPECT_EQ(presses, 2);
}

}  // namespace
}  // namespace trocar::needle_job_test
