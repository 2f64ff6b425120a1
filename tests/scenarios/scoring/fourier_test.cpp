// The transform against the defining sum, and against identities.
#include "scenarios/scoring/fourier.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace trocar::fourier_test {
namespace {

TEST(FourierTransform, AgreesWithTheDefiningSum) {
  std::mt19937_64 generator(7);
  std::vector<double> signal(32);
  for (double& value : signal) value = static_cast<double>(generator() >> 11) * 0x1.0p-53 - 0.5;
  const auto fast = fourier_transform(signal, 32);
  for (std::size_t k = 0; k < 32; ++k) {
    std::complex<double> slow = 0;
    for (std::size_t n = 0; n < 32; ++n)
      slow += signal[n] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * n) / 32);
    EXPECT_NEAR(std::abs(fast[k] - slow), 0, 1e-12) << k;  // 32 additions of order 1 in double
  }
}

TEST(FourierTransform, KeepsTheEnergy) {
  const std::vector<double> signal = {1, -2, 3, 0.5, 0, 4, -1};
  const auto spectrum = fourier_transform(signal, 8);
  double in = 0, out = 0;
  for (const double value : signal) in += value * value;
  for (const auto& value : spectrum) out += std::norm(value);
  EXPECT_NEAR(out / 8, in, 1e-12);
}

TEST(FourierTransform, PadsAndCutsToSize) {
  EXPECT_EQ(fourier_transform({1, 2, 3}, 16).size(), 16u);
  EXPECT_DOUBLE_EQ(fourier_transform({1, 2, 3, 100}, 2)[0].real(), 3);
  EXPECT_DOUBLE_EQ(fourier_transform({5}, 1)[0].real(), 5);
}

TEST(FourierTransform, RoundsSizesUpToPowersOfTwo) {
  EXPECT_EQ(next_power_of_two(0), 1u);
  EXPECT_EQ(next_power_of_two(1), 1u);
  EXPECT_EQ(next_power_of_two(200), 256u);
  EXPECT_EQ(next_power_of_two(256), 256u);
}

}  // namespace
}  // namespace trocar::fourier_test
