// The validator against hand-made statements: a sound one with everything, and one broken rule at a time.
#include <nlohmann/json.hpp>

#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/xapi.h"

namespace trocar::xapi_problems_test {
namespace {

using nlohmann::json;

/// Written by hand, not by our writer: every property that the standard has.
const char* const kSound = R"({
  "id": "fd41c918-b88b-4b20-a0a5-a4c32391aaa0", "version": "2.0.0",
  "actor": {"objectType": "Group", "name": "Team", "member": [{"mbox": "mailto:a@example.org"}, {"openid": "http://example.org/me"}]},
  "verb": {"id": "http://adlnet.gov/expapi/verbs/passed", "display": {"en-GB": "passed", "de": "bestanden"}},
  "object": {"objectType": "Activity", "id": "http://example.org/a?b=1#c",
             "definition": {"type": "http://adlnet.gov/expapi/activities/simulation", "name": {"en": "x"}, "description": {"en": "y"},
                            "moreInfo": "https://example.org/", "extensions": {"http://example.org/x": null}}},
  "result": {"score": {"scaled": -1, "raw": 0, "min": 0, "max": 1}, "success": true, "completion": false, "response": "",
             "duration": "P1Y2M3DT4H5M6.7S", "extensions": {"http://example.org/e": {"a": null}}},
  "context": {"registration": "EC531277-B57B-4C15-8D91-D292C5B2B8F7",
              "instructor": {"account": {"homePage": "http://example.org", "name": "i"}},
              "team": {"objectType": "Group", "mbox_sha1sum": "ebd31e95054c018b10727ccffd2ef2ec3a016ee9"},
              "contextActivities": {"parent": [{"id": "http://example.org/p"}], "other": {"id": "urn:x:1"}},
              "contextAgents": [], "contextGroups": [], "revision": "1", "platform": "p", "language": "en-GB",
              "statement": {"objectType": "StatementRef", "id": "6690e6c9-3ef0-4ed3-8b37-7f3964730bee"}, "extensions": {}},
  "timestamp": "2026-02-28T23:59:60.5+01:30", "stored": "2026-03-01T00:00:00Z",
  "authority": {"mbox": "mailto:root@example.org"}, "attachments": []})";

/// The sound statement with one place changed.
std::vector<std::string> problems_with(const std::string& pointer, const json& value) {
  json statement = json::parse(kSound);
  statement[json::json_pointer(pointer)] = value;
  return xapi_problems(statement.dump());
}

std::vector<std::string> problems_without(const std::string& parent, const std::string& key) {
  json statement = json::parse(kSound);
  EXPECT_EQ(statement[json::json_pointer(parent)].erase(key), 1u) << key;
  return xapi_problems(statement.dump());
}

