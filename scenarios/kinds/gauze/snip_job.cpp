#include "scenarios/kinds/gauze/snip_job.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kBladesOpen = 0.007;                 // m
constexpr double kBladesReady = 0.8;                  // of that, seen
constexpr double kBladeSpeed = 0.045;                 // m/s of free opening and closing
constexpr double kBladesShut = -0.006;                // m of intent: the fingers press beyond
constexpr double kBladesShutFor = 0.10;               // s
constexpr double kSnipLate = 0.16, kSnipLook = 0.05;  // s: the eyes are that late; looking, before speed_factor
constexpr double kGoodEnough = 0.5;                   // of what is near enough: so near the place is followed
constexpr double kAsideGain = 3;                      // 1/s
constexpr double kLookFor = 0.4;                      // s a correction that the person would make, before speed_factor
constexpr double kOutSpeed = 0.080;                   // m/s, before speed_factor
constexpr double kOutOver = 0.001;                    // m over the gauze, where tips are out of the cut
constexpr double kLightest = 0.2;                     // of the force that is meant
constexpr double kQuickestSnipReach = 0.12;           // s
constexpr double kSnipDeepest = 0.040;                // m on from the hover, felt or not: then it closes all the same
constexpr double kSlowNear = 0.7;                     // of the approach speed, once something is felt
constexpr double kPressedIn = 0.001;  // m under the place, where the tips are seen to press on the gauze
constexpr double kGivesWay = 0.006;   // m, seen, that it gives way: it is not pressed further
constexpr double kFollowed = 0.015;   // m, seen, as far as closing blades follow it
constexpr double kFelt = 0.12;        // N
constexpr double kBladesRoll = 3;     // rad/s of a turn, before speed_factor
constexpr double kMostFollowed = 0.5, kMostLead = 0.4;  // rad at which the eyes lead; that fingers go ahead of a tool
constexpr double kSnipTurn = 30 * std::numbers::pi / 180, kSnipTurnFloor = 0.15;  // of the aim error of turns

}  // namespace

void SnipJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
}

/// From the seen tip to the place, or so far over it.
Vec3 SnipJob::way_over(const Percept& percept, double over_m) {
  return percept.target_T + over_m * percept.target_normal_T - percept.tip_T;
}

Vec3 SnipJob::aside_of(const Percept& percept) {
  const Vec3 way = way_over(percept, 0);
  return way - percept.target_normal_T * way.dot(percept.target_normal_T);
}

void SnipJob::set_blades(double to_m, double dt_s, HandIntent& intent) const {
  const double most = kBladeSpeed / skill_.speed_factor * dt_s;
  intent.jaw_opening_m += std::clamp(to_m - intent.jaw_opening_m, -most, most);
}

double SnipJob::missing_roll(const Percept& percept) const {
  return wrist_.held(percept.target_R_TI).roll_rad - wrist_.held(percept.R_TI).roll_rad;
}

/// Along the shaft that is asked for: a port leads it, whatever the fingers do. What friction holds back is made up for
/// by so much and no more, or it would build up.
Wrist::Held SnipJob::rolled(const Percept& percept, double roll_rad) const {
  const Wrist::Held wanted = wrist_.held(percept.target_R_TI);
  return {wanted.shaft_T, std::clamp(roll_rad, wanted.roll_rad - kMostLead, wanted.roll_rad + kMostLead)};
}

void SnipJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  wrist_.begin(percept.R_TI);
  reach(percept, intent, random);
}

/// Plans a movement such that the seen tip would come over the place, the blades along the line.
void SnipJob::reach(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  plan_ = aimed_reach(intent.X_TI.p, way_over(percept, skill_.hover_m), percept.target_radius_m, kQuickestSnipReach,
                      skill_, random);
  const double missing = missing_roll(percept), angle = std::abs(missing);
  const double noise = skill_.aim_angle_rad * std::sqrt(std::min(1.0, angle / kSnipTurn) + kSnipTurnFloor);
  const Wrist::Held now = wrist_.held(intent.X_TI.R);
  const Wrist::Held then = rolled(percept, now.roll_rad + missing + noise * random.normal());
  const double aimed = reach_time_s(angle, 2 * percept.target_angle_rad, skill_.speed_factor);
  const double time = std::max({aimed, angle / kBladesRoll * skill_.speed_factor, plan_.duration_s()});
  turn_ = WristPlan(wrist_, now, then, time);
  enter(Step::kReach);
}

