// Plots of a sweep as inline SVG: scores of each hand as dots, score over latent skill.
//
// Told apart without colour: dots lie in a row of their own, the pass mark is dashed, means are bars. Thread: any.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trocar {

struct HandScores {
  std::string hand;
  std::vector<double> scores;  ///< 0..100
};

/// One row of dots a hand, with its mean.
std::string hand_scores_svg(const std::vector<HandScores>& hands, double pass_at);

/// @param points latent skill 0..1 and score 0..100
std::string skill_scores_svg(const std::vector<std::pair<double, double>>& points, double pass_at);

}  // namespace trocar
