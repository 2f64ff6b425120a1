// Lines that drop after any number of bytes, programs that are killed at any moment, a centre that is put back to an
// older state: the same command again brings the same as if nothing had happened.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <random>

#include "tests/trainees/exchange/sync/cutting_proxy.h"
#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/exchange/sync/central_logins.h"
#include "trainees/exchange/sync/station.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/curricula.h"
#include "trainees/records/standings.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::dropped_test {
namespace {

using test::CuttingProxy;
using test::kTeacher;
using test::Stations;
using Lines = std::vector<std::string>;

class Dropped : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    proxy_ = std::make_unique<CuttingProxy>(server_);
    Database first = station("first");
    practise(first, "T-a", 4);
    CurriculumStore(first).join("T-a", "monday", kTeacher);
    AssessmentStore(first).mark_seen(AssessmentStore(first).notes_of("T-a").front().uuid);
    sync::own_station(first, "first", false);  // its UUID is in every copy
  }
  /// A copy of the first station as it was before any push.
  Database fresh(const std::string& name) {
    Database first = station("first");
    first.backup(folder_ / (name + ".db"));
    return station(name);
  }
  static PushReport send(Database& database, const CentralAddress& to) {
    PushOptions options{to};
    options.with_identity = true;
    options.batch = 5;
    return push_to_central(database, options);
  }
  /// What it should be: a push that nobody disturbs.
  Lines undisturbed() {
    const CentralAddress other = another_central();
    Database database = fresh("undisturbed");
    send(database, other);
    return everything(other);
  }
  std::unique_ptr<CuttingProxy> proxy_;
};

TEST_F(Dropped, APushGoesOnFromEveryPlaceWhereTheLineWasCut) {
  const Lines right = undisturbed();
  const CentralAddress counted = another_central();
  Database measure = fresh("measure");
  send(measure, proxy_->through(counted));
  const long whole = proxy_->passed();
  ASSERT_GT(whole, 10000);
  constexpr int kCuts = 16;
  for (int cut = 0; cut < kCuts; ++cut) {
    const CentralAddress there = another_central();
    Database database = fresh("cut" + std::to_string(cut));
    proxy_->cut_after(whole * cut / kCuts);
    const std::string lost = message_of<EnvironmentError>([&] { send(database, proxy_->through(there)); });
    EXPECT_NE(lost.find("central database"), std::string::npos) << cut << ": " << lost;
    proxy_->mend();
    EXPECT_EQ(send(database, proxy_->through(there)).conflicts, Lines{}) << cut;
    EXPECT_EQ(everything(there), right) << "cut after " << whole * cut / kCuts << " of " << whole << " bytes";
    EXPECT_EQ(problems_of(database), "") << cut;
  }
}

TEST_F(Dropped, ACopyForADeskGoesOnFromEveryPlaceWhereTheLineWasCut) {
  Database first = station("first");
  push_named(first, "first");
  Database whole = desk("whole");
  const long before = proxy_->passed();
  Database measured = station("measured");
  replicate_central(measured, proxy_->through(central_));
  const long bytes = proxy_->passed() - before;
  constexpr int kCuts = 10;
  for (int cut = 0; cut < kCuts; ++cut) {
    Database database = station("copy" + std::to_string(cut));
    proxy_->cut_after(bytes * cut / kCuts);
    EXPECT_NE(message_of<EnvironmentError>([&] { replicate_central(database, proxy_->through(central_)); }), "") << cut;
    EXPECT_EQ(problems_of(database), "") << "half a copy is sound as far as it goes, cut " << cut;
    proxy_->mend();
    replicate_central(database, proxy_->through(central_));
    EXPECT_EQ(problems_of(database), "") << cut;
    for (const char* table : {"attempt", "event", "metric", "note", "signature", "verdict_override", "certificate",
                              "membership", "note_seen", "person"}) {
      const std::string count = std::string("SELECT count(*) FROM ") + table;
      EXPECT_EQ(sql::query_integer(database.connection(), count), sql::query_integer(whole.connection(), count))
          << table << " " << cut;
    }
  }
}

