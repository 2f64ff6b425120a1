#include "scenarios/files/level_reader.h"

#include <algorithm>
#include <cmath>

#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

const std::vector<std::string> kLevelNames{"L1", "L2", "L3", "exam"};

void read_mapping(StrictTable& table, bool derived, ExerciseLevel& level) {
  const std::string before = mapping_name(level.mapping);
  const std::vector<std::string> known{"direct", "fulcrum"};
  const std::string mapping = derived ? table.choice_or("mapping", known, before) : table.choice("mapping", known);
  level.mapping = mapping == "direct" ? Mapping::kDirect : Mapping::kFulcrum;
  const bool inherits = derived && before == mapping;
  if (level.mapping == Mapping::kDirect) {
    for (const char* key : {"port_mm", "instrument_mm"}) {
      if (table.has(key)) table.fail(key, std::string("'") + key + "' needs mapping = \"fulcrum\"");
    }
    level.port_m = Vec3::Zero();
  } else {
    level.port_m = kMilli * (inherits ? table.vector_or("port_mm", -500, 500, level.port_m / kMilli)
                                      : table.vector("port_mm", -500, 500));
    if (level.port_m.z() < 0.020) table.fail("port_mm", "'port_mm' must lie at least 20 mm above the region's centre");
    level.instrument_length_m = kMilli * table.number_or("instrument_mm", 100, 600, level.instrument_length_m / kMilli);
    if (level.port_m.norm() + 0.020 > level.instrument_length_m)
      table.fail("port_mm", "'port_mm': the instrument is too short, its handle would be in the port");
  }
  LevelKeys{table, derived}.number("motion_scale", 0.1, 10, 1, level.motion_scale);
  table.allow("force_scale");
  if (!derived || table.has("force_scale"))
    level.force_scale = table.number_or_word("force_scale", 0.01, 1, "auto", -1);
}

void read_feedback(StrictTable& table, bool derived, ExerciseLevel& level) {
  const std::vector<std::string> known{"always", "band", "after"};
  level.force_display =
      derived ? table.choice_or("force_display", known, level.force_display) : table.choice("force_display", known);
  level.guides = table.flag_or("guides", level.guides);
  level.exam = level.name == "exam";
  if (level.exam && level.force_display != "after")
    table.fail("force_display", "an exam shows no force: 'force_display' must be \"after\"");
}

/// [[levels.anchors]]: the rubric's own stand for every sub-score that is not named.
void read_anchors(StrictTable& table, const std::vector<std::string>& subscores, ExerciseLevel& level) {
  table.allow("anchors");
  if (!table.has("anchors")) return;
  level.anchors.clear();
  for (StrictTable& row : table.tables("anchors")) {
    const LevelAnchors anchors{row.choice("subscore", subscores), row.number("full_at", -1e6, 1e6),
                               row.number("zero_at", -1e6, 1e6)};
    if (anchors.full_at == anchors.zero_at) row.fail("zero_at", "'full_at' equals 'zero_at'");
    row.finish();
    level.anchors.push_back(anchors);
  }
}

ExerciseLevel read_level(StrictTable& table, const std::vector<std::string>& subscores, const Exercise& exercise) {
  ExerciseLevel level;
  level.time_limit_s = exercise.time_limit_s;
  const std::string name = table.choice("name", kLevelNames);
  const bool derived = table.has("like");
  for (const ExerciseLevel& other : exercise.levels) {
    if (other.name == name) table.fail("name", "level '" + name + "' stands twice");
  }
  if (derived) {
    std::vector<std::string> above;
    for (const ExerciseLevel& other : exercise.levels) above.push_back(other.name);
    if (above.empty()) table.fail("like", "'like' names a level above this one, and this is the first");
    const std::string model = table.choice("like", above);
    level = *std::find_if(exercise.levels.begin(), exercise.levels.end(),
                          [&](const ExerciseLevel& other) { return other.name == model; });
  }
  level.name = name;
  read_mapping(table, derived, level);
  read_feedback(table, derived, level);
  LevelKeys keys{table, derived};
  kind_of(exercise).read_level(keys, exercise, level);
  read_anchors(table, subscores, level);
  level.time_limit_s = table.number_or("time_limit_s", 1, 3600, level.time_limit_s);
  level.expert_time_s = table.number_or("expert_time_s", 1, 3600, level.expert_time_s);
  level.pointer.glide = table.flag_or("pointer_glide", level.pointer.glide);
  level.pointer.expert_time_s = table.number_or("pointer_time_s", 1, 3600, level.pointer.expert_time_s);
  table.finish();
  return level;
}

