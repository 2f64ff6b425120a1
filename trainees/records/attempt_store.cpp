#include "trainees/records/attempt_store.h"

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_rows.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/process_identity.h"
#include "trainees/records/replica_facts.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShortestName = 4, kWholeUuid = 36;

std::string summaries() { return summary_query("t.code", " JOIN known_trainee t ON t.id = a.trainee_id"); }

AttemptStatus status_of(const std::string& name) {
  for (const AttemptStatus status : {AttemptStatus::kCompleted, AttemptStatus::kTimeout, AttemptStatus::kAborted,
                                     AttemptStatus::kFault, AttemptStatus::kVoid}) {
    if (name == status_name(status)) return status;
  }
  throw InputError("database: the attempt is still " + name);
}

/// trocar.db -> trocar.recordings/UUID.trec
fs::path recording_beside(const Database& database, const std::string& uuid) {
  if (database.in_memory()) return {};
  return recordings_folder(database.file()) / (uuid + ".trec");
}

/// An attempt is stored before its recording is made, so one without the other was removed. One that was kept without a
/// recording has none (another's lay in its place).
std::vector<std::string> stray_recordings(const Database& database) {
  std::vector<std::string> strays;
  std::error_code error;
  sql::Statement known(database.connection(),
                       "SELECT status = 'running' OR recording_sha256 <> '' FROM attempt WHERE uuid = ?");
  for (const auto& entry : fs::directory_iterator(recording_beside(database, "").parent_path(), error)) {
    if (entry.path().extension() != ".trec") continue;
    const bool attempt = known.bind(entry.path().stem().string()).step(), its = attempt && known.integer(0) != 0;
    known.run();
    if (its) continue;
    strays.push_back("recording " + entry.path().string() +
                     (attempt ? " bears the name of an attempt that was kept without one"
                              : " belongs to no attempt of this database"));
  }
  std::sort(strays.begin(), strays.end());
  return strays;
}

std::string looked_at(const std::vector<fs::path>& places) {
  std::string all;
  for (const fs::path& place : places) all += (all.empty() ? "" : ", ") + place.string();
  return places.size() < 2 ? "" : " (looked for: " + all + ")";
}

/// The session's row, made by its first attempt. @throws InputError: another trainee's.
std::optional<std::int64_t> session_row(sqlite3* connection, const AttemptStart& start, std::int64_t trainee,
                                        const std::string& utc) {
  if (start.session.empty()) return std::nullopt;
  sql::Statement insert(connection,
                        "INSERT INTO session (uuid, trainee_id, station, started_utc) SELECT ?1, ?2, ?3, ?4"
                        " WHERE NOT EXISTS (SELECT 1 FROM session WHERE uuid = ?1)");
  insert.bind(start.session).bind(trainee).bind(start.station).bind(utc).run();
  sql::Statement row(connection, "SELECT id, trainee_id FROM session WHERE uuid = ?");
  row.bind(start.session).step();
  if (row.integer(1) != trainee) throw InputError("session " + start.session + ": is another trainee's");
  return row.integer(0);
}

/// The calibration's row; the same bytes are kept once.
std::optional<std::int64_t> calibration_row(sqlite3* connection, const AttemptStart& start, const std::string& utc) {
  if (start.calibration.empty()) return std::nullopt;
  const std::string sha256 = digest::of_bytes(start.calibration);
  sql::Statement insert(connection,
                        "INSERT INTO device_calibration (device, sha256, toml, utc) SELECT ?1, ?2, ?3, ?4"
                        " WHERE NOT EXISTS (SELECT 1 FROM device_calibration WHERE sha256 = ?2)");
  insert.bind(start.calibration_device).bind(sha256).bind(start.calibration).bind(utc).run();
  sql::Statement row(connection, "SELECT id FROM device_calibration WHERE sha256 = ?");
  row.bind(sha256).step();
  return row.integer(0);
}

