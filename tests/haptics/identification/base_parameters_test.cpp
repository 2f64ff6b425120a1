// Base parameters: how many, which, and that they carry every torque of the whole set.
#include <gtest/gtest.h>

#include "haptics/identification/base_parameters.h"
#include "haptics/kinematics/device_geometry.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::base_parameters_test {
namespace {

using test::Random;

const BaseSet& base() {
  static const BaseSet set = base_parameters();
  return set;
}

double grouping(const std::string& kept, const std::string& grouped) {
  for (int k = 0; k < base().size(); ++k) {
    if (mass_parameter_name(base().kept[static_cast<std::size_t>(k)]) != kept) continue;
    for (int j = 0; j < kMassParameters; ++j) {
      if (mass_parameter_name(j) == grouped) return base().grouping(k, j);
    }
  }
  ADD_FAILURE() << kept << " or " << grouped << " is not there";
  return 0;
}

TEST(BaseParameters, ThirtySixOfFortySixWithTheNineOfGravityFirst) {
  // Spherical body 9, then 7 a revolute joint, less 1 for each of the masses' two dependent pairs; rotors 6.
  EXPECT_EQ(base().size(), 36);
  const std::vector<std::string> first{"P.mx", "P.my", "P.mz", "4.mx", "4.my", "5.mx", "5.my", "6.mx", "6.my"};
  for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(mass_parameter_name(base().kept[k]), first[k]);
}

TEST(BaseParameters, EveryTorqueOfTheWholeSetIsOneOfTheBase) {
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const JointVector q = test::random_joints(random, 5, 0.2);
    JointVector qd, qdd;
    for (int i = 0; i < kArmJoints; ++i) qd[i] = random.symmetric(3), qdd[i] = random.symmetric(20);
    Eigen::VectorXd pi(kMassParameters);
    for (int i = 0; i < kMassParameters; ++i) pi[i] = random.symmetric(1);
    const TorqueRegressor Y = torque_regressor(q, qd, qdd);
    const JointVector whole = Y * pi, reduced = base().columns(Y) * (base().grouping * pi);
    EXPECT_LT((whole - reduced).norm(), 1e-9 * (1 + whole.norm()));
  }
}

TEST(BaseParameters, RegroupAsTheTextbookSays) {
  // A mass behind the elbow acts as a point at the elbow's end of link 1 and of link 2.
  EXPECT_NEAR(grouping("P.mx", "6.m"), -kLink1, 1e-9);
  EXPECT_NEAR(grouping("4.mx", "6.m"), kLink2, 1e-9);
  EXPECT_NEAR(grouping("P.Izz", "4.m"), kLink1 * kLink1, 1e-9);
  EXPECT_NEAR(grouping("P.Iyy", "6.m"), kLink1 * kLink1 + kLink2 * kLink2, 1e-9);
  // The component along a joint axis belongs to the body before.
  EXPECT_NEAR(grouping("P.mz", "4.mz"), -1, 1e-9);
  EXPECT_NEAR(grouping("5.mx", "6.mz"), 1, 1e-9);
  EXPECT_NEAR(grouping("6.Ixx", "6.Iyy"), -1, 1e-9);
  EXPECT_EQ(grouping("6.mx", "6.m"), 0);
}

TEST(BaseParameters, ArePickedTheSameEveryTime) {
  const BaseSet again = base_parameters();
  EXPECT_EQ(again.kept, base().kept);
  EXPECT_EQ(again.grouping, base().grouping);
}

}  // namespace
}  // namespace trocar::base_parameters_test
