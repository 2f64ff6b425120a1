// Programmes kept and assigned, people deactivated: rows that are added and never changed.
#include "trainees/records/programmes.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/erasure.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::programmes_test {
namespace {

namespace fs = std::filesystem;

const Author kAuthor{"0192-account", "Ida Adler"};
constexpr const char* kText = "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\npasses = 3\n";

class Programmes : public TemporaryFolder {
 protected:
  Programmes() {
    for (const char* code : {"T-1", "T-2"}) TraineeStore(database_).ensure_trainee(code);
    CurriculumStore(database_).join("T-1", "2026 A", kAuthor);
  }
  std::string refusal(const std::function<void()>& action) const { return message_of<InputError>(action); }
  const fs::path file_ = folder_ / "t.db";
  Database database_{file_};
  ProgrammeStore store_{database_};
};

TEST_F(Programmes, AreCurriculaOfTheirNameAndVersionsHold) {
  EXPECT_EQ(store_.save("Basics", kText, kAuthor).version, 1);
  EXPECT_EQ(store_.save("Basics", kText, kAuthor).version, 1);
  EXPECT_EQ(store_.save("Basics", std::string(kText) + "days = 2\n", kAuthor).version, 2);
  CurriculumStore(database_).add("standard", "version = \"1\"\n", kAuthor);
  CurriculumStore(database_).add("broken", "[[step]]\n", kAuthor);
  const auto all = store_.list();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].programme.steps.at(0).days, 2);
  EXPECT_NE(all[1].problem.find("broken:1:"), std::string::npos) << all[1].problem;
  EXPECT_NE(refusal([&] { store_.save("standard", kText, kAuthor); }).find("rules of progress"), std::string::npos);
  EXPECT_NE(refusal([&] { store_.save("Basics", "[[step]]\n", kAuthor); }).find("Basics:1:"), std::string::npos);
  EXPECT_THROW(store_.find("standard"), InputError);
  EXPECT_THROW(store_.find("nothing"), InputError);
}

TEST_F(Programmes, AreAssignedReplacedAndWithdrawnAndAllStays) {
  store_.save("Basics", kText, kAuthor);
  const Assignment group = store_.assign("Basics", "", "2026 A", "2026-06-30", kAuthor);
  const Assignment person = store_.assign("Basics", "t-2", "", "", kAuthor);
  EXPECT_EQ(person.trainee, "T-2");
  EXPECT_NE(refusal([&] { store_.assign("Basics", "", "2026 A", "2026-06-30", kAuthor); }).find("already"),
            std::string::npos);
  store_.assign("Basics", "", "2026 A", "2026-07-31", kAuthor);
  store_.withdraw(person.uuid, "left the course", kAuthor);
  const auto all = store_.assignments();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].due, "2026-07-31");
  EXPECT_EQ(all[1].withdrawn_reason, "left the course");
  EXPECT_EQ(all[1].withdrawn_by, "Ida Adler");
  EXPECT_EQ(all[2].uuid, group.uuid);
  EXPECT_EQ(all[2].withdrawn_reason, "replaced");
  EXPECT_NE(refusal([&] { store_.withdraw(person.uuid, "", kAuthor); }).find("withdrawn before"), std::string::npos);
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(Programmes, AreNotAssignedToNobodyOrToNoDay) {
  store_.save("Basics", kText, kAuthor);
  const auto said = [&](const char* programme, const char* trainee, const char* group, const char* due) {
    return refusal([&] { store_.assign(programme, trainee, group, due, kAuthor); });
  };
  EXPECT_NE(said("Other", "T-1", "", "").find("programme \"Other\": there is none"), std::string::npos);
  EXPECT_NE(said("Basics", "T-9", "", "").find("there is none"), std::string::npos);
  EXPECT_NE(said("Basics", "", "2027", "").find("nobody is in it"), std::string::npos);
  EXPECT_NE(said("Basics", "", "", "").find("one person or to one group"), std::string::npos);
  EXPECT_NE(said("Basics", "T-1", "2026 A", "").find("one person or to one group"), std::string::npos);
  EXPECT_NE(said("Basics", "T-1", "", "30.6.2026").find("such as 2026-06-30"), std::string::npos);
  EXPECT_NE(refusal([&] { store_.withdraw("nothing", "", kAuthor); }).find("there is none"), std::string::npos);
  EXPECT_TRUE(store_.assignments().empty());
}

