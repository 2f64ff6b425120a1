// Two MC4000 boards that are not there: their registers as the driver sees them, and behind them the simulated device
// with its hand.
//
// SYNC takes the converters over, lets one period of the device pass, then latches the decoders of each board that
// hears it and sets the flags. Each board's watchdog counts down from its MCWD, one in watchdog_divider periods, while
// its gate is open; a write to MCWD or to the gate begins anew. At zero its flag is set and its own converters are zero
// until the flag is cleared. While SYNCs pass that nobody asks for (SimulatedWorld::miss_sync()) the device's watchdog,
// set to the first that is due, stands for theirs: it zeroes both boards' converters, until disarmed. Troubles are the
// boards' own. Thread: the haptic task's.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/device/mc4000/mc4000_map.h"
#include "haptics/device/mc4000/register_bus.h"
#include "haptics/device/simulated_daq.h"

namespace trocar {

struct BoardTroubles {
  bool sync_cable_out = false;    ///< board 1 hears no SYNC
  bool gone[2] = {false, false};  ///< reads give all ones, writes nothing
  int quadrature_errors = 0;      ///< channels, a bit each
};

class EmulatedMc4000 {
 public:
  static SimulatedDaqConfig device_config(SimulatedDaqConfig config);
  /// @param device made of device_config(); outlives the boards.
  EmulatedMc4000(SimulatedDaq& device, double rate_hz, const Mc4000Map& map, std::vector<Mc4000Input> inputs);

  RegisterBus& board(int number) { return boards_[static_cast<std::size_t>(number)]; }
  void trouble(const BoardTroubles& troubles) { troubles_ = troubles; }

 private:
  class Board final : public RegisterBus {
   public:
    Board(EmulatedMc4000& pair, int number) : pair_(pair), number_(number) {}
    std::uint32_t read(std::uint32_t word) noexcept override { return pair_.read(number_, word); }
    void write(std::uint32_t word, std::uint32_t value) noexcept override { pair_.write(number_, word, value); }
    std::uint32_t await_sync(std::uint32_t, std::uint32_t) noexcept override { return number_ == 0 ? pair_.sync() : 0; }

   private:
    EmulatedMc4000& pair_;
    int number_;
  };
  static constexpr std::uint32_t kWords = 0x60;
  using Registers = std::array<std::uint32_t, kWords>;

  std::uint32_t read(int number, std::uint32_t word) noexcept;
  void write(int number, std::uint32_t word, std::uint32_t value) noexcept;
  std::uint32_t sync() noexcept;
  std::int64_t periods() const noexcept;
  void set_device_watchdog(std::int64_t now) noexcept;
  DacFrame codes_due() const noexcept;
  bool watched(int number) const noexcept {
    return (memory_[static_cast<std::size_t>(number)][map_.gate] & map_.gate_watchdog) != 0;
  }
  int channel_at(int number, std::uint32_t word, std::uint32_t base, std::uint32_t stride) const noexcept;
  std::uint32_t inputs(int number) const noexcept;
  std::uint32_t& word(int number, std::uint32_t at) noexcept { return memory_[static_cast<std::size_t>(number)][at]; }

  SimulatedDaq& device_;
  double rate_hz_;
  Mc4000Map map_;
  std::vector<Mc4000Input> inputs_;
  BoardTroubles troubles_;
  std::array<Board, 2> boards_;
  std::array<Registers, 2> memory_{};
  std::array<std::int32_t, kChannels> zero_{},
      latched_{};  ///< of the decoders: at their preload, and as they were latched
  DaqSample now_;
  DacFrame held_;                           ///< by the converters, since the last SYNC
  std::array<std::int64_t, 2> bites_at_{};  ///< periods of the device, by its watchdog; where its gate is open
};

}  // namespace trocar
