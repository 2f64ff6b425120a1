// Schema version 3: an exam board is met once, told by the board and not by the seed; what the device loop warned of
// and how its state changed is kept with the attempt.
//
// Two seeds can draw one board (they are taken modulo a million) and schema 2 went by the seed. A trigger and not an
// index: an older database may hold two sittings of one board, and those stay as they are. docs/data_store.md.
#include "trainees/store/migrations.h"

namespace trocar {

const char* const kSchemaV3 = R"sql(
DROP INDEX IF EXISTS exam_once;
CREATE TRIGGER exam_once BEFORE INSERT ON attempt
WHEN NEW.level = 'exam' AND EXISTS (SELECT 1 FROM attempt WHERE trainee_id = NEW.trainee_id
  AND exercise_id = NEW.exercise_id AND level = 'exam' AND board = NEW.board)
BEGIN SELECT RAISE(ABORT, 'an exam board is met once'); END;

CREATE TABLE device_warning (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  name       TEXT NOT NULL,
  first_s    REAL,
  ticks      INTEGER NOT NULL,
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE device_transition (
  attempt_id INTEGER NOT NULL REFERENCES attempt(id),
  position   INTEGER NOT NULL,
  t_s        REAL,
  from_state TEXT NOT NULL,
  to_state   TEXT NOT NULL,
  PRIMARY KEY (attempt_id, position)
) STRICT, WITHOUT ROWID;

CREATE TRIGGER device_warning_late BEFORE INSERT ON device_warning
WHEN (SELECT status FROM attempt WHERE id = NEW.attempt_id) IS NOT 'running'
BEGIN SELECT RAISE(ABORT, 'device_warning: a finished attempt cannot be added to'); END;
CREATE TRIGGER device_warning_no_update BEFORE UPDATE ON device_warning
BEGIN SELECT RAISE(ABORT, 'device_warning: a row cannot be changed'); END;
CREATE TRIGGER device_warning_no_delete BEFORE DELETE ON device_warning
BEGIN SELECT RAISE(ABORT, 'device_warning: a row cannot be deleted'); END;
CREATE TRIGGER device_transition_late BEFORE INSERT ON device_transition
WHEN (SELECT status FROM attempt WHERE id = NEW.attempt_id) IS NOT 'running'
BEGIN SELECT RAISE(ABORT, 'device_transition: a finished attempt cannot be added to'); END;
CREATE TRIGGER device_transition_no_update BEFORE UPDATE ON device_transition
BEGIN SELECT RAISE(ABORT, 'device_transition: a row cannot be changed'); END;
CREATE TRIGGER device_transition_no_delete BEFORE DELETE ON device_transition
BEGIN SELECT RAISE(ABORT, 'device_transition: a row cannot be deleted'); END;
)sql";

}  // namespace trocar
