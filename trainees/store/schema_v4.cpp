// Schema version 4: the instructor's desk. Accounts, notes, overrides, certificates, curricula, groups, erasure,
// synchronisation.
//
// What a person says of an attempt or a trainee is kept as attempts are: rows with a time-ordered UUID, never changed,
// each with its digest in the audit trail (sealed_rows.h). An erasure is the one exception, and is itself such a row.
// docs/data_store.md.
#include <string>

#include "trainees/store/migrations.h"

namespace trocar {
namespace {

// These tables had no rows yet in any program before this one; "" stands for "before schema 4".
constexpr const char kOpinions[] = R"sql(
ALTER TABLE consent ADD COLUMN uuid TEXT NOT NULL DEFAULT '';
ALTER TABLE consent ADD COLUMN author TEXT NOT NULL DEFAULT '';
ALTER TABLE rating ADD COLUMN uuid TEXT NOT NULL DEFAULT '';
ALTER TABLE rating ADD COLUMN account_uuid TEXT NOT NULL DEFAULT '';
ALTER TABLE signature ADD COLUMN uuid TEXT NOT NULL DEFAULT '';
ALTER TABLE signature ADD COLUMN account_uuid TEXT NOT NULL DEFAULT '';
ALTER TABLE benchmark ADD COLUMN uuid TEXT NOT NULL DEFAULT '';
ALTER TABLE benchmark ADD COLUMN rule TEXT NOT NULL DEFAULT '';
ALTER TABLE benchmark ADD COLUMN author TEXT NOT NULL DEFAULT '';
CREATE UNIQUE INDEX consent_uuid ON consent(uuid) WHERE uuid <> '';
CREATE UNIQUE INDEX rating_uuid ON rating(uuid) WHERE uuid <> '';
CREATE UNIQUE INDEX signature_uuid ON signature(uuid) WHERE uuid <> '';
CREATE UNIQUE INDEX benchmark_uuid ON benchmark(uuid) WHERE uuid <> '';
CREATE INDEX signature_by_attempt ON signature(attempt_id);
CREATE INDEX rating_by_attempt ON rating(attempt_id);

-- Of a trainee, or of one attempt. author: account's UUID, '' from the command line. printed: the name as it stood.
CREATE TABLE note (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  attempt_id INTEGER REFERENCES attempt(id),
  author     TEXT NOT NULL,
  printed    TEXT NOT NULL,
  text       TEXT NOT NULL CHECK (length(text) BETWEEN 1 AND 4000),
  utc        TEXT NOT NULL
) STRICT;
CREATE INDEX note_by_trainee ON note(trainee_id, id);

-- When the trainee met it. Not evidence, so not sealed.
CREATE TABLE note_seen (
  note_id INTEGER PRIMARY KEY REFERENCES note(id),
  utc     TEXT NOT NULL
) STRICT;

-- A person's verdict beside the score, never in its place. The newest of an attempt holds.
CREATE TABLE verdict_override (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  row_hash   TEXT NOT NULL,
  author     TEXT NOT NULL,
  printed    TEXT NOT NULL,
  passed     INTEGER NOT NULL CHECK (passed IN (0, 1)),
  reason     TEXT NOT NULL CHECK (length(trim(reason)) >= 10),
  utc        TEXT NOT NULL
) STRICT;
CREATE INDEX override_by_attempt ON verdict_override(attempt_id);

-- evidence: JSON, what the decision rested on (attempts, rule and its version, n). It holds unless revoked.
CREATE TABLE certificate (
  id           INTEGER PRIMARY KEY,
  uuid         TEXT NOT NULL UNIQUE,
  trainee_id   INTEGER NOT NULL REFERENCES trainee(id),
  exercise_id  TEXT NOT NULL REFERENCES exercise(id),
  level        TEXT NOT NULL,
  rule_version TEXT NOT NULL,
  evidence     TEXT NOT NULL,
  author       TEXT NOT NULL,
  printed      TEXT NOT NULL,
  utc          TEXT NOT NULL
) STRICT;
CREATE INDEX certificate_by_trainee ON certificate(trainee_id);

CREATE TABLE revocation (
  id             INTEGER PRIMARY KEY,
  uuid           TEXT NOT NULL UNIQUE,
  certificate_id INTEGER NOT NULL UNIQUE REFERENCES certificate(id),
  author         TEXT NOT NULL,
  printed        TEXT NOT NULL,
  reason         TEXT NOT NULL CHECK (length(trim(reason)) >= 10),
  utc            TEXT NOT NULL
) STRICT;
)sql";

constexpr const char kRules[] = R"sql(
-- Courses and progress rules as TOML text; the highest version of a name holds.
CREATE TABLE curriculum (
  id      INTEGER PRIMARY KEY,
  uuid    TEXT NOT NULL UNIQUE,
  name    TEXT NOT NULL,
  version INTEGER NOT NULL CHECK (version >= 1),
  sha256  TEXT NOT NULL CHECK (length(sha256) = 64),
  toml    TEXT NOT NULL,
  author  TEXT NOT NULL,
  utc     TEXT NOT NULL,
  UNIQUE (name, version, uuid)
) STRICT;
)sql";

