#include <nlohmann/json.hpp>

#include "trainees/review/page_frame.h"

namespace trocar::review {

std::string evidence_text(const std::string& json) {
  const nlohmann::json evidence = nlohmann::json::parse(json, nullptr, false);
  if (!evidence.is_object()) return json;
  const auto words_of = [](const nlohmann::json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  std::string out = evidence.contains("words") ? words_of(evidence["words"]) : "";
  for (const auto& [key, value] : evidence.items())
    if (key != "words") out += (out.empty() ? "" : "; ") + key + " " + words_of(value);
  return out;
}

}  // namespace trocar::review
