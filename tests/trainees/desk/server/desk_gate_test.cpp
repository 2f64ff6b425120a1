// What stands before every page: names of the host, methods, forms of others, whose data; and what comes of pages that
// fail.
#include "trainees/desk/server/desk_gate.h"

#include <gtest/gtest.h>

#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/server/desk_accounts.h"

namespace trocar::review::desk_gate_test {
namespace {

class DeskGateTest : public DeskTest {
 protected:
  int status(const std::string& method, const std::string& target, const Visitor& visitor = {},
             const std::vector<std::string>& headers = {}) {
    return ask(method, target, visitor, "", headers).response.status;
  }
};

TEST_F(DeskGateTest, GoesByItsNamesOnly) {
  make_gate({.hosts = {"desk.clinic.example"}});
  for (const char* host : {"127.0.0.1:8642", "localhost:8642", "LOCALHOST:8642", "desk.clinic.example:8642"}) {
    EXPECT_EQ(status("GET", "/everybody", {}, {std::string("Host: ") + host}), 200) << host;
  }
  for (const char* host : {"evil.example:8642", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:8642:8642", "10.0.0.5:8642",
                           "127.0.0.1.evil.example:8642", ":8642", "localhost"}) {
    EXPECT_EQ(status("GET", "/everybody", {}, {std::string("Host: ") + host}), 421) << host;
  }
  local_address_ = "10.0.0.5";
  EXPECT_EQ(status("GET", "/everybody", {}, {"Host: 10.0.0.5:8642"}), 200) << "the address at which it was reached";
  EXPECT_EQ(status("GET", "/everybody", {}, {"Host: localhost:8642"}), 421);
}

TEST_F(DeskGateTest, KnowsItsMethods) {
  make_gate();
  EXPECT_EQ(status("HEAD", "/everybody"), 200);
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "CONNECT", "get"})
    EXPECT_EQ(status(method, "/everybody"), 405) << method;
  const Answer wrong = ask("POST", "/leads/T-anna");
  EXPECT_EQ(wrong.response.status, 405);
  EXPECT_EQ(header_of(*gate_, wrong, "Allow"), "GET");
}

TEST_F(DeskGateTest, HasNoPageOutsideTheList) {
  make_gate();
  for (const char* path : {"/nothing", "/../etc/passwd", "/everybody/../admin", "/%2e%2e/%2e%2e/etc/passwd",
                           "/..%2fetc%2fpasswd", "/everybody%00", "/everybody/", "/EVERYBODY", "//everybody",
                           "/.git/config", "/own/T-anna/../T-otto", "/own/T-anna%2f..%2fT-otto", "/own/%2e%2e"}) {
    EXPECT_EQ(status("GET", path), 404) << path;
  }
}

TEST_F(DeskGateTest, TakesFormsOfItsOwnPagesOnly) {
  add_accounts();
  make_gate();
  const Visitor adam = signed_in("adam");
  EXPECT_EQ(status("POST", "/admin", adam), 200);
  EXPECT_EQ(status("POST", "/admin", adam, {"Origin: null"}), 200) << "what browsers say where no referrer is allowed";
  EXPECT_EQ(status("POST", "/admin", adam, {"Origin: http://127.0.0.1:8642", "Sec-Fetch-Site: same-origin"}), 200);
  for (const char* header :
       {"Origin: http://evil.example", "Origin: https://127.0.0.1:8642", "Origin: http://127.0.0.1:8643",
        "Sec-Fetch-Site: cross-site", "Sec-Fetch-Site: same-site"}) {
    EXPECT_EQ(status("POST", "/admin", adam, {header}), 403) << header;
  }
  const auto head = parse_head(
      "POST /admin HTTP/1.1\r\nHost: 127.0.0.1:8642\r\nContent-Length: 2\r\nContent-Type: text/plain\r\nCookie: " +
      adam.cookie + "\r\n\r\n");
  EXPECT_EQ(
      gate_
          ->answer({.head = std::get<RequestHead>(head), .body = "{}", .address = "x", .local_address = "127.0.0.1"},
                   desk_)
          .response.status,
      415);
  EXPECT_EQ(ask("POST", "/admin", adam, "a=%zz").response.status, 400);
}

TEST_F(DeskGateTest, ReadsOneCookie) {
  add_accounts();
  make_gate();
  const Visitor adam = signed_in("adam");
  EXPECT_EQ(status("GET", "/admin", {"a=b; " + adam.cookie + ";c=d", ""}), 200);
  EXPECT_EQ(status("GET", "/admin", {adam.cookie + "; " + adam.cookie, ""}), 401)
      << "a cookie that stands twice was set by somebody else";
  EXPECT_EQ(status("GET", "/admin", {"x" + adam.cookie, ""}), 401);
  EXPECT_EQ(status("GET", "/admin", {adam.cookie + "x", ""}), 401);
  EXPECT_EQ(status("GET", "/admin", {adam.cookie.substr(0, adam.cookie.size() - 1), ""}), 401);
}

