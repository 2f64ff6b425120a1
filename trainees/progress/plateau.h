// Whether scores still rise: the slope of Theil (1950) and Sen (1968), the median over all pairs, which one bad day
// does not bend. Pure. Thread: any.
#pragma once

#include <optional>
#include <vector>

namespace trocar {

/// Points an attempt; empty with fewer than two scores. O(n^2).
std::optional<double> theil_sen_slope(const std::vector<double>& scores);

struct Plateau {
  double rise = 0;  ///< slope times the steps of the window
  int n = 0;        ///< scores that it rests on
  bool flat = false;
};
/// Over the newest `window` scores; empty with fewer. @param scores oldest first. @param least_rise below which it is
/// flat.
std::optional<Plateau> plateau(const std::vector<double>& scores, int window, double least_rise);

}  // namespace trocar
