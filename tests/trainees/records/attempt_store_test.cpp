// An attempt's life: begun, finished in one piece, read back equal, never changed.
#include "trainees/records/attempt_store.h"

#include <sqlite3.h>

#include <cmath>
#include <limits>

#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::attempt_store_test {
namespace {

using AttemptFile = TemporaryFolder;

void expect_equal(const AttemptResult& back, const AttemptResult& result) {
  EXPECT_EQ(back.grade.status, result.grade.status);
  EXPECT_EQ(back.grade.score, result.grade.score);
  EXPECT_EQ(back.grade.passed, result.grade.passed);
  EXPECT_EQ(back.grade.grade, result.grade.grade);
  EXPECT_EQ(back.grade.caps, result.grade.caps);
  ASSERT_EQ(back.grade.metrics.size(), result.grade.metrics.size());
  for (std::size_t i = 0; i < result.grade.metrics.size(); ++i) {
    EXPECT_EQ(back.grade.metrics[i].name, result.grade.metrics[i].name);
    EXPECT_EQ(back.grade.metrics[i].value, result.grade.metrics[i].value);
    EXPECT_EQ(back.grade.metrics[i].unit, result.grade.metrics[i].unit);
  }
  ASSERT_EQ(back.grade.subscores.size(), result.grade.subscores.size());
  for (std::size_t i = 0; i < result.grade.subscores.size(); ++i) {
    const Subscore &a = back.grade.subscores[i], &b = result.grade.subscores[i];
    EXPECT_EQ(std::tie(a.name, a.value, a.weight, a.raw, a.unit, a.full_at, a.zero_at, a.gate),
              std::tie(b.name, b.value, b.weight, b.raw, b.unit, b.full_at, b.zero_at, b.gate));
  }
  ASSERT_EQ(back.events.size(), result.events.size());
  for (std::size_t i = 0; i < result.events.size(); ++i) {
    const Event &a = back.events[i], &b = result.events[i];
    EXPECT_EQ(std::tie(a.t_s, a.type, a.severity, a.object, a.value, a.unit),
              std::tie(b.t_s, b.type, b.severity, b.object, b.value, b.unit));
    EXPECT_EQ(a.tip_T, b.tip_T);
  }
  const RunReport &a = back.device, &b = result.device;
  EXPECT_EQ(std::tie(a.backend, a.rate_hz, a.ticks, a.overruns, a.saturated_contact_share, a.passivity_active_share,
                     a.min_energy_j, a.kappa, a.fault, a.realtime, a.plant),
            std::tie(b.backend, b.rate_hz, b.ticks, b.overruns, b.saturated_contact_share, b.passivity_active_share,
                     b.min_energy_j, b.kappa, b.fault, b.realtime, b.plant));
  ASSERT_EQ(a.warnings.size(), b.warnings.size());
  for (std::size_t i = 0; i < b.warnings.size(); ++i) {
    EXPECT_EQ(std::tie(a.warnings[i].name, a.warnings[i].first_s, a.warnings[i].ticks),
              std::tie(b.warnings[i].name, b.warnings[i].first_s, b.warnings[i].ticks));
  }
  ASSERT_EQ(a.transitions.size(), b.transitions.size());
  for (std::size_t i = 0; i < b.transitions.size(); ++i) {
    EXPECT_EQ(std::tie(a.transitions[i].t_s, a.transitions[i].from, a.transitions[i].to),
              std::tie(b.transitions[i].t_s, b.transitions[i].from, b.transitions[i].to));
  }
  EXPECT_EQ(back.state_hash, result.state_hash);
}

TEST(AttemptStore, ReadsBackWhatWasFinished) {
  Database database(":memory:");
  AttemptStore store(database);
  const AttemptStart start = sample_start();
  const AttemptId id = store.begin_attempt(start);
  store.finish_attempt(id, sample_result());
  const AttemptResult back = store.load(id.row);
  expect_equal(back, sample_result());
  EXPECT_EQ(back.uuid, id.uuid);
  EXPECT_EQ(back.started_utc, id.started_utc);
  EXPECT_EQ(back.exercise_id, start.exercise_id);
  EXPECT_EQ(back.exercise_version, start.exercise_version);
  EXPECT_EQ(back.rubric_sha256, digest::of_bytes(start.exercise_text));
  EXPECT_EQ(store.exercise_text(back.rubric_sha256), start.exercise_text);
  EXPECT_EQ(std::tie(back.level, back.seed, back.board, back.trainee, back.hand),
            std::tie(start.level, start.seed, start.board, start.trainee, start.hand));
  EXPECT_EQ(
      std::tie(back.organ_name, back.organ_source, back.organ_sha256, back.organ_synthetic, back.organ_credit),
      std::tie(start.organ_name, start.organ_source, start.organ_sha256, start.organ_synthetic, start.organ_credit));
}

TEST(AttemptStore, KeepsAnAbsentScoreAbsentAndNotANumberUndefined) {
  Database database(":memory:");
  AttemptResult result = sample_result();
  result.grade.status = AttemptStatus::kFault;
  result.grade.score.reset();
  result.grade.passed = false;
  result.grade.metrics = {{"mean_force", std::nan(""), "N"}};
  result.events[0].value = std::nan("");
  const AttemptId id = store_attempt(database, sample_start(), result);
  const AttemptResult back = AttemptStore(database).load(id.row);
  EXPECT_FALSE(back.grade.score);
  EXPECT_FALSE(back.grade.metrics[0].value);
  EXPECT_TRUE(std::isnan(back.events[0].value));
  EXPECT_EQ(back.grade.status, AttemptStatus::kFault);
}

TEST(AttemptStore, KeepsCapsOfEveryKindAndSqlSaysThemInTheSameWords) {
  Database database(":memory:");
  const AttemptResult result = capped_result();
  const AttemptId id = store_attempt(database, sample_start(), result);
  EXPECT_EQ(AttemptStore(database).load(id.row).grade.caps, result.grade.caps);
  EXPECT_EQ(database.check(), std::vector<std::string>{});
  sql::Statement rows(
      database.connection(),
      "SELECT cap_sentence(kind, subject, below, done, total, at_most) FROM score_cap ORDER BY position");
  std::vector<std::string> said;
  while (rows.step()) said.push_back(rows.text(0));
  EXPECT_EQ(said, cap_sentences(result.grade.caps));
}

TEST(AttemptStore, ARunningAttemptIsListedButHasNoResult) {
  Database database(":memory:");
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start());
  EXPECT_EQ(store.latest()->status, "running");
  EXPECT_NE(message_of<InputError>([&] { store.load(id.row); }).find("still running"), std::string::npos);
}

