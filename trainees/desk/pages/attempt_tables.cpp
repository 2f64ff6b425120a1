#include <algorithm>
#include <cmath>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/markup/html.h"
#include "trainees/markup/pacing.h"
#include "trainees/markup/score_words.h"

namespace trocar::review {
namespace {

bool graded(const AttemptResult& result) { return result.grade.score.has_value(); }

std::string share_text(double share) { return fixed_text(100 * share, 1) + " %"; }

std::string quantity(const std::optional<double>& value, const std::string& unit) {
  return value && std::isfinite(*value) ? quantity_text(value, unit) : "undefined";
}

std::string recorded(const std::string& name, const std::string& words, bool mono = false) {
  return fact(name, words.empty() ? "not recorded" : words, mono);
}

bool capped_by(const Grade& grade, const std::string& part) {
  return std::any_of(grade.caps.begin(), grade.caps.end(),
                     [&](const Cap& cap) { return cap.kind == CapKind::kGate && cap.subject == part; });
}

const Subscore* failed_gate(const Grade& grade) {
  const Subscore* worst = nullptr;
  for (const Subscore& part : grade.subscores)
    if (part.gate && part.raw && capped_by(grade, part.name) &&
        (worst == nullptr || points_lost(part) > points_lost(*worst)))
      worst = &part;
  return worst;
}

const Subscore* largest_loss(const Grade& grade) {
  const Subscore* worst = nullptr;
  for (const Subscore& part : grade.subscores)
    if (part.raw && (worst == nullptr || points_lost(part) > points_lost(*worst))) worst = &part;
  return worst != nullptr && points_lost(*worst) >= 0.05 ? worst : nullptr;
}

/// What is pressed there is in no band: it belongs to every reason.
std::string beside_words(const std::vector<Event>& events) {
  const auto times = std::count_if(events.begin(), events.end(),
                                   [](const Event& event) { return event.type == event_type::kWrongPlace; });
  return times == 0 ? "" : " Beside the lit disc " + plural(times, "time", "times") + ".";
}

/// The first safety gate whose measure has no value: nothing was done that it could judge.
const Subscore* unjudged_gate(const Grade& grade) {
  const auto at = std::find_if(grade.subscores.begin(), grade.subscores.end(),
                               [](const Subscore& part) { return part.gate && !part.raw; });
  return at == grade.subscores.end() ? nullptr : &*at;
}

}  // namespace

std::string help_words(const std::string& assists) {
  if (assists.empty()) return "nothing";
  std::string out;
  for (const auto& [word, meaning] :
       {std::pair("height", "the tip keeps its height by itself"), {"plumb", "a line from the tip to what lies below"}})
    if (assists.find(word) != std::string::npos) out += (out.empty() ? "" : "; ") + std::string(meaning);
  return out;
}

double points_lost(const Subscore& part) { return 100 * part.weight * (1 - part.value); }

std::optional<bool> less_is_better(const AttemptView& view, const std::string& metric) {
  const auto it = view.less_is_better.find(metric);
  return it == view.less_is_better.end() ? std::nullopt : std::optional<bool>(it->second);
}

std::string metric_title(const std::string& name) {
  for (const char* unit : {"_n_s", "_n_per_s", "_m_per_s", "_mm", "_deg", "_hz", "_s", "_n", "_m", "_j"})
    if (name.ends_with(unit)) return words_of(name.substr(0, name.size() - std::string(unit).size()));
  return words_of(name);
}

std::string verdict_reason(const AttemptView& view, bool times) {
  const Grade& grade = view.result.grade;
  if (!graded(view.result)) return view.result.integrity.empty() ? "It carries no score." : view.result.integrity;
  for (const Event& event : view.result.events)
    if (event.severity == Severity::kCritical)
      return words_of(event.type) + (times ? " at " + fixed_text(event.t_s - view.begin_s(), 1) + " s" : "") +
             (event.unit.empty() ? "" : ": " + quantity_text(event.value, event.unit)) + ".";
  const auto said = [](const Subscore& part) {
    return words_of(part.name) + ": " + part_value_text(part, part.raw) + " (" + anchors_text(part) + ")";
  };
  const std::string beside = beside_words(view.result.events);
  if (const Subscore* gate = failed_gate(grade)) {
    const auto cap =
        std::find_if(grade.caps.begin(), grade.caps.end(), [&](const Cap& c) { return c.subject == gate->name; });
    return "Safety gate not met: " + gate_text(*gate, cap->below) + "." + beside;
  }
  const Subscore* unjudged = unjudged_gate(grade);
  const std::string unjudged_words =
      unjudged == nullptr ? ""
                          : " " + words_of(unjudged->name) + " cannot be judged: nothing was done that it measures.";
  for (const Cap& cap : grade.caps)
    if (cap.kind == CapKind::kUnfinished)
      return (grade.status == AttemptStatus::kTimeout ? "Time ran out, " : "") + cap_sentence(cap) + "." + beside +
             unjudged_words;
  if (grade.status == AttemptStatus::kTimeout) return "Time ran out.";
  const Subscore* worst = largest_loss(grade);
  const std::string most =
      worst == nullptr ? ""
                       : " Most points went on " + said(*worst) + ", " + fixed_text(points_lost(*worst), 1) + " lost.";
  if (grade.passed) return worst == nullptr ? "Nothing lost." : most.substr(1);
  return "Score " + fixed_text(*grade.score, 1) + ", pass " + number_text(view.pass_at) + "." + most;
}

std::string verdict_band(const AttemptView& view) {
  const Grade& grade = view.result.grade;
  const bool has = graded(view.result);
  const Verdict verdict = view.verdict();
  const bool judged = has || verdict.decision;
  const char* const words[] = {"Not graded", "Not yet", "Pass"};
  const int at = !judged ? 0 : verdict.passed ? 2 : 1;
  const std::string kind = at == 0 ? "none" : at == 2 ? "pass" : "notyet";
  std::string out = "<section class=\"verdict " + kind + "\" aria-label=\"Verdict\"><p class=\"word\">" +
                    shape(at == 0   ? "void"
                          : at == 2 ? "pass"
                                    : "fail") +
                    words[at] + (verdict.decision ? " <small>by decision</small>" : "") + "</p><p class=\"reason\">" +
                    (verdict.decision ? "The score says: " +
                                            std::string(!has               ? "nothing"
                                                        : verdict.by_score ? "pass"
                                                                           : "not yet") +
                                            ". "
                                      : "") +
                    escape_html(verdict_reason(view)) + "</p>";
  out += "<p class=\"score\">" + score_text(grade.score) +
         (has ? "<small> of 100</small><br/><small>" + escape_html(grade.grade) + "</small>"
              : "<br/><small>" + std::string(status_name(grade.status)) + "</small>") +
         "</p>";
  if (!view.overrides.empty()) {
    const VerdictOverride& o = view.overrides.front();
    out += "<p class=\"override\">" + shape(o.passed ? "pass" : "fail") + "<strong>" +
           (o.passed ? "Passed" : "Not passed") + " by decision of " + printed_html(o.printed, o.author) +
           "</strong>, " + date_html(o.utc) + ": " + verbatim(o.reason) +
           " <small>The score above stays as it was.</small></p>";
  }
  if (const std::string soft = soft_real_time(view.result.device); has && !soft.empty())
    out += "<p class=\"override\">" + shape("integrity") + escape_html(soft) + "</p>";
  return out + "</section>";
}

namespace {

/// Rows of the table of events, and how many they are. @param least severity; at most 200 rows.
std::pair<std::string, std::size_t> event_rows(const AttemptView& view, Severity least) {
  constexpr std::size_t kShown = 200;
  std::string rows;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < view.result.events.size() && shown < kShown; ++i) {
    const Event& event = view.result.events[i];
    if (event.severity < least) continue;
    ++shown;
    const double t = event.t_s - view.begin_s();
    const bool grave = event.severity >= Severity::kMajor;
    rows += std::string("<tr") + (grave ? " class=\"grave\"" : "") + "><th scope=\"row\" class=\"n\">" +
            std::to_string(i + 1) + "</th><td class=\"n\"><a href=\"/attempt/" + url_part(view.result.uuid) +
            "?t=" + fixed_text(std::max(0.0, t), 2) + "#moment\">" + fixed_text(t, 1) + " s</a></td>" +
            cell(words_of(event.type)) + "<td>" + (grave ? shape("unsafe") : "") + severity_name(event.severity) +
            "</td>" + number_cell(event.unit.empty() ? "" : quantity(event.value, event.unit)) +
            number_cell(event.object < 0 ? "" : std::to_string(event.object + 1)) + "</tr>";
  }
  return {rows, shown};
}

std::string event_list(const std::string& which, const std::pair<std::string, std::size_t>& rows, std::size_t all) {
  const std::string caption =
      rows.second < all ? "First " + std::to_string(rows.second) + " of " + std::to_string(all) + which
                        : plural(static_cast<std::int64_t>(all), which.substr(1, which.size() - 2), which.substr(1));
  return table(caption, head_cells({">No.", ">Time", "What", "How grave", ">Value", ">Object"}), rows.first);
}

}  // namespace

