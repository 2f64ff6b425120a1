#include "scenarios/scoring/metrics.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace trocar {

namespace {

constexpr MetricDefinition kCatalogue[] = {
    {"time_s", "s", "from START to the end of the attempt"},
    {"path_m", "m", "length of the tip's path, filtered at 10 Hz and taken at 100 Hz"},
    {"path_x_m", "m", "sum of the tip's motion along x of the theatre"},
    {"path_y_m", "m", "sum of the tip's motion along y of the theatre"},
    {"path_z_m", "m", "sum of the tip's motion along z of the theatre"},
    {"ideal_path_m", "m", "start to each held target in turn, withdrawing by the retract height between them"},
    {"economy", "1", "ideal path / path"},
    {"path_ratio", "1", "path / ideal path"},
    {"depth_path_m", "m", "sum of the tip's motion along the shaft (depth perception)"},
    {"angular_path_deg", "deg", "angle swept by the shaft, taken at 10 Hz"},
    {"speed_mean_mps", "m/s", "mean speed of the tip"},
    {"speed_max_mps", "m/s", "highest speed of the tip"},
    {"speed_peaks", "1", "local maxima of the speed that stand out by at least 5 mm/s"},
    {"speed_peak_rate_hz", "1/s", "speed peaks per second"},
    {"idle_share", "1", "share of time slower than 5 mm/s for at least 0.5 s"},
    {"movements", "1", "stretches faster than 10 mm/s that last at least 0.5 s"},
    {"sparc", "1", "spectral arc length of the speed, mean over movements; nearer 0 is smoother"},
    {"ldlj", "1", "log dimensionless jerk (6 Hz filter), mean over movements; nearer 0 is smoother"},
    {"normalised_jerk", "1", "sqrt(T^5 / (2 L^2) x integral of squared jerk), mean over movements; 19.0 is ideal"},
    {"tremor_rms_m", "m", "displacement of the tip between 8 and 12 Hz, RMS, unfiltered trace"},
    {"tremor_share", "1", "velocity power between 8 and 12 Hz / above 0.3 Hz"},
    {"contact_time_s", "s", "time in contact with the tissue"},
    {"force_max_n", "N", "largest contact force"},
    {"force_mean_n", "N", "mean contact force over the time in contact"},
    {"force_rms_n", "N", "root mean square of the contact force over the time in contact"},
    {"force_sd_n", "N", "standard deviation of the contact force over the time in contact"},
    {"impulse_ns", "N s", "integral of the contact force"},
    {"impulse_max_ns", "N s", "integral of the contact force over the heaviest single contact"},
    {"force_volume_n3", "N^3", "ellipsoid of the standard deviations of the force along its principal axes"},
    {"soft_force_share", "1", "share of contact time above the soft force limit"},
    {"force_rate_max_n_per_s", "N/s", "steepest change of the contact force, filtered at 20 Hz"},
    {"in_band_share", "1", "share of the pressing time in which the force is in the wanted band"},
    {"grip_max_n", "N", "largest grip force"},
    {"grip_mean_n", "N", "mean grip force while gripping"},
    {"grip_in_band_share", "1", "share of the squeezing time in which the grip is in the wanted band"},
    {"regrasps", "1", "grasps after the first"},
    {"commanded_max_n", "N", "largest contact force asked at the stylus (force scale and mapping applied)"},
    {"commanded_mean_n", "N", "mean of it over the time in contact"},
    {"delivered_max_n", "N", "largest contact force that the device gave (limits, heat, passivity applied)"},
    {"delivered_mean_n", "N", "mean of it over the time in contact"},
    {"room_share", "1", "share of the board region in which the device can give the soft force limit"},
    {"saturated_contact_share", "1", "share of contact ticks in which the device could not give the force"},
    {"passivity_active_share", "1", "share of contact ticks in which the passivity law changed the force"},
    {"targets_held", "1", "targets held in the band for the wanted time"},
    {"objects_done_share", "1", "objects done / objects of the exercise"},
    {"wrong_places", "1", "contacts that began outside the lit target"},
    {"excess_events", "1", "times that contact or grip went above its hard limit"},
    {"critical_events", "1", "events of critical severity"},
    {"tool_collisions", "1", "times that the shaft pressed on the tissue"},
    {"clutches", "1", "times that the clutch was pressed"},
    {"matched_in_time_share", "1", "targets held before their time ran out / all objects"},
    {"position_error_m", "m", "distance of the tip from the wanted place, second half of the hold, mean over targets"},
    {"angle_error_deg", "deg", "turn between instrument and wanted pose, roll included, over the same time"},
    {"target_timeouts", "1", "targets that were not done in their time"},
    {"device_limits", "1", "times that the device could not give the force"},
    {"rest_tremor_rms_m", "m", "displacement between 8 and 12 Hz in the second before START: the baseline of tremor"},
    {"grip_window_share", "1", "share of the time blocks are carried in which the grip lies in the block's window"},
    {"crushed", "1", "blocks crushed"},
    {"block_regrasps", "1", "times that a block was grasped again"},
    {"slips", "1", "times that a carried block slid through the jaws"},
    {"drops", "1", "times that a block fell"},
    {"misplaced", "1", "times that a carried block was set down outside its ring"},
};

// Of force though their unit does not say so; all others of force are in newtons.
constexpr std::string_view kForceShares[] = {"soft_force_share", "in_band_share",     "grip_in_band_share",
                                             "excess_events",    "grip_window_share", "crushed"};

}  // namespace

