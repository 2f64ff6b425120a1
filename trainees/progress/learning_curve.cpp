#include "trainees/progress/learning_curve.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "trainees/records/cohort.h"

namespace trocar {
namespace {

constexpr std::size_t kLeastForBand = 3;

/// Value between the sorted values at share p.
double quantile(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

void add(LearningCurve& curve, const PastAttempt& attempt) {
  const AttemptSummary& s = attempt.summary;
  curve.attempts.push_back(attempt);
  curve.in_a_row = s.passed ? curve.in_a_row + 1 : 0;
  curve.passed += s.passed ? 1 : 0;
  if (const auto time = attempt.metrics.find(kTimeMetric); time != attempt.metrics.end())
    curve.trained_s += time->second;
  if (!s.score) return;
  ++curve.graded;
  curve.last = s.score;
  curve.best = std::max(curve.best.value_or(*s.score), *s.score);
}

std::optional<Quartiles> own_band(const LearningCurve& curve) {
  std::vector<double> scores;
  for (const PastAttempt& attempt : curve.attempts)
    if (attempt.summary.score) scores.push_back(*attempt.summary.score);
  if (scores.size() < kLeastForBand) return std::nullopt;
  if (scores.size() > kBandAttempts) scores.erase(scores.begin(), scores.end() - kBandAttempts);
  return quartiles(scores);
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// A name that a spreadsheet would compute gets an apostrophe before it.
std::string defused(const std::string& text) {
  return !text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos ? "'" + text : text;
}

std::string exact(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

}  // namespace

std::optional<Quartiles> quartiles(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Quartiles{quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

std::vector<bool> LearningCurve::passes() const {
  std::vector<bool> out;
  for (const PastAttempt& attempt : attempts) out.push_back(attempt.summary.passed);
  return out;
}

std::vector<LearningCurve> learning_curves(const std::vector<PastAttempt>& newest_first) {
  std::vector<LearningCurve> curves;
  for (const PastAttempt& attempt : newest_first) {
    const AttemptSummary& s = attempt.summary;
    const CurveKey key{s.exercise_id, s.level, s.hand, s.rubric_sha256};
    if (s.status == "running" || s.ended_by_device) continue;
    if (std::none_of(curves.begin(), curves.end(), [&](const LearningCurve& c) { return c.key == key; })) {
      curves.emplace_back();
      curves.back().key = key;
    }
  }
  for (auto attempt = newest_first.rbegin(); attempt != newest_first.rend(); ++attempt) {
    const AttemptSummary& s = attempt->summary;
    const CurveKey key{s.exercise_id, s.level, s.hand, s.rubric_sha256};
    if (s.status == "running" || s.ended_by_device) continue;
    add(*std::find_if(curves.begin(), curves.end(), [&](const LearningCurve& c) { return c.key == key; }), *attempt);
  }
  for (LearningCurve& curve : curves) curve.band = own_band(curve);
  return curves;
}

OwnValues own_values(const std::vector<PastAttempt>& attempts, const std::string& metric, bool less_is_better) {
  std::vector<double> values;
  for (const PastAttempt& attempt : attempts) {
    const auto at = attempt.metrics.find(metric);
    if (attempt.summary.score && at != attempt.metrics.end()) values.push_back(at->second);
  }
  OwnValues out;
  out.count = static_cast<int>(values.size());
  if (values.empty()) return out;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  out.best = less_is_better ? *least : *most;
  out.median = quartiles(values)->median;
  return out;
}

std::string attempts_csv(const std::vector<PastAttempt>& attempts) {
  std::set<std::string> names;
  for (const PastAttempt& attempt : attempts)
    for (const auto& [name, value] : attempt.metrics) names.insert(name);
  std::string out =
      "started_utc,attempt,trainee,exercise,version,level,board,seed,input,status,score,passed,passed_by_score,decided_"
      "by,"
      "decided_utc,grade,reason,rubric_sha256";
  for (const std::string& name : names) out += "," + name;
  out += "\r\n";
  for (const PastAttempt& attempt : attempts) {
    const AttemptSummary& s = attempt.summary;
    for (const std::string& cell :
         {s.started_utc, s.uuid, s.trainee, s.exercise_id, s.exercise_version, s.level, std::to_string(s.board),
          std::to_string(s.seed), s.hand, s.status, s.score ? exact(*s.score) : "", std::string(s.passed ? "1" : "0"),
          std::string(s.passed_by_score ? "1" : "0"), defused(s.decided_by), s.decided_utc, s.grade, s.integrity})
      out += quoted(cell) + ",";
    out += s.rubric_sha256;
    for (const std::string& name : names) {
      const auto at = attempt.metrics.find(name);
      out += "," + (at == attempt.metrics.end() ? "" : exact(at->second));
    }
    out += "\r\n";
  }
  return out;
}

}  // namespace trocar
