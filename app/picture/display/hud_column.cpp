#include "app/picture/display/hud_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <tuple>

namespace trocar {
namespace {

constexpr int kStepLines = 3, kRowsToSay = 3;
constexpr double kWholeFrom = 10;  // mm: an error so large is said in whole millimetres

/// What is shown and how tightly: from roomy to dense until the column holds it.
struct Plan {
  double pitch = 1.34;  ///< line pitch of lists, in body sizes
  double gap = 0.75;    ///< between sections
  int bars = 0, steps = 0, rows = 0;
  double dial = 0;      ///< diameter of the dials in body sizes; 0: the same as two rows of text
  bool legends = true;  ///< under the force bars
  bool device_as_rows = true;
  int device_lines = 2;  ///< of the flowing form
};

/// A label with its numbers in it.
std::string put_in(std::string label, const std::string& first, const std::string& second = "") {
  for (const auto& [place, value] : {std::pair("{1}", second), std::pair("{0}", first)})
    if (const std::size_t at = label.find(place); at != std::string::npos) label.replace(at, 3, value);
  return label;
}

class Column {
 public:
  Column(HudPen& pen, const Hud& hud, const HudFrame& frame)
      : pen_(pen), hud_(hud), labels_(hud.labels), frame_(frame), body_(frame.body) {
    box_ = {frame.width - frame.column_width, frame.top, frame.column_width, frame.height - frame.top};
    x_ = box_.x + frame.px(14);
    room_ = box_.width - frame.px(28);
    choose_plan();
  }

  void lay() {
    pen_.column(box_);
    pen_.shape(HudShape::Kind::kPanel, box_);
    y_ = box_.y + 0.4 * body_;
    lay_dial();
    lay_bars();
    lay_steps();
    lay_rows();
    lay_device();
  }

 private:
  std::string number(double value, int decimals) const {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return with_sign(text.data());
  }

  std::string short_number(double value) const {
    std::array<char, 40> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.2f", value);
    std::string text = buffer.data();
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return with_sign(text);
  }

  std::string with_sign(std::string text) const {
    if (const std::size_t at = text.find('.'); at != std::string::npos) text.replace(at, 1, labels_.decimal);
    return text;
  }

  double line() const { return plan_.pitch * body_; }
  double heading_height() const { return 1.45 * body_; }
  double bar_height() const { return (1.40 + 1.15 + (plan_.legends ? 1.35 : 0) + 0.35) * body_; }
  double icon_room() const { return 1.5 * body_; }

  HudPen::Lines step_lines(std::size_t i) {
    return pen_.wrapped(hud_.steps[i].text, body_, false, room_ - icon_room(), kStepLines);
  }

  /// First and one past the last step shown: a window that holds the current one.
  std::pair<std::size_t, std::size_t> step_window() const {
    const std::size_t n = hud_.steps.size(), shown = static_cast<std::size_t>(plan_.steps);
    std::size_t current = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (hud_.steps[i].state != HudStep::State::kOpen) current = i;
    const std::size_t before = shown > 1 && current > 0 ? current - 1 : current;
    const std::size_t first = std::min(before, n - shown);
    return {first, first + shown};
  }

  /// The rows that are shown, in their order: gauges are left out last.
  std::vector<HudRow> shown_rows() const {
    std::vector<HudRow> out = hud_.rows;
    while (static_cast<int>(out.size()) > plan_.rows) {
      const auto last = std::find_if(out.rbegin(), out.rend(), [](const HudRow& row) { return !row.gauge; });
      out.erase(last == out.rend() ? out.end() - 1 : std::prev(last.base()));
    }
    return out;
  }

  bool says_left_out() const { return plan_.rows >= kRowsToSay && plan_.rows < static_cast<int>(hud_.rows.size()); }

  /// The device in flowing lines of whole entries, gauges first; what has no room is left out.
  std::vector<std::string> device_flow() {
    std::vector<HudRow> entries = hud_.device;
    std::stable_partition(entries.begin(), entries.end(), [](const HudRow& row) { return row.gauge; });
    std::vector<std::string> lines;
    for (const HudRow& row : entries) {
      const std::string entry = row.name + " " + row.value + (row.unit.empty() ? "" : " " + row.unit);
      const std::string longer = lines.empty() ? entry : lines.back() + " \u00b7 " + entry;
      if (!lines.empty() && pen_.width(longer, body_, false) <= room_)
        lines.back() = longer;
      else if (static_cast<int>(lines.size()) < plan_.device_lines && pen_.width(entry, body_, false) <= room_)
        lines.push_back(entry);
    }
    return lines;
  }

