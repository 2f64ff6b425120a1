#include "scenarios/kinds/grasp/grasp_task.h"

#include <algorithm>
#include <cmath>

#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

constexpr double kLiftShort = 0.001;     // m that a lift may fall short
constexpr double kGraspToastTime = 1.5;  // s
constexpr double kPushedOut = 0.001;     // m beyond the tolerance that undo a placing
constexpr double kTouched = 0.05;        // N

/// Height of the lowest corner over the board.
double clearance(const ObjectState& object) {
  return object.X_TO.p.z() - object.X_TO.R.row(2).cwiseAbs().dot(object.size_m.transpose()) / 2;
}

}  // namespace

GraspTask::GraspTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : rules_(exercise.grasp),
      level_(level.grasp),
      display_(level.force_display),
      rings_(board.targets),
      blocks_(board.targets.size()) {}

bool GraspTask::gone(std::int32_t index) const {
  const Block& block = blocks_[static_cast<std::size_t>(index)];
  return block.placed || block.lost;
}

void GraspTask::begin(EventLog& log) { light_next(log); }

void GraspTask::light_next(EventLog& log) {
  if (lit_ >= 0 && !gone(lit_)) return;
  lit_ = -1;
  for (std::size_t i = 0; i < blocks_.size() && lit_ < 0; ++i) {
    if (!gone(static_cast<std::int32_t>(i))) lit_ = static_cast<std::int32_t>(i);
  }
  if (lit_ >= 0) log.add(event_type::kTargetLit, Severity::kInfo, lit_);
}

void GraspTask::update(const TaskInput& input, EventLog& log) {
  if (finished() || !input.tissue) return;
  toast_s_ += input.dt_s;
  const TissueFrame& frame = *input.tissue;
  const auto count = std::min<std::int32_t>(frame.object_count, static_cast<std::int32_t>(blocks_.size()));
  for (std::int32_t i = 0; i < count; ++i) {
    follow_grip(frame, i, input.stylus.grip_force_n, log);
    if (!blocks_[static_cast<std::size_t>(i)].lost && !has_left(frame.object[static_cast<std::size_t>(i)], i, log))
      follow_free(frame.object[static_cast<std::size_t>(i)], i, log);
  }
  light_next(log);
}

void GraspTask::follow_grip(const TissueFrame& frame, std::int32_t index, double grip_n, EventLog& log) {
  Block& block = blocks_[static_cast<std::size_t>(index)];
  const ObjectState& object = frame.object[static_cast<std::size_t>(index)];
  if (object.crushed && !block.crushed) {
    block.crushed = true;
    const bool critical = ++crushed_ == rules_.critical_crushed;
    log.add(event_type::kCrush, critical ? Severity::kCritical : Severity::kMajor, index, grip_n, "N");
    toast_ = "Crushed - hold it more gently";
    toast_s_ = 0;
    ++errors_;
  }
  using Change = CarryWatch::Change;
  const Change change = block.carry.update(frame, index, index, index == lit_, clearance(object), grip_n, log);
  if (change == Change::kTaken) {
    block.dropped = false;
    if (block.placed) take_out(index, log);
  }
  if (change == Change::kLetGo) block.judged = false;
  if (change == Change::kSlips) {
    toast_ = "It slips - hold it tighter";
    toast_s_ = 0;
  }
}

void GraspTask::take_out(std::int32_t index, EventLog& log) {
  blocks_[static_cast<std::size_t>(index)].placed = false;
  --done_;
  ++errors_;
  log.add(event_type::kRemoved, Severity::kMinor, index);
}

void GraspTask::follow_free(const ObjectState& object, std::int32_t index, EventLog& log) {
  Block& block = blocks_[static_cast<std::size_t>(index)];
  if (block.placed) {  // pushed out by something
    const Target& ring = rings_[static_cast<std::size_t>(index)];
    if ((object.X_TO.p - ring.centre_T).head<2>().norm() > ring.radius_m + kPushedOut) take_out(index, log);
    return;
  }
  if (block.carry.held() || block.judged) return;
  const double fallen = block.carry.let_go_z_m() - object.X_TO.p.z();
  if (!block.dropped && fallen > rules_.drop_m) {
    block.dropped = true;
    ++errors_;
    log.add(event_type::kDrop, Severity::kMajor, index, clearance(object) + fallen, "m");
    toast_ = "Dropped - pick it up again";
    toast_s_ = 0;
  }
  if (object.motion == ObjectMotion::kResting) judge_rest(object, index, log);
}

