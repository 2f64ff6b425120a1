#include <algorithm>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/film_page.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

/// Decisions hold in the order of the audit trail; where their times say otherwise, somebody set a clock back.
std::string decision_clock_notice(const std::vector<VerdictOverride>& newest_first) {
  const auto later = [](const VerdictOverride& a, const VerdictOverride& b) { return b.utc > a.utc; };
  if (std::adjacent_find(newest_first.begin(), newest_first.end(), later) == newest_first.end()) return "";
  return "<p class=\"warning\">" + shape("integrity") +
         "The times of these decisions do not follow their order: a clock was set back, or those of two stations "
         "differ. They stand newest first, as the audit trail has them, and the first holds.</p>";
}

std::string signatures(const AttemptView& view, bool demo) {
  if (view.signatures.empty()) return "<p class=\"dim\">Not signed yet.</p>";
  std::string rows;
  for (const Signature& s : view.signatures)
    rows += "<tr><th scope=\"row\">" + author_html(s.signer, s.account_uuid, demo) + "</th>" +
            cell(words_of(s.meaning)) + "<td>" + date_html(s.utc) + "</td><td class=\"long\" translate=\"no\">" +
            escape_html(s.note) + "</td><td class=\"mono\">" + escape_html(s.row_hash.substr(0, 16)) +
            (s.row_hash == view.row_hash ? "" : " <span class=\"tag\">other bytes</span>") + "</td></tr>";
  return stacked_table("Signatures", {"Signed by", "Meaning", "When", "Note", "Bound to"}, rows);
}

std::string no_signature_notice(const Frame& frame) {
  return "<p class=\"warning\">" + shape("integrity") + "You cannot sign, decide or certify: " +
         (frame.lost_key.empty() ? escape_html(frame.no_signature) : "the station's key is missing") + ". " +
         (!frame.lost_key.empty() ? std::string()  // the top of the page says what to do
          : frame.signed_in       ? link_html("/password", "Set your own password")
          : frame.administrator   ? link_html("/accounts", "Make an account")
                                  : std::string()) +
         "</p>";
}

std::string sign_form(const AttemptView& view, const Frame& frame) {
  const std::vector<Choice> meanings = {{"review", "Review: I have looked at it"},
                                        {"approval", "Approval: I agree with the result"},
                                        {"responsibility", "Responsibility: I answer for it"},
                                        {"authorship", "Authorship: I supervised it"}};
  return form_begin("/attempt/" + url_part(view.result.uuid) + "/sign", frame) +
         select_field("sign-meaning", "meaning", "Meaning", meanings, kept(frame, "sign", "meaning", "review")) +
         text_field("sign-note", "note", "Note to the signature (may be empty)", kept(frame, "sign", "note"),
                    "maxlength=\"1000\"" + refused_field(frame, "sign")) +
         password_field("sign-password", frame) + why_refused(frame, "sign") + "<p><button>Sign" +
         (frame.who.empty() ? "" : " as " + who_html(frame)) +
         "</button></p><p class=\"dim\">Your name, the time and the meaning are bound to the bytes of this attempt "
         "(row hash " +
         escape_html(view.row_hash.substr(0, 16)) + "). It cannot be taken back.</p></form>";
}

std::string override_form(const AttemptView& view, const Frame& frame) {
  return (view.recorded.empty() ? "" : "<p>" + escape_html(view.recorded) + "</p>") + "<details" +
         (frame.refused.form == "override" ? " open=\"open\"" : "") +
         "><summary>Decide otherwise than the score</summary>" +
         form_begin("/attempt/" + url_part(view.result.uuid) + "/override", frame) +
         select_field("override-passed", "passed", "Your decision", {{"no", "not passed"}, {"yes", "passed"}},
                      kept(frame, "override", "passed", view.verdict().passed ? "no" : "yes")) +
         area_field("override-reason", "reason", "Reason, at least 10 characters", kept(frame, "override", "reason"), 2,
                    "minlength=\"10\" maxlength=\"2000\" required=\"required\"" + refused_field(frame, "override")) +
         password_field("override-password", frame) + why_refused(frame, "override") +
         "<p><button class=\"danger\">Record the decision</button></p><p class=\"dim\">The score stays as it is; the "
         "newest "
         "decision is what counts, for unlocking, progress and certificates too.</p></form></details>";
}

