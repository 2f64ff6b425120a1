#include "scenarios/kinds/pegs/peg_task.h"

#include <algorithm>
#include <cmath>

#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

constexpr double kMarkEnds = 0.9;      // of the grip that leaves a mark: below, the next one is another
constexpr double kPegToastTime = 1.5;  // s
constexpr double kMeets = 0.0003;      // m under a peg's top: the ring is on it or past it
constexpr double kFreeAgain = 0.002;   // m over it: the ring may come down anew
constexpr double kFlatOn = 0.001;      // m that a ring on its peg may lie higher than flat on the board
constexpr double kUpright = 0.9;       // least cosine between its hole and the peg

}  // namespace

PegTask::PegTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(own_rules<PegsRules>(exercise)),
      level_(own_rules<PegsLevel>(level)),
      display_(level.force_display),
      goals_(board.targets),
      pegs_(board.rigid.pegs),
      rings_(board.rigid.blocks.size()) {
  for (std::size_t i = 0; i < rings_.size(); ++i) rings_[i].from_z_m = board.rigid.blocks[i].X_TO.p.z();
}

std::int32_t PegTask::transfer_of(std::int32_t ring) const {
  return rings_[static_cast<std::size_t>(ring)].across ? ring + rings() : ring;
}

bool PegTask::gone(std::int32_t transfer) const {
  const Ring& ring = rings_[static_cast<std::size_t>(transfer % rings())];
  return ring.lost || (transfer < rings() ? ring.across : ring.back);
}

void PegTask::begin(EventLog& log) { light_next(log); }

void PegTask::light_next(EventLog& log) {
  if (lit_ >= 0 && !gone(lit_)) return;
  lit_ = -1;
  for (std::int32_t i = 0; i < 2 * rings() && lit_ < 0; ++i)
    if (!gone(i)) lit_ = i;
  if (lit_ >= 0) log.add(event_type::kTargetLit, Severity::kInfo, lit_);
}

void PegTask::update(const TaskInput& input, EventLog& log) {
  if (finished() || !input.tissue) return;
  toast_s_ += input.dt_s;
  const TissueFrame& frame = *input.tissue;
  for (std::int32_t i = 0; i < std::min(frame.object_count, rings()); ++i) {
    const ObjectState& object = frame.object[static_cast<std::size_t>(i)];
    follow_grip(frame, i, input.stylus.grip_force_n, log);
    if (!rings_[static_cast<std::size_t>(i)].lost && !has_left(object, i, log)) follow_free(object, i, log);
  }
  light_next(log);
}

void PegTask::warn(const char* message) {
  toast_ = message;
  toast_s_ = 0;
}

void PegTask::follow_grip(const TissueFrame& frame, std::int32_t index, double grip_n, EventLog& log) {
  Ring& ring = rings_[static_cast<std::size_t>(index)];
  const ObjectState& object = frame.object[static_cast<std::size_t>(index)];
  const std::int32_t transfer = transfer_of(index);
  const double z = object.X_TO.p.z();
  if (CarryWatch::holds(frame, index) && !ring.carry.held()) ring.from_z_m = z;
  using Change = CarryWatch::Change;
  const Change change =
      ring.carry.update(frame, index, transfer, index == lit_ % rings(), z - ring.from_z_m, grip_n, log);
  if (change == Change::kTaken) {
    ring.marking = false;
    ring.over = peg_under(object);
  }
  if (change == Change::kLetGo) ring.judged = ring.carry.highest_m() <= kCarriedFrom;
  if (change == Change::kSlips) warn("It slips - hold it tighter");
  if (!ring.carry.held()) return;
  if (!ring.marking && grip_n > rules_.mark_above_n) {
    log.add(event_type::kGripExcess, Severity::kMajor, transfer, grip_n, "N");
    warn("Too tight - the ring is marked");
    ++errors_;
  }
  ring.marking = grip_n > (ring.marking ? kMarkEnds : 1) * rules_.mark_above_n;
  follow_pegs(object, index, log);
}

/// The peg that stands under or beside the ring, no further than its sides; -1: none.
int PegTask::peg_under(const ObjectState& object) const {
  const double reach = rules_.ring_side_m / (2 * std::sqrt(3.0)) + rules_.peg_radius_m;
  for (std::size_t i = 0; i < pegs_.size(); ++i)
    if ((object.X_TO.p - pegs_[i].foot_T).head<2>().norm() < reach) return static_cast<int>(i);
  return -1;
}

/// Where a ring comes down on a peg is judged once, until it is free again.
void PegTask::follow_pegs(const ObjectState& object, std::int32_t index, EventLog& log) {
  Ring& ring = rings_[static_cast<std::size_t>(index)];
  const int peg = peg_under(object);
  const Vec3 hole = object.X_TO.R.col(2) * (object.X_TO.R(2, 2) < 0 ? -1 : 1);
  const Vec3 lower = object.X_TO.p - rules_.ring_height_m / 2 * hole;
  if (peg < 0 || lower.z() > rules_.peg_height_m + kFreeAgain) {
    ring.over = -1;
    return;
  }
  if (ring.over == peg || lower.z() > rules_.peg_height_m - kMeets) return;
  ring.over = peg;
  const double off = (object.X_TO.p - pegs_[static_cast<std::size_t>(peg)].foot_T).head<2>().norm();
  if (off <= level_.place_tolerance_m) return;
  ++errors_;
  log.add(event_type::kBump, Severity::kMinor, transfer_of(index), off, "m");
  warn("It hit the peg - look where it stands");
}

void PegTask::follow_free(const ObjectState& object, std::int32_t index, EventLog& log) {
  const Ring& ring = rings_[static_cast<std::size_t>(index)];
  if (!ring.carry.held() && !ring.judged && object.motion == ObjectMotion::kResting) judge_rest(object, index, log);
}

