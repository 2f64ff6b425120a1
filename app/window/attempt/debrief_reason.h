// The verdict and the one reason for it, in words; what is to be said besides. Parts of debrief_facts(). Pure. Thread:
// any.
#pragma once

#include "app/window/attempt/debrief_facts.h"

namespace trocar {

Outcome outcome_of(const AttemptResult& result);
std::string verdict_words(const Translator& words, Outcome outcome);
/// One sentence. @param facts with score and rows.
std::string reason_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                         const Exercise& exercise);
/// What the reason left out: failed gates, what was undone, forces that the device could not give; why there is no
/// score.
std::vector<std::string> further_words(const Translator& words, const AttemptResult& result, const DebriefFacts& facts);

/// Seconds of the exercise's clock at loop time t: from START, 0 before it.
double clock_s(const AttemptResult& result, double t_s);
const Event* first_critical(const AttemptResult& result);
/// The row that cost most; safety before time where two cost the same. Null below half a point.
const DebriefRow* largest_loss(const std::vector<DebriefRow>& rows);
/// The failed gate that cost most; null without one.
const DebriefRow* worst_gate(const std::vector<DebriefRow>& rows);

}  // namespace trocar
