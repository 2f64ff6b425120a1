#include "trainees/records/erasure.h"

#include <sqlite3.h>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_rows.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/replica_facts.h"
#include "trainees/records/signing.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

struct Erased {
  std::int64_t id = 0;
  std::string uuid, erasure;  ///< of the trainee, of the row in `erasure`
};

struct KeptRecording {
  std::string uuid, sha256;
  fs::path file;
};

// ?1: the trainee.
const std::string kOnAttempts = "attempt_id IN (SELECT id FROM attempt WHERE trainee_id = ?1)";
const std::string kOwnWords = "account_uuid IN (SELECT uuid FROM account WHERE trainee_id = ?1) AND " + kOnAttempts;

const char* kind_name(ErasureKind kind) { return kind == ErasureKind::kIdentity ? "identity" : "training"; }

Erased trainee_to_erase(sqlite3* connection, const std::string& code) {
  sql::Statement row(connection,
                     "SELECT id, uuid FROM known_trainee WHERE code = ?1 COLLATE NOCASE OR uuid = lower(?1)");
  if (!row.bind(code).step()) throw InputError("trainee \"" + code + "\": there is none");
  const Erased erased{row.integer(0), row.text(1), ""};
  if (row.step()) throw InputError("trainee \"" + code + "\": stands for several");
  sql::Statement running(connection, "SELECT uuid FROM attempt WHERE trainee_id = ? AND status = 'running'");
  if (!running.bind(erased.id).step()) return erased;
  throw InputError("trainee \"" + code + "\": attempt " + running.text(0) + " is running; erase when it has ended");
}

/// The record of the erasure comes first: the triggers ask for it.
void record_erasure(sqlite3* connection, Erased& erased, ErasureKind kind, const std::string& rule,
                    const Author& author) {
  sql::Statement known(connection,
                       "SELECT uuid FROM erasure WHERE trainee_id = ? AND kind IN (?, 'training') AND"
                       " row_holds('erasure', id)");
  if (known.bind(erased.id).bind(kind_name(kind)).step()) {
    erased.erasure = known.text(0);
    return;
  }
  erased.erasure = make_uuid();
  sql::Statement insert(connection,
                        "INSERT INTO erasure (uuid, trainee_id, kind, rule, author, utc) VALUES (?, ?, ?, ?, ?, ?)");
  insert.bind(erased.erasure)
      .bind(erased.id)
      .bind(kind_name(kind))
      .bind(rule)
      .bind(author.account_uuid)
      .bind(utc_now())
      .run();
  seal_row(connection, "erasure", erased.erasure, author.account_uuid);
}

/// Deletes rows of a sealed table, each with its entry. @param where with the trainee's number as ?1. @returns how
/// many.
int erase_rows(sqlite3* connection, const Erased& erased, const std::string& table, const std::string& where,
               const Author& author) {
  std::vector<std::string> uuids;
  sql::Statement rows(connection, "SELECT uuid FROM " + table + " WHERE " + where + " ORDER BY uuid");
  rows.bind(erased.id);
  while (rows.step()) uuids.push_back(rows.text(0));
  for (const std::string& uuid : uuids) note_erased_row(connection, table, uuid, erased.erasure, author.account_uuid);
  sql::Statement(connection, "DELETE FROM " + table + " WHERE " + where).bind(erased.id).run();
  return static_cast<int>(uuids.size());
}

void remove_rows(sqlite3* connection, const Erased& erased, const std::string& table, const std::string& where) {
  sql::Statement(connection, "DELETE FROM " + table + " WHERE " + where).bind(erased.id).run();
}

