#include "scenarios/scoring/metrics.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace trocar {

namespace {

/// Where a metric is known to tell skill apart. What has none is a design choice, not yet compared with people.
constexpr const char* kTime =
    "separates experts from novices best: Cliff's delta -0.77, -0.99, -0.37 on three JIGSAWS tasks (102 trials); "
    "between surgeons ICC of one trial 0.35 to 0.53";
constexpr const char* kPath = "JIGSAWS: delta -0.67, -0.33, -0.03 between experts and novices; ICC 0.40 to 0.49";
constexpr const char* kRetreat =
    "as path; surgeons draw back before they approach, so the ideal way has a retract height (Chmarra, Surg Endosc, "
    "s00464-007-9526-z)";
constexpr const char* kPeaks =
    "of pace, least mixed up with time: ICC of the rate 0.75 to 0.89 on JIGSAWS; delta of the count -0.42 to -0.84";
constexpr const char* kSmooth =
    "JIGSAWS: over a whole trial it repeats the time (partial rho 0.15 to 0.32), SPARC even has the wrong sign on "
    "suturing; so it is taken per movement, is feedback and has no weight";
constexpr const char* kTremor =
    "physiological tremor lies at 8 to 12 Hz (Novak and Newell 2017); controllers and encoders make the same band: "
    "compare with rest_tremor_rms_m";
constexpr const char* kForce =
    "suturing in a box: experts 2.6 +- 0.4 N at most, 0.9 +- 0.3 N on average; novices 4.7 +- 1.3 and 2.1 +- 0.6 N "
    "(Horeman 2010, Surg Endosc 24:3102)";
constexpr const char* kGrip = "experienced surgeons grasp with 0.73 to 1.20 N (BMC Med Educ 2024, s12909-024-05155-1)";
constexpr const char* kToggles =
    "opening and closing of the grip: rho with ratings -0.34, -0.30, -0.43 on JIGSAWS, and it survives control for "
    "time";
constexpr const char* kHonest = "of the device and not of the hand: above 5 % the forces were not felt as they were";
constexpr const char* kErrors =
    "counted errors weigh far more than time in published simulators (MIST-VR; E-BLUS asks for none); which ones "
    "is a choice";

constexpr Direction kLess = Direction::kLess, kMore = Direction::kMore, kNeither = Direction::kNeither;
constexpr MetricDefinition kCatalogue[] = {
    {"time_s", "s", "from START to the end of the attempt", "t(end) - t(START)", kLess, kTime},
    {"path_m", "m", "length of the tip's path, filtered at 10 Hz and taken at 100 Hz", "sum |p(i+1) - p(i)|", kLess,
     kPath},
    {"path_x_m", "m", "sum of the tip's motion along x of the theatre", "sum |dx|", kLess, kPath},
    {"path_y_m", "m", "sum of the tip's motion along y of the theatre", "sum |dy|", kLess, kPath},
    {"path_z_m", "m", "sum of the tip's motion along z of the theatre", "sum |dz|", kLess, kPath},
    {"ideal_path_m", "m", "start to each held target in turn, withdrawing by the retract height between them",
     "sum over legs of up + across + down", kNeither},
    {"economy", "1", "ideal path / path", "ideal / path", kMore, kRetreat},
    {"path_ratio", "1", "path / ideal path", "path / ideal", kLess, kRetreat},
    {"depth_path_m", "m", "sum of the tip's motion along the shaft (depth perception)", "sum |dp . shaft|", kLess},
    {"angular_path_deg", "deg", "angle swept by the shaft, taken at 10 Hz", "sum of angles between shafts, at 10 Hz",
     kLess},
    {"speed_mean_mps", "m/s", "mean speed of the tip", "mean |v|", kNeither},
    {"speed_max_mps", "m/s", "highest speed of the tip", "max |v|", kNeither},
    {"speed_peaks", "1", "local maxima of the speed that stand out by at least 5 mm/s",
     "count of maxima of |v|, prominence >= 5 mm/s", kLess, kPeaks},
    {"speed_peak_rate_hz", "1/s", "speed peaks per second", "peaks / time", kLess, kPeaks},
    {"idle_share", "1", "share of time slower than 5 mm/s for at least 0.5 s",
     "time in runs >= 0.5 s of |v| < 5 mm/s / time", kLess},
    {"movements", "1", "stretches faster than 10 mm/s that last at least 0.5 s",
     "count of runs >= 0.5 s of |v| > 10 mm/s", kLess},
    {"sparc", "1", "spectral arc length of the speed, mean over movements; nearer 0 is smoother",
     "- arc length of |V(f)| / V(0) over f / fc, amplitude > 0.05, f <= 10 Hz", kMore, kSmooth},
    {"ldlj", "1", "log dimensionless jerk (6 Hz filter), mean over movements; nearer 0 is smoother",
     "-ln(D^3 / v_peak^2 sum |v''|^2 dt)", kMore, kSmooth},
    {"normalised_jerk", "1", "sqrt(T^5 / (2 L^2) x integral of squared jerk), mean over movements; 19.0 is ideal",
     "sqrt(T^5 / (2 A^2) sum |j|^2 dt)", kLess, kSmooth},
    {"tremor_rms_m", "m", "displacement of the tip between 8 and 12 Hz, RMS, unfiltered trace",
     "RMS of the displacement in 8 to 12 Hz", kLess, kTremor},
    {"tremor_share", "1", "velocity power between 8 and 12 Hz / above 0.3 Hz",
     "power of v in 8 to 12 Hz / above 0.3 Hz", kLess, kTremor},
    {"contact_time_s", "s", "time in contact with the tissue", "sum of contact dt", kNeither},
    {"force_max_n", "N", "largest contact force", "max |F|", kLess, kForce},
    {"force_mean_n", "N", "mean contact force over the time in contact", "sum |F| dt / contact time", kLess, kForce},
    {"force_rms_n", "N", "root mean square of the contact force over the time in contact",
     "sqrt(sum F^2 dt / contact time)", kLess, kForce},
    {"force_sd_n", "N", "standard deviation of the contact force over the time in contact",
     "sqrt(mean F^2 - (mean F)^2)", kLess, kForce},
    {"impulse_ns", "N s", "integral of the contact force", "sum |F| dt", kLess, kForce},
    {"impulse_max_ns", "N s", "integral of the contact force over the heaviest single contact",
     "max over contacts of sum |F| dt", kLess, kForce},
    {"force_volume_n3", "N^3", "ellipsoid of the standard deviations of the force along its principal axes",
     "4/3 pi s1 s2 s3 of the force cloud", kLess},
    {"soft_force_share", "1", "share of contact time above the soft force limit",
     "time with |F| > soft limit / contact time", kLess, kForce},
    {"soft_impulse_ns", "N s", "integral of the contact force beyond the soft force limit",
     "sum max(0, |F| - soft limit) dt over the time in contact", kLess, kForce},
    {"pressed_impulse_ns", "N s", "integral of the contact force over the time beyond the soft force limit",
     "sum |F| dt over the time in contact with |F| > soft limit", kLess, kForce},
    {"force_rate_max_n_per_s", "N/s", "steepest change of the contact force, filtered at 20 Hz",
     "max |dF/dt| after 20 Hz", kLess},
    {"in_band_share", "1", "share of the pressing time in which the force is in the wanted band",
     "time in band / time in windows, all objects together", kMore},
    {"object_in_band_share", "1",
     "time in the wanted band, up to that of one hold, over it and the time out of the band; mean over objects",
     "mean over objects of min(in, hold) / (min(in, hold) + out)", kMore},
    {"hard_force_share", "1", "share of the judged time in which the force is above the hard limit",
     "time with |F| > hard limit / time in windows, all objects together", kLess, kForce},
    {"grip_max_n", "N", "largest grip force", "max G", kLess, kGrip},
    {"grip_mean_n", "N", "mean grip force while gripping", "mean of G above 0.05 N", kNeither, kGrip},
    {"grip_in_band_share", "1", "share of the squeezing time in which the grip is in the wanted band",
     "time in band / time in window", kMore, kGrip},
    {"regrasps", "1", "grasps after the first", "grasps - 1; a grasp is G above 0.1 N until below 0.05 N", kLess,
     kToggles},
    {"commanded_max_n", "N", "largest contact force asked at the stylus (force scale and mapping applied)",
     "max |F| asked of the device", kNeither},
    {"commanded_mean_n", "N", "mean of it over the time in contact", "its mean over the contact time", kNeither},
    {"delivered_max_n", "N", "largest contact force that the device gave (limits, heat, passivity applied)",
     "max |F| given by it", kNeither},
    {"delivered_mean_n", "N", "mean of it over the time in contact", "its mean over the contact time", kNeither},
    {"room_share", "1", "share of the board region in which the device can give the soft force limit",
     "share of the region where the soft limit can be given", kNeither},
    {"saturated_contact_share", "1", "share of contact ticks in which the device could not give the force",
     "saturated contact ticks / contact ticks", kLess, kHonest},
    {"passivity_active_share", "1", "share of contact ticks in which the passivity law changed the force",
     "contact ticks with the passivity law at work / contact ticks", kNeither, kHonest},
    {"targets_held", "1", "targets held in the band for the wanted time", "count of different TARGET_HELD", kMore},
    {"objects_done_share", "1", "objects done / objects of the exercise", "objects done / all objects", kMore},
    {"wrong_places", "1", "contacts that began outside the lit target", "count of WRONG_PLACE", kLess, kErrors},
    {"excess_events", "1", "times that contact or grip went above its hard limit",
     "count of EXCESS_FORCE and GRIP_EXCESS", kLess, kErrors},
    {"critical_events", "1", "events of critical severity", "count of events of critical severity", kLess, kErrors},
    {"tool_collisions", "1", "times that the shaft pressed on the tissue", "count of TOOL_COLLISION", kLess, kErrors},
    {"clutches", "1", "times that the clutch was pressed", "count of CLUTCH", kNeither},
    {"matched_in_time_share", "1", "targets held before their time ran out / all objects",
     "held without TARGET_TIMEOUT / all objects", kMore},
    {"position_error_m", "m", "distance of the tip from the wanted place, second half of the hold, mean over targets",
     "mean of POSITION_ERROR", kLess},
    {"angle_error_deg", "deg", "turn between instrument and wanted pose, roll included, over the same time",
     "mean of ANGLE_ERROR", kLess},
    {"target_timeouts", "1", "targets that were not done in their time", "count of TARGET_TIMEOUT", kLess},
    {"device_limits", "1", "times that the device could not give the force", "count of DEVICE_LIMIT", kNeither,
     kHonest},
    {"rest_tremor_rms_m", "m", "displacement between 8 and 12 Hz in the second before START: the baseline of tremor",
     "tremor_rms_m over the 1.02 s before START", kNeither, kTremor},
    {"grip_window_share", "1", "share of the time blocks are carried in which the grip lies in the block's window",
     "carrying time in the window / carrying time, all blocks together", kMore, kGrip},
    {"object_grip_window_share", "1",
     "carrying time in the block's window, up to that of a quick carry, over it and the time out; mean over blocks",
     "mean over blocks of min(in, 3 s) / (min(in, 3 s) + out)", kMore, kGrip},
    {"crushed", "1", "blocks crushed", "count of CRUSH", kLess, kErrors},
    {"block_regrasps", "1", "times that a block was grasped again", "count of REGRASP", kLess, kToggles},
    {"slips", "1", "times that a carried block slid through the jaws", "count of SLIP", kLess, kErrors},
    {"drops", "1", "times that a block fell", "count of DROP", kLess, kErrors},
    {"misplaced", "1", "times that a carried block was set down outside its ring", "count of MISPLACED", kLess,
     kErrors},
    {"time_to_expose_s", "s", "until tissue is lifted far enough to show what lies behind it, mean over places",
     "mean of the first EXPOSED of each object", kLess, kTime},
    {"holds_lost", "1", "times that lifted tissue slid, was let go too early or sank back",
     "count of SLIP, LET_GO and COVERED", kLess, kErrors},
    {"right_answers_share", "1", "symbols read beneath the flap and told rightly / all",
     "count of different ANSWERED / all objects", kMore, kErrors},
    {"time_per_target_s", "s", "time of the run / spheres held (camera navigation)",
     "(t(end) - t(START)) / objects done", kLess, kTime},
    {"horizon_share", "1",
     "time with a level picture, up to that of a quick hand, over it and the time without; mean over spheres",
     "mean over objects of the last HORIZON_KEPT", kMore},
    {"horizon_losses", "1", "times that the picture stayed rolled too far", "count of HORIZON_LOST", kLess, kErrors},
    {"wall_contacts", "1", "times that the lens touched a cup or the plate", "count of WALL_CONTACT", kLess, kErrors},
    {"view_jerks", "1", "peaks of the lit sphere's speed in the picture, while it is lit; mean over spheres",
     "mean over objects of the last VIEW_JERKS", kLess},
    {"wire_touch_share", "1",
     "time in which the ring touches the wire at a gate, over that of an unhurried way there, 1 at most; mean over "
     "gates",
     "mean over gates of min(1, touching / unhurried)", kLess, kErrors},
    {"wire_touches", "1", "times that the ring touched the wire for longer than 20 ms", "count of WIRE_TOUCHED", kLess,
     kErrors},
    {"ring_angle_deg", "deg", "angle between the ring's normal and the wire, mean over the wire passed",
     "mean of ANGLE_ERROR", kLess},
    {"touches_times_time_s", "s", "touches of the wire times the time: what haste gains by touching it does not lower",
     "wire_touches x time_s", kLess, kErrors},
    {"nodules_found", "1", "hidden nodules that were marked", "count of NODULE_FOUND", kMore},
    {"false_marks", "1", "marks where no nodule is", "count of FALSE_MARK", kLess, kErrors},
    {"search_share", "1", "nodules found less false marks / all nodules",
     "(count of NODULE_FOUND - count of FALSE_MARK) / all objects", kMore},
    {"localisation_error_m", "m", "distance of a right mark from its nodule along the surface, mean over them",
     "mean of NODULE_FOUND", kLess},
    {"pressed_well_share", "1", "share of the region whose first press had the wanted force at its most",
     "sum of PLACE_PRESSED in band", kMore},
    {"searched_share", "1", "share of the region that was pressed", "value of SEARCH_ENDED", kMore},
    {"bumps", "1", "times that a ring came down on a peg too far from its middle", "count of BUMP", kLess, kErrors},
    {"grip_marks", "1", "times that a carried ring was held so tightly that it was marked", "count of GRIP_EXCESS",
     kLess, kErrors},
    {"transfer_errors", "1", "rings that fell, and half of the bumps against pegs", "count of DROP + count of BUMP / 2",
     kLess, kErrors},
    {"time_left_less_lost_s", "s",
     "time left once all rings are moved, less 100 s when all were lost; not an FLS score",
     "max(0, limit - time - 100 lost / rings)", kMore, kTime},
    {"clips_correct_share", "1", "clips that are on as they should be, of the six asked for",
     "places of CLIP_SET without a later CLIP_WASTED / 6", kMore, kErrors},
    {"clips_wasted", "1", "clips that do not count or came off, and closings that set none", "count of CLIP_WASTED",
     kLess, kErrors},
    {"clip_errors", "1", "clips wasted, wrong structures touched, cuts too near to a clip",
     "count of CLIP_WASTED, WRONG_STRUCTURE and DIVIDED that is not info", kLess, kErrors},
    {"clip_angle_deg", "deg", "how far a clip that counts lies off straight across, mean over these clips",
     "mean of CLIP_SET", kLess},
    {"cut_off_middle_m", "m", "distance of a cut from the middle between the clips beside it, mean over structures",
     "mean of DIVIDED", kLess},
    {"entry_error_m", "m",
     "distance from the dot to where the needle went in, mean over the bites of a pair, then over pairs",
     "mean over objects of the mean of BITE_BEGUN", kLess, kErrors},
    {"exit_error_m", "m",
     "distance from the dot to where the needle came out, mean over the bites of a pair, then over pairs",
     "mean over objects of the mean of BITE_THROUGH", kLess, kErrors},
    {"needle_angle_deg", "deg",
     "how far the needle's way in lies off that of its circle through both dots, and its point's way through the "
     "tissue off its own direction, together; mean over pairs drawn through",
     "mean of NEEDLE_DRAWN", kLess},
    {"needle_redos", "1", "needles grasped again or at the wrong place, bites undone, needles dropped",
     "count of NEEDLE_GRIPPED that is not info + count of BITE_UNDONE + count of NEEDLE_LOST", kLess, kErrors},
    {"safe_energy_share", "1",
     "safe current over safe and unsafe, mean over strands and vessels; an object without any has 0",
     "mean over objects of CURRENT_USED / (CURRENT_USED + UNSAFE_CURRENT)", kMore, kErrors},
    {"strands_lifted_share", "1", "strands that were parted by current while lifted high enough, of those asked for",
     "count of STRAND_DIVIDED that is info / strands asked for", kMore, kErrors},
    {"strand_clearance_share", "1",
     "how far off the organ strands were when current parted them, over how far is asked for, at most 1 each; mean of "
     "those asked for, 0 for one that tore",
     "sum of min(1, STRAND_DIVIDED that is not major / lift asked for) / strands asked for", kMore, kErrors},
    {"spurted_ml", "mL", "blood lost by all vessels that spurted, as last told",
     "the last of SPURTS, BLEEDING and SEALED, once there is a SPURTS", kLess, kErrors},
    {"strand_current_s", "s", "time of the pedal while a strand was lit, mean over the strands that current parted",
     "pedal from START to SPURTS / strands divided", kLess},
    {"sealed_late", "1", "vessels that bled for longer than they should", "count of SEALED_LATE", kLess, kErrors},
    {"cut_area_share", "1", "area between cut and line, of what the line encloses; of several cuts the one further off",
     "sum of SNIP", kLess, kErrors},
    {"cut_outside_share", "1", "length cut outside the band about the line, of the line's, 1 at most",
     "min(1, sum of OFF_LINE)", kLess, kErrors},
    {"hard_pulls", "1", "times that the gauze was pulled or pressed too hard", "count of PULLED_HARD", kLess, kErrors},
    {"snips", "1", "closings of the scissors that cut gauze", "count of SNIP", kNeither},
};

// Of force though their unit does not say so; all others of force are in newtons.
constexpr std::string_view kForceShares[] = {"soft_force_share",
                                             "in_band_share",
                                             "object_in_band_share",
                                             "grip_in_band_share",
                                             "excess_events",
                                             "grip_window_share",
                                             "object_grip_window_share",
                                             "crushed",
                                             "hard_force_share",
                                             "grip_marks",
                                             "hard_pulls"};

}  // namespace

