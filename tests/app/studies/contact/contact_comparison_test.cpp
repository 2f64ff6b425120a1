// Desired beside measured on a recording that is made up, so that every answer is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/studies/contact/contact_comparison.h"

namespace trocar::contact_comparison_test {
namespace {

constexpr double kLag = 0.15;

/// Two presses, 1 to 3 s and 5 to 7 s, the second the other way.
double press(double t) {
  const auto shape = [](double s) { return s <= 0 || s >= 2 ? 0 : std::min(1.0, 4 * std::min(s, 2 - s)); };
  return shape(t - 1) - shape(t - 5);
}

Wrench wrench(double size) {
  Wrench w;
  w.force = size * Vec3(0.3, -0.4, 0);
  w.moment = size * Vec3(0, 0, 0.05);
  return w;
}

ContactRecording made_up(double gain) {
  ContactRecording r;
  for (int i = 0; i < 8000; ++i) {
    r.t.push_back(1e-3 * i);
    r.desired.push_back(wrench(press(r.t.back())));
    r.printed_moment.push_back(-r.desired.back().moment);
    r.rendered_n.push_back(r.desired.back().force.norm());
  }
  for (int i = 6; i < 320; ++i) {
    r.sensor_t.push_back(0.025 * i);
    r.measured.push_back(wrench(gain * press(0.025 * i - kLag)));
  }
  r.read = r.measured;
  return r;
}

TEST(ContactComparison, FindsContactsLagAndGainOfEachComponent) {
  const ContactRecording r = made_up(1.2);
  for (const Component which : {Component::kFx, Component::kFy, Component::kMz}) {
    const ComponentComparison c = compare(r, which);
    ASSERT_EQ(c.touched.size(), 2u);
    EXPECT_EQ(c.asked.size(), 2u);
    EXPECT_EQ(c.felt.size(), 2u);
    EXPECT_NEAR(c.touched[0].from_s, 1.005, 0.002) << "2 % of the peak on a slope of 0.25 s";
    EXPECT_NEAR(c.touched[1].to_s, 6.995, 0.002);
    EXPECT_NEAR(c.felt[0].from_s - c.asked[0].from_s, kLag, 0.025);
    EXPECT_NEAR(c.lag_s, kLag, 0.002);
    EXPECT_NEAR(c.ratio, 1.2, 1e-3);
  }
}

TEST(ContactComparison, AComponentThatIsNeverAskedForHasNoContacts) {
  const ComponentComparison c = compare(made_up(1), Component::kMx);
  EXPECT_TRUE(c.touched.empty());
  EXPECT_TRUE(c.asked.empty());
  EXPECT_EQ(c.ratio, 0);
}

TEST(ContactComparison, MeansAreTakenWithinTheContactAndBehindByTheLag) {
  const MeanWrenches m = mean_wrenches(made_up(2), {1.05, 2.95});
  EXPECT_NEAR((m.desired.force - Vec3(0.3, -0.4, 0)).norm(), 0, 1e-3);
  EXPECT_NEAR((m.measured.force - Vec3(0.6, -0.8, 0)).norm(), 0, 0.01);
  EXPECT_NEAR(m.measured.moment.z(), 0.1, 0.002);
}

TEST(ContactComparison, OnlyUnrestInTheHoldCounts) {
  ContactExperiment e;
  e.moves = {{0.8, 1.2, {}}, {1.8, 2.0, {}}, {2.7, 3.2, {}}};
  const std::vector<Spell> touched{{1.0, 3.0}};
  ContactRecording r = made_up(1);
  const auto shake = [&](double from, double to) {
    for (std::size_t i = 0; i < r.t.size(); ++i) {
      if (r.t[i] > from && r.t[i] < to) r.rendered_n[i] += 0.3 * std::sin(2 * std::numbers::pi * 40 * r.t[i]);
    }
  };
  EXPECT_NEAR(late_unrest(e, r, touched), 0, 0.01);
  shake(1.0, 1.4);
  EXPECT_LT(late_unrest(e, r, touched), 0.01) << "earlier than 0.5 s after touch";
  shake(2.8, 2.95);
  EXPECT_LT(late_unrest(e, r, touched), 0.01) << "the hand is leaving";
  shake(2.0, 2.3);
  EXPECT_NEAR(late_unrest(e, r, touched), 0.3, 0.02);
}

TEST(ContactComparison, MannersDifferInWhatTheThesisHadAndTrocarHas) {
  EXPECT_EQ(soft_manner().setting.law, PassivityLaw::kOff);
  EXPECT_EQ(thesis_manner().setting.gain, 5);
  EXPECT_FALSE(thesis_manner().setting.compensation);
  EXPECT_EQ(stiff_manner().setting.law, PassivityLaw::kBudgeted);
  EXPECT_EQ(stiff_manner().setting.stiffness, 150);
  for (const ContactManner& manner : {soft_manner(), thesis_manner(), stiff_manner()}) {
    EXPECT_EQ(manner.setting.fixture_kg, kFixtureKg);
  }
}

TEST(ContactComparison, TheQuickFormHasOneTrialAndTheFullOneTen) {
  EXPECT_EQ(trial_seeds({true, 7}), (std::vector<std::uint64_t>{7}));
  EXPECT_EQ(trial_seeds({false, 7}), (std::vector<std::uint64_t>{7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
}

TEST(ContactComparison, CurvesCarryTheirUnits) {
  const ContactRecording r = made_up(1);
  const StudyCurves forces = component_curves("f", "title", r.t, r.desired, {Component::kFx, Component::kFy});
  EXPECT_EQ(forces.y_label, "force, N");
  ASSERT_EQ(forces.series.size(), 2u);
  EXPECT_EQ(forces.series[1].name, "force along Y6");
  EXPECT_EQ(forces.series[1].y.size(), forces.x.size());
  EXPECT_EQ(component_curves("f", "title", r.t, r.desired, {Component::kMz}).y_label, "torque, N m");
}

TEST(ContactComparison, TheOverlayHasBothAtTheTimesOfTheReadings) {
  const ContactRecording r = made_up(1.5);
  const StudyCurves c = overlay_curves("f", "title", r, Component::kMz);
  EXPECT_EQ(c.x, r.sensor_t);
  EXPECT_EQ(c.y_label, "torque about Z6, N m");
  ASSERT_EQ(c.series.size(), 2u);
  EXPECT_EQ(c.series[1].name, "desired");
  const std::size_t at = 74;  // 2.0 s, in the middle of the first press
  EXPECT_NEAR(c.x[at], 2.0, 1e-9);
  EXPECT_NEAR(c.series[0].y[at], 0.075, 1e-9);
  EXPECT_NEAR(c.series[1].y[at], 0.05, 1e-9);
}

}  // namespace
}  // namespace trocar::contact_comparison_test
