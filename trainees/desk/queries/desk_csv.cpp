#include <array>
#include <charconv>
#include <cmath>

#include "trainees/desk/pages/pages.h"

namespace trocar::review {
namespace {

/// Quoted where it must be. A text that a spreadsheet would compute gets an apostrophe before it.
std::string field(const std::string& text) {
  std::string safe = text;
  if (!safe.empty() && std::string("=+-@\t\r").find(safe[0]) != std::string::npos) safe = "'" + safe;
  if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
  std::string out = "\"";
  for (const char c : safe) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// Shortest text that reads back to the same bits; "" for nothing.
std::string number(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return "";
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), *value);
  return {text.data(), end.ptr};
}

std::string row(const std::vector<std::string>& cells) {
  std::string out;
  for (const std::string& cell : cells) out += (&cell == &cells.front() ? "" : ",") + cell;
  return out + "\r\n";
}

std::string flags(const std::vector<Judgement>& judgements) {
  std::string out;
  for (const Judgement& j : judgements) out += (out.empty() ? "" : "; ") + std::string(flag_name(j.flag));
  return out;
}

}  // namespace

std::string cohort_csv(const CohortView& view) {
  std::string out =
      row({"trainee", "name", "exercise", "level", "input", "tries", "best", "last", "pass_at", "peak_force_n",
           "over_force", "last_utc", "states", "evidence", "n", "decided", "reliability", "rules"});
  for (const CohortEntry& l : selected_lines(view))
    out += row({field(l.code), field(l.name), field(l.exercise_id), field(l.level), field(l.hand),
                std::to_string(l.tries), number(l.best), number(l.last), number(l.pass_at), number(l.peak_force_n),
                std::to_string(l.over_force), field(l.last_utc), field(flags(l.judgements)),
                field(l.judgements.empty() ? "" : l.judgements.front().evidence),
                std::to_string(l.judgements.empty() ? l.tries : l.judgements.front().n),
                std::to_string(l.judgements.empty() ? 0 : l.judgements.front().decided),
                number(l.judgements.empty() ? std::nullopt : l.judgements.front().reliability),
                field(view.rules_version)});
  return out;
}

std::string trainee_csv(const TraineeView& view) {
  std::string out = row({"trainee", "exercise", "level", "input", "rules_sha256", "try", "number", "attempt",
                         "started_utc", "status", "score", "passed", "passed_by_score", "decided_by"});
  const auto line = [&](const CurveKey& key, const std::string& at, const CurvePoint& p) {
    return row({field(view.code), field(key.exercise_id), field(key.level), field(key.hand), field(key.rubric_sha256),
                at, std::to_string(p.number), field(p.uuid), field(p.utc), field(p.status), number(p.score),
                p.passed ? "1" : "0", p.passed_by_score ? "1" : "0", field(p.decided_by)});
  };
  for (const CurveView& curve : view.curves)
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      out += line(curve.key, std::to_string(i + 1), curve.points[i]);
  for (const EndedAttempt& ended : view.ended_by_device)
    out += line(ended.key, "", ended.point);  // they count as no try
  return out;
}

std::string attempt_csv(const AttemptView& view) {
  const AttemptResult& r = view.result;
  std::string out =
      row({"attempt", "kind", "name", "value", "unit", "t_s", "severity", "weight", "full_at", "zero_at"});
  out += row({field(r.uuid), "score", "score", number(r.grade.score), "", "", "", "", "", ""});
  const Verdict verdict = view.verdict();
  out += row({field(r.uuid), "verdict", "passed", verdict.passed ? "1" : "0", "", "", "", "", "", ""});
  out += row({field(r.uuid), "verdict", "passed_by_score", verdict.by_score ? "1" : "0", "", "", "", "", "", ""});
  for (const VerdictOverride& o : view.overrides)
    out += row({field(r.uuid), "decision", field(o.printed), o.passed ? "1" : "0", "", "", "", "", "", ""});
  for (const Metric& m : r.grade.metrics)
    out += row({field(r.uuid), "metric", field(m.name), number(m.value), field(m.unit), "", "", "", "", ""});
  for (const Subscore& s : r.grade.subscores)
    out += row({field(r.uuid), "part", field(s.name), number(s.value), "", "", "", number(s.weight), number(s.full_at),
                number(s.zero_at)});
  for (const Event& e : r.events)
    out += row({field(r.uuid), "event", field(e.type), number(e.value), field(e.unit), number(e.t_s),
                severity_name(e.severity), "", "", ""});
  return out;
}

}  // namespace trocar::review
