// The job with a block in a small world of its own: the tip follows the intent, foam springs between the pads.
#include "scenarios/kinds/grasp/grasp_job.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace trocar::grasp_job_test {
namespace {

constexpr double kDt = 1e-3, kFinger = 400, kFingerLag = 0.04;
constexpr double kThick = 0.014, kHalfHeight = 0.010, kBoard = 250;
constexpr FoamLore kFoams[] = {{300, 0.6, 1.2}, {400, 0.96, 2.0}, {550, 1.44, 3.2}};

HandSkill steady() {
  HandSkill skill;
  skill.max_corrections = 3;
  skill.approach_speed_mps = 0.025;
  return skill;
}

/// One block at the left, its ring at the right.
struct JobWorld {
  explicit JobWorld(const HandSkill& skill, int foam_index = 0, bool told_in = true, std::uint64_t seed = 1)
      : foam(kFoams[foam_index]), told(told_in), job(skill), senses(skill.reaction_s), random(seed) {
    block.p = Vec3(-0.03, 0, kHalfHeight);
    intent.X_TI.p = tip = Vec3(0, 0, 0.06);
    intent.X_TI.R = down();
  }

  static Mat3 down() { return Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix(); }
  double roll() const {
    const Mat3 rolled = down().transpose() * intent.X_TI.R;
    return std::atan2(rolled(1, 0), rolled(0, 0));
  }

  Percept look() const {
    Percept seen;
    seen.tip_T = tip;
    seen.R_TI = down() * Eigen::AngleAxisd(std::clamp(roll(), -roll_end, roll_end), Vec3::UnitZ()).toRotationMatrix();
    seen.felt_force_T = Vec3(0, 0, board_n);
    seen.felt_grip_n = grip_n;
    seen.shown_grip_n = std::numeric_limits<double>::quiet_NaN();
    seen.jaw_opening_m = jaw;
    seen.cue = Cue::kPick;
    seen.target_radius_m = 0.004;
    if (told) seen.band_low_n = foam.low_n, seen.band_high_n = foam.high_n;
    seen.object = {block, size, slipping};
    seen.goal_T = ring;
    for (const FoamLore& lore : kFoams) seen.foam[static_cast<std::size_t>(seen.foam_count++)] = lore;
    return seen;
  }

  bool near(const Vec3& off) const { return held || (off.head<2>().norm() < 0.006 && std::abs(off.z()) < 0.009); }
  void begin() { job.begin(look(), intent, random); }

  void step() {
    const Percept seen = look();
    senses.update(seen, 0, kDt);
    job.update(seen, senses, kDt, intent, random);
    fastest_step = std::max(fastest_step, (intent.X_TI.p - tip).norm());
    tip = intent.X_TI.p + drift;
    const bool between = !vanished && near(tip - block.p);
    double rest = intent.jaw_opening_m;
    if (between && rest < kThick)
      rest = (kFinger * rest + foam.stiffness_n_per_m * kThick) / (kFinger + foam.stiffness_n_per_m);
    jaw += (rest - jaw) * kDt / kFingerLag;
    grip_n = between ? foam.stiffness_n_per_m * std::max(0.0, kThick - jaw) : kFinger * std::max(0.0, -jaw);
    hold();
    t_s += kDt;
  }

  void hold() {
    if (!held && grip_n > 0.1) {
      held = true;
      ++grasps;
      offset = block.p - tip;
    } else if (held && (grip_n < 0.05 || vanished)) {
      held = false;
      let_go_at = block.p;
    }
    board_n = 0;
    if (!held) {
      block.p.z() = kHalfHeight;
      return;
    }
    block.p = tip + offset;
    board_n = kBoard * std::max(0.0, kHalfHeight - block.p.z());
    highest = std::max(highest, block.p.z() - kHalfHeight);
    if (block.p.z() - kHalfHeight < 0.002) return;
    carried_s += kDt;
    carried_sum += grip_n * kDt;
    if (grip_n >= foam.low_n && grip_n <= foam.high_n) in_window_s += kDt;
  }

  template <typename Until>
  bool run(double longest_s, Until until) {
    for (const double end = t_s + longest_s; t_s < end;) {
      step();
      if (until()) return true;
    }
    return false;
  }
  bool brought() const { return grasps > 0 && !held && (block.p - ring).head<2>().norm() < 0.004; }
  double mean_grip() const { return carried_s > 0 ? carried_sum / carried_s : 0; }

