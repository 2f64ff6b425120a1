// What a certificate rests on, and which certificates an attempt's page shows.
#include <nlohmann/json.hpp>

#include "trainees/desk/queries/desk_views.h"
#include "trainees/records/certificate_standing.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
std::vector<CurveDecision> decisions_of_curve(Database& database, const AttemptResult& attempt) {
  sql::Statement rows(
      database.connection(),
      "SELECT a.uuid, o.uuid, o.author, o.printed, o.reason, o.utc, o.passed FROM attempt a" + sql::decision() +
          " WHERE o.id IS NOT NULL AND a.trainee_id = (SELECT trainee_id FROM attempt WHERE uuid = ?) AND "
          "a.exercise_id = ? AND a.level = ?"
          " AND a.hand = ? AND a.ruleset_sha256 = ? ORDER BY a.id");
  rows.bind(attempt.uuid).bind(attempt.exercise_id).bind(attempt.level).bind(attempt.hand).bind(attempt.rubric_sha256);
  std::vector<CurveDecision> out;
  while (rows.step())
    out.push_back(
        {rows.text(0), {rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5), rows.integer(6) != 0}});
  return out;
}

void add_certificates(AttemptView& view, Database& database) {
  sql::Statement holds(database.connection(), "SELECT row_holds('certificate', id) FROM certificate WHERE uuid = ?");
  for (Certificate& certificate : AssessmentStore(database).certificates_of(view.result.trainee)) {
    CertificateStanding standing = standing_of(database, certificate);
    const bool of_this = standing.cited == view.result.uuid;
    const bool same = certificate.exercise_id == view.result.exercise_id && certificate.level == view.result.level;
    if (!of_this && !same) continue;
    const bool is_signed = holds.bind(certificate.uuid).step() && holds.integer(0) != 0;
    holds.run();
    view.certificates.push_back({std::move(certificate), of_this, std::move(standing.in_question), is_signed});
  }
}

ShakenCertificates shaken_certificates(Database& database, const std::vector<Certificate>& certificates) {
  ShakenCertificates out;
  for (const Certificate& certificate : certificates) {
    if (!certificate.revoked_utc.empty()) continue;
    if (std::string why = standing_of(database, certificate).in_question; !why.empty())
      out[certificate.uuid] = std::move(why);
  }
  return out;
}

std::string certificate_evidence(const Database& database, const AttemptView& view) {
  nlohmann::ordered_json decisions = nlohmann::ordered_json::array();
  for (const CurveDecision& one : view.curve_decisions)
    decisions.push_back({{"attempt", one.attempt_uuid},
                         {"decision", one.decision.uuid},
                         {"passed", one.decision.passed},
                         {"by", one.decision.printed},
                         {"utc", one.decision.utc},
                         {"reason", one.decision.reason}});
  nlohmann::ordered_json evidence = {{"attempt", view.result.uuid},
                                     {"row_hash", view.row_hash},
                                     {"words", view.ready->evidence},
                                     {"n", view.ready->n},
                                     {"decided", view.ready->decided},
                                     {"reliability", nullptr},
                                     {"rules", view.ready->rule_version},
                                     {"overrides", std::move(decisions)},
                                     {"attempts", attempts_of_curve(database, view.result.uuid)}};
  if (view.ready->reliability) evidence["reliability"] = *view.ready->reliability;
  return evidence.dump();
}

}  // namespace trocar::review
