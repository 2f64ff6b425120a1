// Stations fetch: rules that others made, erasures that others did, and the whole record for a desk.
#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/records/accounts.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::fetch_test {
namespace {

using test::kTeacher;
using test::Stations;
using Counts = std::map<std::string, int>;
using Lines = std::vector<std::string>;

std::int64_t count(Database& database, const std::string& table) {
  return sql::query_integer(database.connection(), "SELECT count(*) FROM " + table);
}

TEST_F(Stations, CurriculaAndBenchmarksOfOthersAreFetchedOnce) {
  Database maker = station("maker"), other = station("other");
  CurriculumStore made(maker);
  made.add("course", "first = 1\n", kTeacher);
  const Curriculum newest = made.add("course", "second = 2\n", kTeacher);
  made.add_benchmark({"", "never-practised-here", "L2", "time_s", "8 experts", "median", "", "", 30.1, 90, 8},
                     kTeacher);
  push(maker, "maker");
  const PullReport pulled = pull_from_central(other, central_, false);
  EXPECT_EQ(pulled.added, (Counts{{"curriculum", 2}, {"benchmark", 1}}));
  EXPECT_EQ(CurriculumStore(other).newest("course")->uuid, newest.uuid);
  EXPECT_EQ(CurriculumStore(other).newest("course")->toml, "second = 2\n");
  EXPECT_EQ(CurriculumStore(other).benchmarks().at(0).full_at, 30.1);
  EXPECT_EQ(other.check(), Lines{});
  EXPECT_TRUE(pull_from_central(other, central_, false).added.empty());
  EXPECT_EQ(push(other).added.count("curriculum"), 0u);  // they are there already, under one UUID
  EXPECT_TRUE(pull_from_central(maker, central_, false).added.empty());
}

TEST_F(Stations, OneVersionFromTwoStationsEndsTheSameEverywhere) {
  Database a = station("a"), b = station("b");
  CurriculumStore(a).add("course", "by = 'a'\n", kTeacher);
  CurriculumStore(b).add("course", "by = 'b'\n", kTeacher);
  for (Database* database : {&a, &b, &a}) {
    push(*database);
    pull_from_central(*database, central_, false);
  }
  EXPECT_EQ(CurriculumStore(a).newest("course")->uuid, CurriculumStore(b).newest("course")->uuid);
  EXPECT_EQ(CurriculumStore(a).list().size(), 2u);
}

TEST_F(Stations, ARuleThatWasChangedAtTheCentreIsLeftOut) {
  Database maker = station("maker"), other = station("other");
  const Curriculum good = CurriculumStore(maker).add("good", "a = 1\n", kTeacher);
  const Curriculum bad = CurriculumStore(maker).add("bad", "a = 1\n", kTeacher);
  push(maker);
  ask("UPDATE curriculum SET toml = 'pass = true' WHERE name = 'bad' RETURNING 1");
  const PullReport pulled = pull_from_central(other, central_, false);
  ASSERT_EQ(pulled.problems.size(), 1u);
  EXPECT_NE(pulled.problems[0].find("curriculum " + bad.uuid + ": its content is not that of its hash"),
            std::string::npos);
  EXPECT_FALSE(CurriculumStore(other).newest("bad"));
  EXPECT_EQ(CurriculumStore(other).newest("good")->uuid, good.uuid);
  EXPECT_EQ(other.check(), Lines{});
}

/// Two stations know one trainee: the second began as a copy of the first.
class Erased : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    Database first = station("first");
    practise(first, "T-gone", 2);
    practise(first, "T-stays", 1);
    ConsentStore(first).record("T-gone", "research", true, "I agree.", kTeacher);
    PushOptions options{central_};
    options.with_identity = true;
    options.station_name = "first";
    push_to_central(first, options);
    first.backup(folder_ / "second.db");
    Database second = station("second");
    options.new_station = true;
    options.station_name = "second";
    push_to_central(second, options);
  }
  void erase(ErasureKind kind) {
    Database first = station("first");
    erase_trainee(first, "T-gone", kind, "request of the person", kTeacher);
    push(first);
  }
  std::string left(const std::string& table) {
    return one("SELECT count(*) FROM " + table + " WHERE trainee_uuid IN (SELECT trainee_uuid FROM erasure)");
  }
};

