// What a trainee reads of an exercise before it begins: skill, steps, limits, what is measured, display mode, tools,
// scope.
//
// `pointer`: done at mouse, keys or pad, without a device; it feels nothing and has a rubric of its own.
// All from the exercise as it was loaded, so that no sentence can differ from what is run and graded. Pure. Thread:
// any.
#pragma once

#include <string>
#include <vector>

#include "app/window/words/translator.h"
#include "scenarios/exercise.h"

namespace trocar {

/// Pictures of steps, drawn by lesson_icons.h.
enum class StepIcon : std::uint8_t { kRest, kReach, kTurn, kHold, kPress, kSqueeze, kPick, kCarry, kPlace, kWithdraw };

struct LessonStep {
  StepIcon icon = StepIcon::kRest;
  std::string text;
};

/// One row of the table of limits: "too much force", "above 1.5 N".
struct LessonLimit {
  std::string what, value;
};

/// One sub-score as it is explained: the same as `trocar exercises --explain`.
struct LessonMeasure {
  std::string name;        ///< of the sub-score: "force in band"
  std::string weight;      ///< "35 %"
  std::string full, none;  ///< "80 %", "2.5 s": values of the metric that earn all and nothing
  std::string metric;      ///< "object_in_band_share"
  std::string meaning;     ///< what the metric is
  std::string gate;        ///< what a bad value does to the whole score; empty: nothing
};

std::string lesson_skill(const Translator& words, const Exercise& exercise);
/// 3 to 6 steps.
std::vector<LessonStep> lesson_steps(const Translator& words, const Exercise& exercise, const ExerciseLevel& level,
                                     bool pointer = false);
std::vector<LessonLimit> lesson_limits(const Translator& words, const Exercise& exercise, const ExerciseLevel& level);
std::vector<LessonMeasure> lesson_measures(const Translator& words, const ExerciseLevel& level, bool pointer = false);
/// "Score = 100 x sum of weight x ...; pass from 75": the rule beneath the table.
std::string lesson_rule(const Translator& words, const Rubric& rubric);
/// The display mode and what it means.
std::string lesson_display(const Translator& words, const Exercise& exercise, const ExerciseLevel& level,
                           bool pointer = false);
std::string lesson_tool(const Translator& words, const Exercise& exercise, const ExerciseLevel& level,
                        bool pointer = false);
/// @param degrees of its tip, "0" or "30". @param post_left,post_right names of the keys that turn its light post.
std::string lesson_scope(const Translator& words, const std::string& degrees, const std::string& post_left,
                         const std::string& post_right);

/// "E02 Surface touch - L1".
std::string lesson_title(const Translator& words, const Exercise& exercise, const std::string& level);

}  // namespace trocar
