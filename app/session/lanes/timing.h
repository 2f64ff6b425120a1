// Distribution of durations of a task, counted without allocation. (What drives a run, Timing, stands in channel.h.)
//
// Bins of 1 us to 4 ms (so that the period of a loop at 1 kHz is told to a microsecond), of 100 us to 1 s; what is
// longer is in the overflow and in the maximum. A percentile is the upper end of its bin, never more than the maximum.
// Thread: that of the task; others when it has ended.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

namespace trocar {

class DurationCounts {
 public:
  void add(std::int64_t ns, std::uint32_t times = 1) noexcept;
  void add(const DurationCounts& others) noexcept;
  std::uint64_t count() const { return count_; }
  std::int64_t max_ns() const { return max_ns_; }
  /// @param share 0..1. @return us; 0 when nothing was counted.
  double percentile_us(double share) const;
  /// Durations above a limit of whole us (up to 4000).
  std::uint64_t above_us(std::int64_t limit) const;
  /// Each bin that is not empty, from below: its lower end in us, how many. The overflow stands at 1 s.
  void each(const std::function<void(std::int64_t lower_us, std::uint64_t count)>& tell) const;

 private:
  static constexpr std::size_t kFine = 4000, kCoarse = 9960;
  std::array<std::uint32_t, kFine + kCoarse + 1> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace trocar
