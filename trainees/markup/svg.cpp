#include "trainees/markup/svg.h"

#include <cmath>

#include "trainees/markup/html.h"

namespace trocar::svg {

std::string px(double value) { return fixed_text(value, 1); }

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& style) {
  return "<line" + attribute("x1", px(x0)) + attribute("y1", px(y0)) + attribute("x2", px(x1)) +
         attribute("y2", px(y1)) + " " + style + "/>";
}

std::string rect(double x, double y, double w, double h, const std::string& style) {
  return "<rect" + attribute("x", px(x)) + attribute("y", px(y)) + attribute("width", px(w)) +
         attribute("height", px(h)) + " " + style + "/>";
}

std::string label(double x, double y, const std::string& words, const char* anchor, const char* extra) {
  return "<text" + attribute("x", px(x)) + attribute("y", px(y)) + attribute("text-anchor", anchor) + " " + extra +
         ">" + escape_html(words) + "</text>";
}

double nice_step(double range, double count) {
  const double raw = range / count, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double m : {1.0, 2.0, 5.0})
    if (raw <= m * power * 1.0001) return m * power;
  return 10 * power;
}

std::vector<double> ticks(double low, double high, double step) {
  constexpr int kMost = 200;
  std::vector<double> out;
  for (int k = 0; k < kMost && low + k * step <= high; ++k) out.push_back(low + k * step);
  return out;
}

std::string without_links(std::string svg) {
  for (std::size_t at = 0; (at = svg.find('<', at)) != std::string::npos; ++at) {
    if (svg.compare(at, 3, "<a ") == 0 || svg.compare(at, 3, "<a>") == 0)
      svg.replace(at, svg.find('>', at) - at, "<g");
    else if (svg.compare(at, 4, "</a>") == 0)
      svg.replace(at, 4, "</g>");
  }
  return svg;
}

}  // namespace trocar::svg
