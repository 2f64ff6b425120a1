// The passivity laws of others, each by its definition.
#include "app/device_bench/comparison_laws.h"

#include <gtest/gtest.h>

#include "tests/haptics/contact/one_axis_rig.h"

namespace trocar::comparison_laws_test {
namespace {

using test::Random;
using test::spring;

TEST(ComparisonLaws, TheThesisLawNeverActsOnASpring) {
  auto thesis = comparison_law(ComparisonLaw::kThesis, {});
  Random random(1);
  double x = 0;
  for (int k = 0; k < 100000; ++k) {
    const double dx = std::max(-x, random.symmetric(3e-4));
    x = std::min(x + dx, 0.02);
    const ContactWork work = spring(400, x, dx, 400 * x);
    EXPECT_EQ(thesis(work), work.wanted_n);
  }
}

TEST(ComparisonLaws, WhereTheThesisLawActsItTakesAllForceInOneTick) {
  auto thesis = comparison_law(ComparisonLaw::kThesis, {});
  ContactWork work;
  work.wanted_n = 1;
  work.dx_m = -1e-4;  // leaves while the force is not that of a spring
  EXPECT_NEAR(thesis(work), 0, 1e-12) << "alpha v = -W / (T v) = -f: from 1 N to nothing";
}

TEST(ComparisonLaws, CapShowsASpringOfKappa) {
  const double kappa = 0.3 / 1.5e-3;
  auto cap = comparison_law(ComparisonLaw::kCap, {});
  EXPECT_NEAR(cap(spring(1000, 0.004, 0, 0)), kappa * 0.004, 1e-12);
  EXPECT_NEAR(cap(spring(kappa / 2, 0.004, 0, 0)), kappa / 2 * 0.004, 1e-12) << "softer ones as they are";
}

TEST(ComparisonLaws, ReferenceKeepsTheSpringAndAddsBoundedDamping) {
  auto reference = comparison_law(ComparisonLaw::kReference, {});
  for (int k = 0; k < 20; ++k) reference(spring(500, 0.004, -1e-5, 2));  // into debt
  double last = 0;
  for (int k = 0; k < 50; ++k) {
    const ContactWork work = spring(500, 0.004, 5e-5, 0);
    const double force = reference(work);
    EXPECT_GE(force, work.wanted_n);
    EXPECT_LE(force - last, (k == 0 ? work.wanted_n : 0) + 0.25 + 1e-12) << "no blow";
    last = force;
  }
  EXPECT_GT(last, spring(500, 0.004, 0, 0).wanted_n) << "it does damp";
}

TEST(ComparisonLaws, ACopyGoesOnByItself) {
  auto reference = comparison_law(ComparisonLaw::kReference, {});
  for (int k = 0; k < 20; ++k) reference(spring(500, 0.004, -1e-5, 2));
  auto copy = reference;
  for (int k = 0; k < 50; ++k) reference(spring(500, 0.004, 5e-5, 0));
  EXPECT_EQ(copy(spring(500, 0.004, 0, 0)), 2) << "not damped yet";
}

}  // namespace
}  // namespace trocar::comparison_laws_test
