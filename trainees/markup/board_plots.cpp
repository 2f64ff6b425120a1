#include "trainees/markup/board_plots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/scoring/event_types.h"
#include "trainees/markup/html.h"
#include "trainees/markup/plots.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

using svg::attribute;
using svg::label;
using svg::line;
using svg::nice_step;
using svg::px;
using svg::rect;
using svg::ticks;

constexpr double kWidth = 1000, kLeft = 52, kRight = 986;
constexpr const char* kInside = "#009e73";
constexpr const char* kOutside = "#d55e00";

/// One panel of bars, a bar a pen, with the tolerance as a line across.
struct Panel {
  double top, bottom;
  std::string title;
  double limit = 0, scale = 1;  ///< limit in shown units; SI value times scale is shown

  double highest(const std::vector<std::optional<double>>& values) const {
    double most = std::max(1.3 * limit, 1e-6);
    for (const auto& value : values)
      if (value && std::isfinite(*value)) most = std::max(most, 1.1 * scale * *value);
    return most;
  }

  std::string draw(const std::vector<std::optional<double>>& values, const std::vector<int>& timeouts) const {
    const double most = highest(values),
                 slot = (kRight - kLeft) / std::max<double>(1, static_cast<double>(values.size()));
    const auto y = [&](double shown) { return bottom - (bottom - top) * std::clamp(shown / most, 0.0, 1.0); };
    std::string out = label(kLeft, top - 8, title, "start", "font-weight=\"bold\"");
    const double step = nice_step(most, 3);
    for (const double tick : ticks(0, most, step))
      out += line(kLeft, y(tick), kRight, y(tick), "stroke=\"#000\" stroke-opacity=\"0.12\"") +
             label(kLeft - 7, y(tick) + 5, number_text(tick), "end");
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double middle = kLeft + (static_cast<double>(i) + 0.5) * slot;
      if (values[i] && std::isfinite(*values[i]))
        out += bar(*values[i] * scale, middle, 0.44 * slot, y);
      else
        out += label(middle, bottom - 6, slot < 95 ? "none" : "not matched", "middle", "fill=\"#b04a00\"");
      if (timeouts[i] > 0)
        out += label(middle + 0.26 * slot, top + 14, "\u00d7" + std::to_string(timeouts[i]), "start",
                     "fill=\"#b04a00\" font-weight=\"bold\"");
    }
    if (limit > 0)
      out +=
          line(kLeft, y(limit), kRight, y(limit), "stroke=\"#d55e00\" stroke-width=\"1.6\" stroke-dasharray=\"7 4\"");
    return out;
  }

 private:
  template <typename Height>
  std::string bar(double shown, double middle, double width, const Height& y) const {
    const bool inside = limit <= 0 || shown <= limit;
    const char* colour = limit <= 0 ? "#0072b2" : inside ? kInside : kOutside;
    return rect(middle - 0.5 * width, y(shown), width, bottom - y(shown), std::string("fill=\"") + colour + "\"") +
           label(middle, y(shown) - 5, fixed_text(shown, 1), "middle");
  }
};

double start_of(const Trace& trace) { return trace.samples.empty() ? 0 : trace.samples.front().t_s; }

bool ends_carry(const Event& event) {
  return event.type == event_type::kSetDown || event.type == event_type::kDrop || event.type == event_type::kLost ||
         event.type == event_type::kPlaced;
}

double window_share(const Trace& trace, double from_s, double to_s, const GripLimits& limits) {
  std::size_t inside = 0, all = 0;
  for (const TraceSample& sample : trace.samples) {
    if (sample.t_s < from_s || sample.t_s > to_s) continue;
    ++all;
    inside += sample.grip_n >= limits.slip_n && sample.grip_n <= limits.crush_n;
  }
  return all ? static_cast<double>(inside) / static_cast<double>(all) : 0;
}

constexpr double kTop = 40, kBottom = 250, kShareTop = 300, kRow = 24;

/// Grip force over time above, one row a block with its carry share below.
class GripPlot {
 public:
  GripPlot(const Trace& trace, const std::vector<Event>& events, const std::vector<GripLimits>& blocks)
      : trace_(trace), blocks_(blocks), carries_(carries(trace, events, blocks)), start_s_(start_of(trace)) {
    double most = 0.5;
    for (const GripLimits& block : blocks) most = std::max(most, 1.1 * block.crush_n);
    for (const TraceSample& sample : trace.samples)
      if (std::isfinite(sample.grip_n)) most = std::max(most, 1.05 * sample.grip_n);
    top_n_ = most;
    if (!trace.samples.empty()) end_s_ = std::max(trace.samples.back().t_s - start_s_, 1e-3);
  }

