// Pieces of inline SVG: lines, rectangles, labels, round axis steps. Coordinates in user units, one decimal.
//
// Words are escaped; `style` and `extra` are attributes of this program's own making. Thread: any.
#pragma once

#include <string>
#include <vector>

namespace trocar::svg {

std::string px(double value);
std::string attribute(const char* name, const std::string& value);
std::string line(double x0, double y0, double x1, double y1, const std::string& style);
std::string rect(double x, double y, double w, double h, const std::string& style);
std::string label(double x, double y, const std::string& words, const char* anchor = "start", const char* extra = "");

/// 1, 2 or 5 times a power of ten, giving about `count` steps.
double nice_step(double range, double count);
/// low, low + step, ... up to high, 200 at most whatever the numbers are.
std::vector<double> ticks(double low, double high, double step);

/// A whole chart as groups in place of its links, for a file by itself.
std::string without_links(std::string svg);

}  // namespace trocar::svg
