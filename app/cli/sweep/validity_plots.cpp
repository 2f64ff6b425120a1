#include "app/cli/sweep/validity_plots.h"

#include <algorithm>
#include <numeric>

#include "trainees/markup/svg.h"

namespace trocar {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::px;

constexpr double kPlotWide = 720, kBandLeft = 130, kBandRight = 700, kBandTop = 12, kBandRow = 36;
constexpr double kScatterLeft = 60, kScatterTop = 12, kScatterBottom = 300;
constexpr const char* kGridStyle = "stroke=\"#e1e6eb\"";
constexpr const char* kPassStyle = "stroke=\"#b04a00\" stroke-width=\"1.8\" stroke-dasharray=\"6 3\"";
constexpr int kOffsets = 5;  // heights at which dots lie, so that equal scores are seen

double score_x(double score) { return kBandLeft + (kBandRight - kBandLeft) * std::clamp(score, 0.0, 100.0) / 100; }

std::string dot(double x, double y) {
  return "<circle r=\"3\" stroke=\"#0072b2\" fill=\"#56b4e9\" fill-opacity=\"0.45\"" + attribute("cx", px(x)) +
         attribute("cy", px(y)) + "/>";
}

std::string begin(double height, const char* title) {
  return "<svg viewBox=\"0 0 " + px(kPlotWide) + " " + px(height) + "\" role=\"img\" aria-label=\"" + title + "\">";
}

}  // namespace

std::string hand_scores_svg(const std::vector<HandScores>& hands, double pass_at) {
  const double bottom = kBandTop + kBandRow * static_cast<double>(hands.size());
  std::string out = begin(bottom + 44, "Scores by hand");
  for (int score = 0; score <= 100; score += 20)
    out += line(score_x(score), kBandTop, score_x(score), bottom, kGridStyle) +
           label(score_x(score), bottom + 18, std::to_string(score), "middle");
  out += line(score_x(pass_at), kBandTop, score_x(pass_at), bottom, kPassStyle);
  out += label(0.5 * (kBandLeft + kBandRight), bottom + 38, "score (dashed: pass mark; bar: mean)", "middle");
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const double y = kBandTop + kBandRow * (static_cast<double>(i) + 0.5);
    out += label(kBandLeft - 12, y + 5, hands[i].hand, "end");
    for (std::size_t k = 0; k < hands[i].scores.size(); ++k)
      out += dot(score_x(hands[i].scores[k]), y + 3.5 * static_cast<double>(static_cast<int>(k % kOffsets) - 2));
    if (hands[i].scores.empty()) continue;
    const double mean = std::accumulate(hands[i].scores.begin(), hands[i].scores.end(), 0.0) /
                        static_cast<double>(hands[i].scores.size());
    out += line(score_x(mean), y - 13, score_x(mean), y + 13, "stroke=\"#14191f\" stroke-width=\"2.4\"");
  }
  return out + "</svg>";
}

std::string skill_scores_svg(const std::vector<std::pair<double, double>>& points, double pass_at) {
  const auto x_of = [](double skill) { return kScatterLeft + (kBandRight - kScatterLeft) * skill; };
  const auto y_of = [](double score) {
    return kScatterBottom - (kScatterBottom - kScatterTop) * std::clamp(score, 0.0, 100.0) / 100;
  };
  std::string out = begin(kScatterBottom + 46, "Score over latent skill");
  for (int i = 0; i <= 5; ++i) {
    out += line(x_of(0.2 * i), kScatterTop, x_of(0.2 * i), kScatterBottom, kGridStyle) +
           label(x_of(0.2 * i), kScatterBottom + 18, svg::px(0.2 * i), "middle") +
           line(kScatterLeft, y_of(20 * i), kBandRight, y_of(20 * i), kGridStyle) +
           label(kScatterLeft - 8, y_of(20 * i) + 5, std::to_string(20 * i), "end");
  }
  out += line(kScatterLeft, y_of(pass_at), kBandRight, y_of(pass_at), kPassStyle);
  out += label(0.5 * (kScatterLeft + kBandRight), kScatterBottom + 40,
               "latent skill, 0 novice to 1 expert (dashed: pass mark)", "middle");
  out += label(16, 0.5 * (kScatterTop + kScatterBottom), "score", "middle",
               ("transform=\"rotate(-90 16 " + px(0.5 * (kScatterTop + kScatterBottom)) + ")\"").c_str());
  for (const auto& [skill, score] : points) out += dot(x_of(skill), y_of(score));
  return out + "</svg>";
}

}  // namespace trocar
