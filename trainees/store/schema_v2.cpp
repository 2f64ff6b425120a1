// Schema version 2: identity apart from training data, scores apart from attempts, an audit trail, room for what the
// desk and the progression will keep.
//
// person is the only table that says who somebody is: dropping its row leaves every attempt, without a name. A score
// names the ruleset (the bytes of the exercise file) that it was computed by; its metrics, sub-scores and caps hang on
// it, so that an attempt can be scored again by other rules without touching the first score (revision 0). Finished
// attempts and everything below the line "append only" refuse UPDATE and DELETE. docs/data_store.md.
#include <string>

#include "trainees/store/migrations.h"

namespace trocar {
namespace {

// The old tables step aside with their triggers and indices, and are dropped at the end.
constexpr const char kAside[] = R"sql(
ALTER TABLE trainee RENAME TO old_trainee;
ALTER TABLE attempt RENAME TO old_attempt;
ALTER TABLE event RENAME TO old_event;
ALTER TABLE metric RENAME TO old_metric;
ALTER TABLE subscore RENAME TO old_subscore;
ALTER TABLE score_cap RENAME TO old_score_cap;
)sql";

constexpr const char kPeople[] = R"sql(
CREATE TABLE trainee (
  id          INTEGER PRIMARY KEY,
  uuid        TEXT NOT NULL UNIQUE,
  created_utc TEXT NOT NULL
) STRICT;

CREATE TABLE person (
  trainee_id INTEGER PRIMARY KEY REFERENCES trainee(id),
  code       TEXT NOT NULL UNIQUE COLLATE NOCASE,
  name       TEXT NOT NULL DEFAULT '',
  email      TEXT NOT NULL DEFAULT ''
) STRICT;

CREATE VIEW known_trainee AS
SELECT t.id, t.uuid, coalesce(p.code, 'erased-' || substr(t.uuid, 29)) AS code, t.created_utc
FROM trainee t LEFT JOIN person p ON p.trainee_id = t.id;

-- Given and withdrawn are rows of their own: the newest of a purpose holds.
CREATE TABLE consent (
  id         INTEGER PRIMARY KEY,
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  purpose    TEXT NOT NULL,
  given      INTEGER NOT NULL CHECK (given IN (0, 1)),
  text       TEXT NOT NULL,
  utc        TEXT NOT NULL
) STRICT;

CREATE TABLE session (
  id          INTEGER PRIMARY KEY,
  uuid        TEXT NOT NULL UNIQUE,
  trainee_id  INTEGER NOT NULL REFERENCES trainee(id),
  station     TEXT NOT NULL,
  started_utc TEXT NOT NULL,
  ended_utc   TEXT
) STRICT;
)sql";

constexpr const char kRules[] = R"sql(
CREATE TABLE exercise (
  id     TEXT PRIMARY KEY,
  number TEXT NOT NULL,
  title  TEXT NOT NULL
) STRICT;

-- An exercise file as it was: whatever is scored by it is scored by exactly these bytes.
CREATE TABLE ruleset (
  sha256      TEXT PRIMARY KEY CHECK (length(sha256) = 64),
  exercise_id TEXT NOT NULL REFERENCES exercise(id),
  version     TEXT NOT NULL,
  toml        TEXT NOT NULL
) STRICT;

-- Anchors taken from people: full marks at full_at, none at zero_at, from n people.
CREATE TABLE benchmark (
  id          INTEGER PRIMARY KEY,
  exercise_id TEXT NOT NULL REFERENCES exercise(id),
  level       TEXT NOT NULL,
  metric      TEXT NOT NULL,
  full_at     REAL NOT NULL,
  zero_at     REAL NOT NULL,
  n           INTEGER NOT NULL CHECK (n >= 0),
  source      TEXT NOT NULL,
  utc         TEXT NOT NULL
) STRICT;

CREATE TABLE device_calibration (
  id     INTEGER PRIMARY KEY,
  device TEXT NOT NULL,
  sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
  toml   TEXT NOT NULL,
  utc    TEXT NOT NULL
) STRICT;
)sql";

