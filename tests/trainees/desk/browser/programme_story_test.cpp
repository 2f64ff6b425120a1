// A programme from nothing, in a real browser: a list of thirty people out of a file, a group, steps in a form, a
// deadline, the grid, one of them live and written to, the riskiest signed, one certified and then decided otherwise,
// files out, statements to a record store; the same pages on a phone's screen and without script.
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "tests/trainees/desk/browser/browsed_desk.h"
#include "tests/trainees/exchange/lrs/record_store_sample.h"
#include "trainees/exchange/lrs/lrs_delivery.h"
#include "trainees/live/live_publisher.h"
#include "trainees/live/live_stations.h"
#include "trainees/records/assessments.h"
#include "trainees/records/programmes.h"
#include "trainees/records/trainee_store.h"

namespace trocar::test::programme_story_test {
namespace {

class ProgrammeStory : public BrowsedDesk {
 protected:
  void begin(const BrowserLook& given) {
    add_accounts();
    auto served = options();
    served.sources.stations = [this] { return look_at_stations(file_); };
    served.sources.exercises = {{"surface-touch", "Surface touch", {"L1", "L2", "L3"}},
                                {"reach-and-orient", "Reach and orient", {"L1", "L2"}}};
    serve(std::move(served));
    look(given);
    browser_->open(at("/roster"));
    sign_in("adam");
  }

  /// As Excel writes it in German: semicolons, Windows letters, CR LF.
  std::string list() const {
    std::string out = "K\xFCrzel;Vorname;Nachname\r\n";
    for (int i = 1; i <= 30; ++i)
      out += "N-" + std::to_string(i) + ";J\xFCrgen;\"Gro\xDF " + std::to_string(i) + "\"\r\n";
    return out + "N-1;Doppelt;\r\n";
  }

  void choose_file() {
    const std::filesystem::path file = folder_ / "people.csv";
    std::ofstream(file, std::ios::binary) << list();
    browser_->type("#i-file", file.string());
    browser_->until("the file was read",
                    [&] { return browser_->text("output[for=i-file]").find("WINDOWS-1252") != std::string::npos; });
  }

  void import_people(bool script) {
    browser_->open(at("/roster"));
    expect_sound("roster");
    browser_->follow("a[href='/roster/import']");
    EXPECT_EQ(browser_->run("return document.querySelector('[data-reads]').hidden").get<bool>(), !script);
    if (script) {
      choose_file();
    } else {
      std::string pasted = "code;name\n";
      for (int i = 1; i <= 30; ++i) pasted += "N-" + std::to_string(i) + ";Person " + std::to_string(i) + "\n";
      browser_->type("#i-csv", pasted + "N-1;Twice\n");
    }
    browser_->type("#i-group", "Autumn 26");
    browser_->follow("#list button[value=look]");
    EXPECT_NE(browser_->text("#preview").find("30 added, 1 refused"), std::string::npos) << browser_->text("#preview");
    EXPECT_EQ(TraineeStore(*std::make_unique<Database>(file_)).find("N-1"), std::nullopt);
    expect_sound("preview");
    picture("preview");
    browser_->follow("#list button[value=take]");
    EXPECT_NE(browser_->text("#done").find("Done."), std::string::npos);
    expect_sound("imported");
  }

  void give_pins_to_a_few() {
    browser_->open(at("/roster?group=Autumn+26"));
    if (browser_->run("return document.querySelector('[data-all]').hidden").get<bool>() == false) {
      browser_->click("#all");
      EXPECT_EQ(browser_->run("return document.querySelectorAll('.roster tbody input:checked').length").get<int>(), 30);
      browser_->click("#all");
    }
    for (const char* code : {"N-1", "N-2"}) browser_->click("input[name='p:" + std::string(code) + "']");
    browser_->follow("button[formaction='/roster/pins']");
    EXPECT_EQ(browser_->run("return document.querySelectorAll('.cards li').length").get<int>(), 2);
    EXPECT_NE(browser_->text(".cards").find("PIN"), std::string::npos);
    expect_sound("cards");
    picture("cards");
  }

