#include "app/window/input/steering.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/window/input/careful_press.h"
#include "app/window/input/jaw_fingers.h"
#include "app/window/input/stick_curve.h"
#include "haptics/least_turn.h"

namespace trocar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTipSpeed = 0.25;    // m/s, of the target
constexpr double kMostAhead = 0.040;  // m that a flick of the mouse may be ahead of the target
constexpr double kKeySlow = 0.008, kKeyFast = 0.080, kKeyRamp = 1.2;     // m/s when pressed, after s of holding
constexpr double kStickSpeed = 0.10;                                     // m/s at full deflection
constexpr double kFine = 0.25;                                           // of all that keys and sticks do, with Shift
constexpr double kWheel = 0.002, kWheelFine = 0.0005;                    // m a notch
constexpr double kScopeWheel = 0.005;                                    // likewise
constexpr double kWheelRoll = 4 * kDegree;                               // a notch
constexpr double kLeanSpeed = 90 * kDegree, kRollSpeed = 270 * kDegree;  // rad/s, of the target
constexpr double kKeyTurn = 45 * kDegree, kKeyRoll = 90 * kDegree;       // rad/s
constexpr double kDragTurn = 120 * kDegree;                              // over the picture's height
constexpr double kScopeDrag = 60 * kDegree;                              // likewise
constexpr double kScopeTurn = 25 * kDegree, kScopeDepth = 0.03, kPostTurn = 60 * kDegree;  // rad/s, m/s, rad/s
constexpr double kCircle = 0.64;  // radius of the scope's picture, of its height (scope_optics.h)
constexpr double kTrigger = 0.3;  // of a pad's trigger: pulled
constexpr double kLeap_px = 600;  // between two events: the pointer was elsewhere meanwhile (a panel, another window)
constexpr double kLongestStep = 0.1;  // s: after a standstill of the window nothing leaps

// The act button.
constexpr double kClick_s = 0.2;                            // shorter is a click: it lets off
constexpr double kApproach = 0.012;                         // m/s towards what is not touched yet
constexpr double kToGround_s = 0.25;                        // over a ground: faster from high above,
constexpr double kGroundSlow = 0.004, kGroundFast = 0.040;  // within these, m/s
constexpr double kFollow = 0.02;                            // m/s per N after what relaxes once the button is let go,
constexpr double kMostFollowed = 0.004;                     // m at most: no further into what has given way
constexpr double kShut = 0.001;                             // m: jaws between which nothing is taken
constexpr double kAhead = 0.0015;                           // m that the target may be deeper than the tip
constexpr double kLetOff = 0.10;                            // m/s back
constexpr double kFeltGain = 0.3;                           // of sideways movements, while something is touched
constexpr double kAway = 0.005;                             // m of a movement sideways that lets off by itself
constexpr double kSnap = 0.02;                              // m/s to the middle of what it stands over
constexpr double kEdge = 1e-5;  // m: above what seen_ground() leaves, below any step: there the ground ends
constexpr double kLowest = -0.016, kHighest = 0.120;  // m over the ground: an even press needs 13 mm of soft organ

struct View {
  Vec3 right, up, away;
  double m_per_px;
};

/// @param tip_T what the pointer seems to hold: a pixel of mouse is a pixel of tip.
View view_of(const Camera& camera, const Vec3& tip_T, double height_px) {
  View view;
  view.away = (camera.look_at_T - camera.eye_T).normalized();
  const Vec3 right = view.away.cross(camera.up_T);
  view.right = right.norm() < 1e-6 ? Vec3(view.away.unitOrthogonal()) : Vec3(right.normalized());
  view.up = view.right.cross(view.away);
  const double depth = std::clamp((tip_T - camera.eye_T).dot(view.away), 0.03, 0.30);
  view.m_per_px = depth * std::tan(0.5 * camera.diagonal_fov_deg * kDegree) / (kCircle * std::max(1.0, height_px));
  return view;
}

