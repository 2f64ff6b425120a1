#include <algorithm>

#include "trainees/desk/pages/pages.h"
#include "trainees/live/live_stations.h"
#include "trainees/markup/html.h"
#include "trainees/records/assessments.h"

namespace trocar::review {
namespace {

constexpr int kStationRefresh_s = 2;
constexpr double kOld_s = 4;  ///< from here on the age of what is shown is said

using State = LiveStation::State;

std::string station_fact(const std::string& name, const std::string& words) {
  return fact(name, words.empty() ? "\xE2\x80\x93" : words);
}

std::string newton(const std::optional<double>& value) { return value ? fixed_text(*value, 1) + " N" : ""; }

/// Bar of the force now, with a tick at the peak and a line at the limit.
std::string force_bar(const LiveMoment& now) {
  if (!now.force_n) return "";
  const double limit = now.limit_n.value_or(0);
  const double top = std::max({1.2 * limit, 1.1 * now.peak_force_n.value_or(0), 1.1 * *now.force_n, 0.5});
  const auto x = [&](double n) { return fixed_text(10 + 580 * std::clamp(n / top, 0.0, 1.0), 1); };
  const bool over = limit > 0 && *now.force_n >= limit;
  std::string out =
      "<svg class=\"forcebar\" viewBox=\"0 0 600 64\" role=\"img\" aria-label=\"Force now\"><rect x=\"10\" y=\"14\" "
      "width=\"580\" "
      "height=\"24\" fill=\"#e3e7eb\"/><rect x=\"10\" y=\"14\" height=\"24\" width=\"" +
      fixed_text(580 * std::clamp(*now.force_n / top, 0.0, 1.0), 1) + "\" fill=\"" + (over ? "#d55e00" : "#0072b2") +
      "\"/>";
  if (now.peak_force_n)
    out += "<path d=\"M" + x(*now.peak_force_n) + " 10V42\" stroke=\"#14191f\" stroke-width=\"3\"/><text x=\"" +
           x(*now.peak_force_n) + "\" y=\"58\" text-anchor=\"middle\">peak</text>";
  if (limit > 0)
    out += "<path d=\"M" + x(limit) +
           " 4V48\" stroke=\"#b04a00\" stroke-width=\"3\" stroke-dasharray=\"5 3\"/><text x=\"" + x(limit) +
           "\" y=\"12\" dx=\"" + (limit > 0.85 * top ? "-6\" text-anchor=\"end" : "6") +
           "\" fill=\"#9c4100\">limit</text>";
  return out + "</svg>";
}

std::string events(const LiveMoment& now) {
  if (now.attempt.empty()) return "";
  if (now.events.empty()) return "<p class=\"dim\">No events yet.</p>";
  std::string rows;
  for (std::size_t k = now.events.size(); k-- > 0;) {
    const LiveEvent& event = now.events[k];
    rows += std::string("<tr") + (event.grave ? " class=\"grave\"" : "") + ">" +
            number_cell(fixed_text(event.t_s, 1) + " s") + "<td>" + (event.grave ? shape("unsafe") : "") +
            escape_html(event.what) + "</td></tr>";
  }
  return table("Events, newest first", head_cells({">Time", "What"}), rows);
}

std::string device_words(const LiveMoment& now) {
  std::string out = now.device;
  const auto add = [&](const std::string& words) { out += (out.empty() || words.empty() ? "" : ", ") + words; };
  add(now.device_state);
  if (now.rate_hz) add(fixed_text(*now.rate_hz, 0) + " Hz");
  if (now.missed) add(*now.missed > 0 ? "missed " + fixed_text(*now.missed, 0) : "none missed");
  if (now.at_limit) add("at its limit");
  return out;
}

std::string who(const LiveMoment& now) {
  return now.trainee.empty() ? std::string("Nobody signed in")
                             : verbatim_link("/trainee/" + url_part(now.trainee), now.trainee);
}

std::string clock(const LiveMoment& now) {
  if (!now.elapsed_s) return "";
  return clock_text(*now.elapsed_s) + (now.limit_s && *now.limit_s > 0 ? " of " + clock_text(*now.limit_s) : "");
}

std::string age_words(double age_s) {
  return age_s < 90     ? fixed_text(age_s, 0) + " s ago"
         : age_s < 5400 ? fixed_text(age_s / 60, 0) + " min ago"
                        : fixed_text(age_s / 3600, 1) + " h ago";
}

std::string condition(const LiveStation& station) {
  switch (station.state) {
    case State::kEnded:
      return "<p class=\"error\">" + shape("unsafe") +
             "Ended unexpectedly: the program is gone and said no farewell. It last spoke " + age_words(station.age_s) +
             "; an attempt that was running is kept as aborted when the database is next opened.</p>";
    case State::kQuiet:
      return "<p class=\"error\">" + shape("integrity") + "Does not answer: the program is there, and last spoke " +
             age_words(station.age_s) + ".</p>";
    case State::kRunning:
      break;
  }
  return station.age_s > kOld_s ? "<p class=\"dim\">As it was " + age_words(station.age_s) + ".</p>" : "";
}

/// What the trainee sees, several times a second where there is a script, else as often as the page.
std::string picture(const LiveStation& station) {
  if (station.picture.empty()) return "";
  return "<p><img class=\"scope scene\" alt=\"View of the scope now\" src=\"/station/picture/" +
         url_part(station.picture) + "\"/></p>";
}

std::string message_link(const LiveStation& station) {
  const std::string& code = station.told.moment.trainee;
  if (station.state == State::kEnded || code.empty() || !station.told.moment.hears) return "";
  return "<p>" +
         ("<a class=\"button\" href=\"/station/message" + query_html({{"trainee", code}}) + "\">Write to " +
          verbatim(code) + "</a>") +
         "</p>";
}

std::string station_card(const LiveStation& station, std::size_t number, const Frame& frame) {
  const LiveMoment& now = station.told.moment;
  const bool idle = now.attempt.empty();
  std::string out = condition(station) + "<p class=\"live\">" + who(now) + ": <strong>" +
                    escape_html(idle ? "between attempts" : now.exercise + " " + now.level) + "</strong></p>";
  std::string facts = station_fact("State", station.state == State::kEnded ? "ended unexpectedly" : now.phase);
  if (!idle)
    facts += station_fact("Clock", clock(now)) +
             station_fact("Done", now.count > 0 ? std::to_string(now.done) + " of " + std::to_string(now.count) : "") +
             station_fact("Force now", newton(now.force_n)) + station_fact("Peak force", newton(now.peak_force_n)) +
             station_fact("Limit", newton(now.limit_n)) + station_fact("Input", now.hand) +
             station_fact("Device", device_words(now)) + station_fact("Setup", now.setup);
  out += picture(station) + "<dl class=\"facts\">" + facts + "</dl>" +
         (station.state == State::kEnded ? "" : force_bar(now)) + events(now);
  if (frame.may_write) out += message_link(station);
  const std::string where = station.told.machine.empty() ? "" : " at " + station.told.machine;
  return section("now-" + std::to_string(number),
                 now.program + where + ", process " + std::to_string(station.told.process.pid), out);
}

}  // namespace

std::string station_page(const LiveStations& view, Frame frame) {
  frame.title = "Station";
  frame.refresh_s = kStationRefresh_s;
  std::string out;
  if (!view.refusal.empty())
    out += "<section class=\"card\"><p class=\"error\">" + escape_html(view.refusal) +
           ": nothing is read from it.</p></section>";
  if (view.stations.empty() && view.refusal.empty())
    out += "<section class=\"card\"><p class=\"empty\">Nothing runs at this station now.</p></section>";
  for (std::size_t k = 0; k < view.stations.size(); ++k) out += station_card(view.stations[k], k + 1, frame);
  if (!view.unreadable.empty()) {
    std::string names;
    for (const std::string& name : view.unreadable) names += (names.empty() ? "" : ", ") + name;
    out += "<section class=\"card\"><p class=\"error\">" +
           plural(static_cast<std::int64_t>(view.unreadable.size()), "file", "files") +
           " of this desk's live folder cannot be read: " + escape_html(names) + ".</p></section>";
  }
  return document(frame,
                  "<div class=\"title\"><h1>Station</h1><p class=\"dim\">What runs now, of the programs that share "
                  "this database. Looks again every " +
                      std::to_string(kStationRefresh_s) + " s.</p></div><div id=\"live\" data-every=\"" +
                      std::to_string(kStationRefresh_s) + "\" class=\"stations\">" + out + "</div>");
}

std::string station_message_page(const std::string& trainee, const std::string& now, const std::string& problem,
                                 const std::string& text, Frame frame) {
  frame.title = "Write to " + trainee;
  frame.title_verbatim = true;
  const std::string most = std::to_string(AssessmentStore::kLongestMessage);
  return document(
      frame, "<div class=\"title\"><h1>Write to " + verbatim(trainee) + "</h1><p class=\"dim\">" + escape_html(now) +
                 "</p></div>" +
                 section("message", "Message",
                         (problem.empty() ? "" : "<p class=\"error\">" + escape_html(problem) + "</p>") +
                             form_begin("/station/message", frame) +
                             "<input type=\"hidden\" name=\"trainee\" value=\"" + escape_html(trainee) + "\"/>" +
                             text_field("message-text", "text", "One line, at most " + most + " characters", text,
                                        "maxlength=\"" + most + "\" required=\"required\" autocomplete=\"off\"") +
                             "<p><button>Send</button> " + link_html("/station", "Back without sending") +
                             "</p><p class=\"dim\">It is shown at once, small, at the upper edge of their window; the "
                             "recording keeps the moment. In an exam "
                             "it waits until the attempt is over. It is kept as a note with your name.</p></form>"));
}

}  // namespace trocar::review