  void make_programme() {
    browser_->open(at("/programmes"));
    expect_sound("programmes");
    browser_->type("#p-name", "Basics");
    browser_->follow("#programmes form button");
    browser_->type("#s1-passes", "2");
    browser_->follow("button[value=add]");
    browser_->run("document.getElementById('s2-step').value = 'reach-and-orient|L1'");
    browser_->click("#s2-row");
    browser_->type("#s2-due", "30");
    browser_->follow("button[value='up.2']");
    EXPECT_EQ(browser_->property("#s1-step", "value"), "reach-and-orient|L1");
    expect_sound("steps");
    picture("steps");
    browser_->follow(".buttons button[value=save]");
    EXPECT_NE(browser_->text(".title").find("version 1"), std::string::npos);
  }

  void assign_and_look() {
    browser_->open(at("/programmes"));
    browser_->run("document.getElementById('g-group').value = 'Autumn 26'");
    browser_->run("document.getElementById('g-due').value = '2020-06-30'");
    browser_->follow("#assignments form button");
    EXPECT_NE(browser_->text("#assignments").find("30 Jun 2020"), std::string::npos);
    expect_sound("assigned");
    picture("programmes");
    browser_->open(at("/grid?programme=Basics"));
    EXPECT_NE(browser_->text("#grid").find("30 people"), std::string::npos);
    EXPECT_EQ(browser_->run("return document.querySelectorAll('.badge.step-overdue').length").get<int>(), 60);
    expect_sound("grid");
    picture("grid");
    browser_->open(at("/reminders"));
    EXPECT_NE(browser_->text("#reminders").find("days late"), std::string::npos);
    EXPECT_EQ(browser_
                  ->run("return [...document.querySelectorAll('.reminders tbody td')].filter("
                        "e => e.getBoundingClientRect().right > innerWidth).length")
                  .get<int>(),
              0)
        << "day and what is missing";
    expect_sound("reminders");
    picture("reminders");
    browser_->open(at("/roster/person?code=N-1"));
    expect_sound("person");
    browser_->follow("#state button[value=deactivate]");
    browser_->open(at("/grid?programme=Basics"));
    EXPECT_NE(browser_->text("#grid").find("29 people"), std::string::npos);
  }

  void watch_and_write() {
    LivePublisher publisher(file_);
    LiveMoment now;
    now.program = "practice window";
    now.trainee = "N-2";
    now.exercise_id = "surface-touch";
    now.exercise = "Surface touch";
    now.level = "L1";
    now.hand = "mouse";
    now.attempt = "0192";
    now.phase = "running";
    now.elapsed_s = 21;
    now.limit_s = 150;
    now.force_n = 0.7;
    now.peak_force_n = 1.7;
    now.limit_n = 1.5;
    now.done = 3;
    now.count = 12;
    now.hears = true;
    now.events = {{20.5, "force over the limit", true}};
    publisher.tell(now);
    browser_->until("the station shows who practises", [&] {
      browser_->open(at("/station"));
      return browser_->text("#live").find("N-2") != std::string::npos;
    });
    EXPECT_NE(browser_->text("#live").find("3 of 12"), std::string::npos);
    expect_sound("station");
    picture("station");
    browser_->follow("a[href^='/station/message']");
    browser_->type("#message-text", "Gently: half of that force will do.");
    browser_->follow("#message form button");
    Database database(file_);
    EXPECT_EQ(AssessmentStore(database).notes_of("N-2").at(0).text, "Gently: half of that force will do.");
  }

  /// Somebody passes often enough to be certified. @returns the newest attempt.
  std::string passes(const std::string& who) {
    Database database(file_);
    std::string newest;
    for (int i = 0; i < 16; ++i) {
      AttemptStart start = sample_start(who);
      start.hand = "mouse";
      start.board = i;
      AttemptResult result = sample_result(91);
      result.grade.caps.clear();
      result.events.pop_back();
      newest = store_attempt(database, start, result).uuid;
    }
    return newest;
  }

  void sign(const std::string& attempt) {
    browser_->open(at("/"));
    browser_->follow(".state.unsafe a[href*='" + std::string(kRisky) + "']");
    browser_->open(at("/attempt/" + attempt));
    browser_->type("#sign-password", kDeskPassword);
    browser_->follow("#sign form[action$='/sign'] button");
    EXPECT_NE(browser_->text("#sign tbody").find("Dr Ines Brandt"), std::string::npos);
  }

