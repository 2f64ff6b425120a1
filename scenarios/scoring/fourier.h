// Discrete Fourier transform of a real signal, radix 2 (Cooley and Tukey 1965). Pure, deterministic.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace trocar {

/// Smallest power of two that is not below n (1 for n = 0).
std::size_t next_power_of_two(std::size_t n);
/// X_k = sum_n x_n exp(-2 pi i k n / size). @param size power of two; the signal is padded with zeros or cut to it.
std::vector<std::complex<double>> fourier_transform(const std::vector<double>& signal, std::size_t size);

}  // namespace trocar
