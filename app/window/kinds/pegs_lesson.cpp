#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/pegs/pegs_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> pegs_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool pointer) {
  const auto& rules = own_rules<PegsRules>(e);
  const std::string grip = newtons_between(w, rules.wanted.low_n, rules.wanted.high_n);
  return {{StepIcon::kPick, w("Put the open jaws round the lit ring and its peg.")},
          {StepIcon::kSqueeze, pointer ? w("Grip it with {0}: see how far it gives way.", {grip})
                                       : w("Grip it with {0}: looser it slips, tighter it is marked.", {grip})},
          {StepIcon::kCarry, w("Lift it off, {0} high, and carry it to the lit peg.", {millimetres(w, rules.lift_m)})},
          {StepIcon::kPlace, w("Lower it over the peg, {0} or less off its middle, and let go.",
                               {millimetres(w, own_rules<PegsLevel>(level).place_tolerance_m)})}};
}

void add_pegs_limits(const Translator& w, const Exercise& e, const ExerciseLevel&, std::vector<LessonLimit>& out) {
  const auto& rules = own_rules<PegsRules>(e);
  out.push_back({w("Rings, across and back"), std::to_string(rules.rings())});
  out.push_back({w("Wanted grip"), newtons_between(w, rules.wanted.low_n, rules.wanted.high_n)});
  out.push_back({w("A ring is lost"), w("{0} beyond the board", {millimetres(w, rules.lost_margin_m)})});
}

}  // namespace

KindLesson pegs_lesson() {
  return {.kind = ExerciseKind::kPegs,
          .skill =
              [](const Translator& w) {
                return w("Skill: judging depth, and a grip that neither drops nor crushes what is carried.");
              },
          .steps = pegs_steps,
          .add_limits = add_pegs_limits,
          .display = {words("Ring {0}."), words("Hold it with {0}."), words("A little softer"),
                      words("A little tighter"), words("Take the lit ring off its peg"), words("Lower it over the peg"),
                      words("Let go when it lies on the board."), words("Carry it to the lit peg"),
                      words("Lift it well clear of the pegs."), words("Too tight - the ring is marked"),
                      words("It slips - hold it tighter"), words("It hit the peg - look where it stands"),
                      words("Dropped - pick it up again"), words("That is another peg"), words("It is not on its peg"),
                      words("Move all rings across and back"), words("Rings moved"), words("Errors")}};
}

}  // namespace trocar
