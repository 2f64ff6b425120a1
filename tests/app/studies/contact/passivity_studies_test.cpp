// The presses into a wall, the grid of laws and the Z-width ladder: that every law meets the same press, that energy
// and stability are what they are called, and what the studies write.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "app/studies/contact/hardware_study.h"
#include "app/studies/contact/passivity_grid.h"
#include "app/studies/contact/passivity_study.h"
#include "app/studies/contact/sensitivity_study.h"
#include "app/studies/contact/zwidth_study.h"
#include "app/studies/device/velocity_study.h"
#include "haptics/device/plant/plant_faults.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar::passivity_studies_test {
namespace {

constexpr double kTravel = 0.105;

/// Scenario S1 of the study: 150 N/m, 10 ms, fingertip grip.
const WallRig& slow_rig() {
  static const WallRig rig = [] {
    WallCase c;
    c.pose = near_home(kTravel);
    c.direction = -arm_state(c.pose).X_WS.R.col(1);
    c.device = nominal_device(GripPreset::kFingertip);
    c.device.extra_delay_periods = 9;
    c.speed = 0.46;
    return WallRig(c);
  }();
  return rig;
}

/// The same wall without further delay, normal grip.
const WallRig& quick_rig() {
  static const WallRig rig = [] {
    WallCase c = slow_rig().the_case();
    c.device = nominal_device();
    return WallRig(c);
  }();
  return rig;
}

const StudyCase* find(const StudyResult& study, const std::string& start) {
  for (const StudyCase& c : study.cases) {
    if (c.name.rfind(start, 0) == 0) return &c;
  }
  ADD_FAILURE() << "no case " << start;
  return nullptr;
}

TEST(WallTrial, TheStylusMeetsTheWallAtTheSpeedAskedFor) {
  const WallOutcome o = quick_rig().press({PassivityLaw::kOff}, 0.2);
  EXPECT_NEAR(o.touched_at_m_s, 0.46, 0.06 * 0.46) << "3 % of the search and a tick of braking";
  EXPECT_EQ(o.contacts, 1);
}

TEST(WallTrial, EveryPressBeginsInTheSameState) {
  const WallOutcome a = quick_rig().press({PassivityLaw::kBudgeted}, 0.3),
                    b = quick_rig().press({PassivityLaw::kBudgeted}, 0.3);
  EXPECT_EQ(a.trace.force_n, b.trace.force_n);
  EXPECT_EQ(a.trace.position_m, b.trace.position_m);
}

TEST(WallTrial, TheThesisLawIsTheLawSwitchedOff) {
  const WallOutcome off = slow_rig().press({PassivityLaw::kOff}, 1.0),
                    thesis = slow_rig().press({PassivityLaw::kOff, false, {}, 0, ComparisonLaw::kThesis}, 1.0);
  EXPECT_EQ(off.trace.force_n, thesis.trace.force_n);
  EXPECT_FALSE(off.stable());
  EXPECT_GT(off.contacts, 4);
}

TEST(WallTrial, TheDefaultLawSettlesScenario1) {
  const WallOutcome on = slow_rig().press({PassivityLaw::kBudgeted}, 1.5);
  EXPECT_TRUE(on.stable()) << on.settled_s;
  EXPECT_GT(on.displayed, 0.75);
  EXPECT_GT(on.least_net_j, -1e-3);
  EXPECT_LT(on.law_step_n, 0.1);
  EXPECT_LT(on.overclaimed_j, 1e-3) << "the account claims no more than there is";
}

TEST(WallTrial, TrueEnergyIsTheForceTimesTheWay) {
  const WallOutcome o = quick_rig().press({PassivityLaw::kOff}, 0.08);
  double sum = 0;
  const std::size_t held = 80;              // ticks until the hand sets out to leave
  for (std::size_t i = 2; i < held; ++i) {  // what tick i - 2 asked for acted until tick i
    sum += o.trace.force_n[i - 2] * (o.trace.position_m[i] - o.trace.position_m[i - 1]);
  }
  EXPECT_GT(sum, 5e-3);
  EXPECT_LT(o.trace.true_j[held - 1], sum) << "friction is fed forward";
  EXPECT_GT(o.trace.true_j[held - 1], 0.9 * sum) << "the ball's way aside does no work";
  EXPECT_LT(o.overclaimed_j, 1e-3);
}

TEST(WallTrial, TheClampWeakensTheWallToKMax) {
  const WallPress stiff{PassivityLaw::kOff, true, 750.0};
  const WallOutcome clamped = quick_rig().press(stiff, 1.0),
                    free = quick_rig().press({PassivityLaw::kOff, false, 750.0}, 1.0);
  EXPECT_TRUE(clamped.stable());
  EXPECT_LT(clamped.shown_stiffness, 1.2 * 60) << "K_max here is some 25 to 50 N/m";
  EXPECT_GT(free.shown_stiffness, 3 * clamped.shown_stiffness);
  EXPECT_GT(clamped.k_max, 5);
}

TEST(WallTrial, AGainThatTheLoopDoesNotKnowIsBeyondItsLaw) {
  WallCase c = slow_rig().the_case();
  c.gain = 5;
  c.compensated = false;
  c.device = nominal_device(GripPreset::kLight);
  c.device.extra_delay_periods = 5;
  EXPECT_FALSE(WallRig(c).press({PassivityLaw::kBudgeted}, 1.5).stable());
}

TEST(WallTrial, AWayOutOfTheWorkspaceIsRefused) {
  WallCase c = slow_rig().the_case();
  c.direction = -Vec3::UnitZ();  // home hangs at arm's length: no way down
  EXPECT_THROW(WallRig{c}, std::invalid_argument);
}

TEST(PlantBench, ThrowsWhenTheLoopFaults) {
  SimulatedDaqConfig device = nominal_device();
  InjectedFault jump;
  jump.kind = InjectedFaultKind::kEncoderJump;
  jump.at_s = 1.0;
  jump.channel = 2;
  jump.value = 1000;
  device.faults.push_back(jump);
  PlantBench bench(device, {});
  try {
    bench.start();
    FAIL() << "no fault";
  } catch (const BenchFault& fault) {
    EXPECT_NE(std::string(fault.what()).find("encoder-jump"), std::string::npos) << fault.what();
  }
}

TEST(WallTrial, WithoutALawTheHandIsFedAndFrictionOnlyTakes) {
  const WallOutcome o = slow_rig().press({PassivityLaw::kOff}, 0.3);
  const WallTrace& t = o.trace;
  ASSERT_GT(t.t.back(), 1.0);
  EXPECT_LT(o.least_net_j, -1e-3) << "law off at 10 ms of delay feeds the hand";
  EXPECT_GT(t.net_j.back() - t.true_j.back(), 1e-3) << "friction only takes";
  for (std::size_t i = 1; i < t.t.size(); ++i) {
    EXPECT_GE(t.net_j[i] - t.true_j[i], t.net_j[i - 1] - t.true_j[i - 1] - 1e-5);
  }
}

TEST(WallTrial, AnIdealWallPushesWithItsStiffnessAndNoHarderThanTheMotorsCan) {
  const WallOutcome ideal = quick_rig().press_ideal(0.4);
  double most = 0;
  for (std::size_t i = 0; i < ideal.trace.t.size(); ++i) {
    const double spring = 150 * std::max(0.0, ideal.trace.position_m[i]);
    EXPECT_LE(ideal.trace.force_n[i], spring + 1e-9);
    if (ideal.trace.force_n[i] < spring - 1e-9) most = std::max(most, ideal.trace.force_n[i]);
  }
  EXPECT_NEAR(ideal.displayed, 1, 1e-12);
  EXPECT_EQ(ideal.law_step_n, 0);
  EXPECT_LT(ideal.shaking_n, quick_rig().press({PassivityLaw::kOff}, 0.4).shaking_n);
  EXPECT_GT(most, 1.1) << "reference 2: 5 % of the workspace has less";
  EXPECT_LT(most, 2.25) << "and 5 % more";
}

TEST(WallTrial, WithoutALawTheForceStepsOnlyWithTheSpring) {
  EXPECT_LT(quick_rig().press({PassivityLaw::kOff}, 0.4).law_step_n, 0.01) << "no law";
}

TEST(PassivityGrid, HasEveryStiffnessDelayAndGripEquallyOftenOnComfortableWays) {
  const std::vector<DrawnPress> cases = grid_cases(1, 100, false);
  ASSERT_EQ(cases.size(), 100u);
  std::set<std::tuple<double, int, GripPreset>> seen;
  std::set<double> friction;
  for (const DrawnPress& c : cases) {
    seen.insert({c.wall.stiffness, c.wall.device.extra_delay_periods, c.grip});
    friction.insert(c.wall.device.plant->channel[0].friction.coulomb);
    EXPECT_GT(c.wall.device.plant->options.cable[0].stiffness, 40);
    EXPECT_GT(c.wall.device.hand.tremor_m, 0);
    EXPECT_TRUE(comfortable(c.wall.pose, c.wall.direction, press_travel(c.wall)));
    EXPECT_NEAR(c.wall.direction.norm(), 1, 1e-12);
  }
  EXPECT_EQ(seen.size(), 100u);
  EXPECT_EQ(friction.size(), 100u) << "an arm for each press";
  const WallCase nominal = grid_cases(1, 1, true).front().wall;
  EXPECT_EQ(nominal.device.plant->channel[0].friction.coulomb, nominal_parameters().channel[0].friction.coulomb);
  EXPECT_EQ(nominal.device.plant->options.cable[0].stiffness, 0);
}

TEST(PassivityGrid, TheSeedDrawsTheCasesWhateverTheirNumber) {
  const auto a = grid_cases(4, 40, false), b = grid_cases(4, 20, false), c = grid_cases(5, 20, false);
  for (std::size_t i = 0; i < b.size(); ++i) {
    EXPECT_EQ(a[i].wall.direction, b[i].wall.direction);
    EXPECT_EQ(a[i].wall.speed, b[i].wall.speed);
    EXPECT_NE(a[i].wall.speed, c[i].wall.speed);
  }
}

TEST(PassivityGrid, APressIsStableByItselfOrBesideTheIdealWall) {
  WallOutcome ours, ideal;
  ours.settled_s = 0.65, ours.late_contacts = 3;
  EXPECT_FALSE(stable_beside(ours, ideal));
  ideal.settled_s = 0.6, ideal.late_contacts = 3;
  EXPECT_TRUE(stable_beside(ours, ideal)) << "the hand's own swing";
  EXPECT_FALSE(ours.stable());
  ours.late_contacts = 4;
  EXPECT_FALSE(stable_beside(ours, ideal));
  ours = {}, ours.faulted = true;
  EXPECT_FALSE(stable_beside(ours, ideal));
}

TEST(PassivityGrid, TheLowerBoundIsWilsons) {
  EXPECT_NEAR(wilson_low(297, 300), 0.9710, 5e-4);
  EXPECT_NEAR(wilson_low(300, 300), 0.9874, 5e-4);
  EXPECT_EQ(wilson_low(0, 0), 0);
}

TEST(PassivityGrid, EveryTaskRunsOnceAndAFailureIsHeard) {
  std::vector<std::atomic<int>> ran(57);
  on_all_processors(ran.size(), [&](std::size_t i) { ++ran[i]; });
  EXPECT_TRUE(std::all_of(ran.begin(), ran.end(), [](const std::atomic<int>& n) { return n == 1; }));
  EXPECT_THROW(on_all_processors(9,
                                 [](std::size_t i) {
                                   if (i == 7) throw std::runtime_error("seven");
                                 }),
               std::runtime_error);
}

TEST(PassivityStudy, QuickFormMeetsWhatItAsksOfScenariosAndWritesEveryPress) {
  const StudyResult study = passivity_study({true, 1});
  for (const char* name :
       {"S1: law off, no reaction", "S1: thesis' law", "S1: budgeted", "S2: law off, no reaction", "S2: budgeted"}) {
    const StudyCase* c = find(study, name);
    ASSERT_NE(c, nullptr);
    EXPECT_TRUE(c->met) << c->name << ": " << c->value;
    EXPECT_FALSE(c->definition.empty());
  }
  for (const char* name : {"presses: stable with the default law", "presses: least net energy",
                           "settling above the ideal wall, median", "settling above the ideal wall, 95 %"}) {
    const StudyCase* c = find(study, name);
    ASSERT_NE(c, nullptr);
    EXPECT_TRUE(c->met) << c->name << ": " << c->value;
  }
  EXPECT_NE(study.plant.find("seed 1"), std::string::npos) << study.plant;
  ASSERT_EQ(study.files.size(), 3u);
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(lines(study.files[0].bytes), 1 + 4) << "four hands";
  EXPECT_EQ(lines(study.files[1].bytes), 1 + 5 * 7)
      << "five presses, three laws, three of others and one with the clamp";
  EXPECT_NE(study.files[2].bytes.find("| budgeted + clamp |"), std::string::npos);
  EXPECT_EQ(study.curves.size(), 5u);
  for (const StudyCurves& c : study.curves) EXPECT_LT(c.x.back(), 2.5) << "the way out is not drawn";
}

TEST(VelocityStudy, OrdersTheEstimatorsAsPublished) {
  const StudyResult study = velocity_study({});
  for (const StudyCase& c : study.cases) EXPECT_TRUE(c.met) << c.name << ' ' << c.value;
  const std::string& table = study.files.at(0).bytes;
  const auto value = [&](const std::string& row) {  // rms error of "motion,estimator"
    const std::size_t at = table.find(row + ',');
    EXPECT_NE(at, std::string::npos) << row;
    return std::stod(table.substr(at + row.size() + 1));
  };
  EXPECT_NEAR(value("12 Hz, 2 mm,backward"), 0.092, 0.023) << "haptics notes 1.9";
  EXPECT_LT(value("12 Hz, 2 mm,kalman"), value("12 Hz, 2 mm,foaw"));
  EXPECT_LT(value("creep at 10 mm/s,foaw"), value("creep at 10 mm/s,kalman"));
  EXPECT_LT(value("reach at 0.45 m/s,kalman"), value("reach at 0.45 m/s,average"));
  EXPECT_EQ(study.curves.size(), 3u);
}

TEST(SensitivityStudy, SaysWhatEveryDoubtfulNumberDoes) {
  const StudyResult study = sensitivity_study({true, 1});
  EXPECT_EQ(study.cases.size(), 1u + 3 * (1 + 2 * 7));
  const StudyCase* finer = find(study, "sub-steps half as long: verdicts that change");
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->value, 0);
  std::set<double> displayed;
  for (const StudyCase& c : study.cases) {
    if (c.name.ends_with("where the motors can")) displayed.insert(c.value);
    if (c.unit != "1" || !c.thesis) continue;
    EXPECT_TRUE(c.value >= 0 && c.value <= 1) << c.name;
  }
  EXPECT_GT(displayed.size(), 12u) << "each property makes a difference";
}

