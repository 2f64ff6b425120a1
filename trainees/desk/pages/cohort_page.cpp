#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <set>

#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

constexpr int kNamesInCard = 5;

struct CardWords {
  Flag flag;
  const char *key, *title, *none;
};
constexpr std::array<CardWords, 5> kCards = {{{Flag::kUnsafe, "unsafe", "Unsafe", "Nobody"},
                                              {Flag::kRelapsed, "relapsed", "Relapsed", "Nobody"},
                                              {Flag::kStuck, "stuck", "Stuck", "Nobody"},
                                              {Flag::kReady, "ready", "Ready", "Nobody yet"},
                                              {Flag::kNotStarted, "not-started", "Not started", "Nobody"}}};

bool holds(const CohortEntry& line, Flag flag) {
  return std::any_of(line.judgements.begin(), line.judgements.end(),
                     [&](const Judgement& j) { return j.flag == flag; }) ||
         (line.judgements.empty() && flag == Flag::kLearning);
}

const Judgement* judgement_of(const CohortEntry& line, Flag flag) {
  for (const Judgement& j : line.judgements)
    if (j.flag == flag) return &j;
  return nullptr;
}

std::string curve_href(const CohortEntry& line) {
  if (line.state() == Flag::kNotStarted) return "/trainee/" + url_part(line.code);
  return "/trainee/" + url_part(line.code) +
         query_html({{"exercise", line.exercise_id}, {"level", line.level}, {"hand", line.hand}});
}

std::string shown_name(const CohortEntry& line) { return line.name.empty() ? line.code : line.name; }

using Items = std::vector<std::pair<std::string, std::string>>;
Items items_of(const CohortQuestion& q) {
  return {{"group", q.group}, {"exercise", q.exercise_id}, {"level", q.level}, {"state", q.state}, {"sort", q.sort}};
}

std::string with(const CohortQuestion& q, const std::string& name, const std::string& value) {
  Items items = items_of(q);
  for (auto& [key, old] : items)
    if (key == name) old = value;
  if (name == "page") items.emplace_back("page", value);
  return query_html(items);
}

std::string card(const CohortView& view, const CardWords& words) {
  const std::vector<const CohortEntry*> who = trainees_in_state(view, words.flag);
  std::string out = std::string("<section class=\"state ") + words.key + "\" aria-labelledby=\"card-" + words.key +
                    "\"><h2 id=\"card-" + words.key + "\">" + shape(words.key) + words.title +
                    "</h2><p class=\"count\">" + std::to_string(who.size()) + "</p>";
  if (who.empty()) return out + "<p class=\"dim\">" + words.none + "</p></section>";
  out += "<ul>";
  for (std::size_t i = 0; i < who.size() && i < kNamesInCard; ++i) {
    const Judgement* why = judgement_of(*who[i], words.flag);
    out += "<li>" + verbatim_link(curve_href(*who[i]), shown_name(*who[i])) + " <span class=\"dim\">" +
           escape_html(who[i]->exercise) + " " + escape_html(who[i]->level) + "</span>" +
           (why == nullptr || why->evidence.empty() ? ""
                                                    : "<br/><small>" + escape_html(dated(why->evidence)) + "</small>") +
           (why == nullptr || why->n == 0 ? "" : "<br/>" + basis_html(*why)) + "</li>";
  }
  out += "</ul>";
  const std::string all = with(view.asked, "state", words.key);
  const std::size_t more = who.size() > kNamesInCard ? who.size() - kNamesInCard : 0;
  return out + "<p class=\"more\">" +
         link_html(all + "#trainees", more == 0 ? "Show in the table" : "and " + std::to_string(more) + " more") +
         "</p></section>";
}

std::string filters(const CohortView& view) {
  std::vector<Choice> exercises = {{"", "all exercises"}};
  exercises.insert(exercises.end(), view.exercises.begin(), view.exercises.end());
  const std::vector<Choice> states = {
      {"", "any state"},  {"unsafe", "unsafe"},          {"relapsed", "relapsed"}, {"in-question", "in question"},
      {"stuck", "stuck"}, {"integrity", "check record"}, {"plateau", "plateau"},   {"retention-due", "retention due"},
      {"ready", "ready"}, {"certified", "certified"},    {"learning", "learning"}, {"not-started", "not started"}};
  return "<form class=\"filters\" method=\"get\" action=\"/\">" +
         select_field("f-group", "group", "Group", all_or_one("all groups", view.groups), view.asked.group, true) +
         select_field("f-exercise", "exercise", "Exercise", exercises, view.asked.exercise_id) +
         select_field("f-level", "level", "Level", all_or_one("all levels", view.levels), view.asked.level) +
         select_field("f-state", "state", "State", states, view.asked.state) +
         "<input type=\"hidden\" name=\"sort\" value=\"" + escape_html(view.asked.sort) +
         "\"/><p class=\"field\"><button>Show</button> " + link_html("/", "Reset") + "</p></form>";
}

