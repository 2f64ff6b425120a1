// everything_about(): what the database holds of one person, row for row, under the names of its columns.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/records/certificate_standing.h"
#include "trainees/records/erasure.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

Json value_of(const sql::Statement& row, int column) {
  switch (row.kind(column)) {
    case sql::Statement::Kind::kNull:
      return nullptr;
    case sql::Statement::Kind::kInteger:
      return row.integer(column);
    case sql::Statement::Kind::kReal:
      return row.real(column);
    case sql::Statement::Kind::kText:
      return row.text(column);
  }
  return nullptr;
}

/// Rows as objects. @param id what ?1 stands for.
Json rows_of(sqlite3* connection, const std::string& query, std::int64_t id) {
  Json list = Json::array();
  sql::Statement rows(connection, query);
  rows.bind(id);
  while (rows.step()) {
    Json object = Json::object();
    for (int column = 0; column < rows.columns(); ++column) object[rows.name(column)] = value_of(rows, column);
    list.push_back(std::move(object));
  }
  return list;
}

Json one_of(const Json& rows) { return rows.empty() ? Json(nullptr) : rows.front(); }

constexpr const char* kAttempts =
    "SELECT a.id, a.uuid, s.uuid AS session, c.sha256 AS calibration_sha256, exercise_id, exercise_version, "
    "ruleset_sha256, level, seed,"
    " board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program, a.started_utc, "
    "status, integrity,"
    " finished_utc, recording_path, recording_sha256, state_hash, device_backend, device_rate_hz, device_ticks, "
    "device_overruns, saturated_contact_share,"
    " passivity_active_share, min_energy_j, kappa, device_fault, device_realtime, device_plant, assists, hash_version, "
    "chain_position, "
    "prev_hash, row_hash"
    " FROM attempt a LEFT JOIN session s ON s.id = a.session_id LEFT JOIN device_calibration c ON c.id = "
    "a.calibration_id"
    " WHERE a.trainee_id = ?1 ORDER BY a.id";

struct Part {
  const char* name;
  const char* query;
};

constexpr Part kOfScore[] = {
    {"metrics", "SELECT name, value, unit FROM metric WHERE score_id = ?1 ORDER BY position"},
    {"subscores",
     "SELECT name, value, weight, raw, unit, full_at, zero_at, gate FROM subscore WHERE score_id = ?1 ORDER BY "
     "position"},
    {"caps",
     "SELECT cap_sentence(kind, subject, below, done, total, at_most) AS reason FROM score_cap WHERE score_id = ?1 "
     "ORDER BY position"},
};

constexpr Part kOfAttempt[] = {
    {"events",
     "SELECT t_s, type, severity, object, value, unit, tip_x_m, tip_y_m, tip_z_m FROM event WHERE attempt_id = ?1"
     " ORDER BY position"},
    {"device_warnings", "SELECT name, first_s, ticks FROM device_warning WHERE attempt_id = ?1 ORDER BY position"},
    {"device_transitions",
     "SELECT t_s, from_state, to_state FROM device_transition WHERE attempt_id = ?1 ORDER BY position"},
    {"ratings", "SELECT uuid, rater, scale, item, value, utc FROM rating WHERE attempt_id = ?1 ORDER BY uuid"},
    {"signatures",
     "SELECT uuid, row_hash, signer, meaning, note, utc FROM signature WHERE attempt_id = ?1 ORDER BY uuid"},
    {"overrides",
     "SELECT uuid, row_hash, printed, passed, reason, utc FROM verdict_override WHERE attempt_id = ?1 ORDER BY uuid"},
};

constexpr Part kOfTrainee[] = {
    {"consents", "SELECT uuid, purpose, given, text, utc FROM consent WHERE trainee_id = ?1 ORDER BY uuid"},
    {"groups", "SELECT group_name FROM membership WHERE trainee_id = ?1 ORDER BY group_name"},
    {"standings", "SELECT uuid, active, reason, printed, utc FROM standing WHERE trainee_id = ?1 ORDER BY uuid"},
    {"assignments",
     "SELECT a.uuid, programme, due, a.printed, a.utc, w.utc AS withdrawn_utc, w.reason AS withdrawn_reason FROM"
     " assignment a LEFT JOIN withdrawal w ON w.assignment_id = a.id AND row_holds('withdrawal', w.id)"
     " WHERE a.trainee_id = ?1 ORDER BY a.uuid"},
    {"sessions", "SELECT uuid, station, started_utc, ended_utc FROM session WHERE trainee_id = ?1 ORDER BY id"},
    {"notes",
     "SELECT n.uuid, a.uuid AS attempt, printed, text, n.utc, s.utc AS seen_utc FROM note n"
     " LEFT JOIN attempt a ON a.id = n.attempt_id LEFT JOIN note_seen s ON s.note_id = n.id WHERE n.trainee_id = ?1"
     " ORDER BY n.uuid"},
    {"certificates",
     "SELECT c.uuid, exercise_id, level, rule_version, evidence, c.printed, c.utc, r.utc AS revoked_utc,"
     " r.printed AS revoked_by, r.reason AS revoked_reason FROM certificate c LEFT JOIN revocation r"
     " ON r.certificate_id = c.id AND row_holds('revocation', r.id) WHERE c.trainee_id = ?1 ORDER BY c.uuid"},
    {"erasures", "SELECT uuid, kind, rule, utc FROM erasure WHERE trainee_id = ?1 ORDER BY uuid"},
};

