#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/needle/needle_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> needle_steps(const Translator& w, const Exercise& e, const ExerciseLevel&, bool) {
  const NeedleRules& rules = own_rules<NeedleRules>(e);
  return {{StepIcon::kSqueeze, w("Take the needle from its stand, half to two thirds of its length from the point.")},
          {StepIcon::kReach, w("Bring the point onto the lit dot, steeply, and press it on.")},
          {StepIcon::kPress, w("Roll it about its own circle until {0} of the point stand out at the other dot.",
                               {millimetres(w, rules.tip_out_m)})},
          {StepIcon::kWithdraw, w("Let go, take it near its point, roll on and draw it out. Let go for the next.")}};
}

void add_needle_limits(const Translator& w, const Exercise&, const ExerciseLevel& level,
                       std::vector<LessonLimit>& out) {
  out.push_back({w("From dot to hole"), millimetres(w, own_rules<NeedleLevel>(level).tolerance_m)});
}

}  // namespace

KindLesson needle_lesson() {
  return {.kind = ExerciseKind::kNeedle,
          .skill = [](const Translator& w) { return w("Skill: a needle that follows its own curve."); },
          .steps = needle_steps,
          .add_limits = add_needle_limits,
          .display = {words("Let go of the needle"),
                      words("Another one stands ready."),
                      words("Take the needle"),
                      words("Half to two thirds of its length from the point."),
                      words("Go in at the lit dot"),
                      words("Lower the point onto it, then roll."),
                      words("Roll it on to the other dot"),
                      words("Follow the needle's own circle."),
                      words("Let go, take the point"),
                      words("Enough of it stands out."),
                      words("Take the needle near its point"),
                      words("Then draw it out."),
                      words("Draw it through"),
                      words("Roll on until it is out, then lift."),
                      words("Grasped at the wrong place"),
                      words("Beside the dot"),
                      words("Draw it back out, or take more care at the next one."),
                      words("Out beside the dot"),
                      words("The tissue is torn"),
                      words("Turn the needle about its circle, never across it."),
                      words("Drawn back out"),
                      words("Go in anew at the dot."),
                      words("The needle was dropped"),
                      words("Take the needle, drive it through each pair, draw it out"),
                      words("Pairs done"),
                      words("Mistakes"),
                      words("Tip force")}};
}

}  // namespace trocar
