#include "scenarios/kinds/wire/ring_task.h"

#include <algorithm>
#include <cmath>

#include "haptics/contact/ring_contact.h"
#include "scenarios/kinds/wire/wire_layout.h"
#include "scenarios/kinds/wire/wire_rules.h"

namespace trocar {
namespace {

constexpr double kStride = 0.008;   // m of wire within which the ring is looked for again after one period
constexpr double kPutOn = 0.012;    // m of wire round where it came off, or from its beginning: it can be put on here
constexpr double kPassed = 0.0015;  // m short of a gate that pass it
constexpr double kLeastTouch = 0.020;  // s
constexpr double kTouchApart = 0.2;    // s without contact that part two touches
constexpr double kAcross = 0.5;        // least cosine between normal and wire as the ring is put on

}  // namespace

RingTask::RingTask(const Exercise& exercise, const ExerciseLevel& level, const Board& board)
    : ring_(ring_of(exercise, level)),
      most_depth_m_(own_rules<WireRules>(exercise).holds_n / own_rules<WireRules>(exercise).stiffness_n_per_m),
      angle_tolerance_rad_(level.angle_tolerance_rad),
      wire_T_(board.wire_T),
      along_(arc_lengths(board.wire_T)),
      gates_(board.targets),
      gate_at_m_(gate_places(exercise.layout.count, along_.back())) {}

void RingTask::light(EventLog& log) {
  angle_sum_ = angle_way_m_ = 0;
  lit_at_s_ = log.t_s;
  if (!finished()) log.add(event_type::kTargetLit, Severity::kInfo, gate_);
}

std::pair<std::size_t, std::size_t> RingTask::near(double reach_m) const {
  const auto first = std::lower_bound(along_.begin(), along_.end(), at_m_ - reach_m);
  const auto last = std::upper_bound(along_.begin(), along_.end(), at_m_ + reach_m);
  return {static_cast<std::size_t>(first - along_.begin()), static_cast<std::size_t>(last - along_.begin())};
}

void RingTask::advance(double along_m, double angle_rad) {
  at_m_ = along_m;
  const double way = along_m - reached_m_;
  if (way <= 0) return;
  angle_sum_ += angle_rad * way;
  angle_way_m_ += way;
  reached_m_ = along_m;
}

void RingTask::come_off(double offset_m, EventLog& log) {
  on_ = false;
  lost_ = true;
  log.add(event_type::kRingOff, Severity::kCritical, gate_, offset_m - ring_.play_m, "m");
}

void RingTask::follow(const TaskInput& input, EventLog& log) {
  const Pose& X_TI = input.stylus.X_TI;
  const Vec3 centre = X_TI * ring_.centre_I, normal = X_TI.R * ring_.normal_I;
  const auto [first, last] = near(on_ ? kStride : kPutOn);
  const auto crossing = cross_ring(std::span(wire_T_).subspan(first, last - first), centre, normal);
  if (!crossing) {
    if (on_ && at_m_ > kStride) come_off(ring_.play_m + most_depth_m_, log);
    on_ = false;  // drawn back over the end where it was put on
    return;
  }
  offset_m_ = (crossing->point_T - centre).norm();
  const double across = std::abs(normal.dot(crossing->tangent_T));
  angle_rad_ = std::acos(std::min(1.0, across));
  if (!on_) {
    on_ = offset_m_ <= ring_.play_m && across >= kAcross;
    if (!on_) return;
    lost_ = false;
  } else if (offset_m_ > ring_.play_m + most_depth_m_) {
    return come_off(offset_m_, log);
  }
  advance(along_[first] + crossing->along_m, angle_rad_);
}

void RingTask::end_touch(EventLog& log) {
  if (touch_s_ > kLeastTouch) {
    ++touches_;
    log.add(event_type::kWireTouched, Severity::kMinor, gate_, touch_s_, "s");
  }
  touch_s_ = 0;
}

void RingTask::watch_touch(const TaskInput& input, EventLog& log) {
  touching_ = on_ && input.stylus.contact;
  free_s_ = touching_ ? 0 : free_s_ + input.dt_s;
  if (touching_) touch_s_ += input.dt_s;
  if (touch_s_ > 0 && free_s_ >= kTouchApart) end_touch(log);
}

void RingTask::update(const TaskInput& input, EventLog& log) {
  if (finished()) return;
  follow(input, log);
  watch_touch(input, log);
  while (on_ && !finished() && at_m_ >= gate_at_m_[static_cast<std::size_t>(gate_)] - kPassed) {
    log.add(event_type::kTargetHeld, Severity::kInfo, gate_, log.t_s - lit_at_s_, "s");
    log.add(event_type::kAngleError, Severity::kInfo, gate_, angle_way_m_ > 0 ? angle_sum_ / angle_way_m_ : angle_rad_,
            "rad");
    ++gate_;
    if (finished()) {
      gate_ -= 1;  // the touch belongs to it
      end_touch(log);
      gate_ += 1;
    }
    light(log);
  }
}

void RingTask::describe(const TaskInput&, DirectorStatus& status) const {
  status.targets_done = gate_;
  status.target_index = object();
  for (std::int32_t i = 0; i < gate_; ++i) status.done.set(static_cast<std::size_t>(i));
  status.cue = Cue::kOrient;
  status.force_shown = false;
  status.hold_progress = 0;
  status.wrong_places = touches_ + (touch_s_ > kLeastTouch ? 1 : 0);
  status.angle_error_rad = angle_rad_;
  status.position_error_m = offset_m_;
  status.ring = nullptr;
  if (finished()) return;
  if (on_) {
    const auto middle = std::lower_bound(along_.begin(), along_.end(), at_m_) - along_.begin();
    const auto points = std::min<std::ptrdiff_t>(RingOnWire::kMostPoints, std::ssize(wire_T_));
    const auto first = std::clamp<std::ptrdiff_t>(middle - points / 2, 0, std::ssize(wire_T_) - points);
    auto ring = std::make_shared<RingOnWire>(ring_);
    std::copy_n(wire_T_.begin() + first, points, ring->point_T.begin());
    ring->count = static_cast<std::int32_t>(points);
    status.ring = std::move(ring);
  }
  const Target& gate = gates_[static_cast<std::size_t>(gate_)];
  status.demand = {gate.centre_T, gate.normal_T, gate.radius_m, true, gate.R_TI, angle_tolerance_rad_, {}};
  const std::string count = std::to_string(gate_ + 1) + " of " + std::to_string(gates_.size());
  if (lost_) {
    // The pose of the gate before is the nearest to where it came off that is known to be good.
    const Target& last = gates_[static_cast<std::size_t>(std::max(0, gate_ - 1))];
    status.demand.centre_T = last.centre_T;
    status.demand.normal_T = last.normal_T;
    status.demand.R_TI = last.R_TI;
    return say(status, "The ring came off", "Put it round the wire again where it came off.", true);
  }
  if (touching_) return say(status, "The ring touches the wire", "Ease it back to the middle.", true);
  if (!on_) return say(status, "Put the ring over the end of the wire", "It stays on until the other end.");
  say(status, "Move the ring along the wire", "Gate " + count + ".");
}

}  // namespace trocar