TEST_F(DeskGateTest, TraineesNameNobodyElse) {
  add_accounts();
  make_gate();
  const Visitor anna = signed_in("anna");
  const std::string own = "/own/T-anna";
  EXPECT_EQ(status("GET", own + "?with=" + annas_ + "&sort=score", anna), 200);
  EXPECT_EQ(status("GET", own + "?with=" + ottos_, anna), 403);
  EXPECT_EQ(status("GET", own + "?with=t-OTTO", anna), 403) << "codes are the same in any case";
  EXPECT_EQ(status("GET", "/own/t-anna", anna), 403);
  EXPECT_EQ(status("GET", own + "/attempt/" + ottos_, anna), 403);
  EXPECT_EQ(status("GET", "/own/T-otto/attempt/" + annas_, anna), 403);
  EXPECT_EQ(status("GET", "/own/attempt/latest", anna), 403) << "otto's";
  EXPECT_EQ(status("GET", "/own/attempt/" + annas_.substr(20), anna), 200) << "found by a part, and her own";
  EXPECT_EQ(status("GET", "/own/attempt/" + ottos_.substr(20), anna), 403);
  EXPECT_EQ(status("GET", "/own/attempt/" + annas_.substr(0, 4), anna), 403) << "fits several";
  EXPECT_EQ(status("GET", "/own", anna), 403) << "a page of nobody's in particular is the staff's";
  const std::string otto = AccountStore(database_).find("otto")->uuid;
  EXPECT_EQ(ask("POST", own, anna, "account=" + otto).response.status, 403);
  EXPECT_EQ(ask("POST", own, anna, "text=T-otto+and+I").response.status, 200)
      << "a note that mentions somebody is a note";
  EXPECT_EQ(status("GET", "/own/T-otto", signed_in("ines")), 200);
}

TEST_F(DeskGateTest, FailuresTellTraineesNothing) {
  add_accounts();
  make_gate();
  const Visitor anna = signed_in("anna"), ines = signed_in("ines");
  const auto body = [&](const std::string& kind, const Visitor& visitor) {
    return ask("GET", "/fails/" + kind + "/T-anna", visitor).response;
  };
  EXPECT_EQ(body("input", ines).status, 400);
  EXPECT_NE(body("input", ines).body.find("T-otto is &lt;b&gt;unknown&lt;/b&gt;"), std::string::npos);
  EXPECT_EQ(body("input", anna).body.find("T-otto"), std::string::npos);
  EXPECT_EQ(body("machine", ines).status, 503);
  EXPECT_NE(body("machine", ines).body.find("disk full"), std::string::npos);
  EXPECT_EQ(body("machine", anna).body.find("trocar.db"), std::string::npos);
  for (const char* kind : {"program", "status", "type"}) {
    EXPECT_EQ(body(kind, ines).status, 500) << kind;
    EXPECT_EQ(body(kind, ines).body.find("secret"), std::string::npos) << "what happened stands in the log";
  }
  EXPECT_EQ(log_.back().substr(0, 4), "GET ");
}

TEST_F(DeskGateTest, NoPageWritesHeaders) {
  make_gate();
  const Answer leads = ask("GET", "/leads/x"), saves = ask("GET", "/saves/x");
  EXPECT_EQ(header_of(*gate_, leads, "Location"), "/a%0D%0ASet-Cookie:%20evil=1");
  EXPECT_EQ(header_of(*gate_, saves, "Content-Disposition"), "attachment; filename=\"a___X-Evil__1_.._b.csv\"");
}

TEST_F(DeskGateTest, KnowsWhoseIsWhat) {
  EXPECT_FALSE(somebody_can_sign_in(database_));
  add_accounts();
  EXPECT_TRUE(somebody_can_sign_in(database_));
  AccountStore accounts(database_);
  const Account anna = *accounts.find("anna");
  const std::string stamp = sign_in_stamp(database_, anna.uuid);
  EXPECT_EQ(stamp.size(), 64U);
  EXPECT_EQ(sign_in_stamp(database_, anna.uuid), stamp);
  EXPECT_EQ(sign_in_stamp(database_, "unknown"), "");
  EXPECT_EQ(own_attempt(anna, database_, annas_), annas_);
  EXPECT_EQ(own_attempt(anna, database_, "1"), annas_) << "the page is given the whole name";
  EXPECT_EQ(own_attempt(anna, database_, "2"), std::nullopt);
  EXPECT_FALSE(own_attempt(anna, database_, ottos_));
  EXPECT_FALSE(own_attempt(anna, database_, ""));
  EXPECT_FALSE(names_another(database_, "T-anna", "T-anna"));
  EXPECT_TRUE(names_another(database_, "T-otto", "T-anna"));
  EXPECT_FALSE(names_another(database_, "T-nobody", "T-anna"));
  Account nobody;
  EXPECT_FALSE(may_see_trainee(nobody, "")) << "an account without a trainee owns nothing";
}

TEST(DeskPage, SaysWhatToDo) {
  for (const int status : {400, 401, 403, 404, 405, 408, 411, 413, 414, 415, 421, 429, 431, 500, 503, 505}) {
    const Response page = error_page(status);
    EXPECT_EQ(page.status, status);
    EXPECT_NE(page.body.find("<h1>" + status_title(status) + "</h1>"), std::string::npos);
    EXPECT_NE(page.body.find("(" + std::to_string(status) + ")"), std::string::npos);
  }
  EXPECT_NE(error_page(400, "<script>").body.find("&lt;script&gt;"), std::string::npos);
  const Response form = sign_in_page({.message = "<b>", .login = "\"><script>", .next = "\"x", .token = "t"});
  EXPECT_EQ(form.body.find("<script>"), std::string::npos);
  EXPECT_EQ(form.body.find("<b>"), std::string::npos);
  EXPECT_EQ(field_of(form.body, "next"), "&quot;x");
}

}  // namespace
}  // namespace trocar::review::desk_gate_test