constexpr const char kPeople[] = R"sql(
-- Who may sign in at the desk. password: the library's own text (algorithm, cost, salt, hash); '' cannot sign in.
CREATE TABLE account (
  id           INTEGER PRIMARY KEY,
  uuid         TEXT NOT NULL UNIQUE,
  login        TEXT NOT NULL UNIQUE COLLATE NOCASE,
  name         TEXT NOT NULL,
  role         TEXT NOT NULL CHECK (role IN ('trainee','instructor','administrator')),
  trainee_id   INTEGER UNIQUE REFERENCES trainee(id),
  password     TEXT NOT NULL DEFAULT '',
  created_utc  TEXT NOT NULL,
  disabled_utc TEXT,
  CHECK ((role = 'trainee') = (trainee_id IS NOT NULL))
) STRICT;

CREATE TABLE membership (
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  group_name TEXT NOT NULL CHECK (length(group_name) BETWEEN 1 AND 64),
  PRIMARY KEY (trainee_id, group_name)
) STRICT, WITHOUT ROWID;

-- kind: 'identity' (name, e-mail, code, notes, consents, sign-in go; training facts stay), 'training' (those too, but for bare attempts).
CREATE TABLE erasure (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  kind       TEXT NOT NULL CHECK (kind IN ('identity','training')),
  rule       TEXT NOT NULL,
  author     TEXT NOT NULL,
  utc        TEXT NOT NULL,
  UNIQUE (trainee_id, kind)
) STRICT;

-- How far a central database has what stands here (position of the audit trail).
CREATE TABLE sync_cursor (
  remote   TEXT PRIMARY KEY,
  position INTEGER NOT NULL CHECK (position >= 0),
  utc      TEXT NOT NULL
) STRICT;

-- This database under its own name (own = 1), and those whose attempts were fetched from a central database.
CREATE TABLE station (
  uuid TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  own  INTEGER NOT NULL CHECK (own IN (0, 1))
) STRICT;
CREATE UNIQUE INDEX station_own ON station(own) WHERE own = 1;

-- Attempts of other stations: their place is in the chain of the station that made them, not in this database's.
CREATE TABLE replica (
  attempt_id     INTEGER PRIMARY KEY REFERENCES attempt(id),
  station        TEXT NOT NULL REFERENCES station(uuid),
  chain_position INTEGER NOT NULL,
  prev_hash      TEXT NOT NULL
) STRICT;
)sql";

constexpr const char kIndices[] = R"sql(
CREATE INDEX attempt_by_time ON attempt(started_utc);
-- An attempt's entry is looked up for every attempt by db check.
CREATE INDEX audit_by_subject ON audit(subject, action);
-- For the desk's cohort: it reads these alone, never the wide tables, so each names every column that a query does, also the one that
-- its WHERE makes constant. An index over all metrics would be as large as they are.
CREATE INDEX attempt_by_curve ON attempt(exercise_id, level, hand, ruleset_sha256, trainee_id, id, status, started_utc, device_ticks,
  device_overruns, saturated_contact_share);
CREATE INDEX score_first ON score(attempt_id, revision, value, passed, id) WHERE revision = 0;
CREATE INDEX metric_peak_force ON metric(score_id, value) WHERE name = 'force_max_n';
CREATE INDEX event_critical ON event(attempt_id, severity) WHERE severity = 'critical';
CREATE INDEX event_over_force ON event(attempt_id, type) WHERE type IN ('EXCESS_FORCE', 'CRITICAL_FORCE', 'GRIP_EXCESS', 'CRUSH');
CREATE INDEX cap_of_safety ON score_cap(score_id, reason) WHERE substr(reason, 1, 8) = 'safety: ';
)sql";