  FoamLore foam;
  bool told, held = false, slipping = false, vanished = false;
  GraspJob job;
  HandSenses senses;
  HandRandom random;
  HandIntent intent;
  Pose block;
  Vec3 size{kThick, kThick, 2 * kHalfHeight};
  double roll_end = 10;       ///< rad about the shaft that the wrist goes
  Vec3 drift = Vec3::Zero();  ///< of the tip against what the hand wants
  Vec3 tip, offset = Vec3::Zero(), let_go_at = Vec3::Zero(), ring{0.03, 0, 0};
  double jaw = 0.02, grip_n = 0, board_n = 0, t_s = 0, highest = 0, fastest_step = 0;
  double carried_s = 0, carried_sum = 0, in_window_s = 0;
  int grasps = 0;
};

TEST(GraspJob, BringsTheBlockAndWithdraws) {
  JobWorld world(steady());
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.brought(); }));
  EXPECT_EQ(world.grasps, 1);
  EXPECT_GT(world.highest, 0.030) << "lifted as high as the rules ask";
  EXPECT_LT(world.highest, 0.045);
  EXPECT_LT((world.let_go_at - world.ring).head<2>().norm(), 0.002);
  EXPECT_LT(std::abs(world.let_go_at.z() - kHalfHeight), 0.002) << "let go when it stands, not above";
  EXPECT_GT(world.in_window_s, 0.95 * world.carried_s);
  world.run(0.8, [] { return false; });
  EXPECT_GT(world.jaw, kThick + 0.004) << "open jaws";
  EXPECT_GT(world.tip.z(), 0.015) << "out of the way";
  EXPECT_LT(world.fastest_step, 0.6 * kDt) << "no jumps";
}

TEST(GraspJob, SeesThatTheBlockIsGoneWhenPadsFeelEachOther) {
  JobWorld world(steady());
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.highest > 0.025; }));
  world.vanished = true;
  world.jaw = world.intent.jaw_opening_m = -0.005;  // the pads press each other
  double furthest = 0;
  world.run(10, [&] {
    furthest = std::max(furthest, (world.tip - world.block.p).norm());
    return false;
  });
  EXPECT_LT(furthest, 0.10) << "it goes back to the block instead of carrying nothing on and on";
  EXPECT_LT((world.tip - world.block.p).norm(), 0.05);
}

TEST(GraspJob, DoesNotPressOnAgainstTheEndOfTheWrist) {
  JobWorld world(steady());
  world.size.y() = 0.030;  // only its other sides fit, and these ask for a quarter turn
  world.roll_end = 0.8;
  world.begin();
  ASSERT_TRUE(world.run(5, [&] { return std::abs(world.roll()) > 1.2; })) << "it tries";
  for (int i = 0; i < 20; ++i) {
    world.begin();
    world.run(3, [] { return false; });
    EXPECT_LT(std::abs(world.roll()), world.roll_end + 0.35) << i;
  }
}

TEST(GraspJob, TellsTheFoamByFeelWhenNoColourDoes) {
  for (int foam = 0; foam < 3; ++foam) {
    JobWorld world(steady(), foam, false);
    world.begin();
    double held_s = 0, at_first = 0;
    ASSERT_TRUE(world.run(15, [&] {
      if (world.held && (held_s += kDt) < 0.5) at_first = std::max(at_first, world.grip_n);
      return world.brought();
    })) << foam;
    EXPECT_LT(at_first, 1.2) << "a light squeeze comes first, which crushes no foam";
    EXPECT_GT(world.in_window_s, 0.9 * world.carried_s) << foam;
    const double wanted = (kFoams[foam].low_n + kFoams[foam].high_n) / 2;
    EXPECT_NEAR(world.mean_grip(), wanted, 0.15 * wanted) << foam;
  }
}

TEST(GraspJob, FeelingTakesTime) {
  double took[2];
  for (const bool told : {false, true}) {
    JobWorld world(steady(), 0, told);
    world.begin();
    ASSERT_TRUE(world.run(15, [&] { return world.brought(); }));
    took[told] = world.t_s;
  }
  EXPECT_GT(took[0], took[1] + 0.4);
}

TEST(GraspJob, HoldsTighterWhatIsSeenToSlip) {
  double grip[2];
  for (const bool slips : {false, true}) {
    JobWorld world(steady());
    world.begin();
    ASSERT_TRUE(world.run(15, [&] { return world.held && world.highest > 0.005; }));
    world.slipping = slips;
    world.run(0.3, [] { return false; });
    world.slipping = false;
    world.run(0.5, [] { return false; });
    grip[slips] = world.grip_n;
  }
  EXPECT_GT(grip[1], grip[0] * 1.1);
}

TEST(GraspJob, FetchesAgainWhatIsLostOnTheWay) {
  JobWorld world(steady());
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.held && world.tip.x() > 0; }));
  world.vanished = true;
  world.run(0.1, [] { return false; });
  world.vanished = false;
  world.held = false;
  world.block.p = Vec3(0, 0.01, kHalfHeight);
  world.run(0.7, [] { return false; });
  EXPECT_GT(world.intent.jaw_opening_m, kThick) << "noticed, and the jaws open";
  ASSERT_TRUE(world.run(25, [&] { return world.brought(); }));
  EXPECT_EQ(world.grasps, 2);
}

TEST(GraspJob, TriesAgainAfterClosingOnNothing) {
  JobWorld world(steady());
  world.vanished = true;
  world.block.p = Vec3(-0.03, 0, kHalfHeight);
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.jaw < kThick / 3 || world.intent.jaw_opening_m < kThick / 3; }));
  world.vanished = false;
  world.block.p.x() += 0.006;
  EXPECT_TRUE(world.run(20, [&] { return world.brought(); }));
}

