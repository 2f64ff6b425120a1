#include "trainees/review/desk_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

#include "haptics/input_error.h"
#include "trainees/attempt_store.h"
#include "trainees/markup/html.h"
#include "trainees/replica_facts.h"
#include "trainees/review/charts.h"
#include "trainees/review/compare_moment.h"
#include "trainees/review/desk_memory.h"
#include "trainees/review/desk_queries.h"
#include "trainees/review/desk_rows.h"
#include "trainees/review/told_text.h"
#include "trainees/sqlite_handle.h"

namespace trocar::review {
namespace {

std::string facts_key(const std::string& rubric, const std::string& level) { return rubric + "/" + level; }

/// Limits and pass mark by rubric and level, each read once for a page.
class LevelReader {
 public:
  explicit LevelReader(Desk& desk) : desk_(&desk) {}
  LevelFacts of(const std::string& rubric, const std::string& level) {
    const auto [it, added] = known_.try_emplace(facts_key(rubric, level));
    if (added && desk_->sources.level_facts) {
      try {
        it->second = desk_->sources.level_facts(AttemptStore(desk_->database).exercise_text(rubric), level);
      } catch (const InputError&) {
        it->second = {};  // an exercise of another version of the program: drawn without its limits
      }
    }
    return it->second;
  }

 private:
  Desk* desk_;
  std::map<std::string, LevelFacts> known_;
};

int whole_number(const std::string& text, int otherwise) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  return end == text.c_str() || *end != '\0' || value < 1 || value > 1000000 ? otherwise : static_cast<int>(value);
}

CurvePoint point_of(const AttemptSummary& s) {
  return {s.uuid, s.started_utc, s.status, s.score, s.passed, s.row, s.decided_by, s.passed_by_score};
}

CurveView curve_view(const CurvePicture& picture, const std::map<std::string, std::string>& titles, LevelReader& levels,
                     const ProgressRules& rules) {
  CurveView out;
  const LearningCurve& curve = picture.curve;
  out.key = curve.key;
  const auto title = titles.find(curve.key.exercise_id);
  out.title = title == titles.end() || title->second.empty() ? curve.key.exercise_id : title->second;
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
  for (const Benchmark& benchmark : picture.benchmarks)
    if (!out.benchmark && benchmark.metric == "score") out.benchmark = benchmark;
  for (const CohortPoint& point : picture.cohort) out.cohort.push_back({point.attempt, point.people, point.scores});
  out.cusum = picture.cusum;
  out.rule = rules.cusum;
  out.judgements = picture.judgements;
  out.reliability = picture.reliability;
  return out;
}

std::string days_words(int days) { return std::to_string(days) + " days after the certificate"; }

void add_due(TraineeView& view, const CurvePicture& picture, const std::string& title) {
  for (const RetentionDate& date : picture.retention) {
    const bool open = date.state == RetentionDate::State::kDue || date.state == RetentionDate::State::kMissed;
    view.due.push_back(
        {title, picture.curve.key.level, date.due_utc, days_words(date.days) + ": " + retention_state_name(date.state), open});
  }
}

/// The first that the query fits. What is not there is said: a page about something else would mislead.
std::size_t chosen_curve(const std::vector<CurveView>& curves, const Request& request) {
  const std::string exercise = argument(request.query, "exercise"), level = argument(request.query, "level"),
                    hand = argument(request.query, "hand"), rubric = argument(request.query, "rubric");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const CurveKey& key = curves[i].key;
    if ((exercise.empty() || key.exercise_id == exercise) && (level.empty() || key.level == level) && (hand.empty() || key.hand == hand) &&
        (rubric.empty() || key.rubric_sha256.starts_with(rubric)))
      return i;
  }
  std::string asked;
  for (const std::string& part : {exercise, level, hand, rubric}) asked += part.empty() ? "" : (asked.empty() ? "" : ", ") + part;
  if (!asked.empty()) throw InputError(argument(request.arguments, "code") + " has no attempts that count of " + asked);
  return 0;
}

/// Chain position of an attempt, 0 when it has none.
std::int64_t chain_position(Database& database, const std::string& uuid) {
  sql::Statement query(database.connection(), "SELECT coalesce(chain_position, 0) FROM attempt WHERE uuid = ?1");
  query.bind(uuid);
  return query.step() ? query.integer(0) : 0;
}