/// What is wanted in one step: right, up and away in the picture (m), then lean of the shaft's far end to the right and
/// up and roll to the right (rad).
struct Wish {
  Vec3 tip = Vec3::Zero();
  Eigen::Vector2d lean = Eigen::Vector2d::Zero();
  double roll = 0;
};

Mat3 swing(const Vec3& from, const Vec3& to) { return least_turn(from, to).toRotationMatrix(); }

Vec3 toward(const Vec3& from, const Vec3& to, double step) {
  const Vec3 way = to - from;
  const double length = way.norm();
  return length <= step ? to : Vec3(from + way * (step / length));
}

Vec3 no_longer(const Vec3& v, double most) { return v.norm() > most ? Vec3(v.normalized() * most) : v; }

}  // namespace

struct Steering::State {
  KeyMap keys;
  SteeringOptions options;
  // from where
  Pose X_TI_begin = {};
  Vec3 centre_T = Vec3::Zero();
  SteeringReach reach = {};
  // wanted and followed
  Vec3 wanted_T = Vec3::Zero(), wanted_lean_T = Vec3::Zero(), lean_T = Vec3::Zero(), clutched_at_T = Vec3::Zero();
  double wanted_roll = 0, roll = 0;
  HandIntent intent = {};
  JawFingers jaw = {};
  // over a ground
  int ground = 0;                 ///< its number; 0: none
  Vec3 foot_T = Vec3::Zero();     ///< on the ground, below the tip
  Vec3 pointed_T = Vec3::Zero();  ///< the same, but at an edge on the line of sight: no small step over it is lost
  double lift_m = 0, rest_m = 0;  ///< of the tip over its foot; and where it settles
  // the act button
  bool acting = false;                   ///< held
  double acted_s = 0;                    ///< for how long
  bool let_go = false, let_off = false;  ///< in this step: kept from now on; a click, or the tip goes away
  Vec3 act_way_T = Vec3::Zero();         ///< what pressing has added to the place
  bool returning = false;                ///< and is taken back
  CarefulPress careful = {};
  double kept_n = 0, followed_m = 0;  ///< force that is kept since the button was let go, and the way that it took
  double aside_m = 0;                 ///< moved sideways since it is kept
  ScopeHand scope = {};
  InputKind kind = InputKind::kMouse;
  // held
  std::map<Action, double> held = {};  ///< and for how long, s
  bool shift_key = false, shift = false;
  bool left = false, right = false, middle = false, alt = false, pointer_known = false;
  double x = 0, y = 0;  ///< px
  std::array<double, 6> pad{}, space_mouse{};
  std::uint32_t pad_buttons = 0, space_mouse_buttons = 0;
  // since the last step
  Eigen::Vector2d moved_px = Eigen::Vector2d::Zero(), dragged_px = Eigen::Vector2d::Zero(),
                  scoped_px = Eigen::Vector2d::Zero();
  double wheel_m = 0, roll_wheel = 0, scope_wheel = 0;
  bool exchange_pressed = false;  ///< however short
  bool closed_by_key = false;     ///< the jaws, in the last step
  // the exchange switch
  bool exchange_down = false, exchange_refused = false;  ///< in the last step; since it is down
  bool refuses_exchange = false;                         ///< in the last step

  bool on(Action action) const { return held.contains(action); }
  bool pad_on(std::uint32_t button) const { return (pad_buttons & button) != 0; }
  double pair(Action plus, Action minus) const { return (on(plus) ? 1 : 0) - (on(minus) ? 1 : 0); }
  bool scoping() const { return on(Action::kScope) || alt || pad_on(kPadX); }
  double side() const { return options.left_handed ? -1 : 1; }

  void release_all() {
    held.clear();
    shift_key = shift = left = right = middle = alt = pointer_known = false;
    pad = space_mouse = {};
    pad_buttons = space_mouse_buttons = 0;
    moved_px = dragged_px = scoped_px = Eigen::Vector2d::Zero();
    wheel_m = roll_wheel = scope_wheel = 0;
    exchange_pressed = closed_by_key = false;
  }

