#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/wire/wire_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> wire_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool pointer) {
  return {
      {StepIcon::kReach, w("Put the ring over the free end of the wire.")},
      {StepIcon::kTurn, level.mapping == Mapping::kFulcrum
                            ? w("Roll the instrument so that the ring stays square across the wire; the port leans it.")
                            : w("Roll the stylus so that the ring stays square across the wire.")},
      {StepIcon::kCarry, pointer ? w("Move it along without touching; the ring lights where it touches.")
                                 : w("Move it along without touching; you feel the wire where it touches.")},
      {StepIcon::kHold, w("Never pull through the wire: beyond {0} N the ring comes off.",
                          {brief(w, own_rules<WireRules>(e).holds_n)})}};
}

void add_wire_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                     std::vector<LessonLimit>& out) {
  out.push_back({w("Gates"), std::to_string(e.layout.count)});
  out.push_back({w("Play of the ring"), w("{0} all round", {millimetres(w, own_rules<WireLevel>(level).ring_radius_m -
                                                                               own_rules<WireRules>(e).radius_m)})});
}

}  // namespace

KindLesson wire_lesson() {
  return {
      .kind = ExerciseKind::kWire,
      .skill =
          [](const Translator& w) { return w("Skill: leading an instrument along a path and turning it on the way."); },
      .steps = wire_steps,
      .add_limits = add_wire_limits,
      .display = {words("Gate {0}."), words("Move the ring along the wire"),
                  words("Put the ring over the end of the wire"), words("It stays on until the other end."),
                  words("The ring touches the wire"), words("Ease it back to the middle."), words("The ring came off"),
                  words("Put it round the wire again where it came off."),
                  words("Move the ring along the wire to its other end"), words("Gates passed"),
                  words("Wire touched")}};
}

}  // namespace trocar
