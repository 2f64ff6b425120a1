#include "haptics/device/pointer_daq.h"

#include <algorithm>
#include <utility>

#include "haptics/device/transmission.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"

namespace trocar {
namespace {

constexpr double kFiner = 100;  // than the encoders
constexpr int kHalvings = 10;   // of the way to a pose that is out of reach

Pose between(const Pose& from, const Pose& to, double place, double turn) {
  const Eigen::Quaterniond a(from.R), b(to.R);
  return {a.slerp(turn, b).toRotationMatrix(), from.p + place * (to.p - from.p)};
}

/// The largest share of 0 to 1 that is within the arm's limits, and its joints.
template <typename PoseAt>
JointVector farthest(const PoseAt& pose_at, const JointVector& near, Pose& reached) {
  JointVector q = near;
  double in = 0, out = 1;
  for (int n = 0; n < kHalvings; ++n) {
    const double share = 0.5 * (in + out);
    const Pose pose = pose_at(share);
    if (const auto found = inverse_within_limits(pose, near)) {
      in = share;
      q = *found;
      reached = pose;
    } else {
      out = share;
    }
  }
  return q;
}

}  // namespace

std::array<Transmission, kChannels> pointer_transmissions() {
  std::array<Transmission, kChannels> transmission = nominal_transmissions();
  for (Transmission& t : transmission) t.counts_per_turn *= kFiner;
  return transmission;
}

PointerDaq::PointerDaq(double rate_hz) : rate_hz_(rate_hz), jaw_m_(DeviceModel{}.pinch_home_m) {
  home_ << home_angles(), jaw_m_;
  q_ = home_;
}

DaqCapabilities PointerDaq::capabilities() const noexcept {
  return {.name = "pointer", .rate_hz = rate_hz_, .motors = false};
}

void PointerDaq::set_hand_intent(const Pose& X_BS, double jaw_opening_m) noexcept {
  if (!X_BS.p.allFinite() || !X_BS.R.allFinite() || !std::isfinite(jaw_opening_m)) return;  // stays where it is
  wanted_BS_ = X_BS;
  jaw_m_ = std::clamp(jaw_opening_m, 0.0, DeviceModel{}.pinch_travel_m);
  holding_ = true;
}

/// The place counts more than the turn.
JointVector PointerDaq::wanted_angles() const noexcept {
  const JointVector now = q_.head<kArmJoints>();
  if (const auto all = inverse_within_limits(wanted_BS_, now)) return *all;
  const Pose here = arm_state(now).X_WS;
  Pose reached = here;
  JointVector q = now;
  const Pose same_turn{here.R, wanted_BS_.p};
  if (const auto place = inverse_within_limits(same_turn, now)) {
    q = *place;
    reached = same_turn;
  } else {
    q = farthest([&](double share) { return between(here, same_turn, share, 0); }, now, reached);
  }
  const Pose from = reached;
  return farthest([&](double share) { return between(from, wanted_BS_, 0, share); }, q, reached);
}

DaqSample PointerDaq::read() noexcept {
  DaqSample sample;
  sample.elapsed_periods = 1 + std::exchange(missed_, 0);
  sync_ += sample.elapsed_periods;
  const double dt_s = sample.elapsed_periods / rate_hz_;
  if (holding_ && armed_) {
    ChannelVector to;
    to << wanted_angles(), jaw_m_;
    for (int i = 0; i < kChannels; ++i) {
      const double most = (i == kPinchChannel ? kMostPinchRate : kMostRate) * dt_s;
      q_[i] += std::clamp(to[i] - q_[i], -most, most);
    }
  }
  for (int i = 0; i < kChannels; ++i)
    sample.counts[i] = static_cast<std::int32_t>(std::lround((q_[i] - home_[i]) / count_size(transmission_[i])));
  if (holding_ && pressed_) sample.digital_in |= kDeadman;
  if (clutch_) sample.digital_in |= kClutch;
  if (pedal_) sample.digital_in |= kPedal;
  if (exchange_) sample.digital_in |= kExchange;
  if (!armed_) sample.digital_in |= kHomeBeam;
  return sample;
}

HandSense PointerDaq::sense() const noexcept {
  HandSense sense;
  sense.X_BS = arm_state(q_.head<kArmJoints>()).X_WS;
  sense.jaw_opening_m = q_[kPinchChannel];
  sense.amplifiers_enabled = armed_;
  sense.in_jig = !armed_;
  return sense;
}

}  // namespace trocar