struct Column {
  const char *key, *title;
  bool number, falls_first;
};
constexpr std::array<Column, 11> kColumns = {{{"name", "Trainee", false, false},
                                              {"state", "State", false, false},
                                              {"exercise", "Exercise", false, false},
                                              {"level", "Level", false, false},
                                              {"tries", "Tries", true, true},
                                              {"best", "Best", true, true},
                                              {"last", "Last", true, true},
                                              {"", "Trend and pass line", false, false},
                                              {"force", "Peak force, N", true, true},
                                              {"over", "Over force", true, true},
                                              {"date", "Last seen", false, true}}};

std::string head(const CohortQuestion& asked) {
  std::string out;
  for (const Column& c : kColumns) {
    const std::string key = c.key, up = key, down = "-" + key;
    const bool rising = !key.empty() && asked.sort == up, falling = !key.empty() && asked.sort == down;
    out += std::string("<th scope=\"col\"") + (c.number ? " class=\"n\"" : "");
    if (rising || falling) out += rising ? " aria-sort=\"ascending\"" : " aria-sort=\"descending\"";
    out += ">";
    const std::string next = rising ? down : falling ? up : c.falls_first ? down : up;
    const std::string title = c.title + std::string(rising ? " \xE2\x86\x91" : falling ? " \xE2\x86\x93" : "");
    out += key.empty() ? escape_html(title) : link_html(with(asked, "sort", next) + "#trainees", title);
    out += "</th>";
  }
  return out;
}

std::string row(const CohortEntry& line) {
  std::string states = badge(line.state());
  for (std::size_t i = 1; i < line.judgements.size(); ++i) states += " " + badge(line.judgements[i].flag);
  const std::string why = line.judgements.empty() ? "" : dated(line.judgements.front().evidence);
  return "<tr><th scope=\"row\">" + verbatim_link(curve_href(line), shown_name(line)) +
         (line.name.empty() ? "" : " <small class=\"dim\">" + verbatim(line.code) + "</small>") + "</th><td>" + states +
         (why.empty() ? "" : "<br/><small>" + escape_html(why) + "</small>") +
         (line.judgements.empty() || line.judgements.front().n == 0 ? ""
                                                                    : "<br/>" + basis_html(line.judgements.front())) +
         "</td><td>" + escape_html(line.exercise) +
         (line.hand.empty() ? "" : " <small class=\"dim\">" + escape_html(line.hand) + "</small>") + "</td>" +
         cell(line.level) + number_cell(std::to_string(line.tries)) + number_cell(score_text(line.best)) +
         number_cell(score_text(line.last)) + "<td>" + spark_svg(line.scores, line.pass_at) + "</td>" +
         number_cell(line.peak_force_n ? fixed_text(*line.peak_force_n, 1) : "\xE2\x80\x93") + "<td class=\"n" +
         (line.over_force > 0 ? " bad" : "") + "\">" + std::to_string(line.over_force) + "</td><td>" +
         day_html(line.last_utc) + "</td></tr>";
}

/// By state, and of two who are unsafe by how bad it is.
bool graver(const CohortEntry& a, const CohortEntry& b) {
  if (a.state() != b.state()) return gravity(a.state()) < gravity(b.state());
  return a.harm && b.harm && worse(*a.harm, *b.harm);
}

/// Less than, by a column; what has no number stands last either way.
std::function<bool(const CohortEntry&, const CohortEntry&)> order_of(const std::string& sort) {
  const bool falling = !sort.empty() && sort[0] == '-';
  const std::string key = falling ? sort.substr(1) : sort;
  const auto number = [falling](std::function<std::optional<double>(const CohortEntry&)> of) {
    return [falling, of](const CohortEntry& a, const CohortEntry& b) {
      const double last = falling ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
      const double x = of(a).value_or(last), y = of(b).value_or(last);
      return falling ? x > y : x < y;
    };
  };
  const auto text = [falling](std::function<std::string(const CohortEntry&)> of) {
    return
        [falling, of](const CohortEntry& a, const CohortEntry& b) { return falling ? of(a) > of(b) : of(a) < of(b); };
  };
  if (key == "name") return text(shown_name);
  if (key == "exercise") return text([](const CohortEntry& l) { return l.exercise; });
  if (key == "level") return text([](const CohortEntry& l) { return l.level; });
  if (key == "date") return text([](const CohortEntry& l) { return l.last_utc; });
  if (key == "tries") return number([](const CohortEntry& l) { return std::optional<double>(l.tries); });
  if (key == "best") return number([](const CohortEntry& l) { return l.best; });
  if (key == "last") return number([](const CohortEntry& l) { return l.last; });
  if (key == "force") return number([](const CohortEntry& l) { return l.peak_force_n; });
  if (key == "over") return number([](const CohortEntry& l) { return std::optional<double>(l.over_force); });
  return [down = sort == "-state"](const CohortEntry& a, const CohortEntry& b) {
    return down ? graver(b, a) : graver(a, b);
  };
}