std::string event_table(const AttemptView& view) {
  const std::vector<Event>& events = view.result.events;
  if (events.empty()) return section("events", "Events", "<p>None.</p>");
  const auto of_least = [&events](Severity least) {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [least](const Event& e) { return e.severity >= least; }));
  };
  const std::size_t grave = of_least(Severity::kMajor), slight = of_least(Severity::kMinor) - grave;
  std::string out =
      grave == 0
          ? "<p>" + shape("pass") + "No major or critical event" +
                (slight == 0 ? "" : ", " + plural(static_cast<std::int64_t>(slight), "minor one", "minor ones")) +
                ".</p>"
          : event_list(" grave events", event_rows(view, Severity::kMajor), grave);
  if (grave < events.size())
    out += "<details><summary>All " + plural(static_cast<std::int64_t>(events.size()), "event", "events") +
           ", as they came</summary>" + event_list(" events", event_rows(view, Severity::kInfo), events.size()) +
           "</details>";
  return section("events", "Events", out);
}

std::string subscore_table(const AttemptView& view) {
  const Grade& grade = view.result.grade;
  std::string rows;
  for (const Subscore& part : grade.subscores) {
    const double lost = points_lost(part);
    const double filled = 60 * std::clamp(part.value, 0.0, 1.0);
    rows += "<tr><th scope=\"row\">" + escape_html(words_of(part.name)) +
            (part.gate ? " <span class=\"tag\">safety gate</span>" : "") + "</th>" +
            number_cell(part_value_text(part, part.raw)) + "<td><small>" + escape_html(anchors_text(part)) +
            "</small></td>" + number_cell(fixed_text(part.value, 2)) +
            "<td><svg class=\"bar\" viewBox=\"0 0 60 10\" aria-hidden=\"true\"><rect width=\"60\" height=\"10\" "
            "fill=\"#dfe3e8\"/><rect "
            "width=\"" +
            fixed_text(filled, 1) + "\" height=\"10\" fill=\"" + (part.value < 0.5 ? "#d55e00" : "#0072b2") +
            "\"/></svg></td>" + number_cell(share_text(part.weight)) + number_cell(fixed_text(lost, 1)) + "</tr>";
  }
  if (rows.empty()) return section("points", "Points", "<p>No score, so no points.</p>");
  std::string caps;
  for (const Cap& cap : grade.caps) caps += "<li>" + escape_html(cap_text(grade, cap)) + "</li>";
  if (!caps.empty()) caps = "<p>The score is capped:</p><ul>" + caps + "</ul>";
  return section(
      "points", "Points",
      stacked_table(
          "Share of each part = (value - none) / (full - none), 0 to 1; points lost = 100 x weight x (1 - share)",
          {"Part", ">Value", "Anchors", ">Share", "", ">Weight", ">Points lost"}, rows) +
          caps);
}

