#include "app/window/lessons/lesson_words.h"

#include <cmath>
#include <numbers>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

/// Two decimals at most, no zeros at the end.
std::string brief(const Words& w, double value) {
  for (const int decimals : {0, 1, 2}) {
    const double scale = std::pow(10, decimals);
    if (std::abs(std::round(value * scale) / scale - value) < 1e-9) return w.number(value, decimals);
  }
  return w.number(value, 2);
}

std::string newtons(const Words& w, double n) { return w("{0} N", {brief(w, n)}); }
std::string band(const Words& w, double low, double high) { return w("{0} to {1} N", {brief(w, low), brief(w, high)}); }
std::string millimetres(const Words& w, double m) { return w("{0} mm", {brief(w, 1e3 * m)}); }
std::string degrees(const Words& w, double rad) {
  return w("{0} degrees", {brief(w, std::round(rad * 1800 / std::numbers::pi) / 10)});
}

/// "1:30".
std::string clock(double seconds) {
  const int all = static_cast<int>(std::lround(seconds)), rest = all % 60;
  return std::to_string(all / 60) + (rest < 10 ? ":0" : ":") + std::to_string(rest);
}

/// A metric's value in the unit that people read: mm for m.
std::string metric_value(const Words& w, const MetricDefinition* metric, double value) {
  const std::string unit = metric ? std::string(metric->unit) : "";
  if (unit == "m") return w("{0} mm", {brief(w, 1e3 * value)});
  if (unit == "1" || unit.empty()) return brief(w, value);
  return brief(w, value) + " " + unit;
}

std::string rest_step(const Words& w, const Exercise& e) {
  return w("Rest the tip in the ball at the start for {0} s: the clock then begins.", {brief(w, e.start_hold_s)});
}

std::vector<LessonStep> reach_steps(const Words& w, const Exercise& e, const ExerciseLevel& level) {
  return {{StepIcon::kRest, rest_step(w, e)},
          {StepIcon::kReach,
           w("Bring the tip to the lit pen, to {0} or nearer.", {millimetres(w, level.position_tolerance_m)})},
          {StepIcon::kTurn,
           w("Turn the instrument along it and about it, to {0} or nearer.", {degrees(w, level.angle_tolerance_rad)})},
          {StepIcon::kHold, w("Hold still for {0} s; the next pen lights.", {brief(w, e.hold_s)})}};
}

std::vector<LessonStep> touch_steps(const Words& w, const Exercise& e, const ExerciseLevel& level) {
  const std::string force = level.bands.size() == 1 ? band(w, level.bands.front().low_n, level.bands.front().high_n)
                                                    : w("the force that the bar asks for");
  return {{StepIcon::kRest, rest_step(w, e)},
          {StepIcon::kReach, w("Bring the tip to the lit disc from above.")},
          {StepIcon::kPress, w("Press it with {0}.", {force})},
          {StepIcon::kHold, w("Hold for {0} s without a break; the next disc lights.", {brief(w, e.hold_s)})},
          {StepIcon::kWithdraw, w("Draw back before you go on: no dragging over tissue.")},
          {StepIcon::kSqueeze, w("Last, squeeze the block between the jaws with {0} for {1} s.",
                                 {band(w, e.grip.low_n, e.grip.high_n), brief(w, e.grip.hold_s)})}};
}

std::vector<LessonStep> grasp_steps(const Words& w, const Exercise& e, const ExerciseLevel& level) {
  const std::string grip = level.grasp.colour_cue
                               ? w("Grip it: bands round a block tell its foam, one the softest, three the hardest.")
                               : w("Grip it: no colour tells the foam, feel how hard it is.");
  return {{StepIcon::kRest, rest_step(w, e)},
          {StepIcon::kPick, w("Put the open jaws round the lit block.")},
          {StepIcon::kSqueeze, grip},
          {StepIcon::kCarry, w("Lift it {0} and carry it to its ring.", {millimetres(w, e.grasp.lift_m)})},
          {StepIcon::kPlace,
           w("Set it down, its middle {0} or less from the ring's.", {millimetres(w, level.grasp.place_tolerance_m)})}};
}

void touch_limits(const Words& w, const Exercise& e, const ExerciseLevel& level, std::vector<LessonLimit>& out) {
  std::string wanted;
  for (const WantedForce& one : level.bands) {
    const std::string said = band(w, one.low_n, one.high_n);
    wanted = wanted.empty() ? said : w("{0} or {1}", {wanted, said});
  }
  if (level.bands.size() == 1)
    out.push_back({w("Wanted force"), wanted});
  else
    out.push_back({w("Wanted force, another for each disc; the bar says which"), wanted});
  out.push_back({w("Discs"), std::to_string(e.layout.count)});
  out.push_back(
      {w("Wrong place"), w("touch begins over {0} outside the disc", {millimetres(w, e.layout.wrong_place_m)})});
}