  /// As the event says, or as the keys themselves were seen.
  void modifiers(const InputEvent& event) {
    const bool down = event.kind == InputEvent::Kind::kKeyDown;
    if (event.key == kKeyShift) shift_key = down;
    shift = shift_key || (event.shift && event.key != kKeyShift);
    alt = keys.key_of(Action::kScope) == kKeyAlt && event.alt && event.key != kKeyAlt;
  }

  bool key(const InputEvent& event) {
    const bool down = event.kind == InputEvent::Kind::kKeyDown;
    const auto action = keys.action_of(event.key);
    const auto& names = action_names();
    const bool steers = action && std::any_of(names.begin(), names.end(),
                                              [&](const auto& n) { return n.action == *action && n.steering; });
    if (!steers) return false;
    if (!down) {
      held.erase(*action);
      return true;
    }
    if (event.repeat || on(*action)) return true;
    held[*action] = 0;
    if (*action <= Action::kWithdraw) kind = InputKind::kKeyboard;
    if (*action == Action::kLevel) scope.level();
    if (*action == Action::kExchange) exchange_pressed = true;
    return true;
  }

  void pointer(const InputEvent& event) {
    const Eigen::Vector2d by(event.x - x, y - event.y);  // right, up
    x = event.x;
    y = event.y;
    if (!pointer_known || by.isZero() || by.norm() > kLeap_px) {
      pointer_known = true;
      return;
    }
    if (middle || scoping()) {
      scoped_px += by;
    } else if (right) {
      dragged_px += by;
    } else {
      moved_px += by;
      kind = InputKind::kMouse;
    }
  }

  void button(const InputEvent& event) {
    const bool down = event.kind == InputEvent::Kind::kButtonDown;
    (event.button == MouseButton::kLeft ? left : event.button == MouseButton::kRight ? right : middle) = down;
  }

  void wheel(const InputEvent& event) {
    if (middle || scoping()) {
      scope_wheel += event.wheel;
    } else if (right) {
      roll_wheel += event.wheel;
    } else {
      wheel_m += event.wheel * (shift ? kWheelFine : kWheel);
      kind = InputKind::kMouse;
    }
  }

  void sticks(const InputEvent& event, std::array<double, 6>& axes, std::uint32_t& buttons, InputKind own) {
    axes = event.axis;
    buttons = event.buttons;
    for (const double axis : axes)
      if (shaped_axis(axis) != 0) kind = own;
  }

  bool handle(const InputEvent& event) {
    using Kind = InputEvent::Kind;
    if (event.kind == Kind::kFocusLost) {
      release_all();
      acted_s = kClick_s;  // what is let go now is kept, not clicked
      return false;
    }
    if (event.kind != Kind::kPad && event.kind != Kind::kSpaceMouse) {
      modifiers(event);
    }
    switch (event.kind) {
      case Kind::kKeyDown:
      case Kind::kKeyUp:
        return key(event);
      case Kind::kMouseMove:
        pointer(event);
        break;
      case Kind::kButtonDown:
      case Kind::kButtonUp:
        button(event);
        break;
      case Kind::kWheel:
        wheel(event);
        break;
      case Kind::kPad:
        sticks(event, pad, pad_buttons, InputKind::kPad);
        break;
      case Kind::kSpaceMouse:
        sticks(event, space_mouse, space_mouse_buttons, InputKind::kSpaceMouse);
        break;
      case Kind::kText:
        return false;
      case Kind::kFocusLost:
        break;
    }
    return true;
  }

  /// m in dt along one axis of the picture by two keys; the longer they are held the faster.
  double key_way(Action plus, Action minus, double dt_s) const {
    double way = 0;
    for (const auto& [action, sign] : {std::pair(plus, 1.0), std::pair(minus, -1.0)}) {
      const auto found = held.find(action);
      if (found == held.end()) continue;
      const double share = std::min(1.0, (found->second + 0.5 * dt_s) / kKeyRamp);
      way += sign * (kKeySlow + share * share * (kKeyFast - kKeySlow)) * dt_s;
    }
    return way;
  }