  double dial_height() const {
    return heading_height() + (plan_.dial + (plan_.dial > 0 ? 1.6 : 2 * plan_.pitch)) * body_;
  }

  double needed() {
    double sum = 0.6 * body_;
    if (hud_.dial) sum += dial_height();
    if (plan_.bars > 0) sum += heading_height() + plan_.bars * bar_height();
    if (plan_.steps > 0) {
      sum += plan_.gap * body_ + heading_height();
      const auto [first, last] = step_window();
      for (std::size_t i = first; i < last; ++i) sum += static_cast<double>(step_lines(i).lines.size()) * line();
    }
    if (plan_.rows > 0) sum += plan_.gap * body_ + heading_height() + (plan_.rows + (says_left_out() ? 1 : 0)) * line();
    if (!hud_.device.empty()) {
      if (plan_.device_as_rows)
        sum += heading_height() + plan_.gap * body_ + static_cast<double>(hud_.device.size()) * line();
      else if (plan_.device_lines > 0)
        sum += plan_.gap * body_ + static_cast<double>(device_flow().size()) * line();
    }
    return sum;
  }

  /// What is told in words gives way before what is read at a glance.
  void choose_plan() {
    plan_.bars = static_cast<int>(hud_.bars.size());
    plan_.steps = static_cast<int>(hud_.steps.size());
    plan_.rows = static_cast<int>(hud_.rows.size());
    plan_.dial = hud_.dial ? std::min(6.2, (0.5 * room_ / body_ - 1.2)) : 0;
    const auto full = [this] { return needed() > box_.height; };
    const int gauges = static_cast<int>(
        std::count_if(hud_.rows.begin(), hud_.rows.end(), [](const HudRow& row) { return row.gauge; }));
    if (full()) plan_.device_as_rows = false;
    if (full()) plan_.pitch = 1.19, plan_.gap = 0.35;
    while (full() && plan_.dial > 4) plan_.dial -= 0.2;
    while (full() && plan_.rows > std::max(4, gauges)) --plan_.rows;
    if (full()) plan_.dial = 0;
    while (full() && plan_.steps > 2) --plan_.steps;
    if (full()) plan_.device_lines = 1;
    if (full()) plan_.legends = false;
    while (full() && plan_.rows > gauges) --plan_.rows;
    while (full() && plan_.steps > 0) --plan_.steps;
    if (full()) plan_.device_lines = 0;
    while (full() && plan_.rows > 0) --plan_.rows;
    while (full() && plan_.bars > 0) --plan_.bars;
  }

  void heading(const std::string& words) {
    pen_.text(words, x_, y_ + 1.05 * body_, body_, true, HudInk::kHeading, room_);
    y_ += heading_height();
  }

  /// Tip on the left, direction and roll on the right; under each its error and what is allowed.
  void lay_dial() {
    if (!hud_.dial) return;
    const PoseDial& d = *hud_.dial;
    const double mm = 1e3, deg = 180 / std::numbers::pi;
    if (d.hidden) return lay_hidden_dial(d);
    heading(labels_.match);
    const double off_mm = d.position_error_m * mm, off_deg = d.angle_error_rad * deg;
    const std::string off = number(off_mm, off_mm < kWholeFrom ? 1 : 0), leans = number(off_deg, 0);
    const std::string tip = put_in(labels_.error, off, short_number(d.position_tolerance_m * mm)) + " mm",
                      turn = put_in(labels_.error, leans, short_number(d.angle_tolerance_rad * deg)) + "\u00b0";
    const bool tip_in = d.position_error_m <= d.position_tolerance_m,
               turn_in = d.angle_error_rad <= d.angle_tolerance_rad;
    if (plan_.dial == 0) return lay_dial_rows(tip, tip_in, turn, turn_in);
    const double size = plan_.dial * body_, half = 0.5 * room_;
    lay_face(d.offset_C / std::max(d.position_tolerance_m, 1e-9), tip_in, x_, size);
    lay_face(d.lean_C / std::max(d.angle_tolerance_rad, 1e-9), turn_in, x_ + half, size, d.roll_rad);
    y_ += size;
    const double baseline = y_ + 1.15 * body_;
    pen_.text(tip, x_, baseline, body_, true, tip_in ? HudInk::kGood : HudInk::kText, half - 0.4 * body_);
    pen_.text(turn, x_ + half, baseline, body_, true, turn_in ? HudInk::kGood : HudInk::kText, half);
    y_ += 1.6 * body_;
  }

  void lay_hidden_dial(const PoseDial& dial) {
    const double end = y_ + dial_height();
    heading(labels_.match);
    pen_.text(dial.hidden_note, x_, y_ + 1.02 * body_, body_, false, HudInk::kDim, room_);
    y_ = end;
  }

