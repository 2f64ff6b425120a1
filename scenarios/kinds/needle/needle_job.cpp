#include "scenarios/kinds/needle/needle_job.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kOpenDriver = 0.008;                     // m: the wire lies freely between the pads
constexpr double kOpenSeen = 0.75;                        // of that: nothing is held any more
constexpr double kShutDriver = -0.010;                    // m of intent: the fingers press beyond the wire
constexpr double kDriverSpeed = 0.030;                    // m/s of opening and closing
constexpr double kNeedleShutFor = 0.15;                   // s
constexpr double kOverNeedle = 0.020;                     // m along the shaft at which the reach ends
constexpr double kOverDot = 0.0025;                       // m over the tissue, at which the needle is looked at
constexpr double kNeedleLate = 0.16, kNeedleLook = 0.05;  // s: the eyes are that late; looking, before speed_factor
constexpr double kQuickestNeedle = 0.15;                  // s of a reach
constexpr double kPressOn = 0.0035;  // m by which tissue gives way before the point goes in, as a person expects
// The point has gone in where it is seen lower over its dot than that, which goes down with the tissue (m): looked at
// for so long, told so late (s). Then it is pressed on for a moment (s, before speed_factor).
constexpr double kSeenIn = 0.0006, kLooksAtPoint = 0.12, kInLate = 0.33, kPressFor = 0.38;
constexpr double kNeedleClear = 0.010;                     // m to which the needle is lifted
constexpr double kShovedIn = 0.0007, kShovedOut = 0.0013;  // m
constexpr double kKeepGain = 2, kKeepRest = 0.0003;        // 1/s by which it is kept over the dot; m that are not seen
constexpr double kSteerGain = 2, kSteersFrom = 0.0015, kMostSteered = 0.004;  // 1/s; m, of settle_share; m
constexpr double kPressTime = 1.0;                                            // s, before speed_factor
constexpr double kRollSpeed = 45 * kDegree;                                   // rad/s, before speed_factor
constexpr double kMostHeldBack = 0.4;     // rad by which friction keeps the needle behind the fingers
constexpr double kQuickestRoll = 4;       // rad/s of a turn in the air
constexpr double kBeyond = 48 * kDegree;  // of the needle that shall stand out at the end
constexpr double kRollMore = 12 * kDegree, kMostMore = 30 * kDegree;  // while it does not; before it is given up
constexpr int kMostInVain = 2;                                        // drives with one grip
constexpr double kMostAsked = 100 * kDegree;                          // of a roll that brings the point over the dot
constexpr double kMostAhead = 45 * kDegree;                           // of what is seen to have been rolled
constexpr double kDrawRoll = 145 * kDegree;
constexpr double kDrawOut = 0.030;                             // m
constexpr double kTurnAim = 30 * kDegree, kTurnAtRest = 0.15;  // of the aim error of turns
constexpr double kNeedleStaysFor = 1.2;                        // s, before what came to nothing is tried again

Vec3 aside(const Vec3& v, const Vec3& axis) { return (v - v.dot(axis) * axis).normalized(); }

/// Of the needle's circle between the dots.
double half_angle(const Percept& percept) {
  const double half = (percept.goal_T - percept.target_T).norm() / 2;
  return std::asin(std::min(1.0, half / percept.object.size_m.y()));
}

/// Where to aim so that the hole comes to lie there, as a person expects: tissue is shoved along under a shaft that
/// leans.
Vec3 aim_T(const Percept& percept, const Vec3& dot_T, double shoved_m) {
  return dot_T - shoved_m * aside(percept.R_TI.col(2), percept.target_normal_T);
}

Vec3 point_N(const Percept& percept) { return {-percept.object.size_m.y(), 0, 0}; }

}  // namespace

void NeedleJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
}

void NeedleJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  wrist_.begin(percept.R_TI);
  cue_ = percept.cue;
  noticed_s_ = 0;
  start(percept, intent, random);
}

void NeedleJob::start(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  corrections_ = in_vain_ = 0;
  if (cue_ == Cue::kTakeNeedle) return enter(Step::kOpen);
  if (cue_ == Cue::kPull) return begin_roll(Step::kDraw, percept, kDrawRoll, intent, random);
  straight(Step::kLift, intent, kNeedleClear * Vec3::UnitZ());
}

