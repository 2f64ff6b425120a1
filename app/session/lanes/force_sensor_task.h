// The force sensor task (40 Hz) and what it compares: measured at the stylus against what the loop believes to deliver.
//
// The residual holds what the loop does not know: friction, inertia, errors of weight compensation and of the
// amplifiers. It is stated in the run report and reaches neither loop nor exercise. Delivered forces are delayed as the
// sensor delays. Threads: the tap beside the device, the sensor its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/session/lanes/channel.h"
#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/task.h"
#include "haptics/device/simulated_world.h"
#include "haptics/force_sensor/force_sensor.h"

namespace trocar {

/// Forces of one instant, axes of T, device newtons.
struct StylusForces {
  Vec3 on_hand_T = Vec3::Zero();    ///< true, of the simulated device
  Vec3 delivered_T = Vec3::Zero();  ///< as the loop believes
};

/// Publishes the forces at the stylus after each period of the device.
class ForceTapTask final : public Task {
 public:
  /// @param world nullptr: nobody knows the true force. @param R_TW from the device's base to the theatre.
  /// @param fixture_n weight that hangs on the sensor.
  ForceTapTask(const SimulatedWorld* world, const HapticTask& haptic, const Mat3& R_TW, Outlet<StylusForces>& forces,
               double fixture_n = 0)
      : world_(world), haptic_(haptic), R_TW_(R_TW), forces_(forces), fixture_W_(0, 0, -fixture_n) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t tick) override {
    const Vec3 on_hand_T = world_ ? Vec3(R_TW_ * (world_->sense().force_on_hand + fixture_W_)) : Vec3(Vec3::Zero());
    forces_.write(tick, {on_hand_T, haptic_.record().stylus.rendered_force_T});
  }

 private:
  const SimulatedWorld* world_;
  const HapticTask& haptic_;
  Mat3 R_TW_;
  Outlet<StylusForces>& forces_;
  Vec3 fixture_W_;
};

/// Root mean square and largest norm of a vector over a run.
class VectorSpread {
 public:
  void add(const Vec3& value) {
    square_sum_ += value.squaredNorm();
    largest_ = std::max(largest_, value.norm());
    ++count_;
  }
  std::uint64_t count() const { return count_; }
  double rms() const { return count_ > 0 ? std::sqrt(square_sum_ / static_cast<double>(count_)) : 0; }
  double largest() const { return largest_; }

 private:
  double square_sum_ = 0, largest_ = 0;
  std::uint64_t count_ = 0;
};

class ForceSensorTask final : public Task {
 public:
  ForceSensorTask(Inlet<StylusForces>& forces, ForceSensor& sensor, double loop_rate_hz)
      : forces_(forces),
        sensor_(sensor),
        delivered_(sensor_.delay() + 1, Vec3::Zero()),
        period_(static_cast<std::uint32_t>(std::lround(loop_rate_hz / sensor.config().rate_hz))) {}

  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    const StylusForces& now = forces_.newest(tick);
    newest_ = sensor_.sample(now.on_hand_T);
    delivered_[newest_.number % delivered_.size()] = now.delivered_T;
    if (!newest_.valid) return;
    const Vec3& then = delivered_[(newest_.number + 1) % delivered_.size()];
    measured_.add(newest_.force);
    if (then.norm() > 0) residual_.add(newest_.force - then);
  }

  const ForceSample& newest() const { return newest_; }
  const ForceSensorConfig& config() const { return sensor_.config(); }
  const VectorSpread& measured() const { return measured_; }
  /// Measured minus delivered, over the samples at which the loop delivered a force.
  const VectorSpread& residual() const { return residual_; }

 private:
  Inlet<StylusForces>& forces_;
  ForceSensor& sensor_;
  std::vector<Vec3> delivered_;  ///< ring as long as the sensor's delay
  std::uint32_t period_;
  ForceSample newest_;
  VectorSpread measured_, residual_;
};

}  // namespace trocar
