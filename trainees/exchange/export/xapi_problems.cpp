// Rules of IEEE 9274.1.1 that a statement can break by itself, checked property by property.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "trainees/exchange/export/xapi.h"
#include "trainees/exchange/export/xapi_terms.h"
#include "trainees/files/doubled_keys.h"

namespace trocar {
namespace {

using nlohmann::json;
using Form = bool (*)(std::string_view);

bool voids(const json& s) {
  const json verb = s.value("verb", json());
  return verb.is_object() && verb.value("id", json()) == "http://adlnet.gov/expapi/verbs/voided";
}

bool object_is(const json& s, const char* type) {
  return s.contains("object") && s["object"].is_object() && s["object"].value("objectType", json("Activity")) == type;
}

class StatementCheck {
 public:
  std::vector<std::string> problems;

  void statement(const json& s, const std::string& at, bool inner);

 private:
  void say(const std::string& at, const std::string& what) {
    problems.push_back((at.empty() ? "statement" : at) + ": " + what);
  }
  static std::string below(const std::string& at, const std::string& key) { return at.empty() ? key : at + "." + key; }

  bool is_object(const json& value, const std::string& at) {
    if (!value.is_object()) say(at, "is no object");
    return value.is_object();
  }
  void known(const json& value, const std::string& at, const std::set<std::string>& keys) {
    for (const auto& [key, unused] : value.items())
      if (!keys.contains(key)) say(below(at, key), "is no property of the standard");
  }
  void text(const json& of, const std::string& at, const char* key, bool required, Form form, const char* what) {
    if (!of.contains(key)) {
      if (required) say(below(at, key), "is missing");
    } else if (!of[key].is_string()) {
      say(below(at, key), "is no text");
    } else if (form && !form(of[key].get_ref<const std::string&>())) {
      say(below(at, key), std::string("is no ") + what);
    }
  }
  void truth(const json& of, const std::string& at, const char* key) {
    if (of.contains(key) && !of[key].is_boolean()) say(below(at, key), "is neither true nor false");
  }

