#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/palpate/palpate_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> palpate_steps(const Translator& w, const Exercise& e, const ExerciseLevel&, bool pointer) {
  const PalpateRules& rules = own_rules<PalpateRules>(e);
  return {{StepIcon::kPress, w("Press the region point by point with {0}, from above.",
                               {newtons_between(w, rules.press_low_n, rules.press_high_n)})},
          {StepIcon::kReach, pointer ? w("See how far it gives way under the same force: less where a nodule is.")
                                     : w("Feel how far it gives way: less where a nodule is.")},
          {StepIcon::kSqueeze,
           w("Mark the hardest place: keep the tip on it and pinch for {0} s.", {brief(w, rules.mark_hold_s)})},
          {StepIcon::kWithdraw, w("The last mark ends the search; a pinch in the start ball ends it sooner.")}};
}

void add_palpate_limits(const Translator& w, const Exercise& e, const ExerciseLevel&, std::vector<LessonLimit>& out) {
  const PalpateRules& rules = own_rules<PalpateRules>(e);
  out.push_back({w("Nodules, and marks"), std::to_string(rules.nodules.size())});
  out.push_back({w("Wanted force"), newtons_between(w, rules.press_low_n, rules.press_high_n)});
  out.push_back({w("A mark is right"), w("up to {0} beside a nodule", {millimetres(w, rules.hit_m)})});
}

}  // namespace

KindLesson palpate_lesson() {
  return {.kind = ExerciseKind::kPalpate,
          .skill =
              [](const Translator& w) {
                return w("Skill: searching without a gap, and telling hard from soft with little force.");
              },
          .steps = palpate_steps,
          .add_limits = add_palpate_limits,
          .display = {words("Too hard - ease off"), words("Keep to {0}."), words("Marked"), words("Found"),
                      words("Nothing there"), words("Marks: {0} of {1}."), words("Ending the search"), words("Marking"),
                      words("Keep still and keep the pinch."), words("Is it harder here than beside it?"),
                      words("Pinch to mark the place."), words("Feel for what is hidden"),
                      words("Feel the region and mark what is hidden"), words("Marks set"), words("False marks"),
                      words("Too much force"), words("Tip force")}};
}

}  // namespace trocar
