// From traces to rows: passes, trajectories, what is left out, how names and groups run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/control/gravity.h"
#include "haptics/identification/measured_rows.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::measured_rows_test {
namespace {

const BaseSet& base() {
  static const BaseSet set = base_parameters();
  return set;
}

const JointVector kCentre = test::degrees(45, 45, 45, -60, -75, 0);

TEST(FitColumns, AreBaseParametersThenThreeSixes) {
  const auto columns = fit_columns(base());
  ASSERT_EQ(static_cast<int>(columns.size()), column_count(base()));
  EXPECT_EQ(columns[0].name, "P.mx");
  EXPECT_EQ(columns[static_cast<std::size_t>(base().size() + kCoulombColumn)].name, "Coulomb 1");
  EXPECT_EQ(columns[static_cast<std::size_t>(base().size() + kViscousColumn + 5)].name, "viscous 6");
  EXPECT_EQ(columns.back().name, "offset 6");
  for (const FitParameter& p : columns) {
    const bool rotor = p.name.rfind("rotor", 0) == 0, friction = p.name[0] == 'C' || p.name[0] == 'v';
    EXPECT_EQ(p.positive, rotor || friction) << p.name;
    EXPECT_FALSE(p.unit.empty()) << p.name;
  }
}

/// A pass at constant rates under the nominal weight, friction of 10 mN m and an offset of 1 mN m.
MotionTrace pass_at(const JointVector& rate) {
  MotionTrace trace;
  for (int k = 0; k < 800; ++k) {
    const JointVector q = kCentre + (k - 400) * 1e-3 * rate;
    trace.q.push_back(q);
    const Eigen::VectorXd moments = gravity_parameters({}) / kGravity;  // with what their motion at this rate adds
    JointVector tau =
        base().columns(torque_regressor(q, rate, JointVector::Zero())).leftCols(kGravityParameters) * moments;
    tau += JointVector::Constant(1e-3);
    for (int i = 0; i < kArmJoints; ++i) tau[i] += rate[i] > 0 ? 0.01 : -0.01;
    if (k < 100 || k >= 700) tau.setConstant(99);  // outside the middle: must not count
    trace.tau.push_back(tau);
  }
  return trace;
}

TEST(AddPass, GivesOneRowAJointThatItsTorqueFits) {
  JointVector rate;
  rate << 0.15, -0.15, 0.15, 0.15, -0.15, -0.15;
  TorqueRows rows(column_count(base()));
  add_pass(pass_at(rate), rate, base(), 0.6, 4, rows);
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(column_count(base()));
  truth.head(kGravityParameters) = gravity_parameters({}) / kGravity;
  truth.segment<kArmJoints>(base().size() + kCoulombColumn).setConstant(0.01);
  truth.segment<kArmJoints>(base().size() + kOffsetColumn).setConstant(1e-3);
  for (int j = 0; j < kArmJoints; ++j) {
    ASSERT_EQ(rows.size(j), 1);
    EXPECT_EQ(rows.groups(j)[0], 4);
    EXPECT_NEAR((rows.rows(j) * truth)[0], rows.torques(j)[0], 1e-9) << "both are means over the same samples";
    const Eigen::MatrixXd Y = rows.rows(j);
    EXPECT_NEAR(Y(0, base().size() + kCoulombColumn + j), rate[j] > 0 ? 1 : -1, 1e-12);
    EXPECT_NEAR(Y(0, base().size() + kViscousColumn + j), rate[j], 1e-12);
    for (int i = 0; i < kArmJoints; ++i) EXPECT_NEAR(Y(0, base().size() + kOffsetColumn + i), i == j ? 1 : 0, 1e-12);
  }
}

/// Joint 2 swings, the others rest.
MotionTrace swing() {
  MotionTrace trace;
  for (int k = 0; k < 4000; ++k) {
    JointVector q = kCentre;
    q[1] += 0.3 * std::sin(2 * k * 1e-3);
    trace.q.push_back(q);
    trace.tau.push_back(JointVector::Zero());
  }
  return trace;
}

TEST(AddTrajectory, LeavesOutMomentsInWhichTheJointIsSlow) {
  TorqueRows all(column_count(base())), moving(column_count(base()));
  add_trajectory(swing(), base(), false, all);
  add_trajectory(swing(), base(), true, moving);
  EXPECT_EQ(moving.size(0), 0) << "joint 1 rests";
  EXPECT_GT(moving.size(1), 0.5 * all.size(1));
  EXPECT_LT(moving.size(1), 0.9 * all.size(1)) << "around the reversals";
  EXPECT_EQ(all.size(0), all.size(5));
  const Eigen::MatrixXd Y = moving.rows(1);
  for (int k = 0; k < Y.rows(); ++k) {
    EXPECT_GT(std::abs(Y(k, base().size() + kViscousColumn + 1)), kSlow);
    EXPECT_NEAR(std::abs(Y(k, base().size() + kCoulombColumn + 1)), 1, 1e-4) << "presliding is over";
  }
}

TEST(AddTrajectory, TakesARowEvery20MillisecondsAndAGroupASecond) {
  TorqueRows all(column_count(base()));
  add_trajectory(swing(), base(), false, all);
  EXPECT_NEAR(all.size(0), 4.0 / kRow_s, 0.3 / kRow_s) << "filters take a margin at both ends";
  EXPECT_EQ(all.group_count(), 4);
  EXPECT_TRUE(std::is_sorted(all.groups(0).begin(), all.groups(0).end()));
}

TEST(AddTrajectory, RatesSurviveQuantisedAngles) {
  MotionTrace trace = swing();
  constexpr double kCount = 0.23 * 2 * 3.141592653589793 / 2000;
  for (JointVector& q : trace.q) {
    for (int i = 0; i < kArmJoints; ++i) q[i] = kCount * std::floor(q[i] / kCount);
  }
  TorqueRows exact(column_count(base())), counted(column_count(base()));
  add_trajectory(swing(), base(), false, exact);
  add_trajectory(trace, base(), false, counted);
  const int rate = base().size() + kViscousColumn + 1;
  const Eigen::VectorXd error = counted.rows(1).col(rate) - exact.rows(1).col(rate);
  EXPECT_LT(error.norm() / std::sqrt(double(error.size())), 0.01) << "one count a millisecond is 0.72 rad/s";
}

}  // namespace
}  // namespace trocar::measured_rows_test
