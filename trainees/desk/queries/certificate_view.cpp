// What a certificate rests on, and which certificates an attempt's page shows.
#include <nlohmann/json.hpp>

#include "trainees/desk/queries/desk_views.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

/// The attempt that it cites; "" where its evidence names none.
std::string cited(const Certificate& certificate) {
  const nlohmann::json evidence = nlohmann::json::parse(certificate.evidence, nullptr, false);
  if (!evidence.is_object() || !evidence.contains("attempt") || !evidence["attempt"].is_string()) return "";
  return evidence["attempt"].get<std::string>();
}

bool cites(const Certificate& certificate, const std::string& attempt_uuid) {
  return cited(certificate) == attempt_uuid;
}

}  // namespace

std::vector<CurveDecision> decisions_of_curve(Database& database, const AttemptResult& attempt) {
  sql::Statement rows(database.connection(),
                      "SELECT a.uuid, o.uuid, o.author, o.printed, o.reason, o.utc, o.passed FROM attempt a" +
                          sql::decision() +
                          " WHERE o.id IS NOT NULL AND a.trainee_id = (SELECT trainee_id FROM attempt WHERE uuid = ?) "
                          "AND a.exercise_id = ? AND a.level = ?"
                          " AND a.hand = ? AND a.ruleset_sha256 = ? ORDER BY a.id");
  rows.bind(attempt.uuid).bind(attempt.exercise_id).bind(attempt.level).bind(attempt.hand).bind(attempt.rubric_sha256);
  std::vector<CurveDecision> out;
  while (rows.step())
    out.push_back(
        {rows.text(0), {rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5), rows.integer(6) != 0}});
  return out;
}

void add_certificates(AttemptView& view, Database& database) {
  for (Certificate& certificate : AssessmentStore(database).certificates_of(view.result.trainee)) {
    const bool of_this = cites(certificate, view.result.uuid);
    const bool same = certificate.exercise_id == view.result.exercise_id && certificate.level == view.result.level;
    if (of_this || same) view.certificates.push_back({std::move(certificate), of_this});
  }
}

ShakenCertificates shaken_certificates(Database& database, const std::vector<Certificate>& certificates) {
  ShakenCertificates out;
  const AssessmentStore assessments(database);
  for (const Certificate& certificate : certificates) {
    if (!certificate.revoked_utc.empty()) continue;
    const auto decisions = assessments.overrides_of(cited(certificate));
    if (decisions.empty() || decisions.front().passed) continue;
    const VerdictOverride& last = decisions.front();
    out[certificate.uuid] = "The attempt that it cites was decided not passed by " + last.printed + " on " +
                            last.utc.substr(0, 10) + ": " + last.reason;
  }
  return out;
}

std::string certificate_evidence(const AttemptView& view) {
  nlohmann::ordered_json decisions = nlohmann::ordered_json::array();
  for (const CurveDecision& one : view.curve_decisions)
    decisions.push_back({{"attempt", one.attempt_uuid},
                         {"decision", one.decision.uuid},
                         {"passed", one.decision.passed},
                         {"by", one.decision.printed},
                         {"utc", one.decision.utc},
                         {"reason", one.decision.reason}});
  nlohmann::ordered_json evidence = {{"attempt", view.result.uuid},       {"row_hash", view.row_hash},
                                     {"words", view.ready->evidence},     {"n", view.ready->n},
                                     {"decided", view.ready->decided},    {"reliability", nullptr},
                                     {"rules", view.ready->rule_version}, {"overrides", std::move(decisions)}};
  if (view.ready->reliability) evidence["reliability"] = *view.ready->reliability;
  return evidence.dump();
}

}  // namespace trocar::review
