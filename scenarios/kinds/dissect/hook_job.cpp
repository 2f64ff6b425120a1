#include "scenarios/kinds/dissect/hook_job.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

// The hook as a person knows it: foot towards -y of the instrument, so far beyond the tip's middle along the shaft.
constexpr double kFootBeyond = 0.00165, kFootUnder = 0.0025;  // m; under a strand's axis
constexpr double kOnFoot = 0.0036;                            // m along the foot at which a strand shall lie
constexpr double kAside = 0.0052;                             // m further to the side, while the hook goes down
constexpr double kHookOver = 0.015;                           // m over the place at which the reach ends
constexpr double kDrawnBack = 0.015;                          // m that the hook is drawn back before it crosses
constexpr double kLower = 0.0008;                             // m lower with each try that came up without the strand
constexpr int kHeights = 3;                                   // that it is tried at
constexpr double kPressIn = 0.0010;                           // m that the tip is set into the tissue over a vessel
constexpr double kHookLate = 0.16;                            // s: the eyes are that late
constexpr double kHookLook = 0.05;                            // s of looking, before speed_factor
constexpr double kQuickestHook = 0.12;                        // s
constexpr double kHookGood = 0.0040;                          // m off, before settle_share
constexpr double kComesAlong = 0.2;  // share of the lift that is shown, from which it is seen to come along
constexpr double kInVainFor = 4;     // s, before speed_factor, of current before the person begins anew
constexpr double kSinks = 0.003;     // m/s by which the tip is let down until so much is felt:
constexpr double kLies = 0.25;       // N, or so deep:
constexpr double kDeepest = 0.0010;  // m of the tip's middle under the place

}  // namespace

void HookJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
}

/// The tip's middle where a strand lies `out_m` along the foot, `over_m` over where it would just touch.
Vec3 HookJob::beside(const Percept& percept, double out_m, double over_m) const {
  const Vec3 foot = -percept.R_TI.col(1), tip_to_foot = kFootBeyond * percept.R_TI.col(2);
  return percept.target_T - out_m * foot - tip_to_foot +
         (over_m - kFootUnder - tries_ * kLower) * percept.target_normal_T;
}

Vec3 HookJob::over_T(const Percept& percept) const {
  if (percept.cue == Cue::kHook) return beside(percept, kOnFoot + kAside, kHookOver);
  return percept.target_T + kHookOver * percept.target_normal_T;
}

Vec3 HookJob::down_T(const Percept& percept) const {
  if (percept.cue == Cue::kHook) return beside(percept, kOnFoot + kAside, 0);
  return percept.target_T - kPressIn * percept.target_normal_T;
}

/// Plans a movement of the intent such that the seen tip would come there.
void HookJob::go(Step step, const Percept& percept, const Vec3& to_T, const HandIntent& intent, HandRandom& random) {
  plan_ = aimed_reach(intent.X_TI.p, to_T - percept.tip_T, percept.target_radius_m, kQuickestHook, skill_, random);
  enter(step);
}

void HookJob::rise(const Percept& percept, double way_m, const HandIntent& intent) {
  plan_ = ReachPlan(intent.X_TI.p, intent.X_TI.p + way_m * percept.target_normal_T,
                    {0, Vec3::Zero(), 0, reach_time_s(way_m, percept.target_radius_m, skill_.speed_factor)});
  enter(Step::kDrawBack);
}

/// First of all the foot leaves the pedal.
void HookJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  corrections_ = tries_ = 0;
  enough_ = std::clamp((1 + skill_.force_cv * random.normal()) / skill_.force_bias, 0.1, 1.2);
  rise(percept, kDrawnBack, intent);
}

void HookJob::look(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (in_step_s_ < kHookLate + kHookLook * skill_.speed_factor) return;
  const bool over = step_ == Step::kLook, under = step_ == Step::kUnder;
  const Vec3 to = over ? over_T(percept) : under ? beside(percept, kOnFoot, 0) : down_T(percept);
  const bool again =
      (to - percept.tip_T).norm() > skill_.settle_share * kHookGood && corrections_ < skill_.max_corrections;
  if (again) {
    ++corrections_;
    return go(over ? Step::kReach : under ? Step::kSlide : Step::kAdvance, percept, to, intent, random);
  }
  corrections_ = 0;
  if (over) return go(Step::kAdvance, percept, down_T(percept), intent, random);
  if (under) return lift(percept, intent, random);
  if (percept.cue == Cue::kHook) return go(Step::kSlide, percept, beside(percept, kOnFoot, 0), intent, random);
  enter(Step::kPress);
}

/// Straight up, as far as this person thinks is enough.
void HookJob::lift(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  const double way = (percept.goal_T - percept.tip_T).dot(percept.target_normal_T);
  go(Step::kLift, percept, percept.tip_T + std::min(1.0, enough_) * way * percept.target_normal_T, intent, random);
}

/// Is the strand seen to come along, and far enough?
void HookJob::weigh(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (in_step_s_ < kHookLate + kHookLook * skill_.speed_factor) return;
  if (percept.shown_share < kComesAlong) {
    tries_ = (tries_ + 1) % kHeights;
    corrections_ = 0;
    return rise(percept, kDrawnBack, intent);
  }
  if (percept.shown_share < std::min(1.0, enough_) && corrections_ < skill_.max_corrections) {
    ++corrections_;
    return lift(percept, intent, random);
  }
  enter(Step::kBurn);
}

void HookJob::burn(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent) {
  intent.pedal = true;
  const double depth = (percept.target_T - percept.tip_T).dot(percept.target_normal_T);
  if (step_ == Step::kPress && senses.touch_n() < kLies && depth < kDeepest)
    intent.X_TI.p -= kSinks / skill_.speed_factor * dt_s * percept.target_normal_T;
  if (in_step_s_ < kInVainFor * skill_.speed_factor) return;
  rise(percept, kDrawnBack, intent);
}

void HookJob::arrive(const Percept& percept, HandIntent& intent, HandRandom& random) {
  intent.X_TI.p = plan_.at(in_step_s_);
  if (in_step_s_ <= plan_.duration_s()) return;
  switch (step_) {
    case Step::kDrawBack:
      return go(Step::kReach, percept, over_T(percept), intent, random);
    case Step::kReach:
      return enter(Step::kLook);
    case Step::kAdvance:
      return enter(Step::kCheck);
    case Step::kSlide:
      return enter(Step::kUnder);
    default:
      return enter(Step::kWeigh);
  }
}

void HookJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                     HandRandom& random) {
  in_step_s_ += dt_s;
  intent.pedal = false;
  switch (step_) {
    case Step::kLook:
    case Step::kCheck:
    case Step::kUnder:
      return look(percept, intent, random);
    case Step::kWeigh:
      return weigh(percept, intent, random);
    case Step::kBurn:
    case Step::kPress:
      return burn(percept, senses, dt_s, intent);
    default:
      return arrive(percept, intent, random);
  }
}

}  // namespace trocar
