#include "trainees/exchange/export/xapi_export.h"
#include "trainees/integrity/attempt_chain.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "haptics/input_error.h"
#include "trainees/exchange/export/certificate_export.h"
#include "trainees/exchange/export/xapi_terms.h"
#include "trainees/records/attempt_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using nlohmann::json;

/// @throws InputError.
void require_sound(const std::string& statement, const std::string& about) {
  const std::vector<std::string> problems = xapi_problems(statement);
  if (!problems.empty()) throw InputError(about + ": its statement would break the standard: " + problems.front());
}

/// Statements, one a line.
class StatementList {
 public:
  explicit StatementList(std::ostream& out) : out_(&out) { *out_ << '['; }
  void add(const std::string& statement) {
    *out_ << (first_ ? "\n" : ",\n") << statement;
    first_ = false;
  }
  void end() { *out_ << "\n]\n"; }

 private:
  std::ostream* out_;
  bool first_ = true;
};

std::string text_of(const json& of, const char* key, const std::string& name) {
  if (!of.is_object() || !of.contains(key) || !of[key].is_string() || of[key].get<std::string>().empty()) {
    throw InputError(name + ": \"" + key + "\" is missing, or no text");
  }
  return of[key].get<std::string>();
}

}  // namespace

XapiAttempt read_xapi_attempt(Database& database, std::int64_t row, const PassMark& pass_mark) {
  XapiAttempt attempt;
  attempt.result = AttemptStore(database).load(row);
  sql::Statement more(
      database.connection(),
      "SELECT t.uuid, a.finished_utc, a.row_hash, coalesce(e.title, ''), a.program, coalesce(n.uuid, ''), r.toml,"
      " coalesce((SELECT account_uuid FROM signature WHERE attempt_id = a.id AND account_uuid <> ''"
      " ORDER BY uuid DESC LIMIT 1), '')"
      " FROM attempt a JOIN trainee t ON t.id = a.trainee_id JOIN exercise e ON e.id = a.exercise_id"
      " JOIN ruleset r ON r.sha256 = a.ruleset_sha256 LEFT JOIN session n ON n.id = a.session_id WHERE a.id = ?");
  if (!more.bind(row).step()) throw InputError("no attempt with number " + std::to_string(row));
  attempt.trainee_uuid = more.text(0);
  attempt.finished_utc = more.text(1);
  attempt.row_hash = more.text(2);
  attempt.title = more.text(3);
  attempt.program = more.text(4);
  attempt.session_uuid = more.text(5);
  attempt.instructor_uuid = more.text(7);
  attempt.decision = verdict_of(database, attempt.result).decision;
  if (pass_mark) attempt.pass_at = pass_mark(more.text(6), attempt.result.level);
  return attempt;
}

std::vector<XapiSubject> xapi_subjects(Database& database, const ExportChoice& choice, const XapiSetting& setting,
                                       const PassMark& pass_mark) {
  if (!xapi::is_iri(setting.home_page)) {
    throw InputError("home page \"" + setting.home_page + "\": is no absolute URL such as https://hospital.example/");
  }
  std::vector<XapiSubject> all;
  for (const std::int64_t row : choice.attempts) {
    require_vouched(database.connection(), row, "stated");
    const XapiAttempt attempt = read_xapi_attempt(database, row, pass_mark);
    std::string text = xapi_statement(attempt, setting);
    all.push_back({"attempt " + attempt.result.uuid, XapiStatement{json::parse(text)["id"], std::move(text)}});
  }
  for (const ExportedCertificate& one : chosen_certificates(database, choice))
    for (XapiSubject& subject : certificate_subjects(one, setting)) all.push_back(std::move(subject));
  for (const XapiSubject& subject : all)
    if (subject.statement) require_sound(subject.statement->text, subject.about);
  return all;
}

void write_xapi(Database& database, const ExportChoice& choice, const XapiSetting& setting, const PassMark& pass_mark,
                std::ostream& out) {
  StatementList list(out);
  for (const XapiSubject& subject : xapi_subjects(database, choice, setting, pass_mark))
    if (subject.statement) list.add(subject.statement->text);
  list.end();
}

void write_cmi5(Database& database, const ExportChoice& choice, const Cmi5Launch& launch, const PassMark& pass_mark,
                std::ostream& out) {
  if (choice.trainees.size() != 1)
    throw InputError("a cmi5 launch is of one trainee, but the attempts are of several: say which trainee");
  StatementList list(out);
  require_vouched(database.connection(), choice.attempts.back(), "stated");
  const XapiAttempt attempt = read_xapi_attempt(database, choice.attempts.back(), pass_mark);
  for (const std::string& statement : cmi5_statements(attempt, launch)) {
    require_sound(statement, "attempt " + attempt.result.uuid);
    list.add(statement);
  }
  list.end();
}

Cmi5Launch parse_cmi5_launch(const std::string& text, const std::string& name) {
  const json data = json::parse(text, nullptr, false);
  if (!data.is_object()) throw InputError(name + ": is no JSON object with the data of a cmi5 launch");
  Cmi5Launch launch;
  launch.activity_id = text_of(data, "activityId", name);
  launch.publisher_id = text_of(data, "publisherId", name);
  launch.registration = text_of(data, "registration", name);
  launch.session_id = text_of(data, "sessionId", name);
  const json actor = data.value("actor", json());
  launch.home_page = text_of(actor, "homePage", name + ": actor");
  launch.account = text_of(actor, "name", name + ": actor");
  if (!xapi::is_uuid(launch.registration)) throw InputError(name + ": registration is no UUID");
  for (const std::string& iri : {launch.activity_id, launch.publisher_id, launch.home_page}) {
    if (!xapi::is_iri(iri)) throw InputError(name + ": \"" + iri + "\" is no absolute IRI");
  }
  if (!data.contains("masteryScore")) return launch;
  const json& mastery = data["masteryScore"];
  if (!mastery.is_number() || mastery.get<double>() < 0 || mastery.get<double>() > 1) {
    throw InputError(name + ": masteryScore is no number from 0 to 1");
  }
  launch.mastery_score = mastery.get<double>();
  return launch;
}

}  // namespace trocar
