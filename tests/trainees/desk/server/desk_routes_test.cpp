// Every route with a real database behind it, without a network: what is shown, what is stored, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/routes/route_table.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/records/trainee_store.h"

namespace trocar::review::desk_routes_test {
namespace {

constexpr const char* kRules = "version = \"7\"\n";

class DeskRoutes : public testing::Test {
 protected:
  DeskRoutes() : database_(":memory:"), desk_{database_, {}, false}, table_(desk_routes()) {
    test::fill_cohort(database_, {});
    desk_.sources.trace = [](const std::filesystem::path&) { return sample_trace(); };
    desk_.sources.picture = [](const std::string& uuid, double t_s, int width) {
      return uuid + " " + std::to_string(t_s) + " " + std::to_string(width);
    };
    desk_.sources.metric_words = [](const std::string& metric) { return "words of " + metric; };
    desk_.sources.level_facts = [](const std::string&, const std::string&) { return LevelFacts{{0.4, 0.8, 1.5}, 70}; };
    desk_.sources.shipped_rules = kRules;
    attempt_ = AttemptStore(database_).latest()->uuid;
    trainee_ = AttemptStore(database_).latest()->trainee;
    staff_ = Account{"a-1", "ines", "Dr Ines Okafor", Role::kInstructor};
  }

  Response ask(const std::string& method, const std::string& path, std::map<std::string, std::string> values = {}) {
    const RouteTable::Found found = table_.find(method, path);
    if (found.route == nullptr) return Response{.status = 405};
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    (method == "GET" ? request.query : request.form) = std::move(values);
    request.account = staff_;
    request.token = "token-4711";
    request.now_utc = "2026-06-01T10:00:00Z";
    return found.route->answer(request, desk_);
  }

  CheckedPage page(const std::string& path, std::map<std::string, std::string> values = {}) {
    const Response answer = ask("GET", path, std::move(values));
    EXPECT_EQ(answer.status, 200) << path << "\n" << answer.body.substr(0, 2000);
    return check_page(answer.body);
  }

