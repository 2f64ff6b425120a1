#include "haptics/device/mc4000/mc4000_daq.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr int kSyncTries = 50;  // waits in which a first SYNC must come
constexpr int kFirstDrivePin = 8;
constexpr std::uint32_t kNobody = ~0U;  // what a bus reads where no board answers

const Mc4000Options& checked(const Mc4000Options& o) {
  if (!is_board_pace(o.rate_hz, o.watchdog_s))
    throw std::invalid_argument("mc4000: rates from 100 to 10000 Hz and a watchdog of up to 1 s");
  return o;
}

std::uint32_t dac_word(std::int32_t code, int bits) {
  return static_cast<std::uint32_t>(code) & (bits >= 32 ? ~0U : (1U << bits) - 1);
}

std::int32_t sign_extended(std::uint32_t value, int bits) {
  const int shift = 32 - bits;
  return static_cast<std::int32_t>(value << shift) >> shift;
}

}  // namespace

std::vector<Mc4000Input> mc4000_inputs() {
  std::vector<Mc4000Input> out;
  int pin = 0;
  for (const DigitalInput input : {kDeadman, kHomeBeam, kEmergencyStop, kClutch, kPedal, kExchange})
    out.push_back({input, 0, pin++, input != kEmergencyStop});
  for (const DigitalInput group : {kDriveFault, kDriveHot})
    for (int i = 0; i < kChannels; ++i)
      out.push_back({static_cast<std::uint32_t>(group) << i, kMc4000Axes[i].board,
                     kFirstDrivePin + 2 * kMc4000Axes[i].axis + (group == kDriveHot ? 1 : 0), false});
  return out;
}

Mc4000Daq::Mc4000Daq(RegisterBus& board0, RegisterBus& board1, const Mc4000Options& options)
    : boards_{&board0, &board1},
      options_(checked(options)),
      watchdog_counts_(static_cast<std::uint32_t>(
          std::max(1.0, std::ceil(options.watchdog_s * options.rate_hz / options.map.watchdog_divider - 1e-9)))) {
  const Mc4000Map& map = options_.map;
  for (RegisterBus* board : boards_) {
    board->write(map.digital_out_a, 0);
    board->write(map.gate, 0);
  }
  for (const int number : {1, 0}) set_up(*boards_[static_cast<std::size_t>(number)], number);  // 0 drives 1
  for (int number = 0; number < 2; ++number) {
    RegisterBus& board = *boards_[static_cast<std::size_t>(number)];
    bool seen = false;
    for (int n = 0; n < kSyncTries && !seen; ++n) {
      boards_[0]->await_sync(map.interrupt_flags, map.flag_sync);
      seen = (board.read(map.interrupt_flags) & map.flag_sync) != 0;
      clear_sync();
    }
    if (!seen)
      throw EnvironmentError("MC4000 board " + std::to_string(number) + ": no SYNC comes" +
                             (number == 0 ? "; its timer does not run" : " from board 0; is their cable plugged?"));
  }
  clear_watchdogs();
}

void Mc4000Daq::set_up(RegisterBus& board, int number) {
  const Mc4000Map& map = options_.map;
  const std::string name = "MC4000 board " + std::to_string(number);
  const auto load = static_cast<std::uint32_t>(std::lround(map.pit_clock_hz / options_.rate_hz));
  board.write(map.pit, load);
  if (board.read(map.pit) != load)
    throw EnvironmentError(name + ": its timer does not keep what is written; is this the right memory?");
  for (std::uint32_t axis = 0; axis < 8; ++axis) board.write(map.dac + axis * map.dac_stride, 0);
  board.write(map.watchdog, watchdog_counts_);
  board.write(map.sync_control,
              number == 0 ? map.sync_internal_pit | map.sync_output1_pit : map.sync_internal_external);
  for (int i = 0; i < kChannels; ++i) {
    if (kMc4000Axes[i].board != number) continue;
    const std::uint32_t invert = options_.invert[static_cast<std::size_t>(i)] ? map.mode_invert : 0;
    board.write(decoder(i, map.decoder_count), 0);  // the preload
    board.write(decoder(i, map.decoder_mode), invert | map.mode_preload);
    board.write(decoder(i, map.decoder_mode), invert);
  }
  board.write(map.interrupt_flags, map.flag_sync | map.flag_watchdog);
  if (board.read(map.interrupt_flags) & (map.flag_sync | map.flag_watchdog))
    throw EnvironmentError(name + ": its interrupt flags do not clear");
  board.write(map.interrupt_enable, number == 0 && board.hears_interrupt() ? map.flag_sync : 0);
  const std::uint32_t gate = map.gate_watchdog | (number == 0 ? map.gate_pit : 0);
  board.write(map.gate, gate);
  if (board.read(map.gate) != gate) throw EnvironmentError(name + ": its watchdog cannot be switched on");
}

Mc4000Daq::~Mc4000Daq() {
  const Mc4000Map& map = options_.map;
  write({});
  arm(false);
  clear_sync();
  boards_[0]->await_sync(map.interrupt_flags, map.flag_sync);
  boards_[0]->write(map.interrupt_enable, 0);
}

std::uint32_t Mc4000Daq::decoder(int channel, std::uint32_t base) const noexcept {
  return base + static_cast<std::uint32_t>(kMc4000Axes[channel].axis) * options_.map.decoder_stride;
}

std::uint32_t Mc4000Daq::converter(int channel) const noexcept {
  return options_.map.dac + static_cast<std::uint32_t>(kMc4000Axes[channel].axis) * options_.map.dac_stride;
}

std::int32_t Mc4000Daq::extended(std::uint32_t count) const noexcept {
  return sign_extended(count, options_.map.count_bits);
}

