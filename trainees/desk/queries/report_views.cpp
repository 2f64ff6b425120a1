#include "trainees/desk/queries/report_views.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "haptics/input_error.h"
#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/witness.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/certificate_standing.h"
#include "trainees/records/verdicts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

constexpr int kPictureWidth = 1280;

Request asked(const std::string& now_utc) {
  Request request;
  request.now_utc = now_utc;
  return request;
}

template <class Page>
std::string file_of(const Page& page, ReportFormat format) {
  return format == ReportFormat::kPdf ? printed::pdf_of(page) : printed::html_of(page);
}

ReportSetting setting_of(Desk& desk, bool notes) { return {desk.demo, notes, rules_in_force(desk.database)}; }

/// Newest decision of each attempt of a trainee.
std::map<std::string, VerdictOverride> decisions_of(Database& database, const std::string& code) {
  std::map<std::string, VerdictOverride> out;
  sql::Statement rows(database.connection(),
                      "SELECT a.uuid, o.uuid, o.author, o.printed, o.reason, o.utc, o.passed FROM verdict_override o"
                      " JOIN attempt a ON a.id = o.attempt_id JOIN known_trainee k ON k.id = a.trainee_id"
                      " WHERE k.code = ? COLLATE NOCASE ORDER BY o.id");
  rows.bind(code);
  while (rows.step())
    out[rows.text(0)] = {rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5), rows.integer(6) != 0};
  return out;
}

Exclusion counted(Database& database, const std::string& words, const std::string& condition,
                  const std::string& group) {
  sql::Statement row(
      database.connection(),
      "SELECT count(*), count(DISTINCT a.trainee_id) FROM attempt a LEFT JOIN score s INDEXED BY score_first"
      " ON s.attempt_id = a.id AND s.revision = 0 WHERE a.status <> 'running' AND (" +
          condition + ") AND (?1 = '' OR a.trainee_id IN (SELECT trainee_id FROM membership WHERE group_name = ?1))");
  row.bind(group);
  row.step();
  return {words, static_cast<int>(row.integer(0)), static_cast<int>(row.integer(1))};
}

std::vector<Exclusion> exclusions_of(Database& database, const std::string& group) {
  return {
      counted(database, "Void: not a measurement (counted nowhere)",
              "a.status = 'void' AND " + std::string(sql::kEndedByDevice), group),
      counted(database, "Switched off while the clock ran (a try that failed, void)",
              "a.status = 'void' AND NOT " + std::string(sql::kEndedByDevice), group),
      counted(database, "Ended by the device (counted nowhere)", "a.status = 'fault'", group),
      counted(database, "Left before the end (a try that failed, without a score)", "a.status = 'aborted'", group),
      counted(database, "Without a score for another reason",
              "a.status IN ('completed', 'timeout') AND s.value IS NULL", group),
      counted(database, "Force not rendered in over 5 % of the contact (counted, with a doubt)",
              "a.status NOT IN ('void', 'fault') AND a.saturated_contact_share > 0.05", group),
      counted(database, "Device loop late in over 1 % of its ticks (counted, with a doubt)",
              "a.status NOT IN ('void', 'fault') AND a.device_ticks > 0 AND a.device_overruns > 0.01 * a.device_ticks",
              group)};
}

Certificate find_certificate(Database& database, const std::string& uuid) {
  for (Certificate& certificate : AssessmentStore(database).certificates_of(""))
    if (certificate.uuid == uuid) return std::move(certificate);
  throw InputError("certificate \"" + uuid + "\": there is none of that number");
}

/// What was written down when it was given.
void read_evidence(CertificateView& view) {
  const nlohmann::json evidence = nlohmann::json::parse(view.certificate.evidence, nullptr, false);
  if (!evidence.is_object()) {
    view.evidence = view.certificate.evidence;
    return;
  }
  const auto text = [&](const char* name) {
    return evidence.contains(name) && evidence[name].is_string() ? evidence[name].get<std::string>() : std::string();
  };
  view.evidence = text("words");
  if (evidence.contains("n") && evidence["n"].is_number_integer()) view.n = evidence["n"].get<int>();
  if (evidence.contains("reliability") && evidence["reliability"].is_number())
    view.reliability = evidence["reliability"].get<double>();
}

/// Those that the certificate stands on, as they counted when it was given.
std::vector<CertifiedAttempt> attempts_behind(Database& database, const CertificateStanding& standing) {
  std::vector<CertifiedAttempt> out;
  sql::Statement rows(
      database.connection(),
      "SELECT a.uuid, a.started_utc, a.status, coalesce(a.row_hash, ''), a.device_backend, a.hand, "
      "coalesce(a.chain_position, 0), s.value, " +
          std::string(sql::kSoftRealTime) +
          " FROM attempt a"
          " LEFT JOIN score s INDEXED BY score_first ON s.attempt_id = a.id AND s.revision = 0 WHERE a.id = ?");
  for (const CertifiedBy& by : standing.attempts) {
    if (!rows.bind(by.row).step()) continue;
    CertifiedAttempt one{rows.text(0), rows.text(1),    rows.text(2), rows.text(3),   rows.text(4),
                         rows.text(5), rows.integer(6), {},           by.passed_then, by.decided_then};
    one.score = rows.optional_real(7);
    one.passed_now = by.passed_now;
    one.decided_since = by.decided_now;
    one.soft_real_time = rows.integer(8) != 0;
    out.push_back(std::move(one));
    rows.run();
  }
  return out;
}

