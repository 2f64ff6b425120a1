#include "app/studies/device/drive_weighing.h"

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "app/studies/device/held_stylus.h"
#include "haptics/device/transmission.h"
#include "haptics/identification/measured_rows.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kForce_n = 1.5, kMoment_nm = 0.15;
constexpr int kRepeats = 2;
constexpr double kMostOff = 0.5;

/// Wrenches in the stylus frame that the arm bears well at home: all but a force along X6.
std::array<Wrench, 5> rendered_wrenches() {
  const Vec3 none = Vec3::Zero();
  return {{{kForce_n * Vec3::UnitY(), none},
           {kForce_n * Vec3::UnitZ(), none},
           {none, kMoment_nm * Vec3::UnitX()},
           {none, kMoment_nm * Vec3::UnitY()},
           {none, kMoment_nm * Vec3::UnitZ()}}};
}

/// What came in every joint, N m, while the device rendered the wrench of the stylus frame.
JointVector came(HeldStylus& bench, const Wrench& w_S) {
  const auto read = [&](double sign) {
    return bench.read([asked_S = w_S * sign](const ArmState& arm) { return torques_of_wrench(arm, asked_S); });
  };
  const Wrench up = read(1), half = (up + read(-1) * -1) * 0.5;
  return torques_of_wrench(bench.arm(), half);
}

void require_drive(int j, double scale) {
  if (std::abs(scale - 1) <= kMostOff) return;
  std::ostringstream text;
  text << "identification: joint " << j + 1 << " gives " << std::lround(100 * scale)
       << " % of the torque that is asked of it, by the force sensor: trocar device calibrate comes first";
  throw InputError(text.str());
}

/// N m; the offsets stand after weights, inertias and friction.
double offset_deviation(const Identification& id, int j) {
  return id.fit.parameter[static_cast<std::size_t>(id.base.size() + kOffsetColumn + j)].deviation;
}

}  // namespace

DriveWeighing weigh_drives(const PlantParameters& truth, const DeviceModel& nominal, const std::string& line,
                           std::uint64_t seed) {
  HeldStylus bench({.truth = truth, .model = nominal, .seed = seed, .line = line});
  std::vector<JointVector> asked, given;
  for (int n = 0; n < kRepeats; ++n)
    for (const Wrench& w_S : rendered_wrenches()) {
      given.push_back(came(bench, w_S));
      if (!given.back().allFinite()) throw InputError("identification: the force sensor gave no reading that holds");
      asked.push_back(torques_of_wrench(bench.arm(), w_S));
    }
  DriveWeighing found;
  for (int j = 0; j < kArmJoints; ++j) {
    double product = 0, square = 0, rest = 0;
    for (std::size_t k = 0; k < asked.size(); ++k)
      product += asked[k][j] * given[k][j], square += asked[k][j] * asked[k][j];
    found.scale[j] = product / square;
    require_drive(j, found.scale[j]);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const double left = given[k][j] - found.scale[j] * asked[k][j];
      rest += left * left;
    }
    found.deviation[j] = std::sqrt(rest / static_cast<double>(asked.size() - 1) / square);
  }
  found.taken = bench.taken(), found.left_out = bench.left_out();
  return found;
}

DeviceModel weighed(DeviceModel model, const DriveWeighing& found) {
  for (int j = 0; j < kArmJoints; ++j) model.transmission[static_cast<std::size_t>(j)].amps_per_volt *= found.scale[j];
  return model;
}

AmplifierCalibration as_calibration(const DriveWeighing& found, const Identification& id) {
  AmplifierCalibration calibration;
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    const Transmission& t = id.device.transmission[c];
    calibration[c].amps_per_volt = t.amps_per_volt;
    if (i >= kArmJoints) continue;
    // The drive was asked for id.offset more than weight and friction need: the chain adds as much the other way.
    const double per_volt = torque_per_volt(t);
    calibration[c].amps_per_volt_sd = t.amps_per_volt * found.deviation[i] / found.scale[i];
    calibration[c].offset_v = -id.offset[i] / per_volt;
    calibration[c].offset_sd_v = offset_deviation(id, i) / per_volt;
  }
  return calibration;
}

}  // namespace trocar
