// Stations push: everything arrives bit for bit, once, whatever happens on the way.
#include <sqlite3.h>

#include <atomic>
#include <thread>

#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/accounts.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::push_test {
namespace {

using test::kTeacher;
using test::Stations;
using Counts = std::map<std::string, int>;

bool holds(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines) {
    if (line.find(part) != std::string::npos) return true;
  }
  return false;
}

TEST_F(Stations, ThreeMeetInOnePlaceAndPushingAgainChangesNothing) {
  for (const char* name : {"north", "south", "west"}) {
    Database database = station(name);
    practise(database, std::string("T-") + name, 3);
    CurriculumStore(database).add("course", std::string("name = \"") + name + "\"\n", kTeacher);
    const PushReport report = push(database, name);
    EXPECT_EQ(report.name, name);
    EXPECT_EQ(report.to, audit_head(database.connection()).position);
    Counts added{{"attempt", 3},        {"certificate", 1}, {"curriculum", 1},      {"device_transition", 6},
                 {"device_warning", 6}, {"event", 6},       {"metric", 9},          {"note", 1},
                 {"rating", 1},         {"score", 3},       {"score_cap", 3},       {"signature", 1},
                 {"subscore", 6},       {"trainee", 1},     {"verdict_override", 1}};
    if (std::string(name) == "north") added.insert({{"exercise", 1}, {"ruleset", 1}});  // the same file everywhere
    EXPECT_EQ(report.added, added);
    EXPECT_TRUE(report.conflicts.empty() && report.problems.empty());
  }
  EXPECT_EQ(one("SELECT count(*), count(DISTINCT station) FROM attempt"), "9|3");
  EXPECT_EQ(one("SELECT count(*) FROM ruleset"), "1");
  const auto before = everything();
  for (const char* name : {"north", "south", "west"}) {
    Database database = station(name);
    EXPECT_TRUE(push(database).added.empty());
  }
  EXPECT_EQ(everything(), before);
}

TEST_F(Stations, ADemoIsKeptOutOfTheCentre) {
  Database demo = station("demo");
  mark_demo(demo);
  mark_demo_whole(demo);
  EXPECT_THROW(push(demo), InputError);
  EXPECT_THROW(pull_from_central(demo, central_, false), InputError);
}

TEST_F(Stations, NumbersAndTextsArriveBitForBit) {
  Database database = station("a");
  practise(database, "T-a", 1);
  push(database);
  sql::Statement rows(database.connection(), "SELECT t_s, tip_z_m, value FROM event ORDER BY position");
  std::vector<std::string> here;
  while (rows.step()) here.push_back(rows.canonical(0) + rows.canonical(1) + rows.canonical(2));
  const auto there =
      ask("SELECT 'r' || encode(float8send(t_s), 'hex') || ';r' || encode(float8send(tip_z_m), 'hex') || ';r' ||"
          " encode(float8send(value), 'hex') || ';' FROM event ORDER BY position");
  EXPECT_EQ(there, here);
  EXPECT_EQ(one("SELECT value IS NULL FROM metric WHERE name = 'tremor'"), "t");
  EXPECT_EQ(one("SELECT text FROM note"),
            "Keep the left hand still: \xc3\xbc"
            "ben \"jetzt\"\n\\n");
  EXPECT_EQ(one("SELECT seed FROM attempt"), "0");
  EXPECT_EQ(one("SELECT toml FROM ruleset"), sample_start().exercise_text);
}

