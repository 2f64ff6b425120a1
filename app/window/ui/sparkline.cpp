#include "app/window/ui/sparkline.h"

#include <algorithm>

namespace trocar {

std::vector<double> scores_oldest_first(const LevelProgress& progress) {
  constexpr std::size_t kMost = 30;
  std::vector<double> out;
  for (const AttemptSummary& attempt : progress.newest_first)
    if (attempt.score && out.size() < kMost) out.push_back(*attempt.score);
  std::reverse(out.begin(), out.end());
  return out;
}

void paint_sparkline(Ui& ui, const Translator& words, const Area& area, const std::vector<double>& scores,
                     double pass_at) {
  const double pad = ui.px(8), label = ui.text_width("100") + ui.px(8), left = area.x + label,
               right = area.x + area.width - pad;
  const double line = ui.line_height();
  const double top = area.y + line / 2, bottom = area.y + area.height - line / 2;
  const auto y_of = [&](double score) { return bottom - (bottom - top) * std::clamp(score, 0.0, 100.0) / 100; };
  for (const double score : {0.0, 100.0}) {
    ui.paint_line(left, y_of(score), right, y_of(score), Ink::kDim, 1);
    ui.text_at(left - ui.px(6), y_of(score) - line / 2, words.number(score, 0), Ink::kDim, label, 1);
  }
  ui.paint_line(left, y_of(pass_at), right, y_of(pass_at), Ink::kGood, 1.5, true);
  ui.text_at(left - ui.px(6), y_of(pass_at) - line / 2, words.number(pass_at, 0), Ink::kGood, label, 1);
  std::vector<Ui::Point> points;
  const double step = scores.size() > 1 ? (right - left - 2 * pad) / static_cast<double>(scores.size() - 1) : 0;
  for (std::size_t i = 0; i < scores.size(); ++i)
    points.push_back({left + pad + step * static_cast<double>(i), y_of(scores[i])});
  if (points.size() > 1) ui.paint_curve(points, Ink::kHeading, 2);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] >= pass_at)
      ui.paint_disc(points[i].x, points[i].y, ui.px(5), Ink::kGood);
    else
      ui.paint_ring(points[i].x, points[i].y, ui.px(4), Ink::kCaution, 2);
  }
}

}  // namespace trocar
