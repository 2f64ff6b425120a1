#include "scenarios/kinds/retract/retract_job.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kTissueOpenJaw = 0.014;                // m: a fold of that much comes between the pads
constexpr double kTissueJawSpeed = 0.030;               // m/s of free opening and closing
constexpr double kTissueTightestJaw = -0.040;           // m of intent: the fingers press beyond what they hold
constexpr double kOverPlace = 0.015;                    // m over the place at which the reach ends
constexpr double kPressDepth = 0.006;                   // m that the jaws are pressed down before they close ...
constexpr double kDeeper = 0.0015;                      // ... and so much more with each try that failed
constexpr double kPressStop = 0.8;                      // N felt on the way down at which it is deep enough
constexpr double kTissueGripFelt = 0.25;                // N
constexpr double kTissueLate = 0.16;                    // s: the eyes are that late
constexpr double kGoodPlace = 0.6;                      // of the place's radius that needs no correction
constexpr double kFirmGrip = 0.15, kSqueezeAtMost = 2;  // of the grip wanted; s after which it is lifted anyhow
constexpr double kEnoughShown = 0.90;                   // share that the person wants to see ...
constexpr double kFurther = 0.004;        // m/s by which it is lifted further until then, while the pull allows
constexpr double kLostAfter = 0.3;        // s without felt grip before it counts as lost
constexpr double kDown = 0.05;            // share shown at which it lies
constexpr double kLoweringSpeed = 0.012;  // m/s
constexpr double kQuickestReach = 0.05;   // s

}  // namespace

RetractJob::RetractJob(const HandSkill& skill)
    : skill_(skill),
      pull_({90, 2.5, 0.02, skill.force_bias, skill.force_cv, 0.08}),
      grip_({200, 3, 0.02, skill.force_bias, skill.force_cv}) {}

void RetractJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
}

/// Plans a movement of the intent such that the seen tip would arrive over the place.
void RetractJob::reach(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  const Vec3 way = percept.target_T + kOverPlace * percept.target_normal_T - percept.tip_T;
  plan_ = aimed_reach(intent.X_TI.p, way, percept.target_radius_m, kQuickestReach, skill_, random);
  enter(Step::kReach);
}

void RetractJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  corrections_ = tries_ = 0;
  reach(percept, intent, random);
}

void RetractJob::approach(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                          HandRandom& random) {
  intent.jaw_opening_m = std::min(kTissueOpenJaw, intent.jaw_opening_m + kTissueJawSpeed * dt_s);
  if (step_ == Step::kReach) {
    intent.X_TI.p = plan_.at(in_step_s_);
    if (in_step_s_ > plan_.duration_s()) enter(Step::kLook);
    return;
  }
  if (step_ == Step::kLook) {
    if (in_step_s_ < kTissueLate) return;
    const Vec3 off = percept.target_T - percept.tip_T;
    const Vec3 aside = off - percept.target_normal_T * off.dot(percept.target_normal_T);
    if (aside.norm() > kGoodPlace * percept.target_radius_m && corrections_++ < skill_.max_corrections)
      return reach(percept, intent, random);
    depth_m_ = kPressDepth + tries_ * kDeeper + 0.5 * skill_.aim_depth_m * random.normal();
    return enter(Step::kDescend);
  }
  intent.X_TI.p -= percept.target_normal_T * (skill_.approach_speed_mps / skill_.speed_factor * dt_s);
  const double height = percept.target_normal_T.dot(percept.tip_T - percept.target_T);
  if (height < -depth_m_ || senses.touch_n() > kPressStop) enter(Step::kClose);
}

void RetractJob::squeeze(const HandSenses& senses, double dt_s, HandIntent& intent, HandRandom& random) {
  const double closing = grip_.speed(senses.grip_n(), dt_s, random);
  intent.jaw_opening_m = std::clamp(intent.jaw_opening_m - closing * dt_s, kTissueTightestJaw, kTissueOpenJaw);
}

