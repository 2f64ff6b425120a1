#include <algorithm>
#include <cstdlib>
#include <map>

#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/loss_parts.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string curve_query(const CurveView& curve) {
  return query_html({{"exercise", curve.key.exercise_id},
                     {"level", curve.key.level},
                     {"hand", curve.key.hand},
                     {"rubric", curve.key.rubric_sha256.substr(0, 12)}});
}

Flag state_of(const CurveView& curve) {
  return curve.judgements.empty() ? Flag::kLearning : curve.judgements.front().flag;
}

/// Rows: exercise and input; columns: levels. A cell: shape of the state, best score, tries.
std::string grid(const TraineeView& view) {
  std::vector<std::string> levels;
  std::map<std::pair<std::string, std::string>, std::vector<const CurveView*>> rows;
  for (const CurveView& curve : view.curves) {
    if (std::find(levels.begin(), levels.end(), curve.key.level) == levels.end()) levels.push_back(curve.key.level);
    rows[{curve.title, curve.key.hand}].push_back(&curve);
  }
  std::sort(levels.begin(), levels.end());
  std::vector<std::string> head = {"Exercise"};
  head.insert(head.end(), levels.begin(), levels.end());
  std::string body;
  for (const auto& [name, curves] : rows) {
    body += "<tr><th scope=\"row\">" + escape_html(name.first) + " <small class=\"dim\">" + escape_html(name.second) +
            "</small></th>";
    for (const std::string& level : levels) {
      body += "<td>";
      for (const CurveView* curve : curves) {
        if (curve->key.level != level) continue;
        const bool here = view.chosen < view.curves.size() && curve == &view.curves[view.chosen];
        body += "<a class=\"gridcell\" href=\"/trainee/" + url_part(view.code) + curve_query(*curve) + "#curve\"" +
                (here ? " aria-current=\"true\"" : "") + ">" + badge(state_of(*curve)) + " <strong>" +
                score_text(curve->best) + "</strong> <small>" +
                plural(static_cast<std::int64_t>(curve->points.size()), "try", "tries") + "</small></a>";
      }
      body += "</td>";
    }
    body += "</tr>";
  }
  if (rows.empty()) return "<p>No attempts yet.</p>";
  return table("State, best score and tries by exercise and level; a cell opens its curve", head_cells(head), body,
               "grid");
}

std::string judgements(const CurveView& curve) {
  if (curve.judgements.empty()) return "<p>" + badge(Flag::kLearning) + " No judgement yet.</p>";
  std::string out = "<ul class=\"judgements\">";
  for (const Judgement& j : curve.judgements)
    out += "<li>" + badge(j.flag) + " " + escape_html(dated(j.evidence)) + " " + basis_html(j) + "</li>";
  return out + "</ul>";
}

std::int64_t decided_points(const CurveView& curve) {
  return std::count_if(curve.points.begin(), curve.points.end(),
                       [](const CurvePoint& p) { return !p.decided_by.empty(); });
}

std::string curve_caption(const CurveView& curve) {
  std::string out = "Filled: passed; hollow: not passed; cross: no score";
  out += decided_points(curve) > 0 ? "; in a diamond: decided by a person. A point opens its attempt. "
                                   : ". A point opens its attempt. ";
  if (curve.points.size() > kPointsDrawn)
    out += "Newest " + std::to_string(kPointsDrawn) + " of " + std::to_string(curve.points.size()) + " attempts. ";
  if (!curve.cohort.empty()) {
    int fewest = curve.cohort.front().n, most = fewest;
    for (const CohortBand& band : curve.cohort) {
      fewest = std::min(fewest, band.n);
      most = std::max(most, band.n);
    }
    out += "Shaded: quartiles and median of the cohort, n = " +
           (fewest == most ? std::to_string(most) : std::to_string(fewest) + " to " + std::to_string(most)) + ". ";
  } else {
    out += "Too few others for quartiles. ";
  }
  out = escape_html(out);
  if (!curve.benchmark) return out + "No benchmark is set for this exercise and level.";
  return out + "Benchmark " + number_text(curve.benchmark->full_at) + ": " + escape_html(curve.benchmark->rule) +
         " of " + escape_html(curve.benchmark->source) + ", n = " + std::to_string(curve.benchmark->n) + ", " +
         day_html(curve.benchmark->utc) + ".";
}

