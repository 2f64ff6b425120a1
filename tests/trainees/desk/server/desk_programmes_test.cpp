// Programmes through the gate: made in a form, assigned, the grid, who is late, files.
#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <thread>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/programmes.h"
#include "trainees/records/standings.h"

namespace trocar::review::desk_programmes_test {
namespace {

class DeskProgrammes : public DeskTest {
 protected:
  DeskProgrammes() {
    desk_.sources.exercises = {{"surface-touch", "Surface touch", {"L1", "L2"}}, {"pegs", "Rings <on> pegs", {"L1"}}};
    make_gate({}, desk_routes());
    add_accounts();
    ines_ = signed_in("ines");
    CurriculumStore(database_).join("T-anna", "2026 A", {"", "x"});
  }
  std::string sound(const std::string& what, const Answer& answer, int status = 200) {
    EXPECT_EQ(answer.response.status, status) << what << answer.response.body.substr(0, 800);
    EXPECT_EQ(check_page(answer.response.body, ines_.token).problems, std::vector<std::string>{}) << what;
    return answer.response.body;
  }
  std::string page(const std::string& path) { return sound(path, ask("GET", path, ines_)); }
  Answer post(const std::string& path, const std::string& body) { return ask("POST", path, ines_, body); }
  /// Fields of the form of a step.
  static std::string step(int number, const std::string& step, const std::string& passes = "2",
                          const std::string& more = "") {
    const std::string at = "&s" + std::to_string(number) + ".";
    return at + "step=" + percent_encoded(step) + at + "passes=" + passes + at + "days=1" + at + "input=" + at +
           "due=" + (more.empty() ? "" : at + more);
  }
  void save_basics() {
    EXPECT_EQ(post("/programme",
                   "name=Basics&do=save" + step(1, "surface-touch|L1", "1") + step(2, "pegs|L1", "3", "sign=yes"))
                  .response.status,
              303);
  }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
  Visitor ines_;
};

TEST_F(DeskProgrammes, AProgrammeIsMadeMovedAndSavedInAForm) {
  EXPECT_TRUE(has(page("/programmes"), "None yet"));
  EXPECT_TRUE(has(page("/grid"), "There is no programme yet"));
  const std::string fresh = page("/programme?name=Basics");
  EXPECT_TRUE(has(fresh, "not saved yet") && has(fresh, "Rings &lt;on&gt; pegs L1"));
  const std::string form = "name=Basics" + step(1, "surface-touch|L1") + step(2, "pegs|L1", "3", "row=yes");
  const std::string more = sound("add", post("/programme", form + "&do=add"));
  EXPECT_TRUE(has(more, "Step 3"));
  EXPECT_FALSE(has(sound("remove", post("/programme", form + "&do=remove.2")), "Step 2"));
  const std::string moved = sound("down", post("/programme", form + "&do=down.1"));
  EXPECT_LT(moved.find("value=\"pegs|L1\" selected"), moved.find("value=\"surface-touch|L1\" selected"));
  EXPECT_TRUE(ProgrammeStore(database_).list().empty()) << "nothing is kept before it is saved";
  EXPECT_EQ(post("/programme", form + "&do=save").response.location, "/programme?name=Basics#steps");
  const Programme kept = ProgrammeStore(database_).find("Basics");
  ASSERT_EQ(kept.steps.size(), 2U);
  EXPECT_TRUE(kept.steps[1].in_a_row);
  EXPECT_TRUE(has(page("/programme?name=Basics"), "version 1"));
  EXPECT_EQ(ProgrammeStore(database_).list().at(0).text.author, AccountStore(database_).find("ines")->uuid);
  const std::string rules = page("/curriculum");
  EXPECT_FALSE(has(rules, "Basics")) << "a programme is none of the rules";
  EXPECT_TRUE(has(sound("taken", post("/curriculum", "name=Basics&do=save&toml=version+%3D+%229%22"), 400),
                  "is the name of a programme"));
}

TEST_F(DeskProgrammes, WhatMeansNothingComesBackWithWhy) {
  for (const auto& [fields, said] :
       {std::pair<std::string, std::string>{step(1, "surface-touch|L1", "0"), "Step 1, passes: a whole number from 1"},
        {step(1, "surface-touch|L1", "two"), "Step 1, passes"},
        {step(1, "surface-touch|L1") + step(2, "surface-touch|L1"), "Step 2, exercise: is step 1 already"},
        {step(1, ""), "Step 1, exercise: choose one"},
        {step(1, "surface-touch|L1", "1", "days=3"), "Step 1, days"},
        {"", "at least one step"}}) {
    const std::string body = sound(said, post("/programme", "name=Basics&do=save" + fields), 400);
    EXPECT_TRUE(has(body, said)) << said;
  }
  EXPECT_EQ(post("/programme", "name=standard&do=save" + step(1, "pegs|L1")).response.status, 400);
  EXPECT_EQ(post("/programme", "name=&do=save" + step(1, "pegs|L1")).response.status, 400);
  EXPECT_TRUE(ProgrammeStore(database_).list().empty());
}

TEST_F(DeskProgrammes, WhatSomebodySavedMeanwhileIsNotOverwritten) {
  save_basics();
  const std::string form = "name=Basics&version=1&do=save" + step(1, "pegs|L1");
  EXPECT_EQ(post("/programme", form).response.status, 303);
  const std::string late = sound("late", post("/programme", form), 400);
  EXPECT_TRUE(has(late, "version 2 was saved meanwhile")) << late;
  EXPECT_TRUE(has(late, "name=\"version\" value=\"1\"")) << "saying it twice does not help";
  EXPECT_EQ(ProgrammeStore(database_).list().at(0).text.version, 2);
  EXPECT_EQ(post("/programme", "name=Basics&version=1&do=text&toml=x").response.status, 400);
}

TEST_F(DeskProgrammes, WhatIsAssignedHasItsDayAndNamesInWords) {
  save_basics();
  EXPECT_EQ(post("/programmes/assign", "programme=Basics&group=2026+A&due=2026-06-30").response.status, 303);
  const std::string programmes = page("/programmes");
  EXPECT_TRUE(has(programmes, ">Due</th>") && !has(programmes, ">By</th>")) << "the day, not who";
  EXPECT_TRUE(has(programmes,
                  "<span class=\"unseen\"> <span translate=\"no\">Basics</span> from <span "
                  "translate=\"no\">2026 A</span></span>"));
  const std::string due = check_page(page("/trainee/T-anna"), ines_.token).by_id("due")->text;
  EXPECT_TRUE(has(due, "Rings <on> pegs")) << due << ": nobody has tried it yet";
}

TEST_F(DeskProgrammes, RulesThatSomebodySavedMeanwhileAreNotOverwritten) {
  const auto rules = [](const std::string& version, const std::string& more = "") {
    return "&do=save&name=standard&toml=" + percent_encoded("version = \"" + version + "\"\n" + more);
  };
  const std::string opened = page("/curriculum"), seen = "seen_name=standard&seen=" + field_of(opened, "seen");
  EXPECT_EQ(field_of(opened, "seen_name"), "standard");
  EXPECT_EQ(post("/curriculum", seen + rules("otto-1")).response.status, 303);
  EXPECT_EQ(post("/curriculum", seen + rules("otto-1")).response.status, 303) << "the same text is no loss";
  const std::string late = sound("late", post("/curriculum", seen + rules("ines-1")), 400);
  EXPECT_TRUE(has(late, "no. 1 is kept here, and your text was not made from it") && has(late, "ines-1")) << late;
  EXPECT_EQ(field_of(late, "seen"), "") << "saying it twice does not help";
  EXPECT_EQ(CurriculumStore(database_).newest("standard")->version, 1);
  const std::string again = field_of(page("/curriculum"), "seen");
  EXPECT_EQ(again, CurriculumStore(database_).newest("standard")->uuid);
  EXPECT_EQ(post("/curriculum", "seen_name=other&seen=" + again + rules("ines-1")).response.status, 400);
  EXPECT_EQ(post("/curriculum", "seen_name=standard&seen=" + again + rules("ines-1")).response.status, 303);
  EXPECT_EQ(problems_of(database_), "");
}

/// Both have looked before either writes.
TEST_F(DeskProgrammes, OfTwoDesksThatSaveAtOnceOneSaves) {
  constexpr int kRounds = 12;
  const std::vector<Route> routes = desk_routes();
  std::atomic<int> rules = 0, programmes = 0;
  std::barrier together(2);
  const auto save = [&](const std::string& who) {
    Database database(file_);
    Desk desk{database, desk_.sources};
    Request request;
    request.account = Account{"", who, who, Role::kInstructor};
    request.now_utc = "2026-07-01T12:00:00Z";
    const auto saved = [&](const std::string& path, const std::map<std::string, std::string>& form) {
      request.form = form;
      together.arrive_and_wait();
      for (const Route& route : routes)
        if (route.method == "POST" && route.path == path) return route.answer(request, desk).status == 303;
      return false;
    };
    for (int round = 0; round < kRounds; ++round) {
      const std::string number = std::to_string(round), own = "# of " + who + "\n";
      rules += saved("/curriculum",
                     {{"do", "save"}, {"name", who + number}, {"toml", own + "version = \"r" + number + "\"\n"}});
      programmes += saved("/programme", {{"do", "text"},
                                         {"name", "Both"},
                                         {"version", number},
                                         {"toml", own + "[[step]]\nexercise = \"pegs\"\nlevel = \"L1\"\npasses = " +
                                                      std::to_string(round + 1) + "\n"}});
    }
  };
  std::thread other(save, "otto");
  save("ines");
  other.join();
  EXPECT_EQ(rules, kRounds) << "one version of rules is one text";
  EXPECT_EQ(programmes, kRounds);
  EXPECT_EQ(ProgrammeStore(database_).list().size(), 1U);
}

/// What would count nowhere is not taken, and every page says why once.
TEST_F(DeskProgrammes, WithoutTheStationsKeyNothingIsAssignedOrWithdrawn) {
  save_basics();
  EXPECT_EQ(post("/programmes/assign", "programme=Basics&group=2026+A").response.status, 303);
  const std::string held = ProgrammeStore(database_).assignments().at(0).uuid,
                    lost = "desk.db.key is missing: what is written now is not signed";
  const std::filesystem::path key = key_path(file_), away = folder_ / "away";
  const Visitor anna = signed_in("anna");
  std::filesystem::rename(key, away);
  for (const auto& [path, form] :
       {std::pair<std::string, std::string>{"/programmes/assign", "programme=Basics&trainee=T-otto"},
        {"/programmes/withdraw", "assignment=" + held},
        {"/roster/selected", "p%3AT-anna=yes&do=deactivate"},
        {"/roster/selected", "p%3AT-anna=yes&do=join&group=spring"},
        {"/trainee/T-anna/note", "text=Slower."},
        {"/attempt/" + annas_ + "/note", "text=Slower."},
        {"/attempt/" + annas_ + "/rate", "scale=GOALS&autonomy=4"},
        {"/roster/add", "code=N-1"}}) {
    const std::string refused = sound(path, post(path, form), 400);
    EXPECT_TRUE(has(refused, "Nothing was written, for what is not signed counts nowhere")) << path;
    EXPECT_EQ(has(refused, "Slower."), has(form, "Slower.")) << path << ": what was typed stays";
  }
  for (const std::string path : {"/", "/roster", "/programmes", "/curriculum", "/trainee/T-anna"}) {
    const std::string shown = page(path);
    const std::size_t at = shown.find("This record takes no decisions now: its key " + lost);
    ASSERT_NE(at, std::string::npos) << path;
    EXPECT_EQ(shown.find(lost, at + lost.size() + 50), std::string::npos) << path << " says it once";
  }
  const std::string attempt = page("/attempt/" + annas_);
  EXPECT_TRUE(has(attempt, "You cannot sign, decide or certify: the station's key is missing."));
  EXPECT_EQ(attempt.find(lost), attempt.rfind(lost));
  EXPECT_FALSE(has(ask("GET", "/trainee/T-anna", anna).response.body, lost)) << "nothing a trainee can mend";
  std::filesystem::rename(away, key);
  EXPECT_FALSE(has(page("/programmes"), lost));
  EXPECT_EQ(post("/programmes/withdraw", "assignment=" + held).response.status, 303);
  EXPECT_TRUE(StandingStore(database_).of("T-anna").active);
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskProgrammes, TheTextIsTheSameProgramme) {
  save_basics();
  const std::string toml = "# mine\n[[step]]\nexercise = \"pegs\"\nlevel = \"L1\"\n";
  EXPECT_EQ(post("/programme", "name=Basics&version=1&do=text&toml=" + percent_encoded(toml)).response.status, 303);
  EXPECT_EQ(ProgrammeStore(database_).find("Basics").steps.size(), 1U);
  EXPECT_TRUE(has(page("/programme?name=Basics"), "# mine"));
  const std::string bad =
      sound("bad", post("/programme", "name=Basics&version=2&do=text&toml=" + percent_encoded(toml + "x = 1\n")), 400);
  EXPECT_TRUE(has(bad, "Basics:5:1: unknown key") && has(bad, "x = 1")) << bad;
}

TEST_F(DeskProgrammes, AssignedToAGroupItShowsInTheGridAndIsWithdrawn) {
  save_basics();
  EXPECT_TRUE(has(page("/grid?programme=Basics"), "Nobody has this programme"));
  EXPECT_EQ(post("/programmes/assign", "programme=Basics&group=2026+A&trainee=&due=2020-06-30").response.status, 303);
  EXPECT_EQ(post("/programmes/assign", "programme=Basics&group=2026+A&trainee=T-otto&due=").response.status, 303)
      << "a code goes before the group that the list stands on";
  const std::string listed = page("/programmes");
  EXPECT_TRUE(has(listed, "30 Jun 2020") && has(listed, "/trainee/T-otto"));
  const std::string grid = page("/grid?programme=Basics");
  EXPECT_TRUE(has(grid, "2 people") && has(grid, "Surface touch L1") && has(grid, "Rings &lt;on&gt; pegs L1"));
  EXPECT_TRUE(has(grid, "step-overdue") && has(grid, ">overdue</span>")) << "colour and word";
  EXPECT_FALSE(has(page("/grid?programme=Basics&group=2026+A"), "T-otto"));
  EXPECT_TRUE(has(page("/grid?programme=Basics&state=certified"), "Nobody has a step in that state"));
  const Answer file = ask("GET", "/grid.csv?programme=Basics", ines_);
  EXPECT_TRUE(has(file.response.body, "T-anna,,2026 A,1,Basics,2,pegs,L1,")) << file.response.body;
  const std::string late = page("/reminders");
  EXPECT_TRUE(has(late, "days late") && has(late, "T-anna") && !has(late, "T-otto"));
  const Answer csv = ask("GET", "/reminders.csv?days=0", ines_);
  EXPECT_TRUE(has(csv.response.body, "code,name,group,programme,step,deadline,days,state,missing\r\n"));
  EXPECT_TRUE(has(csv.response.body, "T-anna,,2026 A,Basics,pegs L1,2020-06-30,-")) << csv.response.body;
  StandingStore(database_).set_active({"T-anna"}, false, "", {"", "x"});
  EXPECT_FALSE(has(page("/reminders"), "T-anna"));
  EXPECT_TRUE(has(page("/grid?programme=Basics&deactivated=yes"), ">deactivated</span>"));
  for (const Assignment& one : ProgrammeStore(database_).assignments())
    EXPECT_EQ(post("/programmes/withdraw", "assignment=" + one.uuid + "&reason=over").response.status, 303);
  EXPECT_TRUE(has(page("/programmes"), "Nothing is assigned") && has(page("/programmes"), "Withdrawn ones"));
  EXPECT_EQ(
      post("/programmes/withdraw", "assignment=" + ProgrammeStore(database_).assignments()[0].uuid).response.status,
      400);
  EXPECT_EQ(problems_of(database_), "");
}

TEST_F(DeskProgrammes, ARefusedAssignmentComesBackWithItsFields) {
  save_basics();
  for (const auto& [form, said] : {std::pair{"programme=Basics&group=&trainee=&due=", "to one person or to one group"},
                                   {"programme=Basics&group=&trainee=nobody&due=", "there is none"},
                                   {"programme=Other&group=2026+A&due=", "there is none"},
                                   {"programme=Basics&group=2026+A&due=30.6.2026", "such as 2026-06-30"}})
    EXPECT_TRUE(has(sound(form, post("/programmes/assign", form), 400), said)) << form;
  EXPECT_TRUE(has(post("/programmes/assign", "programme=Basics&trainee=nobody&due=2026-06-30").response.body,
                  "value=\"2026-06-30\""));
  EXPECT_TRUE(ProgrammeStore(database_).assignments().empty());
}

TEST_F(DeskProgrammes, ATraineeSeesWhatIsDueOnTheirOwnPage) {
  save_basics();
  EXPECT_EQ(post("/programmes/assign", "programme=Basics&group=2026+A&due=2099-06-30").response.status, 303);
  const Answer own = ask("GET", "/trainee/T-anna", signed_in("anna"));
  EXPECT_TRUE(has(own.response.body, "programme Basics: 0 of 3 passes")) << own.response.body;
  EXPECT_TRUE(has(own.response.body, "30 Jun 2099"));
  EXPECT_EQ(ask("GET", "/grid", signed_in("anna")).response.status, 403);
}

}  // namespace
}  // namespace trocar::review::desk_programmes_test
