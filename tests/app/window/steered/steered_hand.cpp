#include "tests/app/window/steered/steered_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/picture/attempt/attempt_scene.h"
#include "app/window/input/jaw_fingers.h"
#include "app/window/input/steering_reach.h"
#include "haptics/least_turn.h"

namespace trocar::testing_support {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFrame_s = 1.0 / 60, kHigh_px = 720;
constexpr double kPicture_m = 0.14;    // what the picture's height shows, about where the tip is
constexpr double kGain = 0.6;          // of the way that is left, in one frame
constexpr double kFastest_m = 0.0032;  // in one frame
constexpr double kNotch_m = 0.002, kFineNotch_m = 0.0005;
constexpr int kNotchEvery = 3;  // frames: twenty notches a second
constexpr double kDragTurn = 120 * kDegree, kScopeTurnSign = -1;
constexpr double kFastestLean = 1.4 * kDegree, kLeanNoticed = 0.4 * kDegree;  // in one frame
constexpr double kRollFast = 1.5 * kDegree, kRollNoticed = 0.4 * kDegree;     // in one frame, without Shift
constexpr double kArm_n_per_m = 98, kFinger_n_per_m = 400;                    // as the hand at a device gives way
constexpr double kArmTime_s = 0.15, kFingerTime_s = 0.05;
constexpr double kBehind_m = 0.006, kOpener_m = 0.002, kLongestWait_s = 6;
constexpr double kTap_s = 0.05;
constexpr double kClose_m = 0.0004, kOpen_m = 0.0020;  // of the jaws, before something is done about it
constexpr double kOpens_m_per_s = 0.010;               // slower, a grip is eased

struct Axes {
  Vec3 right, up, away;
};
/// Of the picture.
Axes axes_of(const Camera& camera) {
  const Vec3 away = (camera.look_at_T - camera.eye_T).normalized(), right = away.cross(camera.up_T).normalized();
  return {right, right.cross(away), away};
}

}  // namespace

SteeredHand::SteeredHand(const Scene& scene, const RunMoment& newest, std::unique_ptr<Hand> script)
    : scene_(scene),
      newest_(newest),
      script_(std::move(script)),
      person_(link_, entry_T(scene)),
      surroundings_(scene),
      steering_(keys_, SteeringOptions()) {}

/// What nobody could feel is done slowly; the script waits for it, but not for ever.
bool SteeredHand::is_behind(double dt_s) {
  const HandIntent& at = link_.target.read();
  const double open_m = std::max(wants_.jaw_opening_m, JawFingers::kTightest_m) + grip_yields_m_;
  const bool behind =
      steers_ && ((wants_.X_TI.p + yields_T_ - at.X_TI.p).norm() > kBehind_m || open_m < at.jaw_opening_m - kOpener_m);
  waited_s_ = behind ? waited_s_ + dt_s : 0;
  return behind && waited_s_ < kLongestWait_s;
}

/// The button keeps the grip that it has. A script that would ease it is told what easing would give, else it would
/// open further and further.
Percept SteeredHand::as_eased(Percept percept) {
  const double eased_n =
      kFinger_n_per_m * std::max(0.0, wants_.jaw_opening_m + grip_yields_m_ - link_.target.read().jaw_opening_m);
  percept.felt_grip_n = std::max(0.0, percept.felt_grip_n - eased_n);
  percept.shown_grip_n = std::max(0.0, percept.shown_grip_n - eased_n);
  return percept;
}

HandIntent SteeredHand::update(const Percept& percept, double dt_s) {
  if (!is_behind(dt_s)) wants_ = script_->update(as_eased(percept), dt_s);
  yields_T_ += std::min(1.0, dt_s / kArmTime_s) * (percept.felt_force_T / kArm_n_per_m - yields_T_);
  grip_yields_m_ += std::min(1.0, dt_s / kFingerTime_s) * (percept.felt_grip_n / kFinger_n_per_m - grip_yields_m_);
  since_s_ += dt_s;
  if (link_.ready.load() && newest_.seen && since_s_ >= kFrame_s) {
    since_s_ -= kFrame_s;
    look();
  }
  return person_.update(percept, dt_s);
}

void SteeredHand::send(InputEvent event) {
  event.x = x_;
  event.y = y_;
  steering_.handle(event);
}

void SteeredHand::hold(Action action, bool down) {
  if (std::exchange(held_[action], down) == down) return;
  send({.kind = down ? InputEvent::Kind::kKeyDown : InputEvent::Kind::kKeyUp, .key = keys_.key_of(action)});
}

