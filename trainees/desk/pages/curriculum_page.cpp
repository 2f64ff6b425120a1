#include <algorithm>

#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string preview_table(const std::vector<PassPreview>& preview, const std::string& caption) {
  constexpr int kShown = 200;  // those that change come first
  std::string rows;
  int now = 0, then = 0, shown = 0;
  bool none_holds = true;
  for (const PassPreview& p : preview) {
    now += p.passes_now.value_or(false) ? 1 : 0;
    none_holds = none_holds && !p.passes_now;
    then += p.would_pass ? 1 : 0;
    if (++shown > kShown) continue;
    const bool differs = p.passes_now && *p.passes_now != p.would_pass;
    rows += std::string("<tr") + (differs ? " class=\"grave\"" : "") + "><th scope=\"row\">" +
            verbatim_link("/trainee/" + url_part(p.trainee), p.trainee) + "</th>" + cell(p.exercise + " " + p.level) +
            "<td>" +
            (p.passes_now ? shape(*p.passes_now ? "pass" : "fail") + (*p.passes_now ? "yes" : "no")
                          : std::string("none is set")) +
            "</td><td>" + shape(p.would_pass ? "pass" : "fail") + (p.would_pass ? "yes" : "no") +
            (differs ? " <span class=\"tag\">changes</span>" : "") + "</td><td class=\"long\">" + escape_html(p.why) +
            "</td></tr>";
  }
  if (rows.empty()) return "<p>Nobody has graded attempts to try this on.</p>";
  return "<p><strong>" + std::to_string(then) + "</strong> of " + std::to_string(preview.size()) +
         " would pass today; " +
         (none_holds ? std::string("none is set now, so nobody is measured by one")
                     : std::to_string(now) + " pass as it stands") +
         ". Nothing is saved yet.</p>" +
         table(
             shown > kShown ? caption + ", first " + std::to_string(kShown) + " of " + std::to_string(shown) : caption,
             head_cells({"Trainee", "Exercise", "Passes now", "Would pass", "Why"}), rows);
}

std::string own_version(const CurriculumView& view, const Curriculum& curriculum) {
  const auto at = view.own_version.find(curriculum.uuid);
  return at == view.own_version.end() ? "" : at->second;
}

/// An account by its name; who has none by what was printed.
std::string author_cell(const CurriculumView& view, const std::string& author) {
  const auto at = view.authors.find(author);
  if (at != view.authors.end() && !at->second.empty()) return verbatim_cell(at->second);
  return author.empty() ? cell("not recorded") : "<td>" + printed_html(author, "") + "</td>";
}

std::string versions(const CurriculumView& view) {
  std::string rows;
  for (const Curriculum& c : view.versions)
    rows +=
        "<tr><th scope=\"row\">" +
        link_html("/curriculum" + query_html({{"name", c.name}, {"version", std::to_string(c.version)}}) + "#editor",
                  c.name + (own_version(view, c).empty() ? "" : ", version " + own_version(view, c))) +
        "</th>" + number_cell(std::to_string(c.version)) + "<td>" + date_html(c.utc) + "</td>" +
        author_cell(view, c.author) + "<td class=\"mono\">" + escape_html(c.sha256.substr(0, 8)) + "</td></tr>";
  if (rows.empty())
    return section("versions", "Versions", "<p>None yet: the rules that came with the program hold.</p>");
  return section("versions", "Versions",
                 table("Every text that was saved, newest first; the newest of a name holds. The version is the one "
                       "that the text gives itself and that "
                       "decisions name; No. counts the texts of a name in this database",
                       head_cells({"Rules", ">No.", "Saved", "By", "sha256"}), rows));
}

std::string editor(const CurriculumView& view, const Frame& frame) {
  std::string out;
  if (!view.problem.empty())
    out += "<p class=\"error\" role=\"alert\">" + shape("fail") + escape_html(view.problem) + "</p>";
  if (!view.saved.empty())
    out += "<p class=\"notice\" role=\"status\">" + shape("pass") + escape_html(view.saved) + "</p>";
  const std::string size = "maxlength=\"64\" required=\"required\"";
  if (frame.may_write)
    out += form_begin("/curriculum#editor", frame) + "<input type=\"hidden\" name=\"seen_name\" value=\"" +
           escape_html(view.seen_name) + "\"/><input type=\"hidden\" name=\"seen\" value=\"" + escape_html(view.seen) +
           "\"/>" + text_field("cur-name", "name", "Name", view.name, size) +
           area_field("cur-toml", "toml", "Rules as TOML", view.text, 24,
                      "class=\"code\" spellcheck=\"false\" maxlength=\"100000\" required=\"required\"") +
           "<p class=\"buttons\"><button name=\"do\" value=\"preview\">Who would pass today</button> <button "
           "name=\"do\" value=\"save\">Save as a new "
           "version</button></p></form>";
  else
    out += "<pre class=\"code\">" + escape_html(view.text) + "</pre>";
  if (view.preview) out += preview_table(*view.preview, "Who would pass with these rules");
  return section("editor", "Rules", out);
}