void add_trace(AttemptView& view, Desk& desk) {
  const std::string station = station_of_attempt(desk.database, view.result.uuid);
  std::error_code none;
  if (view.result.recording_path.empty()) {
    view.no_trace = "This attempt was not recorded.";
  } else if (!station.empty() && !std::filesystem::exists(view.result.recording_path, none)) {
    view.no_trace = "The recording is at station " + station + ": without it there are no traces and no pictures here.";
  } else if (!desk.sources.trace) {
    view.no_trace = "This desk cannot read recordings.";
  } else {
    try {
      view.trace = desk.sources.trace(view.result.recording_path);
    } catch (const std::exception& error) {
      const bool there = std::filesystem::is_regular_file(view.result.recording_path, none);
      view.no_trace = desk::of_erased(desk.database.connection(), view.result.uuid) ? "The recording was erased with the training data."
                      : there ? sentence("The recording cannot be read: " + told_without_folders(error.what(), desk.database.file()))
                              : "The recording is not in its place any more.";
    }
  }
}

void add_film(AttemptView& view, Desk& desk) {
  if (desk.sources.film.state) view.film = desk.sources.film.state(view.result.uuid);
  view.no_film = desk.sources.no_film;
  if (view.no_film.empty() && !desk.sources.film.make) view.no_film = "No film: this desk makes none.";
  if (view.no_film.empty() && view.result.recording_path.empty()) view.no_film = "No film: this attempt was not recorded.";
}

/// Own earlier attempts; an expert's for staff only: a trainee sees nobody else's.
void add_rivals(AttemptView& view, const AttemptPicture& picture, bool staff) {
  const PastAttempt* best = nullptr;
  for (const PastAttempt& attempt : picture.earlier)
    if (attempt.summary.score && (best == nullptr || *attempt.summary.score > *best->summary.score)) best = &attempt;
  if (best != nullptr) view.rivals.push_back({"own best before", best->summary.uuid, best->summary.score});
  if (!picture.earlier.empty())
    view.rivals.push_back({"own attempt before", picture.earlier.front().summary.uuid, picture.earlier.front().summary.score});
  if (staff && !picture.experts.empty()) {
    const AttemptSummary& expert = picture.experts.front();
    if (expert.uuid != picture.result.uuid)
      view.rivals.push_back(
          {expert.board == picture.result.board ? "expert, same board" : "expert, another board", expert.uuid, expert.score});
  }
}

/// The cohort's lines, out of the desk's memory where it has one.
std::vector<CohortLine> lines_of(Desk& desk, const ProgressRules& rules, const CohortFilter& filter, const std::string& now_utc) {
  if (!desk.memory) return cohort_lines(desk.database, rules, filter, now_utc);
  return filtered(desk.memory->lines(desk.database, now_utc), filter);
}

/// Which conditions of a certificate a curve that is not ready does not meet.
std::vector<std::string> missing_on(const CohortLine& line, const ProgressRules& rules) {
  std::vector<std::string> out;
  if (!line.certified_utc.empty()) out.push_back("One is held already, of " + line.certified_utc.substr(0, 10) + ".");
  for (const Judgement& judgement : line.judgements)
    if (judgement.flag != Flag::kReady && judgement.flag != Flag::kRetentionDue)
      out.push_back((judgement.flag == Flag::kLearning ? "Competence has not been shown: "
                                                       : std::string(flag_name(judgement.flag)) + ": ") +
                    judgement.evidence + ".");
  if (line.reliability.value_or(1) < rules.least_reliability)
    out.push_back("The scores are not reliable enough: " + fixed_text(*line.reliability, 2) + ", wanted are " +
                  fixed_text(rules.least_reliability, 2) + ".");
  return out;
}

/// The judgement "ready" of the attempt's curve, for the certificate; else why there is none.
void add_readiness(AttemptView& view, Desk& desk, const ProgressRules& rules, const std::string& now_utc) {
  CohortFilter filter;
  filter.exercise = view.result.exercise_id;
  filter.level = view.result.level;
  filter.trainee = view.result.trainee;
  view.missing = {"This attempt stands on no learning curve: the device ended it, or it was void."};
  for (const CohortLine& line : lines_of(desk, rules, filter, now_utc)) {
    if (line.key.hand != view.result.hand || line.key.rubric_sha256 != view.result.rubric_sha256) continue;
    for (const Judgement& judgement : line.judgements)
      if (judgement.flag == Flag::kReady && line.certified_utc.empty()) view.ready = judgement;
    view.missing = view.ready ? std::vector<std::string>{} : missing_on(line, rules);
  }
}

double moment_of(const AttemptView& view, const std::string& text) {
  double worst = -1;
  for (const Event& event : view.result.events)
    if (event.severity >= Severity::kMajor && worst < 0) worst = event.t_s - view.begin_s();
  char* end = nullptr;
  const double asked = std::strtod(text.c_str(), &end);
  const double t = end != text.c_str() && std::isfinite(asked) ? asked : std::max(0.0, worst);
  return std::clamp(t, 0.0, view.trace ? length_s(*view.trace) : 0.0);
}

