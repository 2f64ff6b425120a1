// What a push reads, without a server; and what else arrives: extreme numbers, texts that cannot go.
#include "trainees/exchange/sync/batch.h"

#include <fstream>
#include <limits>

#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/exchange/sync/central_logins.h"
#include "trainees/exchange/sync/station.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/accounts.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::batch_test {
namespace {

using sync::Batch;
using sync::read_batch;
using test::kTeacher;
using test::Stations;

std::size_t rows_in(const Batch& batch, const std::string& table) {
  const auto found = batch.rows.find(table);
  return found == batch.rows.end() ? 0 : found->second.size();
}

class BatchOf : public TemporaryFolder {
 protected:
  BatchOf() : database_(folder_ / "t.db") {
    for (int i = 0; i < 3; ++i) store_attempt(database_, sample_start("T-a"), sample_result(60 + i));
  }
  sqlite3* connection() const { return database_.connection(); }
  Database database_;
};

TEST_F(BatchOf, IsAStretchOfTheTrail) {
  const Batch first =
      read_batch(connection(), 0, 6);  // "database made", trainee, person, exercise, one attempt begun and ended
  EXPECT_EQ(first.to, 6);
  EXPECT_EQ(rows_in(first, "attempt"), 1u);
  EXPECT_EQ(rows_in(first, "ruleset"), 1u);
  EXPECT_EQ(rows_in(first, "trainee"), 1u);
  const Batch rest = read_batch(connection(), 6, 100);
  EXPECT_EQ(rest.to, audit_head(connection()).position);
  EXPECT_EQ(rows_in(rest, "attempt"), 2u);
  EXPECT_EQ(rows_in(rest, "ruleset"), 1u) << "one row, however many attempts name it";
  EXPECT_EQ(rows_in(rest, "event"), 4u);
  EXPECT_EQ(read_batch(connection(), rest.to, 100).to, rest.to);
  EXPECT_TRUE(read_batch(connection(), rest.to, 100).audit.empty());
}

TEST_F(BatchOf, OwnWordsOfTraineesAreIdentities) {
  const Account own = AccountStore(database_).add("anna", "Anna", Role::kTrainee, "T-a", "580274", "");
  const std::string attempt = AttemptStore(database_).list().front().uuid;
  AssessmentStore assessments(database_);
  assessments.sign(attempt, "authorship", "", {own.uuid, own.name});
  assessments.sign(attempt, "approval", "", kTeacher);
  const Batch batch = read_batch(connection(), 0, 1000);
  EXPECT_EQ(rows_in(batch, "signature"), 1u);
  EXPECT_EQ(rows_in(batch, "person"), 0u);
  EXPECT_EQ(rows_in(batch, "account"), 0u);
  const Batch identities = sync::read_identities(connection());
  EXPECT_EQ(rows_in(identities, "signature"), 1u);
  EXPECT_EQ(rows_in(identities, "person"), 1u);
  EXPECT_TRUE(identities.audit.empty());
}

TEST_F(BatchOf, ErasedPeopleHaveBareAttemptsAndNoProblems) {
  AssessmentStore(database_).add_note("T-a", "", "Keep still.", kTeacher);
  erase_trainee(database_, "T-a", ErasureKind::kTraining, "request of the person", kTeacher);
  const Batch batch = read_batch(connection(), 0, 1000);
  EXPECT_EQ(rows_in(batch, "attempt"), 3u);
  EXPECT_EQ(rows_in(batch, "metric"), 0u);
  EXPECT_EQ(rows_in(batch, "note"), 0u);
  EXPECT_EQ(rows_in(batch, "erasure"), 1u);
  EXPECT_TRUE(batch.problems.empty());
  EXPECT_TRUE(sync::read_identities(connection()).rows.empty());
}

TEST_F(BatchOf, AnAttemptThatIsGoneIsNamed) {
  const std::string uuid = AttemptStore(database_).list().back().uuid;
  EXPECT_EQ(run_outside(folder_ / "t.db", "DROP TRIGGER attempt_no_delete; DELETE FROM attempt WHERE id = 1"), "");
  const Batch batch = read_batch(connection(), 0, 1000);
  ASSERT_EQ(batch.problems.size(), 1u);
  EXPECT_EQ(batch.problems[0], "attempt " + uuid + " is in the audit trail and not in the database; not pushed");
}

TEST_F(BatchOf, RowsGoBackInAsTheyCameOut) {
  const Batch batch = read_batch(connection(), 0, 1000);
  Database other(":memory:");
  for (const sync::CarriedTable& table : sync::carried_bases()) {
    for (const sync::Values& row : batch.rows.at(table.name)) {
      sync::insert_local(other.connection(), table, row);
      EXPECT_EQ(sync::local_rows(other.connection(), table, *row.front()), (std::vector<sync::Values>{row}))
          << table.name;
    }
  }
}

TEST_F(BatchOf, AStationIsMadeOnceAndWrittenDown) {
  const sync::Station made = sync::own_station(database_, "", false);
  EXPECT_FALSE(made.name.empty());
  EXPECT_EQ(sync::own_station(database_, "", false).uuid, made.uuid);
  const sync::Station renewed = sync::own_station(database_, "theatre", true);
  EXPECT_NE(renewed.uuid, made.uuid);
  EXPECT_EQ(sql::query_integer(connection(), "SELECT count(*) FROM audit WHERE action = 'station made'"), 2);
  EXPECT_EQ(database_.check(), std::vector<std::string>{});
  EXPECT_EQ(sync::cursor_of(database_, "x"), 0);
  sync::set_cursor(database_, "x", 7);
  sync::set_cursor(database_, "x", 9);
  EXPECT_EQ(sync::cursor_of(database_, "x"), 9);
}

TEST_F(Stations, AnyBatchSizeComesToTheSame) {
  Database database = station("a");
  practise(database, "T-a", 5);
  push(database);
  for (const int size : {1, 3, 1000}) {
    PushOptions options{another_central()};
    options.batch = size;
    push_to_central(database, options);
    EXPECT_EQ(everything(options.central), everything()) << size;
  }
}

TEST_F(Stations, ExtremeNumbersComeBackToTheBit) {
  Database database = station("a");
  AttemptResult result = sample_result();
  const double kinds[] = {-0.0,
                          5e-324,
                          std::numeric_limits<double>::max(),
                          std::numeric_limits<double>::infinity(),
                          0.1 + 0.2,
                          -std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN()};
  for (const double value : kinds)
    result.events.push_back({1, "TARGET_HELD", Severity::kInfo, 1, value, "N", Vec3(value, 0, 0)});
  AttemptStart start = sample_start();
  start.seed = std::numeric_limits<std::int64_t>::min();
  store_attempt(database, start, result);
  push(database);
  Database desk = station("desk");
  EXPECT_EQ(replicate_central(desk, central_).problems, std::vector<std::string>{});
  EXPECT_EQ(desk.check(), std::vector<std::string>{});
  for (const char* query :
       {"SELECT value, tip_x_m FROM event ORDER BY position", "SELECT seed, min_energy_j FROM attempt"}) {
    sql::Statement here(database.connection(), query), there(desk.connection(), query);
    while (here.step()) {
      ASSERT_TRUE(there.step());
      EXPECT_EQ(there.canonical(0) + there.canonical(1), here.canonical(0) + here.canonical(1));
    }
  }
}

TEST_F(Stations, CapsOfEveryKindComeBackAsTheyWere) {
  Database database = station("a");
  store_attempt(database, sample_start(), capped_result());
  push(database);
  Database desk = station("desk");
  EXPECT_EQ(replicate_central(desk, central_).problems, std::vector<std::string>{});
  EXPECT_EQ(desk.check(), std::vector<std::string>{});
  const AttemptStore there(desk);
  EXPECT_EQ(there.load(there.latest()->row).grade.caps, capped_result().grade.caps);
}

TEST_F(Stations, TextThatIsNoUtf8IsNamedAndNothingGoes) {
  Database database = station("a");
  practise(database, "T-a", 1);
  sql::execute(database.connection(), "UPDATE person SET name = CAST(x'ff41' AS TEXT)");
  PushOptions options{central_};
  options.with_identity = true;
  const std::string message = message_of<InputError>([&] { push_to_central(database, options); });
  EXPECT_NE(message.find("a row of person holds text that is not UTF-8"), std::string::npos) << message;
  EXPECT_EQ(one("SELECT count(*) FROM person"), "0");
  EXPECT_EQ(one("SELECT count(*) FROM attempt"), "1");  // what was committed before stays
}

TEST_F(Stations, WhoIsNotLetInIsTold) {
  Database database = station("a");
  ask("CREATE ROLE guest LOGIN PASSWORD 'g'");
  const auto file = folder_ / "guest";
  std::ofstream(file) << "g\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  const CentralAddress guest = server_.as(central_, "guest", file);
  const std::string refused = message_of<EnvironmentError>([&] { push_to_central(database, {guest}); });
  EXPECT_NE(refused.find("no permission"), std::string::npos) << refused;
  EXPECT_NE(message_of<InputError>([&] { set_up_central(guest); }).find("only its owner"), std::string::npos);
  const CentralAddress bare = server_.make_database("bare");
  const std::string message = message_of<EnvironmentError>([&] { push_to_central(database, {bare}); });
  EXPECT_NE(message.find("nothing of trocar is there yet: its owner sets it up with trocar sync central"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace trocar::batch_test