/// A measure in which an anchor may be written: "full_at_expert_times = 0.7".
struct AnchorUnit {
  const char* suffix;
  double value;  ///< in the metric's unit; 0: the level has none
  const char* missing;
};

double anchor(StrictTable& table, const std::string& key, const std::vector<AnchorUnit>& units) {
  for (const AnchorUnit& unit : units) {
    const std::string scaled = key + unit.suffix;
    if (!table.has(scaled)) continue;
    if (table.has(key)) table.fail(scaled, "'" + scaled + "' and '" + key + "' exclude each other");
    if (unit.value <= 0) table.fail(scaled, "'" + scaled + "' needs " + unit.missing);
    return table.number(scaled, 0, 100) * unit.value;
  }
  return table.number(key, -1e6, 1e6);
}

SubscoreRule read_rule(StrictTable table, const Exercise& exercise, const std::vector<AnchorUnit>& units) {
  SubscoreRule rule;
  rule.name = table.text("name");
  rule.metric = table.choice("metric", metric_names(exercise));
  rule.weight = table.number("weight", 0, 1);
  rule.gate = table.flag_or("gate", false);
  rule.gate_below = table.number_or("gate_below", 0, 1, 0.5);
  rule.full_at = anchor(table, "full_at", units);
  rule.zero_at = anchor(table, "zero_at", units);
  if (rule.full_at == rule.zero_at) table.fail("metric", "sub-score '" + rule.name + "': 'full_at' equals 'zero_at'");
  table.finish();
  return rule;
}

}  // namespace

std::vector<std::string> metric_names(const Exercise& exercise) {
  std::vector<std::string> names;
  for (const MetricDefinition& definition : metric_catalogue()) {
    names.emplace_back(definition.name);
    for (const ExerciseStage& stage : exercise.stages) names.push_back(stage_metric(stage.name, definition.name));
  }
  return names;
}

Rubric read_rubric(StrictTable table, const Exercise& exercise, const ExerciseLevel& level) {
  Rubric rubric;
  const double own_time_s = table.number_or("expert_time_s", 1, 3600, 0);
  rubric.pass_at = table.number("pass_at", 0, 100);
  rubric.proficient_at = table.number("proficient_at", rubric.pass_at, 100);
  rubric.expert_at = table.number("expert_at", rubric.proficient_at, 100);
  rubric.gate_cap = table.number("gate_cap", 0, rubric.pass_at);
  rubric.critical_cap = table.number("critical_cap", 0, rubric.pass_at);
  rubric.unfinished_cap = table.number("unfinished_cap", 0, rubric.pass_at);
  if (table.has("caps"))
    rubric.caps_scale = table.choice("caps", {"cut", "scale"}) == "scale";
  else
    table.allow("caps");
  const std::vector<AnchorUnit> units{
      {"_expert_times", level.expert_time_s > 0 ? level.expert_time_s : own_time_s,
       "'expert_time_s' in every level or in [rubric]"},
      {"_position_tolerances", level.position_tolerance_m, "a level with 'position_tolerance_mm'"},
      {"_angle_tolerances", level.angle_tolerance_rad / kDegrees, "a level with 'angle_tolerance_deg'"}};
  double sum = 0;
  for (StrictTable& rule : table.tables("subscores")) {
    rubric.subscores.push_back(read_rule(rule, exercise, units));
    SubscoreRule& read = rubric.subscores.back();
    for (const LevelAnchors& other : level.anchors) {
      if (other.subscore != read.name) continue;
      read.full_at = other.full_at;
      read.zero_at = other.zero_at;
    }
    sum += read.weight;
  }
  if (std::abs(sum - 1) > 1e-9)
    table.fail("subscores", "weights of the sub-scores sum to " + std::to_string(sum) + ", not to 1");
  table.finish();
  return rubric;
}

void read_levels(StrictTable& document, Exercise& exercise) {
  std::vector<std::string> subscores;
  for (StrictTable& rule : document.table("rubric").tables("subscores")) subscores.push_back(rule.text("name"));
  for (StrictTable& table : document.tables("levels"))
    exercise.levels.push_back(read_level(table, subscores, exercise));
}

}  // namespace trocar
