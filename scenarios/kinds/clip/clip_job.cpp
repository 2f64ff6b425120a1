#include "scenarios/kinds/clip/clip_job.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kClipOpenJaw = 0.012;                // m: the structure lies freely between the pads
constexpr double kNameJaw = 0.007;                    // m, to name it: a neighbour stays outside
constexpr double kClearOf = 0.75;                     // of that, seen: nothing is held any more
constexpr double kStaysFor = 4;                       // s, before speed_factor, of naming in vain
constexpr double kClipJawSpeed = 0.030;               // m/s of free opening and closing
constexpr double kClipShutJaw = -0.016;               // m of intent: the fingers press beyond what they hold
constexpr double kShutFor = 0.15;                     // s
constexpr double kTugTime = 0.8;                      // s of a pull, before speed_factor ...
constexpr double kTugFor = 0.2;                       // ... and of staying at its end
constexpr double kPulledStiffness = 70;               // N/m of a structure, as a person expects it
constexpr double kLongestTug = 0.050;                 // m
constexpr double kOver = 0.020;                       // m over the goal at which the reach ends
constexpr double kClipLate = 0.16, kClipLook = 0.05;  // s: the eyes are that late; looking, before speed_factor
constexpr double kQuickestClipReach = 0.15;           // s
constexpr double kTurnNominal = 30 * std::numbers::pi / 180, kTurnFloor = 0.15;  // of the aim error of turns
constexpr int kTriesInside = 2;  // closings that failed, before drawing back to begin afresh

}  // namespace

void ClipJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
  planned_ = false;
  moves_on_ = moves_on_ && step != Step::kWithdraw;
}

/// What is closing, or being tried, is done with first.
void ClipJob::begin(const Percept&, const HandIntent&, HandRandom&) {
  corrections_ = tries_ = 0;
  moves_on_ = step_ == Step::kClose || step_ == Step::kTug;
  if (!moves_on_) enter(Step::kWithdraw);
}

/// Until they close.
double ClipJob::free_jaw(const Percept& percept) {
  return percept.asked_instrument == InstrumentKind::kGrasper ? kNameJaw : kClipOpenJaw;
}

/// From the seen tip to the goal, or so far over it.
Vec3 ClipJob::way_to(const Percept& percept, double over_m) {
  return percept.goal_T + over_m * percept.target_normal_T - percept.tip_T;
}

bool ClipJob::off_place(const Percept& percept, const Vec3& way) const {
  return way.norm() > skill_.settle_share * percept.target_radius_m;
}

void ClipJob::set_jaws(const Percept& percept, double dt_s, HandIntent& intent) {
  const double way = free_jaw(percept) - intent.jaw_opening_m;
  intent.jaw_opening_m += std::clamp(way, -kClipJawSpeed * dt_s, kClipJawSpeed * dt_s);
}

/// Opens the jaws where they are, then out along the shaft.
void ClipJob::leave(const Percept& percept, double dt_s, HandIntent& intent) {
  set_jaws(percept, dt_s, intent);
  if (!planned_) {
    if (percept.jaw_opening_m < kClearOf * free_jaw(percept)) return;
    const double out = std::max(0.0, percept.target_normal_T.dot(way_to(percept, kOver)));
    plan_ = ReachPlan(intent.X_TI.p, intent.X_TI.p + out * percept.target_normal_T,
                      {0, Vec3::Zero(), 0, reach_time_s(out, kOver, skill_.speed_factor)});
    planned_ = true;
    in_step_s_ = 0;
  }
  intent.X_TI.p = plan_.at(in_step_s_);
  if (in_step_s_ > plan_.duration_s()) enter(Step::kExchange);
}

void ClipJob::exchange(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random) {
  if (switch_.press(percept, dt_s, intent)) go(Step::kReach, percept, kOver, intent, random);
}

/// Plans a movement of the intent such that the seen tip would come to the goal, or over it, turned as it shall be.
void ClipJob::go(Step step, const Percept& percept, double over_m, const HandIntent& intent, HandRandom& random) {
  const Vec3 way = way_to(percept, over_m);
  plan_ = aimed_reach(intent.X_TI.p, way, percept.target_radius_m, kQuickestClipReach, skill_, random);
  const Mat3 R_missing = percept.target_R_TI * percept.R_TI.transpose();
  const double angle = Eigen::AngleAxisd(R_missing).angle();
  const double noise = skill_.aim_angle_rad * std::sqrt(std::min(1.0, angle / kTurnNominal) + kTurnFloor);
  const Vec3 error = noise * Vec3(random.normal(), random.normal(), random.normal());
  const double time = reach_time_s(angle, 2 * percept.target_angle_rad, skill_.speed_factor);
  turn_ = TurnPlan(intent.X_TI.R, rotation_by(error) * R_missing * intent.X_TI.R, std::max(time, plan_.duration_s()));
  enter(step);
}

