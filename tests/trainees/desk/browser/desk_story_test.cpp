// The desk as an instructor uses it, in a real browser: sign in, find who is unsafe, open, scrub, compare, sign, write,
// export, sign out; on a desk's screen, on a phone's, without script, and by keyboard alone.
#include "tests/trainees/desk/browser/browsed_desk.h"

#include <algorithm>
#include <fstream>

#include "trainees/records/assessments.h"

namespace trocar::test::desk_story_test {
namespace {

constexpr const char* kNote = "Let go earlier, and look before you press.";

std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

class DeskStory : public BrowsedDesk {
 protected:
  void begin(const BrowserLook& given) {
    add_accounts();
    serve(options());
    look(given);
    browser_->open(at("/"));
    expect_sound("sign in");
    EXPECT_FALSE(browser_->has("nav")) << "nothing of the desk shows before signing in";
  }

  void find_the_unsafe_trainee() {
    const std::string card = browser_->text(".state.unsafe");
    EXPECT_NE(card.find(kRisky), std::string::npos) << card;
    expect_sound("cohort");
    browser_->follow(".state.unsafe a[href*='" + std::string(kRisky) + "']");
    EXPECT_EQ(browser_->text("h1"), kRisky);
    expect_sound("trainee");
    browser_->follow("#attempts tbody tr:first-child a");
    EXPECT_NE(browser_->address().find(attempt_), std::string::npos);
    EXPECT_NE(browser_->text(".verdict").find("Not yet"), std::string::npos);
    EXPECT_NE(browser_->text("#moment-h").find("30.0 s"), std::string::npos) << "it begins at the first grave event";
    expect_sound("attempt");
  }

  /// With script the page stays; without it is asked for again.
  void scrub(bool script) {
    const std::string first = "#events details tbody tr:first-child a";
    browser_->click("#events summary");
    if (script) {
      browser_->run("document.documentElement.setAttribute('data-same', 'yes')");
      browser_->click(first);
    } else {
      browser_->follow(first);
    }
    browser_->until("the first event", [&] { return browser_->text("#moment-h").find("20.0 s") != std::string::npos; });
    EXPECT_NE(browser_->text("#now").find("20.0 s"), std::string::npos);
    EXPECT_NE(browser_->property("#picture", "src").find("t=20.00"), std::string::npos);
    EXPECT_EQ(browser_->has("[data-same]"), script);
  }

  void compare() {
    browser_->follow("#compare li a");
    EXPECT_NE(browser_->text("h1").find("Compare"), std::string::npos);
    EXPECT_TRUE(browser_->has("#traces svg"));
    expect_sound("compare");
    browser_->open(at("/attempt/" + attempt_));
  }

  void sign_and_write() {
    browser_->type("#sign-note", "seen with the trainee");
    browser_->type("#sign-password", kDeskPassword);
    browser_->follow("#sign form[action$='/sign'] button");
    EXPECT_NE(browser_->text("#sign tbody").find("Dr Ines Brandt"), std::string::npos);
    // What is refused is not lost: three spaces pass the browser, not the desk.
    browser_->type("#note-text", "   ");
    browser_->follow("#notes form button");
    EXPECT_NE(browser_->text("#why-note").find("Not done."), std::string::npos);
    EXPECT_EQ(browser_->property("#note-text", "value"), "   ");
    EXPECT_EQ(browser_->run("return document.activeElement.id").get<std::string>(), "note-text");
    expect_sound("refused note");
    browser_->type("#note-text", kNote);
    browser_->follow("#notes form button");
    EXPECT_NE(browser_->text("#notes .said").find(kNote), std::string::npos);
  }

  void export_files() {
    browser_->open(at("/"));
    browser_->click(".files a");
    EXPECT_TRUE(first_line(browser_->saved("cohort.csv")).starts_with("trainee,name,exercise"));
    if (!browser_->has(".files a[href*='.pdf']")) return;
    browser_->click(".files a[href*='.pdf']");
    EXPECT_TRUE(first_line(browser_->saved("cohort.pdf")).starts_with("%PDF-1."));
  }

