#include "app/screens/coach.h"

#include <cmath>

namespace trocar {
namespace {

constexpr double kEnough_px = 120;   // of the pointer's way: not a twitch
constexpr double kPushed = 0.4;      // of a stick

}  // namespace

void Coach::begin(bool wanted) {
  *this = Coach();
  wanted_ = wanted;
}

void Coach::pass(double dt_s) {
  if (all()) over_s_ += dt_s;
}

void Coach::saw(const InputEvent& event, const KeyMap& keys) {
  using Kind = InputEvent::Kind;
  const auto action = event.kind == Kind::kKeyDown ? keys.action_of(event.key) : std::nullopt;
  if (action && *action <= Action::kDown) done_[0] = true;
  if (action == Action::kInsert || action == Action::kWithdraw || event.kind == Kind::kWheel) done_[1] = true;
  if (action == Action::kClose || action == Action::kLatch || action == Action::kOpen) done_[2] = true;
  if (event.kind == Kind::kButtonDown && event.button == MouseButton::kLeft) done_[2] = true;
  if (event.kind == Kind::kMouseMove) {
    if (last_x_ >= 0) way_px_ += std::hypot(event.x - last_x_, event.y - last_y_);
    last_x_ = event.x;
    last_y_ = event.y;
    if (way_px_ > kEnough_px) done_[0] = true;
  }
  if (event.kind == Kind::kPad || event.kind == Kind::kPuck) {
    const auto& a = event.axis;
    if (std::hypot(a[0], a[1]) > kPushed) done_[0] = true;
    if (event.kind == Kind::kPuck ? std::abs(a[2]) > kPushed : (event.buttons & 0x30U) != 0) done_[1] = true;
    if (event.kind == Kind::kPuck ? (event.buttons & 1U) != 0 : std::max(a[4], a[5]) > kPushed) done_[2] = true;
  }
}

std::vector<Coach::CoachMark> Coach::marks(const Words& words, const KeyMap& keys, InputKind kind) const {
  switch (kind) {
    case InputKind::kPad:
      return {{words("The left stick moves the tip"), done_[0]},
              {words("The shoulder buttons go deeper and back"), done_[1]},
              {words("A trigger closes the jaws"), done_[2]}};
    case InputKind::kPuck:
      return {{words("Push the cap: the tip moves"), done_[0]},
              {words("Press it down or lift it: deeper and back"), done_[1]},
              {words("Its first button closes the jaws"), done_[2]}};
    case InputKind::kDevice:
      return {{words("Move the stylus: the tip moves"), true}, {words("Press the pads to grip"), true}};
    case InputKind::kMouse:
    case InputKind::kKeyboard: break;
  }
  return {{words("The mouse moves the tip (or the arrow keys)"), done_[0]},
          {words("The wheel goes deeper and back (or {0}, {1})", {key_name(keys.key_of(Action::kInsert)), key_name(keys.key_of(Action::kWithdraw))}),
           done_[1]},
          {words("The left button closes the jaws (or {0})", {key_name(keys.key_of(Action::kClose))}), done_[2]}};
}

}  // namespace trocar