  void lay_face(const Vec3& error, bool inside, double x, double size, std::optional<double> roll = {}) {
    HudDial dial;
    dial.face = {x, y_, size, size};
    dial.depth = {x + size + 0.25 * body_, y_, 0.55 * body_, size};
    const double aside = error.head<2>().norm(), share = dial_share(aside);
    dial.x = aside > 0 ? share * error.x() / aside : 0;
    dial.y = aside > 0 ? share * error.y() / aside : 0;
    dial.away = dial_share(error.z());
    dial.turns = roll.has_value();
    dial.roll_rad = roll.value_or(0);
    dial.inside = inside;
    pen_.dial(dial);
  }

  void lay_dial_rows(const std::string& tip, bool tip_in, const std::string& turn, bool turn_in) {
    for (const auto& [name, value, inside] :
         {std::tuple(labels_.tip, tip, tip_in), std::tuple(labels_.angle, turn, turn_in)}) {
      const double baseline = y_ + 0.98 * body_;
      pen_.shape(inside ? HudShape::Kind::kTick : HudShape::Kind::kOpen,
                 {x_, y_ + 0.1 * body_, 1.05 * body_, 1.05 * body_});
      const double most = room_ - icon_room() - 0.75 * pen_.width(name, body_, false) - 0.4 * body_,
                   left = pen_.text_right(value, x_ + room_, baseline, body_, true,
                                          inside ? HudInk::kGood : HudInk::kText, most);
      pen_.text(name, x_ + icon_room(), baseline, body_, false, HudInk::kDim, left - 0.4 * body_ - x_ - icon_room());
      y_ += line();
    }
  }

  void lay_bars() {
    if (plan_.bars == 0) return;
    heading(labels_.force);
    for (int i = 0; i < plan_.bars; ++i) lay_bar(hud_.bars[static_cast<std::size_t>(i)]);
  }

  /// The place of a bar that the feedback mode hides: same height, so that nothing jumps when it appears.
  void lay_hidden_bar(const ForceBar& bar) {
    pen_.text(bar.label, x_, y_ + 1.02 * body_, body_, false, HudInk::kDim, room_);
    pen_.text(bar.hidden_note, x_, y_ + (1.40 + 0.9) * body_, body_, false, HudInk::kDim, room_);
    y_ += bar_height();
  }

  void lay_bar(const ForceBar& bar) {
    if (bar.hidden) return lay_hidden_bar(bar);
    const double baseline = y_ + 1.02 * body_;
    const HudBar::Level level = force_level(bar);
    const HudInk ink = level == HudBar::Level::kOverLimit ? HudInk::kAlarm
                       : level == HudBar::Level::kAbove   ? HudInk::kCaution
                       : level == HudBar::Level::kInBand  ? HudInk::kGood
                                                          : HudInk::kText;
    double right = pen_.text_right(number(bar.value_n, 2) + " N", x_ + room_, baseline, body_, true, ink, room_);
    if (level != HudBar::Level::kBelow) {
      const HudShape::Kind kind = level == HudBar::Level::kInBand  ? HudShape::Kind::kTick
                                  : level == HudBar::Level::kAbove ? HudShape::Kind::kUp
                                                                   : HudShape::Kind::kWarning;
      right -= 1.35 * body_;
      pen_.shape(kind, {right, y_ + 0.18 * body_, 1.05 * body_, 1.05 * body_});
    }
    pen_.text(bar.label, x_, baseline, body_, false, HudInk::kText, right - 0.4 * body_ - x_);
    y_ += 1.40 * body_;
    const double scale = std::max({bar.full_scale_n, 1.1 * bar.limit_n, bar.band_high_n, 1e-9});
    const auto share = [&](double n) { return std::clamp(n / scale, 0.0, 1.0); };
    pen_.bar({{x_, y_, room_, 1.15 * body_},
              share(bar.value_n),
              share(bar.peak_n),
              share(bar.band_low_n),
              share(bar.band_high_n),
              bar.limit_n > 0 ? share(bar.limit_n) : 1.0,
              level});
    y_ += 1.15 * body_;
    if (plan_.legends) {
      lay_bar_legend(bar);
      y_ += 1.35 * body_;
    }
    y_ += 0.35 * body_;
  }

