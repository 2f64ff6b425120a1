// The filter of all motion metrics: gain, phase, ends, and what it does to a quantised encoder.
#include "scenarios/scoring/trace_filter.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace trocar::trace_filter_test {
namespace {

std::vector<double> sine(double frequency_hz, double rate_hz, std::size_t n) {
  std::vector<double> signal(n);
  for (std::size_t i = 0; i < n; ++i)
    signal[i] = std::sin(2 * std::numbers::pi * frequency_hz * static_cast<double>(i) / rate_hz);
  return signal;
}

Trace straight_line(double rate_hz, double seconds, double speed) {
  Trace trace;
  trace.rate_hz = rate_hz;
  for (int i = 0; i <= static_cast<int>(seconds * rate_hz); ++i) {
    TraceSample sample;
    sample.t_s = i / rate_hz;
    sample.tip_T = Vec3(speed * sample.t_s, 0, 0);
    trace.samples.push_back(sample);
  }
  return trace;
}

TEST(LowPass, HasTheSquaredButterworthGainAndNoPhase) {
  for (const double f : {1.0, 5.0, 10.0, 20.0}) {
    const auto in = sine(f, 1000, 8000);
    const auto out = low_pass(in, 1000, 10);
    double in_phase = 0, quadrature = 0, power = 0;
    for (std::size_t i = 2000; i < 6000; ++i) {
      const double angle = 2 * std::numbers::pi * f * static_cast<double>(i) / 1000;
      in_phase += out[i] * std::sin(angle);
      quadrature += out[i] * std::cos(angle);
      power += in[i] * in[i];
    }
    // Analogue prototype; the bilinear transform with pre-warping is exact at 10 Hz and within 0.2 % of it here.
    const double ratio = std::tan(std::numbers::pi * f / 1000) / std::tan(std::numbers::pi * 10 / 1000);
    EXPECT_NEAR(in_phase / power, 1 / (1 + std::pow(ratio, 4)), 1e-3) << f;
    EXPECT_NEAR(quadrature / power, 0, 1e-3) << f;
  }
}

TEST(LowPass, LeavesConstantsAndRampsAlone) {
  std::vector<double> ramp(500);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = 3 + 0.01 * static_cast<double>(i);
  const auto out = low_pass(ramp, 1000, 10);
  ASSERT_EQ(out.size(), ramp.size());
  EXPECT_NEAR(out[250], ramp[250], 1e-6);
  const auto constant = low_pass(std::vector<double>(50, 2.5), 1000, 10);
  for (const double value : constant) EXPECT_NEAR(value, 2.5, 1e-12);
}

TEST(LowPass, PassesWhatItCannotFilter) {
  const std::vector<double> one = {4};
  EXPECT_EQ(low_pass(one, 1000, 10), one);
  const auto coarse = sine(1, 20, 40);
  EXPECT_EQ(low_pass(coarse, 20, 10), coarse);
}

TEST(Resample, InterpolatesAcrossAMissingTick) {
  const std::vector<double> result = resample({0, 1, 3, 4}, {0, 10, 30, 40}, 1);
  EXPECT_EQ(result, (std::vector<double>{0, 10, 20, 30, 40}));
  EXPECT_EQ(resample({}, {}, 10), std::vector<double>{});
  EXPECT_EQ(resample({2}, {7}, 10), std::vector<double>{7});
}

TEST(SmoothPath, GivesPositionAndSpeedAtOneHundredHertz) {
  const SmoothPath path = smooth_path(straight_line(1000, 2, 0.05), kMotionCutoffHz);
  EXPECT_DOUBLE_EQ(path.rate_hz, 100);
  ASSERT_EQ(path.position.size(), 201u);
  ASSERT_EQ(path.speed.size(), 201u);
  EXPECT_NEAR(path.speed[100], 0.05, 1e-6);
  EXPECT_NEAR((path.position.back() - path.position.front()).norm(), 0.1, 1e-4);
  EXPECT_TRUE(smooth_path(Trace{}, kMotionCutoffHz).position.empty());
}

TEST(SmoothPath, RemovesTheInflationOfAQuantisedEncoder) {
  // A reach of 100 mm in 1 s read in steps of 0.2 mm on each axis: raw samples inflate its length by a third.
  Trace trace;
  double raw = 0, truth = 0;
  Vec3 exact_before = Vec3::Zero();
  const auto stepped = [](double x) { return std::round(x / 2e-4) * 2e-4; };
  for (int i = 0; i <= 1000; ++i) {
    const double s = i / 1000.0, p = 0.1 * s * s * s * (10 + s * (-15 + 6 * s));
    const Vec3 exact(p * 0.8, p * 0.6, 0.01 * std::sin(std::numbers::pi * s));
    TraceSample sample;
    sample.t_s = s;
    sample.tip_T = exact.unaryExpr(stepped);
    if (i > 0) {
      raw += (sample.tip_T - trace.samples.back().tip_T).norm();
      truth += (exact - exact_before).norm();
    }
    exact_before = exact;
    trace.samples.push_back(sample);
  }
  const SmoothPath path = smooth_path(trace, kMotionCutoffHz);
  double length = 0;
  for (std::size_t i = 1; i < path.position.size(); ++i) length += (path.position[i] - path.position[i - 1]).norm();
  EXPECT_GT(raw / truth, 1.2);
  EXPECT_NEAR(length / truth, 1, 0.01);
}

}  // namespace
}  // namespace trocar::trace_filter_test