/// Runs the action in a process of its own, which is killed after so long. @returns whether it had ended by itself.
bool killed_after(int microseconds, const std::function<void()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      action();
    } catch (const std::exception&) {
      _exit(1);
    }
    _exit(0);
  }
  usleep(static_cast<useconds_t>(microseconds));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status);
}

TEST_F(Dropped, AStationThatIsKilledAtAnyMomentGoesOn) {
  proxy_.reset();  // no threads while processes are forked
  const Lines right = undisturbed();
  std::mt19937 random(7);
  int killed = 0;
  for (int round = 0; round < 8; ++round) {
    const CentralAddress there = another_central();
    const std::string name = "killed" + std::to_string(round);
    { Database made = fresh(name); }
    killed += !killed_after(static_cast<int>(random() % 400000), [&] {
      Database database = station(name);
      PushOptions options{there};
      options.batch = 1;
      push_to_central(database, options);
    });
    Database database = station(name);
    EXPECT_EQ(send(database, there).conflicts, Lines{}) << round;
    EXPECT_EQ(everything(there), right) << round;
    EXPECT_EQ(problems_of(database), "") << round;
  }
  EXPECT_GT(killed, 0);
}

TEST_F(Dropped, ADeskThatIsKilledAtAnyMomentGoesOn) {
  proxy_.reset();
  Database first = station("first");
  push_named(first, "first");
  std::mt19937 random(11);
  for (int round = 0; round < 6; ++round) {
    const std::string name = "desk" + std::to_string(round);
    killed_after(static_cast<int>(random() % 400000), [&] {
      Database database = station(name);
      replicate_central(database, central_);
    });
    Database database = station(name);
    EXPECT_EQ(problems_of(database), "") << round;
    replicate_central(database, central_);
    EXPECT_EQ(problems_of(database), "") << round;
    EXPECT_EQ(sql::query_integer(database.connection(), "SELECT count(*) FROM attempt"), 4) << round;
  }
}

TEST_F(Stations, ACentrePutBackFromABackupIsToldAndFilledAgain) {
  Database a = station("a"), b = station("b");
  practise(a, "T-a", 2);
  practise(b, "T-b", 2);
  push_named(a, "a");
  push_named(b, "b");
  const CentralAddress backup = backup_of_central();
  practise(a, "T-a", 2);
  practise(b, "T-b", 1);
  AssessmentStore(a).mark_seen(AssessmentStore(a).notes_of("T-a").front().uuid);
  push_named(a, "a");
  push_named(b, "b");
  Database copy = desk();
  const Lines before = everything();
  const std::string attempt = AttemptStore(copy).find("latest").uuid;
  AssessmentStore(copy).sign(attempt, "review", "", kTeacher);
  push(copy, "desk");
  central_ = backup;  // the disk of the centre was replaced

  const PullReport pulled = replicate_central(copy, central_);
  ASSERT_EQ(pulled.told.size(), 1u);
  EXPECT_NE(pulled.told[0].find("it was put back to an older state"), std::string::npos) << pulled.told[0];
  const PushReport pushed = push_named(a, "a");
  ASSERT_EQ(pushed.told.size(), 1u);
  EXPECT_NE(pushed.told[0].find("put back to an older state"), std::string::npos) << pushed.told[0];
  EXPECT_EQ(pushed.added.at("attempt"), 2);
  EXPECT_EQ(push_named(b, "b").added.at("attempt"), 1);
  EXPECT_EQ(push_named(a, "a").told, Lines{});  // told once
  EXPECT_EQ(everything(), before);
  push(copy, "desk");
  EXPECT_EQ(one("SELECT count(*) FROM signature WHERE meaning = 'review' AND attempt_uuid = '" + attempt + "'"), "1");
  EXPECT_EQ(problems_of(copy), "");
}

