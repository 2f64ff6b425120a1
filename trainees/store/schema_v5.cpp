// Schema version 5: the same record in two thirds of the room. Texts that repeat (what an event or a metric is called,
// its unit, what a sub-score's marks mean) stand once in dictionaries; events, metrics and sub-scores are narrow rows
// in the order of their attempts.
//
// A row's number says whose it is, so that an attempt's rows lie side by side and no index is needed to find them:
//   event_row, device_transition_row   attempt * 2^20 + position
//   metric_row                         score * 2^10 + number of the metric in metric_kind
//   subscore_row                       score * 2^10 + position
// (tables with a key of two columns leave an eighth of every page empty, because rows come in order; these fill
// theirs.) The views event, metric, subscore and device_transition have the columns that the tables of those names had.
// What row_hash covers is what they show: no hash changes.
//
// Two unique indices over hashes go (they cost a page at random for every attempt, and the chain is checked by
// computing it), and indices lose what is in them twice. docs/data_store.md.
#include <string>

#include "trainees/store/migrations.h"

namespace trocar {
namespace {

constexpr const char kKinds[] = R"sql(
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
)sql";

constexpr const char kRows[] = R"sql(
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

// A text where a number must be ends the migration, and everything stays as it was: no row may run into another
// attempt's.
constexpr const char kCopy[] = R"sql(
INSERT INTO event_kind SELECT row_number() OVER (ORDER BY type, severity, unit) * 4 + (severity = 'critical')
  + 2 * (type IN ('EXCESS_FORCE', 'CRITICAL_FORCE', 'GRIP_EXCESS', 'CRUSH')), type, severity, unit
FROM (SELECT DISTINCT type, severity, unit FROM event);
INSERT INTO event_row
SELECT iif(e.position BETWEEN 0 AND 1048575, e.attempt_id << 20 | e.position, 'too many'), e.t_s, k.id, e.object, e.value, e.tip_x_m,
  e.tip_y_m, e.tip_z_m
FROM event e CROSS JOIN event_kind k ON k.type = e.type AND k.severity = e.severity AND k.unit = e.unit ORDER BY e.attempt_id, e.position;
INSERT INTO metric_kind (name, unit) SELECT name, unit FROM metric WHERE (name, unit) <> ('force_max_n', 'N')
GROUP BY name, unit ORDER BY min(position), name, unit;
INSERT INTO metric_row SELECT m.score_id << 10 | k.id, m.position, m.value
FROM metric m CROSS JOIN metric_kind k ON k.name = m.name AND k.unit = m.unit ORDER BY 1;
INSERT INTO subscore_kind (name, unit, weight, full_at, zero_at, gate)
SELECT DISTINCT name, unit, weight, full_at, zero_at, gate FROM subscore ORDER BY name, unit, weight, full_at, zero_at, gate;
INSERT INTO subscore_row SELECT iif(r.position BETWEEN 0 AND 1023, r.score_id << 10 | r.position, 'too many'), k.id, r.value, r.raw
FROM subscore r CROSS JOIN subscore_kind k ON k.name = r.name AND k.unit = r.unit AND k.weight IS r.weight AND k.full_at IS r.full_at
  AND k.zero_at IS r.zero_at AND k.gate = r.gate ORDER BY r.score_id, r.position;
INSERT INTO device_change (from_state, to_state) SELECT DISTINCT from_state, to_state FROM device_transition ORDER BY from_state, to_state;
INSERT INTO device_transition_row SELECT iif(t.position BETWEEN 0 AND 1048575, t.attempt_id << 20 | t.position, 'too many'), t.t_s, c.id
FROM device_transition t CROSS JOIN device_change c ON c.from_state = t.from_state AND c.to_state = t.to_state
ORDER BY t.attempt_id, t.position;
DROP TABLE event;
DROP TABLE metric;
DROP TABLE subscore;
DROP TABLE device_transition;
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

// Copied without UNIQUE at row_hash; counter and rows as they were. Renamed the old way: what names the table keeps its
// text.
constexpr const char kAttempt[] = R"sql(
CREATE TABLE attempt_5 (
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
  -- not IN: SQLite would build a table of the words for every row
  status           TEXT NOT NULL CHECK (status = 'running' OR status = 'completed' OR status = 'timeout' OR status = 'aborted'
                                        OR status = 'fault' OR status = 'void'),
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
  row_hash         TEXT,
  CHECK ((status = 'running') = (row_hash IS NULL))
) STRICT;
INSERT INTO sqlite_sequence (name, seq) SELECT 'attempt_5', seq FROM sqlite_sequence WHERE name = 'attempt';
INSERT INTO attempt_5 SELECT * FROM attempt;
)sql";

constexpr const char kAudit[] = R"sql(
CREATE TABLE audit_5 (
  position  INTEGER PRIMARY KEY,
  utc       TEXT NOT NULL,
  actor     TEXT NOT NULL,
  action    TEXT NOT NULL,
  subject   TEXT NOT NULL,
  detail    TEXT NOT NULL,
  prev_hash TEXT NOT NULL,
  row_hash  TEXT NOT NULL
) STRICT;
INSERT INTO audit_5 SELECT * FROM audit;
)sql";

