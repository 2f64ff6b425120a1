#include <algorithm>
#include <charconv>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/programme_views.h"

namespace trocar::review {
namespace {

std::vector<std::string> names_of(const std::vector<KeptProgramme>& programmes) {
  std::vector<std::string> out;
  for (const KeptProgramme& one : programmes) out.push_back(one.text.name);
  return out;
}

/// Every level of every exercise: of the program, and what the record has besides.
std::vector<Choice> step_choices(Desk& desk) {
  std::vector<Choice> out;
  const auto add = [&](const std::string& id, const std::string& title, const std::string& level) {
    const std::string value = id + "|" + level;
    if (std::none_of(out.begin(), out.end(), [&](const Choice& known) { return known.first == value; }))
      out.emplace_back(value, title + " " + level);
  };
  for (const ExerciseLevels& one : desk.sources.exercises)
    for (const std::string& level : one.levels) add(one.id, one.title, level);
  const StepTitles titles = exercise_titles(desk);
  for (const auto& [id, level] : tried_levels(desk.database)) add(id, titles.at(id), level);
  return out;
}

std::string own_value(const ProgrammeStep& step) { return step.exercise_id + "|" + step.level; }

StepDraft draft_of(const ProgrammeStep& step) {
  return {own_value(step),
          std::to_string(step.passes),
          std::to_string(step.days),
          step.due_days == 0 ? "" : std::to_string(step.due_days),
          step.input,
          step.in_a_row,
          step.sign_off};
}

/// What a step names stays in its choices, though no exercise of the program has it.
void add_own_choices(ProgrammeView& view) {
  for (const StepDraft& step : view.steps) {
    const auto same = [&](const Choice& known) { return known.first == step.step; };
    if (step.step.empty() || std::any_of(view.exercises.begin(), view.exercises.end(), same)) continue;
    std::string words = step.step;
    std::replace(words.begin(), words.end(), '|', ' ');
    view.exercises.emplace_back(step.step, words);
  }
  for (const StepDraft& step : view.steps)
    if (!step.input.empty() && std::find(view.inputs.begin(), view.inputs.end(), step.input) == view.inputs.end())
      view.inputs.push_back(step.input);
}

int number_in(const std::string& text, const std::string& what, int low, int high) {
  int value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size() && value >= low && value <= high) return value;
  throw InputError(what + ": a whole number from " + std::to_string(low) + " to " + std::to_string(high));
}

}  // namespace

std::string step_title(const StepTitles& titles, const ProgrammeStep& step) {
  const auto at = titles.find(step.exercise_id);
  return (at == titles.end() || at->second.empty() ? step.exercise_id : at->second) + " " + step.level;
}

ProgrammesView programmes_view(Desk& desk) {
  const ProgrammeStore store(desk.database);
  return {store.list(), store.assignments(), CurriculumStore(desk.database).groups()};
}

KnownLevels known_levels(Database& database, const std::vector<ExerciseLevels>& shipped) {
  KnownLevels out;
  for (const Choice& tried : exercise_choices(database)) out[tried.first] = {};
  for (const ExerciseLevels& one : shipped) out[one.id] = one.levels;
  return out;
}

ProgrammeView programme_view(Desk& desk, const std::string& name) {
  ProgrammeView view;
  view.name = name;
  view.exercises = step_choices(desk);
  view.inputs = distinct_attempt_values(desk.database, "hand");
  std::erase_if(view.inputs, [](const std::string& input) {
    return std::find(std::begin(kPersonsInputs), std::end(kPersonsInputs), input) == std::end(kPersonsInputs);
  });
  const auto kept = CurriculumStore(desk.database).newest(name);
  if (kept && !is_programme(kept->toml)) throw InputError("\"" + name + "\": is the name of rules of progress");
  if (!kept) return view;
  view.version = view.seen = kept->version;
  view.text = kept->toml;
  try {
    for (const ProgrammeStep& step : read_programme(kept->toml, name).steps) view.steps.push_back(draft_of(step));
  } catch (const InputError& error) {
    view.unreadable = error.what();
  }
  add_own_choices(view);
  return view;
}

ProgrammeView drafted(Desk& desk, const std::map<std::string, std::string>& form) {
  ProgrammeView view = programme_view(desk, argument(form, "name"));
  view.steps.clear();
  view.seen = whole_number(argument(form, "version"), 0);
  for (std::size_t i = 1; i <= kMostSteps; ++i) {
    const std::string at = "s" + std::to_string(i) + ".";
    if (!form.contains(at + "step")) break;
    view.steps.push_back({argument(form, at + "step"), argument(form, at + "passes"), argument(form, at + "days"),
                          argument(form, at + "due"), argument(form, at + "input"), form.contains(at + "row"),
                          form.contains(at + "sign")});
  }
  add_own_choices(view);
  return view;
}

Programme programme_of(const std::vector<StepDraft>& steps) {
  Programme out;
  for (const StepDraft& draft : steps) {
    const std::string which = "step " + std::to_string(out.steps.size() + 1) + ", ";
    const std::size_t bar = draft.step.find('|');
    if (bar == std::string::npos) throw InputError(which + "exercise: choose one");
    ProgrammeStep step;
    step.exercise_id = draft.step.substr(0, bar);
    step.level = draft.step.substr(bar + 1);
    step.passes = number_in(draft.passes, which + "passes", 1, 100);
    step.days = draft.days.empty() ? 1 : number_in(draft.days, which + "days", 1, 100);
    if (step.days > step.passes) throw InputError(which + "days: no more than passes, for a pass is on one day");
    step.due_days = draft.due_days.empty() ? 0 : number_in(draft.due_days, which + "due after days", 1, 3660);
    step.in_a_row = draft.in_a_row;
    step.sign_off = draft.sign_off;
    step.input = draft.input;
    for (std::size_t other = 0; other < out.steps.size(); ++other)
      if (own_value(out.steps[other]) == own_value(step) && out.steps[other].input == step.input)
        throw InputError(which + "exercise: is step " + std::to_string(other + 1) + " already");
    out.steps.push_back(std::move(step));
  }
  if (out.steps.empty()) throw InputError("a programme needs at least one step");
  return out;
}

GridView grid_view(Desk& desk, const Request& request) {
  GridView view;
  const auto programmes = ProgrammeStore(desk.database).list();
  view.programmes = names_of(programmes);
  view.groups = CurriculumStore(desk.database).groups();
  view.asked = {argument(request.query, "programme", view.programmes.empty() ? "" : view.programmes.front()),
                argument(request.query, "group"), argument(request.query, "state"),
                argument(request.query, "deactivated") == "yes", whole_number(argument(request.query, "page"), 1)};
  view.titles = exercise_titles(desk);
  if (view.asked.programme.empty()) {
    view.problem = "There is no programme yet.";
    return view;
  }
  view.grid = programme_grid(desk.database, view.asked.programme, {view.asked.group, "", view.asked.deactivated},
                             request.now_utc);
  return view;
}

RemindersView reminders_view(Desk& desk, const Request& request) {
  RemindersView view;
  view.programme = argument(request.query, "programme");
  view.group = argument(request.query, "group");
  view.days = argument(request.query, "days") == "0" ? 0 : whole_number(argument(request.query, "days"), 14);
  view.programmes = names_of(ProgrammeStore(desk.database).list());
  view.groups = CurriculumStore(desk.database).groups();
  view.titles = exercise_titles(desk);
  view.lines = reminders(desk.database, view.programme, view.group, view.days, request.now_utc);
  return view;
}

}  // namespace trocar::review