  double height() const { return kShareTop + kRow * static_cast<double>(blocks_.size()) + 8; }
  std::string draw() const { return windows() + axes() + force() + key() + shares(); }

 private:
  double x(double t_s) const { return kLeft + (kRight - kLeft) * std::clamp((t_s - start_s_) / end_s_, 0.0, 1.0); }
  double y(double n) const { return kBottom - (kBottom - kTop) * std::clamp(n / top_n_, 0.0, 1.0); }

  /// While a block is carried: its window in green, its slip line below and its crush line above.
  std::string windows() const {
    std::string out;
    for (const Carry& carry : carries_) {
      const GripLimits& limits = blocks_[static_cast<std::size_t>(carry.block)];
      const double x0 = x(carry.from_s), x1 = std::max(x(carry.to_s), x0 + 2);
      out += rect(x0, y(limits.crush_n), x1 - x0, y(limits.slip_n) - y(limits.crush_n),
                  "fill=\"#009e73\" fill-opacity=\"0.17\"");
      out += line(x0, y(limits.slip_n), x1, y(limits.slip_n), "stroke=\"#0072b2\" stroke-width=\"2\"");
      out += line(x0, y(limits.crush_n), x1, y(limits.crush_n), "stroke=\"#d55e00\" stroke-width=\"2\"");
      out += label(0.5 * (x0 + x1), y(limits.crush_n) - 5, std::to_string(carry.block + 1), "middle",
                   "font-weight=\"bold\"");
    }
    return out;
  }

  std::string axes() const {
    std::string out;
    for (const double n : ticks(0, top_n_, nice_step(top_n_, 5)))
      out += line(kLeft, y(n), kRight, y(n), "stroke=\"#000\" stroke-opacity=\"0.12\"") +
             label(kLeft - 7, y(n) + 5, number_text(n), "end");
    for (const double t : ticks(0, end_s_ * 1.0001, nice_step(end_s_, 10)))
      out += line(x(t + start_s_), kBottom, x(t + start_s_), kBottom + 5, "stroke=\"#555\"") +
             label(x(t + start_s_), kBottom + 20, number_text(t), "middle");
    return out + label(6, kTop - 10, "grip, N") + label(kRight, kBottom + 36, "time, s", "end");
  }

  std::string force() const {
    std::vector<double> t_s, grip_n;
    for (const TraceSample& sample : trace_.samples) {
      t_s.push_back(sample.t_s - start_s_);
      grip_n.push_back(sample.grip_n);
    }
    std::string points;
    for (const ColumnRange& c : column_ranges(t_s, grip_n, end_s_, static_cast<int>(kRight - kLeft))) {
      points += px(kLeft + c.column) + "," + px(y(c.low)) + " ";
      if (c.high > c.low) points += px(kLeft + c.column) + "," + px(y(c.high)) + " ";
    }
    if (!points.empty()) points.pop_back();
    return "<polyline fill=\"none\" stroke=\"#1d2630\" stroke-width=\"1.3\"" + attribute("points", points) + "/>";
  }

  std::string key() const {
    const double at = kTop - 14;
    return line(330, at - 5, 350, at - 5, "stroke=\"#d55e00\" stroke-width=\"2\"") + label(356, at, "crushed above") +
           line(490, at - 5, 510, at - 5, "stroke=\"#0072b2\" stroke-width=\"2\"") + label(516, at, "slips below") +
           rect(640, at - 11, 20, 12, "fill=\"#009e73\" fill-opacity=\"0.25\"") +
           label(666, at, "window of the block carried (its number above)");
  }

  std::string shares() const {
    std::string out = label(kLeft, kShareTop - 10, "Carry time within the window", "start", "font-weight=\"bold\"");
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      double inside = 0, all = 0;
      for (const Carry& carry : carries_)
        if (carry.block == static_cast<int>(i)) {
          inside += carry.share_in_window * (carry.to_s - carry.from_s);
          all += carry.to_s - carry.from_s;
        }
      const double top = kShareTop + kRow * static_cast<double>(i), full = 560, left = kLeft + 250;
      out += label(kLeft, top + 14,
                   "Block " + std::to_string(i + 1) + ", " + number_text(blocks_[i].slip_n) + " to " +
                       number_text(blocks_[i].crush_n) + " N");
      out += rect(left, top + 3, full, 14, "fill=\"#dfe3e8\"");
      if (all > 0) {
        const double share = inside / all;
        out +=
            rect(left, top + 3, share * full, 14, std::string("fill=\"") + (share < 0.8 ? kOutside : kInside) + "\"");
        out += label(left + full + 10, top + 15, fixed_text(100 * share, 0) + " % of " + fixed_text(all, 1) + " s");
      } else {
        out += label(left + full + 10, top + 15, "never carried");
      }
    }
    return out;
  }

  const Trace& trace_;
  const std::vector<GripLimits>& blocks_;
  std::vector<Carry> carries_;
  double start_s_ = 0, end_s_ = 1, top_n_ = 1;
};

}  // namespace

