// The drives weighed by a force sensor at the held stylus: what the device of a seed really gives, through the sensors'
// drivers, and an identification that no longer mistakes an amplifier's gain for a weight.
#include "app/studies/device/drive_weighing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/session/calibration/torque_rig.h"
#include "app/studies/device/identified_device.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar::drive_weighing_test {
namespace {

/// Torque that came over torque asked for, of the device as it is.
double true_scale(const PlantParameters& truth, int joint) {
  const auto c = static_cast<std::size_t>(joint);
  const ChannelParameters& p = truth.channel[c];
  return p.amplifier_gain * p.dac_gain * p.torque_constant / p.ratio / torque_per_volt(nominal_transmissions()[c]);
}

double stylus_weight(const Identification& id) { return id.device.identified_gravity->link2.x() / kLink2; }

TEST(DriveWeighing, FindsWhatEachDriveGivesThroughEitherSensor) {
  const PlantParameters truth = draw_everything(5);  // torque constants up to 5 % off
  double most_off = 0;
  for (const std::string line : {"net-ft", "serial"}) {
    const DriveWeighing found = weigh_drives(truth, {}, line, 5);
    EXPECT_EQ(found.left_out, 0) << line;
    EXPECT_GT(found.taken, 1000) << line;
    for (int j = 0; j < kArmJoints; ++j) {
      EXPECT_NEAR(found.scale[j], true_scale(truth, j), 0.01) << line << ", joint " << j + 1;
      EXPECT_LT(found.deviation[j], 0.005) << line << ", joint " << j + 1;
      most_off = std::max(most_off, std::abs(true_scale(truth, j) - 1));
    }
  }
  EXPECT_GT(most_off, 0.03) << "or there was nothing to find";
}

TEST(DriveWeighing, WeightsComeOutInNewtonsAndTheCalibrationRenders) {
  const PlantParameters truth = draw_everything(5);
  const IdentifyRequest request = seeded_identification(5, true);
  const DriveWeighing drives = weigh_drives(truth, {}, "net-ft", 5);
  const Identification id = identify_simulated(truth, request, weighed({}, drives)),
                       blind = identify_simulated(truth, request);
  const double weight = kGravity * truth.stylus_mass;
  EXPECT_NEAR(stylus_weight(id) / weight, 1, 0.01);
  EXPECT_LT(std::abs(stylus_weight(id) - weight), 0.5 * std::abs(stylus_weight(blind) - weight));

  SimulatedDaqConfig device;
  device.plant = truth;
  TorqueRig rig(device, perfect_cell(), 1);
  const DeviceModel calibrated_by_sensor = calibrated({}, as_calibration(drives, id));
  const JointVector error = rendering_error(rig, calibrated_by_sensor).head<kArmJoints>(),
                    before = rendering_error(rig, {}).head<kArmJoints>();
  EXPECT_LT(error.maxCoeff(), 0.02);
  EXPECT_GT(before.maxCoeff(), 0.03);
}

TEST(DriveWeighing, ADriveFarOffIsNamed) {
  PlantParameters truth = nominal_parameters();
  truth.channel[2].amplifier_gain *= 5;  // the thesis' amplifiers
  try {
    weigh_drives(truth, {}, "net-ft", 1);
    FAIL() << "a drive of five times the torque was taken";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("joint 3"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace trocar::drive_weighing_test
