#include "scenarios/scoring/fourier.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace trocar {

std::size_t next_power_of_two(std::size_t n) {
  std::size_t size = 1;
  while (size < n) size *= 2;
  return size;
}

std::vector<std::complex<double>> fourier_transform(const std::vector<double>& signal, std::size_t size) {
  assert(size > 0 && (size & (size - 1)) == 0);
  std::vector<std::complex<double>> x(size);
  std::copy_n(signal.begin(), std::min(signal.size(), size), x.begin());
  for (std::size_t i = 1, j = 0; i < size; ++i) {  // bit-reversed order
    std::size_t bit = size / 2;
    for (; j & bit; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  std::vector<std::complex<double>> roots(size / 2);
  for (std::size_t k = 0; k < roots.size(); ++k)
    roots[k] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(size));
  for (std::size_t length = 2; length <= size; length *= 2) {
    const std::size_t stride = size / length;
    for (std::size_t start = 0; start < size; start += length) {
      for (std::size_t k = 0; k < length / 2; ++k) {
        const auto even = x[start + k];
        const auto odd = roots[k * stride] * x[start + k + length / 2];
        x[start + k] = even + odd;
        x[start + k + length / 2] = even - odd;
      }
    }
  }
  return x;
}

}  // namespace trocar
