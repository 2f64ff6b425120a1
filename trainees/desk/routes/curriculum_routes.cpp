#include "haptics/input_error.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/desk/server/path_redaction.h"
#include "trainees/progress/programme.h"

namespace trocar::review {
namespace {

Response curriculum_answer(const CurriculumView& view, const Request& request, Desk& desk, int status = 200) {
  Response out;
  out.status = status;
  out.body = curriculum_page(view, frame_of(request, desk));
  return out;
}

Response show(const Request& request, Desk& desk) {
  return curriculum_answer(curriculum_view(desk, request), request, desk);
}

/// What another desk has saved since the form was made is not lost; the same text again is no loss.
void refuse_unseen(const CurriculumView& view, const std::optional<Curriculum>& last) {
  if (!last || last->toml == view.text || (view.seen_name == view.name && view.seen == last->uuid)) return;
  throw InputError("rules \"" + view.name + "\": no. " + std::to_string(last->version) +
                   " is kept here, and your text was not made from it; open it, and repeat what you changed");
}

/// Previews or saves; a text that cannot be read comes back with what is wrong and where.
Response rules(const Request& request, Desk& desk) {
  CurriculumView view = curriculum_view(desk, request);
  view.name = argument(request.form, "name");
  view.text = argument(request.form, "toml");
  view.seen_name = argument(request.form, "seen_name");
  view.seen = argument(request.form, "seen");
  try {
    const ProgressRules read = read_progress_rules(view.text, view.name);
    if (argument(request.form, "do") == "save") {
      CurriculumStore(desk.database)
          .add(view.name, view.text, author_of(request), [&](const std::optional<Curriculum>& last) {
            if (last && is_programme(last->toml))
              throw InputError("\"" + view.name + "\": is the name of a programme; give the rules another");
            refuse_taken_version(desk, view.text, read);
            refuse_unseen(view, last);
          });
      return see("/curriculum?name=" + url_part(view.name) + "#editor");
    }
    view.preview = preview_rules(desk, read, request.now_utc);
  } catch (const InputError& error) {
    view.problem = without_folders(error.what(), desk.database.file());
    return curriculum_answer(view, request, desk, 400);
  }
  return curriculum_answer(view, request, desk);
}

Response benchmark(const Request& request, Desk& desk) {
  const auto& form = request.form;
  const BenchmarkQuestion question = {argument(form, "exercise"), argument(form, "level"), argument(form, "metric"),
                                      argument(form, "who"),      argument(form, "rule"),  argument(form, "fixed"),
                                      argument(form, "zero_at")};
  BenchmarkProposal proposal = propose(desk, question, request.now_utc);
  if (argument(form, "do") == "save" && proposal.value) {
    Benchmark numbers;
    numbers.exercise_id = question.exercise_id;
    numbers.level = question.level;
    numbers.metric = question.metric;
    numbers.source = proposal.source +
                     (proposal.set_by_person
                          ? " (rules "
                          : " (reliability of their means " + reliability_text(proposal.reliability) + ", rules ") +
                     proposal.rules_version + ")";
    numbers.rule = question.rule == "mean-2sd"        ? "mean - 2 SD"
                   : question.rule == "best-quartile" ? "best quartile"
                   : question.rule == "fixed"         ? "fixed number"
                                                      : question.rule;
    numbers.full_at = *proposal.value;
    numbers.zero_at = std::strtod(question.zero_at.c_str(), nullptr);
    numbers.n = proposal.n;
    try {
      CurriculumStore(desk.database).add_benchmark(numbers, author_of(request));
      return see("/curriculum#benchmarks");
    } catch (const InputError& error) {
      proposal.problem = sentence(error.what());
    }
  }
  CurriculumView view = curriculum_view(desk, request);
  view.proposal = proposal;
  return curriculum_answer(view, request, desk, proposal.problem.empty() ? 200 : 400);
}

Response group(const Request& request, Desk& desk) {
  CurriculumStore store(desk.database);
  const std::string trainee = argument(request.form, "trainee"), name = argument(request.form, "group"),
                    what = argument(request.form, "do");
  try {
    if (what == "join")
      store.join(trainee, name, author_of(request));
    else if (what == "leave")
      store.leave(trainee, name, author_of(request));
    else
      throw InputError("group: join or leave");
  } catch (const InputError& error) {
    Frame frame = frame_of(request, desk);
    frame.refused = {"group", error.what(), request.form};
    return {.status = 400, .body = curriculum_page(curriculum_view(desk, request), frame)};
  }
  return see("/curriculum#groups");
}

using Action = Response (*)(const Request&, Desk&);

Route curriculum_route(const std::string& method, const std::string& path, Action action) {
  return {method, path, Audience::kInstructors,
          [action, status = method == "GET" ? 404 : 400](const Request& request, Desk& desk) {
            return answered(request, desk, status, [&] { return action(request, desk); });
          }};
}

/// A form's address asked for as a page.
Route curriculum_form(const std::string& path) {
  return {"GET", path, Audience::kInstructors, [](const Request&, Desk&) { return see("/curriculum"); }};
}

}  // namespace

std::vector<Route> curriculum_routes() {
  return {curriculum_route("GET", "/curriculum", show),
          curriculum_route("POST", "/curriculum", rules),
          curriculum_route("POST", "/curriculum/benchmark", benchmark),
          curriculum_route("POST", "/curriculum/group", group),
          curriculum_form("/curriculum/benchmark"),
          curriculum_form("/curriculum/group")};
}

}  // namespace trocar::review