  void no_nulls(const json& value, const std::string& at);
  void language_map(const json& of, const std::string& at, const char* key);
  void extensions(const json& of, const std::string& at);
  void actor(const json& a, const std::string& at, const std::set<std::string>& types);
  int identifiers(const json& a, const std::string& at);
  void verb(const json& v, const std::string& at);
  void activity(const json& a, const std::string& at);
  void reference(const json& r, const std::string& at);
  void object(const json& o, const std::string& at, bool inner);
  void score(const json& s, const std::string& at);
  void result(const json& r, const std::string& at);
  void context(const json& c, const std::string& at, bool of_activity);
  void context_activities(const json& c, const std::string& at);
};

void StatementCheck::no_nulls(const json& value, const std::string& at) {
  if (value.is_null()) say(at, "is null");
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      if (key != "extensions" || inner.is_null()) no_nulls(inner, below(at, key));
  }
  if (value.is_array()) {
    for (const json& inner : value) no_nulls(inner, at);
  }
}

void StatementCheck::language_map(const json& of, const std::string& at, const char* key) {
  if (!of.contains(key)) return;
  const std::string here = below(at, key);
  if (!is_object(of[key], here)) return;
  for (const auto& [language, words] : of[key].items()) {
    if (!xapi::is_language(language)) say(here, "\"" + language + "\" is no language");
    if (!words.is_string()) say(below(here, language), "is no text");
  }
}

void StatementCheck::extensions(const json& of, const std::string& at) {
  if (!of.contains("extensions")) return;
  const std::string here = below(at, "extensions");
  if (!is_object(of["extensions"], here)) return;
  for (const auto& [key, unused] : of["extensions"].items())
    if (!xapi::is_iri(key)) say(here, "\"" + key + "\" is no IRI");
}

int StatementCheck::identifiers(const json& a, const std::string& at) {
  const auto mail = [](std::string_view t) {
    return t.starts_with("mailto:") && t.find('@') != t.npos && xapi::is_iri(t);
  };
  const auto sha1 = [](std::string_view t) {
    return t.size() == 40 && t.find_first_not_of("0123456789abcdefABCDEF") == t.npos;
  };
  text(a, at, "mbox", false, mail, "mailto IRI");
  text(a, at, "mbox_sha1sum", false, sha1, "SHA-1");
  text(a, at, "openid", false, xapi::is_iri, "URI");
  if (a.contains("account") && is_object(a["account"], below(at, "account"))) {
    known(a["account"], below(at, "account"), {"homePage", "name"});
    text(a["account"], below(at, "account"), "homePage", true, xapi::is_iri, "IRL");
    text(a["account"], below(at, "account"), "name", true, nullptr, "");
  }
  int count = 0;
  for (const char* key : {"mbox", "mbox_sha1sum", "openid", "account"}) count += a.contains(key);
  return count;
}

void StatementCheck::actor(const json& a, const std::string& at, const std::set<std::string>& types) {
  if (!is_object(a, at)) return;
  const json type = a.value("objectType", json("Agent"));
  if (!type.is_string() || !types.contains(type.get<std::string>()))
    return say(below(at, "objectType"), "is not possible here");
  text(a, at, "name", false, nullptr, "");
  const int count = identifiers(a, at);
  if (type == "Agent") {
    known(a, at, {"objectType", "name", "mbox", "mbox_sha1sum", "openid", "account"});
    if (count != 1) say(at, "has " + std::to_string(count) + " identifiers instead of one");
    return;
  }
  known(a, at, {"objectType", "name", "member", "mbox", "mbox_sha1sum", "openid", "account"});
  if (count > 1) say(at, "has " + std::to_string(count) + " identifiers instead of at most one");
  if (count == 0 && !a.contains("member")) say(below(at, "member"), "is missing in a group without identifier");
  if (!a.contains("member")) return;
  if (!a["member"].is_array()) return say(below(at, "member"), "is no array");
  for (const json& member : a["member"]) actor(member, below(at, "member"), {"Agent"});
}

void StatementCheck::verb(const json& v, const std::string& at) {
  if (!is_object(v, at)) return;
  known(v, at, {"id", "display"});
  text(v, at, "id", true, xapi::is_iri, "IRI");
  language_map(v, at, "display");
}

void StatementCheck::activity(const json& a, const std::string& at) {
  if (!is_object(a, at)) return;
  known(a, at, {"objectType", "id", "definition"});
  text(
      a, at, "objectType", false, [](std::string_view t) { return t == "Activity"; }, "\"Activity\"");
  text(a, at, "id", true, xapi::is_iri, "IRI");
  if (!a.contains("definition") || !is_object(a["definition"], below(at, "definition"))) return;
  const std::string here = below(at, "definition");
  known(a["definition"], here,
        {"name", "description", "type", "moreInfo", "extensions", "interactionType", "correctResponsesPattern",
         "choices", "scale", "source", "target", "steps"});
  language_map(a["definition"], here, "name");
  language_map(a["definition"], here, "description");
  text(a["definition"], here, "type", false, xapi::is_iri, "IRI");
  text(a["definition"], here, "moreInfo", false, xapi::is_iri, "IRL");
  extensions(a["definition"], here);
}

void StatementCheck::reference(const json& r, const std::string& at) {
  if (!is_object(r, at)) return;
  known(r, at, {"objectType", "id"});
  text(
      r, at, "objectType", true, [](std::string_view t) { return t == "StatementRef"; }, "\"StatementRef\"");
  text(r, at, "id", true, xapi::is_uuid, "UUID");
}

void StatementCheck::object(const json& o, const std::string& at, bool inner) {
  if (!is_object(o, at)) return;
  const json type = o.value("objectType", json("Activity"));
  if (type == "Activity") return activity(o, at);
  if (type == "Agent" || type == "Group") return actor(o, at, {"Agent", "Group"});
  if (type == "StatementRef") return reference(o, at);
  if (type == "SubStatement" && !inner) return statement(o, at, true);
  say(below(at, "objectType"), "is not possible here");
}

void StatementCheck::score(const json& s, const std::string& at) {
  if (!is_object(s, at)) return;
  known(s, at, {"scaled", "raw", "min", "max"});
  std::map<std::string, double> given;
  for (const char* key : {"scaled", "raw", "min", "max"}) {
    if (!s.contains(key)) continue;
    if (!s[key].is_number())
      say(below(at, key), "is no number");
    else
      given[key] = s[key].get<double>();
  }
  if (given.contains("scaled") && !(given["scaled"] >= -1 && given["scaled"] <= 1))
    say(below(at, "scaled"), "lies outside -1 to 1");
  if (given.contains("min") && given.contains("max") && !(given["min"] < given["max"])) say(at, "min is not below max");
  if (given.contains("raw") && given.contains("min") && given["raw"] < given["min"])
    say(below(at, "raw"), "lies below min");
  if (given.contains("raw") && given.contains("max") && given["raw"] > given["max"])
    say(below(at, "raw"), "lies above max");
}

void StatementCheck::result(const json& r, const std::string& at) {
  if (!is_object(r, at)) return;
  known(r, at, {"score", "success", "completion", "response", "duration", "extensions"});
  if (r.contains("score")) score(r["score"], below(at, "score"));
  truth(r, at, "success");
  truth(r, at, "completion");
  text(r, at, "response", false, nullptr, "");
  text(r, at, "duration", false, xapi::is_duration, "duration of ISO 8601");
  extensions(r, at);
}

void StatementCheck::context_activities(const json& c, const std::string& at) {
  if (!is_object(c, at)) return;
  known(c, at, {"parent", "grouping", "category", "other"});
  for (const auto& [key, list] : c.items()) {
    if (!list.is_array())
      activity(list, below(at, key));
    else
      for (const json& one : list) activity(one, below(at, key));
  }
}

void StatementCheck::context(const json& c, const std::string& at, bool of_activity) {
  if (!is_object(c, at)) return;
  known(c, at,
        {"registration", "instructor", "team", "contextActivities", "contextAgents", "contextGroups", "revision",
         "platform", "language", "statement", "extensions"});
  text(c, at, "registration", false, xapi::is_uuid, "UUID");
  if (c.contains("instructor")) actor(c["instructor"], below(at, "instructor"), {"Agent", "Group"});
  if (c.contains("team")) actor(c["team"], below(at, "team"), {"Group"});
  if (c.contains("contextActivities")) context_activities(c["contextActivities"], below(at, "contextActivities"));
  for (const char* key : {"contextAgents", "contextGroups"})
    if (c.contains(key) && !c[key].is_array()) say(below(at, key), "is no array");
  for (const char* key : {"revision", "platform"}) {
    text(c, at, key, false, nullptr, "");
    if (c.contains(key) && !of_activity) say(below(at, key), "is for activities only");
  }
  text(c, at, "language", false, xapi::is_language, "language");
  if (c.contains("statement")) reference(c["statement"], below(at, "statement"));
  extensions(c, at);
}

void StatementCheck::statement(const json& s, const std::string& at, bool inner) {
  if (!is_object(s, at)) return;
  std::set<std::string> keys{"actor", "verb", "object", "result", "context", "timestamp", "attachments"};
  if (inner)
    keys.insert("objectType");
  else
    keys.insert({"id", "stored", "authority", "version"});
  known(s, at, keys);
  for (const char* key : {"actor", "verb", "object"})
    if (!s.contains(key)) say(below(at, key), "is missing");
  if (!inner) text(s, at, "id", false, xapi::is_uuid, "UUID");
  if (s.contains("actor")) actor(s["actor"], below(at, "actor"), {"Agent", "Group"});
  if (s.contains("verb")) verb(s["verb"], below(at, "verb"));
  if (voids(s) && !object_is(s, "StatementRef")) say(below(at, "object"), "is no StatementRef, which voiding asks for");
  if (s.contains("object")) object(s["object"], below(at, "object"), inner);
  if (s.contains("result")) result(s["result"], below(at, "result"));
  if (s.contains("context"))
    context(s["context"], below(at, "context"), !s.contains("object") || object_is(s, "Activity"));
  text(s, at, "timestamp", false, xapi::is_timestamp, "time of RFC 3339");
  text(s, at, "stored", false, xapi::is_timestamp, "time of RFC 3339");
  const auto version = [](std::string_view v) { return v.starts_with("2.0") || v.starts_with("1.0"); };
  text(s, at, "version", false, version, "version 1.0 or 2.0");
  if (s.contains("authority")) actor(s["authority"], below(at, "authority"), {"Agent", "Group"});
  if (s.contains("attachments") && !s["attachments"].is_array()) say(below(at, "attachments"), "is no array");
  if (!inner) no_nulls(s, at);
}

}  // namespace

std::vector<std::string> xapi_problems(std::string_view statement) {
  const json parsed = json::parse(statement, nullptr, false);
  if (parsed.is_discarded()) return {"statement: is no JSON"};
  StatementCheck check;
  for (const std::string& key : doubled_keys(statement)) check.problems.push_back(key + ": stands twice");
  check.statement(parsed, "", false);
  return check.problems;
}

}  // namespace trocar
