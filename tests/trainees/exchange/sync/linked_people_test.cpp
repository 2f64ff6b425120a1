// One person who practises at two stations: linked by somebody who says so, one curve, parted again, erased together.
#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/progress/learning_curve.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/records/standings.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::linked_people_test {
namespace {

using test::kTeacher;
using test::Stations;
using Lines = std::vector<std::string>;

/// anna at the north, a.nna at the south: the same hands. berta is somebody else.
class Linked : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    Database north = station("north"), south = station("south");
    practise(north, "anna", 2);
    practise(north, "berta", 1);
    practise(south, "a.nna", 3);
    ConsentStore(south).record("a.nna", "research", true, "I agree.", kTeacher);
    CurriculumStore(south).join("a.nna", "monday", kTeacher);
    push_named(north, "north");
    push_named(south, "south");
    Database made = desk();
    annas_ = trainee_uuid(north, "anna");
  }
  LinkedPeople link() { return link_people(central_, "anna@north", "a.nna@south", true, "Ida Adler"); }
  LinkedPeople part() { return link_people(central_, "anna@north", "a.nna@south", false, "Ida Adler"); }
  std::string refusal(const std::string& one, const std::string& other, bool linked = true) {
    return message_of<InputError>([&] { link_people(central_, one, other, linked, "Ida Adler"); });
  }
  /// Brings it up to date; everything in it holds.
  void refresh(Database& database) {
    EXPECT_EQ(replicate_central(database, central_).problems, Lines{});
    EXPECT_EQ(problems_of(database), "");
  }
  std::size_t attempts(Database& database, const std::string& code) const {
    return AttemptStore(database).list({code, ""}).size();
  }
  std::string annas_;
};

TEST_F(Linked, HaveOneCurveAndOneSetOfNotesAtTheDesk) {
  Database copy = station("desk");
  EXPECT_EQ(attempts(copy, "anna"), 2u);
  EXPECT_EQ(link().one, annas_) << "the older UUID is the one they stand under";
  refresh(copy);
  EXPECT_EQ(attempts(copy, "anna"), 5u);
  EXPECT_EQ(attempts(copy, "a.nna"), 0u);
  EXPECT_EQ(attempts(copy, "berta"), 1u);
  const auto curves = learning_curves(past_attempts(copy, "anna"));
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].attempts.size(), 5u);
  EXPECT_EQ(AssessmentStore(copy).notes_of("anna").size(), 2u);
  EXPECT_EQ(AssessmentStore(copy).certificates_of("anna").size(), 2u);
  EXPECT_TRUE(ConsentStore(copy).holds("anna", "research"));
  EXPECT_EQ(CurriculumStore(copy).groups_of("anna"), Lines{"monday"});
}

TEST_F(Linked, ThatComesAfterwardsJoinsThem) {
  Database copy = station("desk"), south = station("south");
  link();
  refresh(copy);
  practise(south, "a.nna", 2);
  push(south);
  refresh(copy);
  EXPECT_EQ(attempts(copy, "anna"), 7u);
  Database late = desk("late");  // a desk that begins after it was said
  EXPECT_EQ(attempts(late, "anna"), 7u);
  EXPECT_EQ(AssessmentStore(late).notes_of("anna").size(), 3u);
}

TEST_F(Linked, AreTwoAgainWhenItIsTakenBack) {
  Database copy = station("desk");
  link();
  refresh(copy);
  part();
  refresh(copy);
  EXPECT_EQ(attempts(copy, "anna"), 2u);
  EXPECT_EQ(attempts(copy, "a.nna"), 3u);
  EXPECT_EQ(AssessmentStore(copy).notes_of("anna").size(), 1u);
  EXPECT_EQ(AssessmentStore(copy).certificates_of("a.nna").size(), 1u);
  EXPECT_FALSE(ConsentStore(copy).holds("anna", "research"));
  link();
  refresh(copy);
  EXPECT_EQ(attempts(copy, "anna"), 5u);
}

TEST_F(Linked, AreWrittenDownWithWhoSaidSo) {
  link();
  part();
  EXPECT_EQ(ask("SELECT one, linked, author FROM person_link ORDER BY person_link.seq"),
            (Lines{annas_ + "|t|Ida Adler", annas_ + "|f|Ida Adler"}));
  Database copy = station("desk");
  link();
  refresh(copy);
  EXPECT_EQ(sql::query_integer(copy.connection(), "SELECT count(*) FROM audit WHERE action = 'linked'"), 6)
      << "3 attempts, note, consent, certificate";
}

TEST_F(Linked, AMovedRowThatIsChangedIsFound) {
  Database copy = station("desk");
  link();
  refresh(copy);
  ASSERT_EQ(run_without_triggers(
                folder_ / "desk.db",
                "UPDATE metric_row SET value = 1 WHERE id >> 10 = (SELECT s.id FROM score s JOIN attempt a ON"
                " a.id = s.attempt_id JOIN audit u ON u.subject = a.uuid AND u.action = 'linked' LIMIT 1)"),
            "");
  EXPECT_NE(problems_of(copy).find("of another station was changed"), std::string::npos) << problems_of(copy);
}

