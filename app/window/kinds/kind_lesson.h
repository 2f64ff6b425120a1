// What the window says of a kind of exercise before it begins: one table, one source a kind. Pure. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "app/window/lessons/lesson_words.h"

namespace trocar {

struct KindLesson {
  ExerciseKind kind;
  std::string (*skill)(const Translator&);
  /// After the rest at the start. @param pointer without a device: nothing is felt.
  std::vector<LessonStep> (*steps)(const Translator&, const Exercise&, const ExerciseLevel&, bool pointer);
  /// What only this kind limits.
  void (*add_limits)(const Translator&, const Exercise&, const ExerciseLevel&, std::vector<LessonLimit>&);
  /// What director and display say in it: for the check of the catalogues, which finds sentences by "words".
  std::vector<const char*> display;
};

const std::vector<KindLesson>& all_lessons();
const KindLesson& lesson_of(const Exercise&);

constexpr const char* words(const char* sentence) { return sentence; }

}  // namespace trocar
