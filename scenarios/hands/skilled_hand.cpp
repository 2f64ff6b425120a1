#include "scenarios/hands/skilled_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/hands/exchange_job.h"
#include "scenarios/hands/population.h"
#include "scenarios/kinds/clip/clip_job.h"
#include "scenarios/kinds/dissect/hook_job.h"
#include "scenarios/kinds/find/find_job.h"
#include "scenarios/kinds/gauze/snip_job.h"
#include "scenarios/kinds/grasp/grasp_job.h"
#include "scenarios/kinds/needle/needle_job.h"
#include "scenarios/kinds/palpate/palpate_job.h"
#include "scenarios/kinds/retract/retract_job.h"

namespace trocar {
namespace {

constexpr double kTremorHz = 9;
constexpr double kAimReference = 0.060;  // m of travel at which the aim error has its nominal size
constexpr double kAimFloor = 0.15;
constexpr double kTurnReference = 30 * std::numbers::pi / 180;  // of turn at which the aim error has its nominal size
constexpr double kNearEnough = 0.6;                             // of the start ball's radius
constexpr double kLift = 0.012;                                 // m of withdrawal before crossing
constexpr double kLookTime = 0.16;                              // s: the eyes are that late
constexpr double kPenSettling = 0.15;      // s more before judging a pose: arm and instrument come to rest first
constexpr double kTouchForce = 0.15;       // N that counts as feeling the tissue ...
constexpr double kHitForce = 0.35;         // ... and, while the arm is moved fast, as having hit it, so near to it
constexpr double kHitNear = 0.012;         // m: further off it is the arm's own weight that is felt
constexpr double kLongestDescent = 0.030;  // m below the hover point before looking again
constexpr double kForesight =
    0.08;                          // s: a force that rises is judged by what it will be when the eyes and fingers tell
constexpr double kInVain = 2;      // s in the band, as it feels, in which a hold of 1 s has not succeeded
constexpr double kSideGain = 1.2;  // 1/s, sideways correction while pressing
constexpr double kSideDeadBand = 0.0010;                  // m
constexpr double kAsideTime = 0.5;                        // s beside the target before lifting off to try again
constexpr double kOpenJaw = 0.020;                        // m, as taken from the jig and before squeezing
constexpr double kClosedJaw = 0.002;                      // m, while touching
constexpr double kJawSpeed = 0.030;                       // m/s of free opening and closing
constexpr double kOpenEnough = 0.004;                     // m short of open at which the fingers turn round
constexpr double kTightestJaw = -0.010;                   // m of intent: the fingers press beyond what they hold
constexpr double kClosingSpeed = 0.012;                   // m/s until the block is felt
constexpr double kDiscGripTouch = 0.12;                   // N
constexpr std::uint64_t kJobStride = 0x9e3779b97f4a7c15;  // keeps the streams of the jobs apart

}  // namespace

SkilledHand::SkilledHand(const HandSkill& skill, std::uint64_t seed)
    : seed_(seed),
      random_(seed),
      skill_(drawn_person(skill, random_)),
      senses_(skill_.reaction_s),
      press_({60, 3.5, 0.04, skill_.force_bias, skill_.force_cv, kForesight, kInVain}),
      squeeze_({200, 3, 0.02, skill_.force_bias, skill_.force_cv, 0, kInVain}),
      jaw_m_(kOpenJaw) {
  const auto bring = [this](HandJob::Kind kind, std::unique_ptr<HandWork> work) {
    works_[static_cast<std::size_t>(kind)] = std::move(work);
  };
  bring(HandJob::Kind::kBlock, std::make_unique<GraspJob>(skill_));
  bring(HandJob::Kind::kLift, std::make_unique<RetractJob>(skill_));
  bring(HandJob::Kind::kClips, std::make_unique<ClipJob>(skill_));
  bring(HandJob::Kind::kSewing, std::make_unique<NeedleJob>(skill_));
  bring(HandJob::Kind::kHooking, std::make_unique<HookJob>(skill_));
  bring(HandJob::Kind::kExchange, std::make_unique<ExchangeJob>(skill_));
  bring(HandJob::Kind::kSnips, std::make_unique<SnipJob>(skill_));
  bring(HandJob::Kind::kAnswer, std::make_unique<FindJob>(skill_));
  bring(HandJob::Kind::kSearch, std::make_unique<PalpateJob>(skill_));
  for (int axis = 0; axis < 3; ++axis) tremor_phase_[axis] = 2 * std::numbers::pi * random_.uniform();
}

Vec3 SkilledHand::tremor(double t_s) const {
  const double amplitude = skill_.tremor_m * std::sqrt(2.0 / 3.0);  // RMS over the three axes together is tremor_m
  const double angle = 2 * std::numbers::pi * kTremorHz * t_s;
  return amplitude * Vec3(std::sin(angle + tremor_phase_.x()), std::sin(angle + tremor_phase_.y()),
                          std::sin(angle + tremor_phase_.z()));
}

Vec3 SkilledHand::sideways_error(const Percept& percept) const {
  const Vec3 error = percept.target_T - percept.tip_T;
  return error - percept.target_normal_T * error.dot(percept.target_normal_T);
}

/// Seen height of the tip over the target's plane, m.
double SkilledHand::height_over(const Percept& percept) {
  return percept.target_normal_T.dot(percept.tip_T - percept.target_T);
}

/// Plans a movement of the intent such that the SEEN tip would arrive at the goal.
void SkilledHand::reach(const Percept& percept, const Vec3& goal_T, bool lift) {
  const Vec3 way = goal_T - percept.tip_T;
  const double distance = way.norm(), k = skill_.speed_factor;
  ReachPlan::Shape shape;
  shape.travel_time_s = std::max(0.05, reach_time_s(distance, 2 * percept.target_radius_m, k));
  if (lift) {
    shape.sunk_m = std::max(0.0, percept.tip_T.z() - intent_T_.z());  // the intent lies in the tissue
    shape.lift_m = kLift;
    shape.lift_time_s = reach_time_s(kLift, 2 * percept.target_radius_m, k);
  }
  const Vec3 across = Vec3::UnitZ().cross(way);
  if (across.norm() > 1e-6)
    shape.bulge = across.normalized() * (skill_.path_bulge * distance * (random_.uniform() < 0.5 ? -1 : 1));
  const double noise = std::sqrt(std::min(1.0, distance / kAimReference) + kAimFloor);
  const Vec3 n = percept.target_normal_T;
  const Vec3 side = n.unitOrthogonal();
  const Vec3 error = noise * (skill_.aim_lateral_m * (side * random_.normal() + n.cross(side) * random_.normal()) +
                              skill_.aim_depth_m * n * random_.normal());
  const Vec3 offset = lift ? Vec3::Zero() : Vec3(intent_T_ - percept.tip_T);  // how far the tip hangs behind
  plan_ = ReachPlan(intent_T_, goal_T + offset + error, shape);
  step_ = Step::kReach;
  in_step_s_ = 0;
}

/// Plans a turn of the intent such that the SEEN instrument would come to the pen's orientation; the longer of reach
/// and turn sets the pace of both.
void SkilledHand::turn(const Percept& percept) {
  const Mat3 R_missing = percept.target_R_TI * percept.R_TI.transpose();
  const double angle = Eigen::AngleAxisd(R_missing).angle();
  const double noise = skill_.aim_angle_rad * std::sqrt(std::min(1.0, angle / kTurnReference) + kAimFloor);
  const Vec3 error = noise * Vec3(random_.normal(), random_.normal(), random_.normal());
  const double time = reach_time_s(angle, 2 * percept.target_angle_rad, skill_.speed_factor);
  turn_ = TurnPlan(intent_R_, rotation_by(error) * R_missing * intent_R_, std::max(time, plan_.duration_s()));
}

void SkilledHand::reach_target(const Percept& percept, bool lift) {
  const double hover = task_.kind == HandJob::Kind::kDisc ? skill_.hover_m : 0;
  reach(percept, percept.target_T + percept.target_normal_T * hover, lift);
  if (task_.kind == HandJob::Kind::kPen && percept.target_oriented) turn(percept);
}

/// Every job, and every press in it, has luck of its own: what an earlier one took, or when it ended, does not reach
/// it. So an attempt that is shifted by some milliseconds stays the same attempt.
void SkilledHand::draw_anew(std::uint64_t part) { random_ = HandRandom(seed_ + kJobStride * (2 * jobs_ + part)); }

void SkilledHand::begin_task(const Percept& percept) {
  ++jobs_;
  if (step_ == Step::kPress && !senses_.knows_bar()) press_.succeeded();  // another disc is lit
  draw_anew(0);
  corrections_ = 0;
  in_step_s_ = 0;
  if (HandWork* own = work()) {
    job_intent_ = {{intent_R_, intent_T_}, jaw_m_};
    return own->begin(percept, job_intent_, random_);
  }
  switch (task_.kind) {
    case HandJob::Kind::kStart:
    case HandJob::Kind::kPen:
      return reach_target(percept, false);
    case HandJob::Kind::kDisc:
      return reach_target(percept, true);
    case HandJob::Kind::kGrip:
      squeeze_.begin(percept.band_low_n, percept.band_high_n, random_);
      opened_ = false;
      [[fallthrough]];
    case HandJob::Kind::kFinished:
      plan_ = ReachPlan(intent_T_, intent_T_ + Vec3(0, 0, 2 * kLift), {0, Vec3::Zero(), 0, 0.5 * skill_.speed_factor});
      step_ = task_.kind == HandJob::Kind::kGrip ? Step::kSqueeze : Step::kReach;
      return;
    case HandJob::Kind::kNothing:
    default:
      step_ = Step::kStill;
  }
}

void SkilledHand::start_pressing(const Percept& percept) {
  draw_anew(1);
  press_.begin(percept.band_low_n, percept.band_high_n, random_);
  aside_s_ = 0;
  in_step_s_ = 0;
  step_ = Step::kPress;
}

/// Felt the tissue before it was meant to: press when about on target, else withdraw and try again.
void SkilledHand::on_unexpected_touch(const Percept& percept) {
  if (task_.kind != HandJob::Kind::kDisc || height_over(percept) > kHitNear) return;
  if (sideways_error(percept).norm() <= percept.target_radius_m) return start_pressing(percept);
  reach_target(percept, true);
}

bool SkilledHand::off_target(const Percept& percept) const {
  if (task_.kind == HandJob::Kind::kDisc) return sideways_error(percept).norm() > percept.target_radius_m;
  const bool pen = task_.kind == HandJob::Kind::kPen && percept.target_oriented;
  const double share = pen ? skill_.settle_share : kNearEnough;
  const bool beside = (percept.target_T - percept.tip_T).norm() > share * percept.target_radius_m;
  if (!pen) return beside;
  const double angle = Eigen::AngleAxisd(Mat3(percept.R_TI.transpose() * percept.target_R_TI)).angle();
  return beside || angle > share * percept.target_angle_rad;
}

void SkilledHand::look(const Percept& percept) {
  const double settling = task_.kind == HandJob::Kind::kPen ? kPenSettling : 0;
  if (in_step_s_ < kLookTime + settling + 0.05 * skill_.speed_factor) return;
  const bool disc = task_.kind == HandJob::Kind::kDisc;
  if (off_target(percept) && (corrections_ < skill_.max_corrections || !disc)) {
    ++corrections_;
    return reach_target(percept, false);
  }
  in_step_s_ = 0;
  step_ = disc ? Step::kDescend : Step::kLook;
}

void SkilledHand::descend(const Percept& percept, double dt_s) {
  const double speed = skill_.approach_speed_mps / skill_.speed_factor;
  intent_T_ -= percept.target_normal_T * speed * dt_s;
  if (senses_.touch_n() > kTouchForce) return start_pressing(percept);
  if (speed * in_step_s_ > kLongestDescent) reach_target(percept, true);
}

void SkilledHand::press(const Percept& percept, double dt_s) {
  intent_T_ -= percept.target_normal_T * press_.speed(senses_.force_n(), dt_s, random_) * dt_s;
  const Vec3 error = sideways_error(percept);
  const double distance = error.norm();
  if (distance > kSideDeadBand) intent_T_ += error * (kSideGain * (1 - kSideDeadBand / distance) * dt_s);
  const bool beside = distance > percept.target_radius_m + kSideDeadBand || height_over(percept) > kHitNear;
  aside_s_ = beside ? aside_s_ + dt_s : 0;
  if (aside_s_ > kAsideTime * skill_.speed_factor || press_.gives_up()) reach_target(percept, true);
}

void SkilledHand::squeeze(const Percept& percept, double dt_s) {
  if (in_step_s_ <= plan_.duration_s()) intent_T_ = plan_.at(in_step_s_);
  if (!opened_) {
    jaw_m_ = std::min(kOpenJaw, jaw_m_ + kJawSpeed * dt_s);
    opened_ = in_step_s_ > plan_.duration_s() && percept.jaw_opening_m > kOpenJaw - kOpenEnough;
    return;
  }
  const bool felt = senses_.grip_n() > kDiscGripTouch;
  const double closing = felt ? squeeze_.speed(senses_.grip_n(), dt_s, random_) : kClosingSpeed / skill_.speed_factor;
  if (squeeze_.gives_up()) begin_task(percept);
  jaw_m_ = std::clamp(jaw_m_ - closing * dt_s, std::min(kTightestJaw, percept.jaw_opening_m), kOpenJaw);
}

HandIntent SkilledHand::move_work(HandWork& work, const Percept& percept, double dt_s) {
  work.update(percept, senses_, dt_s, job_intent_, random_);
  intent_T_ = job_intent_.X_TI.p;
  intent_R_ = job_intent_.X_TI.R;
  jaw_m_ = job_intent_.jaw_opening_m;
  HandIntent intent = job_intent_;
  intent.X_TI.p += tremor(time_s_);
  return intent;
}

/// Until the next cue is noticed the person still attends to the old target, but sees what is in hand, and where.
Percept SkilledHand::attend(const Percept& percept) {
  if (senses_.seen() == task_) attended_ = percept;
  Percept view = attended_;
  view.instrument = percept.instrument;
  view.tip_T = percept.tip_T;
  view.R_TI = percept.R_TI;
  view.jaw_opening_m = percept.jaw_opening_m;
  return view;
}

HandIntent SkilledHand::update(const Percept& percept, double dt_s) {
  if (!is_ready_) {
    if (!seen_ || percept.device_ready) ready_ = {percept.R_TI, percept.tip_T};
    seen_ = true;
    is_ready_ = percept.device_ready;
    intent_T_ = ready_.p;
    intent_R_ = ready_.R;
    job_intent_.X_TI = ready_;
    return {ready_, jaw_m_};
  }
  time_s_ += dt_s;
  in_step_s_ += dt_s;
  const HandWork* busy = work();
  const bool touching = busy ? busy->touches() : step_ == Step::kPress;
  senses_.set_used_to_it(!touching);
  senses_.update(percept, skill_.pause_s, dt_s);
  if (!(senses_.task() == task_)) {
    task_ = senses_.task();
    begin_task(attend(percept));
  }
  if (HandWork* own = work()) return move_work(*own, attend(percept), dt_s);
  if (step_ != Step::kSqueeze) jaw_m_ = std::max(kClosedJaw, jaw_m_ - kJawSpeed * dt_s);  // touch with closed jaws
  act(attend(percept), dt_s);
  return {{intent_R_, intent_T_ + tremor(time_s_)}, jaw_m_};
}

void SkilledHand::act(const Percept& percept, double dt_s) {
  switch (step_) {
    case Step::kStill:
      break;
    case Step::kReach:
      intent_T_ = plan_.at(in_step_s_);
      if (task_.kind == HandJob::Kind::kPen) intent_R_ = turn_.at(in_step_s_);
      if (in_step_s_ > std::max(plan_.duration_s(), task_.kind == HandJob::Kind::kPen ? turn_.duration_s() : 0)) {
        in_step_s_ = 0;
        step_ = task_.kind == HandJob::Kind::kFinished ? Step::kStill : Step::kLook;
      } else if (in_step_s_ > 0.5 * plan_.duration_s() && senses_.touch_n() > kHitForce) {
        on_unexpected_touch(percept);
      }
      break;
    case Step::kLook:
      if (senses_.touch_n() > kHitForce) on_unexpected_touch(percept);
      if (step_ == Step::kLook) look(percept);
      break;
    case Step::kDescend:
      descend(percept, dt_s);
      break;
    case Step::kPress:
      press(percept, dt_s);
      break;
    case Step::kSqueeze:
      squeeze(percept, dt_s);
      break;
  }
}

}  // namespace trocar