constexpr const char kAttempts[] = R"sql(
CREATE TABLE attempt (
  id               INTEGER PRIMARY KEY AUTOINCREMENT,
  uuid             TEXT NOT NULL UNIQUE,
  trainee_id       INTEGER NOT NULL REFERENCES trainee(id),
  session_id       INTEGER REFERENCES session(id),
  calibration_id   INTEGER REFERENCES device_calibration(id),
  exercise_id      TEXT NOT NULL REFERENCES exercise(id),
  exercise_version TEXT NOT NULL,
  ruleset_sha256   TEXT NOT NULL REFERENCES ruleset(sha256),
  level            TEXT NOT NULL,
  seed             INTEGER NOT NULL,
  board            INTEGER NOT NULL,
  hand             TEXT NOT NULL,
  organ_name       TEXT NOT NULL,
  organ_source     TEXT NOT NULL,
  organ_sha256     TEXT NOT NULL,
  organ_synthetic  INTEGER NOT NULL CHECK (organ_synthetic IN (0, 1)),
  organ_credit     TEXT NOT NULL,
  program          TEXT NOT NULL,
  started_utc      TEXT NOT NULL,
  -- the process that runs it, so that a dead one can be told from a living one
  owner_pid        INTEGER NOT NULL,
  owner_boot       TEXT NOT NULL,
  owner_start      INTEGER NOT NULL,
  status           TEXT NOT NULL CHECK (status IN ('running','completed','timeout','aborted','fault','void')),
  -- why it was aborted or void; empty when nothing is wrong
  integrity        TEXT NOT NULL DEFAULT '',
  finished_utc     TEXT,
  recording_path   TEXT NOT NULL DEFAULT '',
  recording_sha256 TEXT NOT NULL DEFAULT '',
  state_hash       TEXT NOT NULL DEFAULT '',
  device_backend   TEXT NOT NULL DEFAULT '',
  device_rate_hz   REAL,
  device_ticks     INTEGER NOT NULL DEFAULT 0,
  device_overruns  INTEGER NOT NULL DEFAULT 0,
  saturated_contact_share REAL,
  passivity_active_share  REAL,
  min_energy_j     REAL,
  kappa            REAL,
  device_fault     TEXT NOT NULL DEFAULT '',
  -- JSON: how a live run kept its pace; empty in lockstep
  device_realtime  TEXT NOT NULL DEFAULT '',
  -- of the content that row_hash covers (attempt_chain.h)
  hash_version     INTEGER NOT NULL,
  chain_position   INTEGER UNIQUE,
  prev_hash        TEXT,
  row_hash         TEXT UNIQUE,
  CHECK ((status = 'running') = (row_hash IS NULL))
) STRICT;

