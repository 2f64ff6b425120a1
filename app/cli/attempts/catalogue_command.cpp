#include "app/cli/attempts/catalogue_command.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/attempt_json.h"
#include "app/cli/command.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/trace_filter.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

Json level_json(const ExerciseLevel& level) {
  Json json = {{"name", level.name},
               {"mapping", mapping_name(level.mapping)},
               {"motion_scale", level.motion_scale},
               {"force_scale", level.force_scale > 0 ? Json(level.force_scale) : Json("auto")},
               {"force_display", level.force_display},
               {"guides", level.guides},
               {"exam", level.exam},
               {"time_limit_s", level.time_limit_s},
               {"expert_time_s", level.expert_time_s}};
  if (level.mapping == Mapping::kFulcrum) json["port_m"] = {level.port_m.x(), level.port_m.y(), level.port_m.z()};
  for (const WantedForce& band : level.bands) json["bands_n"].push_back({band.low_n, band.high_n});
  if (level.position_tolerance_m > 0) {
    json["position_tolerance_m"] = level.position_tolerance_m;
    json["angle_tolerance_rad"] = level.angle_tolerance_rad;
  }
  json["rubric"] = Json::parse(rubric_json(level.rubric));
  return json;
}

Json exercise_json(const Exercise& exercise) {
  Json levels = Json::array();
  for (const ExerciseLevel& level : exercise.levels) levels.push_back(level_json(level));
  return {{"id", exercise.id},
          {"number", exercise.number},
          {"kind", kind_of(exercise).name},
          {"version", exercise.version},
          {"title", exercise.title},
          {"goal", exercise.goal},
          {"objects", exercise.layout.count},
          {"time_limit_s", exercise.time_limit_s},
          {"force_n",
           {{"soft", exercise.soft_force_n}, {"hard", exercise.hard_force_n}, {"critical", exercise.critical_force_n}}},
          {"pass_at", exercise.rubric.pass_at},
          {"levels", levels},
          {"filter", kFilterId},
          {"rubric_sha256", exercise.rubric.sha256},
          {"file", exercise.file.filename().string()}};
}

void list_exercise(const Exercise& exercise, std::ostream& out) {
  out << exercise.number << "  " << std::left << std::setw(18) << exercise.id << exercise.title << "\n     "
      << exercise.goal << '\n';
  for (const ExerciseLevel& level : exercise.levels) {
    out << "     " << std::setw(6) << level.name << mapping_name(level.mapping)
        << ", force shown: " << level.force_display << ", " << level.time_limit_s << " s";
    for (const WantedForce& band : level.bands) out << ", " << band.low_n << "-" << band.high_n << " N";
    if (level.position_tolerance_m > 0)
      out << ", " << 1e3 * level.position_tolerance_m << " mm, " << level.angle_tolerance_rad * 180 / M_PI << " deg";
    out << '\n';
  }
}

void explain_rule(const SubscoreRule& rule, std::ostream& out) {
  const MetricDefinition* metric = find_metric(rule.metric);
  const std::string unit(metric ? metric->unit : "");
  out << "  " << std::left << std::setw(15) << rule.name << " weight " << rule.weight << ", " << rule.metric
      << ": full at " << rule.full_at << ' ' << unit << ", none at " << rule.zero_at << ' ' << unit;
  if (rule.gate) out << "; safety gate below " << rule.gate_below;
  out << '\n';
}

void explain_exercise(const Exercise& exercise, std::ostream& out) {
  list_exercise(exercise, out);
  for (const ExerciseLevel& level : exercise.levels) {
    out << exercise.id << ' ' << level.name << ": S = 100 x sum of weight x clamp((x - none) / (full - none), 0, 1)\n";
    for (const SubscoreRule& rule : level.rubric.subscores) explain_rule(rule, out);
    out << "  caps" << (level.rubric.caps_scale ? " (hundredths left of S): " : ": ") << level.rubric.gate_cap
        << " safety gate, " << level.rubric.critical_cap << " critical event, " << level.rubric.unfinished_cap
        << " x share done when time runs out; pass from " << level.rubric.pass_at << '\n';
  }
  out << "rubric " << exercise.rubric.sha256
      << " (the file's SHA-256; the origin of each number stands in its comments: " << exercise.file.filename().string()
      << ")\n";
}

/// Every use of a sub-score by this name. @return false when there is none.
bool explain_subscore(const std::vector<Exercise>& exercises, const std::string& name, std::ostream& out) {
  bool found = false;
  for (const Exercise& exercise : exercises) {
    for (const ExerciseLevel& level : exercise.levels) {
      for (const SubscoreRule& rule : level.rubric.subscores) {
        if (rule.name != name) continue;
        found = true;
        out << exercise.id << ' ' << level.name << '\n';
        explain_rule(rule, out);
      }
    }
  }
  return found;
}

void explain_metric(const MetricDefinition& metric, const std::vector<Exercise>& exercises, std::ostream& out) {
  constexpr const char* kBetter[] = {"less is better", "more is better", "neither more nor less is better by itself"};
  out << metric.name << " [" << metric.unit << "]: " << metric.meaning << "\n  formula   " << metric.formula
      << "\n  direction " << kBetter[static_cast<std::size_t>(metric.better)] << "\n  evidence  " << metric.evidence
      << "\n  filter    " << kFilterId << '\n';
  bool graded = false;
  for (const Exercise& exercise : exercises) {
    for (const ExerciseLevel& level : exercise.levels) {
      for (const SubscoreRule& rule : level.rubric.subscores) {
        if (plain_metric(rule.metric) != metric.name) continue;
        graded = true;
        out << exercise.id << ' ' << level.name << '\n';
        explain_rule(rule, out);
      }
    }
  }
  if (!graded) out << "no shipped rubric grades it\n";
}

void explain(const std::string& name, const std::vector<Exercise>& exercises, std::ostream& out) {
  if (const MetricDefinition* metric = find_metric(name)) return explain_metric(*metric, exercises, out);
  std::vector<std::string> known;
  for (const Exercise& exercise : exercises) {
    if (is_named(exercise, name)) return explain_exercise(exercise, out);
    known.push_back(exercise.id);
    for (const SubscoreRule& rule : exercise.rubric.subscores)
      if (std::find(known.begin(), known.end(), rule.name) == known.end()) known.push_back(rule.name);
  }
  if (explain_subscore(exercises, name, out)) return;
  for (const MetricDefinition& metric : metric_catalogue()) known.emplace_back(metric.name);
  const std::string near = nearest_word(name, known);
  throw InputError("--explain " + name + ": unknown metric, exercise or sub-score; known are " + joined(known) +
                   (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace

int exercises_command(const ExercisesOptions& options, std::ostream& out, std::ostream&) {
  const std::vector<Exercise> exercises = list_exercises(find_assets().exercises);
  if (!options.explain.empty()) {
    explain(options.explain, exercises, out);
    return 0;
  }
  Json json = Json::array();
  for (const Exercise& exercise : exercises) {
    if (options.json)
      json.push_back(exercise_json(exercise));
    else
      list_exercise(exercise, out);
  }
  if (options.json) out << json.dump(2) << '\n';
  return 0;
}

void add_exercises(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ExercisesOptions>();
  ExercisesOptions& o = *given;
  CLI::App* exercises = add_command(parent, "exercises", "The catalogue of exercises", chosen,
                                    [given] { return exercises_command(*given, std::cout, std::cerr); });
  exercises->add_flag("--json", o.json, "As JSON");
  exercises->add_option("--explain", o.explain, "Explain a metric, an exercise or a sub-score");
}

}  // namespace trocar
