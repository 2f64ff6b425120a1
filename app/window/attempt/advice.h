// What happened, counted, and one thing to try next: by the cause that the reason names. For the input in hand: mouse,
// keys and pad feel nothing, so they are told what to look at. Pure. Thread: any.
#pragma once

#include "app/window/attempt/debrief_facts.h"

namespace trocar {

/// "8 times beside the disc. Try next: ..."
std::string advice(const Translator& words, const AttemptResult& result, const DebriefFacts& facts,
                   const Exercise& exercise);

}  // namespace trocar