std::string proposal(const BenchmarkProposal& p, const Frame& frame) {
  if (!p.problem.empty()) return "<p class=\"error\" role=\"alert\">" + shape("fail") + escape_html(p.problem) + "</p>";
  if (!p.value) return "";
  std::string out = "<p><strong>" + escape_html(words_of(p.asked.metric)) + " " + number_text(*p.value) +
                    "</strong> from " + escape_html(p.source) + ", n = " + std::to_string(p.n);
  if (p.mean && p.deviation) out += ", mean " + number_text(*p.mean) + ", SD " + number_text(*p.deviation);
  out += ".</p>";
  out += p.set_by_person ? "<p class=\"dim\">Set by a person, n = 0: it rests on no attempts. Rules " +
                               escape_html(p.rules_version) + ".</p>"
                         : "<p class=\"dim\">Reliability of their means " + reliability_text(p.reliability) +
                               ", rules " + escape_html(p.rules_version) + ".</p>";
  if (p.n < 5 && !p.set_by_person)
    out += "<p class=\"warning\">" + shape("integrity") +
           "Fewer than 5: the number would move much with the next one.</p>";
  out += preview_table(p.preview, "Who would reach this benchmark");
  if (!frame.may_write) return out;
  out += form_begin("/curriculum/benchmark", frame) + "<input type=\"hidden\" name=\"do\" value=\"save\"/>";
  const BenchmarkQuestion& a = p.asked;
  for (const auto& [name, value] : std::vector<Choice>{{"exercise", a.exercise_id},
                                                       {"level", a.level},
                                                       {"metric", a.metric},
                                                       {"who", a.who},
                                                       {"rule", a.rule},
                                                       {"fixed", a.fixed},
                                                       {"zero_at", a.zero_at}})
    out += "<input type=\"hidden\" name=\"" + name + "\" value=\"" + escape_html(value) + "\"/>";
  return out + "<p><button>Save this benchmark</button></p></form>";
}

std::string benchmark_form(const CurriculumView& view, const Frame& frame) {
  if (!frame.may_write) return "";
  const BenchmarkQuestion a = view.proposal ? view.proposal->asked : BenchmarkQuestion{};
  std::vector<Choice> levels, who = {{"", "everybody"}};
  for (const std::string& level : view.levels) levels.emplace_back(level, level);
  for (const std::string& hand : view.hands) who.emplace_back("hand:" + hand, "input " + hand);
  for (const GroupView& group : view.groups) who.emplace_back("group:" + group.name, "group " + group.name);
  for (const std::string& code : view.trainees) who.emplace_back("trainee:" + code, code);
  const std::vector<Choice> rules = {
      {"mean-2sd", "mean - 2 SD"}, {"median", "median"}, {"best-quartile", "best quartile"}, {"fixed", "fixed number"}};
  return form_begin("/curriculum/benchmark#benchmarks", frame) + "<div class=\"fields\">" +
         select_field("b-exercise", "exercise", "Exercise", view.exercises, a.exercise_id) +
         select_field("b-level", "level", "Level", levels, a.level) +
         text_field("b-metric", "metric", "Metric (score, or a metric's name)", a.metric, "required=\"required\"") +
         select_field("b-who", "who", "Attempts of", who, a.who) +
         select_field("b-rule", "rule", "Number from", rules, a.rule) +
         text_field("b-fixed", "fixed", "Fixed number", a.fixed, "inputmode=\"decimal\"") +
         text_field("b-zero", "zero_at", "No marks at (of a metric)", a.zero_at, "inputmode=\"decimal\"") +
         "</div><p><button name=\"do\" value=\"preview\">Compute and show who would pass</button></p></form>";
}

