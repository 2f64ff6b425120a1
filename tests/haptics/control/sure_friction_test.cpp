// What friction surely takes: nothing inside its play, Coulomb and viscous friction beyond.
#include "haptics/control/sure_friction.h"

#include <gtest/gtest.h>

namespace trocar::sure_friction_test {
namespace {

constexpr double kCoulomb = 0.006, kViscous = 0.004, kPlay = 1e-3;

SureFriction friction(double viscous) {
  return {ChannelVector::Constant(kCoulomb), ChannelVector::Constant(viscous), ChannelVector::Constant(kPlay)};
}

TEST(SureFriction, TakesNothingFromAJointThatOnlyRocks) {
  SureFriction f = friction(0);
  double sum = f.update(ChannelVector::Constant(kPlay), ChannelVector::Zero()).sum();
  for (int k = 0; k < 100; ++k) {
    const double way = k % 2 == 0 ? -2 * kPlay : 2 * kPlay;
    sum += f.update(ChannelVector::Constant(way), ChannelVector::Zero()).sum();
  }
  EXPECT_EQ(sum, 0);
}

TEST(SureFriction, TakesCoulombFrictionOfTheWayBeyondThePlay) {
  SureFriction f = friction(0);
  double sum = 0;
  for (int k = 0; k < 100; ++k) sum += f.update(ChannelVector::Constant(1e-4), ChannelVector::Zero())[2];
  EXPECT_NEAR(sum, kCoulomb * (0.010 - kPlay), 1e-12);
  for (int k = 0; k < 100; ++k) sum += f.update(ChannelVector::Constant(-1e-4), ChannelVector::Zero())[2];
  EXPECT_NEAR(sum, kCoulomb * (0.020 - 3 * kPlay), 1e-12) << "turning back gives both plays away";
  f.reset();
  EXPECT_EQ(f.update(ChannelVector::Constant(kPlay), ChannelVector::Zero())[2], 0);
}

TEST(SureFriction, CountsViscousFrictionOnlyWhereWayAndRateAgree) {
  SureFriction f = friction(kViscous);
  ChannelVector way = ChannelVector::Zero(), rate = ChannelVector::Zero();
  way[1] = 5e-4, rate[1] = 0.5;
  way[4] = 5e-4, rate[4] = -0.5;  // the estimate lags behind
  const ChannelVector taken = f.update(way, rate);
  EXPECT_NEAR(taken[1], kViscous * 0.5 * 5e-4, 1e-15);
  EXPECT_EQ(taken[4], 0);
}

}  // namespace
}  // namespace trocar::sure_friction_test
