// The parts of a hand: movement shapes, late senses, force control against a spring, fixed waypoints, idleness.
#include <cmath>

#include <gtest/gtest.h>

#include "scenarios/hands/force_grip.h"
#include "scenarios/hands/hand_senses.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/hands/minimum_jerk.h"
#include "scenarios/hands/skilled_hand.h"
#include "scenarios/hands/waypoint_hand.h"

namespace trocar::hand_parts_test {
namespace {

constexpr double kDt = 1e-3;

TEST(MinimumJerk, StartsAndEndsAtRest) {
  EXPECT_EQ(minimum_jerk(-1), 0);
  EXPECT_EQ(minimum_jerk(0), 0);
  EXPECT_EQ(minimum_jerk(1), 1);
  EXPECT_EQ(minimum_jerk(3), 1);
  EXPECT_DOUBLE_EQ(minimum_jerk(0.5), 0.5);
  const double h = 1e-5;
  EXPECT_NEAR(minimum_jerk(h) / h, 0, 1e-8);
  EXPECT_NEAR((minimum_jerk(0.5 + h) - minimum_jerk(0.5 - h)) / (2 * h), 1.875, 1e-6);
  EXPECT_NEAR((1 - minimum_jerk(1 - h)) / h, 0, 1e-8);
}

TEST(ReachTime, GrowsWithDistanceOverWidth) {
  EXPECT_NEAR(reach_time_s(0.040, 0.006, 1), 0.12 + 0.11 * std::log2(2 * 40.0 / 6 + 1), 1e-12);
  EXPECT_NEAR(reach_time_s(0.040, 0.006, 2.1), 2.1 * reach_time_s(0.040, 0.006, 1), 1e-12);
  EXPECT_NEAR(reach_time_s(0, 0.006, 1), 0.12, 1e-12);
  EXPECT_NEAR(reach_time_s(0, 0, 1), 0.12, 1e-12);
  EXPECT_LT(reach_time_s(0.040, 0, 1), 2) << "a place of no size is reached all the same";
}

TEST(ReachPlan, WithdrawsCrossesAndArrives) {
  const Vec3 from(0, 0, 0), to(0.04, 0, 0.004);
  const ReachPlan plan(from, to, {0.012, Vec3(0, 0.002, 0), 0.4, 0.6});
  EXPECT_LT((plan.at(0) - from).norm(), 1e-12);
  EXPECT_LT((plan.at(plan.duration_s()) - to).norm(), 1e-12);
  EXPECT_LT((plan.at(plan.duration_s() + 1) - to).norm(), 1e-12);
  double highest = 0, widest = 0;
  for (double t = 0; t < plan.duration_s(); t += kDt) {
    const Vec3 p = plan.at(t);
    highest = std::max(highest, p.z());
    widest = std::max(widest, p.y());
    if (p.x() < 0.004 || p.x() > 0.036) continue;
    EXPECT_GT(p.z(), 0.006) << "crosses above the tissue";
  }
  EXPECT_GT(highest, 0.010);
  EXPECT_NEAR(widest, 0.002, 1e-5);
}

TEST(ReachPlan, OutOfTheTissueItRisesNoHigherThanTheWithdrawal) {
  const Vec3 from(0, 0, -0.015), to(0.05, 0, 0.004);  // the intent lies 15 mm under the surface at 0
  ReachPlan::Shape shape{0.012, Vec3::Zero(), 0.4, 0.6};
  shape.sunk_m = 0.015;
  const ReachPlan plan(from, to, shape);
  EXPECT_TRUE(plan.at(0).isApprox(from));
  EXPECT_TRUE(plan.at(plan.duration_s()).isApprox(to));
  double highest = -1;
  for (double t = 0; t < plan.duration_s(); t += 0.002) highest = std::max(highest, plan.at(t).z());
  EXPECT_LT(highest, 0.0165);
  EXPECT_GT(highest, 0.008);
}

TEST(ReachPlan, MovesWithoutJumps) {
  const ReachPlan plan(Vec3::Zero(), Vec3(0.05, 0.03, -0.01), {0.012, Vec3(0.001, 0, 0), 0.3, 0.5});
  Vec3 before = plan.at(0);
  for (double t = kDt; t < plan.duration_s() + 0.1; t += kDt) {
    EXPECT_LT((plan.at(t) - before).norm(), 0.6 * kDt) << "under 0.6 m/s at " << t;
    before = plan.at(t);
  }
}

TEST(LateSignal, ArrivesAfterItsDelay) {
  LateSignal signal(0.1, 1e-3);
  for (int i = 0; i < 99; ++i) EXPECT_EQ(signal.update(1, kDt), 0) << i;
  signal.update(1, kDt);
  signal.update(1, kDt);
  EXPECT_NEAR(signal.value(), 1, 1e-9);
}

TEST(HandSenses, NoticeACueAfterReactionAndPause) {
  HandSenses senses(0.17);
  Percept percept;
  percept.cue = Cue::kReach;
  percept.target_index = 3;
  int ticks = 0;
  while (senses.task().kind == HandJob::Kind::kNothing && ticks < 1000) {
    senses.update(percept, 0.15, kDt);
    ++ticks;
  }
  EXPECT_NEAR(ticks * kDt, 0.32, 0.003);
  EXPECT_EQ(senses.task().target, 3);
  percept.cue = Cue::kPress;
  for (int i = 0; i < 400; ++i) senses.update(percept, 0.15, kDt);
  EXPECT_EQ(senses.task().target, 3) << "pressing the same disc is the same task";
  percept.target_index = 4;
  senses.update(percept, 0.15, kDt);
  EXPECT_EQ(senses.task().target, 3);
  EXPECT_EQ(senses.seen().target, 4);
}

TEST(HandSenses, PreferTheForceBarAndFallBackToTheFingers) {
  HandSenses bar(0.17), fingers(0.17);
  Percept percept;
  percept.felt_force_T = Vec3(0.2, 0, 0.3);
  percept.shown_force_n = 0.7;
  fingers.set_used_to_it(false);
  for (int i = 0; i < 1000; ++i) bar.update(percept, 0, kDt);
  EXPECT_NEAR(bar.force_n(), 0.7, 1e-6);
  percept.shown_force_n = std::nan("");
  for (int i = 0; i < 1000; ++i) fingers.update(percept, 0, kDt);
  EXPECT_NEAR(fingers.force_n(), 0.3, 1e-6);
  EXPECT_NEAR(fingers.touch_n(), 0.3, 1e-6) << "what acts against the target, not what acts sideways";
}

TEST(HandSenses, GetUsedToWhatTheArmMakesThemFeelAndNoticeATouchBesideIt) {
  HandSenses senses(0.17);
  Percept percept;
  percept.shown_force_n = std::nan("");
  percept.felt_force_T = Vec3(0, 0, 0.2);  // friction of the arm on the way down
  for (int i = 0; i < 2000; ++i) senses.update(percept, 0, kDt);
  EXPECT_NEAR(senses.touch_n(), 0, 1e-3);
  EXPECT_NEAR(senses.force_n(), 0, 1e-3);
  senses.set_used_to_it(false);
  percept.felt_force_T = Vec3(0, 0, 0.5);
  for (int i = 0; i < 2000; ++i) senses.update(percept, 0, kDt);
  EXPECT_NEAR(senses.touch_n(), 0.3, 1e-3) << "a pressing hand does not get used to the tissue";
  EXPECT_NEAR(senses.force_n(), 0.3, 1e-3);
}

TEST(HandSenses, LearnFromTheBarWhatTheyFeelTooLittleOrTooMuch) {
  HandSenses senses(0.17);
  senses.set_used_to_it(false);
  Percept percept;
  percept.felt_force_T = Vec3(0, 0, 0.5);
  percept.shown_force_n = 0.7;
  for (int i = 0; i < 3000; ++i) senses.update(percept, 0, kDt);
  EXPECT_TRUE(senses.knows_bar());
  percept.shown_force_n = std::nan("");  // the bar goes, what it taught stays
  percept.felt_force_T = Vec3(0, 0, 0.6);
  for (int i = 0; i < 1000; ++i) senses.update(percept, 0, kDt);
  EXPECT_NEAR(senses.force_n(), 0.8, 0.01);
}

/// Seconds until a force that is felt `wrong` too strong has been in the band for 1 s; 0: given up or never.
double seconds_until_held(ForceGrip& grip, double wrong_n) {
  HandRandom random(4);
  grip.begin(0.45, 0.75, random);
  double force = 0, held_s = 0;
  for (int i = 0; i < 30000 && !grip.gives_up(); ++i) {
    force = std::max(0.0, force + 100 * grip.speed(force + wrong_n, kDt, random) * kDt);
    held_s = force >= 0.45 && force <= 0.75 ? held_s + kDt : 0;
    if (held_s >= 1) return i * kDt;
  }
  return 0;
}

TEST(ForceGrip, TriesOtherForcesWhenNothingComesOfTheOneThatFeelsRight) {
  for (const double wrong : {-0.2, 0.2}) {
    ForceGrip stubborn({100, 3, 0.04, 1.0, 0.0}), patient({100, 3, 0.04, 1.0, 0.0, 0, 2});
    EXPECT_EQ(seconds_until_held(stubborn, wrong), 0) << "feels right and is not";
    EXPECT_GT(seconds_until_held(patient, wrong), 2) << wrong;
  }
  ForceGrip patient({100, 3, 0.04, 1.0, 0.0, 0, 2});
  EXPECT_EQ(seconds_until_held(patient, -0.6), 0) << "gives up, to press afresh";
  EXPECT_TRUE(patient.gives_up());
}

TEST(ForceGrip, LearnsFromTheTrialThatSucceeded) {
  ForceGrip grip({100, 3, 0.04, 1.0, 0.0, 0, 2});
  const double first = seconds_until_held(grip, 0.2);
  double last = first;
  for (int hold = 0; hold < 4; ++hold) {
    grip.succeeded();
    last = seconds_until_held(grip, 0.2);
  }
  EXPECT_GT(first, 3);
  EXPECT_GT(last, 1);
  EXPECT_LT(last, 2.5);
}

class ForceGripAgainstASpring : public testing::TestWithParam<double> {};

TEST_P(ForceGripAgainstASpring, SettlesInTheBandDespiteTheDelay) {
  HandRandom random(1);
  ForceGrip grip({100, 3, 0.04, 1.0, 0.0});
  grip.begin(0.4, 0.8, random);
  LateSignal late(0.12, 0.05);
  double intent = 0, highest = 0, force = 0;
  for (int i = 0; i < 8000; ++i) {
    force = std::max(0.0, GetParam() * intent);
    highest = std::max(highest, force);
    intent += grip.speed(late.update(force, kDt), kDt, random) * kDt;
    if (i <= 6000) continue;
    EXPECT_NEAR(force, 0.6, 0.02) << "settled";
  }
  EXPECT_LT(highest, 1.1) << "overshoot stays below the hard limit of 1.5 N with room";
}

// 49 N/m: an arm of 130 N/m behind a light grip, on 150 N/m of tissue; 125 N/m: a firm hand.
INSTANTIATE_TEST_SUITE_P(Stiffnesses, ForceGripAgainstASpring, testing::Values(49.0, 70.0, 100.0, 125.0));

TEST(ForceGrip, BiasFadesWhenTheForceStaysOutside) {
  HandRandom random(1);
  ForceGrip grip({100, 3, 0.04, 2.6, 0.0});
  grip.begin(0.4, 0.8, random);
  EXPECT_NEAR(grip.goal_n(), 1.56, 1e-9);
  for (int i = 0; i < 800; ++i) grip.speed(1.5, kDt, random);
  EXPECT_NEAR(grip.goal_n(), 0.6 * (1 + 1.6 * 0.6), 1e-9);
  for (int i = 0; i < 5000; ++i) grip.speed(0.6, kDt, random);
  EXPECT_NEAR(grip.goal_n(), 0.6 * (1 + 1.6 * 0.6), 1e-9) << "inside the band it leaves well alone";
}

TEST(ForceGrip, ForesightLetsAQuickerHandOvershootLess) {
  double highest[2] = {0, 0};
  for (const bool foresees : {false, true}) {
    HandRandom random(1);
    ForceGrip grip({60, 3.5, 0.04, 1.0, 0.0, foresees ? 0.08 : 0.0});
    grip.begin(0.4, 0.8, random);
    LateSignal late(0.12, 0.05);
    double intent = 0, force = 0;
    for (int i = 0; i < 6000; ++i) {
      force = std::max(0.0, 100 * intent);
      highest[foresees] = std::max(highest[foresees], force);
      intent += grip.speed(late.update(force, kDt), kDt, random) * kDt;
    }
    EXPECT_NEAR(force, 0.6, 0.03) << foresees;
  }
  EXPECT_LT(highest[true], highest[false] - 0.05);
}

TEST(ForceGrip, AForceThatComesAndGoesMakesItThinkAgain) {
  HandRandom random(1);
  ForceGrip grip({100, 3, 0.04, 1.5, 0.0});
  grip.begin(0.4, 0.8, random);
  const double first = grip.goal_n();
  for (int i = 0; i < 3000; ++i) grip.speed(i % 200 < 100 ? 0.85 : 0.75, kDt, random);  // never outside for long
  EXPECT_LT(grip.goal_n(), first - 0.05);
}

TEST(HandRandom, HasTheMomentsItClaims) {
  HandRandom random(5);
  double sum = 0, squares = 0, log_sum = 0, log_squares = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal(), y = random.log_normal(0.2);
    sum += x;
    squares += x * x;
    log_sum += y;
    log_squares += y * y;
  }
  EXPECT_NEAR(sum / n, 0, 0.01);  // 4 standard errors of 0.0022
  EXPECT_NEAR(squares / n, 1, 0.02);
  EXPECT_NEAR(log_sum / n, 1, 0.005);
  EXPECT_NEAR(std::sqrt(log_squares / n - std::pow(log_sum / n, 2)), 0.2, 0.005);
}

Percept ready_at(const Vec3& tip) {
  Percept percept;
  percept.device_ready = true;
  percept.tip_T = tip;
  percept.R_TI = Eigen::AngleAxisd(0.7, Vec3::UnitX()).toRotationMatrix();
  return percept;
}

TEST(WaypointHand, FollowsItsMovesFromWhereItWasReady) {
  const HandScript script = parse_hand_script(
      "name = \"line\"\nkind = \"waypoints\"\n"
      "[[move]]\nto_mm = [0, 0, -20]\nfrom = \"ready\"\nseconds = 0.5\nhold_s = 0.25\n"
      "[[move]]\nto_mm = [10, 5, 40]\nseconds = 1\njaw_mm = 3\n",
      "line.toml");
  const auto hand = make_hand(script, 1);
  const Vec3 ready(0.1, 0.2, 0.3);
  HandIntent intent;
  const auto run = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds * 1000)); ++i) intent = hand->update(ready_at(ready), kDt);
  };
  run(0.001);
  EXPECT_EQ(intent.X_TI.p, ready);
  run(0.25);
  EXPECT_NEAR(intent.X_TI.p.z(), 0.3 - 0.010, 1e-4) << "half way";
  run(0.4);
  EXPECT_NEAR((intent.X_TI.p - Vec3(0.1, 0.2, 0.28)).norm(), 0, 1e-12) << "resting";
  run(1.2);
  EXPECT_NEAR((intent.X_TI.p - Vec3(0.010, 0.005, 0.040)).norm(), 0, 1e-12);
  EXPECT_NEAR(intent.jaw_opening_m, 0.003, 1e-12);
  EXPECT_NEAR((intent.X_TI.R - ready_at(ready).R_TI).norm(), 0, 1e-12) << "orientation as seen when ready";
}

