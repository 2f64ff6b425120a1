#include <numbers>

#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/find/find_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> find_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool) {
  const FindRules& rules = own_rules<FindRules>(e);
  return {
      {StepIcon::kReach, w("Bring the open jaws to the lit disc and press them on a little.")},
      {StepIcon::kSqueeze,
       w("Close them and grip with {0}.", {newtons_between(w, rules.grip_low_n, rules.grip_high_n)})},
      {StepIcon::kWithdraw, w("Swing the flap up and back until the pin beneath it shows its symbol.")},
      {StepIcon::kHold, w("Hold it so for {0} s with a pull of {1}, and read the symbol.",
                          {brief(w, e.hold_s), newtons_between(w, level.band_low_n, level.band_high_n)})},
      {StepIcon::kPress, w("Keep the tip in the ball with the same symbol for {0} s. An answer before that is wrong.",
                           {brief(w, rules.answer_hold_s)})}};
}

void add_find_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                     std::vector<LessonLimit>& out) {
  const FindRules& rules = own_rules<FindRules>(e);
  out.push_back({w("Wanted pull"), newtons_between(w, level.band_low_n, level.band_high_n)});
  out.push_back({w("Lift"), brief(w, rules.seen_rad * 180 / std::numbers::pi) + " °"});
  out.push_back({w("Wanted grip"), newtons_between(w, rules.grip_low_n, rules.grip_high_n)});
}

}  // namespace

KindLesson find_lesson() {
  return {
      .kind = ExerciseKind::kFind,
      .skill = [](const Translator& w) { return w("Skill: lifting thin tissue to look beneath it, and sparing it."); },
      .steps = find_steps,
      .add_limits = add_find_limits,
      .display = {words("Take the flap at the lit disc"),
                  words("Open jaws on it, press a little, close."),
                  words("Take it again"),
                  words("It was lost: hold it tighter, and calmly."),
                  words("It slips - hold it tighter"),
                  words("Pull with {0}."),
                  words("Hold it tighter"),
                  words("Grip with {0}."),
                  words("A little softer"),
                  words("A little more"),
                  words("Lift it further"),
                  words("Let it down and let go"),
                  words("Slowly, until it lies as before."),
                  words("Read the symbol and hold"),
                  words("Which symbol was it?"),
                  words("Keep the tip in the ball that shows it."),
                  words("That was wrong"),
                  words("Now the flap at the next disc."),
                  words("Lift the flap and read what lies beneath"),
                  words("Symbols told"),
                  words("Exposed"),
                  words("Holds lost"),
                  words("Pull")}};
}

}  // namespace trocar