TEST_F(Stations, NobodyIsNamedUnlessAsked) {
  Database database = station("a");
  practise(database, "T-Zimtstern", 2);
  TraineeStore(database).edit("T-Zimtstern", "Anna Zimtstern", "anna@zimtstern", "");
  ConsentStore(database).record("T-Zimtstern", "research", true, "I, Anna Zimtstern, agree.", kTeacher);
  const Account own =
      AccountStore(database).add("zimtstern", "Anna Zimtstern", Role::kTrainee, "T-Zimtstern", "580274", "");
  const std::string attempt = AttemptStore(database).list().front().uuid;
  AssessmentStore(database).sign(attempt, "authorship", "", {own.uuid, own.name});
  AssessmentStore(database).add_rating(attempt, "self", "overall", 3, {own.uuid, own.name});
  push(database);
  EXPECT_EQ(one("SELECT count(*) FROM signature"), "1");  // the teacher's
  EXPECT_FALSE(holds(everything(), "imtstern"));
  PushOptions named{central_};
  named.with_identity = true;
  EXPECT_EQ(push_to_central(database, named).added,
            (Counts{{"person", 1}, {"consent", 1}, {"signature", 1}, {"rating", 1}}));
  EXPECT_EQ(one("SELECT code, name, email FROM person"), "T-Zimtstern|Anna Zimtstern|anna@zimtstern");
  EXPECT_TRUE(push_to_central(database, named).added.empty());
  TraineeStore(database).edit("T-Zimtstern", "Anna Stern", {}, "");
  EXPECT_EQ(push_to_central(database, named).added, (Counts{{"person", 1}}));
  EXPECT_EQ(one("SELECT name FROM person"), "Anna Stern");
}

TEST_F(Stations, AnAttemptThatStillRunsStaysAtHome) {
  Database database = station("a");
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start());
  push(database);
  EXPECT_EQ(one("SELECT count(*) FROM attempt"), "0");
  store.finish_attempt(id, sample_result());
  push(database);
  EXPECT_EQ(one("SELECT uuid, status FROM attempt"), id.uuid + "|completed");
}

TEST_F(Stations, ALostCursorCostsTimeAndNothingElse) {
  Database database = station("a");
  practise(database, "T-a", 3);
  const std::int64_t head = push(database).to;
  const auto before = everything();
  sql::execute(database.connection(), "DELETE FROM sync_cursor");
  const PushReport again = push(database);
  EXPECT_EQ(again.from, 0);
  EXPECT_EQ(again.to, head);
  EXPECT_TRUE(again.added.empty());
  EXPECT_EQ(everything(), before);
}

TEST_F(Stations, ACentreThatWasPutBackIsFilledAgain) {
  Database database = station("a");
  practise(database, "T-a", 3);
  push(database);
  const auto before = everything();
  ask("DELETE FROM audit WHERE position > 2; DELETE FROM attempt; DELETE FROM event; DELETE FROM metric; DELETE FROM "
      "subscore;"
      " DELETE FROM score; DELETE FROM score_cap; DELETE FROM device_warning; DELETE FROM device_transition; DELETE "
      "FROM note;"
      " UPDATE station SET last_position = 0 RETURNING 1");
  EXPECT_EQ(push(database).from, 0);
  EXPECT_EQ(everything(), before);
}

TEST_F(Stations, ADroppedConnectionIsTakenUpWhereItBroke) {
  Database database = station("a");
  practise(database, "T-a", 12);
  int batches = 0;
  PushOptions options{central_};
  options.batch = 4;
  options.after_batch = [&](std::int64_t, std::int64_t) {
    if (++batches < 2) return;
    ask("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'trocar' AND datname = "
        "current_database()");
  };
  const std::string lost = message_of<EnvironmentError>([&] { push_to_central(database, options); });
  EXPECT_NE(lost.find("central database"), std::string::npos) << lost;
  EXPECT_EQ(batches, 2);
  EXPECT_EQ(one("SELECT last_position FROM station"), "8");
  EXPECT_EQ(one("SELECT max(position) FROM audit"), "8");
  options.after_batch = {};
  const PushReport rest = push_to_central(database, options);
  EXPECT_EQ(rest.from, 8);
  EXPECT_EQ(rest.to, audit_head(database.connection()).position);
  PushOptions undisturbed{another_central()};
  push_to_central(database, undisturbed);
  EXPECT_EQ(everything(), everything(undisturbed.central));
}