bool holds(const CitedCertificate& one, const AttemptView& view) {
  return one.is_signed && one.certificate.revoked_utc.empty() &&
         one.certificate.exercise_id == view.result.exercise_id && one.certificate.level == view.result.level;
}

/// Each certificate of this exercise and level, or that cites this attempt, with its date and who gave it.
std::string certificate_list(const AttemptView& view, bool demo) {
  std::string out;
  for (const CitedCertificate& one : view.certificates) {
    const Certificate& c = one.certificate;
    const bool held = c.revoked_utc.empty();
    const std::string exercise = c.exercise_id == view.result.exercise_id ? view.exercise : c.exercise_id;
    out += "<li>" + shape(held ? "pass" : "fail") + "Certificate for " + escape_html(exercise + " " + c.level) + ", " +
           day_html(c.utc) + ", " + author_html(c.printed, c.author, demo) + ", rules " + escape_html(c.rule_version) +
           (one.cites ? ", cites this attempt" : "") +
           (held ? "" : ". Withdrawn " + day_html(c.revoked_utc) + ": " + verbatim(c.revoked_reason)) + " " +
           link_html("/trainee/" + url_part(view.result.trainee) + "#certificates", "evidence");
    if (held && !one.in_question.empty())
      out += "<p class=\"warning\">" + shape("in-question") + "In question: " + escape_html(dated(one.in_question)) +
             ". Look, and withdraw it if it must not stand.</p>";
    out += "</li>";
  }
  return out.empty() ? "" : "<ul>" + out + "</ul>";
}

std::string certificate_form(const AttemptView& view, const Frame& frame) {
  const std::string given = certificate_list(view, frame.demo);
  for (const CitedCertificate& one : view.certificates)
    if (holds(one, view)) return given + why_refused(frame, "certify");
  if (!view.ready) {
    std::string missing;
    for (const std::string& condition : view.missing)
      missing += "<li>" + escape_html(sentence(dated(condition))) + "</li>";
    return given + why_refused(frame, "certify") + "<p>A certificate cannot be given now" +
           (missing.empty() ? ": competence at this exercise and level has not been shown.</p>"
                            : ":</p><ul>" + missing + "</ul>");
  }
  const std::string why = given + why_refused(frame, "certify") + "<p>" + badge(Flag::kReady) + " " +
                          escape_html(view.ready->evidence) + " " + basis_html(*view.ready) + "</p>";
  if (!view.verdict().passed)
    return why + "<p class=\"dim\">This attempt is not passed, so no certificate can cite it. Open one that is.</p>";
  return why + form_begin("/attempt/" + url_part(view.result.uuid) + "/certify", frame) +
         password_field("certify-password", frame) + "<p><button>Certify " + verbatim(view.result.trainee) + " for " +
         escape_html(view.exercise) + " " + escape_html(view.result.level) + "</button></p></form>";
}

std::string compare_section(const AttemptView& view, const Frame& frame) {
  std::string out;
  for (const Rival& rival : view.rivals)
    out += "<li><a href=\"/compare/" + url_part(view.result.uuid) + "/" + url_part(rival.uuid) + "\">" +
           escape_html(rival.words) + "</a> <small class=\"dim\">score " + score_text(rival.score) + "</small></li>";
  out = out.empty() ? "<p class=\"dim\">Nothing of the same exercise and level to compare with yet.</p>"
                    : "<ul>" + out + "</ul>";
  if (!frame.may_write) return section("compare", "Compare with", out);
  return section(
      "compare", "Compare with",
      out +
          "<form class=\"inline\" method=\"get\" action=\"/compare\"><input type=\"hidden\" name=\"attempt\" value=\"" +
          escape_html(view.result.uuid) + "\"/>" +
          text_field("other", "other", "Another attempt, by its number or identifier", kept(frame, "compare", "other"),
                     "required=\"required\"" + refused_field(frame, "compare")) +
          why_refused(frame, "compare") + "<p><button>Compare</button></p></form>");
}