bool PegTask::has_left(const ObjectState& object, std::int32_t index, EventLog& log) {
  if (object.motion != ObjectMotion::kResting) return false;
  const double outside = object.X_TO.p.head<2>().cwiseAbs().maxCoeff() - (rules_.board_half_m + rules_.lost_margin_m);
  if (outside <= 0) return false;
  rings_[static_cast<std::size_t>(index)].lost = true;
  ++errors_;
  log.add(event_type::kLost, Severity::kCritical, transfer_of(index), outside, "m");
  return true;
}

void PegTask::judge_rest(const ObjectState& object, std::int32_t index, EventLog& log) {
  Ring& ring = rings_[static_cast<std::size_t>(index)];
  ring.judged = true;
  const std::int32_t transfer = transfer_of(index);
  const int peg = peg_under(object);
  const Vec3 goal = goals_[static_cast<std::size_t>(transfer)].centre_T;
  const double off = (object.X_TO.p - goal).head<2>().norm();
  const bool on_peg =
      peg >= 0 && std::abs(object.X_TO.R(2, 2)) > kUpright &&
      (object.X_TO.p - pegs_[static_cast<std::size_t>(peg)].foot_T).head<2>().norm() < rules_.hole_radius_m &&
      object.X_TO.p.z() < rules_.ring_height_m / 2 + kFlatOn;
  if (on_peg && off < rules_.hole_radius_m) {
    (ring.across ? ring.back : ring.across) = true;
    ring.carry.arrive();
    ++done_;
    return log.add(event_type::kTargetHeld, Severity::kInfo, transfer, off, "m");
  }
  const double fallen = ring.carry.let_go_z_m() - object.X_TO.p.z();
  if (!on_peg && fallen > rules_.drop_m) {
    ++errors_;
    log.add(event_type::kDrop, Severity::kMajor, transfer, fallen, "m");
    return warn("Dropped - pick it up again");
  }
  log.add(event_type::kMisplaced, Severity::kMinor, transfer, off, "m");
  warn(on_peg ? "That is another peg" : "It is not on its peg");
}

void PegTask::describe_message(double grip_n, DirectorStatus& status) const {
  const Ring& ring = rings_[static_cast<std::size_t>(lit_ % rings())];
  const std::string count = std::to_string(done_ + 1) + " of " + std::to_string(goals_.size());
  if (toast_s_ < kPegToastTime) return say(status, toast_, "Ring " + count + ".", true);
  const bool told = display_ != "after";
  if (ring.carry.held() && told && grip_n > rules_.mark_above_n)
    return say(status, "A little softer", "Hold it with " + band_text(goals_.front().band) + ".");
  if (ring.carry.held() && ring.carry.up() && told && grip_n < rules_.slip_below_n)
    return say(status, "A little tighter", "Hold it with " + band_text(goals_.front().band) + ".");
  if (!ring.carry.held()) return say(status, "Take the lit ring off its peg", "Ring " + count + ".");
  if (status.cue == Cue::kPlace) return say(status, "Lower it over the peg", "Let go when it lies on the board.");
  say(status, "Carry it to the lit peg", "Lift it well clear of the pegs.");
}

/// A ring is as thick for the pads however it is turned about its hole: the hand need not turn to it.
SeenObject PegTask::seen(const ObjectState& object, const TaskInput& input) const {
  const bool slipping = input.tissue->grip == GripState::kSlipping && input.tissue->grip_object == lit_ % rings();
  const Vec3 hole = object.X_TO.R.col(2);
  Vec3 across = input.stylus.X_TI.R.col(1);
  across -= across.dot(hole) * hole;
  if (across.norm() < 0.5) return {object.X_TO, object.size_m, slipping};
  Mat3 R;
  R.col(1) = across.normalized();
  R.col(2) = hole;
  R.col(0) = R.col(1).cross(hole);
  return {{R, object.X_TO.p}, object.size_m, slipping};
}

void PegTask::describe(const TaskInput& input, DirectorStatus& status) const {
  status.targets_done = done_;
  for (std::int32_t i = 0; i < 2 * rings(); ++i) {
    const Ring& ring = rings_[static_cast<std::size_t>(i % rings())];
    status.done.set(static_cast<std::size_t>(i), i < rings() ? ring.across : ring.back);
  }
  status.target_index = lit_;
  status.wrong_places = errors_;
  status.hold_progress = 0;
  if (finished()) return;
  const std::int32_t index = lit_ % rings();
  const Target& goal = goals_[static_cast<std::size_t>(lit_)];
  Demand& demand = status.demand;
  demand.goal_T = goal.centre_T;
  demand.radius_m = goal.radius_m;
  demand.band = goal.band;
  demand.foam_count = 1;
  demand.foam[0] = {rules_.ring_stiffness_n_per_m, goal.band.low_n, goal.band.high_n};
  status.cue = Cue::kPick;
  if (input.tissue && index < input.tissue->object_count) {
    const ObjectState& object = input.tissue->object[static_cast<std::size_t>(index)];
    demand.object = seen(object, input);
    const double off = (object.X_TO.p - goal.centre_T).head<2>().norm();
    if (rings_[static_cast<std::size_t>(index)].carry.held())
      status.cue = off <= goal.radius_m ? Cue::kPlace : Cue::kCarry;
  }
  demand.centre_T = status.cue == Cue::kPick ? demand.object.X_TO.p : goal.centre_T;
  const double grip = input.stylus.grip_force_n;
  const bool holds = rings_[static_cast<std::size_t>(index)].carry.held();
  status.force_shown = force_shown(display_, holds && (grip < goal.band.low_n || grip > goal.band.high_n));
  describe_message(grip, status);
}

}  // namespace trocar
