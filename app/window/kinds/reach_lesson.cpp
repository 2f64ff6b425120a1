#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"

namespace trocar {
namespace {

std::vector<LessonStep> reach_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool) {
  const std::string angle = degrees(w, level.angle_tolerance_rad);
  return {{StepIcon::kReach,
           w("Bring the tip to the lit pen, to {0} or nearer.", {millimetres(w, level.position_tolerance_m)})},
          {StepIcon::kTurn,
           level.mapping == Mapping::kFulcrum
               ? w("Roll the instrument as the pen is rolled, to {0} or nearer; the port leans it.", {angle})
               : w("Turn the instrument along it and about it, to {0} or nearer.", {angle})},
          {StepIcon::kHold, w("Hold still for {0} s; the next pen lights.", {brief(w, e.hold_s)})}};
}

void add_reach_limits(const Translator& w, const Exercise& e, const ExerciseLevel&, std::vector<LessonLimit>& out) {
  out.push_back({w("Pens"), std::to_string(e.layout.count)});
  out.push_back({w("A pen's time"), w("{0} s, then it comes back at the end", {brief(w, e.pens.timeout_s)})});
}

}  // namespace

KindLesson reach_lesson() {
  return {.kind = ExerciseKind::kReach,
          .skill =
              [](const Translator& w) {
                return w("Skill: depth from a flat picture, and turning the instrument where you want it.");
              },
          .steps = reach_steps,
          .add_limits = add_reach_limits,
          .display = {words("Pen {0}."), words("Bring the tip to the lit pen"),
                      words("Turn the instrument along the pen"), words("The tip is right."),
                      words("Match each lit pen and hold"), words("Pens matched"), words("Out of time")}};
}

}  // namespace trocar
