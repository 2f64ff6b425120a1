#include <algorithm>
#include <map>

#include "trainees/desk/queries/programme_views.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

const char* state_shape(StepState state) {
  switch (state) {
    case StepState::kOverdue:
      return "retention-due";
    case StepState::kNotStarted:
      return "void";
    case StepState::kLearning:
      return "learning";
    case StepState::kToSign:
      return "integrity";
    case StepState::kPassed:
      return "pass";
    case StepState::kCertified:
      return "certified";
  }
  return "void";
}

std::string state_badge(StepState state) {
  return std::string("<span class=\"badge step-") + step_state_key(state) + "\">" + shape(state_shape(state)) +
         step_state_words(state) + "</span>";
}

std::vector<std::pair<std::string, std::string>> asked_items(const GridQuestion& asked) {
  return {{"programme", asked.programme},
          {"group", asked.group},
          {"state", asked.state},
          {"deactivated", asked.deactivated ? "yes" : ""}};
}

std::string grid_filters(const GridView& view) {
  std::vector<Choice> states = {{"", "any state"}};
  for (const StepState state : kStepStates) states.emplace_back(step_state_key(state), step_state_words(state));
  return "<form class=\"filters\" method=\"get\" action=\"/grid\">" +
         select_field("f-programme", "programme", "Programme", one_of(view.programmes), view.asked.programme, true) +
         select_field("f-group", "group", "Group", all_or_one("all groups", view.groups), view.asked.group, true) +
         select_field("f-state", "state", "With a step that is", states, view.asked.state) +
         select_field("f-away", "deactivated", "Deactivated", {{"", "left out"}, {"yes", "shown too"}},
                      view.asked.deactivated ? "yes" : "") +
         "<p class=\"field\"><button>Show</button></p></form>";
}

std::string cell_href(const ProgrammeLine& line, const ProgrammeStep& step, const ProgrammeCell& cell) {
  const std::string page = "/trainee/" + url_part(line.code);
  if (cell.progress.attempts == 0) return page;  // there is no curve to show
  return page + query_html({{"exercise", step.exercise_id}, {"level", step.level}, {"hand", step.input}}) + "#attempts";
}

bool is_open(const ProgrammeCell& cell) {
  return cell.state == StepState::kOverdue || cell.state == StepState::kNotStarted ||
         cell.state == StepState::kLearning;
}

using Due = std::optional<std::int64_t>;

/// @param usual deadline of most people, which stands at the head of the column.
std::string grid_cell(const ProgrammeLine& line, const ProgrammeStep& step, const ProgrammeCell& cell,
                      const Due& usual) {
  std::string out = "<td><a href=\"" + cell_href(line, step, cell) + "\">" + state_badge(cell.state) + "</a>";
  if (is_open(cell) && cell.progress.attempts > 0)
    out += "<br/><small>" + escape_html(missing_words(step, cell.progress)) + "</small>";
  if (is_open(cell) && cell.due_s != usual)
    out +=
        "<br/><small class=\"dim\">" + (cell.due_s ? "due " + day_html(due_day(*cell.due_s)) : "no date") + "</small>";
  return out + "</td>";
}

