// Metrics as people read them: mm, N, %, whole counts; which group of the debrief a sub-score belongs to. Pure. Thread:
// any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/window/words/translator.h"
#include "scenarios/exercise.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// In the order of the debrief: safety leads, time comes last.
enum class ScoreGroup : std::uint8_t { kSafety, kAccuracy, kMotion, kTime };
ScoreGroup group_of(const SubscoreRule& rule);
std::string group_name(const Translator& words, ScoreGroup group);

/// The share of the wanted force or grip: by object, or all together as in older rubrics.
bool is_band_share(const std::string& metric);
bool is_window_share(const std::string& metric);
/// "312 mm", "87 %", "3", "0.62 N"; "n/a" without a value. @param metric its name, "" unknown. @param unit as in the
/// catalogue.
std::string metric_text(const Translator& words, const std::string& metric, const std::optional<double>& value,
                        const std::string& unit);
/// The metric at which a gate opens: "at most 3". @param floor share of the sub-score that meets it.
std::string needed_text(const Translator& words, const std::string& metric, const std::string& unit, double full_at,
                        double zero_at, double floor);
/// Is the value counted in whole numbers?
bool is_count(const std::string& metric, const std::string& unit);

/// What moved the hand, as people say it: "mouse", "gamepad", "expert"; any other name as it is.
std::string hand_words(const Translator& words, const std::string& hand);

/// The sub-score's name with a capital.
std::string subscore_words(const Translator& words, const std::string& name);

/// Of the result's level; nullptr when the exercise has no such level or sub-score (another version of it).
const ExerciseLevel* level_named(const Exercise& exercise, const std::string& level);
const SubscoreRule* rule_named(const ExerciseLevel* level, const std::string& subscore);

/// What a good hand takes at the input of the result, s; 0 unknown.
double model_time_s(const ExerciseLevel& level, const AttemptResult& result);

}  // namespace trocar