void NeedleJob::straight(Step step, const HandIntent& intent, const Vec3& way) {
  plan_ = ReachPlan(intent.X_TI.p, intent.X_TI.p + way,
                    {0, Vec3::Zero(), 0, reach_time_s(way.norm(), kOverNeedle, skill_.speed_factor)});
  const Wrist::Held now = wrist_.held(intent.X_TI.R);
  turn_ = WristPlan(wrist_, now, now, plan_.duration_s());
  enter(step);
}

/// As it is seen to be missing, and as well as the person aims.
void NeedleJob::turn_to(const Percept& percept, const Mat3& R_goal, const HandIntent& intent, HandRandom& random) {
  const double angle = Eigen::AngleAxisd(Mat3(R_goal * percept.R_TI.transpose())).angle();
  const double noise = skill_.aim_angle_rad * std::sqrt(std::min(1.0, angle / kTurnAim) + kTurnAtRest);
  const Vec3 error = noise * Vec3(random.normal(), random.normal(), random.normal());
  const Wrist::Held seen = wrist_.held(percept.R_TI), now = wrist_.held(intent.X_TI.R, seen);
  Wrist::Held then = wrist_.held(rotation_by(error) * R_goal);
  const double way = then.roll_rad - seen.roll_rad;
  then.roll_rad += std::clamp(now.roll_rad - seen.roll_rad, -kMostHeldBack, kMostHeldBack);
  const double aimed = reach_time_s(angle, kTurnAim, skill_.speed_factor);
  const double rolled = std::abs(way) / kQuickestRoll * skill_.speed_factor;
  turn_ = WristPlan(wrist_, now, then, std::max({aimed, rolled, plan_.duration_s()}));
}

void NeedleJob::open(const Percept& percept, double dt_s, HandIntent& intent) {
  intent.jaw_opening_m = std::min(kOpenDriver, intent.jaw_opening_m + kDriverSpeed * dt_s);
  if (percept.jaw_opening_m < kOpenSeen * kOpenDriver) in_step_s_ = 0;
  if (in_step_s_ > kNeedleLate) straight(Step::kBack, intent, -kOverNeedle * percept.R_TI.col(2));
}

/// Plans a movement of the intent such that the seen tip would come to the goal, or so far before it.
void NeedleJob::go(Step step, const Percept& percept, double over_m, const HandIntent& intent, HandRandom& random) {
  const Vec3 way = percept.goal_T - over_m * percept.target_R_TI.col(2) - percept.tip_T;
  plan_ = aimed_reach(intent.X_TI.p, way, percept.target_radius_m, kQuickestNeedle, skill_, random);
  turn_to(percept, percept.target_R_TI, intent, random);
  enter(step);
}

void NeedleJob::look(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (in_step_s_ < kNeedleLate + kNeedleLook * skill_.speed_factor) return;
  const bool over = step_ == Step::kLook;
  const Vec3 way = percept.goal_T - (over ? kOverNeedle : 0) * percept.target_R_TI.col(2) - percept.tip_T;
  const bool again =
      way.norm() > skill_.settle_share * percept.target_radius_m && corrections_ < skill_.max_corrections;
  if (again) ++corrections_;
  if (again) return go(over ? Step::kReach : Step::kAdvance, percept, over ? kOverNeedle : 0, intent, random);
  corrections_ = 0;
  if (over) return go(Step::kAdvance, percept, 0, intent, random);
  enter(Step::kClose);
}

void NeedleJob::shut(double dt_s, HandIntent& intent) const {
  intent.jaw_opening_m = std::max(kShutDriver, intent.jaw_opening_m - kDriverSpeed / skill_.speed_factor * dt_s);
}

/// Until what comes next is noticed; if nothing does, there was nothing between the jaws.
void NeedleJob::close(double dt_s, HandIntent& intent) {
  shut(dt_s, intent);
  if (intent.jaw_opening_m > kShutDriver) in_step_s_ = 0;
  if (in_step_s_ > kNeedleShutFor + kNeedleStaysFor + skill_.reaction_s + skill_.pause_s) enter(Step::kOpen);
}

