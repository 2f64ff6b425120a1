#include "haptics/control/device_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trocar {

DeviceWatch::DeviceWatch(const SafetyLimits& limits, const DeviceModel& model, const MotorHeatParameters& heat,
                         double period_s, const MotorStates& motors)
    : limits_(limits), model_(model), period_s_(period_s) {
  std::ranges::transform(motors, heat_.begin(), [&](const MotorTemperatures& start) { return MotorHeat(heat, start); });
  for (int i = 0; i < kChannels; ++i) {
    const Transmission& t = model.transmission[i];
    strong_[i] = limits.stuck_torque_share * t.max_motor_torque / t.ratio;
  }
}

void DeviceWatch::update(const WatchedTick& now, Supervisor& supervisor) {
  const bool active = supervisor.state() == LoopState::kActive;
  watch_heat(now, supervisor);
  watch_speed(now, supervisor);
  watch_encoders(now, supervisor);
  watch_patch(now, supervisor);
  set(LoopWarning::kNearSingular, active && now.det_a < limits_.warn_det_a);
  set(LoopWarning::kForceSaturated, active && now.saturated);
  set(LoopWarning::kEnergyDebt, active && now.debt);
  if (active && now.det_a < limits_.fault_det_a) supervisor.raise(FaultCode::kSingular, now.tick, -1, now.det_a);
}

void DeviceWatch::watch_heat(const WatchedTick& now, Supervisor& supervisor) {
  bool hot = false;
  for (int i = 0; i < kChannels; ++i) {
    if (!std::isfinite(now.torque[i])) {
      supervisor.raise(FaultCode::kNonFinite, now.tick, i, now.torque[i]);
      continue;
    }
    const Transmission& t = model_.transmission[i];
    heat_[i].update(now.torque[i] * t.ratio / t.torque_constant, now.periods * period_s_);
    hot = hot || heat_[i].hot();
    if (heat_[i].cut()) supervisor.raise(FaultCode::kOverheat, now.tick, i, heat_[i].winding_c());
  }
  set(LoopWarning::kHotMotor, hot);
}

void DeviceWatch::watch_speed(const WatchedTick& now, Supervisor& supervisor) {
  int fastest = 0;
  for (int i = 1; i < kArmJoints; ++i) {
    if (std::abs(now.qd[i]) > std::abs(now.qd[fastest])) fastest = i;
  }
  const bool joint = std::abs(now.qd[fastest]) > limits_.max_joint_rate;
  const bool fast = supervisor.powered() && (joint || now.tip_speed > limits_.max_tip_speed);
  too_fast_s_ = fast ? too_fast_s_ + now.periods * period_s_ : 0;
  set(LoopWarning::kOverspeed, fast);
  if (too_fast_s_ <= limits_.overspeed_s) return;
  supervisor.raise(FaultCode::kOverspeed, now.tick, joint ? fastest : -1, joint ? now.qd[fastest] : now.tip_speed);
}

std::int64_t DeviceWatch::arm_travel(const std::array<std::int32_t, kChannels>& delta) {
  std::int64_t travel = 0;
  for (int i = 0; i < kArmJoints; ++i) {
    const std::int64_t off = static_cast<std::int64_t>(off_place_[i]) + delta[i];
    off_place_[i] =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(off, -limits_.stuck_dither, limits_.stuck_dither));
    travel += std::abs(off - off_place_[i]);
  }
  return travel;
}

void DeviceWatch::watch_encoders(const WatchedTick& now, Supervisor& supervisor) {
  const bool active = supervisor.state() == LoopState::kActive;
  const std::int64_t travel = arm_travel(now.delta);
  bool suspected = false;
  for (int i = 0; i < kChannels; ++i) {
    const bool pushed = active && !now.touching && now.delta[i] == 0 && std::abs(now.torque[i]) > strong_[i];
    pushed_s_[i] = pushed ? pushed_s_[i] + now.periods * period_s_ : 0;
    suspected = suspected || pushed_s_[i] >= limits_.stuck_s;
    if (i >= kArmJoints) continue;  // the jaws may rest while the arm travels
    pushed_travel_[i] = pushed ? pushed_travel_[i] + travel : 0;
    quiet_travel_[i] = active && now.delta[i] == 0 ? quiet_travel_[i] + travel : 0;
    if (pushed_travel_[i] <= limits_.stuck_pushed_travel && quiet_travel_[i] <= limits_.stuck_travel) continue;
    supervisor.raise(FaultCode::kEncoderStuck, now.tick, i, static_cast<double>(quiet_travel_[i]));
  }
  set(LoopWarning::kEncoderStuck, suspected);
}

void DeviceWatch::watch_patch(const WatchedTick& now, Supervisor& supervisor) {
  const double most = limits_.max_patch_age_s, fades_from = most / 2;
  const bool old = supervisor.state() == LoopState::kActive && now.patch_age_s > fades_from;
  const double left = old ? std::max(0.0, (most - now.patch_age_s) / (most - fades_from)) : 1;
  patch_share_ = std::min(left, patch_share_ + now.periods * period_s_ / limits_.patch_return_s);
  set(LoopWarning::kStalePatch, old);
  if (old && now.patch_age_s > most) supervisor.raise(FaultCode::kStalePatch, now.tick, -1, now.patch_age_s);
}

double DeviceWatch::contact_share() const {
  double share = warnings_ & bit(LoopWarning::kOverspeed) ? 0 : patch_share_;
  for (const MotorHeat& heat : heat_) share = std::min(share, heat.share());
  return share;
}

ChannelVector DeviceWatch::damping(const ChannelVector& qd) const {
  ChannelVector torque = ChannelVector::Zero();
  if (!(warnings_ & bit(LoopWarning::kOverspeed))) return torque;
  torque.head<kArmJoints>() = -limits_.overspeed_damping * qd.head<kArmJoints>();
  return torque;
}

std::array<double, kChannels> DeviceWatch::winding_c() const {
  std::array<double, kChannels> winding;
  std::ranges::transform(heat_, winding.begin(), &MotorHeat::winding_c);
  return winding;
}

MotorStates DeviceWatch::motors() const {
  MotorStates motors;
  std::ranges::transform(heat_, motors.begin(), &MotorHeat::temperatures);
  return motors;
}

double DeviceWatch::hottest_c() const { return std::ranges::max(winding_c()); }

}  // namespace trocar
