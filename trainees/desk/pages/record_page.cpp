#include <algorithm>

#include "trainees/desk/queries/record_views.h"
#include "trainees/files/size_text.h"
#include "trainees/integrity/audit.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string parts(const char* here) {
  std::string out = "<nav class=\"parts\" aria-label=\"Record\">";
  for (const auto& [path, words] :
       {std::pair("/record", "Record"), std::pair("/audit", "Audit trail"), std::pair("/retention", "Retention")})
    out += std::string("<a href=\"") + path + "\"" + (std::string(path) == here ? " aria-current=\"page\"" : "") + ">" +
           words + "</a>";
  return out + "</nav>";
}

std::string problem_list(const std::vector<std::string>& problems) {
  std::string out = "<div class=\"error\" role=\"alert\"><p>" + shape("fail") + "<strong>" +
                    plural(static_cast<std::int64_t>(problems.size()), "problem", "problems") +
                    "</strong>. Change nothing, keep the backups, and find out what happened.</p><ul>";
  constexpr std::size_t kShown = 100;
  for (std::size_t k = 0; k < problems.size() && k < kShown; ++k)
    out += "<li>" + escape_html(sentence(problems[k])) + "</li>";
  if (problems.size() > kShown)
    out += "<li>and " + std::to_string(problems.size() - kShown) + " more: trocar db check tells all</li>";
  return out + "</ul></div>";
}

/// What the background found; it goes on while pages are looked at.
/// @param told problems that stand on the page already
std::string recordings_checked(RecordingsChecked checked, const std::vector<std::string>& told) {
  std::string out;
  const bool sound = checked.problems.empty();
  std::erase_if(checked.problems,
                [&](const std::string& problem) { return std::find(told.begin(), told.end(), problem) != told.end(); });
  if (!checked.finished_utc.empty() && (sound || !checked.problems.empty()))
    out = sound
              ? "<p class=\"notice\">" + shape("pass") +
                    "Each recording is its attempt's and gives the stored score (" +
                    escape_html(dated(checked.finished_utc.substr(0, 10)) + ", " + checked.finished_utc.substr(11, 5)) +
                    " UTC).</p>"
              : problem_list(checked.problems);
  if (checked.running)
    out += "<p class=\"dim\">Grading every attempt again from its recording: " + std::to_string(checked.done) + " of " +
           std::to_string(checked.all) + ".</p>";
  return out;
}

std::string check_section(const RecordView& view, const Frame& frame) {
  std::string out;
  if (view.problems && view.problems->empty())
    out = "<p class=\"notice\" role=\"status\">" + shape("pass") +
          "Sound: file, schema, references, hash chain, audit trail, signatures, anchor and recordings.</p>";
  if (view.problems && !view.problems->empty()) out = problem_list(*view.problems);
  if (view.recordings) out += recordings_checked(*view.recordings, view.problems.value_or(std::vector<std::string>{}));
  for (const std::string& remark : view.remarks)
    out += "<p class=\"dim\">" + shape("integrity") + "Remark: " + escape_html(remark) + "</p>";
  return section("check", "Check",
                 out +
                     "<p>Reads every row and every recording again and compares them with the hash chain, the audit "
                     "trail, its signatures and the anchor. With many recordings it takes minutes. Grading every "
                     "attempt again from its recording goes on behind this page, and begins whenever the desk "
                     "does.</p>" +
                     form_begin("/record/check#check", frame) + "<p><button>Check the record</button></p></form>");
}

std::string backup_section(const RecordView& view, const Frame& frame) {
  std::string rows;
  for (const BackupFile& backup : view.backups)
    rows += "<tr><th scope=\"row\" class=\"mono\">" + escape_html(backup.name) + "</th><td>" + date_html(backup.utc) +
            "</td>" + number_cell(size_text(backup.bytes)) + "</tr>";
  const std::string listed = rows.empty() ? "<p>None lies beside the record.</p>"
                                          : table("Backups beside the record, newest first",
                                                  head_cells({"File", "Made (UTC)", ">Size"}), rows);
  return section(
      "backups", "Backups",
      listed + why_refused(frame, "backup") + form_begin("/record/backup", frame) +
          select_field("backup-leave", "leave", "Recordings",
                       {{"", "taken along, " + size_text(view.recordings_bytes)}, {"recordings", "left out"}}, "") +
          "<p><button>Make a backup</button></p></form><p class=\"dim\">A whole copy of database "
          "and recordings in the same folder; with many recordings it takes minutes. Without them a copy "
          "elsewhere has scores and no motion, and its check says so. Take it to another disk: one beside "
          "the record is lost with it.</p>");
}

