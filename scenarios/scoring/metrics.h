// The metric table: name, unit and definition of every number that an attempt is described by (docs/scoring.md).
//
// compute_metrics sees only the graded window (START to the end event). A metric that is not defined for the attempt
// is empty, never 0. Pure: same trace, events and context in, same bits out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/scoring_context.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// What a better hand has of a metric, all else equal.
enum class Direction : std::uint8_t { kLess, kMore, kNeither };

struct MetricDefinition {
  std::string_view name, unit, meaning, formula;
  Direction better = Direction::kNeither;
  std::string_view evidence = "none: a design choice, not yet compared with people";
};

/// All metrics, in the order of the table.
const std::vector<MetricDefinition>& metric_catalogue();
/// "<stage>/<metric>": of a stage of an operation.
std::string stage_metric(std::string_view stage, std::string_view metric);
/// Of a stage or of the whole: its name in the table.
std::string_view plain_metric(std::string_view name);
/// By its plain name. nullptr when unknown.
const MetricDefinition* find_metric(std::string_view name);

/// Does it tell how hard was pressed or held?
bool is_force_metric(std::string_view name);

/// Part of a trace with start <= t <= end.
Trace cut_trace(const Trace& trace, double start_s, double end_s);

/// Events of an operation's stage as those of an attempt: START where it began, DONE or TIMEOUT where the next one did
/// or all ended, between them its own objects, counted from 0, and what names none; last CLIP_WASTED of later clips
/// that came off. Empty: it never began.
std::vector<Event> events_of_stage(const std::vector<Event>& events, int stage, int first_object, int objects);

/// Every metric of the catalogue, in its order; after them the stages' that are asked for. @param trace strictly
/// increasing finite times (integrity.h).
std::vector<Metric> compute_metrics(const Trace& trace, const std::vector<Event>& events,
                                    const ScoringContext& context);

/// Start and end of the graded window: START event to DONE or TIMEOUT event (last sample when there is none).
/// Empty without a START event.
std::optional<std::pair<double, double>> graded_window(const Trace& trace, const std::vector<Event>& events);

// The groups that compute_metrics asks, each filling its own names.
using MetricSink = std::vector<Metric>;
void add_motion_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                        MetricSink& sink);
void add_force_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                       MetricSink& sink);
void add_pose_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink);
/// @param trace the whole one: this looks at what came before START.
void add_rest_metric(const Trace& trace, const std::vector<Event>& events, MetricSink& sink);
void add_grasp_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                       MetricSink& sink);
/// @param events of the graded window.
void add_retract_metrics(const std::vector<Event>& events, MetricSink& sink);
/// @param events of the graded window.
void add_find_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink);
void add_camera_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                        MetricSink& sink);
void add_wire_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                      MetricSink& sink);
void add_palpate_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink);
/// @param events of the graded window. @param time_s its length; nothing: there is none
void add_pegs_metrics(const std::vector<Event>& events, const ScoringContext& context, std::optional<double> time_s,
                      MetricSink& sink);
/// @param events of the graded window.
void add_clip_metrics(const std::vector<Event>& events, MetricSink& sink);
/// @param events of the graded window.
void add_needle_metrics(const std::vector<Event>& events, MetricSink& sink);
/// @param trace and @param events of the graded window.
void add_dissect_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& context,
                         MetricSink& sink);
void add_gauze_metrics(const std::vector<Event>& events, MetricSink& sink);
void add_count_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink);

}  // namespace trocar
