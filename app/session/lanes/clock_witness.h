// A second clock beside the one that paces a live run: a library put before libc can slow down the clock that the
// program reads, and a run at half speed leaves a person twice the time.
//
// The kernel is asked by the system call itself, past every library, every two seconds: slow in one part and fast in
// another does not cancel out. Its clock that goes on while the machine sleeps tells of sleep. What cannot be seen: a
// debugger that answers in the kernel's place, a virtual machine or kernel whose own clock is wrong. Thread: one.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace trocar {

/// What both clocks said of a live run.
struct WitnessedTime {
  double program_s = 0, kernel_s = 0;  ///< from the first look to the last
  double worst = 1;                    ///< program's over kernel's, of the two seconds where they differ most
  double slept_s = 0;                  ///< that the machine was suspended
};

class ClockWitness {
 public:
  /// Where a reading is wanted. Cheap; to be called often.
  void look();
  /// Empty where nothing could be read: the processor's way to the kernel is known on x86-64 and AArch64 Linux only.
  std::optional<WitnessedTime> seen() const;

 private:
  struct Reading {
    std::array<double, 2> program_s{};  ///< as threads are paced, and as std::chrono says
    double kernel_s = 0, awake_or_not_s = 0;
  };
  static std::optional<Reading> read();
  std::optional<Reading> first_, window_, last_;
  WitnessedTime seen_;
};

/// Why times by this clock are no measurement; "" where they are: within 2 % all through, and awake.
std::string clock_fault(const WitnessedTime& time);

}  // namespace trocar
