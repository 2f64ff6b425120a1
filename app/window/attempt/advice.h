// One thing to try next, chosen by rule: what was critical, else the failed safety gate that cost most, else the
// largest loss (safety before time where two cost the same), else the next step. Pure. Thread: any.
#pragma once

#include "app/window/attempt/debrief_facts.h"

namespace trocar {

/// What the advice is about.
struct AdviceTopic {
  enum class Kind : std::uint8_t { kCritical, kGate, kLoss, kOnward, kAgain, kDevice } kind = Kind::kOnward;
  std::string metric, subscore;  ///< of kGate and kLoss
  std::string event;             ///< of kCritical
};
AdviceTopic advice_topic(const AttemptResult& result, const DebriefFacts& facts);

/// "Try next: ..."
std::string advice(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                   const Exercise& exercise);

}  // namespace trocar
