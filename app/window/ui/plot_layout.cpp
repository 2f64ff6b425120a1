#include "app/window/ui/plot_layout.h"

#include <algorithm>
#include <cmath>

#include "trainees/markup/svg.h"

namespace trocar {
namespace {

bool inside(const Area& a, const Area& all) {
  return a.x >= all.x - 0.01 && a.y >= all.y - 0.01 && a.x + a.width <= all.x + all.width + 0.01 &&
         a.y + a.height <= all.y + all.height + 0.01;
}

void fill_ticks(Axis& axis, double step) {
  axis.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const auto first = static_cast<long>(std::ceil(axis.low / step - 1e-6)),
             last = static_cast<long>(std::floor(axis.high / step + 1e-6));
  for (long i = first; i <= last; ++i) axis.ticks.push_back(static_cast<double>(i) * step);
}

}  // namespace

Axis nice_axis(double low, double high, int most, bool widen) {
  Axis axis;
  if (!std::isfinite(low) || !std::isfinite(high)) low = high = 0;
  if (high - low < 1e-9) high = low + 1;
  const int intervals = std::max(2, most) - 1;
  double step = svg::nice_step(high - low, intervals);
  // Widening can add a tick at either end: then the next round step.
  while (widen && std::ceil(high / step - 1e-6) - std::floor(low / step + 1e-6) > intervals)
    step = svg::nice_step(step * 1.01, 1);
  axis.low = widen ? std::floor(low / step + 1e-6) * step : low;
  axis.high = widen ? std::ceil(high / step - 1e-6) * step : high;
  fill_ticks(axis, step);
  return axis;
}

Axis count_axis(int low, int high, int most) {
  Axis axis;
  axis.low = low;
  axis.high = std::max(low + 1, high);
  fill_ticks(axis, std::max(1.0, svg::nice_step(axis.high - axis.low, std::max(1, most - 1))));
  return axis;
}

bool overlap(const Area& a, const Area& b, double air) {
  return a.x < b.x + b.width + air && b.x < a.x + a.width + air && a.y < b.y + b.height + air &&
         b.y < a.y + a.height + air;
}

std::vector<std::optional<Area>> place_labels(const std::vector<LabelWish>& wishes, const Area& within,
                                              std::vector<Area> taken, double air) {
  std::vector<std::optional<Area>> out;
  for (const LabelWish& wish : wishes) {
    std::optional<Area> place;
    const double reach = within.height + wish.height;
    for (double away = 0; away <= reach && !place; away += std::max(1.0, wish.height / 2)) {
      for (const double side : {0.0, -wish.width - 2 * air, -wish.width / 2 - air}) {
        for (const double y : {wish.y - air - wish.height - away, wish.y + air + away}) {
          const Area at{wish.x + air + side, y, wish.width, wish.height};
          const bool clear =
              std::none_of(taken.begin(), taken.end(), [&](const Area& t) { return overlap(at, t, air); });
          if (!place && clear && inside(at, within)) place = at;
        }
      }
    }
    if (place) taken.push_back(*place);
    out.push_back(place);
  }
  return out;
}

}  // namespace trocar
