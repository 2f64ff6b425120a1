// What the energy observer is made of: which torque acted when, how far a channel moved between counts, and the
// stiffness that friction and counts allow.
#include <gtest/gtest.h>

#include "haptics/contact/stiffness_limit.h"
#include "haptics/control/sub_count_travel.h"
#include "haptics/control/torque_history.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::contact_energy_parts_test {
namespace {

ChannelVector all(double value) { return ChannelVector::Constant(value); }

TEST(TorqueHistory, WhatATickAsksActsOnePeriodLater) {
  TorqueHistory history;
  for (int k = 1; k <= 5; ++k) {
    EXPECT_EQ(history.acted(1, 0)[0], std::max(0, k - 2)) << "tick " << k;
    history.add(all(k));
  }
}

TEST(TorqueHistory, AKnownDelayComesOnTop) {
  TorqueHistory history;
  for (int k = 1; k <= 30; ++k) {
    EXPECT_EQ(history.acted(1, 9)[3], std::max(0, k - 11)) << "tick " << k;
    history.add(all(k));
  }
}

TEST(TorqueHistory, MissedPeriodsKeepWhatWasWrittenLast) {
  TorqueHistory history;
  for (int k = 1; k <= 4; ++k) {
    history.acted(1, 0);
    history.add(all(k));
  }
  // Three periods since tick 4: the codes of tick 3 acted in the first, those of tick 4 in the two others.
  EXPECT_NEAR(history.acted(3, 0)[0], (3 + 4 + 4) / 3.0, 1e-15);
  history.add(all(8));
  EXPECT_EQ(history.acted(1, 0)[0], 4);
}

TEST(TorqueHistory, EqualsAQueueForAnyPatternOfMissedPeriodsAndDelays) {
  for (const int delay : {0, 1, 5, 20}) {
    TorqueHistory history;
    std::vector<double> written{0};  // what the board holds from period to period
    test::Random random(static_cast<std::uint64_t>(11 + delay));
    for (int tick = 0; tick < 300; ++tick) {
      const int periods = 1 + (random.below(4) == 0 ? random.below(6) : 0);
      for (int i = 1; i < periods; ++i) written.push_back(written.back());
      double sum = 0;
      for (int i = 0; i < periods; ++i) {
        const int at = static_cast<int>(written.size()) - 2 - delay - i;
        sum += at >= 0 ? written[static_cast<std::size_t>(at)] : 0;
      }
      EXPECT_NEAR(history.acted(periods, delay)[0], sum / periods, 1e-12) << "tick " << tick << ", delay " << delay;
      written.push_back(random.symmetric(1));
      history.add(all(written.back()));
    }
  }
}

TEST(TorqueHistory, DisarmedNothingIsOnItsWay) {
  TorqueHistory history;
  for (int k = 0; k < 10; ++k) history.add(all(1));
  history.clear();
  EXPECT_EQ(history.acted(1, 0)[0], 0);
  EXPECT_EQ(history.acted(5, 3)[0], 0);
}

SubCountTravel::Counts counts(std::int64_t n) {
  SubCountTravel::Counts c;
  c.fill(n);
  return c;
}

TEST(SubCountTravel, AFlickeringCountIsNoTravel) {
  SubCountTravel travel;
  travel.reset(counts(5));
  travel.advance(counts(6), all(0), 1e-3);  // the edge between 5 and 6 is found
  double way = 0;
  for (int k = 0; k < 1000; ++k)
    way += travel.advance(counts(k % 2 == 0 ? 5 : 6), all(k % 2 == 0 ? -60 : 60), 1e-3).cwiseAbs().sum();
  EXPECT_EQ(way, 0);
}

TEST(SubCountTravel, MovingItIsRightToAFractionOfACount) {
  SubCountTravel travel;
  travel.reset(counts(0));
  const double speed = 0.37;  // counts a period
  double x = 0.5, worst = 0, found = 0.5;
  for (int k = 0; k < 2000; ++k) {
    x += speed;
    found += travel.advance(counts(static_cast<std::int64_t>(std::floor(x))), all(speed * 1e3), 1e-3)[2];
    if (k > 100) worst = std::max(worst, std::abs(found - x));
  }
  EXPECT_LT(worst, 0.05) << "the count alone would be wrong by up to 1";
}

TEST(SubCountTravel, NeverLeavesItsCount) {
  SubCountTravel travel;
  travel.reset(counts(0));
  test::Random random(3);
  double position = 0.5;
  std::int64_t n = 0;
  for (int k = 0; k < 5000; ++k) {
    n += random.below(7) - 3;
    position += travel.advance(counts(n), all(random.symmetric(5e3)), 1e-3 * (1 + random.below(3)))[0];
    EXPECT_GE(position, static_cast<double>(n) - 1e-9);
    EXPECT_LE(position, static_cast<double>(n + 1) + 1e-9);
  }
}

TEST(StiffnessLimit, IsTheSmallestOfTheThreeLimits) {
  DeviceModel model;
  const JointVector lever = (JointVector() << 0.2, 0, 0, 0, 0, 0).finished();
  const double b = model.viscous[0] / 0.04, fc = model.coulomb[0] / 0.2,
               count = 0.2 * count_size(model.transmission[0]);
  const TipFriction tip = tip_friction(model, lever);
  EXPECT_NEAR(tip.viscous_n_s_per_m, b, 1e-12);
  EXPECT_NEAR(tip.coulomb_n, fc, 1e-12);
  EXPECT_NEAR(tip.count_m, count, 1e-12);
  const auto k_max = [&](double delay) { return stiffness_limit(model, lever, 1, 1e-3, delay).k_max; };
  const double sure = model.friction_sure();
  EXPECT_LT(sure, 1);
  EXPECT_NEAR(k_max(0), sure * std::min(2 * b / 1e-3, 2 * fc / count), 1e-9);
  EXPECT_NEAR(k_max(0.010), sure * b / 0.0105, 1e-9) << "delay decides";
  model.coulomb[0] = 1e-6;
  EXPECT_NEAR(k_max(0), sure * 2e-6 / 0.2 / count, 1e-9) << "counts decide";
}

TEST(StiffnessLimit, ShareIsWhatIsLeftOfTheAskedStiffness) {
  const DeviceModel model;
  const JointVector lever = (JointVector() << 0.15, 0.15, -0.18, 0, 0, 0).finished();
  const double k_max = stiffness_limit(model, lever, 1, 1e-3, 1e-3).k_max;
  EXPECT_EQ(stiffness_limit(model, lever, 0.5 * k_max, 1e-3, 1e-3).share, 1);
  EXPECT_NEAR(stiffness_limit(model, lever, 4 * k_max, 1e-3, 1e-3).share, 0.25, 1e-12);
  EXPECT_EQ(stiffness_limit(model, JointVector::Zero(), 1000, 1e-3, 1e-3).share, 1) << "no joint feels this force";
}

TEST(StiffnessLimit, DampingIsTheLeastThatAnyMotionAlongTheForceMeets) {
  const DeviceModel model;
  test::Random random(9);
  for (int trial = 0; trial < 200; ++trial) {
    const ArmState arm = arm_state(test::random_joints(random));
    Vec6 w;
    w << random.direction(), Vec3::Zero();
    const JointVector lever = arm.J_WS.transpose() * w;
    const TipFriction tip = tip_friction(model, lever);
    for (int k = 0; k < 20; ++k) {
      JointVector qd;
      for (int i = 0; i < kArmJoints; ++i) qd[i] = random.symmetric(1);
      const double v = lever.dot(qd);
      EXPECT_GE(qd.dot(model.viscous.cwiseProduct(qd)) * (1 + 1e-9), tip.viscous_n_s_per_m * v * v);
      EXPECT_GE(model.coulomb.dot(qd.cwiseAbs()) * (1 + 1e-9), tip.coulomb_n * std::abs(v));
    }
  }
}

}  // namespace
}  // namespace trocar::contact_energy_parts_test