TEST(AttemptStore, FinishesOnce) {
  Database database(":memory:");
  AttemptStore store(database);
  const AttemptId id = store_attempt(database, sample_start(), sample_result());
  EXPECT_NE(message_of<InputError>([&] { store.finish_attempt(id, sample_result()); }).find("already completed"),
            std::string::npos);
  AttemptId unknown = id;
  unknown.uuid = "0";
  EXPECT_THROW(store.finish_attempt(unknown, sample_result()), InputError);
}

TEST(AttemptStore, AResultThatDoesNotFitLeavesNothingBehind) {
  Database database(":memory:");
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start());
  AttemptResult result = sample_result();
  result.grade.score = 250;
  EXPECT_THROW(store.finish_attempt(id, result), InputError);
  EXPECT_EQ(store.find(id.uuid).status, "running");
  EXPECT_EQ(sql::query_integer(database.connection(), "SELECT count(*) FROM event"), 0);
  store.finish_attempt(id, sample_result());
  result = sample_result();
  result.rubric_sha256 = std::string(64, 'f');
  EXPECT_THROW(store.finish_attempt(store.begin_attempt(sample_start()), result), std::invalid_argument);
}

TEST(AttemptStore, FindsByBeginningEndOrLatest) {
  Database database(":memory:");
  AttemptStore store(database);
  EXPECT_THROW(store.find("latest"), InputError);
  const AttemptId first = store_attempt(database, sample_start("A"), sample_result());
  const AttemptId second = store_attempt(database, sample_start("B"), sample_result(50));
  EXPECT_EQ(store.find(first.uuid).row, first.row);
  EXPECT_EQ(store.find(first.uuid.substr(24)).row, first.row);
  EXPECT_EQ(store.find("latest").row, second.row);
  EXPECT_EQ(store.load(second.uuid).trainee, "B");
  EXPECT_NE(message_of<InputError>([&] { store.find(first.uuid.substr(0, 6)); }).find("several"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { store.find("ffffffff"); }).find("not in this database"), std::string::npos);
  EXPECT_THROW(store.find("abc"), InputError);
  EXPECT_THROW(store.find("%%%%%"), InputError);
}

