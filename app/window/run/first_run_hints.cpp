#include "app/window/run/first_run_hints.h"

#include <cmath>
#include <utility>

#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

constexpr double kEnough_px = 120;  // of the pointer's way: not a twitch
constexpr double kPushed = 0.4;     // of a stick
constexpr double kClick_s = 0.25;   // longer is held

}  // namespace

void FirstRunHints::begin(bool wanted, Tries tries) {
  *this = FirstRunHints();
  wanted_ = wanted;
  tries_ = tries;
  done_[2] = tries == Tries::kRolls;
}

void FirstRunHints::pass(double dt_s) {
  if (all()) over_s_ += dt_s;
  if (acting_) acted_s_ += dt_s;
  if (acted_s_ > kClick_s && tries_ == Tries::kActs) done_[2] = true;
}

/// A short one is a click.
void FirstRunHints::acts(bool held) {
  if (!held && acting_ && acted_s_ <= kClick_s && tries_ == Tries::kActs) done_[3] = true;
  if (held != acting_) acted_s_ = 0;
  acting_ = held;
}

void FirstRunHints::turns(const InputEvent& event, std::optional<Action> action) {
  using Kind = InputEvent::Kind;
  if (event.kind == Kind::kButtonDown || event.kind == Kind::kButtonUp)
    if (event.button == MouseButton::kRight) dragging_ = event.kind == Kind::kButtonDown;
  const bool pad = event.kind == Kind::kPad, cap = event.kind == Kind::kSpaceMouse;
  const auto& a = event.axis;
  const bool leant = (event.kind == Kind::kMouseMove && dragging_) ||
                     (action >= Action::kPitchUp && action <= Action::kYawRight) ||
                     (pad && std::hypot(a[2], a[3]) > kPushed) || (cap && std::hypot(a[3], a[5]) > kPushed);
  const bool rolled = (event.kind == Kind::kWheel && dragging_) || action == Action::kRollLeft ||
                      action == Action::kRollRight || (pad && (event.buttons & (kPadLeft | kPadRight)) != 0) ||
                      (cap && std::abs(a[4]) > kPushed);
  done_[2] = done_[2] || leant;
  done_[3] = done_[3] || rolled;
}

void FirstRunHints::works(const InputEvent& event, std::optional<Action> action) {
  const bool pad = event.kind == InputEvent::Kind::kPad;
  done_[2] = done_[2] || action == Action::kGrip || (pad && event.axis[5] > kPushed);
  done_[3] = done_[3] || action == Action::kExchange || (pad && (event.buttons & kPadRightThumb) != 0);
  done_[4] = done_[4] || action == Action::kPedal || (pad && event.axis[4] > kPushed);
}

void FirstRunHints::saw(const InputEvent& event, const KeyMap& keys) {
  using Kind = InputEvent::Kind;
  const auto action = event.kind == Kind::kKeyDown ? keys.action_of(event.key) : std::nullopt;
  if (action && *action <= Action::kDown) done_[0] = true;
  if (tries_ == Tries::kWorks)
    works(event, action);
  else if (tries_ != Tries::kActs)
    turns(event, action);
  const bool wheel = event.kind == Kind::kWheel && !dragging_;
  if (action == Action::kInsert || action == Action::kWithdraw || wheel) done_[1] = true;
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

std::vector<FirstRunHints::Hint> FirstRunHints::working(const Translator& words, const KeyMap& keys,
                                                        InputKind kind) const {
  const auto name = [&](Action action) { return words.name(key_name(keys.key_of(action))); };
  const bool pad = kind == InputKind::kPad;
  return {
      {pad ? words("Right trigger, held: close the jaws") : words("{0}, held: close the jaws", {name(Action::kGrip)}),
       done_[2]},
      {pad ? words("Right stick pressed: next instrument") : words("{0}: next instrument", {name(Action::kExchange)}),
       done_[3]},
      {pad ? words("Left trigger, held: the pedal") : words("{0}, held: the pedal", {name(Action::kPedal)}), done_[4]}};
}

std::vector<FirstRunHints::Hint> FirstRunHints::marks(const Translator& words, const KeyMap& keys,
                                                      InputKind kind) const {
  const auto name = [&](Action action) { return words.name(key_name(keys.key_of(action))); };
  const auto hints = [&](const std::string& move, const std::string& deeper, const std::string& act,
                         const std::string& let_off, const std::string& lean, const std::string& roll) {
    std::vector<Hint> out{{move, done_[0]}, {deeper, done_[1]}};
    if (tries_ == Tries::kWorks) {
      for (Hint& hint : working(words, keys, kind)) out.push_back(std::move(hint));
      return out;
    }
    if (tries_ != Tries::kRolls) out.push_back({tries_ == Tries::kActs ? act : lean, done_[2]});
    out.push_back({tries_ == Tries::kActs ? let_off : roll, done_[3]});
    return out;
  };
  switch (kind) {
    case InputKind::kPad:
      return hints(words("Left stick: move the tip"), words("Shoulder buttons: deeper, back"),
                   words("Trigger, held: press, grip"), words("Trigger, short: let off"),
                   words("Right stick: lean the shaft"), words("Cross, left and right: roll the shaft"));
    case InputKind::kSpaceMouse:
      return hints(words("Push the cap: move the tip"), words("Press or lift it: deeper, back"),
                   words("First button, held: press, grip"), words("First button, clicked: let off"),
                   words("Tilt the cap: lean the shaft"), words("Twist the cap: roll the shaft"));
    case InputKind::kKeyboard:
      return hints(
          words("Arrow keys: move the tip"),
          words("{0}, {1}: deeper, back", {name(Action::kInsert), name(Action::kWithdraw)}),
          words("{0}, held: press, grip", {name(Action::kAct)}), words("{0}, tapped: let off", {name(Action::kAct)}),
          words("{0} {1} {2} {3}: lean the shaft",
                {name(Action::kPitchUp), name(Action::kPitchDown), name(Action::kYawLeft), name(Action::kYawRight)}),
          words("{0}, {1}: roll the shaft", {name(Action::kRollLeft), name(Action::kRollRight)}));
    case InputKind::kDevice:
      return {{words("Move the stylus: the tip moves"), true}, {words("Press the pads to grip"), true}};
    case InputKind::kMouse:
      break;
  }
  return hints(words("Mouse: move the tip"), words("Wheel: deeper, back"), words("Left button, held: press, grip"),
               words("Left button, clicked: let off"), words("Right button, held: lean the shaft"),
               words("Right button and wheel: roll the shaft"));
}

FirstRunHints::Tries hand_tries(const Exercise& exercise, const ExerciseLevel& level) {
  using Tries = FirstRunHints::Tries;
  if (exercise.instruments.size() > 1) return Tries::kWorks;
  if (!kind_of(exercise).oriented) return Tries::kActs;
  return level.mapping == Mapping::kFulcrum ? Tries::kRolls : Tries::kTurns;
}

}  // namespace trocar
