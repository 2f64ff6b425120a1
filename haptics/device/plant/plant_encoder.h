// Encoders and counters of the plant: whole quadrature counts of the motors' angles, wrapping at 32 bits, and where
// asked for the edges that a counter misses and when it saw the last one.
//
//   count = floor(theta_m N / 2 pi + offset) - lost,   theta_m = output / ratio
// The four edges of a line are not quite even where the disc or its reader is not: edge k lies at k + uneven_counts
// times a pattern that repeats every four.
// An edge is missed by chance (missed_per_edge, drawn for each) or because edges come faster than 4 limit_hz, four to a
// line. What is missed stays missed: the counter is off by it until it is homed.
// Units: channel outputs (rad, m), counts. Thread: one owner; nothing allocates or throws.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/device/plant/plant_parameters.h"
#include "haptics/device/plant/plant_random.h"

namespace trocar {

class PlantEncoders {
 public:
  /// @param outputs where the motors stand at first. @param seed of what is missed. @param timed edges are timed.
  PlantEncoders(const PlantParameters& plant, const ChannelVector& outputs, std::uint64_t seed, bool timed = false);

  /// Whether follow() is needed: edges are missed or timed.
  bool watched() const noexcept { return timed_ || flaws_.missed_per_edge > 0 || flaws_.limit_hz > 0; }
  /// The motors moved to `outputs` within dt, steadily.
  void follow(const ChannelVector& outputs, double dt) noexcept;
  std::int32_t count(int channel, double output) const noexcept;
  /// Whether the disc stands at its index, one count of a turn; never unless so wired. What is missed moves no mark.
  bool at_mark(int channel, double output) const noexcept;
  /// As DaqSample: since the counter last moved; 0 unless timed.
  std::uint16_t edge_age_us(int channel) const noexcept;
  /// Counts that a channel's counter lacks, signed.
  std::int64_t lost(int channel) const noexcept { return track_[static_cast<std::size_t>(channel)].lost; }

 private:
  struct Track {
    std::int64_t whole = 0, lost = 0;
    double credit = 0;  ///< edges that the encoder can still follow
    double at = 0;      ///< position, counts
    double edge_s = 1;  ///< since the last edge that was counted
  };
  double position(std::size_t channel, double output) const noexcept;
  double edge(std::size_t channel, std::int64_t number) const noexcept;
  std::int64_t whole(std::size_t channel, double position) const noexcept;

  EncoderFlaws flaws_;
  bool timed_;
  std::array<double, kChannels> ratio_, offset_;
  double counts_per_turn_;
  std::array<Track, kChannels> track_{};
  PlantRandom random_;
};

}  // namespace trocar