std::string audit_filters(const AuditView& view) {
  std::vector<std::pair<std::string, std::string>> persons = {{"", "everybody"}}, actions = {{"", "any action"}};
  persons.insert(persons.end(), view.persons.begin(), view.persons.end());
  for (const std::string& action : view.actions) actions.emplace_back(action, action);
  return "<form class=\"filters\" method=\"get\" action=\"/audit\">" +
         select_field("f-person", "person", "Done by", persons, view.asked.person) +
         select_field("f-action", "action", "Action", actions, view.asked.action) +
         "<p class=\"field\"><button>Show</button> " + link_html("/audit", "Reset") + "</p></form>";
}

std::string trail_clock_notice(std::size_t set_back) {
  if (set_back == 0) return "";
  return "<p class=\"warning\">" + shape("integrity") + "The clock of this machine was set back " +
         plural(static_cast<std::int64_t>(set_back), "time", "times") +
         ". Entries stand in the order in which they were written and decisions hold in that order; times around "
         "those places cannot be trusted.</p>";
}

std::string audit_pages(const AuditView& view) {
  const auto last = static_cast<int>(std::max<std::int64_t>(1, (view.total + kAuditOnPage - 1) / kAuditOnPage));
  if (last == 1) return "";
  const auto to = [&](int page, const std::string& words) {
    return link_html(
        "/audit" +
            query_html({{"person", view.asked.person}, {"action", view.asked.action}, {"page", std::to_string(page)}}),
        words);
  };
  std::string out = "<nav class=\"pages\" aria-label=\"Parts of the trail\">";
  if (view.asked.page > 1) out += to(1, "Newest") + to(view.asked.page - 1, "Newer");
  out += "<strong aria-current=\"page\">Page " + std::to_string(view.asked.page) + " of " + std::to_string(last) +
         "</strong>";
  if (view.asked.page < last) out += to(view.asked.page + 1, "Older") + to(last, "Oldest");
  return out + "</nav>";
}

}  // namespace

std::string record_page(const RecordView& view, Frame frame) {
  frame.title = "Record";
  std::string out =
      "<dl class=\"facts\">" + fact("Database", view.file.empty() ? "in memory" : view.file) +
      fact("Schema", std::to_string(view.schema)) + fact("Program", view.program.empty() ? "unknown" : view.program) +
      fact("Size", size_text(view.database_bytes)) + fact("Recordings", size_text(view.recordings_bytes)) +
      fact("Last backup", view.backups.empty() ? "none here"
                                               : dated(view.backups.front().utc.substr(0, 10)) + ", " +
                                                     view.backups.front().utc.substr(11, 5) + " UTC") +
      "</dl>" + "<dl class=\"facts\">";
  for (const auto& [what, count] : view.counts) out += fact(what, std::to_string(count));
  out += "</dl><dl class=\"facts\">" +
         fact("Head of the audit trail: noted elsewhere, it shows any later change", view.head, true) + "</dl>";
  return document(frame, "<div class=\"title\"><h1>Record</h1></div>" + parts("/record") +
                             trail_clock_notice(view.set_back) + section("facts", "What is kept", out) +
                             "<div class=\"two even\"><div>" + check_section(view, frame) + "</div><div>" +
                             backup_section(view, frame) + "</div></div>");
}

namespace {

/// What it is about in words; its identifier, which the record knows it by, on the words. An identifier of something
/// that is gone: its beginning.
std::string subject_cell(const AuditEntry& entry) {
  const bool uuid = entry.subject.size() == 36;
  const std::string words = !entry.words.empty() ? entry.words
                            : uuid               ? entry.subject.substr(0, 8) + "\xE2\x80\xA6"
                                                 : entry.subject;
  return "<td class=\"long\"" + (uuid ? " title=\"" + escape_html(entry.subject) + "\"" : std::string()) + ">" +
         (entry.page.empty() ? escape_html(words) : link_html(escape_html(entry.page), words)) + "</td>";
}

/// Digests and keys are cut; of words, those about a migration are the program's, all others are names.
std::string detail_cell(const AuditEntry& entry) {
  constexpr std::size_t kHash = 64, kShown = 16;
  std::string words, word;
  bool hashed = false;
  for (const char c : entry.detail + " ") {
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f')) {
      word += c;
      continue;
    }
    hashed = hashed || word.size() == kHash;
    words += (word.size() == kHash ? word.substr(0, kShown) + "\xE2\x80\xA6" : word) + c;
    word.clear();
  }
  words.pop_back();
  if (entry.action == kActionMigrated) return "<td class=\"long\">" + escape_html(words) + "</td>";
  return std::string("<td class=\"long") + (hashed ? " mono" : "") + "\" translate=\"no\">" + escape_html(words) +
         "</td>";
}

}  // namespace

