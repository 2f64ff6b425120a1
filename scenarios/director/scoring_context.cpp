#include "scenarios/director/scoring_context.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

struct NumberField {
  const char* key;
  double ScoringContext::*member;
};
constexpr NumberField kNumbers[] = {{"time_limit_s", &ScoringContext::time_limit_s},
                                    {"band_low_n", &ScoringContext::band_low_n},
                                    {"band_high_n", &ScoringContext::band_high_n},
                                    {"soft_force_n", &ScoringContext::soft_force_n},
                                    {"hard_force_n", &ScoringContext::hard_force_n},
                                    {"critical_force_n", &ScoringContext::critical_force_n},
                                    {"grip_low_n", &ScoringContext::grip_low_n},
                                    {"grip_high_n", &ScoringContext::grip_high_n},
                                    {"retract_height_m", &ScoringContext::retract_height_m}};

constexpr AttemptStatus kStatuses[] = {AttemptStatus::kCompleted, AttemptStatus::kTimeout, AttemptStatus::kAborted,
                                       AttemptStatus::kFault, AttemptStatus::kVoid};

Json to_json(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Vec3 vector_from(const Json& json) {
  if (!json.is_array() || json.size() != 3) throw std::invalid_argument("a point must be an array of three numbers");
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

AttemptStatus status_from(const std::string& name) {
  for (const AttemptStatus status : kStatuses) {
    if (name == status_name(status)) return status;
  }
  throw std::invalid_argument("unknown outcome '" + name + "'");
}

void require_finite(const ScoringContext& context) {
  bool finite = context.approach_T.allFinite();
  for (const auto& [key, member] : kNumbers) finite = finite && std::isfinite(context.*member);
  finite = finite && std::isfinite(context.room_share.value_or(0)) && std::isfinite(context.counted_hold_s) &&
           std::isfinite(context.rise_s) && std::isfinite(context.strand_lift_m) && context.strand_lift_m > 0;
  for (const Vec3& point : context.waypoints) finite = finite && point.allFinite();
  for (const ObjectBand& band : context.object_bands)
    finite = finite && std::isfinite(band.low_n) && std::isfinite(band.high_n);
  for (const auto& [low, high] : context.grip_windows) finite = finite && std::isfinite(low) && std::isfinite(high);
  if (!finite)
    throw std::invalid_argument("scoring context holds a number that is not finite, or a lift of strands of 0");
}

}  // namespace

void account_held_targets(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  std::set<std::int32_t> done;
  for (const Event& event : events) {
    if (event.type != event_type::kTargetHeld || !done.insert(event.object).second) continue;
    const auto index = static_cast<std::size_t>(event.object);
    if (event.object >= 0 && index < board.targets.size()) context.waypoints.push_back(board.targets[index].centre_T);
  }
  context.objects_total = static_cast<int>(board.targets.size());
  context.objects_done = static_cast<int>(done.size());
}

ScoringContext scoring_context(const Exercise& exercise, const ExerciseLevel& level, const Board& board,
                               const std::vector<Event>& events, AttemptStatus outcome) {
  ScoringContext context;
  context.outcome = outcome;
  context.time_limit_s = exercise.time_limit_s;
  context.band_low_n = level.band_low_n;
  context.band_high_n = level.band_high_n;
  if (level.bands.size() > 1) {
    for (const Target& target : board.targets) context.object_bands.push_back({target.band.low_n, target.band.high_n});
  }
  context.soft_force_n = exercise.soft_force_n;
  context.hard_force_n = exercise.hard_force_n;
  context.critical_force_n = exercise.critical_force_n;
  context.grip_low_n = exercise.grip.low_n;
  context.grip_high_n = exercise.grip.high_n;
  context.counted_hold_s = exercise.counted_hold_s;
  context.rise_s = exercise.rise_s;
  context.retract_height_m = exercise.retract_height_m;
  context.waypoints.push_back(board.start_T);
  kind_of(exercise).account(board, events, context);
  kind_of(exercise).account_rules(exercise, context);
  for (std::size_t i = 0; i < exercise.stages.size(); ++i) {
    const Board& own = board.stages[i];
    const auto targets = static_cast<int>(own.targets.size());
    ScoringContext stage =
        scoring_context(*exercise.stages[i].exercise, level.stages[i], own,
                        events_of_stage(events, static_cast<int>(i), context.objects_total, targets), outcome);
    stage.stage = exercise.stages[i].name;
    stage.first_object = context.objects_total;
    const std::string prefix = stage_metric(stage.stage, "");
    for (const SubscoreRule& rule : level.rubric.subscores)
      if (rule.metric.starts_with(prefix)) stage.stage_metrics.emplace_back(plain_metric(rule.metric));
    context.waypoints.insert(context.waypoints.end(), stage.waypoints.begin() + 1, stage.waypoints.end());
    context.objects_total += stage.objects_total;
    context.objects_done += stage.objects_done;
    context.stages.push_back(std::move(stage));
  }
  return context;
}

namespace {

Json json_of(const ScoringContext& context) {
  require_finite(context);
  Json json;
  json["outcome"] = status_name(context.outcome);
  for (const auto& [key, member] : kNumbers) json[key] = context.*member;
  json["approach"] = to_json(context.approach_T);
  json["waypoints"] = Json::array();
  for (const Vec3& point : context.waypoints) json["waypoints"].push_back(to_json(point));
  if (!context.object_bands.empty()) json["object_bands"] = Json::array();
  for (const ObjectBand& band : context.object_bands) json["object_bands"].push_back({band.low_n, band.high_n});
  if (!context.grip_windows.empty()) json["grip_windows"] = Json::array();
  for (const auto& [low, high] : context.grip_windows) json["grip_windows"].push_back({low, high});
  json["counted_hold_s"] = context.counted_hold_s;
  if (context.rise_s != ScoringContext{}.rise_s) json["rise_s"] = context.rise_s;
  json["objects_total"] = context.objects_total;
  json["objects_done"] = context.objects_done;
  if (context.ring_on_wire) json["ring_on_wire"] = true;
  if (context.room_share) json["room_share"] = *context.room_share;
  if (context.strands_total != ScoringContext{}.strands_total) json["strands_total"] = context.strands_total;
  if (context.strand_lift_m != ScoringContext{}.strand_lift_m) json["strand_lift_m"] = context.strand_lift_m;
  if (!context.stages.empty()) json["stages"] = Json::array();
  for (const ScoringContext& stage : context.stages) {
    Json own = json_of(stage);
    own["stage"] = stage.stage;
    own["first_object"] = stage.first_object;
    own["stage_metrics"] = stage.stage_metrics;
    json["stages"].push_back(std::move(own));
  }
  return json;
}

ScoringContext context_of(const Json& json) {
  ScoringContext context;
  context.outcome = status_from(json.at("outcome").get<std::string>());
  for (const auto& [key, member] : kNumbers) context.*member = json.at(key).get<double>();
  context.approach_T = vector_from(json.at("approach"));
  for (const Json& point : json.at("waypoints")) context.waypoints.push_back(vector_from(point));
  for (const Json& band : json.value("object_bands", Json::array()))
    context.object_bands.push_back({band.at(0).get<double>(), band.at(1).get<double>()});
  for (const Json& window : json.value("grip_windows", Json::array()))
    context.grip_windows.push_back({window.at(0).get<double>(), window.at(1).get<double>()});
  context.counted_hold_s = json.value("counted_hold_s", 0.0);
  context.rise_s = json.value("rise_s", context.rise_s);
  context.objects_total = json.at("objects_total").get<int>();
  context.objects_done = json.at("objects_done").get<int>();
  context.ring_on_wire = json.value("ring_on_wire", false);
  if (json.contains("room_share")) context.room_share = json.at("room_share").get<double>();
  context.strands_total = json.value("strands_total", context.strands_total);
  context.strand_lift_m = json.value("strand_lift_m", context.strand_lift_m);
  for (const Json& own : json.value("stages", Json::array())) {
    context.stages.push_back(context_of(own));
    ScoringContext& stage = context.stages.back();
    stage.stage = own.at("stage").get<std::string>();
    stage.first_object = own.at("first_object").get<int>();
    stage.stage_metrics = own.at("stage_metrics").get<std::vector<std::string>>();
  }
  require_finite(context);
  return context;
}

}  // namespace

std::string scoring_context_json(const ScoringContext& context) { return json_of(context).dump(); }

ScoringContext parse_scoring_context(const std::string& text, const std::string& name) {
  try {
    return context_of(Json::parse(text));
  } catch (const std::exception& error) {
    throw InputError(name + ": " + error.what());
  }
}

}  // namespace trocar
