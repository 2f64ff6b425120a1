#include "app/report/report.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <numbers>
#include <vector>

#include "app/report/report_style.h"
#include "app/report/stiffness_plot.h"
#include "app/report/verdict.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/markup/html.h"

namespace trocar {
namespace {

std::string cell(const std::string& words, const char* attributes = "") {
  return std::string("<td") + attributes + ">" + escape_html(words) + "</td>";
}

std::string fact(const std::string& name, const std::string& value) {
  return "<tr>" + cell(name) + cell(value.empty() ? "not stated" : value) + "</tr>";
}

std::string verdict_html(const AttemptResult& result, const ReportContext& context) {
  const Verdict verdict = judge(result, context.pass_mark);
  const char* kind = verdict.kind == Verdict::Kind::kPass     ? "pass"
                     : verdict.kind == Verdict::Kind::kNotYet ? "notyet"
                                                              : "notgraded";
  std::string out = std::string("<section class=\"verdict ") + kind + "\"><div class=\"word\">" +
                    escape_html(verdict.headline) + "</div><div><p class=\"reason\">" + escape_html(verdict.reason) +
                    "</p>";
  if (!verdict.advice.empty()) out += "<p>" + escape_html(verdict.advice) + "</p>";
  out += "</div><div class=\"score\">";
  if (result.grade.score)
    out += fixed_text(*result.grade.score, 1) + "<small> / 100</small><br><small>" + escape_html(result.grade.grade) +
           ", pass at " + number_text(context.pass_mark) + "</small>";
  else
    out += "<small>no score</small>";
  return out + "</div></section>\n";
}

std::string subscore_row(const Subscore& s) {
  const bool gate_ok = s.value >= 0.5;
  std::string name = escape_html(words_of(s.name));
  if (s.gate)
    name +=
        gate_ok ? " <span class=\"tag ok\">safety gate</span>" : " <span class=\"tag\">safety gate below half</span>";
  const double share = std::clamp(s.value, 0.0, 1.0);
  return "<tr><td>" + name + "</td><td><span class=\"bar\"><i" + (share < 0.5 ? " class=\"low\"" : "") +
         " style=\"width:" + fixed_text(100 * share, 1) + "%\"></i></span></td>" +
         cell(fixed_text(100 * s.value, 0) + " %", " class=\"n\"") +
         cell(quantity_text(s.raw, s.unit), " class=\"n\"") + cell(quantity_text(s.full_at, s.unit), " class=\"n\"") +
         cell(quantity_text(s.zero_at, s.unit), " class=\"n\"") + cell(fixed_text(100 * s.weight, 0), " class=\"n\"") +
         cell(points_lost(s) < 0.05 ? "0" : "\u2212" + fixed_text(points_lost(s), 1), " class=\"n\"") + "</tr>";
}

std::string subscores_html(const Grade& grade) {
  std::string out =
      "<section><h2>Where the points went</h2><table><thead><tr><th>Part</th><th style=\"width:24%\">Earned</th><th "
      "class=\"n\"></th><th class=\"n\">Measured</th>"
      "<th class=\"n\">Full at</th><th class=\"n\">Zero at</th><th class=\"n\">Weight</th><th class=\"n\">Points "
      "lost</th></tr></thead><tbody>";
  for (const Subscore& s : in_report_order(grade.subscores)) out += subscore_row(s);
  if (grade.subscores.empty()) out += "<tr><td colspan=\"8\">No sub-scores: the attempt was not graded.</td></tr>";
  out += "</tbody></table>";
  for (const Cap& cap : grade.caps)
    out += "<p><span class=\"tag\">score capped</span> " + escape_html(cap_sentence(cap)) + "</p>";
  return out + "</section>\n";
}

std::string picture_html(const ReportContext& context) {
  if (context.picture.empty()) return "<p class=\"dim\">No picture was recorded for this attempt.</p>";
  std::string source = context.picture.filename().string();
  if (context.embed_picture) {
    std::ifstream file(context.picture, std::ios::binary);
    if (!file) throw EnvironmentError("cannot read picture " + context.picture.string() + ": " + std::strerror(errno));
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
    return "<img alt=\"Scope picture of the attempt\" src=\"data:image/png;base64," + base64(bytes) + "\">";
  }
  return "<img alt=\"Scope picture of the attempt\" src=\"" + escape_html(source) + "\">";
}

std::string summary_html(const AttemptResult& r, const ReportContext& context) {
  std::string out = "<table class=\"facts\"><tbody>";
  out += fact("Trainee", r.trainee) + fact("Held by", r.hand) +
         fact("Exercise", context.exercise_number + " " + context.exercise_title + ", level " + r.level);
  out += fact("Board, seed", std::to_string(r.board) + ", " + std::to_string(r.seed)) +
         fact("Outcome", status_name(r.grade.status));
  if (context.time_limit_s > 0) out += fact("Time limit", number_text(context.time_limit_s) + " s");
  if (context.band.high_n > 0)
    out += fact("Wanted force", number_text(context.band.low_n) + " to " + number_text(context.band.high_n) + " N");
  if (context.pose.position_m > 0)
    out += fact("Allowed", quantity_text(context.pose.position_m, "m") + " and " +
                               number_text(context.pose.angle_rad * 180 / std::numbers::pi) + " degrees");
  if (context.band.hard_n > 0) out += fact("Hard limit", number_text(context.band.hard_n) + " N");
  out += fact("Started", r.started_utc.empty() ? "not recorded" : r.started_utc + " UTC");
  return out + "</tbody></table>";
}

std::string events_html(const AttemptResult& result, double start_s) {
  std::string out =
      "<table><thead><tr><th class=\"n\">#</th><th class=\"n\">t, s</th><th>Event</th><th>Severity</th><th "
      "class=\"n\">Value</th></tr></thead><tbody>";
  for (std::size_t i = 0; i < result.events.size(); ++i) {
    const Event& event = result.events[i];
    const std::string object = event.object >= 0 ? ", object " + std::to_string(event.object + 1) : "";
    out += event.severity >= Severity::kMajor ? "<tr class=\"major\">" : "<tr>";
    out += cell(std::to_string(i + 1), " class=\"n\"") + cell(fixed_text(event.t_s - start_s, 2), " class=\"n\"") +
           cell(words_of(event.type) + object) + cell(severity_name(event.severity)) +
           cell(event.unit.empty() ? "" : quantity_text(event.value, event.unit), " class=\"n\"") + "</tr>";
  }
  if (result.events.empty()) out += "<tr><td colspan=\"5\">No events.</td></tr>";
  return out + "</tbody></table>";
}

/// The picture that says most about the exercise: errors of the pens, grip on the blocks, else force.
std::string main_plot_html(const AttemptResult& result, const Trace& trace, const ReportContext& context) {
  std::string title = "Force against time", plot;
  if (context.pose.position_m > 0) {
    title = "Place and turn of each pen";
    plot = pose_plot_svg(result.events, context.pose);
  } else if (!context.blocks.empty()) {
    title = "Grip force against time";
    plot = grip_plot_svg(trace, result.events, context.blocks);
  } else {
    plot = force_plot_svg(trace, result.events, context.band);
  }
  return "<section class=\"force\"><h2>" + title + "</h2>" + plot + "</section>\n";
}

/// Recordings before format 3 have nothing to show here.
std::string stiffness_html(const AttemptResult& result, const Trace& trace) {
  const StiffnessReceipt& stiffness = result.device.stiffness;
  if (!stiffness.recorded) return "";
  std::string out = "<section class=\"force\"><h2>Stiffness that the device could display</h2><p>" +
                    escape_html(stiffness_words(stiffness)) + "</p>";
  if (stiffness.contact_ticks > 0) out += stiffness_plot_svg(trace);
  return out + "</section>\n";
}

std::string path_key() {
  const auto entry = [](const char* colour, int width, const char* words) {
    return "<span><b style=\"border-top:" + std::to_string(width) + "px solid " + colour + "\"></b>" + words +
           "</span>";
  };
  return "<p class=\"key\">" + entry("#7a8794", 2, "free or below band") + entry("#009e73", 3, "in band") +
         entry("#e69f00", 4, "above band") + entry("#d55e00", 6, "over the limit") +
         "<span>\u25EF event with an object</span></p>";
}

std::string metrics_html(const Grade& grade) {
  std::string out = "<section><h2>Everything measured</h2><div class=\"metrics\">";
  for (const Metric& m : grade.metrics)
    out += "<div><span>" + escape_html(words_of(m.name)) + "</span><span>" +
           escape_html(quantity_text(m.value, m.unit)) + "</span></div>";
  if (grade.metrics.empty()) out += "<div><span>Nothing was measured.</span></div>";
  return out + "</div></section>\n";
}

std::string device_html(const DeviceReceipt& d) {
  const bool simulated =
      d.backend.find("simulated") != std::string::npos || d.backend.find("emulated") != std::string::npos;
  std::string out = "<table class=\"facts\"><tbody>";
  out += fact("Ran on", d.backend + (simulated ? " \u2013 on the simulated plant, no hardware moved" : ""));
  out += fact("Loop", number_text(d.rate_hz) + " Hz, " + std::to_string(d.ticks) + " ticks, " +
                          std::to_string(d.overruns) + " overruns");
  out += fact("Force scale to the hand", number_text(d.kappa));
  out += fact("Saturated", fixed_text(100 * d.saturated_contact_share, 1) + " % of contact time" +
                               (d.force_not_rendered() ? " \u2013 FORCE NOT RENDERED" : ""));
  out += fact("Passivity control active", fixed_text(100 * d.passivity_active_share, 1) +
                                              " % of contact time, lowest energy " +
                                              number_text(1000 * d.min_energy_j) + " mJ");
  if (d.stiffness.recorded) out += fact("Stiffness clamp (K max)", d.stiffness.clamped ? "on" : "off");
  return out + fact("Fault", d.fault.empty() ? "none" : d.fault) + "</tbody></table>";
}

/// The three forces side by side: what the tissue felt, what the hand was to feel, what it was given.
std::string forces_html(const Grade& grade) {
  const auto value = [&](const char* name) {
    for (const Metric& m : grade.metrics) {
      if (m.name == name) return quantity_text(m.value, m.unit);
    }
    return std::string("not recorded");
  };
  std::string out = "<table class=\"facts\"><tbody>";
  out += fact("Virtual force (tissue)", "largest " + value("force_max_n") + ", mean " + value("force_mean_n"));
  out += fact("Commanded (stylus)", "largest " + value("commanded_max_n") + ", mean " + value("commanded_mean_n"));
  out += fact("Delivered (hand)", "largest " + value("delivered_max_n") + ", mean " + value("delivered_mean_n"));
  return out + "</tbody></table>";
}

std::string origin_html(const AttemptResult& r) {
  if (r.organ_name.empty() && r.organ_sha256.empty()) return "<p>No organ: a board exercise.</p>";
  const auto stated = [](const std::string& words) { return words.empty() ? std::string("not stated") : words; };
  return "<p>" + escape_html(stated(r.organ_name)) +
         (r.organ_synthetic ? " \u2013 <b>SYNTHETIC</b>, made by a program, not a patient" : "") + ". Made from " +
         escape_html(stated(r.organ_source)) + ". Credit and licence: " + escape_html(stated(r.organ_credit)) + "</p>";
}

std::string footer_html(const AttemptResult& r, const ReportContext& context) {
  const auto hash = [](const char* name, const std::string& value) {
    return std::string(name) + " " + (value.empty() ? "none" : escape_html(value));
  };
  return "<footer><p class=\"mono\">" + hash("attempt", r.uuid) + " \u00b7 " + hash("state", r.state_hash) +
         " \u00b7 " + hash("rubric", r.rubric_sha256) + " \u00b7 " + hash("recording", r.recording_sha256) +
         " \u00b7 " + hash("organ", r.organ_sha256) + " \u00b7 seed " + std::to_string(r.seed) + " \u00b7 board " +
         std::to_string(r.board) + "</p><p>Trocar " + escape_html(context.program_version) + ", exercise " +
         escape_html(r.exercise_id) + " version " + escape_html(r.exercise_version) +
         ". Forces are those of the scene on the instrument, in newtons. A training aid, not a medical "
         "device.</p></footer>\n";
}

}  // namespace

std::string report_page(const AttemptResult& result, const Trace& trace, const ReportContext& context) {
  const double start = trace.samples.empty() ? 0 : trace.samples.front().t_s;
  const std::string title = escape_html(context.exercise_number + " " + context.exercise_title);
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>" +
      title + " \u2013 " + escape_html(result.trainee) + "</title><style>" + kReportStyle + "</style></head><body>\n";
  page += "<div class=\"head\"><h1>" + title + " \u00b7 " + escape_html(result.level) + "</h1><p class=\"dim\">" +
          escape_html(result.trainee) + "</p></div>\n";
  if (!context.goal.empty()) page += "<p class=\"dim\">Goal: " + escape_html(context.goal) + "</p>\n";
  page += verdict_html(result, context);
  page += "<div class=\"two top\"><div>" + picture_html(context) + "</div><div>" + summary_html(result, context) +
          "</div></div>\n";
  page += subscores_html(result.grade);
  page += main_plot_html(result, trace, context);
  page += stiffness_html(result, trace);
  page += "<div class=\"two path\"><div><section><h2>Events</h2>" + events_html(result, start) + "</section>" +
          metrics_html(result.grade) + "</div><div><section><h2>Tip path from above</h2>" +
          path_plot_svg(trace, result.events, context.band) + path_key() + "</section><section><h2>Device</h2>" +
          device_html(result.device) + forces_html(result.grade) + "</section></div></div>\n";
  page += "<section><h2>Organ</h2>" + origin_html(result) + "</section>\n";
  return page + footer_html(result, context) + "</body></html>\n";
}

void write_report(const std::filesystem::path& path_html, const AttemptResult& result, const Trace& trace,
                  const ReportContext& context) {
  const std::string page = report_page(result, trace, context);
  std::ofstream file = open_owner_file(path_html);
  if (!file) throw EnvironmentError("cannot write report " + path_html.string() + ": " + std::strerror(errno));
  file << page;
  file.close();
  if (!file) throw EnvironmentError("cannot write report " + path_html.string() + ": disk full or device error");
}

}  // namespace trocar
