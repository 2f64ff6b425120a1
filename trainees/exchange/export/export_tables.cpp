#include "trainees/exchange/export/export_tables.h"

#include "trainees/records/verdicts.h"

namespace trocar {
namespace {

using Kind = ColumnKind;

constexpr const char* kOfScore =
    " JOIN score s ON s.id = x.score_id JOIN attempt a ON a.id = s.attempt_id WHERE a.id = ? AND s.revision = 0 ORDER "
    "BY x.position";

std::vector<ExportColumn> attempt_columns() {
  return {{"attempt_uuid", "a.uuid"},
          {"trainee_uuid", "t.uuid"},
          {"trainee", "t.code"},
          {"session_uuid", "(SELECT uuid FROM session WHERE id = a.session_id)"},
          {"calibration_sha256", "(SELECT sha256 FROM device_calibration WHERE id = a.calibration_id)"},
          {"exercise", "a.exercise_id"},
          {"exercise_version", "a.exercise_version"},
          {"ruleset_sha256", "a.ruleset_sha256"},
          {"level", "a.level"},
          {"seed", "a.seed", Kind::kInteger},
          {"board", "a.board", Kind::kInteger},
          {"hand", "a.hand"},
          {"assists", "a.assists"},
          {"organ", "a.organ_name"},
          {"organ_source", "a.organ_source"},
          {"organ_sha256", "a.organ_sha256"},
          {"organ_synthetic", "a.organ_synthetic", Kind::kTruth},
          {"organ_credit", "a.organ_credit"},
          {"program", "a.program"},
          {"started_utc", "a.started_utc"},
          {"finished_utc", "a.finished_utc"},
          {"status", "a.status"},
          {"integrity", "a.integrity"},
          {"score_of_100", "s.value", Kind::kReal},
          {"passed", sql::kPassed, Kind::kTruth},
          {"passed_by_score", "s.passed", Kind::kTruth},
          {"decided_by", "o.printed"},
          {"decided_utc", "o.utc"},
          {"grade", "s.grade"},
          {"recording", "a.recording_path"},
          {"recording_sha256", "a.recording_sha256"},
          {"state_hash", "a.state_hash"},
          {"device_backend", "a.device_backend"},
          {"device_rate_hz", "a.device_rate_hz", Kind::kReal},
          {"device_ticks", "a.device_ticks", Kind::kInteger},
          {"device_overruns_ticks", "a.device_overruns", Kind::kInteger},
          {"saturated_contact_share", "a.saturated_contact_share", Kind::kReal},
          {"passivity_active_share", "a.passivity_active_share", Kind::kReal},
          {"min_energy_j", "a.min_energy_j", Kind::kReal},
          {"kappa_1", "a.kappa", Kind::kReal},
          {"device_fault", "a.device_fault"},
          {"device_realtime_json", "a.device_realtime"},
          {"device_plant_json", "a.device_plant"},
          {"hash_version", "a.hash_version", Kind::kInteger},
          {"chain_position", "a.chain_position", Kind::kInteger},
          {"prev_hash", "a.prev_hash"},
          {"row_hash", "a.row_hash"}};
}

ExportTable metrics() {
  return {"metrics",
          {{"attempt_uuid", "a.uuid"}, {"metric", "x.name"}, {"value", "x.value", Kind::kReal}, {"unit", "x.unit"}},
          std::string("FROM metric x") + kOfScore};
}

ExportTable subscores() {
  return {"subscores",
          {{"attempt_uuid", "a.uuid"},
           {"subscore", "x.name"},
           {"value_of_1", "x.value", Kind::kReal},
           {"weight_of_1", "x.weight", Kind::kReal},
           {"raw", "x.raw", Kind::kReal},
           {"unit", "x.unit"},
           {"full_at", "x.full_at", Kind::kReal},
           {"zero_at", "x.zero_at", Kind::kReal},
           {"gate", "x.gate", Kind::kTruth}},
          std::string("FROM subscore x") + kOfScore};
}

ExportTable caps() {
  return {
      "caps",
      {{"attempt_uuid", "a.uuid"}, {"reason", "cap_sentence(x.kind, x.subject, x.below, x.done, x.total, x.at_most)"}},
      std::string("FROM score_cap x") + kOfScore};
}

ExportTable events() {
  return {"events",
          {{"attempt_uuid", "a.uuid"},
           {"t_s", "x.t_s", Kind::kReal},
           {"type", "x.type"},
           {"severity", "x.severity"},
           {"object", "nullif(x.object, -1)", Kind::kInteger},
           {"value", "x.value", Kind::kReal},
           {"unit", "x.unit"},
           {"tip_x_m", "x.tip_x_m", Kind::kReal},
           {"tip_y_m", "x.tip_y_m", Kind::kReal},
           {"tip_z_m", "x.tip_z_m", Kind::kReal}},
          "FROM event x JOIN attempt a ON a.id = x.attempt_id WHERE a.id = ? ORDER BY x.position"};
}

ExportTable notes() {
  return {"notes",
          {{"attempt_uuid", "a.uuid"},
           {"note_uuid", "x.uuid"},
           {"trainee_uuid", "t.uuid"},
           {"author_account_uuid", "x.author"},
           {"author", "x.printed"},
           {"text", "x.text"},
           {"utc", "x.utc"},
           {"seen_utc", "(SELECT utc FROM note_seen WHERE note_id = x.id)"}},
          "FROM note x JOIN trainee t ON t.id = x.trainee_id JOIN attempt a ON a.id = x.attempt_id WHERE a.id = ? "
          "ORDER BY x.uuid"};
}

ExportTable ratings() {
  return {"ratings",
          {{"attempt_uuid", "a.uuid"},
           {"rating_uuid", "x.uuid"},
           {"rater_account_uuid", "x.account_uuid"},
           {"rater", "x.rater"},
           {"scale", "x.scale"},
           {"item", "x.item"},
           {"value", "x.value", Kind::kReal},
           {"utc", "x.utc"}},
          "FROM rating x JOIN attempt a ON a.id = x.attempt_id WHERE a.id = ? ORDER BY x.uuid"};
}

ExportTable signatures() {
  return {"signatures",
          {{"attempt_uuid", "a.uuid"},
           {"signature_uuid", "x.uuid"},
           {"row_hash", "x.row_hash"},
           {"signer_account_uuid", "x.account_uuid"},
           {"signer", "x.signer"},
           {"meaning", "x.meaning"},
           {"note", "x.note"},
           {"utc", "x.utc"}},
          "FROM signature x JOIN attempt a ON a.id = x.attempt_id WHERE a.id = ? ORDER BY x.uuid"};
}

ExportTable overrides() {
  return {"overrides",
          {{"attempt_uuid", "a.uuid"},
           {"override_uuid", "x.uuid"},
           {"row_hash", "x.row_hash"},
           {"author_account_uuid", "x.author"},
           {"author", "x.printed"},
           {"passed", "x.passed", Kind::kTruth},
           {"reason", "x.reason"},
           {"utc", "x.utc"}},
          "FROM verdict_override x JOIN attempt a ON a.id = x.attempt_id WHERE a.id = ? ORDER BY x.uuid"};
}

}  // namespace

const ExportTable& attempts_table() {
  static const std::string rows = std::string(
                                      "FROM attempt a JOIN known_trainee t ON t.id = a.trainee_id"
                                      " LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0") +
                                  sql::decision() + " WHERE a.id = ?";
  static const ExportTable table{"attempts", attempt_columns(), rows};
  return table;
}

const std::vector<ExportTable>& attempt_parts() {
  static const std::vector<ExportTable> parts{metrics(), subscores(), caps(),       events(),
                                              notes(),   ratings(),   signatures(), overrides()};
  return parts;
}

const char* notes_of_trainee() {
  return "FROM note x JOIN trainee t ON t.id = x.trainee_id LEFT JOIN attempt a ON 0"
         " WHERE x.attempt_id IS NULL AND x.trainee_id = ? ORDER BY x.uuid";
}

}  // namespace trocar
