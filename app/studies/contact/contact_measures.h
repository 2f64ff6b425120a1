// What a pair of desired and measured curves says: when there was contact, how late the measured one is, how large, how
// calm. The curves have their own times: the desired one a sample each tick, the measured one each reading of the
// sensor. Pure functions; SI; thread: any.
#pragma once

#include <vector>

#include "haptics/quantities.h"

namespace trocar {

struct Curve {
  std::vector<double> t, y;  ///< t rising
};

struct Spell {
  double from_s = 0, to_s = 0;
};

/// Times in which |y| is above `threshold`. Gaps shorter than `bridge_s` count as within, spells shorter than it are
/// left out.
std::vector<Spell> spells(const Curve& curve, double threshold, double bridge_s);

/// Largest |y|.
double peak(const Curve& curve);

/// y at t, linear between samples, held beyond the ends. @throws std::invalid_argument for an empty curve.
double value_at(const Curve& curve, double t);

/// Lag in 0 to `longest_s`, in steps of 1 ms, at which the measured curve correlates best with the desired one.
double best_lag(const Curve& desired, const Curve& measured, double longest_s);

/// Slope of the line through the origin that fits measured(t) over desired(t - lag) best.
double magnitude_ratio(const Curve& desired, const Curve& measured, double lag_s);

/// Mean over a spell; zero when no sample lies in it.
double mean_over(const Curve& curve, const Spell& spell);

/// Largest |y - centred mean of window_s| in the spell.
double unrest(const Curve& curve, const Spell& spell, double window_s);

/// Angle between two vectors, rad.
double angle_between(const Vec3& a, const Vec3& b);

}  // namespace trocar
