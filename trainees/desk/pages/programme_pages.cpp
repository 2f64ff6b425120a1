#include <algorithm>

#include "trainees/desk/queries/programme_views.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string programme_href(const std::string& name) { return "/programme" + query_html({{"name", name}}); }

std::string programme_list(const ProgrammesView& view) {
  std::string rows;
  for (const KeptProgramme& one : view.programmes) {
    const auto held = std::count_if(view.assignments.begin(), view.assignments.end(), [&](const Assignment& a) {
      return a.programme == one.text.name && a.withdrawn_utc.empty();
    });
    rows += "<tr><th scope=\"row\">" + verbatim_link(programme_href(one.text.name), one.text.name) + "</th>" +
            (one.problem.empty() ? number_cell(std::to_string(one.programme.steps.size()))
                                 : "<td>" + shape("fail") + "cannot be read</td>") +
            number_cell(std::to_string(one.text.version)) + "<td>" + day_html(one.text.utc) + "</td>" +
            number_cell(std::to_string(held)) + "<td>" +
            link_html("/grid" + query_html({{"programme", one.text.name}}), "Grid") + "</td></tr>";
  }
  return rows.empty()
             ? "<p>None yet. A programme is a sequence of steps: an exercise at a level, and what passes it.</p>"
             : stacked_table("Programmes; the newest version holds",
                             {"Programme", ">Steps", ">Version", "Saved", ">Assignments", ""}, rows);
}

std::string new_programme(const Frame& frame) {
  return "<form method=\"get\" action=\"/programme\"><div class=\"fields\">" +
         text_field("p-name", "name", "A new programme called", kept(frame, "programme", "name"),
                    "maxlength=\"64\" required=\"required\" autocomplete=\"off\"") +
         "<p class=\"field\"><button>Make its steps</button></p></div></form>";
}

std::string assign_form(const ProgrammesView& view, const Frame& frame) {
  if (view.programmes.empty()) return "";
  const std::string form = "assign";
  std::vector<Choice> programmes, groups = {{"", "nobody: to one person"}};
  for (const KeptProgramme& one : view.programmes) programmes.emplace_back(one.text.name, one.text.name);
  for (const std::string& group : view.groups) groups.emplace_back(group, group);
  return form_begin("/programmes/assign", frame) + "<div class=\"fields\">" +
         select_field("g-programme", "programme", "Programme", programmes, kept(frame, form, "programme"), true) +
         select_field("g-group", "group", "To the group", groups,
                      kept(frame, form, "group", view.groups.empty() ? "" : view.groups.front()), true) +
         text_field("g-trainee", "trainee", "or to one person (code)", kept(frame, form, "trainee"),
                    "maxlength=\"32\" autocomplete=\"off\" autocapitalize=\"none\"") +
         text_field("g-due", "due", "to be done by (may stay empty)", kept(frame, form, "due"),
                    "type=\"date\"" + refused_field(frame, form)) +
         "</div>" + why_refused(frame, form) +
         "<p><button>Assign</button></p></form><p class=\"dim\">A group's assignment holds for whoever is in the "
         "group, "
         "also who joins later. Assigning again with another day replaces it. One to a person goes before those to "
         "groups.</p>";
}

std::string whom(const Assignment& one) {
  return one.group.empty() ? verbatim_link("/trainee/" + url_part(one.trainee), one.trainee)
                           : "group " + verbatim_link("/roster" + query_html({{"group", one.group}}), one.group);
}

std::string withdraw_form(const Assignment& one, const Frame& frame) {
  const std::string form = "withdraw-" + one.uuid;
  return std::string("<details") + (frame.refused.form == form ? " open=\"open\"" : "") +
         "><summary>Withdraw<span class=\"unseen\"> " + verbatim(one.programme) + " from " +
         verbatim(one.group + one.trainee) + "</span></summary>" + form_begin("/programmes/withdraw", frame) +
         "<input type=\"hidden\" name=\"assignment\" value=\"" + escape_html(one.uuid) + "\"/>" +
         text_field("w-" + one.uuid, "reason", "Reason (may stay empty)", kept(frame, form, "reason"),
                    "maxlength=\"200\"" + refused_field(frame, form)) +
         why_refused(frame, form) + "<p><button class=\"danger\">Withdraw</button></p></form></details>";
}

