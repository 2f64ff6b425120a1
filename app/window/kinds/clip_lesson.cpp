#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/clip/clip_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> clip_steps(const Translator& w, const Exercise& e, const ExerciseLevel&, bool) {
  const ClipRules& rules = own_rules<ClipRules>(e);
  return {{StepIcon::kReach, w("Lay the jaws round the cystic duct, then round the cystic artery, for {0} s each.",
                               {brief(w, rules.touch_s)})},
          {StepIcon::kSqueeze, w("Take the clip applier. Set two clips on each where it comes from, one beyond.")},
          {StepIcon::kHold, w("A clip lies straight across, its tips show beyond, {0} from the next one at least.",
                              {millimetres(w, rules.clip_gap_m)})},
          {StepIcon::kWithdraw, w("Take the scissors and cut in the middle between the second and the third clip.")}};
}

void add_clip_limits(const Translator& w, const Exercise& e, const ExerciseLevel&, std::vector<LessonLimit>& out) {
  const ClipRules& rules = own_rules<ClipRules>(e);
  out.push_back({w("From the large vessels"), millimetres(w, rules.spared_m)});
  out.push_back({w("Between clip and cut"), millimetres(w, rules.cut_gap_m)});
}

}  // namespace

KindLesson clip_lesson() {
  return {.kind = ExerciseKind::kClip,
          .skill = [](const Translator& w) { return w("Skill: knowing what you hold before you clip and cut it."); },
          .steps = clip_steps,
          .add_limits = add_clip_limits,
          .display = {words("Touch the cystic duct"),
                      words("Clip the cystic duct"),
                      words("Cut the cystic duct"),
                      words("Touch the cystic artery"),
                      words("Clip the cystic artery"),
                      words("Cut the cystic artery"),
                      words("First clip: where it comes from, clear of the large vessel."),
                      words("Second clip: beside the first, with a gap."),
                      words("Third clip: towards the gallbladder, with room to cut."),
                      words("In the middle between the second and the third clip."),
                      words("Lay the jaws round it, gently, until it is named."),
                      words("Good - hold"),
                      words("Stay on it."),
                      words("Take the grasper"),
                      words("Take the clip applier"),
                      words("Take the scissors"),
                      words("Draw back and exchange the instrument."),
                      words("That is another structure"),
                      words("Look where it comes from and where it goes."),
                      words("That clip would not have held"),
                      words("Draw back, look, and set it anew."),
                      words("Clipped before both were named"),
                      words("First touch duct and artery as asked."),
                      words("The clip does not shut all of it"),
                      words("Its tips must show beyond the structure."),
                      words("The clip lies askew"),
                      words("Set it straight across."),
                      words("Too near to the other clip"),
                      words("Leave a gap between them."),
                      words("Too near to what must be spared"),
                      words("Keep the clip further from the large vessel."),
                      words("More clips than are needed"),
                      words("Two where it comes from, one beyond."),
                      words("That must be spared"),
                      words("It is neither the cystic duct nor the cystic artery."),
                      words("Opened without enough clips"),
                      words("Two before the cut and one beyond it."),
                      words("Cut too near to a clip"),
                      words("It may slip off the stump."),
                      words("A clip came off"),
                      words("Pull less on what is clipped."),
                      words("Touch duct and artery, clip each, cut between"),
                      words("Clips set"),
                      words("Mistakes"),
                      words("Pull")}};
}

}  // namespace trocar
