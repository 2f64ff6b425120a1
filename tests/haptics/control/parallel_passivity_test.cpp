// The parallel form for an admittance device: what the printed one does, what ours does, each against its definition.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numbers>
#include <stdexcept>

#include "haptics/control/parallel_passivity.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::parallel_passivity_test {
namespace {

using test::Random;
constexpr double kT = 1e-3;

ParallelParameters with(ParallelLaw law) {
  ParallelParameters p;
  p.law = law;
  return p;
}

/// No delay, no lag: what is asked for is made at once.
ParallelParameters ideal(ParallelLaw law) {
  ParallelParameters p = with(law);
  p.delay_periods = 0;
  p.servo_lag_s = p.sensor_lag_s = 0;
  return p;
}

ParallelWork work(double v, double f, double moved, double stored = 0, double mass = 1) {
  return {v, f, moved, stored, mass};
}

/// An environment that gives energy: velocity against the force in every second tick.
struct Active {
  Random random{7};
  double f = 0, v = 0;
  void step() {
    f = random.between(0.5, 3);
    v = random.between(-0.3, 0.1);
  }
};

// --- the thesis' equations (docs/thesis_errata.md) ---

TEST(ThesisErrata, Eq421AndEq424HoldTogetherOnlyWithoutAController) {
  // (4.21) v2 = v1 - f/alpha gives v1 = v2 + f/alpha; (4.24) prints v1 = v2 - f/alpha.
  const double v2 = 0.1, f = 2, by_alpha = 0.05;
  const double from_421 = v2 + f * by_alpha, from_424 = v2 - f * by_alpha;
  EXPECT_NEAR(from_421 - from_424, 2 * f * by_alpha, 1e-15);
  ParallelPassivity printed(with(ParallelLaw::kThesis)), mended(with(ParallelLaw::kMended));
  const double a = printed.update(work(-0.1, 2, 0)), b = mended.update(work(-0.1, 2, 0));
  EXPECT_NEAR(a, -0.2, 1e-12) << "(4.24): W = -0.2, 1/alpha = 0.05, twice as fast against the hand";
  EXPECT_NEAR(b, 0, 1e-12) << "(4.21): held still";
}

TEST(ThesisErrata, Eq424AddsTheEnergyThatEq422CountsAsDissipated) {
  Active environment;
  ParallelPassivity printed(with(ParallelLaw::kThesis)), mended(with(ParallelLaw::kMended));
  double bare = 0, with_424 = 0, with_plus = 0;
  for (int k = 0; k < 2000; ++k) {
    environment.step();
    const ParallelWork now = work(environment.v, environment.f, 0);
    bare += kT * now.force_n * now.wanted_m_s;
    with_424 += kT * now.force_n * printed.update(now);
    with_plus += kT * now.force_n * mended.update(now);
    EXPECT_GE(with_plus, -1e-12) << "with the plus sign the port is passive at every tick, as (4.22) promises";
  }
  EXPECT_LT(bare, -0.1);
  EXPECT_NEAR(with_424, 2 * bare, 0.02 * std::abs(bare)) << "as printed it doubles what it should take away";
  EXPECT_GE(printed.energy_j(), -1e-12) << "while its own observer reports a passive port";
}

TEST(ThesisErrata, Eq422NeverSeesTheEnergyOfAVirtualMass) {
  // T sum f v = 1/2 m v^2 + 1/2 m sum(dv^2) for m dv = f T: never negative, whatever the hand does.
  ParallelPassivity thesis(with(ParallelLaw::kThesis));
  Random random(8);
  const double m = 0.3;
  double v = 0, squares = 0;
  for (int k = 0; k < 20000; ++k) {
    const double f = random.symmetric(5), dv = kT * f / m;
    v += dv;
    squares += 0.5 * m * dv * dv;
    EXPECT_EQ(thesis.update(work(v, f, 0)), v) << "it never acts";
    ASSERT_NEAR(thesis.energy_j(), 0.5 * m * v * v + squares, 1e-9);
  }
  EXPECT_EQ(thesis.min_energy_j(), 0);
}

TEST(ThesisErrata, TheExactObserverSeesIt) {
  // The same mass, made three periods late, under a force that swings at 10 Hz: each period gives
  // 1/2 F^2 / (m w) sin(w lag) T of energy. Lag: T v(k-3), made in (k-1, k), holds the forces up to k - 5/2.
  ParallelParameters p = ideal(ParallelLaw::kYield);
  p.yield_share = 0;  // observes only
  ParallelPassivity exact(p);
  const double m = 0.3, w = 2 * std::numbers::pi * 10, force = 2, seconds = 10;
  std::deque<double> late(3, 0.0);
  double v = 0;
  for (int k = 0; k * kT < seconds; ++k) {
    const double f = force * std::cos(w * k * kT);
    v += kT * f / m;
    late.push_back(v);
    exact.update(work(v, f, kT * late.front()));
    late.pop_front();
  }
  const double lag = 2 * kT;  // from k - 5/2 to k - 1/2
  EXPECT_NEAR(exact.energy_j(), -0.5 * force * force / (m * w) * std::sin(w * lag) * seconds, 0.01 * 0.133);
}

TEST(ThesisErrata, Eq423HasNoBoundWhereTheForceIsSmall) {
  // An environment that drives at 0.2 m/s against a force of a hundredth of a newton, noise of the sensor: 1/alpha =
  // v/f = 20 m/s per newton, and the whole velocity is switched off from one tick to the next. Ours stays out of it.
  ParallelPassivity mended(with(ParallelLaw::kMended)), ours(with(ParallelLaw::kYield));
  Random random(9);
  double largest = 0, conductance = 0;
  for (int k = 0; k < 2000; ++k) {
    const double f = random.symmetric(0.02), wanted = -0.2 * std::copysign(1.0, f);
    const double added = std::abs(mended.update(work(wanted, f, 0)) - wanted);
    largest = std::max(largest, added);
    conductance = std::max(conductance, added / std::abs(f));
    EXPECT_EQ(ours.update(work(wanted, f, kT * wanted)), wanted);
  }
  EXPECT_NEAR(largest, 0.2, 1e-9);
  EXPECT_GT(conductance, 1000) << "m/s per newton";
  EXPECT_LT(with(ParallelLaw::kYield).most_yield(), 0.05);
}

// --- ours ---

TEST(ParallelPassivity, YieldIsBoundedAndSilentInTheDeadBand) {
  const ParallelParameters p = with(ParallelLaw::kYield);
  ParallelPassivity law(p);
  Random random(10);
  double last = 0;
  for (int k = 0; k < 5000; ++k) {
    const double f = k % 50 < 25 ? random.symmetric(0.09) : random.symmetric(6);
    const double yielded = law.update(work(0.1, f, -1e-4 * std::copysign(1.0, f))) - 0.1;
    EXPECT_LE(std::abs(yielded), p.most_yield() * 6 + 1e-12);
    EXPECT_GE(yielded * f, 0) << "it gives way to the hand, never against it";
    if (yielded != 0) {
      EXPECT_LE(std::abs(yielded - last), p.yield_m_s2 * p.period_s + 1e-12) << "no blow";
    }
    last = yielded;
  }
  EXPECT_LT(law.budget_j(), 0);
  ParallelPassivity quiet(p);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(quiet.update(work(0.1, 0.05, -1e-3)), 0.1) << "inside the dead band";
}

TEST(ParallelPassivity, MostYieldHoldsTheHandsLoopGainToItsShare) {
  const ParallelParameters p;
  EXPECT_NEAR(p.most_yield() * p.hand_n_per_m * p.lag_s(), p.yield_share, 1e-12);
  EXPECT_NEAR(p.lag_s(), 1.5e-3 + 5e-3 + 1.5e-3, 1e-15);
  EXPECT_NEAR(p.least_mass_kg(), 5 * 900 * 64e-6, 1e-12);
}

TEST(ParallelPassivity, ObserverIsExactOnWhatWasMade) {
  ParallelPassivity law(ideal(ParallelLaw::kBudgeted));
  double energy = 0, last = 0;
  Random random(11);
  for (int k = 0; k < 10000; ++k) {
    const double f = random.symmetric(4), dx = random.symmetric(1e-3);
    law.update(work(0, f, dx));
    energy += 0.5 * (f + last) * dx;
    last = f;
    ASSERT_NEAR(law.energy_j(), energy, 1e-12);
  }
}

TEST(ParallelPassivity, AnIdealDeviceIsLeftAlone) {
  // Made at once and at the mean of old and new speed, the force's work is what the mass stores: nothing is ever owed.
  ParallelPassivity law(ideal(ParallelLaw::kBudgeted));
  const double m = 0.5;
  double v = 0, f_last = 0;
  for (int k = 0; k < 4000; ++k) {
    const double f = 2 * std::sin(2 * std::numbers::pi * 0.5 * k * kT);
    const double before = v;
    v += kT * 0.5 * (f + f_last) / m;
    f_last = f;
    EXPECT_NEAR(law.update(work(v, f, 0.5 * kT * (before + v), 0.5 * m * v * v, m)), v, 1e-9);
    EXPECT_GT(law.budget_j(), -1e-12);
    EXPECT_NEAR(law.shown_mass_kg(m), m, 1e-9);
  }
}

TEST(ParallelPassivity, CreditIsCapped) {
  const ParallelParameters p = ideal(ParallelLaw::kYield);
  ParallelPassivity law(p);
  for (int k = 0; k < 1000; ++k) law.update(work(0.1, 5, 1e-4));
  EXPECT_EQ(law.budget_j(), p.credit_cap_j);
  EXPECT_NEAR(law.energy_j(), 0.4997, 1e-3) << "the observer itself is not";
  for (int k = 0; k < 3; ++k) law.update(work(-0.1, 5, -1e-4));
  EXPECT_LT(law.budget_j(), 0) << "1 J banked before does not pay for 1.5 mJ now";
}

TEST(ParallelPassivity, DebtDecaysOnlyWhileNobodyPushes) {
  const ParallelParameters p = ideal(ParallelLaw::kYield);
  ParallelPassivity law(p);
  for (int k = 0; k < 20; ++k) law.update(work(0, 5, -1e-4));
  const double debt = law.budget_j();
  ASSERT_LT(debt, -5e-3);
  for (int k = 0; k < 200; ++k) law.update(work(0, 5, 0));
  EXPECT_NEAR(law.budget_j(), debt, 1e-12);
  law.update(work(0, 0, 0));
  for (int k = 0; k < 200; ++k) law.update(work(0, 0, 0));
  EXPECT_NEAR(law.budget_j(), debt * std::exp(-1), 0.02 * std::abs(debt));
}

TEST(ParallelPassivity, GrowsHeavyWithTheDebtAndLightAgainInTime) {
  const ParallelParameters p = ideal(ParallelLaw::kBudgeted);
  ParallelPassivity law(p);
  const double asked = 0.5 * p.least_mass_kg();
  EXPECT_EQ(law.shown_mass_kg(asked), asked);
  for (int k = 0; k < 20; ++k) law.update(work(0, 5, -1e-4, 0, asked));
  EXPECT_NEAR(law.shown_mass_kg(asked), p.least_mass_kg(), 1e-12);
  for (int k = 0; k < 100; ++k) law.update(work(0, 5, 1e-4, 0, asked));
  EXPECT_GT(law.shown_mass_kg(asked), asked);
  EXPECT_LT(law.shown_mass_kg(asked), p.least_mass_kg());
  for (int k = 0; k < 200; ++k) law.update(work(0, 5, 1e-4, 0, asked));
  EXPECT_EQ(law.shown_mass_kg(asked), asked);
  EXPECT_EQ(law.shown_mass_kg(2), 2) << "what is heavy enough stays as it is";
}

TEST(ParallelPassivity, HeavyShowsNoLessThanItsLeastMass) {
  const ParallelParameters p = with(ParallelLaw::kHeavy);
  ParallelPassivity law(p);
  EXPECT_EQ(law.update(work(0.2, 1, 0, 0, 0.01)), 0.2);
  EXPECT_NEAR(law.shown_mass_kg(0.01), p.least_mass_kg(), 1e-12);
}

TEST(ParallelPassivity, RefusesWhatItCannotKnow) {
  ParallelParameters p;
  p.delay_periods = 32;
  EXPECT_THROW(ParallelPassivity{p}, std::invalid_argument);
  p = {};
  p.sensor_lag_s = std::nan("");
  EXPECT_THROW(ParallelPassivity{p}, std::invalid_argument);
  p = {};
  p.hand_n_per_m = 0;
  EXPECT_THROW(ParallelPassivity{p}, std::invalid_argument);
}

TEST(ParallelPassivity, EveryLawHasAName) {
  for (const ParallelLaw law : kParallelLaws) EXPECT_STRNE(parallel_law_name(law), "");
}

}  // namespace
}  // namespace trocar::parallel_passivity_test
