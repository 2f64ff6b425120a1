// People from a list: looked at first, taken all at once.
#include "trainees/records/people_import.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/curricula.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::people_import_test {
namespace {

const Author kAuthor{"0192-account", "Ida Adler"};

class PeopleImport : public TemporaryFolder {
 protected:
  ImportPreview preview(const std::string& csv, const std::string& group = "") {
    return preview_people(database_, csv, "list.csv", group);
  }
  ImportPreview take(const std::string& csv, const std::string& group = "") {
    return take_people(database_, csv, "list.csv", group, kAuthor);
  }
  std::size_t people() { return TraineeStore(database_).list().size(); }
  std::filesystem::path file_ = folder_ / "p.db";
  Database database_{file_};
};

TEST_F(PeopleImport, APreviewWritesNothingAndSaysWhatWouldBe) {
  TraineeStore(database_).ensure_trainee("K-7");
  TraineeStore(database_).edit("K-7", "Kim Long", std::nullopt, "");
  const auto entries = [&] { return sql::query_integer(database_.connection(), "SELECT count(*) FROM audit"); };
  const std::int64_t before = entries();
  const ImportPreview seen = preview(
      "\xEF\xBB\xBF"
      "Code;Vorname;Nachname;E-Mail;Gruppe;Matrikel\r\n"
      "A-1;Ada;Lovelace;ada@example.org;2026 A;123\r\n"
      "k-7;Kim;Lang;;2026 A;\r\n"
      "a-1;Twin;;;;\r\n"
      ";No;Code;;;\r\n"
      "B 2;Blank;;;;\r\n"
      "C-3;;;not an address;;\r\n"
      "D-4;\xD0\x90\xD0\xBD\xD0\xBD\xD0\xB0;\xE6\x9D\x8E;;;\r\n"
      "E-5;too;many;;;;;;\r\n"
      "erased-1;x;;;;\r\n");
  EXPECT_EQ(entries(), before);
  EXPECT_EQ(people(), 1U);
  ASSERT_EQ(seen.remarks.size(), 1U);
  EXPECT_EQ(seen.remarks[0], "column \"Matrikel\" is not used");
  EXPECT_EQ(seen.count(RowFate::kNew), 2);
  EXPECT_EQ(seen.count(RowFate::kJoins), 1);
  EXPECT_EQ(seen.count(RowFate::kRefused), 6);
  EXPECT_EQ(seen.rows[0].name, "Ada Lovelace");
  EXPECT_EQ(seen.rows[0].group, "2026 A");
  EXPECT_EQ(seen.rows[1].reason, "is there already as Kim Long");
  EXPECT_EQ(seen.rows[2].line, 4);
  EXPECT_EQ(seen.rows[2].reason, "the code stands in line 2 already");
  EXPECT_EQ(seen.rows[3].reason, "has no code");
  EXPECT_NE(seen.rows[4].reason.find("1 to 32 letters"), std::string::npos);
  EXPECT_NE(seen.rows[5].reason.find("name@example.org"), std::string::npos);
  EXPECT_EQ(seen.rows[6].name, "\xD0\x90\xD0\xBD\xD0\xBD\xD0\xB0 \xE6\x9D\x8E");
  EXPECT_EQ(seen.rows[7].reason, "has 9 fields, the first line 6");
}

TEST_F(PeopleImport, WhatIsTakenIsWhatWasShownAndTwiceIsOnce) {
  const std::string csv = "code,name\nA-1,Ada\nB-2,\"Bo, the \"\"second\"\"\"\n'bad,x\n";
  const ImportPreview taken = take(csv, "2026 A");
  EXPECT_EQ(taken.count(RowFate::kNew), 2);
  EXPECT_EQ(taken.count(RowFate::kRefused), 1);
  EXPECT_EQ(TraineeStore(database_).find("B-2")->name, "Bo, the \"second\"");
  EXPECT_EQ(CurriculumStore(database_).members("2026 A"), (std::vector<std::string>{"A-1", "B-2"}));
  EXPECT_EQ(problems_of(database_), "");
  const ImportPreview again = take(csv, "2026 A");
  EXPECT_EQ(again.count(RowFate::kThere), 2);
  EXPECT_EQ(again.count(RowFate::kNew), 0);
  EXPECT_EQ(people(), 2U);
  StandingStore(database_).set_active({"A-1"}, false, "", kAuthor);
  EXPECT_EQ(preview(csv).rows[0].reason, "is there already, deactivated");
}

TEST_F(PeopleImport, FiveHundredAreTakenInOneTransactionAndAFailureTakesNone) {
  std::string csv = "code;name;group\r\n";
  for (int i = 1; i <= 500; ++i) csv += "P" + std::to_string(i) + ";Person " + std::to_string(i) + ";2026\r\n";
  sql::execute(database_.connection(),
               "CREATE TEMP TRIGGER stop BEFORE INSERT ON person WHEN NEW.code = 'P400' BEGIN SELECT RAISE(ABORT, "
               "'stopped'); END");
  EXPECT_THROW(take(csv), std::runtime_error);
  EXPECT_EQ(people(), 0U);
  sql::execute(database_.connection(), "DROP TRIGGER stop");
  EXPECT_EQ(take(csv).count(RowFate::kNew), 500);
  EXPECT_EQ(people(), 500U);
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(PeopleImport, AnotherDeskMayHaveBeenFaster) {
  const std::string csv = "code,name\nA-1,Ada\nB-2,Bo\n";
  EXPECT_EQ(preview(csv).count(RowFate::kNew), 2);
  Database other(file_);
  add_person(other, {0, "B-2", "Bea", "", ""}, kAuthor);
  const ImportPreview taken = take(csv);
  EXPECT_EQ(taken.count(RowFate::kNew), 1);
  EXPECT_EQ(taken.rows[1].reason, "is there already as Bea");
  EXPECT_EQ(TraineeStore(database_).find("B-2")->name, "Bea");
}

TEST_F(PeopleImport, LongFieldsAndGroupsComeBackShort) {
  const std::string longest(100000, 'g');
  EXPECT_THROW(preview("code\nA-1\n", longest), InputError);
  const ImportPreview seen = preview("code,group\nA-1," + longest + "\n");
  ASSERT_EQ(seen.rows.size(), 1U);
  EXPECT_EQ(seen.rows[0].fate, RowFate::kRefused);
  EXPECT_EQ(seen.rows[0].group, std::string(80, 'g') + "...");
}

TEST_F(PeopleImport, FilesThatAreNoListAreRefusedWithTheirPlace) {
  for (const auto& [csv, said] : {std::pair<std::string, std::string>{"", "list.csv: is empty"},
                                  {"name\nAda\n", "list.csv:1:1: the first line names the columns"},
                                  {"code,Name,name\nA,B,C\n", "list.csv:1:1: two columns for the same"},
                                  {"code\n", "nobody below it"},
                                  {"code\n\"A\n", "list.csv:2:"}})
    EXPECT_NE(message_of<InputError>([&, text = csv] { preview(text); }).find(said), std::string::npos)
        << csv << message_of<InputError>([&, text = csv] { preview(text); });
}

TEST_F(PeopleImport, CodesThatTheProgramGivesAreNobodys) {
  for (const char* code : {"guest", "Demonstration", "unnamed-1", "erased-2"})
    EXPECT_THROW(add_person(database_, {0, code, "", "", ""}, kAuthor), InputError) << code;
}

TEST_F(PeopleImport, OneIsAddedAndNotTwice) {
  add_person(database_, {0, "A-1", "Ada", "ada@example.org", "2026 A"}, kAuthor);
  EXPECT_EQ(TraineeStore(database_).find("A-1")->email, "ada@example.org");
  EXPECT_NE(message_of<InputError>([&] {
              add_person(database_, {0, "a-1", "", "", ""}, kAuthor);
            }).find("there already"),
            std::string::npos);
  EXPECT_THROW(add_person(database_, {0, "", "Nobody", "", ""}, kAuthor), InputError);
  EXPECT_EQ(problems_of(database_), "");
}

}  // namespace
}  // namespace trocar::people_import_test
