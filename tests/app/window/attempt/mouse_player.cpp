#include "tests/app/window/attempt/mouse_player.h"

#include <algorithm>

#include "app/picture/attempt/attempt_hud.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar {
namespace {

constexpr PixelRect kPicture{0, 45, 960, 644};  // of a window of 1280 x 720
constexpr double kFrame_s = 0.02;
constexpr std::size_t kEyeFrames = 10;  // 200 ms
constexpr double kGain = 0.06;          // of an error, a frame: slower than the eye is late
constexpr double kMost_px = 14;         // of a movement, a frame

}  // namespace

MousePlayer::MousePlayer(const Scene& scene, const SteeringOptions& options)
    : scene_(scene), camera_(attempt_camera(scene)), steering_(KeyMap(), options) {}

SessionHooks MousePlayer::hooks() {
  SessionHooks hooks;
  hooks.hand = [this] { return std::make_unique<PersonHand>(*link_); };
  hooks.observe = [this](const SessionView& view) { look(view); };
  return hooks;
}

MousePlayer::Seen MousePlayer::see(const SessionView& view) const {
  const SceneView scene = attempt_scene(view);
  const ScopeOptics optics(camera_, kPicture);
  const DirectorStatus& status = view.director.status();
  Seen seen;
  seen.ready = link_->ready;
  seen.phase = status.phase;
  seen.cue = status.cue;
  seen.target = status.target_index;
  seen.toast = status.message;
  // What touches is where the dent is; the tip itself is in it.
  if (const auto tip = optics.project(scene.dimple_T.value_or(scene.X_TI.p))) seen.tip = *tip;
  for (const TargetMark& mark : scene.targets)
    if (mark.state == TargetMark::State::kLit)
      seen.goal_seen = true, seen.goal = optics.project(mark.centre_T).value_or(seen.goal);
  for (const SceneObject& object : scene.objects) {
    if (object.shape != SceneObject::Shape::kSphere) continue;
    seen.goal_seen = true;
    seen.goal = optics.project(object.X_TO.p).value_or(seen.goal);
    seen.goal_hides_tip = (object.X_TO.p - scene.X_TI.p).dot(optics.forward()) < 0;
  }
  const Hud hud = attempt_hud(view, camera_, "");
  if (!hud.bars.empty() && !hud.bars[0].hidden) {
    seen.force_n = hud.bars[0].value_n;
    seen.band_low_n = hud.bars[0].band_low_n;
    seen.band_high_n = hud.bars[0].band_high_n;
  }
  if (hud.bars.size() > 1 && !hud.bars[1].hidden) seen.grip_n = hud.bars[1].value_n;
  seen.has_dial = hud.dial.has_value();
  if (hud.dial) seen.dial = *hud.dial;
  return seen;
}

void MousePlayer::look(const SessionView& view) {
  if (view.t_s < next_s_) return;
  next_s_ = view.t_s + kFrame_s - 1e-9;
  t_s_ = view.t_s;
  if (!begun_ && link_->ready) {
    const HandIntent& from = link_->target.read();
    steering_.begin(from.X_TI, from.jaw_opening_m, scene_.board.centre_T,
                    steering_reach(scene_.setup.exercise, scene_.level));
    begun_ = true;
  }
  eye_.push_back(see(view));
  if (eye_.size() <= kEyeFrames) return;
  const Seen seen = eye_.front();
  eye_.pop_front();
  if (!begun_ || !seen.ready) return;
  act(seen);
  link_->wanted.write({steering_.advance(kFrame_s, camera_, kPicture.height), ++number_});
}

bool MousePlayer::often(double seconds) {
  if (t_s_ - wheeled_s_ < seconds) return false;
  wheeled_s_ = t_s_;
  return true;
}

void MousePlayer::move(const Eigen::Vector2d& by_px) {
  pointer_ += by_px;
  InputEvent event;
  event.kind = InputEvent::Kind::kMouseMove;
  event.x = pointer_.x();
  event.y = pointer_.y();
  event.control = control_;
  event.shift = shift_;
  steering_.handle(event);
}

void MousePlayer::wheel(int notches, bool fine) {
  InputEvent event;
  event.kind = InputEvent::Kind::kWheel;
  event.wheel = notches;
  event.shift = fine;
  steering_.handle(event);
}

void MousePlayer::button(MouseButton which, bool down) {
  bool& held = which == MouseButton::kLeft ? left_ : right_;
  if (held == down) return;
  held = down;
  InputEvent event;
  event.kind = down ? InputEvent::Kind::kButtonDown : InputEvent::Kind::kButtonUp;
  event.button = which;
  steering_.handle(event);
}

