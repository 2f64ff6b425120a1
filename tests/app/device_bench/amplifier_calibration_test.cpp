// Calibration of the amplifiers: found against the plant's true values, which the procedure is never told.
#include "app/session/calibration/amplifier_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/device/device_calibrate.h"
#include "app/session/calibration/calibration_file.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::amplifier_calibration_test {
namespace {

SimulatedDaqConfig device(std::uint64_t seed, double gain) {
  SimulatedDaqConfig config;
  config.plant = draw_parameters(seed);
  for (ChannelParameters& c : config.plant->channel) c.amplifier_gain *= gain;
  return config;
}

/// A/V that the whole chain of a channel has, counted on the nominal torque constant.
double true_gain(const ChannelParameters& c) { return c.amplifier_gain * c.dac_gain * c.torque_constant / 0.0232; }

class Gains : public ::testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(Gains, AreFoundWithinHalfAPercentWhateverTheyAre) {
  const auto [seed, gain] = GetParam();
  const SimulatedDaqConfig config = device(static_cast<std::uint64_t>(seed), gain);
  TorqueRig rig(config, {}, 1000 + static_cast<std::uint64_t>(seed));
  const AmplifierCalibration found = calibrate_amplifiers(rig, DeviceModel{});
  for (std::size_t i = 0; i < found.size(); ++i) {
    const ChannelParameters& truth = config.plant->channel[i];
    EXPECT_NEAR(found[i].amps_per_volt / true_gain(truth), 1, 0.005) << "channel " << i;
    EXPECT_LT(std::abs(found[i].amps_per_volt - true_gain(truth)), 4.5 * found[i].amps_per_volt_sd) << "channel " << i;
    const double offset = truth.dac_offset / truth.dac_gain;  // before the DAC's gain, where codes are
    EXPECT_LT(std::abs(found[i].offset_v - offset), 4.5 * found[i].offset_sd_v) << "channel " << i;
    EXPECT_LT(found[i].offset_sd_v, 1e-3 / gain) << "the weaker the amplifier, the more volts a torque stands for";
    EXPECT_NEAR(found[i].stiction_nm, 0.86e-3, 0.05e-3) << "the rig's own brushes";
  }
}
INSTANTIATE_TEST_SUITE_P(Devices, Gains,
                         ::testing::Combine(::testing::Values(1, 2, 3, 4), ::testing::Values(0.4, 1.0, 5.0, 8.0)));

/// Motor torque that the plant delivers for a joint torque asked of a model, shaft held, from the plant itself.
ChannelVector delivered(const SimulatedDaqConfig& config, const DeviceModel& model, double motor_nm) {
  SimulatedDaq daq(config);
  ChannelVector joint;
  for (int i = 0; i < kChannels; ++i) joint[i] = motor_nm / model.transmission[static_cast<std::size_t>(i)].ratio;
  daq.arm(true);
  for (int k = 0; k < 20; ++k) {
    daq.write(dac_codes(model, joint, 16));
    daq.read();
  }
  ChannelVector motor = daq.plant().motor_loads();
  for (int i = 0; i < kChannels; ++i) motor[i] *= config.plant->channel[static_cast<std::size_t>(i)].ratio;
  return motor;
}

TEST(Calibration, TheThesisGainOfFiveIsCalibratedOut) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const SimulatedDaqConfig config = device(seed, 5);
    TorqueRig rig(config, {}, seed);
    const DeviceModel nominal, corrected = calibrated(nominal, calibrate_amplifiers(rig, nominal));
    for (const double asked : {-0.09, -0.03, 0.01, 0.05, 0.10}) {
      const ChannelVector with = delivered(config, corrected, asked), without = delivered(config, nominal, asked);
      for (int i = 0; i < kChannels; ++i) {
        EXPECT_NEAR(with[i] / asked, 1, 0.01) << "channel " << i << " at " << asked << " N m";
        const bool within_supply = std::abs(asked) <= 0.03;
        EXPECT_GT(without[i] / asked, within_supply ? 4.5 : 1.2) << "uncalibrated it is five times as strong";
      }
    }
  }
}

