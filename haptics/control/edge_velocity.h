// Velocity and position of one counter of which the board tells when it last moved (DaqSample::edge_age_us).
//
// An edge of the disc is a place: whoever knows when it passed knows position and time together, without the quantum.
// Velocity is one count over the time between the last two edges, no more than one count over the silence since, and
// exactly zero after kSilentS; it lags by half the time between edges. Position starts anew at each edge, moves on with
// the velocity, never leaves the count, and stays where it is in silence. An edge that came while the count stands
// still (out and back) is the one nearer to where the position was expected. Units: counts, s. Thread: haptic task; no
// allocation.
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
  /// @param count rounded down; @param age_us as DaqSample, not 0. @return velocity, counts/s.
  double update(std::int64_t count, std::uint32_t elapsed_periods, std::uint16_t age_us);
  /// Moves on from the last update. @param velocity best known, counts/s. @return position within the count.
  double advance(double velocity);
  double position() const { return position_; }

 private:
  static constexpr double kSameEdgeS = 2e-6;  ///< two ages that differ by no more are those of one edge

  double period_s_;
  std::int64_t count_ = 0, edge_ = 0, edge_before_ = 0;  ///< edge n lies between the counts n - 1 and n
  double since_s_ = 0, apart_s_ = 0;                     ///< since the last edge; between the last two
  double elapsed_s_ = 0;                                 ///< that position_ has not moved on yet
  double position_ = 0, expected_ = 0;                   ///< now; in a period, if all goes on
  enum class Known { kNothing, kCount, kEdge, kTwoEdges } known_ = Known::kNothing;
};

inline double EdgeVelocity::update(std::int64_t count, std::uint32_t elapsed_periods, std::uint16_t age_us) {
  elapsed_s_ = std::max<std::uint32_t>(1, elapsed_periods) * period_s_;
  const double age_s = std::min(1e-6 * age_us, elapsed_s_);
  if (known_ == Known::kNothing) {
    count_ = count;
    position_ = expected_ = static_cast<double>(count) + 0.5;
    since_s_ = 0;
    known_ = Known::kCount;
  }
  since_s_ += elapsed_s_;
  const bool moved = count != count_;
  if (moved || (known_ > Known::kCount && 1e-6 * age_us < std::min(since_s_ - kSameEdgeS, elapsed_s_))) {
    edge_before_ = edge_;
    if (moved)
      edge_ = count > count_ ? count : count + 1;
    else
      edge_ = expected_ < static_cast<double>(count) + 0.5 ? count : count + 1;
    apart_s_ = std::max(since_s_ - age_s, kSameEdgeS);
    since_s_ = elapsed_s_ = age_s;
    position_ = static_cast<double>(edge_);
    known_ = known_ == Known::kCount ? Known::kEdge : Known::kTwoEdges;
    count_ = count;
  }
  if (known_ != Known::kTwoEdges || since_s_ > kSilentS) return 0;
  const double between = static_cast<double>(edge_ - edge_before_) / apart_s_,
               most = 1 / std::max(since_s_, kSameEdgeS);
  return std::clamp(between, -most, most);
}

inline double EdgeVelocity::advance(double velocity) {
  const auto low = static_cast<double>(count_);
  position_ = std::clamp(position_ + velocity * elapsed_s_, low, low + 1);
  expected_ = position_ + velocity * period_s_;
  elapsed_s_ = 0;
  return position_;
}

}  // namespace trocar