const std::vector<MetricDefinition>& metric_catalogue() {
  static const std::vector<MetricDefinition> catalogue(std::begin(kCatalogue), std::end(kCatalogue));
  return catalogue;
}

std::string stage_metric(std::string_view stage, std::string_view metric) {
  return std::string(stage) + "/" + std::string(metric);
}

std::string_view plain_metric(std::string_view name) { return name.substr(name.rfind('/') + 1); }

const MetricDefinition* find_metric(std::string_view name) {
  name = plain_metric(name);
  for (const MetricDefinition& definition : metric_catalogue()) {
    if (definition.name == name) return &definition;
  }
  return nullptr;
}

bool is_force_metric(std::string_view name) {
  const MetricDefinition* metric = find_metric(name);
  if (metric && metric->unit.starts_with('N')) return true;
  return std::find(std::begin(kForceShares), std::end(kForceShares), plain_metric(name)) != std::end(kForceShares);
}

Trace cut_trace(const Trace& trace, double start_s, double end_s) {
  Trace cut;
  cut.rate_hz = trace.rate_hz;
  cut.samples.reserve(trace.samples.size());
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

std::vector<Event> events_of_stage(const std::vector<Event>& events, int stage, int first_object, int objects) {
  std::vector<Event> out;
  bool over = false;
  for (const Event& event : events) {
    const bool begins = event.type == event_type::kStageBegun;
    const bool ends = event.type == event_type::kDone || event.type == event_type::kTimeout;
    if (out.empty() && !(begins && event.object == stage)) continue;
    Event own = event;
    if (event.object >= 0) own.object -= first_object;
    if (own.object < 0 || own.object >= objects) own.object = -1;
    if (over && (event.type != event_type::kClipWasted || own.object < 0)) continue;
    if (over) {
      own.t_s = out.back().t_s;
      out.insert(out.end() - 1, own);
      continue;
    }
    if (out.empty()) own.type = event_type::kStart.name;
    if (begins && !out.empty()) own.type = event_type::kDone.name;
    if (begins) own.object = -1;
    out.push_back(own);
    over = out.size() > 1 && (begins || ends);
  }
  return out;
}

namespace {

void add_stage_metrics(const Trace& trace, const std::vector<Event>& events, const ScoringContext& stage, int index,
                       MetricSink& sink) {
  const std::vector<Event> own = events_of_stage(events, index, stage.first_object, stage.objects_total);
  const std::vector<Metric> all = own.empty() ? std::vector<Metric>{} : compute_metrics(trace, own, stage);
  for (const std::string& name : stage.stage_metrics) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Metric& metric) { return metric.name == name; });
    const MetricDefinition* known = find_metric(name);
    sink.push_back({stage_metric(stage.stage, name), found == all.end() ? std::nullopt : found->value,
                    known ? std::string(known->unit) : ""});
  }
}

}  // namespace

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
  add_retract_metrics(graded_events, metrics);
  add_find_metrics(graded_events, context, metrics);
  add_camera_metrics(graded, graded_events, context, metrics);
  add_wire_metrics(graded, graded_events, context, metrics);
  add_palpate_metrics(graded_events, context, metrics);
  add_pegs_metrics(graded_events, context,
                   window ? std::optional<double>(window->second - window->first) : std::nullopt, metrics);
  add_clip_metrics(graded_events, metrics);
  add_needle_metrics(graded_events, metrics);
  add_dissect_metrics(graded, graded_events, context, metrics);
  add_gauze_metrics(graded_events, metrics);
  assert(metrics.size() == metric_catalogue().size());
  for (std::size_t i = 0; i < context.stages.size(); ++i)
    add_stage_metrics(trace, events, context.stages[i], static_cast<int>(i), metrics);
  return metrics;
}

}  // namespace trocar