/// Plans a movement of the needle in the jaws: its point over the first dot, its circle turned to go through both.
void NeedleJob::bring(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  const Pose X_IN = Pose{percept.R_TI, percept.tip_T}.inverse() * percept.object.X_TO;
  const Mat3& R = percept.target_R_TI;
  const Vec3 shaft = R.col(2), up = aside(percept.target_normal_T, shaft), side = shaft.cross(up);
  const double angle = 1.5 * std::numbers::pi - half_angle(percept);
  const Vec3 wanted = std::cos(angle) * side + std::sin(angle) * up;
  const Vec3 point = aside(-(R * X_IN.R).col(0), shaft);
  const double roll = std::atan2(point.cross(wanted).dot(shaft), point.dot(wanted));
  if (std::abs(roll) > kMostAsked) return enter(Step::kOpen);  // held by the wrong end: no wrist turns that far
  const Mat3 R_goal = Eigen::AngleAxisd(roll, shaft).toRotationMatrix() * R;
  over_T_ = aim_T(percept, percept.target_T, kShovedIn) + kOverDot * percept.target_normal_T;
  const Vec3 goal = over_T_ - R_goal * (X_IN * point_N(percept));
  plan_ = aimed_reach(intent.X_TI.p, goal - percept.tip_T, percept.target_radius_m, kQuickestNeedle, skill_, random);
  turn_to(percept, R_goal, intent, random);
  rolled_rad_ = 0;
  by_rad_ = 2 * half_angle(percept) + kBeyond;
  enter(Step::kBring);
}

void NeedleJob::see(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (in_step_s_ < kNeedleLate + kNeedleLook * skill_.speed_factor) return;
  const bool off =
      (over_T_ - percept.object.X_TO * point_N(percept)).norm() > skill_.settle_share * percept.target_radius_m;
  if (off && corrections_ < skill_.max_corrections) {
    ++corrections_;
    return bring(percept, intent, random);
  }
  const double push = skill_.force_bias * (1 + skill_.force_cv * random.normal()) * kPressOn;
  const Vec3 way = -(kOverDot + push) * percept.target_normal_T;
  plan_ = ReachPlan(intent.X_TI.p, intent.X_TI.p + way, {0, Vec3::Zero(), 0, kPressTime * skill_.speed_factor});
  aside_ = Vec3::Zero();
  over_m_ = kOverDot;
  in_for_s_ = 0;
  enter(Step::kPress);
}

/// Presses it on until it is seen to have gone in, and keeps it over the dot, which goes along with the tissue, as far
/// as that is seen.
void NeedleJob::press(const Percept& percept, double dt_s, HandIntent& intent) {
  const Vec3 off = aim_T(percept, percept.target_T, kShovedIn) - percept.object.X_TO * point_N(percept);
  const Vec3& normal = percept.target_normal_T;
  const Vec3 beside = off - off.dot(normal) * normal;
  const double over = (percept.object.X_TO * point_N(percept) - percept.target_T).dot(normal);
  over_m_ += (over - over_m_) * std::min(1.0, dt_s / kLooksAtPoint);
  in_for_s_ = over_m_ < kSeenIn ? in_for_s_ + dt_s : 0;
  if (const double size = beside.norm(); size > kKeepRest)
    aside_ += beside * (kKeepGain / skill_.speed_factor * (1 - kKeepRest / size) * dt_s);
  intent.X_TI.p = plan_.at(in_step_s_) + aside_;
}

/// About where the needle's middle is taken to be.
void NeedleJob::begin_roll(Step step, const Percept& percept, double by_rad, const HandIntent& intent,
                           HandRandom& random) {
  const double noise = std::sqrt(kTurnAtRest) * skill_.aim_lateral_m;
  const Vec3 error = noise * Vec3(random.normal(), random.normal(), random.normal());
  from_ = intent.X_TI;
  hinge_T_ = percept.R_TI.col(0);
  aside_ = Vec3::Zero();
  middle_T_ = intent.X_TI.p + percept.object.X_TO.p - percept.tip_T + error;
  shaft_T_ = percept.R_TI.col(2);
  by_rad_ = by_rad;
  roll_s_ = std::abs(by_rad) / kRollSpeed * skill_.speed_factor;
  enter(step);
}

void NeedleJob::roll(const Percept& percept, HandIntent& intent) const {
  const Vec3 hinge = percept.R_TI.col(0);
  const double seen = std::atan2(hinge_T_.cross(hinge).dot(shaft_T_), hinge_T_.dot(hinge));
  // Fingers feel what holds the needle, and do not wind up against it.
  const double angle = std::clamp(-by_rad_ * minimum_jerk(in_step_s_ / roll_s_), seen - kMostAhead, seen + kMostAhead);
  const Mat3 R = Eigen::AngleAxisd(angle, shaft_T_).toRotationMatrix();
  intent.X_TI = {R * from_.R, middle_T_ + R * (from_.p - middle_T_)};
}

