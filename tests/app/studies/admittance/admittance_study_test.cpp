// The simulated admittance device, one press with it, and the study that compares the laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "app/studies/admittance/admittance_study.h"

namespace trocar::admittance_study_test {
namespace {

constexpr double kDt = 50e-6;

HandParameters no_hand() {
  HandParameters hand;
  hand.grip_stiffness = hand.grip_damping = 0;
  return hand;
}

AdmittanceCase calm() {
  AdmittanceCase c;
  c.mass_kg = 1;
  c.delay_periods = 1;
  c.servo_hz = 40;
  c.wall_damping = 0.4;
  c.speed_m_s = 0.2;
  return c;
}

AdmittanceCase wild() {
  AdmittanceCase c = calm();
  c.mass_kg = 0.15;
  c.delay_periods = 6;
  c.servo_hz = 25;
  return c;
}

TEST(AdmittanceDevice, FollowsAWantedVelocityWithTheLagOfItsServo) {
  AdmittanceDevice device({}, no_hand(), 1);
  const double w = 2 * std::numbers::pi * 2, lag = 1 / (2 * std::numbers::pi * 30);
  double cos_sum = 0, sin_sum = 0;
  for (int k = 0; k < 40000; ++k) {  // four periods of 2 Hz
    const double t = k * kDt;
    device.step(0.2 * std::sin(w * t), 0, kDt);
    if (k < 10000) continue;
    sin_sum += device.speed_m_s() * std::sin(w * t), cos_sum += device.speed_m_s() * std::cos(w * t);
  }
  const double late = std::atan2(-cos_sum, sin_sum) / w;
  EXPECT_LT(late, lag) << "the PI is better than a first-order loop at low frequency";
  EXPECT_GT(late, -0.2e-3);
  EXPECT_NEAR(std::hypot(sin_sum, cos_sum) * 2 / 30000, 0.2, 0.01);
}

TEST(AdmittanceDevice, IsStiffAgainstTheHandWhileItHoldsStill) {
  HandParameters hand = hand_parameters(GripPreset::kFirm);
  AdmittanceDevice device({}, hand, 1);
  for (int k = 0; k < 60000; ++k) device.step(0, 0.05, kDt);
  const AdmittanceDeviceParameters p;
  const double w = 2 * std::numbers::pi * p.servo_hz;
  EXPECT_GT(device.force_n(), 1);
  EXPECT_NEAR(device.force_n() / device.position_m(), p.slide_kg * w * w / 4, 0.1 * p.slide_kg * w * w / 4)
      << "M w^2 / 4 of the integral part; friction holds a little of it";
}

TEST(AdmittanceDevice, GivenEnergyIsForceTimesWay) {
  AdmittanceDevice device({}, hand_parameters(GripPreset::kNormal), 1);
  double sum = 0, last = 0;
  for (int k = 0; k < 20000; ++k) {
    device.step(0.1 * std::sin(k * kDt * 9), 0.02, kDt);
    sum += device.force_n() * (device.position_m() - last);
    last = device.position_m();
  }
  EXPECT_NEAR(device.given_j(), sum, 1e-9);
}

TEST(AdmittanceDevice, SeesWholeCountsAndAForceThatLags) {
  AdmittanceDevice device({}, hand_parameters(GripPreset::kFirm), 3);
  for (int k = 0; k < 4000; ++k) {
    device.step(0.05, 0.05, kDt);
    EXPECT_LE(device.encoder_m(), device.position_m());
    EXPECT_GT(device.encoder_m(), device.position_m() - 10.001e-6);
  }
  double sum = 0, squares = 0;
  AdmittanceDevice still({}, no_hand(), 4);
  for (int k = 0; k < 4000; ++k) {
    const double f = still.measured_n();
    EXPECT_NEAR(f / 0.01, std::round(f / 0.01), 1e-6);
    sum += f, squares += f * f;
  }
  EXPECT_NEAR(sum / 4000, 0, 1.5e-3);
  EXPECT_NEAR(std::sqrt(squares / 4000), 0.02, 2e-3);
}

TEST(AdmittanceTrial, AHeavyMassNeedsNoLaw) {
  const AdmittanceOutcome off = press(calm(), ParallelLaw::kOff), on = press(calm(), ParallelLaw::kBudgeted);
  EXPECT_TRUE(off.stable()) << off.settled_s;
  EXPECT_TRUE(on.stable()) << on.settled_s;
  EXPECT_NEAR(off.felt_mass_kg, 1, 0.15);
  EXPECT_NEAR(off.shown_n_per_m, 1000, 150) << "the drive's own 32 kN/m stand in series";
  EXPECT_GT(off.least_j, -1e-3);
}

TEST(AdmittanceTrial, ASmallMassWithAStiffHandAndDelaySwingsWithoutTheLaw) {
  const AdmittanceOutcome off = press(wild(), ParallelLaw::kOff);
  EXPECT_FALSE(off.stable());
  EXPECT_LT(off.least_j, -1.0) << "joules out of nothing";
  AdmittanceCase soft = wild();
  soft.hand = hand_parameters(GripPreset::kFingertip);
  EXPECT_TRUE(press(soft, ParallelLaw::kOff).stable()) << "it takes a stiff hand";
  AdmittanceCase prompt = wild();
  prompt.delay_periods = 0;
  prompt.servo_hz = 200;
  EXPECT_TRUE(press(prompt, ParallelLaw::kOff).stable()) << "and a lag";
}

TEST(AdmittanceTrial, TheThesisFormIsTheLawSwitchedOff) {
  const AdmittanceOutcome off = press(wild(), ParallelLaw::kOff);
  for (const ParallelLaw law : {ParallelLaw::kThesis, ParallelLaw::kMended}) {
    const AdmittanceOutcome thesis = press(wild(), law);
    EXPECT_EQ(thesis.trace.force_n, off.trace.force_n) << parallel_law_name(law);
    EXPECT_EQ(thesis.active_share, 0);
  }
}

TEST(AdmittanceTrial, TheBudgetedLawSettlesItAndStaysPassive) {
  const AdmittanceOutcome on = press(wild(), ParallelLaw::kBudgeted);
  EXPECT_TRUE(on.stable()) << on.settled_s;
  EXPECT_GT(on.least_j, -5e-3);
  EXPECT_LT(on.observer_gap_j, 10e-3);
}

TEST(AdmittanceTrial, SamePressSameBytes) {
  const AdmittanceOutcome a = press(wild(), ParallelLaw::kBudgeted), b = press(wild(), ParallelLaw::kBudgeted);
  EXPECT_EQ(a.trace.position_m, b.trace.position_m);
  AdmittanceCase other = wild();
  other.noise_seed = 2;
  EXPECT_NE(press(other, ParallelLaw::kBudgeted).trace.position_m, a.trace.position_m);
}

TEST(AdmittanceGrid, HasEveryMassDelayAndGripOnceAndIsDrawnBySeed) {
  const std::vector<AdmittanceCase> cases = admittance_cases(1, 1), again = admittance_cases(1, 1),
                                    other = admittance_cases(2, 1);
  ASSERT_EQ(cases.size(), 100u);
  std::set<std::tuple<double, int, GripPreset>> seen;
  int same = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    seen.insert({cases[i].mass_kg, cases[i].delay_periods, cases[i].grip});
    EXPECT_EQ(cases[i].hand.grip_stiffness, again[i].hand.grip_stiffness);
    same += cases[i].hand.grip_stiffness == other[i].hand.grip_stiffness;
  }
  EXPECT_EQ(seen.size(), 100u);
  EXPECT_EQ(same, 0);
  EXPECT_EQ(admittance_cases(1, 10).size(), 10u);
}

TEST(AdmittanceStudy, QuickFormShowsTheInstabilityAndTheCure) {
  const StudyResult study = admittance_study({true, 1});
  const auto find = [&](const std::string& start) -> const StudyCase& {
    return *std::find_if(study.cases.begin(), study.cases.end(),
                         [&](const StudyCase& c) { return c.name.rfind(start, 0) == 0; });
  };
  for (const char* name : {"one press: law off", "one press: budgeted", "smallest virtual mass",
                           "grid: stable with the budgeted", "grid: least energy"}) {
    EXPECT_TRUE(find(name).met) << name << ' ' << find(name).value;
    EXPECT_FALSE(find(name).definition.empty());
  }
  for (const StudyCase& c : study.cases) EXPECT_TRUE(std::isfinite(c.value)) << c.name;
  EXPECT_EQ(study.curves.size(), 3u);
  ASSERT_EQ(study.files.size(), 2u);
  EXPECT_EQ(std::count(study.files[0].bytes.begin(), study.files[0].bytes.end(), '\n'), 1 + 10 * 6);
  EXPECT_EQ(admittance_study({true, 1}).files[0].bytes, study.files[0].bytes) << "same seed, same bytes";
}

}  // namespace
}  // namespace trocar::admittance_study_test
