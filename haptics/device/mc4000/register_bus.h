// The registers of a board as its driver sees them: 32-bit words, and the interrupt of its SYNC.
//
// Word w stands at byte 4 w of the mapped memory. Thread: one at a time; no call allocates, locks or throws, but for
// those of an emulated board, which lock.
#pragma once

#include <cstdint>

namespace trocar {

class RegisterBus {
 public:
  virtual ~RegisterBus() = default;
  virtual std::uint32_t read(std::uint32_t word) noexcept = 0;
  virtual void write(std::uint32_t word, std::uint32_t value) noexcept = 0;
  /// Waits for the board's interrupt where it has one that is heard, else for nothing.
  /// @return SYNC periods since the last call: by counted interrupts, or by the host's clock; 0: none yet.
  virtual std::uint32_t await_sync() noexcept = 0;
  /// Whether await_sync() waits.
  virtual bool tells_sync() const noexcept { return false; }
};

}  // namespace trocar
