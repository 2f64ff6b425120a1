#include "app/window/replay/replay_plot.h"

#include <algorithm>
#include <cmath>

#include "app/picture/films/film.h"
#include "trainees/markup/svg.h"

namespace trocar {
namespace {

std::string one_decimal(const Translator& w, double value) { return w.number(value, 1); }

class TimeLine {
 public:
  TimeLine(Ui& ui, const Area& area, const ReplayPlotContent& c, const ReplayClock& clock)
      : ui_(ui), c_(c), clock_(clock) {
    const double left = ui.text_width("00.0 N") + ui.px(8), line = ui.line_height();
    inner_ = {area.x + left, area.y + ui.px(18), std::max(8.0, area.width - left - ui.px(8)),
              std::max(8.0, area.height - ui.px(18) - line - ui.px(4))};
    own_ = columns(c.run);
    if (c.beside) other_ = columns(*c.beside);
    for (const auto* both : {&own_, &other_})
      for (const auto& column : *both) top_n_ = std::max(top_n_, 1.1 * column.high);
    top_n_ = std::max({top_n_, 1.6 * c.band.high_n, 0.1});
  }

  double x_of(double clock_s) const {
    const double span = std::max(1e-6, clock_.to_s() - clock_.from_s());
    return inner_.x + inner_.width * std::clamp((clock_s - clock_.from_s()) / span, 0.0, 1.0);
  }
  double clock_at(double x) const {
    return clock_.from_s() + (clock_.to_s() - clock_.from_s()) * std::clamp((x - inner_.x) / inner_.width, 0.0, 1.0);
  }

  void draw() {
    ground();
    axes();
    for (std::size_t i = 0; i < own_.size(); ++i) {
      const double x = inner_.x + static_cast<double>(i), low = y_of(own_[i].low), high = y_of(own_[i].high),
                   zero = y_of(0);
      if (zero > high) ui_.paint_box({x, high, 1, zero - high}, Ink::kHeading, 0.4);
      if (zero > high) ui_.paint_box({x, high, 1, std::max(1.5, low - high)}, Ink::kHeading);
    }
    other_line();
    loop();
    for (const ReplayEvent& event : c_.events) {
      if (event.clock_s < clock_.from_s() || event.clock_s > clock_.to_s()) continue;
      paint_event(ui_, event, x_of(event.clock_s), inner_.y - ui_.px(9), ui_.px(6));
    }
    not_known();
    const double x = x_of(clock_.now_s());
    ui_.paint_line(x, inner_.y - ui_.px(16), x, inner_.y + inner_.height, Ink::kText, 2);
    ui_.paint_triangle(x - ui_.px(6), inner_.y - ui_.px(18), x + ui_.px(6), inner_.y - ui_.px(18), x,
                       inner_.y - ui_.px(9), Ink::kText);
  }

 private:
  std::vector<RecordedRun::Column> columns(const RecordedRun& run) const {
    const int count = std::max(1, static_cast<int>(inner_.width));
    const double from_s = loop_time(run, clock_.from_s()), to_s = loop_time(run, clock_.to_s());
    return c_.grip ? run.grip_columns(count, from_s, to_s) : run.force_columns(count, from_s, to_s);
  }
  double y_of(double n) const { return inner_.y + inner_.height * (1 - std::clamp(n / top_n_, 0.0, 1.0)); }

  void ground() {
    ui_.paint_ground(inner_, 0.6);
    const double band_top = y_of(c_.band.high_n);
    if (c_.band.high_n > 0)
      ui_.paint_box({inner_.x, band_top, inner_.width, y_of(c_.band.low_n) - band_top}, Ink::kGood, 0.28);
    if (c_.limit_n > 0 && c_.limit_n < top_n_)
      ui_.paint_hatch({inner_.x, inner_.y, inner_.width, y_of(c_.limit_n) - inner_.y}, Ink::kAlarm);
  }

  void axes() {
    const double high = ui_.line_height(), step_n = svg::nice_step(top_n_, std::max(1.0, inner_.height / (1.6 * high)));
    for (double n = 0; n <= top_n_; n += step_n) {
      ui_.paint_line(inner_.x - ui_.px(4), y_of(n), inner_.x, y_of(n), Ink::kDim, 1);
      ui_.text_at(inner_.x - ui_.px(6), y_of(n) - 0.55 * high, one_decimal(ui_.words(), n) + " N", Ink::kDim, 0, 1);
    }
    const double step_s = std::max(1.0, svg::nice_step(clock_.to_s() - clock_.from_s(), inner_.width / ui_.px(90)));
    for (double s = std::ceil(clock_.from_s() / step_s) * step_s; s <= clock_.to_s(); s += step_s) {
      s = std::abs(s) < 1e-9 ? 0 : s;  // no "-0 s"
      const double x = x_of(s);
      ui_.paint_line(x, inner_.y + inner_.height, x, inner_.y + inner_.height + ui_.px(4), Ink::kDim, 1);
      if (x + ui_.px(40) > inner_.x + inner_.width) continue;
      ui_.text_at(x, inner_.y + inner_.height + ui_.px(4), ui_.words().number(s, 0) + " s", Ink::kDim, 0, 0.5);
    }
  }

  void other_line() {
    if (other_.empty()) return;
    std::vector<Ui::Point> points;
    for (std::size_t i = 0; i < other_.size(); i += 2)
      points.push_back({inner_.x + static_cast<double>(i), y_of(other_[i].high)});
    ui_.paint_curve(points, Ink::kCaution, 2);
  }

  void loop() {
    const auto edge = [&](double s, const char* name) {
      ui_.paint_line(x_of(s), inner_.y, x_of(s), inner_.y + inner_.height, Ink::kHeading, 2, true);
      ui_.text_at(x_of(s) + ui_.px(3), inner_.y + ui_.px(1), name, Ink::kHeading);
    };
    if (clock_.loop_a_s()) edge(*clock_.loop_a_s(), "A");
    if (clock_.loop_b_s()) edge(*clock_.loop_b_s(), "B");
  }

  /// What is still being run again.
  void not_known() {
    const double from = x_of(c_.run.available_until() - c_.run.begin_s()), end = inner_.x + inner_.width;
    if (c_.run.stage() != RecordedRun::Stage::kReplaying || from >= end) return;
    ui_.paint_hatch({from, inner_.y, end - from, inner_.height}, Ink::kDim, 14, 1);
  }

  Ui& ui_;
  const ReplayPlotContent& c_;
  const ReplayClock& clock_;
  Area inner_;
  std::vector<RecordedRun::Column> own_, other_;
  double top_n_ = 0;
};

}  // namespace

void replay_plot(Ui& ui, const Area& area, const ReplayPlotContent& content, ReplayClock& clock) {
  const Ui::Pointer pointer = ui.pointer();
  TimeLine line(ui, area, content, clock);
  if (pointer.held || pointer.clicked) clock.go(line.clock_at(pointer.x));
  line.draw();
}

}  // namespace trocar
