#include "app/session/recording/recorded_tick.h"

#include <cmath>
#include <limits>

namespace trocar {
namespace {

// Quanta are decimal fractions: dividing by the whole number 1/quantum gives the double nearest to the decimal.
constexpr double kPerMetre = 1e6, kPerDirection = 1e4, kPerNewton = 1e3, kPerStiffness = 10;

std::int32_t to_quanta(double value, double per_unit) {
  const double quanta = std::round(value * per_unit);
  constexpr double kLimit = std::numeric_limits<std::int32_t>::max();
  if (!(std::abs(quanta) <= kLimit)) return kNotRepresentable;
  return static_cast<std::int32_t>(quanta);
}

double from_quanta(std::int32_t quanta, double per_unit) {
  if (quanta == kNotRepresentable) return std::numeric_limits<double>::quiet_NaN();
  return quanta / per_unit;
}

std::array<std::int32_t, 3> to_quanta(const Vec3& value, double per_unit) {
  return {to_quanta(value.x(), per_unit), to_quanta(value.y(), per_unit), to_quanta(value.z(), per_unit)};
}

Vec3 from_quanta(const std::array<std::int32_t, 3>& quanta, double per_unit) {
  return {from_quanta(quanta[0], per_unit), from_quanta(quanta[1], per_unit), from_quanta(quanta[2], per_unit)};
}

}  // namespace

RecordedTick quantise(std::uint64_t tick, const DaqSample& input, const TraceSample& sample, LoopState loop,
                      std::uint8_t phase) {
  RecordedTick row;
  row.tick = tick;
  row.counts = input.counts;
  row.elapsed_periods = input.elapsed_periods;
  row.digital_in = input.digital_in;
  row.valid = input.valid;
  row.tip = to_quanta(sample.tip_T, kPerMetre);
  row.shaft = to_quanta(sample.shaft_T, kPerDirection);
  row.force = to_quanta(sample.force_T, kPerNewton);
  row.commanded = to_quanta(sample.commanded_n, kPerNewton);
  row.rendered = to_quanta(sample.rendered_n, kPerNewton);
  row.grip = to_quanta(sample.grip_n, kPerNewton);
  row.jaw_opening = to_quanta(sample.jaw_opening_m, kPerMetre);
  row.stiffness = to_quanta(sample.stiffness_n_per_m, kPerStiffness);
  row.k_max = to_quanta(sample.k_max_n_per_m, kPerStiffness);
  row.flags = static_cast<std::uint8_t>((sample.contact ? kFlagContact : 0) | (sample.saturated ? kFlagSaturated : 0) |
                                        (sample.passivity_active ? kFlagPassivityActive : 0) |
                                        (sample.pedal ? kFlagPedal : 0) | sample.instrument << kFirstInstrumentBit);
  row.loop_state = static_cast<std::uint8_t>(loop);
  row.phase = phase;
  return row;
}

TraceSample dequantise(const RecordedTick& row, double rate_hz) {
  TraceSample sample;
  sample.t_s = static_cast<double>(row.tick) / rate_hz;
  sample.tip_T = from_quanta(row.tip, kPerMetre);
  sample.shaft_T = from_quanta(row.shaft, kPerDirection);
  if (const double length = sample.shaft_T.norm(); length > 0) sample.shaft_T /= length;
  sample.force_T = from_quanta(row.force, kPerNewton);
  sample.commanded_n = from_quanta(row.commanded, kPerNewton);
  sample.rendered_n = from_quanta(row.rendered, kPerNewton);
  sample.grip_n = from_quanta(row.grip, kPerNewton);
  sample.jaw_opening_m = from_quanta(row.jaw_opening, kPerMetre);
  sample.stiffness_n_per_m = from_quanta(row.stiffness, kPerStiffness);
  sample.k_max_n_per_m = from_quanta(row.k_max, kPerStiffness);
  sample.contact = (row.flags & kFlagContact) != 0;
  sample.saturated = (row.flags & kFlagSaturated) != 0;
  sample.passivity_active = (row.flags & kFlagPassivityActive) != 0;
  sample.pedal = (row.flags & kFlagPedal) != 0;
  sample.instrument = row.flags >> kFirstInstrumentBit;
  return sample;
}

DaqSample device_input(const RecordedTick& row) {
  DaqSample input;
  input.counts = row.counts;
  input.valid = row.valid;
  input.elapsed_periods = row.elapsed_periods;
  input.digital_in = row.digital_in;
  return input;
}

Trace rebuild_trace(std::span<const RecordedTick> rows, double rate_hz) {
  Trace trace;
  trace.rate_hz = rate_hz;
  trace.samples.reserve(rows.size());
  for (const RecordedTick& row : rows) trace.samples.push_back(dequantise(row, rate_hz));
  return trace;
}

}  // namespace trocar
