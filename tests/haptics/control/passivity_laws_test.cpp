// The passivity laws side by side: what each does by its definition, and what all do on the same wall.
#include <gtest/gtest.h>

#include "tests/haptics/contact/one_axis_rig.h"

namespace trocar::passivity_laws_test {
namespace {

using test::OneAxisCase;
using test::OneAxisResult;
using test::OneAxisRig;
using test::Random;
using test::spring;

PassivityParameters with(PassivityLaw law) {
  PassivityParameters p;
  p.law = law;
  return p;
}

TEST(PassivityLaws, NamesLeadBackToTheirLaws) {
  for (const PassivityLawName& known : kPassivityLaws) {
    EXPECT_EQ(passivity_law_named(known.name), known.law);
    EXPECT_STREQ(passivity_law_name(known.law), known.name);
  }
  EXPECT_FALSE(passivity_law_named("cap")) << "a law of comparison is none of the loop's";
}

TEST(PassivityLaws, IncrementBoundingNeverStoresMoreThanMotionAndFrictionBrought) {
  const PassivityParameters p = with(PassivityLaw::kIncrement);
  const double b = 0.3, kappa = 2 * b / p.period_s;
  PassivityParameters no_delay = p;
  no_delay.delay_s = no_delay.finest_hold_s = 0;  // kappa = 2 b / T, the case that is proven
  PassivityController increment(no_delay);
  Random random(2);
  double x = 0.001, held = 0;
  for (int k = 0; k < 100000; ++k) {
    const double dx = std::max(-x, random.symmetric(4e-4));
    x = std::min(x + dx, 0.01);
    const double force = increment.update(spring(2000, x, dx, held));
    const double brought = held * dx + b * dx * dx / p.period_s;
    EXPECT_GE(brought, (force * force - held * held) / (2 * kappa) - 1e-12) << "step " << k;
    EXPECT_LE(force, 2000 * x + 1e-12);
    held = force;
  }
}

TEST(PassivityLaws, ACountThatFlickersAtRestMovesTheForceLittle) {
  PassivityController budgeted(with(PassivityLaw::kBudgeted));
  double low = 1e9, high = 0;
  for (int i = 0; i < 3000; ++i) {
    const double depth = 0.004 + (i % 7 < 3 ? 0.15e-3 : 0);
    ContactWork work = spring(750, depth, 0, 0);
    const double force = budgeted.update(work);
    if (i < 2000) continue;
    low = std::min(low, force);
    high = std::max(high, force);
  }
  EXPECT_GT(low, 0.5);
  EXPECT_LT(high - low, 0.08) << "750 N/m times a count are 0.11 N";
}

TEST(PassivityLaws, OnTheWallOfScenario1) {
  const auto press = [](PassivityLaw law) {
    OneAxisCase c;
    c.law.law = law;
    c.delay_periods = 10;
    c.law.delay_s = 0.010;
    return OneAxisRig(c).run();
  };
  EXPECT_GT(press(PassivityLaw::kOff).settled_at_s, 2.5);
  for (const PassivityLaw law : {PassivityLaw::kIncrement, PassivityLaw::kBudgeted}) {
    EXPECT_LT(press(law).settled_at_s, 1.2) << passivity_law_name(law);
    EXPECT_GT(press(law).least_true_j, -9e-3) << passivity_law_name(law) << ", reference: -4 to -9 mJ";
  }
  EXPECT_LT(press(PassivityLaw::kIncrement).displayed, press(PassivityLaw::kBudgeted).displayed);
}

}  // namespace
}  // namespace trocar::passivity_laws_test
