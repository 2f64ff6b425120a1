#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/retract/retract_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> retract_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool) {
  return {{StepIcon::kReach, w("Bring the open jaws to the lit disc and press them on a little.")},
          {StepIcon::kSqueeze,
           w("Close them and grip with {0}.",
             {newtons_between(w, own_rules<RetractRules>(e).grip_low_n, own_rules<RetractRules>(e).grip_high_n)})},
          {StepIcon::kWithdraw, w("Lift the tissue until four fifths of what lies behind it are exposed.")},
          {StepIcon::kHold, w("Hold it so for {0} s with a pull of {1}; it breathes.",
                              {brief(w, e.hold_s), newtons_between(w, level.band_low_n, level.band_high_n)})},
          {StepIcon::kPress, w("Let it down before you let it go.")}};
}

void add_retract_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                        std::vector<LessonLimit>& out) {
  out.push_back({w("Wanted pull"), newtons_between(w, level.band_low_n, level.band_high_n)});
  out.push_back({w("Lift"), millimetres(w, own_rules<RetractLevel>(level).lift_m)});
  out.push_back({w("Wanted grip"),
                 newtons_between(w, own_rules<RetractRules>(e).grip_low_n, own_rules<RetractRules>(e).grip_high_n)});
}

}  // namespace

KindLesson retract_lesson() {
  return {
      .kind = ExerciseKind::kRetract,
      .skill = [](const Translator& w) { return w("Skill: showing what lies behind, and sparing what you hold."); },
      .steps = retract_steps,
      .add_limits = add_retract_limits,
      .display = {words("Take the tissue at the lit disc"), words("Open jaws on it, press a little, close."),
                  words("Take it again"), words("It was lost: hold it tighter, and calmly."),
                  words("It slips - hold it tighter"), words("Pull with {0}."), words("Hold it tighter"),
                  words("Grip with {0}."), words("A little softer"), words("A little more"), words("Lift it further"),
                  words("Let it down and let go"), words("Slowly, until it lies as before."), words("Good - hold"),
                  words("Take, lift and hold the tissue"), words("Let it down"), words("Exposed"), words("Holds lost"),
                  words("Pull")}};
}

}  // namespace trocar
