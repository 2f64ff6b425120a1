#include "app/window/attempt/debrief_reason.h"

#include <algorithm>

#include "app/session/grading/device_words.h"
#include "app/session/grading/realtime_report.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

constexpr double kWorthSaying = 0.5;  // points

/// The cap of what was left undone; null without one.
const Cap* undone(const Grade& grade) {
  const auto at = std::find_if(grade.caps.begin(), grade.caps.end(),
                               [](const Cap& cap) { return cap.kind == CapKind::kUnfinished; });
  return at == grade.caps.end() ? nullptr : &*at;
}

std::string critical_words(const Translator& words, const AttemptResult& result, const Event& event,
                           const Exercise& exercise) {
  const std::string t = words.number(clock_s(result, event.t_s), 1);
  if (event.type == event_type::kCriticalForce)
    return words("{0} N at {1} s: above the critical limit of {2} N.",
                 {words.number(event.value, 2), t, words.number(exercise.critical_force_n, 1)});
  if (event.type == event_type::kLost) return words("A block was lost at {0} s: it lies outside the field.", {t});
  if (event.type == event_type::kCrush) return words("Too many blocks crushed, the last one at {0} s.", {t});
  return words("A critical event at {0} s: {1}.",
               {t, event_words(words, event).empty() ? event.type : event_words(words, event)});
}

std::string undone_words(const Translator& words, const AttemptResult& result, const Cap& left) {
  const std::vector<std::string> counts{std::to_string(left.done), std::to_string(left.total)};
  return result.grade.status == AttemptStatus::kTimeout ? words("Time ran out: {0} of {1} done.", counts)
                                                        : words("Not finished: {0} of {1} done.", counts);
}

std::string gate_words(const Translator& words, const DebriefRow& row) {
  return words("{0}: {1}; a pass needs {2}.", {row.name, row.value, row.needed});
}

std::string score_words(const Translator& words, const DebriefFacts& facts) {
  const std::string score = words.number(*facts.score, 1), pass = words.number(facts.pass_at, 0);
  const DebriefRow* worst = largest_loss(facts.rows);
  if (!worst) return words("{0} of 100 points, a pass needs {1}.", {score, pass});
  return words("{0} of 100 points, a pass needs {1}. Most points were lost on: {2}.", {score, pass, worst->name});
}

bool began(const AttemptResult& result) {
  return std::any_of(result.events.begin(), result.events.end(),
                     [](const Event& e) { return e.type == event_type::kStart; });
}

std::string ungraded_words(const Translator& words, const AttemptResult& result, Outcome outcome) {
  const double t = result.events.empty() ? 0 : clock_s(result, result.events.back().t_s);
  switch (outcome) {
    case Outcome::kStopped:
      if (result.cut_off)
        return words("The attempt was cut off with its program, so there is no score. It counts as not passed.");
      return t > 0 ? words("You left the attempt, so there is no score. It counts as not passed.")
                   : words("You left before the clock began, so there is no score. It counts as not passed.");
    case Outcome::kDeviceStopped:
      return words("The device stopped. That is not your doing: the attempt does not count.");
    default:
      return began(result) ? words("The attempt is void: its record cannot be graded, and it does not count.")
                           : words("The clock never began: nothing is graded, and it does not count.");
  }
}

/// That it stood still: no point is lost by it, but it belongs to the attempt.
void add_pauses(const Translator& words, const AttemptResult& result, std::vector<std::string>& out) {
  const std::vector<StoodStill> pauses = pauses_of(result.device.realtime);
  if (pauses.empty()) return;
  double all_s = 0;
  for (const StoodStill& pause : pauses) all_s += pause.seconds;
  const std::string took = words.number(all_s, all_s < 10 ? 1 : 0),
                    at = words.number(clock_s(result, pauses.front().at_s), 1);
  out.push_back(pauses.size() == 1 ? words("Paused once, at {0} s, for {1} s.", {at, took})
                                   : words("Paused {0} times, first at {1} s, {2} s in all.",
                                           {std::to_string(pauses.size()), at, took}));
}

}  // namespace

