#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "trainees/markup/html.h"
#include "trainees/review/pages.h"

namespace trocar::review {
namespace {

using nlohmann::json;

constexpr int kRefresh_s = 2;

std::string text_of(const json& from, const char* key) {
  const auto it = from.find(key);
  if (it == from.end() || it->is_null()) return "";
  return it->is_string() ? it->get<std::string>() : it->is_number() ? number_text(it->get<double>()) : "";
}

std::optional<double> number_of(const json& from, const char* key) {
  const auto it = from.find(key);
  return it != from.end() && it->is_number() ? std::optional<double>(it->get<double>()) : std::nullopt;
}

std::string fact(const std::string& name, const std::string& words) {
  return "<div><dt>" + escape_html(name) + "</dt><dd>" + (words.empty() ? "\xE2\x80\x93" : escape_html(words)) + "</dd></div>";
}

std::string newton(const std::optional<double>& value) { return value ? fixed_text(*value, 1) + " N" : ""; }

/// Bar of the force now, with a tick at the peak and a line at the limit.
std::string force_bar(const std::optional<double>& force, const std::optional<double>& peak, const std::optional<double>& limit) {
  if (!force) return "";
  const double top = std::max({1.2 * limit.value_or(0), 1.1 * peak.value_or(0), 1.1 * *force, 0.5});
  const auto x = [&](double n) { return fixed_text(10 + 580 * std::clamp(n / top, 0.0, 1.0), 1); };
  const bool over = limit && *force >= *limit;
  std::string out =
      "<svg class=\"forcebar\" viewBox=\"0 0 600 64\" role=\"img\" aria-label=\"Force now\"><rect x=\"10\" y=\"14\" width=\"580\" "
      "height=\"24\" fill=\"#e3e7eb\"/><rect x=\"10\" y=\"14\" height=\"24\" width=\"" +
      fixed_text(580 * std::clamp(*force / top, 0.0, 1.0), 1) + "\" fill=\"" + (over ? "#d55e00" : "#0072b2") + "\"/>";
  if (peak)
    out += "<path d=\"M" + x(*peak) + " 10V42\" stroke=\"#14191f\" stroke-width=\"3\"/><text x=\"" + x(*peak) +
           "\" y=\"58\" text-anchor=\"middle\">peak</text>";
  if (limit)
    out += "<path d=\"M" + x(*limit) + " 4V48\" stroke=\"#b04a00\" stroke-width=\"3\" stroke-dasharray=\"5 3\"/><text x=\"" + x(*limit) +
           "\" y=\"12\" dx=\"6\" fill=\"#9c4100\">limit</text>";
  return out + "</svg>";
}

std::string events(const json& now) {
  const auto it = now.find("events");
  if (it == now.end() || !it->is_array() || it->empty()) return "<p>No events yet.</p>";
  constexpr std::size_t kShown = 12;
  std::string rows;
  for (std::size_t k = 0; k < it->size() && k < kShown; ++k) {
    const json& event = (*it)[it->size() - 1 - k];
    if (!event.is_object()) continue;
    const std::string severity = text_of(event, "severity");
    const bool grave = severity == "major" || severity == "critical";
    const std::optional<double> t = number_of(event, "t_s");
    rows += std::string("<tr") + (grave ? " class=\"grave\"" : "") + ">" + number_cell(t ? fixed_text(*t, 1) + " s" : "") +
            cell(words_of(text_of(event, "type"))) + "<td>" + (grave ? shape("unsafe") : "") + escape_html(severity) + "</td></tr>";
  }
  return table("Events, newest first", head_cells({">Time", "What", "How grave"}), rows);
}

std::string running(const json& now) {
  const std::optional<double> elapsed = number_of(now, "elapsed_s"), limit = number_of(now, "limit_s"), force = number_of(now, "force_n"),
                              most = number_of(now, "limit_n");
  const std::string trainee = text_of(now, "trainee"), level = text_of(now, "level"), title = text_of(now, "title");
  const std::string exercise = title.empty() ? text_of(now, "exercise") : title;
  std::string clock = elapsed ? clock_text(*elapsed) : "";
  if (elapsed && limit) clock += " of " + clock_text(*limit);
  std::string done = text_of(now, "done");
  if (!done.empty() && !text_of(now, "count").empty()) done += " of " + text_of(now, "count");
  std::string device;
  if (const auto it = now.find("device"); it != now.end() && it->is_object())
    device = text_of(*it, "backend") + (text_of(*it, "rate_hz").empty() ? "" : ", " + text_of(*it, "rate_hz") + " Hz") +
             (text_of(*it, "overruns").empty() ? "" : ", missed " + text_of(*it, "overruns"));
  else
    device = text_of(now, "device");
  std::string out = "<p class=\"live\">" +
                    (trainee.empty() ? std::string("A guest") : link_html("/trainee/" + url_part(trainee), trainee)) + ": <strong>" +
                    escape_html(exercise) + " " + escape_html(level) + "</strong></p>";
  out += "<dl class=\"facts\">" + fact("State", words_of(text_of(now, "status"))) + fact("Clock", clock) + fact("Done", done) +
         fact("Force now", newton(force)) + fact("Peak force", newton(number_of(now, "peak_force_n"))) + fact("Limit", newton(most)) +
         fact("Input", text_of(now, "hand")) + fact("Device", device) + "</dl>";
  return section("now", "Running now", out + force_bar(force, number_of(now, "peak_force_n"), most) + events(now));
}

}  // namespace

std::string station_page(const std::string& text, Frame frame) {
  frame.title = "Station";
  frame.refresh_s = kRefresh_s;
  const json now = json::parse(text, nullptr, false);
  std::string out = "<div class=\"title\"><h1>Station</h1><p class=\"dim\">Looks again every 2 s.</p></div>";
  if (text.empty() || (now.is_object() && now.empty()))
    out += "<section class=\"card\"><p class=\"empty\">Nothing runs at this station now.</p></section>";
  else if (now.is_discarded() || !now.is_object())
    out += "<section class=\"card\"><p class=\"error\">What the station says of itself cannot be read.</p></section>";
  else
    out += running(now);
  return document(frame, out);
}

}  // namespace trocar::review
