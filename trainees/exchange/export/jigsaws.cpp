#include "trainees/exchange/export/jigsaws.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "haptics/input_error.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/trace_filter.h"

namespace trocar {
namespace {

std::vector<double> numbers_of(std::string_view line, const std::string& name, int number) {
  std::vector<double> values;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == ',')) ++at;
    if (at == end) return values;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool whole = next == end || *next == ' ' || *next == '\t' || *next == '\r' || *next == ',';
    if (error != std::errc() || !whole || !std::isfinite(value)) {
      throw InputError(name, number, static_cast<int>(at - line.data()) + 1, "is no finite number");
    }
    values.push_back(value);
    at = next;
  }
}

/// @param c the 19 columns of the instrument.
TraceSample sample_of(const double* c, double t_s, const std::string& name, int number) {
  TraceSample sample;
  sample.t_s = t_s;
  sample.tip_T = Vec3(c[0], c[1], c[2]);
  Mat3 R;
  R << c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11];
  if ((R * R.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() > 0.02 || R.determinant() < 0) {
    throw InputError(name, number, 1, "columns 4 to 12 of the instrument are no rotation matrix");
  }
  sample.shaft_T = R.col(2).normalized();
  sample.jaw_opening_m = 2 * kJawLength * std::sin(c[18] / 2);
  return sample;
}

/// A cubic through four neighbours (Catmull-Rom), at `share` of the way from b to c.
Vec3 cubic(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double share) {
  const Vec3 first = (c - a) / 2, second = a - 2.5 * b + 2 * c - d / 2, third = (d - a) / 2 + 1.5 * (b - c);
  return b + share * (first + share * (second + share * third));
}

/// The metrics' definitions take the path at kMetricRateHz: a slower trace is brought there.
Trace at_metric_rate(const Trace& slow) {
  const std::vector<TraceSample>& s = slow.samples;
  if (slow.rate_hz >= kMetricRateHz || s.size() < 4) return slow;
  Trace fast;
  fast.rate_hz = kMetricRateHz;
  const double span = s.back().t_s - s.front().t_s;
  const auto count = static_cast<std::size_t>(std::floor(span * kMetricRateHz + 1e-6)) + 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double at =
        std::min(static_cast<double>(k) / kMetricRateHz * slow.rate_hz, static_cast<double>(s.size() - 1));
    const std::size_t i = std::min(static_cast<std::size_t>(at), s.size() - 2);
    const std::size_t a = i > 0 ? i - 1 : 0, d = std::min(i + 2, s.size() - 1);
    const double share = at - static_cast<double>(i);
    TraceSample sample = s[share < 0.5 ? i : i + 1];
    sample.t_s = s.front().t_s + static_cast<double>(k) / kMetricRateHz;
    sample.tip_T = cubic(s[a].tip_T, s[i].tip_T, s[i + 1].tip_T, s[d].tip_T, share);
    sample.shaft_T = (s[i].shaft_T + share * (s[i + 1].shaft_T - s[i].shaft_T)).normalized();
    fast.samples.push_back(sample);
  }
  return fast;
}

bool nothing_there(const double* c) {
  return std::all_of(c, c + 12, [](double value) { return value == 0; });
}

}  // namespace

Trace parse_jigsaws(std::string_view text, const std::string& name, JigsawsSide side) {
  Trace trace;
  trace.rate_hz = kJigsawsRateHz;
  const int first = (side == JigsawsSide::kLeft ? 2 : 3) * kJigsawsBlock;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    const std::vector<double> values = numbers_of(line, name, ++number);
    if (values.empty()) continue;
    if (values.size() != static_cast<std::size_t>(kJigsawsColumns)) {
      throw InputError(name, number, 1,
                       "has " + std::to_string(values.size()) + " numbers, not " + std::to_string(kJigsawsColumns));
    }
    if (nothing_there(values.data() + first)) {
      const std::string hand = side == JigsawsSide::kRight ? "right" : "left";
      throw InputError(name, number, 1,
                       "no instrument stands in the columns of slave " + hand + ": try the other side");
    }
    trace.samples.push_back(
        sample_of(values.data() + first, static_cast<double>(trace.samples.size()) / kJigsawsRateHz, name, number));
  }
  if (trace.samples.size() < 2) throw InputError(name + ": has fewer than two lines of 76 numbers");
  return trace;
}

std::vector<Metric> kinematic_metrics(const Trace& given) {
  std::vector<Metric> all, defined;
  if (given.samples.empty()) return defined;
  const Trace trace = at_metric_rate(given);
  Event start, done;
  start.t_s = trace.samples.front().t_s;
  start.type = event_type::kStart.name;
  done.t_s = trace.samples.back().t_s;
  done.type = event_type::kDone.name;
  add_motion_metrics(trace, {start, done}, ScoringContext{}, all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(defined),
               [](const Metric& metric) { return metric.value.has_value(); });
  return defined;
}

}  // namespace trocar
