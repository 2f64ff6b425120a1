// What plots of forces share: limits, classes of force, and the range of every pixel column, so that no peak is lost at
// 1 kHz. Force is the magnitude of the scene's force on the instrument (TraceSample::force_T), virtual newtons. Thread:
// any.
#pragma once

#include <vector>

namespace trocar {

/// Force limits of an exercise at a level, N; 0 where there is none.
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

}  // namespace trocar
