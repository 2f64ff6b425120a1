// A desk that serves the centre's record: fresh by itself, says since when it is not, and loses nothing that is written
// at it.
#include "trainees/exchange/sync/replica_keeper.h"

#include <mutex>

#include "tests/trainees/exchange/sync/cutting_proxy.h"
#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/records/curricula.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::replica_keeper_test {
namespace {

using test::CuttingProxy;
using test::kTeacher;
using test::Stations;
using Lines = std::vector<std::string>;

class Keeper : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    proxy_ = std::make_unique<CuttingProxy>(server_);
    Database north = station("north");
    practise(north, "T-north", 2);
    push_named(north, "north");
  }
  std::unique_ptr<ReplicaKeeper> keeper(const std::string& name = "desk") {
    KeeperOptions options;
    options.central = proxy_->through(central_);
    options.open = [this, name] { return station(name); };
    options.station_name = name;
    options.look = std::chrono::milliseconds(10);
    options.ask = std::chrono::milliseconds(30);
    options.retry = std::chrono::milliseconds(50);
    options.log = [this](const std::string& line) {
      const std::scoped_lock lock(mutex_);
      log_.push_back(line);
    };
    auto made = std::make_unique<ReplicaKeeper>(std::move(options));
    made->start();
    return made;
  }
  /// Waits for what has to come; the test's own time limit ends it otherwise.
  static void until(const std::function<bool()>& came) {
    while (!came()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::unique_ptr<CuttingProxy> proxy_;
  std::mutex mutex_;
  Lines log_;
};

TEST_F(Keeper, BringsWhatStationsPushWithoutBeingAsked) {
  const auto kept = keeper();
  Database copy = station("desk"), north = station("north");
  EXPECT_EQ(AttemptStore(copy).list().size(), 2u) << "it is filled when it is made";
  EXPECT_NE(kept->status().as_of_utc, "");
  EXPECT_EQ(kept->status().lost_since_utc, "");
  practise(north, "T-north", 1);
  push(north);
  until([&] { return AttemptStore(copy).list().size() == 3; });
  until([&] { return AssessmentStore(copy).notes_of("T-north").size() == 2; });
}

TEST_F(Keeper, PushesWhatIsWrittenAtTheDeskAndTheTraineeMeetsItAtTheStation) {
  const auto kept = keeper();
  Database copy = station("desk"), north = station("north");
  AssessmentStore(copy).add_note("T-north", "", "Slower on the way out.", kTeacher);
  CurriculumStore(copy).add("standard", "version = \"2\"\n", kTeacher);
  CurriculumStore(copy).join("T-north", "monday", kTeacher);
  until([&] { return one("SELECT count(*) FROM note WHERE text LIKE 'Slower%'") == "1"; });
  until([&] { return kept->status().waiting == 0; });
  pull_from_central(north, central_, false);
  EXPECT_EQ(AssessmentStore(north).newest_unseen("T-north")->text, "Slower on the way out.");
  EXPECT_TRUE(CurriculumStore(north).newest("standard"));
  EXPECT_EQ(CurriculumStore(north).groups_of("T-north"), Lines{"monday"});
}

TEST_F(Keeper, SaysSinceWhenTheCentreIsLostAndWhatWaitsAndSendsItWhenItIsBack) {
  const auto kept = keeper();
  Database copy = station("desk");
  proxy_->cut_after(0);
  until([&] { return !kept->status().lost_since_utc.empty(); });
  const ReplicaStatus lost = kept->status();
  EXPECT_NE(lost.why.find("central database"), std::string::npos) << lost.why;
  EXPECT_NE(lost.as_of_utc, "") << "what is there is as of then";
  EXPECT_LE(lost.as_of_utc, lost.lost_since_utc);
  AssessmentStore(copy).add_note("T-north", "", "Written in a dark hour.", kTeacher);
  AssessmentStore(copy).add_note("T-north", "", "And another.", kTeacher);
  until([&] { return kept->status().waiting == 2; });
  EXPECT_EQ(kept->status().lost_since_utc, lost.lost_since_utc) << "the first moment, not the newest try";
  proxy_->mend();
  until([&] { return kept->status().lost_since_utc.empty() && kept->status().waiting == 0; });
  EXPECT_EQ(one("SELECT count(*) FROM note"), "3");
  const std::scoped_lock lock(mutex_);
  EXPECT_EQ(std::count(log_.begin(), log_.end(), "the central database is reached again"), 1);
}

TEST_F(Keeper, KeepsWhatWaitsWhenTheDeskIsClosed) {
  {
    const auto kept = keeper();
    proxy_->cut_after(0);
    until([&] { return !kept->status().lost_since_utc.empty(); });
    Database copy = station("desk");
    AssessmentStore(copy).add_note("T-north", "", "Written in a dark hour.", kTeacher);
  }
  {
    const auto kept = keeper();  // begins without a centre, from what it had
    EXPECT_NE(kept->status().lost_since_utc, "");
    EXPECT_NE(kept->status().as_of_utc, "");
    EXPECT_EQ(kept->status().waiting, 1);
  }
  proxy_->mend();
  const auto kept = keeper();
  EXPECT_EQ(kept->status().waiting, 0);
  EXPECT_EQ(one("SELECT count(*) FROM note WHERE text LIKE 'Written%'"), "1");
}

TEST_F(Keeper, WithoutACentreANewDeskDoesNotBegin) {
  proxy_->cut_after(0);
  EXPECT_NE(message_of<EnvironmentError>([&] { keeper(); }).find("cannot be reached"), std::string::npos);
}

TEST_F(Keeper, DoesNotTakeAStationsOwnDatabaseForACopy) {
  const auto before = everything();
  EXPECT_NE(message_of<InputError>([&] { keeper("north"); }).find("holds attempts of its own"), std::string::npos);
  EXPECT_EQ(everything(), before) << "and pushes nothing of it under the desk's name";
}

TEST_F(Keeper, BeginsFromWhatItHasWhenItCannotTakeWhatIsThere) {
  { const auto kept = keeper(); }
  ask("ALTER TABLE note_seen RENAME TO gone");  // any refusal of the centre
  const auto kept = keeper();
  Database copy = station("desk");
  EXPECT_NE(kept->status().as_of_utc, "");
  EXPECT_NE(kept->status().why.find("note_seen"), std::string::npos) << kept->status().why;
  EXPECT_EQ(AttemptStore(copy).list().size(), 2u);
  ask("ALTER TABLE gone RENAME TO note_seen");
  until([&] { return kept->status().lost_since_utc.empty(); });
}

TEST_F(Keeper, DoesNotTakeTheCopyOfAnotherCentre) {
  { const auto kept = keeper(); }
  central_ = another_central();
  const auto before = everything();
  EXPECT_NE(message_of<InputError>([&] { keeper(); }).find("is a copy of another central database"), std::string::npos);
  EXPECT_EQ(everything(), before);
}

TEST_F(Keeper, TwoDesksThatWriteAtOnceEndWithTheSame) {
  const auto first = keeper("desk"), second = keeper("second");
  Database one_desk = station("desk"), other_desk = station("second");
  const std::string attempt = AttemptStore(one_desk).find("latest").uuid;
  for (int i = 0; i < 5; ++i) {
    AssessmentStore(one_desk).override_verdict(attempt, true, "The camera was knocked over.", kTeacher);
    AssessmentStore(other_desk)
        .override_verdict(attempt, false, "I saw it: it was the hand.", {"0192-other", "Otto Blau"});
  }
  const auto all = [&](Database& database) { return AssessmentStore(database).overrides_of(attempt); };
  until([&] { return all(one_desk).size() == 10 && all(other_desk).size() == all(one_desk).size(); });
  EXPECT_EQ(all(one_desk).front().uuid, all(other_desk).front().uuid);
  until([&] { return first->status().waiting == 0 && second->status().waiting == 0; });
  EXPECT_EQ(problems_of(one_desk), "");
  EXPECT_EQ(problems_of(other_desk), "");
}

TEST_F(Keeper, SettlesDownWhenNobodyWrites) {
  const auto first = keeper("desk"), second = keeper("second");
  Database copy = station("desk");
  AssessmentStore(copy).add_note("T-north", "", "Slower on the way out.", kTeacher);
  Database other = station("second");
  until([&] { return AssessmentStore(other).notes_of("T-north").size() == 2; });
  const auto quiet = [&] {
    const std::string before = one("SELECT revision FROM central") + copy.head() + other.head();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return before == one("SELECT revision FROM central") + copy.head() + other.head();
  };
  until(quiet);  // two desks do not tell each other the same for ever
}

TEST_F(Keeper, TellsEachFaultOnceHoweverOftenItLooks) {
  ask("UPDATE note SET text = 'Splendid.' RETURNING 1");
  const auto kept = keeper();
  Database north = station("north");
  practise(north, "T-north", 1);
  push(north);
  Database copy = station("desk");
  until([&] { return AttemptStore(copy).list().size() == 3; });
  const std::scoped_lock lock(mutex_);
  int told = 0;
  for (const std::string& line : log_) told += line.find("its content is not that of its hash") != std::string::npos;
  EXPECT_EQ(told, 1);
}

TEST(CentralName, IsWhereTheRecordIsAndNeverWhoAsks) {
  EXPECT_EQ(central_name({"postgresql://desk@central.example/trocar"}), "central.example/trocar");
  EXPECT_EQ(central_name({"postgresql://desk@central.example:5433/trocar?sslmode=verify-full"}),
            "central.example:5433/trocar");
  EXPECT_EQ(central_name({"postgresql:///trocar?host=/run/postgresql&user=desk"}), "this machine/trocar");
  EXPECT_EQ(central_name({"postgresql:///trocar?user=desk&host=central.example"}), "central.example/trocar");
}

TEST(DefaultReplica, IsOneFileForEachCentre) {
  const auto first = default_replica_path({"postgresql://desk@central.example/trocar"});
  EXPECT_NE(first, default_replica_path({"postgresql://desk@central.example/other"}));
  EXPECT_EQ(first, default_replica_path({"postgresql://desk@central.example/trocar"}));
  EXPECT_EQ(first.extension(), ".db");
}

}  // namespace
}  // namespace trocar::replica_keeper_test
