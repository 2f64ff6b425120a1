#include "haptics/device/plant/plant_encoder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kEdgesPerLine = 4;

}  // namespace

PlantEncoders::PlantEncoders(const PlantParameters& plant, const ChannelVector& outputs, std::uint64_t seed)
    : flaws_(plant.options.encoder), counts_per_turn_(plant.counts_per_turn), random_(seed) {
  for (std::size_t i = 0; i < kChannels; ++i) {
    ratio_[i] = plant.channel[i].ratio;
    offset_[i] = plant.channel[i].encoder_offset_counts;
    track_[i].whole = whole(i, outputs[static_cast<int>(i)]);
  }
}

std::int64_t PlantEncoders::whole(std::size_t channel, double output) const noexcept {
  const double turns = output / ratio_[channel] / (2.0 * std::numbers::pi);
  return static_cast<std::int64_t>(std::floor(turns * counts_per_turn_ + offset_[channel]));
}

void PlantEncoders::follow(const ChannelVector& outputs, double dt) noexcept {
  const double followed = kEdgesPerLine * flaws_.limit_hz * dt;
  for (std::size_t i = 0; i < kChannels; ++i) {
    Track& track = track_[i];
    const std::int64_t now = whole(i, outputs[static_cast<int>(i)]), way = now - track.whole;
    const std::int64_t edges = std::abs(way), sign = way < 0 ? -1 : 1;
    track.whole = now;
    track.credit = std::min(track.credit + followed, followed + 1);
    for (std::int64_t n = 0; n < edges; ++n) {
      const bool too_fast = flaws_.limit_hz > 0 && track.credit < 1;
      if (!too_fast) track.credit -= 1;
      const bool missed = flaws_.missed_per_edge > 0 && random_.unit() < flaws_.missed_per_edge;
      if (too_fast || missed) track.lost += sign;
    }
  }
}

std::int32_t PlantEncoders::count(int channel, double output) const noexcept {
  const auto i = static_cast<std::size_t>(channel);
  const std::int64_t seen = whole(i, output) - track_[i].lost;
  return static_cast<std::int32_t>(static_cast<std::uint64_t>(seen) & 0xFFFFFFFFull);  // wraps as the counter does
}

}  // namespace trocar