TEST_F(Linked, GetNotesAtWhicheverStationTheyComeTo) {
  Database copy = station("desk"), south = station("south"), north = station("north");
  link();
  refresh(copy);
  AssessmentStore(copy).add_note("anna", "", "See me on Friday.", kTeacher);
  AssessmentStore(copy).certify("anna", "surface-touch", "L2", "1", "{}", kTeacher);
  push(copy);
  for (Database* one : {&south, &north}) {
    EXPECT_EQ(pull_from_central(*one, central_, false).problems, Lines{});
    EXPECT_EQ(problems_of(*one), "");
  }
  EXPECT_EQ(AssessmentStore(south).newest_unseen("a.nna")->text, "See me on Friday.");
  EXPECT_EQ(AssessmentStore(north).newest_unseen("anna")->text, "See me on Friday.");
  EXPECT_EQ(AssessmentStore(south).certificates_of("a.nna").front().level, "L2");
  EXPECT_EQ(attempts(south, "a.nna"), 3u) << "a station keeps its own attempts as they are";
  EXPECT_EQ(push(south).conflicts, Lines{}) << "what it was told goes back as it was written";
  part();
  EXPECT_EQ(pull_from_central(south, central_, false).problems, Lines{});
  EXPECT_EQ(AssessmentStore(south).notes_of("a.nna").front().text.substr(0, 4), "Keep") << "not hers any more";
  EXPECT_EQ(problems_of(south), "");
}

TEST_F(Linked, AreActiveOrNotAtBothStations) {
  Database copy = station("desk"), south = station("south"), north = station("north");
  StandingStore(south).set_active({"a.nna"}, false, "away", kTeacher);
  push(south);
  link();
  refresh(copy);
  EXPECT_FALSE(StandingStore(copy).of("anna").active);
  EXPECT_EQ(pull_from_central(north, central_, false).problems, Lines{});
  EXPECT_FALSE(StandingStore(north).of("anna").active);
  StandingStore(copy).set_active({"anna"}, true, "", kTeacher);
  push(copy);
  for (Database* one : {&south, &north}) {
    EXPECT_EQ(pull_from_central(*one, central_, false).problems, Lines{});
    EXPECT_EQ(problems_of(*one), "");
    EXPECT_EQ(push(*one).conflicts, Lines{});
  }
  EXPECT_TRUE(StandingStore(south).of("a.nna").active);
  part();
  refresh(copy);
  EXPECT_EQ(pull_from_central(north, central_, false).problems, Lines{});
  EXPECT_TRUE(StandingStore(north).of("anna").active);
}

TEST_F(Linked, AreErasedTogether) {
  Database copy = station("desk"), north = station("north"), south = station("south");
  link();
  refresh(copy);
  erase_trainee(north, "anna", ErasureKind::kTraining, "request of the person", kTeacher);
  push(north);
  EXPECT_EQ(one("SELECT count(*) FROM score"), "1") << "berta's alone";
  EXPECT_EQ(one("SELECT count(*) FROM person"), "1");
  EXPECT_EQ(one("SELECT count(*) FROM consent"), "0");
  refresh(copy);
  EXPECT_EQ(sql::query_integer(copy.connection(), "SELECT count(*) FROM score"), 1);
  EXPECT_EQ(sql::query_integer(copy.connection(), "SELECT count(*) FROM person"), 1);
  const PullReport told = pull_from_central(south, central_, false);
  ASSERT_EQ(told.erasures.size(), 1u);
  EXPECT_NE(told.erasures[0].find("trainee a.nna"), std::string::npos) << told.erasures[0];
  EXPECT_EQ(pull_from_central(south, central_, true).erased, 1);
  EXPECT_EQ(sql::query_integer(south.connection(), "SELECT count(*) FROM score"), 0);
  push(south);
  refresh(copy);
  Database late = desk("late");
  EXPECT_EQ(sql::query_integer(late.connection(), "SELECT count(*) FROM score"), 1);
  EXPECT_NE(refusal("anna@north", "a.nna@south", false), "") << "nobody is told apart any more";
}

TEST_F(Linked, AreNeverGuessed) {
  Database other = station("east");
  practise(other, "anna", 1);  // the same code is no proof
  push_named(other, "east");
  Database copy = desk("fresh");
  EXPECT_EQ(attempts(copy, "anna") + attempts(copy, "anna-" + trainee_uuid(other, "anna").substr(28)), 3u);
  EXPECT_EQ(attempts(copy, "anna"), 2u);
}

TEST_F(Linked, MayBeThreeAndPartedOnlyWhereTheyWereJoined) {
  Database east = station("east");
  practise(east, "A3", 1);
  push_named(east, "east");
  link();
  link_people(central_, "A3@east", "a.nna@south", true, "Ida Adler");
  Database copy = desk("fresh");
  EXPECT_EQ(attempts(copy, "anna"), 6u);
  EXPECT_NE(refusal("A3@east", "anna@north").find("are linked already"), std::string::npos);
  EXPECT_NE(refusal("A3@east", "anna@north", false).find("but through a third"), std::string::npos);
  part();
  refresh(copy);
  EXPECT_EQ(attempts(copy, "anna"), 2u);
  EXPECT_EQ(attempts(copy, "a.nna"), 4u);
}

TEST_F(Linked, RefusalsSayWhatToDo) {
  EXPECT_NE(refusal("nobody@north", "a.nna@south").find("--with-identity"), std::string::npos);
  EXPECT_NE(refusal("anna@moon", "a.nna@south").find("no such code of that station"), std::string::npos);
  EXPECT_NE(refusal("anna", "a.nna@south").find("CODE@STATION"), std::string::npos);
  EXPECT_NE(refusal("anna@north", annas_).find("one trainee already"), std::string::npos);
  EXPECT_NE(refusal("anna@north", "berta@north", false).find("were not linked"), std::string::npos);
  EXPECT_EQ(one("SELECT count(*) FROM person_link"), "0");
  Database south = station("south");
  erase_trainee(south, "a.nna", ErasureKind::kIdentity, "request of the person", kTeacher);
  push(south);
  const std::string uuid = one("SELECT trainee_uuid FROM erasure");
  EXPECT_NE(refusal("anna@north", uuid).find("was erased"), std::string::npos);
}

}  // namespace
}  // namespace trocar::linked_people_test
