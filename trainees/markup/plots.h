// The report's two pictures as inline SVG: force against time, and the tip's path from above coloured by force.
//
// Force is the magnitude of the scene's force on the instrument (TraceSample::force_T), virtual newtons. At 1 kHz the
// plot keeps the lowest and highest value of every pixel column, so no peak is lost. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

/// Force limits drawn into both plots, N; 0 where there is none.
struct ForceLimits {
  double low_n = 0, high_n = 0, hard_n = 0;
};

/// Lowest and highest value of one pixel column.
struct ColumnRange {
  int column = 0;
  double low = 0, high = 0;
};

/// Reduces samples to one range a column. @param columns > 0. Non-finite values are left out.
std::vector<ColumnRange> column_ranges(const std::vector<double>& t_s, const std::vector<double>& values,
                                       double t_end_s, int columns);

/// How a force stands to the band: 0 none or below, 1 in band, 2 above, 3 at or above the hard limit.
int force_class(double force_n, const ForceLimits& band);

/// Whole <svg> elements; text inside is escaped.
std::string force_plot_svg(const Trace& trace, const std::vector<Event>& events, const ForceLimits& band);
std::string path_plot_svg(const Trace& trace, const std::vector<Event>& events, const ForceLimits& band);

}  // namespace trocar
