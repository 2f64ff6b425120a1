// The kinematics study against the plant's own kinematics and against bounds computed another way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/device_bench/thesis_kinematics.h"
#include "app/studies/device/kinematics_study.h"
#include "haptics/device/device_model.h"
#include "haptics/device/plant/plant_kinematics.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::kinematics_oracle_test {
namespace {

using test::Random;

const StudyCase& the_case(const StudyResult& study, const std::string& start) {
  for (const StudyCase& c : study.cases) {
    if (c.name.rfind(start, 0) == 0) return c;
  }
  ADD_FAILURE() << "no case " << start;
  return study.cases.front();
}

TEST(KinematicsOracle, PlantAndControllerAgreeOverTheTrajectory) {
  for (int k = 0; k <= 400; ++k) {
    const JointVector q = kinematic_trajectory(0.01 * k);
    const Pose plant = stylus_pose(evaluate_kinematics(configuration_at(q), kLink1, kLink2)), ours = arm_state(q).X_WS;
    EXPECT_LT((plant.p - ours.p).norm(), 1e-13) << k;
    EXPECT_LT((plant.R - ours.R).norm(), 1e-13) << k;
  }
}

TEST(KinematicsOracle, WholeCountsMoveTheTipByNoMoreThanTheirColumnsSum) {
  // Each angle is floored to a whole count: less than one count each. Sum of the columns' lengths bounds the tip.
  const double count = count_size(DeviceModel{}.transmission[0]);
  double bound = 0;
  for (int k = 0; k <= 400; ++k) {
    const ArmState arm = arm_state(kinematic_trajectory(0.01 * k));
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += arm.J_WS.col(i).head<3>().norm() * count;
    bound = std::max(bound, sum);
  }
  const StudyResult study = kinematics_study({false, 1});
  const double measured = 1e-3 * the_case(study, "trajectory: tip as the encoders see it").value;
  EXPECT_LT(measured, bound);
  EXPECT_GT(measured, 0.2 * bound) << "and it is of that order, not of 0.02 mm";
}

TEST(KinematicsOracle, ThesisAlgorithmIsOurFirstCandidate) {
  // On exact frames algorithm 1 gives the candidate with n = +(AO x Z6); on its own side that is the posture put in.
  Random random(1);
  int compared = 0;
  for (int n = 0; n < 1000; ++n) {
    const ArmState arm = arm_state(test::random_joints(random));
    const Vec3 normal = (-arm.X_WS.p.normalized()).cross(arm.X_WS.R.col(2));
    if (normal.norm() < 0.02 || normal.dot(arm.J_WS.col(3).tail<3>()) < 0) continue;
    const InverseSolutions all = inverse_kinematics(arm.X_WS);
    const JointVector theirs = thesis::inverse(arm.X_WS, thesis::exact_frames());
    double off = 0;
    for (int i = 0; i < kArmJoints; ++i) {
      off = std::max(off, std::abs(std::remainder(theirs[i] - all.candidate[0].q[i], 2 * std::numbers::pi)));
    }
    EXPECT_LT(off, 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 700);
}

TEST(KinematicsOracle, BeyondTheSurfaceTheSecondPlaneIsTheRightOneAndTheFirstIsOutside) {
  Random random(2);
  int beyond = 0;
  for (int n = 0; n < 3000; ++n) {
    const JointVector q = test::random_joints(random);
    const ArmState arm = arm_state(q);
    const Vec3 normal = (-arm.X_WS.p.normalized()).cross(arm.X_WS.R.col(2));
    if (normal.norm() < 0.02 || normal.dot(arm.J_WS.col(3).tail<3>()) > 0) continue;
    ++beyond;
    const InverseSolutions all = inverse_kinematics(arm.X_WS);
    ASSERT_EQ(all.count, 2);
    EXPECT_TRUE(all.candidate[1].in_limits);
    EXPECT_LT((arm_state(all.candidate[1].q).X_WS.p - arm.X_WS.p).norm(), 1e-10);
  }
  EXPECT_GE(beyond, 100);
}

TEST(KinematicsOracle, StudyNumbersComeFromTheirTables) {
  const StudyResult study = kinematics_study({true, 1});
  const auto& s = thesis::samples();
  EXPECT_NEAR(*the_case(study, "S2: position").thesis, 1e3 * (s[1].printed.p - arm_state(s[1].q).X_WS.p).norm(), 1e-3);
  EXPECT_NEAR(*the_case(study, "S3: position").thesis, 1e3 * (s[2].printed.p - arm_state(s[2].q).X_WS.p).norm(), 1e-3);
  EXPECT_NEAR(the_case(study, "S1: table 3.3").value, 1e3 * (arm_state(s[0].q).X_WS.p - home_pose().p).norm(), 1e-12);
  EXPECT_NEAR(s[0].printed.p.z(), -0.27202, 1e-12);
  EXPECT_NEAR(s[2].q[5] / kDegree, -95.41, 1e-12);
  for (const thesis::Sample& sample : s) {
    // Printed rotations have rows of about unit length: a misread entry would show.
    for (int row = 0; row < 3; ++row)
      EXPECT_NEAR(sample.printed.R.row(row).norm(), 1, 0.02) << sample.name << ' ' << row;
    EXPECT_LT((sample.inverse - sample.q).cwiseAbs().maxCoeff(), 1.21 * kDegree) << sample.name;
  }
}

TEST(KinematicsOracle, QuickFormMeasuresTheSameOnFewerSamples) {
  const StudyResult quick = kinematics_study({true, 1}), full = kinematics_study({false, 1});
  ASSERT_EQ(quick.cases.size(), full.cases.size());
  for (std::size_t i = 0; i < quick.cases.size(); ++i) {
    EXPECT_EQ(quick.cases[i].name, full.cases[i].name);
    EXPECT_EQ(quick.cases[i].met, full.cases[i].met) << quick.cases[i].name;
  }
  const double one = *the_case(quick, "trajectory: inverse").thesis,
               all = *the_case(full, "trajectory: inverse").thesis;
  EXPECT_LE(one, all) << "a maximum over fewer samples";
  EXPECT_NEAR(one, all, 0.02 * all);
}

}  // namespace
}  // namespace trocar::kinematics_oracle_test
