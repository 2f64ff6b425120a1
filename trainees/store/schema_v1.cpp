// Schema version 1: trainees, exercise versions, attempts with what belongs to them.
//
// Training rows know a trainee by number and UUID only; who that is does not stand here. A finished attempt and its
// rows cannot change: triggers refuse UPDATE and DELETE, and row_hash chains every finished attempt to the one before
// (attempt_chain.h).
#include "trainees/store/migrations.h"

namespace trocar {

const char* const kSchemaV1 = R"sql(
CREATE TABLE trainee (
  id          INTEGER PRIMARY KEY,
  uuid        TEXT NOT NULL UNIQUE,
  code        TEXT NOT NULL UNIQUE COLLATE NOCASE,
  created_utc TEXT NOT NULL
) STRICT;

-- An exercise file as it was: its rubric is graded by exactly these bytes.
CREATE TABLE exercise_version (
  sha256      TEXT PRIMARY KEY CHECK (length(sha256) = 64),
  exercise_id TEXT NOT NULL,
  version     TEXT NOT NULL,
  toml        TEXT NOT NULL
) STRICT;

CREATE TABLE attempt (
  id               INTEGER PRIMARY KEY AUTOINCREMENT,
  uuid             TEXT NOT NULL UNIQUE,
  trainee_id       INTEGER NOT NULL REFERENCES trainee(id),
  exercise_id      TEXT NOT NULL,
  exercise_version TEXT NOT NULL,
  rubric_sha256    TEXT NOT NULL REFERENCES exercise_version(sha256),
  level            TEXT NOT NULL,
  seed             INTEGER NOT NULL,
  board            INTEGER NOT NULL,
  hand             TEXT NOT NULL,
  organ_name       TEXT NOT NULL,
  organ_source     TEXT NOT NULL,
  organ_sha256     TEXT NOT NULL,
  organ_synthetic  INTEGER NOT NULL CHECK (organ_synthetic IN (0, 1)),
  organ_credit     TEXT NOT NULL,
  started_utc      TEXT NOT NULL,
  -- the process that runs it, so that a dead one can be told from a living one
  owner_pid        INTEGER NOT NULL,
  owner_boot       TEXT NOT NULL,
  owner_start      INTEGER NOT NULL,
  status           TEXT NOT NULL CHECK (status IN ('running','completed','timeout','aborted','fault','void')),
  finished_utc     TEXT,
  score            REAL CHECK (score IS NULL OR score BETWEEN 0 AND 100),
  passed           INTEGER NOT NULL DEFAULT 0 CHECK (passed IN (0, 1)),
  grade            TEXT NOT NULL DEFAULT 'not graded',
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
  chain_position   INTEGER UNIQUE,
  prev_hash        TEXT,
  row_hash         TEXT UNIQUE,
  CHECK ((status = 'running') = (row_hash IS NULL))
) STRICT;
CREATE INDEX attempt_by_trainee ON attempt(trainee_id, exercise_id, level, id);
CREATE INDEX attempt_running ON attempt(status) WHERE status = 'running';

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

-- NULL in value: undefined for this attempt.
CREATE TABLE metric (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  name       TEXT NOT NULL,
  value      REAL,
  unit       TEXT NOT NULL,
  PRIMARY KEY (attempt_id, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE subscore (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  name       TEXT NOT NULL,
  value      REAL,
  weight     REAL,
  raw        REAL,
  unit       TEXT NOT NULL,
  full_at    REAL,
  zero_at    REAL,
  gate       INTEGER NOT NULL CHECK (gate IN (0, 1)),
  PRIMARY KEY (attempt_id, name)
) STRICT, WITHOUT ROWID;

CREATE TABLE score_cap (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  reason     TEXT NOT NULL,
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;

CREATE TRIGGER exercise_version_no_update BEFORE UPDATE ON exercise_version
BEGIN SELECT RAISE(ABORT, 'an exercise version cannot be changed'); END;
CREATE TRIGGER exercise_version_no_delete BEFORE DELETE ON exercise_version
BEGIN SELECT RAISE(ABORT, 'an exercise version cannot be deleted'); END;

CREATE TRIGGER attempt_begins_running BEFORE INSERT ON attempt WHEN NEW.status <> 'running'
BEGIN SELECT RAISE(ABORT, 'an attempt begins as running'); END;
-- INSERT OR REPLACE would delete without asking the DELETE trigger.
CREATE TRIGGER attempt_no_replace BEFORE INSERT ON attempt
WHEN EXISTS (SELECT 1 FROM attempt WHERE id = NEW.id OR uuid = NEW.uuid)
BEGIN SELECT RAISE(ABORT, 'the attempt exists already'); END;
CREATE TRIGGER attempt_no_update BEFORE UPDATE ON attempt WHEN OLD.status <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be changed'); END;
CREATE TRIGGER attempt_keeps_identity
BEFORE UPDATE OF id, uuid, trainee_id, exercise_id, exercise_version, rubric_sha256, level, seed, board, hand, organ_name,
  organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, owner_pid, owner_boot, owner_start ON attempt
BEGIN SELECT RAISE(ABORT, 'what an attempt began with cannot be changed'); END;
CREATE TRIGGER attempt_no_delete BEFORE DELETE ON attempt
BEGIN SELECT RAISE(ABORT, 'an attempt cannot be deleted'); END;

CREATE TRIGGER event_late BEFORE INSERT ON event
WHEN (SELECT status FROM attempt WHERE id = NEW.attempt_id) <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be added to'); END;
CREATE TRIGGER event_no_update BEFORE UPDATE ON event BEGIN SELECT RAISE(ABORT, 'an event cannot be changed'); END;
CREATE TRIGGER event_no_delete BEFORE DELETE ON event BEGIN SELECT RAISE(ABORT, 'an event cannot be deleted'); END;

CREATE TRIGGER metric_late BEFORE INSERT ON metric
WHEN (SELECT status FROM attempt WHERE id = NEW.attempt_id) <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be added to'); END;
CREATE TRIGGER metric_no_update BEFORE UPDATE ON metric BEGIN SELECT RAISE(ABORT, 'a metric cannot be changed'); END;
CREATE TRIGGER metric_no_delete BEFORE DELETE ON metric BEGIN SELECT RAISE(ABORT, 'a metric cannot be deleted'); END;

CREATE TRIGGER subscore_late BEFORE INSERT ON subscore
WHEN (SELECT status FROM attempt WHERE id = NEW.attempt_id) <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be added to'); END;
CREATE TRIGGER subscore_no_update BEFORE UPDATE ON subscore BEGIN SELECT RAISE(ABORT, 'a subscore cannot be changed'); END;
CREATE TRIGGER subscore_no_delete BEFORE DELETE ON subscore BEGIN SELECT RAISE(ABORT, 'a subscore cannot be deleted'); END;

CREATE TRIGGER score_cap_late BEFORE INSERT ON score_cap
WHEN (SELECT status FROM attempt WHERE id = NEW.attempt_id) <> 'running'
BEGIN SELECT RAISE(ABORT, 'a finished attempt cannot be added to'); END;
CREATE TRIGGER score_cap_no_update BEFORE UPDATE ON score_cap BEGIN SELECT RAISE(ABORT, 'a cap cannot be changed'); END;
CREATE TRIGGER score_cap_no_delete BEFORE DELETE ON score_cap BEGIN SELECT RAISE(ABORT, 'a cap cannot be deleted'); END;
)sql";

}  // namespace trocar
