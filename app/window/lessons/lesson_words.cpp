#include "app/window/lessons/lesson_words.h"

#include <cmath>
#include <utility>

#include "app/picture/attempt/attempt_scene.h"
#include "app/window/attempt/metric_words.h"
#include "app/window/attempt/number_words.h"
#include "app/window/kinds/kind_lesson.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

/// "1:30".
std::string clock(double seconds) {
  const int all = static_cast<int>(std::lround(seconds)), rest = all % 60;
  return std::to_string(all / 60) + (rest < 10 ? ":0" : ":") + std::to_string(rest);
}

}  // namespace

std::string lesson_title(const Translator& w, const Exercise& exercise, const std::string& level) {
  return exercise.number + " " + w(exercise.title) + " - " + w(level);
}

std::string lesson_skill(const Translator& w, const Exercise& exercise) { return lesson_of(exercise).skill(w); }

std::vector<LessonStep> lesson_steps(const Translator& w, const Exercise& exercise, const ExerciseLevel& level,
                                     bool pointer) {
  std::vector<LessonStep> out{
      {StepIcon::kRest, w("Rest the tip in the ball at the start for {0} s: the clock then begins.",
                          {brief(w, exercise.start_hold_s)})}};
  for (LessonStep& step : lesson_of(exercise).steps(w, exercise, level, pointer)) out.push_back(std::move(step));
  return out;
}

std::vector<LessonLimit> lesson_limits(const Translator& w, const Exercise& exercise, const ExerciseLevel& level) {
  std::vector<LessonLimit> out{{w("Time"), w("{0} min at most", {clock(level.time_limit_s)})}};
  lesson_of(exercise).add_limits(w, exercise, level, out);
  if (kind_of(exercise).watched != WatchedForce::kNone) {
    out.push_back({w("Too much force"), w("above {0}", {newtons(w, exercise.hard_force_n)})});
    out.push_back({w("Critical force"), w("above {0}: no pass", {newtons(w, exercise.critical_force_n)})});
  }
  return out;
}

std::vector<LessonMeasure> lesson_measures(const Translator& w, const ExerciseLevel& level, bool pointer) {
  std::vector<LessonMeasure> out;
  const Rubric& rubric = pointer ? level.pointer.rubric : level.rubric;
  for (const SubscoreRule& rule : rubric.subscores) {
    const MetricDefinition* metric = find_metric(rule.metric);
    const std::string unit(metric ? metric->unit : "");
    LessonMeasure m;
    m.name = w(rule.name);
    m.weight = w("{0} %", {brief(w, std::round(1000 * rule.weight) / 10)});
    m.full = metric_text(w, rule.metric, rule.full_at, unit);
    m.none = metric_text(w, rule.metric, rule.zero_at, unit);
    m.metric = rule.metric;
    m.meaning = metric ? w(metric->meaning) : "";
    if (rule.gate)
      m.gate = w(
          "Safety gate: a pass needs {0}; without it the score is {1} or less.",
          {needed_text(w, rule.metric, unit, rule.full_at, rule.zero_at, rule.gate_below), brief(w, rubric.gate_cap)});
    out.push_back(m);
  }
  return out;
}

std::string lesson_rule(const Translator& w, const Rubric& rubric) {
  return w(
      "Each measure earns its weight in full at one value and nothing at the other, in a straight line between. Pass "
      "from {0} of 100.",
      {brief(w, rubric.pass_at)});
}

std::string lesson_display(const Translator& w, const Exercise& exercise, const ExerciseLevel& level, bool pointer) {
  const std::string& display = level.force_display;
  if (is_scope(exercise))
    return display == "after" ? w("Horizon and distance: not during the run. Judge them by eye.")
                              : w("Horizon and distance: always shown.");
  if (kind_of(exercise).watched == WatchedForce::kNone) {
    if (display == "band") return w("Match of the pen: shown only while something is off.");
    if (display == "after") return w("Match of the pen: not during the run. Judge place and turn by eye.");
    return w("Match of the pen: always shown. You see how far off you are.");
  }
  if (display == "band") return w("Force bar: only outside the limits. You see it when something is wrong.");
  if (display == "after")
    return pointer ? w("Force bar: after the run. Go by how far things give way.")
                   : w("Force bar: after the run. Feel the force; you see it in the debrief.");
  return w("Force bar: always. You see the force all the time.");
}

std::string lesson_tool(const Translator& w, const Exercise& exercise, const ExerciseLevel& level, bool pointer) {
  const std::string tool = is_scope(exercise)                           ? w("Scope, 5 mm")
                           : kind_of(exercise).tool == ToolKind::kProbe ? w("Probe, 5 mm")
                                                                        : w("Grasper, 5 mm");
  if (level.mapping != Mapping::kFulcrum)
    return pointer ? w("{0}, no port: you move the tip and turn the shaft about it.", {tool})
                   : w("{0}, one hand, no port: the tip moves with the hand.", {tool});
  return pointer ? w("{0}, through a port: you move and roll the tip.", {tool})
                 : w("{0}, through a port: the tip moves against the hand.", {tool});
}

std::string lesson_scope(const Translator& w, const std::string& degrees, const std::string& post_left,
                         const std::string& post_right) {
  if (degrees == "0") return w("Scope 0 degrees, held by an assistant.");
  return w("Scope 30 degrees, held by an assistant; {0} and {1} turn its light post.", {post_left, post_right});
}

}  // namespace trocar
