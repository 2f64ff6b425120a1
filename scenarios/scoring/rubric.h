// A rubric: how metrics become sub-scores, a total, caps and a grade. Read from the exercise's TOML
// (scenarios/files/exercise_loader.h) and stored with every attempt by its sha256.
//
// S = 100 * sum_k w_k s_k with s_k = clamp((x - zero_at) / (full_at - zero_at), 0, 1); gates and critical events cap S
// (caps_scale).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace trocar {

/// One weighted sub-score: a linear ramp between two anchors of one metric.
struct SubscoreRule {
  std::string name;
  std::string metric;  ///< key of the metric table (docs/scoring.md)
  double weight = 0;   ///< weights of a rubric sum to 1
  double full_at = 0;  ///< metric value that earns 1
  double zero_at = 0;  ///< metric value that earns 0 (may lie on either side of full_at)
  bool gate = false;   ///< safety gate: value below gate_below caps the total
  double gate_below = 0.5;
};

struct Rubric {
  std::vector<SubscoreRule> subscores;
  double pass_at = 75;  ///< pass needs at least this, without any cap
  double proficient_at = 85;
  double expert_at = 92;
  double gate_cap = 59;        ///< total when a gate fails
  double critical_cap = 49;    ///< total after a critical event
  double unfinished_cap = 49;  ///< times the share of objects done, when time ran out or one was lost
  /// Gates and critical events leave gate_cap or critical_cap of 100 of the score, so that who does better below a cap
  /// still scores better; false, as rubrics without the word have it: the score is cut off at the cap.
  bool caps_scale = false;
  std::string sha256;  ///< of the exercise file's bytes
};

}  // namespace trocar
