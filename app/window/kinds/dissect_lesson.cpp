#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/dissect/dissect_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> dissect_steps(const Translator& w, const Exercise& e, const ExerciseLevel&, bool) {
  const DissectRules& rules = own_rules<DissectRules>(e);
  return {{StepIcon::kReach, w("Slide the foot of the hook under the lit strand, from the side.")},
          {StepIcon::kWithdraw, w("Lift it until the hook is {0} clear of the liver.", {millimetres(w, rules.lift_m)})},
          {StepIcon::kHold, w("Only then press the pedal, until the strand parts. Let go at once.")},
          {StepIcon::kSqueeze, w("Then set the tip on each spurting vessel and keep the pedal down until it is dry.")}};
}

void add_dissect_limits(const Translator& w, const Exercise& e, const ExerciseLevel&, std::vector<LessonLimit>& out) {
  const DissectRules& rules = own_rules<DissectRules>(e);
  out.push_back({w("Live tip off the liver"), millimetres(w, rules.near_m)});
  out.push_back({w("To seal a vessel"), w("{0} s", {w.number(rules.seal_s, 0)})});
}

}  // namespace

KindLesson dissect_lesson() {
  return {
      .kind = ExerciseKind::kDissect,
      .skill = [](const Translator& w) { return w("Skill: current only where you see it and nothing else is near."); },
      .steps = dissect_steps,
      .add_limits = add_dissect_limits,
      .display = {words("Hook the lit strand"),
                  words("Slide the foot of the hook under it from the side."),
                  words("Lift the strand"),
                  words("Clear of the liver before any current."),
                  words("Divide the strand"),
                  words("Press the pedal until it parts, then let go."),
                  words("Stop the bleeding"),
                  words("Set the tip on the spurting vessel and press the pedal."),
                  words("Good - hold"),
                  words("Keep the pedal down until it is dry."),
                  words("Current too near to the liver"),
                  words("Lift before you press the pedal."),
                  words("Current out of view"),
                  words("Press the pedal only where you see the hook."),
                  words("A strand tore"),
                  words("Lift gently, and let the current divide it."),
                  words("Divided too low"),
                  words("Lift the strand clear of the liver first."),
                  words("It bleeds for too long"),
                  words("Press the tip on it and keep the pedal down."),
                  words("The hook has cut into the liver"),
                  words("Never draw the live hook over it."),
                  words("Divide the strands, then stop the bleeding"),
                  words("Strands divided"),
                  words("Vessels sealed"),
                  words("Lifted"),
                  words("Mistakes"),
                  words("Force")}};
}

}  // namespace trocar
