#include "app/window/attempt/debrief_reason.h"

#include <algorithm>

#include "app/session/grading/device_words.h"
#include "app/session/grading/realtime_report.h"
#include "app/window/attempt/metric_words.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/event_types.h"
#include "trainees/markup/pacing.h"

namespace trocar {
namespace {

constexpr double kWorthSaying = 0.5;  // points
constexpr const char* kWrongPlaces = "wrong_places";

/// The row that cost most of those that `counts`; of two that cost the same the first, and safety comes first. Null
/// without one.
template <typename Counts>
const DebriefRow* costliest(const std::vector<DebriefRow>& rows, Counts counts) {
  const DebriefRow* worst = nullptr;
  for (const DebriefRow& row : rows)
    if (counts(row) && (!worst || row.lost > worst->lost + 1e-9)) worst = &row;
  return worst;
}

double share_lost(const DebriefRow& row) { return row.possible > 0 ? row.lost / row.possible : 0; }

/// The row of the places, where force failed its gate and they went at least as badly: what is pressed beside the disc
/// is no force in the band, however gentle. Null otherwise.
const DebriefRow* missed_discs(const std::vector<DebriefRow>& rows) {
  const DebriefRow* force =
      costliest(rows, [](const DebriefRow& row) { return is_band_share(row.metric) && row.failed; });
  const DebriefRow* place =
      costliest(rows, [](const DebriefRow& row) { return row.metric == kWrongPlaces && row.raw.value_or(0) > 0; });
  return force && place && share_lost(*place) >= share_lost(*force) - 1e-9 ? place : nullptr;
}

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
  if (event.type == event_type::kLost) return words("Lost at {0} s: it lies outside the field.", {t});
  if (event.type == event_type::kCrush) return words("Too many blocks crushed, the last one at {0} s.", {t});
  if (event.type == event_type::kRingOff) return words("The ring was pulled off the wire at {0} s.", {t});
  if (event.type == event_type::kGauzeTorn) return words("The gauze was torn at {0} s.", {t});
  if (event.type == event_type::kCutTooSoon)
    return words("Opened at {0} s without two clips before the cut and one beyond it.", {t});
  if (event.type == event_type::kWrongStructure) return words("What must be spared was clipped or cut at {0} s.", {t});
  if (event.type == event_type::kPerforated) return words("The live hook was drawn into the liver at {0} s.", {t});
  if (event.type == event_type::kBleeding)
    return words("At {0} s {1} mL of blood were lost.", {t, words.number(event.value, 0)});
  if (event.type == event_type::kNeedleLost)
    return words("The needle was lost at {0} s: it fell outside the field.", {t});
  if (event.type == event_type::kTear) return words("At {0} s the needle tore the tissue.", {t});
  return words("A critical event at {0} s: {1}.",
               {t, event_words(words, event).empty() ? event.type : event_words(words, event)});
}

std::string undone_words(const Translator& words, const AttemptResult& result, const Cap& left) {
  const std::vector<std::string> counts{std::to_string(left.done), std::to_string(left.total)};
  return result.grade.status == AttemptStatus::kTimeout ? words("Time ran out: {0} of {1} done.", counts)
                                                        : words("Not finished: {0} of {1} done.", counts);
}

/// What was never done, so that this part has no value.
std::string not_tried_words(const Translator& words, const DebriefRow& row, const EventCounts& counts,
                            const Exercise& exercise) {
  const std::vector<std::string> part{words.made(row.subscore)};
  if (judges_pull(judged_part(exercise, row.metric)))
    return words("Nothing was lifted far enough, so {0} cannot be judged.", part);
  if (is_band_share(row.metric)) return words("No disc was touched, so {0} cannot be judged.", part);
  if (is_window_share(row.metric))
    return counts.grasped == 0 ? words("No block was gripped, so {0} cannot be judged.", part)
                               : words("No block was lifted, so {0} cannot be judged.", part);
  return words("Nothing was done that {0} could be judged by.", part);
}

std::string gate_words(const Translator& words, const DebriefRow& row, const EventCounts& counts,
                       const Exercise& exercise) {
  if (!row.raw) return not_tried_words(words, row, counts, exercise);
  return words("{0}: {1}; a pass needs {2}.", {row.name, row.value, row.needed});
}

std::string beside_words(const Translator& words, const DebriefRow& row) {
  return words(row.raw == 1 ? "Once beside the lit disc: what is pressed there does not count."
                            : "{0} times beside the lit disc: what is pressed there does not count.",
               {row.value});
}

std::string score_words(const Translator& words, const DebriefFacts& facts) {
  const std::string score = words.number(*facts.score, 1), pass = words.number(facts.pass_at, 0);
  const DebriefRow* worst = row_of_subscore(facts, facts.cause.subscore);
  if (!worst) return words("{0} of 100 points, a pass needs {1}.", {score, pass});
  return words("{0} of 100 points, a pass needs {1}. Most points were lost on: {2}.", {score, pass, worst->name});
}

std::string ungraded_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts) {
  const double t = result.events.empty() ? 0 : clock_s(result, result.events.back().t_s);
  switch (facts.outcome) {
    case Outcome::kStopped:
      if (result.cut_off)
        return words("The attempt was cut off with its program, so there is no score. It counts as not passed.");
      return t > 0 ? words("You left the attempt, so there is no score. It counts as not passed.")
                   : words("You left before the clock began, so there is no score. It counts as not passed.");
    case Outcome::kDeviceStopped:
      return facts.counts.started
                 ? words("The device stopped. The attempt does not count, but passes in a row begin anew.")
                 : words("The device stopped. That is not your doing: the attempt does not count.");
    default:
      switch (facts.cause.kind) {
        case DebriefCause::Kind::kDeadman:
          return words("The deadman was opened while the clock ran: the attempt is void, and counts as not passed.");
        case DebriefCause::Kind::kNotStarted:
          return words("The clock never began: nothing is graded, and it does not count.");
        default:
          return facts.counts.started
                     ? words("The attempt is void: its record cannot be graded. Passes in a row begin anew.")
                     : words("The attempt is void: its record cannot be graded, and it does not count.");
      }
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

/// Of AttemptResult::assists.
std::string help_words(const Translator& w, const std::string& assists) {
  const bool height = assists.find("height") != std::string::npos, plumb = assists.find("plumb") != std::string::npos;
  if (height && plumb) return w("Helped at this level: the tip kept its height, a line showed what lies below it.");
  if (height) return w("Helped at this level: the tip kept its height by itself.");
  return plumb ? w("Helped at this level: a line showed what lies below the tip.") : "";
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

const DebriefRow* row_of_subscore(const DebriefFacts& facts, const std::string& subscore) {
  const auto at = std::find_if(facts.rows.begin(), facts.rows.end(),
                               [&](const DebriefRow& row) { return row.subscore == subscore; });
  return at == facts.rows.end() ? nullptr : &*at;
}

DebriefCause cause_of(const AttemptResult& result, const DebriefFacts& facts) {
  using Kind = DebriefCause::Kind;
  const auto of = [](Kind kind, const DebriefRow* row) {
    return row ? DebriefCause{kind, row->metric, row->subscore} : DebriefCause{kind};
  };
  if (facts.outcome == Outcome::kStopped) return {Kind::kAgain};
  if (facts.outcome == Outcome::kVoid && facts.counts.deadman_opened) return {Kind::kDeadman};
  if (facts.outcome == Outcome::kVoid && !facts.counts.started) return {Kind::kNotStarted};
  if (facts.outcome == Outcome::kDeviceStopped || facts.outcome == Outcome::kVoid) return {Kind::kDevice};
  if (const Event* event = first_critical(result)) return {Kind::kCritical, "", "", event->type};
  const bool late = result.grade.status == AttemptStatus::kTimeout;
  if (late && !facts.counts.started) return {Kind::kNotStarted};
  const DebriefRow* beside = missed_discs(facts.rows);
  if (const DebriefRow* gate = costliest(facts.rows, [&](const DebriefRow& row) {
        return row.failed && row.raw && !(beside && is_band_share(row.metric));
      }))
    return of(Kind::kGate, gate);
  if (beside) return of(Kind::kBeside, beside);
  if (const DebriefRow* gate = costliest(facts.rows, [](const DebriefRow& row) { return row.failed; }))
    return of(Kind::kNotTried, gate);
  const DebriefRow* loss =
      costliest(facts.rows, [](const DebriefRow& row) { return row.raw && row.lost >= kWorthSaying; });
  if (late || undone(result.grade)) return of(Kind::kUndone, loss);
  return of(loss ? Kind::kLoss : Kind::kOnward, loss);
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
  using Kind = DebriefCause::Kind;
  if (!facts.score) return ungraded_words(words, result, facts);
  const Cap* left = undone(result.grade);
  const DebriefRow* row = row_of_subscore(facts, facts.cause.subscore);
  switch (facts.cause.kind) {
    case Kind::kCritical:
      return critical_words(words, result, *first_critical(result), exercise);
    case Kind::kNotStarted:
      return words("Time ran out before the clock began: the tip did not rest in the ball at the start.");
    case Kind::kGate:
      return gate_words(words, *row, facts.counts, exercise);
    case Kind::kBeside:
      return beside_words(words, *row);
    case Kind::kNotTried: {
      const std::string said = not_tried_words(words, *row, facts.counts, exercise);
      return left ? undone_words(words, result, *left) + " " + said : said;
    }
    case Kind::kUndone:
      return left ? undone_words(words, result, *left) : words("Time ran out before the task was done.");
    default:
      return score_words(words, facts);
  }
}

std::vector<std::string> further_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                                       const Exercise& exercise) {
  using Kind = DebriefCause::Kind;
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
  const Kind kind = facts.cause.kind;
  const bool nothing_done = kind == Kind::kNotStarted;
  for (const DebriefRow& row : facts.rows)
    if (row.failed && row.subscore != facts.cause.subscore && !nothing_done)
      out.push_back(gate_words(words, row, facts.counts, exercise));
  const bool said = kind == Kind::kUndone || kind == Kind::kNotTried || nothing_done;
  if (const Cap* left = undone(result.grade); left && !said) out.push_back(undone_words(words, result, *left));
  if (result.device.force_not_rendered())
    out.push_back(
        words("The device could not give the force in {0} % of the contact time: this attempt does not count for a "
              "certificate.",
              {words.number(100 * result.device.saturated_contact_share, 0)}));
  if (!soft_real_time(result.device).empty())
    out.push_back(words("Soft real time: this computer gave the device no priority, so forces may have come late."));
  add_pauses(words, result, out);
  if (const std::string help = help_words(words, result.assists); !help.empty()) out.push_back(help);
  return out;
}

}  // namespace trocar