  /// One line under the bar: band left, peak in the middle, limit right; never on top of each other.
  void lay_bar_legend(const ForceBar& bar) {
    const double baseline = y_ + 1.10 * body_, space = 0.5 * body_;
    double right = x_ + room_;
    if (bar.limit_n > 0)
      right = pen_.text_right(put_in(labels_.limit, short_number(bar.limit_n)), right, baseline, body_, false,
                              HudInk::kDim, room_) -
              space;
    const std::string range =
        bar.band_high_n > 0 ? short_number(bar.band_low_n) + "\u2013" + short_number(bar.band_high_n) : "";
    const std::string peak = put_in(labels_.peak, number(bar.peak_n, 1));
    const double peak_width = pen_.width(peak, body_, false);
    double left = x_;
    if (!range.empty()) {
      const double free = right - left - peak_width - space;
      const std::string named = put_in(labels_.band, range);
      const std::string band = pen_.width(named, body_, false) <= free ? named : range;
      left = pen_.text(band, x_, baseline, body_, false, HudInk::kDim, right - left) + space;
    }
    if (bar.peak_n > 0 && right - left >= peak_width)  // no peak yet, or none kept: say nothing rather than 0
      pen_.text(peak, left + 0.5 * (right - left - peak_width), baseline, body_, false, HudInk::kText, peak_width + 1);
  }

  void lay_steps() {
    if (plan_.steps == 0) return;
    y_ += plan_.gap * body_;
    const auto done = std::count_if(hud_.steps.begin(), hud_.steps.end(),
                                    [](const HudStep& s) { return s.state == HudStep::State::kDone; });
    heading(labels_.steps + "  " + std::to_string(done) + "/" + std::to_string(hud_.steps.size()));
    const auto [first, last] = step_window();
    for (std::size_t i = first; i < last; ++i) {
      const HudStep& step = hud_.steps[i];
      const bool current = step.state == HudStep::State::kCurrent;
      const HudShape::Kind kind = step.state == HudStep::State::kDone ? HudShape::Kind::kTick
                                  : current                           ? HudShape::Kind::kCurrent
                                                                      : HudShape::Kind::kOpen;
      pen_.shape(kind, {x_, y_ + 0.10 * body_, 1.05 * body_, 1.05 * body_});
      const HudPen::Lines said = step_lines(i);
      for (const std::string& words : said.lines) {
        pen_.text(words, x_ + icon_room(), y_ + 0.98 * body_, said.size, false, current ? HudInk::kText : HudInk::kDim,
                  room_ - icon_room());
        y_ += line();
      }
    }
  }

  void row(const HudRow& row, bool striped) {
    if (striped) pen_.shape(HudShape::Kind::kStripe, {x_ - 0.3 * body_, y_, room_ + 0.6 * body_, line()});
    const double baseline = y_ + 0.5 * line() + 0.36 * body_;
    const std::string value = row.unit.empty() ? row.value : row.value + " " + row.unit;
    // 60 % of the width to the name; a short value gives the rest away.
    const double value_room = std::max(0.4 * room_, room_ - pen_.width(row.name, body_, false) - 0.5 * body_);
    const double left = pen_.text_right(value, x_ + room_, baseline, body_, false, HudInk::kText, value_room);
    pen_.text(row.name, x_, baseline, body_, false, HudInk::kDim, left - 0.4 * body_ - x_);
    y_ += line();
  }

  void lay_rows() {
    if (plan_.rows == 0) return;
    y_ += plan_.gap * body_;
    heading(labels_.so_far);
    const std::vector<HudRow> rows = shown_rows();
    for (std::size_t i = 0; i < rows.size(); ++i) row(rows[i], i % 2 == 0);
    const std::size_t left_out = hud_.rows.size() - rows.size();
    if (says_left_out()) {
      pen_.text(put_in(labels_.more, std::to_string(left_out)), x_, y_ + 0.98 * body_, body_, false, HudInk::kDim,
                room_);
      y_ += line();
    }
  }

  void lay_device() {
    if (hud_.device.empty() || (!plan_.device_as_rows && plan_.device_lines == 0)) return;
    y_ += plan_.gap * body_;
    if (plan_.device_as_rows) {
      heading(labels_.device);
      for (std::size_t i = 0; i < hud_.device.size(); ++i) row(hud_.device[i], i % 2 == 0);
      return;
    }
    for (const std::string& words : device_flow()) {
      pen_.text(words, x_, y_ + 0.98 * body_, body_, false, HudInk::kDim, room_);
      y_ += line();
    }
  }

  HudPen& pen_;
  const Hud& hud_;
  const HudLabels& labels_;
  const HudFrame& frame_;
  int body_;
  HudBox box_;
  double x_ = 0, room_ = 0, y_ = 0;
  Plan plan_;
};

}  // namespace

void lay_column(HudPen& pen, const Hud& hud, const HudFrame& frame) { Column(pen, hud, frame).lay(); }

}  // namespace trocar