TEST(GraspJob, LooksAgainWhenTheJawsMeetSomethingOnTheWayDown) {
  for (const bool strikes : {false, true}) {
    JobWorld world(steady());
    world.begin();
    ASSERT_TRUE(world.run(15, [&] { return world.t_s > 0.3 && world.tip.z() < 0.035; }));
    double lowest = world.tip.z(), rise = 0;
    for (int i = 0; i < 600; ++i) {
      if (strikes && i < 200) world.board_n = 0.8;
      world.step();
      lowest = std::min(lowest, world.tip.z());
      rise = std::max(rise, world.tip.z() - lowest);
    }
    EXPECT_EQ(rise > 0.002, strikes) << "back up, and only then: " << rise;
    EXPECT_TRUE(world.run(20, [&] { return world.brought(); }));
  }
}

TEST(GraspJob, TurnsThePadsToTheSidesOfTheBlock) {
  for (const double degrees : {-30.0, 10.0, 40.0}) {
    JobWorld world(steady());
    world.block.R = Eigen::AngleAxisd(degrees * M_PI / 180, Vec3::UnitZ()).toRotationMatrix();
    world.begin();
    ASSERT_TRUE(world.run(15, [&] { return world.held; })) << degrees;
    const Vec3 across = world.block.R.transpose() * world.intent.X_TI.R.col(1);
    EXPECT_GT(across.head<2>().cwiseAbs().maxCoeff(), std::cos(0.10)) << degrees;
  }
}

TEST(GraspJob, TakesALyingBlockAcrossTheSideThatThePadsReachRound) {
  JobWorld world(steady());
  world.block.R =
      Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix();  // 20 mm long along y of T, as are the pads
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.held; }));
  EXPECT_GT(std::abs(world.intent.X_TI.R.col(1).x()), std::cos(0.10)) << "across its 14 mm";
}

TEST(GraspJob, GuidesTheBlockWhileItIsLowered) {
  JobWorld world(steady());
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.held && world.tip.x() > 0.029 && world.tip.z() < 0.036; }));
  for (int i = 0; i < 200; ++i) {  // the instrument bends away as it goes down
    world.drift.x() -= 0.003 / 200;
    world.step();
  }
  ASSERT_TRUE(world.run(15, [&] { return !world.held; }));
  EXPECT_LT((world.let_go_at - world.ring).head<2>().norm(), 0.0015) << "half of it, and more, is made good on the way";
}

TEST(GraspJob, GuidesTheJawsOnTheWayDown) {
  JobWorld world(steady());
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.t_s > 0.3 && world.tip.z() < 0.038; }));
  double off = 1;
  ASSERT_TRUE(world.run(3, [&] {
    if (world.drift.y() > -0.003) world.drift.y() -= 0.003 / 100;  // the instrument bends away
    off = std::abs(world.tip.y() - world.block.p.y());
    return world.held;
  }));
  EXPECT_LT(off, 0.0025);
}

TEST(GraspJob, LeavesTheBlockBeforeItTurnsToTheNext) {
  JobWorld world(steady());
  world.begin();
  ASSERT_TRUE(world.run(15, [&] { return world.brought(); }));
  const Vec3 stood = world.tip;
  world.ring.x() = 0.05;
  world.block.p = Vec3(-0.03, 0.03, kHalfHeight);  // the next one is lit while the jaws still open
  world.begin();
  double sideways = 0;
  ASSERT_TRUE(world.run(3, [&] {
    if (world.tip.z() < stood.z() + 0.02) sideways = std::max(sideways, (world.tip - stood).head<2>().norm());
    return world.tip.z() > stood.z() + 0.02;
  }));
  EXPECT_LT(sideways, 0.004) << "out first, then aside";
  EXPECT_TRUE(world.run(15, [&] { return world.held; })) << "and takes it";
}

TEST(GraspJob, AHeavyHandSqueezesHarder) {
  HandSkill heavy = steady();
  heavy.force_bias = 1.8;
  double hardest[2] = {0, 0};
  for (const bool is_heavy : {false, true}) {
    JobWorld world(is_heavy ? heavy : steady());
    world.begin();
    world.run(15, [&] {
      hardest[is_heavy] = std::max(hardest[is_heavy], world.grip_n);
      return world.brought();
    });
  }
  EXPECT_LT(hardest[0], 1.2);
  EXPECT_GT(hardest[1], 1.3);
}

TEST(GraspJob, TheSeedAloneDrawsTheMovement) {
  HandSkill unsteady = steady();
  unsteady.aim_lateral_m = unsteady.aim_depth_m = 0.001;
  unsteady.force_cv = 0.2;
  JobWorld one(unsteady, 0, true, 5), same(unsteady, 0, true, 5), other(unsteady, 0, true, 6);
  double off = 0;
  for (JobWorld* world : {&one, &same, &other}) world->begin();
  for (int i = 0; i < 4000; ++i) {
    for (JobWorld* world : {&one, &same, &other}) world->step();
    ASSERT_EQ(one.tip, same.tip) << i;
    off = std::max(off, (one.tip - other.tip).norm());
  }
  EXPECT_GT(off, 2e-4);
}

}  // namespace
}  // namespace trocar::grasp_job_test
