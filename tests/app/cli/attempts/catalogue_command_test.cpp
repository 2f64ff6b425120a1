// `trocar exercises`: the list, its JSON, and what it explains; all against the exercises as they are loaded.
#include "app/cli/attempts/catalogue_command.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/metrics.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::catalogue_command_test {
namespace {

using Json = nlohmann::json;
using test::message_of;

const std::vector<Exercise>& shipped() {
  static const std::vector<Exercise> exercises = list_exercises(find_assets().exercises);
  return exercises;
}

std::string catalogue(const ExercisesOptions& options = {}) {
  std::ostringstream out, err;
  EXPECT_EQ(exercises_command(options, out, err), 0);
  EXPECT_EQ(err.str(), "");
  return out.str();
}

std::string explained(const std::string& name) { return catalogue({.json = false, .explain = name}); }

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Catalogue, ListsEveryExerciseInOrderWithItsGoalAndLevels) {
  const std::string text = catalogue();
  std::size_t last = 0;
  for (const Exercise& exercise : shipped()) {
    const auto at = text.find(exercise.number + "  " + exercise.id);
    ASSERT_NE(at, std::string::npos) << exercise.id << " in\n" << text;
    EXPECT_GE(at, last) << "ordered by number";
    last = at;
    EXPECT_CONTAINS(text.substr(at), exercise.goal);
    for (const ExerciseLevel& level : exercise.levels) EXPECT_CONTAINS(text.substr(at), "     " + level.name + ' ');
  }
  std::size_t lines = 0;
  for (const Exercise& exercise : shipped()) lines += 2 + exercise.levels.size();
  EXPECT_EQ(static_cast<std::size_t>(count(text, "\n")), lines) << "nothing else is said";
}

TEST(Catalogue, JsonHoldsWhatWasLoaded) {
  const Json json = Json::parse(catalogue({.json = true, .explain = ""}));
  ASSERT_EQ(json.size(), shipped().size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Exercise& exercise = shipped()[i];
    EXPECT_EQ(json[i].at("id"), exercise.id);
    EXPECT_EQ(json[i].at("number"), exercise.number);
    EXPECT_EQ(json[i].at("version"), exercise.version);
    EXPECT_EQ(json[i].at("objects"), exercise.layout.count);
    EXPECT_EQ(json[i].at("force_n").at("hard"), exercise.hard_force_n);
    EXPECT_EQ(json[i].at("rubric_sha256"), exercise.rubric.sha256);
    EXPECT_EQ(json[i].at("file"), exercise.file.filename().string()) << "no folder of this machine";
    ASSERT_EQ(json[i].at("levels").size(), exercise.levels.size());
  }
}

TEST(Catalogue, JsonOfALevelHoldsMappingBandsAndRubric) {
  const Json json = Json::parse(catalogue({.json = true, .explain = ""}));
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Exercise& exercise = shipped()[i];
    for (std::size_t k = 0; k < exercise.levels.size(); ++k) {
      const ExerciseLevel& level = exercise.levels[k];
      const Json& said = json[i].at("levels").at(k);
      SCOPED_TRACE(exercise.id + ' ' + level.name);
      EXPECT_EQ(said.at("name"), level.name);
      EXPECT_EQ(said.at("exam").get<bool>(), level.name == "exam");
      EXPECT_EQ(said.contains("port_m"), level.mapping == Mapping::kFulcrum);
      EXPECT_EQ(said.contains("angle_tolerance_rad"), level.angle_tolerance_rad > 0);
      EXPECT_EQ(said.contains("bands_n") ? said.at("bands_n").size() : 0, level.bands.size());
      EXPECT_EQ(said.at("force_scale").is_string(), level.force_scale <= 0) << "auto, or the number";
    }
  }
}

TEST(Catalogue, JsonOfARubricAddsUpAndGatesAreNullWhereThereIsNone) {
  const Json json = Json::parse(catalogue({.json = true, .explain = ""}));
  for (const Json& exercise : json) {
    for (const Json& level : exercise.at("levels")) {
      const Json& rubric = level.at("rubric");
      EXPECT_LT(rubric.at("pass_at"), rubric.at("expert_at"));
      double weights = 0;
      for (const Json& rule : rubric.at("subscores")) {
        weights += rule.at("weight").get<double>();
        EXPECT_EQ(rule.at("gate_below").is_null(), !rule.at("gate").get<bool>()) << rule;
        const MetricDefinition* metric = find_metric(rule.at("metric").get<std::string>());
        ASSERT_NE(metric, nullptr) << rule;
        EXPECT_EQ(rule.at("unit"), std::string(metric->unit));
      }
      EXPECT_NEAR(weights, 1, 1e-9) << exercise.at("id") << level.at("name");
    }
  }
}