  /// What keys and sticks want of the tip or, while it is held, of the scope.
  Vec3 plane_wish(double dt_s) const {
    const double fine = shift ? kFine : 1;
    const Eigen::Vector2d stick = shaped_stick(pad[0], -pad[1]);
    const double bumpers = (pad_on(kPadRightBumper) ? 0.4 : 0) - (pad_on(kPadLeftBumper) ? 0.4 : 0);
    const Vec3 rate(stick.x() + shaped_axis(space_mouse[0]), stick.y() + shaped_axis(space_mouse[1]),
                    bumpers - shaped_axis(space_mouse[2]));
    return fine * (kStickSpeed * dt_s * rate + Vec3(key_way(Action::kRight, Action::kLeft, dt_s),
                                                    key_way(Action::kUp, Action::kDown, dt_s),
                                                    key_way(Action::kInsert, Action::kWithdraw, dt_s)));
  }

  Wish wish(double dt_s, const View& view, double height_px) const {
    Wish out;
    out.tip = Vec3(moved_px.x(), moved_px.y(), 0) * view.m_per_px + Vec3(0, 0, wheel_m);
    if (!scoping()) out.tip += plane_wish(dt_s);
    out.tip *= options.sensitivity;
    if (options.like_a_fulcrum) out.tip.head<2>() *= -1;
    const double fine = shift ? kFine : 1;
    const Eigen::Vector2d stick = shaped_stick(pad[2], -pad[3]), drag = dragged_px / std::max(1.0, height_px);
    const double cross = (pad_on(kPadRight) ? 1 : 0) - (pad_on(kPadLeft) ? 1 : 0);
    const Eigen::Vector2d hand(side() * (stick.x() + shaped_axis(-space_mouse[5])),
                               stick.y() - shaped_axis(space_mouse[3]));
    const Eigen::Vector2d by_key(pair(Action::kYawRight, Action::kYawLeft), pair(Action::kPitchUp, Action::kPitchDown));
    out.lean = fine * kKeyTurn * dt_s * (hand + by_key) + kDragTurn * Eigen::Vector2d(side() * drag.x(), drag.y());
    out.roll = fine * kKeyRoll * dt_s *
                   (pair(Action::kRollRight, Action::kRollLeft) + side() * (cross + shaped_axis(-space_mouse[4]))) +
               side() * kWheelRoll * roll_wheel;
    return out;
  }

  /// The triggers act, too, but where the right one closes the jaws and the left one is the pedal.
  bool act_held(bool triggers) const {
    return left || on(Action::kAct) || pad_on(kPadA) || (triggers && std::max(pad[4], pad[5]) > kTrigger) ||
           (space_mouse_buttons & 1u) != 0;
  }

  /// Held, let go of, or clicked. A click takes back at once.
  void act(bool triggers, double dt_s) {
    const bool held_now = act_held(triggers);
    let_go = acting && !held_now;
    let_off = (let_go && acted_s < kClick_s) || on(Action::kLetOff) || (space_mouse_buttons & 2u) != 0 || pad_on(kPadY);
    acted_s = held_now ? acted_s + dt_s : 0;
    if (held_now && !acting) aside_m = 0;
    acting = held_now;
  }

