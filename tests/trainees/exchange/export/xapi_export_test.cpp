// Statements from a database: one an attempt, each sound, with what the database knows besides the result.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/trainees/exchange/export/export_samples.h"
#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/exchange/export/xapi_export.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"

namespace trocar::xapi_export_test {
namespace {

using nlohmann::json;

std::optional<double> mark_of_70(const std::string& toml, const std::string& level) {
  EXPECT_EQ(toml, "id = \"surface-touch\"\n");
  EXPECT_EQ(level, "L1");
  return 70;
}

json written(Database& database, const ExportFilter& filter, const PassMark& mark, const XapiSetting& setting = {}) {
  std::ostringstream out;
  write_xapi(database, choose_attempts(database, filter), setting, mark, out);
  return json::parse(out.str());
}

const char* const kLaunch = R"({"activityId": "https://lms.example/au/1", "publisherId": "https://course.example/touch",
  "registration": "b22893ae-a13e-406f-abb6-fd463ed7c645", "sessionId": "s7", "masteryScore": 0.5, "moveOn": "Passed",
  "actor": {"homePage": "https://lms.example/", "name": "learner-12"}})";

TEST(XapiExport, OneStatementAFinishedAttempt) {
  Database database(":memory:");
  const AttemptId first = store_attempt(database, sample_start("A"), sample_result());
  store_attempt(database, sample_start("B"), sample_result(20));
  AttemptResult dead = sample_result();
  dead.grade.status = AttemptStatus::kAborted;
  dead.grade.score.reset();
  store_attempt(database, sample_start("A"), dead);
  AttemptStore(database).begin_attempt(sample_start("A"));
  const json all = written(database, {}, mark_of_70);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0]["verb"]["display"]["en"], "passed");
  EXPECT_EQ(all[1]["verb"]["display"]["en"], "failed");
  EXPECT_EQ(all[2]["verb"]["display"]["en"], "attempted");
  EXPECT_EQ(all[0]["actor"]["account"]["name"], TraineeStore(database).find("A")->uuid);
  EXPECT_EQ(all[0]["context"]["extensions"]["https://w3id.org/xapi/cmi5/context/extensions/masteryscore"], 0.7);
  EXPECT_EQ(all[0]["timestamp"].get<std::string>().size(), 24u);
  EXPECT_EQ(all[0]["result"]["extensions"]["https://trocar.invalid/xapi/extension/row-hash"].get<std::string>().size(),
            64u);
  EXPECT_EQ(written(database, {"B", "", ""}, mark_of_70).size(), 1u);
  EXPECT_EQ(read_xapi_attempt(database, first.row, {}).pass_at, std::nullopt)
      << "no reader of rulesets, no mastery score";
  EXPECT_THROW(read_xapi_attempt(database, 99, {}), InputError);
}

using XapiExportOnDisk = TemporaryFolder;

TEST_F(XapiExportOnDisk, StatesNoScoreThatSomebodyChanged) {
  Database database(folder_ / "t.db");
  const AttemptId id = store_attempt(database, sample_start("A"), sample_result(20));
  EXPECT_EQ(written(database, {}, mark_of_70).size(), 1u);
  ASSERT_EQ(run_without_triggers(folder_ / "t.db", "UPDATE score SET value = 99, passed = 1"), "");
  EXPECT_NE(message_of<InputError>([&] { written(database, {}, mark_of_70); }).find(id.uuid), std::string::npos);
}

TEST(XapiExport, TheNewestSignersAccountIsTheInstructor) {
  Database database(":memory:");
  const AttemptId id = store_attempt(database, sample_start("A"), sample_result());
  EXPECT_FALSE(written(database, {}, {})[0]["context"].contains("instructor"));
  AssessmentStore assessments(database);
  assessments.sign(id.uuid, "review", "", {"", "before anybody had an account"});
  EXPECT_FALSE(written(database, {}, {})[0]["context"].contains("instructor"));
  AccountStore accounts(database);
  const Account one = accounts.add("one", "Dr One", Role::kInstructor, "", "long enough to sign in", "");
  const Account two = accounts.add("two", "Dr Two", Role::kInstructor, "", "long enough to sign in", "");
  assessments.sign(id.uuid, "review", "", {one.uuid, one.name});
  assessments.sign(id.uuid, "approval", "", {two.uuid, two.name});
  const json statement = written(database, {}, {}, {"https://hospital.example/"})[0];
  EXPECT_EQ(statement["context"]["instructor"]["account"],
            (json{{"homePage", "https://hospital.example/"}, {"name", two.uuid}}));
  EXPECT_EQ(statement.dump().find("Dr Two"), std::string::npos);
}

