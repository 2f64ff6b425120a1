#include "haptics/force_sensor/ati/wrench_stream.h"

#include <cmath>
#include <ctime>
#include <iomanip>
#include <sstream>

namespace trocar {
namespace {

constexpr std::uint64_t WrenchLink::*kCounters[] = {
    &WrenchLink::records, &WrenchLink::lost,  &WrenchLink::out_of_order, &WrenchLink::malformed,
    &WrenchLink::unsound, &WrenchLink::begun, &WrenchLink::taken_away};

}  // namespace

std::string counts_words(const WrenchCounts& counts) {
  std::ostringstream out;
  out << std::setprecision(9) << counts.per_n << " counts a N and " << counts.per_nm << " a N m, from " << counts.from;
  return out.str();
}

std::string link_words(const WrenchLink& link) {
  std::string out = std::to_string(link.records) + " records, " + std::to_string(link.lost) + " lost, " +
                    std::to_string(link.malformed) + " broken, " + std::to_string(link.unsound) +
                    " saturated or in error; asked to begin " +
                    (link.begun == 1 ? "once" : std::to_string(link.begun) + " times");
  if (link.taken_away > 0)
    out += "; " + std::to_string(link.taken_away) + (link.taken_away == 1 ? " time" : " times") +
           " its records stopped and went on as soon as it was asked: another program may be listening to it, which "
           "takes them away";
  return out;
}

std::int64_t monotonic_ns() {
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

WrenchStream::WrenchStream(const WrenchStreamOptions& options) : options_(options) {
  config_.rate_hz = options.rate_hz;
  config_.lag_s = options.lag_s;
  config_.noise_n = config_.drift_n_per_h = 0;  // the real one has its own
}

std::size_t WrenchStream::delay() const {
  return static_cast<std::size_t>(std::lround(options_.lag_s * options_.rate_hz));
}

void WrenchStream::stop() {
  ends_ = true;
  if (thread_.joinable()) thread_.join();
}

void WrenchStream::count(std::uint64_t WrenchLink::*what, std::uint64_t by) {
  for (std::size_t i = 0; i < counters_.size(); ++i)
    if (kCounters[i] == what) counters_[i].fetch_add(by, std::memory_order_release);
}

WrenchLink WrenchStream::link() const {
  WrenchLink out;
  for (std::size_t i = 0; i < counters_.size(); ++i) out.*kCounters[i] = counters_[i].load(std::memory_order_acquire);
  out.counts = {options_.counts_per_n, options_.counts_per_nm, options_.counts_from, options_.counts_doubt};
  return out;
}

void WrenchStream::take(const std::array<std::int64_t, 6>& counts, bool sound) {
  WrenchRecord record;
  record.number = ++taken_;
  record.arrived_ns = options_.now_ns();
  Vec3 force;
  for (int i = 0; i < 3; ++i)
    force[i] = static_cast<double>(counts[static_cast<std::size_t>(i)]) / options_.counts_per_n;
  Vec3 moment;
  for (int i = 0; i < 3; ++i)
    moment[i] = static_cast<double>(counts[static_cast<std::size_t>(3 + i)]) / options_.counts_per_nm;
  record.sound =
      sound && force.cwiseAbs().maxCoeff() <= options_.most_n && moment.cwiseAbs().maxCoeff() <= options_.most_nm;
  if (record.sound && bias_due_.exchange(false)) zero_ = force, zero_moment_ = moment;
  record.moment_nm = moment - zero_moment_;
  record.force_n = force - zero_;
  newest_.write(record);
  if (!record.sound) count(&WrenchLink::unsound);
  count(&WrenchLink::records);  // last: who sees it counted finds it
}

std::pair<WrenchRecord, bool> WrenchStream::newest() {
  const WrenchRecord record = newest_.read();
  const bool fresh =
      record.number > 0 && static_cast<double>(options_.now_ns() - record.arrived_ns) < 1e9 * options_.silent_s;
  return {record, fresh && record.sound};
}

ForceSample WrenchStream::sample(const Vec3& /*acting*/) {
  const auto [record, holds] = newest();
  return {.number = ++sampled_, .force = record.force_n, .valid = holds, .moment_nm = record.moment_nm};
}

}  // namespace trocar
