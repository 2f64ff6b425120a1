// The verdict and the one reason for it, in words; what is to be said besides. Parts of debrief_facts(). Pure. Thread:
// any.
#pragma once

#include "app/window/attempt/debrief_facts.h"

namespace trocar {

Outcome outcome_of(const AttemptResult& result);
std::string verdict_words(const Translator& words, Outcome outcome);
/// @param facts with outcome, counts, score and rows.
DebriefCause cause_of(const AttemptResult& result, const DebriefFacts& facts);
/// @param facts with all but the sentences.
std::string reason_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                         const Exercise& exercise);
/// What the reason left out: failed gates, what was undone, forces that the device could not give; why there is no
/// score.
/// @param facts with the reason.
std::vector<std::string> further_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                                       const Exercise& exercise);

/// Seconds of the exercise's clock at loop time t: from START, 0 before it.
double clock_s(const AttemptResult& result, double t_s);
const Event* first_critical(const AttemptResult& result);
/// The row of a sub-score; null without one.
const DebriefRow* row_of_subscore(const DebriefFacts& facts, const std::string& subscore);

}  // namespace trocar
