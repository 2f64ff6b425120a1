// Smoothness of one movement from its speed profile: spectral arc length, dimensionless jerk, speed peaks, tremor.
//
// SPARC: Balasubramanian, Melendez-Calderon, Roby-Brami, Burdet, "On the analysis of movement smoothness", J
// NeuroEngineering Rehabil 12:112 (2015): minus the arc length of the normalised magnitude spectrum of the speed, up to
// an adaptive cut-off (last bin above the amplitude threshold, at most fc). Closer to 0 is smoother.
// DLJ = -(D^3 / v_peak^2) sum |d2v/dt2|^2 dt ; LDLJ = -ln |DLJ|.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

/// @param speed m/s (any unit: the value is dimensionless). Empty when the speed is zero throughout.
std::optional<double> spectral_arc_length(const std::vector<double>& speed, double rate_hz, double cutoff_hz = 10,
                                          double amplitude_threshold = 0.05);
std::optional<double> dimensionless_jerk(const std::vector<double>& speed, double rate_hz);
std::optional<double> log_dimensionless_jerk(const std::vector<double>& speed, double rate_hz);

/// T^5 / A^2 * integral |jerk|^2 dt with A the displacement, T the duration: 720 for the minimum-jerk movement.
/// The normalised jerk of the TrEndo papers is sqrt(0.5 * this).
std::optional<double> normalised_squared_jerk(const std::vector<Vec3>& position, double rate_hz);

/// Local maxima whose prominence (height above the higher of the two flanking minima) is at least `prominence`.
int count_peaks(const std::vector<double>& signal, double prominence);

/// Half-open index ranges in which the signal stays above (or, with below = true, below) a level for at least
/// `min_samples`.
std::vector<std::pair<std::size_t, std::size_t>> runs(const std::vector<double>& signal, double level,
                                                      std::size_t min_samples, bool below = false);

/// Root-mean-square displacement in a frequency band (default: physiological tremor), and the share of velocity power.
struct Tremor {
  double rms_m = 0;        ///< displacement in the band
  double power_share = 0;  ///< velocity power in the band / velocity power above 0.3 Hz
};
/// @param position uniform samples, m. Hann window. Empty below 1 s of data.
std::optional<Tremor> tremor(const std::vector<Vec3>& position, double rate_hz, double low_hz = 8, double high_hz = 12);

}  // namespace trocar
