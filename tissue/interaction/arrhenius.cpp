#include "tissue/interaction/arrhenius.h"

#include <cmath>

namespace trocar {
namespace {

constexpr double kZeroCelsius = 273.15, kGasConstant = 8.314462618;  // K, J/(mol K)
constexpr double kRateStep = 0.1;                                    // K

}  // namespace

double ArrheniusLaw::rate_per_s(double temperature_c) const {
  return frequency_per_s * std::exp(-energy_j_per_mol / (kGasConstant * (temperature_c + kZeroCelsius)));
}

ArrheniusTable::ArrheniusTable(const ArrheniusLaw& law, double from_c, double to_c) : from_c_(from_c) {
  const int steps = static_cast<int>(std::lround((to_c - from_c) / kRateStep));
  for (int i = 0; i <= steps; ++i) rate_.push_back(law.rate_per_s(from_c + kRateStep * i));
}

double ArrheniusTable::rate_per_s(double temperature_c) const {
  if (temperature_c < from_c_) return 0;
  const double at = (temperature_c - from_c_) / kRateStep;
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= rate_.size()) return rate_.back();
  return rate_[below] + (at - static_cast<double>(below)) * (rate_[below + 1] - rate_[below]);
}

}  // namespace trocar