void grasp_limits(const Words& w, const Exercise& e, const ExerciseLevel& level, std::vector<LessonLimit>& out) {
  out.push_back({w("Blocks"), std::to_string(e.layout.count)});
  if (level.grasp.colour_cue) {
    int bands = 0;
    for (const FoamKind& kind : e.grasp.kinds) {
      const GripWindow window = grip_window(kind, level.grasp);
      out.push_back({w("Bands {0}: wanted grip", {std::to_string(++bands)}), band(w, window.low_n, window.high_n)});
    }
  }
  out.push_back({w("Crushed blocks"), w("fewer than {0}", {std::to_string(e.grasp.critical_crushed)})});
}

}  // namespace

std::string lesson_title(const Words& w, const Exercise& exercise, const std::string& level) {
  return exercise.number + " " + w(exercise.title) + " - " + w(level);
}

std::string lesson_skill(const Words& w, ExerciseKind kind) {
  switch (kind) {
    case ExerciseKind::kReach:
      return w("Skill: depth from a flat picture, and turning the instrument where you want it.");
    case ExerciseKind::kTouch:
      return w("Skill: touching where you mean to, with a force that you choose.");
    case ExerciseKind::kGrasp:
      return w("Skill: a grip that holds and does not hurt, lifted and set down gently.");
  }
  return "";
}

std::vector<LessonStep> lesson_steps(const Words& w, const Exercise& exercise, const ExerciseLevel& level) {
  switch (exercise.kind) {
    case ExerciseKind::kReach:
      return reach_steps(w, exercise, level);
    case ExerciseKind::kTouch:
      return touch_steps(w, exercise, level);
    case ExerciseKind::kGrasp:
      return grasp_steps(w, exercise, level);
  }
  return {};
}

std::vector<LessonLimit> lesson_limits(const Words& w, const Exercise& exercise, const ExerciseLevel& level) {
  std::vector<LessonLimit> out{{w("Time"), w("{0} min at most", {clock(level.time_limit_s)})}};
  if (exercise.kind == ExerciseKind::kTouch) touch_limits(w, exercise, level, out);
  if (exercise.kind == ExerciseKind::kGrasp) grasp_limits(w, exercise, level, out);
  if (exercise.kind == ExerciseKind::kReach) {
    out.push_back({w("Pens"), std::to_string(exercise.layout.count)});
    out.push_back({w("A pen's time"), w("{0} s, then it comes back at the end", {brief(w, exercise.pens.timeout_s)})});
  } else {
    out.push_back({w("Too much force"), w("above {0}", {newtons(w, exercise.hard_force_n)})});
    out.push_back({w("Critical force"), w("above {0}: no pass", {newtons(w, exercise.critical_force_n)})});
  }
  return out;
}

std::vector<LessonMeasure> lesson_measures(const Words& w, const ExerciseLevel& level) {
  std::vector<LessonMeasure> out;
  for (const SubscoreRule& rule : level.rubric.subscores) {
    const MetricDefinition* metric = find_metric(rule.metric);
    LessonMeasure m;
    m.name = w(rule.name);
    m.weight = w("{0} %", {brief(w, std::round(1000 * rule.weight) / 10)});
    m.full = metric_value(w, metric, rule.full_at);
    m.none = metric_value(w, metric, rule.zero_at);
    m.metric = rule.metric;
    m.meaning = metric ? w(metric->meaning) : "";
    if (rule.gate)
      m.gate = w("Safety: a share below {0} here holds the whole score at {1} or less.",
                 {brief(w, rule.gate_below), brief(w, level.rubric.gate_cap)});
    out.push_back(m);
  }
  return out;
}

std::string lesson_rule(const Words& w, const Rubric& rubric) {
  return w(
      "Each measure earns its weight in full at one value and nothing at the other, in a straight line between. Pass "
      "from {0} of 100.",
      {brief(w, rubric.pass_at)});
}

std::string lesson_display(const Words& w, const ExerciseLevel& level) {
  if (level.force_display == "band")
    return w("Force bar: only outside the limits. You see it when something is wrong.");
  if (level.force_display == "after") return w("Force bar: after the run. Feel the force; you see it in the debrief.");
  return w("Force bar: always. You see the force all the time.");
}

std::string lesson_tool(const Words& w, const Exercise& exercise, const ExerciseLevel& level) {
  const std::string tool = exercise.kind == ExerciseKind::kReach ? w("Probe, 5 mm") : w("Grasper, 5 mm");
  if (level.mapping == Mapping::kFulcrum) return w("{0}, through a port: the tip moves against the hand.", {tool});
  return w("{0}, one hand, no port: the tip moves with the hand.", {tool});
}

std::string lesson_scope(const Words& w, const std::string& degrees, const std::string& post_left,
                         const std::string& post_right) {
  if (degrees == "0") return w("Scope 0 degrees, held by an assistant.");
  return w("Scope 30 degrees, held by an assistant; {0} and {1} turn its light post.", {post_left, post_right});
}

}  // namespace trocar