  Database database_;
  Desk desk_;
  RouteTable table_;
  Account staff_;
  std::string attempt_, trainee_;
};

TEST_F(DeskRoutes, EveryPageIsSound) {
  staff_.role = Role::kAdministrator;
  for (const std::string& path :
       {std::string("/accounts"), std::string("/record"), std::string("/audit"), std::string("/retention"),
        std::string("/"), "/trainee/" + trainee_, "/attempt/" + attempt_, "/compare/" + attempt_ + "/" + attempt_,
        std::string("/curriculum"), std::string("/station"), std::string("/why")})
    EXPECT_EQ(page(path).problems, std::vector<std::string>{}) << path;
}

TEST_F(DeskRoutes, EmptyDatabase) {
  Database empty(":memory:");
  Desk desk{empty};
  for (const char* path :
       {"/", "/why", "/curriculum", "/station", "/cohort.csv", "/accounts", "/record", "/audit", "/retention"}) {
    Request request;
    request.path = path;
    request.account = staff_;
    request.token = "token-4711";
    const Response answer = table_.find("GET", path).route->answer(request, desk);
    EXPECT_EQ(answer.status, 200) << path;
    if (answer.download.empty()) {
      EXPECT_EQ(check_page(answer.body).problems, std::vector<std::string>{}) << path;
    }
  }
}

TEST_F(DeskRoutes, CohortShowsEverybodyAndFilters) {
  const CheckedPage all = page("/");
  EXPECT_NE(all.all("div", "title")[0]->text.find("8 trainees, 98 tries"), std::string::npos)
      << all.all("div", "title")[0]->text;
  const std::string group = CurriculumStore(database_).groups().front();
  const std::size_t members = CurriculumStore(database_).members(group).size();
  EXPECT_NE(page("/", {{"group", group}}).all("div", "title")[0]->text.find(std::to_string(members) + " trainees"),
            std::string::npos);
  EXPECT_NE(page("/", {{"group", "' OR 1=1 --"}}).by_id("trainees")->text.find("Nobody matches"), std::string::npos);
}

TEST_F(DeskRoutes, WhoIsRegisteredAndHasNotTriedWhatIsAskedForIsShown) {
  TraineeStore(database_).ensure_trainee("IDLE");
  TraineeStore(database_).edit("IDLE", "Ivo Idle", {}, "");
  const auto card = [this](const std::map<std::string, std::string>& query) {
    return page("/", query).all("section", "not-started").at(0)->text;
  };
  EXPECT_NE(card({}).find("Ivo Idle"), std::string::npos) << card({});
  const std::string group = CurriculumStore(database_).groups().front();
  EXPECT_EQ(card({{"group", group}}).find("Ivo Idle"), std::string::npos);
  const CheckedPage only = page("/", {{"state", "not-started"}});
  EXPECT_NE(only.all("div", "title").at(0)->text.find("1 trainee, 0 tries"), std::string::npos);
  EXPECT_NE(ask("GET", "/cohort.csv", {{"state", "not-started"}}).body.find("IDLE"), std::string::npos);
}

TEST_F(DeskRoutes, WhyAttemptsFailFollowsTheFilterAndDrawsTheMeasureThatIsAsked) {
  for (const char* who : {"X", "Y", "Z"}) store_attempt(database_, sample_start(who), sample_result(80));
  const CheckedPage all = page("/why");
  EXPECT_EQ(all.problems, std::vector<std::string>{});
  EXPECT_FALSE(all.all("table").empty());
  EXPECT_TRUE(all.all("svg", "measure").empty()) << "which exercise?";
  const CheckedPage one = page("/why", {{"exercise", "surface-touch"}, {"level", "L1"}, {"metric", "time_s"}});
  EXPECT_EQ(one.problems, std::vector<std::string>{});
  ASSERT_FALSE(one.all("svg", "measure").empty());
  EXPECT_EQ(one.all("svg", "measure")[0]->of("aria-label"), "Time s by attempt");
  EXPECT_LT(one.all("table").size(), all.all("table").size());
  EXPECT_TRUE(page("/why", {{"group", "' OR 1=1 --"}}).all("table").empty());
  EXPECT_EQ(page("/why", {{"exercise", "surface-touch"}, {"level", "L1"}, {"metric", "<script>"}}).problems,
            std::vector<std::string>{});
}

TEST_F(DeskRoutes, ATraineesPageSaysWhyAndDrawsAnyMeasure) {
  const CheckedPage own = page("/trainee/" + trainee_, {{"metric", "time_s"}});
  EXPECT_EQ(own.problems, std::vector<std::string>{});
  EXPECT_EQ(own.all("svg", "measure").at(0)->of("aria-label"), "Time s by attempt");
  EXPECT_FALSE(own.by_id("why")->text.empty());
  const auto reasons = own.all("td", "why");
  ASSERT_FALSE(reasons.empty());
  EXPECT_TRUE(std::any_of(reasons.begin(), reasons.end(), [](const PageElement* cell) {
    return cell->text.find("points went on") != std::string::npos || cell->text.find("gate") != std::string::npos;
  })) << reasons[0]->text;
}

TEST_F(DeskRoutes, AttemptLooksAtTheAskedMoment) {
  EXPECT_EQ(page("/attempt/" + attempt_, {{"t", "12.5"}}).by_id("t")->of("value"), "12.5");
  EXPECT_EQ(page("/attempt/" + attempt_, {{"t", "1e99"}}).by_id("t")->of("value"), "60.0");
  EXPECT_EQ(page("/attempt/" + attempt_, {{"t", "-4"}}).by_id("t")->of("value"), "0.0");
  EXPECT_EQ(page("/attempt/" + attempt_, {{"t", "nan"}}).problems, std::vector<std::string>{});
}

TEST_F(DeskRoutes, PicturesCarryAttemptTimeAndWidth) {
  const Response answer = ask("GET", "/attempt/" + attempt_ + "/picture.png", {{"t", "3.25"}});
  EXPECT_EQ(answer.type, "image/png");
  EXPECT_EQ(answer.body, attempt_ + " 3.250000 800");
  for (const char* t : {"", "x", "-1", "inf"})
    EXPECT_EQ(ask("GET", "/attempt/" + attempt_ + "/picture.png", {{"t", t}}).status, 404) << t;
  desk_.sources.picture = [](const std::string&, double, int) -> std::string {
    throw EnvironmentError("replayed to 40 %");
  };
  EXPECT_EQ(ask("GET", "/attempt/" + attempt_ + "/picture.png", {{"t", "1"}}).status, 503);
  desk_.sources.picture = {};
  EXPECT_EQ(page("/attempt/" + attempt_).all("img").size(), 0U);
}

TEST_F(DeskRoutes, AnUnreadableRecordingLeavesThePageStanding) {
  desk_.sources.trace = [](const std::filesystem::path&) -> Trace { throw InputError("a.trec: cut"); };
  const CheckedPage answer = page("/attempt/" + attempt_);
  EXPECT_EQ(answer.problems, std::vector<std::string>{});
  EXPECT_NE(answer.by_id("metrics")->text.find("words of "), std::string::npos);
}

TEST_F(DeskRoutes, WhatIsNotThereIsSaid) {
  for (const char* path : {"/trainee/nobody", "/attempt/ffffffff-0000", "/compare/ffffffff/eeeeeeee"}) {
    const Response answer = ask("GET", path);
    EXPECT_EQ(answer.status, 404) << path;
    EXPECT_EQ(check_page(answer.body).problems, std::vector<std::string>{}) << path;
  }
  EXPECT_EQ(ask("GET", "/compare", {{"attempt", attempt_}, {"other", "'; DROP TABLE attempt"}}).status, 404);
  EXPECT_EQ(ask("GET", "/compare", {{"attempt", attempt_.substr(0, 36)}, {"other", attempt_}}).location,
            "/compare/" + attempt_ + "/" + attempt_);
}

TEST_F(DeskRoutes, FilesAreDownloads) {
  const Response cohort = ask("GET", "/cohort.csv"), attempts = ask("GET", "/trainee/" + trainee_ + "/attempts.csv"),
                 attempt = ask("GET", "/attempt/" + attempt_ + "/attempt.csv");
  EXPECT_EQ(cohort.download, "cohort.csv");
  EXPECT_EQ(attempts.download, "attempts-" + trainee_ + ".csv");
  for (const Response& file : {cohort, attempts, attempt}) EXPECT_EQ(file.type, "text/csv; charset=utf-8");
  const auto all = AttemptStore(database_).list(AttemptFilter{trainee_, "", 0});
  EXPECT_EQ(std::count(attempts.body.begin(), attempts.body.end(), '\n') - 1, static_cast<std::ptrdiff_t>(all.size()))
      << "what the device ended is on no curve, but in the file";
}

TEST_F(DeskRoutes, NotesSignaturesOverridesAreStoredWithTheirAuthor) {
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/note", {{"text", "Too strong <b>"}}).location,
            "/attempt/" + attempt_ + "#notes");
  EXPECT_EQ(ask("POST", "/trainee/" + trainee_ + "/note", {{"text", "Well done"}}).status, 303);
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/sign", {{"meaning", "approval"}, {"note", "seen"}}).status, 303);
  EXPECT_EQ(
      ask("POST", "/attempt/" + attempt_ + "/override", {{"passed", "yes"}, {"reason", "The stand slipped twice"}})
          .status,
      303);
  const AssessmentStore assessments(database_);
  ASSERT_EQ(assessments.notes_of(trainee_).size(), 2U);
  EXPECT_EQ(assessments.notes_of(trainee_)[0].printed, "Dr Ines Okafor");
  ASSERT_EQ(assessments.signatures_of(attempt_).size(), 1U);
  EXPECT_EQ(assessments.signatures_of(attempt_)[0].meaning, "approval");
  EXPECT_TRUE(assessments.overrides_of(attempt_)[0].passed);
  const CheckedPage answer = page("/attempt/" + attempt_);
  EXPECT_NE(answer.by_id("notes")->text.find("Too strong <b>"), std::string::npos);
  EXPECT_NE(answer.all("section", "verdict")[0]->text.find("Passed by decision of Dr Ines Okafor"), std::string::npos);
}

TEST_F(DeskRoutes, BadAssessmentsAreRefusedAndNothingIsStored) {
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/note", {{"text", ""}}).status, 400);
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/sign", {{"meaning", "admiration"}}).status, 400);
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/override", {{"passed", "yes"}, {"reason", "short"}}).status, 400);
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/override", {{"reason", "long enough a reason"}}).status, 400);
  EXPECT_EQ(ask("POST", "/certificate/none/revoke", {{"reason", "long enough a reason"}}).status, 400);
  EXPECT_TRUE(AssessmentStore(database_).notes_of(trainee_).empty());
  EXPECT_TRUE(AssessmentStore(database_).overrides_of(attempt_).empty());
}

TEST_F(DeskRoutes, NobodyIsCertifiedWithoutEvidence) {
  ASSERT_EQ(page("/attempt/" + attempt_).by_id("sign")->text.find("Certify"), std::string::npos);
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/certify").status, 400);
  EXPECT_TRUE(AssessmentStore(database_).certificates_of("").empty());
}

/// Attempts of one trainee, one a board, without anything critical.
AttemptId practise(Database& database, const std::string& trainee, int attempts, double score) {
  AttemptId last;
  for (int i = 0; i < attempts; ++i) {
    AttemptStart start = sample_start(trainee);
    start.board = i;
    AttemptResult result = sample_result(score + i % 3);
    result.grade.caps.clear();
    result.events.pop_back();
    for (Subscore& part : result.grade.subscores) part.value = 0.01 * score;
    last = store_attempt(database, start, result);
  }
  return last;
}

TEST_F(DeskRoutes, EvidenceMakesACertificateOnce) {
  Database database(":memory:");
  practise(database, "novice-1", 5, 60);
  practise(database, "novice-2", 5, 52);
  const AttemptId last = practise(database, "steady", 30, 90);
  Desk desk{database};
  Request request;
  request.account = staff_;
  request.token = "token-4711";
  request.now_utc = "2026-06-01T10:00:00Z";
  request.arguments = {{"attempt", last.uuid}, {"code", "steady"}};
  const std::string page = table_.find("GET", "/attempt/x").route->answer(request, desk).body;
  ASSERT_NE(page.find("/certify\""), std::string::npos);
  EXPECT_EQ(check_page(page).problems, std::vector<std::string>{});
  EXPECT_EQ(table_.find("POST", "/attempt/x/certify").route->answer(request, desk).location,
            "/trainee/steady#certificates");
  const auto held = AssessmentStore(database).certificates_of("steady");
  ASSERT_EQ(held.size(), 1U);
  EXPECT_EQ(held[0].printed, "Dr Ines Okafor");
  EXPECT_NE(held[0].evidence.find(last.uuid), std::string::npos);
  EXPECT_EQ(table_.find("POST", "/attempt/x/certify").route->answer(request, desk).status, 400);  // one is held already
  request.form = {{"reason", "The device was out of calibration"}};
  request.arguments["certificate"] = held[0].uuid;
  EXPECT_EQ(table_.find("POST", "/certificate/x/revoke").route->answer(request, desk).location,
            "/trainee/steady#certificates");
  EXPECT_NE(table_.find("GET", "/trainee/x").route->answer(request, desk).body.find("(withdrawn)"), std::string::npos);
}

TEST_F(DeskRoutes, ATraineeComparesOwnAttemptsOnly) {
  std::string other;
  for (const AttemptSummary& attempt : AttemptStore(database_).list())
    if (attempt.trainee != trainee_) other = attempt.uuid;
  staff_ = Account{"a-2", "tr", "Trainee", Role::kTrainee, trainee_};
  EXPECT_EQ(ask("GET", "/compare/" + attempt_ + "/" + other).status, 403);
  EXPECT_EQ(ask("GET", "/compare/" + attempt_ + "/" + attempt_).status, 200);
  const CheckedPage own = page("/attempt/" + attempt_);
  EXPECT_EQ(own.by_id("note-text"), nullptr);
  EXPECT_EQ(own.by_id("sign-meaning"), nullptr);
}

TEST_F(DeskRoutes, RulesArePreviewedSavedAndRefusedWithTheirPlace) {
  EXPECT_NE(page("/curriculum").by_id("cur-toml")->text.find(kRules), std::string::npos);
  const Response preview = ask("POST", "/curriculum", {{"do", "preview"}, {"name", kRulesName}, {"toml", kRules}});
  EXPECT_EQ(preview.status, 200);
  EXPECT_NE(preview.body.find("would pass today"), std::string::npos);
  EXPECT_FALSE(CurriculumStore(database_).newest(kRulesName));
  EXPECT_EQ(ask("POST", "/curriculum", {{"do", "save"}, {"name", kRulesName}, {"toml", kRules}}).status, 303);
  EXPECT_EQ(CurriculumStore(database_).newest(kRulesName)->version, 1);
  const Response bad =
      ask("POST", "/curriculum", {{"do", "save"}, {"name", kRulesName}, {"toml", "version = \"8\"\nnonsense = 1\n"}});
  EXPECT_EQ(bad.status, 400);
  EXPECT_NE(bad.body.find("standard:2:"), std::string::npos);
  EXPECT_NE(bad.body.find("nonsense = 1"), std::string::npos);  // the text is not lost
  EXPECT_EQ(CurriculumStore(database_).newest(kRulesName)->version, 1);
}

TEST_F(DeskRoutes, BenchmarksComeFromPeopleAndSayHowMany) {
  const AttemptSummary newest = *AttemptStore(database_).latest();
  std::map<std::string, std::string> form = {{"do", "preview"},       {"exercise", newest.exercise_id},
                                             {"level", newest.level}, {"metric", "score"},
                                             {"rule", "fixed"},       {"fixed", "81.5"}};
  const Response preview = ask("POST", "/curriculum/benchmark", form);
  EXPECT_EQ(preview.status, 200);
  EXPECT_NE(preview.body.find("<strong>Score 81.5</strong>"), std::string::npos);
  EXPECT_TRUE(CurriculumStore(database_).benchmarks().empty());
  form["do"] = "save";
  EXPECT_EQ(ask("POST", "/curriculum/benchmark", form).status, 303);
  ASSERT_EQ(CurriculumStore(database_).benchmarks().size(), 1U);
  EXPECT_DOUBLE_EQ(CurriculumStore(database_).benchmarks()[0].full_at, 81.5);
  form["rule"] = "mean-2sd";
  form["who"] = "trainee:" + newest.trainee;
  const Response one = ask("POST", "/curriculum/benchmark", form);
  EXPECT_EQ(one.status, 400);
  EXPECT_NE(one.body.find("At least three people"), std::string::npos);
  form["rule"] = "fixed";
  form["fixed"] = "8x";
  EXPECT_EQ(ask("POST", "/curriculum/benchmark", form).status, 400);
  form["fixed"] = "3";
  form["metric"] = "time_s";
  EXPECT_NE(ask("POST", "/curriculum/benchmark", form).body.find("which way is better"), std::string::npos);
}

TEST_F(DeskRoutes, GroupsAreJoinedAndLeft) {
  EXPECT_EQ(ask("POST", "/curriculum/group", {{"do", "join"}, {"trainee", trainee_}, {"group", "evening"}}).status,
            303);
  EXPECT_EQ(CurriculumStore(database_).members("evening"), std::vector<std::string>{trainee_});
  EXPECT_NE(page("/curriculum").by_id("groups")->text.find("evening 1 trainee"), std::string::npos);
  EXPECT_EQ(ask("POST", "/curriculum/group", {{"do", "leave"}, {"trainee", trainee_}, {"group", "evening"}}).status,
            303);
  EXPECT_TRUE(CurriculumStore(database_).members("evening").empty());
  EXPECT_EQ(ask("POST", "/curriculum/group", {{"do", "dance"}, {"trainee", trainee_}, {"group", "evening"}}).status,
            400);
  EXPECT_EQ(ask("POST", "/curriculum/group", {{"do", "join"}, {"trainee", "nobody"}, {"group", "evening"}}).status,
            400);
}

TEST_F(DeskRoutes, WhoMaySeeWhat) {
  const std::vector<std::string> record = {"/accounts", "/record", "/audit", "/retention", "/demo", "/roster/pins"};
  for (const Route& route : desk_routes()) {
    const bool open = route.path == "/style.css" || route.path == "/desk.js" || route.path == "/icon.svg";
    const bool read =
        route.method == "GET" || route.path == "/attempt/{attempt}/film";  // a film adds nothing to the record
    const bool own =
        read && (route.path.find("{code}") != std::string::npos || route.path.find("{attempt}") != std::string::npos ||
                 route.path.find("{certificate}") != std::string::npos);
    const bool of_record = !(route.path == "/roster/pins" && route.method == "GET") &&  // which leads to the roster
                           std::any_of(record.begin(), record.end(),
                                       [&](const std::string& part) { return route.path.starts_with(part); });
    EXPECT_EQ(route.audience, open                        ? Audience::kEverybody
                              : route.path == "/password" ? Audience::kSignedIn
                              : own                       ? Audience::kOwnData
                              : of_record                 ? Audience::kAdministrators
                                                          : Audience::kInstructors)
        << route.method << " " << route.path;
  }
}

TEST_F(DeskRoutes, RulesThatCannotBeReadLeaveThoseBeforeThemInForce) {
  CurriculumStore store(database_);
  store.add(kRulesName, kRules, {});
  const std::string version = rules_in_force(database_).version;
  store.add(kRulesName, "version = \"9\"\n[unlock]\nfuture = 3\n", {});  // of a newer program
  EXPECT_EQ(rules_in_force(database_).version, version);
  for (const char* path : {"/", "/curriculum"}) {
    const Response shown = ask("GET", path);
    EXPECT_EQ(shown.status, 200) << path;
    EXPECT_NE(shown.body.find("Newer rules are kept here and do not rule: curriculum standard, version 2"),
              std::string::npos)
        << path;
  }
  const std::string mended = "version = \"10\"\n";
  EXPECT_EQ(ask("POST", "/curriculum",
                {{"do", "save"},
                 {"name", kRulesName},
                 {"toml", mended},
                 {"seen_name", kRulesName},
                 {"seen", store.newest(kRulesName)->uuid}})
                .status,
            303);
  EXPECT_EQ(rules_in_force(database_).version, "10");
  EXPECT_EQ(ask("GET", "/").body.find("Newer rules"), std::string::npos);
}

TEST_F(DeskRoutes, WhoseTrainingDataWereErasedIsInNoLineAndNoCount) {
  const auto lines = [&] { return cohort_lines(database_, rules_in_force(database_), {}, "2026-06-01T10:00:00Z"); };
  const auto of_them = [&](const std::string& who) {
    const auto all = lines();
    return std::count_if(all.begin(), all.end(), [&](const CohortLine& line) { return line.trainee == who; });
  };
  ASSERT_GT(of_them(trainee_), 0);
  const std::string count = "8 trainees, 98 tries";
  EXPECT_NE(ask("GET", "/").body.find(count), std::string::npos);
  int left = 0;
  for (const CohortLine& line : lines()) left += line.trainee == trainee_ ? 0 : line.tries;
  const std::string uuid =
      erase_trainee(database_, trainee_, ErasureKind::kTraining, "request of the person", {"", "Ida"}).trainee_uuid;
  const std::string who = "erased-" + uuid.substr(28);
  EXPECT_EQ(of_them(who), 0);
  const std::string cohort = ask("GET", "/").body;
  EXPECT_NE(cohort.find("7 trainees, " + std::to_string(left) + " tries, 1 erased and left out"), std::string::npos);
  EXPECT_EQ(cohort.find(who), std::string::npos);
  EXPECT_EQ(ask("GET", "/cohort.csv").body.find(who), std::string::npos);
  EXPECT_EQ(ask("GET", "/curriculum").body.find(who), std::string::npos) << "nobody puts them into a group";
  const TraineeDetail picture = trainee_detail(database_, who, rules_in_force(database_), "2026-06-01T10:00:00Z");
  EXPECT_TRUE(picture.training_erased);
  EXPECT_TRUE(picture.curves.empty() && picture.weeks.empty());
  const CheckedPage page_of_them = page("/trainee/" + who);
  EXPECT_EQ(page_of_them.problems, std::vector<std::string>{});
  const std::string body = ask("GET", "/trainee/" + who).body;
  EXPECT_NE(body.find("The training data were erased"), std::string::npos);
}

TEST_F(DeskRoutes, WhoseIdentityWasErasedIsJudgedOnUnderACodeThatTellsNobody) {
  const auto before = cohort_lines(database_, rules_in_force(database_), {}, "2026-06-01T10:00:00Z").size();
  erase_trainee(database_, trainee_, ErasureKind::kIdentity, "request of the person", {"", "Ida"});
  EXPECT_EQ(cohort_lines(database_, rules_in_force(database_), {}, "2026-06-01T10:00:00Z").size(), before);
  EXPECT_EQ(ask("GET", "/").body.find("left out"), std::string::npos);
}

TEST_F(DeskRoutes, AbilitiesOfOthersDoNotFollowFromWhatWasErased) {
  const auto tries = [&] {
    for (const Trainee& one : TraineeStore(database_).list())
      if (one.code != trainee_ && !one.code.starts_with("erased-"))
        return trainee_detail(database_, one.code, rules_in_force(database_), "2026-06-01T10:00:00Z").rasch_attempts;
    return 0;
  };
  const int before = tries();
  int theirs = 0;  // what the device ended says nothing of anybody's ability
  for (const AttemptSummary& one : AttemptStore(database_).list({trainee_, "", 0}))
    theirs += one.status != "fault" && one.status != "void";
  erase_trainee(database_, trainee_, ErasureKind::kTraining, "request of the person", {"", "Ida"});
  EXPECT_EQ(tries(), before - theirs);
}

class DeskFolders : public TemporaryFolder {};

/// On the command line a message may say where a file lies; a browser is somewhere else.
TEST_F(DeskFolders, NoPageTellsWhereTheRecordLies) {
  Database database(folder_ / "my record" / "t.db");
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start("T-1"));
  std::filesystem::create_directories(id.recording.parent_path());
  std::ofstream(id.recording) << "motion";
  AttemptResult result = sample_result();
  result.recording_sha256 = digest::of_bytes("motion");
  store.finish_attempt(id, result);
  Desk desk{database, {}, false};
  desk.sources.trace = [](const std::filesystem::path& file) -> Trace {
    throw InputError(file.string() + ": is damaged");
  };
  desk.sources.picture = [&](const std::string&, double, int) -> std::string {
    throw EnvironmentError(folder_.string() + "/x: no room");
  };
  const RouteTable table(desk_routes());
  const auto body = [&](const std::string& path, std::map<std::string, std::string> query = {}) {
    const RouteTable::Found found = table.find("GET", path);
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    request.query = std::move(query);
    request.account = Account{"a-1", "ines", "Ines", Role::kInstructor};
    request.now_utc = "2026-06-01T10:00:00Z";
    return found.route->answer(request, desk).body;
  };
  const auto clean = [&](const std::string& page, const std::string& says) {
    EXPECT_EQ(page.find(folder_.string()), std::string::npos) << page;
    EXPECT_EQ(page.find("my record"), std::string::npos) << page;
    EXPECT_NE(page.find(says), std::string::npos) << says << " is not in\n" << page;
  };
  clean(body("/attempt/" + id.uuid), "The recording cannot be read: ");
  clean(body("/attempt/" + id.uuid + "/picture.png", {{"t", "1"}}), "X: no room");
  clean(body("/trainee/T-9"), "no trainee");
  std::filesystem::remove(id.recording);
  clean(body("/attempt/" + id.uuid), "The recording is not in its place any more.");
  erase_trainee(database, "T-1", ErasureKind::kTraining, "request of the person", {"", "Ida"});
  clean(body("/attempt/" + id.uuid), "The recording was erased with the training data.");
}

TEST_F(DeskRoutes, AFormThatIsSentTwiceSignsOnce) {
  const std::map<std::string, std::string> form{{"meaning", "review"}, {"note", ""}};
  EXPECT_EQ(ask("POST", "/attempt/" + attempt_ + "/sign", form).status, 303);
  const Response second = ask("POST", "/attempt/" + attempt_ + "/sign", form);
  EXPECT_EQ(second.status, 400);
  EXPECT_NE(second.body.find("Already signed"), std::string::npos);
  EXPECT_EQ(AssessmentStore(database_).signatures_of(attempt_).size(), 1u);
}

}  // namespace
}  // namespace trocar::review::desk_routes_test
