#include "scenarios/kinds/grasp/grasp_job.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kQuickest = 0.05;            // s that a movement takes at least
constexpr double kBlockOpenJaw = 0.022;       // m
constexpr double kBlockJawSpeed = 0.040;      // m/s of free opening
constexpr double kLettingGo = 0.15;           // m/s: the fingers relax
constexpr double kBlockClosingSpeed = 0.014;  // m/s until the block is felt
constexpr double kBlockTightestJaw = -0.030;  // m of intent: the fingers press beyond what they hold
constexpr double kBeyondMiddle = 0.003;       // m that the tips reach beyond the block's middle
constexpr double kHover = 0.032;              // m that the reach ends before the grip point, against the shaft ...
constexpr double kRaised = 0.25;              // ... and a little above its line: clear of the neighbours
constexpr double kOverRing = 0.034;           // m under the block while it is carried: 30 mm are asked for
constexpr double kSeenLate = 0.16;            // s: the eyes are that late
constexpr double kGoodAim = 0.0015;           // m off the grip point that needs no correction
constexpr double kGoodTurn = 0.10;            // rad between pads and block that need no correction
constexpr double kGoodRing = 0.4;             // of the ring's tolerance
constexpr double kLevel = 0.7;                // largest sine of a side's slope that can be taken between the pads
constexpr double kRoom = 0.004;               // m that open jaws are wider than what they take
constexpr double kHit = 0.50;                 // N met on the way down: the jaws stand on something
constexpr double kSlowFrom = 0.010;           // m under a block that is lowered from which the hand slows down ...
constexpr double kSlowest = 0.25;             // ... to this share of its speed
constexpr double kGuiding = 2.5;              // 1/s of what is seen to be off, on the way down, and with a block ...
constexpr double kGuided = 0.001;             // ... to this height over the ring, m
constexpr double kEasing = 0.020;             // m/s at which the hand takes its weight off what stands
constexpr double kCare = 0.5;  // of the time for the way down, more with each time that something was met
constexpr int kMostCare = 4;
constexpr int kTriesASide = 2;      // met by something on the way down that often, the other sides are tried
constexpr double kGripFelt = 0.12;  // N
constexpr double kBeside = 2, kSeenBeside = 0.7;  // of tolerance and height: seen to go down beside, it is lifted again
constexpr double kFlat = 0.995;                   // least cosine of a block that is seen to stand flat
constexpr double kSet = 0.15;          // N of the board on the block that tells that it stands, when it is ...
constexpr double kNearlyDown = 0.004;  // m over the ring as it is seen: before, it is the arm that is felt
constexpr double kFeelLow = 0.75, kFeelHigh = 0.95;  // N, a squeeze that no foam minds
constexpr double kFeelTime = 1.0, kFeelLook = 0.4;   // s of feeling; the last of it is what is judged by
constexpr double kJudgement = 0.5;                   // of the force CV: error of the judged stiffness
constexpr double kSeenAway = 0.015;                  // m from the pads: it is not between them
constexpr double kWound = 0.25, kGive = 0.3;  // rad about the shaft that the wrist stays behind: it is at its end
constexpr double kLongestLead = 0.025;        // m that the hand leads an instrument that does not follow
constexpr double kLostTime = 0.25;            // s without felt grip before the block counts as lost
constexpr double kTighter = 1.35;             // of the window when the block is seen to slip
constexpr double kHighest = 0.055;            // m over the board: no higher when withdrawing
constexpr double kSnagged = 1.5;              // N on the fingers that tell that the open jaws hang on something
constexpr double kPatience = 0.9;             // s to wait for the next block before trying the same again

/// Can the pads take the object across this axis of it? It lies level, and open jaws reach round it.
bool between_pads(const SeenObject& object, int axis) {
  return std::abs(object.X_TO.R(2, axis)) < kLevel && object.size_m[axis] < kBlockOpenJaw - kRoom;
}

}  // namespace

