#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/gauze/gauze_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> gauze_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool) {
  const GauzeRules& rules = own_rules<GauzeRules>(e);
  return {{StepIcon::kReach, w("Bring the open blades over the lit place and roll them along the line.")},
          {StepIcon::kPress, w("Press the tips on with {0}: that lays the gauze between them.",
                               {newtons_between(w, rules.press_low_n, rules.press_high_n)})},
          {StepIcon::kSqueeze, w("Close them. A snip cuts {0} at most.", {millimetres(w, rules.step_m)})},
          {StepIcon::kHold, w("Cut in from the edge, then all round, within {0} of the line.",
                              {millimetres(w, own_rules<GauzeLevel>(level).off_m)})}};
}

void add_gauze_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                      std::vector<LessonLimit>& out) {
  out.push_back({w("From the line"), millimetres(w, own_rules<GauzeLevel>(level).off_m)});
  out.push_back({w("Most pull"), newtons(w, own_rules<GauzeRules>(e).most_pull_n)});
}

}  // namespace

KindLesson gauze_lesson() {
  return {
      .kind = ExerciseKind::kGauze,
      .skill = [](const Translator& w) { return w("Skill: cutting along a line, with small snips and little pull."); },
      .steps = gauze_steps,
      .add_limits = add_gauze_limits,
      .display = {words("Cut in from the edge"), words("Straight along the line to the circle."),
                  words("Cut along the line"), words("Open blades on the line, press a little, close."),
                  words("Off the line"), words("Lay the blades on the line before you close them."),
                  words("Too much pull on the gauze"), words("Press just enough that it lies between the blades."),
                  words("The gauze is torn"), words("Cut out the circle"), words("Line cut"), words("Press")}};
}

}  // namespace trocar
