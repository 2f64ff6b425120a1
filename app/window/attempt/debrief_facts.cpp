#include "app/window/attempt/debrief_facts.h"

#include <algorithm>
#include <cmath>

#include "app/window/attempt/debrief_reason.h"
#include "scenarios/scoring/event_types.h"
#include "scenarios/scoring/metrics.h"
#include "trainees/progress/learning_curve.h"

namespace trocar {
namespace {

std::string own_text(const Translator& words, const DebriefRow& row, const std::optional<double>& value) {
  return value ? metric_text(words, row.metric, value, row.unit) : "";
}

void compare(const Translator& words, DebriefRow& row, const Subscore& s, const DebriefPast& past) {
  const bool less = s.full_at < s.zero_at;
  const OwnValues own = own_values(past.own, row.metric, less);
  row.best = own_text(words, row, own.best);
  row.median = own_text(words, row, own.median);
  if (const auto at = past.expert.find(row.metric); at != past.expert.end())
    row.expert = own_text(words, row, at->second);
  if (!own.median || !s.raw || row.value == row.median) return;
  row.against_median = (*s.raw < *own.median) == less ? 1 : -1;
}

DebriefRow row_of(const Translator& words, const Subscore& s, const ExerciseLevel* level, const DebriefPast& past) {
  const SubscoreRule* rule = rule_named(level, s.name);
  SubscoreRule stand_in;
  stand_in.gate = s.gate;
  if (s.name == "time") stand_in.metric = "time_s";
  DebriefRow row;
  row.subscore = s.name;
  row.metric = rule ? rule->metric : stand_in.metric;
  row.unit = s.unit;
  if (const MetricDefinition* metric = find_metric(row.metric); metric && row.unit.empty()) row.unit = metric->unit;
  row.group = group_of(rule ? *rule : stand_in);
  if (s.raw && std::isfinite(*s.raw)) row.raw = s.raw;
  row.name = subscore_words(words, s.name);
  row.value = metric_text(words, row.metric, s.raw, row.unit);
  row.full = metric_text(words, row.metric, s.full_at, row.unit);
  row.none = metric_text(words, row.metric, s.zero_at, row.unit);
  row.gate = s.gate;
  const double floor = rule ? rule->gate_below : SubscoreRule{}.gate_below;
  row.failed = s.gate && s.value < floor;
  if (s.gate) row.needed = needed_text(words, row.metric, row.unit, s.full_at, s.zero_at, floor);
  row.possible = 100 * s.weight;
  row.lost = 100 * s.weight * (1 - s.value);
  compare(words, row, s, past);
  return row;
}

void add_rows(const Translator& words, DebriefFacts& facts, const AttemptResult& result, const ExerciseLevel* level,
              const DebriefPast& past) {
  double lost = 0;
  for (const Subscore& s : result.grade.subscores) {
    facts.rows.push_back(row_of(words, s, level, past));
    lost += facts.rows.back().lost;
  }
  std::stable_sort(facts.rows.begin(), facts.rows.end(), [](const DebriefRow& a, const DebriefRow& b) {
    return a.group != b.group ? a.group < b.group : a.lost > b.lost;
  });
  facts.lost_to_caps = std::max(0.0, 100 - *facts.score - lost);
}

}  // namespace

DebriefFacts debrief_facts(const Translator& words, const AttemptResult& result, const Exercise& exercise,
                           const DebriefPast& past) {
  const ExerciseLevel* level = level_named(exercise, result.level);
  DebriefFacts facts;
  facts.score = result.grade.score;
  facts.pass_at = level ? level->rubric.pass_at : exercise.rubric.pass_at;
  facts.outcome = outcome_of(result);
  facts.verdict = verdict_words(words, facts.outcome);
  facts.counts = counted(result.events);
  if (facts.score) add_rows(words, facts, result, level, past);
  facts.cause = cause_of(result, facts);
  facts.reason = reason_words(words, result, facts, exercise);
  facts.more = further_words(words, result, facts, exercise);
  return facts;
}

std::vector<std::string> explained(const Translator& words, const DebriefRow& row, const AttemptResult& result,
                                   const Exercise& exercise) {
  const ExerciseLevel* level = level_named(exercise, result.level);
  const SubscoreRule* rule = rule_named(level, row.subscore);
  std::vector<std::string> out;
  if (const MetricDefinition* metric = find_metric(row.metric))
    out.push_back(words("Measured: {0}.", {words.made(metric->meaning)}));
  out.push_back(words("Points: {0} x clamp((value - {1}) / ({2} - {1}), 0, 1). All at {2}, none at {1}.",
                      {words.number(row.possible, 0), row.none, row.full}));
  out.push_back(words("Here: {0}, so {1} of {2} points.",
                      {row.value, words.number(row.possible - row.lost, 1), words.number(row.possible, 0)}));
  if (row.gate && rule)
    out.push_back(words("Safety gate: a pass needs {0}; without it the score is {1} or less.",
                        {row.needed, words.number(level->rubric.gate_cap, 0)}));
  const double model_s = level ? model_time_s(*level, result) : 0;
  if (row.metric == "time_s" && model_s > 0)
    out.push_back(words(
        result.device.without_device() ? "A practised hand takes {0} s." : "The expert hand takes {0} s on average.",
        {words.number(model_s, 1)}));
  if (!row.metric.empty()) out.push_back(words("Its name in exports: {0}.", {row.metric}));
  return out;
}

std::string event_words(const Translator& words, const Event& event) {
  const std::string& type = event.type;
  if (type == event_type::kExcessForce) return words("Too much force");
  if (type == event_type::kCriticalForce) return words("Critical force");
  if (type == event_type::kGripExcess) return words("Grip too hard");
  if (type == event_type::kWrongPlace) return words("Wrong place");
  if (type == event_type::kTargetHeld) return words("Target held");
  if (type == event_type::kTargetTimeout) return words("Time for this target over");
  if (type == event_type::kToolCollision) return words("Shaft pressed on tissue");
  if (type == event_type::kGripHeld) return words("Grip held");
  if (type == event_type::kCrush) return words("Block crushed");
  if (type == event_type::kSlip) return words("Slipped through the jaws");
  if (type == event_type::kDrop) return words("Dropped");
  if (type == event_type::kLost) return words("Lost outside the field");
  if (type == event_type::kPlaced) return words("Block placed");
  if (type == event_type::kMisplaced) return words("Set down elsewhere");
  if (type == event_type::kBump) return words("Hit a peg");
  if (type == event_type::kWireTouched) return words("Wire touched");
  if (type == event_type::kRingOff) return words("Ring off the wire");
  if (type == event_type::kRegrasp) return words("Grasped again");
  if (type == event_type::kWrongBlock) return words("Wrong block");
  if (type == event_type::kRemoved) return words("Placed block taken away");
  if (type == event_type::kExposed) return words("Lifted far enough");
  if (type == event_type::kCovered) return words("Sank back");
  if (type == event_type::kLetGo) return words("Let go too early");
  if (type == event_type::kAnswered) return words("Symbol told");
  if (type == event_type::kWrongAnswer) return words("Wrong answer");
  if (type == event_type::kWallContact) return words("Lens touched");
  if (type == event_type::kHorizonLost) return words("Horizon lost");
  if (type == event_type::kNoduleFound) return words("Nodule found");
  if (type == event_type::kFalseMark) return words("False mark");
  if (type == event_type::kSearchEnded) return words("Search ended");
  if (type == event_type::kSnip) return words("Snip");
  if (type == event_type::kOffLine) return words("Cut off the line");
  if (type == event_type::kPulledHard) return words("Gauze pulled too hard");
  if (type == event_type::kGauzeTorn) return words("Gauze torn");
  if (type == event_type::kNamed) return words("Named by touch");
  if (type == event_type::kClipSet) return words("Clip set");
  if (type == event_type::kClipWasted) return words("Clip wasted");
  if (type == event_type::kWrongStructure) return words("Wrong structure");
  if (type == event_type::kDivided) return words("Divided");
  if (type == event_type::kCutTooSoon) return words("Cut without enough clips");
  if (type == event_type::kNeedleGripped) return words("Needle grasped");
  if (type == event_type::kBiteBegun) return words("Point in");
  if (type == event_type::kBiteThrough) return words("Point out");
  if (type == event_type::kBiteUndone) return words("Drawn back out");
  if (type == event_type::kNeedleDrawn) return words("Needle drawn through");
  if (type == event_type::kNeedleLost) return words("Needle dropped");
  if (type == event_type::kStageBegun) return words("Stage begun");
  if (type == event_type::kStrandLifted) return words("Strand lifted");
  if (type == event_type::kStrandDivided) return words("Strand divided");
  if (type == event_type::kUnsafeCurrent) return words("Unsafe current");
  if (type == event_type::kSpurts) return words("Vessels spurt");
  if (type == event_type::kSealed) return words("Vessel sealed");
  if (type == event_type::kSealedLate) return words("Bled for too long");
  if (type == event_type::kPerforated) return words("Cut into the liver");
  if (type == event_type::kPortHold) return words("Too close to the port");
  if (type == event_type::kDeadmanOpen) return words("Deadman opened");
  if (type == event_type::kMarked) return words("Marked by you");
  if (type == event_type::kMessage) return words("Message from your teacher");
  if (type == event_type::kDeviceFault) return words("Device stopped");
  if (type == event_type::kTimeout) return words("Time over");
  return "";
}

}  // namespace trocar