void MousePlayer::key(std::int32_t which, bool down) {
  bool& held = which == kKeyControl ? control_ : shift_;
  if (which == kKeyControl || which == kKeyShift) {
    if (held == down) return;
    held = down;
  }
  InputEvent event;
  event.kind = down ? InputEvent::Kind::kKeyDown : InputEvent::Kind::kKeyUp;
  event.key = which;
  event.control = control_;
  event.shift = shift_;
  steering_.handle(event);
}

namespace {

Eigen::Vector2d step(const Eigen::Vector2d& error) {
  Eigen::Vector2d by = kGain * error;
  if (by.norm() > kMost_px) by *= kMost_px / by.norm();
  return by;
}

}  // namespace

void MousePlayer::act(const Seen& seen) {
  switch (seen.phase) {
    case Phase::kReady:
    case Phase::kArmed:
      return find_start(seen);
    case Phase::kRun:
      break;
    default:
      return;
  }
  if (seen.has_dial) return match_pen(seen);
  if (seen.cue == Cue::kGrip) return squeeze(seen);
  touch(seen);
}

/// Puts the tip over the ball in the picture; what hides what tells whether to go in or out, until the screen says
/// "hold still".
void MousePlayer::find_start(const Seen& seen) {
  if (!seen.goal_seen) return;
  const Eigen::Vector2d error = seen.goal - seen.tip;
  move(step(error));
  if (seen.phase == Phase::kArmed || error.norm() > 15 || !often(0.3)) return;
  wheel(seen.goal_hides_tip ? -1 : 1, false);
}

/// Back off, over the disc, in until it is felt, then by the bar.
void MousePlayer::touch(const Seen& seen) {
  if (seen.target != target_) {
    back_ = target_ < 0 ? 0 : 4;
    target_ = seen.target;
    settled_ = 0;
    return;
  }
  if (back_ > 0) {
    if (often(0.1)) wheel(-1, false), --back_;
    return;
  }
  const Eigen::Vector2d error = seen.goal - seen.tip;
  const bool felt = seen.force_n > 0.04;
  move(felt ? Eigen::Vector2d(0.5 * step(error)) : step(error));
  settled_ = error.norm() < 7 ? settled_ + 1 : 0;
  if (!felt) {
    if (settled_ > 4 && often(0.3)) wheel(1, false);
    return;
  }
  const double middle = 0.5 * (seen.band_low_n + seen.band_high_n), half = 0.5 * (seen.band_high_n - seen.band_low_n);
  if (std::abs(seen.force_n - middle) < 0.5 * half || !often(0.4)) return;
  const double away = std::abs(seen.force_n - middle);
  wheel((seen.force_n < middle ? 1 : -1) * (away > 0.25 ? 4 : away > 0.15 ? 2 : 1), true);
}

/// Slowly, with Shift; the latch keeps what the bar shows to be right.
void MousePlayer::squeeze(const Seen& seen) {
  key(kKeyShift, true);
  const double middle = 0.95;
  if (steering_.latched()) return;
  if (seen.toast == "Open the jaws") return button(MouseButton::kLeft, false);
  if (seen.grip_n < middle - 0.05) return button(MouseButton::kLeft, true);
  key(kKeySpace, true);
  key(kKeySpace, false);
  button(MouseButton::kLeft, false);
}

/// By the dial: place first, then the shaft, then the roll; one at a time, as a hand at a mouse must.
void MousePlayer::match_pen(const Seen& seen) {
  const PoseDial& dial = seen.dial;
  const Vec3 off = -dial.offset_C;  // to go: right, up, away
  const double fine = 0.6 * dial.position_tolerance_m, turn_fine = 0.35 * dial.angle_tolerance_rad;
  if (off.head<2>().norm() > fine) {
    button(MouseButton::kRight, false);
    key(kKeyControl, false);
    const double px_per_m = 6000;  // what a hand has learnt of its mouse
    return move(step(px_per_m * Eigen::Vector2d(off.x(), -off.y())));
  }
  if (std::abs(off.z()) > fine && often(0.3)) return wheel(off.z() > 0 ? 1 : -1, std::abs(off.z()) < 0.006);
  button(MouseButton::kRight, true);
  const double px_per_rad = 200;
  const auto turned = [&](double rad) { return std::clamp(kGain * px_per_rad * rad, -6.0, 6.0); };
  if (std::abs(dial.lean_C.y()) > turn_fine) return key(kKeyControl, false), move({0, turned(dial.lean_C.y())});
  if (std::abs(dial.lean_C.x()) > turn_fine) return key(kKeyControl, true), move({-turned(dial.lean_C.x()), 0});
  key(kKeyControl, false);
  if (std::abs(dial.roll_rad) > turn_fine) move({-turned(dial.roll_rad), 0});
}

}  // namespace trocar
