#include "haptics/device/mc4000/emulated_mc4000.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trocar {

SimulatedDaqConfig EmulatedMc4000::device_config(SimulatedDaqConfig config) {
  const Mc4000Map map;
  config.dac_bits = map.dac_bits;
  config.edge_times = false;
  config.watchdog_s = std::numeric_limits<double>::infinity();  // until the gate of one is opened
  return config;
}

EmulatedMc4000::EmulatedMc4000(SimulatedDaq& device, double rate_hz, const Mc4000Map& map,
                               std::vector<Mc4000Input> inputs)
    : device_(device),
      rate_hz_(rate_hz),
      map_(map),
      inputs_(std::move(inputs)),
      boards_{Board(*this, 0), Board(*this, 1)} {
  now_ = device_.read();  // the decoders stand somewhere before anybody asks
}

/// Channel of a register of a kind that each axis has. -1: another register.
int EmulatedMc4000::channel_at(int number, std::uint32_t word, std::uint32_t base,
                               std::uint32_t stride) const noexcept {
  for (int i = 0; i < kChannels; ++i)
    if (kMc4000Axes[i].board == number && word == base + static_cast<std::uint32_t>(kMc4000Axes[i].axis) * stride)
      return i;
  return -1;
}

void EmulatedMc4000::write(int number, std::uint32_t at, std::uint32_t value) noexcept {
  if (at >= kWords || troubles_.gone[number]) return;
  if (at == map_.interrupt_flags) {
    word(number, at) &= ~value;
    return;
  }
  if (at == map_.digital_in_b) return;
  word(number, at) = value;
  if (at == map_.watchdog || at == map_.gate) {
    bites_at_[static_cast<std::size_t>(number)] =
        periods() + std::int64_t{word(number, map_.watchdog)} * map_.watchdog_divider;
    set_device_watchdog(periods());
  }
  if (at == map_.digital_out_a && number == 0) device_.arm((value & map_.out_amplifiers) != 0);
  if (const int i = channel_at(number, at, map_.decoder_mode, map_.decoder_stride);
      i >= 0 && (value & map_.mode_preload)) {
    const auto c = static_cast<std::size_t>(i);
    const auto preload = static_cast<std::int32_t>(word(number, map_.decoder_count + (at - map_.decoder_mode)));
    zero_[c] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(now_.counts[c]) - static_cast<std::uint32_t>(preload));
    latched_[c] = preload;
  }
}

std::uint32_t EmulatedMc4000::read(int number, std::uint32_t at) noexcept {
  if (at >= kWords || troubles_.gone[number]) return ~0U;
  if (at == map_.digital_in_b) return inputs(number);
  if (const int i = channel_at(number, at, map_.decoder_count, map_.decoder_stride); i >= 0) {
    const auto count = static_cast<std::uint32_t>(latched_[static_cast<std::size_t>(i)]);
    return map_.count_bits >= 32 ? count : count & ((1U << map_.count_bits) - 1);
  }
  if (const int i = channel_at(number, at, map_.decoder_mode, map_.decoder_stride); i >= 0) {
    const bool error = (troubles_.quadrature_errors >> i & 1) || !(now_.valid >> i & 1);
    return (word(number, at) & ~map_.mode_error) | (error ? map_.mode_error : 0);
  }
  if (const int i = channel_at(number, at, map_.dac, map_.dac_stride); i >= 0)
    return static_cast<std::uint32_t>(held_.codes[static_cast<std::size_t>(i)]) & ((1U << map_.dac_bits) - 1);
  return word(number, at);
}

std::uint32_t EmulatedMc4000::sync() noexcept {
  if (troubles_.gone[0]) return 0;
  if (!(word(0, map_.gate) & map_.gate_pit) || !(word(0, map_.sync_control) & map_.sync_internal_pit)) return 0;
  const double pit_hz = map_.pit_clock_hz / word(0, map_.pit);
  if (std::abs(pit_hz / rate_hz_ - 1) > 1e-3) return 0;  // the device is stepped at its own rate only
  const std::int64_t now = periods() + 1;
  for (int number = 0; number < 2; ++number)
    if (watched(number) && now >= bites_at_[static_cast<std::size_t>(number)])
      word(number, map_.interrupt_flags) |= map_.flag_watchdog;
  set_device_watchdog(now);
  held_ = codes_due();
  device_.write(held_);
  now_ = device_.read();
  if (now_.digital_in & kWatchdogFired) held_ = {};
  for (int i = 0; i < kChannels; ++i)
    if (channel_input(now_.digital_in, kDacMismatch, i))
      held_.codes[static_cast<std::size_t>(i)] = device_.codes_in_force().codes[static_cast<std::size_t>(i)];
  if (now_.elapsed_periods == 0) return 0;
  const bool heard = (word(0, map_.sync_control) & map_.sync_output1_pit) && !troubles_.sync_cable_out &&
                     (word(1, map_.sync_control) & map_.sync_internal_external);
  for (int i = 0; i < kChannels; ++i) {
    const auto c = static_cast<std::size_t>(i);
    const int number = kMc4000Axes[i].board;
    if (number == 1 && !heard) continue;
    const bool inverted =
        (word(number, map_.decoder_mode + static_cast<std::uint32_t>(kMc4000Axes[i].axis) * map_.decoder_stride) &
         map_.mode_invert) != 0;
    const auto moved = static_cast<std::uint32_t>(now_.counts[c]) - static_cast<std::uint32_t>(zero_[c]);
    latched_[c] = static_cast<std::int32_t>(inverted ? 0U - moved : moved);
  }
  word(0, map_.interrupt_flags) |= map_.flag_sync;
  if (heard) word(1, map_.interrupt_flags) |= map_.flag_sync;
  for (int number = 0; number < 2; ++number)
    if ((now_.digital_in & kWatchdogFired) && watched(number)) word(number, map_.interrupt_flags) |= map_.flag_watchdog;
  return now_.elapsed_periods;
}

/// That have passed in the device, whoever asked for them.
std::int64_t EmulatedMc4000::periods() const noexcept { return std::llround(device_.time_s() * rate_hz_); }

void EmulatedMc4000::set_device_watchdog(std::int64_t now) noexcept {
  double first_s = std::numeric_limits<double>::infinity();
  for (int number = 0; number < 2; ++number) {
    const std::int64_t left = bites_at_[static_cast<std::size_t>(number)] - now;
    if (watched(number) && left > 0) first_s = std::min(first_s, static_cast<double>(left) / rate_hz_);
  }
  device_.set_watchdog(first_s);
}

/// What the converters take over at a SYNC.
DacFrame EmulatedMc4000::codes_due() const noexcept {
  DacFrame frame;
  for (int i = 0; i < kChannels; ++i) {
    const int shift = 32 - map_.dac_bits;
    const Registers& board = memory_[static_cast<std::size_t>(kMc4000Axes[i].board)];
    if (board[map_.interrupt_flags] & map_.flag_watchdog) continue;
    const std::uint32_t code = board[map_.dac + static_cast<std::uint32_t>(kMc4000Axes[i].axis) * map_.dac_stride];
    frame.codes[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(code << shift) >> shift;
  }
  return frame;
}

std::uint32_t EmulatedMc4000::inputs(int number) const noexcept {
  std::uint32_t out = ~0U;  // pulled up
  for (const Mc4000Input& input : inputs_) {
    if (input.board != number) continue;
    const bool says = (now_.digital_in & input.bits) != 0;
    if (says == input.active_low) out &= ~(1U << input.pin);
  }
  return out;
}

}  // namespace trocar