  /// Where the tip is without what pressing adds. Over a ground its foot follows the pointer.
  void move_foot(const Vec3& aside, double deeper_m, const GlideGround& over, const Camera& camera, double dt_s) {
    if (over.number != ground) {
      ground = over.number;
      foot_T = wanted_T;
      lift_m = wanted_T.z() - over.level_z_m.value_or(over.height(foot_T.x(), foot_T.y()));
      rest_m = over.clearance_m;
      pointed_T = {foot_T.x(), foot_T.y(), over.height(foot_T.x(), foot_T.y())};
    }
    if (!aside.isZero()) {
      const Vec3 next = pointed_T + over.aside * aside;
      foot_T = pointed_T = seen_ground(over, camera, next).value_or(next);
    }
    if (aside.isZero() && !acting && over.centre_T)
      foot_T.head<2>() +=
          no_longer(Vec3((*over.centre_T - foot_T).cwiseProduct(Vec3(1, 1, 0))), kSnap * dt_s).head<2>();
    foot_T = within_ball(foot_T, Vec3(centre_T.x(), centre_T.y(), foot_T.z()), reach.radius_m);
    foot_T.z() = over.height(foot_T.x(), foot_T.y());
    const bool below_edge = std::abs(pointed_T.z() - foot_T.z()) > kEdge;
    if (!below_edge || pointed_T.head<2>() != foot_T.head<2>()) pointed_T = foot_T;
    if (deeper_m != 0) rest_m = lift_m = std::clamp(lift_m - deeper_m, kLowest, kHighest);
    const double settles = over.settle_m_per_s * dt_s;
    if (!acting) lift_m += std::clamp(rest_m - lift_m, -settles, settles);
    wanted_T = {foot_T.x(), foot_T.y(), over.level_z_m.value_or(foot_T.z()) + lift_m};
  }

  /// Tissue that is held relaxes. Fingers keep their force; a pointer has none to feel it by.
  void follow_relaxing(const AtHand& around, double dt_s) {
    if (let_go && around.touching) kept_n = around.force_n, followed_m = 0;
    if (acting || returning || around.jaws || !around.touching) kept_n = 0;
    const double way =
        std::min({kFollow * (kept_n - around.force_n), CarefulPress::kSlow, (kMostFollowed - followed_m) / dt_s});
    if (kept_n == 0 || !(way > 0)) return;
    followed_m += way * dt_s;
    act_way_T -= way * dt_s * around.normal_T;
  }

  /// What the act button adds: on to the surface, and into it as long as it is held.
  void press(const AtHand& around, const View& view, double dt_s) {
    if (let_off && !around.jaws) returning = true;
    if (acting && acted_s > kClick_s) returning = false;
    if (returning) act_way_T = toward(act_way_T, Vec3::Zero(), kLetOff * dt_s);
    if (act_way_T.isZero()) returning = false;
    if (!acting || !around.touching) careful.leave();
    follow_relaxing(around, dt_s);
    if (!acting || around.jaws || returning) return;
    if (around.jaws_apart && !gripping() && around.now.jaw_opening_m > kShut) return;  // else it would take a fold
    const Vec3& tip = around.now.X_TI.p;
    if (around.touching) {
      const double deeper = careful.speed(around.force_n) * dt_s;
      careful.go(deeper);
      act_way_T -= deeper * around.normal_T;
    } else if (ground > 0) {
      const double speed = std::clamp((lift_m + act_way_T.z()) / kToGround_s, kGroundSlow, kGroundFast);
      act_way_T.z() -= speed * dt_s;
    } else {
      act_way_T += kApproach * dt_s * view.away;
    }
    const Vec3 ahead = wanted_T + act_way_T - tip;  // not far beyond a tip that something holds back
    const double deep = around.touching ? -ahead.dot(around.normal_T) : 0;
    if (deep > kAhead) act_way_T += (deep - kAhead) * around.normal_T;
  }

  void move_tip(const Wish& wish, const View& view, const Camera& camera, const AtHand& around, double dt_s) {
    const bool felt = around.touching && !around.jaws;
    const double gain = felt ? kFeltGain : 1;
    const Vec3 aside = gain * (view.right * wish.tip.x() + view.up * wish.tip.y());
    aside_m = felt && !acting ? aside_m + aside.norm() : 0;
    if (aside_m > kAway) let_off = true;
    if (around.ground) {
      move_foot(aside, wish.tip.z(), *around.ground, camera, dt_s);
    } else {
      ground = 0;
      wanted_T += aside + view.away * wish.tip.z();
    }
    press(around, view, dt_s);
    wanted_T = within_ball(wanted_T, centre_T, reach.radius_m);
    const Vec3 next = wanted_T + act_way_T;
    const Vec3 there = around.ground ? next : Vec3(intent.X_TI.p + no_longer(next - intent.X_TI.p, kMostAhead));
    if (!around.ground) wanted_T = there - act_way_T;
    intent.X_TI.p = toward(intent.X_TI.p, there, kTipSpeed * dt_s);
  }

