// What the pages about one attempt and about two show.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "haptics/input_error.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/desk/pages/compare_moment.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/level_reader.h"
#include "trainees/desk/server/path_redaction.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/markup/html.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

/// Whether something that people said of the attempt is not as its signed entry says.
bool unsigned_words(const Database& database, const std::string& attempt) {
  for (const std::string table : {"signature", "verdict_override", "rating", "note"}) {
    sql::Statement row(database.connection(), "SELECT EXISTS (SELECT 1 FROM " + table +
                                                  " r JOIN attempt a ON a.id = r.attempt_id WHERE a.uuid = ?1"
                                                  " AND NOT row_holds('" +
                                                  table + "', r.id))");
    if (row.bind(attempt).step() && row.integer(0) != 0) return true;
  }
  return false;
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
      if (const std::string foreign = desk.sources.foreign_recording(desk.database, view.result); !foreign.empty())
        view.no_trace = sentence(foreign + ": it says nothing of this attempt");
      else
        view.trace = desk.sources.trace(view.result.recording_path);
      if (view.result.cut_off && desk.sources.recorded_outcome)
        view.recorded = desk.sources.recorded_outcome(desk.database, view.result);
    } catch (const std::exception& error) {
      const bool there = std::filesystem::is_regular_file(view.result.recording_path, none);
      view.no_trace =
          desk::of_erased(desk.database.connection(), view.result.uuid)
              ? "The recording was erased with the training data."
          : there ? sentence("The recording cannot be read: " + without_folders(error.what(), desk.database.file()))
                  : "The recording is not in its place any more.";
    }
  }
}

void add_film(AttemptView& view, Desk& desk) {
  if (desk.sources.film.state) view.film = desk.sources.film.state(view.result.uuid);
  view.no_film = desk.sources.no_film;
  if (view.no_film.empty() && !desk.sources.film.make) view.no_film = "No film: this desk makes none.";
  if (view.no_film.empty() && view.result.recording_path.empty())
    view.no_film = "No film: this attempt was not recorded.";
}

/// Own earlier attempts; an expert's for staff only: a trainee sees nobody else's.
void add_rivals(AttemptView& view, const AttemptDetail& detail, bool staff) {
  const PastAttempt* best = nullptr;
  for (const PastAttempt& attempt : detail.earlier)
    if (attempt.summary.score && (best == nullptr || *attempt.summary.score > *best->summary.score)) best = &attempt;
  if (best != nullptr) view.rivals.push_back({"own best before", best->summary.uuid, best->summary.score});
  if (!detail.earlier.empty())
    view.rivals.push_back(
        {"own attempt before", detail.earlier.front().summary.uuid, detail.earlier.front().summary.score});
  if (staff && !detail.experts.empty()) {
    const AttemptSummary& expert = detail.experts.front();
    if (expert.uuid != detail.result.uuid)
      view.rivals.push_back({expert.board == detail.result.board ? "expert, same board" : "expert, another board",
                             expert.uuid, expert.score});
  }
}

/// Which conditions of a certificate a curve that is not ready does not meet.
std::vector<std::string> missing_on(const CohortLine& line, const ProgressRules& rules) {
  std::vector<std::string> out;
  if (!line.certified_utc.empty()) out.push_back("One is held already, of " + line.certified_utc.substr(0, 10) + ".");
  for (const Judgement& judgement : line.judgements)
    if (judgement.flag != Flag::kReady && judgement.flag != Flag::kRetentionDue && judgement.flag != Flag::kCertified)
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

std::string short_words(const AttemptView& view) {
  return view.result.trainee + ", " + view.result.started_utc.substr(0, 10);
}

}  // namespace

AttemptView attempt_view(Desk& desk, const Request& request, const std::string& uuid) {
  const AttemptDetail detail = attempt_detail(desk.database, uuid);
  AttemptView view;
  view.result = detail.result;
  view.number = detail.summary.row;
  view.exercise = exercise_title(desk.database, view.result.exercise_id);
  view.program = detail.program;
  view.finished_utc = detail.finished_utc;
  view.row_hash = detail.row_hash;
  view.chain_position = chain_position(desk.database, view.result.uuid);
  const LevelFacts facts = LevelReader(desk).of(view.result.rubric_sha256, view.result.level);
  view.pass_at = facts.pass_at;
  view.limits = facts.limits;
  view.pose = facts.pose;
  view.less_is_better = facts.less_is_better;
  add_trace(view, desk);
  view.picture = static_cast<bool>(desk.sources.picture) && view.trace.has_value();
  view.heat = static_cast<bool>(desk.sources.heat) && view.trace.has_value();
  view.heat_of_force = argument(request.query, "heat") == "force";
  add_film(view, desk);
  view.t_s = moment_of(view, argument(request.query, "t"));
  if (desk.sources.metric_words)
    for (const Metric& metric : view.result.grade.metrics)
      view.metric_words[metric.name] = desk.sources.metric_words(metric.name);
  const AssessmentStore assessments(desk.database);
  view.signatures = assessments.signatures_of(view.result.uuid);
  view.overrides = assessments.overrides_of(view.result.uuid);
  view.ratings = assessments.ratings_of(view.result.uuid);
  for (Note& note : assessments.notes_of(view.result.trainee))
    if (note.attempt_uuid == view.result.uuid) view.notes.push_back(std::move(note));
  view.changed = !desk::of_erased(desk.database.connection(), view.result.uuid) &&
                 !attempt_vouched(desk.database.connection(), detail.summary.row);
  view.unsigned_words = unsigned_words(desk.database, view.result.uuid);
  add_certificates(view, desk.database);
  view.curve_decisions = decisions_of_curve(desk.database, view.result);
  add_rivals(view, detail, is_staff(request));
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