  void certify_and_decide_otherwise(const std::string& attempt, RecordStoreSample& store) {
    browser_->open(at("/attempt/" + attempt));
    browser_->type("#certify-password", kDeskPassword);
    browser_->follow("form[action$='/certify'] button");
    EXPECT_NE(browser_->text("#certificates").find("L1"), std::string::npos);
    expect_sound("certified");
    picture("certified");
    deliver(store);
    const std::size_t before = store.kept().size();
    EXPECT_GT(before, 16U);
    browser_->open(at("/attempt/" + attempt));
    browser_->run("for (const d of document.querySelectorAll('#sign details')) d.open = true");
    browser_->type("#override-reason", "Somebody else held the stylus.");
    browser_->type("#override-password", kDeskPassword);
    browser_->follow("form[action$='/override'] button");
    EXPECT_NE(browser_->text("#sign").find(": Somebody else held the stylus. Look, and withdraw it"), std::string::npos)
        << browser_->text("#sign");
    expect_sound("in question");
    picture("in-question");
    browser_->open(at("/grid?programme=Basics"));
    EXPECT_NE(browser_->text("#grid").find("N-3"), std::string::npos);
    const DeliveryReport again = deliver(store);
    EXPECT_GE(again.taken_back, 1) << "the statement of a passed attempt that no longer is";
    EXPECT_GT(store.kept().size(), before);
  }

  DeliveryReport deliver(RecordStoreSample& store) {
    Database database(file_);
    DeliveryOptions options;
    options.lrs.url = store.url();
    options.setting.home_page = "https://hospital.example/";
    const DeliveryReport report = deliver_to_lrs(database, choose_attempts(database, {}), {}, options);
    EXPECT_TRUE(report.refused.empty());
    return report;
  }

  void take_files() {
    browser_->open(at("/"));
    for (const auto& [link, name, begins] : {std::tuple{".files a[href*='.csv']", "cohort.csv", "trainee,name,"},
                                             std::tuple{".files a[href*='.pdf']", "cohort.pdf", "%PDF-1."}}) {
      if (!browser_->has(link)) continue;
      browser_->click(link);
      std::ifstream in(browser_->saved(name));
      std::string line;
      std::getline(in, line);
      EXPECT_TRUE(line.starts_with(begins)) << line;
    }
  }

  /// For people to look at: DESK_PICTURES names a folder.
  void picture(const std::string& name) {
    if (const char* folder = std::getenv("DESK_PICTURES"))
      browser_->picture(std::filesystem::path(folder) /
                        (name + (small_ ? "-390" : "-1280") + (script_ ? "" : "-plain") + ".png"));
  }

  void whole_story(const BrowserLook& given) {
    small_ = given.phone;
    script_ = given.script;
    begin(given);
    import_people(given.script);
    give_pins_to_a_few();
    make_programme();
    assign_and_look();
    watch_and_write();
    browser_->open(at("/"));
    browser_->follow(".who button");  // an instructor signs, not the administrator
    sign_in("ines");
    sign(attempt_);
    RecordStoreSample store;
    certify_and_decide_otherwise(passes("N-3"), store);
    take_files();
    expect_quiet({"401 (Unauthorized)"});
    Database database(file_);
    EXPECT_EQ(CurriculumStore(database).members("Autumn 26").size(), 30U);
    EXPECT_EQ(TraineeStore(database).find("N-7")->name, given.script ? "J\xC3\xBCrgen Gro\xC3\x9F 7" : "Person 7");
    EXPECT_EQ(ProgrammeStore(database).find("Basics").steps.size(), 2U);
    EXPECT_EQ(problems_of(database), "");
  }
  bool small_ = false, script_ = true;
};

TEST_F(ProgrammeStory, OnADesksScreen) { whole_story({}); }
TEST_F(ProgrammeStory, OnAPhone) { whole_story({.width = 390, .height = 844, .phone = true}); }
TEST_F(ProgrammeStory, WithoutScript) { whole_story({.script = false}); }

}  // namespace
}  // namespace trocar::test::programme_story_test
