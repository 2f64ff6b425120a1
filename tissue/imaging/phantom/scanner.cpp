#include "tissue/imaging/phantom/scanner.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace trocar::phantom {
namespace {

/// Normal deviates by Box and Muller from a named generator: the same on every machine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}

  double operator()() {
    if (has_spare_) return has_spare_ = false, spare_;
    const double u = (static_cast<double>(engine_() >> 11) + 1) * 0x1p-53,
                 v = static_cast<double>(engine_() >> 11) * 0x1p-53;
    const double radius = std::sqrt(-2 * std::log(u)), angle = 2 * std::numbers::pi * v;
    spare_ = radius * std::sin(angle), has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// Half of a symmetric kernel of sum 1: [0] the middle.
std::vector<float> point_spread(double voxel) {
  const double sigma = kPointSpreadMm / voxel;
  std::vector<double> half;
  double sum = 0;
  for (int n = 0; n <= static_cast<int>(std::ceil(3 * sigma)); ++n) {
    half.push_back(std::exp(-0.5 * n * n / (sigma * sigma)));
    sum += n == 0 ? half.back() : 2 * half.back();
  }
  std::vector<float> kernel;
  for (const double value : half) kernel.push_back(static_cast<float>(value / sum));
  return kernel;
}

void blur_line(std::vector<float>& line, const std::vector<float>& from, const std::vector<float>& kernel) {
  const auto length = static_cast<std::ptrdiff_t>(line.size()), reach = static_cast<std::ptrdiff_t>(kernel.size()) - 1;
  for (std::ptrdiff_t n = 0; n < length; ++n) {
    float sum = kernel[0] * from[static_cast<std::size_t>(n)];
    for (std::ptrdiff_t s = 1; s <= reach; ++s)
      sum += kernel[static_cast<std::size_t>(s)] * (from[static_cast<std::size_t>(std::max(n - s, std::ptrdiff_t{0}))] +
                                                    from[static_cast<std::size_t>(std::min(n + s, length - 1))]);
    line[static_cast<std::size_t>(n)] = sum;
  }
}

void blur_slice(std::vector<float>& values, const std::array<int, 3>& size, const std::vector<float>& kernel) {
  std::size_t stride = 1;
  for (const int extent : size) {
    const auto length = static_cast<std::size_t>(extent);
    std::vector<float> from(length), line(length);
    for (std::size_t start = 0; start < values.size(); ++start) {
      if (start / stride % length != 0) {
        start += stride * (length - 1) - 1;  // to the next line's first voxel
        continue;
      }
      for (std::size_t n = 0; n < length; ++n) from[n] = values[start + n * stride];
      blur_line(line, from, kernel);
      for (std::size_t n = 0; n < length; ++n) values[start + n * stride] = line[n];
    }
    stride *= length;
  }
}

}  // namespace

void scan(std::vector<float>& hounsfield, const std::array<int, 3>& size, const Scanner& scanner) {
  const std::vector<float> kernel = point_spread(scanner.voxel_mm);
  double left = 0;
  for (std::size_t n = 0; n < kernel.size(); ++n) left += (n == 0 ? 1 : 2) * static_cast<double>(kernel[n]) * kernel[n];
  const double white = scanner.noise_hu / std::pow(left, 1.5);  // the same kernel along three axes
  Noise noise(scanner.seed);
  for (float& value : hounsfield) value += static_cast<float>(white * noise());
  blur_slice(hounsfield, size, kernel);
}

}  // namespace trocar::phantom