GraspJob::GraspJob(const HandSkill& skill) : skill_(skill), grip_({200, 3, 0.02, skill.force_bias, skill.force_cv}) {}

void GraspJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
}

/// Lowest point under the middle: the board turns a block flat about its middle when it is set down.
Vec3 GraspJob::base_of(const SeenObject& object) {
  return object.X_TO.p - Vec3(0, 0, object.X_TO.R.row(2).cwiseAbs().dot(object.size_m.transpose()) / 2);
}

/// Across the pads the block is as thick as its thinner level side.
double GraspJob::thickness(const Percept& percept) {
  double thinnest = kBlockOpenJaw;
  for (int axis = 0; axis < 3; ++axis) {
    if (between_pads(percept.object, axis)) thinnest = std::min(thinnest, percept.object.size_m[axis]);
  }
  return thinnest;
}

Vec3 GraspJob::grip_point(const Percept& percept) const {
  return percept.object.X_TO.p + kBeyondMiddle * percept.R_TI.col(2);
}

/// From a block to where the jaws may turn aside: back along the shaft, so that the pads pass by its sides.
Vec3 GraspJob::way_out(const Percept& percept) {
  return kHover * (kRaised * Vec3::UnitZ() - percept.R_TI.col(2)).normalized();
}

/// Roll about the shaft after which the pads, as they are seen, would face the nearest pair of the block's sides that
/// they can take; the other pair where the nearest was barred; 0 where they can take none.
double GraspJob::roll_off(const Percept& percept) const {
  constexpr double kNone = 10;  // rad, more than any roll
  double best = kNone, other = kNone;
  for (int axis = 0; axis < 3; ++axis) {
    if (!between_pads(percept.object, axis)) continue;
    const Vec3 side_I = percept.R_TI.transpose() * percept.object.X_TO.R.col(axis);
    const double roll = std::remainder(std::atan2(-side_I.x(), side_I.y()), M_PI);
    if (std::abs(roll) < std::abs(best)) {
      other = best;
      best = roll;
    } else {
      other = roll;
    }
  }
  const bool turn_aside = hits_ % (2 * kTriesASide) >= kTriesASide && other < kNone;
  if (best == kNone) return 0;
  return turn_aside ? other : best;
}

/// Roll of the intent after which the seen instrument would have rolled; no further than the wrist goes.
double GraspJob::turn_to(double roll, const Percept& percept, const HandIntent& intent) {
  const Mat3 behind = intent.X_TI.R.transpose() * percept.R_TI;
  const double twist = std::atan2(behind(1, 0) - behind(0, 1), behind(0, 0) + behind(1, 1));
  return std::abs(twist) > kWound ? twist + std::clamp(roll, -kGive, kGive) : roll;
}

void GraspJob::straight(const Vec3& from_T, const Vec3& to_T, double seconds) {
  plan_ = ReachPlan(from_T, to_T, {0, Vec3::Zero(), 0, std::max(kQuickest, seconds)});
}

/// Plans a movement of the intent such that the seen tip would arrive at the goal. Where the instrument is held back,
/// the intent leads it no further with each new plan.
void GraspJob::reach(const Percept& percept, const Vec3& goal_T, double width_m, double least_s,
                     const HandIntent& intent, HandRandom& random) {
  const Vec3 lead = intent.X_TI.p - percept.tip_T;
  const Vec3 slack = lead * std::max(0.0, 1 - kLongestLead / std::max(kLongestLead, lead.norm()));
  plan_ = aimed_reach(intent.X_TI.p, goal_T - percept.tip_T - slack, width_m, least_s, skill_, random);
}

void GraspJob::reach_block(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  turn_ = Eigen::AngleAxisd(turn_to(roll_off(percept), percept, intent), Vec3::UnitZ());
  const double turning = reach_time_s(std::abs(turn_.angle()), 2 * kGoodTurn, skill_.speed_factor);
  reach(percept, grip_point(percept) + way_out(percept), 2 * kGoodAim, std::max(kQuickest, turning), intent, random);
  R_from_ = intent.X_TI.R;
  enter(Step::kReach);
}