TEST(AttemptStore, ListsNewestFirstByTraineeAndExercise) {
  Database database(":memory:");
  AttemptStore store(database);
  for (int i = 0; i < 3; ++i) store_attempt(database, sample_start("A"), sample_result(60 + i));
  store_attempt(database, sample_start("B"), sample_result(99));
  const auto of_a = store.list({"A", "surface-touch", 2});
  ASSERT_EQ(of_a.size(), 2u);
  EXPECT_EQ(of_a[0].score, 62);
  EXPECT_EQ(of_a[1].score, 61);
  EXPECT_TRUE(of_a[0].organ_synthetic);
  EXPECT_EQ(store.list().size(), 4u);
  EXPECT_TRUE(store.list({"A", "peg-transfer", 0}).empty());
  EXPECT_EQ(store.latest("A")->score, 62);
  EXPECT_FALSE(store.latest("nobody"));
}

TEST(AttemptStore, ALoopWithoutRightsIsKnownInLists) {
  Database database(":memory:");
  AttemptStore store(database);
  const auto listed = [&](const char* backend, const std::string& realtime) {
    AttemptResult result = sample_result();
    result.device.backend = backend;
    result.device.realtime = realtime;
    const AttemptId id = store.begin_attempt(sample_start());
    store.finish_attempt(id, result);
    return store.list({}).front().soft_real_time;
  };
  const std::string refused = R"({"lanes":{"haptic":{"policy":"SCHED_OTHER","refused":"Operation not permitted"}}})";
  EXPECT_FALSE(listed("simulated", ""));
  EXPECT_FALSE(listed("simulated", R"({"lanes":{"haptic":{"policy":"SCHED_FIFO 80"}}})"));
  EXPECT_TRUE(listed("simulated", refused));
  EXPECT_FALSE(listed("pointer", refused));
}

TEST(AttemptStore, IdentifiersAreOrderedByTime) {
  Database database(":memory:");
  AttemptStore store(database);
  std::string previous;
  for (int i = 0; i < 50; ++i) {
    const std::string uuid = store.begin_attempt(sample_start()).uuid;
    EXPECT_GT(uuid, previous);
    EXPECT_EQ(uuid[14], '7');
    EXPECT_NE(std::string("89ab").find(uuid[19]), std::string::npos);
    previous = uuid;
  }
}

