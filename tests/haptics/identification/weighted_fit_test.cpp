// Weighted least squares on data whose answer is known.
#include <gtest/gtest.h>

#include <cmath>

#include "haptics/identification/weighted_fit.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::weighted_fit_test {
namespace {

using test::Random;

std::vector<FitParameter> columns(int n) {
  std::vector<FitParameter> out;
  for (int i = 0; i < n; ++i) {
    FitParameter& p = out.emplace_back();
    p.name = std::to_string(i);
  }
  return out;
}

/// Rows of unit normals; noise of a joint's own size, the same within a group of `together`.
TorqueRows made_up(const Eigen::VectorXd& truth, const JointVector& noise, int rows, int together, std::uint64_t seed) {
  Random random(seed);
  TorqueRows data(static_cast<int>(truth.size()));
  for (int j = 0; j < kArmJoints; ++j) {
    double error = 0;
    for (int k = 0; k < rows; ++k) {
      Eigen::RowVectorXd row(truth.size());
      for (int c = 0; c < truth.size(); ++c) row[c] = 1 + random.normal();
      if (k % together == 0) error = noise[j] * random.normal();
      data.add(j, j * rows + k / together, row, row.dot(truth) + error);
    }
  }
  return data;
}

TEST(WeightedFit, IsExactWithoutNoise) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(4) << 1, -2, 3e-3, 40).finished();
  const TorqueFit fit = fit_torques(made_up(truth, JointVector::Zero(), 30, 1, 1), columns(4), 0.3);
  EXPECT_LT((fit.values() - truth).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(fit.dropped, 0);
  EXPECT_LT(fit.residual.maxCoeff(), 1e-9);
}

TEST(WeightedFit, DeviationIsTheSpreadOverRepeats) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(3) << 1, -2, 3).finished();
  for (const int together : {1, 10}) {
    double squares = 0, claimed = 0;
    constexpr int kRepeats = 200;
    for (int n = 0; n < kRepeats; ++n) {
      const TorqueFit fit =
          fit_torques(made_up(truth, JointVector::Constant(0.5), 200, together, 10 + n), columns(3), 1);
      squares += std::pow(fit.parameter[0].value - 1, 2) / kRepeats;
      claimed += std::pow(fit.parameter[0].deviation, 2) / kRepeats;
    }
    // 200 repeats tell a variance to 10 %; three times that.
    EXPECT_NEAR(claimed / squares, 1, 0.3) << "errors that last for " << together << " rows";
  }
}

TEST(WeightedFit, TrustsTheQuietJointMore) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(2) << 1, -2).finished();
  JointVector noise = JointVector::Constant(1.0);
  noise[5] = 1e-4;
  const TorqueFit fit = fit_torques(made_up(truth, noise, 100, 1, 3), columns(2), 0.3);
  EXPECT_LT((fit.values() - truth).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(fit.residual[0], 1, 0.3);
}

TEST(WeightedFit, WhatTheDataCannotTellLeaves) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(3) << 1, 0, -2).finished();
  const TorqueFit fit = fit_torques(made_up(truth, JointVector::Constant(0.1), 100, 1, 4), columns(3), 0.3);
  EXPECT_FALSE(fit.parameter[1].used);
  EXPECT_EQ(fit.parameter[1].value, 0);
  EXPECT_GT(fit.parameter[1].deviation, 0) << "says how well it was told when it left";
  EXPECT_TRUE(fit.parameter[0].used && fit.parameter[2].used);
  EXPECT_EQ(fit.dropped, 1);
}

TEST(WeightedFit, ImpossibleNegativesLeave) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(2) << 1, -2).finished();
  auto names = columns(2);
  names[1].positive = true;
  const TorqueFit fit = fit_torques(made_up(truth, JointVector::Zero(), 100, 1, 5), names, 0.3);
  EXPECT_FALSE(fit.parameter[1].used);
  EXPECT_TRUE(fit.parameter[0].used);
}

TEST(WeightedFit, TheWorstLeavesFirstAndTheRestIsFittedAgain) {
  // Two columns that say nearly the same: neither is told while both are there, one is when the other has left.
  Random random(6);
  TorqueRows data(2);
  for (int j = 0; j < kArmJoints; ++j) {
    for (int k = 0; k < 100; ++k) {
      const double a = 1 + random.normal();
      Eigen::RowVectorXd row(2);
      row << a, a + 1e-4 * random.normal();
      data.add(j, 100 * j + k, row, 3 * a + 0.1 * random.normal());
    }
  }
  const TorqueFit fit = fit_torques(data, columns(2), 0.3);
  EXPECT_EQ(fit.dropped, 1);
  EXPECT_NEAR(fit.values().sum(), 3, 0.02) << "what is left carries both";
}

TEST(WeightedFit, OneParameterAlwaysStays) {
  const Eigen::VectorXd truth = Eigen::VectorXd::Zero(2);
  const TorqueFit fit = fit_torques(made_up(truth, JointVector::Constant(1), 50, 1, 7), columns(2), 1e-6);
  EXPECT_EQ(fit.dropped, 1);
}

TEST(WeightedFit, ResidualIsTheNoiseOfEachJoint) {
  const Eigen::VectorXd truth = (Eigen::VectorXd(2) << 1, -2).finished();
  JointVector noise;
  noise << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  const TorqueFit fit = fit_torques(made_up(truth, noise, 2000, 1, 8), columns(2), 0.3);
  for (int j = 0; j < kArmJoints; ++j) EXPECT_NEAR(fit.residual[j] / noise[j], 1, 0.06) << j;  // 4 sigma of 2000 rows
}

TEST(TorqueRows, AppendKeepsGroupsApart) {
  TorqueRows a(1), b(1);
  a.add(0, 0, Eigen::RowVectorXd::Ones(1), 1);
  b.add(0, 0, Eigen::RowVectorXd::Ones(1), 3);
  b.add(2, 1, 2 * Eigen::RowVectorXd::Ones(1), 5);
  a.append(b);
  EXPECT_EQ(a.size(0), 2);
  EXPECT_EQ(a.size(2), 1);
  EXPECT_EQ(a.group_count(), 3);
  EXPECT_EQ(a.groups(0)[1], 1);
  EXPECT_EQ(a.stacked().rows(), 3);
  EXPECT_EQ(a.stacked()(2, 0), 2);
}

TEST(PredictionError, IsTheShareOfTheTorqueLeftOver) {
  TorqueRows data(1);
  for (int k = 0; k < 4; ++k) data.add(0, 0, Eigen::RowVectorXd::Ones(1), 2);
  TorqueFit fit;
  fit.parameter = columns(1);
  fit.parameter[0].value = 1.5;
  EXPECT_NEAR(prediction_error(fit, data)[0], 0.25, 1e-15);
}

}  // namespace
}  // namespace trocar::weighted_fit_test