TEST_F(Stations, ThreeStationsWithClocksHoursApartAndWeeksOfflineMeetInOneRecord) {
  const std::vector<std::string> names{"north", "south", "west"};
  for (int week = 0; week < 3; ++week) {
    for (const std::string& name : names) {
      Database database = station(name);
      AttemptStart start = sample_start("T-" + name);
      // The south is 9 hours ahead, the west's battery is flat.
      start.started_utc = name == "south"  ? "2026-03-02T23:00:00.000Z"
                          : name == "west" ? "1970-01-01T00:00:10.000Z"
                                           : "2026-03-02T14:00:00.000Z";
      start.seed = week;
      store_attempt(database, start, sample_result(60 + week));
    }
    if (week == 1) continue;  // nobody had a line
    Database north = station("north");
    push_named(north, "north");
  }
  for (const char* name : {"west", "south"}) {
    Database database = station(name);
    EXPECT_EQ(push_named(database, name).added.at("attempt"), 3);
  }
  Database copy = desk();
  for (const std::string& name : names) {
    Lines scores;
    for (const AttemptSummary& attempt : AttemptStore(copy).list({"T-" + name, ""})) {
      scores.push_back(std::to_string(static_cast<int>(*attempt.score)));
    }
    EXPECT_EQ(scores, (Lines{"62", "61", "60"})) << name << ": newest first, as its station made them";
  }
}

TEST_F(Stations, TwoSyncsOfOneStationAtOnceBringEverythingOnce) {
  {
    Database database = station("a");
    practise(database, "T-a", 8);
    push(database);
    practise(database, "T-a", 8);
  }
  Lines failures(2);
  const auto work = [&](int which) {
    try {
      Database database = station("a");
      PushOptions options{central_};
      options.batch = 2;
      push_to_central(database, options);
      pull_from_central(database, central_, false);
    } catch (const std::exception& error) {
      failures[static_cast<std::size_t>(which)] = error.what();
    }
  };
  std::thread first(work, 0), second(work, 1);
  first.join();
  second.join();
  EXPECT_EQ(failures, (Lines{"", ""}));
  EXPECT_EQ(one("SELECT count(*), count(DISTINCT chain_position) FROM attempt"), "16|16");
  EXPECT_EQ(one("SELECT count(*) FROM conflict"), "0");
  Database database = station("a");
  EXPECT_EQ(problems_of(database), "");
}

TEST_F(Stations, AnotherDatabaseOfTheServerIsAnotherCentre) {
  Database database = station("a");
  practise(database, "T-a", 2);
  push(database);
  const CentralAddress wrong = another_central();
  PushOptions options{wrong};
  EXPECT_EQ(push_to_central(database, options).added.at("attempt"), 2);  // whole, not from where the first has it
  Database copy = desk();
  const std::string refused = message_of<InputError>([&] { replicate_central(copy, wrong); });
  EXPECT_NE(refused.find("is a copy of another central database"), std::string::npos) << refused;
  EXPECT_EQ(problems_of(copy), "");
  CentralAddress none = central_;
  none.url.replace(none.url.find("///") + 3, none.url.find('?') - none.url.find("///") - 3, "no_such_database");
  const std::string message = message_of<EnvironmentError>([&] { push_to_central(database, {none}); });
  EXPECT_NE(message.find("no_such_database"), std::string::npos) << message;
}

/// Takes from a centre what version 5 added, and those before it.
constexpr const char* kBackToVersion4 =
    "DO $$ DECLARE t text; BEGIN FOR t IN SELECT tablename FROM pg_policies WHERE schemaname = 'trocar' AND policyname "
    "="
    " 'brings' LOOP EXECUTE 'ALTER POLICY brings ON trocar.' || t || ' WITH CHECK (true)'; END LOOP; END $$;"
    " ALTER TABLE trocar.audit DROP COLUMN of_desk; UPDATE trocar.central SET version = 4";
constexpr const char* kBackToVersion3 =
    "DROP TRIGGER recorded_once ON trocar.attempt; DROP FUNCTION trocar.recorded_once; DROP INDEX"
    " trocar.attempt_by_recording; DROP TABLE trocar.withdrawal, trocar.assignment, trocar.standing; ALTER POLICY sees "
    "ON trocar.note USING (true);"
    " UPDATE trocar.central SET version = 3";
