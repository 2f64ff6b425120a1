#include "haptics/device/plant/plant_faults.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kMostMissed = 1000, kLongestDelay = 63;  // periods

bool present(const InjectedFault& f, double now_s) {
  const bool begun = now_s >= f.at_s - kTimeSlack;
  return begun && (f.duration_s == 0 || now_s < f.at_s + f.duration_s - kTimeSlack);
}

}  // namespace

std::string injection_refusal(const InjectedFault& f) {
  if (f.channel < 0 || f.channel >= kChannels) return "fault channels are 0 to 6";
  if (!std::isfinite(f.at_s) || !std::isfinite(f.duration_s) || f.at_s < 0 || f.duration_s < 0) {
    return "fault times must not be negative";
  }
  if (!std::isfinite(f.value)) return "a fault's value must be finite";
  if (f.kind == InjectedFaultKind::kMissedSync && !(f.value >= 1 && f.value <= kMostMissed)) {
    return "missed SYNCs are 1 to 1000";
  }
  if (f.kind == InjectedFaultKind::kDelay && !(f.value >= 1 && f.value <= kLongestDelay)) {
    return "a delay is 1 to 63 periods";
  }
  if (f.kind == InjectedFaultKind::kEncoderJump && !(std::abs(f.value) <= INT32_MAX)) {
    return "a jump is at most 2147483647 counts";
  }
  return "";
}

PlantFaults::PlantFaults(const std::vector<InjectedFault>& faults) {
  for (const InjectedFault& fault : faults) entries_.push_back({fault});
}

bool PlantFaults::lasts(InjectedFaultKind kind, double now_s) const noexcept {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.fault.kind == kind && present(e.fault, now_s); });
}

bool PlantFaults::lasts(InjectedFaultKind kind, double now_s, int channel) const noexcept {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.fault.kind == kind && e.fault.channel == channel && present(e.fault, now_s);
  });
}

std::uint32_t PlantFaults::missed_syncs(double next_s) noexcept {
  std::uint32_t missed = 0;
  for (Entry& e : entries_) {
    if (e.fault.kind != InjectedFaultKind::kMissedSync || e.fired || !present(e.fault, next_s)) continue;
    e.fired = true;
    missed += static_cast<std::uint32_t>(e.fault.value);
  }
  return missed;
}

int PlantFaults::extra_delay(double now_s) const noexcept {
  double periods = 0;
  for (const Entry& e : entries_) {
    if (e.fault.kind == InjectedFaultKind::kDelay && present(e.fault, now_s)) periods += e.fault.value;
  }
  return static_cast<int>(std::min(periods, kLongestDelay));
}

void PlantFaults::spoil(DaqSample& sample, const DaqSample& last, double now_s) noexcept {
  for (Entry& e : entries_) {
    const InjectedFault& f = e.fault;
    if (!present(f, now_s)) continue;
    if (f.kind == InjectedFaultKind::kEncoderJump && !e.fired) {
      jump_[f.channel] += static_cast<std::int32_t>(f.value);
      e.fired = true;
    }
    if (f.kind == InjectedFaultKind::kChannelInvalid) {
      sample.valid = static_cast<std::uint8_t>(sample.valid & ~(1u << f.channel));
    }
  }
  for (int i = 0; i < kChannels; ++i) {
    sample.counts[i] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(sample.counts[i]) + static_cast<std::uint32_t>(jump_[i]));
    if (lasts(InjectedFaultKind::kEncoderStuck, now_s, i)) sample.counts[i] = last.counts[i];
  }
}

}  // namespace trocar
