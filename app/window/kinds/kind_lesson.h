// What the window says of a kind of exercise before it begins: one table, one source a kind. Pure. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "app/window/lessons/lesson_words.h"

namespace trocar {

struct KindLesson {
  ExerciseKind kind;
  std::string (*skill)(const Words&);
  /// After the rest at the start.
  std::vector<LessonStep> (*steps)(const Words&, const Exercise&, const ExerciseLevel&);
  /// What only this kind limits.
  void (*add_limits)(const Words&, const Exercise&, const ExerciseLevel&, std::vector<LessonLimit>&);
};

const KindLesson& lesson_of(const Exercise&);

KindLesson reach_lesson();
KindLesson touch_lesson();
KindLesson grasp_lesson();

}  // namespace trocar
