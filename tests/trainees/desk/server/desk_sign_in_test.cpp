// Signing in and out, the station's own instructor, and what ends a session besides time.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/integrity/station_key.h"
#include "trainees/markup/html.h"
#include "trainees/store/disk_full.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review::desk_sign_in_test {
namespace {

class DeskSignIn : public DeskTest {
 protected:
  int staff_page(const Visitor& visitor) { return ask("GET", "/staff/x", visitor).response.status; }
};

TEST_F(DeskSignIn, TheRightPasswordOpensTheDesk) {
  add_accounts();
  make_gate();
  const Visitor before = stranger();
  const Answer answer = try_sign_in("ines", kPassword, before);
  EXPECT_EQ(answer.response.status, 303);
  EXPECT_EQ(header_of(*gate_, answer, "Location"), "/");
  EXPECT_NE(cookie_of(answer), before.cookie) << "a number that was known before would be somebody else's to choose";
  EXPECT_EQ(ask("GET", "/staff/x", {cookie_of(answer), ""}).response.body, "page for ines\n");
  EXPECT_EQ(staff_page(before), 401);
  EXPECT_EQ(header_of(*gate_, try_sign_in("anna", kPassword, stranger()), "Location"), "/trainee/T-anna");
}

TEST_F(DeskSignIn, CookiesAreOutOfReach) {
  add_accounts();
  make_gate({.cookie = "trocar_desk_8642"});
  const std::string plain = ask("GET", "/sign-in").cookie;
  EXPECT_TRUE(plain.starts_with("trocar_desk_8642=")) << plain;
  EXPECT_TRUE(plain.ends_with("; Path=/; HttpOnly; SameSite=Strict")) << plain;
  make_gate({.secure = true, .cookie = "trocar_desk_8642"});
  const std::string secure = ask("GET", "/sign-in").cookie;
  EXPECT_TRUE(secure.starts_with("__Host-trocar_desk_8642=")) << secure;
  EXPECT_TRUE(secure.ends_with("; Path=/; HttpOnly; SameSite=Strict; Secure")) << secure;
  EXPECT_EQ(secure.find("Domain"), std::string::npos);
}

TEST_F(DeskSignIn, WrongOnesAreTurnedAwayAlike) {
  add_accounts();
  make_gate();
  std::string first;
  for (const auto& [login, password] : std::vector<std::pair<std::string, std::string>>{
           {"ines", "wrong"}, {"nobody", kPassword}, {"ines", ""}, {"' OR 1=1 --", "x"}}) {
    const Answer answer = try_sign_in(login, password, stranger());
    EXPECT_EQ(answer.response.status, 401) << login;
    EXPECT_NE(answer.response.body.find("Login or password is wrong."), std::string::npos);
    EXPECT_EQ(staff_page({cookie_of(answer), ""}), 401);
    EXPECT_EQ(answer.response.body.find(kPassword), std::string::npos) << "a password never comes back";
  }
}

TEST_F(DeskSignIn, TooManyTriesWait) {
  add_accounts();
  make_gate();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(try_sign_in("ines", "wrong", stranger()).response.status, 401);
  const Answer late = try_sign_in("ines", kPassword, stranger());
  EXPECT_EQ(late.response.status, 429) << "even the right one";
  EXPECT_EQ(header_of(*gate_, late, "Retry-After"), "30");
  address_ = "10.0.0.8";
  EXPECT_EQ(try_sign_in("Ines", kPassword, stranger()).response.status, 303) << "from elsewhere she is let in";
  address_ = "10.0.0.7";
  EXPECT_EQ(try_sign_in("adam", kPassword, stranger()).response.status, 429) << "from there nobody is";
  now_ += std::chrono::seconds(31);
  EXPECT_EQ(try_sign_in("ines", kPassword, stranger()).response.status, 303);
}

TEST_F(DeskSignIn, TheFormNeedsItsToken) {
  add_accounts();
  make_gate();
  const Visitor one = stranger(), other = stranger();
  EXPECT_EQ(try_sign_in("ines", kPassword, {one.cookie, other.token}).response.status, 403);
  EXPECT_EQ(try_sign_in("ines", kPassword, {one.cookie, ""}).response.status, 403);
  EXPECT_EQ(try_sign_in("ines", kPassword, {"", one.token}).response.status, 403);
  EXPECT_EQ(ask("POST", "/sign-in", one, "login=ines&password=correct+horse+battery", {"Sec-Fetch-Site: cross-site"})
                .response.status,
            403);
  EXPECT_EQ(try_sign_in("ines", kPassword, one).response.status, 303);
}

TEST_F(DeskSignIn, LeadsBackToWhereOneWanted) {
  add_accounts();
  make_gate();
  const Answer asked = ask("GET", "/staff/x?sort=last&state=stuck");
  EXPECT_EQ(asked.response.status, 401);
  EXPECT_EQ(field_of(asked.response.body, "next"), "/staff/x?sort=last&amp;state=stuck");
  EXPECT_EQ(header_of(*gate_, try_sign_in("ines", kPassword, stranger(), "/staff/x?sort=last"), "Location"),
            "/staff/x?sort=last");
  for (const char* elsewhere :
       {"//evil.example", "https://evil.example", "/\\evil.example", "/a\r\nSet-Cookie: x=1", "/sign-out", "x"}) {
    EXPECT_EQ(header_of(*gate_, try_sign_in("ines", kPassword, stranger(), elsewhere), "Location"), "/") << elsewhere;
  }
}

TEST_F(DeskSignIn, SigningOutEndsIt) {
  add_accounts();
  make_gate();
  const Visitor ines = signed_in("ines"), elsewhere = signed_in("ines");
  EXPECT_EQ(ask("GET", "/sign-out", ines).response.status, 405);
  EXPECT_EQ(ask("POST", "/sign-out", {ines.cookie, "x"}).response.status, 403);
  EXPECT_EQ(staff_page(ines), 200);
  const Answer out = ask("POST", "/sign-out", ines);
  EXPECT_EQ(out.response.status, 303);
  EXPECT_NE(out.cookie.find("Max-Age=0"), std::string::npos);
  EXPECT_EQ(staff_page(ines), 401);
  EXPECT_EQ(staff_page(elsewhere), 200) << "another browser stays signed in";
}

TEST_F(DeskSignIn, ChangesOfTheAccountEndItsSessions) {
  add_accounts();
  make_gate();
  const Visitor ines = signed_in("ines"), adam = signed_in("adam");
  AccountStore accounts(database_);
  accounts.add("eva", "Eva", Role::kAdministrator, "", kPassword, "");  // the last one cannot be disabled
  accounts.set_password("ines", "another long password", "");
  EXPECT_EQ(staff_page(ines), 401);
  accounts.set_disabled("adam", true, "");
  EXPECT_EQ(ask("GET", "/admin", adam).response.status, 401);
  EXPECT_EQ(try_sign_in("adam", kPassword, stranger()).response.status, 401);
  accounts.set_disabled("adam", false, "");
  EXPECT_EQ(ask("GET", "/admin", adam).response.status, 401) << "an ended session does not come back";
}

TEST_F(DeskSignIn, TheStationsOwnUserNeedsNoAccount) {
  make_gate();
  const Answer first = ask("GET", "/admin");
  EXPECT_EQ(first.response.body, "page for local\n");
  const Visitor local{cookie_of(first), ""};
  EXPECT_EQ(ask("POST", "/admin", local).response.status, 403) << "a token is asked of him as of everybody";
  EXPECT_EQ(ask("POST", "/admin").response.status, 401) << "what is posted opens no session";
  const Visitor with_token{local.cookie, field_of(ask("GET", "/sign-in", local).response.body, "token")};
  EXPECT_EQ(ask("POST", "/admin", with_token).response.status, 200);
  same_user_ = false;
  EXPECT_EQ(ask("GET", "/admin").response.status, 401) << "another user of the machine";
  EXPECT_EQ(ask("GET", "/admin", local).response.status, 200) << "who has the number is the one who got it";
}

TEST_F(DeskSignIn, TheFirstAccountClosesTheOpenDesk) {
  make_gate();
  const Visitor local{cookie_of(ask("GET", "/admin")), ""};
  add_accounts();
  EXPECT_EQ(ask("GET", "/admin", local).response.status, 401);
  EXPECT_EQ(ask("GET", "/admin").response.status, 401);
}

TEST_F(DeskSignIn, OnTheNetworkNobodyIsLocal) {
  make_gate({.lan = true});
  const Answer answer = ask("GET", "/admin");
  EXPECT_EQ(answer.response.status, 401);
  EXPECT_NE(answer.response.body.find("trocar review account add"), std::string::npos) << "says what to do";
}

TEST_F(DeskSignIn, LogsWhoWithoutWhat) {
  add_accounts();
  make_gate();
  try_sign_in("ines", "my secret password", stranger());
  try_sign_in("evil\nsigned in: adam", "x", stranger());
  signed_in("adam");
  ASSERT_EQ(log_.size(), 3U);
  EXPECT_EQ(log_[0], "sign-in refused: ines from 10.0.0.7");
  EXPECT_EQ(log_[1], "sign-in refused: evil?signed?in:?adam from 10.0.0.7");
  EXPECT_EQ(log_[2], "signed in: adam from 10.0.0.7");
}

/// Entries about coming and going, "action login" each.
std::vector<std::string> comings(Database& database) {
  std::vector<std::string> out;
  sql::Statement rows(
      database.connection(),
      "SELECT u.action || ' ' || coalesce(a.login, 'nobody') || ' by ' || coalesce(b.login, u.actor) || u.detail"
      " FROM audit u LEFT JOIN account a ON a.uuid = u.subject LEFT JOIN account b ON b.uuid = u.actor"
      " WHERE u.action LIKE 'sign%' AND u.action NOT LIKE 'signature%' ORDER BY u.position");
  while (rows.step()) out.push_back(rows.text(0));
  return out;
}

TEST_F(DeskSignIn, ComingAndGoingIsOnRecord) {
  add_accounts();
  make_gate();
  const Visitor ines = signed_in("ines");
  signed_in("anna");
  EXPECT_EQ(ask("POST", "/sign-out", ines, "token=" + ines.token).response.status, 303);
  EXPECT_EQ(ask("POST", "/sign-out", ines, "token=" + ines.token).response.status, 303) << "out already";
  EXPECT_EQ(comings(database_),
            (std::vector<std::string>{"signed in ines by ines", "signed in anna by anna", "signed out ines by ines"}));
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskSignIn, ManyWrongTriesLeaveOneEntry) {
  add_accounts();
  make_gate();
  for (int i = 0; i < 4; ++i) try_sign_in("ines", "wrong", stranger());
  EXPECT_TRUE(comings(database_).empty()) << "somebody who mistypes";
  for (int i = 0; i < 500; ++i) try_sign_in("ines", "wrong", stranger());
  EXPECT_EQ(comings(database_), std::vector<std::string>{"sign-in held back ines by trocar"});
  now_ += std::chrono::hours(2);
  address_ = "10.0.0.9";
  for (int i = 0; i < 8; ++i) try_sign_in("nobody-" + std::to_string(i), "wrong", stranger());
  EXPECT_EQ(comings(database_).size(), 2u);
  EXPECT_EQ(comings(database_).back(), "sign-in held back nobody by trocar")
      << "a login that does not exist is not written down";
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskSignIn, UnderAnotherKeyNoTryCountsAndThePageSaysWhy) {
  add_accounts();
  make_gate();
  const Visitor visitor = stranger();
  const std::filesystem::path own = key_path(file_), away = folder_ / "away.key";
  std::filesystem::rename(own, away);
  write_station_key(file_, SigningKey::make());
  const std::string why =
      "Nobody can sign in to this record now: its key desk.db.key is not the one that signs this record";
  for (int i = 0; i < 8; ++i) {
    const Answer answer = try_sign_in("ines", i % 2 == 0 ? kPassword : "wrong", visitor);
    EXPECT_EQ(answer.response.status, 503);
    EXPECT_NE(answer.response.body.find(why), std::string::npos) << answer.response.body;
  }
  EXPECT_NE(ask("GET", "/sign-in", visitor).response.body.find(why), std::string::npos) << "before anybody tries";
  std::ofstream(folder_ / "no.key") << "no key";
  std::filesystem::rename(folder_ / "no.key", own);
  EXPECT_NE(try_sign_in("ines", kPassword, visitor).response.body.find("its key cannot be read"), std::string::npos);
  EXPECT_EQ(ask("GET", "/sign-in", visitor).response.status, 200);
  std::filesystem::rename(away, own);
  EXPECT_TRUE(comings(database_).empty());
  EXPECT_EQ(problems_of(database_), "");
  EXPECT_EQ(try_sign_in("ines", kPassword, visitor).response.status, 303) << "no try counted";
  std::filesystem::remove(own);
  EXPECT_EQ(try_sign_in("ines", kPassword, stranger()).response.status, 303) << "without a key people read";
}

TEST_F(DeskSignIn, WhoWaitsForPagesIsTheAccountOrTheAddress) {
  add_accounts();
  make_gate();
  const auto turn = [&](const std::string& cookie, const std::string& address) {
    RequestHead head;
    head.headers["cookie"] = cookie;
    return gate_->turn(head, address);
  };
  const Visitor one = signed_in("ines"), other = signed_in("ines");
  EXPECT_EQ(turn(one.cookie, "10.0.0.1"), turn(other.cookie, "10.0.0.2")) << "however many browsers";
  EXPECT_NE(turn(one.cookie, "10.0.0.1"), turn(signed_in("anna").cookie, "10.0.0.1"));
  EXPECT_EQ(turn(stranger().cookie, "10.0.0.1"), turn("", "10.0.0.1")) << "a number that anybody may make up";
  EXPECT_NE(turn("", "10.0.0.1"), turn("", "10.0.0.2"));
}

TEST_F(DeskSignIn, WhatCannotBeRecordedDoesNotHappen) {
  add_accounts();
  make_gate();
  const Visitor visitor = stranger();
  sql::execute(database_.connection(), "PRAGMA query_only = ON");
  const Answer answer = try_sign_in("ines", kPassword, visitor);
  EXPECT_EQ(answer.response.status, 503);
  EXPECT_EQ(staff_page({cookie_of(answer), ""}), 401);
  sql::execute(database_.connection(), "PRAGMA query_only = OFF");
  EXPECT_EQ(try_sign_in("ines", kPassword, visitor).response.status, 303);
}

/// No page more, and what room the pages have is used up.
void fill_disk(Database& database) {
  sqlite3* connection = database.connection();
  const std::string most = std::to_string(sql::query_integer(connection, "PRAGMA page_count"));
  sql::query_integer(connection, "PRAGMA max_page_count = " + most);
  const auto write = [&] {
    for (;;) AccountStore(database).signed_out("");
  };
  EXPECT_NE(message_of<DiskFull>(write).find("full"), std::string::npos);
}

TEST_F(DeskSignIn, AFullDiskLetsPeopleInToReadAndIsCalledThat) {
  add_accounts();
  make_gate({}, desk_routes());
  fill_disk(database_);
  const Answer in = try_sign_in("ines", kPassword, stranger());
  EXPECT_EQ(in.response.status, 303);
  const std::string cookie = cookie_of(in), page = ask("GET", "/attempt/" + annas_, {cookie, ""}).response.body;
  EXPECT_NE(page.find("Sign-off"), std::string::npos);
  const Visitor ines{cookie, field_of(page, "token")};
  const std::string note = "text=" + std::string(200, 'n') + "+with+an+end";
  const Answer refused = ask("POST", "/attempt/" + annas_ + "/note", ines, note);
  EXPECT_EQ(refused.response.status, 507);
  EXPECT_NE(refused.response.body.find("disk of this machine is full"), std::string::npos);
  EXPECT_NE(refused.response.body.find("nnn with an end</textarea>"), std::string::npos)
      << "what was typed stands in the form";
  EXPECT_EQ(ask("POST", "/curriculum/group", ines, "code=T-anna&group=autumn").response.status, 507);
  EXPECT_EQ(ask("GET", "/", ines).response.status, 200) << "and it is read on";
  sql::query_integer(database_.connection(), "PRAGMA max_page_count = 1000000");
  EXPECT_EQ(ask("POST", "/attempt/" + annas_ + "/note", ines, note).response.status, 303);
  EXPECT_EQ(sql::query_integer(database_.connection(), "SELECT count(*) FROM audit WHERE action = 'signed in'"), 1)
      << "whoever came while it was full is put on record before anything is written";
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskSignIn, AFullDiskGivesEveryFormBackToBeSentAgain) {
  add_accounts();
  make_gate({}, desk_routes());
  fill_disk(database_);
  const std::string cookie = cookie_of(try_sign_in("adam", kPassword, stranger()));
  const Visitor adam{cookie, field_of(ask("GET", "/accounts", {cookie, ""}).response.body, "token")};
  for (const auto& [path, sent] : std::vector<std::pair<std::string, std::string>>{
           {"/roster/add", "code=T-77&name=Ann+%22Lee%22&email=ann%40clinic.example&group=autumn"},
           {"/roster/person?code=T-anna", "name=Ann+Lee&email=ann%40clinic.example"},
           {"/roster/import", "do=take&csv=code,name%0D%0AT-77,Ann&group=autumn"},
           {"/programmes/assign", "programme=course&trainee=T-anna&due=2027-05-01"},
           {"/programme", "do=save&name=course&exercise.1=surface-touch&passes.1=3"},
           {"/curriculum/group", "do=join&trainee=T-anna&group=autumn"},
           {"/accounts", "login=kim&name=Kim&role=instructor&password=a+word+of+mine&again=a+word+of+mine"}}) {
    const Answer full = ask("POST", path, adam, sent);
    const std::string& page = full.response.body;
    EXPECT_EQ(full.response.status, 507) << path;
    EXPECT_NE(page.find("action=\"" + path + "\""), std::string::npos) << page;
    EXPECT_EQ(field_of(page, "token"), adam.token);
    EXPECT_EQ(page.find("word of mine"), std::string::npos) << "a password never comes back";
    const auto fields = form_fields(sent);
    for (const auto& [name, value] : *fields) {
      if (name == "password" || name == "again")
        EXPECT_NE(page.find("<input name=\"" + name + "\" type=\"password\""), std::string::npos) << page;
      else
        EXPECT_EQ(field_of(page, name), escape_html(value)) << path;
    }
    EXPECT_TRUE(path != "/roster/import" || page.find("csv:\ncode,name") != std::string::npos) << "and to be copied";
  }
  for (const char* path : {"/accounts", "/password", "/sign-in"}) {
    const std::string page = ask("GET", path, adam).response.body;
    const std::size_t input = page.find("type=\"password\"");
    ASSERT_NE(input, std::string::npos) << path;
    for (std::size_t at = input; at != std::string::npos; at = page.find("type=\"password\"", at + 1)) {
      const std::size_t name = page.rfind("name=\"", at) + 6;
      EXPECT_EQ(prose_of({{page.substr(name, page.find('"', name) - name), "x"}}), "") << path;
    }
  }
}

}  // namespace
}  // namespace trocar::review::desk_sign_in_test