std::string metric_table(const AttemptView& view) {
  std::string rows;
  for (const Metric& metric : view.result.grade.metrics) {
    const auto words = view.metric_words.find(metric.name);
    rows += "<tr><th scope=\"row\">" + escape_html(metric_title(metric.name)) + "<br/><small class=\"mono dim\">" +
            escape_html(metric.name) + "</small></th>" + number_cell(quantity(metric.value, metric.unit)) +
            "<td class=\"long\">" + escape_html(words == view.metric_words.end() ? "" : words->second) + "</td></tr>";
  }
  if (rows.empty()) return section("metrics", "Metrics", "<p>None were computed.</p>");
  return section("metrics", "Metrics",
                 table("Every number that was computed, and how", head_cells({"Metric", ">Value", "What it is"}), rows,
                       "metrics"));
}

std::string device_facts(const AttemptView& view) {
  const RunReport& d = view.result.device;
  std::string out = "<dl class=\"facts\">" +
                    (d.without_device() ? fact("Device", "none: nothing was felt") : recorded("Device", d.backend)) +
                    recorded("Loop", d.rate_hz > 0 ? number_text(d.rate_hz) + " Hz" : "") +
                    recorded("Ticks", std::to_string(d.ticks)) + recorded("Ticks missed", std::to_string(d.overruns));
  if (!d.without_device())
    out += recorded("At its limit", share_text(d.saturated_contact_share) + " of contact") +
           recorded("Passivity at work", share_text(d.passivity_active_share) + " of contact") +
           recorded("Least energy", number_text(d.min_energy_j) + " J") + recorded("Force scale", number_text(d.kappa));
  if (!d.fault.empty()) out += recorded("Fault", d.fault);
  out += "</dl>";
  if (d.force_not_rendered())
    out += "<p class=\"warning\">" + shape("integrity") +
           "The device lacked room in over 5 % of the contact: forces were not all felt. It does not count towards a "
           "certificate.</p>";
  if (!view.result.integrity.empty())
    out += "<p class=\"warning\">" + shape("integrity") + escape_html(view.result.integrity) + "</p>";
  std::string rows;
  for (const DeviceWarning& w : d.warnings)
    rows += "<tr><th scope=\"row\">" + escape_html(w.name) + "</th>" + number_cell(fixed_text(w.first_s, 2) + " s") +
            number_cell(std::to_string(w.ticks)) + "</tr>";
  if (!rows.empty()) out += table("Warnings of the device loop", head_cells({"Warning", ">First", ">Ticks"}), rows);
  return section("device", "Run report", out);
}