/// One frame of the window: what RunScreen does with what the hands do.
void SteeredHand::look() {
  const HandIntent& target = link_.target.read();
  if (!steers_) {
    steering_.begin(target.X_TI, target.jaw_opening_m, scene_.board.centre_T,
                    steering_reach(scene_.setup.exercise, scene_.level));
    send({});
    steers_ = true;
  }
  ++frames_;
  const Camera camera = attempt_camera(view_of(scene_, newest_));
  const AtHand around = surroundings_.around(newest_, target);
  move(wants_.X_TI.p + yields_T_, camera, around.ground != nullptr);
  turn(wants_.X_TI.R, camera);
  use_jaws(wants_.jaw_opening_m, around);
  hold(Action::kPedal, wants_.pedal);
  hold(Action::kExchange, wants_.exchange);
  hold(Action::kClutch, wants_.clutch);
  link_.wanted.write({steering_.advance(kFrame_s, camera, kHigh_px, around), ++number_});
}

/// Sideways with the mouse; deeper, or over a ground lower, with the wheel.
void SteeredHand::move(const Vec3& to_T, const Camera& camera, bool glides) {
  const auto [right, up, away] = axes_of(camera);
  const Vec3 left_T = to_T - steering_.intent().X_TI.p;
  Vec3 aside = left_T;
  if (glides) aside.z() = 0;
  aside *= kGain;
  aside *= std::min(1.0, kFastest_m / std::max(1e-9, aside.norm()));
  const double px = kHigh_px / kPicture_m;
  x_ += std::round(px * aside.dot(right));
  y_ -= std::round(px * aside.dot(up));
  send({.kind = InputEvent::Kind::kMouseMove});
  const double deeper = glides ? -left_T.z() : left_T.dot(away);
  if (frames_ % kNotchEvery != 0 || std::abs(deeper) < 0.6 * kFineNotch_m) return;
  const bool fine = std::abs(deeper) < 1.5 * kNotch_m;
  const double notch = fine ? kFineNotch_m : kNotch_m;
  const double notches = std::clamp(std::round(deeper / notch), -2.0, 2.0);
  send({.kind = InputEvent::Kind::kWheel, .shift = fine, .wheel = notches});
}

/// The shaft by dragging its far end with the right button, roll by keys.
void SteeredHand::turn(const Mat3& wanted_TI, const Camera& camera) {
  const Mat3& R = steering_.intent().X_TI.R;
  const Vec3 far = -R.col(2), wanted = -wanted_TI.col(2);
  const auto [right, up, away] = axes_of(camera);
  const SteeringReach reach = steering_reach(scene_.setup.exercise, scene_.level);
  Vec3 lean = kGain * (wanted - far);
  if (lean.norm() > kLeanNoticed && !reach.port_T) {
    lean *= std::min(1.0, kFastestLean / lean.norm());
    const double px = (is_scope(scene_.setup.exercise) ? kScopeTurnSign : 1) * kHigh_px / kDragTurn;
    send({.kind = InputEvent::Kind::kButtonDown, .button = MouseButton::kRight});
    x_ += std::round(px * lean.dot(right));
    y_ -= std::round(px * lean.dot(up));
    send({.kind = InputEvent::Kind::kMouseMove});
    send({.kind = InputEvent::Kind::kButtonUp, .button = MouseButton::kRight});
  }
  double roll = 0;
  if (reach.rolls_stylus) {
    const Eigen::Quaterniond left(Mat3(wanted_TI * R.transpose()));
    roll = 2 * std::atan2(left.y(), left.w());
  } else {
    const Eigen::Quaterniond left(Mat3(R.transpose() * least_turn(wanted, far) * wanted_TI));
    roll = 2 * std::atan2(left.z(), left.w());
  }
  roll = std::remainder(roll, 2 * std::numbers::pi);
  hold(Action::kRollRight, roll > kRollNoticed);
  hold(Action::kRollLeft, roll < -kRollNoticed);
  send({.kind = InputEvent::Kind::kMouseMove, .shift = std::abs(roll) < kRollFast});
}

/// Where they have a key of their own it is held while they shall be narrower; else by the act button, and what was
/// let go stays until a tap on the key that lets off opens them: which a script that only eases its grip does not mean.
void SteeredHand::use_jaws(double wanted_m, const AtHand& around) {
  const double now_m = around.now.jaw_opening_m;
  const bool narrower = wanted_m + grip_yields_m_ < now_m - kClose_m;
  hold(Action::kGrip, around.jaws_apart && (narrower || wanted_m < kClose_m));
  if (around.jaws_apart) return;
  if (!around.jaws) return hold(Action::kAct, false);
  lets_off_s_ -= kFrame_s;
  const bool opens = wanted_m - std::exchange(wanted_jaw_m_, wanted_m) > kOpens_m_per_s * kFrame_s;
  if (opens && wanted_m > now_m + kOpen_m && lets_off_s_ < -kTap_s) lets_off_s_ = kTap_s;
  hold(Action::kLetOff, lets_off_s_ > 0);
  hold(Action::kAct, narrower && lets_off_s_ <= 0);
}

}  // namespace trocar::testing_support
