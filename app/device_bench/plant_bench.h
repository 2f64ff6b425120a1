// The device on a bench: the haptic loop on the simulated plant in simulated time, a hand that leads the stylus, a
// flat wall where the study wants one. Beside the loop stands what it cannot know: the plant's true motion and the
// true energy that the contact force took or gave.
//
// Theatre T = device base W'; the instrument is the stylus itself unless the configuration says otherwise. The bench
// throws when the loop faults: a study never averages over a dead device. SI. Thread: one owner.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "app/device_bench/drawn_device.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/haptic_loop.h"

namespace trocar {

/// A study that cannot go on: the loop of the bench has faulted.
struct BenchFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class PlantBench {
 public:
  PlantBench(const SimulatedDaqConfig& device, const HapticLoopConfig& loop);
  /// A second bench in the same state to the bit.
  PlantBench(const PlantBench& other);
  PlantBench& operator=(const PlantBench&) = delete;

  /// One period. @throws BenchFault.
  const TickRecord& tick();
  void run(double seconds);
  /// Self-test and homing in the jig, then the hand takes hold and the soft start passes.
  void start();
  /// The hand's goal goes to `to` on a straight line with minimum jerk.
  void move(const Pose& to, double seconds);
  /// Hand off: the plant alone.
  void let_go() {
    holding_ = false;
    daq_.release_hand();
  }

  /// Square wall of 80 mm about `point_T`, facing `normal_T`; the tool's radius lies before it.
  void put_wall(const Vec3& point_T, const Vec3& normal_T, const ContactMaterial& material);
  /// Any surface instead: triangles counter-clockwise from outside, in T. @throws std::invalid_argument when they do
  /// not fit into a patch.
  void put_surface(std::span<const std::array<Vec3, 3>> triangles_T, const ContactMaterial& material);

  const TickRecord& record() const { return record_; }
  const SimulatedDaq& daq() const { return daq_; }
  SimulatedDaq& daq() { return daq_; }
  HapticLoop& loop() { return loop_; }
  const HapticLoopConfig& loop_config() const { return config_; }
  Pose& goal() { return goal_; }
  double time_s() const { return daq_.time_s(); }
  double period_s() const { return 1 / config_.daq.rate_hz; }
  /// True energy that all that the loop asks for beyond the weight has absorbed since start(), J: -sum of acting torque
  /// times true motion of the motors.
  double true_absorbed_j() const { return absorbed_j_; }
  /// That and what friction and cables of the arm have taken, J: what it falls the hand has been fed.
  double net_absorbed_j() const { return absorbed_j_ + daq_.plant().dissipated_j(); }

 private:
  void remember(const DacFrame& out);
  void account(const DacFrame& acting);

  SimulatedDaq daq_;
  HapticLoopConfig config_;
  HapticLoop loop_;
  std::unique_ptr<ContactPatch> patch_;
  TickRecord record_;
  Pose goal_;
  double jaw_;
  bool holding_ = false;
  /// What a tick asked for: the codes, and their torque beyond the weight.
  struct Asked {
    DacFrame codes;
    JointVector torque = JointVector::Zero();
  };
  static constexpr std::size_t kKept = kMaxExtraDelayPeriods + 3;
  JointVector last_q_;
  std::deque<Asked> asked_;  ///< newest first
  double absorbed_j_ = 0;
};

}  // namespace trocar