  /// Lean is a vector across the shaft as it began: direction and angle of what its far end has gone.
  void turn_wrist(const Wish& wish, const View& view, double dt_s) {
    const Vec3 far0 = -X_TI_begin.R.col(2);
    const auto across = [&](const Vec3& axis) {  // a shaft along that axis leans away instead
      const Vec3 seen = std::abs(axis.dot(far0)) < 0.95 ? axis : view.away;
      return Vec3((seen - far0 * seen.dot(far0)).normalized());
    };
    wanted_lean_T = no_longer(wanted_lean_T + across(view.right) * wish.lean.x() + across(view.up) * wish.lean.y(),
                              reach.most_lean_rad);
    lean_T = toward(lean_T, wanted_lean_T, kLeanSpeed * dt_s);
    wanted_roll = std::clamp(wanted_roll + wish.roll, -reach.most_roll_rad, reach.most_roll_rad);
    roll += std::clamp(wanted_roll - roll, -kRollSpeed * dt_s, kRollSpeed * dt_s);

    const double angle = lean_T.norm();
    Vec3 far = angle > 0 ? Vec3(std::cos(angle) * far0 + std::sin(angle) / angle * lean_T) : far0;
    if (reach.port_T) {
      const Vec3 out = *reach.port_T - intent.X_TI.p;
      far = out.norm() > 1e-6 ? Vec3(out.normalized()) : far0;
      wanted_lean_T = lean_T = Vec3::Zero();
    }
    const auto about = [&](const Vec3& axis) { return Eigen::AngleAxisd(roll, axis).toRotationMatrix(); };
    intent.X_TI.R = reach.rolls_stylus ? Mat3(about(Vec3::UnitY()) * swing(far0, far) * X_TI_begin.R)
                                       : Mat3(swing(far0, far) * X_TI_begin.R * about(Vec3::UnitZ()));
  }

  void move_scope(double dt_s, double height_px) {
    const Eigen::Vector2d drag = kScopeDrag * scoped_px / std::max(1.0, height_px);
    ScopeMove more{0, drag.x(), drag.y(), scope_wheel * kScopeWheel};
    if (scoping()) {
      const Vec3 held_wish = plane_wish(1);  // m/s
      more.yaw_rad += std::clamp(held_wish.x() / kKeyFast, -1.0, 1.0) * kScopeTurn * dt_s;
      more.pitch_rad += std::clamp(held_wish.y() / kKeyFast, -1.0, 1.0) * kScopeTurn * dt_s;
      more.depth_m += std::clamp(held_wish.z() / kKeyFast, -1.0, 1.0) * kScopeDepth * dt_s;
    }
    const double post =
        pair(Action::kPostRight, Action::kPostLeft) + (pad_on(kPadUp) ? 1 : 0) - (pad_on(kPadDown) ? 1 : 0);
    more.post_rad = post * kPostTurn * dt_s;
    scope.turn(more);
    scope.advance(dt_s);
  }

  void hold_clutch() {
    const bool clutch = on(Action::kClutch) || pad_on(kPadB);
    if (clutch && !intent.clutch) clutched_at_T = intent.X_TI.p;
    if (!clutch && intent.clutch) intent.X_TI.p = wanted_T = clutched_at_T, ground = 0;  // it stood still meanwhile
    intent.clutch = clutch;
  }

  /// The jaws' own control.
  bool gripping() const { return on(Action::kGrip) || pad[5] > kTrigger; }