TEST(Calibration, StandardDeviationsAreHonest) {
  // Errors over many rigs and devices in units of the standard deviation given: their RMS is 1 when it is honest.
  double gain = 0, offset = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const SimulatedDaqConfig config = device(seed, 1);
    TorqueRig rig(config, {}, 77 * seed);
    const AmplifierCalibration found = calibrate_amplifiers(rig, DeviceModel{});
    for (std::size_t i = 0; i < found.size(); ++i, ++n) {
      const ChannelParameters& truth = config.plant->channel[i];
      gain += std::pow((found[i].amps_per_volt - true_gain(truth)) / found[i].amps_per_volt_sd, 2);
      offset += std::pow((found[i].offset_v - truth.dac_offset / truth.dac_gain) / found[i].offset_sd_v, 2);
    }
  }
  EXPECT_NEAR(std::sqrt(gain / n), 1, 0.15);  // 280 errors: 4 % of spread
  EXPECT_NEAR(std::sqrt(offset / n), 1, 0.15);
}

TEST(Calibration, WorksAtEveryRateAndWithACoarseDac) {
  for (const auto& [rate, bits] : {std::pair(1000.0, 12), std::pair(2000.0, 16), std::pair(4000.0, 14)}) {
    SimulatedDaqConfig config = device(5, 5);
    config.rate_hz = rate;
    config.dac_bits = bits;
    TorqueRig rig(config, {}, 5);
    const AmplifierCalibration found = calibrate_amplifiers(rig, DeviceModel{});
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].amps_per_volt / true_gain(config.plant->channel[i]), 1, 0.005)
          << rate << " Hz, " << bits << " bits";
    }
  }
}

TEST(Calibration, ATorqueConstantThatIsOffComesRightWithTheGain) {
  SimulatedDaqConfig config = device(6, 1);
  for (ChannelParameters& c : config.plant->channel) c.torque_constant *= 0.97;
  TorqueRig rig(config, {}, 6);
  const DeviceModel nominal, corrected = calibrated(nominal, calibrate_amplifiers(rig, nominal));
  const ChannelVector with = delivered(config, corrected, 0.05), without = delivered(config, nominal, 0.05);
  for (int i = 0; i < kChannels; ++i) {
    EXPECT_NEAR(with[i] / 0.05, 1, 0.006) << i;
    EXPECT_LT(without[i] / 0.05, 0.99) << i;
  }
}

TEST(Calibration, LeavesWhatItDoesNotMeasure) {
  const DeviceModel nominal;
  AmplifierCalibration found{};
  for (ChannelCalibration& c : found) c.amps_per_volt = 0.5, c.offset_v = 0.01;
  const DeviceModel model = calibrated(nominal, found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(model.transmission[i].amps_per_volt, 0.5);
    EXPECT_EQ(model.transmission[i].offset_v, 0.01);
    EXPECT_EQ(model.transmission[i].ratio, nominal.transmission[i].ratio);
    EXPECT_EQ(model.transmission[i].torque_constant, nominal.transmission[i].torque_constant);
  }
  EXPECT_EQ(model.stylus_weight_n, nominal.stylus_weight_n);
}

TEST(Calibration, RenderingErrorTellsAGoodModelFromABadOne) {
  const SimulatedDaqConfig config = device(7, 1);
  TorqueRig rig(config, {}, 7);
  const DeviceModel nominal, corrected = calibrated(nominal, calibrate_amplifiers(rig, nominal));
  EXPECT_LT(rendering_error(rig, corrected).maxCoeff(), 0.005);
  DeviceModel wrong = corrected;
  wrong.transmission[2].amps_per_volt *= 1.05;
  const ChannelVector error = rendering_error(rig, wrong);
  EXPECT_NEAR(error[2], 1 - 1 / 1.05, 0.005);
  EXPECT_LT(error[3], 0.005) << "the others are as good as before";
}

TEST(Calibration, ADeadChannelAndAReversedOneAreNamed) {
  for (const auto& [gain, words] : {std::pair(0.0, "shows no torque at 5 V"), std::pair(-1.0, "turns the wrong way")}) {
    SimulatedDaqConfig config = device(1, 1);
    config.plant->channel[3].amplifier_gain *= gain;
    TorqueRig rig(config, {}, 1);
    try {
      calibrate_amplifiers(rig, DeviceModel{});
      ADD_FAILURE() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("joint 4"), std::string::npos) << error.what();
    }
  }
}

