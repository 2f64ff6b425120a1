// A steering with a camera and short words for events: what the tests of steering share.
#pragma once

#include <numbers>

#include <gtest/gtest.h>

#include "app/window/input/steering.h"

namespace trocar {

inline constexpr double kHeight_px = 720, kStep_s = 0.01;

inline InputEvent event_of(InputEvent::Kind kind) {
  InputEvent event;
  event.kind = kind;
  return event;
}

inline InputEvent key_event(std::int32_t key, bool down) {
  InputEvent event = event_of(down ? InputEvent::Kind::kKeyDown : InputEvent::Kind::kKeyUp);
  event.key = key;
  return event;
}

/// Looking at the origin.
inline Camera camera_at(const Vec3& eye_T, const Vec3& up_T, double field_deg) {
  Camera camera;
  camera.eye_T = eye_T;
  camera.up_T = up_T;
  camera.diagonal_fov_deg = field_deg;
  return camera;
}
/// Looking down onto the board from the person's side.
inline Camera front_camera() { return camera_at(Vec3(0, -0.1, 0.1), Vec3::UnitZ(), 70); }

/// Of a wrist that follows far.
inline SteeringReach wide_reach() { return {0.08, {}, 35 * std::numbers::pi / 180, 150 * std::numbers::pi / 180}; }

struct Steered {
  explicit Steered(const SteeringOptions& options = {}, const SteeringReach& reach = wide_reach())
      : steering(KeyMap(), options) {
    steering.begin({resting(), Vec3::Zero()}, 0.02, Vec3::Zero(), reach);
    move(640, 360);
  }
  /// Shaft pointing down and away from the person, as in a box trainer.
  static Mat3 resting() { return Eigen::AngleAxisd(-2.4, Vec3::UnitX()).toRotationMatrix(); }

  void move(double x, double y) {
    InputEvent event = event_of(InputEvent::Kind::kMouseMove);
    event.x = x;
    event.y = y;
    steering.handle(event);
  }
  void button(MouseButton which, bool down) {
    InputEvent event = event_of(down ? InputEvent::Kind::kButtonDown : InputEvent::Kind::kButtonUp);
    event.button = which;
    steering.handle(event);
  }
  void wheel(double notches, bool shift = false) {
    InputEvent event = event_of(InputEvent::Kind::kWheel);
    event.wheel = notches;
    event.shift = shift;
    steering.handle(event);
  }
  void press(std::int32_t key) { steering.handle(key_event(key, true)); }
  void release(std::int32_t key) { steering.handle(key_event(key, false)); }
  void sticks(InputEvent::Kind kind, const std::array<double, 6>& axis, std::uint32_t buttons = 0) {
    InputEvent event = event_of(kind);
    event.axis = axis;
    event.buttons = buttons;
    steering.handle(event);
  }
  const HandIntent& run(double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep_s); ++i) {
      around.now = steering.intent();  // a hand that follows at once
      steering.advance(kStep_s, camera, kHeight_px, around);
    }
    return steering.intent();
  }
  Vec3 tip() const { return steering.intent().X_TI.p; }
  /// Far end of the shaft, a unit vector from the tip.
  Vec3 far() const { return -steering.intent().X_TI.R.col(2); }

  Steering steering;
  Camera camera = front_camera();
  AtHand around = {};
};

struct Axes {
  Vec3 right, up, away;
};
inline Axes axes_of(const Camera& camera) {
  const Vec3 away = (camera.look_at_T - camera.eye_T).normalized(), right = away.cross(camera.up_T).normalized();
  return {right, right.cross(away), away};
}

}  // namespace trocar