TEST_F(Erased, IdentityLeavesTheCentreWithThePush) {
  EXPECT_EQ(one("SELECT count(*) FROM person WHERE code = 'T-gone'"), "1");
  erase(ErasureKind::kIdentity);
  for (const char* table : {"person", "note", "consent"}) EXPECT_EQ(left(table), "0") << table;
  EXPECT_EQ(left("attempt"), "2");
  EXPECT_EQ(left("certificate"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM person"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM note"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM metric"), "9");
}

TEST_F(Erased, WhatTheySignedThemselvesGoesEverywhere) {
  Database first = station("first");
  const Account own = AccountStore(first).add("gone", "Anna Gone", Role::kTrainee, "T-gone", "580274", "");
  const std::string attempt = AttemptStore(first).list({"T-gone", ""}).front().uuid;
  const std::string signature = AssessmentStore(first).sign(attempt, "authorship", "", {own.uuid, own.name}).uuid;
  PushOptions named{central_};
  named.with_identity = true;
  push_to_central(first, named);
  Database desk = station("desk");
  replicate_central(desk, central_);
  const std::int64_t signatures = count(desk, "signature");
  EXPECT_EQ(count(desk, "signature WHERE signer = 'Anna Gone'"), 1);
  erase(ErasureKind::kIdentity);
  EXPECT_EQ(one("SELECT count(*) FROM signature WHERE uuid = '" + signature + "'"), "0");
  push(desk, "desk");  // it still has it, and cannot bring it back
  EXPECT_EQ(one("SELECT count(*) FROM signature WHERE uuid = '" + signature + "'"), "0");
  replicate_central(desk, central_);
  EXPECT_EQ(count(desk, "signature"), signatures - 1);
  EXPECT_EQ(desk.check(), Lines{});
}

TEST_F(Erased, TrainingLeavesBareAttempts) {
  erase(ErasureKind::kTraining);
  EXPECT_EQ(left("attempt"), "2");
  EXPECT_EQ(left("certificate"), "0");
  for (const char* table : {"event", "device_warning", "device_transition", "score", "metric", "subscore", "score_cap",
                            "rating", "signature", "verdict_override"}) {
    EXPECT_EQ(one(std::string("SELECT count(*) FROM ") + table +
                  " x JOIN attempt a ON a.uuid = x.attempt_uuid JOIN erasure e"
                  " ON e.trainee_uuid = a.trainee_uuid"),
              "0")
        << table;
  }
  EXPECT_EQ(one("SELECT count(*) FROM metric"), "3");  // of the one who stays
}

TEST_F(Erased, NobodyComesBackFromAStationThatHasNotHeard) {
  Database second = station("second");
  AssessmentStore(second).add_note("T-gone", "", "Written before the news came.", kTeacher);
  erase(ErasureKind::kIdentity);
  PushOptions options{central_};
  options.with_identity = true;
  push_to_central(second, options);
  EXPECT_EQ(left("note"), "0");
  EXPECT_EQ(left("person"), "0");
  sql::execute(second.connection(), "DELETE FROM sync_cursor");
  push_to_central(second, options);
  EXPECT_EQ(left("note"), "0");
}

TEST_F(Erased, ElsewhereItIsToldAndDoneOnlyWhenAsked) {
  erase(ErasureKind::kTraining);
  Database second = station("second");
  const PullReport told = pull_from_central(second, central_, false);
  ASSERT_EQ(told.erasures.size(), 1u);
  EXPECT_NE(told.erasures[0].find("trainee T-gone"), std::string::npos);
  EXPECT_NE(told.erasures[0].find("training; request of the person"), std::string::npos);
  EXPECT_EQ(count(second, "note"), 2);
  const PullReport done = pull_from_central(second, central_, true);
  EXPECT_EQ(done.erased, 1);
  EXPECT_TRUE(done.erasures.empty());
  EXPECT_EQ(count(second, "note"), 1);
  EXPECT_EQ(count(second, "score"), 1);
  EXPECT_EQ(count(second, "person"), 1);
  EXPECT_EQ(second.check(), Lines{});
  EXPECT_EQ(pull_from_central(second, central_, true).erased, 0);
  push(second);
  Database first = station("first");
  EXPECT_TRUE(pull_from_central(first, central_, false).erasures.empty());  // the echo asks for nothing
}

TEST_F(Erased, ACopyForADeskFollows) {
  Database desk = station("desk");
  replicate_central(desk, central_);
  EXPECT_EQ(count(desk, "person"), 2);
  erase(ErasureKind::kTraining);
  const PullReport pulled = replicate_central(desk, central_);
  EXPECT_EQ(pulled.erased, 1);
  EXPECT_EQ(count(desk, "person"), 1);
  EXPECT_EQ(count(desk, "score"), 1);
  EXPECT_EQ(desk.check(), Lines{});
  Database late = station("late");  // and one that begins after the erasure
  EXPECT_TRUE(replicate_central(late, central_).problems.empty());
  EXPECT_EQ(count(late, "attempt"), 3);
  EXPECT_EQ(count(late, "person"), 1);
  EXPECT_EQ(late.check(), Lines{});
}

class Desk : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    for (const char* name : {"north", "south", "west"}) {
      Database database = station(name);
      practise(database, "T-same", 3);
      PushOptions options{central_};
      options.station_name = name;
      options.with_identity = std::string(name) != "west";
      push_to_central(database, options);
    }
  }
};

