// Statements field by field; each is sound; neither code nor name gets out.
#include <nlohmann/json.hpp>

#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/named_uuid.h"
#include "trainees/exchange/export/xapi.h"

namespace trocar::xapi_test {
namespace {

using nlohmann::json;
using test::sample_xapi;

constexpr const char* kMastery = "https://w3id.org/xapi/cmi5/context/extensions/masteryscore";
constexpr const char* kVerb = "http://adlnet.gov/expapi/verbs/";

/// Parsed, after it has passed the validator.
json sound(const std::string& statement) {
  EXPECT_EQ(xapi_problems(statement), std::vector<std::string>{}) << statement;
  EXPECT_EQ(statement.find('\n'), std::string::npos);
  return json::parse(statement);
}

json statement_of(const XapiAttempt& attempt, const XapiSetting& setting = {}) {
  return sound(xapi_statement(attempt, setting));
}

std::string verb_of(const json& statement) {
  return statement["verb"]["id"].get<std::string>().substr(std::string(kVerb).size());
}

json extension(const json& statement, const std::string& name) {
  return statement["result"]["extensions"].value("https://trocar.invalid/xapi/extension/" + name, json());
}

TEST(XapiStatement, SaysWhoDidWhat) {
  const json s = statement_of(sample_xapi());
  EXPECT_EQ(
      s["actor"],
      (json{{"objectType", "Agent"},
            {"account", {{"homePage", "https://trocar.invalid/"}, {"name", "01890a5d-0000-7000-8000-000000000001"}}}}));
  EXPECT_EQ(s["verb"]["id"], "http://adlnet.gov/expapi/verbs/passed");
  EXPECT_EQ(s["verb"]["display"]["en"], "passed");
  EXPECT_EQ(s["object"]["id"], "https://trocar.invalid/xapi/exercise/surface-touch/1.0/L1");
  EXPECT_EQ(s["object"]["definition"]["type"], "http://adlnet.gov/expapi/activities/simulation");
  EXPECT_EQ(s["object"]["definition"]["name"]["en"], "Touch the surface");
  EXPECT_EQ(s["timestamp"], "2026-03-01T09:30:00.123Z");
}

TEST(XapiStatement, CarriesTheResult) {
  const json r = statement_of(sample_xapi())["result"];
  EXPECT_EQ(r["score"], (json{{"scaled", 0.8125}, {"raw", 81.25}, {"min", 0}, {"max", 100}}));
  EXPECT_EQ(r["success"], true);
  EXPECT_EQ(r["completion"], true);
  EXPECT_EQ(r["duration"], "PT41.5S");
}

TEST(XapiStatement, CarriesTheEvidence) {
  const json s = statement_of(sample_xapi());
  EXPECT_EQ(extension(s, "status"), "completed");
  EXPECT_EQ(extension(s, "ruleset-sha256"), std::string(64, 'b'));
  EXPECT_EQ(extension(s, "trace-sha256"), std::string(64, 'c'));
  EXPECT_EQ(extension(s, "row-hash"), std::string(64, 'd'));
  EXPECT_EQ(extension(s, "seed"), -7);
  EXPECT_EQ(extension(s, "board"), 3);
  EXPECT_EQ(extension(s, "hand"), "mouse");
  EXPECT_TRUE(extension(s, "integrity").is_null()) << "nothing wrong, nothing said";
  ASSERT_EQ(extension(s, "subscores").size(), 2u);
  EXPECT_EQ(extension(s, "subscores")[0]["raw"], 2.6);
  EXPECT_FALSE(extension(s, "subscores")[1].contains("raw")) << "undefined is left out";
  ASSERT_EQ(extension(s, "events").size(), 2u);
  EXPECT_EQ(extension(s, "events")[1],
            (json{{"type", "EXCESS_FORCE"}, {"severity", "critical"}, {"t_s", 0.5}, {"value", 6.5}, {"unit", "N"}}));
}

TEST(XapiStatement, CarriesTheContext) {
  XapiAttempt attempt = sample_xapi();
  json c = statement_of(attempt)["context"];
  EXPECT_EQ(c["platform"], "Trocar 1.2.3");
  EXPECT_EQ(c["revision"], "1.0");
  EXPECT_EQ(c["language"], "en");
  EXPECT_EQ(c["contextActivities"]["parent"][0]["id"], "https://trocar.invalid/xapi/exercise/surface-touch");
  EXPECT_FALSE(c["contextActivities"].contains("grouping"));
  EXPECT_FALSE(c.contains("instructor"));
  EXPECT_EQ(c["extensions"], (json{{kMastery, 0.75}}));
  attempt.session_uuid = "01890a5d-0000-7000-8000-000000000009";
  attempt.instructor_uuid = "01890a5d-0000-7000-8000-00000000000a";
  attempt.pass_at.reset();
  attempt.program.clear();
  c = statement_of(attempt, {"https://hospital.example/"})["context"];
  EXPECT_EQ(c["contextActivities"]["grouping"][0]["id"],
            "https://trocar.invalid/xapi/session/01890a5d-0000-7000-8000-000000000009");
  EXPECT_EQ(c["instructor"]["account"]["name"], "01890a5d-0000-7000-8000-00000000000a");
  EXPECT_EQ(c["instructor"]["account"]["homePage"], "https://hospital.example/");
  EXPECT_FALSE(c.contains("extensions"));
  EXPECT_EQ(c["platform"], "Trocar");
}

TEST(XapiStatement, RegistrationIsOfTraineeAndExercise) {
  XapiAttempt attempt = sample_xapi();
  const json first = statement_of(attempt);
  attempt.result.uuid = "01890a5d-ac96-774b-bcce-b302099a8058";
  const json second = statement_of(attempt);
  EXPECT_NE(first["id"], second["id"]);
  EXPECT_EQ(first["context"]["registration"], second["context"]["registration"]);
  attempt.trainee_uuid = "01890a5d-0000-7000-8000-000000000002";
  EXPECT_NE(statement_of(attempt)["context"]["registration"], first["context"]["registration"]);
}

TEST(XapiStatement, ItsIdentifierIsOfTheAttempt) {
  const json s = statement_of(sample_xapi());
  EXPECT_EQ(s["id"], named_uuid("01890a5d-ac96-774b-bcce-b302099a8057", "http://adlnet.gov/expapi/verbs/passed"));
  EXPECT_EQ(xapi_statement(sample_xapi()), xapi_statement(sample_xapi())) << "sent twice, stored once";
}

TEST(XapiStatement, TheVerbFollowsTheOutcome) {
  XapiAttempt attempt = sample_xapi(60);
  EXPECT_EQ(verb_of(statement_of(attempt)), "failed");
  attempt.result.grade.status = AttemptStatus::kTimeout;
  json s = statement_of(attempt);
  EXPECT_EQ(verb_of(s), "failed");
  EXPECT_EQ(s["result"]["completion"], false);
  EXPECT_EQ(s["result"]["success"], false);
  attempt.result.grade.score.reset();
  attempt.result.grade.status = AttemptStatus::kCompleted;
  s = statement_of(attempt);
  EXPECT_EQ(verb_of(s), "completed");
  EXPECT_FALSE(s["result"].contains("success"));
  for (const AttemptStatus status : {AttemptStatus::kAborted, AttemptStatus::kFault, AttemptStatus::kVoid}) {
    attempt.result.grade.status = status;
    attempt.result.integrity = "the watchdog stopped the device";
    s = statement_of(attempt);
    EXPECT_EQ(verb_of(s), "attempted");
    EXPECT_FALSE(s["result"].contains("score"));
    EXPECT_EQ(s["result"]["completion"], false);
    EXPECT_EQ(extension(s, "integrity"), "the watchdog stopped the device");
    EXPECT_FALSE(s["context"].contains("extensions")) << "no verdict, no mastery score";
  }
}

TEST(XapiStatement, NamesNobody) {
  XapiAttempt attempt = sample_xapi();
  attempt.instructor_uuid = "01890a5d-0000-7000-8000-00000000000a";
  EXPECT_EQ(xapi_statement(attempt).find("T-secret"), std::string::npos);
}

TEST(XapiStatement, OddNamesStayIris) {
  XapiAttempt attempt = sample_xapi();
  attempt.result.exercise_id = "my exercise/<2>\"é?#%";
  attempt.result.exercise_version = "";
  attempt.result.level = "L 1";
  attempt.title.clear();
  attempt.result.grade.caps = {{.kind = CapKind::kVoid, .subject = "caf\xE9 is no UTF-8"}};
  const json s = statement_of(attempt);
  EXPECT_EQ(s["object"]["id"], "https://trocar.invalid/xapi/exercise/my%20exercise%2F%3C2%3E%22é%3F%23%25/-/L%201");
  EXPECT_EQ(s["object"]["definition"]["name"]["en"], attempt.result.exercise_id);
  EXPECT_FALSE(s["context"].contains("revision"));
}

TEST(XapiStatement, NumbersThatAreNoneAreLeftOut) {
  XapiAttempt attempt = sample_xapi();
  attempt.result.events[0].value = std::numeric_limits<double>::quiet_NaN();
  attempt.result.grade.subscores[0].value = std::numeric_limits<double>::infinity();
  attempt.result.grade.metrics.clear();
  const json s = statement_of(attempt);
  EXPECT_FALSE(extension(s, "events")[0].contains("value"));
  EXPECT_FALSE(extension(s, "subscores")[0].contains("value"));
  EXPECT_EQ(s["result"]["duration"], "PT60S") << "ticks over rate where the exercise's clock is missing";
  attempt.result.device.rate_hz = 0;
  EXPECT_EQ(statement_of(attempt)["result"]["duration"], "PT0S");
}

TEST(XapiDuration, HasHundredths) {
  EXPECT_EQ(xapi_duration(0), "PT0S");
  EXPECT_EQ(xapi_duration(46.2), "PT46.2S");
  EXPECT_EQ(xapi_duration(100), "PT100S");
  EXPECT_EQ(xapi_duration(1.0 / 3), "PT0.33S");
  EXPECT_EQ(xapi_duration(0.999), "PT1S");
  EXPECT_EQ(xapi_duration(86400.25), "PT86400.25S");
}

Cmi5Launch sample_launch(std::optional<double> mastery) {
  return {"https://lms.example/au/1",
          "https://course.example/au/touch",
          "b22893ae-a13e-406f-abb6-fd463ed7c645",
          "session 7",
          "https://lms.example/",
          "learner-12",
          mastery};
}

TEST(Cmi5, ReportsCompletedAndPassedApart) {
  const auto statements = cmi5_statements(sample_xapi(), sample_launch(0.8));
  ASSERT_EQ(statements.size(), 2u);
  const json completed = sound(statements[0]), passed = sound(statements[1]);
  EXPECT_EQ(verb_of(completed), "completed");
  EXPECT_EQ(completed["result"], (json{{"completion", true}, {"duration", "PT41.5S"}}))
      << "neither score nor success (cmi5 9.5)";
  EXPECT_EQ(verb_of(passed), "passed");
  EXPECT_EQ(passed["result"]["success"], true);
  EXPECT_FALSE(passed["result"].contains("completion"));
  EXPECT_EQ(passed["result"]["score"]["scaled"], 0.8125);
  EXPECT_EQ(passed["context"]["extensions"][kMastery], 0.8);
  EXPECT_FALSE(completed["context"]["extensions"].contains(kMastery));
  EXPECT_NE(completed["id"], passed["id"]);
}

TEST(Cmi5, SpeaksAsTheLaunchAsks) {
  for (const std::string& text : cmi5_statements(sample_xapi(), sample_launch({}))) {
    const json s = sound(text);
    EXPECT_EQ(s["actor"]["account"], (json{{"homePage", "https://lms.example/"}, {"name", "learner-12"}}));
    EXPECT_EQ(s["object"]["id"], "https://lms.example/au/1");
    EXPECT_EQ(s["context"]["registration"], "b22893ae-a13e-406f-abb6-fd463ed7c645");
    EXPECT_EQ(s["context"]["extensions"]["https://w3id.org/xapi/cmi5/context/extensions/sessionid"], "session 7");
    EXPECT_EQ(s["context"]["contextActivities"]["grouping"][0]["id"], "https://course.example/au/touch");
    const json& category = s["context"]["contextActivities"]["category"];
    EXPECT_EQ(category[0]["id"], "https://w3id.org/xapi/cmi5/context/categories/cmi5");
    EXPECT_EQ(category[1]["id"], "https://w3id.org/xapi/cmi5/context/categories/moveon");
    EXPECT_EQ(text.find("01890a5d-0000-7000-8000-000000000001"), std::string::npos) << "the launch's actor, not ours";
  }
}

TEST(Cmi5, TheLaunchsMasteryScoreHolds) {
  const auto verdict = [](double score, std::optional<double> mastery, bool capped) {
    XapiAttempt attempt = sample_xapi(score);
    if (capped) attempt.result.grade.caps = {{.kind = CapKind::kGate, .subject = "gate", .below = 0.5, .at_most = 59}};
    return sound(cmi5_statements(attempt, sample_launch(mastery)).back());
  };
  EXPECT_EQ(verb_of(verdict(81.25, 0.9, false)), "failed") << "above our mark, below theirs";
  EXPECT_EQ(verb_of(verdict(60, 0.5, false)), "passed") << "below our mark, above theirs";
  EXPECT_EQ(verb_of(verdict(50, 0.5, false)), "passed") << "reaching it is enough";
  EXPECT_EQ(verb_of(verdict(81.25, {}, false)), "passed");
  EXPECT_EQ(verb_of(verdict(60, {}, false)), "failed");
  const json capped = verdict(59, 0.5, true);
  EXPECT_EQ(verb_of(capped), "failed") << "safety is not overruled";
  EXPECT_FALSE(capped["result"].contains("score")) << "a failed score must not reach the mastery score";
  EXPECT_TRUE(verdict(40, 0.5, true)["result"].contains("score"));
}

const VerdictOverride kFailed{"01890a5d-0000-7000-8000-0000000000aa",
                              "01890a5d-0000-7000-8000-0000000000bb",
                              "Dr Anna Secret",
                              "The assistant did half of it",
                              "2026-03-02T10:00:00.000Z",
                              false};

TEST(XapiStatement, ADecisionIsTheSuccessAndIsNamed) {
  const json before = statement_of(sample_xapi());
  XapiAttempt attempt = sample_xapi();
  attempt.decision = kFailed;
  const json s = statement_of(attempt);
  EXPECT_EQ(verb_of(s), "failed");
  EXPECT_EQ(s["result"]["success"], false);
  EXPECT_EQ(s["result"]["score"]["raw"], 81.25) << "the score never changes";
  EXPECT_EQ(extension(s, "decision"), (json{{"id", kFailed.uuid},
                                            {"success", false},
                                            {"success-by-score", true},
                                            {"timestamp", kFailed.utc},
                                            {"authority", kFailed.author}}));
  EXPECT_EQ(s.dump().find("Secret"), std::string::npos) << "no printed name leaves";
  EXPECT_TRUE(extension(before, "decision").is_null());
  attempt.decision->passed = true;
  const json confirmed = statement_of(attempt);
  EXPECT_EQ(verb_of(confirmed), "passed");
  EXPECT_NE(confirmed["id"], before["id"]) << "another content must not bear the identifier of the first";
  EXPECT_EQ(confirmed["id"], statement_of(attempt)["id"]);
}

TEST(XapiStatement, WhatWasLeftHasSuccessByDecisionOnly) {
  XapiAttempt attempt = sample_xapi();
  attempt.result.grade.score.reset();
  attempt.result.grade.passed = false;
  attempt.result.grade.status = AttemptStatus::kAborted;
  EXPECT_FALSE(statement_of(attempt)["result"].contains("success"));
  attempt.decision = kFailed;
  attempt.decision->passed = true;
  EXPECT_EQ(verb_of(statement_of(attempt)), "passed");
  attempt.result.grade.status = AttemptStatus::kVoid;
  EXPECT_EQ(verb_of(statement_of(attempt)), "attempted") << "what the device ended counts for nothing";
}

TEST(Cmi5, ADecisionHoldsAndAScoreThatContradictsItIsLeftOut) {
  XapiAttempt attempt = sample_xapi();
  attempt.decision = kFailed;
  const json failed = sound(cmi5_statements(attempt, sample_launch(0.8)).back());
  EXPECT_EQ(verb_of(failed), "failed");
  EXPECT_FALSE(failed["result"].contains("score"));
  attempt = sample_xapi(60);
  attempt.decision = kFailed;
  EXPECT_TRUE(sound(cmi5_statements(attempt, sample_launch(0.8)).back())["result"].contains("score"))
      << "both say failed";
  attempt.decision->passed = true;
  const json passed = sound(cmi5_statements(attempt, sample_launch(0.8)).back());
  EXPECT_EQ(verb_of(passed), "passed");
  EXPECT_FALSE(passed["result"].contains("score"));
}

TEST(Cmi5, SaysNothingOfWhatCarriesNoScore) {
  XapiAttempt attempt = sample_xapi();
  attempt.result.grade.score.reset();
  attempt.result.grade.status = AttemptStatus::kAborted;
  EXPECT_TRUE(cmi5_statements(attempt, sample_launch({})).empty());
  attempt = sample_xapi(30);
  attempt.result.grade.status = AttemptStatus::kTimeout;
  const auto statements = cmi5_statements(attempt, sample_launch({}));
  ASSERT_EQ(statements.size(), 1u);
  EXPECT_EQ(verb_of(sound(statements[0])), "failed") << "not completed";
}

}  // namespace
}  // namespace trocar::xapi_test
