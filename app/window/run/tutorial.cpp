#include "app/window/run/tutorial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/window/run/first_run_hints.h"

namespace trocar {
namespace {

constexpr double kPraised_s = 0.9;
constexpr double kStays_s = 0.4;                   // over the disc, in the band: not by the way
constexpr double kLow_m = 0.005, kHigh_m = 0.012;  // of the tip over the organ: it glides at 8 mm
constexpr double kFree_s = 0.3;                    // without contact: it bounces
constexpr double kLooked_rad = 6 * std::numbers::pi / 180, kBack_rad = 1 * std::numbers::pi / 180;

/// In FirstRunHints::marks().
enum Gesture : std::size_t { kMoving, kDeeper, kActing, kLettingOff };

std::string gesture(Gesture which, const Translator& w, const KeyMap& keys, InputKind kind) {
  const auto marks = FirstRunHints().marks(w, keys, kind);
  if (kind == InputKind::kDevice) return marks[which == kActing ? 1 : 0].text;  // the stylus: all but the grip
  return marks[which].text;
}

std::string looking(const Translator& w, const KeyMap& keys, InputKind kind) {
  const std::string key = w.name(key_name(keys.key_of(Action::kScope)));
  switch (kind) {
    case InputKind::kPad:
      return w("X, held, and the left stick: look round");
    case InputKind::kSpaceMouse:
      return w("{0}, held, and the cap: look round", {key});
    case InputKind::kKeyboard:
    case InputKind::kDevice:
      return w("{0}, held, and arrow keys: look round", {key});
    case InputKind::kMouse:
      break;
  }
  return w("{0}, held, and the mouse: look round", {key});
}

double turned_rad(const ScopeMove& scope) { return std::hypot(scope.yaw_rad, scope.pitch_rad); }

}  // namespace

bool Tutorial::held(bool so, double dt_s, double wanted_s) {
  held_s_ = so ? held_s_ + dt_s : 0;
  return held_s_ >= wanted_s;
}

bool Tutorial::done(const Seen& seen, double dt_s) {
  const StylusState& stylus = seen.moment.record.stylus;
  const Demand& lit = status_.demand;
  const double height_m = stylus.X_TI.p.z() - seen.below_T.z();
  const double off_m = (stylus.X_TI.p - lit.centre_T).head<2>().norm();
  switch (static_cast<Step>(step_)) {
    case Step::kMove:
      return status_.phase == Phase::kRun;
    case Step::kOver:
      return held(off_m < lit.radius_m, dt_s, kStays_s);
    case Step::kLower:
      return stylus.contact || (off_m < lit.radius_m && height_m < kLow_m);
    case Step::kPress:
      return status_.cue == Cue::kPress && stylus.F_I_T.force.norm() >= lit.band.low_n;
    case Step::kKeep:
      if (status_.targets_done == 0 && held(!stylus.contact, dt_s, kFree_s)) {
        --step_;  // let off too early: press again
        held_s_ = 0;
      }
      return status_.targets_done > 0;
    case Step::kLetOff:
      return held(!stylus.contact, dt_s, kFree_s);
    case Step::kLook:
      return turned_rad(seen.scope) > kLooked_rad;
    case Step::kLevel:
      return turned_rad(seen.scope) < kBack_rad;
    case Step::kAgain:
      return status_.cue == Cue::kGrip;
    case Step::kRaise:
      return !stylus.contact && height_m > kHigh_m;
    case Step::kGrip:
      return held(stylus.grip_force_n >= lit.band.low_n && stylus.grip_force_n <= lit.band.high_n, dt_s, kStays_s);
    case Step::kOpen:
      return held(stylus.grip_force_n <= 0, dt_s, kFree_s);
  }
  return false;
}

std::optional<Tutorial::Step> Tutorial::see(const Seen& seen, double dt_s) {
  if (over() || !seen.moment.seen) return std::nullopt;
  if (praise_s_ > 0) {
    praise_s_ -= dt_s;
    if (praise_s_ <= 0) ++step_;
    return std::nullopt;
  }
  status_ = seen.moment.status;
  const StylusState& stylus = seen.moment.record.stylus;
  if (status_.targets_done > 0) step_ = std::max(step_, static_cast<int>(Step::kKeep));  // went ahead
  const bool gripping = status_.cue == Cue::kGrip;
  const double force_n = gripping ? stylus.grip_force_n : stylus.F_I_T.force.norm();
  beside_ = !gripping && stylus.contact && status_.cue != Cue::kPress;
  rests_ = stylus.contact && force_n < status_.demand.band.low_n;
  too_much_ = status_.phase == Phase::kRun && force_n > status_.demand.band.high_n;
  if (!done(seen, dt_s)) return std::nullopt;
  held_s_ = 0;
  praise_s_ = kPraised_s;
  return static_cast<Step>(step_);
}

std::vector<HudStep> Tutorial::list(const Translator& w) const {
  const std::pair<std::string, Step> parts[] = {
      {w("Move"), Step::kMove},        {w("See depth"), Step::kLower},   {w("Press, keep, let off"), Step::kLetOff},
      {w("Look round"), Step::kLevel}, {w("On your own"), Step::kAgain}, {w("Grip"), Step::kOpen}};
  std::vector<HudStep> out;
  int first = 0;  // step of the part
  for (const auto& [name, last] : parts) {
    const int end = static_cast<int>(last);
    using State = HudStep::State;
    out.push_back({name, step_ > end ? State::kDone : step_ >= first ? State::kCurrent : State::kOpen});
    first = end + 1;
  }
  return out;
}

Tutorial::Said Tutorial::says(const Translator& w, const KeyMap& keys, InputKind kind) const {
  if (praise_s_ > 0) return {w("Good"), "", false, true};
  const auto by = [&](Gesture which) { return gesture(which, w, keys, kind); };
  const auto step = static_cast<Step>(step_);
  const bool presses = step == Step::kPress || step == Step::kKeep || step == Step::kAgain;
  if ((presses || step == Step::kGrip) && too_much_)
    return {by(kLettingOff), w("Too much force: let off, then again more gently."), true};
  if (presses && beside_) return {by(kMoving), w("The tip is beside the disc: let off, and move over it."), true};
  if (step == Step::kLetOff && rests_) return {by(kDeeper), w("Draw the tip back, clear of the organ.")};
  switch (step) {
    case Step::kMove:
      return {by(kMoving), w("Bring the tip into the ball with the yellow outline, and rest there.")};
    case Step::kOver:
      return {by(kMoving), w("The pink ring is below the tip: bring it onto the yellow disc.")};
    case Step::kLower:
      return {by(kDeeper), w("Lower the tip towards the disc: the pink line gets shorter.")};
    case Step::kPress:
      return {by(kActing), w("Hold until the bar beside the tip ends in its green frame.")};
    case Step::kKeep:
      return {w("Let go: the force stays"), w("Wait until the green ring round the tip is full.")};
    case Step::kLetOff:
      return {by(kLettingOff), w("Take the tip off the organ.")};
    case Step::kLook:
      return {looking(w, keys, kind), w("Turn the view a little to one side.")};
    case Step::kLevel:
      return {w("{0}: the view as at the start", {w.name(key_name(keys.key_of(Action::kLevel)))}),
              w("Bring the view back.")};
    case Step::kAgain:
      return {w("Now the next disc, on your own"), w("Move over it, press into the green frame, let go and wait.")};
    case Step::kRaise:
      return {by(kDeeper), w("Draw the tip back, clear of the organ.")};
    case Step::kGrip:
      return {by(kActing), w("Close the jaws until the bar ends in its green frame, then let go.")};
    case Step::kOpen:
      return {by(kLettingOff), w("Open the jaws.")};
  }
  return {};
}

}  // namespace trocar
