// The force sensor task (40 Hz) and what it compares: measured at the stylus against what the loop believes to deliver.
//
// The residual holds what the loop does not know: friction, inertia, errors of weight compensation and of the
// amplifiers. It is stated in the run report and reaches neither loop nor exercise. Delivered forces are delayed as the
// sensor delays. Threads: the tap beside the device, the sensor its own.
//
// A real sensor speaks in its own axes F, with a zero and a fixture of its own:
//   F_T = +-R_TF (read - zero - R_FW m (g - a)),   R_TF = R_TW R_WS(q) R_SF
// zero: mean of what it reads in the jig after homing, torque off, less the fixture's weight there. q as it was when
// the force acted. What hangs on the tool side takes a force D of the hand (body on the device) or of the device (body
// in the hand), and passes S = read - zero on: m a = D + m g - S. F_T is D, turned round where it is the hand's.
// a of the fixture's centre p, from q as it was kSpan_s before and after; a sensor that lags less waits for the pose
// after:
//   a = 2 ((p+ - p) / t+ - (p - p-) / t-) / (t+ + t-)
// which averages it over both spans. 0 next to a pose before homing. m is a point (its moments of inertia are not
// known), and F's origin is taken to be that of S (its place is not known).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/session/lanes/channel.h"
#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/task.h"
#include "haptics/device/device_model.h"
#include "haptics/device/simulated_world.h"
#include "haptics/force_sensor/force_sensor.h"
#include "haptics/kinematics/hybrid_arm.h"

namespace trocar {

/// Forces of one instant, axes of T, device newtons; and how the arm stood.
struct StylusForces {
  Vec3 on_hand_T = Vec3::Zero();        ///< true, of the simulated device
  Vec3 delivered_T = Vec3::Zero();      ///< as the loop believes
  JointVector q = JointVector::Zero();  ///< rad; means something once homed
  LoopState loop = LoopState::kOff;
  std::uint64_t period = 0;  ///< of the device at q, missed ones counted

  bool unloaded() const { return loop == LoopState::kHomed || loop == LoopState::kArmed; }  ///< homed, torque off
  bool posed() const { return unloaded() || loop == LoopState::kActive; }
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
    const TickRecord& record = haptic_.record();
    forces_.write(tick, {on_hand_T, record.stylus.rendered_force_T, record.q.head<kArmJoints>(), record.stylus.loop,
                         record.stylus.period});
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

/// A real sensor on a device.
struct RealSensorPlace {
  std::optional<SensorMount> mount;  ///< none, or one without axes: nothing is compared
  Mat3 R_TW = Mat3::Identity();
};

class ForceSensorTask final : public Task {
 public:
  /// The zero: so many samples at most, the first after homing (half a second at 40 Hz: the arm still stands in the
  /// jig), and at least so many [chosen].
  static constexpr std::uint64_t kZeroSamples = 20, kLeastZeroSamples = 4;
  /// Between the poses of an acceleration [chosen]. Encoder counts become 9 mN (RMS) on 80 g, 35 at half the span; of
  /// an inertia 3 % stay in at 2 Hz, 19 % at 5 Hz, 60 % at 10 Hz.
  static constexpr double kSpan_s = 0.05;

  /// @param real of a real sensor; none: a simulated one, in the axes of T.
  ForceSensorTask(Inlet<StylusForces>& forces, ForceSensor& sensor, double loop_rate_hz,
                  std::optional<RealSensorPlace> real = {})
      : forces_(forces),
        sensor_(sensor),
        loop_rate_hz_(loop_rate_hz),
        period_(static_cast<std::uint32_t>(std::lround(loop_rate_hz / sensor.config().rate_hz))),
        real_(std::move(real)) {
    if (compares() && real_ && real_->mount->fixture_kg > 0)
      span_ = static_cast<std::size_t>(std::max(1L, std::lround(kSpan_s * sensor.config().rate_hz)));
    waits_ = span_ - std::min(span_, sensor.delay());
    past_.resize(waits_ + sensor.delay() + span_ + 1);
  }

  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    const StylusForces& now = forces_.newest(tick);
    const ForceSample read = sensor_.sample(now.on_hand_T);
    number_ = read.number;
    past_[number_ % past_.size()] = {now, read};
    if (read.valid) ++samples_;
    newest_ = ago(waits_).read;
    if (!newest_.valid) return;
    const StylusForces& then = ago(waits_ + sensor_.delay()).stylus;
    if (real_ && !set_free(ago(waits_).stylus, then)) return;
    measured_.add(newest_.force);
    measured_moment_.add(newest_.moment_nm);
    if (compares() && then.delivered_T.norm() > 0) residual_.add(newest_.force - then.delivered_T);
  }

