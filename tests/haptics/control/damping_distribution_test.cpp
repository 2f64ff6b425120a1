// Damping placed on the joints: against the conditions of Karush, Kuhn and Tucker, against an enumeration of all sets
// of saturated joints, and in the loop's law.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "haptics/control/damping_distribution.h"
#include "haptics/control/passivity.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::damping_distribution_test {
namespace {

using test::Random;

struct Problem {
  double power_w;
  JointVector qd, headroom, weight;
};

Problem draw(Random& random) {
  Problem problem;
  for (int i = 0; i < kArmJoints; ++i) {
    problem.qd[i] = random.below(6) == 0 ? 0 : random.symmetric(6);
    problem.headroom[i] = random.below(6) == 0 ? 0 : random.between(0.01, 0.4);
    problem.weight[i] = random.between(0.05, 0.5);
  }
  problem.power_w = random.between(0.01, 1.3) * problem.qd.cwiseAbs().dot(problem.headroom) + 1e-6;
  return problem;
}

double cost(const JointVector& torque, const JointVector& weight) { return torque.cwiseQuotient(weight).squaredNorm(); }

/// Least cost over all 64 choices of saturated joints, the others as the free solution shares the remainder; infinite
/// when no choice is feasible. Knows nothing of passes.
double least_cost(const Problem& p, JointVector& best) {
  double least = std::numeric_limits<double>::infinity();
  for (int set = 0; set < 64; ++set) {
    JointVector torque = JointVector::Zero();
    double left = p.power_w, mobility = 0;
    for (int i = 0; i < kArmJoints; ++i) {
      if (set >> i & 1) {
        torque[i] = -std::copysign(p.headroom[i], p.qd[i]);
        left += torque[i] * p.qd[i];
      } else {
        mobility += std::pow(p.weight[i] * p.qd[i], 2);
      }
    }
    if (mobility == 0 && std::abs(left) > 1e-12) continue;
    for (int i = 0; i < kArmJoints; ++i) {
      if (!(set >> i & 1) && mobility > 0) torque[i] = -left * p.weight[i] * p.weight[i] * p.qd[i] / mobility;
    }
    if (((torque.cwiseAbs() - p.headroom).array() > 1e-12).any()) continue;
    if (cost(torque, p.weight) < least) least = cost(torque, p.weight), best = torque;
  }
  return least;
}

TEST(DampingDistribution, WithoutLimitsItIsTheClosedForm) {
  Random random(1);
  for (int k = 0; k < 1000; ++k) {
    Problem p = draw(random);
    p.headroom.setConstant(1e9);
    const PlacedDamping placed = place_damping(p.power_w, p.qd, p.headroom, p.weight);
    const JointVector mobile = p.weight.cwiseProduct(p.weight).cwiseProduct(p.qd);
    const JointVector expected =
        p.qd.isZero() ? JointVector(JointVector::Zero()) : JointVector(-p.power_w * mobile / p.qd.dot(mobile));
    EXPECT_LT((placed.torque - expected).norm(), 1e-12 * (1 + expected.norm()));
    EXPECT_LE(placed.passes, 1);
  }
}

TEST(DampingDistribution, IsTheCheapestOfAllSetsOfSaturatedJoints) {
  Random random(2);
  int feasible = 0, saturated = 0;
  for (int k = 0; k < 4000; ++k) {
    const Problem p = draw(random);
    const PlacedDamping placed = place_damping(p.power_w, p.qd, p.headroom, p.weight);
    if (p.power_w >= p.qd.cwiseAbs().dot(p.headroom) * (1 - 1e-9)) continue;
    JointVector best = JointVector::Zero();
    const double least = least_cost(p, best);
    ASSERT_TRUE(std::isfinite(least)) << "draw " << k;
    EXPECT_NEAR(cost(placed.torque, p.weight), least, 1e-9 * least) << "draw " << k;
    EXPECT_LT((placed.torque - best).norm(), 1e-9) << "strictly convex: one optimum";
    ++feasible;
    saturated += placed.passes > 1;
  }
  EXPECT_GT(feasible, 2500);
  EXPECT_GT(saturated, 1500) << "the draws do exercise the limits";
}

TEST(DampingDistribution, MeetsTheConditionsOfKarushKuhnAndTucker) {
  Random random(3);
  for (int k = 0; k < 4000; ++k) {
    const Problem p = draw(random);
    const PlacedDamping placed = place_damping(p.power_w, p.qd, p.headroom, p.weight);
    // Stationary: tau_i / w_i^2 = -lambda qd_i on free joints; a held one would want more: lambda |qd_i| w_i^2 >= h_i.
    double multiplier = -1;
    for (int i = 0; i < kArmJoints; ++i) {
      if (p.qd[i] == 0 || std::abs(placed.torque[i]) >= p.headroom[i] * (1 - 1e-12)) continue;
      const double own = -placed.torque[i] / (p.weight[i] * p.weight[i] * p.qd[i]);
      if (multiplier >= 0) {
        EXPECT_NEAR(own, multiplier, 1e-9 * multiplier);
      }
      multiplier = own;
    }
    if (multiplier < 0) continue;  // all held
    for (int i = 0; i < kArmJoints; ++i) {
      if (p.qd[i] == 0) continue;
      EXPECT_GE(multiplier * p.weight[i] * p.weight[i] * std::abs(p.qd[i]), std::abs(placed.torque[i]) * (1 - 1e-9));
    }
  }
}

TEST(DampingDistribution, PlacesAllThatFitsAndOwnsUpToTheRest) {
  Random random(4);
  for (int k = 0; k < 4000; ++k) {
    const Problem p = draw(random);
    const PlacedDamping placed = place_damping(p.power_w, p.qd, p.headroom, p.weight);
    const double most = p.qd.cwiseAbs().dot(p.headroom);
    EXPECT_NEAR(-placed.torque.dot(p.qd), std::min(p.power_w, most), 1e-12 + 1e-9 * p.power_w);
    EXPECT_NEAR(placed.unplaced_w, std::max(0.0, p.power_w - most), 1e-12 + 1e-9 * p.power_w);
    EXPECT_LE(placed.passes, kArmJoints);
    for (int i = 0; i < kArmJoints; ++i) {
      EXPECT_LE(std::abs(placed.torque[i]), p.headroom[i]);
      EXPECT_LE(placed.torque[i] * p.qd[i], 0) << "no joint is driven";
    }
  }
}

TEST(DampingDistribution, NothingFromNothing) {
  const JointVector one = JointVector::Ones(), none = JointVector::Zero();
  EXPECT_EQ(place_damping(1, none, one, one).torque, none) << "no motion, no torque";
  EXPECT_EQ(place_damping(1, none, one, one).unplaced_w, 1) << "and it stays debt";
  EXPECT_EQ(place_damping(0, one, one, one).torque, none);
  EXPECT_EQ(place_damping(-1, one, one, one).torque, none) << "it never drives";
  EXPECT_EQ(place_damping(std::nan(""), one, one, one).torque, none);
  EXPECT_EQ(place_damping(1, one * std::nan(""), one, one).torque, none);
  EXPECT_EQ(place_damping(1, one, -one, one).torque, none) << "a motor beyond its limit has no headroom";
  EXPECT_EQ(place_damping(1, one, -one, one).unplaced_w, 1);
}

TEST(DampingDistribution, StrongJointsWorkMost) {
  JointVector weight = JointVector::Ones();
  weight[2] = 3;
  const JointVector torque = place_damping(1, JointVector::Ones(), JointVector::Constant(10), weight).torque;
  EXPECT_NEAR(torque[2] / torque[0], 9, 1e-12) << "Q^-1 = diag(w^2)";
}

TEST(DampingDistribution, HeadroomIsWhatIsLeftAgainstTheMotion) {
  JointVector qd = JointVector::Zero(), carried = JointVector::Zero();
  qd << 1, -1, 1, -1, 0, 2;
  carried << 0.1, 0.1, -0.1, -0.1, 0.2, -0.9;
  const JointVector room = headroom_against(qd, carried, JointVector::Constant(0.4));
  EXPECT_NEAR(room[0], 0.5, 1e-15) << "carries along the motion: may turn round and then brake";
  EXPECT_NEAR(room[1], 0.3, 1e-15);
  EXPECT_NEAR(room[2], 0.3, 1e-15);
  EXPECT_NEAR(room[3], 0.5, 1e-15);
  EXPECT_EQ(room[5], 0) << "beyond the limit already";
  Random random(5);
  for (int k = 0; k < 2000; ++k) {
    const Problem p = draw(random);
    const JointVector limit = JointVector::Constant(0.43), load = p.headroom - JointVector::Constant(0.2);
    const PlacedDamping placed = place_damping(p.power_w, p.qd, headroom_against(p.qd, load, limit), p.weight);
    EXPECT_LE((placed.torque + load).cwiseAbs().maxCoeff(), 0.43 + 1e-12) << "the sum stays within the motors' limits";
  }
}

TEST(DampingDistribution, ARestingJointIsLeftOut) {
  JointVector qd;
  qd << 0.05, -0.0999, 0.1, -2, 0, 0.3;
  const JointVector kept = moving_joints(qd);
  EXPECT_EQ(kept[0], 0);
  EXPECT_EQ(kept[1], 0);
  for (int i = 2; i < kArmJoints; ++i) EXPECT_EQ(kept[i], qd[i]);
  const JointVector torque = place_damping(1, kept, JointVector::Ones(), JointVector::Ones()).torque;
  EXPECT_EQ(torque[0], 0);
  EXPECT_GT(torque[3], 0) << "against -2 rad/s";
}

/// A spring of 500 N/m pressed to 4 mm, moved by dx while `held` newtons acted.
ContactWork pressed(double dx, double held) {
  ContactWork work;
  work.wanted_n = 2;
  work.absorbed_j = held * dx;
  work.dx_m = dx;
  work.speed_m_s = dx / 1e-3;
  work.stored_j = 0.5 * 500 * 0.004 * 0.004;
  work.stiffness = 500;
  return work;
}

TEST(DistributedLaw, ShowsTheSpringOfTheDefaultAndAsksForThePowerOfItsDamping) {
  PassivityParameters p;
  PassivityController budgeted(p);
  p.law = PassivityLaw::kDistributed;
  PassivityController distributed(p);
  Random random(6);
  int damped = 0;
  for (int k = 0; k < 3000; ++k) {
    const ContactWork work = pressed(random.symmetric(2e-4), k % 40 < 20 ? 0 : 2);
    const double whole = budgeted.update(work), spring = distributed.update(work);
    EXPECT_GE(distributed.damping_w(), 0);
    EXPECT_NEAR(whole, spring + (distributed.damping_w() > 0 ? distributed.damping_w() / work.speed_m_s : 0), 1e-9)
        << "same observation, same debt: force of the default is spring and damping together, tick " << k;
    damped += distributed.damping_w() > 0;
  }
  EXPECT_GT(damped, 300);
  EXPECT_EQ(budgeted.damping_w(), 0);
}

TEST(DistributedLaw, HasItsNumberAndName) {
  EXPECT_EQ(static_cast<int>(PassivityLaw::kDistributed), 6) << "recordings keep numbers";
  EXPECT_EQ(passivity_law_named("distributed"), PassivityLaw::kDistributed);
  EXPECT_EQ(PassivityParameters{}.law, PassivityLaw::kBudgeted);
}

}  // namespace
}  // namespace trocar::damping_distribution_test
