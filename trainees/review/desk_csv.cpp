#include <array>
#include <charconv>
#include <cmath>

#include "trainees/review/pages.h"

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
  std::string out = row({"trainee", "name", "exercise", "level", "input", "tries", "best", "last", "pass_at", "peak_force_n", "over_force",
                         "last_utc", "states", "evidence", "rules"});
  for (const CohortEntry& l : selected_lines(view))
    out += row({field(l.code), field(l.name), field(l.exercise_id), field(l.level), field(l.hand), std::to_string(l.tries), number(l.best),
                number(l.last), number(l.pass_at), number(l.peak_force_n), std::to_string(l.over_force), field(l.last_utc),
                field(flags(l.judgements)), field(l.judgements.empty() ? "" : l.judgements.front().evidence), field(view.rules_version)});
  return out;
}

std::string trainee_csv(const TraineeView& view) {
  std::string out =
      row({"trainee", "exercise", "level", "input", "rules_sha256", "number", "attempt", "started_utc", "status", "score", "passed"});
  for (const CurveView& curve : view.curves)
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CurvePoint& p = curve.points[i];
      out += row({field(view.code), field(curve.key.exercise_id), field(curve.key.level), field(curve.key.hand),
                  field(curve.key.rubric_sha256), std::to_string(i + 1), field(p.uuid), field(p.utc), field(p.status), number(p.score),
                  p.passed ? "1" : "0"});
    }
  return out;
}

std::string attempt_csv(const AttemptView& view) {
  const AttemptResult& r = view.result;
  std::string out = row({"attempt", "kind", "name", "value", "unit", "t_s", "severity", "weight", "full_at", "zero_at"});
  out += row({field(r.uuid), "score", "score", number(r.grade.score), "", "", "", "", "", ""});
  for (const Metric& m : r.grade.metrics)
    out += row({field(r.uuid), "metric", field(m.name), number(m.value), field(m.unit), "", "", "", "", ""});
  for (const Subscore& s : r.grade.subscores)
    out += row({field(r.uuid), "part", field(s.name), number(s.value), "", "", "", number(s.weight), number(s.full_at), number(s.zero_at)});
  for (const Event& e : r.events)
    out +=
        row({field(r.uuid), "event", field(e.type), number(e.value), field(e.unit), number(e.t_s), severity_name(e.severity), "", "", ""});
  return out;
}

}  // namespace trocar::review
