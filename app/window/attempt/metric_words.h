// Metrics as people read them: mm, N, %, whole counts; which group of the debrief a sub-score belongs to. Pure. Thread:
// any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/window/words/translator.h"
#include "scenarios/exercise.h"

namespace trocar {

/// In the order of the debrief: safety leads, time comes last.
enum class ScoreGroup : std::uint8_t { kSafety, kAccuracy, kEconomy, kTime };
ScoreGroup group_of(const SubscoreRule& rule);
std::string group_name(const Translator& words, ScoreGroup group);

/// "312 mm", "87 %", "3", "0.62 N"; "n/a" without a value. @param metric its name, "" unknown. @param unit as in the
/// catalogue.
std::string metric_text(const Translator& words, const std::string& metric, const std::optional<double>& value,
                        const std::string& unit);
/// Is the value counted in whole numbers?
bool is_count(const std::string& metric, const std::string& unit);

/// What moved the hand, as people say it: "mouse", "gamepad", "expert"; any other name as it is.
std::string hand_words(const Translator& words, const std::string& hand);

/// The sub-score's name with a capital.
std::string subscore_words(const Translator& words, const std::string& name);

/// Of the result's level; nullptr when the exercise has no such level or sub-score (another version of it).
const ExerciseLevel* level_named(const Exercise& exercise, const std::string& level);
const SubscoreRule* rule_named(const ExerciseLevel* level, const std::string& subscore);

}  // namespace trocar