// What another program could try on the rows of a finished attempt.
const char* const kChanges[] = {
    "UPDATE score SET value = 100",
    "DELETE FROM score",
    "UPDATE attempt SET status = 'running'",
    "DELETE FROM attempt",
    "UPDATE event SET value = 0",
    "DELETE FROM event",
    "UPDATE metric SET value = 0",
    "DELETE FROM metric",
    "UPDATE subscore SET value = 1",
    "DELETE FROM subscore",
    "DELETE FROM score_cap",
    "UPDATE score_cap SET subject = ''",
    "INSERT INTO event SELECT attempt_id, 99, t_s, type, severity, object, value, unit, 0, 0, 0 FROM event LIMIT 1",
    "INSERT INTO score (attempt_id, revision, ruleset_sha256, passed, grade)"
    " SELECT attempt_id, 1, ruleset_sha256, 1, 'expert' FROM score",
    "INSERT OR REPLACE INTO score SELECT * FROM score",
    "INSERT INTO metric VALUES (1, 99, 'luck', 1, '')",
    "INSERT OR REPLACE INTO metric VALUES (1, 0, 'time', 1, 's')",
    "INSERT INTO subscore SELECT score_id, 99, 'luck', 1, 1, 1, '', 0, 0, 0 FROM subscore LIMIT 1",
    "INSERT INTO score_cap VALUES (1, 99, 'void', 'x', 0, 0, 0, 0)",
    "UPDATE event_row SET value = 0",
    "DELETE FROM event_row",
    "INSERT INTO event_row SELECT id + 9, t_s, kind_id, object, value, 0, 0, 0 FROM event_row LIMIT 1",
    "INSERT OR REPLACE INTO event_row SELECT * FROM event_row",
    "INSERT INTO event_row SELECT id + (1 << 30), t_s, kind_id, object, value, 0, 0, 0 FROM event_row LIMIT 1",
    "UPDATE metric_row SET value = 0",
    "DELETE FROM metric_row",
    "INSERT INTO metric_row VALUES (1 << 10 | 77, 99, 1)",
    "INSERT OR REPLACE INTO metric_row SELECT id, position, 9 FROM metric_row",
    "UPDATE subscore_row SET value = 1",
    "DELETE FROM subscore_row",
    "INSERT INTO subscore_row SELECT id + 9, kind_id, 1, 1 FROM subscore_row LIMIT 1",
    "INSERT OR REPLACE INTO subscore SELECT score_id, position, name, 1, 1, 1, '', 0, 0, 0 FROM subscore",
    "UPDATE device_transition_row SET t_s = 0",
    "DELETE FROM device_transition_row",
    "INSERT OR REPLACE INTO device_transition_row SELECT id, 9, change_id FROM device_transition_row",
    "INSERT OR REPLACE INTO device_change SELECT id, to_state, from_state FROM device_change",
    "UPDATE device_change SET to_state = ''",
    "DELETE FROM device_change",
    "UPDATE event_kind SET type = 'TARGET_HELD'",
    "DELETE FROM event_kind",
    "INSERT OR REPLACE INTO event_kind SELECT id, type || 'S', severity, unit FROM event_kind",
    "UPDATE metric_kind SET unit = 'mN'",
    "DELETE FROM metric_kind",
    "INSERT OR REPLACE INTO metric_kind SELECT id, name, 'mN' FROM metric_kind",
    "INSERT OR REPLACE INTO metric_kind (name, unit) SELECT name, unit FROM metric_kind",
    "UPDATE subscore_kind SET gate = 0",
    "DELETE FROM subscore_kind",
    "INSERT OR REPLACE INTO subscore_kind SELECT id, name, unit, 1, full_at, zero_at, gate FROM subscore_kind",
    "UPDATE device_warning SET ticks = 0",
    "DELETE FROM device_warning",
    "INSERT INTO device_warning VALUES (1, 9, 'x', 0, 1)",
    "INSERT OR REPLACE INTO device_warning SELECT * FROM device_warning",
    "UPDATE device_transition SET to_state = ''",
    "DELETE FROM device_transition",
    "INSERT INTO device_transition VALUES (1, 9, 0, '', '')",
    "INSERT OR REPLACE INTO device_transition SELECT * FROM device_transition",
    "UPDATE ruleset SET toml = ''",
    "DELETE FROM ruleset",
    "INSERT OR REPLACE INTO ruleset SELECT sha256, exercise_id, version, 'easier' FROM ruleset",
    "UPDATE audit SET detail = ''",
    "DELETE FROM audit",
    "INSERT INTO audit VALUES (9, '', '', '', '', '', '', 'x')",
    "INSERT OR REPLACE INTO audit SELECT * FROM audit",
    "INSERT OR REPLACE INTO attempt SELECT * FROM attempt",
    "INSERT OR REPLACE INTO attempt (uuid, trainee_id, exercise_id, exercise_version, ruleset_sha256, level, seed, "
    "board,"
    " hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, owner_pid, "
    "owner_boot,"
    " owner_start, program, hash_version, status) SELECT uuid, trainee_id, exercise_id, exercise_version, "
    "ruleset_sha256, level, seed, board,"
    " hand, organ_name, organ_source, organ_sha256, organ_synthetic, organ_credit, started_utc, 1, '', 1, '', 2, "
    "'running'"
    " FROM attempt"};