/// By step the deadline that most people have.
std::vector<Due> usual_dues(const ProgrammeGrid& grid) {
  std::vector<Due> out;
  for (std::size_t at = 0; at < grid.programme.steps.size(); ++at) {
    std::map<Due, int> often;
    for (const ProgrammeLine& line : grid.lines) ++often[line.cells[at].due_s];
    const auto most =
        std::max_element(often.begin(), often.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    out.push_back(most == often.end() ? Due() : most->first);
  }
  return out;
}

bool has_state(const ProgrammeLine& line, std::optional<StepState> state) {
  return !state || std::any_of(line.cells.begin(), line.cells.end(),
                               [&](const ProgrammeCell& cell) { return cell.state == *state; });
}

std::vector<const ProgrammeLine*> shown_lines(const GridView& view) {
  const std::optional<StepState> state = step_state_keyed(view.asked.state);
  std::vector<const ProgrammeLine*> out;
  for (const ProgrammeLine& line : view.grid.lines)
    if (has_state(line, state)) out.push_back(&line);
  return out;
}

std::string grid_row(const GridView& view, const ProgrammeLine& line, const std::vector<Due>& usual) {
  std::string out = "<tr><th scope=\"row\">" +
                    verbatim_link("/trainee/" + url_part(line.code), line.name.empty() ? line.code : line.name) +
                    (line.name.empty() ? "" : " <small class=\"dim\">" + verbatim(line.code) + "</small>") +
                    (line.active ? "" : " <span class=\"tag\">deactivated</span>") + "</th>";
  for (std::size_t at = 0; at < line.cells.size(); ++at)
    out += grid_cell(line, view.grid.programme.steps[at], line.cells[at], usual[at]);
  return out + "</tr>";
}

/// How many of those shown stand where, step by step.
std::string counts_row(const GridView& view, const std::vector<const ProgrammeLine*>& lines) {
  std::string out = "<tr class=\"counts\"><th scope=\"row\">" +
                    plural(static_cast<std::int64_t>(lines.size()), "person", "people") + "</th>";
  for (std::size_t at = 0; at < view.grid.programme.steps.size(); ++at) {
    out += "<td>";
    for (const StepState state : kStepStates) {
      const auto n = std::count_if(lines.begin(), lines.end(),
                                   [&](const ProgrammeLine* line) { return line->cells[at].state == state; });
      if (n > 0)
        out += "<span class=\"count\">" + shape(state_shape(state)) + std::to_string(n) + " " +
               step_state_words(state) + "</span>";
    }
    out += "</td>";
  }
  return out + "</tr>";
}

std::string grid_head(const GridView& view, const std::vector<Due>& usual) {
  std::string out = "<th scope=\"col\">Trainee</th>";
  for (std::size_t at = 0; at < usual.size(); ++at) {
    const ProgrammeStep& step = view.grid.programme.steps[at];
    out += "<th scope=\"col\">" + std::to_string(at + 1) + ". " + escape_html(step_title(view.titles, step)) +
           "<br/><small>" + escape_html(rule_words(step)) +
           (usual[at] ? "<br/>due " + day_html(due_day(*usual[at])) : "") + "</small></th>";
  }
  return out;
}

std::string grid_parts(const GridQuestion& asked, int page, int pages) {
  return part_links("Parts of the grid", page, pages, [&asked](int n) {
    auto items = asked_items(asked);
    items.emplace_back("page", std::to_string(n));
    return "/grid" + query_html(items);
  });
}

std::string grid_table(const GridView& view) {
  if (view.grid.lines.empty())
    return "<p>Nobody" + std::string(view.asked.group.empty() ? "" : " of this group") + " has this programme. " +
           link_html("/programmes#assignments", "Assign it") + " to a group or a person.</p>";
  const auto lines = shown_lines(view);
  if (lines.empty()) return "<p>Nobody has a step in that state. Choose less above.</p>";
  const int count = static_cast<int>(lines.size()), pages = (count + kPeopleInGrid - 1) / kPeopleInGrid,
            page = std::clamp(view.asked.page, 1, pages);
  const std::vector<Due> usual = usual_dues(view.grid);
  std::string rows = counts_row(view, lines);
  for (int i = (page - 1) * kPeopleInGrid; i < std::min(count, page * kPeopleInGrid); ++i)
    rows += grid_row(view, *lines[static_cast<std::size_t>(i)], usual);
  return table("Where everybody stands; the first line counts " + plural(count, "person", "people") + " by step",
               grid_head(view, usual), rows, "step-grid") +
         grid_parts(view.asked, page, pages);
}

constexpr std::size_t kRemindersShown = 500;

std::string days_words(int days) {
  if (days < 0) return plural(-days, "day late", "days late");
  return days == 0 ? "today" : "in " + plural(days, "day", "days");
}

std::string joined_groups(const std::vector<std::string>& groups) {
  std::string out;
  for (const std::string& group : groups) out += (out.empty() ? "" : ", ") + group;
  return out;
}

}  // namespace

