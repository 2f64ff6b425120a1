// Registers of a board in this computer: its memory, mapped from PCI's sysfs or from UIO.
//
// PCI: /sys/bus/pci/devices/0000:03:00.0 (its resource0). No interrupt is heard: periods go by the host's clock.
// UIO: /dev/uio0, a driver of the kernel's (uio_pci_generic); its interrupt paces the loop and is counted.
// Only volatile, aligned 32-bit accesses; a write is read back so that it has arrived. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "haptics/device/mc4000/register_bus.h"

namespace trocar {

class PciBus final : public RegisterBus {
 public:
  /// @param device folder of a PCI device, its resource0, a /dev/uio, or any file of registers. @param rate_hz of the
  /// SYNC. @throws EnvironmentError: not there, no right to it (and what gives it), too small.
  PciBus(const std::string& device, double rate_hz);
  ~PciBus() override;
  PciBus(const PciBus&) = delete;
  PciBus(PciBus&&) = delete;
  PciBus& operator=(const PciBus&) = delete;
  PciBus& operator=(PciBus&&) = delete;

  std::uint32_t read(std::uint32_t word) noexcept override;
  void write(std::uint32_t word, std::uint32_t value) noexcept override;
  std::uint32_t await_sync() noexcept override;
  bool tells_sync() const noexcept override { return counts_interrupts_; }

 private:
  int file_ = -1;
  bool counts_interrupts_ = false;
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
  double period_s_;
  std::uint32_t interrupts_ = 0;
  std::int64_t periods_ = 0;  ///< of the host's clock, at the last call
};

}  // namespace trocar
