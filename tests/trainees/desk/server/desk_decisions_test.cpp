// Decisions that count, over every route: what is decided is seen on every page and file, certificates where they hold,
// benchmarks that can be, versions that are one, attempts found by what is shown.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/report_views.h"
#include "trainees/desk/routes/route_table.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review::desk_decisions_test {
namespace {

constexpr const char* kReason = "The stand slipped twice in it";

/// novice-1 and novice-2 spread the scores; "steady" has shown competence in 30 attempts, "new" failed 14 times.
class DeskDecisions : public testing::Test {
 protected:
  DeskDecisions() : database_(":memory:"), desk_{database_, {}, false}, table_(desk_routes()) {
    desk_.sources.shipped_rules = "version = \"7\"\n";
    practise("novice-1", 5, 60);
    practise("novice-2", 5, 52);
    last_ = practise("steady", 30, 90);
    failed_ = practise("new", 14, 55);
  }

  AttemptId practise(const std::string& trainee, int attempts, double score,
                     AttemptStatus status = AttemptStatus::kCompleted) {
    AttemptId last;
    for (int i = 0; i < attempts; ++i) {
      AttemptStart start = sample_start(trainee);
      start.board = i;
      AttemptResult result = sample_result(score + i % 3);
      result.grade.status = status;
      result.grade.caps.clear();
      result.events.pop_back();
      for (Subscore& part : result.grade.subscores) part.value = 0.01 * score;
      last = store_attempt(database_, start, result);
    }
    return last;
  }

  Response ask(const std::string& method, const std::string& path, std::map<std::string, std::string> values = {}) {
    const RouteTable::Found found = table_.find(method, path);
    if (found.route == nullptr) return Response{.status = 405};
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    (method == "GET" ? request.query : request.form) = std::move(values);
    request.account = who_;
    request.token = "token-4711";
    request.now_utc = "2026-06-01T10:00:00Z";
    return found.route->answer(request, desk_);
  }
  std::string text(const std::string& path, const std::string& id, std::map<std::string, std::string> values = {}) {
    const Response answer = ask("GET", path, std::move(values));
    EXPECT_EQ(answer.status, 200) << path;
    const CheckedPage page = check_page(answer.body);
    EXPECT_EQ(page.problems, std::vector<std::string>{}) << path;
    const PageElement* element = page.by_id(id);
    EXPECT_NE(element, nullptr) << path << " " << id;
    return element == nullptr ? "" : element->text;
  }
  void decide(const AttemptId& id, bool passed) {
    EXPECT_EQ(ask("POST", "/attempt/" + id.uuid + "/override", {{"passed", passed ? "yes" : "no"}, {"reason", kReason}})
                  .status,
              303);
  }
  static std::string path_of(const AttemptId& id) { return "/attempt/" + id.uuid; }

