#include "trainees/desk/queries/desk_views.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "haptics/input_error.h"
#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/desk/queries/level_reader.h"
#include "trainees/desk/queries/programme_query.h"
#include "trainees/desk/server/desk_memory.h"
#include "trainees/integrity/station_key.h"
#include "trainees/markup/html.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/signing.h"
#include "trainees/records/standings.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

CurvePoint point_of(const AttemptSummary& s) {
  return {s.uuid, s.started_utc, s.status, s.score, s.passed, s.row, s.decided_by, s.passed_by_score, s.soft_real_time};
}

/// What an exercise is called; its identifier where nobody says.
std::string title_in(const std::map<std::string, std::string>& titles, const std::string& exercise) {
  const auto at = titles.find(exercise);
  return at == titles.end() || at->second.empty() ? exercise : at->second;
}

CurveView curve_view(const CurveDetail& detail, const std::map<std::string, std::string>& titles, LevelReader& levels,
                     const ProgressRules& rules) {
  CurveView out;
  const LearningCurve& curve = detail.curve;
  out.key = curve.key;
  out.title = title_in(titles, curve.key.exercise_id);
  for (const PastAttempt& attempt : curve.attempts) {
    const AttemptSummary& s = attempt.summary;
    out.points.push_back(point_of(s));
  }
  out.pass_at = levels.of(curve.key.rubric_sha256, curve.key.level).pass_at;
  out.best = curve.best;
  out.last = curve.last;
  out.graded = curve.graded;
  out.passed = curve.passed;
  out.in_a_row = curve.in_a_row;
  out.trained_s = curve.trained_s;
  for (const Benchmark& benchmark : detail.benchmarks)
    if (!out.benchmark && benchmark.metric == "score") out.benchmark = benchmark;
  for (const CohortPoint& point : detail.cohort) out.cohort.push_back({point.attempt, point.people, point.scores});
  out.cusum = detail.cusum;
  out.rule = rules.cusum;
  out.judgements = detail.judgements;
  out.reliability = detail.reliability;
  return out;
}

std::string days_words(int days) { return std::to_string(days) + " days after the certificate"; }

void add_due(TraineeView& view, const CurveDetail& detail, const std::string& title) {
  for (const RetentionDate& date : detail.retention) {
    const bool open = date.state == RetentionDate::State::kDue || date.state == RetentionDate::State::kMissed;
    view.due.push_back({title, detail.curve.key.level, date.due_utc,
                        days_words(date.days) + ": " + retention_state_name(date.state), open});
  }
}

/// People who are registered and have no attempt of what is asked for, after all others.
void add_not_started(CohortView& view, Desk& desk, const std::map<std::string, std::string>& titles,
                     bool with_deactivated) {
  const std::set<std::int64_t> gone =
      with_deactivated ? std::set<std::int64_t>{} : deactivated(desk.database.connection());
  std::set<std::string> started;
  for (const CohortEntry& line : view.lines) started.insert(line.code);
  const std::set<std::int64_t> erased = desk::training_erased(desk.database.connection());
  for (const auto& [id, person] : desk::people(desk.database.connection())) {
    const bool wanted = view.asked.group.empty() ||
                        std::find(person.groups.begin(), person.groups.end(), view.asked.group) != person.groups.end();
    if (!wanted || erased.contains(id) || gone.contains(id) || started.contains(person.code) ||
        person.code.starts_with("erased-"))
      continue;
    CohortEntry entry;
    entry.code = person.code;
    entry.name = person.name;
    entry.exercise_id = view.asked.exercise_id;
    entry.exercise = title_in(titles, view.asked.exercise_id);
    entry.level = view.asked.level;
    const bool narrowed = !entry.exercise_id.empty() || !entry.level.empty();
    entry.judgements.push_back({Flag::kNotStarted,
                                "registered " + person.created_utc.substr(0, 10) +
                                    (narrowed ? "; no attempt of what is asked for" : "; no attempt yet"),
                                0, view.rules_version});
    view.lines.push_back(std::move(entry));
  }
}

/// The largest contact force where none is asked for, or what there is.
std::string measure_of(const std::vector<std::string>& choices, const std::string& asked) {
  for (const std::string& name : {asked, std::string("force_max_n"), std::string("time_s")})
    if (std::find(choices.begin(), choices.end(), name) != choices.end()) return name;
  return choices.empty() ? "" : choices.front();
}

