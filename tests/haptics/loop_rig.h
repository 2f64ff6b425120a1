// The whole loop in simulated time: HapticLoop on the simulated device, a hand that aims, a patch in the theatre.
#pragma once

#include <memory>
#include <vector>

#include "haptics/device/replay_daq.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/haptic_loop.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"
#include "tests/support/allocation_guard.h"

namespace trocar::test {

/// A comfortable pose in front of home: det A 0.9, far from every limit.
inline Pose working_pose() { return arm_state(degrees(45, 45, 45, -60, -75, 0)).X_WS; }

class LoopRig {
 public:
  explicit LoopRig(const SimulatedDaqConfig& device = {}, const HapticLoopConfig& loop_config = {})
      : daq(quiet(device)), config(matched(loop_config, daq)), loop(config), patch(std::make_unique<ContactPatch>()) {
    goal = daq.sense().X_BS;
  }

  /// One period. @return the record of the tick.
  const TickRecord& tick() {
    if (holding) daq.set_hand_intent(goal, jaw);
    const DaqSample sample = daq.read();
    const AllocationGuard guard;
    const DacFrame out = loop.tick(sample, *patch, record);
    allocations += guard.allocations();
    daq.arm(record.amplifiers_armed);
    daq.write(out);
    if (keep) records.push_back(record);
    return record;
  }
  void run(double seconds) {
    for (int k = 0, n = static_cast<int>(std::lround(seconds * config.daq.rate_hz)); k < n; ++k) tick();
  }
  /// Self-test and homing in the jig, then the hand takes hold and the soft start passes.
  void start() {
    holding = false;
    run(0.65);
    holding = true;
    run(1.2);
  }
  /// Moves the goal of the hand in a straight line.
  void move(const Pose& to, double seconds) {
    const Pose from = goal;
    const Eigen::AngleAxisd turn(Mat3(to.R * from.R.transpose()));
    const int n = static_cast<int>(std::lround(seconds * config.daq.rate_hz));
    for (int k = 1; k <= n; ++k) {
      const double s = double(k) / n;
      goal.p = from.p + s * (to.p - from.p);
      goal.R = Eigen::AngleAxisd(s * turn.angle(), turn.axis()) * from.R;
      tick();
    }
  }
  /// Moves the fingers to an opening: a leap would outrun what the loop takes for an encoder fault.
  void squeeze(double opening, double seconds) {
    const double from = jaw;
    const int n = static_cast<int>(std::lround(seconds * config.daq.rate_hz));
    for (int k = 1; k <= n; ++k) {
      jaw = from + (opening - from) * k / n;
      tick();
    }
  }
  /// Flat patch facing up under the tip, its surface `below` metres under where the tip is now (plus its radius).
  void put_floor(double below, double stiffness) {
    const Vec3 tip = record.stylus.X_TI.p;
    patch->clear();
    patch->material[0].stiffness_n_per_m = stiffness;
    const double z = tip.z() - config.tool.radius_m - below;
    add_sheet(*patch, {tip.x() - 0.03, tip.y() - 0.03, z}, {0.06, 0, 0}, {0, 0.06, 0}, 6);
  }

  SimulatedDaq daq;
  HapticLoopConfig config;
  HapticLoop loop;
  std::unique_ptr<ContactPatch> patch;
  TickRecord record;
  std::vector<TickRecord> records;
  std::uint64_t allocations = 0;  ///< heap allocations inside the ticks so far
  bool keep = false, holding = false;
  Pose goal;
  double jaw = 0.02;

 private:
  static SimulatedDaqConfig quiet(SimulatedDaqConfig device) {
    device.hand.tremor_m = 0;
    return device;
  }
  static HapticLoopConfig matched(HapticLoopConfig c, const DataAcquisition& device) {
    c.daq = device.capabilities();
    // The instrument points down whatever way the stylus is held at the working pose; its shaft stays in the air.
    c.map.X_SI.R = working_pose().R.transpose() * tip_down(Vec3::Zero()).R;
    return c;
  }
};

}  // namespace trocar::test