constexpr const char* kBackToVersion2 =
    "DO $$ DECLARE t text; BEGIN DROP TRIGGER chained ON trocar.audit; FOR t IN SELECT tablename FROM pg_tables WHERE "
    "schemaname = 'trocar' LOOP"
    " EXECUTE 'DROP POLICY IF EXISTS sees ON trocar.' || t; EXECUTE 'DROP POLICY IF EXISTS brings ON trocar.' || t;"
    " EXECUTE 'ALTER TABLE trocar.' || t || ' DISABLE ROW LEVEL SECURITY'; END LOOP;"
    " DROP VIEW trocar.own_certificate, trocar.own_attempt, trocar.own_person, trocar.own_trainee;"
    " DROP TABLE trocar.head, trocar.login; FOR t IN SELECT table_name FROM information_schema.columns WHERE"
    " table_schema = 'trocar' AND column_name = 'login' LOOP"
    " EXECUTE 'ALTER TABLE trocar.' || t || ' DROP COLUMN login'; END LOOP;"
    " FOR t IN SELECT oid::regprocedure::text FROM pg_proc WHERE pronamespace = 'trocar'::regnamespace LOOP"
    " EXECUTE 'DROP FUNCTION ' || t; END LOOP; UPDATE trocar.central SET version = 2; END $$";
constexpr const char* kBackToVersion1 =
    "DO $$ DECLARE t text; BEGIN DROP VIEW trocar.erased_trainee, trocar.linked_trainee, trocar.holding_link;"
    " DROP TABLE trocar.note_seen, trocar.person_link, trocar.recording_chunk, trocar.recording; FOR t IN SELECT"
    " table_name FROM information_schema.columns WHERE table_schema = 'trocar' AND column_name = 'seq' LOOP EXECUTE"
    " 'ALTER TABLE trocar.' || t || ' DROP COLUMN seq'; END LOOP; ALTER TABLE trocar.central DROP COLUMN revision;"
    " DROP SEQUENCE trocar.arrival; UPDATE trocar.central SET version = 1; END $$";

TEST_F(Stations, ACentreOfAnOlderSchemaIsBroughtToTheNewOneByItsOwnerAndKeepsEverything) {
  for (const int version : {4, 3, 2, 1}) {
    central_ = another_central();
    Database database = station("a" + std::to_string(version));
    practise(database, "T-a", 2);
    push_named(database, "a");
    const Lines before = everything();
    StandingStore(database).set_active({"T-a"}, false, "", {});
    StandingStore(database).set_active({"T-a"}, true, "", {});
    push_named(database, "a");
    ask(kBackToVersion4);
    if (version < 4) ask(kBackToVersion3);
    if (version < 3) ask(kBackToVersion2);
    if (version == 1) ask(kBackToVersion1);
    practise(database, "T-a", 1);
    const std::string refused = message_of<EnvironmentError>([&] { push_named(database, "a"); });
    EXPECT_NE(refused.find("older trocar (schema " + std::to_string(version)), std::string::npos) << refused;
    EXPECT_NE(refused.find("trocar sync central --at"), std::string::npos) << refused;
    EXPECT_EQ(set_up_central(server_.owner_of(central_)).from, version);
    EXPECT_EQ(set_up_central(server_.owner_of(central_)).from, 5);
    EXPECT_EQ(
        one("SELECT count(*) FROM pg_policies WHERE policyname = 'brings' AND with_check LIKE '%clock_timestamp%'"),
        "13");
    EXPECT_EQ(one("SELECT count(*) FROM pg_policies WHERE policyname = 'brings' AND with_check = 'true'"), "0");
    EXPECT_EQ(one("SELECT count(*) FROM audit WHERE NOT of_desk"), "0");
    if (version < 3) central_ = server_.owner_of(central_);
    const PushReport pushed = push_named(database, "a");
    EXPECT_EQ(pushed.conflicts, Lines{});
    EXPECT_EQ(pushed.added.at("attempt"), 1);
    EXPECT_EQ(pushed.added.contains("standing") ? pushed.added.at("standing") : 0, version < 4 ? 2 : 0)
        << "written before the centre knew of such rows";
    const Lines after = everything();
    for (const std::string& line : before) {
      if (line.starts_with("station")) continue;  // how far one is has changed
      EXPECT_EQ(std::count(after.begin(), after.end(), line), 1) << line;
    }
    Database copy = desk("desk" + std::to_string(version));
    EXPECT_EQ(AttemptStore(copy).list().size(), 3u);
  }
}

}  // namespace
}  // namespace trocar::dropped_test
