#include "app/window/attempt/metric_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

using Names = std::initializer_list<std::string_view>;

/// By its plain name, whatever stage it is of.
bool among(std::string_view name, Names names) {
  return std::find(names.begin(), names.end(), plain_metric(name)) != names.end();
}

}  // namespace

ScoreGroup group_of(const SubscoreRule& rule) {
  const std::string m(plain_metric(rule.metric));
  if (rule.gate || among(m, {"excess_events", "critical_events", "tool_collisions", "crushed", "force_max_n",
                             "soft_force_share", "soft_impulse_ns", "pressed_impulse_ns"}))
    return ScoreGroup::kSafety;
  if (m == "time_s" || m == "time_per_target_s") return ScoreGroup::kTime;
  if (m.starts_with("path_") || m.ends_with("regrasps") ||
      among(m, {"economy", "depth_path_m", "angular_path_deg", "movements", "speed_peaks", "speed_peak_rate_hz",
                "idle_share", "clutches", "view_jerks"}))
    return ScoreGroup::kMotion;
  return ScoreGroup::kAccuracy;
}

std::string group_name(const Translator& words, ScoreGroup group) {
  switch (group) {
    case ScoreGroup::kSafety:
      return words("Safety");
    case ScoreGroup::kAccuracy:
      return words("Accuracy");
    case ScoreGroup::kMotion:
      return words("Motion");
    case ScoreGroup::kTime:
      return words("Time");
  }
  return "";
}

bool is_count(const std::string& metric, const std::string& unit) {
  return unit == "1" && !metric.ends_with("_share") &&
         !among(metric, {"", "economy", "path_ratio", "sparc", "ldlj", "normalised_jerk"});
}

bool is_band_share(const std::string& metric) { return among(metric, {"in_band_share", "object_in_band_share"}); }
bool is_window_share(const std::string& metric) {
  return among(metric, {"grip_window_share", "object_grip_window_share"});
}

std::string metric_text(const Translator& words, const std::string& metric, const std::optional<double>& value,
                        const std::string& unit) {
  if (!value || !std::isfinite(*value)) return words("n/a");
  const double x = *value;
  if (metric.ends_with("_share")) return words.number(100 * x, 0) + " %";
  if (is_count(metric, unit)) return words.number(x, x == std::floor(x) ? 0 : 1);
  if (unit == "1" || unit.empty()) return words.number(x, 2);
  if (unit == "m") return words.number(1e3 * x, std::abs(x) < 0.1 ? 1 : 0) + " mm";
  if (unit == "m/s") return words.number(1e3 * x, 0) + " mm/s";
  if (unit == "deg") return words.number(x, 1) + "\u00b0";
  if (unit == "s") return words.number(x, 1) + " s";
  return words.number(x, 2) + " " + unit;
}

std::string needed_text(const Translator& words, const std::string& metric, const std::string& unit, double full_at,
                        double zero_at, double floor) {
  double x = zero_at + floor * (full_at - zero_at);
  const bool less = full_at < zero_at;
  if (is_count(metric, unit)) x = less ? std::floor(x + 1e-9) : std::ceil(x - 1e-9);
  const std::string text = metric_text(words, metric, x, unit);
  return less ? words("at most {0}", {text}) : words("at least {0}", {text});
}

std::string hand_words(const Translator& words, const std::string& hand) {
  if (hand == "mouse") return words("mouse");
  if (hand == "keyboard") return words("keyboard");
  if (hand == "gamepad") return words("gamepad");
  if (hand == "spacemouse") return words("SpaceMouse");
  if (hand == "device") return words("device");
  if (hand == "expert") return words("expert");
  if (hand == "intermediate") return words("intermediate");
  if (hand == "novice") return words("novice");
  if (hand == "clumsy") return words("clumsy");
  if (hand == "learner") return words("learner");
  if (hand == "idle") return words("idle");
  if (hand == "speed-runner") return words("speed-runner");
  if (hand == "heavy-handed") return words("heavy-handed");
  return hand;
}

std::string subscore_words(const Translator& words, const std::string& name) {
  std::string heading = name;  // the English one: the first letter of "économie" is no byte
  if (!heading.empty()) heading[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(heading[0])));
  return words.made(heading);
}

const ExerciseLevel* level_named(const Exercise& exercise, const std::string& level) {
  const auto at = std::find_if(exercise.levels.begin(), exercise.levels.end(),
                               [&](const ExerciseLevel& l) { return l.name == level; });
  return at == exercise.levels.end() ? nullptr : &*at;
}

const SubscoreRule* rule_named(const ExerciseLevel* level, const std::string& subscore) {
  if (!level) return nullptr;
  const auto& rules = level->rubric.subscores;
  const auto at = std::find_if(rules.begin(), rules.end(), [&](const SubscoreRule& r) { return r.name == subscore; });
  return at == rules.end() ? nullptr : &*at;
}

double model_time_s(const ExerciseLevel& level, const AttemptResult& result) {
  const double own = result.device.without_device() ? level.pointer.expert_time_s : 0;
  return own > 0 ? own : level.expert_time_s;
}

}  // namespace trocar