constexpr const char* kTrail =
    "SELECT position, utc, actor, action, subject, detail FROM audit WHERE actor IN (SELECT uuid FROM account WHERE "
    "trainee_id = ?1)"
    " OR subject IN (SELECT uuid FROM trainee WHERE id = ?1 UNION SELECT uuid FROM account WHERE trainee_id = ?1"
    " UNION SELECT uuid FROM attempt WHERE trainee_id = ?1 UNION SELECT uuid FROM note WHERE trainee_id = ?1"
    " UNION SELECT uuid FROM consent WHERE trainee_id = ?1 UNION SELECT uuid FROM erasure WHERE trainee_id = ?1"
    " UNION SELECT uuid FROM certificate WHERE trainee_id = ?1 UNION SELECT uuid FROM standing WHERE trainee_id = ?1"
    " UNION SELECT uuid FROM assignment WHERE trainee_id = ?1"
    " UNION SELECT w.uuid FROM withdrawal w JOIN assignment a ON a.id = w.assignment_id WHERE a.trainee_id = ?1"
    " UNION SELECT r.uuid FROM revocation r JOIN certificate c ON c.id = r.certificate_id WHERE c.trainee_id = ?1"
    " UNION SELECT r.uuid FROM rating r JOIN attempt a ON a.id = r.attempt_id WHERE a.trainee_id = ?1"
    " UNION SELECT g.uuid FROM signature g JOIN attempt a ON a.id = g.attempt_id WHERE a.trainee_id = ?1"
    " UNION SELECT o.uuid FROM verdict_override o JOIN attempt a ON a.id = o.attempt_id WHERE a.trainee_id = ?1) ORDER "
    "BY position";

/// Every grading of the attempt: the one that counts is revision 0.
Json scores_of(sqlite3* connection, std::int64_t attempt) {
  Json scores = rows_of(connection,
                        "SELECT id, revision, ruleset_sha256, value, passed, grade FROM score WHERE attempt_id = ?1"
                        " ORDER BY revision",
                        attempt);
  for (Json& score : scores) {
    const std::int64_t id = score["id"];
    score.erase("id");
    for (const Part& part : kOfScore) score[part.name] = rows_of(connection, part.query, id);
  }
  return scores;
}

Json attempts_of(const Database& database, std::int64_t trainee) {
  Json attempts = rows_of(database.connection(), kAttempts, trainee);
  for (Json& attempt : attempts) {
    const std::int64_t id = attempt["id"];
    attempt.erase("id");
    const auto file = recording_here(database.file(), attempt["recording_path"].get<std::string>(),
                                     attempt["uuid"].get<std::string>());
    std::error_code none;
    attempt["recording"] = {{"file", file.string()}, {"present", std::filesystem::is_regular_file(file, none)}};
    attempt["scores"] = scores_of(database.connection(), id);
    for (const Part& part : kOfAttempt) attempt[part.name] = rows_of(database.connection(), part.query, id);
  }
  return attempts;
}

/// With what the certificate stands on now.
void add_standings(Database& database, const std::string& code, Json& certificates) {
  for (const Certificate& certificate : AssessmentStore(database).certificates_of(code))
    for (Json& one : certificates)
      if (one["uuid"] == certificate.uuid) one["in_question"] = standing_of(database, certificate).in_question;
}

}  // namespace

std::string everything_about(Database& database, const std::string& trainee) {
  sqlite3* connection = database.connection();
  sql::Statement who(connection,
                     "SELECT id, uuid, code, created_utc FROM known_trainee WHERE code = ?1 COLLATE NOCASE"
                     " OR uuid = lower(?1)");
  if (!who.bind(trainee).step()) throw InputError("trainee \"" + trainee + "\": there is none");
  const std::int64_t id = who.integer(0);
  Json all{
      {"format", "trocar-person-1"}, {"trainee", who.text(1)}, {"code", who.text(2)}, {"created_utc", who.text(3)}};
  const std::string who_code = who.text(2);
  who.run();
  all["person"] = one_of(rows_of(connection, "SELECT code, name, email FROM person WHERE trainee_id = ?1", id));
  all["account"] = one_of(rows_of(connection,
                                  "SELECT uuid, login, name, role, created_utc, disabled_utc FROM account"
                                  " WHERE trainee_id = ?1",
                                  id));
  for (const Part& part : kOfTrainee) all[part.name] = rows_of(connection, part.query, id);
  add_standings(database, who_code, all["certificates"]);
  all["attempts"] = attempts_of(database, id);
  all["audit"] = rows_of(connection, kTrail, id);
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace trocar
