#include "trainees/exchange/export/jigsaws.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "haptics/input_error.h"
#include "scenarios/scoring/metrics.h"
#include "scenarios/scoring/trace_filter.h"

namespace trocar {
namespace {

/// The instrument at one moment of the layout.
struct Moment {
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  double angle = 0;
};

void check_trace(const Trace& trace) {
  if (trace.samples.size() < 2) throw InputError("a trace of fewer than two samples has no motion to export");
  double before = -HUGE_VAL;
  for (const TraceSample& s : trace.samples) {
    const bool finite =
        std::isfinite(s.t_s) && s.tip_T.allFinite() && s.shaft_T.allFinite() && std::isfinite(s.jaw_opening_m);
    if (!finite || s.shaft_T.norm() < 0.5) {
      throw InputError("the trace has values that are not finite at " + std::to_string(s.t_s) + " s");
    }
    if (s.t_s <= before) throw InputError("the trace's times do not increase at " + std::to_string(s.t_s) + " s");
    before = s.t_s;
  }
}

/// Turns the frame so that z becomes the shaft, by the shortest way.
Mat3 carried(const Mat3& R, const Vec3& shaft) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(R.col(2), shaft);
  return (turn * Eigen::Quaterniond(R)).normalized().toRotationMatrix();
}

/// Moments at 30 Hz from the first sample on, linear between neighbours.
std::vector<Moment> moments(const Trace& trace) {
  const std::vector<TraceSample>& s = trace.samples;
  const double span = s.back().t_s - s.front().t_s;
  const auto count = static_cast<std::size_t>(std::floor(span * kJigsawsRateHz + 1e-6)) + 1;
  std::vector<Moment> out(count);
  std::size_t i = 0;
  Mat3 frame = Mat3::Identity();
  for (std::size_t k = 0; k < count; ++k) {
    const double t = s.front().t_s + static_cast<double>(k) / kJigsawsRateHz;
    while (i + 2 < s.size() && s[i + 1].t_s <= t) ++i;
    const double share = std::clamp((t - s[i].t_s) / (s[i + 1].t_s - s[i].t_s), 0.0, 1.0);
    const auto between = [&](const auto& a, const auto& b) { return (a + share * (b - a)).eval(); };
    const Vec3 shaft = between(s[i].shaft_T, s[i + 1].shaft_T);
    frame = carried(frame, shaft.norm() > 1e-9 ? Vec3(shaft.normalized()) : s[i].shaft_T);
    const double opening = s[i].jaw_opening_m + share * (s[i + 1].jaw_opening_m - s[i].jaw_opening_m);
    out[k] = {between(s[i].tip_T, s[i + 1].tip_T), frame,
              2 * std::asin(std::clamp(opening / (2 * kJawLength), -1.0, 1.0))};
  }
  return out;
}

void put(std::string& line, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value == 0 ? 0.0 : value).ptr;  // no -0
  line += line.empty() ? "" : " ";
  line.append(digits, end);
}

/// 19 columns; velocities by central difference, one-sided at the ends.
std::string block(const std::vector<Moment>& path, std::size_t k) {
  const std::size_t a = k > 0 ? k - 1 : 0, b = std::min(k + 1, path.size() - 1);
  const double dt = static_cast<double>(b - a) / kJigsawsRateHz;
  const Eigen::AngleAxisd turn(path[b].R * path[a].R.transpose());
  const Vec3 v = b > a ? Vec3((path[b].p - path[a].p) / dt) : Vec3(Vec3::Zero());
  const Vec3 w = b > a ? Vec3(turn.axis() * turn.angle() / dt) : Vec3(Vec3::Zero());
  std::string line;
  for (int i = 0; i < 3; ++i) put(line, path[k].p[i]);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) put(line, path[k].R(row, column));
  for (int i = 0; i < 3; ++i) put(line, v[i]);
  for (int i = 0; i < 3; ++i) put(line, w[i]);
  put(line, path[k].angle);
  return line;
}

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

std::string jigsaws_text(const Trace& trace) {
  check_trace(trace);
  const std::vector<Moment> path = moments(trace);
  std::string nothing;
  for (int i = 0; i < kJigsawsBlock; ++i) put(nothing, 0);
  std::string out;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::string hand = block(path, k);
    out += nothing + " " + hand + " " + nothing + " " + hand + "\n";
  }
  return out;
}

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

std::string jigsaws_meta_line(const JigsawsTrial& trial) {
  int sum = 0;
  const std::array<int, 6> ratings = trial.ratings.value_or(std::array<int, 6>{});
  for (const int rating : ratings) sum += rating;
  std::string line = trial.name + "\t" + trial.skill + "\t" + std::to_string(sum);
  for (const int rating : ratings) line += "\t" + std::to_string(rating);
  return line + "\n";
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
