// What the debrief says of an attempt: verdict, the one reason, every sub-score with the points that it cost. No
// drawing.
//
// Points lost: 100 w (1 - s) each; what caps took on top is lost_to_caps, so that all of it is 100 - score.
// One cause stands behind reason and advice, so that they never disagree: a critical event, else that the clock never
// began, else the failed safety gate that cost most, else what was left undone, else the largest loss. What has no
// value is no cause: then it is what was never tried. Force is not judged where the discs were missed. Pure. Thread:
// any.
#pragma once

#include <map>

#include "app/window/attempt/event_counts.h"
#include "app/window/attempt/metric_words.h"
#include "scenarios/scoring/attempt_result.h"
#include "trainees/progress/past_attempts.h"

namespace trocar {

enum class Outcome : std::uint8_t { kPass, kNotYet, kStopped, kDeviceStopped, kVoid };

/// Why the attempt is no better than it is.
struct DebriefCause {
  enum class Kind : std::uint8_t {
    kCritical,
    kNotStarted,  ///< the clock never began: time ran out, or it is void
    kGate,        ///< failed, with a value
    kBeside,      ///< force failed its gate, but the discs were missed at least as badly
    kNotTried,    ///< a gate has no value: nothing was done that it could judge
    kUndone,
    kLoss,    ///< a pass, or a score below it: what cost most
    kOnward,  ///< nothing to speak of
    kAgain,   ///< left, or cut off
    kDevice,  ///< stopped, or no record to grade
    kDeadman  ///< opened while the clock ran
  } kind = Kind::kOnward;
  std::string metric = {}, subscore = {};  ///< of the row; of kUndone the largest loss, empty without one
  std::string event = {};                  ///< of kCritical
};

struct DebriefRow {
  ScoreGroup group = ScoreGroup::kAccuracy;
  std::string subscore, metric, unit;   ///< names as in the rubric; metric "" when the rubric is another one
  std::optional<double> raw = {};       ///< the metric; nothing: it has no value
  std::string name, value, full, none;  ///< texts: what it is called, was, what earns all, what earns nothing
  std::string best, median, expert;     ///< own attempts before this one, the expert's; "" unknown
  bool gate = false, failed = false;    ///< safety gate; below its floor
  std::string needed;                   ///< of a gate: "at most 3"
  double lost = 0, possible = 0;        ///< points
  int against_median = 0;               ///< better 1, worse -1, the same or unknown 0
};

struct DebriefFacts {
  Outcome outcome = Outcome::kStopped;
  DebriefCause cause;
  EventCounts counts;
  std::string verdict, reason;    ///< "NOT YET"; one sentence, two where the first needs one
  std::vector<std::string> more;  ///< further caps, and what is honest to say: a sentence each
  std::optional<double> score;
  double pass_at = 0;
  std::vector<DebriefRow> rows;  ///< safety, accuracy, motion, time; within a group what cost most first
  double lost_to_caps = 0;
};

/// What there is to compare with.
struct DebriefPast {
  std::vector<PastAttempt> own = {};          ///< comparable ones, without this one
  std::map<std::string, double> expert = {};  ///< the expert's metrics on the same board
};

DebriefFacts debrief_facts(const Translator& words, const AttemptResult& result, const Exercise& exercise,
                           const DebriefPast& past = {});

/// One row explained: what is measured, formula with its anchors, weight, gate; a sentence each.
std::vector<std::string> explained(const Translator& words, const DebriefRow& row, const AttemptResult& result,
                                   const Exercise& exercise);

/// "Excess force" of EXCESS_FORCE; "" for what a trainee need not see in a plot (a target was lit).
std::string event_words(const Translator& words, const Event& event);

}  // namespace trocar