MetricCurve cohort_metric(Desk& desk, const CurveKey& key, const std::string& name) {
  MetricCurve out;
  out.name = name;
  if (desk.sources.metric_words) out.words = desk.sources.metric_words(name);
  MetricCohort cohort = metric_cohort(desk.database, key, name);
  out.unit = std::move(cohort.unit);
  for (const CohortPoint& point : cohort.points) out.cohort.push_back({point.attempt, point.people, point.scores});
  return out;
}

MetricCurve own_metric(Desk& desk, const LearningCurve& curve, const std::string& asked) {
  std::set<std::string> names;
  for (const PastAttempt& attempt : curve.attempts)
    for (const auto& [name, value] : attempt.metrics) names.insert(name);
  const std::vector<std::string> choices(names.begin(), names.end());
  if (choices.empty()) return {};
  MetricCurve out = cohort_metric(desk, curve.key, measure_of(choices, asked));
  out.choices = choices;
  for (const PastAttempt& attempt : curve.attempts) {
    const auto at = attempt.metrics.find(out.name);
    out.values.push_back(at == attempt.metrics.end() ? std::nullopt : std::optional(at->second));
  }
  return out;
}

std::vector<LossLine> loss_lines(Desk& desk, const std::vector<NewestAttempts>& of,
                                 const std::map<std::string, std::string>& titles) {
  std::vector<LossLine> out;
  for (Losses& losses : losses_of(desk.database, of)) {
    const std::string words = title_in(titles, losses.key.exercise_id);
    out.push_back({words, std::move(losses), {}});
  }
  return out;
}

/// How bad it is, as the cohort's page says it.
void tell_harm(TraineeView& view, Desk& desk, const ProgressRules& rules, const std::string& now_utc) {
  const auto is_unsafe = [](const CurveView& curve) {
    return !curve.judgements.empty() && curve.judgements.front().flag == Flag::kUnsafe;
  };
  if (std::none_of(view.curves.begin(), view.curves.end(), is_unsafe)) return;
  CohortFilter own;
  own.trainee = view.code;
  for (const CohortLine& line : lines_of(desk, rules, own, now_utc))
    for (CurveView& curve : view.curves)
      if (line.harm && line.key == curve.key) curve.judgements.front().evidence = line.judgements.front().evidence;
}

/// The first that the query fits. What is not there is said: a page about something else would mislead.
std::size_t chosen_curve(const std::vector<CurveView>& curves, const Request& request) {
  const std::string exercise = argument(request.query, "exercise"), level = argument(request.query, "level"),
                    hand = argument(request.query, "hand"), rubric = argument(request.query, "rubric");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const CurveKey& key = curves[i].key;
    if ((exercise.empty() || key.exercise_id == exercise) && (level.empty() || key.level == level) &&
        (hand.empty() || key.hand == hand) && (rubric.empty() || key.rubric_sha256.starts_with(rubric)))
      return i;
  }
  std::string asked;
  for (const std::string& part : {exercise, level, hand, rubric})
    asked += part.empty() ? "" : (asked.empty() ? "" : ", ") + part;
  if (!asked.empty())
    throw InputError("there is no attempt of " + argument(request.arguments, "code") + " that counts of " + asked);
  return 0;
}

}  // namespace

std::string argument(const std::map<std::string, std::string>& values, const std::string& name,
                     const std::string& otherwise) {
  const auto it = values.find(name);
  return it == values.end() ? otherwise : it->second;
}

int whole_number(const std::string& text, int otherwise) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  return end == text.c_str() || *end != '\0' || value < 1 || value > 1000000 ? otherwise : static_cast<int>(value);
}

std::vector<CohortLine> lines_of(Desk& desk, const ProgressRules& rules, const CohortFilter& filter,
                                 const std::string& now_utc) {
  std::vector<CohortLine> lines;
  // One person at one exercise is a third of the work of everybody: an attempt's page does not wait for the cohort.
  const bool few = !filter.trainee.empty() && !filter.exercise.empty();
  const bool kept = desk.memory && !filter.deactivated && (!few || desk.memory->fresh(desk.database, now_utc));
  if (kept) lines = filtered(desk.memory->lines(desk.database, now_utc), filter);
  // What is kept leaves out who is deactivated.
  if (!kept || (lines.empty() && !filter.trainee.empty())) lines = cohort_lines(desk.database, rules, filter, now_utc);
  LevelReader levels(desk);
  for (CohortLine& line : lines) {
    if (!line.harm) continue;
    line.harm->limit_n = levels.of(line.key.rubric_sha256, line.key.level).limits.hard_n;
    line.judgements.front().evidence = harm_sentence(*line.harm);
  }
  return lines;
}

