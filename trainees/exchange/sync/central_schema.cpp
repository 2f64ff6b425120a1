#include "trainees/exchange/sync/central_schema.h"

#include "trainees/exchange/sync/carried_rows.h"
#include "trainees/exchange/sync/central_rights.h"

namespace trocar::sync {
namespace {

// received, last_seen: the centre's clock. No table is ordered by a clock, the stations' own least of all.
constexpr const char* kOwnTables[] = {
    "CREATE TABLE central (uuid text PRIMARY KEY, version integer NOT NULL)",
    "CREATE TABLE station (uuid text PRIMARY KEY, name text NOT NULL, first_seen timestamptz NOT NULL DEFAULT "
    "clock_timestamp(),"
    " last_seen timestamptz NOT NULL DEFAULT clock_timestamp(), last_position bigint NOT NULL DEFAULT 0)",
    "CREATE TABLE audit (station text NOT NULL, position bigint NOT NULL, utc text NOT NULL, actor text NOT NULL, "
    "action text NOT NULL,"
    " subject text NOT NULL, detail text NOT NULL, prev_hash text NOT NULL, row_hash text NOT NULL,"
    " received timestamptz NOT NULL DEFAULT clock_timestamp(), PRIMARY KEY (station, position))",
    "CREATE TABLE conflict (station text NOT NULL, kind text NOT NULL, uuid text NOT NULL, hash text NOT NULL, kept "
    "text NOT NULL,"
    " received timestamptz NOT NULL DEFAULT clock_timestamp(), PRIMARY KEY (station, kind, uuid, hash))",
};

constexpr const char* kIndices[] = {
    "CREATE INDEX attempt_by_trainee ON attempt (trainee_uuid)",
    "CREATE INDEX attempt_by_station ON attempt (station, chain_position)",
    "CREATE INDEX erasure_by_trainee ON erasure (trainee_uuid)",
    "CREATE INDEX audit_erased ON audit (action, subject) WHERE action LIKE '% erased'",
};

// person_link: the newest row of a pair holds; one < other. linked_trainee: everybody who is the same person, however
// far round.
constexpr const char* kVersion2[] = {
    "CREATE TABLE note_seen (note_uuid text PRIMARY KEY, utc text NOT NULL, station text NOT NULL,"
    " received timestamptz NOT NULL DEFAULT clock_timestamp(), seq bigint NOT NULL DEFAULT nextval('arrival'))",
    "CREATE TABLE person_link (seq bigint PRIMARY KEY DEFAULT nextval('arrival'), one text NOT NULL, other text NOT "
    "NULL,"
    " linked boolean NOT NULL, author text NOT NULL, utc text NOT NULL, CHECK (one < other))",
    "CREATE VIEW holding_link AS SELECT one, other FROM (SELECT DISTINCT ON (one, other) one, other, linked FROM "
    "person_link"
    " ORDER BY one, other, seq DESC) newest WHERE linked",
    "CREATE VIEW linked_trainee AS WITH RECURSIVE edge AS (SELECT one AS a, other AS b FROM holding_link UNION SELECT "
    "other, one FROM"
    " holding_link), reach AS (SELECT a, b FROM edge UNION SELECT r.a, e.b FROM reach r JOIN edge e ON e.a = r.b)"
    " SELECT a AS trainee_uuid, b AS same_uuid FROM reach",
    "CREATE VIEW erased_trainee AS SELECT trainee_uuid, kind, rule, author, utc FROM erasure UNION SELECT l.same_uuid, "
    "e.kind, e.rule,"
    " e.author, e.utc FROM erasure e JOIN linked_trainee l ON l.trainee_uuid = e.trainee_uuid",
    "CREATE TABLE recording (sha256 text PRIMARY KEY, attempt_uuid text NOT NULL, bytes bigint NOT NULL, chunks bigint "
    "NOT NULL,"
    " complete boolean NOT NULL DEFAULT false, station text NOT NULL, seq bigint NOT NULL DEFAULT nextval('arrival'))",
    "CREATE INDEX recording_by_attempt ON recording (attempt_uuid)",
    "CREATE TABLE recording_chunk (sha256 text NOT NULL REFERENCES recording ON DELETE CASCADE, position bigint NOT "
    "NULL,"
    " data bytea NOT NULL, PRIMARY KEY (sha256, position))",
    "ALTER TABLE recording_chunk ALTER COLUMN data SET STORAGE EXTERNAL",
    "CREATE INDEX audit_groups ON audit (subject, detail, seq) WHERE action IN ('group joined', 'group left')",
};

std::vector<const CarriedTable*> carried_tables() {
  std::vector<const CarriedTable*> all;
  for (const CarriedTable& table : carried_bases()) all.push_back(&table);
  for (const CarriedTable* table : {&carried_person(), &carried_attempt()}) all.push_back(table);
  for (const CarriedTable& table : carried_of_attempt()) all.push_back(&table);
  for (const CarriedTable& table : carried_sealed()) all.push_back(&table);
  return all;
}

bool of_attempt(const CarriedTable& table) {
  for (const CarriedTable& part : carried_of_attempt()) {
    if (part.name == table.name) return true;
  }
  return false;
}

void add_version_1(std::vector<std::string>& statements) {
  statements.emplace_back("CREATE SCHEMA IF NOT EXISTS trocar");
  for (const char* statement : kOwnTables) statements.emplace_back(statement);
  for (const CarriedTable* table : carried_tables()) statements.push_back(create_statement(*table));
  for (const char* statement : kIndices) statements.emplace_back(statement);
}

void number_arrivals(const std::string& table, std::vector<std::string>& statements) {
  statements.push_back("ALTER TABLE " + table + " ADD COLUMN seq bigint NOT NULL DEFAULT nextval('arrival')");
  statements.push_back("CREATE INDEX " + table + "_by_seq ON " + table + " (seq)");
}

/// Rows that were there get numbers in no order: who fetches for the first time takes all.
void add_version_2(std::vector<std::string>& statements) {
  statements.emplace_back("CREATE SEQUENCE arrival");
  statements.emplace_back("ALTER TABLE central ADD COLUMN revision bigint NOT NULL DEFAULT 0");
  statements.emplace_back("ALTER TABLE audit ADD COLUMN seq bigint NOT NULL DEFAULT nextval('arrival')");
  for (const CarriedTable* table : carried_tables()) {
    if (!of_attempt(*table)) number_arrivals(table->name, statements);  // else they come with their attempt
  }
  for (const char* statement : kVersion2) statements.emplace_back(statement);
  statements.emplace_back("UPDATE central SET version = 2, revision = (SELECT last_value FROM arrival)");
}

}  // namespace

std::vector<std::string> central_statements(int from) {
  std::vector<std::string> statements;
  const auto add = [&](const std::vector<std::string>& more) {
    statements.insert(statements.end(), more.begin(), more.end());
  };
  if (from < 1) {
    add_version_1(statements);
  } else if (from < 4) {
    for (const std::string& table : programme_tables()) statements.push_back(create_statement(carried_sealed(table)));
    statements.emplace_back("UPDATE station SET last_position = 0");
  }
  if (from < 2) {
    add_version_2(statements);
  } else if (from < 4) {
    for (const std::string& table : programme_tables()) number_arrivals(table, statements);
  }
  if (from < 3) {
    add(rights_statements());
  } else {
    if (from < 4) add(rights_since_3());
    add(rights_since_4());
  }
  statements.push_back("UPDATE central SET version = " + std::to_string(kCentralVersion));
  return statements;
}

const std::vector<std::string>& central_erasing() {
  static const std::vector<std::string> kStatements = [] {
    const std::string attempts =
        "(SELECT a.uuid FROM attempt a JOIN erased_trainee e ON e.trainee_uuid = a.trainee_uuid"
        " WHERE e.kind = 'training')";
    const std::string of_erased = " WHERE attempt_uuid IN " + attempts;
    std::vector<std::string> statements;
    statements.emplace_back(
        "DELETE FROM note_seen s USING note n, erased_trainee e WHERE n.uuid = s.note_uuid AND"
        " e.trainee_uuid = n.trainee_uuid");
    statements.emplace_back(
        "DELETE FROM withdrawal WHERE assignment_uuid IN (SELECT a.uuid FROM assignment a JOIN erased_trainee e ON"
        " e.trainee_uuid = a.trainee_uuid)");
    for (const char* table : {"person", "note", "consent", "standing", "assignment"}) {
      statements.push_back(std::string("DELETE FROM ") + table +
                           " WHERE trainee_uuid IN (SELECT trainee_uuid FROM erased_trainee)");
    }
    // What people signed and rated under their own names: only their station knows which those are, its trail names
    // them; no trail names those of another login.
    for (const std::string table : {"signature", "rating"}) {
      statements.push_back("DELETE FROM " + table +
                           " r USING audit u, erasure e WHERE u.action LIKE '% erased' AND u.action = '" + table +
                           " erased' AND u.subject = r.uuid AND e.uuid = u.detail AND (SELECT login FROM station WHERE"
                           " uuid = r.station) = (SELECT login FROM station WHERE uuid = u.station)");
    }
    for (const CarriedTable& table : carried_of_attempt())
      statements.push_back("DELETE FROM " + table.name + of_erased);
    for (const char* table : {"rating", "signature", "verdict_override", "recording"})
      statements.push_back(std::string("DELETE FROM ") + table + of_erased);
    const std::string trained =
        " WHERE trainee_uuid IN (SELECT trainee_uuid FROM erased_trainee WHERE kind = 'training')";
    statements.push_back("DELETE FROM revocation WHERE certificate_uuid IN (SELECT uuid FROM certificate" + trained +
                         ")");
    statements.push_back("DELETE FROM certificate" + trained);
    return statements;
  }();
  return kStatements;
}

}  // namespace trocar::sync
