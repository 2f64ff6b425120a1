// The simulated device with its stylus held at home by a fixture with a force and torque sensor: what the sensor reads
// of the torques that the device renders.
//
// The fixture comes to the home pose from either side of every joint, so that friction shows with both signs, and the
// mean of the two readings counts. Through a sensor's line each reading is counts through that sensor's driver, the
// fixture's own weight and inertia on it and taken away again. SI. Thread: one owner.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/studies/contact/bare_control_loop.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/force_sensor/ati/fake_sensor.h"
#include "haptics/force_sensor/simulated_force_sensor.h"

namespace trocar {

/// Stiffer than any hand: 0.2 mm under 1 N, 1 deg under 1 N m.
HandParameters stiff_fixture();
/// The sensor's moments: 0.5 mN m of noise [assumed, with the 20 mN of its forces], no drift.
ForceSensorConfig moment_sensor();

/// Joint torques, N m, of a wrench at the stylus. @param w_S in the stylus frame
JointVector torques_of_wrench(const ArmState& arm, const Wrench& w_S);

struct HeldStylusConfig {
  PlantParameters truth;
  DeviceModel model = {};  ///< its transmissions count
  ForceSensorConfig force = {};
  ForceSensorConfig moment = moment_sensor();
  std::uint64_t seed = 1;                  ///< of the sensor
  HandParameters holds = stiff_fixture();  ///< what holds the stylus
  std::string line = {};                   ///< "net-ft", "serial": through that sensor's driver; empty: as it reads
};

class HeldStylus {
 public:
  /// @throws InputError, EnvironmentError as SensorLine.
  explicit HeldStylus(const HeldStylusConfig& config);

  int taken() const { return taken_; }        ///< readings that counted
  int left_out() const { return left_out_; }  ///< of the readings asked for, those that the sensor did not vouch for
  const ArmState& arm() const { return loop_.arm(); }

  /// Mean reading from both sides, on what holds, in the stylus frame. @param law what the device renders; empty: none.
  Wrench read(const TorqueLaw& law);
  /// Mean reading where the stylus is held, without coming from anywhere: friction hides what it can.
  Wrench read_as_held(const TorqueLaw& law);

 private:
  /// Weight and inertia of what hangs on the sensor, in the stylus frame, sample by sample.
  class FixtureLoad {
   public:
    /// @param X of the stylus in W'; its acceleration by its last two differences.
    Wrench at(const Pose& X, double period_s);

   private:
    Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();
    int known_ = 0;
  };

  Wrench read_at_rest();
  /// @param aside share of the way aside at which the fixture holds, by the share of time.
  void run(double seconds, const std::function<double(double)>& aside, const std::function<void(const Wrench&)>& take);
  void sample(const std::function<void(const Wrench&)>& take);
  /// What hangs on the sensor, as the loop knew it when the reading was true.
  Wrench remembered(const Wrench& now);

  std::unique_ptr<SensorLine> line_;
  FixtureLoad true_, believed_;
  std::vector<Wrench> hung_;
  int taken_ = 0, left_out_ = 0;
  SimulatedDaq daq_;
  SimulatedForceSensor force_, moment_;
  HandSense home_;
  TorqueLaw law_;
  BareControlLoop loop_;
};

}  // namespace trocar