-- NULL in value: not a number.
CREATE TABLE event (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  t_s        REAL NOT NULL,
  type       TEXT NOT NULL,
  severity   TEXT NOT NULL CHECK (severity IN ('info','minor','major','critical')),
  object     INTEGER NOT NULL,
  value      REAL,
  unit       TEXT NOT NULL,
  tip_x_m    REAL, tip_y_m REAL, tip_z_m REAL,
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE score (
  id             INTEGER PRIMARY KEY,
  attempt_id     INTEGER NOT NULL REFERENCES attempt(id),
  -- 0: given when the attempt ended, the one that counts; higher ones: scored again
  revision       INTEGER NOT NULL CHECK (revision >= 0),
  ruleset_sha256 TEXT NOT NULL REFERENCES ruleset(sha256),
  value          REAL CHECK (value IS NULL OR value BETWEEN 0 AND 100),
  passed         INTEGER NOT NULL CHECK (passed IN (0, 1)),
  grade          TEXT NOT NULL,
  UNIQUE (attempt_id, revision)
) STRICT;

-- NULL in value: undefined for this attempt.
CREATE TABLE metric (
  score_id INTEGER NOT NULL REFERENCES score(id),
  position INTEGER NOT NULL,
  name     TEXT NOT NULL,
  value    REAL,
  unit     TEXT NOT NULL,
  PRIMARY KEY (score_id, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE subscore (
  score_id INTEGER NOT NULL REFERENCES score(id),
  position INTEGER NOT NULL,
  name     TEXT NOT NULL,
  value    REAL,
  weight   REAL,
  raw      REAL,
  unit     TEXT NOT NULL,
  full_at  REAL,
  zero_at  REAL,
  gate     INTEGER NOT NULL CHECK (gate IN (0, 1)),
  PRIMARY KEY (score_id, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE score_cap (
  score_id INTEGER NOT NULL REFERENCES score(id),
  position INTEGER NOT NULL,
  reason   TEXT NOT NULL,
  PRIMARY KEY (score_id, position)
) STRICT, WITHOUT ROWID;
)sql";

constexpr const char kOpinions[] = R"sql(
-- What a person thought of an attempt, item by item of a named scale.
CREATE TABLE rating (
  id         INTEGER PRIMARY KEY,
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  rater      TEXT NOT NULL,
  scale      TEXT NOT NULL,
  item       TEXT NOT NULL,
  value      REAL NOT NULL,
  utc        TEXT NOT NULL
) STRICT;

-- Bound to the bytes of the attempt by its row_hash.
CREATE TABLE signature (
  id         INTEGER PRIMARY KEY,
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  row_hash   TEXT NOT NULL,
  signer     TEXT NOT NULL,
  meaning    TEXT NOT NULL CHECK (meaning IN ('review','approval','responsibility','authorship')),
  note       TEXT NOT NULL,
  utc        TEXT NOT NULL
) STRICT;

CREATE TABLE audit (
  position  INTEGER PRIMARY KEY,
  utc       TEXT NOT NULL,
  actor     TEXT NOT NULL,
  action    TEXT NOT NULL,
  subject   TEXT NOT NULL,
  detail    TEXT NOT NULL,
  prev_hash TEXT NOT NULL,
  row_hash  TEXT NOT NULL UNIQUE
) STRICT;
)sql";

constexpr const char kCopy[] = R"sql(
INSERT INTO trainee SELECT id, uuid, created_utc FROM old_trainee;
INSERT INTO person (trainee_id, code) SELECT id, code FROM old_trainee;
INSERT INTO exercise SELECT DISTINCT exercise_id, '', '' FROM exercise_version;
INSERT INTO ruleset SELECT sha256, exercise_id, version, toml FROM exercise_version;
INSERT INTO attempt (id, uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed, board, hand,
  organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program, started_utc, owner_pid, owner_boot,
  owner_start, status, finished_utc, recording_path, recording_sha256, state_hash, device_backend, device_rate_hz,
  device_ticks, device_overruns, saturated_contact_share, passivity_active_share, min_energy_j, kappa, device_fault,
  hash_version, chain_position, prev_hash, row_hash)
SELECT id, uuid, trainee_id, exercise_id, exercise_version, rubric_sha256, level, seed, board, hand, organ_name,
  organ_source, organ_sha256, organ_synthetic, organ_credit, '', started_utc, owner_pid, owner_boot, owner_start,
  status, finished_utc, recording_path, recording_sha256, state_hash, device_backend, device_rate_hz, device_ticks,
  device_overruns, saturated_contact_share, passivity_active_share, min_energy_j, kappa, device_fault,
  CASE status WHEN 'running' THEN 2 ELSE 1 END, chain_position, prev_hash, row_hash FROM old_attempt;
INSERT INTO event SELECT * FROM old_event;
INSERT INTO score SELECT id, id, 0, rubric_sha256, score, passed, grade FROM old_attempt WHERE status <> 'running';
INSERT INTO metric SELECT * FROM old_metric;
INSERT INTO subscore SELECT * FROM old_subscore;
INSERT INTO score_cap SELECT * FROM old_score_cap;
DROP TABLE old_event;
DROP TABLE old_metric;
DROP TABLE old_subscore;
DROP TABLE old_score_cap;
DROP TABLE old_attempt;
DROP TABLE old_trainee;
DROP TABLE exercise_version;
CREATE INDEX attempt_by_trainee ON attempt(trainee_id, exercise_id, level, id);
CREATE INDEX attempt_running ON attempt(status) WHERE status = 'running';
)sql";

// INSERT OR REPLACE would delete without asking a DELETE trigger, hence the _no_replace ones.
constexpr const char kAttemptTriggers[] = R"sql(
CREATE TRIGGER attempt_begins_running BEFORE INSERT ON attempt WHEN NEW.status <> 'running'
BEGIN SELECT RAISE(ABORT, 'an attempt begins as running'); END;
CREATE TRIGGER attempt_no_replace BEFORE INSERT ON attempt
WHEN EXISTS (SELECT 1 FROM attempt WHERE id = NEW.id OR uuid = NEW.uuid)
BEGIN SELECT RAISE(ABORT, 'the attempt exists already'); END;
CREATE TRIGGER attempt_no_update BEFORE UPDATE ON attempt WHEN OLD.status <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be changed'); END;
CREATE TRIGGER attempt_keeps_identity
BEFORE UPDATE OF id, uuid, trainee_id, session_id, calibration_id, exercise_id, exercise_version, ruleset_sha256, level,
  seed, board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program, started_utc,
  owner_pid, owner_boot, owner_start, hash_version ON attempt
BEGIN SELECT RAISE(ABORT, 'what an attempt began with cannot be changed'); END;
CREATE TRIGGER attempt_no_delete BEFORE DELETE ON attempt
BEGIN SELECT RAISE(ABORT, 'an attempt cannot be deleted'); END;
CREATE TRIGGER ruleset_no_replace BEFORE INSERT ON ruleset WHEN EXISTS (SELECT 1 FROM ruleset WHERE sha256 = NEW.sha256)
BEGIN SELECT RAISE(ABORT, 'the ruleset exists already'); END;
CREATE TRIGGER score_no_replace BEFORE INSERT ON score
WHEN EXISTS (SELECT 1 FROM score WHERE id = NEW.id OR (attempt_id = NEW.attempt_id AND revision = NEW.revision))
BEGIN SELECT RAISE(ABORT, 'the score exists already'); END;
CREATE TRIGGER audit_follows BEFORE INSERT ON audit
WHEN NEW.position <> (SELECT coalesce(max(position), 0) + 1 FROM audit)
  OR NEW.prev_hash <> coalesce((SELECT row_hash FROM audit ORDER BY position DESC LIMIT 1), '')
BEGIN SELECT RAISE(ABORT, 'an audit entry follows the last one'); END;
)sql";

std::string append_only(const std::string& table) {
  return "CREATE TRIGGER " + table + "_no_update BEFORE UPDATE ON " + table + " BEGIN SELECT RAISE(ABORT, '" + table +
         ": a row cannot be changed'); END;\nCREATE TRIGGER " + table + "_no_delete BEFORE DELETE ON " + table +
         " BEGIN SELECT RAISE(ABORT, '" + table + ": a row cannot be deleted'); END;\n";
}

std::string never_replaced(const std::string& table) {
  return "CREATE TRIGGER " + table + "_no_replace BEFORE INSERT ON " + table + " WHEN EXISTS (SELECT 1 FROM " + table +
         " WHERE id = NEW.id) BEGIN SELECT RAISE(ABORT, '" + table + ": the row exists already'); END;\n";
}

/// Rows of an attempt come while it runs. @param attempt SQL for its number.
std::string not_late(const std::string& table, const std::string& attempt) {
  return "CREATE TRIGGER " + table + "_late BEFORE INSERT ON " + table +
         " WHEN (SELECT status FROM attempt WHERE id = " + attempt + ") IS NOT 'running' BEGIN SELECT RAISE(ABORT, '" +
         table + ": a finished attempt cannot be added to'); END;\n";
}

std::string triggers() {
  std::string sql = kAttemptTriggers;
  for (const char* table : {"ruleset", "benchmark", "device_calibration", "consent", "event", "score", "metric",
                            "subscore", "score_cap", "rating", "signature", "audit"}) {
    sql += append_only(table);
  }
  for (const char* table : {"benchmark", "device_calibration", "consent", "rating", "signature"}) {
    sql += never_replaced(table);
  }
  for (const char* table : {"event", "score"}) sql += not_late(table, "NEW.attempt_id");
  for (const char* table : {"metric", "subscore", "score_cap"}) {
    sql += not_late(table, "(SELECT attempt_id FROM score WHERE id = NEW.score_id)");
  }
  return sql;
}

}  // namespace

const char* schema_v2() {
  static const std::string kSql = std::string(kAside) + kPeople + kRules + kAttempts + kOpinions + kCopy + triggers();
  return kSql.c_str();
}

}  // namespace trocar