void GraspJob::reach_ring(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  const Vec3 wanted = percept.goal_T + Vec3(0, 0, kOverRing);
  reach(percept, percept.tip_T + (wanted - base_of(percept.object)), 2 * percept.target_radius_m, kQuickest, intent,
        random);
  enter(Step::kCarry);
}

void GraspJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  corrections_ = hits_ = 0;
  due_ = step_ == Step::kOpen || step_ == Step::kRetreat;  // first the jaws leave what stands between them
  if (!due_) reach_block(percept, intent, random);
}

/// On the way down the eyes keep the jaws over the block: what is seen to be off across the way is taken out.
void GraspJob::guide(const Percept& percept, double dt_s) {
  const Vec3 off = grip_point(percept) - percept.tip_T, way = way_out(percept).normalized();
  aside_ += kGuiding / skill_.speed_factor * dt_s * (off - way * off.dot(way));
}

void GraspJob::squeeze(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                       HandRandom& random) {
  const double closing = grip_.speed(senses.grip_n(), dt_s, random);
  intent.jaw_opening_m = std::clamp(intent.jaw_opening_m - closing * dt_s,
                                    std::min(kBlockTightestJaw, percept.jaw_opening_m), kBlockOpenJaw);
}

void GraspJob::judge_foam(const Percept& percept, HandRandom& random) {
  const double force = felt_sum_n_ / std::max(1, felt_count_), opening = opening_sum_m_ / std::max(1, felt_count_);
  const double felt = force / std::max(1e-4, thickness(percept) - opening);
  const double judged = felt * random.log_normal(kJudgement * skill_.force_cv);
  double best = 1e9;
  for (std::int32_t i = 0; i < percept.foam_count; ++i) {
    const FoamLore& foam = percept.foam[static_cast<std::size_t>(i)];
    const double off = std::abs(std::log(judged / foam.stiffness_n_per_m));
    if (off >= best) continue;
    best = off;
    low_n_ = foam.low_n;
    high_n_ = foam.high_n;
  }
}

void GraspJob::approach(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                        HandRandom& random) {
  intent.jaw_opening_m = std::min(kBlockOpenJaw, intent.jaw_opening_m + kBlockJawSpeed * dt_s);
  const bool there = in_step_s_ > plan_.duration_s();
  if (step_ == Step::kReach) intent.X_TI.p = plan_.at(in_step_s_);
  if (step_ == Step::kReach && there) return enter(Step::kLook);
  if (step_ == Step::kLook && in_step_s_ > kSeenLate) {
    const Vec3 error = grip_point(percept) + way_out(percept) - percept.tip_T;
    const Vec3 shaft = percept.R_TI.col(2);
    const bool askew = std::abs(roll_off(percept)) > kGoodTurn;
    if (((error - shaft * error.dot(shaft)).norm() > kGoodAim || askew) && corrections_++ < skill_.max_corrections)
      return reach_block(percept, intent, random);
    const Vec3 way = grip_point(percept) - percept.tip_T;
    const double care = 1 + kCare * std::min(hits_, kMostCare);
    straight(intent.X_TI.p, intent.X_TI.p + way, care * reach_time_s(way.norm(), 0.002, skill_.speed_factor));
    aside_.setZero();
    return enter(Step::kDescend);
  }
  if (step_ != Step::kDescend) return;
  guide(percept, dt_s);
  intent.X_TI.p = plan_.at(in_step_s_) + aside_;
  if (senses.touch_n() > kHit && in_step_s_ < plan_.duration_s()) {  // the jaws stand on something: look again
    corrections_ = 0;
    ++hits_;
    return reach_block(percept, intent, random);
  }
  if (there) enter(Step::kClose);
}