/// Sideways and about, as the eyes tell, until the place is near enough for this person.
void SnipJob::follow(const Percept& percept, double dt_s, HandIntent& intent) const {
  const Vec3 aside = aside_of(percept);
  const double off = aside.norm(), good = kGoodEnough * skill_.settle_share * percept.target_radius_m;
  if (off > good) intent.X_TI.p += aside * (kAsideGain / skill_.speed_factor * (1 - good / off) * dt_s);
  const double missing = std::clamp(missing_roll(percept), -kMostFollowed, kMostFollowed);
  if (std::abs(missing) < kGoodEnough * skill_.settle_share * percept.target_angle_rad) return;
  const double roll = wrist_.held(intent.X_TI.R).roll_rad + kAsideGain / skill_.speed_factor * dt_s * missing;
  intent.X_TI.R = wrist_.holding(rolled(percept, roll));
}

void SnipJob::look(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random) {
  if (in_step_s_ > kSnipLate && skill_.max_corrections > 0) follow(percept, dt_s, intent);
  if (in_step_s_ < kSnipLate + kSnipLook * skill_.speed_factor || percept.jaw_opening_m < kBladesReady * kBladesOpen)
    return;
  const bool off = aside_of(percept).norm() > skill_.settle_share * percept.target_radius_m ||
                   std::abs(missing_roll(percept)) > skill_.settle_share * percept.target_angle_rad;
  if (off && in_step_s_ < kLookFor * skill_.max_corrections * skill_.speed_factor) return;
  const double wanted = (percept.band_low_n + percept.band_high_n) / 2 * skill_.force_bias;
  goal_n_ = wanted * std::max(kLightest, 1 + skill_.force_cv * random.normal());
  lay_T_ = percept.target_T;
  enter(Step::kPress);
}

/// Straight down, more slowly once the gauze is felt, until it is seen and felt to be pressed as is meant, or gives
/// way.
void SnipJob::press(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent) {
  const double speed = skill_.approach_speed_mps * (senses.touch_n() > kFelt ? kSlowNear : 1.0);
  intent.X_TI.p -= speed * dt_s * percept.target_normal_T;
  if (skill_.max_corrections > 0) follow(percept, dt_s, intent);
  const bool deep = in_step_s_ * skill_.approach_speed_mps > kSnipDeepest;
  const bool at_gauze =
      percept.target_normal_T.dot(way_over(percept, -kPressedIn)) >= 0;  // what is felt above is the arm
  const bool gives_way = percept.target_normal_T.dot(lay_T_ - percept.tip_T) > kGivesWay;
  if ((senses.force_n() >= goal_n_ && at_gauze) || gives_way || deep) enter(Step::kClose);
}

/// The blades close while the hand goes on pressing: gauze that hangs loose backs away from them.
void SnipJob::close(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent) {
  set_blades(kBladesShut, dt_s, intent);
  const bool far = percept.target_normal_T.dot(lay_T_ - percept.tip_T) > kFollowed;
  if (senses.force_n() < goal_n_ && !far && intent.jaw_opening_m > kBladesShut)
    intent.X_TI.p -= skill_.approach_speed_mps * dt_s * percept.target_normal_T;
  if (intent.jaw_opening_m > kBladesShut) in_step_s_ = 0;
  if (in_step_s_ > kBladesShutFor) enter(Step::kNext);
}

void SnipJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                     HandRandom& random) {
  in_step_s_ += dt_s;
  if (step_ < Step::kClose) set_blades(kBladesOpen, dt_s, intent);
  switch (step_) {
    case Step::kReach:
      intent.X_TI = {turn_.at(in_step_s_), plan_.at(in_step_s_)};
      if (in_step_s_ > turn_.duration_s()) enter(Step::kLook);
      return;
    case Step::kLook:
      return look(percept, dt_s, intent, random);
    case Step::kPress:
      return press(percept, senses, dt_s, intent);
    case Step::kClose:
      return close(percept, senses, dt_s, intent);
    case Step::kNext:  // out of the cut with closed blades; which place is the next is seen by then
      if (percept.target_normal_T.dot(way_over(percept, kOutOver)) > 0)
        intent.X_TI.p += kOutSpeed / skill_.speed_factor * dt_s * percept.target_normal_T;
      else if (in_step_s_ > kSnipLate + skill_.pause_s)
        reach(percept, intent, random);
      return;
  }
}

}  // namespace trocar
