// Registers of a board in this computer: its memory, mapped from PCI's sysfs, and its interrupt where UIO gives it.
//
// Folder in sysfs, /sys/bus/pci/devices/0000:03:00.0: no interrupt is heard, the SYNC's flag is polled.
// /dev/uio0 (uio_pci_generic is bound): registers from the resource0 of its device in sysfs, since that driver maps
// none in older kernels; its interrupt ends the wait. The driver masks it each time (INTx); the Interrupt Disable bit
// of the PCI command register is cleared before each wait, through `config`, or by a write to the node where its driver
// takes one. Counted interrupts are not periods: while it is masked none are counted. Only volatile, aligned 32-bit
// accesses; a write is read back so that it has arrived. One program has a board at a time. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "haptics/device/mc4000/polled_bus.h"

namespace trocar {

inline constexpr std::size_t kLeastBoardBytes = 4 * 0x60;  ///< of registers, table 3.1 of the thesis

/// The file of a board's registers. @param device as PciBus takes it.
std::filesystem::path board_registers(const std::string& device);

class PciBus final : public PolledBus {
 public:
  /// @param device folder of a PCI device, its resource0, a /dev/uio, or any file of registers. @param rate_hz of the
  /// SYNC. @param interrupt node of UIO that belongs to it; empty: none, but for a /dev/uio itself.
  /// @throws EnvironmentError: not there, no right to it (and what gives it), too small; another program has it.
  PciBus(const std::string& device, double rate_hz, const std::string& interrupt = {});
  ~PciBus() override;
  PciBus(const PciBus&) = delete;
  PciBus(PciBus&&) = delete;
  PciBus& operator=(const PciBus&) = delete;
  PciBus& operator=(PciBus&&) = delete;

  std::uint32_t read(std::uint32_t word) noexcept override;
  void write(std::uint32_t word, std::uint32_t value) noexcept override;
  bool hears_interrupt() const noexcept override { return node_.file >= 0; }

 private:
  struct Opened {
    ~Opened();
    int file = -1;
  };
  double now_s() noexcept override;
  void rest(double look_s, double limit_s) noexcept override;
  bool unmask() noexcept;

  Opened registers_, node_, config_;
  std::uint8_t command_high_ = 0;  ///< high byte of the PCI command register, interrupts on
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace trocar
