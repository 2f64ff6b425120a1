// Who may see what, over the list of routes: a page that is added later is covered by being in desk_routes().
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/server/url_text.h"

namespace trocar::review::desk_roles_test {
namespace {

const std::vector<std::string> kLogins{"", "anna", "ines", "adam"};

std::string filled(const std::string& pattern, const std::string& code, const std::string& attempt) {
  std::string out;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{') {
      out += pattern[i];
      continue;
    }
    const std::size_t end = pattern.find('}', i);
    const std::string name = pattern.substr(i + 1, end - i - 1);
    out += name == "code" ? code : name == "attempt" ? attempt : "1";
    i = end;
  }
  return out;
}

bool of_a_trainee(const Route& route) {
  return route.path.find("{code}") != std::string::npos || route.path.find("{attempt}") != std::string::npos;
}

/// What the route must say to that visitor: 401, 403, 303 at the door, or 0 for anything but a refusal.
int refusal_for(const Route& route, const std::string& login, bool own) {
  if (route.audience == Audience::kEverybody) return 0;
  if (login.empty()) return 401;
  if (login == "adam" || route.audience == Audience::kSignedIn) return 0;
  if (route.audience == Audience::kAdministrators) return 403;
  if (login == "ines") return 0;
  if (route.path == "/" && route.method == "GET") return 303;  // to the own page
  return route.audience == Audience::kOwnData && of_a_trainee(route) && own ? 0 : 403;
}

class DeskRoles : public DeskTest, public testing::WithParamInterface<bool> {
 protected:
  std::vector<Route> routes() const { return GetParam() ? desk_routes() : sample_routes(); }
  void SetUp() override {
    add_accounts();
    make_gate({}, routes());
    for (const std::string& login : kLogins) visitors_[login] = login.empty() ? stranger() : signed_in(login);
  }
  void expect_refusals(bool own) {
    const std::string code = own ? "T-anna" : "T-otto", attempt = own ? annas_ : ottos_;
    for (const Route& route : routes()) {
      for (const auto& [login, visitor] : visitors_) {
        const int status = ask(route.method, filled(route.path, code, attempt), visitor).response.status;
        const int wanted = refusal_for(route, login, own);
        const std::string what = route.method + " " + route.path + " by '" + login + "': " + std::to_string(status);
        if (wanted != 0)
          EXPECT_EQ(status, wanted) << what;
        else
          EXPECT_TRUE(status != 401 && status != 403) << what;
      }
    }
  }
  std::map<std::string, Visitor> visitors_;
};

TEST_P(DeskRoles, OwnDataIsOpenToItsTrainee) { expect_refusals(true); }

TEST_P(DeskRoles, ForeignDataIsClosedToTrainees) { expect_refusals(false); }

TEST_P(DeskRoles, NumbersAndPartsOfIdentifiersOpenNoMoreThanTheWholeOnes) {
  const AttemptStore store(database_);
  const std::string own = GetParam() ? "/attempt/" : "/own/attempt/";
  for (const AttemptSummary& attempt : store.list()) {
    for (const std::string& name : {std::to_string(attempt.row), attempt.uuid, attempt.uuid.substr(20)}) {
      const int status = ask("GET", own + name, visitors_["anna"]).response.status;
      EXPECT_EQ(status, attempt.trainee == "T-anna" ? 200 : 403) << name << " of " << attempt.trainee;
      EXPECT_EQ(ask("GET", own + name, visitors_["ines"]).response.status, 200);
    }
  }
  for (const char* name : {"4711", "99", "zzzz", "ffffffff"})
    EXPECT_EQ(ask("GET", own + name, visitors_["anna"]).response.status, 403) << name;
}

TEST_P(DeskRoles, NothingPostedWithoutTheRightToken) {
  const Visitor foreign = signed_in("ines");
  for (const Route& route : routes()) {
    if (route.method != "POST") continue;
    const std::string target = filled(route.path, "T-anna", annas_);
    const std::string cookie = visitors_["adam"].cookie;
    for (const std::string& token :
         {std::string(), std::string("x"), foreign.token, visitors_[""].token, visitors_["anna"].token}) {
      EXPECT_EQ(ask("POST", target, {cookie, token}).response.status, 403) << route.path << " token '" << token << "'";
    }
    const int without_cookie = ask("POST", target, {"", visitors_["adam"].token}).response.status;
    EXPECT_EQ(without_cookie, route.audience == Audience::kEverybody ? 403 : 401) << route.path;
  }
}

TEST_P(DeskRoles, ClosedAgainWhenTheSessionIsOver) {
  now_ += std::chrono::minutes(31);
  for (const Route& route : routes()) {
    if (route.audience == Audience::kEverybody) continue;
    for (const auto& [login, visitor] : visitors_) {
      EXPECT_EQ(ask(route.method, filled(route.path, "T-anna", annas_), visitor).response.status, 401)
          << route.path << " by " << login;
    }
  }
}

TEST_P(DeskRoles, EveryAnswerHasTheSecurityHeaders) {
  for (const Route& route : routes()) {
    for (const auto& [login, visitor] : visitors_) {
      const Answer answer = ask(route.method, filled(route.path, "T-otto", ottos_), visitor);
      EXPECT_EQ(header_of(*gate_, answer, "Content-Security-Policy"),
                "default-src 'none'; style-src 'self'; img-src 'self' data:; script-src 'self'; connect-src 'self'; "
                "media-src 'self'; form-action 'self'; frame-ancestors "
                "'none'; base-uri 'none'");
      EXPECT_EQ(header_of(*gate_, answer, "X-Content-Type-Options"), "nosniff");
      EXPECT_EQ(header_of(*gate_, answer, "Referrer-Policy"), "no-referrer");
      EXPECT_EQ(header_of(*gate_, answer, "Cache-Control"), "no-store");
      for (const auto& [name, value] : gate_->headers(answer)) {
        EXPECT_EQ(value.find_first_of("\r\n"), std::string::npos) << route.path << ": " << name;
      }
    }
  }
}

/// Metacharacters of SQL and HTML in every argument, query and form field that a page may have.
TEST_P(DeskRoles, NoTextIsTakenForSqlOrHtml) {
  const std::vector<std::string> evil{"'; DROP TABLE attempt; --",
                                      "\" OR \"\"=\"",
                                      "1 OR 1=1",
                                      "%' OR code LIKE '%",
                                      "a' UNION SELECT password FROM account --",
                                      "<script>alert(1)</script>",
                                      "\"><svg onload=alert(1)>",
                                      "${7*7}",
                                      "{{7*7}}",
                                      "\xE2\x80\xAE",
                                      std::string(900, 'A')};
  const std::vector<std::string> names{"group",  "exercise", "level", "state",   "sort", "order",   "page",
                                       "limit",  "with",     "from",  "to",      "text", "note",    "reason",
                                       "name",   "login",    "code",  "attempt", "toml", "meaning", "passed",
                                       "metric", "rule",     "kind",  "next",    "t",    "width",   "format"};
  for (const Route& route : routes()) {
    if (route.path.starts_with("/fails/")) continue;  // on purpose
    for (const std::string& text : evil) {
      std::string fields;
      for (const std::string& name : names) fields += (fields.empty() ? "" : "&") + name + "=" + percent_encoded(text);
      const bool posts = route.method == "POST";
      const std::string part = text.size() < 100 && text.find('/') == std::string::npos ? percent_encoded(text) : "x";
      for (const std::string& target : {filled(route.path, "T-anna", annas_), filled(route.path, part, part)}) {
        const Answer answer =
            ask(route.method,
                posts ? target : target + "?" + (fields.size() < 6000 ? fields : "text=" + percent_encoded(text)),
                visitors_["adam"], posts ? fields : "");
        EXPECT_LT(answer.response.status, 500) << route.method << " " << target;
        EXPECT_EQ(answer.response.body.find("<script>alert"), std::string::npos) << route.path;
        EXPECT_EQ(answer.response.body.find("<svg onload"), std::string::npos) << route.path;
        EXPECT_EQ(answer.response.body.find("argon2"), std::string::npos) << route.path;
      }
    }
  }
  EXPECT_EQ(run_outside(file_, "SELECT count(*) FROM attempt"), "");
  EXPECT_EQ(AttemptStore(database_).list().size(), 4U);
  EXPECT_EQ(database_.check(), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Routes, DeskRoles, testing::Values(false, true),
                         [](const auto& kind) { return kind.param ? "Desk" : "Sample"; });

}  // namespace
}  // namespace trocar::review::desk_roles_test
