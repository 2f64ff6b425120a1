#include "app/session/lanes/hand_task.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "haptics/kinematics/device_geometry.h"
#include "scenarios/director/cue_percept.h"

namespace trocar {
namespace {

constexpr std::uint64_t kSensesSeed = 0x5e45e5;  // the senses' own stream, apart from the hand's decisions
constexpr std::uint64_t kTargetStride = 0x9e3779b97f4a7c15;
constexpr double kLeastLever = 1e-9;  // determinant of the map from a force at the tip to the one at the hand
constexpr double kEyeErrorPeriod_s = 0.020;
constexpr double kSeenOpen_s = 0.01;  // the switch of no device is open for as long as the loop wants to see it so
constexpr std::uint64_t kMostMissed = 1000;  // what is longer is a fault anyway: the simulated world waits for the rest

}  // namespace

HandTask::HandTask(const Scene& scene, const HapticTask& haptic, Inlet<ExerciseFrame>& frames,
                   std::unique_ptr<Hand> hand, SimulatedWorld& world)
    : scene_(scene),
      haptic_(haptic),
      frames_(frames),
      hand_(std::move(hand)),
      world_(world),
      random_(static_cast<std::uint64_t>(scene.setup.seed) ^ kSensesSeed),
      past_(std::max<std::size_t>(1, static_cast<std::size_t>(kEyeDelay_s * scene.loop.daq.rate_hz)),
            Seen{scene.loop.map.instrument_pose(home_pose()), 0}),
      past_objects_(past_.size()) {}

HandTask::Seen HandTask::see() {
  // The oldest entry is what the eye reports; the newest state takes its place.
  Seen& slot = past_[periods_ % past_.size()];
  const Seen seen = slot;
  const StylusState& now = haptic_.record().stylus;
  if (periods_ > 0) slot = {now.X_TI, now.jaw_opening_m};
  return seen;
}

/// The force at the tip that the instrument would bring to the hand as the one that is felt, N. Zero where it would
/// bring none: a tip within the port.
Vec3 HandTask::feel_T(const HandSense& sense) {
  Mat3 felt_of_tip;
  for (int axis = 0; axis < 3; ++axis)
    felt_of_tip.col(axis) = scene_.loop.map.stylus_wrench(sense.X_BS, {Vec3::Unit(axis), Vec3::Zero()}).force;
  Mat3 tip_of_felt;
  bool brings = false;
  felt_of_tip.computeInverseWithCheck(tip_of_felt, brings, kLeastLever);
  const Vec3 error(random_.normal(), random_.normal(), random_.normal());
  if (!brings) return Vec3::Zero();
  return tip_of_felt * (sense.force_on_hand + kTouchError_n * error);
}

/// The errors of the senses begin anew with each target, so that an attempt that is shifted by some milliseconds (live,
/// a missed period) stays the same attempt.
void HandTask::draw_eye_error(const DirectorStatus& status) {
  const bool resting = status.target_index < 0 && status.cue != Cue::kGrip;
  const Cue cue = resting || status.cue == Cue::kGrip ? status.cue : Cue::kReach;  // within a target cues come and go
  if (cue != shown_ || status.target_index != shown_target_) {
    shown_ = cue;
    shown_target_ = status.target_index;
    periods_of_target_ = 0;
    random_ = HandRandom(static_cast<std::uint64_t>(scene_.setup.seed) * kTargetStride + ++targets_ + kSensesSeed);
  }
  const auto redraw = static_cast<std::uint64_t>(kEyeErrorPeriod_s * scene_.loop.daq.rate_hz);
  if (periods_of_target_++ % redraw != 0) return;
  for (int axis = 0; axis < 3; ++axis) eye_error_[axis] = kEyeError_m * random_.normal();
  jaw_error_m_ = kEyeError_m * random_.normal();
}

Percept HandTask::perceive(std::uint64_t tick) {
  const StylusState& state = haptic_.record().stylus;
  const double rate = scene_.loop.daq.rate_hz;
  active_ticks_ = state.loop == LoopState::kActive ? active_ticks_ + 1 : 0;
  const DirectorStatus& status = frames_.newest(tick).status;
  draw_eye_error(status);
  Percept percept;
  percept.t_s = state.t_s;
  const std::vector<InstrumentKind>& instruments = scene_.setup.exercise.instruments;
  percept.instrument = instruments[std::min(static_cast<std::size_t>(state.instrument), instruments.size() - 1)];
  percept.device_ready = static_cast<double>(active_ticks_) > (scene_.loop.daq.motors ? kReadyAfter_s : 0) * rate;
  const Seen seen = see();
  percept.tip_T = seen.X_TI.p + eye_error_;
  percept.R_TI = seen.X_TI.R;
  const HandSense sense = world_.sense();
  if (scene_.loop.daq.motors) {
    percept.felt_force_T = feel_T(sense);
    percept.felt_grip_n = std::max(0.0, sense.force_on_finger_n + kTouchError_n * random_.normal());
  } else {  // nothing pushes back: what the scene does to the instrument is all that a hand can go by
    percept.felt_force_T = state.F_I_T.force;
    percept.felt_grip_n = state.grip_force_n;
  }
  percept.jaw_opening_m = std::max(0.0, seen.jaw_opening_m + jaw_error_m_);
  percept.shown_force_n = status.force_shown ? state.F_I_T.force.norm() : std::numeric_limits<double>::quiet_NaN();
  percept.shown_grip_n = status.force_shown ? state.grip_force_n : std::numeric_limits<double>::quiet_NaN();
  show_cue(status, percept);
  std::swap(percept.object, past_objects_[periods_ % past_objects_.size()]);  // the eye is as late for objects
  percept.object.X_TO.p += eye_error_;
  return percept;
}

/// Presses when the device has homed and keeps pressing, whatever happens afterwards.
void HandTask::press_deadman() {
  if (haptic_.record().stylus.loop == LoopState::kHomed) ++homed_ticks_;
  const double thumb_s = scene_.loop.daq.motors ? kPressAfter_s : kSeenOpen_s;
  world_.press_deadman(static_cast<double>(homed_ticks_) > thumb_s * scene_.loop.daq.rate_hz);
}

void HandTask::run(std::uint64_t tick) {
  press_deadman();
  const HandIntent intent = hand_->update(perceive(tick), 1 / scene_.loop.daq.rate_hz);
  const StylusState& state = haptic_.record().stylus;
  const bool releasing = state.clutched && !intent.clutch;  // the loop has still to take up the offset
  if (!releasing) {
    InstrumentMap map = scene_.loop.map;
    map.registration = state.registration;  // a hand finds the stylus where clutching has left it
    stylus_W_ = map.stylus_pose(intent.X_TI);
  }
  world_.set_hand_intent(stylus_W_, intent.jaw_opening_m);
  world_.press_clutch(intent.clutch);
  world_.press_pedal(intent.pedal);
  world_.press_exchange(intent.exchange);
  ++periods_;
}

void HandTask::missed(std::uint64_t periods) {
  for (std::uint64_t n = 0; n < std::min(periods, kMostMissed); ++n) {
    run(periods_);
    world_.miss_sync();
  }
}

}  // namespace trocar