TEST_F(Desk, HasEverythingAndItsHashesHold) {
  Database desk = station("desk");
  const PullReport pulled = replicate_central(desk, central_);
  EXPECT_EQ(pulled.problems, Lines{});
  EXPECT_EQ(pulled.added.at("attempt"), 9);
  EXPECT_EQ(desk.check(), Lines{});
  EXPECT_EQ(AttemptStore(desk).check_recordings(), Lines{});
  Database north = station("north");
  int decided = 0;
  for (const AttemptSummary& here : AttemptStore(north).list()) {
    const AttemptStore store(desk);
    const AttemptSummary there = store.find(here.uuid);
    EXPECT_EQ(there.score, here.score);
    EXPECT_EQ(there.passed, here.passed) << "decisions travel";
    EXPECT_EQ(there.decided_by, here.decided_by);
    decided += there.decided_by.empty() || there.passed == there.passed_by_score ? 0 : 1;
    EXPECT_EQ(store.load(there.row).grade.metrics.size(), AttemptStore(north).load(here.row).grade.metrics.size());
    EXPECT_EQ(store.load(there.row).events.at(0).t_s, AttemptStore(north).load(here.row).events.at(0).t_s);
    EXPECT_EQ(AssessmentStore(desk).signatures_of(here.uuid).size(),
              AssessmentStore(north).signatures_of(here.uuid).size());
  }
  EXPECT_EQ(decided, 1) << "one of north's is passed by decision alone";
  EXPECT_TRUE(replicate_central(desk, central_).added.empty());
  EXPECT_EQ(count(desk, "station"), 3);
}

TEST_F(Desk, OneCodeOfTwoPeopleStaysTwoPeopleAndTheUnnamedStayUnnamed) {
  Database desk = station("desk");
  replicate_central(desk, central_);
  EXPECT_EQ(count(desk, "person"), 3);
  EXPECT_EQ(count(desk, "person WHERE code = 'T-same'"), 1);
  EXPECT_EQ(count(desk, "person WHERE code GLOB 'T-same-*'"), 1);
  EXPECT_EQ(count(desk, "person WHERE code GLOB 'unnamed-*'"), 1);
  Database west = station("west");
  PushOptions options{central_};
  options.with_identity = true;
  push_to_central(west, options);
  replicate_central(desk, central_);
  EXPECT_EQ(count(desk, "person WHERE code GLOB 'unnamed-*'"), 0);
}