std::string assigned(const ProgrammesView& view, const Frame& frame) {
  std::string held, gone;
  const auto by = [&](const std::string& name) {
    return printed_html(name, frame.demo ? std::optional<std::string>("") : std::nullopt);
  };
  for (const Assignment& one : view.assignments) {
    const std::string begin =
        "<tr><th scope=\"row\">" +
        verbatim_link("/grid" + query_html({{"programme", one.programme}, {"group", one.group}}), one.programme) +
        "</th><td>" + whom(one) + "</td><td>" +
        (one.due.empty() ? "<span class=\"dim\">no date</span>" : day_html(one.due)) + "</td><td>" + by(one.printed) +
        ", " + day_html(one.utc) + "</td>";
    if (one.withdrawn_utc.empty())
      held += begin + "<td>" + withdraw_form(one, frame) + "</td></tr>";
    else
      gone += begin + "<td>" + by(one.withdrawn_by) + ", " + day_html(one.withdrawn_utc) +
              (one.withdrawn_reason.empty() ? "" : ": " + verbatim(one.withdrawn_reason)) + "</td></tr>";
  }
  const auto listed = [](const char* caption, const char* last, const std::string& rows) {
    return stacked_table(caption, {"Programme", "To", "Due", "Given", last}, rows);
  };
  return (held.empty() ? "<p>Nothing is assigned.</p>" : listed("Assignments that hold, newest first", "", held)) +
         (gone.empty() ? ""
                       : "<details><summary>Withdrawn ones</summary>" +
                             listed("Assignments that were withdrawn", "Withdrawn", gone) + "</details>");
}

std::string number_field(const std::string& id, const std::string& name, const std::string& label,
                         const std::string& value, int most, bool required) {
  return text_field(id, name, label, value,
                    "type=\"number\" min=\"1\" max=\"" + std::to_string(most) + "\" step=\"1\"" +
                        (required ? " required=\"required\"" : ""));
}

std::string tick_field(const std::string& id, const std::string& name, const std::string& label, bool on) {
  return "<p class=\"field tick\"><input type=\"checkbox\" id=\"" + id + "\" name=\"" + name + "\" value=\"yes\"" +
         (on ? " checked=\"checked\"" : "") + "/> <label for=\"" + id + "\">" + escape_html(label) + "</label></p>";
}

std::string step_button(const std::string& what, int number, const char* words, bool possible = true) {
  return "<button class=\"small\" name=\"do\" value=\"" + what + "." + std::to_string(number) +
         "\" formnovalidate=\"formnovalidate\"" + (possible ? "" : " disabled=\"disabled\"") + ">" + words +
         "<span class=\"unseen\"> step " + std::to_string(number) + "</span></button> ";
}

std::string step_fields(const ProgrammeView& view, std::size_t at) {
  const StepDraft& step = view.steps[at];
  const int number = static_cast<int>(at) + 1;
  const std::string id = "s" + std::to_string(number), name = id + ".";
  std::vector<Choice> inputs = {{"", "any input"}};
  for (const std::string& input : view.inputs) inputs.emplace_back(input, input);
  return "<fieldset class=\"step\"><legend>Step " + std::to_string(number) + "</legend><div class=\"fields\">" +
         select_field(id + "-step", name + "step", "Exercise and level", view.exercises, step.step) +
         number_field(id + "-passes", name + "passes", "Passes", step.passes, 100, true) +
         tick_field(id + "-row", name + "row", "in a row, on different boards", step.in_a_row) +
         number_field(id + "-days", name + "days", "on so many days", step.days, 100, true) +
         select_field(id + "-input", name + "input", "with", inputs, step.input) +
         number_field(id + "-due", name + "due", "due after days", step.due_days, 3660, false) +
         tick_field(id + "-sign", name + "sign", "and certified by an instructor", step.sign_off) +
         "<p class=\"field moves\">" + step_button("up", number, "Up", at > 0) +
         step_button("down", number, "Down", at + 1 < view.steps.size()) + step_button("remove", number, "Remove") +
         "</p></div></fieldset>";
}

