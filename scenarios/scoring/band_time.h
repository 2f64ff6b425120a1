// Time in and out of a wanted force, object by object: so that dwelling on one that is easy cannot buy back a bad one.
//
// An object's share is in / (in + out) seconds, with `in` counted to a limit only: what is asked for needs no more, so
// staying in the band longer earns nothing. While the instrument stands still by clutch or port the time in the band
// does not count, the time out of it does.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scenarios/scoring/scoring_context.h"
#include "scenarios/scoring/trace.h"

namespace trocar {

/// A stretch of the attempt in which one object's force is judged, s.
struct BandWindow {
  std::int32_t object = -1;
  double from_s = 0, to_s = 0;
  ObjectBand band;
};

/// Spans from CLUTCH or PORT_HOLD to INSTRUMENT_FREE, or to the end, in order.
class FrozenTimes {
 public:
  FrozenTimes(const std::vector<Event>& events, double end_s);
  bool at(double t_s) const;

 private:
  std::vector<std::array<double, 2>> spans_;
};

/// Seconds in and out of the wanted force, by object.
class BandTimes {
 public:
  explicit BandTimes(FrozenTimes frozen) : frozen_(std::move(frozen)) {}
  void add(const BandWindow& window, double t_s, double weight_s, double force_n);
  /// Mean of the objects' shares; empty when nothing was judged. @param counted_s of the time in the band; 0: none said
  std::optional<double> mean_share(double counted_s) const;

 private:
  struct Seconds {
    double in = 0, out = 0;
  };
  FrozenTimes frozen_;
  std::map<std::int32_t, Seconds> of_object_;
};

}  // namespace trocar
