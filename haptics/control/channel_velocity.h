// Velocity of one channel by the method that the loop is set to.
//
// The default blends two filters: FOAW (velocity_estimator.h), exactly zero at rest and calm when slow, and Kalman
// (kalman_velocity.h), without lag when moving. Their weight follows the FOAW speed: FOAW alone below
// kSlow, Kalman alone above kFast, linear between (0.06 m/s at the tip of this device is 300 counts/s).
// Where the board tells when each counter last moved, kEdges takes the time between edges (edge_velocity.h) for FOAW,
// up to kSlowEdges; a board that does not tell it gets the blend. The others are the usual ones, for comparison
// (`trocar study velocity`). Thread: haptic task; no allocation after construction.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "haptics/control/edge_velocity.h"
#include "haptics/control/kalman_velocity.h"
#include "haptics/control/velocity_estimator.h"

namespace trocar {

enum class VelocityMethod : std::uint8_t { kBlend, kFoaw, kKalman, kBackward, kAverage, kLowPass, kEdges };

struct VelocityMethodName {
  VelocityMethod method;
  const char* name;
};
inline constexpr std::array<VelocityMethodName, 7> kVelocityMethods{{{VelocityMethod::kBlend, "blend"},
                                                                     {VelocityMethod::kFoaw, "foaw"},
                                                                     {VelocityMethod::kKalman, "kalman"},
                                                                     {VelocityMethod::kBackward, "backward"},
                                                                     {VelocityMethod::kAverage, "average"},
                                                                     {VelocityMethod::kLowPass, "low-pass"},
                                                                     {VelocityMethod::kEdges, "edges"}}};

class ChannelVelocity {
 public:
  static constexpr int kTaps = 8;          ///< of kAverage: the thesis' "velocity signal filter" [assumed length]
  static constexpr double kCutOffHz = 40;  ///< of kLowPass
  static constexpr double kSlow = 150, kFast = 300;           ///< counts/s
  static constexpr double kSlowEdges = 80, kFastEdges = 200;  ///< counts/s

  ChannelVelocity(VelocityMethod method, double quantum, double period_s);

  void reset();
  /// @param count position in counts; @param elapsed_periods since the last sample. @param edge_age_us as
  /// DaqSample. @return velocity, unit/s.
  double update(std::int64_t count, std::uint32_t elapsed_periods, std::uint16_t edge_age_us = 0);
  /// Where the edges put the channel, counts; of kEdges while they are told.
  double position() const { return edges_.position(); }

 private:
  double blend(std::int64_t count, std::uint32_t periods);
  double edges(std::int64_t count, std::uint32_t periods, std::uint16_t edge_age_us);
  double average(std::int64_t count, std::uint32_t periods);
  double low_pass(std::int64_t count, std::uint32_t periods);

  VelocityMethod method_;
  double quantum_, period_s_;
  VelocityEstimator foaw_;
  KalmanVelocity kalman_;
  EdgeVelocity edges_;
  std::array<double, kTaps> tap_{};  ///< counts of the last periods
  std::size_t next_tap_ = 0;
  double smooth_ = 0;  ///< of kLowPass, counts/s
  std::int64_t last_ = 0;
  bool started_ = false;
};

}  // namespace trocar
