// Distribution of durations of a task, counted without allocation. (What drives a run, Timing, stands in channel.h.)
//
// Bins of 1 us to 1 ms, of 100 us to 1 s; what is longer is in the overflow and in the maximum. A percentile is the
// upper end of its bin, never more than the maximum. Thread: that of the task; others when it has ended.
#pragma once

#include <array>
#include <cstdint>

namespace trocar {

class DurationCounts {
 public:
  void add(std::int64_t ns) noexcept;
  std::uint64_t count() const { return count_; }
  std::int64_t max_ns() const { return max_ns_; }
  /// @param share 0..1. @return us; 0 when nothing was counted.
  double percentile_us(double share) const;
  /// Durations above a limit of whole us (up to 1000).
  std::uint64_t above_us(std::int64_t limit) const;

 private:
  static constexpr std::size_t kFine = 1000, kCoarse = 9990;
  std::array<std::uint32_t, kFine + kCoarse + 1> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace trocar
