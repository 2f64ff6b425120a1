#include <cmath>

#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/programme_views.h"
#include "trainees/desk/queries/roster_views.h"
#include "trainees/markup/csv.h"

namespace trocar::review {
namespace {

/// "" for nothing, and for what is no finite number.
std::string csv_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? trocar::csv_number(*value) : "";
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : "; ") + word;
  return out;
}

std::string flags(const std::vector<Judgement>& judgements) {
  std::string out;
  for (const Judgement& j : judgements) out += (out.empty() ? "" : "; ") + std::string(flag_name(j.flag));
  return out;
}

}  // namespace

std::string cohort_csv(const CohortView& view) {
  std::string out =
      csv_line({"trainee", "name", "exercise", "level", "input", "tries", "best", "last", "pass_at", "peak_force_n",
                "over_force", "last_utc", "states", "evidence", "n", "decided", "reliability", "rules"});
  for (const CohortEntry& l : selected_lines(view))
    out += csv_line({csv_text(l.code), csv_text(l.name), csv_text(l.exercise_id), csv_text(l.level), csv_text(l.hand),
                     std::to_string(l.tries), csv_number(l.best), csv_number(l.last), csv_number(l.pass_at),
                     csv_number(l.peak_force_n), std::to_string(l.over_force), csv_text(l.last_utc),
                     csv_text(flags(l.judgements)), csv_text(l.judgements.empty() ? "" : l.judgements.front().evidence),
                     std::to_string(l.judgements.empty() ? l.tries : l.judgements.front().n),
                     std::to_string(l.judgements.empty() ? 0 : l.judgements.front().decided),
                     csv_number(l.judgements.empty() ? std::nullopt : l.judgements.front().reliability),
                     csv_text(view.rules_version)});
  return out;
}

std::string trainee_csv(const TraineeView& view) {
  std::string out =
      csv_line({"trainee", "exercise", "level", "input", "rules_sha256", "try", "number", "attempt", "started_utc",
                "status", "score", "passed", "passed_by_score", "decided_by", "soft_real_time"});
  const auto line = [&](const CurveKey& key, const std::string& at, const CurvePoint& p) {
    return csv_line({csv_text(view.code), csv_text(key.exercise_id), csv_text(key.level), csv_text(key.hand),
                     csv_text(key.rubric_sha256), at, std::to_string(p.number), csv_text(p.uuid), csv_text(p.utc),
                     csv_text(p.status), csv_number(p.score), p.passed ? "1" : "0", p.passed_by_score ? "1" : "0",
                     csv_text(p.decided_by), p.soft_real_time ? "1" : "0"});
  };
  for (const CurveView& curve : view.curves)
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      out += line(curve.key, std::to_string(i + 1), curve.points[i]);
  for (const EndedAttempt& ended : view.ended_by_device)
    out += line(ended.key, "", ended.point);  // they count as no try
  return out;
}

std::string roster_csv(const RosterView& view) {
  std::string out =
      csv_line({"code", "name", "email", "group", "all_groups", "attempts", "last_utc", "login", "state"});
  for (const RosterEntry& one : view.people)
    out += csv_line({csv_text(one.code), csv_text(one.name), csv_text(one.email),
                     csv_text(one.groups.empty() ? "" : one.groups.front()), csv_text(joined(one.groups)),
                     std::to_string(one.attempts), csv_text(one.last_utc), csv_text(one.login),
                     one.active ? "active" : "deactivated"});
  return out;
}

std::string grid_csv(const GridView& view) {
  std::string out = csv_line({"code", "name", "groups", "active", "programme", "step", "exercise", "level", "rule",
                              "state", "attempts", "passes", "days", "deadline", "missing"});
  for (const ProgrammeLine& line : view.grid.lines) {
    for (std::size_t at = 0; at < line.cells.size(); ++at) {
      const ProgrammeStep& step = view.grid.programme.steps[at];
      const ProgrammeCell& cell = line.cells[at];
      out +=
          csv_line({csv_text(line.code), csv_text(line.name), csv_text(joined(line.groups)), line.active ? "1" : "0",
                    csv_text(view.grid.name), std::to_string(at + 1), csv_text(step.exercise_id), csv_text(step.level),
                    csv_text(rule_words(step)), step_state_key(cell.state), std::to_string(cell.progress.attempts),
                    std::to_string(cell.progress.passes), std::to_string(cell.progress.days),
                    cell.due_s ? due_day(*cell.due_s) : "", csv_text(missing_words(step, cell.progress))});
    }
  }
  return out;
}

std::string reminders_csv(const std::vector<Reminder>& lines) {
  std::string out = csv_line({"code", "name", "group", "programme", "step", "deadline", "days", "state", "missing"});
  for (const Reminder& one : lines)
    out += csv_line({csv_text(one.code), csv_text(one.name), csv_text(joined(one.groups)), csv_text(one.programme),
                     csv_text(one.step.exercise_id + " " + one.step.level), one.due, std::to_string(one.days),
                     step_state_key(one.state), csv_text(one.missing)});
  return out;
}

std::string attempt_csv(const AttemptView& view) {
  const AttemptResult& r = view.result;
  std::string out =
      csv_line({"attempt", "kind", "name", "value", "unit", "t_s", "severity", "weight", "full_at", "zero_at"});
  out += csv_line({csv_text(r.uuid), "score", "score", csv_number(r.grade.score), "", "", "", "", "", ""});
  const Verdict verdict = view.verdict();
  out += csv_line({csv_text(r.uuid), "verdict", "passed", verdict.passed ? "1" : "0", "", "", "", "", "", ""});
  out +=
      csv_line({csv_text(r.uuid), "verdict", "passed_by_score", verdict.by_score ? "1" : "0", "", "", "", "", "", ""});
  for (const VerdictOverride& o : view.overrides)
    out += csv_line({csv_text(r.uuid), "decision", csv_text(o.printed), o.passed ? "1" : "0", "", "", "", "", "", ""});
  for (const Metric& m : r.grade.metrics)
    out += csv_line(
        {csv_text(r.uuid), "metric", csv_text(m.name), csv_number(m.value), csv_text(m.unit), "", "", "", "", ""});
  for (const Subscore& s : r.grade.subscores)
    out += csv_line({csv_text(r.uuid), "part", csv_text(s.name), csv_number(s.value), "", "", "", csv_number(s.weight),
                     csv_number(s.full_at), csv_number(s.zero_at)});
  for (const Event& e : r.events)
    out += csv_line({csv_text(r.uuid), "event", csv_text(e.type), csv_number(e.value), csv_text(e.unit),
                     csv_number(e.t_s), severity_name(e.severity), "", "", ""});
  return out;
}

}  // namespace trocar::review
