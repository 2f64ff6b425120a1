// The outcome of one attempt, as printed by `trocar run --json`, stored in the database and shown in reports.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/scoring/cap.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

struct Metric {
  std::string name;
  std::optional<double> value;  ///< empty when undefined (never 0 in its place)
  std::string unit;
};

struct Subscore {
  std::string name;
  double value = 0;  ///< 0..1
  double weight = 0;
  std::optional<double> raw;  ///< the metric's value
  std::string unit;
  double full_at = 0, zero_at = 0;
  bool gate = false;
};

/// What scoring alone computes from trace, events and rubric.
struct Grade {
  AttemptStatus status = AttemptStatus::kAborted;
  std::optional<double> score;  ///< 0..100; empty when void, aborted or fault
  bool passed = false;
  std::string grade;  ///< "expert", "proficient", "pass", "below pass", "not graded"
  std::vector<Subscore> subscores;
  std::vector<Cap> caps;  ///< each that was applied
  std::vector<Metric> metrics;
};

/// How often the device loop warned of something (docs/device_and_safety.md).
struct DeviceWarning {
  std::string name;
  double first_s = 0;  ///< loop time
  std::uint64_t ticks = 0;
};

/// A change of state of the device loop.
struct DeviceTransition {
  double t_s = 0;  ///< loop time
  std::string from, to;
};

/// How stiff the contacts were at the stylus beside K_max, what the device can display there
/// (haptics/contact/stiffness_limit.h).
struct StiffnessReport {
  bool recorded = false;            ///< recordings before format 3 do not say
  bool clamped = false;             ///< contacts stiffer than K_max were weakened to it
  std::uint64_t contact_ticks = 0;  ///< that felt a spring; what follows holds only with some
  double k_max_min_n_per_m = 0, k_max_max_n_per_m = 0;
  double asked_max_n_per_m = 0;  ///< stiffest contact, before any clamp
  double share_min = 1;          ///< least of min(1, K_max / asked)
  double above_share = 0;        ///< of the contact ticks: asked for more than K_max
};

/// Whether that back-end is mouse, keys, pad or SpaceMouse, with which nothing is felt (kPointerBackend, which scoring
/// does not see; tested).
inline bool without_device(const std::string& backend) { return backend == "pointer"; }

/// Loop quality of the attempt (the run report).
struct RunReport {
  std::string backend;
  bool without_device() const { return trocar::without_device(backend); }  ///< then nothing below is of motors
  double rate_hz = 0;
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;          ///< SYNC periods that the loop missed; not the overruns of a lane in `realtime`
  double saturated_contact_share = 0;  ///< of contact ticks
  double passivity_active_share = 0;   ///< of contact ticks
  double min_energy_j = 0;
  double kappa = 1;
  StiffnessReport stiffness;
  /// The force was not rendered when the device lacked room in over 5 % of the contact time.
  bool force_not_rendered() const { return saturated_contact_share > 0.05; }
  std::string fault;         ///< cause of the first one, empty when none
  std::string force_sensor;  ///< JSON: what the force sensor says of the delivered force; empty without one
  std::string plant;     ///< JSON of a simulated device: which arm, and by which files the loop knew it (true_plant.h)
  std::string realtime;  ///< JSON of a live run's pacing (docs/architecture.md); empty in lockstep
  int fault_channel = -1;               ///< -1: none in particular
  double fault_s = 0, fault_value = 0;  ///< loop time of the tick in which it was seen; the offending number
  std::string reason;                   ///< why the loop ended, empty when the exercise ended it
  std::vector<DeviceWarning> warnings;
  std::vector<DeviceTransition> transitions;
};

struct AttemptResult {
  std::string uuid;
  std::string exercise_id, exercise_version, level;
  std::int64_t seed = 0;
  int board = 0;
  std::string trainee, hand;
  std::string assists;  ///< pointer_assists() of a hand without a device; empty with one
  Grade grade;
  std::vector<Event> events;
  RunReport device;
  std::string safety_log_path;  ///< empty when nothing stopped the device
  std::string organ_name, organ_source, organ_sha256;
  bool organ_synthetic = false;
  std::string organ_credit;  ///< licence and origin, shown wherever the organ is
  std::string rubric_sha256, recording_sha256, recording_path;
  std::string integrity;    ///< why it was aborted, void or stopped by the device; empty when nothing is wrong
  bool cut_off = false;     ///< its program ended before it did (kill -9, power)
  std::string state_hash;   ///< 16 hexadecimal digits
  std::string started_utc;  ///< ISO 8601, wall clock, informative only
};

}  // namespace trocar
