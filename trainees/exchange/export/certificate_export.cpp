#include "trainees/exchange/export/certificate_export.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "trainees/exchange/export/named_uuid.h"
#include "trainees/exchange/export/xapi_terms.h"
#include "trainees/markup/csv.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using CertificateJson = nlohmann::ordered_json;

struct Field {
  const char* name;
  std::string (*text)(const ExportedCertificate& one);
};

const std::vector<Field>& fields() {
  using One = const ExportedCertificate&;
  static const std::vector<Field> kFields{
      {"certificate_uuid", [](One c) { return c.certificate.uuid; }},
      {"trainee_uuid", [](One c) { return c.trainee_uuid; }},
      {"trainee", [](One c) { return c.certificate.trainee; }},
      {"exercise", [](One c) { return c.certificate.exercise_id; }},
      {"level", [](One c) { return c.certificate.level; }},
      {"rule_version", [](One c) { return c.certificate.rule_version; }},
      {"author_account_uuid", [](One c) { return c.certificate.author; }},
      {"author", [](One c) { return c.certificate.printed; }},
      {"utc", [](One c) { return c.certificate.utc; }},
      {"state", [](One c) { return c.state(); }},
      {"in_question", [](One c) { return c.standing.in_question; }},
      {"withdrawn_utc", [](One c) { return c.certificate.revoked_utc; }},
      {"withdrawn_by", [](One c) { return c.revoked_by; }},
      {"withdrawn_reason", [](One c) { return c.certificate.revoked_reason; }},
      {"cited_attempt_uuid", [](One c) { return c.standing.cited; }},
      {"attempt_uuids",
       [](One c) {
         std::string all;
         for (const CertifiedBy& by : c.standing.attempts) all += (all.empty() ? "" : " ") + by.uuid;
         return all;
       }},
  };
  return kFields;
}

void read_revocation(sqlite3* connection, ExportedCertificate& one) {
  sql::Statement row(connection,
                     "SELECT r.uuid, r.printed, r.author FROM revocation r JOIN certificate c ON c.id ="
                     " r.certificate_id WHERE c.uuid = ? AND row_holds('revocation', r.id) ORDER BY r.uuid LIMIT 1");
  if (!row.bind(one.certificate.uuid).step()) return;
  one.revocation_uuid = row.text(0);
  one.revoked_by = row.text(1);
  one.revoked_by_account = row.text(2);
}

/// Which decision it was that put it in question; of an attempt that is no longer the certified one there is none.
void read_question(sqlite3* connection, ExportedCertificate& one) {
  for (const CertifiedBy& by : one.standing.attempts) {
    if (!by.passed_then || by.passed_now) continue;
    sql::Statement row(connection,
                       "SELECT uuid, utc FROM verdict_override WHERE attempt_id = ? ORDER BY uuid DESC LIMIT 1");
    if (!row.bind(by.row).step() || row.text(0) <= one.questioned_by) continue;
    one.questioned_by = row.text(0);
    one.questioned_utc = row.text(1);
  }
}

CertificateJson person(const XapiSetting& setting, const std::string& name) {
  return {{"objectType", "Agent"}, {"account", {{"homePage", setting.home_page}, {"name", name}}}};
}

std::string own(const std::string& rest) { return std::string(xapi::kOwn) + rest; }

CertificateJson certificate_object(const ExportedCertificate& one) {
  return {
      {"objectType", "Activity"},
      {"id", own("certificate/" + one.certificate.uuid)},
      {"definition",
       {{"type", xapi::kCertificate}, {"name", {{"en", one.certificate.exercise_id + ", " + one.certificate.level}}}}}};
}

std::string earned_id(const ExportedCertificate& one) {
  return named_uuid(one.certificate.uuid, std::string(xapi::kEarned));
}

CertificateJson earned(const ExportedCertificate& one, const XapiSetting& setting) {
  const Certificate& c = one.certificate;
  const std::string exercise = own("exercise/" + xapi::path_part(c.exercise_id));
  CertificateJson extensions = {{own("extension/level"), c.level}, {own("extension/rule-version"), c.rule_version}};
  if (!one.standing.cited.empty()) extensions[own("extension/attempt")] = one.standing.cited;
  CertificateJson context = {{"registration", named_uuid(one.trainee_uuid, exercise)}};
  if (!c.author.empty()) context["instructor"] = person(setting, c.author);
  context["contextActivities"]["parent"] = CertificateJson::array({{{"objectType", "Activity"}, {"id", exercise}}});
  context["platform"] = "Trocar";
  context["language"] = "en";
  return {{"id", earned_id(one)},
          {"actor", person(setting, one.trainee_uuid)},
          {"verb", {{"id", xapi::kEarned}, {"display", {{"en", "earned"}}}}},
          {"object", certificate_object(one)},
          {"result", {{"success", true}, {"extensions", extensions}}},
          {"context", context},
          {"timestamp", c.utc}};
}

