// What scoring must know of the exercise besides trace, events and rubric: bands, limits, the ideal path.
//
// Made from an exercise by scenarios/director/scoring_context.h and stored in the recording, so that a recording can be
// regraded alone. Frame T, SI units.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "haptics/quantities.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// Force wanted at one object, N.
struct ObjectBand {
  double low_n = 0, high_n = 0;
  bool operator==(const ObjectBand&) const = default;
};

struct ScoringContext {
  AttemptStatus outcome = AttemptStatus::kAborted;
  double time_limit_s = 0;
  double band_low_n = 0, band_high_n = 0;  ///< wanted contact force
  std::vector<ObjectBand> object_bands;    ///< by object where they differ; empty: the band above for all
  double soft_force_n = 0, hard_force_n = 0, critical_force_n = 0;
  double grip_low_n = 0, grip_high_n = 0;           ///< wanted grip force
  std::vector<std::array<double, 2>> grip_windows;  ///< wanted grip while carrying each block; empty: no blocks
  double counted_hold_s = 0;    ///< of the time in an object's band, as much counts; 0: recorded before it was known
  double rise_s = 0.5;          ///< after the first touch of an object, in which a force below the band is free
  double retract_height_m = 0;  ///< of the ideal path between targets, along approach_T
  Vec3 approach_T = Vec3::UnitZ();   ///< direction in which the instrument withdraws
  std::vector<Vec3> waypoints;       ///< start, then the targets that were held, in lit order
  std::optional<double> room_share;  ///< of the region, where the device can give the soft limit
  bool ring_on_wire = false;         ///< metrics of ring and wire are defined
  int objects_total = 0, objects_done = 0;
  int strands_total = 5;         ///< of the objects, the first: strands to be divided
  double strand_lift_m = 0.006;  ///< of the tip off the organ, when one is

  // An operation's stages, each graded as an attempt of its own; the numbers of its objects begin at 0 there.
  std::vector<ScoringContext> stages;
  std::string stage;                       ///< its name; empty: no stage
  int first_object = 0;                    ///< number of its first object in the whole
  std::vector<std::string> stage_metrics;  ///< that are told of it, as "<stage>/<metric>"

  bool operator==(const ScoringContext&) const = default;
};

/// Length of the ideal path: from each waypoint up by the retract height, across, and down to the next; the first leg
/// starts in the air and has no ascent. 0 for fewer than two waypoints.
double ideal_path_length(const ScoringContext& context);

}  // namespace trocar
