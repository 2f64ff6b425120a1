// The schema: identity apart from training data, scores apart from attempts, what people write of them, the audit
// trail.
//
// person is the only table that says who somebody is: without its row every attempt stays, without a name. A score
// names the ruleset (the bytes of the exercise file) that it was computed by; its metrics, sub-scores and caps hang on
// it, so that an attempt can be scored again by other rules without touching the first score (revision 0). What a
// person says of an attempt or a trainee is kept as attempts are: rows with a time-ordered UUID, never changed, each
// with its digest in the audit trail (sealed_rows.h). An erasure is the one exception, and is itself such a row.
//
// Texts that repeat (what an event or a metric is called, its unit, what a sub-score's marks mean) stand once in lookup
// tables; events, metrics and sub-scores are narrow rows in the order of their attempts. A row's number says whose it
// is, so that an attempt's rows lie side by side and no index is needed to find them:
//   event_row, device_transition_row   attempt * 2^20 + position
//   metric_row                         score * 2^10 + number of the metric in metric_kind
//   subscore_row                       score * 2^10 + position
// (tables with a key of two columns leave an eighth of every page empty, because rows come in order; these fill
// theirs.) The views event, metric, subscore and device_transition show them with their texts; what row_hash covers is
// what the views show. No unique index over hashes: it would cost a page at random for every attempt, and the chain is
// checked by computing it. docs/data_store.md.
#include "trainees/store/schema.h"

#include <string>
#include <utility>
#include <vector>

namespace trocar {
namespace {

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
  email      TEXT NOT NULL DEFAULT '',
  -- random, into the digest of the person's audit entries; goes with the person (kept_rows.h)
  salt       TEXT NOT NULL DEFAULT ''
) STRICT;

CREATE VIEW known_trainee AS
SELECT t.id, t.uuid, coalesce(p.code, 'erased-' || substr(t.uuid, 29)) AS code, t.created_utc
FROM trainee t LEFT JOIN person p ON p.trainee_id = t.id;

-- Given and withdrawn are rows of their own: the newest of a purpose holds.
CREATE TABLE consent (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  purpose    TEXT NOT NULL,
  given      INTEGER NOT NULL CHECK (given IN (0, 1)),
  text       TEXT NOT NULL,
  author     TEXT NOT NULL,
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
  uuid        TEXT NOT NULL UNIQUE,
  exercise_id TEXT NOT NULL REFERENCES exercise(id),
  level       TEXT NOT NULL,
  metric      TEXT NOT NULL,
  full_at     REAL NOT NULL,
  zero_at     REAL NOT NULL,
  n           INTEGER NOT NULL CHECK (n >= 0),
  source      TEXT NOT NULL,
  rule        TEXT NOT NULL,
  author      TEXT NOT NULL,
  utc         TEXT NOT NULL
) STRICT;

CREATE TABLE device_calibration (
  id     INTEGER PRIMARY KEY,
  device TEXT NOT NULL,
  sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
  toml   TEXT NOT NULL,
  utc    TEXT NOT NULL
) STRICT;

-- Programmes and progress rules as TOML text; the highest version of a name holds.
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

constexpr const char kAttemptTables[] = R"sql(
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
  -- what helped a hand without a device: 'height', 'plumb', or both with a space between
  assists          TEXT NOT NULL DEFAULT '',
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
  -- not IN: SQLite would build a table of the words for every row
  status           TEXT NOT NULL CHECK (status = 'running' OR status = 'completed' OR status = 'timeout' OR status = 'aborted'
                                        OR status = 'fault' OR status = 'void'),
  -- why it was aborted or void; empty when nothing is wrong
  integrity        TEXT NOT NULL DEFAULT '',
  -- 1: its program ended before it did
  cut_off          INTEGER NOT NULL DEFAULT 0 CHECK (cut_off IN (0, 1)),
  finished_utc     TEXT,
  recording_path   TEXT NOT NULL DEFAULT '',
  recording_sha256 TEXT NOT NULL DEFAULT '',
  state_hash       TEXT NOT NULL DEFAULT '',
  device_backend   TEXT NOT NULL DEFAULT '',
  -- JSON: which simulated arm, and by which files the loop knew it; empty where there is a real one
  device_plant     TEXT NOT NULL DEFAULT '',
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
  row_hash         TEXT,
  CHECK ((status = 'running') = (row_hash IS NULL))
) STRICT;

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

