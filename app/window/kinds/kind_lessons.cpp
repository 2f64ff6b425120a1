#include <algorithm>

#include "app/window/kinds/kind_lesson.h"

namespace trocar {

const KindLesson& lesson_of(const Exercise& exercise) {
  static const std::vector<KindLesson> lessons{reach_lesson(), touch_lesson(), grasp_lesson()};
  return *std::find_if(lessons.begin(), lessons.end(),
                       [&](const KindLesson& lesson) { return lesson.kind == exercise.kind; });
}

}  // namespace trocar
