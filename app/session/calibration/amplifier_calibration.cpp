#include "app/session/calibration/amplifier_calibration.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

#include <Eigen/LU>

#include "app/session/calibration/calibration_file.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::array kProbeV{0.25, 0.5, 1.0, 2.0, 5.0};
constexpr double kSeenNm = 0.015;        // a probe that shows this much is believed to some per cent
constexpr int kSteps = 8, kRepeats = 4;  // levels to each side of 0, and how often each is visited
constexpr double kStepNm = 0.010;
constexpr double kOfFullScale = 0.97;
constexpr double kApproachNm = 0.015;  // the other side from which a level is approached

DacFrame codes_of(const ChannelVector& volts, const DeviceModel& model, int bits) {
  const double full = std::ldexp(1.0, bits - 1) - 1;
  DacFrame frame;
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    frame.codes[c] = static_cast<std::int32_t>(
        std::lround(std::clamp(volts[i] / model.transmission[c].full_scale_v, -1.0, 1.0) * full));
  }
  return frame;
}

/// What the codes ask for, V.
ChannelVector volts_of(const DacFrame& frame, const DeviceModel& model, int bits) {
  ChannelVector volts;
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    volts[i] = frame.codes[c] * model.transmission[c].full_scale_v / (std::ldexp(1.0, bits - 1) - 1);
  }
  return volts;
}

/// Torque per volt of each channel to some per cent: the command doubles until the channel's cell shows it.
ChannelVector probe(TorqueRig& rig, const DeviceModel& model, const ChannelVector& zero) {
  const int bits = rig.capabilities().dac_bits;
  ChannelVector gain = ChannelVector::Zero(), last = ChannelVector::Zero();
  for (const double v : kProbeV) {
    ChannelVector volts = ChannelVector::Zero();
    for (int i = 0; i < kChannels; ++i) volts[i] = gain[i] == 0 ? v : 0;
    const DacFrame codes = codes_of(volts, model, bits);
    last = rig.burst(codes, codes) - zero;
    for (int i = 0; i < kChannels; ++i) {
      if (gain[i] == 0 && std::abs(last[i]) > kSeenNm) gain[i] = last[i] / v;
    }
  }
  for (int i = 0; i < kChannels; ++i) {
    const std::string name = std::string("calibrate: ") + calibration_channel(i);
    if (gain[i] == 0) {
      std::ostringstream seen;
      seen << " shows no torque at " << kProbeV.back() << " V (" << std::fixed << std::setprecision(1) << last[i] * 1e3
           << " mN m): amplifier dead or inhibited";
      throw InputError(name + seen.str());
    }
    if (gain[i] < 0) throw InputError(name + " turns the wrong way: swap the motor's leads");
  }
  return gain;
}

struct AmplifierReading {
  ChannelVector volts, torque;
  double direction;
};

/// Every level from both sides.
std::vector<AmplifierReading> sweep(TorqueRig& rig, const DeviceModel& model, const ChannelVector& gain,
                                    const ChannelVector& zero) {
  const int bits = rig.capabilities().dac_bits;
  std::vector<AmplifierReading> readings;
  ChannelVector step;  // V; a weak amplifier is led less far, so that both approaches stay within the DAC's range
  for (int i = 0; i < kChannels; ++i) {
    const double reach =
        kOfFullScale * model.transmission[static_cast<std::size_t>(i)].full_scale_v - kApproachNm / gain[i];
    step[i] = std::min(kStepNm / gain[i], reach / kSteps);
  }
  for (int n = 0; n < kRepeats * (2 * kSteps + 1); ++n) {
    const int k = n % (2 * kSteps + 1) - kSteps;
    for (const double direction : {1.0, -1.0}) {
      const ChannelVector level = k * step;
      const ChannelVector from = level - (direction * kApproachNm * gain.array().inverse()).matrix();
      const DacFrame held = codes_of(level, model, bits);
      const ChannelVector torque = rig.burst(codes_of(from, model, bits), held) - zero;
      readings.push_back({volts_of(held, model, bits), torque, direction});
    }
  }
  return readings;
}

/// @param zero_sd of the cell's zero, N m. @param scale_sd of its scale.
ChannelCalibration fit(const std::vector<AmplifierReading>& readings, int channel, double torque_constant,
                       double zero_sd, double scale_sd) {
  Eigen::MatrixX3d A(readings.size(), 3);
  Eigen::VectorXd y(readings.size());
  for (Eigen::Index n = 0; n < y.size(); ++n) {
    const AmplifierReading& r = readings[static_cast<std::size_t>(n)];
    A.row(n) << r.volts[channel], 1, -r.direction;
    y[n] = r.torque[channel];
  }
  const Mat3 normal_inverse = (A.transpose() * A).inverse();
  const Vec3 x = normal_inverse * (A.transpose() * y);
  const double squares = (A * x - y).squaredNorm(), variance = squares / static_cast<double>(y.size() - 3);
  ChannelCalibration c;
  c.amps_per_volt = x[0] / torque_constant;
  c.amps_per_volt_sd =
      std::hypot(std::sqrt(variance * normal_inverse(0, 0)) / torque_constant, scale_sd * c.amps_per_volt);
  c.offset_v = x[1] / x[0];
  c.offset_sd_v = std::hypot(std::sqrt(variance * normal_inverse(1, 1)), zero_sd) / x[0];
  c.stiction_nm = x[2];
  c.residual_nm = std::sqrt(squares / static_cast<double>(y.size()));
  return c;
}

}  // namespace

AmplifierCalibration calibrate_amplifiers(TorqueRig& rig, const DeviceModel& nominal) {
  const TorqueRig::Zero zero = rig.rest();
  const ChannelVector gain = probe(rig, nominal, zero.mean);
  const std::vector<AmplifierReading> readings = sweep(rig, nominal, gain, zero.mean);
  AmplifierCalibration found;
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    found[c] = fit(readings, i, nominal.transmission[c].torque_constant, zero.sd[i], rig.cell().scale_sd);
  }
  return found;
}

DeviceModel calibrated(DeviceModel model, const AmplifierCalibration& found) {
  for (std::size_t c = 0; c < found.size(); ++c) {
    model.transmission[c].amps_per_volt = found[c].amps_per_volt;
    model.transmission[c].offset_v = found[c].offset_v;
  }
  return model;
}

ChannelVector rendering_error(TorqueRig& rig, const DeviceModel& model) {
  const int bits = rig.capabilities().dac_bits;
  const ChannelVector zero = rig.rest().mean;
  ChannelVector worst = ChannelVector::Zero();
  const auto frame = [&](double motor_nm) {
    ChannelVector joint;
    for (int i = 0; i < kChannels; ++i) joint[i] = motor_nm / model.transmission[static_cast<std::size_t>(i)].ratio;
    return dac_codes(model, joint, bits);
  };
  for (const double asked : {-0.075, -0.040, 0.040, 0.075}) {
    const ChannelVector below = rig.burst(frame(asked - kApproachNm), frame(asked)) - zero;
    const ChannelVector above = rig.burst(frame(asked + kApproachNm), frame(asked)) - zero;
    const ChannelVector off = (0.5 * (below + above) / asked).array() - 1;
    worst = worst.cwiseMax(off.cwiseAbs());
  }
  return worst;
}

}  // namespace trocar
