#include <cctype>

#include <nlohmann/json.hpp>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/print/report.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

using nlohmann::json;

std::string json_text(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string text_of(const json& of, const char* key) { return of.contains(key) ? json_text(of[key]) : std::string(); }

/// "passed by decision of Dr Ines Okafor, 1 Mar 2026, attempt no. 12: the stand slipped", a line each.
std::string decisions_html(const json& list, const AttemptNames& named) {
  std::string out;
  for (const json& one : list) {
    if (!one.is_object()) continue;
    const bool passed = one.contains("passed") && one["passed"] == true;
    out += "<p><small>" + std::string(passed ? "passed" : "not passed") + " by decision of " +
           printed_html(text_of(one, "by")) + ", " + day_html(text_of(one, "utc")) + ", " +
           named(text_of(one, "attempt")) + ": " + verbatim(text_of(one, "reason")) + "</small></p>";
  }
  return out;
}

/// What says the whole in words; the rest is for who checks it.
std::string plain_evidence(const json& evidence) {
  std::string out = dated(text_of(evidence, "words"));
  const auto add = [&out](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
  for (const auto& [key, value] : evidence.items()) {
    if (key == "words" || key == "attempts" || key == "attempt" || key == "row_hash" || key == "overrides")
      continue;  // attempts are many, and the page lists them; the others have lines of their own
    if (key == "reliability" && (value.is_null() || value.is_number())) {
      add("reliability " + reliability_text(value.is_number() ? std::optional(value.get<double>()) : std::nullopt));
    } else if (key == "decided" && value.is_number()) {
      add(json_text(value) + " by decision");
    } else {
      add(key + " " + json_text(value));
    }
  }
  return out;
}

}  // namespace

std::string dated(const std::string& text) {
  constexpr std::size_t kDay = 10;
  const auto of_word = [&text](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '-');
  };
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::string day = text.substr(at, kDay), words = printed::day_text(day);
    const bool whole = words != day && !of_word(at + kDay) && (at == 0 || !of_word(at - 1));
    out += whole ? words : text.substr(at, 1);
    at += whole ? kDay : 1;
  }
  return out;
}

std::string evidence_html(const std::string& text, const AttemptNames& named) {
  const json evidence = json::parse(text, nullptr, false);
  if (!evidence.is_object()) return "<p><small>" + escape_html(text) + "</small></p>";
  std::string out = "<p><small>" + escape_html(plain_evidence(evidence)) + "</small></p>";
  if (const std::string cited = text_of(evidence, "attempt"); !cited.empty())
    out += "<p><small>Cites " + named(cited) + "</small></p>";
  if (evidence.contains("overrides") && evidence["overrides"].is_array())
    out += decisions_html(evidence["overrides"], named);
  if (const std::string hash = text_of(evidence, "row_hash"); !hash.empty())
    out += "<details><summary>Row hash</summary><p class=\"mono\">" + escape_html(hash) + "</p></details>";
  return out;
}

}  // namespace trocar::review
