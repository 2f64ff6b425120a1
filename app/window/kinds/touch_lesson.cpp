#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"

namespace trocar {
namespace {

std::vector<LessonStep> touch_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool) {
  const std::string force = level.bands.size() == 1
                                ? newtons_between(w, level.bands.front().low_n, level.bands.front().high_n)
                                : w("the force that its message names");
  return {{StepIcon::kReach, w("Bring the tip to the lit disc from above.")},
          {StepIcon::kPress, w("Press it with {0}.", {force})},
          {StepIcon::kHold, w("Hold for {0} s without a break; the next disc lights.", {brief(w, e.hold_s)})},
          {StepIcon::kWithdraw, w("Draw back before you go on: no dragging over tissue.")},
          {StepIcon::kSqueeze, w("Last, squeeze the block between the jaws with {0} for {1} s.",
                                 {newtons_between(w, e.grip.low_n, e.grip.high_n), brief(w, e.grip.hold_s)})}};
}

void add_touch_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                      std::vector<LessonLimit>& out) {
  std::string wanted;
  for (const WantedForce& one : level.bands) {
    const std::string said = newtons_between(w, one.low_n, one.high_n);
    wanted = wanted.empty() ? said : w("{0} or {1}", {wanted, said});
  }
  if (level.bands.size() == 1)
    out.push_back({w("Wanted force"), wanted});
  else
    out.push_back({w("Wanted force; the message of each disc names its own"), wanted});
  out.push_back({w("Discs"), std::to_string(e.layout.count)});
  out.push_back(
      {w("Wrong place"), w("touch begins over {0} outside the disc", {millimetres(w, e.layout.wrong_place_m)})});
}

}  // namespace

KindLesson touch_lesson() {
  return {.kind = ExerciseKind::kTouch,
          .skill =
              [](const Translator& w) { return w("Skill: touching where you mean to, with a force that you choose."); },
          .steps = touch_steps,
          .add_limits = add_touch_limits,
          .display = {words("Too hard - ease off"),
                      words("Keep to {0}."),
                      words("Wrong place"),
                      words("Lift off and touch inside the lit disc."),
                      words("Touch the lit disc"),
                      words("Disc {0}: {1}."),
                      words("Move onto the lit disc"),
                      words("The tip is beside it."),
                      words("Hold the force steady"),
                      words("Wanted: {0}."),
                      words("Press gently"),
                      words("Reach {0} and hold."),
                      words("Keep the force steady."),
                      words("Open the jaws"),
                      words("A block will be placed between them."),
                      words("Too tight - ease off"),
                      words("Squeeze with {0}."),
                      words("Keep the squeeze steady."),
                      words("Touch and hold each disc"),
                      words("Squeeze the block"),
                      words("Discs held"),
                      words("Wrong places"),
                      words("Too much force"),
                      words("Tip force")}};
}

}  // namespace trocar