constexpr const char kAccount[] = R"sql(
CREATE TRIGGER account_keeps_identity BEFORE UPDATE OF id, uuid, login, role, trainee_id, created_utc ON account
BEGIN SELECT RAISE(ABORT, 'account: whose it is cannot be changed'); END;
)sql";

/// @param unless SQL that finds a row where the verb is allowed; empty: never.
std::string refused(const std::string& table, const std::string& verb, const std::string& unless) {
  const std::string past = verb == "DELETE" ? "deleted" : "changed";
  const std::string name = table + (verb == "DELETE" ? "_no_delete" : "_no_update");
  return "DROP TRIGGER IF EXISTS " + name + ";\nCREATE TRIGGER " + name + " BEFORE " + verb + " ON " + table +
         (unless.empty() ? "" : " WHEN NOT EXISTS (" + unless + ")") + " BEGIN SELECT RAISE(ABORT, '" + table +
         ": a row cannot be " + past + "'); END;\n";
}

/// INSERT OR REPLACE would delete without asking a DELETE trigger. @param also SQL for what else is unique.
std::string never_replaced(const std::string& table, const std::string& also = "") {
  const std::string name = table + "_no_replace";
  return "DROP TRIGGER IF EXISTS " + name + ";\nCREATE TRIGGER " + name + " BEFORE INSERT ON " + table +
         " WHEN EXISTS (SELECT 1 FROM " + table + " WHERE id = NEW.id OR (uuid = NEW.uuid AND uuid <> '')" + also +
         ") BEGIN SELECT RAISE(ABORT, '" + table + ": the row exists already'); END;\n";
}

std::string unchanging() {
  std::string sql;
  for (const char* table : {"note", "verdict_override", "certificate", "revocation", "curriculum", "erasure"}) {
    sql += refused(table, "UPDATE", "");
  }
  for (const char* table : {"curriculum", "erasure", "replica"}) sql += refused(table, "DELETE", "");
  sql += refused("replica", "UPDATE", "");
  for (const char* table : {"consent", "rating", "signature", "benchmark", "note", "verdict_override", "certificate"}) {
    sql += never_replaced(table);
  }
  sql += never_replaced("revocation", " OR certificate_id = NEW.certificate_id");
  sql += never_replaced("curriculum", " OR (name = NEW.name AND version = NEW.version AND uuid = NEW.uuid)");
  sql += never_replaced("erasure", " OR (trainee_id = NEW.trainee_id AND kind = NEW.kind)");
  return sql + never_replaced("account", " OR login = NEW.login OR (trainee_id = NEW.trainee_id)");
}

/// Rows go with their person, once the erasure stands: identity first, what was measured and judged only with
/// 'training'.
std::string erasable() {
  const std::string of_person = "SELECT 1 FROM erasure WHERE trainee_id = OLD.trainee_id";
  std::string sql;
  for (const char* table : {"note", "consent", "account"}) sql += refused(table, "DELETE", of_person);
  const std::string of_attempt = "SELECT 1 FROM erasure e JOIN attempt a ON a.trainee_id = e.trainee_id";
  // What they signed and rated themselves goes with the identity.
  for (const char* table : {"signature", "rating"})
    sql += refused(table, "DELETE", of_attempt + " WHERE a.id = OLD.attempt_id");
  for (const char* table : {"event", "device_warning", "device_transition", "score", "verdict_override"}) {
    sql += refused(table, "DELETE", of_attempt + " WHERE a.id = OLD.attempt_id AND e.kind = 'training'");
  }
  for (const char* table : {"metric", "subscore", "score_cap"}) {
    sql +=
        refused(table, "DELETE",
                of_attempt + " JOIN score s ON s.attempt_id = a.id WHERE s.id = OLD.score_id AND e.kind = 'training'");
  }
  sql += refused("certificate", "DELETE", of_person + " AND kind = 'training'");
  return sql + refused("revocation", "DELETE",
                       "SELECT 1 FROM erasure e JOIN certificate c ON c.trainee_id = e.trainee_id"
                       " WHERE c.id = OLD.certificate_id AND e.kind = 'training'");
}

}  // namespace

const char* schema_v4() {
  static const std::string kSql =
      std::string(kOpinions) + kRules + kPeople + kIndices + kAccount + unchanging() + erasable();
  return kSql.c_str();
}

}  // namespace trocar