std::string facts(const CurveView& curve) {
  const auto fact = [](const std::string& name, const std::string& value) {
    return "<div><dt>" + escape_html(name) + "</dt><dd>" + escape_html(value) + "</dd></div>";
  };
  const Competence competence = competence_of(curve.cusum);
  std::string out =
      "<dl class=\"facts\">" + fact("Tries", std::to_string(curve.points.size())) +
      fact("Passed", std::to_string(curve.passed)) +
      (decided_points(curve) > 0 ? fact("Decided by a person", std::to_string(decided_points(curve))) : "") +
      fact("In a row", std::to_string(curve.in_a_row)) + fact("Best", score_text(curve.best)) +
      fact("Last", score_text(curve.last)) + fact("Trained", fixed_text(curve.trained_s / 60, 0) + " min");
  out += fact("Reliability", reliability_text(curve.reliability));
  out += fact("Competence", competence.shown ? "shown" : competence.first_shown ? "lost again" : "not shown yet");
  return out + "</dl>";
}

std::string cusum_caption(const CurveView& curve) {
  return "Circles: the test that competence is shown (limit " + number_text(curve.rule.shown_at) +
         "); squares: the test that it is kept (alarm at " + number_text(curve.rule.relapse_at) +
         "); a large mark decided. Failure rates " + number_text(curve.rule.adequate) + " adequate, " +
         number_text(curve.rule.inadequate) + " inadequate. At the least " + std::to_string(shortest_run(curve.rule)) +
         " passes in a row.";
}

std::string result_cell(const ListedAttempt& one) {
  const CurvePoint& p = *one.point;
  if (one.place == 0) return shape("void") + "ended by the device: not counted, passes in a row begin anew";
  const std::string verdict = shape(p.passed ? "pass" : "fail") + (p.passed ? "passed" : "not passed");
  if (!p.decided_by.empty()) return verdict + " by decision of " + printed_html(p.decided_by);
  return p.score ? verdict : shape("void") + "no score";
}

std::string attempts_pages(const CurveView& curve, int page, int pages) {
  return part_links("Parts of the list", page, pages, [&curve](int n) {
    return query_html({{"exercise", curve.key.exercise_id},
                       {"level", curve.key.level},
                       {"hand", curve.key.hand},
                       {"rubric", curve.key.rubric_sha256.substr(0, 12)},
                       {"page", std::to_string(n)}}) +
           "#attempts";
  });
}

std::string attempts_table(const TraineeView& view) {
  const AttemptsPage part = attempts_page(view);
  std::string rows;
  const auto reason_of = [&view](const CurvePoint& point) {
    const auto at = view.reasons.find(point.uuid);
    return at == view.reasons.end() ? std::string() : "<small>" + escape_html(at->second) + "</small>";
  };
  for (const ListedAttempt& one : part.shown) {
    const CurvePoint& p = *one.point;
    const std::string number = p.number > 0 ? std::to_string(p.number) : "";
    rows += "<tr><th scope=\"row\"><a href=\"/attempt/" + url_part(p.uuid) + "\">" +
            (number.empty() ? "Attempt" : "No. " + number) + "</a></th>" +
            number_cell(one.place > 0 ? std::to_string(one.place) : "\xE2\x80\x93") + "<td>" + date_html(p.utc) +
            "</td>" + cell(words_of(p.status)) + number_cell(score_text(p.score)) + "<td>" + result_cell(one) +
            (p.soft_real_time ? " <span class=\"tag\">soft real time</span>" : "") + "</td><td class=\"why\">" +
            reason_of(p) + "</td></tr>";
  }
  if (rows.empty()) return "";
  const std::string caption = part.pages == 1
                                  ? "Attempts, newest first"
                                  : "Attempts " + std::to_string(part.first) + " to " +
                                        std::to_string(part.first + static_cast<int>(part.shown.size()) - 1) + " of " +
                                        std::to_string(part.all) + ", newest first";
  return table(caption, head_cells({"Attempt", ">Try", "When", "Ended", ">Score", "Result", "Why"}), rows, "tries") +
         attempts_pages(view.curves[view.chosen], part.page, part.pages);
}

/// Over all exercises, so that trainees who met different ones can be compared.
std::string ability(const TraineeView& view) {
  const AbilityView& a = view.ability;
  if (!a.logit || !a.standard_error)
    return "<p class=\"dim\">No ability yet. " +
           escape_html(a.missing.empty() ? "It has not been computed." : a.missing) + "</p>";
  return "<p><strong>" + fixed_text(*a.logit, 2) + "</strong> logit, standard error " +
         fixed_text(*a.standard_error, 2) + ", n = " + std::to_string(a.n) + ", rules " +
         escape_html(view.rules_version) +
         "</p><p class=\"dim\">Rasch: an exercise of that difficulty is passed every second time, one that is 1 logit "
         "easier in 73 of 100 attempts.</p>";
}