TEST_F(Stations, ABatchThatIsCutInTheMiddleLeavesNothingBehind) {
  Database database = station("a");
  push(database);
  const auto before = everything();
  practise(database, "T-a", 4);
  ask("CREATE FUNCTION cut() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM "
      "pg_terminate_backend(pg_backend_pid()); RETURN NEW; "
      "END $$;"
      " CREATE TRIGGER cut BEFORE INSERT ON note FOR EACH ROW EXECUTE FUNCTION cut()");
  EXPECT_NE(message_of<EnvironmentError>([&] { push(database); }), "");
  EXPECT_EQ(everything(), before);
  ask("DROP TRIGGER cut ON note");
  const std::int64_t known = std::stoll(one("SELECT last_position FROM station"));
  const PushReport rest = push(database);
  EXPECT_EQ(rest.from, known);
  EXPECT_EQ(rest.added.at("attempt"), 4);
  PushOptions undisturbed{another_central()};
  push_to_central(database, undisturbed);
  EXPECT_EQ(everything(), everything(undisturbed.central));
}

TEST_F(Stations, OfflineForWeeksIsOneLongPush) {
  Database database = station("a");
  practise(database, "T-a", 1);
  CentralAddress away = central_;
  away.url = "postgresql:///nothing?host=" + folder_.string() + "&user=trocar";
  PushOptions options{away};
  for (int week = 0; week < 3; ++week) {
    const std::string message = message_of<EnvironmentError>([&] { push_to_central(database, options); });
    EXPECT_NE(message.find("cannot be reached"), std::string::npos) << message;
    practise(database, "T-a", 2);
  }
  EXPECT_EQ(push(database).added.at("attempt"), 7);
  EXPECT_EQ(database.check(), std::vector<std::string>{});
}

TEST_F(Stations, TwoPushingAtOnceTakeTurns) {
  const auto alone = another_central();
  for (const char* name : {"a", "b"}) {
    Database database = station(name);
    practise(database, "T-shared", 10);
    PushOptions options{alone};
    options.station_name = name;
    push_to_central(database, options);
  }
  std::atomic<int> failed = 0;
  const auto work = [&](const char* name) {
    try {
      Database database = station(name);
      PushOptions options{central_};
      options.batch = 1;
      push_to_central(database, options);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
      ++failed;
    }
  };
  std::thread first(work, "a"), second(work, "b"), same(work, "b");
  first.join();
  second.join();
  same.join();
  EXPECT_EQ(failed, 0);
  // Which of the two brought the shared ruleset is chance.
  EXPECT_EQ(one("SELECT count(*), count(DISTINCT station) FROM attempt"), "20|2");
  EXPECT_EQ(everything().size(), everything(alone).size());
  EXPECT_EQ(one("SELECT count(*) FROM conflict"), "0");
}

TEST_F(Stations, PracticeGoesOnWhileAPushWaitsForTheNetwork) {
  Database database = station("a");
  practise(database, "T-a", 1);
  push(database);
  practise(database, "T-a", 1);
  std::atomic<bool> pushed = false;
  std::thread waiting;
  server_.while_locked(central_, [&] {
    waiting = std::thread([&] {
      Database same = station("a");
      push(same);
      pushed = true;
    });
    while (one("SELECT count(*) FROM pg_locks WHERE locktype = 'advisory' AND NOT granted") == "0")
      std::this_thread::yield();
    Database impatient(folder_ / "a.db", OpenMode::kExisting, 0);  // waits for nobody
    store_attempt(impatient, sample_start("T-a"), sample_result());
    EXPECT_FALSE(pushed);
  });
  waiting.join();
  EXPECT_EQ(one("SELECT count(*) FROM attempt"), "3");
}

TEST_F(Stations, ClocksOrderNothing) {
  Database database = station("a");
  AttemptStore store(database);
  for (const char* utc : {"2087-01-01T00:00:00.000Z", "2001-01-01T00:00:00.000Z", "2044-01-01T00:00:00.000Z"}) {
    AttemptStart start = sample_start();
    start.started_utc = utc;
    store.finish_attempt(store.begin_attempt(start), sample_result());
  }
  EXPECT_EQ(push(database).added.at("attempt"), 3);
  EXPECT_EQ(ask("SELECT substr(started_utc, 1, 4) FROM attempt ORDER BY station, chain_position"),
            (std::vector<std::string>{"2087", "2001", "2044"}));
  EXPECT_EQ(one("SELECT count(*) FROM attempt WHERE received BETWEEN now() - interval '1 hour' AND now()"), "3");
  Database desk = station("desk");
  EXPECT_TRUE(replicate_central(desk, central_).problems.empty());
  EXPECT_EQ(AttemptStore(desk).list()[0].started_utc.substr(0, 4), "2044");  // newest is what came last
}

