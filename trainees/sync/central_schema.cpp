#include "trainees/sync/central_schema.h"

#include "trainees/sync/carried_rows.h"

namespace trocar::sync {
namespace {

// received, last_seen: the centre's clock. No table is ordered by a clock, the stations' own least of all.
constexpr const char* kOwnTables[] = {
    "CREATE TABLE central (uuid text PRIMARY KEY, version integer NOT NULL)",
    "CREATE TABLE station (uuid text PRIMARY KEY, name text NOT NULL, first_seen timestamptz NOT NULL DEFAULT clock_timestamp(),"
    " last_seen timestamptz NOT NULL DEFAULT clock_timestamp(), last_position bigint NOT NULL DEFAULT 0)",
    "CREATE TABLE audit (station text NOT NULL, position bigint NOT NULL, utc text NOT NULL, actor text NOT NULL, action text NOT NULL,"
    " subject text NOT NULL, detail text NOT NULL, prev_hash text NOT NULL, row_hash text NOT NULL,"
    " received timestamptz NOT NULL DEFAULT clock_timestamp(), PRIMARY KEY (station, position))",
    "CREATE TABLE conflict (station text NOT NULL, kind text NOT NULL, uuid text NOT NULL, hash text NOT NULL, kept text NOT NULL,"
    " received timestamptz NOT NULL DEFAULT clock_timestamp(), PRIMARY KEY (station, kind, uuid, hash))",
};

constexpr const char* kIndices[] = {
    "CREATE INDEX attempt_by_trainee ON attempt (trainee_uuid)",
    "CREATE INDEX attempt_by_station ON attempt (station, chain_position)",
    "CREATE INDEX erasure_by_trainee ON erasure (trainee_uuid)",
    "CREATE INDEX audit_erased ON audit (action, subject) WHERE action LIKE '% erased'",
};

}  // namespace

std::vector<std::string> central_schema() {
  std::vector<std::string> statements{"CREATE SCHEMA IF NOT EXISTS trocar"};
  for (const char* statement : kOwnTables) statements.emplace_back(statement);
  for (const CarriedTable& table : carried_bases()) statements.push_back(create_statement(table));
  for (const CarriedTable* table : {&carried_person(), &carried_attempt()}) statements.push_back(create_statement(*table));
  for (const CarriedTable& table : carried_of_attempt()) statements.push_back(create_statement(table));
  for (const CarriedTable& table : carried_sealed()) statements.push_back(create_statement(table));
  for (const char* statement : kIndices) statements.emplace_back(statement);
  return statements;
}

const std::vector<std::string>& central_erasing() {
  static const std::vector<std::string> kStatements = [] {
    const std::string of_attempt = " WHERE attempt_uuid IN (SELECT a.uuid FROM attempt a JOIN erasure e ON e.trainee_uuid = a.trainee_uuid"
                                   " WHERE e.kind = 'training')";
    std::vector<std::string> statements;
    for (const char* table : {"person", "note", "consent"}) {
      statements.push_back(std::string("DELETE FROM ") + table + " WHERE trainee_uuid IN (SELECT trainee_uuid FROM erasure)");
    }
    // What people signed and rated under their own names: only their station knows which those are, its trail names them.
    for (const std::string table : {"signature", "rating"}) {
      statements.push_back("DELETE FROM " + table + " r USING audit u, erasure e WHERE u.action LIKE '% erased' AND u.action = '" + table +
                           " erased' AND u.subject = r.uuid AND e.uuid = u.detail");
    }
    for (const CarriedTable& table : carried_of_attempt()) statements.push_back("DELETE FROM " + table.name + of_attempt);
    for (const char* table : {"rating", "signature", "verdict_override"})
      statements.push_back(std::string("DELETE FROM ") + table + of_attempt);
    const std::string trained = " WHERE trainee_uuid IN (SELECT trainee_uuid FROM erasure WHERE kind = 'training')";
    statements.push_back("DELETE FROM revocation WHERE certificate_uuid IN (SELECT uuid FROM certificate" + trained + ")");
    statements.push_back("DELETE FROM certificate" + trained);
    return statements;
  }();
  return kStatements;
}

}  // namespace trocar::sync
