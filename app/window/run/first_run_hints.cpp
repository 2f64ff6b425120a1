#include "app/window/run/first_run_hints.h"

#include <cmath>

namespace trocar {
namespace {

constexpr double kEnough_px = 120;  // of the pointer's way: not a twitch
constexpr double kPushed = 0.4;     // of a stick
constexpr double kClick_s = 0.25;   // longer is held

}  // namespace

void FirstRunHints::begin(bool wanted) {
  *this = FirstRunHints();
  wanted_ = wanted;
}

void FirstRunHints::pass(double dt_s) {
  if (all()) over_s_ += dt_s;
  if (acting_) acted_s_ += dt_s;
  if (acted_s_ > kClick_s) done_[2] = true;
}

/// A short one is a click.
void FirstRunHints::acts(bool held) {
  if (!held && acting_ && acted_s_ <= kClick_s) done_[3] = true;
  if (held != acting_) acted_s_ = 0;
  acting_ = held;
}

void FirstRunHints::saw(const InputEvent& event, const KeyMap& keys) {
  using Kind = InputEvent::Kind;
  const auto action = event.kind == Kind::kKeyDown ? keys.action_of(event.key) : std::nullopt;
  if (action && *action <= Action::kDown) done_[0] = true;
  if (action == Action::kInsert || action == Action::kWithdraw || event.kind == Kind::kWheel) done_[1] = true;
  const bool key = event.kind == Kind::kKeyDown || event.kind == Kind::kKeyUp;
  const bool button = event.kind == Kind::kButtonDown || event.kind == Kind::kButtonUp;
  if (key && keys.action_of(event.key) == Action::kAct) acts(event.kind == Kind::kKeyDown);
  if (button && event.button == MouseButton::kLeft) acts(event.kind == Kind::kButtonDown);
  if (event.kind == Kind::kMouseMove) {
    if (last_x_ >= 0) way_px_ += std::hypot(event.x - last_x_, event.y - last_y_);
    last_x_ = event.x;
    last_y_ = event.y;
    if (way_px_ > kEnough_px) done_[0] = true;
  }
  if (event.kind == Kind::kPad || event.kind == Kind::kSpaceMouse) {
    const auto& a = event.axis;
    if (std::hypot(a[0], a[1]) > kPushed) done_[0] = true;
    if (event.kind == Kind::kSpaceMouse ? std::abs(a[2]) > kPushed : (event.buttons & 0x30U) != 0) done_[1] = true;
    acts(event.kind == Kind::kSpaceMouse ? (event.buttons & 1U) != 0
                                         : std::max(a[4], a[5]) > kPushed || (event.buttons & kPadA) != 0);
  }
}

std::vector<FirstRunHints::Hint> FirstRunHints::marks(const Translator& words, const KeyMap& keys,
                                                      InputKind kind) const {
  const auto name = [&](Action action) { return words.name(key_name(keys.key_of(action))); };
  switch (kind) {
    case InputKind::kPad:
      return {{words("Left stick: move the tip"), done_[0]},
              {words("Shoulder buttons: deeper, back"), done_[1]},
              {words("Trigger, held: press, grip"), done_[2]},
              {words("Trigger, short: let off"), done_[3]}};
    case InputKind::kSpaceMouse:
      return {{words("Push the cap: move the tip"), done_[0]},
              {words("Press or lift it: deeper, back"), done_[1]},
              {words("First button, held: press, grip"), done_[2]},
              {words("First button, clicked: let off"), done_[3]}};
    case InputKind::kKeyboard:
      return {{words("Arrow keys: move the tip"), done_[0]},
              {words("{0}, {1}: deeper, back", {name(Action::kInsert), name(Action::kWithdraw)}), done_[1]},
              {words("{0}, held: press, grip", {name(Action::kAct)}), done_[2]},
              {words("{0}, tapped: let off", {name(Action::kAct)}), done_[3]}};
    case InputKind::kDevice:
      return {{words("Move the stylus: the tip moves"), true}, {words("Press the pads to grip"), true}};
    case InputKind::kMouse:
      break;
  }
  return {{words("Mouse: move the tip"), done_[0]},
          {words("Wheel: deeper, back"), done_[1]},
          {words("Left button, held: press, grip"), done_[2]},
          {words("Left button, clicked: let off"), done_[3]}};
}

}  // namespace trocar
