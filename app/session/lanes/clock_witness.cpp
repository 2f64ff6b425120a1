#include "app/session/lanes/clock_witness.h"

#include <sys/syscall.h>
#include <time.h>

#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace trocar {
namespace {

constexpr double kWindow = 2;           // s
constexpr double kDisagreement = 0.02;  // of the kernel's; slewing by NTP is 0.0005 at most
constexpr double kAtOnce = 0.001;       // s: readings further apart were not taken together
constexpr int kTries = 5;
constexpr double kAsleep = 0.1;  // s

double seconds(const timespec& t) { return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec); }

std::optional<double> kernel_clock([[maybe_unused]] long which) {
#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
  timespec now{};
#if defined(__x86_64__)
  long result = SYS_clock_gettime;
  asm volatile("syscall" : "+a"(result) : "D"(which), "S"(&now) : "rcx", "r11", "memory");
#else
  register long result asm("x0") = which;
  register timespec* to asm("x1") = &now;
  register long number asm("x8") = SYS_clock_gettime;
  asm volatile("svc 0" : "+r"(result) : "r"(to), "r"(number) : "memory");
#endif
  if (result == 0) return seconds(now);
#endif
  return std::nullopt;
}

}  // namespace

std::optional<ClockWitness::Reading> ClockWitness::read() {
  for (int i = 0; i < kTries; ++i) {
    Reading reading;
    const auto before = kernel_clock(CLOCK_MONOTONIC);
    timespec now{};
    if (::clock_gettime(CLOCK_MONOTONIC, &now) != 0) return std::nullopt;
    reading.program_s = {seconds(now),
                         std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()};
    const auto boot = kernel_clock(CLOCK_BOOTTIME), after = kernel_clock(CLOCK_MONOTONIC);
    if (!before || !boot || !after) return std::nullopt;
    reading.kernel_s = *before;
    reading.awake_or_not_s = *boot;
    if (*after - *before < kAtOnce) return reading;
  }
  return std::nullopt;
}

void ClockWitness::look() {
  const std::optional<Reading> now = read();
  if (!now) return;
  if (!first_) first_ = window_ = now;
  last_ = now;
  const double kernel = now->kernel_s - window_->kernel_s;
  if (kernel < kWindow) return;
  for (std::size_t i = 0; i < now->program_s.size(); ++i) {
    const double share = (now->program_s[i] - window_->program_s[i]) / kernel;
    if (std::abs(share - 1) > std::abs(seen_.worst - 1)) seen_.worst = share;
  }
  window_ = now;
}

std::optional<WitnessedTime> ClockWitness::seen() const {
  if (!first_) return std::nullopt;
  WitnessedTime out = seen_;
  out.program_s = last_->program_s[0] - first_->program_s[0];
  out.kernel_s = last_->kernel_s - first_->kernel_s;
  out.slept_s = (last_->awake_or_not_s - first_->awake_or_not_s) - out.kernel_s;
  return out;
}

std::string clock_fault(const WitnessedTime& time) {
  std::ostringstream words;
  words << std::fixed << std::setprecision(2);
  if (std::abs(time.worst - 1) > kDisagreement)
    words << "the program's clock ran at " << time.worst << " of the kernel's";
  else if (time.slept_s > kAsleep)
    words << "the machine slept for " << time.slept_s << " s while the attempt ran";
  return words.str();
}

}  // namespace trocar