TEST(Explain, AMetricIsDefinedAndItsUsesAreListed) {
  for (const MetricDefinition& metric : metric_catalogue()) {
    const std::string name(metric.name), text = explained(name);
    EXPECT_EQ(text.find(name + " [" + std::string(metric.unit) + "]: " + std::string(metric.meaning)), 0u) << text;
    for (const std::string& told :
         {"formula   " + std::string(metric.formula), "evidence  " + std::string(metric.evidence)})
      EXPECT_EQ(count(text, "\n  " + told + "\n"), 1) << text;
    EXPECT_EQ(count(text, " is better"), 1) << text;
    int uses = 0;
    for (const Exercise& exercise : shipped()) {
      for (const ExerciseLevel& level : exercise.levels) {
        for (const SubscoreRule& rule : level.rubric.subscores) uses += rule.metric == name ? 1 : 0;
      }
    }
    EXPECT_EQ(count(text, ", " + name + ": full at "), uses) << text;
  }
}

TEST(Explain, AnExerciseByIdOrNumberWithItsWholeRubric) {
  for (const Exercise& exercise : shipped()) {
    const std::string text = explained(exercise.id);
    EXPECT_EQ(text, explained(exercise.number));
    std::size_t rules = 0;
    int gates = 0;
    for (const ExerciseLevel& level : exercise.levels) {
      rules += level.rubric.subscores.size();
      EXPECT_CONTAINS(text, exercise.id + ' ' + level.name + ": S = 100 x sum of weight");
      for (const SubscoreRule& rule : level.rubric.subscores) gates += rule.gate ? 1 : 0;
    }
    EXPECT_EQ(static_cast<std::size_t>(count(text, "weight 0.")), rules) << text;
    EXPECT_EQ(count(text, "; safety gate below "), gates) << text;
    EXPECT_CONTAINS(text, "rubric " + exercise.rubric.sha256);
    EXPECT_CONTAINS(text, exercise.file.filename().string());
  }
}

TEST(Explain, ASubscoreWhereverItIsUsed) {
  std::set<std::string> names;
  for (const Exercise& exercise : shipped()) {
    for (const SubscoreRule& rule : exercise.rubric.subscores) {
      if (!find_metric(rule.name)) names.insert(rule.name);
    }
  }
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    const std::string text = explained(name);
    int lines = 0;
    for (const Exercise& exercise : shipped()) {
      for (const ExerciseLevel& level : exercise.levels) {
        bool used = false;
        for (const SubscoreRule& rule : level.rubric.subscores) used = used || rule.name == name;
        EXPECT_EQ(text.find(exercise.id + ' ' + level.name + '\n') != std::string::npos, used) << name;
        lines += used ? 2 : 0;
      }
    }
    EXPECT_EQ(count(text, "\n"), lines) << text;
  }
}

TEST(Explain, AnUnknownNameIsRefusedWithWhatIsKnownAndWhatIsNear) {
  const auto refusal = [](const std::string& name) {
    std::ostringstream out, err;
    const auto ask = [&] { exercises_command({.json = false, .explain = name}, out, err); };
    const std::string message = message_of<InputError>(ask);
    EXPECT_EQ(out.str(), "");
    return message;
  };
  const std::string far = refusal("zzzzzzzzzzzzzzzz");
  EXPECT_CONTAINS(far, "--explain zzzzzzzzzzzzzzzz: unknown metric, exercise or sub-score; known are ");
  EXPECT_EQ(far.find("did you mean"), std::string::npos) << far;
  for (const Exercise& exercise : shipped()) EXPECT_CONTAINS(far, exercise.id);
  for (const MetricDefinition& metric : metric_catalogue()) EXPECT_CONTAINS(far, std::string(metric.name));
  EXPECT_CONTAINS(refusal("path_ration"), "did you mean 'path_ratio'?");
  EXPECT_CONTAINS(refusal("surfac-touch"), "did you mean 'surface-touch'?");
}

}  // namespace
}  // namespace trocar::catalogue_command_test