TEST(HardwareStudy, SaysWhatEdgeTimesAndPeakTorqueBring) {
  const StudyResult study = hardware_study({true, 1});
  const StudyCase *as_is = find(study, "as it is: force held"), *peak = find(study, "200 mN m: force held"),
                  *edges = find(study, "edge times: force held");
  ASSERT_TRUE(as_is && peak && edges);
  EXPECT_NE(peak->value, as_is->value);
  EXPECT_NE(edges->value, as_is->value);
  const StudyCase* within = find(study, "200 mN m: presses that the motors can give");
  ASSERT_TRUE(within && within->thesis);
  EXPECT_GE(within->value, *within->thesis);
  const StudyCase* given = find(study, "force in every direction at 200 mN m, median pose");
  ASSERT_TRUE(given && given->thesis);
  EXPECT_GT(given->value, 2 * *given->thesis) << "the weight is carried either way";
  const StudyCase* borne = find(study, "force in every direction at 200 mN m, borne by a motor that held 20 mN m");
  ASSERT_TRUE(borne);
  EXPECT_GT(borne->value, 0.5);
  EXPECT_LT(borne->value, 3) << "a peak is short";
}

TEST(ZWidthStudy, QuickFormClimbsTheLadder) {
  const StudyResult study = zwidth_study({true, 1});
  const StudyCase *off = find(study, "widest without damping, law off"),
                  *on = find(study, "widest without damping, default law");
  ASSERT_TRUE(off && on);
  EXPECT_GE(on->value, 75);
  EXPECT_GE(off->value, 75);
  const StudyCurves& curves = study.curves.at(0);
  EXPECT_EQ(curves.x, (std::vector<double>{0, 0.5, 1, 2, 4}));
  for (const auto& series : curves.series) EXPECT_EQ(series.y.size(), curves.x.size());
  std::istringstream table(study.files.at(0).bytes);
  std::string line;
  int rows = 0;
  while (std::getline(table, line)) rows += std::count(line.begin(), line.end(), ',') == 7;
  EXPECT_EQ(rows, 1 + 2 * 5);
}

}  // namespace
}  // namespace trocar::passivity_studies_test
