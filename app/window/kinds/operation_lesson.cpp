#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/dissect/dissect_rules.h"
#include "scenarios/kinds/retract/retract_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> operation_steps(const Translator& w, const Exercise& e, const ExerciseLevel&, bool) {
  std::vector<LessonStep> out;
  for (const ExerciseStage& stage : e.stages) {
    const Exercise& own = *stage.exercise;
    if (own.kind == ExerciseKind::kRetract)
      out.push_back({StepIcon::kHold, w("Take the tissue at the lit disc, lift it, hold it still, and let it down.")});
    if (own.kind == ExerciseKind::kDissect && own.layout.count == own_rules<DissectRules>(own).strands)
      out.push_back({StepIcon::kWithdraw, w("With the hook, lift each lit strand clear of the liver and divide it.")});
    if (own.kind == ExerciseKind::kClip)
      out.push_back({StepIcon::kSqueeze, w("Name duct and artery by touch, clip each three times, cut between.")});
    if (own.kind == ExerciseKind::kDissect && own.layout.count > own_rules<DissectRules>(own).strands)
      out.push_back({StepIcon::kReach, w("Divide the last strands with the hook, and stop what bleeds.")});
  }
  return out;
}

void add_operation_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                          std::vector<LessonLimit>& out) {
  for (std::size_t i = 0; i < e.stages.size(); ++i) {
    const Exercise& own = *e.stages[i].exercise;
    if (own.kind == ExerciseKind::kRetract) {
      out.push_back({w("Pull"), newtons_between(w, level.stages[i].band_low_n, level.stages[i].band_high_n)});
      out.push_back({w("Lift"), millimetres(w, own_rules<RetractLevel>(level.stages[i]).lift_m)});
    }
    if (own.kind == ExerciseKind::kDissect && i + 1 == e.stages.size())
      out.push_back({w("Live tip off the liver"), millimetres(w, own_rules<DissectRules>(own).near_m)});
  }
}

}  // namespace

KindLesson operation_lesson() {
  return {.kind = ExerciseKind::kOperation,
          .skill = [](const Translator& w) { return w("Skill: one thing after the other, each as safely as alone."); },
          .steps = operation_steps,
          .add_limits = add_operation_limits,
          .display = {words("Take the grasper"), words("Take the hook"), words("Take the clip applier"),
                      words("Take the scissors"), words("Take the probe"), words("Take the suction"),
                      words("Take the needle driver"), words("Draw back and exchange the instrument."),
                      words("Retract, dissect, clip and cut, detach"), words("Retract"), words("Free the triangle"),
                      words("Clip and cut"), words("Detach"), words("Mistakes")}};
}

}  // namespace trocar
