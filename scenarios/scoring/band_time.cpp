#include "scenarios/scoring/band_time.h"

#include <algorithm>

namespace trocar {

FrozenTimes::FrozenTimes(const std::vector<Event>& events, double end_s) {
  const Event* since = nullptr;
  for (const Event& event : events) {
    if (!since && (event.type == event_type::kClutch || event.type == event_type::kPortHold)) since = &event;
    if (!since || event.type != event_type::kInstrumentFree) continue;
    spans_.push_back({since->t_s, event.t_s});
    since = nullptr;
  }
  if (since) spans_.push_back({since->t_s, end_s});
}

bool FrozenTimes::at(double t_s) const {
  return std::any_of(spans_.begin(), spans_.end(), [t_s](const auto& span) { return t_s >= span[0] && t_s < span[1]; });
}

void BandTimes::add(const BandWindow& window, double t_s, double weight_s, double force_n) {
  Seconds& seconds = of_object_[window.object];
  if (force_n < window.band.low_n || force_n > window.band.high_n) {
    seconds.out += weight_s;
  } else if (!frozen_.at(t_s)) {
    seconds.in += weight_s;
  }
}

std::optional<double> BandTimes::mean_share(double counted_s) const {
  if (!(counted_s > 0)) return std::nullopt;
  double sum = 0;
  int judged = 0;
  for (const auto& [object, seconds] : of_object_) {
    const double in = std::min(seconds.in, counted_s), whole = in + seconds.out;
    if (!(whole > 0)) continue;
    sum += in / whole;
    ++judged;
  }
  return judged > 0 ? std::optional<double>(sum / judged) : std::nullopt;
}

}  // namespace trocar