std::vector<PenOutcome> pen_outcomes(const std::vector<Event>& events) {
  std::vector<PenOutcome> pens;
  for (const Event& event : events) {
    if (event.object < 0 || event.object > 255) continue;
    const auto i = static_cast<std::size_t>(event.object);
    if (i >= pens.size()) pens.resize(i + 1);
    if (event.type == event_type::kPositionError) pens[i].position_error_m = event.value;
    if (event.type == event_type::kAngleError) pens[i].angle_error_rad = event.value;
    if (event.type == event_type::kTargetHeld) pens[i].time_s = event.value;
    if (event.type == event_type::kTargetTimeout) ++pens[i].timeouts;
  }
  return pens;
}

std::vector<Carry> carries(const Trace& trace, const std::vector<Event>& events,
                           const std::vector<GripLimits>& blocks) {
  std::vector<Carry> out;
  std::vector<std::optional<double>> lifted(blocks.size());
  const auto close = [&](std::size_t block, double to_s) {
    if (!lifted[block] || to_s <= *lifted[block]) return;
    out.push_back(
        {static_cast<int>(block), *lifted[block], to_s, window_share(trace, *lifted[block], to_s, blocks[block])});
    lifted[block].reset();
  };
  for (const Event& event : events) {
    if (event.object < 0 || event.object >= static_cast<int>(blocks.size())) continue;
    const auto block = static_cast<std::size_t>(event.object);
    if (event.type == event_type::kLifted && !lifted[block]) lifted[block] = event.t_s;
    if (ends_carry(event)) close(block, event.t_s);
  }
  const double end_s = trace.samples.empty() ? 0 : trace.samples.back().t_s;
  for (std::size_t block = 0; block < blocks.size(); ++block) close(block, end_s);  // still in the air at the end
  return out;
}

std::string pose_plot_svg(const std::vector<Event>& events, const PoseLimits& limits) {
  const std::vector<PenOutcome> pens = pen_outcomes(events);
  std::vector<std::optional<double>> position, angle, time;
  std::vector<int> timeouts;
  for (const PenOutcome& pen : pens) {
    position.push_back(pen.position_error_m);
    angle.push_back(pen.angle_error_rad);
    time.push_back(pen.time_s);
    timeouts.push_back(pen.timeouts);
  }
  const double deg = 180 / std::numbers::pi;
  std::string out = "<svg viewBox=\"0 0 " + px(kWidth) + " 470\" role=\"img\" aria-label=\"Error of each pen\">";
  out += Panel{30, 140, "Distance of the tip while held, mm", 1e3 * limits.position_m, 1e3}.draw(position, timeouts);
  out += Panel{178, 288, "Turn to the pen while held, degrees", deg * limits.angle_rad, deg}.draw(angle, timeouts);
  out += Panel{326, 426, "Time from lit to matched, s", 0, 1}.draw(time, timeouts);
  const double slot = (kRight - kLeft) / std::max<double>(1, static_cast<double>(pens.size()));
  for (std::size_t i = 0; i < pens.size(); ++i)
    out += label(kLeft + (static_cast<double>(i) + 0.5) * slot, 446, "pen " + std::to_string(i + 1), "middle");
  if (pens.empty()) out += label(0.5 * kWidth, 90, "no pen was lit", "middle");
  return out + line(60, 462, 90, 462, "stroke=\"#d55e00\" stroke-width=\"1.6\" stroke-dasharray=\"7 4\"") +
         label(96, 467, "allowed; \u00d7n: ran out of time n times") + "</svg>";
}

std::string grip_plot_svg(const Trace& trace, const std::vector<Event>& events, const std::vector<GripLimits>& blocks) {
  const GripPlot plot(trace, events, blocks);
  return "<svg viewBox=\"0 0 " + px(kWidth) + " " + px(plot.height()) +
         "\" role=\"img\" aria-label=\"Grip force against time\">" + plot.draw() + "</svg>";
}

}  // namespace trocar
