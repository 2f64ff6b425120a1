// The curves of the motor study, read back from its CSV columns and held to what a permanent-magnet motor must do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/session/calibration/torque_rig.h"
#include "app/studies/device/motor_study.h"
#include "haptics/device/device_model.h"
#include "haptics/device/transmission.h"

namespace trocar::motor_curves_test {
namespace {

constexpr double kOhm = 2.32, kPerAmp = 0.0232, kRpm = 60 / (2 * std::numbers::pi);

const StudyResult& study() {
  static const StudyResult result = motor_study({false, 1});
  return result;
}

const StudyCurves& curve(const std::string& file) {
  for (const StudyCurves& c : study().curves) {
    if (c.file == file) return c;
  }
  ADD_FAILURE() << "no curve " << file;
  return study().curves.front();
}

/// Slope of the finite points of a series by least squares, and the largest distance from that line.
struct Line {
  double slope = 0, at_zero = 0, off = 0;
};
Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(y[i])) continue;
    n += 1, sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  }
  Line line;
  line.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  line.at_zero = (sy - line.slope * sx) / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(y[i])) line.off = std::max(line.off, std::abs(y[i] - line.at_zero - line.slope * x[i]));
  }
  return line;
}

TEST(MotorCurves, SpeedFallsOnAStraightLineOfTheSameSlopeAtEveryVoltage) {
  // dw/dT = -R / k^2, which the thesis takes from the literature as constant.
  const double slope = -kOhm / (kPerAmp * kPerAmp) * kRpm * 1e-3;  // rpm per mN m
  const StudyCurves& low = curve("speed_torque_1v_5v");
  ASSERT_EQ(low.series.size(), 5u);
  for (std::size_t v = 0; v < 5; ++v) {
    const Line line = line_through(low.x, low.series[v].y);
    EXPECT_NEAR(line.slope / slope, 1, 0.002) << v + 1 << " V";
    EXPECT_NEAR(line.at_zero, static_cast<double>(v + 1) / kPerAmp * kRpm, 1.0) << "no-load speed, rpm";
    EXPECT_LT(line.off, 1.0) << "rpm";
  }
  const StudyCurves& nominal = curve("speed_torque_24v");
  EXPECT_NEAR(line_through(nominal.x, nominal.series[0].y).slope / slope, 1, 0.002) << "24 V";
}

TEST(MotorCurves, EachVoltageEndsAtItsStall) {
  const StudyCurves& low = curve("speed_torque_1v_5v");
  for (std::size_t v = 0; v < 5; ++v) {
    double last = 0;
    for (std::size_t i = 0; i < low.x.size(); ++i) {
      if (std::isfinite(low.series[v].y[i])) last = low.x[i];
    }
    EXPECT_NEAR(last, 10.0 * static_cast<double>(v + 1), 0.65) << "mN m, a step of the sweep is 0.625";
  }
}

TEST(MotorCurves, CurrentIsTorqueOverTheConstantWhateverTheVoltage) {
  for (const char* file : {"current_torque_24v", "current_torque_5v"}) {
    const StudyCurves& c = curve(file);
    const Line line = line_through(c.x, c.series[0].y);
    EXPECT_NEAR(line.slope, 1 / 23.2, 1e-4) << file;  // A per mN m
    EXPECT_NEAR(line.at_zero, 0, 1e-3) << file;
    EXPECT_LT(line.off, 1e-3) << file;
  }
}

TEST(MotorCurves, CommandIsAsStrongToBothSides) {
  const StudyCurves& c = curve("torque_command");
  const auto& y = c.series[0].y;
  EXPECT_NEAR(c.x.front(), -10, 1e-9);
  EXPECT_NEAR(c.x.back(), 10, 1e-9);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], -y[y.size() - 1 - i], 1e-9) << c.x[i];
  EXPECT_NEAR(y.back(), 100, 0.1) << "mN m at full scale";
}