/// Which programme, and the version that whoever changes it has seen.
std::string named_version(const ProgrammeView& view) {
  return "<input type=\"hidden\" name=\"name\" value=\"" + escape_html(view.name) +
         "\"/><input type=\"hidden\" name=\"version\" value=\"" + std::to_string(view.seen) + "\"/>";
}

std::string steps_form(const ProgrammeView& view, const Frame& frame) {
  if (view.exercises.empty())
    return "<p>No exercise is known here: neither does this desk know those of the program, nor was one tried.</p>";
  // The first button is the one that Enter presses: saving, and not what stands at a step.
  const std::string save = "<button name=\"do\" value=\"save\">Save</button>";
  std::string out = form_begin("/programme", frame) + named_version(view) + "<p class=\"buttons\">" + save + "</p>";
  for (std::size_t at = 0; at < view.steps.size(); ++at) out += step_fields(view, at);
  if (!view.problem.empty())
    out += "<p class=\"error\" role=\"alert\">" + shape("fail") + "Not done. " + escape_html(sentence(view.problem)) +
           "</p>";
  return out +
         "<p class=\"buttons\"><button name=\"do\" value=\"add\" formnovalidate=\"formnovalidate\" "
         "class=\"quiet-button\">Add a step</button> " +
         save +
         "</p></form><p class=\"dim\">A pass counts as it counts everywhere: the score reaches the pass mark, or a "
         "person "
         "decided so. What was passed before the programme was given counts too. Nothing is kept before you "
         "save.</p>";
}

std::string text_form(const ProgrammeView& view, const Frame& frame) {
  const std::string form = "text";
  const bool open = frame.refused.form == form || !view.unreadable.empty();
  return std::string("<details") + (open ? " open=\"open\"" : "") + "><summary>As text (TOML)</summary>" +
         (view.unreadable.empty()
              ? ""
              : "<p class=\"error\">" + shape("fail") + escape_html(sentence(view.unreadable)) + "</p>") +
         form_begin("/programme", frame) + named_version(view) +
         area_field("t-toml", "toml", "The same programme as text", kept(frame, form, "toml", view.text), 14,
                    "class=\"code\" spellcheck=\"false\"" + refused_field(frame, form)) +
         why_refused(frame, form) +
         "<p><button name=\"do\" value=\"text\">Save the text</button></p></form><p class=\"dim\">The form above "
         "writes "
         "this text anew when it is saved: comments in it go.</p></details>";
}

}  // namespace

std::string programmes_page(const ProgrammesView& view, Frame frame) {
  frame.title = "Programmes";
  return document(frame, "<div class=\"title\"><h1>Programmes</h1><p class=\"files\">" + link_html("/grid", "Grid") +
                             link_html("/reminders", "Overdue and due") + "</p></div>" +
                             section("programmes", "Programmes", programme_list(view) + new_programme(frame)) +
                             section("assignments", "Assignments", assign_form(view, frame) + assigned(view, frame)));
}

std::string programme_page(const ProgrammeView& view, Frame frame) {
  frame.title = view.name;
  frame.title_verbatim = true;
  return document(frame,
                  "<div class=\"title\"><h1>" + verbatim(view.name) + "</h1><p class=\"dim\">" +
                      (view.version == 0 ? std::string("a new programme, not saved yet")
                                         : "version " + std::to_string(view.version)) +
                      "</p><p class=\"files\">" + link_html("/programmes", "Programmes") +
                      (view.version == 0 ? "" : link_html("/grid" + query_html({{"programme", view.name}}), "Grid")) +
                      "</p></div>" + section("steps", "Steps", steps_form(view, frame) + text_form(view, frame)));
}

}  // namespace trocar::review