-- scenarios/scoring/cap.h; what a kind does not have is empty or 0.
CREATE TABLE score_cap (
  score_id INTEGER NOT NULL REFERENCES score(id),
  position INTEGER NOT NULL,
  kind     TEXT NOT NULL CHECK (kind IN ('gate','critical','unfinished','void')),
  subject  TEXT NOT NULL,
  below    REAL NOT NULL,
  done     INTEGER NOT NULL,
  total    INTEGER NOT NULL,
  at_most  REAL NOT NULL,
  PRIMARY KEY (score_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE device_warning (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  name       TEXT NOT NULL,
  first_s    REAL,
  ticks      INTEGER NOT NULL,
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;
)sql";

constexpr const char kRowTables[] = R"sql(
-- The two lowest bits of a number: 1 critical; 2 a force over its hard limit. So one small index finds what the desk warns of.
CREATE TABLE event_kind (
  id       INTEGER PRIMARY KEY CHECK (id >= 4),
  type     TEXT NOT NULL,
  severity TEXT NOT NULL CHECK (severity IN ('info','minor','major','critical')),
  unit     TEXT NOT NULL,
  UNIQUE (type, severity, unit),
  CHECK ((id & 1) = (severity = 'critical')),
  CHECK ((id & 2) = 2 * (type IN ('EXCESS_FORCE', 'CRITICAL_FORCE', 'GRIP_EXCESS', 'CRUSH')))
) STRICT;

CREATE TABLE metric_kind (
  id   INTEGER PRIMARY KEY CHECK (id BETWEEN 1 AND 1023),
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  UNIQUE (name, unit)
) STRICT;
-- 1, because an index needs a number that does not change.
INSERT INTO metric_kind VALUES (1, 'force_max_n', 'N');

-- What is the same for a sub-score in every attempt at an exercise.
CREATE TABLE subscore_kind (
  id      INTEGER PRIMARY KEY,
  name    TEXT NOT NULL,
  unit    TEXT NOT NULL,
  weight  REAL,
  full_at REAL,
  zero_at REAL,
  gate    INTEGER NOT NULL CHECK (gate IN (0, 1))
) STRICT;
CREATE INDEX subscore_kind_by_name ON subscore_kind(name, unit);

CREATE TABLE device_change (
  id         INTEGER PRIMARY KEY,
  from_state TEXT NOT NULL,
  to_state   TEXT NOT NULL,
  UNIQUE (from_state, to_state)
) STRICT;

-- NULL in value: not a number.
CREATE TABLE event_row (
  id      INTEGER PRIMARY KEY,
  t_s     REAL NOT NULL,
  kind_id INTEGER NOT NULL,
  object  INTEGER NOT NULL,
  value   REAL,
  tip_x_m REAL, tip_y_m REAL, tip_z_m REAL
) STRICT;

-- NULL in value: undefined for this attempt.
CREATE TABLE metric_row (
  id       INTEGER PRIMARY KEY,
  position INTEGER NOT NULL,
  value    REAL
) STRICT;

CREATE TABLE subscore_row (
  id      INTEGER PRIMARY KEY,
  kind_id INTEGER NOT NULL,
  value   REAL,
  raw     REAL
) STRICT;

CREATE TABLE device_transition_row (
  id        INTEGER PRIMARY KEY,
  t_s       REAL,
  change_id INTEGER NOT NULL
) STRICT;
)sql";

// A metric can be found by whose it is and by its name: hence it says twice over which row it is.
constexpr const char kViews[] = R"sql(
CREATE VIEW event AS
SELECT a.id AS attempt_id, r.id & 1048575 AS position, r.t_s, k.type, k.severity, r.object, r.value, k.unit, r.tip_x_m, r.tip_y_m, r.tip_z_m
FROM attempt a JOIN event_row r ON r.id BETWEEN a.id << 20 AND a.id << 20 | 1048575 JOIN event_kind k ON k.id = r.kind_id;

CREATE VIEW metric AS
SELECT s.id AS score_id, r.position, k.name, r.value, k.unit
FROM score s JOIN metric_row r ON r.id BETWEEN s.id << 10 AND s.id << 10 | 1023 JOIN metric_kind k ON k.id = r.id & 1023
  AND r.id = s.id << 10 | k.id;

CREATE VIEW subscore AS
SELECT s.id AS score_id, r.id & 1023 AS position, k.name, r.value, k.weight, r.raw, k.unit, k.full_at, k.zero_at, k.gate
FROM score s JOIN subscore_row r ON r.id BETWEEN s.id << 10 AND s.id << 10 | 1023 JOIN subscore_kind k ON k.id = r.kind_id;

CREATE VIEW device_transition AS
SELECT a.id AS attempt_id, r.id & 1048575 AS position, r.t_s, c.from_state, c.to_state
FROM attempt a JOIN device_transition_row r ON r.id BETWEEN a.id << 20 AND a.id << 20 | 1048575 JOIN device_change c ON c.id = r.change_id;
)sql";

