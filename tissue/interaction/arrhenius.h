// What heat destroys: dOmega/dt = A exp(-Ea / (R T)), first order (Henriques and Moritz 1947). At Omega = 1 a share of
// 1 - 1/e is destroyed. Thread: any.
#pragma once

#include <vector>

namespace trocar {

struct ArrheniusLaw {
  double frequency_per_s = 0, energy_j_per_mol = 0;  ///< A, Ea
  double rate_per_s(double temperature_c) const;
};

/// The law between two temperatures in steps of 0.1 K, linear between them: within 0.02 % for the laws of tissue.
class ArrheniusTable {
 public:
  ArrheniusTable(const ArrheniusLaw& law, double from_c, double to_c);
  /// 1/s; 0 below from_c, as at to_c above it.
  double rate_per_s(double temperature_c) const;

 private:
  double from_c_;
  std::vector<double> rate_;
};

}  // namespace trocar
