// Programmes: their steps, whom they are assigned to, the grid of people and steps, who is late.
#include <cstdlib>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/programme_views.h"
#include "trainees/desk/routes/page_routes.h"

namespace trocar::review {
namespace {

Response programme_answer(std::string body, int status = 200) { return {.status = status, .body = std::move(body)}; }

Response programmes(const Request& request, Desk& desk) {
  return programme_answer(programmes_page(programmes_view(desk), frame_of(request, desk)));
}

Response programmes_refusal(const Request& request, Desk& desk, const std::string& form, const std::string& why) {
  Frame frame = frame_of(request, desk);
  frame.refused = {form, why, request.form};
  return programme_answer(programmes_page(programmes_view(desk), frame), 400);
}

Response assign(const Request& request, Desk& desk) {
  const auto& form = request.form;
  // A person's code goes before the group that the list stands on.
  const std::string trainee = argument(form, "trainee"), group = trainee.empty() ? argument(form, "group") : "";
  try {
    ProgrammeStore(desk.database)
        .assign(argument(form, "programme"), trainee, group, argument(form, "due"), author_of(request));
  } catch (const InputError& error) {
    return programmes_refusal(request, desk, "assign", error.what());
  }
  return see("/programmes#assignments");
}

Response withdraw(const Request& request, Desk& desk) {
  const std::string uuid = argument(request.form, "assignment");
  try {
    ProgrammeStore(desk.database).withdraw(uuid, argument(request.form, "reason"), author_of(request));
  } catch (const InputError& error) {
    return programmes_refusal(request, desk, "withdraw-" + uuid, error.what());
  }
  return see("/programmes#assignments");
}

Response programme(const Request& request, Desk& desk) {
  ProgrammeView view = programme_view(desk, argument(request.query, "name"));
  if (view.name.empty()) return see("/programmes");
  if (view.steps.empty() && view.unreadable.empty() && !view.exercises.empty())
    view.steps.push_back({view.exercises.front().first});
  return programme_answer(programme_page(view, frame_of(request, desk)));
}

/// @throws InputError: as ProgrammeStore::save(); an exercise that there is not; somebody has saved another version
/// since the form was made.
Response save(Desk& desk, const Request& request, const ProgrammeView& view, const std::string& toml) {
  require_known(read_programme(toml, view.name), view.name, known_levels(desk.database, desk.sources.exercises));
  ProgrammeStore(desk.database).save(view.name, toml, author_of(request), [&](const std::optional<Curriculum>& last) {
    if (last && last->version != view.seen)
      throw InputError("programme \"" + view.name + "\": version " + std::to_string(last->version) +
                       " was saved meanwhile; open it again, and repeat what you changed");
  });
  return see("/programme?name=" + url_part(view.name) + "#steps");
}

/// "up.2": what is to be done with which step. What cannot be done is left.
void rearrange(ProgrammeView& view, const std::string& act) {
  const std::size_t dot = act.find('.');
  const auto at = static_cast<std::size_t>(dot == std::string::npos ? 0 : std::atoi(act.c_str() + dot + 1));
  const std::string what = act.substr(0, dot);
  auto& steps = view.steps;
  if (what == "add" && steps.size() < kMostSteps && !view.exercises.empty())
    steps.push_back({view.exercises.front().first});
  if (at < 1 || at > steps.size()) return;
  if (what == "remove") steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(at) - 1);
  if (what == "up" && at > 1) std::swap(steps[at - 1], steps[at - 2]);
  if (what == "down" && at < steps.size()) std::swap(steps[at - 1], steps[at]);
}

Response change_programme(const Request& request, Desk& desk) {
  const std::string act = argument(request.form, "do");
  ProgrammeView view = drafted(desk, request.form);
  if (act == "text") {
    try {
      return save(desk, request, view, argument(request.form, "toml"));
    } catch (const InputError& error) {
      Frame frame = frame_of(request, desk);
      frame.refused = {"text", error.what(), request.form};
      ProgrammeView kept = programme_view(desk, view.name);
      kept.seen = view.seen;
      return programme_answer(programme_page(kept, frame), 400);
    }
  }
  if (act != "save") {
    rearrange(view, act);
    return programme_answer(programme_page(view, frame_of(request, desk)));
  }
  try {
    return save(desk, request, view, programme_toml(programme_of(view.steps)));
  } catch (const InputError& error) {
    view.problem = error.what();
    return programme_answer(programme_page(view, frame_of(request, desk)), 400);
  }
}

Response grid(const Request& request, Desk& desk) {
  return programme_answer(grid_page(grid_view(desk, request), frame_of(request, desk)));
}

Response grid_file(const Request& request, Desk& desk) {
  return csv_file(grid_csv(grid_view(desk, request)), "grid.csv");
}

Response late(const Request& request, Desk& desk) {
  return programme_answer(reminders_page(reminders_view(desk, request), frame_of(request, desk)));
}

Response late_file(const Request& request, Desk& desk) {
  return csv_file(reminders_csv(reminders_view(desk, request).lines), "reminders.csv");
}

using ProgrammeAction = Response (*)(const Request&, Desk&);

Route programme_route(const std::string& method, const std::string& path, ProgrammeAction action) {
  return {method, path, Audience::kInstructors,
          [action, status = method == "GET" ? 404 : 400](const Request& request, Desk& desk) {
            return answered(request, desk, status, [&] { return action(request, desk); });
          }};
}

/// A form's address asked for as a page.
Route programme_form(const std::string& path) {
  return {"GET", path, Audience::kInstructors, [](const Request&, Desk&) { return see("/programmes"); }};
}

}  // namespace

std::vector<Route> programme_routes() {
  return {programme_route("GET", "/programmes", programmes),
          programme_route("POST", "/programmes/assign", assign),
          programme_route("POST", "/programmes/withdraw", withdraw),
          programme_form("/programmes/assign"),
          programme_form("/programmes/withdraw"),
          programme_route("GET", "/programme", programme),
          programme_route("POST", "/programme", change_programme),
          programme_route("GET", "/grid", grid),
          programme_route("GET", "/grid.csv", grid_file),
          programme_route("GET", "/reminders", late),
          programme_route("GET", "/reminders.csv", late_file)};
}

}  // namespace trocar::review