std::string changed_notice(const AttemptView& view) {
  return view.changed ? "<p class=\"warning\">" + shape("integrity") + kChangedAttempt + "</p>" : "";
}

std::string title(const AttemptView& view, const Frame& frame) {
  const std::string path = "/attempt/" + url_part(view.result.uuid), code = view.result.trainee;
  return "<div class=\"title\"><h1>" + escape_html(view.exercise) + " " + escape_html(view.result.level) +
         "</h1><p class=\"dim\">" +
         verbatim_link(
             "/trainee/" + url_part(code) +
                 query_html(
                     {{"exercise", view.result.exercise_id}, {"level", view.result.level}, {"hand", view.result.hand}}),
             code) +
         (view.number > 0 ? ", attempt no. " + std::to_string(view.number) : std::string()) + ", " +
         date_html(view.result.started_utc) + ", " + escape_html(view.result.hand) + "</p><p class=\"files\">" +
         link_html(path + "/attempt.csv", "CSV") +
         (frame.pdf ? " " + link_html("/report/attempt/" + url_part(view.result.uuid) + ".pdf", "PDF") : "") +
         "</p></div>";
}

}  // namespace

std::string sign_off_section(const AttemptView& view, const Frame& frame) {
  std::string out = signatures(view, frame.demo);
  if (view.unsigned_words)
    out = "<p class=\"warning\">" + shape("integrity") +
          "A signature, decision, rating or note of this attempt is not signed with the station's key, or was changed "
          "since: whoever may write the file can have put it in. trocar db check names it.</p>" +
          out;
  if (view.overrides.size() > 1) {
    out += "<ul>";
    for (const VerdictOverride& o : view.overrides)
      out += "<li>" + std::string(o.passed ? "Passed" : "Not passed") + ", " +
             author_html(o.printed, o.author, frame.demo) + ", " + date_html(o.utc) + ": " + verbatim(o.reason) +
             "</li>";
    out += "</ul>" + decision_clock_notice(view.overrides);
  }
  if (!frame.may_write) return section("sign", "Sign-off", out + certificate_list(view, frame.demo));
  if (!frame.no_signature.empty())
    return section("sign", "Sign-off",
                   sign_checklist(view) + out + why_refused(frame, "sign") + why_refused(frame, "override") +
                       no_signature_notice(frame) + "<h3>Certificate</h3>" + certificate_list(view, frame.demo) +
                       why_refused(frame, "certify"));
  return section("sign", "Sign-off",
                 sign_checklist(view) + out + sign_form(view, frame) + override_form(view, frame) +
                     "<h3>Certificate</h3>" + certificate_form(view, frame));
}

std::string attempt_page(const AttemptView& view, Frame frame) {
  frame.title = view.exercise + " " + view.result.level + ", " + view.result.trainee;
  const std::string note_action = "/attempt/" + url_part(view.result.uuid) + "/note";
  return document(
      frame, title(view, frame) + changed_notice(view) + verdict_band(view) + moment_section(view) +
                 "<div class=\"two\"><div>" + subscore_table(view) + notes_section(view.notes, note_action, frame) +
                 "</div><div>" + sign_off_section(view, frame) + "</div></div>" + event_table(view) +
                 compare_section(view, frame) + rating_section(view, frame) + heat_section(view) + path_section(view) +
                 film_section(view, frame) + metric_table(view) + "<div class=\"two\"><div>" + device_facts(view) +
                 "</div><div>" + origin_facts(view) + "</div></div>" + pace_section(view));
}

}  // namespace trocar::review
