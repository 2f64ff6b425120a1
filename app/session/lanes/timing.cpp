#include "app/session/lanes/timing.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr std::int64_t kFineNs = 1'000, kCoarseNs = 100'000, kFineEndNs = 4'000'000;

}  // namespace

void DurationCounts::add(std::int64_t ns, std::uint32_t times) noexcept {
  ns = std::max<std::int64_t>(0, ns);
  const auto bin = ns < kFineEndNs ? static_cast<std::size_t>(ns / kFineNs)
                                   : kFine + static_cast<std::size_t>((ns - kFineEndNs) / kCoarseNs);
  if (times == 0) return;
  bins_[std::min(bin, bins_.size() - 1)] += times;
  count_ += times;
  max_ns_ = std::max(max_ns_, ns);
}

void DurationCounts::add(const DurationCounts& others) noexcept {
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) bins_[bin] += others.bins_[bin];
  count_ += others.count_;
  max_ns_ = std::max(max_ns_, others.max_ns_);
}

double DurationCounts::percentile_us(double share) const {
  const double wanted = std::ceil(share * static_cast<double>(count_));
  const double longest_us = static_cast<double>(max_ns_) * 1e-3;
  std::uint64_t sum = 0;
  for (std::size_t bin = 0; bin + 1 < bins_.size(); ++bin) {
    sum += bins_[bin];
    if (static_cast<double>(sum) < wanted || sum == 0) continue;
    const std::int64_t end_ns = bin < kFine ? static_cast<std::int64_t>(bin + 1) * kFineNs
                                            : kFineEndNs + static_cast<std::int64_t>(bin + 1 - kFine) * kCoarseNs;
    return std::min(longest_us, static_cast<double>(end_ns) * 1e-3);
  }
  return longest_us;
}

void DurationCounts::each(const std::function<void(std::int64_t, std::uint64_t)>& tell) const {
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    const auto b = static_cast<std::int64_t>(bin), fine = static_cast<std::int64_t>(kFine);
    if (bins_[bin] > 0) tell(b < fine ? b : (kFineEndNs + (b - fine) * kCoarseNs) / kFineNs, bins_[bin]);
  }
}

std::uint64_t DurationCounts::above_us(std::int64_t limit) const {
  std::uint64_t sum = 0;
  for (std::size_t bin = static_cast<std::size_t>(std::clamp<std::int64_t>(limit, 0, kFine)); bin < bins_.size();
       ++bin) {
    sum += bins_[bin];
  }
  return sum;
}

}  // namespace trocar
