// One attempt: verdict and why, points, forces over time, events, every metric, what the device says of itself, hashes.
#include <algorithm>
#include <cmath>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/desk/reports/report_words.h"
#include "trainees/markup/board_plots.h"
#include "trainees/markup/html.h"
#include "trainees/markup/pacing.h"
#include "trainees/markup/score_words.h"
#include "trainees/markup/stiffness_plot.h"

namespace trocar::review {
namespace {

using printed::Block;
using printed::Cell;
using printed::Facts;
using printed::Figure;
using printed::Heading;
using printed::Paragraph;
using printed::Table;
using printed::Tone;

std::string quantity(const std::optional<double>& value, const std::string& unit) {
  return value && std::isfinite(*value) ? quantity_text(value, unit) : "undefined";
}

std::string share(double value) { return fixed_text(100 * value, 1) + " %"; }
std::string or_none(const std::string& text) { return text.empty() ? "not recorded" : text; }

printed::Verdict verdict(const AttemptView& view) {
  const Grade& grade = view.result.grade;
  const bool has = grade.score.has_value();
  return {!has           ? "Not graded"
          : grade.passed ? "Pass"
                         : "Not yet",
          verdict_reason(view), score_text(grade.score),
          has ? "of 100, pass " + number_text(view.pass_at) + (grade.grade.empty() ? "" : ", " + grade.grade)
              : std::string(status_name(grade.status)),
          !has           ? Tone::kQuiet
          : grade.passed ? Tone::kGood
                         : Tone::kBad};
}

Table point_table(const AttemptView& view) {
  Table table{"Points of the score",
              {{"Part", 3},
               {"Measured", 1.6, true},
               {"Full and no marks", 3.4},
               {"Value", 1, true},
               {"Weight", 1, true},
               {"Points lost", 1.1, true}},
              {},
              "No score, so no points."};
  for (const Subscore& part : view.result.grade.subscores)
    table.rows.push_back({words_of(part.name) + (part.gate ? " (safety gate)" : ""), part_value_text(part, part.raw),
                          anchors_text(part), fixed_text(part.value, 2), share(part.weight),
                          Cell(fixed_text(points_lost(part), 1), part.value < 0.5 ? Tone::kBad : Tone::kPlain)});
  return table;
}

/// A safety gate that is not full is the next thing to practise, whatever it cost; else what cost most.
const Subscore* next_to_practise(const Grade& grade) {
  const Subscore* next = nullptr;
  const auto before = [](const Subscore& a, const Subscore& b) {
    return a.gate != b.gate ? a.gate : points_lost(a) > points_lost(b);
  };
  for (const Subscore& part : grade.subscores)
    if (part.raw && points_lost(part) > 0.05 && (next == nullptr || before(part, *next))) next = &part;
  return next;
}

void add_advice(std::vector<Block>& out, const Grade& grade) {
  const Subscore* next = grade.score ? next_to_practise(grade) : nullptr;
  if (next == nullptr) return;
  out.emplace_back(
      Paragraph{"Try next: " + words_of(next->name) + (next->full_at < next->zero_at ? " down to " : " up to ") +
                part_value_text(*next, next->full_at) + " (now " + part_value_text(*next, next->raw) + ")."});
}

/// Errors of the pens, grip on the blocks: what says most of those exercises.
void add_board(std::vector<Block>& out, const AttemptView& view) {
  if (view.pose.position_m > 0)
    out.emplace_back(
        printed::Figures{{{pose_plot_svg(view.result.events, view.pose), "Place and turn of each pen.", 0.8}}});
  if (!view.grips.empty() && view.trace)
    out.emplace_back(printed::Figures{{{grip_plot_svg(*view.trace, view.result.events, view.grips),
                                        "Grip force on each block in newtons over time in seconds.", 0.8}}});
}

/// Recordings before format 3 have nothing to show here.
void add_stiffness(std::vector<Block>& out, const AttemptView& view) {
  const StiffnessReport& stiffness = view.result.device.stiffness;
  if (!stiffness.recorded) return;
  out.emplace_back(Heading{"Stiffness that the device could display", 1});
  out.emplace_back(Paragraph{stiffness_words(stiffness)});
  if (view.trace && stiffness.contact_ticks > 0)
    out.emplace_back(
        printed::Figures{{{stiffness_plot_svg(*view.trace), "Stiffness in newtons a metre over time.", 0.8}}});
}

void add_traces(std::vector<Block>& out, const AttemptView& view) {
  out.emplace_back(Heading{"Force and path", 1});
  add_board(out, view);
  if (!view.trace) {
    out.emplace_back(Paragraph{view.no_trace.empty() ? "No recording." : view.no_trace});
    return;
  }
  TimePlot plot;
  plot.lines = {{&*view.trace, false, "tissue force", "#1d2630", ""}};
  if (std::any_of(view.trace->samples.begin(), view.trace->samples.end(),
                  [](const TraceSample& s) { return s.grip_n > 0.02; }))
    plot.lines.push_back({&*view.trace, true, "grip force", "#56b4e9", "6 2"});
  plot.limits = view.limits;
  plot.events = view.result.events;
  plot.begin_s = view.begin_s();
  out.emplace_back(printed::Figures{
      {{time_plot_svg(plot),
        "Force in virtual newtons over time in seconds; marks under it are the events: circle harmless, "
        "square minor, triangle major or critical (with a line through the plot).",
        0.8}}});
  std::vector<Figure> squares;
  for (const Projection& projection : {kFromAbove, kFromFront, kFromSide})
    squares.push_back({path_svg(*view.trace, projection, view.limits, -1),
                       std::string("Tip path ") + axes_words(projection), 1.0 / 3});
  out.emplace_back(printed::Figures{std::move(squares)});
  out.emplace_back(Paragraph{
      "Ring: start; dot: end. Grey to red and thin to thick: force under, in and above the band, over the limit.",
      Tone::kQuiet});
}

Table event_rows(const AttemptView& view) {
  const std::size_t count = view.result.events.size();
  Table table{plural(static_cast<std::int64_t>(count), "event", "events"),
              {{"No.", 0.7, true},
               {"Time", 1.1, true},
               {"What", 4},
               {"How grave", 1.6},
               {"Value", 1.6, true},
               {"Object", 1, true}},
              {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Event& event = view.result.events[i];
    const Tone tone = event.severity >= Severity::kMajor ? Tone::kBad : Tone::kPlain;
    table.rows.push_back({std::to_string(i + 1), fixed_text(event.t_s - view.begin_s(), 1) + " s",
                          Cell(words_of(event.type), tone), Cell(severity_name(event.severity), tone),
                          event.unit.empty() ? "" : quantity(event.value, event.unit),
                          event.object < 0 ? "" : std::to_string(event.object + 1)});
  }
  return table;
}

Table metric_rows(const AttemptView& view) {
  Table table{"Every number that was computed, and how",
              {{"Metric", 3}, {"Value", 1.6, true}, {"What it is", 6}},
              {},
              "None were computed."};
  for (const Metric& metric : view.result.grade.metrics) {
    if (!metric.value) continue;
    const auto words = view.metric_words.find(metric.name);
    table.rows.push_back({metric_title(metric.name), quantity(metric.value, metric.unit),
                          words == view.metric_words.end() ? "" : words->second});
  }
  return table;
}

/// Names of those that mean nothing here: what this exercise does not ask for.
std::string undefined_metrics(const AttemptView& view) {
  std::string out;
  for (const Metric& metric : view.result.grade.metrics)
    if (!metric.value) out += (out.empty() ? "Undefined in this attempt: " : ", ") + metric_title(metric.name);
  return out.empty() ? out : out + ".";
}

/// Of a live attempt.
void add_pace(std::vector<Block>& out, const RunReport& d) {
  const std::optional<Pacing> pacing = parse_pacing(d.realtime);
  if (!pacing) return;
  out.emplace_back(Heading{"Pace of the loop", 2});
  out.emplace_back(Facts{pacing_facts(*pacing), 2, false});
  if (std::string plot = pacing_plot_svg(*pacing, d.rate_hz); !plot.empty())
    out.emplace_back(printed::Figures{
        {{std::move(plot), "How late the loop woke, how far its periods were off, how long a tick worked.", 1.0}}});
}

void add_device(std::vector<Block>& out, const AttemptView& view) {
  const RunReport& d = view.result.device;
  out.emplace_back(Heading{"Run report", 1});
  const bool simulated =
      d.backend.find("simulated") != std::string::npos || d.backend.find("emulated") != std::string::npos;
  Facts facts{{{"Device", d.without_device() ? "none: nothing was felt"
                                             : or_none(d.backend) + (simulated ? ", no hardware moved" : "")},
               {"Loop", d.rate_hz > 0 ? number_text(d.rate_hz) + " Hz" : "not recorded"},
               {"Ticks", std::to_string(d.ticks)},
               {"Ticks missed", std::to_string(d.overruns)}},
              4,
              false};
  if (d.without_device())
    facts.pairs.emplace_back("Helped by", help_words(view.result.assists));
  else
    facts.pairs.insert(facts.pairs.end(), {{"At its limit", share(d.saturated_contact_share) + " of contact"},
                                           {"Passivity at work", share(d.passivity_active_share) + " of contact"},
                                           {"Least energy", number_text(d.min_energy_j) + " J"},
                                           {"Force scale", number_text(d.kappa)}});
  if (!d.fault.empty()) facts.pairs.emplace_back("Fault", d.fault);
  out.emplace_back(std::move(facts));
  if (d.force_not_rendered())
    out.emplace_back(
        Paragraph{"The device lacked room in over 5 % of the contact: forces were not all felt. It does not count "
                  "towards a certificate.",
                  Tone::kBad, true});
  if (!view.result.integrity.empty()) out.emplace_back(Paragraph{view.result.integrity, Tone::kBad, true});
  add_pace(out, d);
  if (d.warnings.empty()) return;
  Table table{"Warnings of the device loop", {{"Warning", 5}, {"First", 1, true}, {"Ticks", 1, true}}, {}};
  for (const DeviceWarning& w : d.warnings)
    table.rows.push_back({w.name, fixed_text(w.first_s, 2) + " s", std::to_string(w.ticks)});
  out.emplace_back(std::move(table));
}

void add_origin(std::vector<Block>& out, const AttemptView& view) {
  const AttemptResult& r = view.result;
  out.emplace_back(Heading{"Seed, versions, hashes", 1});
  out.emplace_back(
      Facts{{{"Exercise", view.exercise + ", version " + r.exercise_version + ", level " + r.level},
             {"Seed, board", std::to_string(r.seed) + ", " + std::to_string(r.board)},
             {"Program", or_none(view.program)},
             {"Organ", or_none(r.organ_name + (r.organ_synthetic ? ", synthetic" : ""))},
             {"Organ made from", or_none(r.organ_source)},
             {"Organ's origin", or_none(r.organ_credit)},
             {"Place in the chain", view.chain_position > 0 ? std::to_string(view.chain_position) : "none"}},
            2,
            false});
  out.emplace_back(Facts{{{"Attempt", r.uuid},
                          {"Row hash (sha256)", or_none(view.row_hash)},
                          {"Exercise's rules (sha256)", or_none(r.rubric_sha256)},
                          {"Recording (sha256)", or_none(r.recording_sha256)},
                          {"Organ (sha256)", or_none(r.organ_sha256)},
                          {"State hash", or_none(r.state_hash)}},
                         1,
                         true});
}

void add_people(std::vector<Block>& out, const AttemptView& view, bool demo) {
  out.emplace_back(Heading{"Sign-off", 1});
  Table table{"",
              {{"Signed by", 2}, {"Meaning", 1.4}, {"When", 1.8}, {"Note", 4}, {"Bound to", 1.8, false, true}},
              {},
              "Not signed yet."};
  for (const Signature& s : view.signatures)
    table.rows.push_back({author_text(s.signer, s.account_uuid, demo), words_of(s.meaning), moment_text(s.utc), s.note,
                          s.row_hash.substr(0, 16) + (s.row_hash == view.row_hash ? "" : " other bytes")});
  out.emplace_back(std::move(table));
  if (view.ratings.empty()) return;
  Table ratings{"Ratings by people", {{"Scale", 2}, {"Item", 3}, {"Value", 1, true}, {"By", 2}, {"When", 2}}, {}};
  for (const Rating& r : view.ratings)
    ratings.rows.push_back({r.scale, r.item, number_text(r.value), r.rater, moment_text(r.utc)});
  out.emplace_back(std::move(ratings));
}

std::string newest_entry(const AttemptView& view, bool notes) {
  std::string out = std::max(view.result.started_utc, view.finished_utc);
  for (const Signature& s : view.signatures) out = std::max(out, s.utc);
  for (const VerdictOverride& o : view.overrides) out = std::max(out, o.utc);
  for (const Rating& r : view.ratings) out = std::max(out, r.utc);
  if (notes)
    for (const Note& note : view.notes) out = std::max(out, note.utc);
  return out;
}

}  // namespace

printed::Report attempt_report(const AttemptReportView& report, const ReportSetting& setting) {
  const AttemptView& view = report.attempt;
  printed::Report out;
  out.kind = "Attempt report";
  out.title = view.exercise + " " + view.result.level;
  out.subtitle = "Trainee " + view.result.trainee + ", " + moment_text(view.result.started_utc) + " UTC, input " +
                 view.result.hand + ", rules version " + view.rules_version;
  out.who = view.result.trainee + ", " + out.title;
  out.newest_utc = newest_entry(view, setting.notes);
  out.mark = mark_of(setting);
  out.blocks = {verdict(view)};
  if (view.changed) out.blocks.emplace_back(Paragraph{kChangedAttempt, Tone::kBad, true});
  if (const std::string soft = soft_real_time(view.result.device); view.result.grade.score && !soft.empty())
    out.blocks.emplace_back(Paragraph{soft, Tone::kBad, true});
  for (const VerdictOverride& o : view.overrides)
    out.blocks.emplace_back(Paragraph{
        std::string(o.passed ? "Passed" : "Not passed") + " by decision of " + o.printed + ", " + moment_text(o.utc) +
            ": " + o.reason +
            (&o == &view.overrides.front() ? " The score above stays as it was." : " (followed by the decision above)"),
        o.passed ? Tone::kGood : Tone::kBad, true});
  add_advice(out.blocks, view.result.grade);
  out.blocks.emplace_back(point_table(view));
  for (const Cap& cap : view.result.grade.caps)
    out.blocks.emplace_back(Paragraph{"The score is capped: " + cap_text(view.result.grade, cap), Tone::kBad, true});
  add_traces(out.blocks, view);
  add_stiffness(out.blocks, view);
  if (!report.picture_png.empty())
    out.blocks.emplace_back(printed::Picture{
        report.picture_png, "At the largest force, " + fixed_text(peak_moment_s(view), 1) + " s.", 0.6});
  else if (!report.no_picture.empty())
    out.blocks.emplace_back(Paragraph{report.no_picture, Tone::kQuiet});
  out.blocks.emplace_back(Heading{"Events", 1});
  out.blocks.emplace_back(event_rows(view));
  add_people(out.blocks, view, setting.demo);
  if (setting.notes) note_blocks(out.blocks, view.notes);
  out.blocks.emplace_back(Heading{"Metrics", 1});
  out.blocks.emplace_back(metric_rows(view));
  if (const std::string none = undefined_metrics(view); !none.empty())
    out.blocks.emplace_back(Paragraph{none, Tone::kQuiet});
  add_device(out.blocks, view);
  add_origin(out.blocks, view);
  append(out.blocks, report_terms(TermsOf::kAttempt, setting.rules));
  return out;
}

}  // namespace trocar::review