// Rows that come by name, as from a central database. The program itself writes the tables.
constexpr const char kByName[] = R"sql(
CREATE TRIGGER event_by_name INSTEAD OF INSERT ON event BEGIN
  SELECT RAISE(ABORT, 'event: position') WHERE NEW.position NOT BETWEEN 0 AND 1048575 OR NEW.position IS NULL;
  INSERT INTO event_kind
  SELECT (SELECT coalesce(max(id), 0) / 4 + 1 FROM event_kind) * 4 + (NEW.severity = 'critical')
    + 2 * (NEW.type IN ('EXCESS_FORCE', 'CRITICAL_FORCE', 'GRIP_EXCESS', 'CRUSH')), NEW.type, NEW.severity, NEW.unit
  WHERE NOT EXISTS (SELECT 1 FROM event_kind WHERE type = NEW.type AND severity = NEW.severity AND unit = NEW.unit);
  INSERT INTO event_row SELECT NEW.attempt_id << 20 | NEW.position, NEW.t_s, id, NEW.object, NEW.value, NEW.tip_x_m, NEW.tip_y_m,
    NEW.tip_z_m FROM event_kind WHERE type = NEW.type AND severity = NEW.severity AND unit = NEW.unit;
END;

CREATE TRIGGER metric_by_name INSTEAD OF INSERT ON metric BEGIN
  SELECT RAISE(ABORT, 'metric: is there already') FROM metric WHERE score_id = NEW.score_id AND name = NEW.name;
  INSERT INTO metric_kind (name, unit) SELECT NEW.name, NEW.unit
  WHERE NOT EXISTS (SELECT 1 FROM metric_kind WHERE name = NEW.name AND unit = NEW.unit);
  INSERT INTO metric_row SELECT NEW.score_id << 10 | id, NEW.position, NEW.value FROM metric_kind WHERE name = NEW.name AND unit = NEW.unit;
END;

CREATE TRIGGER subscore_by_name INSTEAD OF INSERT ON subscore BEGIN
  SELECT RAISE(ABORT, 'subscore: position') WHERE NEW.position NOT BETWEEN 0 AND 1023 OR NEW.position IS NULL;
  SELECT RAISE(ABORT, 'subscore: is there already') FROM subscore WHERE score_id = NEW.score_id AND name = NEW.name;
  INSERT INTO subscore_kind (name, unit, weight, full_at, zero_at, gate)
  SELECT NEW.name, NEW.unit, NEW.weight, NEW.full_at, NEW.zero_at, NEW.gate
  WHERE NOT EXISTS (SELECT 1 FROM subscore_kind WHERE name = NEW.name AND unit = NEW.unit AND weight IS NEW.weight
    AND full_at IS NEW.full_at AND zero_at IS NEW.zero_at AND gate = NEW.gate);
  INSERT INTO subscore_row SELECT NEW.score_id << 10 | NEW.position, id, NEW.value, NEW.raw FROM subscore_kind
  WHERE name = NEW.name AND unit = NEW.unit AND weight IS NEW.weight AND full_at IS NEW.full_at AND zero_at IS NEW.zero_at
    AND gate = NEW.gate;
END;

CREATE TRIGGER device_transition_by_name INSTEAD OF INSERT ON device_transition BEGIN
  SELECT RAISE(ABORT, 'device_transition: position') WHERE NEW.position NOT BETWEEN 0 AND 1048575 OR NEW.position IS NULL;
  INSERT INTO device_change (from_state, to_state) SELECT NEW.from_state, NEW.to_state
  WHERE NOT EXISTS (SELECT 1 FROM device_change WHERE from_state = NEW.from_state AND to_state = NEW.to_state);
  INSERT INTO device_transition_row SELECT NEW.attempt_id << 20 | NEW.position, NEW.t_s, id FROM device_change
  WHERE from_state = NEW.from_state AND to_state = NEW.to_state;
