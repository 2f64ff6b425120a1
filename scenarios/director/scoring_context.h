// From exercise, board and events to what scoring must know; and to JSON and back for the recording.
//
// The struct itself is pure and stands in scenarios/scoring/scoring_context.h, a file of the same name. Numbers survive
// the JSON round trip to the bit.
#pragma once

#include <string>
#include <vector>

#include "scenarios/director/director.h"
#include "scenarios/exercise.h"
#include "scenarios/scoring/scoring_context.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// @param outcome how the attempt ended (Director::outcome(), or kAborted).
ScoringContext scoring_context(const Exercise& exercise, const ExerciseLevel& level, const Board& board,
                               const std::vector<Event>& events, AttemptStatus outcome);

/// What a kind whose targets are held tells of them: all asked for, those that were held done, past them the way.
void account_held_targets(const Board& board, const std::vector<Event>& events, ScoringContext& context);

/// One line of JSON. @throws std::invalid_argument when a number is not finite.
std::string scoring_context_json(const ScoringContext& context);
/// @throws InputError naming the missing or mistyped key. @param name of the source, for messages.
ScoringContext parse_scoring_context(const std::string& json, const std::string& name = "scoring context");

}  // namespace trocar
