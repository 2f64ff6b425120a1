#include "app/picture/maps/heat_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/picture/maps/colour_scale.h"

namespace trocar::heat_field_test {
namespace {

TraceSample tick(const Vec3& tip, double force_n = 0) {
  TraceSample out;
  out.tip_T = tip;
  out.force_T = Vec3(0, 0, force_n);
  out.contact = force_n > 0;
  return out;
}

Trace random_trace(int ticks) {
  Trace out;
  std::mt19937 random(7);
  std::normal_distribution<double> step(0, 0.0004);
  std::uniform_real_distribution<double> force(0, 3);
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < ticks; ++i) {
    at = 0.999 * at + Vec3(step(random), step(random), step(random));
    out.samples.push_back(tick(at, i % 3 == 0 ? force(random) : 0));
  }
  return out;
}

/// Straight from the definition, with a reach a cell's diagonal shorter or longer.
double defined(const Trace& trace, HeatOf of, bool flat, const Vec3& place, double reach) {
  double out = 0;
  for (const TraceSample& s : trace.samples) {
    Vec3 way = s.tip_T - place;
    if (flat) way.z() = 0;
    if (way.norm() >= reach || (of == HeatOf::kForce && !s.contact)) continue;
    out = of == HeatOf::kTime ? out + 1 / trace.rate_hz : std::max(out, s.force_T.norm());
  }
  return out;
}

TEST(HeatField, LiesBetweenTheDefinitionsWithACellLessAndACellMore) {
  const Trace trace = random_trace(4000);
  const double cell = std::sqrt(3.0) * HeatField::kCell;
  for (const HeatOf of : {HeatOf::kTime, HeatOf::kForce})
    for (const bool flat : {false, true}) {
      const HeatField field(trace, of, flat);
      std::mt19937 random(3);
      std::uniform_real_distribution<double> where(-0.012, 0.012);
      double most = 0;
      for (int i = 0; i < 200; ++i) {
        const Vec3 place(where(random), where(random), where(random));
        const double value = field.at(place);
        // A flat cell gathers over all heights, so its place along the board is no further off.
        EXPECT_GE(value, defined(trace, of, flat, place, HeatField::kReach - cell) - 1e-12);
        EXPECT_LE(value, defined(trace, of, flat, place, HeatField::kReach + cell) + 1e-12);
        most = std::max(most, value);
      }
      EXPECT_GT(most, 0);
    }
}

TEST(HeatField, SecondsOfATipThatRestsAreItsTime) {
  Trace trace;
  trace.rate_hz = 500;
  trace.samples.assign(1000, tick({0.01, 0.02, 0.03}));
  const HeatField time(trace, HeatOf::kTime, false), flat(trace, HeatOf::kTime, true);
  EXPECT_NEAR(time.at({0.01, 0.02, 0.03}), 2, 1e-9);
  EXPECT_NEAR(time.at({0.0129, 0.02, 0.03}), 2, 1e-9);
  EXPECT_EQ(time.at({0.0131, 0.02, 0.03}), 0);
  EXPECT_EQ(time.at({0.01, 0.02, 0.05}), 0);
  EXPECT_NEAR(flat.at({0.01, 0.02, 0.05}), 2, 1e-9) << "over the place at any height";
}

TEST(HeatField, ForceCountsInContactOnlyAndRubbishNotAtAll) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Trace trace;
  trace.samples = {tick({0, 0, 0}, 1.5), tick({0, 0, 0}, 0.5), tick({kNone, 0, 0}, 9), tick({0, 0, 0}, kNone),
                   tick({1e12, 0, 0}, 4)};
  TraceSample air = tick({0, 0, 0}, 7);
  air.contact = false;
  trace.samples.push_back(air);
  EXPECT_DOUBLE_EQ(HeatField(trace, HeatOf::kForce, false).at({0, 0.001, 0}), 1.5);
  EXPECT_TRUE(HeatField(Trace{}, HeatOf::kTime, false).empty());
  EXPECT_EQ(HeatField(Trace{}, HeatOf::kTime, false).at(Vec3::Zero()), 0);
}

/// CIE L* of sRGB, D65.
double lightness(const std::array<std::uint8_t, 3>& c) {
  const double weight[] = {0.2126, 0.7152, 0.0722};
  double y = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = c[i] / 255.0;
    y += weight[i] * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(Viridis, LightnessRisesInEvenStepsFromEndToEnd) {
  EXPECT_EQ(viridis(0), (std::array<std::uint8_t, 3>{68, 1, 84}));
  EXPECT_EQ(viridis(1), (std::array<std::uint8_t, 3>{253, 231, 37}));
  const double all = lightness(viridis(1)) - lightness(viridis(0));
  EXPECT_GT(all, 70);
  for (int i = 0; i < 20; ++i) {
    const double step = lightness(viridis((i + 1) / 20.0)) - lightness(viridis(i / 20.0));
    EXPECT_GT(step, 0.6 * all / 20) << i;
    EXPECT_LT(step, 1.4 * all / 20) << i;
  }
  EXPECT_EQ(viridis(-3), viridis(0));
  EXPECT_EQ(viridis(7), viridis(1));
  EXPECT_EQ(viridis(std::numeric_limits<double>::quiet_NaN()), viridis(0));
}

}  // namespace
}  // namespace trocar::heat_field_test
