// The registers of a board as its driver sees them: 32-bit words, and its SYNC.
//
// Word w stands at byte 4 w of the mapped memory. Thread: one at a time; no call allocates, locks or throws.
#pragma once

#include <cstdint>

namespace trocar {

class RegisterBus {
 public:
  virtual ~RegisterBus() = default;
  virtual std::uint32_t read(std::uint32_t word) noexcept = 0;
  virtual void write(std::uint32_t word, std::uint32_t value) noexcept = 0;
  /// Waits until `flag` stands in word `flags`, where each SYNC sets it, for at most 1.5 periods; emulated boards let a
  /// period of their device pass instead. @return SYNC periods since the last one told; 0: none came.
  virtual std::uint32_t await_sync(std::uint32_t flags, std::uint32_t flag) noexcept = 0;
  /// Whether await_sync() waits in real time: it can pace a loop.
  virtual bool tells_sync() const noexcept { return false; }
  /// Whether the board's interrupt is heard: without that it must stay off.
  virtual bool hears_interrupt() const noexcept { return false; }
};

}  // namespace trocar
