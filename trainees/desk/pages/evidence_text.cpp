#include <cmath>

#include <nlohmann/json.hpp>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

using nlohmann::json;

std::string json_text(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string text_of(const json& of, const char* key) { return of.contains(key) ? json_text(of[key]) : std::string(); }

/// "1 decision: passed by Dr Ines Okafor on 2026-03-01 (the stand slipped)".
std::string decisions_text(const json& list) {
  std::string out;
  for (const json& one : list) {
    if (!one.is_object()) continue;
    const bool passed = one.contains("passed") && one["passed"] == true;
    out += (out.empty() ? "" : ", ") + std::string(passed ? "passed" : "not passed") + " by decision of " +
           text_of(one, "by") + " on " + text_of(one, "utc").substr(0, 10) + " (" + text_of(one, "reason") +
           "; attempt " + text_of(one, "attempt") + ")";
  }
  return out;
}

}  // namespace

std::string evidence_text(const std::string& text) {
  const json evidence = json::parse(text, nullptr, false);
  if (!evidence.is_object()) return text;
  std::string out = text_of(evidence, "words");
  const auto add = [&out](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
  for (const auto& [key, value] : evidence.items()) {
    if (key == "words" || key == "attempts") continue;  // these are many, and the page lists them
    if (key == "overrides" && value.is_array()) {
      const std::string decisions = decisions_text(value);
      if (!decisions.empty()) add(decisions);
    } else if (key == "reliability" && (value.is_null() || value.is_number())) {
      add("reliability " + reliability_text(value.is_number() ? std::optional(value.get<double>()) : std::nullopt));
    } else if (key == "decided" && value.is_number()) {
      add(json_text(value) + " by decision");
    } else {
      add(key + " " + json_text(value));
    }
  }
  return out;
}

}  // namespace trocar::review
