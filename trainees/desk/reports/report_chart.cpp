#include <algorithm>

#include "trainees/desk/reports/reports.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"
#include "trainees/progress/cohort_bands.h"

namespace trocar::review {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::px;
using svg::rect;

constexpr double kWidth = 720, kLeft = 250, kRight = 700, kTop = 10, kRow = 34;
constexpr std::size_t kLongest = 32;  // characters of a title that fit beside a band

double x_of(double score) { return kLeft + (kRight - kLeft) * std::clamp(score, 0.0, 100.0) / 100; }

/// At most so many characters, whole ones.
std::string brief(const std::string& title) {
  std::size_t at = 0, count = 0;
  for (; at < title.size(); ++at)
    if ((static_cast<unsigned char>(title[at]) & 0xC0U) != 0x80U && ++count > kLongest)
      return title.substr(0, at) + "\xE2\x80\xA6";
  return title;
}

std::string band_svg(const ScoreBand& band, double y) {
  std::string out = label(kLeft - 12, y + 5, brief(band.title), "end");
  out += line(kLeft, y, kRight, y, "stroke=\"#d9dee4\"");
  if (static_cast<int>(band.scores.size()) >= kLeastForCohort)
    if (const auto q = quartiles(band.scores)) {
      out += rect(x_of(q->low), y - 9, x_of(q->high) - x_of(q->low), 18, "fill=\"#56b4e9\" fill-opacity=\"0.35\"");
      out += line(x_of(q->median), y - 9, x_of(q->median), y + 9, "stroke=\"#1f6a94\" stroke-width=\"3\"");
    }
  out += line(x_of(band.pass_at), y - 13, x_of(band.pass_at), y + 13,
              "stroke=\"#b04a00\" stroke-width=\"1.8\" stroke-dasharray=\"6 3\"");
  if (band.benchmark)
    out += line(x_of(*band.benchmark), y - 13, x_of(*band.benchmark), y + 13,
                "stroke=\"#00785a\" stroke-width=\"2.4\" stroke-dasharray=\"2 4\"");
  for (const double score : band.scores)
    out += "<circle r=\"3.6\" stroke-width=\"1.4\" stroke=\"#0072b2\" fill=\"#fff\"" +
           attribute("cx", px(x_of(score))) + attribute("cy", px(y)) + "/>";
  return out;
}

}  // namespace

std::string score_bands_svg(const std::vector<ScoreBand>& bands) {
  const double bottom = kTop + kRow * static_cast<double>(bands.size());
  std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + px(kWidth) + " " + px(bottom + 42) +
                    "\" role=\"img\" aria-label=\"Newest scores\">";
  for (int score = 0; score <= 100; score += 20)
    out += line(x_of(score), kTop, x_of(score), bottom, "stroke=\"#e6eaee\"") +
           label(x_of(score), bottom + 18, std::to_string(score), "middle");
  out += label(0.5 * (kLeft + kRight), bottom + 36, "newest score of each trainee", "middle");
  for (std::size_t i = 0; i < bands.size(); ++i)
    out += band_svg(bands[i], kTop + kRow * (static_cast<double>(i) + 0.5));
  return out + "</svg>";
}

}  // namespace trocar::review