void insert_attempt(sqlite3* connection, const AttemptStart& start, std::int64_t trainee,
                    const std::string& stored_recording, const AttemptId& id) {
  sql::Statement exercise(connection,
                          "INSERT INTO exercise VALUES (?, ?, ?)"
                          " ON CONFLICT (id) DO UPDATE SET number = excluded.number, title = excluded.title"
                          " WHERE number = '' AND (excluded.number, excluded.title) <> (number, title) RETURNING 1");
  const bool told = exercise.bind(start.exercise_id).bind(start.exercise_number).bind(start.exercise_title).step();
  exercise.run();
  told ? keep_exercise(connection, start.exercise_id) : keep_exercise_once(connection, start.exercise_id);
  sql::Statement ruleset(connection,
                         "INSERT INTO ruleset SELECT ?1, ?2, ?3, ?4"
                         " WHERE NOT EXISTS (SELECT 1 FROM ruleset WHERE sha256 = ?1)");
  ruleset.bind(id.rubric_sha256).bind(start.exercise_id).bind(start.exercise_version).bind(start.exercise_text).run();
  const ProcessIdentity owner = this_process();
  const auto session = session_row(connection, start, trainee, id.started_utc);
  const auto calibration = calibration_row(connection, start, id.started_utc);
  sql::Statement insert(
      connection,
      "INSERT INTO attempt (uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed,"
      " board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc,"
      " owner_pid, owner_boot, owner_start, recording_path, program, assists, hash_version, session_id, calibration_id,"
      " status)"
      " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, 'running')");
  insert.bind(id.uuid).bind(trainee).bind(start.exercise_id).bind(start.exercise_version).bind(id.rubric_sha256);
  insert.bind(start.level).bind(start.seed).bind(start.board).bind(start.hand).bind(start.organ_name);
  insert.bind(start.organ_source).bind(start.organ_sha256).bind(start.organ_synthetic).bind(start.organ_credit);
  insert.bind(id.started_utc).bind(owner.pid).bind(owner.boot).bind(owner.start).bind(stored_recording);
  insert.bind(start.program).bind(start.assists).bind(kHashVersion);
  for (const std::optional<std::int64_t>& row : {session, calibration}) row ? insert.bind(*row) : insert.bind_null();
  insert.run();
}

constexpr const char* kResultColumns =
    "SELECT a.uuid, exercise_id, exercise_version, level, seed, board, t.code, hand, status, s.value,"
    " coalesce(s.passed, 0), coalesce(s.grade, 'not graded'),"
    " device_backend, device_rate_hz, device_ticks, device_overruns, saturated_contact_share, passivity_active_share,"
    " min_energy_j, kappa, device_fault, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit,"
    " a.ruleset_sha256, recording_sha256, recording_path, state_hash, started_utc, integrity, device_realtime, cut_off,"
    " device_plant, assists"
    " FROM attempt a JOIN known_trainee t ON t.id = a.trainee_id"
    " LEFT JOIN score s ON s.attempt_id = a.id AND s.revision = 0 WHERE a.id = ?";

RunReport run_report_of(const sql::Statement& row) {
  RunReport device;
  device.backend = row.text(12);
  device.rate_hz = row.real(13);
  device.ticks = static_cast<std::uint64_t>(row.integer(14));
  device.overruns = static_cast<std::uint64_t>(row.integer(15));
  device.saturated_contact_share = row.real(16);
  device.passivity_active_share = row.real(17);
  device.min_energy_j = row.real(18);
  device.kappa = row.real(19);
  device.fault = row.text(20);
  device.realtime = row.text(32);
  device.plant = row.text(34);
  return device;
}

AttemptResult result_of(const sql::Statement& row, const fs::path& database) {
  AttemptResult result;
  result.uuid = row.text(0);
  result.exercise_id = row.text(1);
  result.exercise_version = row.text(2);
  result.level = row.text(3);
  result.seed = row.integer(4);
  result.board = static_cast<int>(row.integer(5));
  result.trainee = row.text(6);
  result.hand = row.text(7);
  result.assists = row.text(35);
  result.grade.status = status_of(row.text(8));
  result.grade.score = row.optional_real(9);
  result.grade.passed = row.integer(10) != 0;
  result.grade.grade = row.text(11);
  result.device = run_report_of(row);
  result.organ_name = row.text(21);
  result.organ_source = row.text(22);
  result.organ_sha256 = row.text(23);
  result.organ_synthetic = row.integer(24) != 0;
  result.organ_credit = row.text(25);
  result.rubric_sha256 = row.text(26);
  result.recording_sha256 = row.text(27);
  result.recording_path = recording_here(database, row.text(28), result.uuid).string();
  result.state_hash = row.text(29);
  result.started_utc = row.text(30);
  result.integrity = row.text(31);
  result.cut_off = row.integer(33) != 0;
  return result;
}

