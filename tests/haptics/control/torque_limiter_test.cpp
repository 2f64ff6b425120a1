// Who gets the torque: priority, direction kept, clamp, rate, what the observer is told.
#include <gtest/gtest.h>

#include "haptics/control/torque_limiter.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::torque_limiter_test {
namespace {

using test::degrees;
using test::Random;

constexpr double kLimit = 0.4, kFast = 1e9;

TorqueLimiter limiter(double rate = kFast) {
  return TorqueLimiter(ChannelVector::Constant(kLimit), ChannelVector::Constant(rate), 1e-3);
}

ChannelVector channels(double a, double b, double c = 0) {
  ChannelVector v = ChannelVector::Zero();
  v.head<3>() << a, b, c;
  return v;
}

ChannelVector random_channels(Random& random, double half) {
  ChannelVector v;
  for (int i = 0; i < kChannels; ++i) v[i] = random.symmetric(half);
  return v;
}

TEST(TorqueLimiter, WithinTheLimitsEverythingPasses) {
  TorqueShares s;
  s.springs = channels(0.05, 0), s.gravity = channels(0.1, -0.1), s.contact = channels(0.1, 0.2),
  s.friction = channels(0.01, 0.01);
  const LimitedTorque out = limiter().update(s);
  EXPECT_LT((out.total - channels(0.26, 0.11)).norm(), 1e-15);
  EXPECT_LT((out.contact - s.contact).norm(), 1e-15);
  EXPECT_EQ(out.contact_scale, 1);
}

TEST(TorqueLimiter, ContactIsScaledDownAsAWholeAndKeepsItsDirection) {
  TorqueShares s;
  s.gravity = channels(0.2, 0);
  s.contact = channels(0.4, 0.1, -0.05);  // 0.2 of room on channel 0
  const LimitedTorque out = limiter().update(s);
  EXPECT_NEAR(out.contact_scale, 0.5, 1e-15);
  EXPECT_LT((out.contact - 0.5 * s.contact).norm(), 1e-15);
  EXPECT_NEAR(out.total[0], kLimit, 1e-15);
}

TEST(TorqueLimiter, PinchIsScaledWithTheArm) {
  TorqueShares s;
  s.contact = channels(0.8, 0);
  s.contact[kPinchChannel] = 0.1;
  EXPECT_NEAR(limiter().update(s).contact[kPinchChannel], 0.05, 1e-15);
}

TEST(TorqueLimiter, GravityIsServedBeforeContact) {
  TorqueShares s;
  s.gravity = channels(0.4, 0);
  s.contact = channels(0.1, 0.1);
  const LimitedTorque out = limiter().update(s);
  EXPECT_NEAR(out.total[0], 0.4, 1e-15);
  EXPECT_EQ(out.contact_scale, 0);
  EXPECT_EQ(out.contact[1], 0);
}

TEST(TorqueLimiter, GravityHelpingAContactLeavesItMoreRoom) {
  TorqueShares s;
  s.gravity = channels(-0.3, 0);
  s.contact = channels(0.6, 0);
  const LimitedTorque out = limiter().update(s);
  EXPECT_EQ(out.contact_scale, 1);
  EXPECT_NEAR(out.total[0], 0.3, 1e-15);
}

TEST(TorqueLimiter, FrictionGetsOnlyWhatIsLeft) {
  TorqueShares s;
  s.contact = channels(0.39, 0);
  s.friction = channels(0.1, 0);
  const LimitedTorque out = limiter().update(s);
  EXPECT_EQ(out.contact_scale, 1) << "friction does not cut the contact";
  EXPECT_NEAR(out.total[0], kLimit, 1e-15);
}

TEST(TorqueLimiter, TotalNeverExceedsLimitOrRate) {
  Random random(1);
  TorqueLimiter limited = limiter(100);
  ChannelVector last = ChannelVector::Zero();
  for (int k = 0; k < 20000; ++k) {
    TorqueShares s;
    s.springs = random_channels(random, 0.6), s.gravity = random_channels(random, 0.3);
    s.contact = random_channels(random, 1), s.friction = random_channels(random, 0.1);
    const LimitedTorque out = limited.update(s);
    EXPECT_LE(out.total.cwiseAbs().maxCoeff(), kLimit + 1e-15);
    EXPECT_LE((out.total - last).cwiseAbs().maxCoeff(), 0.1 + 1e-12);  // 100 N m/s in a millisecond
    EXPECT_GE(out.contact_scale, 0);
    EXPECT_LE(out.contact_scale, 1);
    last = out.total;
  }
}

TEST(TorqueLimiter, TheObserverGetsExactlyWhatTheContactReallyGot) {
  // total = springs + gravity + friction (clamped) + contact: what the rate limit cut is charged to the contact.
  TorqueLimiter limited = limiter(100);
  TorqueShares s;
  s.contact = channels(0.3, -0.25);
  s.gravity = channels(0.05, 0);
  LimitedTorque out;
  for (int k = 1; k <= 5; ++k) {
    out = limited.update(s);
    EXPECT_LT((out.total - (s.gravity + out.contact)).norm(), 1e-15) << "tick " << k;
  }
  EXPECT_LT((out.contact - s.contact).norm(), 1e-15) << "arrived";
}

TEST(TorqueLimiter, ResetStartsTheRampFromZero) {
  TorqueLimiter limited = limiter(100);
  TorqueShares s;
  s.contact = channels(0.4, 0);
  for (int k = 0; k < 10; ++k) limited.update(s);
  limited.reset();
  EXPECT_NEAR(limited.update(s).total[0], 0.1, 1e-15);
}

TEST(LimitSprings, NothingInTheMiddleOfTheRange) {
  EXPECT_EQ(limit_spring_torque(degrees(45, 45, 45, -60, -80, 300), JointVector::Constant(1)).norm(), 0);
}

TEST(LimitSprings, PushInwardsWithThreeNewtonmetresARadian) {
  const ChannelVector low = limit_spring_torque(degrees(3, 45, 45, -60, -80, 0), JointVector::Zero());
  EXPECT_NEAR(low[0], 3.0 * 5 * kDegree, 1e-14);  // 8 deg margin, 5 deg in
  const ChannelVector high = limit_spring_torque(degrees(45, 45, 45, -60, -2, 0), JointVector::Zero());
  EXPECT_NEAR(high[4], -3.0 * 6 * kDegree, 1e-14);
}

TEST(LimitSprings, DampingBrakesButNeverPullsOutwards) {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    JointVector q, qd;
    for (int i = 0; i < kArmJoints; ++i) {
      q[i] = random.between(kJointRange[i].low - 0.1, kJointRange[i].high + 0.1);
      qd[i] = random.symmetric(15);
    }
    const ChannelVector torque = limit_spring_torque(q, qd);
    for (int i = 0; i < 5; ++i) {
      const double middle = (kJointRange[i].low + kJointRange[i].high) / 2;
      EXPECT_LE(torque[i] * (q[i] - middle), 0) << "joint " << i;
    }
    EXPECT_EQ(torque[5], 0) << "theta6 has no stop";
    EXPECT_EQ(torque[6], 0);
  }
}

TEST(SingularityShare, FadesBetweenTwentyAndTenHundredths) {
  EXPECT_EQ(singularity_share(0.704), 1);
  EXPECT_EQ(singularity_share(0.20), 1);
  EXPECT_NEAR(singularity_share(0.15), 0.5, 1e-12);
  EXPECT_EQ(singularity_share(0.10), 0);
  EXPECT_EQ(singularity_share(-0.3), 0);
}

}  // namespace
}  // namespace trocar::torque_limiter_test
