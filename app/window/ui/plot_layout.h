// Axes and places of labels for small plots: round ticks, and labels that never lie over one another. Pure, px. Thread:
// any.
#pragma once

#include <optional>
#include <vector>

#include "app/window/ui/ui.h"

namespace trocar {

struct Axis {
  double low = 0, high = 1;
  std::vector<double> ticks = {};
  int decimals = 0;  ///< that the ticks need
};

/// Steps of 1, 2 or 5 times a power of ten, at most `most` ticks (at least 2). @param widen: ends lie on ticks.
Axis nice_axis(double low, double high, int most, bool widen = true);

/// Ticks at whole numbers only: attempts.
Axis count_axis(int low, int high, int most);

/// A label that wants to stand at a point.
struct LabelWish {
  double x = 0, y = 0;  ///< the point
  double width = 0, height = 0;
};

/// Places in the order of the wishes: beside the point, else above or below it further and further away, within
/// `within`, clear of `taken` and of each other by `air`. Nothing where there is no room.
std::vector<std::optional<Area>> place_labels(const std::vector<LabelWish>& wishes, const Area& within,
                                              std::vector<Area> taken, double air = 2);

bool overlap(const Area& a, const Area& b, double air = 0);

}  // namespace trocar
