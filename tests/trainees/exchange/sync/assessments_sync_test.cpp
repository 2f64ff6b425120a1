// What teachers say at a desk reaches the trainee at the station, and the other way round; groups; two desks that
// decide at once.
#include "tests/trainees/exchange/sync/stations.h"
#include "trainees/exchange/sync/links.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/records/programmes.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::assessments_sync_test {
namespace {

using test::kTeacher;
using test::Stations;
using Lines = std::vector<std::string>;

const Author kOther{"0192-other", "Otto Blau"};

/// Two stations with a trainee each, and a desk.
class Assessments : public Stations {
 protected:
  void SetUp() override {
    Stations::SetUp();
    if (IsSkipped()) return;
    for (const char* name : {"north", "south"}) {
      Database database = station(name);
      for (int i = 0; i < 2; ++i)
        store_attempt(database, sample_start(std::string("T-") + name), sample_result(60 + i));
      push_named(database, name);
    }
    Database made = desk();
  }
  std::string newest(Database& database, const std::string& code) const {
    return AttemptStore(database).list({code, ""}).front().uuid;
  }
  PullReport pull(Database& database) const {
    PullReport report = pull_from_central(database, central_, false);
    EXPECT_EQ(report.problems, Lines{});
    EXPECT_EQ(problems_of(database), "");
    return report;
  }
  /// What the desk wrote goes up and comes down at that station.
  PullReport travel(Database& from, Database& to) {
    const PushReport pushed = push(from);
    EXPECT_EQ(pushed.problems, Lines{});
    EXPECT_EQ(pushed.conflicts, Lines{});
    return pull(to);
  }
};

TEST_F(Assessments, ANoteOfTheDeskMeetsTheTraineeAtTheStationAndTheDeskHearsThatItDid) {
  Database copy = station("desk"), north = station("north"), south = station("south");
  const Note written = AssessmentStore(copy).add_note("T-north", newest(copy, "T-north"), "Rest your elbow.", kTeacher);
  travel(copy, north);
  const auto met = AssessmentStore(north).newest_unseen("T-north");
  ASSERT_TRUE(met);
  EXPECT_EQ(met->text, "Rest your elbow.");
  EXPECT_EQ(met->printed, "Ida Adler");
  EXPECT_EQ(met->attempt_uuid, written.attempt_uuid);
  EXPECT_FALSE(pull(south).added.contains("note")) << "it is no business of that station";
  AssessmentStore(north).mark_seen(met->uuid);
  push(north);
  replicate_central(copy, central_);
  EXPECT_EQ(AssessmentStore(copy).notes_of("T-north").front().seen_utc,
            AssessmentStore(north).notes_of("T-north").front().seen_utc);
  EXPECT_NE(AssessmentStore(copy).notes_of("T-north").front().seen_utc, "");
  EXPECT_TRUE(push(north).added.empty());
  EXPECT_TRUE(pull(north).added.empty());
}

TEST_F(Assessments, DecisionsOfTheDeskStandAtTheStation) {
  Database copy = station("desk"), north = station("north");
  AssessmentStore said(copy);
  const std::string attempt = newest(copy, "T-north");
  said.sign(attempt, "approval", "", kTeacher);
  said.add_rating(attempt, "GOALS", "depth perception", 4, kTeacher);
  said.override_verdict(attempt, true, "The camera was knocked over.", kTeacher);
  const Certificate certificate = said.certify("T-north", "surface-touch", "L1", "1", "{}", kTeacher);
  EXPECT_EQ(travel(copy, north).added,
            (std::map<std::string, int>{{"signature", 1}, {"rating", 1}, {"verdict_override", 1}, {"certificate", 1}}));
  EXPECT_TRUE(AssessmentStore(north).overrides_of(attempt).at(0).passed);
  EXPECT_EQ(AssessmentStore(north).certificates_of("T-north").at(0).uuid, certificate.uuid);
  said.revoke(certificate.uuid, "The wrong trainee was at the table.", kTeacher);
  travel(copy, north);
  EXPECT_NE(AssessmentStore(north).certificates_of("T-north").at(0).revoked_utc, "");
}

TEST_F(Assessments, ConsentsAreKnownWhereverThePersonIs) {
  Database copy = station("desk"), north = station("north");
  ConsentStore(north).record("T-north", "research", true, "I agree.", kTeacher);
  push(north);
  replicate_central(copy, central_);
  EXPECT_FALSE(ConsentStore(copy).holds("T-north", "research")) << "who somebody is goes only when asked";
  push_named(north, "north");
  replicate_central(copy, central_);
  EXPECT_TRUE(ConsentStore(copy).holds("T-north", "research"));
}

TEST_F(Assessments, TwoDesksThatDecideAtOnceBothStandAndEverybodySeesTheSameFirst) {
  Database copy = station("desk"), second = desk("second"), north = station("north");
  const std::string attempt = newest(copy, "T-north");
  AssessmentStore(copy).override_verdict(attempt, true, "The camera was knocked over.", kTeacher);
  AssessmentStore(second).override_verdict(attempt, false, "I saw it: it was the hand.", kOther);
  AssessmentStore(copy).certify("T-north", "surface-touch", "L1", "1", "{}", kTeacher);
  AssessmentStore(second).certify("T-north", "surface-touch", "L1", "1", "{}", kOther);
  for (int turn = 0; turn < 2; ++turn) {  // in either order of arrival
    push(second, "second");
    push(copy, "desk");
    for (Database* one : {&copy, &second}) EXPECT_EQ(replicate_central(*one, central_).problems, Lines{});
    pull(north);
  }
  const auto here = AssessmentStore(copy).overrides_of(attempt);
  ASSERT_EQ(here.size(), 2u);
  for (Database* other : {&second, &north}) {
    EXPECT_EQ(AssessmentStore(*other).overrides_of(attempt).at(0).uuid, here[0].uuid)
        << "the same one holds everywhere";
    EXPECT_EQ(AssessmentStore(*other).certificates_of("T-north").size(), 2u);
    EXPECT_EQ(problems_of(*other), "");
  }
}

TEST_F(Assessments, TwoDesksThatRevokeOneCertificateBothRevokedIt) {
  Database copy = station("desk"), second = desk("second"), north = station("north");
  const Certificate certificate = AssessmentStore(copy).certify("T-north", "surface-touch", "L1", "1", "{}", kTeacher);
  push(copy, "desk");
  replicate_central(second, central_);
  AssessmentStore(copy).revoke(certificate.uuid, "The wrong trainee was at it.", kTeacher);
  AssessmentStore(second).revoke(certificate.uuid, "The table was not level then.", kOther);
  push(second, "second");
  push(copy, "desk");
  EXPECT_EQ(one("SELECT count(*) FROM revocation"), "2") << "the centre has both";
  for (Database* other : {&copy, &second}) {
    EXPECT_EQ(replicate_central(*other, central_).problems, Lines{});
    EXPECT_EQ(problems_of(*other), "");
    EXPECT_NE(AssessmentStore(*other).certificates_of("T-north").at(0).revoked_utc, "");
  }
  pull(north);
  EXPECT_NE(AssessmentStore(north).certificates_of("T-north").at(0).revoked_utc, "");
}

TEST_F(Assessments, GroupsAreThoseOfTheNewestChangeThatReachedTheCentre) {
  Database copy = station("desk"), north = station("north");
  CurriculumStore(north).join("T-north", "monday", kTeacher);
  CurriculumStore(copy).join("T-south", "monday", kTeacher);
  push(copy);
  push(north);
  replicate_central(copy, central_);
  EXPECT_EQ(CurriculumStore(copy).members("monday"), (Lines{"T-north", "T-south"}));
  CurriculumStore(copy).leave("T-north", "monday", kTeacher);
  CurriculumStore(copy).join("T-north", "tuesday", kTeacher);
  travel(copy, north);
  EXPECT_EQ(CurriculumStore(north).groups_of("T-north"), Lines{"tuesday"});
  push(north);  // what it was told is not said again as if it were news
  CurriculumStore(copy).join("T-north", "monday", kTeacher);
  travel(copy, north);
  EXPECT_EQ(CurriculumStore(north).groups_of("T-north"), (Lines{"monday", "tuesday"}));
  EXPECT_EQ(problems_of(copy), "");
}

constexpr const char* kCourse = "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\n";

TEST_F(Assessments, WhoIsActiveIsKnownAtTheStationAndAtTheDesk) {
  Database copy = station("desk"), north = station("north"), south = station("south");
  StandingStore(copy).set_active({"T-north"}, false, "left in June", kTeacher);
  travel(copy, north);
  EXPECT_FALSE(StandingStore(north).of("T-north").active);
  EXPECT_EQ(StandingStore(north).of("T-north").reason, "left in June");
  EXPECT_NE(message_of<InputError>([&] {
              store_attempt(north, sample_start("T-north"), sample_result());
            }).find("is deactivated"),
            std::string::npos);
  EXPECT_FALSE(pull(south).added.contains("standing")) << "it is no business of that station";
  StandingStore(north).set_active({"T-north"}, true, "", kOther);
  push(north);
  EXPECT_EQ(replicate_central(copy, central_).problems, Lines{});
  EXPECT_TRUE(StandingStore(copy).of("T-north").active);
  EXPECT_EQ(StandingStore(copy).of("T-north").printed, kOther.printed);
  EXPECT_EQ(problems_of(copy), "");
}

TEST_F(Assessments, ProgrammesAssignedAtTheDeskHoldAtTheStationUntilTheyAreWithdrawn) {
  Database copy = station("desk"), second = desk("second"), north = station("north"), south = station("south");
  CurriculumStore(copy).join("T-north", "monday", kTeacher);
  ProgrammeStore(copy).save("Basics", kCourse, kTeacher);
  const Assignment group = ProgrammeStore(copy).assign("Basics", "", "monday", "2027-06-30", kTeacher);
  ProgrammeStore(copy).assign("Basics", "T-north", "", "2027-07-31", kTeacher);
  travel(copy, north);
  const auto here = ProgrammeStore(north).assignments();
  ASSERT_EQ(here.size(), 2u);
  EXPECT_EQ(here[0].trainee, "T-north");
  EXPECT_EQ(here[0].due, "2027-07-31");
  EXPECT_EQ(here[1].group, "monday");
  EXPECT_EQ(pull(south).added.at("assignment"), 1) << "that of the group: somebody may join it anywhere";
  // Two desks withdraw one at once: it is withdrawn, at both as whoever was first there.
  EXPECT_EQ(replicate_central(second, central_).problems, Lines{});
  ProgrammeStore(copy).withdraw(group.uuid, "the course is over", kTeacher);
  ProgrammeStore(second).withdraw(group.uuid, "", kOther);
  push(second, "second");
  push(copy, "desk");
  for (Database* one : {&copy, &second}) {
    EXPECT_EQ(replicate_central(*one, central_).problems, Lines{});
    EXPECT_EQ(problems_of(*one), "");
  }
  pull(north);
  for (const Assignment& one : ProgrammeStore(north).assignments())
    EXPECT_EQ(one.withdrawn_utc.empty(), one.group.empty());
  EXPECT_EQ(push(north).conflicts, Lines{});
}

TEST_F(Assessments, AnErasedPersonsStandingAndProgrammesGoEverywhere) {
  Database copy = station("desk"), north = station("north");
  StandingStore(copy).set_active({"T-north"}, false, "ill", kTeacher);
  ProgrammeStore(copy).save("Basics", kCourse, kTeacher);
  const Assignment own = ProgrammeStore(copy).assign("Basics", "T-north", "", "", kTeacher);
  ProgrammeStore(copy).withdraw(own.uuid, "ill", kTeacher);
  travel(copy, north);
  erase_trainee(north, "T-north", ErasureKind::kIdentity, "request of the person", kTeacher);
  push(north);
  EXPECT_EQ(replicate_central(copy, central_).problems, Lines{});
  for (const std::string table : {"standing", "assignment", "withdrawal"}) {
    EXPECT_EQ(one("SELECT count(*) FROM " + table), "0") << table;
    for (Database* database : {&copy, &north})
      EXPECT_EQ(sql::query_integer(database->connection(), ("SELECT count(*) FROM " + table).c_str()), 0) << table;
  }
  EXPECT_EQ(problems_of(copy) + problems_of(north), "");
}

TEST_F(Assessments, AGroupThatWasLeftHereIsNotJoinedAgainByOlderNews) {
  Database copy = station("desk"), north = station("north");
  CurriculumStore(copy).join("T-north", "monday", kTeacher);
  travel(copy, north);
  CurriculumStore(north).leave("T-north", "monday", kTeacher);  // and nobody has pushed it yet
  pull(north);
  EXPECT_EQ(CurriculumStore(north).groups_of("T-north"), Lines{});
  push(north);
  replicate_central(copy, central_);
  EXPECT_EQ(CurriculumStore(copy).groups_of("T-north"), Lines{});
}

TEST_F(Assessments, WhatWasChangedAtTheCentreDoesNotReachTheStation) {
  Database copy = station("desk"), north = station("north");
  const Note note = AssessmentStore(copy).add_note("T-north", "", "Once more with the left.", kTeacher);
  push(copy);
  ask("UPDATE note SET text = 'Splendid.' RETURNING 1");
  const PullReport pulled = pull_from_central(north, central_, false);
  ASSERT_EQ(pulled.problems.size(), 1u);
  EXPECT_NE(pulled.problems[0].find("note " + note.uuid + ": its content is not that of its hash"), std::string::npos);
  EXPECT_FALSE(AssessmentStore(north).newest_unseen("T-north"));
  EXPECT_EQ(problems_of(north), "");
}

TEST_F(Assessments, NobodyWhoWasErasedHereGetsNotesAgain) {
  Database copy = station("desk"), north = station("north");
  AssessmentStore(copy).add_note("T-north", "", "Once more with the left.", kTeacher);
  push(copy);
  erase_trainee(north, "T-north", ErasureKind::kIdentity, "request of the person", kTeacher);
  EXPECT_FALSE(pull(north).added.contains("note"));
  push(north);
  EXPECT_EQ(one("SELECT count(*) FROM note"), "0");
}

TEST_F(Assessments, ACopyTakesNoAttemptsAndSaysWhy) {
  Database copy = station("desk");
  const std::string refused =
      message_of<InputError>([&] { AttemptStore(copy).begin_attempt(sample_start("T-north")); });
  EXPECT_NE(refused.find("is a copy of the record of many stations"), std::string::npos) << refused;
  EXPECT_NE(refused.find("--db FILE"), std::string::npos) << refused;
  EXPECT_NE(message_of<InputError>([&] { TraineeStore(copy).ensure_trainee("T-new"); }).find("nor trainees added"),
            std::string::npos);
  EXPECT_EQ(AttemptStore(copy).list().size(), 4u);
  Database empty = station("empty");  // of a centre that nobody has pushed to yet
  replicate_central(empty, another_central());
  EXPECT_NE(message_of<InputError>([&] { AttemptStore(empty).begin_attempt(sample_start()); }), "");
  Database north = station("north");
  pull(north);
  EXPECT_NO_THROW(store_attempt(north, sample_start("T-north"), sample_result()))
      << "a station that fetches is no copy";
}

TEST_F(Assessments, ACopyPushesNoIdentities) {
  Database copy = station("desk");
  EXPECT_NE(message_of<InputError>([&] { push_named(copy, "desk"); }).find("is a copy for a desk"), std::string::npos);
}

TEST_F(Assessments, OnlyWhatIsNewIsFetchedTheNextTimeAndItIsAllThereIs) {
  Database copy = station("desk"), north = station("north");
  store_attempt(north, sample_start("T-north"), sample_result(99));
  AssessmentStore(north).add_note("T-north", newest(north, "T-north"), "So it is.", kTeacher);
  push(north);
  const PullReport pulled = replicate_central(copy, central_);
  EXPECT_EQ(pulled.added, (std::map<std::string, int>{{"attempt", 1}, {"note", 1}}));
  EXPECT_EQ(problems_of(copy), "");
}

}  // namespace
}  // namespace trocar::assessments_sync_test