/// Keeps the circle, as it is seen, on the second dot: what tissue gives way is made up for.
void NeedleJob::steer(const Percept& percept, double dt_s, HandIntent& intent) {
  const Pose& X_TN = percept.object.X_TO;
  const Vec3 dot_N = X_TN.inverse() * aim_T(percept, percept.goal_T, kShovedOut),
             out_N = Vec3(dot_N.x(), dot_N.y(), 0).normalized();
  const Vec3 off_N = (dot_N - dot_N.z() * Vec3::UnitZ()).norm() * out_N - percept.object.size_m.y() * out_N +
                     dot_N.z() * Vec3::UnitZ();
  const double seen = skill_.settle_share * kSteersFrom;
  if (const double size = off_N.norm(); size > seen && in_step_s_ < roll_s_)
    aside_ += X_TN.R * off_N * (kSteerGain / skill_.speed_factor * (1 - seen / size) * dt_s);
  if (const double size = aside_.norm(); size > kMostSteered) aside_ *= kMostSteered / size;
  intent.X_TI.p += aside_;
}

/// It should have come out by now: a little further, or back and anew.
void NeedleJob::rolled(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (in_step_s_ < roll_s_ + kNeedleLate + skill_.reaction_s + skill_.pause_s) return;
  rolled_rad_ += by_rad_;
  const double asked = 2 * half_angle(percept) + kBeyond;
  if (rolled_rad_ < asked + kMostMore) return begin_roll(Step::kRoll, percept, kRollMore, intent, random);
  begin_roll(Step::kUnroll, percept, -rolled_rad_, intent, random);
}

/// @return whether the plan is at its end
bool NeedleJob::moves(HandIntent& intent) const {
  intent.X_TI = {turn_.at(in_step_s_), plan_.at(in_step_s_)};
  return in_step_s_ > std::max(plan_.duration_s(), turn_.duration_s());
}

void NeedleJob::update(const Percept& percept, const HandSenses&, double dt_s, HandIntent& intent, HandRandom& random) {
  in_step_s_ += dt_s;
  noticed_s_ = percept.cue == cue_ ? 0 : noticed_s_ + dt_s;
  if (noticed_s_ > skill_.reaction_s + skill_.pause_s) {
    noticed_s_ = 0;
    cue_ = percept.cue;
    return start(percept, intent, random);
  }
  if (step_ > Step::kClose) shut(dt_s, intent);
  switch (step_) {
    case Step::kOpen:
      return open(percept, dt_s, intent);
    case Step::kBack:
      if (moves(intent)) go(Step::kReach, percept, kOverNeedle, intent, random);
      return;
    case Step::kReach:
      if (moves(intent)) enter(Step::kLook);
      return;
    case Step::kAdvance:
      if (moves(intent)) enter(Step::kCheck);
      return;
    case Step::kLook:
    case Step::kCheck:
      return look(percept, intent, random);
    case Step::kClose:
      return close(dt_s, intent);
    case Step::kLift:
      if (moves(intent)) bring(percept, intent, random);
      return;
    case Step::kBring:
      if (moves(intent)) enter(Step::kSee);
      return;
    case Step::kSee:
      return see(percept, intent, random);
    case Step::kPress:
      press(percept, dt_s, intent);
      if (in_step_s_ > plan_.duration_s() || in_for_s_ > std::max(0.0, kPressFor * skill_.speed_factor - kInLate))
        begin_roll(Step::kRoll, percept, by_rad_, intent, random);
      return;
    case Step::kRoll:
      roll(percept, intent);
      steer(percept, dt_s, intent);
      return rolled(percept, intent, random);
    case Step::kUnroll:
      roll(percept, intent);
      if (in_step_s_ < roll_s_) return;
      if (++in_vain_ >= kMostInVain) return enter(Step::kOpen);  // it has turned in the jaws: taken anew
      return straight(Step::kLift, intent, kNeedleClear * percept.target_normal_T);
    case Step::kDraw:
      roll(percept, intent);
      if (in_step_s_ > roll_s_)
        straight(Step::kRaise, intent, kDrawOut * (percept.target_normal_T + Vec3::UnitZ()).normalized());
      return;
    case Step::kRaise:
      moves(intent);
  }
}

}  // namespace trocar
