#include <set>

#include <nlohmann/json.hpp>

#include "app/cli/sweep/sweep_table.h"
#include "app/cli/sweep/validity_page.h"
#include "scenarios/scoring/metrics.h"
#include "trainees/markup/csv.h"

namespace trocar {
namespace {

using ValidityJson = nlohmann::ordered_json;

ValidityJson hands_json(const std::vector<ScoredAttempt>& attempts) {
  ValidityJson list = ValidityJson::array();
  for (const auto& [hand, of] : outcomes_by_hand(attempts)) {
    const GroupSummary s = summarise(of.scores);
    list.push_back({{"hand", hand},
                    {"attempts", s.count + of.without_score},
                    {"mean", s.mean},
                    {"sd", s.sd},
                    {"lowest", s.lowest},
                    {"highest", s.highest},
                    {"pass_share", pass_share(of)},
                    {"without_score", of.without_score}});
  }
  return list;
}

ValidityJson left_out_json(const std::optional<LeftOut>& found) {
  if (!found) return nullptr;
  return {{"right", found->right}, {"all", found->all}, {"taken_for", found->taken_for}};
}

ValidityJson population_json(const std::optional<PopulationValidity>& people) {
  if (!people) return nullptr;
  ValidityJson json{{"persons", people->persons},
                    {"attempts", people->attempts},
                    {"without_number", people->without_number},
                    {"correlation", people->one_attempt},
                    {"correlation_95", {people->one_attempt_interval.first, people->one_attempt_interval.second}},
                    {"rank_correlation", people->ranks},
                    {"person_mean_correlation", people->person_mean},
                    {"incomplete", people->incomplete},
                    {"retests", people->retests},
                    {"icc", people->icc ? ValidityJson(*people->icc) : ValidityJson(nullptr)},
                    {"components", nullptr}};
  if (!people->components) return json;
  const VarianceComponents& found = *people->components;
  ValidityJson estimates = ValidityJson::object();
  for (std::size_t facets = 1; facets < kFacetSets; ++facets) estimates[facet_words(facets)] = found.estimate[facets];
  json["components"] = {{"design", people->design},
                        {"estimates", estimates},
                        {"standard_error", found.standard_error()},
                        {"dependability_of_1", found.dependability(1)},
                        {"attempts_for_0.8", found.attempts_for(0.8)}};
  return json;
}

ValidityJson rubric_trials_json(const CellValidity& found) {
  ValidityJson weights = ValidityJson::array(), scorers = weights;
  for (const WeightTrial& trial : found.weights)
    weights.push_back({{"subscore", trial.subscore},
                       {"weight", trial.weight},
                       {"delta_alone", trial.alone_delta},
                       {"delta_without", trial.without_delta},
                       {"decisions_changed_halved", trial.less_changes},
                       {"decisions_changed_half_more", trial.more_changes},
                       {"lost", trial.lost}});
  for (const BadScorer& bad : found.bad_scorers) scorers.push_back({{"scorer", bad.name}, {"lost", bad.lost}});
  return {{"weights", weights}, {"bad_scorers", scorers}};
}

/// By name, of one row: for tables whose rows do not all have the same columns.
template <typename Values>
std::map<std::string, std::string> fields_of(const Values& values) {
  std::map<std::string, std::string> fields;
  for (const auto& one : values) {
    if constexpr (requires { one.weight; })
      fields[one.name] = csv_number(one.value);
    else if (one.value)
      fields[one.name] = csv_number(*one.value);
  }
  return fields;
}

}  // namespace

std::string validity_json(const std::vector<ReportedCell>& cells, const std::string& program) {
  ValidityJson list = ValidityJson::array();
  bool met = true;
  for (const ReportedCell& cell : cells) {
    for (const ValidityCheck& check : cell.found.checks) met = met && check.met;
    ValidityJson one{{"exercise", cell.key.exercise},
                     {"level", cell.key.level},
                     {"organ", cell.key.organ},
                     {"tissue", cell.key.tissue},
                     {"exercise_version", cell.exercise_version},
                     {"rubric_sha256", cell.rubric_sha256},
                     {"hands", hands_json(cell.attempts)},
                     {"checks", ValidityJson::parse(checks_json(cell.found.checks))},
                     {"left_out_by_subscores", left_out_json(cell.found.by_subscores)},
                     {"left_out_by_score", left_out_json(cell.found.by_score)},
                     {"population", population_json(cell.found.population)}};
    one.update(rubric_trials_json(cell.found));
    list.push_back(one);
  }
  return ValidityJson{{"program", program}, {"humans_measured", 0}, {"met", met}, {"cells", list}}.dump(2) + "\n";
}

std::string attempts_csv(const std::vector<const SweepRow*>& rows) {
  std::set<std::string> subscores;
  for (const SweepRow* row : rows) {
    for (const Subscore& subscore : row->grade.subscores) subscores.insert(subscore.name);
  }
  std::vector<std::string> head{
      "exercise",      "level",       "arm",    "hand",   "skill", "organ", "tissue", "board",
      "seed",          "status",      "score",  "passed", "grade", "fault", "caps",   "exercise_version",
      "rubric_sha256", "hand_sha256", "program"};
  for (const std::string& name : subscores) head.push_back(csv_text("subscore: " + name));
  for (const MetricDefinition& metric : metric_catalogue()) head.push_back(csv_text(std::string(metric.name)));
  std::string out = csv_line(head);
  for (const SweepRow* row : rows) {
    std::string caps;
    for (const Cap& cap : row->grade.caps) caps += (caps.empty() ? "" : "; ") + cap_sentence(cap);
    std::vector<std::string> fields{csv_text(row->key.exercise),
                                    csv_text(row->key.level),
                                    csv_text(row->key.arm),
                                    csv_text(row->key.hand),
                                    row->skill ? csv_number(*row->skill) : "",
                                    csv_text(row->key.organ),
                                    csv_text(row->key.tissue),
                                    std::to_string(row->key.board),
                                    std::to_string(row->key.seed),
                                    status_name(row->grade.status),
                                    row->grade.score ? csv_number(*row->grade.score) : "",
                                    row->grade.passed ? "1" : "0",
                                    csv_text(row->grade.grade),
                                    csv_text(row->fault),
                                    csv_text(caps),
                                    csv_text(row->exercise_version),
                                    row->rubric_sha256,
                                    row->hand_sha256,
                                    csv_text(row->program)};
    std::map<std::string, std::string> named = fields_of(row->grade.subscores);
    for (const std::string& name : subscores) fields.push_back(named[name]);
    named = fields_of(row->grade.metrics);
    for (const MetricDefinition& metric : metric_catalogue()) fields.push_back(named[std::string(metric.name)]);
    out += csv_line(fields);
  }
  return out;
}

}  // namespace trocar