END;
)sql";

// What people write.
constexpr const char kWritten[] = R"sql(
-- What a person thought of an attempt, item by item of a named scale.
CREATE TABLE rating (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  account_uuid TEXT NOT NULL,
  rater      TEXT NOT NULL,
  scale      TEXT NOT NULL,
  item       TEXT NOT NULL,
  value      REAL NOT NULL,
  utc        TEXT NOT NULL
) STRICT;
CREATE INDEX rating_by_attempt ON rating(attempt_id);

-- Bound to the bytes of the attempt by its row_hash.
CREATE TABLE signature (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  row_hash   TEXT NOT NULL,
  account_uuid TEXT NOT NULL,
  signer     TEXT NOT NULL,
  meaning    TEXT NOT NULL CHECK (meaning IN ('review','approval','responsibility','authorship')),
  note       TEXT NOT NULL,
  utc        TEXT NOT NULL
) STRICT;
CREATE INDEX signature_by_attempt ON signature(attempt_id);

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

constexpr const char kStations[] = R"sql(
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

constexpr const char kAudit[] = R"sql(
CREATE TABLE audit (
  position  INTEGER PRIMARY KEY,
  utc       TEXT NOT NULL,
  actor     TEXT NOT NULL,
  action    TEXT NOT NULL,
  subject   TEXT NOT NULL,
  detail    TEXT NOT NULL,
  prev_hash TEXT NOT NULL,
  row_hash  TEXT NOT NULL
) STRICT;
)sql";

constexpr const char kIndices[] = R"sql(
CREATE INDEX attempt_running ON attempt(status) WHERE status = 'running';
CREATE INDEX attempt_by_trainee ON attempt(trainee_id, exercise_id, level);
-- For the desk's cohort, which reads this alone: each column that its queries name, the rubric as substr(ruleset_sha256, 1, 16).
CREATE INDEX attempt_by_curve ON attempt(exercise_id, level, hand, substr(ruleset_sha256, 1, 16), trainee_id, id, status, started_utc,
  device_ticks, device_overruns, saturated_contact_share);
CREATE INDEX audit_by_subject ON audit(subject);
CREATE INDEX score_first ON score(attempt_id, revision, value, passed) WHERE revision = 0;
CREATE INDEX metric_peak_force ON metric_row(value) WHERE id & 1023 = 1;
CREATE INDEX event_grave ON event_row(kind_id) WHERE kind_id & 3;
CREATE INDEX cap_of_gate ON score_cap(score_id, kind) WHERE kind = 'gate';
)sql";

// INSERT OR REPLACE would delete without asking a DELETE trigger, hence the _no_replace ones.
constexpr const char kGuards[] = R"sql(
CREATE TRIGGER attempt_begins_running BEFORE INSERT ON attempt WHEN NEW.status <> 'running'
BEGIN SELECT RAISE(ABORT, 'an attempt begins as running'); END;
CREATE TRIGGER attempt_no_replace BEFORE INSERT ON attempt
WHEN EXISTS (SELECT 1 FROM attempt WHERE id = NEW.id OR uuid = NEW.uuid)
BEGIN SELECT RAISE(ABORT, 'the attempt exists already'); END;
CREATE TRIGGER attempt_no_update BEFORE UPDATE ON attempt WHEN OLD.status <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be changed'); END;
CREATE TRIGGER attempt_keeps_identity
BEFORE UPDATE OF id, uuid, trainee_id, session_id, calibration_id, exercise_id, exercise_version, ruleset_sha256, level,
  seed, board, hand, assists, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program,
  started_utc,
  owner_pid, owner_boot, owner_start, hash_version ON attempt
BEGIN SELECT RAISE(ABORT, 'what an attempt began with cannot be changed'); END;
CREATE TRIGGER attempt_no_delete BEFORE DELETE ON attempt
BEGIN SELECT RAISE(ABORT, 'an attempt cannot be deleted'); END;
CREATE TRIGGER exam_once BEFORE INSERT ON attempt
WHEN NEW.level = 'exam' AND EXISTS (SELECT 1 FROM attempt WHERE trainee_id = NEW.trainee_id
  AND exercise_id = NEW.exercise_id AND level = 'exam' AND board = NEW.board)
