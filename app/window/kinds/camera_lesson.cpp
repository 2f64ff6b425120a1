#include <algorithm>

#include "app/window/attempt/metric_words.h"
#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/camera/camera_rules.h"

namespace trocar {
namespace {

std::vector<LessonStep> camera_steps(const Translator& w, const Exercise& e, const ExerciseLevel& level, bool) {
  const CameraRules& rules = own_rules<CameraRules>(e);
  const std::string aim =
      own_rules<CameraLevel>(level).tilt_rad > 0
          ? w("Bring the lit sphere into the ring: the tip looks {0} below the shaft.",
              {degrees(w, own_rules<CameraLevel>(level).tilt_rad)})
          : w("Bring the lit sphere into the ring: the instrument is the scope, the picture goes with it.");
  return {{StepIcon::kReach, aim},
          {StepIcon::kWithdraw, w("Look along its cup, from {0} to {1} away.",
                                  {millimetres(w, rules.nearest_m), millimetres(w, rules.farthest_m)})},
          {StepIcon::kTurn, w("Roll the scope until the picture is level, to {0} or nearer.",
                              {degrees(w, own_rules<CameraLevel>(level).horizon_rad)})},
          {StepIcon::kHold, w("Hold still for {0} s; the next sphere lights.", {brief(w, e.hold_s)})}};
}

void add_camera_limits(const Translator& w, const Exercise& e, const ExerciseLevel& level,
                       std::vector<LessonLimit>& out) {
  out.push_back({w("Spheres"), std::to_string(e.layout.count)});
  out.push_back({w("A sphere's time"),
                 w("{0} s, then it comes back at the end", {brief(w, own_rules<CameraRules>(e).timeout_s)})});
  out.push_back({w("Horizon lost"),
                 w("rolled over {0} for more than {1} s", {degrees(w, own_rules<CameraLevel>(level).horizon_rad),
                                                           brief(w, own_rules<CameraRules>(e).lost_s)})});
  const auto& rules = level.rubric.subscores;
  const auto gate = std::find_if(rules.begin(), rules.end(),
                                 [](const SubscoreRule& r) { return r.gate && r.metric == "wall_contacts"; });
  if (gate != rules.end())
    out.push_back({w("Wall contacts"), w("{0} for a pass", {needed_text(w, "wall_contacts", "1", gate->full_at,
                                                                        gate->zero_at, gate->gate_below)})});
}

}  // namespace

KindLesson camera_lesson() {
  return {
      .kind = ExerciseKind::kCamera,
      .skill =
          [](const Translator& w) {
            return w("Skill: leading the scope for the surgeon: centred, level, at the right distance, calm.");
          },
      .steps = camera_steps,
      .add_limits = add_camera_limits,
      .display = {words("Sphere {0}."), words("The lens touches"), words("Draw the scope back."),
                  words("Bring the lit sphere into the ring"), words("Draw the scope back"), words("It is too near."),
                  words("Go nearer"), words("It is too far away."), words("Look along the cup"),
                  words("Its wall hides the sphere."), words("Level the picture"), words("The tick at the rim is up."),
                  words("Bring each lit sphere into the ring and keep it there"), words("Spheres found"),
                  words("Distance"), words("Horizon"), words("Out of time")}};
}

}  // namespace trocar
