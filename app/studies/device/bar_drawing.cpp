#include "app/studies/device/bar_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "trainees/markup/html.h"

namespace trocar {
namespace {

constexpr double kBarWidth = 720, kBarHeight = 400, kBarLeft = 70, kBarRight = 20, kBarTop = 70, kBarBottom = 56;
constexpr std::array kFills{"#303030", "#b8b8b8", "url(#stripes)"};

void text(std::ostream& out, double x, double y, const std::string& words, const std::string& more) {
  out << "<text x=\"" << x << "\" y=\"" << y << "\" " << more << '>' << escape_html(words) << "</text>\n";
}

void box(std::ostream& out, double x, double y, double width, double height, std::size_t kind) {
  out << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << width << "\" height=\"" << height << "\" fill=\""
      << kFills[kind % kFills.size()] << "\" stroke=\"#303030\"/>\n";
}

std::string value(double v) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << v;
  return out.str();
}

void bar_frame(std::ostream& out, const StudyCurves& curves, double top, double step) {
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 400\" width=\"720\" height=\"400\" "
         "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
         "<defs><pattern id=\"stripes\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
         "patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"white\"/><rect width=\"2\" "
         "height=\"6\" "
         "fill=\"#1f6fb2\"/></pattern></defs>\n";
  text(out, kBarLeft, 22, curves.title, "font-size=\"15\" font-weight=\"bold\"");
  for (double v = 0; v <= top + 1e-9; v += step) {
    const double y = kBarHeight - kBarBottom - v / top * (kBarHeight - kBarTop - kBarBottom);
    out << "<line x1=\"" << kBarLeft << "\" y1=\"" << y << "\" x2=\"" << kBarWidth - kBarRight << "\" y2=\"" << y
        << "\" stroke=\"#ddd\"/>\n";
    std::ostringstream label;
    label << v;
    text(out, kBarLeft - 8, y + 4, label.str(), "text-anchor=\"end\"");
  }
  const double middle = (kBarTop + kBarHeight - kBarBottom) / 2;
  std::ostringstream turned;
  turned << "text-anchor=\"middle\" transform=\"rotate(-90 16 " << middle << ")\"";
  text(out, 16, middle, curves.y_label, turned.str());
  text(out, (kBarLeft + kBarWidth - kBarRight) / 2, kBarHeight - 12, curves.x_label, "text-anchor=\"middle\"");
}

}  // namespace

std::string grouped_bars_svg(const StudyCurves& curves, const std::vector<std::string>& groups) {
  double most = 0;
  for (const auto& series : curves.series) most = std::max(most, *std::max_element(series.y.begin(), series.y.end()));
  const double power = std::pow(10, std::floor(std::log10(std::max(most, 1e-9) / 5)));
  const double step = power * (most / 5 / power < 1.5 ? 1 : most / 5 / power < 3.5 ? 2 : 5);
  const double top = step * std::ceil(most * 1.05 / step);
  std::ostringstream out;
  bar_frame(out, curves, top, step);
  const double room = (kBarWidth - kBarLeft - kBarRight) / static_cast<double>(groups.size());
  const double bar = 0.78 * room / static_cast<double>(curves.series.size());
  for (std::size_t s = 0; s < curves.series.size(); ++s) {
    box(out, kBarLeft + 12 + 200.0 * static_cast<double>(s), 38, 16, 12, s);
    text(out, kBarLeft + 34 + 200.0 * static_cast<double>(s), 48, curves.series[s].name, "");
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double v = curves.series[s].y[g], height = v / top * (kBarHeight - kBarTop - kBarBottom);
      const double x = kBarLeft + room * (static_cast<double>(g) + 0.11) + bar * static_cast<double>(s);
      box(out, x, kBarHeight - kBarBottom - height, bar, height, s);
      text(out, x + bar / 2, kBarHeight - kBarBottom - height - 4, value(v), "text-anchor=\"middle\" font-size=\"10\"");
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    text(out, kBarLeft + room * (static_cast<double>(g) + 0.5), kBarHeight - kBarBottom + 18, groups[g],
         "text-anchor=\"middle\"");
  }
  out << "</svg>\n";
  return out.str();
}

}  // namespace trocar