CertificateJson questioned(const ExportedCertificate& one, const XapiSetting& setting) {
  CertificateJson attempts = CertificateJson::array();
  for (const CertifiedBy& by : one.standing.attempts)
    if (by.passed_then && !by.passed_now) attempts.push_back(by.uuid);
  return {{"id", named_uuid(one.certificate.uuid, own("verb/questioned ") + one.questioned_by)},
          {"actor", person(setting, one.trainee_uuid)},
          {"verb", {{"id", own("verb/questioned")}, {"display", {{"en", "has in question"}}}}},
          {"object", certificate_object(one)},
          {"result", {{"extensions", {{own("extension/attempts"), attempts}}}}},
          {"context", {{"statement", {{"objectType", "StatementRef"}, {"id", earned_id(one)}}}}},
          {"timestamp", one.questioned_utc.empty() ? one.certificate.utc : one.questioned_utc}};
}

}  // namespace

std::string ExportedCertificate::state() const {
  if (!certificate.revoked_utc.empty()) return "withdrawn";
  return standing.in_question.empty() ? "holds" : "in question";
}

std::vector<ExportedCertificate> chosen_certificates(Database& database, const ExportChoice& choice) {
  std::vector<ExportedCertificate> out;
  if (!choice.filter.attempt.empty()) return out;
  sqlite3* connection = database.connection();
  for (Certificate& certificate : AssessmentStore(database).certificates_of("")) {
    if (!choice.filter.exercise.empty() && certificate.exercise_id != choice.filter.exercise) continue;
    sql::Statement of(connection,
                      "SELECT t.id, t.uuid FROM certificate c JOIN trainee t ON t.id = c.trainee_id WHERE c.uuid = ?");
    if (!of.bind(certificate.uuid).step()) continue;
    if (!std::binary_search(choice.trainees.begin(), choice.trainees.end(), of.integer(0))) continue;
    ExportedCertificate one{std::move(certificate), of.text(1)};
    one.standing = standing_of(database, one.certificate);
    read_revocation(connection, one);
    read_question(connection, one);
    out.push_back(std::move(one));
  }
  std::reverse(out.begin(), out.end());
  return out;
}

void write_certificates_csv(const std::vector<ExportedCertificate>& certificates, std::ostream& out) {
  std::vector<std::string> line;
  for (const Field& field : fields()) line.emplace_back(field.name);
  out << csv_line(line);
  for (const ExportedCertificate& one : certificates) {
    line.clear();
    for (const Field& field : fields()) line.push_back(csv_text(field.text(one)));
    out << csv_line(line);
  }
}

std::string certificates_json(const std::vector<ExportedCertificate>& certificates) {
  CertificateJson all = CertificateJson::array();
  for (const ExportedCertificate& one : certificates) {
    CertificateJson object = CertificateJson::object();
    for (const Field& field : fields()) {
      const std::string text = field.text(one);
      object[field.name] = text.empty() ? CertificateJson(nullptr) : CertificateJson(text);
    }
    object["attempt_uuids"] = CertificateJson::array();
    for (const CertifiedBy& by : one.standing.attempts) object["attempt_uuids"].push_back(by.uuid);
    all.push_back(std::move(object));
  }
  return all.dump(-1, ' ', false, CertificateJson::error_handler_t::replace);
}

std::vector<XapiSubject> certificate_subjects(const ExportedCertificate& one, const XapiSetting& setting) {
  const auto statement = [](const CertificateJson& json) {
    return XapiStatement{json["id"], json.dump(-1, ' ', false, CertificateJson::error_handler_t::replace)};
  };
  const std::string uuid = one.certificate.uuid;
  std::vector<XapiSubject> out{{"certificate " + uuid, statement(earned(one, setting))},
                               {"question on certificate " + uuid, std::nullopt},
                               {"withdrawal of certificate " + uuid, std::nullopt}};
  if (one.state() == "in question") out[1].statement = statement(questioned(one, setting));
  if (one.state() == "withdrawn")
    out[2].statement = voiding_statement(earned_id(one), one.revoked_by_account, one.certificate.revoked_utc, setting);
  return out;
}

}  // namespace trocar