/// Of what is shown: it follows every filter.
std::string headline(const std::vector<CohortEntry>& lines) {
  std::set<std::string> who;
  int tries = 0;
  for (const CohortEntry& line : lines) {
    who.insert(line.code);
    tries += line.tries;
  }
  return plural(static_cast<std::int64_t>(who.size()), "trainee", "trainees") + ", " + plural(tries, "try", "tries");
}

/// What to do at a desk that has nothing to show yet.
std::string beginning(const Frame& frame) {
  std::string out =
      "<p>Nobody has finished an attempt yet. Attempts made on this station with <code>trocar practice</code> appear "
      "here by "
      "themselves.</p><p>To look round first: end this desk with Ctrl-C and start <code>trocar review serve "
      "--demo</code>. It shows "
      "eight invented trainees with a hundred attempts, in a database of their own, and a button takes them away "
      "again.</p>";
  if (frame.administrator) out += "<p>" + link_html("/accounts", "Make accounts") + " when others are to sign in.</p>";
  return section("beginning", "A desk that is still empty", out);
}

}  // namespace

std::vector<CohortEntry> selected_lines(const CohortView& view) {
  std::vector<CohortEntry> lines;
  const bool any = view.asked.state.empty() || (state_named(view.asked.state, Flag::kLearning) == Flag::kLearning &&
                                                view.asked.state != "learning");
  for (const CohortEntry& line : view.lines)
    if (any || holds(line, state_named(view.asked.state, Flag::kLearning))) lines.push_back(line);
  std::sort(lines.begin(), lines.end(), [](const CohortEntry& a, const CohortEntry& b) {
    return std::tie(a.code, a.exercise_id, a.level, a.hand) < std::tie(b.code, b.exercise_id, b.level, b.hand);
  });
  std::stable_sort(lines.begin(), lines.end(), order_of(view.asked.sort));
  return lines;
}

std::vector<const CohortEntry*> trainees_in_state(const CohortView& view, Flag flag) {
  std::map<std::string, const CohortEntry*> by_code;
  for (const CohortEntry& line : view.lines) {
    if (!holds(line, flag)) continue;
    const CohortEntry*& kept = by_code[line.code];
    const bool both_harmful = kept != nullptr && kept->harm && line.harm;
    if (kept == nullptr || (both_harmful ? worse(*line.harm, *kept->harm) : line.last_utc > kept->last_utc))
      kept = &line;
  }
  std::vector<const CohortEntry*> out;
  for (const auto& [code, line] : by_code) out.push_back(line);
  std::stable_sort(out.begin(), out.end(), [](const CohortEntry* a, const CohortEntry* b) {
    return a->harm && b->harm && worse(*a->harm, *b->harm);
  });
  return out;
}

std::string cohort_page(const CohortView& view, Frame frame) {
  frame.title = "Cohort";
  const std::vector<CohortEntry> lines = selected_lines(view);
  const int count = static_cast<int>(lines.size()), pages = std::max(1, (count + kLinesOnPage - 1) / kLinesOnPage);
  CohortQuestion asked = view.asked;
  asked.page = std::clamp(asked.page, 1, pages);
  std::string out = "<div class=\"title\"><h1>Cohort" + (asked.group.empty() ? "" : " " + verbatim(asked.group)) +
                    "</h1><p class=\"dim\">" + headline(lines) +
                    (view.erased == 0 ? "" : ", " + std::to_string(view.erased) + " erased and left out") + ", rules " +
                    escape_html(view.rules_version.empty() ? "unknown" : view.rules_version) +
                    "</p><p class=\"files\">" + link_html("/cohort.csv" + with(asked, "", ""), "CSV") +
                    (view.any_attempt ? " " + link_html("/certificates.csv" + query_html({{"group", asked.group}}),
                                                        "Certificates (CSV)")
                                      : "") +
                    (frame.pdf ? " " + link_html("/report/cohort.pdf" + with(asked, "", ""), "PDF") : "") +
                    "</p></div>" + unread_rules_notice(view.rules_unread) + "<div class=\"states\">";
  for (const CardWords& words : kCards) out += card(view, words);
  out += "</div>";
  if (!view.any_attempt) out += beginning(frame);
  std::string rows;
  for (int i = (asked.page - 1) * kLinesOnPage; i < count && i < asked.page * kLinesOnPage; ++i)
    rows += row(lines[static_cast<std::size_t>(i)]);
  if (rows.empty())
    rows = std::string("<tr><td colspan=\"11\">") +
           (!view.any_attempt ? "No attempts yet." : "Nobody matches. Choose less above.") + "</td></tr>";
  out += section("trainees", "Trainees",
                 filters(view) +
                     table("Trainees, " + plural(count, "line", "lines") +
                               ": one for each exercise, level and input; peak force is the mean over graded attempts",
                           head(asked), rows, "cohort") +
                     part_links("Parts of the table", asked.page, pages,
                                [&asked](int n) { return with(asked, "page", std::to_string(n)) + "#trainees"; }));
  return document(frame, out);
}

}  // namespace trocar::review