BEGIN SELECT RAISE(ABORT, 'an exam board is met once'); END;
CREATE TRIGGER ruleset_no_replace BEFORE INSERT ON ruleset WHEN EXISTS (SELECT 1 FROM ruleset WHERE sha256 = NEW.sha256)
BEGIN SELECT RAISE(ABORT, 'the ruleset exists already'); END;
CREATE TRIGGER score_no_replace BEFORE INSERT ON score
WHEN EXISTS (SELECT 1 FROM score WHERE id = NEW.id OR (attempt_id = NEW.attempt_id AND revision = NEW.revision))
BEGIN SELECT RAISE(ABORT, 'the score exists already'); END;
CREATE TRIGGER account_keeps_identity BEFORE UPDATE OF id, uuid, login, role, trainee_id, created_utc ON account
BEGIN SELECT RAISE(ABORT, 'account: whose it is cannot be changed'); END;
CREATE TRIGGER audit_follows BEFORE INSERT ON audit
WHEN NEW.position <> (SELECT coalesce(max(position), 0) + 1 FROM audit)
  OR NEW.prev_hash <> coalesce((SELECT row_hash FROM audit ORDER BY position DESC LIMIT 1), '')
BEGIN SELECT RAISE(ABORT, 'an audit entry follows the last one'); END;
-- What hangs on a row by its number alone goes first.
CREATE TRIGGER score_keeps_rows BEFORE DELETE ON score
WHEN EXISTS (SELECT 1 FROM metric_row WHERE id BETWEEN OLD.id << 10 AND OLD.id << 10 | 1023)
  OR EXISTS (SELECT 1 FROM subscore_row WHERE id BETWEEN OLD.id << 10 AND OLD.id << 10 | 1023)
BEGIN SELECT RAISE(ABORT, 'score: its metrics and sub-scores are there yet'); END;
)sql";

constexpr const char kProgrammes[] = R"sql(
-- Whether a person takes part: the newest row of a trainee holds, and who has none does.
CREATE TABLE standing (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  active     INTEGER NOT NULL CHECK (active IN (0, 1)),
  reason     TEXT NOT NULL,
  author     TEXT NOT NULL,
  printed    TEXT NOT NULL,
  utc        TEXT NOT NULL
) STRICT;
CREATE INDEX standing_by_trainee ON standing(trainee_id, uuid, active);

-- A programme (curriculum of that name) for one person or for a group, whoever is in it. due: "2026-06-30", '' without.
CREATE TABLE assignment (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  trainee_id INTEGER REFERENCES trainee(id),
  group_name TEXT NOT NULL,
  programme  TEXT NOT NULL,
  due        TEXT NOT NULL,
  author     TEXT NOT NULL,
  printed    TEXT NOT NULL,
  utc        TEXT NOT NULL,
  CHECK ((trainee_id IS NULL) = (group_name <> ''))
) STRICT;

CREATE TABLE withdrawal (
  id            INTEGER PRIMARY KEY,
  uuid          TEXT NOT NULL UNIQUE,
  assignment_id INTEGER NOT NULL UNIQUE REFERENCES assignment(id),
  reason        TEXT NOT NULL,
  author        TEXT NOT NULL,
  printed       TEXT NOT NULL,
  utc           TEXT NOT NULL
) STRICT;
)sql";

/// A person's attempts at a skill with their names, out of the index alone: what certificates stand on.
const std::string kByUuid =
    "DROP INDEX IF EXISTS attempt_by_trainee;\n"
    "CREATE INDEX attempt_by_trainee ON attempt(trainee_id, exercise_id, level, uuid);\n";

constexpr const char kEndings[] = R"sql(
CREATE TABLE erasure (
  id         INTEGER PRIMARY KEY,
  uuid       TEXT NOT NULL UNIQUE,
  trainee_id INTEGER NOT NULL REFERENCES trainee(id),
  kind       TEXT NOT NULL CHECK (kind IN ('identity','training')),
  rule       TEXT NOT NULL,
  author     TEXT NOT NULL,
  utc        TEXT NOT NULL
) STRICT;
CREATE INDEX erasure_by_trainee ON erasure(trainee_id, kind);

CREATE TABLE revocation (
  id             INTEGER PRIMARY KEY,
  uuid           TEXT NOT NULL UNIQUE,
  certificate_id INTEGER NOT NULL REFERENCES certificate(id),
  author         TEXT NOT NULL,
  printed        TEXT NOT NULL,
  reason         TEXT NOT NULL CHECK (length(trim(reason)) >= 10),
  utc            TEXT NOT NULL
) STRICT;
CREATE INDEX revocation_by_certificate ON revocation(certificate_id);