/// The number that a name is; empty for what is none. UUIDs of our time begin with 0, numbers do not.
std::optional<std::int64_t> attempt_number(std::string_view name) {
  constexpr std::size_t kLongest = 15;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || name.size() > kLongest || name.front() == '0' || !std::all_of(name.begin(), name.end(), digit))
    return std::nullopt;
  std::int64_t number = 0;
  for (const char c : name) number = 10 * number + (c - '0');
  return number;
}

void check_name(std::string_view name) {
  const auto allowed = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '-'; };
  if (name.size() < kShortestName || !std::all_of(name.begin(), name.end(), allowed)) {
    throw InputError("\"" + std::string(name) + "\": give at least " + std::to_string(kShortestName) +
                     " characters of an identifier (for an attempt also of its end, its number, or \"latest\")");
  }
}

/// An exam board is met once, however the first sitting ended. Seeds do not tell: two of them can draw one board.
void refuse_second_exam(sqlite3* connection, const AttemptStart& start, std::int64_t trainee) {
  sql::Statement taken(connection,
                       "SELECT uuid, started_utc, status FROM attempt WHERE trainee_id = ? AND exercise_id = ?"
                       " AND board = ? AND level = ?");
  if (!taken.bind(trainee).bind(start.exercise_id).bind(start.board).bind(kExamLevel).step()) return;
  throw InputError("exam of " + start.exercise_id + ", board " + std::to_string(start.board) + ": " + start.trainee +
                   " sat it on " + taken.text(1) + " (attempt " + taken.text(0) + ", " + taken.text(2) +
                   "); an exam board is met once, take another --seed");
}

}  // namespace

AttemptId AttemptStore::begin_attempt(const AttemptStart& start) {
  sqlite3* connection = database_->connection();
  AttemptId id;
  id.uuid = make_uuid();
  id.recording = start.recording.value_or(recording_beside(*database_, id.uuid));
  id.rubric_sha256 = digest::of_bytes(start.exercise_text);
  id.started_utc = start.started_utc.empty() ? utc_now() : start.started_utc;
  AnchoredTransaction transaction(*database_);
  require_no_replica(connection);
  require_no_demo(*database_, "no attempt of anybody is kept there. Give another with --db FILE");
  const std::int64_t trainee = TraineeStore(*database_).ensure_id(start.trainee);
  require_active(connection, trainee);
  if (start.level == kExamLevel) refuse_second_exam(connection, start, trainee);
  insert_attempt(connection, start, trainee, stored_recording_path(database_->file(), id.recording), id);
  sql::Statement row(connection, "SELECT id FROM attempt WHERE uuid = ?");
  row.bind(id.uuid).step();
  id.row = row.integer(0);
  if (!database_->in_memory()) {  // what vanishes with the program binds nothing, and equal runs give equal files
    id.key = station_key(database_->file());
    id.identity = identity_of(connection, id.uuid, id.key ? id.key->public_key() : "");
    audit_begun(connection, id.uuid);
  }
  transaction.commit();
  return id;
}

