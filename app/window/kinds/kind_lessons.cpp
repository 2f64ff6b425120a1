#include <algorithm>

#include "app/window/kinds/kind_lesson.h"

namespace trocar {

// One each of this folder's sources.
KindLesson reach_lesson();
KindLesson touch_lesson();
KindLesson grasp_lesson();
KindLesson camera_lesson();
KindLesson wire_lesson();
KindLesson gauze_lesson();
KindLesson find_lesson();
KindLesson retract_lesson();
KindLesson palpate_lesson();
KindLesson clip_lesson();
KindLesson dissect_lesson();
KindLesson pegs_lesson();
KindLesson needle_lesson();
KindLesson operation_lesson();

const std::vector<KindLesson>& all_lessons() {
  static const std::vector<KindLesson> lessons{reach_lesson(),   touch_lesson(),    grasp_lesson(), camera_lesson(),
                                               pegs_lesson(),    wire_lesson(),     find_lesson(),  retract_lesson(),
                                               palpate_lesson(), clip_lesson(),     gauze_lesson(), needle_lesson(),
                                               dissect_lesson(), operation_lesson()};
  return lessons;
}

const KindLesson& lesson_of(const Exercise& exercise) {
  return *std::find_if(all_lessons().begin(), all_lessons().end(),
                       [&](const KindLesson& lesson) { return lesson.kind == exercise.kind; });
}

}  // namespace trocar
