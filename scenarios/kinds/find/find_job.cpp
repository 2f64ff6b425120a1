#include "scenarios/kinds/find/find_job.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kSwingTime = 1.2;         // s of an unhurried swing of the flap, either way
constexpr double kFlapEnoughShown = 0.98;  // of the angle, that the person wants to see ...
constexpr double kFlapFurther = 0.006;     // m/s up until then
constexpr double kTighten = 0.020;         // m/s on while the flap hangs slack ...
constexpr double kTautFrom = 0.5;          // ... that is, below so much of the pull aimed at
constexpr double kFlapLowering = 0.012;    // m/s down from the end of the swing ...
constexpr double kFlapDown = 0.10;         // ... until so much of the angle is left
constexpr double kAnswerQuickest = 0.05;   // s
constexpr double kAnswerLook = 0.30;       // s: arm and eyes come to rest, then the tip is looked at
constexpr double kAnswerGood = 0.5;        // of the ball's radius that needs no correction

}  // namespace

void FindJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  telling_ = false;
  symbol_ = -1;
  thought_s_ = 0;
  RetractJob::begin(percept, intent, random);
}

void FindJob::begin_lift(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  taut_ = false;
  way_ = aimed_reach(intent.X_TI.p, percept.goal_T - percept.tip_T, percept.target_radius_m,
                     kSwingTime * skill().speed_factor, skill(), random);
}

void FindJob::lift(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                   HandRandom& random) {
  if (step() == Step::kLower) {
    if (in_step_s() <= way_.duration_s()) {
      intent.X_TI.p = way_.at(in_step_s());
    } else {
      intent.X_TI.p.z() -= kFlapLowering / skill().speed_factor * dt_s;
      if (percept.shown_share < kFlapDown) enter(Step::kOpen);
    }
    return;
  }
  if (percept.shown_symbol >= 0) symbol_ = percept.shown_symbol;
  if (in_step_s() <= way_.duration_s()) {
    intent.X_TI.p = way_.at(in_step_s());
  } else {
    taut_ = taut_ || senses.force_n() > kTautFrom * pull().goal_n();
    const double speed = taut_ ? pull().speed(senses.force_n(), dt_s, random) : kTighten / skill().speed_factor;
    intent.X_TI.p += speed * dt_s * percept.target_normal_T;
    if (percept.shown_share < kFlapEnoughShown) intent.X_TI.p.z() += kFlapFurther / skill().speed_factor * dt_s;
  }
  if (percept.cue != Cue::kLower || in_step_s() < skill().reaction_s) return;
  way_ = aimed_reach(intent.X_TI.p, percept.target_T - percept.tip_T, percept.target_radius_m,
                     kSwingTime * skill().speed_factor, skill(), random);
  enter(Step::kLower);
}

void FindJob::reach_answer(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  const Vec3& answer = percept.answers_T[static_cast<std::size_t>(symbol_)];
  way_ = aimed_reach(intent.X_TI.p, answer - percept.tip_T, percept.target_radius_m, kAnswerQuickest, skill(), random);
  telling_s_ = 0;
}

void FindJob::tell(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random) {
  telling_s_ += dt_s;
  intent.X_TI.p = way_.at(telling_s_);
  if (telling_s_ < way_.duration_s() + kAnswerLook) return;
  const Vec3 off = percept.answers_T[static_cast<std::size_t>(symbol_)] - percept.tip_T;
  if (off.norm() > kAnswerGood * percept.target_radius_m) reach_answer(percept, intent, random);
}

void FindJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                     HandRandom& random) {
  if (telling_) return tell(percept, dt_s, intent, random);
  RetractJob::update(percept, senses, dt_s, intent, random);
  if (percept.cue != Cue::kRead || !withdrawn()) return;
  thought_s_ += dt_s;
  if (thought_s_ < skill().reaction_s + skill().pause_s) return;
  if (symbol_ < 0) symbol_ = static_cast<int>(random.uniform() * kMostAnswers);
  telling_ = true;
  reach_answer(percept, intent, random);
}

}  // namespace trocar