constexpr const char kExchange[] = R"sql(
DROP TABLE attempt;
DROP TABLE audit;
PRAGMA legacy_alter_table = ON;
ALTER TABLE attempt_5 RENAME TO attempt;
ALTER TABLE audit_5 RENAME TO audit;
PRAGMA legacy_alter_table = OFF;
)sql";

constexpr const char kIndices[] = R"sql(
CREATE INDEX attempt_running ON attempt(status) WHERE status = 'running';
CREATE INDEX attempt_by_trainee ON attempt(trainee_id, exercise_id, level);
-- For the desk's cohort, which reads this alone: each column that its queries name, the rubric as substr(ruleset_sha256, 1, 16).
CREATE INDEX attempt_by_curve ON attempt(exercise_id, level, hand, substr(ruleset_sha256, 1, 16), trainee_id, id, status, started_utc,
  device_ticks, device_overruns, saturated_contact_share);
CREATE INDEX audit_by_subject ON audit(subject);
DROP INDEX score_first;
CREATE INDEX score_first ON score(attempt_id, revision, value, passed) WHERE revision = 0;
CREATE INDEX metric_peak_force ON metric_row(value) WHERE id & 1023 = 1;
CREATE INDEX event_grave ON event_row(kind_id) WHERE kind_id & 3;
)sql";

/// Texts of triggers that go with their table and come again; they are those of versions 2 to 4.
constexpr const char kPerson[] = R"sql(
-- Random, into the digest of the person's audit entries; goes with the person (kept_rows.h).
ALTER TABLE person ADD COLUMN salt TEXT NOT NULL DEFAULT '';
)sql";

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
  seed, board, hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, program, started_utc,
  owner_pid, owner_boot, owner_start, hash_version ON attempt
BEGIN SELECT RAISE(ABORT, 'what an attempt began with cannot be changed'); END;
CREATE TRIGGER attempt_no_delete BEFORE DELETE ON attempt
BEGIN SELECT RAISE(ABORT, 'an attempt cannot be deleted'); END;
CREATE TRIGGER exam_once BEFORE INSERT ON attempt
WHEN NEW.level = 'exam' AND EXISTS (SELECT 1 FROM attempt WHERE trainee_id = NEW.trainee_id
  AND exercise_id = NEW.exercise_id AND level = 'exam' AND board = NEW.board)
BEGIN SELECT RAISE(ABORT, 'an exam board is met once'); END;
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

std::string guard(const std::string& table, const std::string& name, const std::string& when,
                  const std::string& words) {
  return "CREATE TRIGGER " + table + "_" + name + " BEFORE " + when + " BEGIN SELECT RAISE(ABORT, '" + table + ": " +
         words + "'); END;\n";
}

std::string unchanging(const std::string& table, const std::string& unless_deleted = "") {
  return guard(table, "no_update", "UPDATE ON " + table, "a row cannot be changed") +
         guard(table, "no_delete",
               "DELETE ON " + table + (unless_deleted.empty() ? "" : " WHEN NOT EXISTS (" + unless_deleted + ")"),
               "a row cannot be deleted");
}

/// Rows of an attempt come while it runs and go only with an erasure of training data. @param attempt SQL for its
/// number, of ROW.
std::string of_attempt(const std::string& table, const std::string& attempt) {
  const auto of = [&attempt](const std::string& row) {
    std::string sql = attempt;
    return sql.replace(sql.find("ROW"), 3, row);
  };
  return guard(
             table, "late",
             "INSERT ON " + table + " WHEN (SELECT status FROM attempt WHERE id = " + of("NEW") + ") IS NOT 'running'",
             "a finished attempt cannot be added to") +
         unchanging(table, "SELECT 1 FROM erasure e JOIN attempt a ON a.trainee_id = e.trainee_id WHERE a.id = " +
                               of("OLD") + " AND e.kind = 'training'");
}

std::string guards() {
  std::string sql = kGuards;
  for (const char* table : {"event_row", "device_transition_row"}) sql += of_attempt(table, "ROW.id >> 20");
  sql += of_attempt("metric_row", "(SELECT attempt_id FROM score WHERE id = ROW.id >> 10)");
  sql += of_attempt("subscore_row", "(SELECT attempt_id FROM score WHERE id = ROW.id >> 10)");
  sql += unchanging("audit");
  for (const char* table : {"event_kind", "metric_kind", "subscore_kind", "device_change"}) {
    sql += unchanging(table);
    const std::string name = table;
    const std::string also = name == "event_kind"
                                 ? " OR (type = NEW.type AND severity = NEW.severity AND unit = NEW.unit)"
                             : name == "metric_kind"   ? " OR (name = NEW.name AND unit = NEW.unit)"
                             : name == "device_change" ? " OR (from_state = NEW.from_state AND to_state = NEW.to_state)"
                                                       : "";
    sql += guard(name, "no_replace",
                 "INSERT ON " + name + " WHEN EXISTS (SELECT 1 FROM " + name + " WHERE id = NEW.id" + also + ")",
                 "the row exists already");
  }
  return sql;
}

}  // namespace

const char* schema_v5() {
  static const std::string kSql = std::string(kKinds) + kRows + kCopy + kViews + kByName + kAttempt + kAudit +
                                  kExchange + kIndices + kPerson + guards();
  return kSql.c_str();
}

}  // namespace trocar