/// @returns how many notes went.
int erase_identity(sqlite3* connection, const Erased& erased, const Author& author) {
  for (const char* table : {"signature", "rating"}) erase_rows(connection, erased, table, kOwnWords, author);
  remove_rows(connection, erased, "note_seen", "note_id IN (SELECT id FROM note WHERE trainee_id = ?1)");
  const int notes = erase_rows(connection, erased, "note", "trainee_id = ?1", author);
  erase_rows(connection, erased, "withdrawal", "assignment_id IN (SELECT id FROM assignment WHERE trainee_id = ?1)",
             author);
  for (const char* table : {"consent", "account", "standing", "assignment"})
    erase_rows(connection, erased, table, "trainee_id = ?1", author);
  for (const char* table : {"membership", "person"}) remove_rows(connection, erased, table, "trainee_id = ?1");
  return notes;
}

void erase_training(sqlite3* connection, const Erased& erased, const Author& author) {
  for (const char* table : {"rating", "signature", "verdict_override"})
    erase_rows(connection, erased, table, kOnAttempts, author);
  erase_rows(connection, erased, "revocation", "certificate_id IN (SELECT id FROM certificate WHERE trainee_id = ?1)",
             author);
  erase_rows(connection, erased, "certificate", "trainee_id = ?1", author);
  sql::Statement attempts(connection, "SELECT id FROM attempt WHERE trainee_id = ?");
  attempts.bind(erased.id);
  while (attempts.step()) remove_attempt_rows(connection, attempts.integer(0));
}

std::vector<KeptRecording> recordings_of(const Database& database, const Erased& erased) {
  std::vector<KeptRecording> recordings;
  sql::Statement rows(database.connection(),
                      "SELECT uuid, recording_sha256, recording_path FROM attempt WHERE trainee_id = ?"
                      " AND recording_path <> '' ORDER BY id");
  rows.bind(erased.id);
  while (rows.step())
    recordings.push_back({rows.text(0), rows.text(1), recording_here(database.file(), rows.text(2), rows.text(0))});
  return recordings;
}

/// What lies beside a recording under its name: the loop's memory of a stop, films.
std::vector<fs::path> files_of(const KeptRecording& recording) {
  const std::string stem = recording.file.stem().string() + ".";
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(recording.file.parent_path(), none)) {
    if (entry.path().filename().string().starts_with(stem) && entry.is_regular_file(none))
      files.push_back(entry.path());
  }
  return files;
}

/// Only what is known to be the attempt's: the row that names it may have been changed, and a name given by --record
/// may stand for another file by now.
void remove_recording(const fs::path& database, const KeptRecording& recording, const fs::path& film,
                      ErasureReport& report) {
  std::error_code error;
  if (!is_name_of_attempt(recording.uuid)) {
    report.left.push_back(recording.file.string() + ": attempt " + recording.uuid + " has no name of trocar's");
    return;
  }
  if (fs::remove(film, error))
    report.recordings.push_back(film);
  else if (error)
    report.left.push_back(film.string() + ": cannot be removed: " + error.message());
  if (!fs::exists(recording.file, error)) return;
  const bool own_name = recording.file == fetched_recording(database, recording.uuid);
  if (!own_name && digest::of_readable_file(recording.file) != recording.sha256) {
    report.left.push_back(recording.file.string() + ": is not what attempt " + recording.uuid +
                          " recorded; it was left");
    return;
  }
  fs::path stop = recording.file;
  stop.replace_extension(".safety.csv");
  for (const fs::path& file : own_name ? files_of(recording) : std::vector<fs::path>{recording.file, stop}) {
    if (fs::remove(file, error))
      report.recordings.push_back(file);
    else if (error)
      report.left.push_back(file.string() + ": cannot be removed: " + error.message());
  }
}

/// The log still holds the old pages until it is copied back and cut off.
void empty_log(const Database& database, ErasureReport& report) {
  if (database.in_memory()) return;
  sql::Statement checkpoint(database.connection(), "PRAGMA wal_checkpoint(TRUNCATE)");
  if (checkpoint.step() && checkpoint.integer(0) == 0) return;
  report.left.push_back(database.file().string() +
                        "-wal: another program reads the database; the log keeps erased pages until all have ended");
}