  Database database_;
  Desk desk_;
  RouteTable table_;
  Account who_{"a-1", "ines", "Dr Ines Okafor", Role::kInstructor};
  AttemptId last_, failed_;
};

TEST_F(DeskDecisions, ADecisionIsSeenOnEveryPageAndFile) {
  decide(failed_, true);
  const CheckedPage attempt = check_page(ask("GET", path_of(failed_)).body);
  const std::string verdict = attempt.all("section", "verdict pass").at(0)->text;
  EXPECT_EQ(verdict.find("Pass by decision"), 0u) << verdict;
  EXPECT_NE(verdict.find("The score says: not yet."), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("56.0 of 100"), std::string::npos) << verdict;
  const std::string curve = text("/trainee/new", "curve"), attempts = text("/trainee/new", "attempts");
  EXPECT_NE(curve.find("Passed1Decided by a person1"), std::string::npos) << curve;
  EXPECT_NE(curve.find("in a diamond: decided by a person"), std::string::npos) << curve;
  EXPECT_NE(attempts.find("passed by decision of Dr Ines Okafor"), std::string::npos) << attempts;
  EXPECT_NE(ask("GET", "/trainee/new").body.find("class=\"decided\""), std::string::npos);
  EXPECT_EQ(text("/trainee/steady", "curve").find("diamond"), std::string::npos);
  const std::string csv = ask("GET", "/trainee/new/attempts.csv").body;
  EXPECT_NE(csv.find(",completed,56,1,0,Dr Ines Okafor,0\r\n"), std::string::npos) << csv;
  const std::string one = ask("GET", path_of(failed_) + "/attempt.csv").body;
  EXPECT_NE(one.find(",verdict,passed,1,"), std::string::npos);
  EXPECT_NE(one.find(",verdict,passed_by_score,0,"), std::string::npos);
  EXPECT_NE(one.find(",decision,Dr Ines Okafor,1,"), std::string::npos);
  EXPECT_NE(ask("GET", "/compare/" + failed_.uuid + "/" + last_.uuid)
                .body.find("pass by decision of <span translate=\"no\">Dr Ines Okafor"),
            std::string::npos);
  EXPECT_NE(ask("GET", "/").body.find("1 by decision"), std::string::npos);
  EXPECT_NE(ask("GET", "/cohort.csv").body.find("n,decided,reliability,rules"), std::string::npos);
}

TEST_F(DeskDecisions, ACertificateCitesWhatIsPassedAndNamesDecisionsAndReliability) {
  decide(last_, false);
  EXPECT_EQ(ask("POST", path_of(last_) + "/certify").status, 400);
  EXPECT_NE(text(path_of(last_), "sign").find("This attempt is not passed, so no certificate can cite it"),
            std::string::npos);
  EXPECT_TRUE(AssessmentStore(database_).certificates_of("").empty());
  decide(last_, true);
  EXPECT_EQ(ask("POST", path_of(last_) + "/certify").status, 303);
  const auto held = AssessmentStore(database_).certificates_of("steady");
  ASSERT_EQ(held.size(), 1u);
  const auto evidence = nlohmann::json::parse(held[0].evidence);
  EXPECT_EQ(evidence["attempt"], last_.uuid);
  EXPECT_EQ(evidence["decided"], 1);
  EXPECT_GT(evidence["reliability"].get<double>(), 0.7);
  ASSERT_EQ(evidence["overrides"].size(), 1u) << "the newest of each attempt";
  EXPECT_EQ(evidence["overrides"][0]["passed"], true);
  EXPECT_EQ(evidence["overrides"][0]["by"], "Dr Ines Okafor");
  const std::string shown = text("/trainee/steady", "certificates");
  EXPECT_NE(shown.find("passed by decision of Dr Ines Okafor, "), std::string::npos) << shown;
  EXPECT_NE(shown.find("; reliability over 0.99;"), std::string::npos) << shown;
}

TEST_F(DeskDecisions, TheAttemptsPageShowsTheCertificatesThatHoldAndWhoGaveThem) {
  EXPECT_NE(text(path_of(failed_), "sign").find("A certificate cannot be given now"), std::string::npos);
  ASSERT_EQ(ask("POST", path_of(last_) + "/certify").status, 303);
  const std::string sign = text(path_of(last_), "sign");
  EXPECT_EQ(sign.find("No certificate"), std::string::npos) << sign;
  EXPECT_NE(sign.find("Certificate for surface-touch L1"), std::string::npos) << sign;
  EXPECT_NE(sign.find("Dr Ines Okafor, rules 1, cites this attempt"), std::string::npos) << sign;
  const AttemptSummary other = AttemptStore(database_).list({"steady", "", 2}).back();
  const std::string beside = text("/attempt/" + other.uuid, "sign");
  EXPECT_NE(beside.find("Certificate for surface-touch L1"), std::string::npos) << beside;
  EXPECT_EQ(beside.find("cites this attempt"), std::string::npos) << beside;
  decide(last_, false);
  EXPECT_NE(
      text(path_of(last_), "sign").find("In question: the attempt that it cites was decided not passed by Dr Ines"),
      std::string::npos);
  const std::string uuid = AssessmentStore(database_).certificates_of("steady")[0].uuid;
  ASSERT_EQ(ask("POST", "/certificate/" + uuid + "/revoke", {{"reason", kReason}}).status, 303);
  EXPECT_NE(text(path_of(last_), "sign").find("Withdrawn"), std::string::npos);
  who_ = Account{"a-2", "steady", "S", Role::kTrainee, "steady"};
  EXPECT_NE(text(path_of(last_), "sign").find("Certificate for surface-touch L1"), std::string::npos)
      << "the trainee sees it too";
}

TEST_F(DeskDecisions, ACertificateWhoseAttemptsNoLongerCountIsInQuestionEverywhere) {
  ASSERT_EQ(ask("POST", path_of(last_) + "/certify").status, 303);
  EXPECT_NE(ask("GET", "/", {{"state", "certified"}}).body.find("30 of 30 attempts passed"), std::string::npos)
      << "a state of its own, not learning";
  EXPECT_EQ(ask("GET", "/").body.find("class=\"badge in-question\""), std::string::npos);
  const AttemptSummary early = AttemptStore(database_).list({"steady", "", 0}).back();
  EXPECT_EQ(ask("POST", "/attempt/" + early.uuid + "/override", {{"passed", "no"}, {"reason", kReason}}).status, 303);
  const std::string why = "1 of the 30 attempts that it stands on was decided not passed by Dr Ines Okafor on ";
  for (const std::string& path : {path_of(last_), std::string("/trainee/steady"), std::string("/")})
    EXPECT_NE(ask("GET", path).body.find(why), std::string::npos) << path;
  EXPECT_NE(ask("GET", "/cohort.csv").body.find("in question"), std::string::npos);
  const std::string uuid = AssessmentStore(database_).certificates_of("steady")[0].uuid;
  const Response file = ask("GET", "/certificates.csv");
  EXPECT_NE(file.body.find(uuid), std::string::npos);
  EXPECT_NE(file.body.find("in question"), std::string::npos);
  EXPECT_EQ(file.download, "certificates.csv");
  EXPECT_NE(ask("GET", "/").body.find("href=\"/certificates.csv?\""), std::string::npos);
  const std::string sheet =
      certificate_file(desk_, uuid, {.format = ReportFormat::kHtml, .now_utc = "2026-06-01T10:00:00Z"});
  EXPECT_NE(sheet.find("IN QUESTION: " + why), std::string::npos) << sheet;
  EXPECT_NE(sheet.find("30 of 30 when it was given, 29 as they count now"), std::string::npos);
  EXPECT_NE(sheet.find("since: not passed, by Dr Ines Okafor"), std::string::npos);
  EXPECT_EQ(ask("POST", "/attempt/" + early.uuid + "/override", {{"passed", "yes"}, {"reason", kReason}}).status, 303);
  EXPECT_EQ(ask("GET", "/trainee/steady").body.find("In question"), std::string::npos) << "it holds again";
}

/// Put in by SQL: it is shown, counts for nothing and keeps the real one not out.
TEST_F(DeskDecisions, ACertificateThatNobodySignedIsInQuestionAndTheRealOneCanBeGiven) {
  const std::string uuid = "ffffffff-0000-7000-8000-000000000107", why = "it is not signed with the station";
  sql::execute(
      database_.connection(),
      ("INSERT INTO certificate (uuid, trainee_id, exercise_id, level, rule_version, evidence, author, printed,"
       " utc) SELECT '" +
       uuid +
       "', trainee_id, 'surface-touch', 'L1', '1', '{}', '', 'M', '2026-05-01T10:00:00.000Z' FROM"
       " person WHERE code = 'steady'")
          .c_str());
  const std::string before = text(path_of(last_), "sign");
  EXPECT_NE(before.find("In question: " + why), std::string::npos) << before;
  EXPECT_NE(before.find("Certify steady for"), std::string::npos) << before;
  EXPECT_NE(ask("GET", "/").body.find("a certificate is there: " + why), std::string::npos);
  EXPECT_NE(text("/trainee/steady", "certificates").find("In question: " + why), std::string::npos);
  EXPECT_NE(text("/trainee/steady", "due").find("Nothing is due."), std::string::npos);
  EXPECT_NE(certificate_file(desk_, uuid, {.format = ReportFormat::kHtml, .now_utc = "2026-06-01T10:00:00Z"})
                .find("IN QUESTION: " + why),
            std::string::npos);
  EXPECT_EQ(ask("POST", path_of(last_) + "/certify").status, 303);
  EXPECT_EQ(ask("GET", "/").body.find("class=\"badge in-question\""), std::string::npos) << "the real one is held";
  EXPECT_EQ(text(path_of(last_), "sign").find("Certify steady for"), std::string::npos);
}

TEST_F(DeskDecisions, ANoteThatNobodySignedIsMarked) {
  AssessmentStore(database_).add_note("new", failed_.uuid, "Slower.", {"a-1", "Dr Ines Okafor"});
  for (const std::string& path : {path_of(failed_), std::string("/trainee/new")})
    EXPECT_EQ(text(path, "notes").find("Not signed with the station"), std::string::npos) << path;
  sql::execute(database_.connection(),
               "INSERT INTO note (uuid, trainee_id, attempt_id, author, printed, text, utc) SELECT"
               " 'ffffffff-0000-7000-8000-000000000108', trainee_id, attempt_id, author, printed, 'Give up.', utc FROM"
               " note");
  for (const std::string& path : {path_of(failed_), std::string("/trainee/new")}) {
    const std::string notes = text(path, "notes");
    const std::size_t at = notes.find("Not signed with the station's key, or changed since");
    EXPECT_GT(at, notes.find("Give up.")) << notes;
    EXPECT_LT(at, notes.find("Slower.")) << notes;
  }
}

TEST_F(DeskDecisions, ReliabilityStandsBesideEveryDecision) {
  for (const auto& [path, id] :
       {std::pair<std::string, std::string>("/", "trainees"), {"/trainee/steady", "curve"}, {path_of(last_), "sign"}}) {
    const std::string said = text(path, id);
    EXPECT_NE(said.find("n = 30, reliability over 0.99, rules 1"), std::string::npos) << path << "\n" << said;
  }
  EXPECT_NE(check_page(ask("GET", "/").body)
                .all("section", "state ready")
                .at(0)
                ->text.find("n = 30, reliability over 0.99, rules 1"),
            std::string::npos);
}

TEST_F(DeskDecisions, AbilityAndDifficultySayWhatIsMissingOrTheirErrors) {
  EXPECT_NE(text("/trainee/new", "ability").find("54 of the 200 attempts"), std::string::npos);
  EXPECT_NE(text("/curriculum", "difficulties").find("54 of the 200 attempts"), std::string::npos);
  CurriculumStore(database_).add(
      kRulesName, "version = \"8\"\n[rasch]\nleast_attempts = 20\nlargest_standard_error = 3.0\n", {"", "Dr B"});
  decide(failed_, true);
  decide(last_, false);
  const std::string ability = text("/trainee/new", "ability"), difficulties = text("/curriculum", "difficulties");
  EXPECT_NE(ability.find("logit, standard error "), std::string::npos) << ability;
  EXPECT_NE(ability.find("n = 14, rules 8"), std::string::npos) << ability;
  EXPECT_NE(difficulties.find("surface-touch L1expert0.00"), std::string::npos)
      << difficulties << " one item: its difficulty is the zero";
}

TEST_F(DeskDecisions, BenchmarksAreOfKnownMetricsAndLawfulValues) {
  std::map<std::string, std::string> form = {
      {"do", "save"}, {"exercise", "surface-touch"}, {"level", "L1"}, {"metric", "score"}, {"rule", "fixed"}};
  const auto refused = [&](const std::string& metric, const std::string& fixed, const std::string& zero) {
    form["metric"] = metric;
    form["fixed"] = fixed;
    form["zero_at"] = zero;
    const Response answer = ask("POST", "/curriculum/benchmark", form);
    return answer.status == 400 ? check_page(answer.body).all("p", "error").at(0)->text : "saved";
  };
  EXPECT_EQ(refused("score", "-1", ""), "The number -1 is none that \"score\" can have: from 0 to 100.");
  EXPECT_EQ(refused("score", "101", ""), "The number 101 is none that \"score\" can have: from 0 to 100.");
  EXPECT_EQ(refused("force_max_n", "2", "-6"), "The number -6 is none that \"force_max_n\" can have: 0 or more.");
  EXPECT_EQ(refused("flair", "2", "6"), "There is no metric \"flair\". Known are: score, time_s, force_max_n, tremor.");
  desk_.sources.metrics = {"time_s", "sparc"};
  EXPECT_EQ(refused("force_max_n", "2", "6"), "There is no metric \"force_max_n\". Known are: score, time_s, sparc.");
  EXPECT_TRUE(CurriculumStore(database_).benchmarks().empty());
  EXPECT_EQ(refused("sparc", "-2", "-6"), "saved");
  Benchmark numbers;
  numbers.exercise_id = "surface-touch";
  numbers.level = "L1";
  numbers.metric = "score";
  numbers.source = numbers.rule = "x";
  numbers.full_at = 140;
  EXPECT_NE(message_of<InputError>([&] {
              CurriculumStore(database_).add_benchmark(numbers, {"", "Dr B"});
            }).find("from 0 to 100"),
            std::string::npos);
}

TEST_F(DeskDecisions, AFixedBenchmarkIsSetByAPersonAndOneOfPeopleSaysItsReliability) {
  std::map<std::string, std::string> form = {{"do", "preview"}, {"exercise", "surface-touch"},
                                             {"level", "L1"},   {"metric", "score"},
                                             {"rule", "fixed"}, {"fixed", "58"}};
  const std::string fixed = check_page(ask("POST", "/curriculum/benchmark", form).body).by_id("benchmarks")->text;
  EXPECT_NE(fixed.find("Set by a person, n = 0"), std::string::npos) << fixed;
  EXPECT_EQ(fixed.find("Fewer than 5"), std::string::npos) << fixed;
  EXPECT_NE(fixed.find("none is set now, so nobody is measured by one"), std::string::npos) << fixed;
  EXPECT_EQ(fixed.find("changes"), std::string::npos) << "nothing holds that could change";
  form["do"] = "save";
  ASSERT_EQ(ask("POST", "/curriculum/benchmark", form).status, 303);
  form["do"] = "preview";
  form["rule"] = "median";
  const std::string median = check_page(ask("POST", "/curriculum/benchmark", form).body).by_id("benchmarks")->text;
  EXPECT_NE(median.find("2 pass as it stands"), std::string::npos) << "steady and novice-1 reach 58: " << median;
  EXPECT_NE(median.find("Reliability of their means over 0.99, rules 1"), std::string::npos) << median;
  EXPECT_NE(median.find("Fewer than 5"), std::string::npos) << "four people";
  form["do"] = "save";
  ASSERT_EQ(ask("POST", "/curriculum/benchmark", form).status, 303);
  EXPECT_NE(CurriculumStore(database_).benchmarks()[0].source.find("(reliability of their means over 0.99, rules 1)"),
            std::string::npos);
  EXPECT_EQ(CurriculumStore(database_).benchmarks()[1].source, "a person's decision (rules 1)");
}

TEST_F(DeskDecisions, TheLocalInstructorIsNamedAsAuthor) {
  who_ = Account{"", "local", "Local instructor", Role::kAdministrator};
  ASSERT_EQ(ask("POST", "/curriculum", {{"do", "save"}, {"name", kRulesName}, {"toml", "version = \"2026\"\n"}}).status,
            303);
  ASSERT_EQ(ask("POST", "/curriculum/benchmark",
                {{"do", "save"},
                 {"exercise", "surface-touch"},
                 {"level", "L1"},
                 {"metric", "score"},
                 {"rule", "fixed"},
                 {"fixed", "80"}})
                .status,
            303);
  EXPECT_EQ(CurriculumStore(database_).newest(kRulesName)->author, "Local instructor");
  EXPECT_EQ(CurriculumStore(database_).benchmarks()[0].author, "Local instructor");
  EXPECT_NE(text("/curriculum", "versions").find("Local instructor"), std::string::npos);
  EXPECT_NE(text("/curriculum", "benchmarks").find("Local instructor"), std::string::npos);
  EXPECT_EQ(database_.check(), std::vector<std::string>{});
}

TEST_F(DeskDecisions, OneVersionOfRulesIsOneText) {
  const auto save = [&](const std::string& name, const std::string& toml) {
    const auto last = CurriculumStore(database_).newest(name);
    return ask("POST", "/curriculum",
               {{"do", "save"}, {"name", name}, {"toml", toml}, {"seen_name", name}, {"seen", last ? last->uuid : ""}});
  };
  const std::string longer = "version = \"7\"\n[stuck]\nattempts = 6\n";
  EXPECT_NE(save(kRulesName, longer).body.find("the one that came with the program"), std::string::npos);
  ASSERT_EQ(save(kRulesName, "version = \"2026-1\"\n").status, 303);
  ASSERT_EQ(save(kRulesName, "version = \"2026-2\"\n").status, 303);
  const Response taken = save("trial", "version = \"2026-1\"\n[stuck]\nattempts = 6\n");
  EXPECT_EQ(taken.status, 400);
  EXPECT_NE(taken.body.find("as no. 1; every decision names its version"), std::string::npos);
  EXPECT_FALSE(CurriculumStore(database_).newest("trial"));
  EXPECT_EQ(save("trial", "version = \"2026-1\"\n").status, 303) << "the same text may bear another name";
  const std::string versions = text("/curriculum", "versions");
  EXPECT_NE(versions.find("standard, version 2026-22"), std::string::npos)
      << versions << " version 2026-2, saved as no. 2";
  EXPECT_NE(versions.find("No. counts the texts"), std::string::npos);
}

TEST_F(DeskDecisions, AttemptsAreFoundByTheNumberThatIsShown) {
  const std::string number = std::to_string(failed_.row);
  EXPECT_NE(text("/trainee/new", "attempts").find("No. " + number), std::string::npos);
  EXPECT_NE(ask("GET", path_of(failed_)).body.find("attempt no. " + number + ","), std::string::npos);
  EXPECT_EQ(ask("GET", "/attempt/" + number).status, 200);
  EXPECT_EQ(ask("GET", "/compare", {{"attempt", last_.uuid}, {"other", number}}).location,
            "/compare/" + last_.uuid + "/" + failed_.uuid);
  EXPECT_EQ(ask("GET", "/compare/" + number + "/1").status, 200);
  EXPECT_EQ(ask("POST", "/attempt/" + number + "/note", {{"text", "Seen"}}).location, path_of(failed_) + "#notes");
  const Response unknown = ask("GET", "/attempt/4711");
  EXPECT_EQ(unknown.status, 404);
  EXPECT_NE(unknown.body.find("Attempt 4711: not in this database"), std::string::npos) << unknown.body;
  EXPECT_EQ(ask("GET", "/attempt/4711x").status, 404);
}

TEST_F(DeskDecisions, WhatIsAskedAndNotThereIsSaid) {
  for (const auto& [path, query] : std::vector<std::pair<std::string, std::map<std::string, std::string>>>{
           {"/trainee/new", {{"exercise", "juggling"}}},
           {"/trainee/new", {{"exercise", "surface-touch"}, {"level", "L9"}}},
           {"/trainee/new", {{"rubric", "ffff"}}},
           {"/trainee/new/attempts.csv", {{"hand", "foot"}}},
           {"/curriculum", {{"name", "nobody's"}}},
           {"/curriculum", {{"name", kRulesName}, {"version", "3"}}}}) {
    const Response answer = ask("GET", path, query);
    EXPECT_EQ(answer.status, 404) << path << " " << query.begin()->second;
    EXPECT_EQ(check_page(answer.body).problems, std::vector<std::string>{});
  }
  EXPECT_NE(ask("GET", "/trainee/new", {{"exercise", "juggling"}})
                .body.find("There is no attempt of new that counts of juggling"),
            std::string::npos);
  EXPECT_EQ(ask("GET", "/curriculum", {{"name", kRulesName}}).status, 200) << "the shipped rules, nothing saved yet";
}

TEST_F(DeskDecisions, AllAttemptsAreReachedPageByPageAndTheFileHasThoseThatTheDeviceEnded) {
  practise("steady", 1, 80, AttemptStatus::kVoid);
  const CheckedPage first = check_page(ask("GET", "/trainee/steady").body);
  EXPECT_NE(first.by_id("attempts")->text.find("Attempts 1 to 12 of 31, newest first"), std::string::npos)
      << first.by_id("attempts")->text;
  EXPECT_NE(first.by_id("attempts")->text.find("ended by the device: not counted, passes in a row begin anew"),
            std::string::npos);
  EXPECT_NE(ask("GET", "/trainee/steady").body.find("hand=expert&amp;rubric="), std::string::npos);
  const std::string last = text("/trainee/steady", "attempts", {{"page", "3"}});
  EXPECT_NE(last.find("Attempts 25 to 31 of 31"), std::string::npos) << last;
  EXPECT_NE(last.find("No. 111"), std::string::npos) << "No. 11, try 1: the oldest: " << last;
  EXPECT_NE(text("/trainee/steady", "attempts", {{"page", "99"}}).find("25 to 31"), std::string::npos);
  EXPECT_EQ(text("/trainee/novice-1", "attempts").find(" of "), std::string::npos) << "five need no pages";
  const std::string csv = ask("GET", "/trainee/steady/attempts.csv").body;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 32);
  EXPECT_NE(csv.find(",void,"), std::string::npos);
}

}  // namespace
}  // namespace trocar::review::desk_decisions_test