TEST_F(Programmes, TheNewestStandingHoldsAndWhoIsDeactivatedBeginsNoAttempt) {
  StandingStore standings(database_);
  EXPECT_EQ(standings.set_active({"T-1", "T-2"}, false, "left", kAuthor), 2);
  EXPECT_EQ(standings.set_active({"T-1"}, false, "again", kAuthor), 0) << "is so already";
  EXPECT_EQ(deactivated(database_.connection()).size(), 2U);
  EXPECT_NE(refusal([&] { AttemptStore(database_).begin_attempt(sample_start("T-1")); }).find("is deactivated"),
            std::string::npos);
  EXPECT_EQ(AttemptStore(database_).list().size(), 0U);
  EXPECT_EQ(standings.set_active({"T-1"}, true, "", kAuthor), 1);
  EXPECT_EQ(standings.of("T-2").reason, "left");
  EXPECT_TRUE(standings.of("T-1").active);
  store_attempt(database_, sample_start("T-1"), sample_result());
  const AttemptId running = AttemptStore(database_).begin_attempt(sample_start("T-1"));
  EXPECT_NE(refusal([&] { standings.set_active({"T-1"}, false, "", kAuthor); }).find("is running"), std::string::npos);
  AttemptStore(database_).finish_attempt(running, sample_result());
  EXPECT_NE(refusal([&] { standings.set_active({"T-1", "T-9"}, false, "", kAuthor); }).find("T-9"), std::string::npos);
  EXPECT_TRUE(standings.of("T-1").active) << "all or none";
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(Programmes, RowsCannotBeChangedAndAForgeryIsFound) {
  store_.save("Basics", kText, kAuthor);
  store_.withdraw(store_.assign("Basics", "T-1", "", "", kAuthor).uuid, "", kAuthor);
  store_.assign("Basics", "", "2026 A", "2026-06-30", kAuthor);
  StandingStore(database_).set_active({"T-2"}, false, "", kAuthor);
  for (const char* sql : {"UPDATE standing SET active = 1", "DELETE FROM standing", "UPDATE assignment SET due = ''",
                          "DELETE FROM assignment", "UPDATE withdrawal SET reason = 'x'", "DELETE FROM withdrawal",
                          "INSERT OR REPLACE INTO assignment SELECT * FROM assignment"})
    EXPECT_NE(run_outside(file_, sql), "") << sql;
  int copies = 0;
  for (const auto& [sql, said] :
       {std::pair{"UPDATE standing SET active = 1", "was changed after it was written"},
        {"UPDATE assignment SET due = '2027-06-30' WHERE due <> ''", "was changed after it was written"},
        {"DELETE FROM withdrawal", "is missing"}}) {
    const fs::path copy = folder_ / ("forged" + std::to_string(++copies) + ".db");
    database_.backup(copy);
    EXPECT_EQ(run_without_triggers(copy, sql), "");
    EXPECT_NE(problems_of(Database(copy)).find(said), std::string::npos) << sql;
  }
}

TEST_F(Programmes, GoWithThePerson) {
  store_.save("Basics", kText, kAuthor);
  store_.withdraw(store_.assign("Basics", "T-1", "", "", kAuthor).uuid, "moved away", kAuthor);
  store_.assign("Basics", "T-1", "", "2026-06-30", kAuthor);
  store_.assign("Basics", "", "2026 A", "", kAuthor);
  StandingStore(database_).set_active({"T-1"}, false, "moved away", kAuthor);
  const std::string all = everything_about(database_, "T-1");
  for (const char* said : {"\"standings\"", "\"assignments\"", "moved away", "2026-06-30", "standing added",
                           "assignment added", "withdrawal added"})
    EXPECT_NE(all.find(said), std::string::npos) << said;
  erase_trainee(database_, "T-1", ErasureKind::kIdentity, "request", kAuthor);
  EXPECT_EQ(sql::query_integer(database_.connection(), "SELECT count(*) FROM standing"), 0);
  EXPECT_EQ(sql::query_integer(database_.connection(), "SELECT count(*) FROM withdrawal"), 0);
  EXPECT_EQ(store_.assignments().size(), 1U) << "the group's";
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(Programmes, ARecordOfSchemaTwoIsTakenAlong) {
  const fs::path old = folder_ / "old.db";
  {
    Database second(old, OpenMode::kCreate, 5000, shipped_migrations().first(2));
    TraineeStore(second).ensure_trainee("T-old");
    CurriculumStore(second).join("T-old", "2025", kAuthor);
    EXPECT_EQ(second.schema_version(), 2);
  }
  Database now(old);
  EXPECT_EQ(now.migration().from, 2);
  EXPECT_EQ(now.migration().backup, old.string() + ".schema2.backup");
  ProgrammeStore(now).save("Basics", kText, kAuthor);
  ProgrammeStore(now).assign("Basics", "", "2025", "2026-06-30", kAuthor);
  StandingStore(now).set_active({"T-old"}, false, "", kAuthor);
  EXPECT_EQ(problems_of(now), "");
}

}  // namespace
}  // namespace trocar::programmes_test
