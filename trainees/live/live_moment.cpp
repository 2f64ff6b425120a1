#include "trainees/live/live_moment.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace trocar {
namespace {

using nlohmann::json;

constexpr const char* kForm = "trocar-live-1";
constexpr std::size_t kLongestText = 200;

json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

std::optional<double> number_of(const json& from, const char* key) {
  const auto it = from.find(key);
  if (it == from.end() || !it->is_number()) return {};
  const double value = it->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string text_of(const json& from, const char* key) {
  const auto it = from.find(key);
  return it != from.end() && it->is_string() ? it->get<std::string>().substr(0, kLongestText) : "";
}

std::int64_t whole_of(const json& from, const char* key) {
  const auto it = from.find(key);
  return it != from.end() && it->is_number_integer() ? it->get<std::int64_t>() : 0;
}

int count_of(const json& from, const char* key) {
  constexpr std::int64_t kMost = 100000;
  return static_cast<int>(std::clamp<std::int64_t>(whole_of(from, key), 0, kMost));
}

bool flag_of(const json& from, const char* key) {
  const auto it = from.find(key);
  return it != from.end() && it->is_boolean() && it->get<bool>();
}

json of_moment(const LiveMoment& m) {
  json events = json::array();
  for (const LiveEvent& event : m.events)
    events.push_back({{"t_s", event.t_s}, {"what", event.what}, {"grave", event.grave}});
  return {{"program", m.program},
          {"trainee", m.trainee},
          {"exercise_id", m.exercise_id},
          {"exercise", m.exercise},
          {"level", m.level},
          {"hand", m.hand},
          {"setup", m.setup},
          {"attempt", m.attempt},
          {"phase", m.phase},
          {"elapsed_s", number(m.elapsed_s)},
          {"limit_s", number(m.limit_s)},
          {"force_n", number(m.force_n)},
          {"peak_force_n", number(m.peak_force_n)},
          {"limit_n", number(m.limit_n)},
          {"done", m.done},
          {"count", m.count},
          {"device", m.device},
          {"device_state", m.device_state},
          {"rate_hz", number(m.rate_hz)},
          {"missed", number(m.missed)},
          {"at_limit", m.at_limit},
          {"hears", m.hears},
          {"events", events}};
}

std::vector<LiveEvent> events_of(const json& from) {
  std::vector<LiveEvent> out;
  const auto it = from.find("events");
  if (it == from.end() || !it->is_array()) return out;
  for (const json& event : *it) {
    if (!event.is_object() || out.size() == kLiveEvents) continue;
    out.push_back({number_of(event, "t_s").value_or(0), text_of(event, "what"), flag_of(event, "grave")});
  }
  return out;
}

LiveMoment moment_of(const json& from) {
  LiveMoment m;
  m.program = text_of(from, "program");
  m.trainee = text_of(from, "trainee");
  m.exercise_id = text_of(from, "exercise_id");
  m.exercise = text_of(from, "exercise");
  m.level = text_of(from, "level");
  m.hand = text_of(from, "hand");
  m.setup = text_of(from, "setup");
  m.attempt = text_of(from, "attempt");
  m.phase = text_of(from, "phase");
  m.elapsed_s = number_of(from, "elapsed_s");
  m.limit_s = number_of(from, "limit_s");
  m.force_n = number_of(from, "force_n");
  m.peak_force_n = number_of(from, "peak_force_n");
  m.limit_n = number_of(from, "limit_n");
  m.done = count_of(from, "done");
  m.count = count_of(from, "count");
  m.device = text_of(from, "device");
  m.device_state = text_of(from, "device_state");
  m.rate_hz = number_of(from, "rate_hz");
  m.missed = number_of(from, "missed");
  m.at_limit = flag_of(from, "at_limit");
  m.hears = flag_of(from, "hears");
  m.events = events_of(from);
  return m;
}

}  // namespace

std::string live_text(const StatusSnapshot& told) {
  const json out = {
      {"form", kForm},
      {"process", {{"pid", told.process.pid}, {"boot", told.process.boot}, {"start", told.process.start}}},
      {"machine", told.machine},
      {"began_utc", told.began_utc},
      {"told_utc", told.told_utc},
      {"told_s", told.told_s},
      {"moment", of_moment(told.moment)}};
  return out.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<StatusSnapshot> parse_live_text(const std::string& text) {
  const json from = json::parse(text, nullptr, false);
  if (!from.is_object() || text_of(from, "form") != kForm) return {};
  const auto process = from.find("process"), moment = from.find("moment");
  if (process == from.end() || !process->is_object() || moment == from.end() || !moment->is_object()) return {};
  StatusSnapshot out;
  out.process = {whole_of(*process, "pid"), text_of(*process, "boot"), whole_of(*process, "start")};
  if (out.process.pid <= 0 || out.process.boot.empty()) return {};
  out.machine = text_of(from, "machine");
  out.began_utc = text_of(from, "began_utc");
  out.told_utc = text_of(from, "told_utc");
  out.told_s = number_of(from, "told_s").value_or(0);
  out.moment = moment_of(*moment);
  return out;
}

bool same_news(const LiveMoment& a, const LiveMoment& b) {
  return a.trainee == b.trainee && a.exercise_id == b.exercise_id && a.level == b.level && a.attempt == b.attempt &&
         a.phase == b.phase;
}

}  // namespace trocar
