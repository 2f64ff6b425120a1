// Back-end of the seam for the two boards of the thesis: MC4000 PRO (#0) and LITE (#1), register by register.
//
// Set up as in figure 3.9: PIT at the loop rate, SYNC of board 0 driving board 1, decoders preloaded with zero, phases
// set, converters at zero, watchdog ENABLED (the thesis had switched it off) and kicked by write(). A SYNC latches all
// decoders and takes over all converters. Each read() compares what the converters hold with what was written
// (kDacMismatch) and looks whether each board saw its SYNC: channels of one that did not are not valid.
// Boards in this computer pace the loop: await_sync(), or a read() that nobody awaited, returns at their SYNC; where
// none comes within 1.5 periods nothing is news. Thread: the haptic task's. No call allocates, locks or throws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "haptics/device/data_acquisition.h"
#include "haptics/device/mc4000/mc4000_map.h"
#include "haptics/device/mc4000/register_bus.h"

namespace trocar {

struct Mc4000Options {
  const char* name = "mc4000";
  double rate_hz = 1000;
  double watchdog_s = 0.016;  ///< two counts at 1 kHz; rounded up to whole counts
  Mc4000Map map = {};
  std::vector<Mc4000Input> inputs = mc4000_inputs();
  std::array<bool, kChannels> invert{};  ///< phases of the encoders
};

class Mc4000Daq final : public DataAcquisition {
 public:
  /// @throws std::invalid_argument: a rate or time that no board has; EnvironmentError: a register does not keep what
  /// is written, no SYNC comes, a watchdog will not run.
  Mc4000Daq(RegisterBus& board0, RegisterBus& board1, const Mc4000Options& options);
  /// Amplifiers off, converters at zero: waits for the SYNC that takes it over, two periods at most. Timer and
  /// watchdogs run on, so that these zero them where no SYNC comes.
  ~Mc4000Daq() override;
  Mc4000Daq(const Mc4000Daq&) = delete;
  Mc4000Daq(Mc4000Daq&&) = delete;
  Mc4000Daq& operator=(const Mc4000Daq&) = delete;
  Mc4000Daq& operator=(Mc4000Daq&&) = delete;

  DaqCapabilities capabilities() const noexcept override {
    return {options_.name, options_.rate_hz, options_.map.dac_bits};
  }
  /// Waits for board 0's next SYNC where it tells of it; the next read() is then of that one. @return false: it does
  /// not tell, the caller keeps the time.
  bool await_sync() noexcept;
  DaqSample read() noexcept override;
  void write(const DacFrame& frame) noexcept override;
  void arm(bool enabled) noexcept override;

  /// What stands in the registers of table 3.1, a line each: reads only, for who looks at boards before they are used.
  static std::vector<std::string> dry_look(RegisterBus& board, const Mc4000Map& map);

 private:
  RegisterBus& board_of(int channel) noexcept { return *boards_[static_cast<std::size_t>(kMc4000Axes[channel].board)]; }
  std::uint32_t decoder(int channel, std::uint32_t base) const noexcept;
  std::uint32_t converter(int channel) const noexcept;
  void set_up(RegisterBus& board, int number);
  void clear_sync() noexcept;
  void clear_watchdogs() noexcept;
  std::int32_t extended(std::uint32_t count) const noexcept;

  std::array<RegisterBus*, 2> boards_;
  Mc4000Options options_;
  std::uint32_t watchdog_counts_;
  DacFrame written_;
  bool armed_ = false, read_once_ = false;
  bool overtaken_ = false;                ///< by a SYNC, before all of `written_` was in the registers
  std::optional<std::uint32_t> awaited_;  ///< periods that await_sync() saw and read() has not yet told
  DaqSample last_;
};

}  // namespace trocar
