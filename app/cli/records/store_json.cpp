#include "app/cli/records/store_json.h"

#include <nlohmann/json.hpp>

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const Trainee& trainee) {
  return {{"code", trainee.code},         {"uuid", trainee.uuid},     {"created_utc", trainee.created_utc},
          {"attempts", trainee.attempts}, {"passes", trainee.passes}, {"last_utc", trainee.last_utc}};
}

Json json_of(const AttemptSummary& attempt) {
  const bool decided = !attempt.decided_by.empty();
  return {{"number", attempt.row},
          {"uuid", attempt.uuid},
          {"started_utc", attempt.started_utc},
          {"exercise", attempt.exercise_id},
          {"exercise_version", attempt.exercise_version},
          {"rubric_sha256", attempt.rubric_sha256},
          {"level", attempt.level},
          {"board", attempt.board},
          {"seed", attempt.seed},
          {"hand", attempt.hand},
          {"status", attempt.status},
          {"score", number_or_null(attempt.score)},
          {"passed", attempt.passed},
          {"passed_by_score", attempt.passed_by_score},
          {"decided_by", decided ? Json(attempt.decided_by) : Json(nullptr)},
          {"soft_real_time", attempt.soft_real_time},
          {"decided_utc", decided ? Json(attempt.decided_utc) : Json(nullptr)},
          {"grade", attempt.grade},
          {"integrity", attempt.integrity.empty() ? Json(nullptr) : Json(attempt.integrity)},
          {"organ_synthetic", attempt.organ_synthetic}};
}

Json json_of(const CohortRow& row) {
  return {{"trainee", row.trainee},
          {"exercise", row.exercise_id},
          {"exercise_version", row.exercise_version},
          {"rubric_sha256", row.rubric_sha256},
          {"level", row.level},
          {"attempts", row.attempts},
          {"graded", row.graded},
          {"passes", row.passes},
          {"best", number_or_null(row.best)},
          {"last", number_or_null(row.last)},
          {"mean_peak_force_n", number_or_null(row.mean_peak_force_n)},
          {"mean_time_s", number_or_null(row.mean_time_s)},
          {"last_utc", row.last_utc}};
}

Json json_of(const CohortLine& line) {
  Json judgements = Json::array();
  for (const Judgement& j : line.judgements)
    judgements.push_back({{"flag", flag_name(j.flag)},
                          {"evidence", j.evidence},
                          {"n", j.n},
                          {"decided", j.decided},
                          {"reliability", number_or_null(j.reliability)},
                          {"rules", j.rule_version}});
  return {{"exercise", line.key.exercise_id},
          {"level", line.key.level},
          {"hand", line.key.hand},
          {"rubric_sha256", line.key.rubric_sha256},
          {"attempts", line.tries},
          {"passes", line.passes},
          {"reliability", number_or_null(line.reliability)},
          {"certified_utc", line.certified_utc.empty() ? Json(nullptr) : Json(line.certified_utc)},
          {"judgements", judgements}};
}

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

template <class Rows>
Json array_of(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(json_of(row));
  return list;
}

}  // namespace

bool of_row(const CohortLine& line, const CohortRow& row) {
  return line.trainee == row.trainee && line.key.exercise_id == row.exercise_id && line.key.level == row.level &&
         line.key.rubric_sha256 == row.rubric_sha256;
}

std::string trainees_json(const std::vector<Trainee>& trainees) { return text_of(array_of(trainees)); }

std::string trainee_json(const Trainee& trainee, const std::vector<AttemptSummary>& attempts,
                         const std::vector<CohortLine>& lines) {
  Json json = json_of(trainee);
  json["name"] = trainee.name;
  json["email"] = trainee.email;
  json["curves"] = array_of(lines);
  json["history"] = array_of(attempts);
  return text_of(json);
}

std::string cohort_json(const std::vector<CohortRow>& rows, const std::vector<CohortLine>& lines) {
  Json list = Json::array();
  for (const CohortRow& row : rows) {
    Json json = json_of(row);
    json["curves"] = Json::array();
    for (const CohortLine& line : lines)
      if (of_row(line, row)) json["curves"].push_back(json_of(line));
    list.push_back(json);
  }
  return text_of(list);
}

std::string problems_json(const Database& database, const std::vector<std::string>& problems,
                          const std::vector<std::string>& remarks) {
  return text_of({{"database", database.file().string()},
                  {"schema", database.schema_version()},
                  {"head", database.head()},
                  {"sound", problems.empty()},
                  {"problems", problems},
                  {"remarks", remarks}});
}

}  // namespace trocar
