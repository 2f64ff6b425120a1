#include "app/window/input/steering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/window/input/jaw_fingers.h"
#include "app/window/input/stick_curve.h"

namespace trocar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTipSpeed = 0.25;    // m/s, of the target
constexpr double kMostAhead = 0.040;  // m that a flick of the mouse may be ahead of the target
constexpr double kKeySlow = 0.008, kKeyFast = 0.080, kKeyRamp = 1.2;     // m/s when pressed, after s of holding
constexpr double kStickSpeed = 0.10;                                     // m/s at full deflection
constexpr double kFine = 0.25;                                           // of all that keys and sticks do, with Shift
constexpr double kWheel = 0.005, kWheelFine = 0.001;                     // m a notch
constexpr double kLeanSpeed = 90 * kDegree, kRollSpeed = 270 * kDegree;  // rad/s, of the target
constexpr double kKeyTurn = 45 * kDegree, kKeyRoll = 90 * kDegree;       // rad/s
constexpr double kDragTurn = 120 * kDegree, kDragRoll = 360 * kDegree;   // over the picture's height
constexpr double kScopeDrag = 60 * kDegree;                              // likewise
constexpr double kScopeTurn = 25 * kDegree, kScopeDepth = 0.03, kPostTurn = 60 * kDegree;  // rad/s, m/s, rad/s
constexpr double kCircle = 0.64;  // radius of the scope's picture, of its height (scope_optics.h)
constexpr double kLeap_px = 200;  // between two events: the pointer was elsewhere meanwhile (a panel, another window)
constexpr double kLongestStep = 0.1;  // s: after a standstill of the window nothing leaps

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

Mat3 swing(const Vec3& from, const Vec3& to) { return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix(); }

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
  ScopeHand scope = {};
  InputKind kind = InputKind::kMouse;
  // held
  std::map<Action, double> held = {};  ///< and for how long, s
  bool shift_key = false, control_key = false, shift = false, control = false;
  bool left = false, right = false, middle = false, alt = false, pointer_known = false;
  double x = 0, y = 0;  ///< px
  std::array<double, 6> pad{}, space_mouse{};
  std::uint32_t pad_buttons = 0, space_mouse_buttons = 0;
  // since the last step
  Eigen::Vector2d moved_px = Eigen::Vector2d::Zero(), dragged_px = Eigen::Vector2d::Zero(),
                  scoped_px = Eigen::Vector2d::Zero();
  bool yaw_drag = false;
  double wheel_m = 0, scope_wheel = 0;

  bool on(Action action) const { return held.contains(action); }
  bool pad_on(std::uint32_t button) const { return (pad_buttons & button) != 0; }
  double pair(Action plus, Action minus) const { return (on(plus) ? 1 : 0) - (on(minus) ? 1 : 0); }
  bool scoping() const { return on(Action::kScope) || alt || pad_on(kPadX); }
  double side() const { return options.left_handed ? -1 : 1; }

  void release_all() {
    held.clear();
    shift_key = control_key = shift = control = left = right = middle = alt = pointer_known = false;
    pad = space_mouse = {};
    pad_buttons = space_mouse_buttons = 0;
    moved_px = dragged_px = scoped_px = Eigen::Vector2d::Zero();
    wheel_m = scope_wheel = 0;
  }

  /// As the event says, or as the keys themselves were seen.
  void modifiers(const InputEvent& event) {
    const bool down = event.kind == InputEvent::Kind::kKeyDown;
    if (event.key == kKeyShift) shift_key = down;
    if (event.key == kKeyControl) control_key = down;
    shift = shift_key || (event.shift && event.key != kKeyShift);
    control = control_key || (event.control && event.key != kKeyControl);
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
    if (*action == Action::kLatch) jaw.toggle_latch();
    if (*action == Action::kLevel) scope.level();
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
      yaw_drag = control;
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
    } else {
      wheel_m += event.wheel * (shift ? kWheelFine : kWheel);
      kind = InputKind::kMouse;
    }
  }

  void sticks(const InputEvent& event, std::array<double, 6>& axes, std::uint32_t& buttons, InputKind own) {
    const std::uint32_t pressed = event.buttons & ~buttons;
    axes = event.axis;
    buttons = event.buttons;
    if (own == InputKind::kPad && (pressed & kPadA)) jaw.toggle_latch();
    if (own == InputKind::kSpaceMouse && (pressed & 2u)) jaw.toggle_latch();
    for (const double axis : axes)
      if (shaped_axis(axis) != 0) kind = own;
  }

  bool handle(const InputEvent& event) {
    using Kind = InputEvent::Kind;
    if (event.kind == Kind::kFocusLost) {
      jaw.hold();
      release_all();
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
    out.lean = fine * kKeyTurn * dt_s * (hand + by_key) +
               kDragTurn * Eigen::Vector2d(yaw_drag ? side() * drag.x() : 0, drag.y());
    out.roll = fine * kKeyRoll * dt_s *
                   (pair(Action::kRollRight, Action::kRollLeft) + side() * (cross + shaped_axis(-space_mouse[4]))) +
               (yaw_drag ? 0 : side() * kDragRoll * drag.x());
    return out;
  }

  void move_tip(const Wish& wish, const View& view, double dt_s) {
    const Vec3 next = wanted_T + view.right * wish.tip.x() + view.up * wish.tip.y() + view.away * wish.tip.z();
    wanted_T = intent.X_TI.p + no_longer(within_ball(next, centre_T, reach.radius_m) - intent.X_TI.p, kMostAhead);
    intent.X_TI.p = toward(intent.X_TI.p, wanted_T, kTipSpeed * dt_s);
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
    intent.X_TI.R = swing(far0, far) * X_TI_begin.R * Eigen::AngleAxisd(roll, Vec3::UnitZ()).toRotationMatrix();
  }

  void move_scope(double dt_s, double height_px) {
    const Eigen::Vector2d drag = kScopeDrag * scoped_px / std::max(1.0, height_px);
    ScopeMove more{0, drag.x(), drag.y(), scope_wheel * kWheel};
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
    if (!clutch && intent.clutch) intent.X_TI.p = wanted_T = clutched_at_T;  // the instrument stood still meanwhile
    intent.clutch = clutch;
  }

  void advance(double dt_s, const Camera& camera, double height_px) {
    const double dt = std::clamp(dt_s, 0.0, kLongestStep);
    const View view = view_of(camera, intent.X_TI.p, height_px);
    const Wish now = wish(dt, view, height_px);
    hold_clutch();
    move_tip(now, view, dt);
    turn_wrist(now, view, dt);
    move_scope(dt, height_px);
    const double trigger = std::clamp(std::max(pad[4], pad[5]), 0.0, 1.0);
    jaw.advance({left || on(Action::kClose) || (space_mouse_buttons & 1u) != 0, on(Action::kOpen), shift,
                 trigger > 0.05 ? trigger : 0.0},
                dt);
    intent.jaw_opening_m = jaw.opening_m();
    for (auto& [action, since] : held) since += dt;
    moved_px = dragged_px = scoped_px = Eigen::Vector2d::Zero();
    wheel_m = scope_wheel = 0;
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

const HandIntent& Steering::advance(double dt_s, const Camera& camera, double height_px) {
  state_->advance(dt_s, camera, height_px);
  return state_->intent;
}

const HandIntent& Steering::intent() const { return state_->intent; }
InputKind Steering::kind() const { return state_->kind; }
bool Steering::latched() const { return state_->jaw.latched(); }
ScopeMove Steering::scope() const { return state_->scope.move(); }

}  // namespace trocar