int count_of(sqlite3* connection, std::int64_t trainee, const std::string& what) {
  sql::Statement row(connection, "SELECT count(*) FROM " + what);
  return row.bind(trainee).step() ? static_cast<int>(row.integer(0)) : 0;
}

}  // namespace

ErasurePreview preview_erasure(Database& database, const std::string& trainee, ErasureKind kind) {
  sqlite3* connection = database.connection();
  const Erased erased = trainee_to_erase(connection, trainee);
  const auto count = [&](const std::string& what) { return count_of(connection, erased.id, what); };
  const bool training = kind == ErasureKind::kTraining;
  ErasurePreview preview;
  sql::Statement who(
      connection,
      "SELECT t.code, coalesce(max(a.started_utc), t.created_utc) FROM known_trainee t LEFT JOIN attempt a"
      " ON a.trainee_id = t.id WHERE t.id = ?");
  who.bind(erased.id).step();
  preview.code = who.text(0);
  preview.trainee_uuid = erased.uuid;
  preview.last_utc = who.text(1);
  preview.attempts = count("attempt WHERE trainee_id = ?1");
  preview.notes = count("note WHERE trainee_id = ?1");
  preview.consents = count("consent WHERE trainee_id = ?1");
  preview.groups = count("membership WHERE trainee_id = ?1");
  preview.accounts = count("account WHERE trainee_id = ?1");
  for (const char* table : {"signature", "rating"})
    preview.assessments += count(table + (" WHERE " + (training ? kOnAttempts : kOwnWords)));
  if (!training) return preview;
  preview.assessments += count("verdict_override WHERE " + kOnAttempts);
  preview.certificates = count("certificate WHERE trainee_id = ?1");
  std::error_code error;
  for (const KeptRecording& recording : recordings_of(database, erased))
    preview.recordings += fs::is_regular_file(recording.file, error);
  return preview;
}

ErasureReport erase_trainee(Database& database, const std::string& trainee, ErasureKind kind, const std::string& rule,
                            const Author& author) {
  check_printed("rule", rule, 200);
  sqlite3* connection = database.connection();
  ErasureReport report;
  std::vector<KeptRecording> recordings;
  {
    AnchoredTransaction transaction(database);
    require_key(database);
    Erased erased = trainee_to_erase(connection, trainee);
    record_erasure(connection, erased, kind, rule, author);
    report.trainee_uuid = erased.uuid;
    report.notes = erase_identity(connection, erased, author);
    sql::Statement attempts(connection, "SELECT count(*) FROM attempt WHERE trainee_id = ?");
    if (attempts.bind(erased.id).step()) report.attempts = static_cast<int>(attempts.integer(0));
    attempts.run();
    if (kind == ErasureKind::kTraining) {
      erase_training(connection, erased, author);
      recordings = recordings_of(database, erased);
    }
    transaction.commit();
  }
  const fs::path films = database.file().parent_path() / (database.file().stem().string() + ".films");  // the desk's
  for (const KeptRecording& recording : recordings)
    remove_recording(database.file(), recording, films / (recording.uuid + ".mp4"), report);
  empty_log(database, report);
  return report;
}

std::vector<std::string> older_than(Database& database, int days, const std::string& now_utc) {
  std::vector<std::string> codes;
  sql::Statement rows(
      database.connection(),
      "SELECT p.code FROM person p JOIN trainee t ON t.id = p.trainee_id LEFT JOIN attempt a ON a.trainee_id = t.id"
      " GROUP BY t.id HAVING julianday(?1) - julianday(max(coalesce(a.started_utc, t.created_utc))) > ?2"
      " AND count(*) FILTER (WHERE a.status = 'running') = 0 ORDER BY p.code");
  rows.bind(now_utc).bind(days);
  while (rows.step()) codes.push_back(rows.text(0));
  return codes;
}

}  // namespace trocar
