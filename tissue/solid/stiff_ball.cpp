#include "tissue/solid/stiff_ball.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr int kBallSamples = 8;            // along each edge, as a cell's fill is sampled
constexpr double kSphereTensor = 2 / 5.0;  // of Eshelby's tensor for a sphere that keeps its volume
constexpr double kFarBall = 12;            // contact radii from the contact, beyond which a ball is not felt: below 1 %
constexpr double kMostTaken = 0.9;         // of the compliance, to the first order

/// Sums over a raster of a cube's inside.
template <class Value>
double over_cube(const Vec3& low, double edge_m, Value value) {
  double sum = 0;
  for (int i = 0; i < kBallSamples; ++i)
    for (int j = 0; j < kBallSamples; ++j)
      for (int k = 0; k < kBallSamples; ++k)
        sum += value(Vec3(low + edge_m / kBallSamples * (Vec3(i, j, k) + Vec3::Constant(0.5))));
  return sum / (kBallSamples * kBallSamples * kBallSamples);
}

bool within(const StiffBall& ball, const Vec3& place) {
  return (place - ball.centre_m).squaredNorm() < ball.radius_m * ball.radius_m;
}

}  // namespace

double mixed_stiffness(double share, double ratio) {
  return 1 + share * (ratio - 1) / (1 + kSphereTensor * (1 - share) * (ratio - 1));
}

double cell_stiffness(const Lattice& lattice, const LatticeCell& cell, std::span<const StiffBall> balls) {
  double stiffness = 1;
  if (cell.part != 0) return stiffness;
  const Vec3 low = lattice.origin_m + lattice.cell_m * Vec3(cell.place[0], cell.place[1], cell.place[2]);
  for (const StiffBall& ball : balls) {
    const double share = over_cube(low, lattice.cell_m, [&](const Vec3& at) { return within(ball, at) ? 1.0 : 0.0; });
    stiffness *= mixed_stiffness(std::min(1.0, share / cell.fill), ball.ratio);  // none of it is outside the organ
  }
  return stiffness;
}

double stiffer_under(const Vec3& place, const Vec3& inward, double contact_radius_m, std::span<const StiffBall> balls) {
  const double least = 4 / std::numbers::pi * contact_radius_m;
  const double all = 2 * std::numbers::pi / 3 / least;  // integral of cos^2 / d^4 from there on
  double taken = 0;
  for (const StiffBall& ball : balls) {
    if ((ball.centre_m - place).norm() > kFarBall * contact_radius_m + ball.radius_m) continue;
    const Vec3 low = ball.centre_m - Vec3::Constant(ball.radius_m);
    const double held = over_cube(low, 2 * ball.radius_m, [&](const Vec3& at) {
      const Vec3 way = at - place;
      const double d = way.norm(), along = way.dot(inward);
      return within(ball, at) && d > least && along > 0 ? along * along / std::pow(d, 6) : 0;
    });
    taken += held * std::pow(2 * ball.radius_m, 3) / all * (1 - 1 / ball.ratio);
  }
  return 1 / (1 - std::min(kMostTaken, taken));
}

}  // namespace trocar
