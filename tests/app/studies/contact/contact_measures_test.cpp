// Measures of the contact studies on curves whose answer is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "app/studies/contact/contact_measures.h"

namespace trocar::contact_measures_test {
namespace {

/// f sampled every `step` from 0 to `end`.
template <class F>
Curve sampled(double step, double end, F f) {
  Curve curve;
  for (int i = 0; i * step <= end + 1e-9; ++i) {
    curve.t.push_back(i * step);
    curve.y.push_back(f(i * step));
  }
  return curve;
}

/// Smooth press of height 1 from 1 to 2 s.
double bump(double t) {
  const double s = t - 1;
  return s <= 0 || s >= 1 ? 0 : 0.5 * (1 - std::cos(2 * std::numbers::pi * s));
}

TEST(ContactMeasures, SpellsAreWhereTheCurveIsAboveTheThresholdOnEitherSide) {
  const Curve curve = sampled(0.01, 10, [](double t) { return t > 2 && t < 3 ? 1.0 : t > 5 && t < 7 ? -1.0 : 0.1; });
  const auto found = spells(curve, 0.5, 0.2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].from_s, 2.01, 0.011);
  EXPECT_NEAR(found[0].to_s, 2.99, 0.011);
  EXPECT_NEAR(found[1].from_s, 5.01, 0.011);
  EXPECT_NEAR(found[1].to_s, 6.99, 0.011);
}

TEST(ContactMeasures, AShortGapIsBridgedAndAShortSpellIsNoContact) {
  const auto with_gap = [](double gap) {
    return sampled(0.01, 10, [=](double t) { return t > 2 && t < 4 && std::abs(t - 3) > gap / 2 ? 1.0 : 0.0; });
  };
  EXPECT_EQ(spells(with_gap(0.1), 0.5, 0.2).size(), 1u);
  EXPECT_EQ(spells(with_gap(0.4), 0.5, 0.2).size(), 2u);
  const Curve spike = sampled(0.01, 10, [](double t) { return std::abs(t - 3) < 0.03 ? 5.0 : 0.0; });
  EXPECT_TRUE(spells(spike, 0.5, 0.2).empty());
  EXPECT_TRUE(spells({}, 0.5, 0.2).empty());
}

TEST(ContactMeasures, PeakKnowsNoSign) {
  EXPECT_EQ(peak({{0, 1, 2}, {0.5, -2, 1}}), 2);
  EXPECT_EQ(peak({}), 0);
}

TEST(ContactMeasures, ValuesBetweenSamplesLieOnTheLineAndBeyondTheEndsAreHeld) {
  const Curve curve{{1, 2, 4}, {10, 20, 0}};
  EXPECT_DOUBLE_EQ(value_at(curve, 1.5), 15);
  EXPECT_DOUBLE_EQ(value_at(curve, 3), 10);
  EXPECT_DOUBLE_EQ(value_at(curve, 2), 20);
  EXPECT_DOUBLE_EQ(value_at(curve, 0), 10);
  EXPECT_DOUBLE_EQ(value_at(curve, 9), 0);
  EXPECT_THROW(value_at({}, 0), std::invalid_argument);
}

TEST(ContactMeasures, LagIsFoundBetweenTicksAndReadingsWhateverGainAndOffset) {
  const Curve desired = sampled(0.001, 4, bump);
  for (const double lag : {0.0, 0.05, 0.15, 0.31}) {
    for (const double gain : {1.0, 5.0}) {
      const Curve measured = sampled(0.025, 4, [&](double t) { return 0.3 + gain * bump(t - lag); });
      EXPECT_NEAR(best_lag(desired, measured, 0.4), lag, 0.0011) << "gain " << gain;
    }
  }
}

TEST(ContactMeasures, FrictionThatTurnsWithTheMotionMakesTheMeasuredForceLead) {
  // Pressing in friction adds, drawing back it takes away: the reason of the studies' short lags on soft walls.
  const Curve desired = sampled(0.001, 4, bump);
  const Curve measured = sampled(0.025, 4, [](double t) {
    const double rising = bump(t - 0.149) - bump(t - 0.151);
    return bump(t - 0.15) + 0.15 * std::tanh(rising / 1e-4);
  });
  EXPECT_LT(best_lag(desired, measured, 0.4), 0.14);
  EXPECT_NEAR(magnitude_ratio(desired, measured, 0.15), 1, 0.01) << "over press and return it adds nothing";
}

TEST(ContactMeasures, RatioIsTheGainAndItsSignIsKept) {
  const Curve desired = sampled(0.001, 4, bump);
  EXPECT_NEAR(magnitude_ratio(desired, sampled(0.025, 4, [](double t) { return 5 * bump(t - 0.15); }), 0.15), 5, 1e-6);
  EXPECT_NEAR(magnitude_ratio(desired, sampled(0.025, 4, [](double t) { return -bump(t); }), 0), -1, 1e-6);
  EXPECT_EQ(magnitude_ratio(sampled(0.001, 4, [](double) { return 0.0; }), desired, 0), 0);
}

TEST(ContactMeasures, MeanIsTakenWithinTheSpellOnly) {
  const Curve curve = sampled(0.1, 10, [](double t) { return t < 4.95 ? 100.0 : t < 6.05 ? 3.0 : -100.0; });
  EXPECT_DOUBLE_EQ(mean_over(curve, {5, 6}), 3);
  EXPECT_EQ(mean_over(curve, {20, 30}), 0);
}

TEST(ContactMeasures, UnrestIsBlindToSlowChangesAndSeesFastOnes) {
  const Spell all{0.5, 3.5};
  EXPECT_NEAR(unrest(sampled(0.001, 4, [](double t) { return 2 * t; }), all, 0.05), 0, 1e-9);
  const Curve fast = sampled(0.001, 4, [](double t) { return 3 + 0.2 * std::sin(2 * std::numbers::pi * 40 * t); });
  EXPECT_NEAR(unrest(fast, all, 0.05), 0.2, 0.01) << "two whole waves in the window: their mean is the level";
  const Curve step = sampled(0.001, 4, [](double t) { return t < 2 ? 0.0 : 1.0; });
  EXPECT_NEAR(unrest(step, all, 0.05), 0.5, 0.02);
  EXPECT_NEAR(unrest(step, {2.1, 3.5}, 0.05), 0, 1e-12) << "the step lies before the spell";
}

TEST(ContactMeasures, AngleBetweenVectors) {
  EXPECT_NEAR(angle_between(Vec3(1, 0, 0), Vec3(0, 3, 0)), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle_between(Vec3(1, 1, 0), Vec3(-2, -2, 0)), std::numbers::pi, 1e-15);
  EXPECT_NEAR(angle_between(Vec3(1, 0, 0), Vec3(1, 1e-8, 0)), 1e-8, 1e-16);
}

}  // namespace
}  // namespace trocar::contact_measures_test
