#include "app/commands/exercises_command.h"

#include <iomanip>
#include <ostream>

#include <nlohmann/json.hpp>

#include "app/scene.h"
#include "haptics/input_error.h"
#include "scenarios/exercise_loader.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

void explain_metric(const std::string& name, std::ostream& out) {
  if (const MetricDefinition* metric = find_metric(name)) {
    out << metric->name << " [" << metric->unit << "]: " << metric->meaning << '\n';
    return;
  }
  std::string known;
  for (const MetricDefinition& metric : metric_catalogue()) {
    known += (known.empty() ? "" : ", ") + std::string(metric.name);
  }
  throw InputError("--explain " + name + ": unknown metric; known are " + known);
}

}  // namespace

int exercises_command(const ExercisesOptions& options, std::ostream& out, std::ostream&) {
  if (!options.explain.empty()) {
    explain_metric(options.explain, out);
    return 0;
  }
  const auto exercises = list_exercises(find_assets().exercises);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Exercise& exercise : exercises) {
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    std::string level_names;
    for (const ExerciseLevel& level : exercise.levels) {
      levels.push_back(level.name);
      level_names += (level_names.empty() ? "" : " ") + level.name;
    }
    json.push_back({{"id", exercise.id}, {"number", exercise.number}, {"version", exercise.version},
                    {"title", exercise.title}, {"goal", exercise.goal}, {"levels", levels},
                    {"time_limit_s", exercise.time_limit_s}, {"pass_at", exercise.rubric.pass_at},
                    {"rubric_sha256", exercise.rubric.sha256}});
    if (!options.json) {
      out << exercise.number << "  " << std::left << std::setw(18) << exercise.id << exercise.title << "  ("
          << level_names << ")\n     " << exercise.goal << '\n';
    }
  }
  if (options.json) out << json.dump(2) << '\n';
  return 0;
}

}  // namespace trocar
