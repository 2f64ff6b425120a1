#include "app/report/verdict.h"

#include <algorithm>

#include "trainees/markup/html.h"

namespace trocar {
namespace {

/// The score for being quick; "time in band" and the like are accuracy.
bool is_time(const Subscore& s) {
  return s.name == "time" || s.name == "task_time" || s.name == "duration" || s.name == "speed" ||
         s.name.starts_with("time_to") || s.name.starts_with("time to");
}

int rank(const Subscore& s) { return s.gate ? 0 : is_time(s) ? 2 : 1; }

const Event* first_critical(const AttemptResult& result) {
  for (const Event& event : result.events)
    if (event.severity == Severity::kCritical) return &event;
  return nullptr;
}

std::string short_of(const Subscore& s) {
  return words_of(s.name) + ": " + quantity_text(s.raw, s.unit) + ", full marks at " + quantity_text(s.full_at, s.unit);
}

const Subscore* costliest(const std::vector<Subscore>& ordered) {
  const Subscore* worst = nullptr;
  for (const Subscore& s : ordered)
    if (points_lost(s) > 0.05 && (!worst || points_lost(s) > points_lost(*worst))) worst = &s;
  return worst;
}

std::string ungraded_reason(const AttemptResult& result) {
  switch (result.grade.status) {
    case AttemptStatus::kAborted:
      return "The attempt was stopped before its end, so it carries no score.";
    case AttemptStatus::kFault:
      return "The device stopped with a fault" +
             (result.device.fault.empty() ? std::string() : " (" + result.device.fault + ")") +
             "; the attempt carries no score and is not the trainee's doing.";
    case AttemptStatus::kVoid:
      return "The attempt is void: the recording or the device did not meet the conditions for grading.";
    default:
      return "No score was computed for this attempt.";
  }
}

std::string reason_of(const AttemptResult& result, double pass_mark, const std::vector<Subscore>& ordered) {
  const Grade& grade = result.grade;
  const Subscore* worst = costliest(ordered);
  if (grade.passed) {
    const std::string margin = fixed_text(*grade.score, 1) + " of 100, pass mark " + number_text(pass_mark) + ". ";
    return worst ? margin + "Most points lost on " + short_of(*worst) + "." : margin + "Full marks on every part.";
  }
  if (const Event* event = first_critical(result))
    return words_of(event->type) + " at " + fixed_text(event->t_s, 1) + " s" +
           (event->unit.empty() ? "" : " (" + quantity_text(event->value, event->unit) + ")") +
           ": a critical event caps the score.";
  if (!grade.caps.empty()) return cap_sentence(grade.caps.front()) + ".";
  if (grade.status == AttemptStatus::kTimeout) return "The time limit was reached before the task was complete.";
  const std::string gap = fixed_text(*grade.score, 1) + " of 100, pass mark " + number_text(pass_mark) + ". ";
  return worst ? gap + "The largest loss: " + short_of(*worst) + " (\u2212" + fixed_text(points_lost(*worst), 1) +
                     " points)."
               : gap;
}

}  // namespace

double points_lost(const Subscore& subscore) { return 100 * subscore.weight * (1 - subscore.value); }

std::vector<Subscore> in_report_order(std::vector<Subscore> subscores) {
  std::stable_sort(subscores.begin(), subscores.end(), [](const Subscore& a, const Subscore& b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : points_lost(a) > points_lost(b);
  });
  return subscores;
}

Verdict judge(const AttemptResult& result, double pass_mark) {
  Verdict verdict;
  if (!result.grade.score) {
    verdict.headline = "NOT GRADED";
    verdict.reason = ungraded_reason(result);
    return verdict;
  }
  const std::vector<Subscore> ordered = in_report_order(result.grade.subscores);
  verdict.kind = result.grade.passed ? Verdict::Kind::kPass : Verdict::Kind::kNotYet;
  verdict.headline = result.grade.passed ? "PASS" : "NOT YET";
  verdict.reason = reason_of(result, pass_mark, ordered);
  // A safety gate that is not full is the next thing to practise, whatever it cost; else what cost most.
  const Subscore* next = nullptr;
  for (const Subscore& s : ordered)
    if (s.gate && points_lost(s) > 0.05 && !next) next = &s;
  if (!next) next = costliest(ordered);
  if (next) {
    const bool less = next->full_at < next->zero_at;
    verdict.advice = std::string("Try next: ") + words_of(next->name) + (less ? " down to " : " up to ") +
                     quantity_text(next->full_at, next->unit) +
                     (next->raw ? " (now " + quantity_text(next->raw, next->unit) + ")" : "") + ".";
  }
  return verdict;
}

}  // namespace trocar