TEST(WaypointHand, TakesTheInstrumentOfAMoveBeforeItAndHoldsThePedalThrough) {
  using enum InstrumentKind;
  const HandScript script = parse_hand_script(
      "name = \"hook\"\nkind = \"waypoints\"\n"
      "[[move]]\nto_mm = [0, 0, 0]\nseconds = 0.2\n"
      "[[move]]\nto_mm = [0, 0, 10]\nseconds = 0.5\ninstrument = \"hook\"\npedal = true\n"
      "[[move]]\nto_mm = [0, 0, 20]\nseconds = 0.2\n",
      "hook.toml");
  const auto hand = make_hand(script, 1);
  const std::array<InstrumentKind, 3> list{kGrasper, kScissors, kHook};
  std::size_t in_hand = 0;
  int presses = 0, with_pedal = 0;
  bool pressed = false, exchanged_in_move = false;
  double highest_before_hook = 0, z_m = 0;
  for (int k = 0; k < 3000; ++k) {
    Percept percept = ready_at(Vec3::Zero());
    percept.instrument = list[in_hand];
    const HandIntent intent = hand->update(percept, kDt);
    if (intent.exchange && !pressed) in_hand = (in_hand + 1) % list.size(), ++presses;
    pressed = intent.exchange;
    with_pedal += intent.pedal;
    z_m = intent.X_TI.p.z();
    exchanged_in_move |= intent.exchange && z_m > 0;
    if (list[in_hand] != kHook) highest_before_hook = std::max(highest_before_hook, z_m);
  }
  EXPECT_EQ(presses, 2);
  EXPECT_EQ(list[in_hand], kHook) << "and stays in hand";
  EXPECT_EQ(highest_before_hook, 0);
  EXPECT_FALSE(exchanged_in_move);
  EXPECT_NEAR(with_pedal, 500, 2);
  EXPECT_NEAR(z_m, 0.020, 1e-12);
}