/// On paper elsewhere it is what no later rewriting of the record can change (witness.h).
std::string witness_words(const Database& database, const std::string& uuid) {
  sql::Statement entry(database.connection(),
                       "SELECT position, row_hash FROM audit WHERE subject = ? AND action = 'certificate added'");
  if (!entry.bind(uuid).step()) return "";
  std::string out = "entry " + std::to_string(entry.integer(0)) + " of the audit trail, " + key_words(entry.text(1));
  const std::string key = key_at(database.connection(), entry.integer(0));
  if (key.empty()) return out;
  return out + (entry_signed(database.connection(), entry.integer(0)) ? ", key " + key_words(key)
                                                                      : ", not signed with the station's key");
}

void read_stiffness(AttemptView& view, Desk& desk) {
  if (!view.trace || !desk.sources.stiffness) return;
  try {
    view.result.device.stiffness = desk.sources.stiffness(view.result.recording_path);
  } catch (const std::exception&) {  // of a program that recorded otherwise: the report says all without it
  }
}

void read_grip_limits(AttemptView& view, Desk& desk) {
  if (!desk.sources.grip_limits) return;
  try {
    view.grips = desk.sources.grip_limits(AttemptStore(desk.database).exercise_text(view.result.rubric_sha256),
                                          view.result.level, view.result.board);
  } catch (const InputError&) {  // an exercise of another version of the program: drawn without its limits
  }
}

}  // namespace

TraineeReportView trainee_report_view(Desk& desk, const std::string& code, const std::string& now_utc) {
  Request request = asked(now_utc);
  request.arguments["code"] = code;
  TraineeReportView out;
  out.trainee = trainee_view(desk, request);
  out.decisions = decisions_of(desk.database, out.trainee.code);
  return out;
}

CohortReportView cohort_report_view(Desk& desk, const std::map<std::string, std::string>& filters,
                                    const std::string& now_utc) {
  Request request = asked(now_utc);
  request.query = filters;
  CohortReportView out;
  out.cohort = cohort_view(desk, request);
  const auto& groups = out.cohort.groups;
  if (const std::string& group = out.cohort.asked.group;
      !group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
    throw InputError("group \"" + group + "\": nobody is in a group of that name");
  const CohortQuestion& only = out.cohort.asked;
  for (Benchmark& b : CurriculumStore(desk.database).benchmarks(only.exercise_id, only.level)) {
    const bool known = std::any_of(out.benchmarks.begin(), out.benchmarks.end(), [&](const Benchmark& other) {
      return other.exercise_id == b.exercise_id && other.level == b.level && other.metric == b.metric;
    });
    if (!known) out.benchmarks.push_back(std::move(b));
  }
  out.exclusions = exclusions_of(desk.database, only.group);
  out.certificates = AssessmentStore(desk.database).certificates_of("");
  out.shaken = shaken_certificates(desk.database, out.certificates);
  return out;
}

AttemptReportView attempt_report_view(Desk& desk, const std::string& name, const std::string& now_utc) {
  AttemptReportView out;
  out.attempt = attempt_view(desk, asked(now_utc), AttemptStore(desk.database).find(name).uuid);
  read_stiffness(out.attempt, desk);
  read_grip_limits(out.attempt, desk);
  if (!out.attempt.picture) return out;
  try {
    out.picture_png = desk.sources.picture(out.attempt.result.uuid, peak_moment_s(out.attempt), kPictureWidth);
  } catch (const std::exception& error) {  // the report says all without it
    out.no_picture = std::string("No picture: ") + error.what() + ".";
  }
  return out;
}

CertificateView certificate_view(Desk& desk, const std::string& uuid) {
  CertificateView out;
  out.certificate = find_certificate(desk.database, uuid);
  out.exercise = exercise_title(desk.database, out.certificate.exercise_id);
  for (const auto& [id, person] : desk::people(desk.database.connection()))
    if (person.code == out.certificate.trainee) out.name = person.name;
  read_evidence(out);
  const CertificateStanding standing = standing_of(desk.database, out.certificate);
  out.attempts = attempts_behind(desk.database, standing);
  if (out.certificate.revoked_utc.empty()) out.in_question = standing.in_question;
  out.witness = witness_words(desk.database, uuid);
  return out;
}

std::string trainee_file(Desk& desk, const std::string& code, const ReportQuestion& question) {
  return file_of(trainee_report(trainee_report_view(desk, code, question.now_utc), setting_of(desk, question.notes)),
                 question.format);
}

std::string cohort_file(Desk& desk, const std::map<std::string, std::string>& filters, const ReportQuestion& question) {
  return file_of(cohort_report(cohort_report_view(desk, filters, question.now_utc), setting_of(desk, question.notes)),
                 question.format);
}

std::string attempt_file(Desk& desk, const std::string& name, const ReportQuestion& question) {
  return file_of(attempt_report(attempt_report_view(desk, name, question.now_utc), setting_of(desk, question.notes)),
                 question.format);
}

std::string certificate_file(Desk& desk, const std::string& uuid, const ReportQuestion& question) {
  return file_of(certificate_sheet(certificate_view(desk, uuid), setting_of(desk, question.notes)), question.format);
}

}  // namespace trocar::review