/// An attempt of theirs as a link: "attempt no. 12", and its day.
std::string attempt_link(const TraineeView& view, const std::string& uuid) {
  const std::string page = "/attempt/" + url_part(uuid);
  for (const CurveView& curve : view.curves)
    for (const CurvePoint& point : curve.points)
      if (point.uuid == uuid && point.number > 0)
        return link_html(page, "attempt no. " + std::to_string(point.number)) + ", " + day_html(point.utc);
  return link_html(page, "an attempt");
}

std::string certified_title(const TraineeView& view, const Certificate& certificate) {
  for (const CurveView& curve : view.curves)
    if (curve.key.exercise_id == certificate.exercise_id) return curve.title + " " + certificate.level;
  return certificate.exercise_id + " " + certificate.level;
}

std::string certificates(const TraineeView& view, const Frame& frame) {
  const auto named = [&view](const std::string& uuid) { return attempt_link(view, uuid); };
  if (view.certificates.empty()) return "<p>None yet. A certificate is given on an attempt's page, by a person.</p>";
  std::string out;
  int n = 0;
  for (const Certificate& c : view.certificates) {
    const bool held = c.revoked_utc.empty();
    ++n;
    out += std::string("<article class=\"certificate") + (held ? "" : " withdrawn") + "\"><h3>" +
           shape(held ? "pass" : "fail") + escape_html(certified_title(view, c)) + (held ? "" : " (withdrawn)") +
           "</h3><p>" + day_html(c.utc) + ", " + author_html(c.printed, c.author, frame.demo) + ", rules " +
           escape_html(c.rule_version) + "</p>" + evidence_html(c.evidence, named);
    if (const auto shaken = view.shaken.find(c.uuid); shaken != view.shaken.end())
      out += "<p class=\"warning\">" + shape("in-question") + "In question: " + escape_html(dated(shaken->second)) +
             ". Look, and withdraw it if it must not stand.</p>";
    if (frame.pdf)
      out += "<p class=\"files\">" +
             link_html("/report/certificate/" + url_part(c.uuid) + ".pdf", "Certificate as PDF") + "</p>";
    if (!held) out += "<p>Withdrawn " + day_html(c.revoked_utc) + ": " + verbatim(c.revoked_reason) + "</p>";
    if (held && frame.may_write && frame.no_signature.empty())
      out += std::string("<details") + (frame.refused.form == "revoke-" + c.uuid ? " open=\"open\"" : "") +
             "><summary>Withdraw</summary>" + form_begin("/certificate/" + url_part(c.uuid) + "/revoke", frame) +
             text_field("revoke-" + std::to_string(n), "reason", "Reason, at least 10 characters",
                        kept(frame, "revoke-" + c.uuid, "reason"),
                        "minlength=\"10\" required=\"required\"" + refused_field(frame, "revoke-" + c.uuid)) +
             password_field("revoke-password-" + std::to_string(n), frame) + why_refused(frame, "revoke-" + c.uuid) +
             "<p><button class=\"danger\">Withdraw certificate</button></p></form></details>";
    out += "</article>";
  }
  return out;
}

std::string due_dates(const TraineeView& view) {
  std::string rows;
  for (const DueDate& due : view.due)
    rows += "<tr><th scope=\"row\">" + escape_html(due.exercise) + "</th>" + cell(due.level) + "<td>" +
            (due.utc.empty() ? "no date" : day_html(due.utc)) + (due.over ? " " + badge(Flag::kRetentionDue) : "") +
            "</td>" + cell(due.why) + "</tr>";
  return rows.empty() ? "<p>Nothing is due.</p>"
                      : stacked_table("Attempts for keeping, and steps of programmes",
                                      {"Exercise", "Level", "Due", "Why"}, rows);
}

constexpr const char* kErased =
    "<p>The training data were erased: nothing is judged, and nothing counts in the cohort.</p>";

std::string title(const TraineeView& view, const Frame& frame) {
  const std::string path = "/trainee/" + url_part(view.code);
  std::string groups;
  for (const std::string& group : view.groups)
    groups += (groups.empty() ? "" : ", ") +
              (frame.own_code.empty() ? verbatim_link("/" + query_html({{"group", group}}), group) : verbatim(group));
  return "<div class=\"title\"><h1>" + verbatim(view.name.empty() ? view.code : view.name) + "</h1><p class=\"dim\">" +
         (view.name.empty() ? "" : verbatim(view.code) + ", ") + (groups.empty() ? "in no group" : "group " + groups) +
         ", rules " + escape_html(view.rules_version.empty() ? "unknown" : view.rules_version) +
         "</p><p class=\"files\">" + link_html(path + "/attempts.csv", "CSV") +
         (frame.pdf ? " " + link_html("/report/trainee/" + url_part(view.code) + ".pdf", "PDF") : "") + "</p></div>";
}

}  // namespace