void RetractJob::close(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                       HandRandom& random) {
  if (step_ == Step::kClose) {
    intent.jaw_opening_m -= kTissueJawSpeed / skill_.speed_factor * dt_s;
    const FoamLore& lore = percept.foam[0];
    if (senses.grip_n() > kTissueGripFelt) {
      grip_.begin(lore.low_n, lore.high_n, random);
      return enter(Step::kSqueeze);
    }
    if (intent.jaw_opening_m < -kTissueOpenJaw) give_up(percept, intent);  // closed on nothing
    return;
  }
  squeeze(senses, dt_s, intent, random);
  const bool firm = std::abs(senses.grip_n() - grip_.goal_n()) < kFirmGrip * grip_.goal_n();
  if (!firm && in_step_s_ < kSqueezeAtMost * skill_.speed_factor) return;
  pull_.begin(percept.band_low_n, percept.band_high_n, random);
  lost_s_ = 0;
  enter(Step::kLift);
  begin_lift(percept, intent, random);
}

void RetractJob::hold(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                      HandRandom& random) {
  squeeze(senses, dt_s, intent, random);
  const bool gone = senses.grip_n() < kTissueGripFelt / 2 || (step_ == Step::kLift && percept.cue == Cue::kTake);
  lost_s_ = gone ? lost_s_ + dt_s : 0;
  if (lost_s_ > kLostAfter + skill_.reaction_s) return give_up(percept, intent);
  lift(percept, senses, dt_s, intent, random);
}

/// Pulls as strongly as is wanted, and further while too little is to be seen; lets down when that is asked for.
void RetractJob::lift(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                      HandRandom& random) {
  if (step_ == Step::kLift) {
    double speed = pull_.speed(senses.force_n(), dt_s, random);
    const bool allowed = senses.force_n() < percept.band_high_n * skill_.force_bias;
    if (percept.shown_share < kEnoughShown && allowed) speed = std::max(speed, kFurther / skill_.speed_factor);
    intent.X_TI.p.z() += speed * dt_s;
    if (percept.cue == Cue::kLower && in_step_s_ > skill_.reaction_s) enter(Step::kLower);
    return;
  }
  intent.X_TI.p.z() -= kLoweringSpeed / skill_.speed_factor * dt_s;
  if (percept.shown_share < kDown) enter(Step::kOpen);
}

void RetractJob::give_up(const Percept& percept, const HandIntent& intent) {
  ++tries_;
  corrections_ = 0;
  const Vec3 to = intent.X_TI.p + kOverPlace * percept.target_normal_T;
  plan_ = ReachPlan(intent.X_TI.p, to,
                    {0, Vec3::Zero(), 0, reach_time_s(kOverPlace, percept.target_radius_m, skill_.speed_factor)});
  enter(Step::kRetreat);
}

void RetractJob::leave(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random) {
  intent.jaw_opening_m = std::min(kTissueOpenJaw, intent.jaw_opening_m + 2 * kTissueJawSpeed * dt_s);
  if (step_ == Step::kOpen) {
    if (percept.jaw_opening_m > 0.8 * kTissueOpenJaw) give_up(percept, intent);
    return;
  }
  if (intent.jaw_opening_m < 0.8 * kTissueOpenJaw) {
    in_step_s_ = 0;
    return;
  }
  intent.X_TI.p = plan_.at(in_step_s_);
  if (in_step_s_ > plan_.duration_s() && percept.cue == Cue::kTake) reach(percept, intent, random);
}

void RetractJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                        HandRandom& random) {
  in_step_s_ += dt_s;
  switch (step_) {
    case Step::kReach:
    case Step::kLook:
    case Step::kDescend:
      return approach(percept, senses, dt_s, intent, random);
    case Step::kClose:
    case Step::kSqueeze:
      return close(percept, senses, dt_s, intent, random);
    case Step::kLift:
    case Step::kLower:
      return hold(percept, senses, dt_s, intent, random);
    default:
      return leave(percept, dt_s, intent, random);
  }
}

}  // namespace trocar