bool Mc4000Daq::await_sync() noexcept {
  if (!boards_[0]->tells_sync()) return false;
  awaited_ = boards_[0]->await_sync(options_.map.interrupt_flags, options_.map.flag_sync);
  return awaited_ > 0;
}

DaqSample Mc4000Daq::read() noexcept {
  const Mc4000Map& map = options_.map;
  const std::uint32_t periods = awaited_ ? *awaited_ : boards_[0]->await_sync(map.interrupt_flags, map.flag_sync);
  awaited_.reset();
  const std::array<std::uint32_t, 2> flags{boards_[0]->read(map.interrupt_flags),
                                           boards_[1]->read(map.interrupt_flags)};
  clear_sync();
  if (periods == 0 || !(flags[0] & map.flag_sync) || flags[0] == kNobody) {
    last_.elapsed_periods = 0;
    return last_;
  }
  DaqSample out = last_;
  out.elapsed_periods = std::exchange(read_once_, true) ? periods : 1;
  out.valid = 0;
  out.digital_in = 0;
  for (int i = 0; i < kChannels; ++i) {
    RegisterBus& board = board_of(i);
    const auto c = static_cast<std::size_t>(i);
    // Wrap-safe at the decoder's own width: the seam's counter has 32 bits.
    const auto last = static_cast<std::uint32_t>(out.counts[c]), now = board.read(decoder(i, map.decoder_count));
    out.counts[c] = static_cast<std::int32_t>(last + static_cast<std::uint32_t>(extended(now - last)));
    const std::uint32_t seen = flags[static_cast<std::size_t>(kMc4000Axes[i].board)];
    if (seen != kNobody && (seen & map.flag_sync) && !(board.read(decoder(i, map.decoder_mode)) & map.mode_error))
      out.valid = static_cast<std::uint8_t>(out.valid | 1U << i);
    if (armed_ && !overtaken_ && seen != kNobody &&
        sign_extended(board.read(converter(i)), map.dac_bits) != written_.codes[c])
      out.digital_in |= kDacMismatch << i;
  }
  const bool fired = ((flags[0] | (flags[1] == kNobody ? 0 : flags[1])) & map.flag_watchdog) != 0;
  if (fired && armed_) out.digital_in = (out.digital_in | kWatchdogFired) & ~(0x7Fu * kDacMismatch);
  if (fired && !armed_) clear_watchdogs();
  const std::array<std::uint32_t, 2> inputs{boards_[0]->read(map.digital_in_b), boards_[1]->read(map.digital_in_b)};
  for (const Mc4000Input& input : options_.inputs)
    if (flags[static_cast<std::size_t>(input.board)] != kNobody &&
        ((inputs[static_cast<std::size_t>(input.board)] >> input.pin & 1) != 0) != input.active_low)
      out.digital_in |= input.bits;
  return last_ = out;
}

void Mc4000Daq::write(const DacFrame& frame) noexcept {
  const Mc4000Map& map = options_.map;
  for (int i = 0; i < kChannels; ++i)
    board_of(i).write(converter(i), dac_word(frame.codes[static_cast<std::size_t>(i)], map.dac_bits));
  for (RegisterBus* board : boards_) board->write(map.watchdog, watchdog_counts_);
  written_ = frame;
  overtaken_ = (boards_[0]->read(map.interrupt_flags) & map.flag_sync) != 0;
}

/// Board 1 first: a SYNC between the two then costs a period, which the clock counts, and not board 1's flag of a SYNC
/// that board 0 tells of.
void Mc4000Daq::clear_sync() noexcept {
  for (RegisterBus* board : {boards_[1], boards_[0]})
    board->write(options_.map.interrupt_flags, options_.map.flag_sync);
}

void Mc4000Daq::clear_watchdogs() noexcept {
  const Mc4000Map& map = options_.map;
  for (RegisterBus* board : boards_) {
    board->write(map.watchdog, watchdog_counts_);
    board->write(map.interrupt_flags, map.flag_watchdog);
  }
}

void Mc4000Daq::arm(bool enabled) noexcept {
  if (armed_ && !enabled) {
    write({});
    clear_watchdogs();
  }
  // Off is said each time: a board that was gone has not heard it.
  if (!enabled || !armed_) boards_[0]->write(options_.map.digital_out_a, enabled ? options_.map.out_amplifiers : 0);
  armed_ = enabled;
}

std::vector<std::string> Mc4000Daq::dry_look(RegisterBus& board, const Mc4000Map& map) {
  const std::pair<const char*, std::uint32_t> registers[] = {{"MC_PIT", map.pit},
                                                             {"MCWD", map.watchdog},
                                                             {"MC_GATE", map.gate},
                                                             {"MC_SYNCCTRL", map.sync_control},
                                                             {"MC_DIGINB", map.digital_in_b},
                                                             {"MC_INTFLGHOST", map.interrupt_flags},
                                                             {"MC_INTENAHOST", map.interrupt_enable}};
  std::vector<std::string> out;
  const auto line = [&](const std::string& name, std::uint32_t word) {
    char text[64];
    std::snprintf(text, sizeof text, "%-14s 0x%02X  0x%08X", name.c_str(), word, board.read(word));
    out.emplace_back(text);
  };
  for (const auto& [name, word] : registers) line(name, word);
  for (std::uint32_t axis = 0; axis < 4; ++axis) {
    line("MC_DAC" + std::to_string(axis), map.dac + axis * map.dac_stride);
    line("MC_QDCOUNT" + std::to_string(axis), map.decoder_count + axis * map.decoder_stride);
    line("MC_QDMODE" + std::to_string(axis), map.decoder_mode + axis * map.decoder_stride);
  }
  return out;
}

}  // namespace trocar