std::string pace_section(const AttemptView& view) {
  const std::optional<Pacing> pacing = parse_pacing(view.result.device.realtime);
  if (!pacing) return "";
  std::string out = "<dl class=\"facts\">";
  for (const auto& [name, value] : pacing_facts(*pacing)) out += fact(name, value);
  const std::string plot = pacing_plot_svg(*pacing, view.result.device.rate_hz);
  return section("pace", "Pace of the loop",
                 out + "</dl>" +
                     (plot.empty() ? ""
                                   : figure(plot,
                                            "How late the loop woke, how far its periods were off, how long a "
                                            "tick worked.")));
}

std::string origin_facts(const AttemptView& view) {
  const AttemptResult& r = view.result;
  std::string out =
      "<dl class=\"facts wide\">" + recorded("Number here", view.number > 0 ? std::to_string(view.number) : "") +
      recorded("Exercise", view.exercise + ", version " + r.exercise_version + ", level " + r.level) +
      recorded("Seed, board", std::to_string(r.seed) + ", " + std::to_string(r.board)) + recorded("Input", r.hand) +
      (r.device.without_device() ? fact("Helped by", help_words(r.assists)) : "") + recorded("Program", view.program) +
      recorded("Organ", r.organ_name + (r.organ_synthetic ? ", synthetic" : "")) +
      recorded("Organ's origin", r.organ_credit);
  out += recorded("Attempt", r.uuid, true) + recorded("Rules (sha256)", r.rubric_sha256, true) +
         recorded("Recording (sha256)", r.recording_sha256, true) + recorded("State hash", r.state_hash, true) +
         recorded("Place in the chain", view.chain_position > 0 ? std::to_string(view.chain_position) : "") +
         recorded("Row hash", view.row_hash, true) + "</dl>";
  return section("origin", "Seed, versions, hashes", out);
}

}  // namespace trocar::review
