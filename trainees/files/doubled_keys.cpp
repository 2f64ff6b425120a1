#include "trainees/files/doubled_keys.h"

#include <nlohmann/json.hpp>
#include <set>

namespace trocar {

std::vector<std::string> doubled_keys(std::string_view text) {
  using nlohmann::json;
  std::vector<std::set<std::string>> open;
  std::vector<std::string> doubled;
  const auto note = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      doubled.push_back(value);
    return true;
  };
  [[maybe_unused]] const json unused = json::parse(text, note, false);
  return doubled;
}

}  // namespace trocar