void AttemptStore::finish_attempt(const AttemptId& id, const AttemptResult& result, const std::string& finished_utc) {
  sqlite3* connection = database_->connection();
  if (!finished_utc.empty() && finished_utc < id.started_utc) {
    throw InputError("attempt " + id.uuid + ": cannot end at " + finished_utc + ", before it began at " +
                     id.started_utc);
  }
  if (!result.rubric_sha256.empty() && result.rubric_sha256 != id.rubric_sha256) {
    throw std::invalid_argument("the result was graded by another rubric than the attempt began with");
  }
  const fs::path recording = result.recording_path.empty() ? id.recording : fs::path(result.recording_path);
  AnchoredTransaction transaction(*database_);
  {
    sql::Statement status(connection, "SELECT status FROM attempt WHERE id = ? AND uuid = ?");
    if (!status.bind(id.row).bind(id.uuid).step()) throw InputError("attempt " + id.uuid + ": not in this database");
    if (status.text(0) != "running") {
      throw InputError("attempt " + id.uuid + ": is already " + status.text(0) + " and cannot be finished again");
    }
  }
  if (!id.identity.empty() && (identity_of(connection, id.uuid, id.key ? id.key->public_key() : "") != id.identity ||
                               !as_begun(connection, id.uuid)))
    throw InputError("attempt " + id.uuid + ": its row was changed while it ran; it is not graded");
  write_result(connection, id.row, result, stored_recording_path(database_->file(), recording), finished_utc);
  transaction.commit();
}

AttemptResult AttemptStore::load(std::int64_t row) const {
  sqlite3* connection = database_->connection();
  sql::Statement attempt(connection, kResultColumns);
  if (!attempt.bind(row).step()) throw InputError("attempt " + std::to_string(row) + ": not in this database");
  AttemptResult result = result_of(attempt, database_->file());
  read_attempt_rows(connection, row, result);
  return result;
}

AttemptSummary AttemptStore::find(std::string_view name) const {
  if (name == "latest") {
    if (const auto newest = latest()) return *newest;
    throw InputError("there is no attempt yet");
  }
  const auto number = attempt_number(name);
  if (number) {
    sql::Statement row(database_->connection(), summaries() + " WHERE a.id = ?");
    if (row.bind(*number).step()) return summary_of(row);
    if (name.size() < kShortestName)
      throw InputError("attempt " + std::string(name) + ": no attempt of this database has that number");
  }
  check_name(name);
  if (name.size() == kWholeUuid) {  // the usual way, by the index
    sql::Statement row(database_->connection(), summaries() + " WHERE a.uuid = ?");
    if (row.bind(name).step()) return summary_of(row);
  }
  sql::Statement rows(database_->connection(),
                      summaries() + " WHERE a.uuid LIKE ?1 || '%' OR a.uuid LIKE '%' || ?1 LIMIT 2");
  if (!rows.bind(name).step()) {
    throw InputError("attempt " + std::string(name) + ": not in this database" +
                     (number ? ", neither as a number nor in an identifier" : ""));
  }
  const AttemptSummary found = summary_of(rows);
  if (rows.step()) throw InputError("attempt " + std::string(name) + ": several begin or end so; give more of it");
  return found;
}

std::vector<AttemptSummary> AttemptStore::list(const AttemptFilter& filter) const {
  // By the trainee's row, which has an index; a code has none in the view.
  const std::string whose = filter.trainee.empty()
                                ? "?1 = ''"
                                : "a.trainee_id IN (SELECT id FROM known_trainee WHERE code = ?1 COLLATE NOCASE)";
  sql::Statement rows(database_->connection(), summaries() + " WHERE " + whose +
                                                   " AND (?2 = '' OR exercise_id = ?2) ORDER BY a.id DESC LIMIT ?3");
  rows.bind(filter.trainee).bind(filter.exercise_id).bind(filter.limit > 0 ? filter.limit : -1);
  std::vector<AttemptSummary> attempts;
  while (rows.step()) attempts.push_back(summary_of(rows));
  return attempts;
}

std::optional<AttemptSummary> AttemptStore::latest(const std::string& trainee) const {
  const auto newest = list({trainee, "", 1});
  if (newest.empty()) return std::nullopt;
  return newest.front();
}

std::string AttemptStore::exercise_text(const std::string& rubric_sha256) const {
  check_name(rubric_sha256);
  sql::Statement rows(database_->connection(), "SELECT toml FROM ruleset WHERE sha256 LIKE ? || '%' LIMIT 2");
  if (!rows.bind(rubric_sha256).step()) throw InputError("rubric " + rubric_sha256 + ": not in this database");
  const std::string text = rows.text(0);
  if (rows.step()) throw InputError("rubric " + rubric_sha256 + ": several begin so; give more of it");
  return text;
}