double clock_s(const AttemptResult& result, double t_s) {
  const auto start = std::find_if(result.events.begin(), result.events.end(),
                                  [](const Event& e) { return e.type == event_type::kStart; });
  return start == result.events.end() ? 0 : std::max(0.0, t_s - start->t_s);
}

const Event* first_critical(const AttemptResult& result) {
  const auto at = std::find_if(result.events.begin(), result.events.end(),
                               [](const Event& e) { return e.severity == Severity::kCritical; });
  return at == result.events.end() ? nullptr : &*at;
}

const DebriefRow* largest_loss(const std::vector<DebriefRow>& rows) {
  const DebriefRow* worst = nullptr;
  for (const DebriefRow& row : rows)
    if (row.lost >= kWorthSaying && (!worst || row.lost > worst->lost + 1e-9)) worst = &row;
  return worst;
}

const DebriefRow* worst_gate(const std::vector<DebriefRow>& rows) {
  const DebriefRow* worst = nullptr;
  for (const DebriefRow& row : rows)
    if (row.failed && (!worst || row.lost > worst->lost + 1e-9)) worst = &row;
  return worst;
}

Outcome outcome_of(const AttemptResult& result) {
  switch (result.grade.status) {
    case AttemptStatus::kCompleted:
    case AttemptStatus::kTimeout:
      if (!result.grade.score) return Outcome::kVoid;
      return result.grade.passed ? Outcome::kPass : Outcome::kNotYet;
    case AttemptStatus::kAborted:
      return Outcome::kStopped;
    case AttemptStatus::kFault:
      return Outcome::kDeviceStopped;
    case AttemptStatus::kVoid:
      return Outcome::kVoid;
  }
  return Outcome::kVoid;
}

std::string verdict_words(const Translator& words, Outcome outcome) {
  switch (outcome) {
    case Outcome::kPass:
      return words("PASS");
    case Outcome::kNotYet:
      return words("NOT YET");
    case Outcome::kStopped:
      return words("STOPPED");
    case Outcome::kDeviceStopped:
      return words("DEVICE STOPPED");
    case Outcome::kVoid:
      return words("VOID");
  }
  return "";
}

std::string reason_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                         const Exercise& exercise) {
  if (!facts.score) return ungraded_words(words, result, facts.outcome);
  if (facts.outcome == Outcome::kPass) return score_words(words, facts);
  if (const Event* event = first_critical(result)) return critical_words(words, result, *event, exercise);
  if (const DebriefRow* gate = worst_gate(facts.rows)) return gate_words(words, *gate);
  if (const Cap* left = undone(result.grade)) return undone_words(words, result, *left);
  if (result.grade.status == AttemptStatus::kTimeout) return words("Time ran out before the task was done.");
  return score_words(words, facts);
}

std::vector<std::string> further_words(const Translator& words, const AttemptResult& result,
                                       const DebriefFacts& facts) {
  std::vector<std::string> out;
  if (!facts.score) {
    const std::string fault = fault_words(result.device);
    if (!fault.empty())
      out.push_back(words.made(fault));
    else if (!result.integrity.empty())
      out.push_back(words.made(result.integrity));
    add_pauses(words, result, out);
    return out;
  }
  const bool critical = facts.outcome != Outcome::kPass && first_critical(result) != nullptr;
  const DebriefRow* first = critical ? nullptr : worst_gate(facts.rows);
  for (const DebriefRow& row : facts.rows)
    if (row.failed && &row != first) out.push_back(gate_words(words, row));
  if (const Cap* left = undone(result.grade); left && (critical || first))
    out.push_back(undone_words(words, result, *left));
  if (result.device.force_not_rendered())
    out.push_back(
        words("The device could not give the force in {0} % of the contact time: this attempt does not count for a "
              "certificate.",
              {words.number(100 * result.device.saturated_contact_share, 0)}));
  add_pauses(words, result, out);
  return out;
}

}  // namespace trocar
