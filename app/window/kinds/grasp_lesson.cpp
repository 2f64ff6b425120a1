#include <algorithm>

#include "app/window/attempt/metric_words.h"
#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"

namespace trocar {
namespace {

std::vector<LessonStep> grasp_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool pointer) {
  const std::string grip = level.grasp.colour_cue
                               ? w("Grip it: bands round a block tell its foam, one the softest, three the hardest.")
                           : pointer ? w("Grip it: no colour tells the foam, see how far it gives way.")
                                     : w("Grip it: no colour tells the foam, feel how hard it is.");
  return {{StepIcon::kPick, w("Put the open jaws round the lit block.")},
          {StepIcon::kSqueeze, grip},
          {StepIcon::kCarry, w("Lift it {0} and carry it to its ring.", {millimetres(w, e.grasp.lift_m)})},
          {StepIcon::kPlace,
           w("Set it down, its middle {0} or less from the ring's.", {millimetres(w, level.grasp.place_tolerance_m)})}};
}

void add_grasp_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                      std::vector<LessonLimit>& out) {
  out.push_back({w("Blocks"), std::to_string(e.layout.count)});
  if (level.grasp.colour_cue) {
    int bands = 0;
    for (const FoamKind& kind : e.grasp.kinds) {
      const GripWindow window = grip_window(kind, level.grasp);
      out.push_back(
          {w("Bands {0}: wanted grip", {std::to_string(++bands)}), newtons_between(w, window.low_n, window.high_n)});
    }
  }
  const auto& rules = level.rubric.subscores;
  const auto gate =
      std::find_if(rules.begin(), rules.end(), [](const SubscoreRule& r) { return r.gate && r.metric == "crushed"; });
  out.push_back({w("Crushed blocks"), gate == rules.end()
                                          ? w("fewer than {0}", {std::to_string(e.grasp.critical_crushed)})
                                          : w("{0} for a pass", {needed_text(w, "crushed", "1", gate->full_at,
                                                                             gate->zero_at, gate->gate_below)})});
}

}  // namespace

KindLesson grasp_lesson() {
  return {
      .kind = ExerciseKind::kGrasp,
      .skill =
          [](const Translator& w) {
            return w("Skill: a grip that holds and does not hurt, lifted and set down gently.");
          },
      .steps = grasp_steps,
      .add_limits = add_grasp_limits,
      .display = {words("Block {0}."), words("Hold it with {0}."), words("A little tighter"),
                  words("Pick up the lit block"), words("Set it down within the ring"), words("Let go when it stands."),
                  words("Carry it to its ring"), words("Lift it well clear of the others."),
                  words("Crushed - hold it more gently"), words("It slips - hold it tighter"),
                  words("Dropped - pick it up again"), words("Lift it higher on the way"),
                  words("Carry each lit block to its ring"), words("Blocks placed"), words("Errors")}};
}

}  // namespace trocar
