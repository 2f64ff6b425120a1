// Every page of the desk in a real browser, the administrators' too: sound at both widths and reached by Tab; what
// administrators do there; the demo's end; TLS.
#include "tests/trainees/desk/browser/browsed_desk.h"

#include <algorithm>
#include <fstream>

#include "tests/trainees/desk/browser/page_faults.h"
#include "tests/trainees/desk/server/tls_sample.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/attempt_store.h"

namespace trocar::test::desk_pages_in_browser_test {
namespace {

class DeskPages : public BrowsedDesk {
 protected:
  std::vector<std::string> all_paths() {
    Database database(file_);
    AttemptFilter filter;
    filter.trainee = kRisky;
    const std::string earlier = AttemptStore(database).list(filter).at(1).uuid;
    return {"/",
            "/?state=unsafe&sort=-best",
            std::string("/trainee/") + kRisky,
            "/attempt/" + attempt_,
            "/compare/" + attempt_ + "/" + earlier,
            "/curriculum",
            "/station",
            "/accounts",
            "/record",
            "/audit",
            "/audit?page=2",
            "/retention?days=1",
            "/trainee/nobody"};
  }
  void expect_all_sound() {
    for (const std::string& path : all_paths()) {
      browser_->open(at(path));
      expect_sound(path, true);
    }
  }
};

TEST_F(DeskPages, AreSoundOnADesk) {
  add_accounts();
  serve(options());
  look({});
  browser_->open(at("/"));
  sign_in("adam");
  expect_all_sound();
  expect_quiet({"401 (Unauthorized)", "404 (Not Found)"});
}

TEST_F(DeskPages, AreSoundOnAPhone) {
  add_accounts();
  serve(options());
  look({.width = 390, .height = 844, .phone = true});
  browser_->open(at("/"));
  sign_in("adam");
  expect_all_sound();
  expect_quiet({"401 (Unauthorized)", "404 (Not Found)"});
}

TEST_F(DeskPages, OnAPhoneResultsAndVerdictAreSeenWithoutScrolling) {
  add_accounts();
  {
    Database database(file_);
    const Account ines = AccountStore(database).verify("ines", kDeskPassword).value();
    AssessmentStore(database).override_verdict(attempt_, true, "The stand slipped during it.", {ines.uuid, ines.name});
  }
  serve(options());
  look({.width = 390, .height = 844, .phone = true});
  browser_->open(at("/"));
  sign_in("ines");
  browser_->open(at(std::string("/trainee/") + kRisky));
  EXPECT_GT(browser_->run("return document.querySelectorAll('.tries td').length").get<int>(), 6);
  EXPECT_EQ(browser_
                ->run("return [...document.querySelectorAll('.tries td')].filter("
                      "e => e.getBoundingClientRect().right > innerWidth).length")
                .get<int>(),
            0);
  browser_->open(at("/attempt/" + attempt_));
  EXPECT_TRUE(browser_
                  ->run("const words = document.createRange(); "
                        "words.selectNodeContents(document.querySelector('.verdict .word')); "
                        "return words.getBoundingClientRect().right <= "
                        "document.querySelector('.verdict .score').getBoundingClientRect().left")
                  .get<bool>())
      << "the verdict does not run into the score";
}

TEST_F(DeskPages, PrintOnA4) {
  serve(options());
  look({.width = 703, .height = 1000});  // 210 mm less two margins of 12 mm, at 96 px an inch
  browser_->as_printed();
  for (const std::string& path : all_paths()) {
    browser_->open(at(path));
    EXPECT_EQ(faults_of_paper(*browser_), std::vector<std::string>{}) << path;
  }
  browser_->open(at("/attempt/" + attempt_));
  EXPECT_NE(browser_->text(".paper").find(kRisky), std::string::npos) << "whose attempt it is";
}

TEST_F(DeskPages, TheFirstAccountIsMadeAtTheDeskAndSignsIn) {
  serve(options());
  look({.script = false});
  browser_->open(at("/"));
  EXPECT_FALSE(browser_->has(".who button")) << "who did not sign in cannot sign out";
  browser_->follow("nav a[href='/accounts']");
  browser_->type("#a-login", "adam");
  browser_->type("#a-name", "Adam Admin");
  browser_->type("#a-password", kDeskPassword);
  browser_->type("#a-again", "something else");
  browser_->follow("#new form button");
  EXPECT_NE(browser_->text("#why-account").find("passwords differ"), std::string::npos);
  EXPECT_EQ(browser_->property("#a-login", "value"), "adam");
  EXPECT_EQ(browser_->property("#a-password", "value"), "") << "a password is never sent back";
  browser_->type("#a-password", kDeskPassword);
  browser_->type("#a-again", kDeskPassword);
  browser_->follow("#new form button");
  EXPECT_TRUE(browser_->has("input[name=login]")) << "from now on everybody signs in";
  sign_in("adam");
  browser_->open(at("/record"));
  browser_->follow("#check button");
  EXPECT_NE(browser_->text("#check").find("110 problems"), std::string::npos)
      << "the sample's recordings were never made";
  browser_->follow("#backups button");
  EXPECT_NE(browser_->text("#backups tbody").find(".backup"), std::string::npos);
  browser_->open(at("/audit?action=account+added"));
  EXPECT_NE(browser_->text("#trail tbody").find("account added"), std::string::npos);
  expect_quiet({"401 (Unauthorized)", "400 (Bad Request)"});
}

TEST_F(DeskPages, TheDemoGoesAtTheDeskItself) {
  review::DeskServerOptions given = options();
  given.demo = true;
  int removed = 0;
  given.sources.remove_demo = [&removed] {
    ++removed;
    return "/x/removed-demo";
  };
  serve(std::move(given));
  look({.width = 390, .height = 844, .phone = true});
  browser_->open(at("/"));
  browser_->follow(".ribbon .button");
  EXPECT_EQ(removed, 0) << "it is asked first";
  expect_sound("question");
  browser_->follow("main form button");
  EXPECT_EQ(removed, 1);
  EXPECT_EQ(browser_->text("h1"), "The demo is removed");
  expect_sound("gone");
  expect_quiet();
}

TEST_F(DeskPages, OverTlsTheCookieIsForNobodyElse) {
  add_accounts();
  review::DeskServerOptions given = options();
  given.lan = true;
  given.certificate = folder_ / "desk.crt";
  given.key = folder_ / "desk.key";
  review::make_identity(given.certificate, given.key);
  serve(std::move(given));
  ASSERT_TRUE(base_.starts_with("https://127.0.0.1:")) << base_;
  look({.any_certificate = true});
  browser_->open(at("/"));
  sign_in("ines");
  EXPECT_EQ(browser_->text("h1"), "Cohort");
  const auto cookies = browser_->cookies();
  ASSERT_EQ(cookies.size(), 1U);
  EXPECT_TRUE(cookies[0]["name"].get<std::string>().starts_with("__Host-")) << cookies[0];
  EXPECT_TRUE(cookies[0]["secure"].get<bool>());
  EXPECT_TRUE(cookies[0]["httpOnly"].get<bool>());
  EXPECT_EQ(cookies[0]["sameSite"], "Strict");
  EXPECT_EQ(browser_->run("return document.cookie").get<std::string>(), "") << "no script reads it";
  expect_quiet({"401 (Unauthorized)"});
}

}  // namespace
}  // namespace trocar::test::desk_pages_in_browser_test