void GraspJob::take(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                    HandRandom& random) {
  const bool told = percept.band_high_n > 0;
  switch (step_) {
    case Step::kClose:
      intent.jaw_opening_m -= kBlockClosingSpeed / skill_.speed_factor * dt_s;
      if (senses.grip_n() > kGripFelt) {
        low_n_ = told ? percept.band_low_n : kFeelLow;
        high_n_ = told ? percept.band_high_n : kFeelHigh;
        grip_.begin(low_n_, high_n_, random);
        felt_sum_n_ = opening_sum_m_ = 0;
        felt_count_ = hits_ = 0;
        enter(told ? Step::kSqueeze : Step::kFeel);
      } else if (percept.jaw_opening_m < thickness(percept) / 3) {  // closed on nothing
        corrections_ = 0;
        ++hits_;
        reach_block(percept, intent, random);
      }
      return;
    case Step::kFeel:
      squeeze(percept, senses, dt_s, intent, random);
      if (in_step_s_ > (kFeelTime - kFeelLook) * std::sqrt(skill_.speed_factor)) {
        felt_sum_n_ += senses.grip_n();
        opening_sum_m_ += percept.jaw_opening_m;
        ++felt_count_;
      }
      if (in_step_s_ < kFeelTime * std::sqrt(skill_.speed_factor)) return;
      judge_foam(percept, random);
      grip_.begin(low_n_, high_n_, random);
      return enter(Step::kSqueeze);
    default:
      squeeze(percept, senses, dt_s, intent, random);
      if (std::abs(senses.grip_n() - grip_.goal_n()) > 0.12 * grip_.goal_n() && in_step_s_ < 2 * skill_.speed_factor)
        return;
      straight(intent.X_TI.p, intent.X_TI.p + Vec3(0, 0, kOverRing),
               reach_time_s(kOverRing, 0.010, skill_.speed_factor));
      lost_s_ = slip_s_ = 0;
      return enter(Step::kLift);
  }
}

/// While a block is carried: lost, slipping, or well held?
void GraspJob::watch_grip(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                          HandRandom& random) {
  squeeze(percept, senses, dt_s, intent, random);
  // Pads that close on nothing feel each other: eyes tell that.
  const bool away = (grip_point(percept) - percept.tip_T).norm() > kSeenAway;
  const bool held = senses.grip_n() > kGripFelt / 2 && !away;
  lost_s_ = held ? 0 : lost_s_ + dt_s;
  slip_s_ = percept.object.slipping ? slip_s_ + dt_s : 0;
  if (slip_s_ > skill_.reaction_s) {
    slip_s_ = 0;
    low_n_ *= kTighter;
    high_n_ *= kTighter;
    grip_.begin(low_n_, high_n_, random);
  }
  if (lost_s_ < kLostTime) return;
  corrections_ = 0;
  withdraw(percept, intent);
}

void GraspJob::bring(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                     HandRandom& random) {
  watch_grip(percept, senses, dt_s, intent, random);
  const bool there = in_step_s_ > plan_.duration_s();
  const double speed = skill_.approach_speed_mps / skill_.speed_factor;
  switch (step_) {
    case Step::kLift:
      intent.X_TI.p = plan_.at(in_step_s_);
      if (there) {
        corrections_ = 0;
        grip_.shift_attention(random);  // eyes and mind go to the ring
        reach_ring(percept, intent, random);
      }
      return;
    case Step::kCarry:
      intent.X_TI.p = plan_.at(in_step_s_);
      if (there) enter(Step::kLookAtRing);
      return;
    case Step::kLookAtRing:
      if (in_step_s_ < kSeenLate) return;
      if ((base_of(percept.object) - percept.goal_T).head<2>().norm() > kGoodRing * percept.target_radius_m &&
          corrections_++ < skill_.max_corrections)
        return reach_ring(percept, intent, random);
      grip_.shift_attention(random);
      return enter(Step::kLower);
    case Step::kLower: {
      const Vec3 off = percept.goal_T - base_of(percept.object);
      const double under = -off.z();
      if (off.head<2>().norm() > kBeside * percept.target_radius_m && under < kSeenBeside * kOverRing) {
        straight(intent.X_TI.p, intent.X_TI.p + Vec3(0, 0, kOverRing - under),
                 reach_time_s(kOverRing, 0.010, skill_.speed_factor));
        return enter(Step::kLift);
      }
      intent.X_TI.p.z() -= speed * std::clamp(under / kSlowFrom, kSlowest, 1.0) * dt_s;
      if (under > kGuided) intent.X_TI.p.head<2>() += kGuiding / skill_.speed_factor * dt_s * off.head<2>();
      const bool flat = percept.object.X_TO.R.row(2).cwiseAbs().maxCoeff() > kFlat && under < 0.0005;
      const bool stands = (under < kNearlyDown && senses.touch_n() > kSet * skill_.force_bias) || flat;
      if (stands && in_step_s_ > kSeenLate) enter(Step::kOpen);
      return;
    }
    default:
      return;
  }
}