std::string grid_page(const GridView& view, Frame frame) {
  frame.title = "Grid";
  if (!view.problem.empty())
    return document(
        frame, "<div class=\"title\"><h1>Grid</h1></div>" +
                   section("grid", "People and steps",
                           "<p>" + escape_html(view.problem) + " " + link_html("/programmes", "Make one") + ".</p>"));
  const std::string files = query_html(asked_items(view.asked));
  return document(
      frame,
      "<div class=\"title\"><h1>" + verbatim(view.asked.programme) +
          "</h1><p class=\"dim\">people and steps</p><p class=\"files\">" + link_html("/grid.csv" + files, "CSV") +
          link_html("/programme" + query_html({{"name", view.asked.programme}}), "Steps") +
          link_html("/reminders" + query_html({{"programme", view.asked.programme}, {"group", view.asked.group}}),
                    "Overdue and due") +
          "</p></div>" + section("grid", "People and steps", grid_filters(view) + grid_table(view)));
}

std::string reminders_page(const RemindersView& view, Frame frame) {
  frame.title = "Overdue and due";
  std::string rows;
  const std::size_t shown = std::min(view.lines.size(), kRemindersShown);
  for (std::size_t at = 0; at < shown; ++at) {
    const Reminder& one = view.lines[at];
    rows += std::string("<tr") + (one.state == StepState::kOverdue ? " class=\"grave\"" : "") + "><th scope=\"row\">" +
            verbatim_link("/trainee/" + url_part(one.code), one.name.empty() ? one.code : one.name) +
            (one.name.empty() ? "" : " <small class=\"dim\">" + verbatim(one.code) + "</small>") + "</th>" +
            verbatim_cell(joined_groups(one.groups)) + "<td>" +
            verbatim_link("/grid" + query_html({{"programme", one.programme}}), one.programme) + "</td>" +
            cell(step_title(view.titles, one.step)) + "<td>" + day_html(one.due) + "</td>" +
            cell(days_words(one.days)) + "<td>" + state_badge(one.state) + "</td>" + cell(one.missing) + "</tr>";
  }

  const std::string days = std::to_string(view.days);
  return document(
      frame,
      "<div class=\"title\"><h1>Overdue and due</h1><p class=\"dim\">" +
          plural(static_cast<std::int64_t>(view.lines.size()), "step", "steps") + "</p><p class=\"files\">" +
          link_html(
              "/reminders.csv" + query_html({{"programme", view.programme}, {"group", view.group}, {"days", days}}),
              "CSV") +
          link_html("/programmes", "Programmes") + "</p></div>" +
          section(
              "reminders", "Who is late, and who soon would be",
              "<form class=\"filters\" method=\"get\" action=\"/reminders\">" +
                  select_field("f-programme", "programme", "Programme", all_or_one("all programmes", view.programmes),
                               view.programme, true) +
                  select_field("f-group", "group", "Group", all_or_one("all groups", view.groups), view.group, true) +
                  text_field("f-days", "days", "Overdue, or due within days", days,
                             "type=\"number\" min=\"0\" max=\"3660\" required=\"required\"") +
                  "<p class=\"field\"><button>Show</button></p></form>" +
                  (rows.empty() ? "<p>Nothing is overdue, and nothing falls due within " +
                                      plural(view.days, "day", "days") + ".</p>"
                                : table("Steps with a deadline that are not passed, the latest first; days end in UTC" +
                                            (shown < view.lines.size() ? "; the first " + std::to_string(shown) +
                                                                             ", all of them in the CSV file"
                                                                       : std::string()),
                                        head_cells({"Trainee", "Groups", "Programme", "Step", "Due", "When", "State",
                                                    "Missing"}),
                                        rows, "reminders"))));
}

}  // namespace trocar::review
