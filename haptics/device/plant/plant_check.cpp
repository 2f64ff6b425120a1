#include "haptics/device/plant/plant_check.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <sstream>

#include "haptics/device/plant/device_plant.h"
#include "haptics/device/plant/plant_fields.h"

namespace trocar {
namespace {

using Refusal = std::optional<PlantRefusal>;

constexpr double kRounding = 1e-9;    // of the largest principal moment
constexpr double kMissedHome = 1e-6;  // m: Newton's method ends far below this when the links reach
constexpr int kMostJitter = 63;       // periods, the ring of the simulated back-end

std::string in_words(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// By the sign that a field's lower bound asks for.
Refusal sign_refusal(const char* table, const char* key, double low, double value, bool endless = false) {
  if (endless && std::isinf(value)) return {};
  if (!std::isfinite(value)) return PlantRefusal{table, key, "must be finite"};
  if (low > 0 && value <= 0) return PlantRefusal{table, key, "must be positive, not " + in_words(value)};
  if (low == 0 && value < 0) return PlantRefusal{table, key, "must not be negative: " + in_words(value)};
  return {};
}

Refusal numbers_refusal(PlantParameters p) {
  for (const std::span<const PlantNumber> fields : {plant_numbers(), option_numbers()}) {
    for (const PlantNumber& f : fields) {
      if (Refusal r = sign_refusal(f.table, f.key, f.low, f.at(p))) return r;
    }
  }
  for (const PlantVector& f : plant_vectors()) {
    if (!f.at(p).allFinite()) return PlantRefusal{f.table, f.key, "must be finite"};
  }
  return {};
}

Refusal channel_refusal(PlantParameters p, int channel) {
  const bool pinch = channel == kPinchChannel;
  const char* table = pinch ? kPinchTable : kJointTables[channel];
  for (const ChannelNumber& f : pinch ? pinch_numbers() : joint_numbers()) {
    if (Refusal r = sign_refusal(table, f.key, f.low, f.at(p, channel), f.endless)) return r;
  }
  const ChannelParameters& c = p.channel[static_cast<std::size_t>(channel)];
  if (c.friction.stribeck_ratio < 1) {
    return PlantRefusal{table, "stribeck_ratio",
                        "is " + in_words(c.friction.stribeck_ratio) + ": breakaway below sliding friction cannot be"};
  }
  if (!(c.stop.lower < c.stop.upper)) {
    return PlantRefusal{table, pinch ? "stop_upper_m" : "stop_upper_rad",
                        "the upper stop must lie above the lower one"};
  }
  if (pinch) return {};
  for (const ChannelNumber& f : cable_numbers()) {
    if (Refusal r = sign_refusal("cable", f.key, f.low, f.at(p, channel))) return r;
  }
  if (p.options.cable[static_cast<std::size_t>(channel)].friction_on_motor > 1) {
    return PlantRefusal{"cable", "friction_on_motor", "is a share, at most 1"};
  }
  return {};
}

Refusal inertia_refusal(const PlantParameters& p) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(stylus_inertia_tensor(p), Eigen::EigenvaluesOnly);
  const Vec3 moment = eigen.eigenvalues();  // ascending
  if (!(moment[0] > 0)) {
    return PlantRefusal{"stylus", "inertia_kg_m2",
                        "is not positive definite: its least principal moment is " + in_words(moment[0]) + " kg m2"};
  }
  if (moment[2] > moment[0] + moment[1] + kRounding * moment[2]) {
    return PlantRefusal{"stylus", "inertia_kg_m2",
                        "no body has principal moments " + in_words(moment[0]) + ", " + in_words(moment[1]) + ", " +
                            in_words(moment[2]) + " kg m2: the largest exceeds the sum of the others"};
  }
  return {};
}

Refusal options_refusal(const PlantOptions& o) {
  if (o.encoder.missed_per_edge > 1) return PlantRefusal{"encoder", "missed_per_edge", "is a chance, at most 1"};
  if (o.jitter_periods < 0 || o.jitter_periods > kMostJitter) {
    return PlantRefusal{"delay", "jitter_periods", "is 0 to " + std::to_string(kMostJitter)};
  }
  return {};
}

Refusal home_refusal(const PlantParameters& p) {
  const JointVector home = home_joint_angles(p.link1, p.link2);
  const Vec3 jig(0, -0.006, -0.272);  // m, in W'
  const bool reached =
      home.allFinite() &&
      (stylus_pose(evaluate_kinematics(configuration_at(home), p.link1, p.link2)).p - jig).norm() < kMissedHome;
  if (!reached)
    return PlantRefusal{"arm", "link1_m", "the links do not reach the jig's home pose, 272 mm below the centre"};
  for (int i = 0; i < kArmJoints; ++i) {
    const StopParameters& stop = p.channel[static_cast<std::size_t>(i)].stop;
    const double at = home[i] + p.jig_error[i];
    if (at < stop.lower || at > stop.upper) {
      return PlantRefusal{kJointTables[i], at < stop.lower ? "stop_lower_rad" : "stop_upper_rad",
                          "the home pose, " + in_words(at) + " rad, lies beyond this stop"};
    }
  }
  const StopParameters& jaw = p.channel[kPinchChannel].stop;
  if (p.jig_jaw_opening < jaw.lower || p.jig_jaw_opening > jaw.upper) {
    return PlantRefusal{"jaw", "jig_opening_m", "lies beyond the pinch's stops"};
  }
  const Mat6 M = DevicePlant(p).mass_matrix();
  if (!M.allFinite() || Eigen::LLT<Mat6>(M).info() != Eigen::Success) {
    return PlantRefusal{"stylus", "mass_kg", "the arm's mass matrix at home is not positive definite"};
  }
  return {};
}

}  // namespace

Refusal plant_refusal(const PlantParameters& p) {
  if (Refusal r = numbers_refusal(p)) return r;
  for (int i = 0; i < kChannels; ++i) {
    if (Refusal r = channel_refusal(p, i)) return r;
  }
  if (Refusal r = inertia_refusal(p)) return r;
  if (Refusal r = options_refusal(p.options)) return r;
  return home_refusal(p);
}

}  // namespace trocar