TEST_F(Desk, TakesWhatComesLaterAndSeesWhatIsChangedInIt) {
  Database desk = station("desk");
  replicate_central(desk, central_);
  Database south = station("south");
  practise(south, "T-new", 2);
  push(south);
  EXPECT_EQ(replicate_central(desk, central_).added.at("attempt"), 2);
  ASSERT_EQ(desk.check(), Lines{});
  const std::string uuid = AttemptStore(desk).find("latest").uuid;
  ASSERT_EQ(
      run_outside(folder_ / "desk.db",
                  "CREATE TABLE t AS SELECT sql FROM sqlite_master WHERE name = 'event_row_no_update';"
                  "DROP TRIGGER event_row_no_update; UPDATE event_row SET value = 0 WHERE id >> 20 = 11; DROP TABLE t"),
      "");
  bool told = false;
  for (const std::string& problem : desk.check())
    told |= problem == "hash chain: attempt " + uuid + " of another station was changed";
  EXPECT_TRUE(told);
}

TEST_F(Desk, LeavesOutWhatWasChangedAtTheCentre) {
  const std::string uuid = one("SELECT uuid FROM attempt WHERE chain_position = 3 ORDER BY station LIMIT 1");
  ask("UPDATE metric SET value = value + 1e-9 WHERE name = 'time_s' AND attempt_uuid = '" + uuid + "' RETURNING 1");
  const std::string note = one("SELECT uuid FROM note ORDER BY uuid LIMIT 1");
  ask("UPDATE note SET text = 'Splendid.' WHERE uuid = '" + note + "' RETURNING 1");
  Database desk = station("desk");
  const PullReport pulled = replicate_central(desk, central_);
  ASSERT_EQ(pulled.problems.size(), 2u);
  EXPECT_EQ(pulled.problems[0], "attempt " + uuid + ": its content is not that of its hash; left out");
  EXPECT_EQ(pulled.problems[1], "note " + note + ": its content is not that of its hash; left out");
  EXPECT_EQ(pulled.added.at("attempt"), 8);
  EXPECT_EQ(desk.check(), Lines{});
}

TEST_F(Desk, AMissingPredecessorShows) {
  const std::string gone = one("SELECT uuid FROM attempt WHERE chain_position = 2 ORDER BY station LIMIT 1");
  const std::string after = one("SELECT uuid FROM attempt WHERE chain_position = 3 ORDER BY station LIMIT 1");
  ask("DELETE FROM attempt WHERE uuid = '" + gone + "' RETURNING 1");
  Database desk = station("desk");
  replicate_central(desk, central_);
  EXPECT_EQ(desk.check(), (Lines{"hash chain: attempt " + after + " of another station follows one that is not here"}));
}

TEST_F(Desk, WhatIsWrittenAtItGoesBackToTheCentre) {
  Database desk = station("desk");
  replicate_central(desk, central_);
  const std::string attempt = AttemptStore(desk).find("latest").uuid;
  const Signature signature = AssessmentStore(desk).sign(attempt, "approval", "Seen.", kTeacher);
  const PushReport report = push(desk, "desk");
  EXPECT_EQ(report.added.at("signature"), 1);
  EXPECT_EQ(report.added.count("attempt"), 0u);
  EXPECT_TRUE(report.conflicts.empty() && report.problems.empty());
  EXPECT_EQ(one("SELECT attempt_uuid FROM signature WHERE uuid = '" + signature.uuid + "'"), attempt);
}

TEST_F(Desk, NeedsAFileOfItsOwn) {
  Database north = station("north");
  EXPECT_NE(message_of<InputError>([&] { replicate_central(north, central_); }).find("holds attempts of its own"),
            std::string::npos);
}

}  // namespace
}  // namespace trocar::fetch_test