std::string AttemptStore::recording_problem(const std::string& attempt_uuid, const std::string& identity,
                                            const std::string& signed_by) const {
  sqlite3* connection = database_->connection();
  sql::Statement attempt(connection, "SELECT hash_version FROM attempt WHERE uuid = ?");
  if (!attempt.bind(attempt_uuid).step()) throw InputError("attempt " + attempt_uuid + ": not in this database");
  const bool unbound = attempt.integer(0) < kFirstBoundVersion && !began_here(connection, attempt_uuid);
  if (unbound || database_->in_memory() || is_demo(*database_)) return "";
  const auto said = nlohmann::ordered_json::parse(identity, nullptr, false);
  if (!said.is_object()) return "does not say whose it is";
  const auto key = said.find("key");
  if (key == said.end() || !key->is_string()) return "does not say whose key signs it";
  const auto wanted = nlohmann::ordered_json::parse(identity_of(connection, attempt_uuid, key->get<std::string>()));
  for (const auto& [name, value] : wanted.items())
    if (said.value(name, nlohmann::ordered_json()) != value)
      return "is of another attempt: " + name + " " + said.value(name, nlohmann::ordered_json()).dump() +
             " instead of " + value.dump();
  const auto keys = announced_keys(connection);
  const std::string holder = key_of_attempt(connection, attempt_uuid);
  const bool known = holder.empty() ? std::any_of(keys.begin(), keys.end(),
                                                  [&](const AnnouncedKey& one) { return one.public_key == signed_by; })
                                    : holder == signed_by;
  // The keys of another station stand in its own trail.
  if (known || (keys.empty() && signed_by.empty()) ||
      (!signed_by.empty() && came_from_elsewhere(connection, attempt_uuid)))
    return "";
  if (keys.empty()) return "is signed with a key that the record no longer names";
  return signed_by.empty() ? "is not signed with the station's key" : "is signed with another station's key";
}

std::vector<std::string> AttemptStore::check_recordings() const {
  std::vector<std::string> problems;
  sql::Statement twice(database_->connection(),
                       "SELECT min(uuid), max(uuid) FROM attempt WHERE recording_sha256 NOT IN ('', ?)"
                       " GROUP BY recording_sha256 HAVING count(*) > 1 ORDER BY 1");
  twice.bind(digest::of_bytes(""));  // their programs were killed before the first byte
  while (twice.step())
    problems.push_back("one recording counts for two attempts: " + twice.text(0) + " and " + twice.text(1));
  sql::Statement rows(
      database_->connection(),
      "SELECT uuid, recording_path, recording_sha256, EXISTS (SELECT 1 FROM erasure e WHERE e.trainee_id = a.trainee_id"
      " AND e.kind = 'training' AND row_holds('erasure', e.id)) FROM attempt a WHERE status <> 'running'"
      " AND recording_sha256 <> ''"
      " AND id NOT IN (SELECT attempt_id FROM replica) ORDER BY id");  // other stations keep their recordings
  while (rows.step()) {
    const fs::path file = recording_here(database_->file(), rows.text(1), rows.text(0));
    const std::string name = "recording " + file.string() + " of attempt " + rows.text(0);
    std::error_code error;
    const bool there = !file.empty() && fs::is_regular_file(file, error);
    if (rows.integer(3) != 0) {
      if (!there) continue;
      problems.push_back(name + " is still there although its training data were erased (erasing again removes it)");
    } else if (!there) {
      problems.push_back(name + " is missing" + looked_at(recording_places(database_->file(), rows.text(1))));
    } else if (fs::file_size(file, error) > kLargestRecording || digest::of_readable_file(file) != rows.text(2)) {
      problems.push_back(name + " was changed or cannot be read");
    }
  }
  for (const std::string& stray : stray_recordings(*database_)) problems.push_back(stray);
  return problems;
}

bool recording_exchanged(const AttemptResult& stored) {
  std::error_code none;
  return !stored.recording_sha256.empty() && fs::is_regular_file(stored.recording_path, none) &&
         (fs::file_size(stored.recording_path, none) > kLargestRecording ||
          digest::of_readable_file(stored.recording_path) != stored.recording_sha256);
}

}  // namespace trocar