/// A block that comes to rest too far out is lost, carried there or pushed.
bool GraspTask::has_left(const ObjectState& object, std::int32_t index, EventLog& log) {
  if (object.motion != ObjectMotion::kResting) return false;
  const double reach = rules_.board_half_m + rules_.lost_margin_m;
  const double outside = object.X_TO.p.head<2>().cwiseAbs().maxCoeff() - reach;
  if (outside <= 0) return false;
  Block& block = blocks_[static_cast<std::size_t>(index)];
  if (block.placed) take_out(index, log);
  block.lost = true;
  ++errors_;
  log.add(event_type::kLost, Severity::kCritical, index, outside, "m");
  return true;
}

void GraspTask::judge_rest(const ObjectState& object, std::int32_t index, EventLog& log) {
  Block& block = blocks_[static_cast<std::size_t>(index)];
  block.judged = true;
  const Vec3 middle = object.X_TO.p;
  const Target& ring = rings_[static_cast<std::size_t>(index)];
  const double off = (middle - ring.centre_T).head<2>().norm();
  const bool lifted = block.carry.highest_m() > rules_.lift_m - kLiftShort;
  const bool stands = middle.z() < rules_.block_m.z();  // on the board, on whichever side, and not on another block
  if (lifted && !block.dropped && stands && off <= ring.radius_m) {
    block.placed = true;
    ++done_;
    return log.add(event_type::kPlaced, Severity::kInfo, index, off, "m");
  }
  if (block.carry.highest_m() > kCarriedFrom && !block.dropped)
    log.add(event_type::kMisplaced, Severity::kMinor, index, off, "m");
  if (off <= ring.radius_m && !lifted && !block.dropped) {
    toast_ = "Lift it higher on the way";
    toast_s_ = 0;
  }
}

void GraspTask::describe_message(double grip_n, DirectorStatus& status) const {
  const Block& block = blocks_[static_cast<std::size_t>(lit_)];
  if (toast_s_ < kGraspToastTime) return say(status, toast_, "Block " + std::to_string(lit_ + 1) + ".", true);
  const WantedForce band = rings_[static_cast<std::size_t>(lit_)].band;
  if (block.carry.held() && block.carry.up() && grip_n > band.high_n && display_ != "after")
    return say(status, "A little softer", "Hold it with " + band_text(band) + ".");
  if (block.carry.held() && block.carry.up() && grip_n < band.low_n && display_ != "after")
    return say(status, "A little tighter", "Hold it with " + band_text(band) + ".");
  if (!block.carry.held()) {
    const std::string count = std::to_string(done_ + 1) + " of " + std::to_string(blocks_.size());
    return say(status, "Pick up the lit block", "Block " + count + ".");
  }
  if (status.cue == Cue::kPlace) return say(status, "Set it down within the ring", "Let go when it stands.");
  say(status, "Carry it to its ring", "Lift it well clear of the others.");
}

void GraspTask::describe(const TaskInput& input, DirectorStatus& status) const {
  status.targets_done = done_;
  for (std::size_t i = 0; i < blocks_.size(); ++i) status.done.set(i, blocks_[i].placed);
  status.target_index = lit_;
  status.wrong_places = errors_;
  status.hold_progress = 0;
  if (finished()) return;
  const auto index = static_cast<std::size_t>(lit_);
  const Block& block = blocks_[index];
  const Target& ring = rings_[index];
  Demand& demand = status.demand;
  demand.goal_T = ring.centre_T;
  demand.radius_m = ring.radius_m;
  demand.band = level_.colour_cue ? ring.band : WantedForce{};
  demand.foam_count = 0;
  for (const FoamKind& kind : rules_.kinds) {
    if (demand.foam_count >= kMostFoams) break;
    const GripWindow window = grip_window(kind, level_);
    demand.foam[static_cast<std::size_t>(demand.foam_count++)] = {kind.stiffness_n_per_m, window.low_n, window.high_n};
  }
  status.cue = Cue::kPick;
  if (input.tissue && lit_ < input.tissue->object_count) {
    const ObjectState& object = input.tissue->object[index];
    demand.object = {object.X_TO, object.size_m, block.carry.held() && input.tissue->grip == GripState::kSlipping};
    const double off = (object.X_TO.p - ring.centre_T).head<2>().norm();
    if (block.carry.held()) status.cue = off <= ring.radius_m ? Cue::kPlace : Cue::kCarry;
  }
  demand.centre_T = status.cue == Cue::kPick ? demand.object.X_TO.p : ring.centre_T;
  const double grip = input.stylus.grip_force_n;
  const bool outside = grip > kTouched && (grip < ring.band.low_n || grip > ring.band.high_n);
  status.force_shown = force_shown(display_, outside);
  describe_message(grip, status);
}

}  // namespace trocar
