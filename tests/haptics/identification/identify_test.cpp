// The whole identification on simulated devices whose parameters it is never told.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "haptics/control/gravity.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/identification/identify.h"
#include "haptics/identification/measured_rows.h"
#include "haptics/input_error.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::identify_test {
namespace {

IdentifyRequest small(std::uint64_t seed) {
  IdentifyRequest request;
  request.seed = seed;
  request.poses = 20;
  request.trajectories = 1;
  request.candidates = 5;
  return request;
}

struct Outcome {
  PlantParameters truth;
  Identification id;
};

const Outcome& of_seed(std::uint64_t seed) {
  static std::map<std::uint64_t, Outcome> known;
  const auto found = known.find(seed);
  if (found != known.end()) return found->second;
  SimulatedDaqConfig config;
  config.plant = draw_parameters(seed);
  SimulatedDaq daq(config);
  return known.emplace(seed, Outcome{*config.plant, identify(daq, {}, small(seed))}).first->second;
}

/// rms over poses of the weight that a model leaves, over that of the weight itself.
double weight_left(const PlantParameters& truth, const DeviceModel& model) {
  DevicePlant plant(truth);
  double left = 0, whole = 0;
  for (const StaticPose& pose : draw_static_poses(77, 100, 1, {})) {
    plant.place(pose.q, 0.02);
    left += (gravity_torque(model, arm_state(pose.q)) - plant.holding_torque()).squaredNorm();
    whole += plant.holding_torque().squaredNorm();
  }
  return std::sqrt(left / whole);
}

TEST(Identify, FindsTheWeightBetterThanTheDocumentsDo) {
  for (const std::uint64_t seed : {2u, 5u}) {
    const Outcome& o = of_seed(seed);
    const double nominal = weight_left(o.truth, {}), found = weight_left(o.truth, o.id.device);
    EXPECT_LT(found, 0.015) << "gain errors of 1 % are all that is left";
    EXPECT_LT(found, nominal);
  }
}

TEST(Identify, FindsTheFrictionOfEachJoint) {
  for (const std::uint64_t seed : {2u, 5u}) {
    const Outcome& o = of_seed(seed);
    for (int i = 0; i < kArmJoints; ++i) {
      const FrictionParameters& f = o.truth.channel[i].friction;
      EXPECT_NEAR(o.id.device.coulomb[i] / f.coulomb, 1, 0.10) << "seed " << seed << ", joint " << i + 1;
      EXPECT_NEAR(o.id.device.viscous[i] / f.viscous, 1, 0.5) << "a tenth of the Coulomb friction at these speeds; "
                                                              << "seed " << seed << ", joint " << i + 1;
      EXPECT_NEAR(o.id.poses.coulomb[i], f.coulomb + 0.15 * f.viscous, 0.1 * f.coulomb + 5e-4);
    }
  }
}

TEST(Identify, FindsTheInertiasThatMatter) {
  const Outcome& o = of_seed(5);
  const auto value = [&](const std::string& name) {
    for (const FitParameter& p : o.id.fit.parameter) {
      if (p.name == name) return p.value;
    }
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(value("4.Izz") / (o.truth.stylus_mass * 0.128 * 0.128), 1, 0.05);
  EXPECT_NEAR(value("4.mx") / (o.truth.stylus_mass * 0.128), 1, 0.015);
  EXPECT_NEAR(value("rotor 5") / (10.3e-7 / (0.23 * 0.23)), 1, 0.15);
  EXPECT_NEAR(value("rotor 6") / (10.3e-7 / (0.23 * 0.23)), 1, 0.15);
}

TEST(Identify, PredictsATrajectoryThatItHasNotSeen) {
  const Outcome& o = of_seed(5);
  EXPECT_LT(o.id.moving_error.maxCoeff(), 0.03);
  EXPECT_LT(o.id.prediction_error.head<4>().maxCoeff(), 0.03) << "with the reversals, where friction is no constant";
  EXPECT_LT(o.id.prediction_error.maxCoeff(), 0.05);
  EXPECT_LT((o.id.prediction_error - o.id.nominal_error).maxCoeff(), 0.005);
  EXPECT_EQ(o.id.unseen_t.size(), o.id.unseen_torque.size());
  EXPECT_EQ(o.id.unseen_t.size(), o.id.unseen_predicted.size());
  EXPECT_GT(o.id.unseen_t.size(), 400u);
}

TEST(Identify, IsPhysicallyConsistentAndCool) {
  const Outcome& o = of_seed(5);
  EXPECT_TRUE(o.id.doubts.empty());
  EXPECT_GT(o.id.least_inertia, 0);
  EXPECT_LT(o.id.hottest_c, 110) << "motors fade there";
  EXPECT_LT(o.id.condition, 60);
  for (const FitParameter& p : o.id.fit.parameter) {
    EXPECT_TRUE(!p.used || p.deviation <= 0.3 * std::abs(p.value)) << p.name;
    EXPECT_TRUE(p.used || p.value == 0) << p.name;
  }
}

TEST(Identify, SameDeviceSameSeedSameResult) {
  SimulatedDaqConfig config;
  config.plant = of_seed(5).truth;
  SimulatedDaq daq(config);
  const Identification again = identify(daq, {}, small(5));
  EXPECT_EQ(again.fit.values(), of_seed(5).id.fit.values());
}

TEST(Identify, RefusesTooLittleExcitationWithTheConditionNumber) {
  SimulatedDaqConfig config;
  SimulatedDaq daq(config);
  IdentifyRequest timid = small(1);
  timid.span = 0.05;
  try {
    identify(daq, {}, timid);
    FAIL() << "was not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("condition number"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("span 0.05"), std::string::npos) << e.what();
  }
}

TEST(Identify, EndsWithAMessageWhenTheDeviceFails) {
  for (const InjectedFaultKind kind : {InjectedFaultKind::kEncoderJump, InjectedFaultKind::kEncoderStuck}) {
    SimulatedDaqConfig config;
    InjectedFault fault;
    fault.kind = kind;
    fault.channel = 1;
    fault.at_s = 12;
    fault.value = 400;
    config.faults.push_back(fault);
    SimulatedDaq daq(config);
    EXPECT_THROW(identify(daq, {}, small(1)), EnvironmentError);
    EXPECT_FALSE(daq.plant().amplifiers_enabled()) << "the servo lets go of a device that it gives up";
  }
}

TEST(MeasuredRows, ATrajectoryOfKnownMotionGivesTheRegressorOfThatMotion) {
  const BaseSet base = base_parameters();
  const auto q_at = [](double t) {
    return JointVector(test::degrees(45, 45, 45, -60, -75, 0) + 0.3 * std::sin(2 * t) * JointVector::Ones());
  };
  Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(column_count(base), 0.1, 1);
  truth.tail(3 * kArmJoints) *= 0.01;
  MotionTrace trace;
  for (int k = 0; k < 3000; ++k) {
    const double t = k * 1e-3;
    const JointVector qd = 0.6 * std::cos(2 * t) * JointVector::Ones(),
                      qdd = -1.2 * std::sin(2 * t) * JointVector::Ones();
    JointVector tau = base.columns(torque_regressor(q_at(t), qd, qdd)) * truth.head(base.size());
    for (int i = 0; i < kArmJoints; ++i) {
      tau[i] += truth[base.size() + i] * (qd[i] > 0 ? 1 : -1) + truth[base.size() + kViscousColumn + i] * qd[i] +
                truth[base.size() + kOffsetColumn + i];
    }
    trace.q.push_back(q_at(t));
    trace.tau.push_back(tau);
  }
  TorqueRows all(column_count(base)), moving(column_count(base));
  add_trajectory(trace, base, false, all);
  add_trajectory(trace, base, true, moving);
  EXPECT_LT(moving.size(0), all.size(0));
  TorqueFit fit;
  fit.parameter = fit_columns(base);
  for (int k = 0; k < truth.size(); ++k) fit.parameter[static_cast<std::size_t>(k)].value = truth[k];
  // What is left: the angles were smoothed before the regressor, the torques after it (0.6 rad/s, 10 ms).
  EXPECT_LT(prediction_error(fit, all).maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace trocar::identify_test
