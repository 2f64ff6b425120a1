// The passivity laws side by side: what each does by its definition, and what all do on the same wall.
#include <gtest/gtest.h>

#include "tests/haptics/contact/one_axis_rig.h"

namespace trocar::passivity_laws_test {
namespace {

using test::OneAxisCase;
using test::OneAxisResult;
using test::OneAxisRig;
using test::Random;

PassivityParameters with(PassivityLaw law) {
  PassivityParameters p;
  p.law = law;
  return p;
}

/// Spring of stiffness k pressed to depth x, moved by dx in the last period while `held` newtons acted.
ContactWork spring(double k, double x, double dx, double held) {
  ContactWork work;
  work.wanted_n = k * x;
  work.absorbed_j = held * dx;
  work.dx_m = dx;
  work.speed_m_s = dx / 1e-3;
  work.stored_j = 0.5 * k * x * x;
  work.stiffness = k;
  return work;
}

TEST(PassivityLaws, NamesLeadBackToTheirLaws) {
  for (const PassivityLawName& known : kPassivityLaws) {
    EXPECT_EQ(passivity_law_named(known.name), known.law);
    EXPECT_STREQ(passivity_law_name(known.law), known.name);
  }
  EXPECT_FALSE(passivity_law_named("colgate"));
}

TEST(PassivityLaws, TheThesisLawNeverActsOnASpring) {
  PassivityController thesis(with(PassivityLaw::kThesis));
  Random random(1);
  double x = 0;
  for (int k = 0; k < 100000; ++k) {
    const double dx = std::max(-x, random.symmetric(3e-4));
    x = std::min(x + dx, 0.02);
    const ContactWork work = spring(400, x, dx, 400 * x);
    EXPECT_EQ(thesis.update(work), work.wanted_n);
  }
  EXPECT_FALSE(thesis.debt_fault());
}

TEST(PassivityLaws, WhereTheThesisLawActsItTakesAllForceInOneTick) {
  PassivityController thesis(with(PassivityLaw::kThesis));
  ContactWork work;
  work.wanted_n = 1;
  work.dx_m = -1e-4;  // leaves while the force is not that of a spring
  EXPECT_NEAR(thesis.update(work), 0, 1e-12) << "alpha v = -W / (T v) = -f: from 1 N to nothing";
}

TEST(PassivityLaws, CapShowsASpringOfKappa) {
  const PassivityParameters p = with(PassivityLaw::kCap);
  const double kappa = p.viscous_n_s_per_m / (p.period_s / 2 + p.delay_s);
  PassivityController cap(p);
  EXPECT_NEAR(cap.update(spring(1000, 0.004, 0, 0)), kappa * 0.004, 1e-12);
  EXPECT_NEAR(cap.update(spring(kappa / 2, 0.004, 0, 0)), kappa / 2 * 0.004, 1e-12) << "softer ones as they are";
}

TEST(PassivityLaws, IncrementBoundingNeverStoresMoreThanMotionAndFrictionBrought) {
  const PassivityParameters p = with(PassivityLaw::kIncrement);
  const double b = p.viscous_n_s_per_m, kappa = 2 * b / p.period_s;
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

TEST(PassivityLaws, ReferenceKeepsTheSpringAndAddsBoundedDamping) {
  const PassivityParameters p = with(PassivityLaw::kReference);
  PassivityController reference(p);
  for (int k = 0; k < 20; ++k) reference.update(spring(500, 0.004, -1e-5, 2));  // into debt
  double last = 0;
  for (int k = 0; k < 50; ++k) {
    const ContactWork work = spring(500, 0.004, 5e-5, 0);
    const double force = reference.update(work);
    EXPECT_GE(force, work.wanted_n);
    EXPECT_LE(force - last, (k == 0 ? work.wanted_n : 0) + p.damping_n_per_s * p.period_s + 1e-12) << "no blow";
    last = force;
  }
  EXPECT_GT(last, spring(500, 0.004, 0, 0).wanted_n) << "it does damp";
}

/// A controller in debt whose stylus has come to rest 4 mm deep.
PassivityController at_rest_in_debt(double k) {
  PassivityController budgeted(with(PassivityLaw::kBudgeted));
  double x = 0;
  for (int i = 0; i < 40; ++i) {  // pressed in while nothing had acted yet: nothing was absorbed
    x += 1e-4;
    budgeted.update(spring(k, x, 1e-4, 0));
  }
  for (int i = 0; i < 60; ++i) budgeted.update(spring(k, x, 0, 0));
  return budgeted;
}

TEST(PassivityLaws, AtRestTheForceReturnsSlowlyAndUnpaid) {
  PassivityController budgeted = at_rest_in_debt(280);
  const PassivityParameters p;
  double last = budgeted.update(spring(280, 0.004, 0, 0));
  ASSERT_LT(last, 1.0) << "the law had taken away";
  for (int i = 0; i < 600; ++i) {
    const double force = budgeted.update(spring(280, 0.004, 0, 0));
    EXPECT_LE(force - last, p.rest_recovery_n_per_s * p.period_s + 1e-12);
    EXPECT_GE(force, last - 1e-12);
    last = force;
  }
  EXPECT_NEAR(last, 280 * 0.004, 1e-9);
}

TEST(PassivityLaws, WhatReturnsAtRestStopsAtTheRestStiffness) {
  PassivityController budgeted = at_rest_in_debt(1200);
  double force = 0;
  for (int i = 0; i < 5000; ++i) force = budgeted.update(spring(1200, 0.004, 0, 0));
  EXPECT_LE(force, 300 * 0.004 + 1e-9);
}

TEST(PassivityLaws, ACountThatFlickersAtRestMovesTheForceLittle) {
  PassivityController budgeted(with(PassivityLaw::kBudgeted));
  double low = 1e9, high = 0;
  for (int i = 0; i < 3000; ++i) {
    const double depth = 0.004 + (i % 7 < 3 ? 0.15e-3 : 0);
    ContactWork work = spring(750, depth, 0, 0);
    work.count_m = 0.15e-3;
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
  const OneAxisResult off = press(PassivityLaw::kOff), thesis = press(PassivityLaw::kThesis);
  EXPECT_GT(off.settled_at_s, 2.5);
  EXPECT_EQ(thesis.settled_at_s, off.settled_at_s) << "reference: identical to off in 100 of 100 runs";
  EXPECT_EQ(thesis.least_true_j, off.least_true_j);
  for (const PassivityLaw law : {PassivityLaw::kIncrement, PassivityLaw::kCap, PassivityLaw::kBudgeted}) {
    EXPECT_LT(press(law).settled_at_s, 1.2) << passivity_law_name(law);
    EXPECT_GT(press(law).least_true_j, -9e-3) << passivity_law_name(law) << ", reference: -4 to -9 mJ";
  }
  EXPECT_LT(press(PassivityLaw::kIncrement).displayed, press(PassivityLaw::kBudgeted).displayed);
}

}  // namespace
}  // namespace trocar::passivity_laws_test