TEST(TorqueRig, BrushesHideTorqueFromTheSideItCameFrom) {
  TorqueCellConfig cell = perfect_cell();
  cell.stiction_nm = 1e-3;
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  TorqueRig rig(config, cell, 1);
  const auto at = [](double volts) {
    DacFrame codes;
    codes.codes.fill(static_cast<std::int32_t>(std::lround(volts / 10 * 32767)));
    return codes;
  };
  const double below = rig.burst(at(2), at(4))[0], above = rig.burst(at(6), at(4))[0];
  EXPECT_NEAR(above - below, 2e-3, 1e-9);
  EXPECT_NEAR(0.5 * (above + below), 4 * 0.431 * 0.0232, 1e-6) << "a step of the DAC is 3 uN m";
  EXPECT_EQ(rig.rest().mean.cwiseAbs().maxCoeff(), 0) << "turned free by hand, nothing remains";
}

TEST(TorqueRig, ZeroHasTheNoiseThatItSays) {
  SimulatedDaqConfig config;
  config.plant = nominal_parameters();
  TorqueRig one(config, {}, 9), other(config, {}, 10);
  const TorqueRig::Zero a = one.rest(), b = one.rest(), c = other.rest();
  for (int i = 0; i < kChannels; ++i) {
    EXPECT_NEAR(a.sd[i], 0.3e-3 / std::sqrt(2000.0), 0.1 * 0.3e-3 / std::sqrt(2000.0)) << "2 s at 1 kHz";
    EXPECT_LT(std::abs(a.mean[i] - b.mean[i]), 6 * a.sd[i]) << "the zero stays, the noise does not";
    EXPECT_NE(a.mean[i], b.mean[i]);
    EXPECT_LE(std::abs(a.mean[i]), 2e-3 + 5 * a.sd[i]);
  }
  EXPECT_GT((a.mean - c.mean).cwiseAbs().maxCoeff(), 10 * a.sd[0]) << "another rig has other zeros";
}

TEST(TorqueRig, JigStaysClosedHoweverLongItIsUsed) {
  SimulatedDaqConfig config = device(2, 1);
  TorqueRig rig(config, perfect_cell(), 1);
  DacFrame codes;
  codes.codes.fill(8000);
  const ChannelVector first = rig.burst(codes, codes);
  ChannelVector last;
  for (int k = 0; k < 100; ++k) last = rig.burst(codes, codes);
  EXPECT_LT((first - last).cwiseAbs().maxCoeff(), 1e-12) << "nothing has moved";
}

TEST(Offset, OfTheChainIsTakenOffTheCommandAndComesBack) {
  DeviceModel model;
  model.transmission[1].offset_v = 0.02;
  const ChannelVector asked = ChannelVector::Constant(0.05);
  const DacFrame plain = dac_codes(DeviceModel{}, asked, 16), shifted = dac_codes(model, asked, 16);
  EXPECT_EQ(plain.codes[0], shifted.codes[0]);
  EXPECT_NEAR(plain.codes[1] - shifted.codes[1], 0.02 / 10 * 32767, 1.01);
  EXPECT_NEAR(torques_of(model, shifted, 16)[1], 0.05, 2e-5) << "half a step of the DAC";
}

TEST(DeviceCalibrate, WritesWhatItFoundAndTheSameEveryTime) {
  test::TemporaryFolder folder;
  std::ostringstream out, again, err;
  CalibrateOptions options{3, 5, true, folder / "calibration.json", {}};
  EXPECT_EQ(device_calibrate(options, out, err), 0);
  EXPECT_EQ(device_calibrate(options, again, err), 0);
  EXPECT_EQ(out.str(), again.str());
  std::ifstream file(folder / "calibration.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json, nlohmann::json::parse(out.str()));
  ASSERT_EQ(json.at("channels").size(), 7u);
  for (const auto& channel : json.at("channels")) {
    EXPECT_NEAR(channel.at("gain_over_nominal").get<double>(), 5, 0.08);
    EXPECT_LT(channel.at("amps_per_volt_sd").get<double>(), 0.01);
  }
  options.out = folder / "no" / "such" / "folder.json";
  EXPECT_THROW(device_calibrate(options, out, err), EnvironmentError);
  options = {1, -2, false, {}, {}};
  EXPECT_THROW(device_calibrate(options, out, err), InputError);
  options.gain = std::nan("");
  EXPECT_THROW(device_calibrate(options, out, err), InputError);
}

}  // namespace
}  // namespace trocar::amplifier_calibration_test
