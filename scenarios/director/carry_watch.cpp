#include "scenarios/director/carry_watch.h"

#include <algorithm>

#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

constexpr double kDownUntil = 0.0005;  // m over what it stood on
constexpr double kSlipFrom = 0.001;    // m of creep that count as a slip

}  // namespace

CarryWatch::Change CarryWatch::update(const TissueFrame& frame, std::int32_t index, std::int32_t named, bool lit,
                                      double height_m, double grip_n, EventLog& log) {
  const bool held = holds(frame, index);
  Change change = Change::kNone;
  if (held && !held_) {
    change = Change::kTaken;
    log.add(grasped_ ? event_type::kRegrasp : event_type::kGrasped, grasped_ ? Severity::kMinor : Severity::kInfo,
            named, grip_n, "N");
    if (!lit) log.add(event_type::kWrongBlock, Severity::kMinor, named);
    grasped_ = true;
    slipping_ = up_ = false;
    highest_m_ = slip_from_m_ = 0;
  }
  if (!held && held_) {
    change = Change::kLetGo;
    if (up_) log.add(event_type::kSetDown, Severity::kInfo, named, height_m, "m");
    up_ = false;
    let_go_z_m_ = frame.object[static_cast<std::size_t>(index)].X_TO.p.z();
  }
  held_ = held;
  if (!held) return change;
  highest_m_ = std::max(highest_m_, height_m);
  if (up_ ? height_m < kDownUntil : height_m > kCarriedFrom) {
    up_ = !up_;
    log.add(up_ ? event_type::kLifted : event_type::kSetDown, Severity::kInfo, named, height_m, "m");
  }
  if (frame.grip != GripState::kSlipping) {
    slipping_ = false;
    slip_from_m_ = frame.slipped_m;
  } else if (!slipping_ && frame.slipped_m - slip_from_m_ > kSlipFrom) {
    slipping_ = true;
    log.add(event_type::kSlip, Severity::kMinor, named, frame.slipped_m - slip_from_m_, "m");
    if (change == Change::kNone) change = Change::kSlips;
  }
  return change;
}

}  // namespace trocar
