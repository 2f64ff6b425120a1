#include "app/cli/sweep/sweep_row.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/validity/scored_attempts.h"

namespace trocar {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kScoreTolerance = 1e-9;
constexpr std::array kStatuses{AttemptStatus::kCompleted, AttemptStatus::kTimeout, AttemptStatus::kAborted,
                               AttemptStatus::kFault, AttemptStatus::kVoid};

OrderedJson cell_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? OrderedJson(*value) : OrderedJson(nullptr);
}

std::optional<double> number_of(const OrderedJson& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

OrderedJson cap_json(const Cap& cap) {
  return {{"kind", cap_kind_name(cap.kind)},
          {"subject", cap.subject},
          {"below", cap.below},
          {"done", cap.done},
          {"total", cap.total},
          {"at_most", cap.at_most}};
}

/// The one of `all` whose name is the word. @throws InputError.
template <typename All, typename Name>
auto named(const All& all, Name name, const std::string& word, const char* what) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return word == name(one); });
  if (found == all.end()) throw InputError("'" + word + "' is no " + what);
  return *found;
}

Cap cap_of(const OrderedJson& json) {
  return {.kind = named(kCapKinds, cap_kind_name, json.at("kind").get<std::string>(), "cap"),
          .subject = json.at("subject").get<std::string>(),
          .below = json.at("below").get<double>(),
          .done = json.at("done").get<int>(),
          .total = json.at("total").get<int>(),
          .at_most = json.at("at_most").get<double>()};
}

Grade grade_of(const OrderedJson& json) {
  Grade grade;
  grade.status = named(kStatuses, status_name, json.at("status").get<std::string>(), "status");
  grade.score = number_of(json.at("score"));
  grade.passed = json.at("passed").get<bool>();
  grade.grade = json.at("grade").get<std::string>();
  for (const auto& cap : json.at("caps")) grade.caps.push_back(cap_of(cap));
  for (const auto& [name, value] : json.at("subscores").items()) {
    Subscore subscore;
    subscore.name = name;
    subscore.value = value.get<double>();
    grade.subscores.push_back(subscore);
  }
  for (const auto& [name, value] : json.at("metrics").items()) {
    const MetricDefinition* known = find_metric(name);
    grade.metrics.push_back({name, number_of(value), known ? std::string(known->unit) : ""});
  }
  return grade;
}

}  // namespace

std::string key_words(const SweepKey& key) {
  return key.exercise + " " + key.level + ", hand " + key.hand + ", arm " + key.arm + ", organ " + key.organ + " (" +
         key.tissue + "), board " + std::to_string(key.board) + ", seed " + std::to_string(key.seed);
}

std::string row_line(const SweepRow& row) {
  OrderedJson caps = OrderedJson::array(), subscores = OrderedJson::object(), metrics = subscores;
  for (const Cap& cap : row.grade.caps) caps.push_back(cap_json(cap));
  for (const Subscore& subscore : row.grade.subscores) subscores[subscore.name] = subscore.value;
  for (const Metric& metric : row.grade.metrics) metrics[metric.name] = cell_or_null(metric.value);
  return OrderedJson{{"exercise", row.key.exercise},
                     {"level", row.key.level},
                     {"arm", row.key.arm},
                     {"hand", row.key.hand},
                     {"organ", row.key.organ},
                     {"tissue", row.key.tissue},
                     {"board", row.key.board},
                     {"seed", row.key.seed},
                     {"number", row.number},
                     {"exercise_version", row.exercise_version},
                     {"rubric_sha256", row.rubric_sha256},
                     {"hand_sha256", row.hand_sha256},
                     {"program", row.program},
                     {"skill", cell_or_null(row.skill)},
                     {"status", status_name(row.grade.status)},
                     {"score", cell_or_null(row.grade.score)},
                     {"passed", row.grade.passed},
                     {"grade", row.grade.grade},
                     {"fault", row.fault},
                     {"caps", caps},
                     {"subscores", subscores},
                     {"metrics", metrics}}
      .dump();
}

SweepRow parse_row(const std::string& line, const std::string& where) {
  try {
    const OrderedJson json = OrderedJson::parse(line);
    const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
    SweepRow row;
    row.key = {text("exercise"),
               text("level"),
               text("arm"),
               text("hand"),
               text("organ"),
               text("tissue"),
               json.at("board").get<int>(),
               json.at("seed").get<std::int64_t>()};
    row.number = text("number");
    row.exercise_version = text("exercise_version");
    row.rubric_sha256 = text("rubric_sha256");
    row.hand_sha256 = text("hand_sha256");
    row.program = text("program");
    row.skill = number_of(json.at("skill"));
    row.fault = text("fault");
    row.grade = grade_of(json);
    return row;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(where + ": no row of a sweep: " + error.what());
  } catch (const InputError& error) {
    throw InputError(where + ": " + error.what());
  }
}

void check_row(SweepRow& row, const Rubric& rubric, const std::string& where) {
  if (!row.grade.score) return;
  Grade again = regrade(row.grade, rubric);
  const auto refuse = [&](const std::string& what) {
    throw InputError(where + ": the ruleset makes another " + what + " of these metrics than stands there");
  };
  if (std::abs(*again.score - *row.grade.score) > kScoreTolerance) refuse("score");
  if (again.passed != row.grade.passed) refuse("verdict");
  row.grade = std::move(again);
}

}  // namespace trocar