TEST(WaypointHand, GoesOnWithoutAnInstrumentThatTheExerciseHasNot) {
  WaypointHand hand({{.to_m = {0, 0, 0.01}, .seconds = 0.1, .instrument = InstrumentKind::kHook}});
  HandIntent intent;
  int presses = 0;
  for (int k = 0; k < 8000; ++k) {
    const bool was = intent.exchange;
    intent = hand.update(ready_at(Vec3::Zero()), kDt);
    presses += intent.exchange && !was;
  }
  EXPECT_EQ(presses, 16);
  EXPECT_NEAR(intent.X_TI.p.z(), 0.01, 1e-12);
}

TEST(IdleHand, NeverMovesWhateverItSees) {
  HandScript script;
  const auto hand = make_hand(script, 1);
  const HandIntent first = hand->update(ready_at(Vec3(1, 2, 3)), kDt);
  Percept percept = ready_at(Vec3(4, 5, 6));
  percept.cue = Cue::kReach;
  percept.target_index = 0;
  for (int i = 0; i < 3000; ++i) {
    const HandIntent intent = hand->update(percept, kDt);
    ASSERT_EQ(intent.X_TI.p, first.X_TI.p);
    ASSERT_EQ(intent.jaw_opening_m, first.jaw_opening_m);
  }
}