const std::vector<MetricDefinition>& metric_catalogue() {
  static const std::vector<MetricDefinition> catalogue(std::begin(kCatalogue), std::end(kCatalogue));
  return catalogue;
}

const MetricDefinition* find_metric(std::string_view name) {
  for (const MetricDefinition& definition : metric_catalogue()) {
    if (definition.name == name) return &definition;
  }
  return nullptr;
}

bool is_force_metric(std::string_view name) {
  const MetricDefinition* metric = find_metric(name);
  if (metric && metric->unit.starts_with('N')) return true;
  return std::find(std::begin(kForceShares), std::end(kForceShares), name) != std::end(kForceShares);
}

Trace cut_trace(const Trace& trace, double start_s, double end_s) {
  Trace cut;
  cut.rate_hz = trace.rate_hz;
  std::copy_if(trace.samples.begin(), trace.samples.end(), std::back_inserter(cut.samples),
               [&](const TraceSample& sample) { return sample.t_s >= start_s && sample.t_s <= end_s; });
  return cut;
}

std::optional<std::pair<double, double>> graded_window(const Trace& trace, const std::vector<Event>& events) {
  const auto is = [](EventType type) { return [type](const Event& event) { return event.type == type; }; };
  const auto start = std::find_if(events.begin(), events.end(), is(event_type::kStart));
  if (start == events.end()) return std::nullopt;
  const auto end = std::find_if(start, events.end(), [](const Event& event) {
    return event.type == event_type::kDone || event.type == event_type::kTimeout;
  });
  if (end != events.end()) return std::pair{start->t_s, end->t_s};
  return std::pair{start->t_s, trace.samples.empty() ? start->t_s : trace.samples.back().t_s};
}

void add_count_metrics(const std::vector<Event>& events, const ScoringContext& context, MetricSink& sink) {
  int wrong = 0, excess = 0, critical = 0, collisions = 0, clutches = 0;
  std::vector<std::int32_t> held;
  for (const Event& event : events) {
    wrong += event.type == event_type::kWrongPlace;
    excess += event.type == event_type::kExcessForce || event.type == event_type::kGripExcess;
    critical += event.severity == Severity::kCritical;
    collisions += event.type == event_type::kToolCollision;
    clutches += event.type == event_type::kClutch;
    if (event.type == event_type::kTargetHeld && std::find(held.begin(), held.end(), event.object) == held.end())
      held.push_back(event.object);
  }
  const double total = context.objects_total;
  sink.push_back({"targets_held", static_cast<double>(held.size()), "1"});
  sink.push_back(
      {"objects_done_share", total > 0 ? std::optional<double>(context.objects_done / total) : std::nullopt, "1"});
  sink.push_back({"wrong_places", wrong, "1"});
  sink.push_back({"excess_events", excess, "1"});
  sink.push_back({"critical_events", critical, "1"});
  sink.push_back({"tool_collisions", collisions, "1"});
  sink.push_back({"clutches", clutches, "1"});
}

std::vector<Metric> compute_metrics(const Trace& trace, const std::vector<Event>& events,
                                    const ScoringContext& context) {
  const auto window = graded_window(trace, events);
  Trace graded;
  std::vector<Event> graded_events;
  graded.rate_hz = trace.rate_hz;
  if (window) {
    graded = cut_trace(trace, window->first, window->second);
    std::copy_if(events.begin(), events.end(), std::back_inserter(graded_events),
                 [&](const Event& event) { return event.t_s >= window->first && event.t_s <= window->second; });
  }
  std::vector<Metric> metrics;
  add_motion_metrics(graded, graded_events, context, metrics);
  add_force_metrics(graded, graded_events, context, metrics);
  add_count_metrics(graded_events, context, metrics);
  add_pose_metrics(graded_events, context, metrics);
  add_rest_metric(trace, events, metrics);
  add_grasp_metrics(graded, graded_events, context, metrics);
  assert(metrics.size() == metric_catalogue().size());
  return metrics;
}

}  // namespace trocar