TEST(MotorCurves, CommandInMotionIsFlatThenFallsWithTheSupply) {
  const StudyCurves& c = curve("torque_speed_command");
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    const double speed = c.x[i] / kRpm, supply = (24 - kPerAmp * speed) / kOhm * kPerAmp * 1e3;
    EXPECT_NEAR(c.series[0].y[i], std::clamp(supply, 0.0, 5 * 0.431 * 23.2), 0.01) << c.x[i] << " rpm";
    const double leads = (5 - kPerAmp * speed) / kOhm * kPerAmp * 1e3;
    if (!std::isfinite(c.series[1].y[i])) continue;
    EXPECT_NEAR(c.series[1].y[i], leads, 0.01) << c.x[i] << " rpm";
  }
}

TEST(MotorPoint, LoadsOfBothSignsOfVoltageDoNotRunAway) {
  for (const double volts : {0.5, 12.0, 24.0}) {
    const MotorPoint free = loaded_motor(volts, 0), half = loaded_motor(volts, 0.5 * volts / kOhm * kPerAmp);
    EXPECT_NEAR(half.speed_rad_s, 0.5 * free.speed_rad_s, 0.02);
    EXPECT_LT(free.current_a, 0.001 * volts / kOhm + 1e-4) << "nothing to carry, no current";
    EXPECT_GE(free.speed_rad_s, 0);
  }
  EXPECT_EQ(loaded_motor(0.5, 1.0).speed_rad_s, 0) << "far beyond stall it stands and is not driven backwards";
}

TEST(TorqueRig, ReadsWhatTheTransmissionAsksFor) {
  // The seam's own arithmetic, joint torque to code and back, against the torque at the shaft.
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  const DeviceModel model;
  TorqueRig rig(device, perfect_cell(), 1);
  for (const double share : {-1.0, -0.4, 0.05, 0.6, 1.0}) {
    ChannelVector joint;
    for (int i = 0; i < kChannels; ++i)
      joint[i] = share * max_joint_torque(model.transmission[static_cast<std::size_t>(i)]);
    const DacFrame codes = dac_codes(model, joint, 16);
    const ChannelVector read = rig.burst(codes, codes), asked = torques_of(model, codes, 16);
    for (int i = 0; i < kChannels; ++i) {
      const double ratio = model.transmission[static_cast<std::size_t>(i)].ratio;
      EXPECT_NEAR(read[i], asked[i] * ratio, 1e-9) << "channel " << i << ", share " << share;
      EXPECT_NEAR(read[i], joint[i] * ratio, 2e-6 + 1e-9) << "half a step of the DAC is 1.5 uN m";
    }
  }
}

TEST(TorqueRig, SameSeedSameReadings) {
  SimulatedDaqConfig device;
  device.seed = 3;
  TorqueRig one(device, {}, 5), two(device, {}, 5), other(device, {}, 6);
  DacFrame codes;
  codes.codes.fill(5000);
  const ChannelVector a = one.burst(codes, codes), b = two.burst(codes, codes), c = other.burst(codes, codes);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
}

TEST(TorqueRig, NoiseAveragesAwayAndScaleDoesNot) {
  SimulatedDaqConfig device;
  device.plant = nominal_parameters();
  TorqueCellConfig cell = perfect_cell();
  cell.scale_sd = 0.01;
  TorqueRig scaled(device, cell, 2);
  DacFrame codes;
  codes.codes.fill(16384);  // 5 V
  const ChannelVector once = scaled.burst(codes, codes), again = scaled.burst(codes, codes);
  EXPECT_LT((once - again).cwiseAbs().maxCoeff(), 1e-12) << "an error of scale repeats";
  EXPECT_GT((once.array() / once.mean() - 1).abs().maxCoeff(), 1e-3) << "and differs from cell to cell";
  cell = perfect_cell();
  cell.noise_nm = 1e-3;
  TorqueRig noisy(device, cell, 2);
  double sum = 0, squares = 0;
  constexpr int kBursts = 200;
  for (int n = 0; n < kBursts; ++n) {
    const double v = noisy.burst(codes, codes)[0];
    sum += v, squares += v * v;
  }
  const double mean = sum / kBursts, sd = std::sqrt(squares / kBursts - mean * mean);
  EXPECT_NEAR(sd, 1e-3 / 5, 0.2e-3 / 5) << "25 samples a burst";
  EXPECT_NEAR(mean, 5.0002 * 0.431 * 0.0232, 4 * sd / std::sqrt(kBursts) + 1e-5);
}

}  // namespace
}  // namespace trocar::motor_curves_test