std::string notes_section(const std::vector<Note>& notes, const std::string& action, const Frame& frame) {
  std::string out;
  if (frame.may_write)
    out += form_begin(action, frame) +
           area_field("note-text", "text", "Note; the trainee meets the newest one first next time",
                      kept(frame, "note", "text"), 3,
                      "maxlength=\"4000\" required=\"required\"" + refused_field(frame, "note")) +
           why_refused(frame, "note") + "<p><button>Save note</button></p></form>";
  if (notes.empty()) return section("notes", "Notes", out + "<p class=\"dim\">No notes yet.</p>");
  out += "<ol class=\"notes\">";
  for (const Note& note : notes) {
    out += "<li><p class=\"said\">" + escape_html(note.text) + "</p><p class=\"dim\">" +
           (note.printed.empty() ? verbatim(note.author) : printed_html(note.printed, note.author)) + ", " +
           date_html(note.utc);
    if (!note.attempt_uuid.empty()) out += ", on " + link_html("/attempt/" + url_part(note.attempt_uuid), "an attempt");
    out += (note.seen_utc.empty() ? ", not met yet" : ", met " + date_html(note.seen_utc)) + "</p>" +
           (note.is_signed ? "" : "<p class=\"warning\">" + shape("integrity") + kUnsignedNote + "</p>") + "</li>";
  }
  return section("notes", "Notes", out + "</ol>");
}

AttemptsPage attempts_page(const TraineeView& view) {
  constexpr int kShown = 12;
  AttemptsPage out;
  if (view.chosen >= view.curves.size()) return out;
  const CurveView& curve = view.curves[view.chosen];
  std::vector<ListedAttempt> all;
  for (std::size_t i = 0; i < curve.points.size(); ++i) all.push_back({&curve.points[i], static_cast<int>(i) + 1});
  for (const EndedAttempt& ended : view.ended_by_device)
    if (ended.key == curve.key) all.push_back({&ended.point, 0});
  std::reverse(all.begin(), all.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const ListedAttempt& a, const ListedAttempt& b) { return a.point->utc > b.point->utc; });
  out.all = static_cast<int>(all.size());
  out.pages = std::max(1, (out.all + kShown - 1) / kShown);
  out.page = std::clamp(view.page, 1, out.pages);
  out.first = (out.page - 1) * kShown + 1;
  for (int k = out.first - 1; k < out.all && k < out.page * kShown; ++k)
    out.shown.push_back(all[static_cast<std::size_t>(k)]);
  return out;
}

std::string trainee_page(const TraineeView& view, Frame frame) {
  frame.title = view.name.empty() ? view.code : view.name;
  frame.title_verbatim = true;
  std::string out = title(view, frame) + section("exercises", "Exercises", view.erased ? kErased : grid(view));
  if (view.chosen < view.curves.size()) {
    const CurveView& curve = view.curves[view.chosen];
    const std::string name =
        curve.title + " " + curve.key.level + (curve.key.hand.empty() ? "" : ", " + curve.key.hand);
    out += section("curve", name,
                   judgements(curve) + facts(curve) + "<div class=\"two\"><div>" +
                       figure(curve_svg(curve), curve_caption(curve)) + "</div><div>" +
                       figure(cusum_svg(curve), escape_html(cusum_caption(curve))) + "</div></div>");
    if (!view.metric.choices.empty())
      out += section("measure", "Measures",
                     metric_form("/trainee/" + url_part(view.code) + "#measure",
                                 {{"exercise", curve.key.exercise_id},
                                  {"level", curve.key.level},
                                  {"hand", curve.key.hand},
                                  {"rubric", curve.key.rubric_sha256.substr(0, 12)}},
                                 view.metric.choices, view.metric.name) +
                         metric_figure(view.metric, curve.points));
  }
  if (!view.losses.empty()) out += section("why", "Where the points go", loss_tables(view.losses));
  if (view.chosen < view.curves.size()) out += section("attempts", "Attempts", attempts_table(view));
  out += "<div class=\"two\"><div>" + notes_section(view.notes, "/trainee/" + url_part(view.code) + "/note", frame);
  out += "</div><div>";
  out += section("ability", "Ability", ability(view)) +
         section("time", "Time trained",
                 view.minutes_by_week.empty()
                     ? "<p>No time yet.</p>"
                     : figure(weeks_svg(view.minutes_by_week), "Minutes a week on the exercises' clocks.")) +
         section("due", "Due", due_dates(view)) + section("certificates", "Certificates", certificates(view, frame)) +
         "</div></div>";
  return document(frame, out);
}

}  // namespace trocar::review