CREATE TABLE withdrawal (
  id            INTEGER PRIMARY KEY,
  uuid          TEXT NOT NULL UNIQUE,
  assignment_id INTEGER NOT NULL REFERENCES assignment(id),
  reason        TEXT NOT NULL,
  author        TEXT NOT NULL,
  printed       TEXT NOT NULL,
  utc           TEXT NOT NULL
) STRICT;
CREATE INDEX withdrawal_by_assignment ON withdrawal(assignment_id);
)sql";

std::string guard(const std::string& table, const std::string& name, const std::string& when,
                  const std::string& words) {
  return "CREATE TRIGGER " + table + "_" + name + " BEFORE " + when + " BEGIN SELECT RAISE(ABORT, '" + table + ": " +
         words + "'); END;\n";
}

std::string never_changed(const std::string& table) {
  return guard(table, "no_update", "UPDATE ON " + table, "a row cannot be changed");
}

/// @param unless SQL that finds a row where the row may go; empty: never.
std::string never_deleted(const std::string& table, const std::string& unless = "") {
  return guard(table, "no_delete", "DELETE ON " + table + (unless.empty() ? "" : " WHEN NOT EXISTS (" + unless + ")"),
               "a row cannot be deleted");
}

/// @param same SQL: what else is unique besides the number.
std::string never_replaced(const std::string& table, const std::string& same = "") {
  return guard(table, "no_replace",
               "INSERT ON " + table + " WHEN EXISTS (SELECT 1 FROM " + table + " WHERE id = NEW.id" +
                   (same.empty() ? "" : " OR " + same) + ")",
               "the row exists already");
}

/// The tables of rows of an attempt, each with SQL for the attempt's number, of ROW.
const std::vector<std::pair<std::string, std::string>>& attempt_row_tables() {
  const char* const of_score = "(SELECT attempt_id FROM score WHERE id = ROW.id >> 10)";
  static const std::vector<std::pair<std::string, std::string>> kTables{
      {"score", "ROW.attempt_id"},
      {"device_warning", "ROW.attempt_id"},
      {"event_row", "ROW.id >> 20"},
      {"device_transition_row", "ROW.id >> 20"},
      {"metric_row", of_score},
      {"subscore_row", of_score},
      {"score_cap", "(SELECT attempt_id FROM score WHERE id = ROW.score_id)"}};
  return kTables;
}

std::string of_row(std::string attempt, const std::string& row) { return attempt.replace(attempt.find("ROW"), 3, row); }

std::string erased_with(const std::string& attempt) {
  return "SELECT 1 FROM erasure e JOIN attempt a ON a.trainee_id = e.trainee_id WHERE a.id = " +
         of_row(attempt, "OLD") + " AND e.kind = 'training'";
}

/// Rows of an attempt come while it runs and go only with an erasure of training data.
std::string rows_of_attempts() {
  std::string sql;
  for (const auto& [table, attempt] : attempt_row_tables()) {
    sql += guard(table, "late",
                 "INSERT ON " + table + " WHEN (SELECT status FROM attempt WHERE id = " + of_row(attempt, "NEW") +
                     ") IS NOT 'running'",
                 "a finished attempt cannot be added to") +
           never_changed(table) + never_deleted(table, erased_with(attempt));
  }
  return sql;
}

// With what these rows may go.
constexpr const char* kOfCertificate =
    "SELECT 1 FROM erasure e JOIN certificate c ON c.trainee_id = e.trainee_id"
    " WHERE c.id = OLD.certificate_id AND e.kind = 'training'";
constexpr const char* kOfAssignment =
    "SELECT 1 FROM erasure e JOIN assignment a ON a.trainee_id = e.trainee_id WHERE a.id = OLD.assignment_id";

/// Kept for good, with a number that nothing takes over.
std::string kept_for_good() {
  std::string sql;
  for (const char* table : {"ruleset", "benchmark", "device_calibration", "curriculum", "erasure", "replica", "audit",
                            "event_kind", "metric_kind", "subscore_kind", "device_change"}) {
    sql += never_changed(table) + never_deleted(table);
  }
  for (const char* table : {"device_calibration", "subscore_kind"}) sql += never_replaced(table);
  sql += never_replaced("event_kind", "(type = NEW.type AND severity = NEW.severity AND unit = NEW.unit)");
  sql += never_replaced("metric_kind", "(name = NEW.name AND unit = NEW.unit)");
  return sql + never_replaced("device_change", "(from_state = NEW.from_state AND to_state = NEW.to_state)");
}

