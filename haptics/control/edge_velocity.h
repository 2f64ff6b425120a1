// Velocity and position of one counter of which the board tells when it last moved (DaqSample::edge_age_us).
//
// An edge of the disc is a place: whoever knows when it passed knows position and time together, without the quantum.
// Velocity is one count over the time between the last two edges, no more than one count over the silence since, and
// exactly zero after kSilentS; it lags by half the time between edges. Position runs on from the last edge with the
// velocity, within the count. An edge that comes while the count stands still (out and back) is the last one again.
// Units: counts, s. Thread: haptic task; no allocation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trocar {

class EdgeVelocity {
 public:
  static constexpr double kSilentS = 0.050;

  explicit EdgeVelocity(double period_s) : period_s_(period_s) {}

  void reset() { known_ = Known::kNothing; }
  /// @param count rounded down; @param age_us as DaqSample. @return velocity, counts/s.
  double update(std::int64_t count, std::uint32_t elapsed_periods, std::uint16_t age_us);
  /// @param velocity to run on with, counts/s. @return within the last count, whose middle stands for not known.
  double position(double velocity) const;

 private:
  double period_s_;
  std::int64_t count_ = 0, edge_ = 0, edge_before_ = 0;  ///< edge n lies between the counts n - 1 and n
  double since_s_ = 0, apart_s_ = 0;                     ///< since the last edge; between the last two
  enum class Known { kNothing, kCount, kEdge, kTwoEdges } known_ = Known::kNothing;
};

inline double EdgeVelocity::update(std::int64_t count, std::uint32_t elapsed_periods, std::uint16_t age_us) {
  const double elapsed_s = std::max<std::uint32_t>(1, elapsed_periods) * period_s_, age_s = 1e-6 * age_us;
  since_s_ += elapsed_s;
  if (known_ == Known::kNothing) count_ = count, known_ = Known::kCount;
  if (count != count_ || (known_ > Known::kCount && age_s <= elapsed_s)) {
    edge_before_ = edge_;
    if (count != count_) edge_ = count > count_ ? count : count + 1;
    apart_s_ = std::max(since_s_ - age_s, 1e-6);
    since_s_ = std::min(age_s, elapsed_s);
    known_ = known_ == Known::kCount ? Known::kEdge : Known::kTwoEdges;
    count_ = count;
  }
  if (known_ != Known::kTwoEdges || since_s_ > kSilentS) return 0;
  const double between = static_cast<double>(edge_ - edge_before_) / apart_s_;
  return std::clamp(between, -1 / since_s_, 1 / since_s_);
}

inline double EdgeVelocity::position(double velocity) const {
  const auto low = static_cast<double>(count_);
  if (known_ <= Known::kCount) return low + 0.5;
  return std::clamp(static_cast<double>(edge_) + velocity * std::min(since_s_, kSilentS), low, low + 1);
}

}  // namespace trocar
