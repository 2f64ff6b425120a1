// Listens to the formulas: pitch by FFT, ends, loudness, band, and that no two tones are alike.
#include "app/window/sound/tones.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <gtest/gtest.h>
#include <unsupported/Eigen/FFT>

namespace trocar::tones_test {
namespace {

constexpr double kRate_hz = 44100;

/// Power by frequency of a stretch, zero-padded to 65536: bins of 0.67 Hz.
std::vector<double> spectrum(const std::vector<float>& samples, double from_s, double to_s) {
  constexpr std::size_t kLength = 1 << 16;
  std::vector<double> padded(kLength, 0.0);
  const auto first = static_cast<std::size_t>(from_s * kRate_hz);
  const auto last = std::min(samples.size(), static_cast<std::size_t>(to_s * kRate_hz));
  for (std::size_t i = first; i < last; ++i) padded[i - first] = static_cast<double>(samples[i]);
  std::vector<std::complex<double>> bins;
  Eigen::FFT<double> fft;
  fft.fwd(bins, padded);
  std::vector<double> power(kLength / 2);
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = std::norm(bins[i]);
  return power;
}

double hz(std::size_t bin) { return static_cast<double>(bin) * kRate_hz / (1 << 16); }

double loudest_hz(const std::vector<float>& samples, double from_s, double to_s) {
  const auto power = spectrum(samples, from_s, to_s);
  return hz(static_cast<std::size_t>(std::max_element(power.begin(), power.end()) - power.begin()));
}

double share_above(const std::vector<float>& samples, double limit_hz) {
  const auto power = spectrum(samples, 0, 10);
  double above = 0, all = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    all += power[i];
    if (hz(i) > limit_hz) above += power[i];
  }
  return above / all;
}

struct Heard {
  Tone tone;
  double from_s, to_s, hz;
};

TEST(Tones, HaveThePitchOfTheirNotes) {
  const std::vector<Heard> heard{{Tone::kTouch, 0, 0.07, 659.26},   {Tone::kRelease, 0, 0.07, 440},
                                 {Tone::kGood, 0, 0.10, 659.26},    {Tone::kGood, 0.12, 0.28, 880},
                                 {Tone::kTooMuch, 0, 0.12, 233.08}, {Tone::kWarning, 0.2, 0.34, 523.25},
                                 {Tone::kFault, 0, 0.22, 392},      {Tone::kFault, 0.44, 0.78, 196},
                                 {Tone::kDone, 0, 0.13, 523.25},    {Tone::kDone, 0.41, 0.75, 1046.5}};
  for (const Heard& one : heard) {
    const double pitch = loudest_hz(tone_samples(one.tone, kRate_hz), one.from_s, one.to_s);
    EXPECT_NEAR(pitch, one.hz, 0.01 * one.hz)
        << static_cast<int>(one.tone) << " at " << one.from_s;  // a sixth of a semitone
  }
}

TEST(Tones, GoodRisesAndFaultFalls) {
  const auto good = tone_samples(Tone::kGood, kRate_hz), fault = tone_samples(Tone::kFault, kRate_hz);
  EXPECT_GT(loudest_hz(good, 0.15, 0.3), loudest_hz(good, 0, 0.1));
  EXPECT_LT(loudest_hz(fault, 0.5, 0.8), loudest_hz(fault, 0, 0.2));
}

TEST(Tones, BeginAndEndInSilenceWithoutAStep) {
  for (int i = 0; i < kTones; ++i) {
    const auto samples = tone_samples(static_cast<Tone>(i), kRate_hz);
    ASSERT_GT(samples.size(), 1000u);
    EXPECT_EQ(samples.front(), 0) << i;
    EXPECT_EQ(samples.back(), 0) << i;
    float step = 0;
    for (std::size_t n = 1; n < samples.size(); ++n) step = std::max(step, std::abs(samples[n] - samples[n - 1]));
    EXPECT_LT(step, 0.10f) << i;  // 1 kHz at 0.45 moves by 0.064 a sample
    for (std::size_t n = 0; n < 20; ++n) EXPECT_LT(std::abs(samples[n]), 0.02f) << i;
  }
}

TEST(Tones, AreNeitherLoudNorShrillNorLong) {
  for (int i = 0; i < kTones; ++i) {
    const auto samples = tone_samples(static_cast<Tone>(i), kRate_hz);
    float peak = 0;
    for (const float s : samples) peak = std::max(peak, std::abs(s));
    EXPECT_LE(peak, 0.7f) << i;
    EXPECT_GT(peak, 0.2f) << i;
    EXPECT_LT(share_above(samples, 4000), 1e-5) << i;
    EXPECT_LT(static_cast<double>(samples.size()), 1.0 * kRate_hz) << i;
  }
}

TEST(Tones, AreDistinct) {
  for (int a = 0; a < kTones; ++a) {
    for (int b = a + 1; b < kTones; ++b) {
      auto one = tone_samples(static_cast<Tone>(a), 8000), two = tone_samples(static_cast<Tone>(b), 8000);
      one.resize(std::max(one.size(), two.size()));
      two.resize(one.size());
      double product = 0, first = 0, second = 0;
      for (std::size_t i = 0; i < one.size(); ++i) {
        product += static_cast<double>(one[i] * two[i]);
        first += static_cast<double>(one[i] * one[i]);
        second += static_cast<double>(two[i] * two[i]);
      }
      EXPECT_LT(std::abs(product) / std::sqrt(first * second), 0.8) << a << ' ' << b;
    }
  }
}

TEST(Tones, SameAtEveryRate) {
  const auto low = tone_samples(Tone::kDone, 11025), high = tone_samples(Tone::kDone, 44100);
  for (std::size_t i = 0; i < low.size() && 4 * i < high.size(); i += 7) EXPECT_NEAR(low[i], high[4 * i], 1e-6);
}

TEST(HeldTones, RepeatWithoutASeam) {
  for (int i = 0; i < kHeldTones; ++i) {
    const auto samples = held_samples(static_cast<HeldTone>(i), kRate_hz);
    ASSERT_EQ(samples.size(), 44100u);
    float step = 0, peak = 0;
    for (std::size_t n = 1; n < samples.size(); ++n) step = std::max(step, std::abs(samples[n] - samples[n - 1]));
    for (const float s : samples) peak = std::max(peak, std::abs(s));
    EXPECT_LE(std::abs(samples.front() - samples.back()), step);
    EXPECT_LE(peak, 0.7f);
    EXPECT_LT(share_above(samples, 4000), 1e-5);
  }
  EXPECT_NEAR(loudest_hz(held_samples(HeldTone::kForce, kRate_hz), 0, 1), 294, 1);
  EXPECT_NEAR(loudest_hz(held_samples(HeldTone::kCautery, kRate_hz), 0, 1), 750, 1);
}

TEST(HeldTones, ComeAndGoSmoothly) {
  double gain = 0, before = 0;
  for (int picture = 0; picture < 20; ++picture) {
    gain = smoothed_gain(gain, 2);  // limited to 1
    EXPECT_GT(gain, before);
    EXPECT_LT(gain - before, 0.34);
    before = gain;
  }
  EXPECT_NEAR(gain, 1, 1e-3);
  int pictures = 0;
  while (gain > 0 && pictures < 100) gain = smoothed_gain(gain, -1), ++pictures;
  EXPECT_EQ(gain, 0);
  EXPECT_LT(pictures, 25);
}

}  // namespace
}  // namespace trocar::tones_test