TEST_F(AttemptFile, AFinishedAttemptCannotBeChangedFromOutside) {
  AttemptId id;
  {
    Database database(folder_ / "t.db");
    id = store_attempt(database, sample_start(), sample_result());
  }
  for (const char* change : kChanges) EXPECT_NE(run_outside(folder_ / "t.db", change), "") << change;
  Database database(folder_ / "t.db");
  expect_equal(AttemptStore(database).load(id.row), sample_result());
  EXPECT_TRUE(database.check().empty());
}

TEST_F(AttemptFile, ARunningAttemptKeepsWhatItBeganWith) {
  Database database(folder_ / "t.db");
  AttemptStore(database).begin_attempt(sample_start());
  EXPECT_NE(run_outside(folder_ / "t.db", "UPDATE attempt SET seed = 1"), "");
  EXPECT_NE(run_outside(folder_ / "t.db", "DELETE FROM attempt"), "");
}

TEST_F(AttemptFile, MadeAnothersWhileItRunsItIsNotGraded) {
  Database database(folder_ / "t.db");
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start("T-a"));
  TraineeStore(database).ensure_id("T-b");
  ASSERT_EQ(run_outside(folder_ / "t.db", "DROP TRIGGER attempt_keeps_identity"), "");
  ASSERT_EQ(run_outside(folder_ / "t.db",
                        "UPDATE attempt SET trainee_id = (SELECT id FROM known_trainee WHERE code = 'T-b')"),
            "");
  EXPECT_NE(message_of<InputError>([&] { store.finish_attempt(id, sample_result()); }).find("was changed while it ran"),
            std::string::npos);
  EXPECT_EQ(store.find(id.uuid).status, "running");
}

TEST_F(AttemptFile, RecordingsLieBesideTheDatabaseAndMoveWithIt) {
  std::filesystem::create_directories(folder_ / "one");
  AttemptId id;
  {
    Database database(folder_ / "one" / "desk.db");
    id = store_attempt(database, sample_start(), sample_result());
  }
  EXPECT_EQ(id.recording, folder_ / "one" / "desk.recordings" / (id.uuid + ".trec"));
  std::filesystem::rename(folder_ / "one", folder_ / "two");
  Database moved(folder_ / "two" / "desk.db");
  EXPECT_EQ(AttemptStore(moved).load(id.row).recording_path,
            (folder_ / "two" / "desk.recordings" / (id.uuid + ".trec")).string());
}

TEST_F(AttemptFile, AGivenRecordingIsKeptAndNoneStaysNone) {
  std::filesystem::create_directories(folder_ / "db");
  Database database(folder_ / "db" / "t.db");
  AttemptStart start = sample_start();
  start.recording = folder_ / "elsewhere" / "x.trec";
  EXPECT_EQ(AttemptStore(database).load(store_attempt(database, start, sample_result()).row).recording_path,
            (folder_ / "elsewhere" / "x.trec").string());
  start.recording = "";
  EXPECT_EQ(AttemptStore(database).load(store_attempt(database, start, sample_result()).row).recording_path, "");
}

