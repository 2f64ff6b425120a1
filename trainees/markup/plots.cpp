#include "trainees/markup/plots.h"

#include <algorithm>
#include <cmath>

namespace trocar {

std::vector<ColumnRange> column_ranges(const std::vector<double>& t_s, const std::vector<double>& values,
                                       double t_end_s, int columns) {
  std::vector<ColumnRange> ranges;
  for (std::size_t i = 0; i < t_s.size() && i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || !std::isfinite(t_s[i])) continue;
    const int column = std::clamp(static_cast<int>(t_s[i] / t_end_s * columns), 0, columns - 1);
    if (ranges.empty() || ranges.back().column != column) ranges.push_back({column, values[i], values[i]});
    ranges.back().low = std::min(ranges.back().low, values[i]);
    ranges.back().high = std::max(ranges.back().high, values[i]);
  }
  return ranges;
}

int force_class(double force_n, const ForceLimits& band) {
  if (band.hard_n > 0 && force_n >= band.hard_n) return 3;
  if (band.high_n > 0 && force_n > band.high_n) return 2;
  return band.high_n > 0 && force_n >= band.low_n && force_n > 0 ? 1 : 0;
}

}  // namespace trocar
