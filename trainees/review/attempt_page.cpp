#include "trainees/markup/html.h"
#include "trainees/review/attempt_parts.h"
#include "trainees/review/film_page.h"
#include "trainees/review/pages.h"

namespace trocar::review {
namespace {

std::string signatures(const AttemptView& view) {
  if (view.signatures.empty()) return "<p class=\"dim\">Not signed yet.</p>";
  std::string rows;
  for (const Signature& s : view.signatures)
    rows += "<tr><th scope=\"row\">" + escape_html(s.signer) + "</th>" + cell(words_of(s.meaning)) + "<td>" + date_html(s.utc) +
            "</td><td class=\"long\">" + escape_html(s.note) + "</td><td class=\"mono\">" + escape_html(s.row_hash.substr(0, 16)) +
            (s.row_hash == view.row_hash ? "" : " <span class=\"tag\">other bytes</span>") + "</td></tr>";
  return table("Signatures", head_cells({"Signed by", "Meaning", "When", "Note", "Bound to"}), rows);
}

std::string sign_form(const AttemptView& view, const Frame& frame) {
  const std::vector<Choice> meanings = {{"review", "Review: I have looked at it"},
                                        {"approval", "Approval: I agree with the result"},
                                        {"responsibility", "Responsibility: I answer for it"},
                                        {"authorship", "Authorship: I supervised it"}};
  return form_begin("/attempt/" + url_part(view.result.uuid) + "/sign", frame) +
         select_field("sign-meaning", "meaning", "Meaning", meanings, "review") +
         text_field("sign-note", "note", "Note to the signature (may be empty)", "", "maxlength=\"1000\"") + "<p><button>Sign" +
         (frame.who.empty() ? "" : " as " + escape_html(frame.who)) +
         "</button></p><p class=\"dim\">Your name, the time and the meaning are bound to the bytes of this attempt (row hash " +
         escape_html(view.row_hash.substr(0, 16)) + "). It cannot be taken back.</p></form>";
}

std::string override_form(const AttemptView& view, const Frame& frame) {
  return "<details><summary>Decide otherwise than the score</summary>" +
         form_begin("/attempt/" + url_part(view.result.uuid) + "/override", frame) +
         select_field("override-passed", "passed", "Your decision", {{"no", "not passed"}, {"yes", "passed"}},
                      view.result.grade.passed ? "no" : "yes") +
         area_field("override-reason", "reason", "Reason, at least 10 characters", "", 2,
                    "minlength=\"10\" maxlength=\"2000\" required=\"required\"") +
         "<p><button class=\"danger\">Record the decision</button></p><p class=\"dim\">It stands beside the score and never replaces "
         "it.</p></form></details>";
}

std::string certificate_form(const AttemptView& view, const Frame& frame) {
  if (!view.ready) return "<p class=\"dim\">No certificate yet: competence at this exercise and level has not been shown.</p>";
  return "<p>" + badge(Flag::kReady) + " " + escape_html(view.ready->evidence) +
         " <small class=\"dim\">n = " + std::to_string(view.ready->n) + ", rules " + escape_html(view.ready->rule_version) +
         "</small></p>" + form_begin("/attempt/" + url_part(view.result.uuid) + "/certify", frame) + "<p><button>Certify " +
         escape_html(view.result.trainee) + " for " + escape_html(view.exercise) + " " + escape_html(view.result.level) +
         "</button></p></form>";
}

std::string ratings(const AttemptView& view) {
  if (view.ratings.empty()) return "";
  std::string rows;
  for (const Rating& r : view.ratings)
    rows += "<tr><th scope=\"row\">" + escape_html(r.scale) + "</th>" + cell(r.item) + number_cell(number_text(r.value)) + cell(r.rater) +
            "<td>" + date_html(r.utc) + "</td></tr>";
  return section("ratings", "Ratings by people", table("Ratings", head_cells({"Scale", "Item", ">Value", "By", "When"}), rows));
}

std::string compare_section(const AttemptView& view, const Frame& frame) {
  std::string out;
  for (const Rival& rival : view.rivals)
    out += "<li><a href=\"/compare/" + url_part(view.result.uuid) + "/" + url_part(rival.uuid) + "\">" + escape_html(rival.words) +
           "</a> <small class=\"dim\">score " + score_text(rival.score) + "</small></li>";
  out = out.empty() ? "<p class=\"dim\">Nothing of the same exercise and level to compare with yet.</p>" : "<ul>" + out + "</ul>";
  if (!frame.may_write) return section("compare", "Compare with", out);
  return section("compare", "Compare with",
                 out + "<form class=\"inline\" method=\"get\" action=\"/compare\"><input type=\"hidden\" name=\"attempt\" value=\"" +
                     escape_html(view.result.uuid) + "\"/>" +
                     text_field("other", "other", "Another attempt, by its number", "", "required=\"required\" minlength=\"4\"") +
                     "<p><button>Compare</button></p></form>");
}

std::string title(const AttemptView& view, const Frame& frame) {
  const std::string path = "/attempt/" + url_part(view.result.uuid), code = view.result.trainee;
  return "<div class=\"title\"><h1>" + escape_html(view.exercise) + " " + escape_html(view.result.level) + "</h1><p class=\"dim\">" +
         link_html("/trainee/" + url_part(code) +
                       query_html({{"exercise", view.result.exercise_id}, {"level", view.result.level}, {"hand", view.result.hand}}),
                   code) +
         ", " + date_html(view.result.started_utc) + ", " + escape_html(view.result.hand) + "</p><p class=\"files\">" +
         link_html(path + "/attempt.csv", "CSV") + (frame.pdf ? " " + link_html(path + "/report.pdf", "PDF") : "") + "</p></div>";
}

}  // namespace

std::string sign_off_section(const AttemptView& view, const Frame& frame) {
  std::string out = signatures(view);
  if (view.overrides.size() > 1) {
    out += "<ul>";
    for (const VerdictOverride& o : view.overrides)
      out += "<li>" + std::string(o.passed ? "Passed" : "Not passed") + ", " + escape_html(o.printed) + ", " + date_html(o.utc) + ": " +
             escape_html(o.reason) + "</li>";
    out += "</ul>";
  }
  if (!frame.may_write) return section("sign", "Sign-off", out);
  return section("sign", "Sign-off",
                 out + sign_form(view, frame) + override_form(view, frame) + "<h3>Certificate</h3>" + certificate_form(view, frame));
}

std::string attempt_page(const AttemptView& view, Frame frame) {
  frame.title = view.exercise + " " + view.result.level + ", " + view.result.trainee;
  const std::string note_action = "/attempt/" + url_part(view.result.uuid) + "/note";
  return document(frame, title(view, frame) + verdict_band(view) + moment_section(view) + "<div class=\"two\"><div>" +
                             subscore_table(view) + event_table(view) + compare_section(view, frame) + "</div><div>" +
                             sign_off_section(view, frame) + notes_section(view.notes, note_action, frame) +
                             "</div></div>" + heat_section(view) + path_section(view) + film_section(view, frame) +
                             ratings(view) + metric_table(view) + "<div class=\"two\"><div>" + device_facts(view) +
                             "</div><div>" + origin_facts(view) + "</div></div>");
}

}  // namespace trocar::review