  const ForceSample& newest() const { return newest_; }  ///< that waits for nothing
  const ForceSensorConfig& config() const { return sensor_.config(); }
  std::uint64_t samples() const { return samples_; }  ///< that were valid
  /// Of a real sensor without what made its zero, axes of T or, where it does not compare, its own.
  const VectorSpread& measured() const { return measured_; }
  const VectorSpread& measured_moment() const { return measured_moment_; }  ///< of a real one, N m
  /// Whether its axes are known, as those of a simulated one are.
  bool compares() const { return !real_ || (real_->mount && real_->mount->rpy_rad); }
  /// Of a real sensor, in its axes, fixture's weight taken away; none: too few samples came in the jig.
  std::optional<Wrench> zero() const {
    if (zero_samples_ < kLeastZeroSamples) return std::nullopt;
    return zero_sum_ * (1 / static_cast<double>(zero_samples_));
  }
  std::uint64_t zero_samples() const { return zero_samples_; }
  /// Measured minus delivered, over the samples at which the loop delivered a force.
  const VectorSpread& residual() const { return residual_; }

 private:
  struct Past {
    StylusForces stylus;
    ForceSample read;
  };
  const Past& ago(std::size_t samples) const { return past_[(number_ + past_.size() - samples) % past_.size()]; }

  /// Of F in W. @pre compares()
  Pose sensor_pose(const StylusForces& when) const {
    return arm_state(when.q).X_WS * Pose{real_->mount->R_SF(), Vec3::Zero()};
  }

  /// Of the fixture's centre of mass in W when the newest force acted, m/s2. @pre compares()
  Vec3 acceleration() const {
    const std::size_t back = waits_ + sensor_.delay();
    const StylusForces &before = ago(back + span_).stylus, &then = ago(back).stylus, &after = ago(back - span_).stylus;
    if (!before.posed() || !then.posed() || !after.posed()) return Vec3::Zero();
    if (before.period >= then.period || then.period >= after.period) return Vec3::Zero();
    const double in_s = static_cast<double>(then.period - before.period) / loop_rate_hz_;
    const double out_s = static_cast<double>(after.period - then.period) / loop_rate_hz_;
    const Vec3& com_F = real_->mount->fixture_com_F;
    const Vec3 p = sensor_pose(then) * com_F;
    return ((sensor_pose(after) * com_F - p) / out_s - (p - sensor_pose(before) * com_F) / in_s) * (2 / (in_s + out_s));
  }

  /// Takes zero and fixture off the newest sample and turns it into T. @return false: it made the zero, or there is
  /// none.
  bool set_free(const StylusForces& now, const StylusForces& then) {
    const bool making = now.unloaded() && zero_samples_ < kZeroSamples && measured_.count() == 0;
    const StylusForces& when = then.posed() ? then : now;  // before homing it stood in the jig as it does now
    if (!when.posed()) return false;
    Wrench read{newest_.force, newest_.moment_nm};
    Mat3 R_TF = Mat3::Identity();
    if (compares()) {
      const Mat3 R_WF = sensor_pose(when).R;
      const Vec3 g_W(0, 0, -kGravity);
      const Vec3 hung_F = R_WF.transpose() * (real_->mount->fixture_kg * (g_W - acceleration()));
      read = read + Wrench{hung_F, real_->mount->fixture_com_F.cross(hung_F)} * -1;
      R_TF = real_->R_TW * R_WF;
    }
    if (making) {
      zero_sum_ = zero_sum_ + read, ++zero_samples_;
      return false;
    }
    const std::optional<Wrench> off = zero();
    if (!off) return false;
    const double sign = real_->mount && real_->mount->body_on_device ? -1 : 1;
    newest_.force = sign * (R_TF * (read.force - off->force));
    newest_.moment_nm = sign * (R_TF * (read.moment - off->moment));
    return true;
  }

  Inlet<StylusForces>& forces_;
  ForceSensor& sensor_;
  double loop_rate_hz_;
  std::uint32_t period_;
  ForceSample newest_;
  std::optional<RealSensorPlace> real_;
  std::size_t span_ = 0;    ///< kSpan_s in samples; 0: nothing hangs on it whose acceleration counts
  std::size_t waits_ = 0;   ///< samples that one is held back until the pose after is known
  std::vector<Past> past_;  ///< ring: from the pose after to the pose before
  std::uint64_t number_ = 0;
  VectorSpread measured_, measured_moment_, residual_;
  std::uint64_t samples_ = 0, zero_samples_ = 0;
  Wrench zero_sum_;
};

}  // namespace trocar