TEST(XapiExport, ACohortIsSoundThroughout) {
  Database database(":memory:");
  test::CohortPlan plan;
  plan.attempts = 80;
  fill_cohort(database, plan);
  const json all = written(database, {}, {});
  EXPECT_EQ(all.size(), 80u);
  std::set<std::string> ids;
  for (const json& statement : all) {
    EXPECT_EQ(xapi_problems(statement.dump()), std::vector<std::string>{});
    ids.insert(statement["id"]);
  }
  EXPECT_EQ(ids.size(), 80u);
}

TEST(XapiExport, ABadHomePageIsRefused) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result());
  EXPECT_NE(message_of<InputError>([&] { written(database, {}, {}, {"hospital"}); }).find("no absolute URL"),
            std::string::npos);
  EXPECT_THROW(written(database, {}, {}, {""}), InputError);
}

TEST(XapiExport, WhatWouldBreakTheStandardIsNotWritten) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result());
  const PassMark none = [](const std::string&, const std::string&) { return std::optional<double>(); };
  std::ostringstream out;
  Cmi5Launch launch = parse_cmi5_launch(kLaunch, "launch.json");
  launch.registration = "not a UUID";
  const std::string message =
      message_of<InputError>([&] { write_cmi5(database, choose_attempts(database, {}), launch, none, out); });
  EXPECT_NE(message.find("context.registration: is no UUID"), std::string::npos);
  EXPECT_NE(message.find(AttemptStore(database).latest()->uuid), std::string::npos);
}

TEST(Cmi5Export, ALaunchIsAnsweredByTheNewestAttempt) {
  Database database(":memory:");
  store_attempt(database, sample_start("A"), sample_result(10));
  AttemptResult newest = sample_result(60);
  newest.grade.caps.clear();
  store_attempt(database, sample_start("A"), newest);
  std::ostringstream out;
  write_cmi5(database, choose_attempts(database, {}), parse_cmi5_launch(kLaunch, "launch.json"), {}, out);
  const json statements = json::parse(out.str());
  ASSERT_EQ(statements.size(), 2u);
  EXPECT_EQ(statements[0]["verb"]["display"]["en"], "completed");
  EXPECT_EQ(statements[1]["verb"]["display"]["en"], "passed");
  EXPECT_EQ(statements[1]["result"]["score"]["raw"], 60);
  store_attempt(database, sample_start("B"), sample_result());
  EXPECT_NE(message_of<InputError>([&] {
              write_cmi5(database, choose_attempts(database, {}), parse_cmi5_launch(kLaunch, "launch.json"), {}, out);
            }).find("of one trainee"),
            std::string::npos);
}

TEST(Cmi5Export, LaunchDataIsReadStrictly) {
  const Cmi5Launch launch = parse_cmi5_launch(kLaunch, "launch.json");
  EXPECT_EQ(launch.activity_id, "https://lms.example/au/1");
  EXPECT_EQ(launch.publisher_id, "https://course.example/touch");
  EXPECT_EQ(launch.session_id, "s7");
  EXPECT_EQ(launch.account, "learner-12");
  EXPECT_EQ(launch.mastery_score, 0.5);
  const auto message = [](const std::string& pointer, const json& value) {
    json data = json::parse(kLaunch);
    data[json::json_pointer(pointer)] = value;
    return message_of<InputError>([&] { parse_cmi5_launch(data.dump(), "launch.json"); });
  };
  EXPECT_NE(message("/activityId", "au 1").find("no absolute IRI"), std::string::npos);
  EXPECT_NE(message("/registration", "1").find("no UUID"), std::string::npos);
  EXPECT_NE(message("/sessionId", "").find("launch.json: \"sessionId\" is missing"), std::string::npos);
  EXPECT_NE(message("/actor", 1).find("actor: \"homePage\""), std::string::npos);
  EXPECT_NE(message("/masteryScore", 75).find("masteryScore"), std::string::npos);
  EXPECT_NE(message("/masteryScore", nullptr).find("masteryScore"), std::string::npos);
  EXPECT_THROW(parse_cmi5_launch("[]", "launch.json"), InputError);
  EXPECT_THROW(parse_cmi5_launch("{", "launch.json"), InputError);
}

}  // namespace
}  // namespace trocar::xapi_export_test