std::string benchmarks(const CurriculumView& view, const Frame& frame) {
  std::string rows;
  for (const Benchmark& b : view.benchmarks)
    rows += "<tr><th scope=\"row\">" + escape_html(b.exercise_id) + " " + escape_html(b.level) + "</th>" +
            cell(words_of(b.metric)) + number_cell(number_text(b.full_at)) + number_cell(number_text(b.zero_at)) +
            number_cell(std::to_string(b.n)) + cell(b.rule) + cell(b.source) + author_cell(view, b.author) + "<td>" +
            day_html(b.utc) + "</td></tr>";
  const std::string listed =
      rows.empty()
          ? "<p>None yet.</p>"
          : table("Benchmarks, newest first; the newest of exercise, level and metric holds",
                  head_cells({"Exercise", "Metric", ">Full at", ">None at", ">n", "Rule", "Who", "Saved by", "Date"}),
                  rows);
  return section("benchmarks", "Benchmarks",
                 listed + benchmark_form(view, frame) + (view.proposal ? proposal(*view.proposal, frame) : ""));
}

std::string difficulties(const CurriculumView& view) {
  const DifficultyView& d = view.difficulties;
  if (!d.missing.empty())
    return section("difficulties", "Difficulty of the exercises",
                   "<p class=\"dim\">" + escape_html(d.missing) + "</p>");
  std::string rows;
  for (const DifficultyLine& line : d.lines)
    rows += "<tr><th scope=\"row\">" + escape_html(line.exercise) + " " + escape_html(line.level) + "</th>" +
            cell(line.hand) + number_cell(fixed_text(line.logit, 2)) + number_cell(fixed_text(line.standard_error, 2)) +
            number_cell(std::to_string(line.n)) + "</tr>";
  if (rows.empty()) return "";
  return section("difficulties", "Difficulty of the exercises",
                 table("Rasch difficulties, easiest first, from " + std::to_string(d.attempts) + " attempts, rules " +
                           d.rules_version + ": an ability of that many logit passes every second time",
                       head_cells({"Exercise", "Input", ">Logit", ">Standard error", ">n"}), rows));
}

std::string groups(const CurriculumView& view, const Frame& frame) {
  std::string out;
  int n = 0;
  for (const GroupView& group : view.groups) {
    out += "<h3>" + verbatim_link("/" + query_html({{"group", group.name}}), group.name) + " <small class=\"dim\">" +
           plural(static_cast<std::int64_t>(group.members.size()), "trainee", "trainees") +
           "</small></h3><ul class=\"members\">";
    for (const std::string& code : group.members) {
      out += "<li>" + verbatim_link("/trainee/" + url_part(code), code);
      if (frame.may_write)
        out += form_begin("/curriculum/group", frame) +
               "<input type=\"hidden\" name=\"do\" value=\"leave\"/><input type=\"hidden\" name=\"group\" value=\"" +
               escape_html(group.name) + "\"/><input type=\"hidden\" name=\"trainee\" value=\"" + escape_html(code) +
               "\"/><button class=\"small\" id=\"leave-" + std::to_string(++n) +
               "\">Remove<span class=\"unseen\" translate=\"no\"> " + escape_html(code) + "</span></button></form>";
      out += "</li>";
    }
    out += "</ul>";
  }
  if (view.groups.empty()) out += "<p>No groups yet.</p>";
  if (!frame.may_write) return section("groups", "Groups", out);
  std::vector<Choice> codes;
  for (const std::string& code : view.trainees) codes.emplace_back(code, code);
  return section("groups", "Groups",
                 out + form_begin("/curriculum/group", frame) +
                     "<input type=\"hidden\" name=\"do\" value=\"join\"/><div class=\"fields\">" +
                     select_field("g-trainee", "trainee", "Trainee", codes, kept(frame, "group", "trainee"), true) +
                     text_field("g-group", "group", "joins the group", kept(frame, "group", "group"),
                                "maxlength=\"64\" required=\"required\"" + refused_field(frame, "group")) +
                     "</div>" + why_refused(frame, "group") + "<p><button>Add</button></p></form>");
}

}  // namespace

std::string curriculum_page(const CurriculumView& view, Frame frame) {
  frame.title = "Curriculum";
  return document(
      frame,
      "<div class=\"title\"><h1>Curriculum</h1><p class=\"dim\">Rules and benchmarks are versions: added, never "
      "changed.</p></div>" +
          unread_rules_notice(view.rules_unread) + "<div class=\"two\"><div>" + editor(view, frame) + "</div><div>" +
          versions(view) + groups(view, frame) + "</div></div>" + benchmarks(view, frame) + difficulties(view));
}

std::string message_page(const std::string& title, const std::string& words, Frame frame) {
  frame.title = title;
  return document(
      frame,
      "<section class=\"card\"><h1>" + escape_html(title) + "</h1><p>" + escape_html(words) + "</p><p>" +
          link_html(frame.own_code.empty() ? "/" : "/trainee/" + url_part(frame.own_code), "Back to the beginning") +
          "</p></section>");
}

}  // namespace trocar::review
