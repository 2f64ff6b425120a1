#include "scenarios/director/safety_watch.h"

#include <algorithm>
#include <utility>

namespace trocar {
namespace {

constexpr double kExcessRepeat = 1.0;    // s above the limit that count as one more excess
constexpr double kCollisionForce = 2.0;  // N of the shaft on the tissue
constexpr double kLimitRearm = 0.5;      // s

}  // namespace

SafetyWatch::SafetyWatch(const Exercise& exercise)
    : excess_(exercise.hard_force_n, kRearmShare * exercise.hard_force_n, kRearmTime, kExcessRepeat),
      critical_(exercise.critical_force_n, kRearmShare * exercise.critical_force_n, kRearmTime),
      collision_(kCollisionForce, kRearmShare * kCollisionForce, kRearmTime),
      limit_(0.5, 0.5, kLimitRearm) {}

void SafetyWatch::update(const StylusState& state, double dt_s, std::int32_t object, EventLog& log) {
  const double force = state.F_I_T.force.norm();
  peak_n_ = std::max(peak_n_, force);
  if (excess_.update(force, dt_s)) {
    ++excess_count_;
    log.add(event_type::kExcessForce, Severity::kMajor, object, force, "N");
  }
  if (critical_.update(force, dt_s)) log.add(event_type::kCriticalForce, Severity::kCritical, object, force, "N");
  const double shaft_force = state.contact && !state.tip_contact ? force : 0;
  if (collision_.update(shaft_force, dt_s)) log.add(event_type::kToolCollision, Severity::kMinor, object, force, "N");
  if (limit_.update(state.saturated ? 1 : 0, dt_s))
    log.add(event_type::kDeviceLimit, Severity::kInfo, object, state.rendered_force_T.norm(), "N");
  if (state.clutched && !clutched_) log.add(event_type::kClutch, Severity::kInfo, object);
  if (state.port_held && !held_) log.add(event_type::kPortHold, Severity::kMinor, object, state.depth_in_port_m, "m");
  if (frozen(state)) {
    frozen_s_ += dt_s;
  } else if (clutched_ || held_) {
    log.add(event_type::kInstrumentFree, Severity::kInfo, object, std::exchange(frozen_s_, 0), "s");
  }
  clutched_ = state.clutched;
  held_ = state.port_held;
}

}  // namespace trocar