  void leave() {
    browser_->follow(".who button");
    EXPECT_TRUE(browser_->has("input[name=password]"));
    browser_->open(at("/attempt/" + attempt_));
    EXPECT_TRUE(browser_->has("input[name=password]")) << "signed out, and the page is shut";
  }

  void whole_story(const BrowserLook& given) {
    begin(given);
    sign_in("ines");
    find_the_unsafe_trainee();
    scrub(given.script);
    compare();
    sign_and_write();
    export_files();
    leave();
    expect_quiet({"401 (Unauthorized)",
                  "400 (Bad Request)"});  // what the desk answers to who has not signed in, and to three spaces
    Database database(file_);
    EXPECT_EQ(AssessmentStore(database).notes_of(kRisky).at(0).text, kNote);
    EXPECT_EQ(AssessmentStore(database).signatures_of(attempt_).at(0).signer, "Dr Ines Brandt");
    EXPECT_EQ(problems_of(database), "");
  }
};

TEST_F(DeskStory, OnADesk) { whole_story({}); }

TEST_F(DeskStory, OnAPhone) { whole_story({.width = 390, .height = 844, .phone = true}); }

TEST_F(DeskStory, WithoutScript) { whole_story({.script = false}); }

TEST_F(DeskStory, OnAPhoneWithoutScript) { whole_story({.width = 390, .height = 844, .phone = true, .script = false}); }

TEST_F(DeskStory, ByKeyboardAlone) {
  begin({});
  const auto enter = [&] { browser_->arrives([&] { browser_->press(key::kEnter); }); };
  EXPECT_EQ(browser_->run("return document.activeElement.name").get<std::string>(), "login");
  browser_->press(std::string("ines") + key::kTab + kDeskPassword);
  enter();
  browser_->tab_to("a[href*='" + std::string(kRisky) + "']");
  enter();
  browser_->tab_to("#attempts tbody tr:first-child a");
  enter();
  browser_->tab_to("#t");
  browser_->press(key::kRight, 5);  // steps of 0.1 s
  browser_->until("30.5 s", [&] { return browser_->text("#moment-h").find("30.5 s") != std::string::npos; });
  browser_->tab_to("#sign-note");  // it comes before the events
  browser_->tab_to("#events summary");
  browser_->press(key::kEnter);
  browser_->tab_to("#events details tbody tr:first-child a");
  browser_->press(key::kEnter);
  browser_->until("the first event", [&] { return browser_->text("#moment-h").find("20.0 s") != std::string::npos; });
  browser_->tab_to("#sign-note");
  browser_->press(std::string("seen") + key::kTab + kDeskPassword);
  enter();
  EXPECT_NE(browser_->text("#sign tbody").find("seen"), std::string::npos);
  browser_->tab_to("#note-text");
  browser_->press("Well done.");
  browser_->tab_to("#notes button");
  enter();
  EXPECT_NE(browser_->text("#notes .said").find("Well done."), std::string::npos);
  browser_->tab_to(".who button");
  enter();
  EXPECT_TRUE(browser_->has("input[name=password]"));
  expect_quiet({"401 (Unauthorized)"});
}

TEST_F(DeskStory, ATraineeSeesTheOwnPageAndLeaves) {
  begin({.width = 390, .height = 844, .phone = true});
  sign_in("risky");
  EXPECT_EQ(browser_->text("h1"), kRisky);
  expect_sound("own page", true);
  browser_->open(at("/"));
  EXPECT_EQ(browser_->text("h1"), kRisky) << "the first page is the own page";
  EXPECT_FALSE(browser_->has("#note-text"));
  browser_->follow("#attempts tbody tr:first-child a");
  EXPECT_NE(browser_->address().find(attempt_), std::string::npos);
  browser_->open(at("/curriculum"));
  EXPECT_EQ(browser_->text("h1"), "Not allowed");
  browser_->follow("a[href='/']");
  EXPECT_EQ(browser_->text("h1"), kRisky) << "no page is a dead end";
  browser_->follow(".who button");
  EXPECT_TRUE(browser_->has("input[name=password]"));
  expect_quiet({"401 (Unauthorized)", "403 (Forbidden)"});
}

}  // namespace
}  // namespace trocar::test::desk_story_test
