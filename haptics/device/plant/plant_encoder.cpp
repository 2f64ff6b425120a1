#include "haptics/device/plant/plant_encoder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace trocar {
namespace {

constexpr double kEdgesPerLine = 4;
constexpr double kUneven[] = {1, -0.7, 0.3, -0.6};  // of a line's edges, times uneven_counts: assumption
constexpr double kLongestAgeUs = 65535;

}  // namespace

PlantEncoders::PlantEncoders(const PlantParameters& plant, const ChannelVector& outputs, std::uint64_t seed, bool timed)
    : flaws_(plant.options.encoder), timed_(timed), counts_per_turn_(plant.counts_per_turn), random_(seed) {
  for (std::size_t i = 0; i < kChannels; ++i) {
    ratio_[i] = plant.channel[i].ratio;
    offset_[i] = plant.channel[i].encoder_offset_counts;
    track_[i].at = position(i, outputs[static_cast<int>(i)]);
    track_[i].whole = whole(i, track_[i].at);
  }
}

double PlantEncoders::position(std::size_t channel, double output) const noexcept {
  const double turns = output / ratio_[channel] / (2.0 * std::numbers::pi);
  return turns * counts_per_turn_ + offset_[channel];
}

double PlantEncoders::edge(std::size_t channel, std::int64_t number) const noexcept {
  const std::size_t of_line = (static_cast<std::size_t>(number) + channel) % std::size(kUneven);
  return static_cast<double>(number) + flaws_.uneven_counts * kUneven[of_line];
}

std::int64_t PlantEncoders::whole(std::size_t channel, double position) const noexcept {
  const auto even = static_cast<std::int64_t>(std::floor(position));
  if (flaws_.uneven_counts == 0) return even;
  return even - (position < edge(channel, even)) + (position >= edge(channel, even + 1));
}

void PlantEncoders::follow(const ChannelVector& outputs, double dt) noexcept {
  const double followed = kEdgesPerLine * flaws_.limit_hz * dt;
  for (std::size_t i = 0; i < kChannels; ++i) {
    Track& track = track_[i];
    const double before = std::exchange(track.at, position(i, outputs[static_cast<int>(i)]));
    const std::int64_t now = whole(i, track.at), way = now - track.whole;
    const std::int64_t edges = std::abs(way), sign = way < 0 ? -1 : 1;
    track.whole = now;
    track.credit = std::min(track.credit + followed, followed + 1);
    std::int64_t counted = 0;
    for (std::int64_t n = 0; n < edges; ++n) {
      const bool too_fast = flaws_.limit_hz > 0 && track.credit < 1;
      if (!too_fast) track.credit -= 1;
      const bool missed = flaws_.missed_per_edge > 0 && random_.unit() < flaws_.missed_per_edge;
      too_fast || missed ? track.lost += sign : ++counted;
    }
    track.edge_s += dt;
    if (counted == 0) continue;
    const double last = edge(i, sign > 0 ? now : now + 1);
    track.edge_s = std::clamp((track.at - last) / (track.at - before), 0.0, 1.0) * dt;
  }
}

std::uint16_t PlantEncoders::edge_age_us(int channel) const noexcept {
  if (!timed_) return 0;
  const double age_us = 1e6 * track_[static_cast<std::size_t>(channel)].edge_s;
  return static_cast<std::uint16_t>(std::clamp(std::ceil(age_us), 1.0, kLongestAgeUs));
}

bool PlantEncoders::at_mark(int channel, double output) const noexcept {
  if (flaws_.index < 0.5) return false;
  const auto i = static_cast<std::size_t>(channel);
  return whole(i, position(i, output)) % static_cast<std::int64_t>(counts_per_turn_) == 0;
}

std::int32_t PlantEncoders::count(int channel, double output) const noexcept {
  const auto i = static_cast<std::size_t>(channel);
  const std::int64_t seen = whole(i, position(i, output)) - track_[i].lost;
  return static_cast<std::int32_t>(static_cast<std::uint64_t>(seen) & 0xFFFFFFFFull);  // wraps as the counter does
}

}  // namespace trocar
