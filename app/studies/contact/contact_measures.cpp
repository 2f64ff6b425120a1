#include "app/studies/contact/contact_measures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace trocar {
namespace {

constexpr double kLagStep = 1e-3;   // s
constexpr double kRounding = 1e-9;  // s, of sample times

/// Pearson's correlation of measured(t) with desired(t - lag).
double correlation(const Curve& desired, const Curve& measured, double lag_s) {
  double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t i = 0; i < measured.t.size(); ++i) {
    const double x = value_at(desired, measured.t[i] - lag_s), y = measured.y[i];
    n += 1, sx += x, sy += y, sxx += x * x, syy += y * y, sxy += x * y;
  }
  const double vx = n * sxx - sx * sx, vy = n * syy - sy * sy;
  return vx > 0 && vy > 0 ? (n * sxy - sx * sy) / std::sqrt(vx * vy) : 0;
}

}  // namespace

std::vector<Spell> spells(const Curve& curve, double threshold, double bridge_s) {
  std::vector<Spell> found;
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    if (!(std::abs(curve.y[i]) > threshold)) continue;
    if (found.empty() || curve.t[i] - found.back().to_s > bridge_s) found.push_back({curve.t[i], curve.t[i]});
    found.back().to_s = curve.t[i];
  }
  std::erase_if(found, [&](const Spell& s) { return s.to_s - s.from_s < bridge_s; });
  return found;
}

double peak(const Curve& curve) {
  double largest = 0;
  for (const double y : curve.y) largest = std::max(largest, std::abs(y));
  return largest;
}

double value_at(const Curve& curve, double t) {
  if (curve.t.empty()) throw std::invalid_argument("contact measures: an empty curve");
  const auto after = std::upper_bound(curve.t.begin(), curve.t.end(), t);
  if (after == curve.t.begin()) return curve.y.front();
  if (after == curve.t.end()) return curve.y.back();
  const auto i = static_cast<std::size_t>(after - curve.t.begin());
  const double share = (t - curve.t[i - 1]) / (curve.t[i] - curve.t[i - 1]);
  return curve.y[i - 1] + share * (curve.y[i] - curve.y[i - 1]);
}

double best_lag(const Curve& desired, const Curve& measured, double longest_s) {
  double best = 0, highest = -2;
  for (int i = 0; i * kLagStep <= longest_s + 1e-9; ++i) {
    const double c = correlation(desired, measured, i * kLagStep);
    if (c > highest) {
      highest = c;
      best = i * kLagStep;
    }
  }
  return best;
}

double magnitude_ratio(const Curve& desired, const Curve& measured, double lag_s) {
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < measured.t.size(); ++i) {
    const double x = value_at(desired, measured.t[i] - lag_s);
    xx += x * x;
    xy += x * measured.y[i];
  }
  return xx > 0 ? xy / xx : 0;
}

double mean_over(const Curve& curve, const Spell& spell) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    if (curve.t[i] < spell.from_s || curve.t[i] > spell.to_s) continue;
    sum += curve.y[i];
    n += 1;
  }
  return n > 0 ? sum / n : 0;
}

double unrest(const Curve& curve, const Spell& spell, double window_s) {
  std::vector<double> sum(curve.y.size() + 1, 0.0);
  for (std::size_t i = 0; i < curve.y.size(); ++i) sum[i + 1] = sum[i] + curve.y[i];
  const double half = 0.5 * window_s + kRounding;
  double largest = 0;
  std::size_t first = 0, last = 0;  // samples of the window: [first, last)
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    while (curve.t[first] < curve.t[i] - half) ++first;
    while (last < curve.t.size() && curve.t[last] <= curve.t[i] + half) ++last;
    if (curve.t[i] < spell.from_s || curve.t[i] > spell.to_s) continue;
    largest = std::max(largest, std::abs(curve.y[i] - (sum[last] - sum[first]) / static_cast<double>(last - first)));
  }
  return largest;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace trocar