/// Rows that people write go with their person, once the erasure stands: what was judged of them only with 'training'.
std::string written_rows() {
  std::string sql;
  for (const char* table :
       {"consent", "note", "rating", "signature", "verdict_override", "certificate", "revocation"}) {
    sql += never_changed(table);
  }
  const std::string of_person = "SELECT 1 FROM erasure WHERE trainee_id = OLD.trainee_id";
  for (const char* table : {"note", "consent", "account"}) sql += never_deleted(table, of_person);
  const std::string of_attempt =
      "SELECT 1 FROM erasure e JOIN attempt a ON a.trainee_id = e.trainee_id WHERE a.id = OLD.attempt_id";
  // What they signed and rated themselves goes with the identity.
  for (const char* table : {"signature", "rating"}) sql += never_deleted(table, of_attempt);
  sql += never_deleted("verdict_override", of_attempt + " AND e.kind = 'training'");
  sql += never_deleted("certificate", of_person + " AND kind = 'training'");
  sql += never_deleted("revocation", kOfCertificate);
  const std::string same = "uuid = NEW.uuid";
  for (const char* table : {"consent", "rating", "signature", "benchmark", "note", "verdict_override", "certificate"}) {
    sql += never_replaced(table, same);
  }
  sql += never_replaced("revocation", same + " OR certificate_id = NEW.certificate_id");
  sql += never_replaced("curriculum", same + " OR (name = NEW.name AND version = NEW.version AND uuid = NEW.uuid)");
  sql += never_replaced("erasure", same + " OR (trainee_id = NEW.trainee_id AND kind = NEW.kind)");
  return sql + never_replaced("account", same + " OR login = NEW.login OR (trainee_id = NEW.trainee_id)");
}

}  // namespace

const char* programme_schema_sql() {
  static const std::string kSql = [] {
    std::string sql = kProgrammes;
    for (const char* table : {"standing", "assignment", "withdrawal"}) sql += never_changed(table);
    const std::string of_person = "SELECT 1 FROM erasure WHERE trainee_id = OLD.trainee_id";
    for (const char* table : {"standing", "assignment"}) {
      sql += never_deleted(table, of_person) + never_replaced(table, "uuid = NEW.uuid");
    }
    sql += never_deleted("withdrawal", kOfAssignment);
    return sql + never_replaced("withdrawal", "uuid = NEW.uuid OR assignment_id = NEW.assignment_id");
  }();
  return kSql.c_str();
}

const char* running_rows_schema_sql() {
  static const std::string kSql = [] {
    std::string sql;
    for (const auto& [table, attempt] : attempt_row_tables()) {
      sql += "DROP TRIGGER " + table + "_no_delete;\n" +
             never_deleted(table, erased_with(attempt) + " UNION ALL SELECT 1 FROM attempt WHERE id = " +
                                      of_row(attempt, "OLD") + " AND status = 'running'");
    }
    return sql;
  }();
  return kSql.c_str();
}

const char* endings_schema_sql() {
  static const std::string kSql = [] {
    const char* const kTables[] = {"erasure", "revocation", "withdrawal"};
    std::string kept, back, guards;
    for (const std::string table : kTables) {
      kept += "CREATE TABLE kept_" + table + " AS SELECT * FROM " + table + ";\nDROP TABLE " + table + ";\n";
      // A row that breaks the table's own rules is none of this program's: it stays in the backup.
      back += "INSERT OR IGNORE INTO " + table + " SELECT * FROM kept_" + table + ";\nDROP TABLE kept_" + table + ";\n";
      guards += never_changed(table) + never_replaced(table, "uuid = NEW.uuid");
    }
    return kByUuid + kept + kEndings + back + guards + never_deleted("erasure") +
           never_deleted("revocation", kOfCertificate) + never_deleted("withdrawal", kOfAssignment);
  }();
  return kSql.c_str();
}

const char* schema_sql() {
  static const std::string kSql = std::string(kPeople) + kRules + kAttemptTables + kRowTables + kViews + kByName +
                                  kWritten + kStations + kAudit + kIndices + kGuards + rows_of_attempts() +
                                  kept_for_good() + written_rows();
  return kSql.c_str();
}

}  // namespace trocar
