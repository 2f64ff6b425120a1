// The roster through the gate: people added, lists looked at and taken, many put into a group at once, PINs.
#include <gtest/gtest.h>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/records/curricula.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review::desk_roster_test {
namespace {

class DeskRoster : public DeskTest {
 protected:
  DeskRoster() {
    make_gate({}, desk_routes());
    add_accounts();
    ines_ = signed_in("ines");
  }
  /// The page is sound.
  std::string page(const std::string& path, const Visitor& visitor) {
    return sound(path, ask("GET", path, visitor), visitor);
  }
  std::string sound(const std::string& what, const Answer& answer, const Visitor& visitor, int status = 200) {
    EXPECT_EQ(answer.response.status, status) << what << answer.response.body.substr(0, 800);
    EXPECT_EQ(check_page(answer.response.body, visitor.token).problems, std::vector<std::string>{}) << what;
    return answer.response.body;
  }
  Answer post(const std::string& path, const std::string& body) { return ask("POST", path, ines_, body); }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
  Visitor ines_;
};

TEST_F(DeskRoster, ListsPeopleWithGroupsAndState) {
  CurriculumStore(database_).join("T-anna", "2026 <A>", {"", "x"});
  StandingStore(database_).set_active({"T-otto"}, false, "left", {"", "x"});
  const std::string active = page("/roster", ines_);
  EXPECT_TRUE(has(active, "T-anna") && has(active, "2026 &lt;A&gt;") && has(active, "1 deactivated"));
  EXPECT_FALSE(has(active, "/trainee/T-otto"));
  EXPECT_TRUE(has(page("/roster?who=deactivated", ines_), "/trainee/T-otto"));
  EXPECT_TRUE(has(page("/roster?who=all&group=2026+%3CA%3E", ines_), "1 person"));
  EXPECT_TRUE(has(page("/roster?group=none", ines_), "Nobody matches"));
  EXPECT_FALSE(has(active, "/roster/pins")) << "that is an administrator's";
  EXPECT_TRUE(has(page("/roster", signed_in("adam")), "/roster/pins"));
  const Answer file = ask("GET", "/roster.csv?who=all", ines_);
  EXPECT_TRUE(has(file.response.body, "code,name,email,group,all_groups")) << file.response.body;
  EXPECT_TRUE(has(file.response.body, "T-otto,,,,,2,")) << file.response.body;
}

TEST_F(DeskRoster, APersonIsAddedRenamedAndNotTwice) {
  EXPECT_EQ(post("/roster/add", "code=K-7&name=%E6%9D%8E+%22Li%22&email=&group=2026").response.status, 303);
  EXPECT_EQ(TraineeStore(database_).find("K-7")->name, "\xE6\x9D\x8E \"Li\"");
  const std::string again = sound("add", post("/roster/add", "code=k-7&name=Kim"), ines_, 400);
  EXPECT_TRUE(has(again, "is there already") && has(again, "value=\"Kim\"")) << again;
  EXPECT_EQ(post("/roster/add", "code=a+b").response.status, 400);
  page("/roster/person?code=K-7", ines_);
  const std::string seen = "seen_name=%E6%9D%8E+%22Li%22&seen_email=&";
  EXPECT_EQ(post("/roster/person?code=K-7", seen + "name=Li+Na&email=li%40example.org").response.status, 303);
  EXPECT_EQ(TraineeStore(database_).find("K-7")->email, "li@example.org");
  EXPECT_TRUE(
      has(sound("edit", post("/roster/person?code=K-7", "name=Li&email=none"), ines_, 400), "name@example.org"));
  EXPECT_EQ(post("/roster/person?code=nobody", "name=Li&email=").response.status, 400);
  EXPECT_EQ(ask("GET", "/roster/person?code=nobody", ines_).response.status, 404);
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskRoster, WhatSomebodySavedOfAPersonMeanwhileIsNotOverwritten) {
  const std::string path = "/roster/person?code=T-otto", opened = page(path, ines_);
  EXPECT_EQ(field_of(opened, "seen_name") + field_of(opened, "seen_email"), "");
  const std::string first = "seen_name=&seen_email=&name=Otto&email=otto%40example.org";
  EXPECT_EQ(post(path, first).response.status, 303);
  EXPECT_EQ(post(path, first).response.status, 303) << "the same again is no loss";
  const std::string late = sound("late", post(path, "seen_name=&seen_email=&name=Otto+Ohm&email="), ines_, 400);
  EXPECT_TRUE(
      has(late, "was saved meanwhile with the name &quot;Otto&quot; and the e-mail address &quot;otto@example.org"))
      << late;
  EXPECT_TRUE(has(late, "value=\"Otto Ohm\"")) << "what was typed stays";
  EXPECT_EQ(field_of(late, "seen_email"), "") << "saying it twice does not help";
  EXPECT_EQ(TraineeStore(database_).find("T-otto")->email, "otto@example.org");
  const std::string again = page(path, ines_);
  EXPECT_EQ(field_of(again, "seen_name") + field_of(again, "seen_email"), "Ottootto@example.org");
  EXPECT_EQ(post(path, "seen_name=Otto&seen_email=otto%40example.org&name=Otto&email=").response.status, 303);
  EXPECT_EQ(TraineeStore(database_).find("T-otto")->email, "");
}

TEST_F(DeskRoster, AListIsLookedAtBeforeItIsTaken) {
  page("/roster/import", ines_);
  std::string csv = "Code;Name;E-Mail\r\n";
  for (int i = 1; i <= 30; ++i) csv += "N-" + std::to_string(i) + ";\"Person; " + std::to_string(i) + "\";\r\n";
  csv += "T-anna;Anna;\r\nbad code;x;\r\n";
  const std::string form = "csv=" + percent_encoded(csv) + "&group=2026+B&do=";
  const std::string seen = sound("look", post("/roster/import", form + "look"), ines_);
  EXPECT_TRUE(has(seen, "30 added, 1 there already, joining the group, 1 refused")) << seen;
  EXPECT_TRUE(has(seen, "refused<br/><small>")) << "the reason stands where it is seen";
  EXPECT_TRUE(has(seen, "class=\"long\" translate=\"no\">")) << "a long address breaks";
  EXPECT_TRUE(has(seen, "Nothing is written yet") && has(seen, "Add 30 people, 1 into their group"));
  EXPECT_EQ(TraineeStore(database_).list().size(), 2U);
  const std::string done = sound("take", post("/roster/import", form + "take"), ines_);
  EXPECT_TRUE(has(done, "Done.") && has(done, "name=\"p:N-30\""));
  EXPECT_EQ(TraineeStore(database_).list().size(), 32U);
  EXPECT_EQ(CurriculumStore(database_).members("2026 B").size(), 31U);
  EXPECT_EQ(TraineeStore(database_).find("N-3")->name, "Person; 3");
  const std::string again = sound("again", post("/roster/import", form + "take"), ines_);
  EXPECT_TRUE(has(again, "31 there already and skipped"));
  EXPECT_EQ(TraineeStore(database_).list().size(), 32U);
  EXPECT_TRUE(has(sound("bad", post("/roster/import", "csv=code%0A%22x&do=look"), ines_, 400), "List:2:1: a quote"));
  EXPECT_TRUE(has(sound("no code", post("/roster/import", "csv=name%0Ax&do=look"), ines_, 400), "must be &quot;code"));
  EXPECT_EQ(sql::query_integer(database_.connection(),
                               "SELECT count(*) FROM audit WHERE action = 'group joined' AND actor = (SELECT uuid FROM "
                               "account WHERE login = 'ines')"),
            31)
      << "who did it stands in the trail";
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskRoster, ManyAreChangedAtOnce) {
  const std::string both = "p%3AT-anna=yes&p%3AT-otto=yes&";
  EXPECT_EQ(post("/roster/selected?group=x&who=all", both + "do=join&group=2026").response.location,
            "/roster?group=x&who=all#people");
  EXPECT_EQ(CurriculumStore(database_).members("2026").size(), 2U);
  EXPECT_EQ(post("/roster/selected", both + "do=leave&group=2026").response.status, 303);
  EXPECT_TRUE(CurriculumStore(database_).members("2026").empty());
  EXPECT_EQ(post("/roster/selected", both + "do=deactivate&reason=course+over").response.status, 303);
  EXPECT_EQ(StandingStore(database_).of("T-otto").reason, "course over");
  EXPECT_EQ(StandingStore(database_).of("T-otto").printed, "Ines");
  EXPECT_EQ(post("/roster/selected", both + "do=reactivate").response.status, 303);
  EXPECT_TRUE(StandingStore(database_).of("T-otto").active);
  EXPECT_TRUE(has(sound("nobody", post("/roster/selected", "do=join&group=2026"), ines_, 400), "Nobody is ticked"));
  EXPECT_TRUE(has(sound("no group", post("/roster/selected", both + "do=join"), ines_, 400), "say which"));
  EXPECT_EQ(post("/roster/selected", both + "do=erase").response.status, 400);
  EXPECT_EQ(post("/roster/selected", both + "p%3Anobody=yes&do=deactivate").response.status, 400);
  EXPECT_TRUE(StandingStore(database_).of("T-anna").active) << "all or none";
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskRoster, CardsCarryAPinOnlyWhereItWasGivenNow) {
  TraineeStore(database_).ensure_trainee("N-1");
  TraineeStore(database_).edit("N-1", "Nora <New>", std::nullopt, "");
  StandingStore(database_).set_active({"T-otto"}, false, "", {"", "x"});
  const std::string plain = sound("cards", post("/roster/selected", "p%3AN-1=yes&do=cards"), ines_);
  EXPECT_TRUE(has(plain, "Nora &lt;New&gt;") && has(plain, "carry no PIN"));
  EXPECT_EQ(post("/roster/pins", "p%3AN-1=yes").response.status, 403);
  const Visitor adam = signed_in("adam");
  const std::string cards =
      sound("pins", ask("POST", "/roster/pins", adam, "p%3AN-1=yes&p%3AT-anna=yes&p%3AT-otto=yes"), adam);
  const std::string mark = "PIN <strong class=\"key-in\">";
  const std::size_t at = cards.find(mark);
  ASSERT_NE(at, std::string::npos) << cards;
  const std::string pin = cards.substr(at + mark.size(), 6);
  const auto account = AccountStore(database_).of_trainee("N-1");
  ASSERT_TRUE(account);
  EXPECT_EQ(account->login, "N-1");
  EXPECT_EQ(account->name, "Nora <New>");
  EXPECT_TRUE(AccountStore(database_).verify("N-1", pin));
  EXPECT_FALSE(AccountStore(database_).verify("anna", kPassword)) << "a new PIN replaces what was";
  EXPECT_TRUE(has(cards, "is deactivated"));
  EXPECT_TRUE(AccountStore(database_).verify("otto", kPassword));
  std::string many;
  for (int i = 0; i < 101; ++i) many += "p%3AX-" + std::to_string(i) + "=yes&";
  EXPECT_TRUE(has(sound("many", ask("POST", "/roster/pins", adam, many), adam, 400), "At most 100") ||
              has(ask("POST", "/roster/pins", adam, many).response.body, "at most 100"));
}

}  // namespace
}  // namespace trocar::review::desk_roster_test