TEST(SkilledHand, StaysWithTheStylusUntilTheDeviceIsReady) {
  HandSkill skill;
  skill.approach_speed_mps = 0.02;
  SkilledHand hand(skill, 1);
  Percept percept = ready_at(Vec3(0.1, 0, 0));
  percept.device_ready = false;
  percept.cue = Cue::kReach;
  percept.target_index = 0;
  percept.target_radius_m = 0.003;
  for (int i = 0; i < 2000; ++i) {
    const HandIntent intent = hand.update(percept, kDt);
    ASSERT_EQ(intent.X_TI.p, percept.tip_T);
    ASSERT_EQ(intent.X_TI.R, percept.R_TI);
  }
}

TEST(SkilledHand, PersonsDifferBySeedOnlyWhenAPopulationIsAskedFor) {
  HandSkill skill;
  skill.approach_speed_mps = 0.02;
  const auto travelled = [&](std::uint64_t seed, double cv) {
    skill.population_cv = cv;
    SkilledHand hand(skill, seed);
    Percept percept = ready_at(Vec3(0.1, 0, 0.05));
    percept.cue = Cue::kWait;
    percept.target_radius_m = 0.01;
    HandIntent intent;
    for (int i = 0; i < 500; ++i) intent = hand.update(percept, kDt);
    return (intent.X_TI.p - Vec3(0.1, 0, 0.05)).norm();
  };
  EXPECT_EQ(travelled(1, 0), travelled(2, 0)) << "no spread, no noise: the same person";
  EXPECT_NE(travelled(1, 0.2), travelled(2, 0.2));
  EXPECT_EQ(travelled(1, 0.2), travelled(1, 0.2));
}

/// The next cue comes with the instrument: the one that is slow to notice it must not exchange that again.
TEST(SkilledHand, PressesTheExchangeSwitchOnlyUntilTheInstrumentIsSeenInHand) {
  HandSkill skill;
  skill.approach_speed_mps = 0.02;
  skill.pause_s = 1;
  SkilledHand hand(skill, 1);
  Percept percept = ready_at(Vec3(0, 0, 0.05));
  percept.cue = Cue::kExchange;
  percept.target_index = 0;
  percept.target_radius_m = 0.01;
  percept.instrument = InstrumentKind::kGrasper;
  percept.asked_instrument = InstrumentKind::kHook;
  int presses = 0;
  bool pressed = false;
  for (int i = 0; i < 6000; ++i) {
    const HandIntent intent = hand.update(percept, kDt);
    presses += intent.exchange && !pressed;
    pressed = intent.exchange;
    if (presses == 0) continue;
    percept.instrument = InstrumentKind::kHook;
    percept.asked_instrument.reset();
    percept.cue = Cue::kHook;
  }
  EXPECT_EQ(presses, 1);
}

}  // namespace
}  // namespace trocar::hand_parts_test