TEST(XapiProblems, ASoundStatementHasNone) {
  EXPECT_EQ(xapi_problems(kSound), std::vector<std::string>{});
  EXPECT_EQ(xapi_problems(R"({"actor":{"mbox":"mailto:a@b.c"},"verb":{"id":"http://v"},"object":{"id":"http://o"}})"),
            std::vector<std::string>{});
}

struct Wrong {
  const char* pointer;
  json value;
  const char* said;
};

const std::vector<Wrong> kWrong{
    {"/id", "fd41c918", "id: is no UUID"},
    {"/id", 7, "id: is no text"},
    {"/id", "fd41c918-b88b-4b20-70a5-a4c32391aaa0", "id: is no UUID"},
    {"/version", "3.0.0", "version: is no version"},
    {"/actor", "me", "actor: is no object"},
    {"/actor/objectType", "Person", "actor.objectType: is not possible here"},
    {"/actor/objectType", 1, "actor.objectType: is not possible here"},
    {"/actor/member", "a", "actor.member: is no array"},
    {"/actor/member/0/mbox", "a@example.org", "actor.member.mbox: is no mailto IRI"},
    {"/actor/member/0/openid", "http://x/y", "actor.member: has 2 identifiers instead of one"},
    {"/actor/member/0", json::object(), "actor.member: has 0 identifiers instead of one"},
    {"/actor/member/0/objectType", "Group", "actor.member.objectType: is not possible here"},
    {"/actor/nickname", "x", "actor.nickname: is no property of the standard"},
    {"/actor/name", json::array(), "actor.name: is no text"},
    {"/verb", "passed", "verb: is no object"},
    {"/verb/id", "passed", "verb.id: is no IRI"},
    {"/verb/id", "http://exa mple.org", "verb.id: is no IRI"},
    {"/verb/display", "passed", "verb.display: is no object"},
    {"/verb/display/no_language", "x", "is no language"},
    {"/verb/display/en", 1, "verb.display.en: is no text"},
    {"/object/id", "exercise 1", "object.id: is no IRI"},
    {"/object/objectType", "Thing", "object.objectType: is not possible here"},
    {"/object/definition/type", "simulation", "object.definition.type: is no IRI"},
    {"/object/definition/kind", "simulation", "object.definition.kind: is no property"},
    {"/object/definition/extensions/short", 1, "\"short\" is no IRI"},
    {"/result/score/scaled", 1.01, "result.score.scaled: lies outside -1 to 1"},
    {"/result/score/scaled", "1", "result.score.scaled: is no number"},
    {"/result/score/min", 1, "min is not below max"},
    {"/result/score/raw", -1, "result.score.raw: lies below min"},
    {"/result/score/raw", 2, "result.score.raw: lies above max"},
    {"/result/score/percent", 50, "result.score.percent: is no property"},
    {"/result/score", 50, "result.score: is no object"},
    {"/result/success", "true", "result.success: is neither true nor false"},
    {"/result/completion", 1, "result.completion: is neither true nor false"},
    {"/result/duration", "41.5", "result.duration: is no duration"},
    {"/result/response", 4, "result.response: is no text"},
    {"/result/extensions/seed", 4, "\"seed\" is no IRI"},
    {"/result/extensions", 4, "result.extensions: is no object"},
    {"/context/registration", "1", "context.registration: is no UUID"},
    {"/context/instructor/account/homePage", "here", "context.instructor.account.homePage: is no IRL"},
    {"/context/instructor/account/name", 12, "context.instructor.account.name: is no text"},
    {"/context/team/objectType", "Agent", "context.team.objectType: is not possible here"},
    {"/context/team/mbox_sha1sum", "ebd3", "context.team.mbox_sha1sum: is no SHA-1"},
    {"/context/contextActivities/sibling", json::array(), "context.contextActivities.sibling: is no property"},
    {"/context/contextActivities/parent/0/id", "p", "context.contextActivities.parent.id: is no IRI"},
    {"/context/contextActivities/other/id", "p", "context.contextActivities.other.id: is no IRI"},
    {"/context/contextAgents", 1, "context.contextAgents: is no array"},
    {"/context/language", "en_GB", "context.language: is no language"},
    {"/context/statement/objectType", "Activity", "context.statement.objectType: is no \"StatementRef\""},
    {"/context/statement/id", "x", "context.statement.id: is no UUID"},
    {"/context/trainer", "x", "context.trainer: is no property"},
    {"/timestamp", "2026-02-29T00:00:00Z", "timestamp: is no time"},
    {"/stored", "yesterday", "stored: is no time"},
    {"/authority", json::object(), "authority: has 0 identifiers"},
    {"/attachments", 1, "attachments: is no array"},
    {"/score", 1, "score: is no property of the standard"},
    {"/verb/id", "http://adlnet.gov/expapi/verbs/voided", "object: is no StatementRef"},
    {"/result/response", nullptr, "result.response: is null"},
    {"/context/extensions", nullptr, "context.extensions: is null"},
    {"/object/definition/name/en", nullptr, "object.definition.name.en: is null"},
};

TEST(XapiProblems, EveryBrokenRuleIsFoundAndNamed) {
  for (const Wrong& w : kWrong) {
    const auto problems = problems_with(w.pointer, w.value);
    const bool said = std::any_of(problems.begin(), problems.end(),
                                  [&](const std::string& p) { return p.find(w.said) != std::string::npos; });
    EXPECT_TRUE(said) << w.pointer << " = " << w.value << ": " << (problems.empty() ? "nothing" : problems.front());
  }
}

TEST(XapiProblems, WhatIsRequiredIsMissed) {
  for (const char* key : {"actor", "verb", "object"}) {
    EXPECT_EQ(problems_without("", key), std::vector<std::string>{std::string(key) + ": is missing"}) << key;
  }
  EXPECT_EQ(problems_without("/verb", "id"), std::vector<std::string>{"verb.id: is missing"});
  EXPECT_EQ(problems_without("/object", "id"), std::vector<std::string>{"object.id: is missing"});
  EXPECT_EQ(problems_without("/context/instructor/account", "name"),
            std::vector<std::string>{"context.instructor.account.name: is missing"});
  EXPECT_EQ(problems_without("/context/instructor/account", "homePage"),
            std::vector<std::string>{"context.instructor.account.homePage: is missing"});
  EXPECT_EQ(problems_without("/actor", "member"),
            std::vector<std::string>{"actor.member: is missing in a group without identifier"});
  for (const char* key : {"id", "result", "context", "timestamp", "stored", "authority", "version", "attachments"}) {
    EXPECT_TRUE(problems_without("", key).empty()) << key;
  }
}

TEST(XapiProblems, OtherObjectsHaveTheirOwnRules) {
  const json reference = {{"objectType", "StatementRef"}, {"id", "6690e6c9-3ef0-4ed3-8b37-7f3964730bee"}};
  EXPECT_EQ(problems_with("/object", reference).size(), 2u) << "revision and platform are for activities";
  json inner = json::parse(kSound);
  for (const char* key : {"id", "stored", "authority", "version"}) inner.erase(key);
  inner["objectType"] = "SubStatement";
  json statement = json::parse(kSound);
  statement["context"].erase("revision");
  statement["context"].erase("platform");
  statement["object"] = inner;
  EXPECT_EQ(xapi_problems(statement.dump()), std::vector<std::string>{});
  statement["object"]["id"] = statement["id"];
  EXPECT_EQ(xapi_problems(statement.dump()), std::vector<std::string>{"object.id: is no property of the standard"});
  statement["object"].erase("id");
  statement["object"]["object"] = inner;
  EXPECT_EQ(xapi_problems(statement.dump()).size(), 3u) << "a statement inside a statement inside a statement";
  statement["object"] = {{"objectType", "Agent"}, {"mbox", "mailto:a@b.c"}};
  EXPECT_EQ(xapi_problems(statement.dump()), std::vector<std::string>{});
}

TEST(XapiProblems, AVoidingStatementPointsAtOne) {
  json statement =
      json::parse(R"({"actor":{"mbox":"mailto:a@b.c"},"verb":{"id":"http://adlnet.gov/expapi/verbs/voided"},
    "object":{"objectType":"StatementRef","id":"6690e6c9-3ef0-4ed3-8b37-7f3964730bee"}})");
  EXPECT_TRUE(xapi_problems(statement.dump()).empty());
}

TEST(XapiProblems, WhatIsNoStatementIsSaidSo) {
  EXPECT_EQ(xapi_problems("{"), std::vector<std::string>{"statement: is no JSON"});
  EXPECT_EQ(xapi_problems(""), std::vector<std::string>{"statement: is no JSON"});
  EXPECT_EQ(xapi_problems("[]"), std::vector<std::string>{"statement: is no object"});
  const auto twice = xapi_problems(
      R"({"actor":{"mbox":"mailto:a@b.c","mbox":"mailto:d@b.c"},"verb":{"id":"http://v"},"object":{"id":"http://o"}})");
  EXPECT_EQ(twice, std::vector<std::string>{"mbox: stands twice"});
}

}  // namespace
}  // namespace trocar::xapi_problems_test