  void hold_switches(const AtHand& around) {
    intent.pedal = on(Action::kPedal) || (around.in_tissue && pad[4] > kTrigger);
    const bool down = std::exchange(exchange_pressed, false) || on(Action::kExchange) || pad_on(kPadRightThumb);
    refuses_exchange = down && !std::exchange(exchange_down, down) && around.in_use;
    exchange_refused = down && (exchange_refused || refuses_exchange);
    intent.exchange = down && !exchange_refused;
  }

  /// Where the act button closes the jaws their own key does so, too, and let go it opens them as ever.
  void move_jaws(const AtHand& around, double dt_s) {
    const bool by_key = on(Action::kGrip), opened = std::exchange(closed_by_key, by_key) && !by_key;
    if (around.jaws_apart)
      jaw.work({.close = gripping(),
                .shut = acting || !act_way_T.isZero(),
                .gripping = around.gripping,
                .fingers_m = around.now.jaw_opening_m},
               dt_s);
    else
      jaw.advance({.used = around.jaws,
                   .close = acting || by_key,
                   .let_go = let_go,
                   .open = let_off || opened,
                   .gripping = around.gripping,
                   .fingers_m = around.now.jaw_opening_m,
                   .grip_n = around.grip_n},
                  dt_s);
    intent.jaw_opening_m = jaw.opening_m();
  }

  void advance(double dt_s, const Camera& camera, double height_px, const AtHand& around) {
    const double dt = std::clamp(dt_s, 0.0, kLongestStep);
    const View view = view_of(camera, intent.X_TI.p, height_px);
    Wish now = wish(dt, view, height_px);
    hold_clutch();
    hold_switches(around);
    act(!around.in_tissue, dt);
    move_tip(now, view, camera, around, dt);
    if (around.scope) now.lean = -now.lean;  // the shaft's far end goes the other way
    turn_wrist(now, view, dt);
    move_scope(dt, height_px);
    move_jaws(around, dt);
    for (auto& [action, since] : held) since += dt;
    moved_px = dragged_px = scoped_px = Eigen::Vector2d::Zero();
    wheel_m = roll_wheel = scope_wheel = 0;
  }
};

Steering::Steering(const KeyMap& keys, const SteeringOptions& options) : state_(std::make_unique<State>()) {
  retune(keys, options);
}
Steering::~Steering() = default;

void Steering::retune(const KeyMap& keys, const SteeringOptions& options) {
  state_->release_all();
  state_->keys = keys;
  state_->options = options;
  state_->options.sensitivity = std::clamp(options.sensitivity, 0.25, 4.0);
}

void Steering::begin(const Pose& X_TI, double jaw_opening_m, const Vec3& centre_T, const SteeringReach& reach) {
  State fresh;
  fresh.keys = state_->keys;
  fresh.options = state_->options;
  fresh.kind = state_->kind;
  fresh.X_TI_begin = fresh.intent.X_TI = X_TI;
  fresh.wanted_T = fresh.clutched_at_T = X_TI.p;
  fresh.centre_T = centre_T;
  fresh.reach = reach;
  fresh.reach.radius_m = std::max(reach.radius_m, (X_TI.p - centre_T).norm());  // where it begins it may be
  fresh.jaw.begin(jaw_opening_m);
  fresh.intent.jaw_opening_m = fresh.jaw.opening_m();
  *state_ = fresh;
}

bool Steering::handle(const InputEvent& event) { return state_->handle(event); }

const HandIntent& Steering::advance(double dt_s, const Camera& camera, double height_px, const AtHand& around) {
  state_->advance(dt_s, camera, height_px, around);
  return state_->intent;
}

const HandIntent& Steering::intent() const { return state_->intent; }
bool Steering::refuses_exchange() const { return state_->refuses_exchange; }
InputKind Steering::kind() const { return state_->kind; }
std::optional<Vec3> Steering::foot_T() const {
  return state_->ground > 0 ? std::optional(state_->foot_T) : std::nullopt;
}
ScopeMove Steering::scope() const { return state_->scope.move(); }
void Steering::stop_scope_at(double depth_m) { state_->scope.stop_at(depth_m); }

}  // namespace trocar
