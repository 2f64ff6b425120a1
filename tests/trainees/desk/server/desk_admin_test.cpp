// The administrators' pages through the gate: accounts, the record, its audit trail, retention, the demo's end.
#include "tests/trainees/desk/server/desk_samples.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/record_views.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review::desk_admin_test {
namespace {

namespace fs = std::filesystem;

class DeskAdmin : public DeskTest {
 protected:
  DeskAdmin() { make_gate({}, desk_routes()); }
  Visitor local() {
    const Answer page = ask("GET", "/curriculum");
    return {cookie_of(page), field_of(page.response.body, "token")};
  }
  std::string page(const std::string& path, const Visitor& visitor, int status = 200) {
    const Answer answer = ask("GET", path, visitor);
    EXPECT_EQ(answer.response.status, status) << path << answer.response.body.substr(0, 500);
    return answer.response.body;
  }
  static std::string account_form(const std::string& login, const std::string& role, const std::string& password,
                                  const std::string& trainee = "") {
    return "login=" + login + "&name=Kim+Long&role=" + role + "&trainee=" + trainee +
           "&password=" + percent_encoded(password) + "&again=" + percent_encoded(password);
  }
};

TEST_F(DeskAdmin, PagesAreForAdministratorsOnly) {
  add_accounts();
  const Visitor adam = signed_in("adam"), ines = signed_in("ines"), anna = signed_in("anna");
  int pages = 0, forms = 0;
  for (const Route& route : desk_routes()) {
    if (route.audience != Audience::kAdministrators) continue;
    std::string path = route.path;
    if (const std::size_t at = path.find("{login}"); at != std::string::npos) path.replace(at, 7, "ines");
    const Answer no_one = ask(route.method, path), trainee = ask(route.method, path, anna),
                 instructor = ask(route.method, path, ines);
    EXPECT_EQ(no_one.response.status, 401) << route.method << path;
    EXPECT_EQ(trainee.response.status, 403) << route.method << path;
    EXPECT_EQ(instructor.response.status, 403) << route.method << path;
    const int status = ask(route.method, path, {adam.cookie, ""}).response.status;
    if (route.method == "POST") {
      EXPECT_EQ(status, 403) << path << ": without the form's token";
      ++forms;
    } else {
      EXPECT_TRUE(status == 200 || status == 303) << path << " " << status;
      ++pages;
    }
  }
  EXPECT_EQ(pages, 10);
  EXPECT_EQ(forms, 8);
  EXPECT_NE(page("/", adam).find("/sign-out"), std::string::npos);
  EXPECT_NE(page("/", adam).find("href=\"/accounts\""), std::string::npos);
  EXPECT_EQ(page("/", ines).find("href=\"/accounts\""), std::string::npos) << "no link to what is not allowed";
}

TEST_F(DeskAdmin, WithoutAccountsTheLocalInstructorMakesTheFirstAndItIsAnAdministrators) {
  const Visitor here = local();
  const std::string before = page("/accounts", here);
  EXPECT_NE(before.find("Nobody signs in here yet"), std::string::npos);
  EXPECT_EQ(before.find("/sign-out"), std::string::npos) << "signing out would do nothing";
  EXPECT_NE(before.find("Local instructor"), std::string::npos);
  EXPECT_EQ(ask("POST", "/accounts", here, account_form("kim", "instructor", kPassword)).response.status, 400);
  EXPECT_TRUE(AccountStore(database_).list().empty());
  EXPECT_EQ(ask("POST", "/accounts", here, account_form("kim", "administrator", kPassword)).response.status, 303);
  EXPECT_EQ(ask("GET", "/accounts", here).response.status, 401) << "from now on everybody signs in";
  EXPECT_NE(page("/accounts", signed_in("kim")).find("Kim Long"), std::string::npos);
}

TEST_F(DeskAdmin, AccountsAreAddedDisabledEnabledAndGivenPasswords) {
  add_accounts();
  TraineeStore(database_).ensure_trainee("T-new");
  const Visitor adam = signed_in("adam");
  EXPECT_EQ(ask("POST", "/accounts", adam, account_form("new", "trainee", "135791", "T-new")).response.location,
            "/accounts#accounts");
  EXPECT_EQ(AccountStore(database_).find("new")->trainee_code, "T-new");
  EXPECT_TRUE(AccountStore(database_).verify("new", "135791"));
  EXPECT_EQ(ask("POST", "/accounts/new/password", adam, "password=246802").response.status, 303);
  EXPECT_TRUE(AccountStore(database_).verify("new", "246802"));
  EXPECT_EQ(ask("POST", "/accounts/ines/disable", adam).response.status, 303);
  EXPECT_FALSE(AccountStore(database_).verify("ines", kPassword));
  EXPECT_NE(page("/accounts", adam).find("/accounts/ines/enable"), std::string::npos);
  EXPECT_EQ(ask("POST", "/accounts/ines/enable", adam).response.status, 303);
  EXPECT_TRUE(AccountStore(database_).verify("ines", kPassword));
  const AuditView trail = audit_view(database_, {AccountStore(database_).find("adam")->uuid, "", 1});
  EXPECT_EQ(trail.total, 5) << "what adam did stands under his name, the sign-in too";
  EXPECT_EQ(trail.entries[0].who, "Adam, adam");
}

TEST_F(DeskAdmin, ARefusedAccountComesBackWithItsFieldsButNoPassword) {
  add_accounts();
  const Visitor adam = signed_in("adam");
  const Answer taken = ask("POST", "/accounts", adam, account_form("ines", "instructor", "a password of mine"));
  EXPECT_EQ(taken.response.status, 400);
  EXPECT_NE(taken.response.body.find("Login &quot;ines&quot;: is taken."), std::string::npos) << taken.response.body;
  EXPECT_NE(taken.response.body.find("value=\"Kim Long\""), std::string::npos);
  EXPECT_EQ(taken.response.body.find("a password of mine"), std::string::npos);
  const Answer differ =
      ask("POST", "/accounts", adam, "login=kim&role=instructor&password=1234567890&again=1234567891");
  EXPECT_NE(differ.response.body.find("The two passwords differ."), std::string::npos);
  const Answer brief = ask("POST", "/accounts/ines/password", adam, "password=short");
  EXPECT_NE(brief.response.body.find("id=\"why-password-ines\""), std::string::npos);
  EXPECT_EQ(ask("POST", "/accounts/adam/disable", adam).response.status, 400) << "nobody shuts himself out";
  EXPECT_EQ(ask("POST", "/accounts/nobody/enable", adam).response.status, 400);
  EXPECT_TRUE(AccountStore(database_).verify("adam", kPassword));
}

TEST_F(DeskAdmin, ABackupThatTheDiskHasNoRoomForIsRefusedOnTheRecordsPage) {
  const fs::path recording = folder_ / "desk.recordings" / (annas_ + ".trec");
  fs::create_directories(recording.parent_path());
  std::ofstream(recording) << "motion";
  fs::resize_file(recording, fs::space(folder_).available + (1U << 30U));  // takes no room itself
  const Answer full = ask("POST", "/record/backup", local());
  EXPECT_EQ(full.response.status, 507);
  const std::size_t why = full.response.body.find("id=\"why-backup\"");
  ASSERT_NE(why, std::string::npos) << full.response.body;
  EXPECT_NE(full.response.body.find("Not done. desk.db.", why), std::string::npos) << "a file keeps its name";
  EXPECT_NE(full.response.body.find("give a place on a larger disk, or leave the recordings out.", why),
            std::string::npos);
  EXPECT_EQ(full.response.body.find(folder_.string()), std::string::npos);
  EXPECT_EQ(ask("POST", "/record/backup", local(), "leave=recordings").response.status, 303);
}

TEST_F(DeskAdmin, TheRecordIsCountedCheckedAndCopied) {
  desk_.sources.program = "9.8.7";
  const Visitor here = local();
  const std::string before = page("/record", here);
  for (const char* said :
       {"desk.db", "9.8.7", "none here", "<dt>attempts</dt><dd>4</dd>", "<dt>trainees</dt><dd>2</dd>"})
    EXPECT_NE(before.find(said), std::string::npos) << said;
  EXPECT_EQ(before.find(folder_.string()), std::string::npos) << "folders of the machine are nobody's business";
  const std::string sound = ask("POST", "/record/check", here).response.body;
  EXPECT_NE(sound.find("Sound: file"), std::string::npos) << sound;
  EXPECT_EQ(ask("POST", "/record/backup", here).response.location, "/record#backups");
  const RecordView view = record_view(database_, "");
  ASSERT_EQ(view.backups.size(), 1U);
  EXPECT_EQ(view.backups[0].utc.size(), 20U) << view.backups[0].utc;
  EXPECT_EQ(AttemptStore(database_).list().size(), 4U);
  fs::copy_file(folder_ / view.backups[0].name, folder_ / "copy.db");
  Database copy(folder_ / "copy.db");
  EXPECT_EQ(AttemptStore(copy).list().size(), 4U);
  EXPECT_EQ(page("/attempt/" + annas_, here).find("not as it was when it was finished"), std::string::npos);
  EXPECT_EQ(run_without_triggers(file_, "UPDATE attempt SET board = 99 WHERE uuid = '" + annas_ + "'"), "");
  const std::string broken = ask("POST", "/record/check", here).response.body;
  EXPECT_EQ(broken.find("Sound: file"), std::string::npos);
  EXPECT_NE(broken.find("Change nothing, keep the backups"), std::string::npos);
  EXPECT_EQ(broken.find("is missing: what is written now"), std::string::npos);
  EXPECT_NE(page("/attempt/" + annas_, here).find("not as it was when it was finished"), std::string::npos);
  fs::remove(key_path(file_));
  EXPECT_NE(page("/record", here).find("desk.db.key is missing: what is written now is not signed"), std::string::npos);
}

TEST_F(DeskAdmin, ACheckThatFindsThousandsOfProblemsStaysReadable) {
  RecordView view;
  view.problems = std::vector<std::string>(5000, "attempt x: was changed");
  const std::string said = record_page(view, {});
  EXPECT_NE(said.find("5000 problems"), std::string::npos);
  EXPECT_NE(said.find("and 4900 more"), std::string::npos);
  EXPECT_LT(said.size(), 20000U);
}

TEST_F(DeskAdmin, TheAuditTrailIsPagedAndFiltered) {
  add_accounts();
  const Visitor adam = signed_in("adam");
  for (int i = 0; i < 110; ++i)
    AssessmentStore(database_).add_note("T-anna", "", "note " + std::to_string(i), {"", "x"});
  const AuditView all = audit_view(database_, {}), notes = audit_view(database_, {"", "note added", 2});
  EXPECT_EQ(notes.total, 111);
  EXPECT_EQ(notes.entries.size(), 11U);
  EXPECT_GT(notes.entries.front().position, notes.entries.back().position) << "newest first";
  EXPECT_EQ(audit_view(database_, {"", "note added", 99}).asked.page, 2) << "there is no later page";
  EXPECT_EQ(audit_view(database_, {"' OR 1=1 --", "", 1}).total, 0);
  EXPECT_GT(all.total, notes.total);
  const std::string page_2 = page("/audit?action=note+added&page=2", adam);
  EXPECT_NE(page_2.find("111 entries"), std::string::npos);
  EXPECT_NE(page_2.find("Page 2 of 2"), std::string::npos);
  EXPECT_NE(page_2.find("/audit?action=note%20added&amp;page=1"), std::string::npos) << "the filter is kept";
  EXPECT_NE(page("/audit?page=x", adam).find("Page 1 of"), std::string::npos);
  EXPECT_NE(page("/audit?action=nothing", adam).find("No entry matches"), std::string::npos);
}

TEST_F(DeskAdmin, TheAuditTrailSaysWhatItIsAboutInWords) {
  add_accounts();
  const AttemptId attempt = store_attempt(database_, sample_start("T-9"), sample_result(80));
  AssessmentStore assessments(database_);
  const Author ines{AccountStore(database_).find("ines")->uuid, "Ines"};
  const std::string number = std::to_string(AttemptStore(database_).find(attempt.uuid).row);
  const std::string note = assessments.add_note("T-9", "", "Softer.", ines).uuid;
  const std::string signature = assessments.sign(attempt.uuid, "review", "", ines).uuid;
  const std::string certificate = assessments.certify("T-9", "surface-touch", "L1", "1", "{}", ines).uuid;
  std::map<std::string, std::pair<std::string, std::string>> seen;
  for (const AuditEntry& entry : audit_view(database_, {}).entries) seen[entry.subject] = {entry.words, entry.page};
  using Words = std::pair<std::string, std::string>;
  EXPECT_EQ(seen[attempt.uuid], Words("attempt no. " + number + " of T-9", "/attempt/" + attempt.uuid));
  EXPECT_EQ(seen[note], Words("note to T-9", "/trainee/T-9#notes"));
  EXPECT_EQ(seen[signature], Words("signature on no. " + number + " of T-9", "/attempt/" + attempt.uuid));
  EXPECT_EQ(seen[certificate], Words("certificate of T-9, surface-touch L1", "/trainee/T-9#certificates"));
  EXPECT_EQ(seen[AccountStore(database_).find("adam")->uuid], Words("account adam", "/accounts"));
  const std::string body = page("/audit", signed_in("adam"));
  EXPECT_NE(body.find(">signature on no. " + number + " of T-9</a>"), std::string::npos);
  EXPECT_EQ(body.find(">" + attempt.uuid + "<"), std::string::npos) << "no bare identifier";
  EXPECT_NE(body.find("title=\"" + attempt.uuid), std::string::npos) << "yet it can be had";
}

TEST_F(DeskAdmin, TheAuditTrailTellsAProgrammeFromRulesAndTheProgramFromPeople) {
  add_accounts();
  CurriculumStore curricula(database_);
  const std::string rules = curricula.add(kRulesName, "version = \"7\"\n", {"", "Ines"}).uuid;
  const std::string steps =
      curricula.add("Basics & more", "[[step]]\nexercise = \"pegs\"\nlevel = \"L1\"\npasses = 1\n", {"", "Ines"}).uuid;
  bool named = false, program = false;
  for (const AuditEntry& entry : audit_view(database_, {}).entries) {
    if (entry.subject == rules) {
      EXPECT_EQ(entry.words + " " + entry.page, "standard, version 1 /curriculum");
    }
    if (entry.subject == steps) {
      EXPECT_EQ(entry.words + " " + entry.page,
                "programme Basics & more, version 1 /programme?name=Basics%20%26%20more");
    }
    named = named || entry.named;
    program = program || !entry.named;
  }
  EXPECT_TRUE(program && !named) << "nobody with an account did anything yet";
  EXPECT_NE(page("/audit", signed_in("adam")).find(">the program</td>"), std::string::npos);
}

TEST_F(DeskAdmin, AnEntryThatTheStationDidNotSignIsMarked) {
  add_accounts();
  const Visitor adam = signed_in("adam");
  EXPECT_EQ(page("/audit", adam).find("not signed by the station"), std::string::npos);
  ASSERT_EQ(run_outside(file_,
                        "INSERT INTO audit SELECT position + 1, utc, actor, 'certificate added', 'x', 'x', row_hash,"
                        " 'x', signature FROM audit ORDER BY position DESC LIMIT 1"),
            "");
  const std::string body = page("/audit", adam);
  const std::size_t at = body.find("not signed by the station");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(body.find("not signed by the station", at + 1), std::string::npos) << "the others are signed";
}

TEST_F(DeskAdmin, TheRecordsPageTellsAClockThatWentBackBeforeAnybodyChecks) {
  const auto said = [this] { return record_page(record_view(database_, "0.1.0"), {}); };
  EXPECT_EQ(said().find("was set back"), std::string::npos);
  sql::execute(database_.connection(), "DROP TRIGGER audit_no_update");
  sql::execute(database_.connection(),
               "UPDATE audit SET utc = '2020-01-01T00:00:00.000Z' WHERE position = (SELECT max(position) FROM audit)");
  EXPECT_NE(said().find("The clock of this machine was set back 1 time."), std::string::npos);
}

TEST_F(DeskAdmin, RetentionIsLookedAtAndErasesNobody) {
  const Visitor here = local();
  EXPECT_NE(page("/retention", here).find("Nobody: every trainee was here within 730 days"), std::string::npos);
  const RetentionView late = retention_view(database_, "30", "2036-01-01T00:00:00Z");
  ASSERT_EQ(late.lines.size(), 2U);
  EXPECT_EQ(late.lines[0].code, "T-anna");
  EXPECT_EQ(late.lines[0].attempts, 2);
  for (const char* days : {"0", "-1", "x", "1e9", "99999"}) page(std::string("/retention?days=") + days, here, 400);
  EXPECT_EQ(TraineeStore(database_).list().size(), 2U);
  EXPECT_EQ(ask("POST", "/retention", here).response.status, 405) << "there is no button for it";
}

TEST_F(DeskAdmin, TheDemoGoesAfterAQuestionAndByAdministratorsAlone) {
  int removed = 0;
  desk_.demo = true;
  EXPECT_EQ(page("/", local()).find("/demo/remove"), std::string::npos) << "no way to remove it, no button";
  desk_.sources.remove_demo = [&removed] {
    ++removed;
    return "/x/removed-demo";
  };
  EXPECT_NE(page("/", local()).find("href=\"/demo/remove\""), std::string::npos);
  EXPECT_NE(page("/demo/remove", local()).find("Remove the demo?"), std::string::npos);
  EXPECT_EQ(removed, 0);
  const Answer gone = ask("POST", "/demo/remove", local());
  EXPECT_EQ(gone.response.status, 200);
  EXPECT_NE(gone.response.body.find("The demo is removed"), std::string::npos);
  EXPECT_NE(gone.response.body.find("/x/removed-demo"), std::string::npos);
  EXPECT_EQ(gone.response.body.find("<nav"), std::string::npos) << "there is nowhere left to go";
  EXPECT_EQ(removed, 1);
  desk_.sources.remove_demo = []() -> std::string { throw InputError("/home/x/demo.db: holds no demo cohort"); };
  EXPECT_NE(ask("POST", "/demo/remove", local()).response.body.find("demo.db: holds no demo cohort."),
            std::string::npos);
  add_accounts();
  EXPECT_EQ(page("/", signed_in("ines")).find("/demo/remove"), std::string::npos);
  desk_.demo = false;
  EXPECT_EQ(ask("POST", "/demo/remove", signed_in("adam")).response.status, 400) << "a real record is never removed so";
}

}  // namespace
}  // namespace trocar::review::desk_admin_test