TEST_F(AttemptFile, AMissingOrChangedRecordingIsReported) {
  Database database(folder_ / "t.db");
  AttemptStore store(database);
  AttemptId ids[3];
  for (AttemptId& id : ids) {
    id = store.begin_attempt(sample_start());
    std::filesystem::create_directories(id.recording.parent_path());
    FILE* file = std::fopen(id.recording.c_str(), "w");
    std::fputs(id.uuid.c_str(), file);
    std::fclose(file);
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_file(id.recording);
    store.finish_attempt(id, result);
  }
  EXPECT_TRUE(store.check_recordings().empty());
  std::filesystem::remove(ids[0].recording);
  FILE* file = std::fopen(ids[1].recording.c_str(), "a");
  std::fputs("!", file);
  std::fclose(file);
  const auto problems = store.check_recordings();
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_NE(problems[0].find("is missing"), std::string::npos);
  EXPECT_NE(problems[1].find("was changed"), std::string::npos);
}

TEST_F(AttemptFile, OneRecordingCountsOnce) {
  Database database(folder_ / "t.db");
  for (const char* trainee : {"T-one", "T-two"}) {
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_bytes("the same");
    store_attempt(database, sample_start(trainee), result);
  }
  EXPECT_NE(AttemptStore(database).check_recordings().front().find("one recording counts for two attempts"),
            std::string::npos);
}

TEST(AttemptSessions, AttemptsOfOneSignInShareARowAndItsEndMoves) {
  Database database(":memory:");
  AttemptStart start = sample_start("T-1");
  start.session = "0192-session";
  start.station = "lab-3";
  start.calibration = "{\"gain\": [1]}";
  start.calibration_device = "simulated";
  store_attempt(database, start, sample_result());
  const std::string ended = sql::query_text(database.connection(), "SELECT ended_utc FROM session");
  EXPECT_NE(ended, "");
  store_attempt(database, start, sample_result());
  store_attempt(database, sample_start("T-1"), sample_result());
  sqlite3* connection = database.connection();
  EXPECT_EQ(sql::query_integer(connection, "SELECT count(*) FROM session"), 1);
  EXPECT_EQ(sql::query_text(connection, "SELECT station FROM session"), "lab-3");
  EXPECT_GE(sql::query_text(connection, "SELECT ended_utc FROM session"), ended);
  EXPECT_EQ(sql::query_integer(connection, "SELECT count(*) FROM device_calibration"), 1) << "the same bytes once";
  EXPECT_EQ(sql::query_integer(connection, "SELECT count(*) FROM attempt WHERE session_id = 1 AND calibration_id = 1"),
            2);
  EXPECT_EQ(sql::query_integer(connection,
                               "SELECT count(*) FROM attempt WHERE session_id IS NULL AND calibration_id IS NULL"),
            1);
  EXPECT_EQ(problems_of(database), "");
  AttemptStart stranger = sample_start("T-2");
  stranger.session = "0192-session";
  EXPECT_THROW(AttemptStore(database).begin_attempt(stranger), InputError);
}

TEST(AttemptSessions, AnAttemptMovedToAnotherSessionOrCalibrationIsFound) {
  Database database(":memory:");
  AttemptStart start = sample_start("T-1");
  start.session = "0192-session";
  start.calibration = "a";
  store_attempt(database, start, sample_result());
  sql::execute(database.connection(), "UPDATE session SET uuid = 'other'");
  EXPECT_NE(problems_of(database).find("was changed after it was finished"), std::string::npos);
  sql::execute(database.connection(),
               "UPDATE session SET uuid = '0192-session'; DROP TRIGGER device_calibration_no_update;"
               "UPDATE device_calibration SET toml = 'b'");
  EXPECT_NE(problems_of(database).find("calibration of , ca978112ca1b, was changed"), std::string::npos)
      << problems_of(database);
}

}  // namespace
}  // namespace trocar::attempt_store_test