void ClipJob::look(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (in_step_s_ < kClipLate + kClipLook * skill_.speed_factor) return;
  const bool over = step_ == Step::kLook;
  const bool again = off_place(percept, way_to(percept, over ? kOver : 0)) && corrections_ < skill_.max_corrections;
  if (again) ++corrections_;
  if (again && over) return go(Step::kReach, percept, kOver, intent, random);
  if (again) return go(Step::kAdvance, percept, 0, intent, random);
  corrections_ = 0;
  if (over) return go(Step::kAdvance, percept, 0, intent, random);
  enter(percept.asked_instrument == InstrumentKind::kGrasper ? Step::kStay : Step::kClose);
}

void ClipJob::close(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random) {
  intent.jaw_opening_m = std::max(kClipShutJaw, intent.jaw_opening_m - kClipJawSpeed / skill_.speed_factor * dt_s);
  if (intent.jaw_opening_m > kClipShutJaw) in_step_s_ = 0;
  if (in_step_s_ <= kShutFor) return;
  if (percept.asked_instrument != InstrumentKind::kClipApplier) return enter(Step::kOpen);
  const double goal_n = (percept.band_low_n + percept.band_high_n) / 2 * skill_.force_bias;
  pull_n_ = goal_n * (1 + skill_.force_cv * random.normal());
  const double way = std::clamp(pull_n_ / kPulledStiffness, 0.0, kLongestTug);
  plan_ = ReachPlan(intent.X_TI.p, intent.X_TI.p + way * percept.target_normal_T,
                    {0, Vec3::Zero(), 0, kTugTime * skill_.speed_factor});
  enter(Step::kTug);
}

/// As far as planned, or until it is felt that the structure is stiffer than expected.
void ClipJob::tug(const HandSenses& senses, HandIntent& intent) {
  if (-senses.touch_n() > pull_n_ && in_step_s_ < plan_.duration_s())
    in_step_s_ = plan_.duration_s();
  else if (in_step_s_ < plan_.duration_s())
    intent.X_TI.p = plan_.at(in_step_s_);
  if (in_step_s_ > plan_.duration_s() + kTugFor) enter(Step::kOpen);
}

/// Until the next step is noticed: then this job begins anew.
void ClipJob::open(const Percept& percept, double dt_s, HandIntent& intent) {
  set_jaws(percept, dt_s, intent);
  if (percept.jaw_opening_m < kClearOf * free_jaw(percept)) in_step_s_ = 0;
  if (moves_on_) return enter(Step::kWithdraw);
  if (in_step_s_ < kClipLate + 2 * skill_.reaction_s + skill_.pause_s) return;
  enter(++tries_ % kTriesInside == 0 ? Step::kWithdraw : Step::kCheck);
}

void ClipJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                     HandRandom& random) {
  in_step_s_ += dt_s;
  switch (step_) {
    case Step::kWithdraw:
      return leave(percept, dt_s, intent);
    case Step::kExchange:
      return exchange(percept, dt_s, intent, random);
    case Step::kReach:
    case Step::kAdvance:
      set_jaws(percept, dt_s, intent);
      intent.X_TI = {turn_.at(in_step_s_), plan_.at(in_step_s_)};
      if (in_step_s_ > std::max(plan_.duration_s(), turn_.duration_s()))
        enter(step_ == Step::kReach ? Step::kLook : Step::kCheck);
      return;
    case Step::kLook:
    case Step::kCheck:
      return look(percept, intent, random);
    case Step::kStay:
      if (in_step_s_ > kStaysFor * skill_.speed_factor) enter(Step::kWithdraw);
      return;
    case Step::kClose:
      return close(percept, dt_s, intent, random);
    case Step::kTug:
      return tug(senses, intent);
    case Step::kOpen:
      return open(percept, dt_s, intent);
  }
}

}  // namespace trocar