std::string audit_page(const AuditView& view, Frame frame) {
  frame.title = "Audit trail";
  std::string rows;
  for (const AuditEntry& entry : view.entries) {
    rows += "<tr><th scope=\"row\" class=\"n\">" + std::to_string(entry.position) + "</th><td>" + date_html(entry.utc) +
            (entry.before_utc.empty()
                 ? ""
                 : " <span class=\"tag\">clock set back from " + date_html(entry.before_utc) + "</span>") +
            (entry.is_signed ? "" : " <span class=\"tag\">not signed by the station</span>") + "</td>" +
            (entry.named ? verbatim_cell(entry.who) : cell(entry.who)) + cell(entry.action) + subject_cell(entry) +
            detail_cell(entry) + "</tr>";
  }
  if (rows.empty()) rows = "<tr><td colspan=\"6\">No entry matches.</td></tr>";
  return document(
      frame,
      "<div class=\"title\"><h1>Audit trail</h1><p class=\"dim\">Entries are added, never changed; each holds the hash "
      "of the one "
      "before it.</p></div>" +
          parts("/audit") +
          section("trail", plural(view.total, "entry", "entries"),
                  trail_clock_notice(view.set_back) + audit_filters(view) +
                      stacked_table("Newest first; times are UTC",
                                    {">No.", "When", "Done by", "Action", "Of", "Detail"}, rows, "audit") +
                      audit_pages(view)));
}

std::string retention_page(const RetentionView& view, Frame frame) {
  frame.title = "Retention";
  std::string rows;
  for (const RetentionLine& line : view.lines)
    rows += "<tr><th scope=\"row\">" + verbatim_link("/trainee/" + url_part(line.code), line.code) + "</th>" +
            number_cell(std::to_string(line.attempts)) + "<td>" +
            (line.last_utc.empty() ? "never" : day_html(line.last_utc)) + "</td><td>" + day_html(line.created_utc) +
            "</td></tr>";
  const std::string days = std::to_string(view.days);
  std::string out = "<form class=\"filters\" method=\"get\" action=\"/retention\">" +
                    text_field("r-days", "days", "Not here for so many days", days,
                               "inputmode=\"numeric\" maxlength=\"5\" size=\"6\"") +
                    "<p class=\"field\"><button>Show</button></p></form>";
  if (!view.problem.empty())
    out += "<p class=\"error\" role=\"alert\">" + shape("fail") + escape_html(view.problem) + "</p>";
  else if (rows.empty())
    out += "<p>Nobody: every trainee was here within " + days + " days.</p>";
  else
    out += table(
        plural(static_cast<std::int64_t>(view.lines.size()), "trainee", "trainees") + " not here for " + days + " days",
        head_cells({"Trainee", ">Attempts", "Last attempt", "Known since"}), rows);
  return document(
      frame,
      "<div class=\"title\"><h1>Retention</h1><p class=\"dim\">A look ahead: nothing is erased from here.</p></div>" +
          parts("/retention") +
          section(
              "old", "Who would be erased",
              out +
                  "<p class=\"dim\">Erasing cannot be undone, so it is done on the station: <code>trocar db retention "
                  "--days " +
                  days +
                  " --erase</code>. What goes and what stays stands in the privacy page of the documentation.</p>"));
}

std::string demo_question_page(Frame frame) {
  frame.title = "Remove the demo";
  return document(
      frame,
      "<section class=\"card\"><h1>Remove the demo?</h1><p>The eight invented trainees, their attempts and "
      "recordings, and what was written about them, are moved into a folder of their own; nothing is erased, "
      "and no other record is touched. The desk ends then; <code>trocar review serve --demo</code> makes "
      "the cohort anew.</p>" +
          why_refused(frame, "demo") + form_begin("/demo/remove", frame) +
          "<p><button class=\"danger\">Remove the demo</button> " + link_html("/", "Keep it") +
          "</p></form></section>");
}

std::string demo_gone_page(Frame frame, const std::string& moved) {
  frame.title = "The demo is removed";
  frame.demo = false;
  frame.ended = true;
  return document(frame,
                  "<section class=\"card\"><h1>The demo is removed</h1><p>The invented trainees, their attempts and "
                  "recordings lie in <code>" +
                      escape_html(moved) +
                      "</code> now, which can be deleted. This desk has ended; your own opens with <code>trocar review "
                      "serve</code>.</p></section>");
}

}  // namespace trocar::review