bool is_staff(const Request& request) { return request.account && request.account->role != Role::kTrainee; }

Frame frame_of(const Request& request, const Desk& desk) {
  Frame frame;
  if (request.account) frame.who = request.account->name.empty() ? request.account->login : request.account->name;
  if (request.account && request.account->role == Role::kTrainee) frame.own_code = request.account->trainee_code;
  frame.token = request.token;
  frame.now_utc = request.now_utc;
  frame.query = request.query;
  frame.demo = desk.demo;
  frame.may_write = is_staff(request);
  frame.pdf = true;
  if (desk.sources.central) frame.central = desk.sources.central();
  frame.signed_in = request.account && !request.account->uuid.empty();
  if (frame.may_write) frame.no_signature = why_no_signature(desk.database, author_of(request).account_uuid);
  if (frame.may_write) frame.lost_key = lost_key(desk.database.connection());
  frame.administrator = request.account && request.account->role == Role::kAdministrator;
  frame.demo_goes = frame.administrator && desk.demo && desk.sources.remove_demo;
  return frame;
}

Author author_of(const Request& request) {
  if (!request.account) return {};
  return {request.account->uuid, request.account->name.empty() ? request.account->login : request.account->name};
}

std::vector<Choice> exercise_choices(Database& database) {
  sql::Statement query(database.connection(), "SELECT id, title FROM exercise ORDER BY number, id");
  std::vector<Choice> out;
  while (query.step()) out.emplace_back(query.text(0), query.text(1).empty() ? query.text(0) : query.text(1));
  return out;
}

std::string exercise_title(Database& database, const std::string& id) {
  sql::Statement query(database.connection(), "SELECT title FROM exercise WHERE id = ?1");
  query.bind(id);
  return query.step() && !query.text(0).empty() ? query.text(0) : id;
}

std::map<std::string, std::string> exercise_titles(Desk& desk) {
  const std::vector<Choice> tried = exercise_choices(desk.database);
  std::map<std::string, std::string> out(tried.begin(), tried.end());
  for (const ExerciseLevels& one : desk.sources.exercises) out[one.id] = one.title;
  return out;
}

std::vector<std::string> distinct_attempt_values(Database& database, const std::string& column) {
  std::set<std::string> values;
  for (const desk::Combination& one : desk::combinations(database.connection()))
    values.insert(column == "hand" ? one.hand : one.level);
  return {values.begin(), values.end()};
}

std::vector<std::pair<std::string, std::string>> tried_levels(Database& database) {
  std::set<std::pair<std::string, std::string>> values;
  for (const desk::Combination& one : desk::combinations(database.connection()))
    values.emplace(one.exercise_id, one.level);
  return {values.begin(), values.end()};
}

CohortView cohort_view(Desk& desk, const Request& request) {
  CohortView view;
  view.asked = {argument(request.query, "group"), argument(request.query, "exercise"),
                argument(request.query, "level"), argument(request.query, "state"),
                argument(request.query, "sort"),  whole_number(argument(request.query, "page"), 1)};
  const ProgressRules rules = rules_in_force(desk.database);
  view.rules_version = rules.version;
  view.rules_unread = rules.unread;
  view.groups = CurriculumStore(desk.database).groups();
  view.exercises = exercise_choices(desk.database);
  view.levels = distinct_attempt_values(desk.database, "level");
  view.any_attempt =
      sql::query_integer(desk.database.connection(), "SELECT EXISTS (SELECT 1 FROM attempt WHERE status <> 'running')");
  view.erased = static_cast<int>(desk::training_erased(desk.database.connection()).size());
  const std::map<std::string, std::string> titles(view.exercises.begin(), view.exercises.end());
  CohortFilter filter;
  filter.group = view.asked.group;
  filter.exercise = view.asked.exercise_id;
  filter.level = view.asked.level;
  filter.deactivated = argument(request.query, "deactivated") == "yes";
  LevelReader levels(desk);
  for (CohortLine& line : lines_of(desk, rules, filter, request.now_utc)) {
    view.lines.push_back({line.trainee,
                          line.name,
                          line.key.exercise_id,
                          title_in(titles, line.key.exercise_id),
                          line.key.level,
                          line.key.hand,
                          line.tries,
                          line.best,
                          line.last,
                          std::move(line.newest_scores),
                          levels.of(line.key.rubric_sha256, line.key.level).pass_at,
                          line.mean_peak_n,
                          line.over_force,
                          std::move(line.judgements),
                          line.last_utc,
                          line.graded,
                          line.passes,
                          line.reliability,
                          line.key.rubric_sha256,
                          std::move(line.harm)});
  }
  add_not_started(view, desk, titles, filter.deactivated);
  return view;
}