/// Two copies of one database go on apart.
class Parted : public Stations {
 protected:
  /// Begins one attempt, copies the file, ends the attempt here and there with different scores; only the first was
  /// pushed.
  std::string part() {
    Database first = station("first");
    practise(first, "T-a", 1);
    push(first, "first");
    AttemptStore store(first);
    const AttemptId id = store.begin_attempt(sample_start("T-a"));
    first.backup(folder_ / "second.db");
    store.finish_attempt(id, sample_result(90));
    push(first);
    Database second = station("second");
    AttemptStore(second).finish_attempt(id, sample_result(10));
    return id.uuid;
  }
};

TEST_F(Parted, AnotherTrailUnderTheSameNameIsRefused) {
  part();
  const auto before = everything();
  Database second = station("second");
  const std::string message = message_of<InputError>([&] { push(second); });
  EXPECT_NE(message.find("is not the one that was pushed, at position"), std::string::npos) << message;
  EXPECT_NE(message.find("--new-station"), std::string::npos);
  EXPECT_EQ(everything(), before);
}

TEST_F(Parted, AnOlderCopyPutBackIsRefusedToo) {
  part();
  std::filesystem::remove(folder_ / "second.db");
  Database first = station("first");
  const std::string head = first.head();
  EXPECT_TRUE(push(first).added.empty());
  ask("UPDATE audit SET position = position + 100 WHERE position = (SELECT max(position) FROM audit) RETURNING 1");
  EXPECT_NE(message_of<InputError>([&] { push(first); }).find("an older copy"), std::string::npos);
  EXPECT_EQ(first.head(), head);
}

TEST_F(Parted, OneUuidWithTwoHashesIsToldByNameAndKeepsTheFirst) {
  const std::string uuid = part();
  const std::string kept = one("SELECT row_hash FROM attempt WHERE uuid = '" + uuid + "'");
  Database second = station("second");
  PushOptions options{central_};
  options.new_station = true;
  options.station_name = "second";
  for (int time = 0; time < 2; ++time) {  // told until somebody settles it
    const PushReport report = push_to_central(second, options);
    ASSERT_EQ(report.conflicts.size(), 1u);
    EXPECT_NE(report.conflicts[0].find("attempt " + uuid), std::string::npos) << report.conflicts[0];
    options.new_station = false;
  }
  EXPECT_EQ(one("SELECT row_hash FROM attempt WHERE uuid = '" + uuid + "'"), kept);
  EXPECT_EQ(ask("SELECT value FROM score WHERE attempt_uuid = '" + uuid + "'"), (std::vector<std::string>{"90"}));
  EXPECT_EQ(one("SELECT count(*) FROM metric WHERE attempt_uuid = '" + uuid + "'"), "3");
  practise(second, "T-a", 1);  // and the rest goes on
  EXPECT_EQ(push(second).added.at("attempt"), 1);
  EXPECT_EQ(ask("SELECT name FROM station ORDER BY name"), (std::vector<std::string>{"first", "second"}));
}

TEST_F(Stations, WhatWasChangedHereIsNotPushed) {
  Database database = station("a");
  practise(database, "T-a", 2);
  const std::string uuid = AttemptStore(database).list().back().uuid;
  EXPECT_EQ(run_outside(folder_ / "a.db",
                        "DROP TRIGGER metric_row_no_update; UPDATE metric_row SET value = 1 WHERE id >> 10 = 1;"
                        "DROP TRIGGER note_no_update; UPDATE note SET text = 'Splendid.'"),
            "");
  const PushReport report = push(database);
  ASSERT_EQ(report.problems.size(), 2u);
  EXPECT_NE(report.problems[0].find("attempt " + uuid + " was changed"), std::string::npos) << report.problems[0];
  EXPECT_NE(report.problems[1].find("was changed after it was written"), std::string::npos) << report.problems[1];
  EXPECT_EQ(one("SELECT count(*) FROM attempt"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM note"), "0");
}

}  // namespace
}  // namespace trocar::push_test