/// As asked; else the middle of what is chosen to lie together, else the beginning.
double compared_moment(const CompareView& view, const std::string& text) {
  const std::vector<SharedMark> marks = shared_marks(view.left, view.right);
  const double shift = shift_s(marks, view.aligned);
  const double top_s = std::max(view.left.trace ? length_s(*view.left.trace) : 0,
                                view.right.trace ? length_s(*view.right.trace) - shift : 0);
  char* end = nullptr;
  const double asked = std::strtod(text.c_str(), &end);
  const double otherwise = view.aligned > 0 ? marks[static_cast<std::size_t>(view.aligned - 1)].left_s : 0;
  return std::clamp(end != text.c_str() && std::isfinite(asked) ? asked : otherwise, 0.0, std::max(0.0, top_s));
}

std::string short_words(const AttemptView& view) { return view.result.trainee + ", " + view.result.started_utc.substr(0, 10); }

}  // namespace

std::string argument(const std::map<std::string, std::string>& values, const std::string& name, const std::string& otherwise) {
  const auto it = values.find(name);
  return it == values.end() ? otherwise : it->second;
}

bool is_staff(const Request& request) { return request.account && request.account->role != Role::kTrainee; }

Frame frame_of(const Request& request, const Desk& desk) {
  Frame frame;
  if (request.account) frame.who = request.account->name.empty() ? request.account->login : request.account->name;
  if (request.account && request.account->role == Role::kTrainee) frame.own_code = request.account->trainee_code;
  frame.token = request.token;
  frame.now_utc = request.now_utc;
  frame.demo = desk.demo;
  frame.may_write = is_staff(request);
  frame.pdf = true;
  if (desk.sources.central) frame.central = desk.sources.central();
  frame.signed_in = request.account && !request.account->uuid.empty();
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

std::vector<std::string> distinct_attempt_values(Database& database, const std::string& column) {
  std::set<std::string> values;
  for (const desk::Combination& one : desk::combinations(database.connection())) values.insert(column == "hand" ? one.hand : one.level);
  return {values.begin(), values.end()};
}

CohortView cohort_view(Desk& desk, const Request& request) {
  CohortView view;
  view.asked = {argument(request.query, "group"), argument(request.query, "exercise"), argument(request.query, "level"),
                argument(request.query, "state"), argument(request.query, "sort"),     whole_number(argument(request.query, "page"), 1)};
  const ProgressRules rules = rules_in_force(desk.database);
  view.rules_version = rules.version;
  view.groups = CurriculumStore(desk.database).groups();
  view.exercises = exercise_choices(desk.database);
  view.levels = distinct_attempt_values(desk.database, "level");
  view.attempts = static_cast<int>(sql::query_integer(
      desk.database.connection(),
      "SELECT (SELECT count(*) FROM attempt) - (SELECT count(*) FROM attempt WHERE status = 'running' OR trainee_id IN"
      " (SELECT trainee_id FROM erasure WHERE kind = 'training'))"));
  view.erased = static_cast<int>(desk::training_erased(desk.database.connection()).size());
  const std::map<std::string, std::string> titles(view.exercises.begin(), view.exercises.end());
  CohortFilter filter;
  filter.group = view.asked.group;
  filter.exercise = view.asked.exercise_id;
  filter.level = view.asked.level;
  LevelReader levels(desk);
  std::string before;
  for (CohortLine& line : lines_of(desk, rules, filter, request.now_utc)) {
    if (line.trainee != before) ++view.trainees;
    before = line.trainee;
    const auto title = titles.find(line.key.exercise_id);
    view.lines.push_back({line.trainee, line.name, line.key.exercise_id, title == titles.end() ? line.key.exercise_id : title->second,
                          line.key.level, line.key.hand, line.tries, line.best, line.last, std::move(line.newest_scores),
                          levels.of(line.key.rubric_sha256, line.key.level).pass_at, line.mean_peak_n, line.over_force,
                          std::move(line.judgements), line.last_utc, line.graded, line.passes, line.reliability,
                          line.key.rubric_sha256});
  }
  return view;
}

TraineeView trainee_view(Desk& desk, const Request& request) {
  const ProgressRules rules = rules_in_force(desk.database);
  TraineePicture picture = trainee_picture(desk.database, argument(request.arguments, "code"), rules, request.now_utc);
  TraineeView view;
  view.code = picture.code;
  view.name = picture.name;
  view.groups = picture.groups;
  const std::vector<Choice> exercises = exercise_choices(desk.database);
  const std::map<std::string, std::string> titles(exercises.begin(), exercises.end());
  LevelReader levels(desk);
  for (const CurvePicture& curve : picture.curves) {
    view.curves.push_back(curve_view(curve, titles, levels, rules));
    add_due(view, curve, view.curves.back().title);
  }
  std::sort(view.due.begin(), view.due.end(), [](const DueDate& a, const DueDate& b) { return a.utc < b.utc; });
  view.chosen = chosen_curve(view.curves, request);
  view.page = whole_number(argument(request.query, "page"), 1);
  for (const PastAttempt& attempt : picture.ended_by_device) {
    const AttemptSummary& s = attempt.summary;
    view.ended_by_device.push_back({{s.exercise_id, s.level, s.hand, s.rubric_sha256}, point_of(s)});
  }
  view.ability = {picture.ability_logit, picture.ability_se, picture.ability_n, picture.ability_missing};
  for (const WeekMinutes& week : picture.weeks) view.minutes_by_week.emplace_back(week.monday, week.minutes);
  view.erased = picture.training_erased;
  view.notes = std::move(picture.notes);
  view.certificates = std::move(picture.certificates);
  view.rules_version = rules.version;
  view.created_utc = picture.created_utc;
  return view;
}

AttemptView attempt_view(Desk& desk, const Request& request, const std::string& uuid) {
  const AttemptPicture picture = attempt_picture_data(desk.database, uuid);
  AttemptView view;
  view.result = picture.result;
  view.number = picture.summary.row;
  view.exercise = exercise_title(desk.database, view.result.exercise_id);
  view.program = picture.program;
  view.finished_utc = picture.finished_utc;
  view.row_hash = picture.row_hash;
  view.chain_position = chain_position(desk.database, view.result.uuid);
  const LevelFacts facts = LevelReader(desk).of(view.result.rubric_sha256, view.result.level);
  view.pass_at = facts.pass_at;
  view.limits = facts.limits;
  view.less_is_better = facts.less_is_better;
  add_trace(view, desk);
  view.picture = static_cast<bool>(desk.sources.picture) && view.trace.has_value();
  view.heat = static_cast<bool>(desk.sources.heat) && view.trace.has_value();
  view.heat_of_force = argument(request.query, "heat") == "force";
  add_film(view, desk);
  view.t_s = moment_of(view, argument(request.query, "t"));
  if (desk.sources.metric_words)
    for (const Metric& metric : view.result.grade.metrics) view.metric_words[metric.name] = desk.sources.metric_words(metric.name);
  const OpinionStore opinions(desk.database);
  view.signatures = opinions.signatures_of(view.result.uuid);
  view.overrides = opinions.overrides_of(view.result.uuid);
  view.ratings = opinions.ratings_of(view.result.uuid);
  for (Note& note : opinions.notes_of(view.result.trainee))
    if (note.attempt_uuid == view.result.uuid) view.notes.push_back(std::move(note));
  add_certificates(view, desk.database);
  view.curve_decisions = decisions_of_curve(desk.database, view.result);
  add_rivals(view, picture, is_staff(request));
  const ProgressRules rules = rules_in_force(desk.database);
  view.rules_version = rules.version;
  view.late_share = rules.late_share;
  if (is_staff(request)) add_readiness(view, desk, rules, request.now_utc);
  return view;
}

AttemptView film_view(Desk& desk, const std::string& uuid) {
  AttemptView view;
  view.result = AttemptStore(desk.database).load(uuid);
  view.exercise = exercise_title(desk.database, view.result.exercise_id);
  add_film(view, desk);
  return view;
}

CompareView compare_view(Desk& desk, const Request& request) {
  CompareView view;
  view.left = attempt_view(desk, request, argument(request.arguments, "attempt"));
  view.right = attempt_view(desk, request, argument(request.arguments, "other"));
  view.exercise = view.left.exercise + " " + view.left.result.level;
  view.aligned = request.query.contains("by") ? whole_number(argument(request.query, "by"), 0)
                                                : start_mark(shared_marks(view.left, view.right));
  if (static_cast<std::size_t>(view.aligned) > shared_marks(view.left, view.right).size()) view.aligned = 0;
  view.t_s = compared_moment(view, argument(request.query, "t"));
  view.left_words = short_words(view.left);
  view.right_words = short_words(view.right);
  if (view.right.result.hand == "expert") view.right_words = "expert, " + view.right.result.started_utc.substr(0, 10);
  if (view.left_words == view.right_words) {
    view.left_words = "first, " + view.left_words;
    view.right_words = "second, " + view.right_words;
  }
  return view;
}

}  // namespace trocar::review
