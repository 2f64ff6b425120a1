#include "trainees/records/replica_facts.h"

#include "haptics/input_error.h"
#include "trainees/integrity/audit.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSubject = "replica";

}  // namespace

std::string replica_of(sqlite3* connection) {
  sql::Statement entry(connection, "SELECT detail FROM audit WHERE subject = ? AND action = ?");
  return entry.bind(kSubject).bind(kActionReplica).step() ? entry.text(0) : "";
}

bool is_replica(sqlite3* connection) {
  return !replica_of(connection).empty() ||
         sql::query_integer(connection, "SELECT EXISTS (SELECT 1 FROM replica)") != 0;
}

void mark_replica(sqlite3* connection, const std::string& central_uuid) {
  if (replica_of(connection).empty()) append_audit(connection, kActionReplica, kSubject, central_uuid);
}

void require_no_replica(sqlite3* connection) {
  if (!is_replica(connection)) return;
  throw InputError(
      "this database is a copy of the record of many stations, for a desk: attempts are not recorded into it,"
      " nor trainees added. Give the station's own with --db FILE, or leave --db out");
}

void require_no_replica(const Database& database) { require_no_replica(database.connection()); }

std::string origin_sql(const std::string& row, const std::string& trainee) {
  return "coalesce((SELECT detail FROM audit WHERE subject = " + row + " AND action = '" + kActionLinked +
         "' ORDER BY position DESC LIMIT 1), " + trainee + ")";
}

std::string station_of_attempt(const Database& database, const std::string& attempt_uuid) {
  sql::Statement row(database.connection(),
                     "SELECT s.name FROM attempt a JOIN replica r ON r.attempt_id = a.id"
                     " JOIN station s ON s.uuid = r.station WHERE a.uuid = ?");
  return row.bind(attempt_uuid).step() ? row.text(0) : "";
}

fs::path fetched_recording(const fs::path& database, const std::string& attempt_uuid) {
  return database.parent_path() / (database.stem().string() + ".recordings") / (attempt_uuid + ".trec");
}

fs::path recording_here(const fs::path& database, const std::string& stored, const std::string& attempt_uuid) {
  const fs::path own = located_recording(database, stored);
  std::error_code error;
  if (stored.empty() || database.empty() || fs::exists(own, error)) return own;
  const fs::path fetched = fetched_recording(database, attempt_uuid);
  return fs::exists(fetched, error) ? fetched : own;
}

}  // namespace trocar