constexpr std::size_t kCurvesDrawn = 4;  // of a measure: each is read over all attempts

WhyView why_view(Desk& desk, const Request& request) {
  WhyView view;
  view.asked.group = argument(request.query, "group");
  view.asked.exercise_id = argument(request.query, "exercise");
  view.asked.level = argument(request.query, "level");
  view.groups = CurriculumStore(desk.database).groups();
  view.exercises = exercise_choices(desk.database);
  view.levels = distinct_attempt_values(desk.database, "level");
  const std::map<std::string, std::string> titles(view.exercises.begin(), view.exercises.end());
  CohortFilter filter;
  filter.group = view.asked.group;
  filter.exercise = view.asked.exercise_id;
  filter.level = view.asked.level;
  const std::vector<CohortLine> lines = lines_of(desk, rules_in_force(desk.database), filter, request.now_utc);
  view.lines = loss_lines(desk, newest_attempts(lines), titles);
  if (view.lines.size() > kCurvesDrawn) return view;
  std::set<std::string> names;
  std::set<CurveKey> read;
  for (const CohortLine& line : lines)
    if (!line.newest_rows.empty() && read.insert(line.key).second)
      for (const std::string& name : metrics_of_attempt(desk.database, line.newest_rows.front())) names.insert(name);
  view.metrics.assign(names.begin(), names.end());
  view.metric = measure_of(view.metrics, argument(request.query, "metric"));
  for (LossLine& line : view.lines) line.metric = cohort_metric(desk, line.losses.key, view.metric);
  return view;
}

TraineeView trainee_view(Desk& desk, const Request& request) {
  const ProgressRules rules = rules_in_force(desk.database);
  TraineeDetail picture = trainee_detail(desk.database, argument(request.arguments, "code"), rules, request.now_utc);
  TraineeView view;
  view.code = picture.code;
  view.name = picture.name;
  view.groups = picture.groups;
  const std::map<std::string, std::string> titles = exercise_titles(desk);
  LevelReader levels(desk);
  std::vector<NewestAttempts> newest;
  for (const CurveDetail& curve : picture.curves) {
    view.curves.push_back(curve_view(curve, titles, levels, rules));
    newest.push_back({curve.curve.key, {}});
    const auto& attempts = curve.curve.attempts;
    for (auto at = attempts.rbegin(); at != attempts.rend() && newest.back().rows.size() < kRowsForLosses; ++at)
      newest.back().rows.push_back(at->summary.row);
    add_due(view, curve, view.curves.back().title);
  }
  std::sort(view.due.begin(), view.due.end(), [](const DueDate& a, const DueDate& b) { return a.utc < b.utc; });
  for (const Reminder& step : next_steps(desk.database, view.code, request.now_utc)) {
    view.due.push_back({title_in(titles, step.step.exercise_id), step.step.level, step.due,
                        "programme " + step.programme + ": " + step.missing, step.state == StepState::kOverdue});
  }
  view.chosen = chosen_curve(view.curves, request);
  view.page = whole_number(argument(request.query, "page"), 1);
  if (view.chosen < view.curves.size())
    view.metric = own_metric(desk, picture.curves[view.chosen].curve, argument(request.query, "metric"));
  view.losses = loss_lines(desk, newest, titles);
  tell_harm(view, desk, rules, request.now_utc);
  for (const PastAttempt& attempt : picture.ended_by_device) {
    const AttemptSummary& s = attempt.summary;
    view.ended_by_device.push_back({{s.exercise_id, s.level, s.hand, s.rubric_sha256}, point_of(s)});
  }
  view.ability = {picture.ability_logit, picture.ability_se, picture.ability_n, picture.ability_missing};
  for (const WeekMinutes& week : picture.weeks) view.minutes_by_week.emplace_back(week.monday, week.minutes);
  view.erased = picture.training_erased;
  view.notes = std::move(picture.notes);
  view.certificates = std::move(picture.certificates);
  view.shaken = shaken_certificates(desk.database, view.certificates);
  view.rules_version = rules.version;
  view.created_utc = picture.created_utc;
  const AttemptStore store(desk.database);
  for (const ListedAttempt& one : attempts_page(view).shown) {
    AttemptView attempt;
    attempt.result = store.load(store.find(one.point->uuid).row);
    attempt.pass_at = view.curves[view.chosen].pass_at;
    view.reasons[one.point->uuid] = verdict_reason(attempt, false);
  }
  return view;
}

}  // namespace trocar::review