void GraspJob::withdraw(const Percept& percept, const HandIntent& intent) {
  const Vec3 out = way_out(percept);
  const double room = percept.goal_T.z() + kHighest - percept.tip_T.z();  // what is left of the height
  const double share = std::clamp(room / std::max(1e-3, out.z()), 0.0, 1.0);
  straight(intent.X_TI.p, intent.X_TI.p + share * out, reach_time_s(kHover, 0.010, skill_.speed_factor));
  snagged_ = false;
  enter(Step::kRetreat);
}

void GraspJob::leave(const Percept& percept, double dt_s, HandIntent& intent, HandRandom& random) {
  intent.jaw_opening_m = std::min(kBlockOpenJaw, intent.jaw_opening_m + kLettingGo * dt_s);
  switch (step_) {
    case Step::kOpen:
      if (intent.X_TI.p.z() < percept.tip_T.z()) intent.X_TI.p.z() += kEasing * dt_s;
      if (percept.jaw_opening_m < std::min(thickness(percept) + 0.005, kBlockOpenJaw - 0.001)) return;
      return withdraw(percept, intent);
    case Step::kRetreat:
      if (!snagged_ && percept.felt_force_T.norm() > kSnagged) {  // straight up, as what stands between them stands
        snagged_ = true;
        const double up = std::max(0.0, percept.goal_T.z() + kHighest - percept.tip_T.z());
        straight(percept.tip_T, percept.tip_T + Vec3(0, 0, up), reach_time_s(up, 0.010, skill_.speed_factor));
        in_step_s_ = 0;
      }
      intent.X_TI.p = plan_.at(in_step_s_);
      if (in_step_s_ <= plan_.duration_s()) return;
      if (!due_) return enter(Step::kWait);
      due_ = false;
      return reach_block(percept, intent, random);
    default:
      if (in_step_s_ < kPatience) return;
      corrections_ = 0;
      return reach_block(percept, intent, random);
  }
}

void GraspJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                      HandRandom& random) {
  in_step_s_ += dt_s;
  switch (step_) {
    case Step::kReach:
    case Step::kLook:
    case Step::kDescend:
      approach(percept, senses, dt_s, intent, random);
      break;
    case Step::kClose:
    case Step::kFeel:
    case Step::kSqueeze:
      take(percept, senses, dt_s, intent, random);
      break;
    case Step::kLift:
    case Step::kCarry:
    case Step::kLookAtRing:
    case Step::kLower:
      bring(percept, senses, dt_s, intent, random);
      break;
    default:
      leave(percept, dt_s, intent, random);
  }
  const bool turning = step_ == Step::kReach && in_step_s_ < plan_.duration_s();
  const double turned = turning ? minimum_jerk(in_step_s_ / plan_.duration_s()) : 1;
  intent.X_TI.R = R_from_ * Eigen::AngleAxisd(turned * turn_.angle(), turn_.axis()).toRotationMatrix();
}

}  // namespace trocar
